"""What is kept from one correction to the next changes nothing of what comes out."""

import json

import pytest

from shapeblend_cli.rows.project import project_of
from shapeblend_cli.studio import answers
from shapeblend_cli.studio.order import Order
from shapeblend_cli.system.kept import Kept
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
    for values, found in zip(CORRECTIONS, after_others, strict=True):
        monkeypatch.setattr(answers, "KEPT", Kept(0))
        assert looked(values) == found
    assert len(set(after_others)) > 5
