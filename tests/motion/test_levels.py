"""Outlines smoothed until they are round."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.geometry.polygons import signed_area, winding_numbers
from shapeblend_cli.model import CubicPath
from shapeblend_cli.motion.levels import TIMES, smoothing_levels
from tests.support.contours import circle_contour, polygon_contour, polyline
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


def levels_of(*outlines, closed=True):
    """The levels of polygons, as paths."""
    straight = [np.ones(len(z) if closed else len(z) - 1, bool) for z in outlines]
    return [
        [CubicPath(z, lines, closed) for z, lines in zip(level, straight, strict=True)]
        for level in smoothing_levels([polygon_contour(z, closed) for z in outlines])
    ]


def levels_alone(outline, closed=True):
    """The levels of one polygon: control points."""
    return [path.segments for (path,) in levels_of(outline, closed=closed)]


def as_curves(segments):
    return CubicPath(segments, np.zeros(len(segments), bool), True)


def roundness(vertices):
    """1 for a circle, less for all else: 4 pi area over the square of the length."""
    length = abs(np.diff(vertices, append=vertices[:1])).sum()
    return 4.0 * np.pi * abs(signed_area(vertices)) / length**2


@pytest.mark.parametrize("z", BY_HAND.values(), ids=BY_HAND)
def test_outlines_by_hand_keep_their_area_without_crossing_and_become_round(z):
    levels = levels_of(z)
    assert [path_crossings(paths) for paths in levels] == [0] * len(levels)
    # The last is nearly the regular polygon of as many vertices in a circle of that area.
    last, m = levels[-1][0].segments, len(z)
    assert roundness(last[:, 0]) > 0.99 * np.pi / m / np.tan(np.pi / m)
    share = cubics.signed_area(last) / signed_area(z)
    assert share == pytest.approx(0.5 * m / np.pi * np.sin(2.0 * np.pi / m), rel=0.03)


@pytest.mark.parametrize("z", BY_HAND.values(), ids=BY_HAND)
def test_at_every_level_the_area_is_kept(z):
    for (level,) in smoothing_levels([as_curves(polygon_contour(z).segments)]):
        assert cubics.signed_area(level) == pytest.approx(signed_area(z), rel=0.04)


@settings(max_examples=25)
@given(rngs, st.integers(20, 60), st.floats(0.0, 0.9))
def test_any_simple_outline_becomes_round(rng, m, roughness):
    z = star_polygon(rng, m, roughness)
    levels = levels_alone(z)
    assert len(levels) == len(TIMES) + 1
    assert roundness(levels[-1][:, 0]) > 0.985
    assert signed_area(levels[-1][:, 0]) == pytest.approx(signed_area(z), rel=0.03)
    edges = abs(np.diff(levels[-1][:, 0]))
    assert edges.max() < 1.1 * edges.min()


def test_curves_stay_curves_through_the_same_area():
    circle = circle_contour(3 + 1j, 2.0).segments
    for segments in (circle, circle + 0.5 * (circle - 3).real ** 2):
        for (level,) in smoothing_levels([as_curves(segments)]):
            assert cubics.signed_area(level) == pytest.approx(cubics.signed_area(segments), rel=2e-3)
            np.testing.assert_allclose(level[:, 3], np.roll(level[:, 0], -1), atol=1e-12)
        assert roundness(polyline(as_curves(level), 8)) > 0.99


def test_a_circle_stays_where_it_is():
    for (level,) in smoothing_levels([as_curves(circle_contour(3 + 1j, 2.0).segments)]):
        np.testing.assert_allclose(abs(polyline(as_curves(level), 8) - 3 - 1j), 2.0, rtol=2e-3)


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("z", BY_HAND.values(), ids=BY_HAND)
def test_lines_stay_lines_joined_end_to_end(z, closed):
    for level in levels_alone(z, closed):
        np.testing.assert_allclose(level, cubics.line(level[:, :1], level[:, 3:]), atol=1e-12)
        joined = np.roll(level[:, 0], -1) if closed else np.append(level[1:, 0], level[-1, 3])
        np.testing.assert_allclose(level[:, 3], joined, atol=1e-12)


def test_the_first_level_is_what_is_given(rng):
    path = polygon_contour(random_polygon(rng, 9))
    ((first,), *_) = smoothing_levels([path])
    np.testing.assert_array_equal(first, path.segments)
    assert first is not path.segments


def test_size_and_place_make_no_difference():
    z, factor = arm(30, 80, 150), 1e3 * np.exp(2j)
    for one, other in zip(levels_alone(z), levels_alone(factor * z + 5e3), strict=True):
        np.testing.assert_allclose(factor * one + 5e3, other, atol=1e-5)


LIMB = arm(40, 100, 170, width=1.2)
FAR_OUT = 0.5 * (LIMB[4] + LIMB[7]) + 0.15 * np.exp(2j * np.pi * np.arange(12) / 12)[::-1]
ROOMY, SMALL = arm(10, 60, 120, width=1.2), 0.2 * np.array([1, 1j, -1, -1j])


@pytest.mark.parametrize(
    "nested",
    [
        (ROOMY, 2.0 + 1.4j + SMALL[::-1], 2.0 + 1.4j + 0.4 * SMALL),
        (ROOMY, 0.6 + 0.5j + SMALL[::-1], 0.6 + 0.5j + 0.4 * SMALL),
        (LIMB, FAR_OUT),
    ],
)
def test_holes_and_what_is_in_them_stay_inside(nested):
    assert winding_numbers(nested[1], nested[0]).all()
    for paths in levels_of(*nested):
        vertices = [path.segments[:, 0] for path in paths]
        for outside, inside in pairwise(vertices):
            assert winding_numbers(inside, outside).all()


def test_outlines_beside_each_other_make_room():
    apart = [2.2 * k + star_polygon(np.random.default_rng(k), 14) for k in range(3)]
    *_, last = levels_of(*apart)
    assert path_crossings(last) == 0
    for z, path in zip(apart, last, strict=True):
        assert abs(signed_area(path.segments[:, 0])) < 0.5 * signed_area(z)


def test_contours_of_a_point_go_where_they_are_carried():
    start = 0.25 * (LIMB[3] + LIMB[4] + LIMB[7] + LIMB[8])
    levels = smoothing_levels([polygon_contour(LIMB), polygon_contour(np.full(4, start))])
    for around, point in levels:
        assert np.ptp(point) < 1e-12
        assert winding_numbers(point[:1, 0], around[:, 0]).all()
    assert abs(levels[-1][1][0, 0] - start) > 0.5
    for point in levels_alone(np.full(4, start)):
        np.testing.assert_allclose(point, start)


def test_open_lines_keep_their_ends_and_tend_to_a_chord(rng):
    for z in (spiral(1.5)[:60], random_polygon(rng, 12)):
        levels = levels_alone(z, closed=False)
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
    for level in levels_alone(np.array(NASTY[name], complex), closed):
        assert np.isfinite(level).all()
        assert abs(level).max() <= 2.5 * abs(np.array(NASTY[name])).max()


@settings(max_examples=30)
@given(rngs, st.integers(2, 12), st.booleans(), st.booleans())
def test_any_points_give_something_finite(rng, m, closed, on_a_grid):
    z = random_polygon(rng, max(m, 3))
    if on_a_grid:
        z = np.round(2.0 * z)
    assert all(np.isfinite(level).all() for level in levels_alone(z, closed))
