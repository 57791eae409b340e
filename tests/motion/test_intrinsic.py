"""Motion by lengths and angles."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.interpolate.paths import between
from shapeblend_cli.model import CubicPath
from shapeblend_cli.motion.alignment import PointPairs, Rigid, align, point_pairs
from shapeblend_cli.motion.intrinsic import closing_lengths, intrinsic
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.settings import Settings
from shapeblend_cli.svg.reading.read import read
from tests.support.motions import contour_blend
from tests.support.shapes import random_polygon, star_polygon
from tests.support.strategies import rngs

TIMES = (0.1, 0.25, 0.5, 0.75, 0.9)
counts = st.integers(3, 24)


def outlines(a, b, straight=None, closed=True, **more):
    """A moving contour of control points."""
    straight = np.zeros(len(a), bool) if straight is None else straight
    places = np.arange(len(a) + 1.0), np.arange(len(a) + 1.0)
    return contour_blend(CubicPath(a, straight, closed), CubicPath(b, straight, closed), places, **more)


def polygons(a, b, closed=True, **more):
    """A moving contour of vertices."""
    a, b = (cubics.lines(np.asarray(z, complex), closed) for z in (a, b))
    return outlines(a, b, np.ones(len(a), bool), closed, **more)


def fitted(contours):
    """The best similarity of all control points."""
    a, b = (
        np.concatenate([getattr(contour, side).segments.ravel() for contour in contours])
        for side in ("start", "end")
    )
    return align(PointPairs(a, b, np.full(len(a), 1.0 / len(a))))


def motion(*contours):
    return intrinsic(contours, fitted(contours))


def at(contour, t):
    return motion(contour).segments([contour], t)[0]


def smooth_contour(rng, m):
    """Cubics through the vertices of a star, in one direction before and after each."""
    nodes = star_polygon(rng, m)
    way = np.roll(nodes, -1) - np.roll(nodes, 1)
    way /= abs(way)
    reach = abs(np.roll(nodes, -1) - nodes)
    after, before = rng.uniform(0.1, 0.4, (2, m)) * reach
    ends, ways = np.roll(nodes, -1), np.roll(way, -1)
    return np.stack([nodes, nodes + after * way, ends - before * ways, ends], axis=1)


def with_repeats(rng, z, more):
    """Vertices of which some are there several times, one after the other."""
    again = np.sort(rng.integers(0, len(z), more))
    return np.insert(z, again, z[again])


def size(z):
    return abs(z - z.mean()).max()


def pair_of_samples(samples, a, b, settings=None):
    drawings = [read(str(samples / f"{name}.svg")) for name in (a, b)]
    (pair,), _ = match_all(drawings, settings or Settings())
    found = []
    for shape in pair.shapes:
        alignment = align(point_pairs(shape.contours))
        found.append(shape._replace(motion=intrinsic(shape.contours, alignment)))
    return found


@pytest.mark.parametrize(
    "names",
    [("dancer-1", "dancer-2"), ("cow", "deer"), ("bird-1", "bird-2"), ("e", "f"), ("triangle", "square")],
)
def test_samples_start_and_end_as_drawn_and_stay_closed(samples, names):
    for shape in pair_of_samples(samples, *names):
        assert None not in shape.motion.polygons
        for t, side in ((1e-6, "start"), (1.0 - 1e-6, "end")):
            for contour, outline in zip(shape.contours, between(shape, t), strict=True):
                drawn = getattr(contour, side).segments
                assert abs(outline.segments - drawn).max() < 1e-4 * size(drawn)
        for t in TIMES:
            for outline in between(shape, t):
                ends = outline.segments[:, 3]
                assert np.array_equal(np.roll(ends, 1), outline.segments[:, 0])
                lines = outline.segments[outline.straight]
                thirds = cubics.line(lines[:, :1], lines[:, 3:])
                np.testing.assert_allclose(lines, thirds, atol=1e-9)


@given(rngs, counts, st.floats(-3.0, 3.0), st.floats(0.1, 10.0), st.complex_numbers(max_magnitude=20))
def test_a_shape_and_the_same_turned_scaled_and_moved_have_it_between_them(rng, m, turn, scale, shift):
    a = smooth_contour(rng, m)
    contour = outlines(a, scale * np.exp(1j * turn) * a + shift)
    centre, centre_b = contour.start.segments.mean(), contour.end.segments.mean()
    for t in TIMES:
        expected = scale**t * np.exp(1j * turn * t) * (a - centre) + (1.0 - t) * centre + t * centre_b
        np.testing.assert_allclose(at(contour, t), expected, atol=1e-9 * (1.0 + abs(shift) + scale))


@given(rngs, st.integers(4, 16), st.sampled_from(["plain", "handles", "points"]))
def test_what_is_smooth_in_both_drawings_stays_smooth(rng, m, kind):
    a, b = smooth_contour(rng, m), smooth_contour(rng, m)
    if kind == "handles":  # some without length: the next control point gives the tangent
        for segments in (a, b):
            which = rng.random(m) < 0.3
            tangent = np.where(
                which, segments[:, 0] + 2.0 * (segments[:, 1] - segments[:, 0]), segments[:, 2]
            )
            segments[which, 1] = segments[which, 0]
            segments[:, 2] = tangent
        joins = smooth_joins(a) & smooth_joins(b)
    elif kind == "points":  # each drawing waits at a node while the other goes on
        a = np.insert(a, 1, a[0, 3], axis=0)
        b = np.insert(b, 3, b[2, 3], axis=0)
        joins = np.ones(m + 1, bool)
    else:
        joins = np.ones(m, bool)
    contour = outlines(a, b)
    assert motion(contour).polygons[0] is not None
    for t in TIMES:
        assert smooth_joins(at(contour, t))[joins].all()


def smooth_joins(segments):
    """At the start of which segments a chain goes on in its direction."""
    starts, ends = cubics.directions(segments)
    return abs(starts - np.roll(ends, 1)) < 1e-5


# A body three wide and five high; at a shoulder an arm of length six, which swings.
def with_arm(angle):
    body_before, body_after = [0, 3], [3 + 5j, 5j]
    along, across = np.exp(1j * np.radians(angle)), 0.15j * np.exp(1j * np.radians(angle))
    shoulder = 3 + 3j
    out = [shoulder + reach * along - across for reach in (1, 2.5, 4.5, 6)]
    back = [shoulder + reach * along + across for reach in (6, 4.5, 2.5, 1)]
    return np.array([*body_before, shoulder - 0.4j, *out, *back, shoulder + 0.4j, *body_after])


def reach_of_arm(vertices):
    return abs(vertices[[6, 7]].mean() - vertices[[2, 11]].mean())


def test_an_arm_that_swings_keeps_its_length_and_on_straight_paths_withers():
    a, b = with_arm(-75), with_arm(75)
    assert reach_of_arm(a) == pytest.approx(reach_of_arm(b))
    contour = polygons(a, b)
    half_way = 0.5 * (a + b)
    assert reach_of_arm(half_way) < 0.3 * reach_of_arm(a)
    for t in TIMES:
        vertices = at(contour, t)[:, 0]
        assert reach_of_arm(vertices) == pytest.approx(reach_of_arm(a), rel=0.02)
        width = abs(vertices[4:7] - vertices[[9, 8, 7]])
        np.testing.assert_allclose(width, 0.3, rtol=0.1)
        direction = np.degrees(np.angle(vertices[6] - vertices[3]))
        assert direction == pytest.approx(-75 + 150 * t, abs=3.0)


def test_the_body_hardly_moves_while_the_arm_swings():
    contour = polygons(with_arm(-75), with_arm(75))
    for t in TIMES:
        body = at(contour, t)[[0, 1, 12, 13], 0]
        assert abs(body - with_arm(0)[[0, 1, 12, 13]]).max() < 0.35


def test_figure_28_the_dancers_arm_does_not_wither(samples):
    settings = Settings(preset="fig28", band="none")
    (shape,) = pair_of_samples(samples, "dancer-1", "dancer-2", settings)
    (contour,) = shape.contours
    nodes = contour.start.segments[:, 0]
    neck, armpit = abs(nodes - (207 + 98j)).argmin(), abs(nodes - (222 + 158j)).argmin()

    def reach(shape, t):
        """From the neck to the end of the arm."""
        arm = between(shape, t)[0].segments[neck:armpit, 0]
        return abs(arm - arm[0]).max()

    ends = reach(shape, 0.0), reach(shape, 1.0)
    straight = shape._replace(motion=None)
    assert min(reach(straight, t) for t in TIMES) < 0.8 * min(ends)
    assert min(reach(shape, t) for t in TIMES) > 0.98 * min(ends)
    assert max(reach(shape, t) for t in TIMES) < 1.02 * max(ends)


@given(rngs, counts, st.integers(0, 8))
def test_any_outlines_with_vertices_that_wait_move_continuously(rng, m, more):
    a, b = (with_repeats(rng, star_polygon(rng, m), more) for _ in range(2))
    contour = polygons(a, b)
    moved = motion(contour)
    assert moved.polygons[0] is not None
    times = np.linspace(0.0, 1.0, 401)[1:-1]
    every = np.array(
        [contour.start.segments, *(moved.segments([contour], t)[0] for t in times), contour.end.segments]
    )
    assert np.isfinite(every).all()
    assert abs(np.diff(every, axis=0)).max() < 0.1


@given(rngs, counts, st.booleans(), st.integers(0, 4))
def test_nothing_is_not_a_number_and_the_ends_are_reached(rng, m, closed, more):
    # Any points, so outlines cross themselves and go round anyhow.
    a, b = (with_repeats(rng, random_polygon(rng, m), more) for _ in range(2))
    contour = polygons(a, b, closed)
    for t in (1e-9, *TIMES, 1 - 1e-9):
        assert np.isfinite(at(contour, t)).all()
    assert abs(at(contour, 1e-7) - contour.start.segments).max() < 1e-4
    assert abs(at(contour, 1 - 1e-7) - contour.end.segments).max() < 1e-4


@given(rngs, counts, st.floats(-3.0, 3.0), st.floats(0.1, 10.0), st.complex_numbers(max_magnitude=20))
def test_moving_scaling_and_turning_both_drawings_does_so_to_what_is_between(rng, m, turn, scale, shift):
    a, b = smooth_contour(rng, m), smooth_contour(rng, m)
    factor = scale * np.exp(1j * turn)
    for t in TIMES:
        expected = factor * at(outlines(a, b), t) + shift
        found = at(outlines(factor * a + shift, factor * b + shift), t)
        np.testing.assert_allclose(found, expected, atol=1e-6 * scale)


@given(rngs, counts)
def test_backwards_in_time_it_is_the_same(rng, m):
    a, b = smooth_contour(rng, m), 3.0 * smooth_contour(rng, m)
    for t in TIMES:
        np.testing.assert_allclose(at(outlines(b, a), 1.0 - t), at(outlines(a, b), t), atol=1e-6)


def test_it_turns_the_short_way(rng):
    a = star_polygon(rng, 12) - 0.5 - 0.5j
    a[0] *= 2.0  # so that the turn is plain
    for turn in (-170.0, 170.0):
        b = a * np.exp(1j * np.radians(turn)) * (1.0 + 0.1 * rng.random(12))
        contour = polygons(a, b)
        vertices = at(contour, 0.5)[:, 0]
        off = np.vdot(a * np.exp(0.5j * np.radians(turn)), vertices - vertices.mean())
        assert abs(np.angle(off)) < 0.2


def test_an_open_line_bends_and_keeps_its_length():
    a = np.arange(7.0)
    b = np.append(0.0, np.cumsum(np.exp(1j * np.radians(np.arange(6) * 50.0))))
    contour = polygons(a, b, closed=False)
    for t in TIMES:
        np.testing.assert_allclose(abs(np.diff(at(contour, t), axis=1)), 1 / 3, rtol=0.05)
        turns = np.diff(np.angle(at(contour, t)[:, 3] - at(contour, t)[:, 0]))
        np.testing.assert_allclose(np.degrees(turns) % 360.0, 50.0 * t)


def test_what_has_no_turning_of_its_own_moves_as_rigid_has_it():
    circle = np.exp(2j * np.pi * np.arange(12) / 12)
    eight = np.sin(4 * np.pi * np.arange(12) / 12) + 1j * np.sin(2 * np.pi * np.arange(12) / 12)
    partner, crossed = polygons(circle, 2j * circle), polygons(circle, eight)
    growing = polygons(np.full(12, 0.5), circle, grows=True)
    pointless = polygons(circle, np.full(12, 0.5))
    contours = [partner, crossed, growing, pointless]
    moved = intrinsic(contours, fitted([partner]))
    assert moved.name == "intrinsic"
    assert [legs is None for legs in moved.polygons] == [False, True, True, True]
    expected = Rigid(moved.alignment).segments(contours, 0.3)
    for one, other in zip(moved.segments(contours, 0.3), expected, strict=True):
        np.testing.assert_allclose(one, other, atol=1e-12)  # the first because it only turns and grows


def test_a_needle_without_width_turns_at_its_tip_the_right_way():
    outwards = np.array([0, 4, 4 + 4j, 2 + 4j, 2 + 8j, 2 + 4j, 4j])
    inwards = np.array([0, 4, 4 + 4j, 2 + 4j, 2 + 1j, 2 + 4j, 4j])
    wide = np.array([0, 4, 4 + 4j, 2.5 + 4j, 2 + 8j, 1.5 + 4j, 4j])
    gap = np.array([0, 4, 4 + 4j, 2.5 + 4j, 2 + 1j, 1.5 + 4j, 4j])
    for needle, other in ((outwards, wide), (inwards, gap)):
        for way in (1, -1):
            for factor in np.exp(1j * np.linspace(0.0, 6.0, 25)):
                z, w = ((factor * points)[::way] for points in (needle, other))
                found = at(polygons(z, w), 0.5)[:, 0]
                areas = sorted(way * signed_area(points) for points in (z, w))
                assert areas[0] < way * signed_area(found) < areas[1]


def test_a_needle_that_grows_out_of_a_point_is_one_all_the_time():
    a = np.array([0, 4, 4 + 4j, 2 + 4j, 2 + 4j, 2 + 4j, 4j])
    b = np.array([0, 4, 4 + 4j, 2.2 + 4j, 2 + 8j, 1.8 + 4j, 4j])
    for t in TIMES:
        z = at(polygons(a, b), t)[:, 0]
        assert z[4].imag == pytest.approx(4 + 4 * t, abs=0.4)
        assert abs(z[5] - z[3]) == pytest.approx(0.4 * t, abs=0.2)
        assert abs(z[[0, 1, 2, 6]] - a[[0, 1, 2, 6]]).max() < 0.4


def test_contours_of_a_shape_keep_together(rng):
    ring = star_polygon(rng, 14, roughness=0.3) - 0.5 - 0.5j
    outer, hole, inner = ring, 0.5 * ring[::-1], 0.2 * ring
    contours = [polygons(z, 4.0 * np.exp(2j) * z + 3.0) for z in (outer, hole, inner)]
    moved = motion(*contours)
    for t in TIMES:
        found = moved.segments(contours, t)
        placed = moved.alignment.apply(
            np.concatenate([c.start.segments for c in contours]) - moved.alignment.centre_a, t
        )
        np.testing.assert_allclose(np.concatenate(found), placed, atol=1e-9)


def test_what_is_nearly_closed_is_closed_as_in_the_paper():
    # For a small opening the lengths are those of the paper's two linear equations.
    u = np.exp(2j * np.pi * np.array([0.0, 0.1, 0.35, 0.5, 0.6, 0.85]))
    softness = np.array([0.1, 1.0, 0.5, 0.2, 0.1, 0.3])
    opened = np.array([1.0, 2.0, 1.5, 1.0, 2.0, 1.5]) + 1e-5 * np.array([3, -1, 2, 5, -4, 0])
    rest, square = (opened * u).sum(), softness * opened
    matrix = [
        [(square * u.real**2).sum(), (square * u.real * u.imag).sum()],
        [(square * u.real * u.imag).sum(), (square * u.imag**2).sum()],
    ]
    by = np.linalg.solve(matrix, [-rest.real, -rest.imag])
    np.testing.assert_allclose(
        closing_lengths(opened, u, softness) - opened, square * (by[0] * u.real + by[1] * u.imag), atol=1e-8
    )


@pytest.mark.parametrize(
    "angles", [[0.0, 0.0, 0.0], [0.0, np.pi, 0.0], [0.1, 0.8, 1.2, 3.0], [0.5, 0.5 + np.pi]]
)
def test_directions_that_cannot_close_leave_finite_lengths(angles):
    found = closing_lengths(
        np.linspace(1.0, 2.0, len(angles)), np.exp(1j * np.array(angles)), np.ones(len(angles))
    )
    assert np.isfinite(found).all()
    assert (found > 0.0).all()
    assert found.max() < 1e3
