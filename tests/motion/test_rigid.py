"""A shape and the same shape rotated: every in-between is that shape."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Contour
from shapeblend_cli.motion.alignment import PointPairs, align, residual
from shapeblend_cli.svg.reading.read import read
from tests.support import drawings
from tests.support.contours import drawing, polygon_contour
from tests.support.motions import TIMES, moving_polygons, pair_of, rigidly
from tests.support.shapes import regular_polygon, star_polygon, star_with, unit
from tests.support.strategies import rngs

SLIGHT = 4e-3
"""Curves may be flattened to a vertex more or less when they are rotated."""


def placed(one, factor, shift=0j, start=0):
    """A drawing rotated and scaled by a complex factor, and shifted; its outlines begin elsewhere."""

    def moved(contour):
        roll = -start if contour.closed else 0
        segments = np.roll(factor * contour.segments + shift, roll, axis=0)
        return Contour(segments, np.roll(contour.straight, roll), contour.closed)

    shapes = tuple(replace(shape, contours=tuple(map(moved, shape.contours))) for shape in one.shapes)
    return one._replace(shapes=shapes, viewbox=None)


def points_at(pair, t):
    return np.concatenate([path.segments.ravel() for shape in pair.shapes for path in paths_at(shape, t)])


def assert_only_moves(pair, degrees, scale=1.0):
    """Every in-between is the drawing at the start, rotated and scaled by its share."""
    start = points_at(pair, 0.0)
    for t in TIMES:
        points = PointPairs(start, points_at(pair, t), np.full(len(start), 1.0 / len(start)))
        found = align(points)
        assert residual(points, found) < SLIGHT
        assert found.scale == pytest.approx(1.0 - t + t * scale, rel=2.0 * SLIGHT)
        off = np.degrees(found.rotation) - degrees * t
        if abs(degrees) == 180:  # either way round
            off = min(off, -np.degrees(found.rotation) - degrees * t, key=abs)
        assert abs(off) < 0.3


def subject(name, samples):
    if name == "star":
        rng = np.random.default_rng(11)
        hole = 0.35 + 0.25j + 0.15 * star_with(rng, 9)
        return drawing(polygon_contour(star_with(rng, 20)), polygon_contour(hole[::-1]))
    if name == "separate":
        return drawings.drawing("M2 2H10V4H4V12H2Z", "M3 14L8 22L2 20Z", "M15 4H22V20Z")
    if name == "line":
        return drawings.drawing('<path d="M2 2H20C24 8 14 10 12 22" fill="none" stroke="#000"/>')
    return read(str(samples / f"{name}.svg"))


@pytest.mark.parametrize(("motion", "degrees"), [("auto", 10), ("auto", -90), ("auto", 180), ("rigid", -90)])
@pytest.mark.parametrize("name", ["e", "cow", "dancer-1", "star", "separate", "line"])
def test_a_drawing_rotated_scaled_and_shifted_only_moves(samples, name, degrees, motion):
    a = subject(name, samples)
    pair = pair_of(a, placed(a, 1.5 * unit(degrees), 40 - 15j, start=3), motion=motion)
    assert {shape.motion.name for shape in pair.shapes} == {"rigid"}
    assert_only_moves(pair, degrees, 1.5)


@pytest.mark.parametrize("name", ["e", "star"])
def test_polygons_only_move_too(samples, name):
    a = subject(name, samples)
    assert_only_moves(pair_of(a, placed(a, unit(120)), curves=False), 120)


@settings(max_examples=10, phases=[Phase.explicit, Phase.generate])
@given(rngs, st.integers(8, 20), st.floats(5.0, 175.0), st.floats(0.2, 5.0), st.integers(0, 19))
def test_any_star_rotated_only_moves(rng, m, degrees, scale, start):
    a = drawing(polygon_contour(star_with(rng, m)))
    assert_only_moves(pair_of(a, placed(a, scale * unit(degrees), 3.0, start % m)), degrees, scale)


@pytest.mark.parametrize(("corners", "degrees"), [(3, 120), (4, 90), (6, 60), (12, 30)])
def test_a_regular_polygon_rotated_onto_itself_stays(corners, degrees):
    contour = polygon_contour(regular_polygon(corners, 0.3))
    middle = contour.segments[:, 0].mean()
    a = drawing(contour)
    pair = pair_of(a, placed(a, unit(degrees), middle - unit(degrees) * middle))
    assert [shape.motion for shape in pair.shapes] == [None]
    for t in TIMES:
        np.testing.assert_allclose(points_at(pair, t), points_at(pair, 0.0), atol=1e-9)


def test_a_square_rotated_by_50_degrees_rotates_back_by_40():
    square = drawing(polygon_contour([0, 4, 4 + 4j, 4j]))
    assert_only_moves(pair_of(square, placed(square, unit(50), start=3)), -40)


def test_what_is_not_moved_stays():
    # Two shapes of which one is rotated and the other stays: they have no similarity in common.
    base = drawings.drawing("M2 2H10V4H4V12H2Z", "M16 16L22 18L18 22Z")
    both = base._replace(shapes=(placed(base, 1j, 24).shapes[0], base.shapes[1]))
    _, still = pair_of(base, both).shapes
    assert still.motion is None
    half_way, start = (paths_at(still, t)[0].segments for t in (0.5, 0.0))
    np.testing.assert_allclose(half_way, start, atol=1e-9)


@given(rngs, st.integers(3, 20))
def test_between_unlike_outlines_it_starts_and_ends_as_they_are(rng, m):
    shape = rigidly(moving_polygons((star_polygon(rng, m), 3.0 * star_polygon(rng, m) + 2j)))
    for t, side in ((0.0, "start"), (1.0, "end")):
        drawn = getattr(shape.contours[0], side).segments
        near = paths_at(shape, abs(t - 1e-7))[0].segments
        np.testing.assert_array_equal(paths_at(shape, t)[0].segments, drawn)
        np.testing.assert_allclose(near, drawn, atol=1e-5)


@given(rngs, st.integers(3, 20))
def test_backwards_in_time_it_is_the_same(rng, m):
    a, b = star_polygon(rng, m), 3.0 * star_polygon(rng, m)
    there, back = (rigidly(moving_polygons(pair)) for pair in ((a, b), (b, a)))
    for t in TIMES:
        np.testing.assert_allclose(
            paths_at(there, t)[0].segments, paths_at(back, 1.0 - t)[0].segments, atol=1e-9
        )
