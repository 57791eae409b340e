"""Outlines smoothed until they are round."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.geometry.polygons import signed_area, winding_numbers
from shapeblend_cli.model import CubicPath
from shapeblend_cli.motion.levels import TIMES, smoothing_levels
from tests.support.contours import circle_contour
from tests.support.motions import outline
from tests.support.shapes import arm, bar, comb, random_polygon, spiral, star_polygon
from tests.support.strategies import rngs

BY_HAND = {
    "spiral": spiral(2.0),
    "tight spiral": spiral(3.5, steps=90),
    "comb": comb(5),
    "bar": bar(20),
    "arm": arm(30, 80, 150, 220),
    "triangle": np.array([0, 4, 1 + 3j]),
}


def alone(vertices, closed=True):
    """The levels of one polygon."""
    return [contours[0] for contours in smoothing_levels([outline(vertices, closed)])]


def roundness(vertices):
    """1 for a circle, less for all else: 4 pi area over the square of the length."""
    length = abs(np.diff(vertices, append=vertices[:1])).sum()
    return 4.0 * np.pi * abs(signed_area(vertices)) / length**2


def as_polygon(segments, pieces=8):
    return cubics.evaluate(segments[:, None, :], np.arange(pieces) / pieces).ravel()


@pytest.mark.parametrize("name", BY_HAND)
def test_outlines_by_hand_keep_their_area_without_crossing_and_become_round(name):
    levels = alone(BY_HAND[name])
    area = signed_area(BY_HAND[name])
    m = len(BY_HAND[name])
    straight = np.ones(len(levels[0]), bool)
    for segments in levels:
        assert path_crossings([CubicPath(segments, straight, True)]) == 0
    # The last is nearly the regular polygon of as many vertices in a circle of that area.
    assert roundness(levels[-1][:, 0]) > 0.99 * np.pi / m / np.tan(np.pi / m)
    share = cubics.signed_area(levels[-1]) / area
    assert share == pytest.approx(0.5 * m / np.pi * np.sin(2.0 * np.pi / m), rel=0.03)


@pytest.mark.parametrize("name", BY_HAND)
def test_at_every_level_the_area_is_kept(name):
    corners = outline(BY_HAND[name])
    as_curves = CubicPath(corners.segments, np.zeros(len(corners.segments), bool), True)
    for (level,) in smoothing_levels([as_curves]):
        assert cubics.signed_area(level) == pytest.approx(signed_area(BY_HAND[name]), rel=0.04)


@settings(max_examples=25)
@given(rngs, st.integers(20, 60), st.floats(0.0, 0.9))
def test_any_simple_outline_becomes_round(rng, m, roughness):
    z = star_polygon(rng, m, roughness)
    levels = alone(z)
    assert len(levels) == len(TIMES) + 1
    assert roundness(levels[-1][:, 0]) > 0.985
    assert signed_area(levels[-1][:, 0]) == pytest.approx(signed_area(z), rel=0.03)
    edges = abs(np.diff(levels[-1][:, 0]))
    assert edges.max() < 1.1 * edges.min()


def test_curves_stay_curves_through_the_same_area():
    circle = circle_contour(3 + 1j, 2.0)
    bent = circle.segments + 0.5 * (circle.segments - 3).real ** 2
    for segments in (circle.segments, bent):
        one = CubicPath(segments, np.zeros(8, bool), True)
        levels = [contours[0] for contours in smoothing_levels([one])]
        for level in levels:
            assert cubics.signed_area(level) == pytest.approx(cubics.signed_area(segments), rel=2e-3)
            np.testing.assert_allclose(level[:, 3], np.roll(level[:, 0], -1), atol=1e-12)
        assert roundness(as_polygon(levels[-1])) > 0.99


def test_a_circle_stays_where_it_is():
    circle = circle_contour(3 + 1j, 2.0)
    for (level,) in smoothing_levels([CubicPath(circle.segments, circle.straight, True)]):
        np.testing.assert_allclose(abs(as_polygon(level) - 3 - 1j), 2.0, rtol=2e-3)


@pytest.mark.parametrize("name", BY_HAND)
def test_lines_stay_lines_joined_end_to_end(name):
    for closed in (True, False):
        for level in alone(BY_HAND[name], closed):
            np.testing.assert_allclose(level, cubics.line(level[:, :1], level[:, 3:]), atol=1e-12)
            joined = np.roll(level[:, 0], -1) if closed else np.append(level[1:, 0], level[-1, 3])
            np.testing.assert_allclose(level[:, 3], joined, atol=1e-12)


def test_the_first_level_is_what_is_given(rng):
    z = random_polygon(rng, 9)
    given_outline = outline(z)
    ((first,), *_) = smoothing_levels([given_outline])
    np.testing.assert_array_equal(first, given_outline.segments)
    assert first is not given_outline.segments


def test_size_and_place_make_no_difference():
    z = arm(30, 80, 150)
    for one, other in zip(alone(z), alone(1e3 * np.exp(2j) * z + 5e3), strict=True):
        np.testing.assert_allclose(1e3 * np.exp(2j) * one + 5e3, other, atol=1e-5)


@pytest.mark.parametrize("hole", [2.0 + 1.4j, 0.6 + 0.5j])
def test_holes_and_what_is_in_them_stay_inside(hole):
    square = 0.2 * np.array([1, 1j, -1, -1j])
    contours = [arm(10, 60, 120, width=1.2), hole + square[::-1], hole + 0.4 * square]
    outside, hole_outline, _ = (np.asarray(z) for z in contours)
    assert winding_numbers(hole_outline, outside).all()
    for levels in smoothing_levels([outline(z) for z in contours]):
        around, inner, innermost = (level[:, 0] for level in levels)
        assert winding_numbers(inner, around).all()
        assert winding_numbers(innermost, inner).all()


def test_a_hole_far_out_in_an_arm_stays_inside():
    limb = arm(40, 100, 170, width=1.2)
    middle = 0.5 * (limb[2:6] + limb[6:10][::-1])
    hole = middle[2] + 0.15 * np.exp(2j * np.pi * np.arange(12) / 12)[::-1]
    assert winding_numbers(hole, limb).all()
    for around, inner in smoothing_levels([outline(limb), outline(hole)]):
        assert winding_numbers(inner[:, 0], around[:, 0]).all()


def test_outlines_beside_each_other_make_room():
    apart = [2.2 * k + star_polygon(np.random.default_rng(k), 14) for k in range(3)]
    levels = smoothing_levels([outline(z) for z in apart])
    straight = np.ones(14, bool)
    assert path_crossings([CubicPath(z, straight, True) for z in levels[-1]]) == 0
    for z, last in zip(apart, levels[-1], strict=True):
        assert abs(signed_area(last[:, 0])) < 0.5 * signed_area(z)


def test_contours_of_a_point_go_where_they_are_carried():
    shape = arm(40, 100, 170, width=1.2)
    start = 0.25 * (shape[3] + shape[4] + shape[7] + shape[8])
    levels = smoothing_levels([outline(shape), outline(np.full(4, start))])
    for around, point in levels:
        assert np.ptp(point) < 1e-12
        assert winding_numbers(point[:1, 0], around[:, 0]).all()
    assert abs(levels[-1][1][0, 0] - start) > 0.5
    for (point,) in smoothing_levels([outline(np.full(4, start))]):
        np.testing.assert_allclose(point, start)


def test_open_lines_keep_their_ends_and_tend_to_a_chord(rng):
    for z in (spiral(1.5)[:60], random_polygon(rng, 12)):
        levels = alone(z, closed=False)
        for level in levels:
            np.testing.assert_allclose([level[0, 0], level[-1, 3]], [z[0], z[-1]], atol=1e-12)
        along = (levels[-1][:, 0] - z[0]) / (z[-1] - z[0])
        assert abs(along.imag).max() < 0.02
        assert (np.diff(along.real) > 0.0).all()


NASTY = {
    "a bow tie": [0, 2, 2j, 2 + 2j],
    "a figure of eight": [0, 2 + 1j, 2 - 1j, 0, -2 + 1j, -2 - 1j],
    "an uneven eight": [0, 3 + 1j, 3 - 1j, 0, -2 + 1j, -2 - 1j],
    "a sliver": [0, 10, 10 + 1e-6j, 1e-6j],
    "a wider sliver": [0, 10, 10 + 0.02j, 0.02j],
    "there and back": [0, 10, 5],
    "a line": [0, 18],
    "a point": [1 + 1j, 1 + 1j, 1 + 1j],
    "nearly a point": [1, 1 + 1e-12, 1 + 1e-12j],
    "twice round": [0, 1, 1 + 1j, 1j] * 2,
    "coincident vertices": [0, 0, 0, 1, 1, 1j, 1j, 1j],
    "a pentagram": np.exp(4j * np.pi * np.arange(5) / 5),
}


@pytest.mark.parametrize("closed", [True, False], ids=["closed", "open"])
@pytest.mark.parametrize("name", NASTY)
def test_whatever_it_is_it_is_finite(name, closed):
    for level in alone(np.array(NASTY[name], complex), closed):
        assert np.isfinite(level).all()
        assert abs(level).max() <= 2.5 * abs(np.array(NASTY[name])).max()


@settings(max_examples=30)
@given(rngs, st.integers(2, 12), st.booleans(), st.booleans())
def test_any_points_give_something_finite(rng, m, closed, on_a_grid):
    z = random_polygon(rng, max(m, 3))
    if on_a_grid:
        z = np.round(2.0 * z)
    assert all(np.isfinite(level).all() for level in alone(z, closed))
