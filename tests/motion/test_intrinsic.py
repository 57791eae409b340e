"""Motion by lengths and angles."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.motion.alignment import align, point_pairs
from shapeblend_cli.motion.intrinsic import intrinsic
from shapeblend_cli.motion.rigid import Rigid
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read
from tests.support.motions import TIMES, moving_curves, moving_polygon, moving_shape, similarity_of
from tests.support.shapes import random_polygon, star_polygon, unit, with_repeats
from tests.support.strategies import rngs

counts = st.integers(3, 24)
rotations = st.floats(-3.0, 3.0)
scales = st.floats(0.1, 10.0)
shifts = st.complex_numbers(max_magnitude=20)


def motion(*contours):
    return intrinsic(contours, similarity_of(moving_shape(*contours)))


def at(contour, t):
    return motion(contour).segments([contour], t)[0]


def smooth_contour(rng, m):
    """Cubics through the vertices of a star, in one direction before and after each."""
    nodes = star_polygon(rng, m)
    ends = np.roll(nodes, -1)
    tangents = ends - np.roll(nodes, 1)
    tangents /= abs(tangents)
    after, before = rng.uniform(0.1, 0.4, (2, m)) * abs(ends - nodes)
    return np.stack([nodes, nodes + after * tangents, ends - before * np.roll(tangents, -1), ends], axis=1)


def moving_samples(samples, a, b, given_settings=None):
    """The shapes between two samples, in intrinsic motion."""
    drawings = [read(str(samples / f"{name}.svg")) for name in (a, b)]
    (pair,), _ = match_all(drawings, given_settings or Settings())
    for shape in pair.shapes:
        alignment = align(point_pairs(shape.contours))
        yield shape._replace(motion=intrinsic(shape.contours, alignment))


@pytest.mark.parametrize(
    "names",
    [("dancer-1", "dancer-2"), ("cow", "deer"), ("bird-1", "bird-2"), ("e", "f"), ("triangle", "square")],
)
def test_samples_start_and_end_as_drawn_and_stay_closed(samples, names):
    for shape in moving_samples(samples, *names):
        assert None not in shape.motion.polygons
        for t, side in ((1e-6, "start"), (1.0 - 1e-6, "end")):
            for contour, path in zip(shape.contours, paths_at(shape, t), strict=True):
                z = getattr(contour, side).segments
                assert abs(path.segments - z).max() < 1e-4 * abs(z - z.mean()).max()
        for path in (path for t in TIMES for path in paths_at(shape, t)):
            assert np.array_equal(np.roll(path.segments[:, 3], 1), path.segments[:, 0])
            lines = path.segments[path.straight]
            np.testing.assert_allclose(lines, cubics.line(lines[:, :1], lines[:, 3:]), atol=1e-9)


@given(rngs, counts, rotations, scales, shifts)
def test_a_shape_and_the_same_rotated_scaled_and_moved_have_it_between_them(rng, m, rotation, scale, shift):
    a = smooth_contour(rng, m)
    b = scale * np.exp(1j * rotation) * a + shift
    contour = moving_curves(a, b)
    centre = similarity_of(moving_shape(contour)).centre_a
    for t in TIMES:
        scaled = (1.0 - t + t * scale) * np.exp(1j * rotation * t) * (a - centre)
        expected = scaled + (1.0 - t) * centre + t * (scale * np.exp(1j * rotation) * centre + shift)
        np.testing.assert_allclose(at(contour, t), expected, atol=1e-9 * (1.0 + abs(shift) + scale))


@given(rngs, st.integers(4, 16), st.sampled_from(["plain", "handles", "points"]))
def test_what_is_smooth_in_both_drawings_stays_smooth(rng, m, kind):
    a, b = smooth_contour(rng, m), smooth_contour(rng, m)
    if kind == "handles":  # some without length: the next control point gives the tangent
        for segments in (a, b):
            short = rng.random(m) < 0.3
            segments[short, 2] = segments[short, 0] + 2.0 * (segments[short, 1] - segments[short, 0])
            segments[short, 1] = segments[short, 0]
        joints = smooth_joints(a) & smooth_joints(b)
    elif kind == "points":  # each drawing waits at a node while the other goes on
        a = np.insert(a, 1, a[0, 3], axis=0)
        b = np.insert(b, 3, b[2, 3], axis=0)
        joints = np.ones(m + 1, bool)
    else:
        joints = np.ones(m, bool)
    contour = moving_curves(a, b)
    assert motion(contour).polygons[0] is not None
    for t in TIMES:
        assert smooth_joints(at(contour, t))[joints].all()


def smooth_joints(segments):
    """At the start of which segments a chain goes on in its direction."""
    starts, ends = cubics.directions(segments)
    return abs(starts - np.roll(ends, 1)) < 1e-5


def with_arm(angle):
    """A body three wide and five high; at a shoulder an arm of length six, which swings."""
    shoulder, reach = 3 + 3j, np.array([1, 2.5, 4.5, 6])
    out, back = shoulder + (reach - 0.15j) * unit(angle), shoulder + (reach[::-1] + 0.15j) * unit(angle)
    return np.array([0, 3, shoulder - 0.4j, *out, *back, shoulder + 0.4j, 3 + 5j, 5j])


def reach_of_arm(vertices):
    return abs(vertices[[6, 7]].mean() - vertices[[2, 11]].mean())


def test_an_arm_that_swings_keeps_its_length_and_on_straight_paths_collapses():
    a, b = with_arm(-75), with_arm(75)
    assert reach_of_arm(a) == pytest.approx(reach_of_arm(b))
    assert reach_of_arm(0.5 * (a + b)) < 0.3 * reach_of_arm(a)
    for t in TIMES:
        vertices = at(moving_polygon(a, b), t)[:, 0]
        assert reach_of_arm(vertices) == pytest.approx(reach_of_arm(a), rel=0.02)
        np.testing.assert_allclose(abs(vertices[4:7] - vertices[[9, 8, 7]]), 0.3, rtol=0.1)
        direction = np.degrees(np.angle(vertices[6] - vertices[3]))
        assert direction == pytest.approx(-75 + 150 * t, abs=3.0)
        body = [0, 1, 12, 13]  # hardly moves
        assert abs(vertices[body] - with_arm(0)[body]).max() < 0.35


def test_figure_28_the_dancers_arm_does_not_collapse(samples):
    (shape,) = moving_samples(samples, "dancer-1", "dancer-2", Settings(preset="fig28", band="none"))
    (contour,) = shape.contours
    nodes = contour.start.segments[:, 0]
    neck, armpit = abs(nodes - (207 + 98j)).argmin(), abs(nodes - (222 + 158j)).argmin()

    def reach(shape, t):
        """From the neck to the end of the arm."""
        arm = paths_at(shape, t)[0].segments[neck:armpit, 0]
        return abs(arm - arm[0]).max()

    ends = reach(shape, 0.0), reach(shape, 1.0)
    assert min(reach(shape._replace(motion=None), t) for t in TIMES) < 0.8 * min(ends)
    for t in TIMES:
        assert 0.98 * min(ends) < reach(shape, t) < 1.02 * max(ends)


@settings(max_examples=20)
@given(rngs, counts, st.integers(0, 8))
def test_any_outlines_with_vertices_that_wait_move_continuously(rng, m, more):
    a, b = (with_repeats(rng, star_polygon(rng, m), more) for _ in range(2))
    contour = moving_polygon(a, b)
    moved = motion(contour)
    assert moved.polygons[0] is not None
    between_ends = (moved.segments([contour], t)[0] for t in np.linspace(0.0, 1.0, 401)[1:-1])
    every = np.array([contour.start.segments, *between_ends, contour.end.segments])
    assert np.isfinite(every).all()
    assert abs(np.diff(every, axis=0)).max() < 0.1


@given(rngs, counts, st.booleans(), st.integers(0, 4))
def test_nothing_is_not_a_number_and_the_ends_are_reached(rng, m, closed, more):
    # Any points, so outlines cross themselves and go round anyhow.
    a, b = (with_repeats(rng, random_polygon(rng, m), more) for _ in range(2))
    contour = moving_polygon(a, b, closed)
    for t in (1e-9, *TIMES, 1 - 1e-9):
        assert np.isfinite(at(contour, t)).all()
    assert abs(at(contour, 1e-7) - contour.start.segments).max() < 1e-4
    assert abs(at(contour, 1 - 1e-7) - contour.end.segments).max() < 1e-4


@given(rngs, counts, rotations, scales, shifts)
def test_moving_scaling_and_rotating_both_drawings_does_so_to_what_is_between(rng, m, rotation, scale, shift):
    a, b = smooth_contour(rng, m), smooth_contour(rng, m)
    factor = scale * np.exp(1j * rotation)
    for t in TIMES:
        expected = factor * at(moving_curves(a, b), t) + shift
        found = at(moving_curves(factor * a + shift, factor * b + shift), t)
        np.testing.assert_allclose(found, expected, atol=1e-6 * scale)


@given(rngs, counts)
def test_backwards_in_time_it_is_the_same(rng, m):
    a, b = smooth_contour(rng, m), 3.0 * smooth_contour(rng, m)
    for t in TIMES:
        np.testing.assert_allclose(at(moving_curves(b, a), 1.0 - t), at(moving_curves(a, b), t), atol=1e-6)


def test_it_rotates_the_short_way(rng):
    a = star_polygon(rng, 12) - 0.5 - 0.5j
    a[0] *= 2.0  # so that the angle is plain
    for angle in np.radians([-170.0, 170.0]):
        b = a * np.exp(1j * angle) * (1.0 + 0.1 * rng.random(12))
        vertices = at(moving_polygon(a, b), 0.5)[:, 0]
        off = np.vdot(a * np.exp(0.5j * angle), vertices - vertices.mean())
        assert abs(np.angle(off)) < 0.2


def test_an_open_line_bends_and_keeps_its_length():
    a = np.arange(7.0)
    b = np.append(0.0, np.cumsum(np.exp(1j * np.radians(np.arange(6) * 50.0))))
    contour = moving_polygon(a, b, closed=False)
    for t in TIMES:
        np.testing.assert_allclose(abs(np.diff(at(contour, t), axis=1)), 1 / 3, rtol=0.05)
        turns = np.diff(np.angle(at(contour, t)[:, 3] - at(contour, t)[:, 0]))
        np.testing.assert_allclose(np.degrees(turns) % 360.0, 50.0 * t)


def test_what_has_no_turning_of_its_own_moves_as_rigid_has_it():
    circle = np.exp(2j * np.pi * np.arange(12) / 12)
    eight = np.sin(4 * np.pi * np.arange(12) / 12) + 1j * np.sin(2 * np.pi * np.arange(12) / 12)
    # One that has, a crossed one, one that grows, and one that becomes a point.
    pairs = (circle, 2j * circle), (circle, eight), (0.5, circle), (circle, np.full(12, 0.5))
    contours = [moving_polygon(*pair) for pair in pairs]
    moved = intrinsic(contours, similarity_of(moving_shape(contours[0])))
    assert moved.name == "intrinsic"
    assert [polygon is None for polygon in moved.polygons] == [False, True, True, True]
    expected = Rigid((moved.alignment,) * len(contours)).segments(contours, 0.3)
    for one, other in zip(moved.segments(contours, 0.3), expected, strict=True):
        np.testing.assert_allclose(one, other, atol=1e-12)  # the first because it only rotates and grows


def test_a_needle_without_width_turns_at_its_tip_the_right_way():
    def spiked(tip, half_width):
        return np.array([0, 4, 4 + 4j, 2 + half_width + 4j, tip, 2 - half_width + 4j, 4j])

    for tip, sign in product((2 + 8j, 2 + 1j), (1, -1)):  # outwards and inwards
        for factor in np.exp(1j * np.linspace(0.0, 6.0, 25)):
            z, w = ((factor * spiked(tip, half_width))[::sign] for half_width in (0.0, 0.5))
            vertices = at(moving_polygon(z, w), 0.5)[:, 0]
            areas = sorted(sign * signed_area(points) for points in (z, w))
            assert areas[0] < sign * signed_area(vertices) < areas[1]


def test_a_needle_that_grows_out_of_a_point_is_one_all_the_time():
    a = np.array([0, 4, 4 + 4j, 2 + 4j, 2 + 4j, 2 + 4j, 4j])
    b = np.array([0, 4, 4 + 4j, 2.2 + 4j, 2 + 8j, 1.8 + 4j, 4j])
    for t in TIMES:
        z = at(moving_polygon(a, b), t)[:, 0]
        assert z[4].imag == pytest.approx(4 + 4 * t, abs=0.4)
        assert abs(z[5] - z[3]) == pytest.approx(0.4 * t, abs=0.2)
        assert abs(z[[0, 1, 2, 6]] - a[[0, 1, 2, 6]]).max() < 0.4


def test_contours_of_a_shape_keep_together(rng):
    ring = star_polygon(rng, 14, roughness=0.3) - 0.5 - 0.5j
    outer, hole, inner = ring, 0.5 * ring[::-1], 0.2 * ring
    contours = [moving_polygon(z, 4.0 * np.exp(2j) * z + 3.0) for z in (outer, hole, inner)]
    moved = motion(*contours)
    start = np.concatenate([c.start.segments for c in contours]) - moved.alignment.centre_a
    for t in TIMES:
        found = np.concatenate(moved.segments(contours, t))
        np.testing.assert_allclose(found, moved.alignment.apply(start, t), atol=1e-9)
