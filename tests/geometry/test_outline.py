"""Area, direction, crossings."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString
from shapely import Polygon as ShapelyPolygon

from shapeblend_cli.geometry import cubics, outline
from shapeblend_cli.geometry.flatten import flatten
from tests.support.contours import circle_contour, polygon_contour
from tests.support.shapes import random_polygon, star_polygon


def crossings_one_by_one(z, closed):
    """Every pair of edges, by shapely."""
    ends = np.roll(z, -1) if closed else z[1:]
    edges = [LineString([(p.real, p.imag), (q.real, q.imag)]) for p, q in zip(z, ends, strict=False)]
    return sum(edges[p].crosses(edges[q]) for p in range(len(edges)) for q in range(p))


@given(st.integers(0, 10**6), st.integers(3, 40), st.booleans())
def test_crossings_agree_with_shapely(seed, m, closed):
    z = random_polygon(np.random.default_rng(seed), m)
    assert outline.self_crossings(z, closed) == crossings_one_by_one(z, closed)


@given(st.integers(0, 10**6), st.integers(3, 60))
def test_a_simple_polygon_has_none(seed, m):
    z = star_polygon(np.random.default_rng(seed), m)
    if ShapelyPolygon(np.c_[z.real, z.imag]).is_valid:
        assert outline.self_crossings(z, True) == 0


@pytest.mark.parametrize(
    ("points", "count"),
    [
        ([0, 2, 2j, 2 + 2j], 1),  # a bow tie
        ([0, 4, 4 + 4j, 2, 4j], 0),  # a vertex touches an edge from inside
        ([0, 4, 2, 2 + 3j], 0),  # a run there and back
        ([0, 4, 4, 4 + 4j, 4j, 4j], 0),  # coincident vertices
        ([0.1, 0.3, 0.3 + 0.1j, 0.1 + 0.1j, 0.1, 0.3], 0),  # twice round in part
        (np.exp(4j * np.pi * np.arange(5) / 5), 5),  # a pentagram
    ],
)
def test_touching_is_not_crossing(points, count):
    assert outline.self_crossings(np.asarray(points, complex), True) == count


@pytest.mark.parametrize("closed", [True, False])
def test_what_is_reversed_stays_on_its_contour(closed):
    corners = [0, 3, 3 + 2j, 1 + 3j]
    for contour in (polygon_contour(corners, closed=closed), *([circle_contour()] if closed else [])):
        polygon = flatten(contour, 30)
        back = outline.reversed_polygon(polygon, len(contour.segments))
        there = outline.reversed_contour(contour)
        assert back.vertices[0] == polygon.vertices[0 if closed else -1]
        assert outline.signed_area(back.vertices) == pytest.approx(-outline.signed_area(polygon.vertices))
        on_it = cubics.evaluate(there.segments[back.segment], back.parameter)
        np.testing.assert_allclose(on_it, back.vertices, atol=1e-12)
        steps = np.diff(back.segment + back.parameter)
        assert (steps > 0).all()
        again = outline.reversed_polygon(back, len(contour.segments))
        np.testing.assert_array_equal(again.vertices, polygon.vertices)
        np.testing.assert_array_equal(again.segment, polygon.segment)
        np.testing.assert_allclose(again.parameter, polygon.parameter, atol=1e-15)


def test_winding_numbers():
    square = np.array([0, 4, 4 + 4j, 4j])
    points = np.array([2 + 2j, 5 + 2j, -1 + 2j, 2 - 1j, 2 + 5j, 0.001 + 0.001j])
    assert outline.winding_numbers(points, square).tolist() == [1, 0, 0, 0, 0, 1]
    assert outline.winding_numbers(points, square[::-1]).tolist() == [-1, 0, 0, 0, 0, -1]
    assert outline.winding_numbers(points[:2], np.concatenate([square, square])).tolist() == [2, 0]


def test_outlines_cross_each_other():
    a, b = (flatten(polygon_contour(np.array([0, 4, 4 + 4j, 4j]) + shift), 0) for shift in (0, 2 + 2j))
    assert outline.all_crossings([a]) == outline.all_crossings([a, a]) == 0
    assert outline.all_crossings([a, b]) == 2
