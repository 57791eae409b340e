"""Fills in pieces, and outlines without an area."""

import sys
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from shapely import LineString

from shapeblend_cli.anatomy.pieces import with_areas
from shapeblend_cli.geometry.cubics import polyline
from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.job.report import inspection
from tests.support.drawings import EVENODD, RING, SQUARES, drawing

# A user's shoulders in seven pieces, as Figma exports a stroke of a width of 2: caps, uprights, corners, and what is
# between; the last piece is off by a thousandth, as rounded numbers are.
SHOULDERS = (
    "M20 18a1 1 0 1 0 2 0zM2 18a1 1 0 1 0 2 0zM21 16h-1v2h2v-2zM3 16h-1v2h2v-2z"
    "M18 13v1a2 2 0 0 1 2 2h2a4 4 0 0 0-4-4zM6 13v-1a4 4 0 0 0-4 4h2a2 2 0 0 1 2-2zM6 13v1.001h12v-2H6z"
)


def areas(path, attributes=""):
    found = with_areas(drawing(path, attributes=attributes))
    assert with_areas(found) is found
    (shape,) = found.shapes
    for contour in shape.contours:
        ends = contour.segments[:, [0, 3]]
        assert np.array_equal(ends[:, 1], np.roll(ends[:, 0], -1))
        thirds = ends[:, :1] + np.arange(4) / 3 * (ends[:, 1:] - ends[:, :1])
        assert contour.segments[contour.straight] == pytest.approx(thirds[contour.straight])
    return shape.contours


def area(contours):
    return abs(sum(signed_area(polyline(contour.segments, 32)) for contour in contours))


def in_pieces(points, radius):
    """The path of a thick line in pieces, to thousandths: each segment, round join and round cap by itself."""

    def at(z):
        return f"{z.real:.3f} {z.imag:.3f}"

    def piece(*corners):
        return f"M{'L'.join(map(at, corners))}Z"

    edges = [(q - p) / abs(q - p) * radius for p, q in pairwise(points)]
    found = [
        piece(p, p - 1j * e, q - 1j * e, q, q + 1j * e, p + 1j * e)
        for (p, q), e in zip(pairwise(points), edges, strict=True)
    ]
    arc = f"A{radius} {radius} 0 0 1 "
    for end, e in ((points[0], -edges[0]), (points[-1], edges[-1])):
        found.append(f"M{at(end - 1j * e)}{arc}{at(end + e)}{arc}{at(end + 1j * e)}Z")
    for z, d, e in zip(points[1:-1], edges, edges[1:], strict=False):
        sign = -1.0 if (e / d).imag > 0.0 else 1.0  # on the outside of the corner
        ends = [z + sign * 1j * d, z + sign * 1j * e][:: int(-sign)]
        found.append(f"M{at(z)}L{at(ends[0])}{arc}{at(ends[1])}Z")
    return "".join(found)


def test_the_pieces_of_a_stroke_are_one_area():
    (shoulders,) = areas(SHOULDERS)
    assert area([shoulders]) == pytest.approx(12 * 2 + 2 * 2 * 2 + np.pi + 2 * np.pi * 3, rel=1e-3)


def test_its_pen_line_is_found():
    (shape,) = inspection(drawing(SHOULDERS))["shapes"]
    assert (shape["contours"], shape["blended"]) == (7, 1)
    (line,) = shape["pen_lines"]
    assert line["width"] == pytest.approx(2, abs=0.01)
    assert line["cap"] == "round"


steps = st.integers(3, 9), st.integers(0, 11)


@given(st.lists(st.tuples(*steps), min_size=1, max_size=5), st.sampled_from([0.5, 0.75, 1.0]))
def test_thick_lines_in_pieces_become_what_they_paint(walk, radius):
    turns = np.array([turn for _, turn in walk])
    assume((np.diff(turns) % 12 != 6).all())  # no way back on itself
    points = np.cumsum([0j, *(step * np.exp(2j * np.pi * turn / 12) for step, turn in walk)]).tolist()
    line = LineString([(z.real, z.imag) for z in points])
    assume(line.is_simple)
    contours = areas(in_pieces(points, radius))
    whole = line.buffer(radius, quad_segs=64)
    assert area(contours) == pytest.approx(whole.area, rel=2e-3)
    assert len(contours) < 2 + len(walk)


@pytest.mark.parametrize(
    ("path", "attributes"),
    [
        (SHOULDERS, EVENODD),  # where pieces overlap, they paint nothing
        (SHOULDERS, 'stroke="red"'),  # which shows the seams
        (RING, ""),
        (SQUARES, ""),
        ("M2 2H10V10H2Z M10 12H18V20H10Z", ""),  # which share no edge
        ("M2 2H10V10H2Z M6 6H14V14H6Z", ""),  # which overlap
    ],
)
def test_other_drawings_stay_as_they_are(path, attributes):
    given = drawing(path, attributes=attributes)
    assert with_areas(given) is given


def test_a_line_there_and_back_goes():
    plate, hole = areas("M2 2H22V22H2Z M6 18V6ZM6 6V18H18V6Z")
    assert len(plate.segments) == len(hole.segments) == 4
    lone = drawing("M6 18V6Z M9 18V6Z")
    assert with_areas(lone) is lone


def test_outlines_that_cross_themselves_stay():
    given = drawing("M2 2L10 2L2 10L10 10Z M12 2H22V22H12Z")
    assert with_areas(given) is given


def test_quadratic_curves_are_kept():
    (plate,) = areas("M0 4Q0 0 4 0H10V10H0ZM10 0H16Q20 0 20 4V10H10Z")
    assert area([plate]) == pytest.approx(200 - 2 * 8 / 3, rel=1e-3)
    assert len(plate.segments) == 6  # none is at a seam


def test_thin_rules_and_slits_are_kept():
    plates = "M0 0H500V500H0ZM500 0H900V500H500Z"
    found = areas(plates + "M0 700H1000V700.9H0ZM950 800h1v1h-1ZM100 100V400H100.9V100Z")
    assert sorted(len(contour.segments) for contour in found) == [4, 4, 4, 4]


def test_pieces_that_cross_each_other_often_stay():
    bars = [f"M{x} 0h1v100h-1ZM0 {x}h100v1h-100Z" for x in range(0, 100, 2)]
    given = drawing("".join(bars) + "M110 0h5v5h-5ZM115 0h5v5h-5Z")
    assert with_areas(given) is given


def test_numbers_are_those_of_areas():
    found = inspection(drawing(SHOULDERS, "M9 2h6v6h-6z"))["shapes"]
    assert [shape["first_contour"] for shape in found] == [0, 1]


def test_without_the_library_pieces_stay_pieces(monkeypatch):
    monkeypatch.setitem(sys.modules, "pathops", None)
    given = drawing(SHOULDERS)
    assert with_areas(given) is given
