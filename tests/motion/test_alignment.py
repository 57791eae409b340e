"""The best similarity between points that correspond."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.motion.alignment import PointPairs, align, point_pairs, residual, shared_alignments
from tests.support.drawings import drawing
from tests.support.motions import pair_of
from tests.support.strategies import rngs


def pairs_of(a, b, weight=None):
    weight = np.ones(len(a)) if weight is None else weight
    return PointPairs(np.asarray(a, complex), np.asarray(b, complex), weight / weight.sum())


def random_points(rng, k=12):
    return rng.normal(size=k) + 1j * rng.normal(size=k)


@given(
    rngs,
    st.floats(0.01, 100.0),
    st.floats(-3.1, 3.1),
    st.complex_numbers(max_magnitude=1e3),
    st.integers(2, 40),
)
def test_a_similarity_is_found_whatever_the_weights(rng, scale, rotation, shift, k):
    a = random_points(rng, k)
    points = pairs_of(a, scale * np.exp(1j * rotation) * a + shift, 0.01 + rng.random(k))
    found = align(points)
    assert found.scale == pytest.approx(scale)
    assert found.rotation == pytest.approx(rotation, abs=1e-6)
    assert residual(points, found) < 1e-6
    there = found.apply(a - found.centre_a, 1.0)
    np.testing.assert_allclose(there, points.b, atol=1e-6 * (scale + abs(shift)))
    np.testing.assert_allclose(found.undo(points.b), a - found.centre_a, atol=1e-6)


@given(rngs, st.floats(0.3, 3.0), st.floats(-3.1, 3.1))
def test_what_most_points_do_is_found_whatever_the_others_do(rng, scale, rotation):
    a = random_points(rng, 30)
    b = scale * np.exp(1j * rotation) * a + 1.0
    b[:10] += 3.0 * scale * random_points(rng, 10)
    found = align(pairs_of(a, b))
    np.testing.assert_allclose(found.undo(b[10:]), a[10:] - found.centre_a, atol=0.03)


@given(rngs, st.floats(0.5, 3.0))
def test_what_rests_in_its_place_is_not_moved(rng, away):
    a = random_points(rng, 30)
    b = a.copy()
    b[:14] = (b[:14] - 1.0) * np.exp(1j * away) + 1.0
    found = align(pairs_of(a, b))
    assert (found.scale, found.rotation) == (1.0, 0.0)
    assert found.centre_a == found.centre_b


@given(rngs)
def test_from_b_to_a_it_is_the_inverse(rng):
    points = pairs_of(random_points(rng), random_points(rng), rng.random(12))
    there, back = align(points), align(points._replace(a=points.b, b=points.a))
    assert np.exp(1j * (back.rotation + there.rotation)) == pytest.approx(1.0)
    assert back.scale == pytest.approx(1.0 / there.scale)
    assert (back.centre_a, back.centre_b) == pytest.approx((there.centre_b, there.centre_a))


@pytest.mark.parametrize("off", [-0.5, -1e-9, 0.0, 1e-9, 0.5])
def test_a_half_turn_goes_clockwise(off):
    up = np.array([0, 4 + 4j, 1 + 2j, 1 + 9j, -1 + 9j, -1 + 2j, -4 + 4j])
    for angle in (180 + off, -180 + off):
        found = align(pairs_of(up, up * np.exp(1j * np.radians(angle)) + 20))
        assert found.rotation == pytest.approx(np.radians(180 + off))
        np.testing.assert_allclose(
            found.apply(up - found.centre_a, 1.0), up * np.exp(1j * np.radians(angle)) + 20
        )


def test_half_way_it_is_rotated_and_scaled_by_half():
    a = np.array([1, 1j, -1, -1j, 2 + 1j])
    points = pairs_of(a, 9.0 * np.exp(0.8j) * a + 1000.0)
    found = align(points)
    expected = 5.0 * np.exp(0.4j) * (a - a.mean()) + 0.5 * (a.mean() + points.b.mean())
    np.testing.assert_allclose(found.apply(a - found.centre_a, 0.5), expected)


@pytest.mark.parametrize("degrees", [60, -120, 180])
def test_the_hand_of_a_clock_turns_about_its_end(degrees):
    hand = np.array([0.3j, 0, -0.3j, 5 - 0.2j, 5 + 0.2j]) + 2 + 3j
    found = align(pairs_of(hand, (hand - 2 - 3j) * np.exp(1j * np.radians(degrees)) + 2 + 3j))
    for t in (0.2, 0.5, 0.8):
        assert found.apply(2 + 3j - found.centre_a, t) == pytest.approx(2 + 3j)
        assert abs(found.apply(hand[-1] - found.centre_a, t) - 2 - 3j) == pytest.approx(abs(5 + 0.2j))


LINE, SQUARE, POINT = [0, 1, 2, 3], [0, 1, 1 + 1j, 1j], [5, 5, 5, 5]


@pytest.mark.parametrize(
    ("a", "b"),
    [
        (LINE, [0, 1j, 2j, 3j]),
        (LINE, SQUARE),
        ([0, 1, 0, 1], SQUARE),
        (POINT, SQUARE),
        (SQUARE, POINT),
        (POINT, POINT),
        ([1, 1j, -1, -1j], [1, -1j, -1, 1j]),  # a mirror: no rotation is better than another
    ],
    ids=["lines", "line-square", "there-and-back", "point-square", "square-point", "points", "mirror"],
)
def test_lines_and_points_have_a_finite_one(a, b):
    points = pairs_of(a, b)
    found = align(points)
    assert np.isfinite(found).all()
    assert found.scale > 0.0
    assert np.isfinite(residual(points, found))


def test_collinear_points_rotate_with_their_line():
    assert align(pairs_of(LINE, [0, 1j, 2j, 3j])).rotation == pytest.approx(np.pi / 2.0)


FACE = "M2 2H22V22H2Z", "M6 6H9V9H6Z", "M15 6H18V9H15Z"
LARGER = "M2 2H26V26H2Z", "M7 6H10V9H7Z", "M17 7H20V10H17Z"


def similarities(a, b):
    shapes = pair_of(drawing(*a), drawing(*b), motion="linear").shapes
    return shapes, shared_alignments(shapes)


def test_what_lies_in_each_other_has_one_similarity():
    shapes, (face, *eyes) = similarities(FACE, LARGER)
    assert eyes == [face] * 2
    whole = align(point_pairs([contour for shape in shapes for contour in shape.contours]))
    assert face == whole


def test_what_lies_apart_has_its_own_and_what_has_no_partner_none():
    a = *FACE, "M40 0H44V9H40Z"
    b = *LARGER, "M40 20L58 2L54 -2L36 16Z", "M80 80H81V81H80Z"
    shapes, found = similarities(a, b)
    assert [one is None for one in found] == [not shape.is_matched for shape in shapes]
    assert len(set(found) - {None}) == 2
