"""Directions counted on past half a turn."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.motion.turning import directions
from tests.support.shapes import star_polygon, unit, with_repeats
from tests.support.strategies import rngs

SQUARE = np.array([1, 1j, -1, -1j])


def angles(a, b, segment=None, closed=True):
    """In degrees, from the first edge's on."""
    segment = np.arange(len(a)) if segment is None else np.array(segment)
    both = directions(np.asarray(a, complex), np.asarray(b, complex), segment, closed)
    return both and [np.degrees(chain - chain[0]).round(6).tolist() for chain in both]


@given(rngs, st.integers(3, 20), st.integers(0, 8))
def test_edges_have_their_directions_and_both_chains_go_round_once(rng, m, more):
    outlines = [with_repeats(rng, star_polygon(rng, m), more) for _ in range(2)]
    chains = np.array([np.roll(z, -1) - z for z in outlines])
    chains = chains[:, (chains != 0).any(axis=0)]
    both = directions(*chains, np.arange(chains.shape[1]), True)
    for edges, found in zip(chains, both, strict=True):
        np.testing.assert_allclose(abs(edges) * np.exp(1j * found), edges, atol=1e-9)
        own = found[edges != 0]
        assert abs(np.diff(own, append=own[0] + 2 * np.pi)).max() < np.pi


def test_a_corner_opens_as_the_other_chain_turns_there():
    # Where the square has a corner, the other has two more edges, which turn by 30 degrees each time.
    turning = [0, 30, 60, 90, 180, 270]
    assert angles([1, 0, 0, 1j, -1, -1j], unit(turning)) == [turning] * 2


def test_what_the_other_does_not_turn_is_distributed_by_its_lengths():
    # The other goes straight on, for one and for three, so the three joints have shares of 1, 4 and 3 in 90 degrees.
    found, other = angles([1, 0, 0, 1j, -1, -1j], [1, 1, 3, 2, 7 * unit(120), 7 * unit(240)])
    assert other == [0, 0, 0, 0, 120, 240]
    assert found == [0, 11.25, 56.25, 90, 180, 270]


def test_a_curve_takes_up_the_turn_within_so_that_its_ends_stay_smooth():
    # A point where one goes straight on, for the other a curve with bends of 20 and 10 degrees inside.
    bent = [0, 0, 20, 30, 30, 150, 270]
    straight = [1, 0, 0, 0, 1, unit(120), unit(240)]
    found, other = angles(straight, unit(bent), segment=[0, 1, 1, 1, 2, 3, 4])
    assert other == bent
    assert (found[1], found[3], found[4]) == (0, 0, 0)


def test_a_handle_without_length_has_the_direction_of_the_tangent():
    other, segment = [1, 1j, 1j, -1 - 1j, -1j], [0, 0, 0, 1, 2]
    found, _ = angles([1, 1, 0, 1j - 1, -1 - 1j], other, segment)
    assert found[2] == found[1]
    found, _ = angles([0, 1, 1, 1j - 1, -1 - 1j], other, segment)
    assert found[0] == found[1]


def test_chains_that_go_round_differently_have_no_directions():
    assert angles(SQUARE, SQUARE[::-1]) is None
    assert angles(SQUARE, np.zeros(4)) is None


def test_ends_of_an_open_chain_that_stay_at_a_point_turn_as_the_other_one():
    found, other = angles([0, 0, 1, 1j, 0], unit([10, 30, 60, 100, 150]), closed=False)
    assert other == [0, 20, 50, 90, 140]
    assert found == [0, 20, 50, 140, 190]
