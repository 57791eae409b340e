"""How a line moves: one that stays, one that becomes another, and one that is drawn on or back."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.geometry.polygons import polyline_contour, signed_area, winding_numbers
from shapeblend_cli.geometry.polyline import cumulative_lengths, nearest_places, needed
from shapeblend_cli.matching.solve import priced
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.model import (
    Box,
    ContourBlend,
    Correspondence,
    Fade,
    LinePart,
    Polygon,
    ShapeBlend,
)
from shapeblend_cli.model.arrays import rolled
from shapeblend_cli.motion.pen import Drawing, Exchange, Pen, Riding, Straight, between, pressed
from shapeblend_cli.motion.trims import trim_of
from shapeblend_cli.pens.line import (
    at,
    corners,
    each_once,
    foot_points,
    length,
    lengths_along,
    with_dashes,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, IntArray
    from shapeblend_cli.motion.pen import Moving
    from shapeblend_cli.options.constants import WorkConstants
    from shapeblend_cli.pens.line import PenLine
    from shapeblend_cli.pens.stays import Stayed, Tail

STAYS, BECOMES = "a pen line that stays", "a pen line that becomes another"
DRAWN_BACK, DRAWN_ON = "a pen line that is drawn back", "a pen line that is drawn on"

CUT_AT_CORNERS = "it is cut at its corners, as its pieces become lines with less work"
CUT_WHERE_ALIKE = "it is cut where the other drawing's line is elsewhere or ends"
CUT_IN_PARTS = "it is cut, as it becomes several lines"

UNCUT = 0.98
"""Minimum share of the length of a line that is all of it."""

EARLY = 0.4
"""Time that a line that touches no other goes before the end, or comes after the start, as a share of all time."""

SOON = 0.35
"""Time in which a line thickens or thins while others change, as a share of all time."""

CHANGES = 1.0
"""Minimum mean distance that places of a line move, beside its shift, for what touches it to leave early, in units."""

COMES, GOES = Fade(0.0, 0.12, comes=True), Fade(0.88, 1.0, comes=False)

STUB = 0.2
"""Maximum length of a tail that is no line of its own, in units."""

TURNS_OFF = 0.9
"""Minimum angle between two tails, in radians, for one to be drawn back before the other is drawn on."""

EXACT = 0.012
"""Tolerance of lines at both ends, in units: a quarter of a pixel where 24 units are 512."""

SMOOTH = 0.04
"""Tolerance of lines that are drawn on or back, in units. An animation has a waypoint for each of their vertices."""

CORNERS_FIRST = 0.5
"""Weight of the distances that points go if as many corners go to corners: a bend beside a corner shows."""

EVEN = 0.05
"""Tolerance of the halves of a line that are alike, as a share of its length."""

STUBBY = 1.95
"""Maximum length of a line that thickens as it comes, in widths: drawn on in its full width, a dot would pop up."""

RINGS = 3.2
"""The same for a ring."""

CROSSES = 6.0
"""The same for a line through the middle of another one, as in a plus."""

CHEVRONS = 4.0
"""The same for a chevron by itself."""


class Move(NamedTuple):
    """A line on its way, in units.

    What touches nothing is gone, or begins to come, a while before the end or after the start.
    """

    a: PenLine | None
    b: PenLine | None
    motion: Pen
    reason: str
    is_joined: bool = True  # whether what comes or goes ends at another line
    is_early: bool = False  # whether it goes before the others have moved, or comes after
    thickens: bool = False  # whether it grows from a thin line as it comes, or thins as it goes

    @property
    def span(self) -> tuple[float, float]:
        """The times of its start and its end."""
        if (self.a is not None and self.b is not None) or not self.is_early:
            return 0.0, 1.0
        time = SOON if self.thickens else 1.0 - EARLY
        return (1.0 - EARLY - time, 1.0 - EARLY) if self.b is None else (EARLY, EARLY + time)

    def _part(self, line: PenLine, points: ComplexArray) -> LinePart:
        """Return which part of a line its points at an end are."""
        if line.is_piece:
            return LinePart(line.name, *line.share, CUT_AT_CORNERS)
        along = lengths_along(line, points) if length(points) < UNCUT * line.length else None
        if along is None:
            return LinePart(line.name)
        low, high = sorted((along[[0, -1]] / line.length).tolist())
        return LinePart(line.name, low, high, CUT_WHERE_ALIKE if self.reason == STAYS else CUT_IN_PARTS)

    def shape(self, scale: float, constants: WorkConstants) -> ShapeBlend:
        """Return the shape, in A's coordinates."""
        motion = self.motion.scaled(1.0 / scale)
        ends = [motion.points(t) for t in (0.0, 1.0)]
        line_a, line_b = self.a or self.b, self.b or self.a
        assert line_a is not None
        assert line_b is not None
        style_a = line_a.style_beside(line_b)
        style_b = line_b.style_beside(line_a._replace(style=style_a))
        points = [self.motion.points(t) for t in (0.0, 1.0)]
        # Mitred corners of a small drawing would be longer than its sides.
        if np.ptp(points[0]) == 0.0:
            style_a = style_a._replace(stroke_miterlimit=1.0)
        elif np.ptp(points[1]) == 0.0:
            style_b = style_b._replace(stroke_miterlimit=1.0)
        style_a, style_b = with_dashes((style_a, style_b), (line_a, line_b), points, scale)
        fade = None
        if self.thickens:
            thin = (style_a if self.b else style_b)._replace(stroke_width=0.0)
            style_a, style_b = (style_a, thin) if self.a else (thin, style_b)
        elif not self.is_joined:
            fade = GOES if self.a else COMES
        numbers = self.a and self.a.contour, self.b and self.b.contour
        contour = contour_blend(numbers, ends, motion.closed, constants)
        parts = [line and self._part(line, own) for line, own in zip((self.a, self.b), points, strict=True)]
        contour = contour._replace(reason=self.reason, lines=(parts[0], parts[1]))
        sources = self.a and self.a.shape, self.b and self.b.shape
        is_straight = all(isinstance(piece, Straight) for piece in motion.pieces)
        is_straight &= motion.tails == (None, None) and motion.turn == (0.0, 0.0)
        return ShapeBlend(
            (contour,),
            style_a,
            style_b,
            motion=None if is_straight else motion,
            reason=self.reason,
            fade=fade,
            span=self.span,
            trim=trim_of(motion),
            sources=(sources[0], sources[1]),
        )


def contour_blend(
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
        paths.append(polyline_contour(points, closed))
    dots = np.stack(vertices, axis=1)
    distinct = np.append(True, np.any(np.diff(dots, axis=0) != 0, axis=1))
    correspondence = _priced(polygons[0], polygons[1], dots[distinct], constants)
    size_a, size_b = (max(Box.around(points).larger_side, 1e-9) for points in ends)
    every = np.arange(len(ends[0]) + closed, dtype=float)
    return ContourBlend(
        numbers[0],
        numbers[1],
        paths[0],
        paths[1],
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
    if a.closed and any(abs(each.vertices[0] - each.vertices[-1]) < 1e-12 for each in (a, b)):
        return Correspondence.without_work(dots, closed=True)  # pressed flat, there and back
    if min(len(a.vertices), len(b.vertices)) >= least:
        with suppress(ValueError):  # a turn of 90 degrees, which section 4 forbids, has no price
            return priced(Wires(to_unit_box(a), to_unit_box(b), a.closed, constants), dots)
    return Correspondence.without_work(dots, a.closed)


def staying(each: Stayed, a: Sequence[PenLine], b: Sequence[PenLine]) -> Move:
    """Return how a line that stays moves: its pieces little, and its tails back and on."""
    parts = [list(part) for part in each.parts]
    for end, tail in zip((0, -1), each.tails, strict=True):
        for side, points in enumerate(tail):
            if length(points) < STUB:  # the end slides on by so little
                own = parts[end][side]
                parts[end][side] = np.append(own, points[1:]) if end else np.append(points[:0:-1], own)
    tails = [_tail(tail) for tail in each.tails]
    pieces = tuple(between(*alike(*part), closed=True) for part in parts)
    motion = Pen(pieces, (tails[0], tails[1]), each.closed)
    return Move(a[each.lines[0]], b[each.lines[1]], motion, STAYS)


def _tail(tail: Tail) -> Moving | None:
    """Return how a tail is drawn back, or on, or becomes the other drawing's."""
    sizes = [length(points) for points in tail]
    if max(sizes) < STUB:
        return None
    if sizes[0] < STUB:
        return Drawing(smooth(tail.b), 0.0, 1.0)
    if sizes[1] < STUB:
        return Drawing(smooth(tail.a), 1.0, 0.0)
    ways = [at(points, [min(1.0, size)])[0] - points[0] for points, size in zip(tail, sizes, strict=True)]
    if abs(np.angle(ways[1] / ways[0])) < TURNS_OFF:
        return between(*alike(tail.a, tail.b))
    return Exchange(smooth(tail.a), smooth(tail.b))


def smooth(points: ComplexArray) -> ComplexArray:
    """Return a polyline with fewer vertices, to be drawn on or back."""
    return points[needed(points, SMOOTH)]


def becoming(p: PenLine, q: PenLine, a: ComplexArray, b: ComplexArray) -> Move:
    """Return how a line becomes another, from one polyline to the other."""
    # An open line that goes there and back has as many points as the ring; one that ends where it begins need not.
    is_doubled = len(a) == len(b) and all(abs(each[0] - each[-1]) < 1e-9 for each in (a, b))
    if p.closed == q.closed or not is_doubled:
        closed = p.closed and q.closed
        return Move(p, q, Pen((between(*alike(a, b), closed=closed),), closed=closed), BECOMES)
    # Pressed flat, vertex by vertex: where the open line ends both sides would make a spike.
    flat = (q if p.closed else p).style
    flat = flat._replace(stroke_linejoin="round" if flat.stroke_linecap == "round" else "bevel")
    p, q = (p, q._replace(style=flat)) if p.closed else (p._replace(style=flat), q)
    ring, line = (a, b) if p.closed else (b, a)
    return Move(p, q, Pen((pressed(ring, line, opens=q.closed),), closed=True), BECOMES)


def alike(a: ComplexArray, b: ComplexArray, *, by_corners: bool = True) -> tuple[ComplexArray, ComplexArray]:
    """Return two polylines with as many vertices: corners go to corners, else even lengths to even lengths."""
    a, b = (np.repeat(each, 2) if len(each) == 1 else each for each in (a, b))
    sizes = length(a), length(b)
    if min(sizes) < 1e-6:
        line = np.linspace(0.0, 1.0, max(len(a), len(b)))
        long = a if sizes[0] >= sizes[1] else b
        shares = cumulative_lengths(long) / max(length(long), 1e-12)
        shares = shares if length(long) > 1e-9 else line
        return at(a, shares * sizes[0]), at(b, shares * sizes[1])
    bends = (corners(a), corners(b)) if by_corners else ([], [])
    knots = matched_corners(*bends)
    own = [cumulative_lengths(each) / size for each, size in zip((a, b), sizes, strict=True)]
    tries = []
    for x, y in {(tuple(knots[0]), tuple(knots[1])), ((0.0, 1.0), (0.0, 1.0))}:
        shares = each_once(np.concatenate([own[0], np.interp(own[1], y, x), np.linspace(0.0, 1.0, 25)]))
        p, q = at(a, shares * sizes[0]), at(b, np.interp(shares, x, y) * sizes[1])
        steps = np.diff(shares)
        squares = np.abs(p - q) ** 2
        work = float((steps * (squares[1:] + squares[:-1])).sum())
        if len(x) > 2 and len(bends[0]) == len(bends[1]):
            work *= CORNERS_FIRST
        tries.append((work, p, q))
    _, p, q = min(tries, key=lambda each: each[0])
    return thinned(p, q)


def thinned(p: ComplexArray, q: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
    """Return two polylines that correspond without the vertices that neither needs, nor what is half way."""
    keep = needed(p, EXACT) | needed(q, EXACT) | needed((p + q) / 2.0, SMOOTH)
    return p[keep], q[keep]


def matched_corners(a: Sequence[float], b: Sequence[float]) -> tuple[list[float], list[float]]:
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


def alone(
    line: PenLine,
    carriers: Sequence[Pen],
    beside: Sequence[PenLine] = (),
    *,
    is_new: bool,
    has_bodies: bool = False,
) -> list[Move]:
    """Draw a line back to where it touches others, which carry it along, or on from there.

    If it touches none but lines `beside` it that come or go as well, all are drawn from where they meet, as an arrow is
    from its tip. A bow that stands on others parts in its middle. Where the drawing has more than lines, that may
    change, too.
    """
    points = line.drawn
    outlines = [_outline(carrier, is_new=is_new) for carrier in carriers]
    shares = (0.0, 1.0) if is_new else (1.0, 0.0)
    is_early = has_bodies or any(map(_changes, carriers))  # what rests leaves all of the time

    def moving(motion: Moving, *, closed: bool = False, most: float = STUBBY, **options: bool) -> Move:
        options["thickens"] = not options.get("is_joined", True) and line.length < most * line.width
        return _moving(line, Pen((motion,), closed=closed), is_new=is_new, **options)

    if line.closed and _surrounds(line, [own for _, own in outlines]):
        around = Drawing(smooth(_clockwise_from_top(line)), *shares)
        return [moving(around, is_joined=False, is_early=True)]
    if not line.can_be_drawn_on:
        point = np.full(len(points), Box.around(points).centre)
        pair = (point, points) if is_new else (points, point)
        most = RINGS if line.closed else STUBBY
        return [moving(Straight(*pair), closed=line.closed, most=most, is_joined=False, is_early=is_early)]

    def from_foot(points: ComplexArray, foot: tuple[Pen, ComplexArray]) -> Move:
        drawing = Drawing(points, *shares, span=_span(foot[0], is_new=is_new))
        return _carried(moving(drawing), foot, complex(points[0]))

    whole = length(points)
    places = [complex(points[0]), complex(at(points, [whole / 2.0])[0]), complex(points[-1])]
    first, middle, last = (_touched(place, line.reach, outlines) for place in places)
    if line.is_bow and first and last:
        halves = line.part(0.0, whole / 2.0), line.part(whole / 2.0, whole)[::-1]
        return [from_foot(half, foot) for half, foot in zip(halves, (first, last), strict=True)]
    if first:
        return [from_foot(points, first)]
    if last:
        return [from_foot(points[::-1], last)]
    meets = [any(_is_on(place, each) for each in beside) for place in places]
    if not middle and meets[0] != meets[2]:
        points = points if meets[0] else points[::-1]
        return [moving(Drawing(points, *shares), is_joined=False, is_early=is_early)]
    bends = corners(points)
    if middle or meets[1] or not bends or _is_chevron(points, bends):
        span = _span(middle[0], is_new=is_new) if middle else (0.0, 1.0)
        drawing = Drawing(points, *shares, from_middle=True, span=span)
        # A bar has its full width; so has the head of an arrow, which comes with its shaft.
        most = CHEVRONS if bends and not meets[1] else CROSSES if meets[1] and not bends else STUBBY
        move = moving(drawing, most=most, is_joined=bool(middle), is_early=is_early and not middle)
        return [_carried(move, middle, places[1]) if middle else move]
    if points[0].real > points[-1].real:  # as one writes
        points = points[::-1]
    return [moving(Drawing(points, *shares), is_joined=False, is_early=is_early)]


def _outline(carrier: Pen, *, is_new: bool) -> tuple[Pen, ComplexArray]:
    """Return a line with its points at an end, which close if it is closed."""
    points = carrier.points(float(is_new))
    return carrier, np.append(points, points[0]) if carrier.closed else points


def _touched(
    place: complex, reach: float, outlines: Sequence[tuple[Pen, ComplexArray]]
) -> tuple[Pen, ComplexArray] | None:
    """Return the first line within reach of a place."""
    return next((each for each in outlines if foot_points(np.array([place]), each[1])[0][0] < reach), None)


def _moving(line: PenLine, pen: Pen, *, is_new: bool, **options: bool) -> Move:
    """Return a line that comes or goes."""
    reason = DRAWN_ON if is_new else DRAWN_BACK
    return Move(None if is_new else line, line if is_new else None, pen, reason, **options)


def _is_on(place: complex, line: PenLine) -> bool:
    """Return whether a place is on a line, as far as its pen reaches."""
    return bool(foot_points(np.array([place]), line.drawn)[0][0] < line.reach)


def _is_chevron(points: ComplexArray, bends: Sequence[float]) -> bool:
    """Return whether a line has a corner in its middle, between halves that are alike, as a chevron has."""
    if len(bends) % 2 == 0 or abs(bends[len(bends) // 2] - 0.5) > EVEN:
        return False
    along = at(points, np.linspace(0.0, 1.0, 9) * length(points))
    away = np.abs(along - along[0]) - np.abs(along - along[-1])[::-1]
    return bool(np.abs(away).max() < EVEN * length(points))


def _span(carrier: Pen, *, is_new: bool) -> tuple[float, float]:
    """Return the time to leave a line, before it is like what it becomes, or to come to it, when it is.

    There are no hooks on the other drawing then.
    """
    return (0.0, 1.0) if not _changes(carrier) else (EARLY, 1.0) if is_new else (0.0, 1.0 - EARLY)


def _surrounds(line: PenLine, others: Sequence[ComplexArray]) -> bool:
    """Return whether other lines lie inside a ring: it would shrink on to them."""
    return any((winding_numbers(points, line.points) != 0).mean() > 0.5 for points in others)


def _clockwise_from_top(line: PenLine) -> ComplexArray:
    """Return the outline of a ring as a clock's hand goes, y downwards."""
    highest = int(line.points.imag.argmin())
    around = rolled(line.points, -highest)
    around = np.append(around, around[0])
    return around if signed_area(line.points) > 0.0 else around[::-1]


def _changes(carrier: Pen) -> bool:
    """Return whether a line changes its shape or direction, not only its place."""
    ways = carrier.points(1.0) - carrier.points(0.0)
    return bool(np.abs(ways - ways.mean()).mean() >= CHANGES)


def _carried(move: Move, carrier: tuple[Pen, ComplexArray], place: complex) -> Move:
    """Let a line that comes or goes be carried along by the line that it touches."""
    by, points = carrier
    home = 0.0 if move.b is None else 1.0
    _, (where,) = nearest_places(np.array([place]), points)
    edge = min(int(where), len(points) - 2)
    motion = by._replace(closed=False) if by.closed else by
    riding = Riding(move.motion.pieces[0], motion, edge, float(where) - edge, home)
    return move._replace(motion=Pen((riding,)))


def drawn(line: PenLine, points: ComplexArray, *, is_new: bool, is_early: bool = False) -> Move:
    """Draw a line on from the first of its points, or back to it, beside all others."""
    pen = Pen((Drawing(points, *((0.0, 1.0) if is_new else (1.0, 0.0))),))
    return _moving(line, pen, is_new=is_new, is_joined=False, is_early=is_early)
