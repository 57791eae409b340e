"""Pen lines of filled shapes."""

from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.anatomy.decompose import PlacedDrawing, decompose
from shapeblend_cli.geometry.raster import winding_grid
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.pens.drawings import pen_drawing
from shapeblend_cli.pens.line import UNITS
from shapeblend_cli.pens.recovery.region import Recovered, Region, stroke_edges
from shapeblend_cli.svg.reading.read import read
from tests.support import drawings

ICONS = Path(__file__).parent / "icons"

# Fills of 24 units, and for each the lines it was drawn with: closed, cap, and points that are on the line.
STROKES = {
    "bar": ("M3 11H21V13H3Z", [(False, "butt", [3 + 12j, 21 + 12j])]),
    "round bar": ("M4 11H20A1 1 0 0 1 20 13H4A1 1 0 0 1 4 11Z", [(False, "round", [4 + 12j, 20 + 12j])]),
    "plus": (
        "M11 3H13V11H21V13H13V21H11V13H3V11H11Z",
        [(False, "butt", [12 + 3j, 12 + 21j]), (False, "butt", [3 + 12j, 21 + 12j])],
    ),
    "short bar": ("M9 11H14V13H9Z", [(False, "butt", [9 + 12j, 14 + 12j])]),
    "small saltire": (
        "M14.586 8L12 10.586L9.414 8L8 9.414L10.586 12L8 14.586L9.414 16"
        "L12 13.414L14.586 16L16 14.586L13.414 12L16 9.414Z",
        [(False, "butt", [8.7 + 8.7j, 15.3 + 15.3j]), (False, "butt", [15.3 + 8.7j, 8.7 + 15.3j])],
    ),
    "tee": ("M3 5H21V7H13V21H11V7H3Z", [(False, "butt", [3 + 6j, 21 + 6j]), (False, "butt", [12 + 21j])]),
    "corner": ("M4 4H6V18H20V20H4Z", [(False, "butt", [5 + 4j, 5 + 19j, 20 + 19j])]),
    "ring": (
        "M12 2A10 10 0 1 0 12 22A10 10 0 1 0 12 2ZM12 4A8 8 0 1 1 12 20A8 8 0 1 1 12 4Z",
        [(True, "round", [12 + 3j, 21 + 12j, 12 + 21j])],
    ),
    "frame": ("M2 2H22V22H2ZM4 4V20H20V4Z", [(True, "round", [3 + 3j, 21 + 21j, 12 + 3j])]),
    "dot": ("M12 11A1 1 0 1 0 12 13A1 1 0 1 0 12 11Z", [(False, "round", [12 + 12j])]),
}
SOLID = {
    "square": "M2 2H22V22H2Z",
    "disc with a hole": "M12 2A10 10 0 1 0 12 22A10 10 0 1 0 12 2ZM8 8V9H9V8Z",
    "triangle": "M3 21L12 3L21 21Z",
    "wedge": "M2 12L22 8V16Z",
    "thick cross": "M10 2H14V10H22V14H14V22H10V14H2V10H10Z",
}


def lines_of(*paths, **options):
    drawing = drawings.drawing(*paths, **options)
    return pen_drawing(PlacedDrawing(drawing, Similarity(), decompose(drawing, Similarity(), 200)[0]), 1.0)


def icon(name):
    drawing = read(str(ICONS / f"{name}.svg"))
    scale = UNITS / drawing.viewbox.larger_side
    contours = decompose(drawing, Similarity(), 200)[0]
    return pen_drawing(PlacedDrawing(drawing, Similarity(), contours), scale)


def away(line, points):
    """How far points are from a line."""
    outline = line.outline if len(line.points) > 1 else np.repeat(line.points, 2)
    edges = np.diff(outline)
    offsets = np.asarray(points)[:, None] - outline[:-1]
    shares = np.clip((offsets * edges.conj()).real / np.maximum(np.abs(edges) ** 2, 1e-12), 0.0, 1.0)
    return np.abs(offsets - shares * edges).min(axis=1)


@pytest.mark.parametrize("name", STROKES)
def test_a_stroke_comes_back_as_its_line(name):
    path, expected = STROKES[name]
    found = lines_of(path)
    assert (found.bodies, found.share) == ([], 1.0)
    assert [line.width for line in found.lines] == pytest.approx([2.0] * len(expected), rel=0.01)
    for closed, cap, points in expected:
        (line,) = [line for line in found.lines if away(line, points).max() < 0.05]
        assert (line.closed, line.style.stroke_linecap) == (closed, cap)
        assert (line.style.fill, line.style.stroke) == (None, "#000000")
        if not closed:
            ends = line.points[[0, -1]]
            assert all(np.abs(ends - point).min() < 0.05 for point in (points[0], points[-1]))


@pytest.mark.parametrize("name", SOLID)
def test_what_is_solid_is_no_line(name):
    found = lines_of(SOLID[name])
    assert (found.lines, found.share) == ([], 0.0)


@pytest.mark.parametrize("path", sorted(ICONS.glob("solid-*.svg")), ids=lambda path: path.stem)
def test_solid_icons_are_no_lines(path):
    assert icon(path.stem).lines == []


@pytest.mark.parametrize("path", sorted(ICONS.glob("ph-*.svg")), ids=lambda path: path.stem)
def test_icons_drawn_with_a_pen_come_back_as_lines_that_paint_the_same(path):
    found = icon(path.stem)
    assert found.bodies == []
    assert {round(line.width, 1) for line in found.lines if line.length > 0.0} == {1.5}
    drawing = read(str(path))
    scale = UNITS / drawing.viewbox.larger_side
    region = Region([contour.segments * scale for shape in drawing.shapes for contour in shape.contours])
    wanted = winding_grid(region.starts, region.ends, 0j, UNITS / 400, 400) % 2 == 1
    strokes = [
        Recovered(line.points, line.closed, line.width, line.style.stroke_linecap, line.style.stroke_linejoin)
        for line in found.lines
    ]
    covered = winding_grid(*stroke_edges(strokes), 0j, UNITS / 400, 400) != 0
    assert (wanted & covered).sum() / (wanted | covered).sum() > 0.985


def test_regions_follow_long_curves():
    segment = np.array([2 + 22j, 2 - 8j, 22 - 8j, 22 + 22j])
    t = 0.44
    on_it = complex(np.array([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3]) @ segment)
    region = Region([np.stack([segment, np.linspace(22 + 22j, 2 + 22j, 4)])])
    assert region.holds(on_it + 0.02j)
    assert not region.holds(on_it - 0.02j)


def test_a_line_with_a_round_cap_that_is_cut_along_a_slash_has_the_same_area():
    found = lines_of("M4 11H18L16 13H4A1 1 0 0 1 4 11Z")
    (line,) = found.lines
    assert found.bodies == []
    assert line.style.stroke_linecap == "round"
    assert (line.length + np.pi / 2.0) * 2.0 == pytest.approx(26.0 + np.pi / 2.0, rel=0.01)


def test_corners_rounder_outside_than_inside_are_no_lines_of_their_own():
    plane = (
        "M1.5 2A1.4 1.4 0 0 1 3 1.75L22.3 11A1.15 1.15 0 0 1 22.3 13L3 22.25A1.4 1.4 0 0 1 1.1 20.8L2.5 12L1.1 3.2"
        "A1.4 1.4 0 0 1 1.5 2ZM3.9 12.75L2.6 20.8L21 12L2.6 3.2L3.9 11.25H11.2A.75 .75 0 0 1 11.2 12.75Z"
    )
    assert min(line.length for line in lines_of(plane).lines) > 5.0


def test_a_second_pen_may_be_hardly_wider_than_the_first():
    found = lines_of("M3 3H21V5H13.1V21H10.9V5H3Z")
    assert sorted(round(line.width, 2) for line in found.lines) == [2.0, 2.2]


def test_strokes_of_a_file_are_lines_as_they_are():
    stroke = '<path d="M2 2C8 2 12 6 12 12" fill="none" stroke="#c00" stroke-width="1.5"/>'
    (line,) = lines_of(stroke).lines
    assert line.width == 1.5
    assert len(lines_of(stroke.replace("/>", ' stroke-dasharray="2 1"/>')).lines) == 1
    assert away(line, [2 + 2j, 12 + 12j]).max() < 1e-12


def test_what_is_filled_and_stroked_is_no_line():
    assert lines_of('<path d="M3 11H21V13H3Z" fill="#000" stroke="#c00"/>').lines == []


@pytest.mark.parametrize("size", [1e4, 1e8])
def test_outlines_far_larger_than_the_viewbox_are_not_sampled(size, monkeypatch):
    monkeypatch.setattr("shapeblend_cli.pens.recovery.recover._sampled", None)
    assert lines_of(f"M0 0H{size}V2H0Z").lines == []


def test_strokes_far_longer_than_the_viewbox_are_taken_as_they_are():
    assert lines_of('<path d="M0 0H1e8" fill="none" stroke="#000"/>').lines == []
    assert len(lines_of('<path d="M0 0H100" fill="none" stroke="#000"/>').lines) == 1


def test_a_straight_stroke_is_a_line_though_it_is_filled_by_default():
    assert [line.length for line in lines_of('<path d="M3 5H21" stroke="#000" stroke-width="2"/>').lines] == [
        18.0
    ]


def test_corners_that_are_rounder_outside_than_the_pen_are_rounded():
    inside = "M10.8 8L5 4.63V11.37Z"
    outside = "M11.6 7.3A.8 .8 0 0 1 11.6 8.7L5.23 12.39C4.71 12.69 4 12.35 4 11.69V4.31C4 3.65 4.71 3.31 5.23 3.61Z"
    (line,) = lines_of(inside + outside, viewbox="0 0 16 16").lines
    assert line.closed
    assert max(line.points.real) + line.width / 2.0 == pytest.approx(12.0, abs=0.04)


def test_what_sticks_out_of_lines_is_a_shape_of_its_own():
    found = lines_of("M1 11H10A2 2 0 0 1 14 11H23V13H1Z")
    (line,), (knob,) = found.lines, found.bodies
    assert away(line, [1 + 12j, 23 + 12j]).max() < 0.05
    assert knob.number == 1  # beside those of the file
    assert knob.box.bounds == pytest.approx((10.0, 9.0, 14.0, 12.0), abs=0.15)
    assert 0.6 < found.share < 0.9


def test_a_knob_as_wide_as_another_pen_is_no_line():
    found = lines_of("M1 11H9V10A1 1 0 0 1 10 9H13A1 1 0 0 1 14 10V11H23V13H1Z")
    assert [round(line.width, 1) for line in found.lines] == [2.0]
    assert len(found.bodies) == 1


@pytest.mark.parametrize(("colour", "count"), [("#ddd", 1), ("#000", 2)])
def test_a_disc_below_a_ring_of_another_colour_is_no_line(colour, count):
    wheel = f'<circle cx="12" cy="12" r="1.5" fill="{colour}"/>'
    tyre = '<circle cx="12" cy="12" r="1.5" fill="none" stroke="#000" stroke-width="1"/>'
    assert len(lines_of(wheel, tyre).lines) == count


def test_a_square_beside_lines_with_square_ends_is_a_dot():
    found = lines_of("M11 4H13V14H11Z", "M11 16H13V18H11Z")
    assert [line.length for line in found.lines] == pytest.approx([10.0, 2.0])
    assert found.share == 1.0
    assert lines_of("M11 4H13V14H11Z", "M10 16H14V20H10Z").bodies


def test_outlines_that_a_file_has_twice_are_one_line():
    assert len(lines_of("M11 4H13V14H11Z M11 4H13V14H11Z").lines) == 1
