"""Outlines drawn with the same segments, and a match of two in which each becomes its own.

To make one drawing from another, people move its nodes. Both files then have the same lines and curves, in the same
order, and it is known what becomes what, to the last point of each. Editors blend such paths segment by segment, and so
does this where it does not take far more than the least work. Where it does, they have as many segments by accident.

Editors also put nodes into a curve and leave its shape alone. Such nodes, here called cuts, do not count.

Not in the paper, whose polygons are given.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flat_contour import NEAR
from shapeblend_cli.geometry.flatten import COINCIDENT
from shapeblend_cli.geometry.polyline import distinct
from shapeblend_cli.matching.solve import priced
from shapeblend_cli.model import Polygon
from shapeblend_cli.model.arrays import rolled
from shapeblend_cli.wires.contour_match import NOISE, Solved
from shapeblend_cli.wires.symmetry import PARALLEL, common_axes

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapeblend_cli.geometry.flat_contour import FlatContour
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray
    from shapeblend_cli.wires.contour_match import ContourMatch

SURE = 1e-3
"""Maximum distance of a node that is surely a cut from the curve through it, as a share of the outline's size."""

PERHAPS = 1e-2
"""Maximum distance of a node that may be a cut: two decimals in an icon of 24 round that much away."""

MOST = 1.3
"""Maximum work of a match of few segments, as a multiple of the least work."""

MOST_OF_MANY = 1.6
"""Maximum work of a match of `MANY` segments."""

MOST_OTHERWISE = 1.1
"""Maximum work of a match in which lines become curves."""

MANY = 8
"""Minimum number of lines and curves whose common order is hardly an accident."""

AGREED = 0.6
"""Minimum share of the dots of the least work that agree on the curves that become each other."""

LEAST_SHARE = 0.02
"""Minimum parameter between a cut and the ends of its curve."""

SAME = 1e-7
"""Maximum difference of positions that are one."""

LEAST_STEP = 1e-6
"""Minimum part of a curve that a segment is, by the curve's parameter."""


@dataclass(frozen=True, eq=False)
class Curves:
    """A contour as the curves and lines that it had before anybody cut them.

    A position is the number of a curve and the parameter on it: 3.5 is in the middle of the fourth curve. Positions
    start where `order` does, with a node that is no cut.

    Attributes
    ----------
    order : (k,) int
        The numbers of the contour's segments as positions rise.
    bounds : (k + 1,) float
        The positions where these begin; the last is where the last one ends.
    straight : (n,) bool
        Which curves are lines.
    """

    flat: FlatContour
    order: IntArray
    bounds: FloatArray
    straight: BoolArray

    @classmethod
    def without(cls, flat: FlatContour, cuts: IntArray, shares: FloatArray) -> Curves:
        """Return the curves of a contour.

        Parameters
        ----------
        flat : FlatContour
        cuts : (c,) int
            The segments that begin with a cut.
        shares : (k,) float
            The parameter of a cut at the beginning of each segment, on the curve of the two segments that meet there.
        """
        contour = flat.contour
        count = len(contour.segments)
        is_cut = np.zeros(count, np.bool_)
        is_cut[cuts] = True
        order = np.roll(np.arange(count), -int(is_cut.argmin()))
        begins = np.flatnonzero(~is_cut[order])
        curve = np.cumsum(~is_cut[order]) - 1
        # By how much more the parameter of the curve grows on each segment than on the one before it, as a logarithm.
        growth = np.zeros(count)
        growth[is_cut] = np.log(1.0 / shares[is_cut] - 1.0)
        rises = np.cumsum(growth[order])
        steps = np.exp(rises - np.maximum.reduceat(rises, begins)[curve])
        gone = np.cumsum(steps / np.add.reduceat(steps, begins)[curve]) - curve
        bounds = np.append(curve, len(begins)).astype(float)
        inner = np.flatnonzero(is_cut[order])
        bounds[inner] += gone[inner - 1]
        return cls(flat, order, bounds, contour.straight[order[begins]])

    @property
    def count(self) -> int:
        """The number of curves and lines."""
        return len(self.straight)

    @property
    def closed(self) -> bool:
        """Whether it is a closed contour."""
        return self.flat.polygon.closed

    @cached_property
    def vertices(self) -> FloatArray:
        """The positions of the polygon's vertices."""
        polygon = self.flat.polygon
        at = np.argsort(self.order)[polygon.segment]
        return self.bounds[at] + np.diff(self.bounds)[at] * polygon.parameter

    @property
    def is_likely(self) -> bool:
        """Whether the nodes that count as cuts lie on the curves that are then whole, or near them."""
        steps = np.diff(self.bounds)
        if not steps.min() > LEAST_STEP:
            return False
        cuts = np.flatnonzero(self.bounds[:-1] % 1.0)
        if not len(cuts):
            return True
        segments = self.flat.contour.segments[self.order]
        begins = np.flatnonzero(self.bounds[:-1] % 1.0 == 0.0)
        ends = np.append(begins[1:], len(steps)) - 1
        first, last = segments[begins], segments[ends]
        curves = np.stack(
            [
                first[:, 0],
                first[:, 0] + (first[:, 1] - first[:, 0]) / steps[begins],
                last[:, 3] + (last[:, 2] - last[:, 3]) / steps[ends],
                last[:, 3],
            ],
            axis=1,
        )
        number = np.searchsorted(begins, cuts, side="right") - 1
        away = np.abs(cubics.evaluate(curves[number], self.bounds[cuts] - number) - segments[cuts, 0])
        return bool(away.max() <= PERHAPS * self.flat.polygon.box.larger_side)

    def points(self, positions: FloatArray) -> tuple[ComplexArray, IntArray, FloatArray]:
        """Return the points at positions, the segments they are on, and their parameters there."""
        if self.closed:
            positions = positions % self.count
        begin, end = self.bounds[:-1], self.bounds[1:]
        at = np.minimum(np.searchsorted(begin, positions + SAME, side="right") - 1, len(begin) - 1)
        parameter = (positions - begin[at]) / (end[at] - begin[at])
        at_node = positions <= begin[at] + SAME
        parameter = np.where(at_node, 0.0, np.where(positions >= end[at] - SAME, 1.0, parameter))
        if self.closed:
            at = np.where(parameter == 1.0, at + 1, at) % len(begin)
            parameter = np.where(parameter == 1.0, 0.0, parameter)
        segments, segment = self.flat.contour.segments, self.order[at]
        points = cubics.evaluate(segments[segment], parameter)
        return np.where(parameter == 0.0, segments[segment, 0], points), segment, parameter

    def cut_at(self, positions: FloatArray) -> tuple[FlatContour, IntArray]:
        """Return the contour with vertices at rising positions alone, all nodes among them, and the vertex at each."""
        points, segment, parameter = self.points(positions)
        kept = distinct(points, self.closed, COINCIDENT * self.flat.polygon.box.larger_side)
        # A point that is left out is where the vertex before it is, or at the end of a closed contour the first one.
        vertex = np.searchsorted(kept, np.arange(len(points)), side="right") - 1
        if self.closed:
            ends = points[kept[[-1, 0]]]
            beyond = np.flatnonzero(np.abs(points - ends[0]) > np.abs(points - ends[1]))
            vertex[beyond[beyond > kept[-1]]] = 0
            first = int((segment[kept] + parameter[kept]).argmin())
            vertex = (vertex - first) % len(kept)
            kept = np.roll(kept, -first)
        polygon = Polygon(points[kept], segment[kept], parameter[kept], self.closed)
        return replace(self.flat, polygon=polygon), vertex


def solve_with_same_segments(match: ContourMatch) -> Solved | None:
    """Let each segment of one contour become one of the other, where both can be drawn with as many.

    None if they cannot, if the least work does not agree on which becomes which, if it takes too much work, or if an
    axis that both have is lost.
    """
    first = match.first
    found: list[tuple[float, Solved]] = []
    for p, q in _drawn_alike(match.a, match.b):
        start = _start(p, q, first.dots)
        matched = None if start is None else _matched(p, q, start, match)
        if start is None or matched is None:
            continue
        most = MOST_OTHERWISE
        if (p.straight == rolled(q.straight, -start)).all():
            most = MOST if p.count < MANY else MOST_OF_MANY
        if matched.correspondence.work <= most * first.work + NOISE and _keeps_axes(matched, match):
            found.append((most, matched))
    if not found:
        return None
    most, matched = min(found, key=lambda one: one[1].correspondence.work / one[0])
    return match.unless_far_more(matched, most)


def _drawn_alike(a: FlatContour, b: FlatContour) -> Iterator[tuple[Curves, Curves]]:
    """Yield both contours as equally many curves: with as few cuts left out as may be, and with as many as are sure.

    The contour with more curves loses the nodes that are most like cuts.
    """
    contours = a, b
    shares, away = zip(*map(_cuts, contours), strict=True)
    most = [len(off) for off in away]
    least = [len(off) - int((off < SURE).sum()) for off in away]
    for count in sorted({min(most), max(least), min(least)}, reverse=True):
        cuts = [np.argsort(off, kind="stable")[: len(off) - count] for off in away]
        if count <= min(most) and all(
            (off[some] < PERHAPS).all() for off, some in zip(away, cuts, strict=True)
        ):
            p, q = (Curves.without(*one) for one in zip(contours, cuts, shares, strict=True))
            if p.is_likely and q.is_likely:
                yield p, q


def _cuts(flat: FlatContour) -> tuple[FloatArray, FloatArray]:
    """Return for the beginning of each segment the parameter of a cut there, and the error of the curve through it.

    Parts of that curve, cut there, have the outer control points of the two segments. The error is a share of the
    contour's size; infinite where there can be no cut, and at one node of a closed contour at least.
    """
    segments, straight = flat.contour.segments, flat.contour.straight
    before, after = rolled(segments, 1), segments
    arriving, leaving = np.abs(before[:, 3] - before[:, 2]), np.abs(after[:, 1] - after[:, 0])
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        t = arriving / (arriving + leaving)
        # De Casteljau's construction, backwards for the whole curve and forwards for its parts.
        begin, end = before[:, 0], after[:, 3]
        first = begin + (before[:, 1] - begin) / t
        second = end + (after[:, 2] - end) / (1.0 - t)
        between = first + (second - first) * t
        left = before[:, 1] + (between - before[:, 1]) * t
        right = between + (after[:, 2] - between) * t
        node = left + (right - left) * t
        away = np.abs([left - before[:, 2], right - after[:, 1], node - after[:, 0]])
        off = away.max(axis=0) / flat.polygon.box.larger_side
    possible = (t > LEAST_SHARE) & (t < 1.0 - LEAST_SHARE) & (straight == rolled(straight, 1))
    possible[0] &= flat.polygon.closed
    off = np.where(possible & np.isfinite(off), off, np.inf)
    if len(off) and np.isfinite(off).all():
        off[off.argmax()] = np.inf  # somewhere a contour begins
    return t, off


def _start(a: Curves, b: Curves, dots: IntArray) -> int | None:
    """Return the curve of B that the first one of A becomes, by a correspondence; None if it does not agree on one."""
    ahead = np.round(b.vertices[dots[:, 1]] - a.vertices[dots[:, 0]]).astype(np.intp)
    votes = np.bincount(ahead % a.count, minlength=a.count)
    start = int(votes.argmax())
    return start if votes[start] >= AGREED * len(dots) and (a.closed or start == 0) else None


def _matched(a: Curves, b: Curves, start: int, match: ContourMatch) -> Solved | None:
    """Return both contours with vertices at the same positions, B's counted from curve `start`, and the match.

    None where each has a segment without extent beside one of the other: no path stands still twice in a row.
    """
    own_b = (b.vertices - start) % a.count if a.closed else b.vertices
    is_node = b.flat.polygon.parameter == 0.0
    positions = np.sort(np.concatenate([np.arange(a.count + 1.0), a.vertices, own_b[is_node]]))
    positions = positions[np.append(True, np.diff(positions) > SAME)]
    # Of B's other vertices those that are not near one already.
    more = np.sort(own_b[~is_node])
    more = more[np.append(True, np.diff(more) > SAME)[: len(more)]]
    after = np.searchsorted(positions, more).clip(1, len(positions) - 1)
    low, high = positions[after - 1], positions[after]
    more = more[np.minimum(more - low, high - more) > np.maximum(NEAR * (high - low), SAME)]
    positions = np.sort(np.append(positions, more))
    if a.closed:
        positions = positions[positions < a.count - SAME]
    cut_a, vertex_a = a.cut_at(positions)
    cut_b, vertex_b = b.cut_at(positions + start)
    dots = np.stack([vertex_a, vertex_b], axis=1)
    moved = (dots != rolled(dots, 1)).any(axis=1)
    moved[0] |= not a.closed
    try:
        return Solved(cut_a, cut_b, priced(match.wires(cut_a, cut_b), dots[moved]))
    except ValueError:
        return None


def _keeps_axes(matched: Solved, match: ContourMatch) -> bool:
    """Return whether the outline half way between two outlines has the axes that both have."""
    a, b, dots = matched.a.polygon, match.rotated_back(matched.b.polygon), matched.correspondence.dots
    axes = common_axes(a, b)
    if not axes:
        return True
    points = 0.5 * (a.vertices[dots[:, 0]] + b.vertices[dots[:, 1]])
    nowhere = np.zeros(len(points))
    half_way = Polygon(points, nowhere.astype(np.intp), nowhere, a.closed)
    if half_way.box.larger_side <= COINCIDENT * a.box.larger_side:
        return False
    kept = [axis.direction for axis, _ in common_axes(a, half_way)]
    return all(
        any(abs((axis.direction * direction.conjugate()).real) >= PARALLEL for direction in kept)
        for axis, _ in axes
    )
