"""How a line moves: one that stays, one that becomes another, and one that is drawn on or back."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.cubics import lines as straight_lines
from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.matching.solve import priced
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.model import (
    Box,
    Contour,
    ContourBlend,
    Correspondence,
    CubicPath,
    Fade,
    Polygon,
    ShapeBlend,
)
from shapeblend_cli.motion.pen import Drawing, Exchange, Pen, Straight, between
from shapeblend_cli.pens.line import at, corners, foot_points, length, needed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, IntArray
    from shapeblend_cli.motion.pen import Moving
    from shapeblend_cli.options.constants import WorkConstants
    from shapeblend_cli.pens.line import PenLine
    from shapeblend_cli.pens.stays import Stayed, Tail

STAYS, BECOMES = "a pen line that stays", "a pen line that becomes another"
DRAWN_BACK, DRAWN_ON = "a pen line that is drawn back", "a pen line that is drawn on"

EARLY = 0.4
"""Share of the time by which a line that touches no other goes before the end, or comes after the start."""

COMES, GOES = Fade(0.0, 0.12, comes=True), Fade(0.88, 1.0, comes=False)

TURNS_OFF = 0.9
"""Minimum angle between two tails, in radians, for one to be drawn back before the other is drawn on."""

SMOOTH = 0.03
"""Tolerance of lines that are drawn on or back, in units. An animation has a waypoint for each of their vertices."""

SHORT = 1.5
"""Maximum length of a line that comes or goes as a dot, in widths."""

LEAST_SLASH = 14.0
"""Minimum length of a slash, in units."""


class Move(NamedTuple):
    """A line on its way, in units.

    What touches nothing is gone, or begins to come, a while before the end or after the start.
    """

    a: PenLine | None
    b: PenLine | None
    motion: Pen
    reason: str
    is_joined: bool = True  # whether what comes or goes ends at another line
    shrinks: bool = False  # whether its width goes with it
    is_early: bool = False  # whether it goes before the others have moved, or comes after

    def _span(self) -> tuple[float, float]:
        if (self.a is not None and self.b is not None) or not self.is_early:
            return 0.0, 1.0
        return (0.0, 1.0 - EARLY) if self.b is None else (EARLY, 1.0)

    def shape(self, scale: float, constants: WorkConstants) -> ShapeBlend:
        """Return the shape, in A's coordinates."""
        motion = self.motion.scaled(1.0 / scale)
        ends = [motion.points(t) for t in (0.0, 1.0)]
        line_a, line_b = self.a or self.b, self.b or self.a
        assert line_a is not None
        assert line_b is not None
        style_a = line_a.style_beside(line_b)
        style_b = line_b.style_beside(line_a._replace(style=style_a))
        fade = None
        if self.shrinks:
            style_a = style_a if self.a else style_a._replace(stroke_width=0.0)
            style_b = style_b if self.b else style_b._replace(stroke_width=0.0)
        elif not self.is_joined:
            fade = GOES if self.a else COMES
        numbers = self.a and self.a.contour, self.b and self.b.contour
        contour = _contour_blend(numbers, ends, motion.closed, constants)
        names = self.a and self.a.name, self.b and self.b.name
        contour = contour._replace(reason=self.reason, lines=(names[0], names[1]))
        sources = self.a and self.a.shape, self.b and self.b.shape
        is_straight = all(isinstance(piece, Straight) for piece in motion.pieces) and motion.tails == (
            None,
            None,
        )
        return ShapeBlend(
            (contour,),
            style_a,
            style_b,
            motion=None if is_straight else motion,
            reason=self.reason,
            fade=fade,
            span=self._span(),
            sources=(sources[0], sources[1]),
        )


def _contour_blend(
    numbers: tuple[int | None, int | None],
    ends: Sequence[ComplexArray],
    closed: bool,
    constants: WorkConstants,
) -> ContourBlend:
    """Return the blend of a polyline, vertex by vertex; neighbours that are one are one vertex of a polygon."""
    polygons, vertices, paths = [], [], []
    for points in ends:
        is_new = np.append(True, np.abs(np.diff(points)) > 1e-12)
        own = points[is_new]
        vertices.append(np.cumsum(is_new) - 1)
        count = len(own)
        polygons.append(
            Polygon(own, np.arange(count) % max(1, count - (not closed)), np.zeros(count), closed)
        )
        lines = straight_lines(points, closed)
        paths.append(CubicPath(lines, np.ones(len(lines), bool), closed))
    dots = np.stack(vertices, axis=1)
    distinct = np.append(True, np.any(np.diff(dots, axis=0) != 0, axis=1))
    correspondence = _priced(polygons[0], polygons[1], dots[distinct], constants)
    first, last = (Contour(path.segments, path.straight, closed) for path in paths)
    size_a, size_b = (max(Box.around(points).larger_side, 1e-9) for points in ends)
    every = np.arange(len(ends[0]) + closed, dtype=float)
    return ContourBlend(
        numbers[0],
        numbers[1],
        first,
        last,
        polygons[0],
        polygons[1],
        size_a,
        size_b,
        correspondence,
        paths[0],
        paths[1],
        (every, every),
    )


def _priced(a: Polygon, b: Polygon, dots: IntArray, constants: WorkConstants) -> Correspondence:
    """Return a correspondence with the work that it takes; without, where one of the polygons is a point."""
    least = 3 if a.closed else 2
    if min(len(a.vertices), len(b.vertices)) >= least:
        with suppress(ValueError):  # a turn of 90 degrees, which section 4 forbids, has no price
            return priced(Wires(to_unit_box(a), to_unit_box(b), a.closed, constants), dots)
    return Correspondence.without_work(dots, a.closed)


def staying(each: Stayed, a: Sequence[PenLine], b: Sequence[PenLine]) -> Move:
    """Return how a line that stays moves: its pieces little, and its tails back and on."""
    pieces = tuple(between(*_alike(*part), closed=True) for part in each.parts)
    tails = [_tail(tail) for tail in each.tails]
    motion = Pen(pieces, (tails[0], tails[1]), each.closed)
    return Move(a[each.lines[0]], b[each.lines[1]], motion, STAYS)


def _tail(tail: Tail) -> Moving | None:
    """Return how a tail is drawn back, or on, or becomes the other drawing's."""
    sizes = [length(points) if len(points) > 1 else 0.0 for points in tail]
    if max(sizes) < 0.05:
        return None
    if sizes[0] < 0.05:
        return Drawing(_smooth(tail.b), 0.0, 1.0)
    if sizes[1] < 0.05:
        return Drawing(_smooth(tail.a), 1.0, 0.0)
    ways = [at(points, [min(1.0, size)])[0] - points[0] for points, size in zip(tail, sizes, strict=True)]
    if abs(np.angle(ways[1] / ways[0])) < TURNS_OFF:
        return between(*_alike(tail.a, tail.b))
    return Exchange(_smooth(tail.a), _smooth(tail.b))


def _smooth(points: ComplexArray) -> ComplexArray:
    return points[needed(points, SMOOTH)]


def becoming(p: PenLine, q: PenLine, a: ComplexArray, b: ComplexArray) -> Move:
    """Return how a line becomes another, from one polyline to the other."""
    closed = p.closed and q.closed
    return Move(p, q, Pen((between(*_alike(a, b), closed=closed),), closed=closed), BECOMES)


def _alike(a: ComplexArray, b: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
    """Return two polylines with as many vertices: corners go to corners, else even lengths to even lengths."""
    a, b = (np.repeat(each, 2) if len(each) == 1 else each for each in (a, b))
    sizes = length(a), length(b)
    if min(sizes) < 1e-6:
        line = np.linspace(0.0, 1.0, max(len(a), len(b)))
        long = a if sizes[0] >= sizes[1] else b
        shares = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(long)))]) / max(length(long), 1e-12)
        shares = shares if length(long) > 1e-9 else line
        return at(a, shares * sizes[0]), at(b, shares * sizes[1])
    bends = corners(a), corners(b)
    knots = _matched_corners(*bends)
    own = [
        np.concatenate([[0.0], np.cumsum(np.abs(np.diff(each)))]) / size
        for each, size in zip((a, b), sizes, strict=True)
    ]
    tries = []
    for x, y in {(tuple(knots[0]), tuple(knots[1])), ((0.0, 1.0), (0.0, 1.0))}:
        shares = np.concatenate([own[0], np.interp(own[1], y, x), np.linspace(0.0, 1.0, 25)])
        shares = np.unique(np.round(shares, 6))
        p, q = at(a, shares * sizes[0]), at(b, np.interp(shares, x, y) * sizes[1])
        steps = np.diff(shares)
        squares = np.abs(p - q) ** 2
        tries.append((float((steps * (squares[1:] + squares[:-1])).sum()), p, q))
    _, p, q = min(tries, key=lambda each: each[0])
    keep = needed(p, 0.008) | needed(q, 0.008) | needed((p + q) / 2.0, 0.02)
    return p[keep], q[keep]


def _matched_corners(a: Sequence[float], b: Sequence[float]) -> tuple[list[float], list[float]]:
    """Return places of corners on both lines that correspond, from 0 to 1: the nearest, in their order."""
    few, many = (a, b) if len(a) <= len(b) else (b, a)
    # The least sum of differences, by dynamic programming over how many of `few` are placed.
    best = [[0.0, *([np.inf] * len(few))]]
    for place in many:
        before = best[-1]
        row = [0.0]
        row += [min(before[k + 1], before[k] + abs(place - few[k])) for k in range(len(few))]
        best.append(row)
    chosen: list[float] = []
    k = len(few)
    for i in range(len(many), 0, -1):
        if k and best[i][k] < best[i - 1][k]:
            chosen.append(many[i - 1])
            k -= 1
    both = [0.0, *few, 1.0], [0.0, *chosen[::-1], 1.0]
    return both if len(a) <= len(b) else both[::-1]


def alone(line: PenLine, others: Sequence[PenLine], *, is_new: bool) -> Move:
    """Draw a line back to where it touches another one, or on from there; a slash from its first end."""
    points = line.outline if len(line.points) > 1 else np.repeat(line.points, 2)
    reason = DRAWN_ON if is_new else DRAWN_BACK
    before, after = (None, line) if is_new else (line, None)

    def touches(place: complex) -> bool:
        return any(
            len(other.outline) > 1
            and foot_points(np.array([place]), other.outline)[0][0] < 0.6 * other.width + 0.2
            for other in others
        )

    shares = (0.0, 1.0) if is_new else (1.0, 0.0)
    if line.closed or line.length < SHORT * line.width:
        point = np.full(len(points), Box.around(points).centre)
        pair = (point, points) if is_new else (points, point)
        motion = Pen((Straight(*pair),), closed=line.closed)
        return Move(before, after, motion, reason, shrinks=True, is_early=not line.closed)
    first, middle, last = (
        touches(place) for place in (points[0], at(points, [line.length / 2.0])[0], points[-1])
    )
    if last and not first:
        points = points[::-1]
    if first or last:
        return Move(before, after, Pen((Drawing(points, *shares),)), reason)
    if middle or not (_is_slash(points) or corners(points)):
        motion = Pen((Drawing(points, *shares, from_middle=True),))
        return Move(before, after, motion, reason, is_joined=middle, is_early=not middle)
    if points[0].real > points[-1].real:  # as one writes
        points = points[::-1]
    return Move(before, after, Pen((Drawing(points, *shares),)), reason, is_joined=False)


def _is_slash(points: ComplexArray) -> bool:
    """Return whether a line crosses much of the drawing, slanting."""
    chord = points[-1] - points[0]
    slope = abs(chord.real) / max(abs(chord.imag), 1e-9)
    return length(points) > LEAST_SLASH and 0.3 < slope < 3.3
