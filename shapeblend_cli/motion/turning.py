"""Directions of the legs of two matched chains, counted on past half a turn, so that angles between them can move."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polygons import signed_area

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray

ROUND = 2.0 * np.pi

TIP = np.pi - 1e-6
"""From this angle on a turn is one of half a round, back over itself, and its sign says nothing."""

SHARP = 0.75 * np.pi
"""From this angle on a turn may be taken for one the other way round, where two chains disagree about the sum."""

STRAIGHT_ON = 0.1
"""Neighbours of a tip that bend by less, together, do not say which way round it turns."""

NO_AREA = 1e-9
"""An outline that encloses less, with its length as 1, goes neither way round."""


class Chain(NamedTuple):
    """One of the two chains: its legs, and at each leg the turn from the one before.

    Attributes
    ----------
    legs : (n,) complex
        Exactly zero where the chain waits. Wherever one of the two chains waits the other one does not.
    turns : (n,) float
        Radians, from the last leg that has a direction; zero at legs that have none, and at the first of an open
        chain.
    """

    legs: ComplexArray
    turns: FloatArray

    @property
    def rounds(self) -> int:
        """How often the directions go round, for a closed chain."""
        return round(float(self.turns.sum()) / ROUND)


def directions(
    a: ComplexArray, b: ComplexArray, segment: IntArray, closed: bool
) -> tuple[FloatArray, FloatArray] | None:
    """Directions of the legs of two chains, leg for leg.

    Parameters
    ----------
    a, b : (n,) complex
        Legs; exactly zero where a chain waits for the other one, and nowhere in both.
    segment : (n,) int
        Which segment each leg belongs to, rising.
    closed : bool

    Returns
    -------
    pair of (n,) float, or None
        Radians. Along either chain they change by its turns, and the turns of two closed chains have the same sum. None
        where they have not, as of a circle and a figure of eight; also where a chain is a point.

    Notes
    -----
    A turn is within half a round of zero, with three exceptions.

    * A tip, where the chain goes back over itself: its turn is half a round either way. It is taken to be opposite to
      the bend of its neighbours, as at the tip of a needle, and if the turns do not make one round then, in the
      direction of the area, tips turn the other way until they do.
    * Where the two sums still differ, the sharpest of the turns of 135° and more may go the long way round. The legs
      of a curve turn by more than the curve does where its handles cross.
    * A leg without length has no direction of its own. A handle of a curve takes that of the leg of this curve next to
      it, which is the tangent. Where whole segments are a point, the chain turns there as the other one does, and what
      this falls short of its own turn at the point is spread over them: over the insides of curves, so that their
      joins stay as smooth as they are, or else over all of them; in proportion to the other chain's lengths.
    """
    if not (a.any() and b.any()):
        return None
    chains = Chain(a, _turns(a, closed)), Chain(b, _turns(b, closed))
    if closed:
        ways = _way(a), _way(b)
        goals = ways[0] or ways[1] or 1, ways[1] or ways[0] or 1
        chains = _retold(chains[0], goals[0], TIP), _retold(chains[1], goals[1], TIP)
        if chains[0].rounds != chains[1].rounds:
            chains = _retold(chains[0], goals[0], SHARP), _retold(chains[1], goals[1], SHARP)
        if chains[0].rounds != chains[1].rounds:
            return None
    one, other = chains
    return (
        _added_up(one.legs, _spread(one, other, segment, closed)),
        _added_up(other.legs, _spread(other, one, segment, closed)),
    )


def _turns(legs: ComplexArray, closed: bool) -> FloatArray:
    """Turns as `Chain` has them, within half a round; tips opposite to the bend of their neighbours."""
    at = np.flatnonzero(legs)
    turns = np.angle(legs[at] * np.roll(legs[at], 1).conj())
    if not closed:
        turns[0] = 0.0
    tips = np.abs(turns) > TIP
    others = np.where(tips, 0.0, turns)
    bend = np.roll(others, 1) + np.roll(others, -1)
    wrong = tips & (np.abs(bend) > STRAIGHT_ON) & (bend * turns > 0.0)
    turns[wrong] -= ROUND * np.sign(turns[wrong])
    every = np.zeros(len(legs))
    every[at] = turns
    return every


def _way(legs: ComplexArray) -> int:
    """Which way round a closed chain goes: 1, -1, or 0 without an area."""
    area = signed_area(np.cumsum(legs))
    return int(np.sign(area)) if abs(area) > NO_AREA * np.abs(legs).sum() ** 2 else 0


def _retold(chain: Chain, goal: int, least: float) -> Chain:
    """The chain with turns of an angle of `least` or more taken the other way, until it goes round `goal` times."""
    off = chain.rounds - goal
    turns = chain.turns.copy()
    candidates = np.flatnonzero((np.abs(turns) >= least) & (turns * off > 0.0))
    sharpest = candidates[np.argsort(-np.abs(turns[candidates]), kind="stable")][: abs(off)]
    turns[sharpest] -= ROUND * np.sign(off)
    return chain._replace(turns=turns)


def _spread(chain: Chain, other: Chain, segment: IntArray, closed: bool) -> FloatArray:
    """Turns at every leg of a chain, also where it waits; their sum stays."""
    n = len(segment)
    legs, turns = chain
    moves, other_moves = legs != 0.0, other.legs != 0.0
    is_known = other_moves & np.roll(other_moves, 1)
    found = turns.copy()
    at = np.flatnonzero(moves)
    if not closed:  # nothing says what the turn before the first leg, or after the last, should be together
        outside = np.r_[1 : at[0] + 1, at[-1] + 1 : n]
        is_join = segment[outside] != segment[outside - 1]
        of_moving = np.isin(segment[outside], segment[at[[0, -1]]]) & ~is_join
        found[outside] = np.where(is_known[outside] & ~of_moving, other.turns[outside], 0.0)
    after = np.append(at[1:], at[0] + n) if closed else at[1:]
    for p, q in zip(at.tolist(), after.tolist(), strict=False):
        if q == p + 1:
            continue
        waiting, joints = np.arange(p + 1, q) % n, np.arange(p + 1, q + 1) % n
        found[joints] = 0.0
        total = turns[q % n]
        of_before, of_after = segment[waiting] == segment[p], segment[waiting] == segment[q % n]
        if (of_before & of_after).any():
            found[joints] = total / len(joints)
            continue
        joints = joints[of_before.sum() : len(joints) - of_after.sum()]
        waiting = waiting[~(of_before | of_after)]
        own = np.where(is_known[joints], other.turns[joints], 0.0)
        length = np.abs(other.legs[waiting])
        weight = np.append(length, 0.0) + np.append(0.0, length)
        inside = segment[joints] == segment[joints - 1]
        shares: tuple[BoolArray, ...] = (inside, ~is_known[joints], np.ones(len(joints), np.bool_))
        share = next((weight * which for which in shares if (weight * which).any()), np.ones(len(joints)))
        found[joints] = own + (total - own.sum()) * share / share.sum()
    return found


def _added_up(legs: ComplexArray, turns: FloatArray) -> FloatArray:
    """Directions from turns, by way of the first leg that has one."""
    first = int(np.flatnonzero(legs)[0])
    along = np.cumsum(turns)
    return along - along[first] + np.angle(legs[first])
