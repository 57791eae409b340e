import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.pairing.growth import (
    MatchedPoints,
    growth_point_inside,
    growth_point_on,
    mean_value_weights,
)

# A crescent: the middle of its box is outside of it.
turn = np.linspace(0.6, 2 * np.pi - 0.6, 60)
CRESCENT = np.concatenate([10 * np.exp(1j * turn), 7 * np.exp(1j * turn[::-1])])
CIRCLE = 10 * np.exp(2j * np.pi * np.arange(120) / 120)


def test_mean_value_weights_give_back_the_point():
    square = np.array([0, 4, 4 + 4j, 4j])
    for point in (1 + 1j, 3.9 + 0.1j, 2 + 2j):
        weights = mean_value_weights(point, square)
        assert (weights > 0).all()
        assert weights.sum() == pytest.approx(1.0)
        assert complex(weights @ square) == pytest.approx(point)
    np.testing.assert_allclose(mean_value_weights(2 + 2j, square), 0.25)


@given(
    st.lists(st.complex_numbers(max_magnitude=10, allow_nan=False), min_size=3, max_size=12),
    st.complex_numbers(max_magnitude=10, allow_nan=False),
)
def test_mean_value_weights_are_finite_and_one_together(polygon, point):
    weights = mean_value_weights(point, np.array(polygon))
    assert np.isfinite(weights).all()
    assert weights.sum() == pytest.approx(1.0)


def test_a_hole_grows_from_where_it_is():
    hole = 5 + np.exp(2j * np.pi * np.arange(12) / 12)
    assert growth_point_inside(hole, MatchedPoints(CIRCLE, CIRCLE)) == pytest.approx(5.0)
    assert growth_point_inside(hole, MatchedPoints(CIRCLE, 3j + 0.5 * CIRCLE)) == pytest.approx(2.5 + 3j)


def test_a_hole_stays_inside_all_the_way():
    hole = np.exp(2j * np.pi * np.arange(12) / 12)
    matched = MatchedPoints(CIRCLE, CRESCENT)
    point = growth_point_inside(hole, matched)
    for t in np.linspace(0.05, 0.95, 19):
        growing = (1 - t) * point + t * hole
        assert winding_numbers(growing, (1 - t) * CRESCENT + t * CIRCLE).all(), t


def test_a_hole_keeps_away_from_its_neighbours():
    hole = np.exp(2j * np.pi * np.arange(12) / 12)
    other = MatchedPoints(hole + 5, 4 * hole)
    point = growth_point_inside(hole, MatchedPoints(CIRCLE, CIRCLE), [other])
    for t in TIMES:
        growing = (1 - t) * point + t * hole
        assert not winding_numbers(growing, (1 - t) * other.there + t * other.here).any(), t


TIMES = np.linspace(0.1, 0.9, 9)


def test_an_outline_grows_from_the_nearest_point_of_the_nearest_contour():
    near, far = MatchedPoints(CIRCLE + 30, CIRCLE * 1j), MatchedPoints(CIRCLE - 50, CIRCLE)
    number, point = growth_point_on(45 + CIRCLE / 10, [far, near])
    assert number == 1
    assert point == pytest.approx(10j)
