"""The solver's correspondence of vertices as a correspondence of positions anywhere along two contours."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polyline import interpolated
from shapeblend_cli.interpolate.parametrization import ContourParameter, is_among
from shapeblend_cli.model import unroll
from shapeblend_cli.model.arrays import rolled

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray

LONG_HOLD = 2
"""Minimum hold of a corner that is meant, in edges of the other contour; shorter holds are rounding."""

REACH = 2
"""Maximum distance of corners of both contours that are matched, in steps of the solver."""

START_SNAP = 0.5
"""Maximum distance of a node of B from the partner of A's first node to become that partner, in mean edges."""


@dataclass(frozen=True, eq=False)
class ContinuousMatch:
    """A monotone correspondence of two contours from start to end, once round where they are closed.

    Attributes
    ----------
    a, b : ContourParameter
    positions : (l, 2) float
        Corresponding positions on A and B: the solver's dots without the stairs. Both columns rise; closed contours
        return to their start.
    fixed : (l,) bool
        Positions that need a cut: matched corners, both ends of the hold of a corner, and both ends of the match.
    """

    a: ContourParameter
    b: ContourParameter
    positions: FloatArray
    fixed: BoolArray

    @cached_property
    def lengths(self) -> tuple[FloatArray, FloatArray]:
        """Lengths along A and B up to the positions, (l,) each."""
        return self.a.length_at(self.positions[:, 0]), self.b.length_at(self.positions[:, 1])

    @cached_property
    def vertices(self) -> tuple[ComplexArray, ComplexArray]:
        """Points of A and B at the positions, (l,) each."""
        return self.a.points(self.positions[:, 0]), self.b.points(self.positions[:, 1])

    @cached_property
    def own_progress(self) -> FloatArray:
        """Progress of the match's own positions, (l,)."""
        return self.progress(self.positions)

    def progress(self, positions: FloatArray) -> FloatArray:
        """Return the progress of positions along both contours: 0 at vertices 0, 2 once round."""
        a, b = self.a, self.b
        return a.length_at(positions[:, 0]) / a.lengths[-1] + b.length_at(positions[:, 1]) / b.lengths[-1]

    def with_partners(self, side: int, positions: FloatArray) -> FloatArray:
        """Return positions on A, side 0, or B, side 1, with the corresponding positions on the other, (k, 2) float."""
        sides = self.a, self.b
        known = self.lengths
        lengths = interpolated(sides[side].length_at(positions), known[side], known[1 - side])
        partners = sides[1 - side].position_at(lengths)
        both = np.empty((len(positions), 2))
        both[:, side], both[:, 1 - side] = positions, partners
        return both

    def piece_at(self, cuts: FloatArray, positions: FloatArray) -> IntArray:
        """Return for each position the number of the piece between cuts on which it lies."""
        numbers = self.progress(cuts).searchsorted(self.progress(positions), side="right") - 1
        return np.minimum(np.maximum(numbers, 0), len(cuts) - 2)

    def edges_between(self, first: FloatArray, second: FloatArray) -> FloatArray:
        """Return the larger of the two distances between positions along A and B, in mean edges."""
        gaps = [
            np.abs(one.length_at(second[:, side]) - one.length_at(first[:, side]))
            * (one.count / one.lengths[-1])
            for side, one in enumerate((self.a, self.b))
        ]
        return np.maximum(*gaps)


def unroll_from_node(a: ContourParameter, b: ContourParameter, dots: IntArray) -> FloatArray:
    """Return the solver's dots as rising positions; for closed contours, from A's first node on."""
    if not a.closed:
        return unroll(dots, None)
    first = int(a.node.argmax())
    at_first = dots[:, 0] == first
    begin = int((at_first & ~rolled(at_first, 1)).argmax()) if not at_first.all() else 0
    return unroll(rolled(dots, -begin), (a.count, b.count))


def match_continuously(a: ContourParameter, b: ContourParameter, dots: IntArray) -> ContinuousMatch:
    """Remove the stairs from the solver's dots, and match corners with corners.

    The polygons' vertices rarely coincide, so now and then a vertex is held while the other contour advances by an
    edge. That is rounding, and the position in the middle of such a step is as good as its ends. If a corner is held
    for longer, a piece of the other contour is meant to grow out of it.
    """
    positions, anchored = _match_corners(a, b, unroll_from_node(a, b, dots))
    if a.closed:
        positions, anchored = _choose_start(a, b, positions, anchored)
    anchored[[0, -1]] = True
    return _remove_stairs(ContinuousMatch(a, b, positions, anchored))


def _match_corners(
    a: ContourParameter, b: ContourParameter, given: FloatArray
) -> tuple[FloatArray, BoolArray]:
    """Match corners that the solver nearly matched; return the positions, and which of them are corners of both."""
    corner_a, corner_b = a.is_corner(given[:, 0]), b.is_corner(given[:, 1])
    both = corner_a & corner_b
    single_a = (corner_a & ~is_among(given[:, 0], given[both, 0])).nonzero()[0]
    single_b = (corner_b & ~is_among(given[:, 1], given[both, 1])).nonzero()[0]
    if not len(single_a) or not len(single_b):
        return given, both
    length_a, length_b = a.length_at(given[:, 0]), b.length_at(given[:, 1])
    # Candidates are each dot of a single corner of A and the dots of such corners of B next to it.
    after = np.searchsorted(single_b, single_a)
    candidates: list[tuple[float, int, int]] = []
    for side in (after - 1, after):
        valid = (side >= 0) & (side < len(single_b))
        p, q = single_a[valid], single_b[side[valid]]
        near = np.abs(p - q) <= REACH
        p, q = p[near], q[near]
        apart = np.maximum(np.abs(length_a[p] - length_a[q]), np.abs(length_b[p] - length_b[q]))
        candidates += zip(apart.tolist(), p.tolist(), q.tolist(), strict=True)
    positions, used_a, used_b = given, set(), set()
    last = len(given) - 1
    for _, i, j in sorted(candidates):
        x, y = given[i, 0], given[j, 1]
        # `_choose_start` chooses the ends of a closed match, which are one position.
        if x in used_a or y in used_b or (a.closed and {i, j} & {0, last}):
            continue
        used_a.add(x)
        used_b.add(y)
        # Positions before the new one on one contour and after it on the other no longer fit.
        wrong = (positions[:, 0] - x) * (positions[:, 1] - y) < 0.0
        wrong[[0, -1]] = False
        if both[wrong].any():
            continue
        at = int(np.flatnonzero(~wrong & (positions[:, 0] + positions[:, 1] <= x + y))[-1]) + 1
        at -= int(wrong[:at].sum())
        positions = np.insert(positions[~wrong], at, [x, y], axis=0)
        both = np.insert(both[~wrong], at, True)
    return positions, both.copy()


def _choose_start(
    a: ContourParameter, b: ContourParameter, positions: FloatArray, anchored: BoolArray
) -> tuple[FloatArray, BoolArray]:
    """Start a closed match at the best position of B for A's first node."""
    period = np.array([a.count, b.count], np.float64)
    first = positions[0, 0]
    held = ((positions[:, 0] == first) & (positions[:, 0] < first + period[0])).nonzero()[0]
    paired = held[anchored[held]]
    if len(paired):
        start = positions[paired[0], 1]
    elif bool(a.is_corner(positions[:1, 0])[0]) and len(held) > LONG_HOLD:
        start = positions[0, 1]
    else:
        low, high = b.length_at(positions[held[[0, -1]], 1])
        middle = 0.5 * (low + high)
        start = float(b.position_at(np.array([middle]))[0])
        nodes = b.node[:-1].nonzero()[0].astype(float)
        nodes = np.concatenate([nodes, nodes + b.count])
        far = np.abs(b.length_at(nodes) - middle)
        if len(nodes) and far.min() <= START_SNAP * b.lengths[-1] / b.count:
            start = float(nodes[far.argmin()])
    begin = np.array([first, start])
    body, body_anchored = positions[:-1], anchored[:-1]
    early = (body[:, 0] <= first) & (body[:, 1] < start)
    body = np.concatenate([body[~early], body[early] + period])
    body_anchored = np.concatenate([body_anchored[~early], body_anchored[early]])
    inside = ((body > begin).any(axis=1)) & ((body < begin + period).any(axis=1))
    inside &= (body >= begin).all(axis=1) & (body <= begin + period).all(axis=1)
    return (
        np.concatenate([begin[None], body[inside], begin[None] + period]),
        np.concatenate([[True], body_anchored[inside], [True]]),
    )


def _holds(
    match: ContinuousMatch, corners: tuple[BoolArray, BoolArray]
) -> tuple[IntArray, IntArray, IntArray]:
    """Return the side held in each step, and the first and the last position of each run of steps.

    The sides are 0 for A, 1 for B, 2 for neither. The steps of a run hold the same side; a run ends where a position is
    anchored, or where the advancing contour turns a corner. Given are the corners of A and B among the positions.
    """
    steps = match.positions[1:] - match.positions[:-1]
    held = np.where(steps[:, 0] == 0.0, 0, np.where(steps[:, 1] == 0.0, 1, 2))
    turns = np.where(held[1:] == 0, corners[1][1:-1], (held[1:] == 1) & corners[0][1:-1])
    breaks = ((held[1:] != held[:-1]) | match.fixed[1:-1] | turns).nonzero()[0] + 1
    return held, np.concatenate([[0], breaks]), np.concatenate([breaks, [len(held)]])


def _remove_stairs(match: ContinuousMatch) -> ContinuousMatch:
    """Return the match without holds that are rounding.

    A hold of one step becomes the position in its middle. A longer hold is extended by half an edge at both ends: a
    vertex stands for the contour up to halfway to the next vertex, so that is as correct, and the in-between does not
    bend where both contours are smooth. Holds of corners stay, and so do holds between corners of the other contour.
    """
    a, b, positions, anchored = match.a, match.b, match.positions, match.fixed
    corners = a.is_corner(positions[:, 0]), b.is_corner(positions[:, 1])
    held, firsts, lasts = _holds(match, corners)
    if not (held < 2).any():
        return match
    lengths = a.length_at(positions[:, 0]), b.length_at(positions[:, 1])
    kept = np.ones(len(positions), np.bool_)
    forced = np.zeros(len(positions), np.bool_)
    is_long = np.repeat(lasts - firsts >= LONG_HOLD, lasts - firsts)
    fixed = anchored.copy()
    middles: list[FloatArray] = []
    single: tuple[list[int], list[int]] = [], []  # holds of one step on either side, by their first positions
    stays = [(anchored | corners[1 - side]).tolist() for side in (0, 1)]
    for p, q, side in zip(firsts.tolist(), lasts.tolist(), held[firsts].tolist(), strict=True):
        if side == 2:
            continue
        is_hold_long = q - p >= LONG_HOLD
        if is_hold_long and corners[side][p]:
            fixed[[p, q]] = True
            continue
        kept[p + 1 : q] = False
        moved = 0
        for end, beyond in ((p, p - 1), (q, q + 1)):
            if stays[side][end]:  # a corner of the advancing contour stays as it is
                forced[end] = True
                continue
            moved += 1
            kept[end] = False
            if is_hold_long:
                step = min(end, beyond)
                if held[step] == 2:
                    middles.append(0.5 * (positions[[end]] + positions[[beyond]]))
                elif is_long[step]:
                    forced[end] = True
        if not is_hold_long and moved == 2:
            single[side].append(p)
    for side, other in ((0, b), (1, a)):
        first, along = np.array(single[side], np.intp), lengths[1 - side]
        middles.append(positions[first])
        middles[-1][:, 1 - side] = other.position_at(0.5 * (along[first] + along[first + 1]))
    kept |= fixed | forced
    match = _sort(a, b, np.concatenate([positions[kept], *middles]), fixed[kept])
    # Vertices of the removed holds stay: without them a curve would become a chord.
    between = []
    for side in (0, 1):
        gone = np.zeros(len(kept), np.bool_)
        advances = held == 1 - side
        gone[:-1] = advances
        gone[1:] |= advances
        gone &= ~kept
        between.append(match.with_partners(side, positions[gone, side]))
    return _sort(a, b, np.concatenate([match.positions, *between]), match.fixed)


def even_lines(match: ContinuousMatch) -> ContinuousMatch:
    """Return the match without positions that lie within a line of A and a line of B.

    Then a line evenly becomes a line, and the in-betweens are lines: any other match would have the same ends, and a
    bend in between.
    """
    sides = match.a, match.b
    within = ~match.fixed
    for side, one in enumerate(sides):
        positions = match.positions[:, side]
        edge = np.floor(positions).astype(np.intp)
        edge = edge % one.count if one.closed else np.minimum(edge, one.count - 1)
        within &= one.straight[one.segment[edge]] & ~one.is_node(positions)
    return ContinuousMatch(match.a, match.b, match.positions[~within], match.fixed[~within])


def _sort(
    a: ContourParameter, b: ContourParameter, positions: FloatArray, fixed: BoolArray
) -> ContinuousMatch:
    """Return the match of positions in order, rounding corrected; positions beyond the end of `fixed` are not fixed."""
    fixed = np.concatenate([fixed, np.zeros(len(positions) - len(fixed), np.bool_)])
    order = np.lexsort((positions[:, 1], positions[:, 0]))
    return ContinuousMatch(a, b, np.maximum.accumulate(positions[order], axis=0), fixed[order])
