"""Directions of the edges of two matched chains, counted on past half a round, so that angles can change evenly."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.model.arrays import rolled

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray

FULL_TURN = 2.0 * np.pi

CUSP = np.pi - 1e-6
"""Minimum turn of a cusp, where a chain goes back over itself and the sign of the turn means nothing, in radians."""

SHARP = 0.75 * np.pi
"""Minimum turn that may be taken for a turn the other way round if two chains disagree about the sum, in radians."""

NEARLY_STRAIGHT = 0.1
"""Minimum turn of both neighbours of a cusp, together, that decides its direction, in radians."""

NEGLIGIBLE_AREA = 1e-9
"""Maximum area of an outline without an orientation, as a share of its squared length."""


class Chain(NamedTuple):
    """One of two chains; an edge is exactly zero where the chain stays at a point while the other chain moves on."""

    edges: ComplexArray  # (n,)
    turns: FloatArray  # (n,), from the last edge with a direction, in radians; 0 without, and at an open chain's first

    @property
    def turning_number(self) -> int:
        """The number of rounds of a closed chain's directions."""
        return round(float(self.turns.sum()) / FULL_TURN)


def directions(
    a: ComplexArray, b: ComplexArray, segment: IntArray, closed: bool
) -> tuple[FloatArray, FloatArray] | None:
    """Return the directions of the edges of two chains, edge for edge.

    Parameters
    ----------
    a, b : (n,) complex
        Edges; exactly zero where a chain stays at a point, and nowhere in both.
    segment : (n,) int
        Which segment each edge belongs to, rising.
    closed : bool

    Returns
    -------
    pair of (n,) float, or None
        In radians. Along either chain they change by its turns; the turns of two closed chains have the same sum. None
        if that cannot be, as for a circle and a figure of eight, or if a chain is a point.

    Notes
    -----
    A turn is within half a round of zero, with three exceptions.

    * At a cusp, where the chain goes back over itself, the turn is half a round in either direction. It is taken to be
      opposite to the turns of its neighbours, as at the tip of a needle. If the turning number is then not 1 in the
      orientation of the area, cusps turn the other way until it is.
    * If the two sums still differ, the sharpest turns of 135° and more may go the long way round. Where the handles of
      a curve cross, the edges of its control polygon turn by more than the curve.
    * An edge without length has no direction of its own. The handle of a curve takes the direction of the curve's next
      edge, the tangent. Where whole segments are a point, the chain turns like the other chain, and the rest of its own
      turn at the point is distributed over these segments in proportion to the other chain's lengths: over the insides
      of curves, so that their joints stay as smooth as they are, or else over all joints.
    """
    if not (a.any() and b.any()):
        return None
    one, other = Chain(a, _turns(a, closed)), Chain(b, _turns(b, closed))
    if closed:
        signs = _orientation(a), _orientation(b)
        numbers = signs[0] or signs[1] or 1, signs[1] or signs[0] or 1
        for least in (CUSP, SHARP):
            one = _with_turning_number(one, numbers[0], least)
            other = _with_turning_number(other, numbers[1], least)
            if one.turning_number == other.turning_number:
                break
        else:
            return None
    return (
        _accumulate(one.edges, _distribute(one, other, segment, closed)),
        _accumulate(other.edges, _distribute(other, one, segment, closed)),
    )


def _turns(edges: ComplexArray, closed: bool) -> FloatArray:
    """Return the turns of a `Chain`, within half a round, with cusps opposite to the turns of their neighbours."""
    moving = np.flatnonzero(edges)
    turns = np.angle(edges[moving] * rolled(edges[moving], 1).conj())
    if not closed:
        turns[0] = 0.0
    cusps = np.abs(turns) > CUSP
    others = np.where(cusps, 0.0, turns)
    neighbours = rolled(others, 1) + rolled(others, -1)
    wrong = cusps & (np.abs(neighbours) > NEARLY_STRAIGHT) & (neighbours * turns > 0.0)
    turns[wrong] -= FULL_TURN * np.sign(turns[wrong])
    every = np.zeros(len(edges))
    every[moving] = turns
    return every


def _orientation(edges: ComplexArray) -> int:
    """Return the orientation of a closed chain: 1, -1, or 0 without an area."""
    area = signed_area(np.cumsum(edges))
    return int(np.sign(area)) if abs(area) > NEGLIGIBLE_AREA * np.abs(edges).sum() ** 2 else 0


def _with_turning_number(chain: Chain, number: int, least: float) -> Chain:
    """Reverse turns of `least` or more, the sharpest first, until the chain has a turning number, or none is left."""
    excess = chain.turning_number - number
    turns = chain.turns.copy()
    candidates = np.flatnonzero((np.abs(turns) >= least) & (turns * excess > 0.0))
    sharpest = candidates[np.argsort(-np.abs(turns[candidates]), kind="stable")][: abs(excess)]
    turns[sharpest] -= FULL_TURN * np.sign(excess)
    return chain._replace(turns=turns)


def _distribute(chain: Chain, other: Chain, segment: IntArray, closed: bool) -> FloatArray:
    """Return the turns at every edge of a chain, also where it stays at a point; their sum stays."""
    n = len(segment)
    moves, other_moves = chain.edges != 0.0, other.edges != 0.0
    is_known = other_moves & rolled(other_moves, 1)
    turns = chain.turns.copy()
    moving = np.flatnonzero(moves)
    if not closed:  # turns before the first edge that moves, or after the last, may have any sum
        outside = np.r_[1 : moving[0] + 1, moving[-1] + 1 : n]
        is_joint = segment[outside] != segment[outside - 1]
        of_moving = np.isin(segment[outside], segment[moving[[0, -1]]]) & ~is_joint
        turns[outside] = np.where(is_known[outside] & ~of_moving, other.turns[outside], 0.0)
    following = np.append(moving[1:], moving[0] + n) if closed else moving[1:]
    for p, q in zip(moving.tolist(), following.tolist(), strict=False):
        if q == p + 1:
            continue
        waiting, joints = np.arange(p + 1, q) % n, np.arange(p + 1, q + 1) % n
        turns[joints] = 0.0
        total = chain.turns[q % n]
        of_p, of_q = segment[waiting] == segment[p], segment[waiting] == segment[q % n]
        if (of_p & of_q).any():
            turns[joints] = total / len(joints)
            continue
        joints = joints[of_p.sum() : len(joints) - of_q.sum()]
        waiting = waiting[~(of_p | of_q)]
        shared = np.where(is_known[joints], other.turns[joints], 0.0)
        length = np.abs(other.edges[waiting])
        weight = np.append(length, 0.0) + np.append(0.0, length)
        inside = segment[joints] == segment[joints - 1]
        choices: tuple[BoolArray, ...] = (inside, ~is_known[joints], np.ones(len(joints), np.bool_))
        share = next((weight * where for where in choices if (weight * where).any()), np.ones(len(joints)))
        turns[joints] = shared + (total - shared.sum()) * share / share.sum()
    return turns


def _accumulate(edges: ComplexArray, turns: FloatArray) -> FloatArray:
    """Return directions from turns, starting with the first edge that has a direction."""
    first = int(np.flatnonzero(edges)[0])
    total = np.cumsum(turns)
    return total - total[first] + np.angle(edges[first])
