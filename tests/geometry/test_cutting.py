import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.geometry.cubics import signed_area
from shapeblend_cli.geometry.cutting import left_of, with_vertices
from shapeblend_cli.geometry.flatten import flatten
from tests.support.drawings import LEAF, SQUARES, contours_of

SQUARE, DISC, LEAF = (
    contours_of(d)[0].contour for d in (SQUARES, "M12 2A10 10 0 1 0 12 22A10 10 0 1 0 12 2Z", LEAF)
)
places = st.floats(0, 24)


@pytest.mark.parametrize("contour", [SQUARE, DISC, LEAF])
@given(x=places, y=places, angle=st.floats(0, 6.28))
def test_both_sides_of_a_line_make_up_the_whole(contour, x, y, angle):
    start, way = complex(x, y), np.exp(1j * angle)
    sides = left_of(contour, start, start + way), left_of(contour, start + way, start)
    found = [0.0 if side is None else signed_area(side.segments) for side in sides]
    assert sum(found) == pytest.approx(signed_area(contour.segments), abs=1e-6)
    for side, turn in zip(sides, (1.0, -1.0), strict=True):
        if side is not None:
            assert np.abs(side.segments[:, 3] - np.roll(side.segments[:, 0], -1)).max() < 1e-6
            assert (turn * ((side.segments[:, [0, 3]] - start) * way.conjugate()).imag).min() > -1e-6


def test_a_part_of_curves_keeps_them():
    half = left_of(DISC, 12 + 0j, 12 + 1j)
    points = flatten(half, 100).vertices
    assert np.abs(np.abs(points[points.real < 11.99] - (12 + 12j)) - 10).max() < 0.01


def test_more_vertices_lie_on_the_contour_and_change_no_other():
    polygon = flatten(DISC, 24)
    finer = with_vertices(polygon, np.array([23.5, 3.25]))
    assert len(finer.vertices) == len(polygon.vertices) + 2
    assert set(polygon.vertices) < set(finer.vertices)
    assert finer.vertices[4] == 0.75 * polygon.vertices[3] + 0.25 * polygon.vertices[4]
    assert (np.diff(finer.segment + finer.parameter) > 0).all()
