"""Shapes that start one after the other."""

from pathlib import Path
from xml.etree import ElementTree

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import assert_refused, points, write
from tests.support.drawings import BAR, LEAF, svg

SVG = "{http://www.w3.org/2000/svg}"


def three(shift, fill="#000000"):
    """Three squares beside each other, the right one lowest in paint order, the middle one largest."""
    boxes = ((20, 4), (8, 6), (0, 3))
    return svg(
        *(f'<path d="M{x} {2 + shift}h{side}v{side}h{-side}z" fill="{fill}"/>' for x, side in boxes),
        viewbox="0 0 30 30",
    )


def starts(*options):
    """When each square has begun to move, of 20 frames: 0 by then, counted in frames; in the order of the file."""
    write(a=three(0), b=three(12))
    assert (
        run(["a.svg", "b.svg", "-n", "19", "--ends", "-o", "f", "-f", "-q", "--motion", "linear", *options])
        == 0
    )
    tops = []
    for file in sorted(Path("f").iterdir()):
        paths = ElementTree.parse(file).getroot().findall(f"{SVG}path")
        tops.append([points(path.get("d")).imag.min() for path in paths])
    found = []
    for square in zip(*tops, strict=True):
        moving = [k for k, top in enumerate(square) if 2.01 < top < 13.99]
        found.append((moving[0] - 1, moving[-1] + 1))
    return found


def test_without_it_all_start_at_once(here):
    assert starts() == [(0, 20)] * 3


@pytest.mark.parametrize(
    ("by", "first", "last"),
    [("order", 0, 2), ("left", 2, 0), ("right", 0, 2), ("size", 1, 2), (None, 0, 2)],
)
def test_shapes_start_in_turn_and_take_equally_long(here, by, first, last):
    found = starts("--stagger", ".5", *(["--stagger-by", by] if by else []))
    assert found[first] == (0, 10)
    assert found[last] == (10, 20)
    assert sorted(found) == [(0, 10), (5, 15), (10, 20)]


@pytest.mark.parametrize("by", ["top", "bottom"])
def test_they_may_start_from_above_or_below(here, by):
    column = svg(*(f'<path d="M2 {y}h4v4h-4z"/>' for y in (2, 10, 18)))
    moved = svg(*(f'<path d="M14 {y}h4v4h-4z"/>' for y in (2, 10, 18)))
    write(a=column, b=moved)
    assert (
        run(["a.svg", "b.svg", "-n", "1", "-o", "f", "-f", "-q", "--stagger", ".6", "--stagger-by", by]) == 0
    )
    paths = ElementTree.parse("f/frame-1.svg").getroot().findall(f"{SVG}path")
    lefts = [points(path.get("d")).real.min() for path in paths]
    assert lefts == sorted(lefts, reverse=by == "top")
    assert len(set(lefts)) == 3


def test_paint_goes_with_its_shape(here):
    write(a=three(0, "#ff0000"), b=three(12, "#0000ff"))
    assert run("a.svg b.svg -n 1 -o f -q --stagger .9 --motion linear".split()) == 0
    fills = [path.get("fill") for path in ElementTree.parse("f/frame-1.svg").getroot().findall(f"{SVG}path")]
    assert fills[0] == "#0000ff"
    assert fills[2] == "#ff0000"


REFUSED = {
    "--stagger 1": "--stagger must be at most 0.95, not 1",
    "--stagger-by size": "--stagger-by sets the order of --stagger",
    "--stagger .5 --emit lottie": "--stagger is for frames, animated SVGs",
    "--stagger .5 --emit pair": "--stagger is for frames, animated SVGs",
    "--stagger .5 --mix .5,.5": "--mix makes mixtures",
    "--stagger .5 -o x.svg --animate css --trigger hover": "needs --animate smil",
}


@pytest.mark.parametrize("options", REFUSED)
def test_what_cannot_be_staggered_is_refused(here, capsys, options):
    write(a=svg(BAR), b=svg(LEAF))
    assert_refused(capsys, ["a.svg", "b.svg", *options.split()], REFUSED[options])
