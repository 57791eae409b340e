"""Area, orientation, and winding numbers."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.polygons import (
    mean_value_weights,
    reverse_contour,
    reverse_polygon,
    signed_area,
    winding_numbers,
)
from tests.support.contours import circle_contour, polygon_contour


@pytest.mark.parametrize("closed", [True, False])
def test_what_is_reversed_stays_on_its_contour(closed):
    corners = [0, 3, 3 + 2j, 1 + 3j]
    for contour in (polygon_contour(corners, closed=closed), *([circle_contour()] if closed else [])):
        polygon = flatten(contour, 30)
        back = reverse_polygon(polygon, len(contour.segments))
        there = reverse_contour(contour)
        assert back.vertices[0] == polygon.vertices[0 if closed else -1]
        assert signed_area(back.vertices) == pytest.approx(-signed_area(polygon.vertices))
        on_it = cubics.evaluate(there.segments[back.segment], back.parameter)
        np.testing.assert_allclose(on_it, back.vertices, atol=1e-12)
        assert (np.diff(back.segment + back.parameter) > 0).all()
        again = reverse_polygon(back, len(contour.segments))
        np.testing.assert_array_equal(again.vertices, polygon.vertices)
        np.testing.assert_array_equal(again.segment, polygon.segment)
        np.testing.assert_allclose(again.parameter, polygon.parameter, atol=1e-15)


def test_winding_numbers():
    square = np.array([0, 4, 4 + 4j, 4j])
    points = np.array([2 + 2j, 5 + 2j, -1 + 2j, 2 - 1j, 2 + 5j, 0.001 + 0.001j])
    assert winding_numbers(points, square).tolist() == [1, 0, 0, 0, 0, 1]
    assert winding_numbers(points, square[::-1]).tolist() == [-1, 0, 0, 0, 0, -1]
    assert winding_numbers(points[:2], np.concatenate([square, square])).tolist() == [2, 0]


def test_mean_value_weights_give_back_the_point():
    square = np.array([0, 4, 4 + 4j, 4j])
    for point in (1 + 1j, 3.9 + 0.1j, 2 + 2j):
        weights = mean_value_weights(point, square)
        assert (weights > 0).all()
        assert weights.sum() == pytest.approx(1.0)
        assert complex(weights @ square) == pytest.approx(point)
    np.testing.assert_allclose(mean_value_weights(2 + 2j, square), 0.25)


points = st.complex_numbers(max_magnitude=10, allow_nan=False)


@given(st.lists(points, min_size=3, max_size=12), points)
def test_mean_value_weights_are_finite_and_of_sum_1(vertices, point):
    weights = mean_value_weights(point, np.array(vertices))
    assert np.isfinite(weights).all()
    assert weights.sum() == pytest.approx(1.0)
