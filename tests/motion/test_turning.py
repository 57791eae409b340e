"""Directions counted on past half a turn."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.motion.turning import directions
from tests.support.shapes import star_polygon
from tests.support.strategies import rngs

SQUARE = np.array([1, 1j, -1, -1j])


def angles(a, b, segment=None, closed=True):
    """In degrees, from the first leg's on."""
    a, b = np.asarray(a, complex), np.asarray(b, complex)
    segment = np.arange(len(a)) if segment is None else np.array(segment)
    found = directions(a, b, segment, closed)
    return None if found is None else [np.degrees(one - one[0]).round(6).tolist() for one in found]


@given(rngs, st.integers(3, 20), st.integers(0, 8))
def test_legs_have_their_directions_and_both_chains_go_round_once(rng, m, more):
    legs = []
    for _ in range(2):
        z = star_polygon(rng, m)
        again = np.sort(rng.integers(0, m, more))
        z = np.insert(z, again, z[again])
        legs.append(np.roll(z, -1) - z)
    moves = (legs[0] != 0) | (legs[1] != 0)
    legs = [one[moves] for one in legs]
    for one, found in zip(legs, directions(*legs, np.arange(moves.sum()), True), strict=True):
        np.testing.assert_allclose(abs(one) * np.exp(1j * found), one, atol=1e-9)
        own = found[one != 0]
        turns = np.diff(own, append=own[0] + 2 * np.pi)
        assert abs(turns).max() < np.pi


def test_a_corner_opens_as_the_other_chain_turns_there():
    # Where the square has a corner, the other has two more legs, which turn by 30 degrees each time.
    ways = np.exp(1j * np.radians([0, 30, 60, 90, 180, 270]))
    square = np.array([1, 0, 0, 1j, -1, -1j])
    assert angles(square, ways) == [[0, 30, 60, 90, 180, 270]] * 2


def test_what_the_other_does_not_turn_is_spread_by_its_lengths():
    # The other goes straight on, for one and for three, so the three joints have shares of 1, 4 and 3 in 90 degrees.
    way = np.exp(2j * np.pi / 3)
    found, other = angles([1, 0, 0, 1j, -1, -1j], [1, 1, 3, 2, 7 * way, 7 * way**2])
    assert other == [0, 0, 0, 0, 120, 240]
    assert found == [0, 11.25, 56.25, 90, 180, 270]


def test_a_curve_takes_up_the_turn_within_so_that_its_ends_stay_smooth():
    # A point where one goes straight on, for the other a curve with bends of 20 and 10 degrees inside.
    bent = np.exp(1j * np.radians([0, 0, 20, 30, 30, 150, 270]))
    straight = np.array([1, 0, 0, 0, 1, *np.exp(2j * np.pi * np.array([1, 2]) / 3)])
    found, other = angles(straight, bent, segment=[0, 1, 1, 1, 2, 3, 4])
    assert other == [0, 0, 20, 30, 30, 150, 270]
    assert (found[1], found[3], found[4]) == (0, 0, 0)


def test_a_handle_without_length_has_the_direction_of_the_tangent():
    segment = [0, 0, 0, 1, 2]
    found, _ = angles([1, 1, 0, 1j - 1, -1 - 1j], [1, 1j, 1j, -1 - 1j, -1j], segment=segment)
    assert found[2] == found[1]
    found, _ = angles([0, 1, 1, 1j - 1, -1 - 1j], [1, 1j, 1j, -1 - 1j, -1j], segment=segment)
    assert found[0] == found[1]


def test_chains_that_go_round_differently_have_no_directions():
    assert angles(SQUARE, SQUARE[::-1]) is None
    assert angles(SQUARE, np.zeros(4)) is None


def test_ends_of_an_open_chain_that_wait_turn_as_the_other_one():
    a, b = [0, 0, 1, 1j, 0], np.exp(1j * np.radians([10, 30, 60, 100, 150]))
    found, other = angles(a, b, closed=False)
    assert other == [0, 20, 50, 90, 140]
    assert found == [0, 20, 50, 140, 190]
