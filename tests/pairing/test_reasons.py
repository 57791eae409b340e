import json

import pytest

from shapeblend_cli.cli import run
from tests.support.drawings import svg


@pytest.fixture
def report(tmp_path, monkeypatch, capfd):
    def blended(a, b, *options):
        monkeypatch.chdir(tmp_path)
        (tmp_path / "a.svg").write_text(svg(*a, viewbox="0 0 40 40"), "utf-8")
        (tmp_path / "b.svg").write_text(svg(*b, viewbox="0 0 40 40"), "utf-8")
        assert run(["a.svg", "b.svg", "-n", "0", "--report", "-", *options]) == 0
        (pair,) = json.loads(capfd.readouterr().out)["pairs"]
        return pair

    return blended


def rect(x, y, width, height, colour="#640"):
    return f'<rect x="{x}" y="{y}" width="{width}" height="{height}" fill="{colour}"/>'


FACE, EYES, MOUTH = rect(0, 0, 40, 40, "#fc4"), (rect(6, 8, 6, 6), rect(28, 8, 6, 6)), rect(10, 26, 20, 5)


def test_the_report_says_what_lies_in_what_and_why_contours_are_paired(report):
    tear = rect(7, 15, 3, 12, "#5ae")
    found = report(
        (FACE, *EYES, MOUTH), (FACE, MOUTH.replace("26", "28"), rect(6, 9, 6, 4), rect(28, 9, 6, 4), tear)
    )
    assert found["inside_a"] == {"1": 0, "2": 0, "3": 0}
    assert found["inside_b"] == {"1": 0, "2": 0, "3": 0, "4": 0}
    reasons = {(contour["a"], contour["b"]): contour["pair_because"] for contour in found["contours"]}
    assert reasons.pop((3, 1)).startswith("overlaps ")
    assert reasons == {
        (0, 0): "overlaps 100 %",
        (1, 2): "twin of 2=3",
        (2, 3): "twin of 1=2",
        (None, 4): "A has nothing like it there",
    }


def test_what_is_asked_for_and_what_has_no_choice_say_so(report):
    reasons = [
        contour["pair_because"]
        for contour in report((FACE, MOUTH), (FACE, rect(12, 20, 10, 8)), "--match", "0=0")["contours"]
    ]
    assert reasons == ["asked for", "the only ones inside 0=0"]
    (alone,) = report((FACE,), (MOUTH,))["contours"]
    assert alone["pair_because"] == "the only ones"


def test_of_a_copy_that_is_turned_it_is_said_what_overlaps_once_it_is_turned_back(report):
    parts = '<path d="M4 4H34V12H14V36H4Z" fill="#640"/>' + rect(20, 20, 6, 3) + rect(30, 30, 3, 6)
    found = report((parts,), (f'<g transform="rotate(90 20 20)">{parts}</g>',))
    assert all(contour["turned_back"] == pytest.approx(90) for contour in found["contours"])
    assert {contour["pair_because"] for contour in found["contours"]} == {"overlaps 100 %"}


# A card with a window, and the same crossed out: a bar from corner to corner, and beside it a gap.
CARD = '<path d="M4 4H20V20H4Z M10 8V12H15V8Z"/>'
CROSSED_OUT = '<path d="M1 2L2 1L23 22L22 23L19 20H4V5Z M7 4H20V17L15 12V8H11Z"/>'


@pytest.mark.parametrize(("a", "b"), [(CARD, CROSSED_OUT), (CROSSED_OUT, CARD)])
def test_of_what_is_crossed_out_every_contour_is_there_and_the_bar_says_what_it_does(report, a, b):
    contours = report((a,), (b,))["contours"]
    assert {c["a"] for c in contours} - {None} == {c["b"] for c in contours} - {None} == {0, 1}
    for contour in contours:
        alone = contour["a"] is None or contour["b"] is None
        assert contour["pair_because"] == (
            "a part that is added or removed"
            if alone
            else "unchanged except where parts are added or removed"
        )
