"""Lines cut out of plates."""

from functools import cache

import numpy as np
import pytest

import shapeblend_cli as sb
from shapeblend_cli.frames.frames import frame_at, shapes_at
from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.model import Box
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from tests.support.contours import polyline
from tests.support.drawings import drawing, svg

PLATE = "M2 2H22V22H2Z"
PLUS = "M11 6H13V11H18V13H13V18H11V13H6V11H11Z"
CROSS = (
    "M7.05 5.64L12 10.59L16.95 5.64L18.36 7.05L13.41 12L18.36 16.95"
    "L16.95 18.36L12 13.41L7.05 18.36L5.64 16.95L10.59 12L5.64 7.05Z"
)
CHECK = "M10 14.17L17.59 6.58L19 8L10 17L5 12L6.41 10.59Z"
BARS = "M6 7H18V9H6Z M6 11H18V13H6Z M6 15H18V17H6Z"
PAIRS = [(PLUS, CHECK), (CROSS, CHECK), (BARS, CROSS), (PLUS, "M6 11H18V13H6Z"), (CHECK, BARS)]
POINTS = Box(0, 0, 24, 24).grid(97) + 0.01 + 0.013j


@cache
def pair_of(a, b, plates=(PLATE, PLATE), **settings):
    paths = (f'<path fill-rule="evenodd" d="{p} {d}"/>' for p, d in zip(plates, (a, b), strict=True))
    (pair,), _ = match_all([drawing(path) for path in paths], Settings(**settings))
    return pair


def painted(pair, t):
    """Which of the points are painted."""
    windings = [
        winding_numbers(POINTS, polyline(path, 8)) for shape in shapes_at(pair, t) for path in shape.paths
    ]
    return np.sum(windings, axis=0) != 0


@pytest.mark.parametrize("backwards", [False, True])
@pytest.mark.parametrize(("a", "b"), PAIRS)
def test_lines_become_lines_of_the_same_width_within_the_plate(a, b, backwards):
    pair = pair_of(*((b, a) if backwards else (a, b)))
    (shape,) = pair.shapes
    assert shape.motion_name == "pen"
    assert frame_at(pair, 1.0, as_drawn=True).shapes == pair.drawn[1]
    areas = []
    for t in np.linspace(0.0, 1.0, 9):
        filled = painted(pair, t)
        plate = winding_numbers(POINTS, polyline(shape.contours[0].start, 8)) != 0
        assert not (filled & ~plate).any()
        areas.append((plate & ~filled).sum() / 16.0)
    # No hole counts twice, which would fill it, and none swells: twice the length of the pen's way.
    assert max(areas) < 1.12 * max(areas[0], areas[-1])
    assert min(areas) > 0.55 * min(areas[0], areas[-1])


def test_dots_are_lines_too():
    dot = "M{0} {1}A1 1 0 1 1 {2} {1}A1 1 0 1 1 {0} {1}Z"
    i, mark = dot.format(11, 7, 13) + "M11 10H13V17H11Z", dot.format(11, 17, 13) + "M11 7H13V14H11Z"
    pair = pair_of(i, mark)
    (shape,) = pair.shapes
    assert shape.motion_name == "pen"
    assert frame_at(pair, 1.0, as_drawn=True).shapes == pair.drawn[1]
    inks = [painted(pair, t).sum() for t in np.linspace(0.0, 1.0, 5)]
    assert min(inks) > 0.98 * max(inks)


@pytest.mark.parametrize("t", [0.0, 1.0])
@pytest.mark.parametrize(("a", "b"), PAIRS)
def test_both_ends_are_the_drawings(a, b, t):
    pair = pair_of(a, b)
    hole = drawing(f'<path d="{(a, b)[int(t)]}"/>').shapes[0].contours
    wanted = sum(winding_numbers(POINTS, polyline(contour, 8)) for contour in hole) == 0
    wanted &= winding_numbers(POINTS, np.array([2 + 2j, 22 + 2j, 22 + 22j, 2 + 22j])) != 0
    assert (painted(pair, t) == wanted).mean() > 0.995


@pytest.mark.parametrize(
    ("a", "b", "plates"),
    [
        (PLUS, CHECK, (PLATE, "M2 2H22V14H2Z M2 15H22V22H2Z")),  # another plate
        (PLUS, "M6 6H18V18H6Z", (PLATE, PLATE)),  # a hole that is no line
        (PLUS, CHECK, (PLATE, "M1 1H5V5H1Z")),  # a plate that is not there
    ],
)
def test_other_plates_are_matched_by_their_outlines(a, b, plates):
    assert "pen" not in {shape.motion_name for shape in pair_of(a, b, plates).shapes}


def test_strokes_keep_matches_the_holes_by_their_outlines():
    assert "pen" not in {shape.motion_name for shape in pair_of(PLUS, CHECK, strokes="keep").shapes}


@pytest.mark.parametrize(
    ("target", "options"),
    [
        ("x.svg", {}),
        ("y.svg", {"animate": "css"}),
        ("x.json", {"emit": "lottie"}),
        ("x.xml", {"emit": "avd"}),
        ("pair", {"emit": "pair"}),
    ],
)
def test_every_format_can_show_them(tmp_path, target, options):
    files = []
    for name, hole in (("a", BARS), ("b", CROSS)):
        files.append(tmp_path / f"{name}.svg")
        files[-1].write_text(svg(f"{PLATE} {hole}", attributes='fill-rule="evenodd"'))
    saved = sb.blend(*files).save(tmp_path / target, **options)
    assert all("nan" not in file.read_text() for file in saved)
