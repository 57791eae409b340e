"""What is kept from one correction to the next changes nothing of what comes out."""

import json

import numpy as np
import pytest

from shapeblend_cli.errors import OptionError
from shapeblend_cli.job.tries import _differ
from shapeblend_cli.rows.project import project_of
from shapeblend_cli.studio import answers
from shapeblend_cli.studio.order import Consent, Order
from shapeblend_cli.system.kept import Kept
from tests.support.documents import ROOT
from tests.support.drawings import EYED, RING, SQUARES, svg

DRAWINGS = {
    "ring": svg(RING, attributes='fill-rule="evenodd"'),
    "eyed": svg(EYED, attributes='fill-rule="evenodd" fill="#206080"'),
    "squares": svg(*SQUARES.split(" ", 0), attributes='fill="#804000"'),
}
CORRECTIONS = (
    {},
    {"pin": ["2,12:5,2"]},
    {"pin": ["2,12:5,22"]},
    {"match": ["0=0"], "motion": "linear"},
    {"kb": 3, "polygons": True},
    {"stiff": ["4,12,6=5"]},
    {"unmatched": "split"},
    {"place": "bbox"},
    {"style": "a", "preset": "paper"},
    {"pin": ["2,12:5,2"], "effort": "fast", "reverse": "yes"},
    {},
)


def looked(values):
    project = project_of({"files": ["a.svg", "b.svg"], "vertices": 40, **values}, "", "")
    answer = answers.do(Order("blend", project, {}))
    return json.dumps([answer[name] for name in ("pairs", "drawings", "grade", "notes")])


@pytest.mark.parametrize(("a", "b"), [("ring", "eyed"), ("squares", "eyed"), ("eyed", "eyed")])
def test_a_blend_is_the_same_whatever_was_looked_at_before(here, monkeypatch, a, b):
    (here / "a.svg").write_text(DRAWINGS[a])
    (here / "b.svg").write_text(DRAWINGS[b])
    monkeypatch.setattr(answers, "KEPT", Kept(most=64, largest=1_000_000, steps=2000))
    after_others = [looked(values) for values in CORRECTIONS]
    for values, found in zip(CORRECTIONS[1:], after_others[1:], strict=True):
        monkeypatch.setattr(answers, "KEPT", Kept(0))
        assert looked(values) == found
    assert after_others[0] == after_others[-1]
    assert len(set(after_others)) > 5


def asked(values):
    return answers.do(Order("blend", project_of({"files": ["a.svg", "b.svg"], **values}, "", ""), {}))


def parts(**values):
    """The parts of the timeline by name, each with its span."""
    (pair,) = asked(values)["pairs"]
    return {part["name"]: tuple(part["span"]) for part in pair["parts"]}


def grouped(shift):
    """Three shapes: one with an id in a group with an id, one without, and one whose id the page does not show."""
    return svg(
        f'<g id="sky"><path id="sun" d="M{1 + shift} 1h5v5h-5z"/></g>'
        f'<path d="M{9 + shift} 9h6v6h-6z"/><path id="&lt;x&gt;" d="M{17 + shift} 17h6v6h-6z"/>'
    )


def test_the_parts_of_a_timeline_go_by_what_a_timetable_may_call_them(here):
    (here / "a.svg").write_text(grouped(0))
    (here / "b.svg").write_text(grouped(1))
    assert parts() == {"#sun": (0, 1), "1": (0, 1), "2": (0, 1)}
    timetable = {"1": {"start": 0.5}, "#<x>": {"length": 0.25}, "sky": {"start": 0.1}}
    assert parts(timing=timetable, ease="back") == {"#sun": (0.1, 1), "1": (0.5, 1), "#<x>": (0, 0.25)}
    (sun, *others) = asked({"timing": timetable})["pairs"][0]["parts"]
    assert sun["is_grouped"]
    assert not any(part["is_grouped"] for part in others)
    assert parts(stagger=0.5) == {"#sun": (0, 0.5), "1": (0.25, 0.75), "2": (0.5, 1)}


def test_where_specks_are_left_out_parts_have_the_numbers_of_those_that_remain(here):
    speck = "M0 0h.1v.1h-.1z"
    (here / "a.svg").write_text(svg(f"{speck}M1 1h5v5h-5z", "M9 9h6v6h-6z"))
    (here / "b.svg").write_text(svg("M2 2h5v5h-5z", "M9 9h7v7h-7z"))
    answer = asked({"specks": 1})
    assert [len(drawing["contours"]) for drawing in answer["drawings"]] == [2, 2]
    assert [(contour["a"], contour["b"]) for contour in answer["pairs"][0]["contours"]] == [(0, 0), (1, 1)]
    assert any("left out" in note for note in answer["notes"])


def test_both_edges_of_a_stroke_that_becomes_a_fill_have_the_number_of_the_stroke(here):
    (here / "a.svg").write_text(svg("M3 3H21V21H3Z", attributes='fill="none" stroke="#000" stroke-width="2"'))
    (here / "b.svg").write_text(DRAWINGS["ring"])
    answer = asked({"swap": "never"})
    assert [len(drawing["contours"]) for drawing in answer["drawings"]] == [1, 2]
    assert [(contour["a"], contour["b"]) for contour in answer["pairs"][0]["contours"]] == [(0, 0), (0, 1)]


@pytest.mark.parametrize("what", ["blend", "others"])
def test_a_mixture_is_refused_in_a_line_and_written_all_the_same(here, what):
    for name, drawing in {"a": "ring", "b": "eyed"}.items():
        (here / f"{name}.svg").write_text(DRAWINGS[drawing])
    project = project_of({"files": ["a.svg", "b.svg"], "mix": ".5,.5", "output": "mixed.svg"}, "", "")
    with pytest.raises(OptionError, match=r"^--mix makes mixtures, which the studio does not show"):
        answers.do(Order(what, project, {}))
    assert answers.do(Order("write", project, {}, Consent(str(here))))["written"] == ["mixed.svg"]
    assert (here / "mixed.svg").exists()


def test_other_blends_that_look_the_same_are_not_offered(here):
    for name, drawing in {"a": "car", "b": "bus"}.items():
        (here / f"{name}.svg").write_bytes((ROOT / "docs" / "studio" / f"{drawing}.svg").read_bytes())
    order = Order("others", project_of({"files": ["a.svg", "b.svg"]}, "", ""), {})
    names = {one["name"] for one in answers.do(order)}
    assert {"As it is", "B in the frame of A"} <= names
    assert "Points may go far" not in names  # a line's width off at most


@pytest.mark.parametrize(("shift", "is_other"), [(0, False), (1, False), (2, True)])
def test_thin_lines_beside_each_other_look_the_same(shift, is_other):
    line = np.zeros((48, 48), np.intp)
    line[10:40, 20] = 5
    assert _differ([line], [np.roll(line, shift, axis=1)]) == is_other
    assert _differ([line], [np.where(line, 7, 0)])  # of another colour
