"""The way through both outlines: which place of one goes to which place of the other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.interpolate.rails import is_among
from shapeblend_cli.model import unroll

if TYPE_CHECKING:
    from shapeblend_cli.interpolate.rails import Rail
    from shapeblend_cli.model import BoolArray, FloatArray, IntArray

LONG_STAND = 2
"""A corner that stands still over so many edges of the other outline is meant to; over fewer it is rounding."""

REACH = 2
"""Corners of both outlines are matched with each other if so many steps of the solver lie between, at most."""

START_SNAP = 0.5
"""A node of B within so many mean edges of where A's first node goes is where it goes."""


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """A monotone way through both outlines, from its start to its end: once round, where they are closed.

    Attributes
    ----------
    places : (l, 2) float
        What corresponds, as places on both rails: the solver's dots without its stairs. Neither side ever decreases;
        closed outlines come back to where they began.
    fixed : (l,) bool
        The places at which a cut is needed: corners that are matched with corners, both ends of where a corner
        stands still, and both ends of the track.
    """

    places: FloatArray
    fixed: BoolArray


def unrolled(a: Rail, b: Rail, dots: IntArray) -> FloatArray:
    """The solver's dots as places; closed outlines begin at A's first node and come back to it."""
    if not a.closed:
        return unroll(dots, None)
    first = int(np.flatnonzero(a.node)[0])
    there = dots[:, 0] == first
    begin = int(np.flatnonzero(there & ~np.roll(there, 1))[0]) if not there.all() else 0
    return unroll(np.roll(dots, -begin, axis=0), (a.count, b.count))


def slack_track(a: Rail, b: Rail, dots: IntArray) -> Track:
    """Take the stairs out of the solver's dots, and lead corners to corners.

    The polygons' vertices rarely fall on each other: now and then one stands still while the other outline goes on
    by an edge. That is rounding, and the place in the middle of such a step is as good as its ends. A corner
    that stands still for longer is meant to: a piece of the other outline grows out of it.
    """
    given = unrolled(a, b, dots)
    places, anchored = _corners_to_corners(a, b, given)
    if a.closed:
        places, anchored = _begun(a, b, places, anchored)
    anchored[[0, -1]] = True
    return Track(*_without_stairs(a, b, places, anchored))


def _corners(a: Rail, b: Rail, places: FloatArray) -> tuple[BoolArray, BoolArray]:
    return a.flag(a.corner, places[:, 0]), b.flag(b.corner, places[:, 1])


def _corners_to_corners(a: Rail, b: Rail, given: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Lead corners through corners that the solver passed nearby; tell which places are such a pair."""
    corner_a, corner_b = _corners(a, b, given)
    both = corner_a & corner_b
    lone_a = corner_a & ~is_among(given[:, 0], given[both, 0])
    lone_b = corner_b & ~is_among(given[:, 1], given[both, 1])
    if not lone_a.any() or not lone_b.any():
        return given, both
    length_a, length_b = a.length_at(given[:, 0]), b.length_at(given[:, 1])
    numbers_a, numbers_b = np.flatnonzero(lone_a), np.flatnonzero(lone_b)
    # Every dot of a lone corner of A with the next such dot of B behind it and the last one before it.
    after = np.searchsorted(numbers_b, numbers_a)
    candidates = []
    for side in (after - 1, after):
        valid = (side >= 0) & (side < len(numbers_b))
        p, q = numbers_a[valid], numbers_b[side[valid]]
        near = np.abs(p - q) <= REACH
        p, q = p[near], q[near]
        candidates += list(
            zip(
                np.maximum(np.abs(length_a[p] - length_a[q]), np.abs(length_b[p] - length_b[q])).tolist(),
                p.tolist(),
                q.tolist(),
                strict=True,
            )
        )
    places, used_a, used_b = given, set(), set()
    last = len(given) - 1
    for _, p, q in sorted(candidates):
        x, y = given[p, 0], given[q, 1]
        # Both ends of a closed track are one place, which `_begun` chooses.
        if x in used_a or y in used_b or (a.closed and {p, q} & {0, last}):
            continue
        used_a.add(x)
        used_b.add(y)
        # What lies before the new place on one outline and behind it on the other no longer fits.
        wrong = (places[:, 0] - x) * (places[:, 1] - y) < 0.0
        wrong[[0, -1]] = False
        if (both[wrong]).any():
            continue
        at = int(np.flatnonzero(~wrong & (places[:, 0] + places[:, 1] <= x + y))[-1]) + 1
        at -= int(wrong[:at].sum())
        places = np.insert(places[~wrong], at, [x, y], axis=0)
        both = np.insert(both[~wrong], at, True)
    return places, both.copy()


def _begun(a: Rail, b: Rail, places: FloatArray, anchored: BoolArray) -> tuple[FloatArray, BoolArray]:
    """Begin a closed track at the place of B that is best for A's first node."""
    period = np.array([a.count, b.count], np.float64)
    run = places[:, 0] == places[0, 0]
    stands = np.flatnonzero(run & (places[:, 0] < places[0, 0] + period[0]))
    paired = stands[anchored[stands]]
    first = places[0, 0]
    if len(paired):
        start = places[paired[0], 1]
    elif bool(a.flag(a.corner, places[:1, 0])[0]) and len(stands) > LONG_STAND:
        start = places[0, 1]
    else:
        low, high = b.length_at(places[stands[[0, -1]], 1])
        middle = 0.5 * (low + high)
        start = float(b.place_at(np.array([middle]))[0])
        nodes = np.flatnonzero(b.node[:-1]).astype(float)
        nodes = np.concatenate([nodes + b.count * k for k in (0, 1)])
        far = np.abs(b.length_at(nodes) - middle)
        if len(nodes) and far.min() <= START_SNAP * b.lengths[-1] / b.count:
            start = float(nodes[far.argmin()])
    begin = np.array([first, start])
    body, body_anchored = places[:-1], anchored[:-1]
    early = (body[:, 0] <= first) & (body[:, 1] < start)
    body = np.concatenate([body[~early], body[early] + period])
    body_anchored = np.concatenate([body_anchored[~early], body_anchored[early]])
    inside = ((body > begin).any(axis=1)) & ((body < begin + period).any(axis=1))
    inside &= (body >= begin).all(axis=1) & (body <= begin + period).all(axis=1)
    return (
        np.concatenate([begin[None], body[inside], begin[None] + period]),
        np.concatenate([[True], body_anchored[inside], [True]]),
    )


def _without_stairs(
    a: Rail, b: Rail, places: FloatArray, anchored: BoolArray
) -> tuple[FloatArray, BoolArray]:
    """The track without stands that are rounding; see `slack_track`.

    A stand of one step becomes the place in its middle. A longer one is spread over half an edge before it and half
    an edge after it: a vertex speaks for the outline up to half way to the next one, so that is as true, and the
    in-between does not bend where both outlines are smooth. What stays a stand are those of corners, and parts
    between corners of the outline that goes on, which are corners anyway.
    """
    steps = np.diff(places, axis=0)
    # The side that stands still in a step; no side in a diagonal one.
    still = np.where(steps[:, 0] == 0.0, 0, np.where(steps[:, 1] == 0.0, 1, 2))
    if not (still < 2).any():
        return places, anchored
    corners = _corners(a, b, places)
    # A stand is seen in parts where the outline that goes on turns a corner.
    turns = np.where(still[1:] == 0, corners[1][1:-1], (still[1:] == 1) & corners[0][1:-1])
    breaks = np.flatnonzero((still[1:] != still[:-1]) | anchored[1:-1] | turns) + 1
    firsts = np.concatenate([[0], breaks])
    lasts = np.concatenate([breaks, [len(still)]])
    lengths = a.length_at(places[:, 0]), b.length_at(places[:, 1])
    kept = np.ones(len(places), np.bool_)
    forced = np.zeros(len(places), np.bool_)
    is_long = np.repeat(lasts - firsts >= LONG_STAND, lasts - firsts)
    fixed = anchored.copy()
    middles: list[tuple[float, float]] = []
    for p, q in zip(firsts.tolist(), lasts.tolist(), strict=True):
        side = int(still[p])
        if side == 2:
            continue
        if corners[side][p] and q - p >= LONG_STAND:
            fixed[[p, q]] = True
            continue
        # An end that is a corner of the outline that goes on stays as it is.
        ends = [
            (end, beyond)
            for end, beyond in ((p, p - 1), (q, q + 1))
            if not anchored[end] and not corners[1 - side][end]
        ]
        kept[p + 1 : q] = False
        for end, beyond in ends:
            kept[end] = False
            step = min(end, beyond)
            if q - p >= LONG_STAND:
                if still[step] == 2:
                    middles.append(tuple((0.5 * (places[end] + places[beyond])).tolist()))
                elif is_long[step]:
                    forced[end] = True
        if q - p < LONG_STAND and len(ends) == 2:
            middle = 0.5 * (lengths[1 - side][p] + lengths[1 - side][q])
            moved = float((b if side == 0 else a).place_at(np.array([middle]))[0])
            middles.append((places[p, 0], moved) if side == 0 else (moved, places[p, 1]))
        for end in {p, q} - {end for end, _ in ends}:
            forced[end] = True
    kept |= fixed | forced
    slack = np.concatenate([places[kept], np.reshape(middles, (-1, 2))])
    slack, fixed = _in_order(slack, np.append(fixed[kept], np.zeros(len(middles), np.bool_)))
    # Vertices on the way through a stand that is no longer one: without them its curve would become a chord.
    length_a, length_b = a.length_at(slack[:, 0]), b.length_at(slack[:, 1])
    gone_a, gone_b = (
        places[~kept & (np.append(still == other, False) | np.append(False, still == other)), side]
        for side, other in ((0, 1), (1, 0))
    )
    to_b = b.place_at(np.interp(a.length_at(gone_a), length_a, length_b))
    to_a = a.place_at(np.interp(b.length_at(gone_b), length_b, length_a))
    between = np.concatenate([np.stack([gone_a, to_b], axis=1), np.stack([to_a, gone_b], axis=1)])
    return _in_order(np.concatenate([slack, between]), np.append(fixed, np.zeros(len(between), np.bool_)))


def _in_order(places: FloatArray, fixed: BoolArray) -> tuple[FloatArray, BoolArray]:
    """Places one after the other, whatever rounding has done to them."""
    order = np.lexsort((places[:, 1], places[:, 0]))
    return np.maximum.accumulate(places[order], axis=0), fixed[order]
