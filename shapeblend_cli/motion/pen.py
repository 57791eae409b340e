"""Motion of a pen line: pieces that change, one after the other, and tails that are drawn back or on."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polyline import cumulative_lengths, points_at
from shapeblend_cli.motion.rigid import turned_over

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, Motion

BENDS = 0.8
"""Minimum length of a piece half way on straight paths, as a share of its shorter end; else it turns as it goes."""


PRESSED = 0.75
"""Share of the time in which a ring is pressed flat: its sides would look like a thick line until the end."""

SHUTS = 3
"""Power of the time by which it is: wide for long, and narrow for moments only."""

TURNS_OVER = np.radians(30.0)
"""Maximum turn of a line as a whole that turns over, in radians, as from ] to [."""

FARTHEST = 1.25
"""Maximum distance from the middle of a line that turns as it goes, as a share of that of its ends."""

FLATTENS = 0.3
"""Minimum length half way of a line that turns over, as a share of its shorter end."""


SHORTEST = 1e-3
"""Minimum distance of a vertex from the ends of a stretch that slides, as a share of the length of its path."""


class Moving(Protocol):
    """Points that move."""

    def points(self, t: float) -> ComplexArray:
        """Return the points at a time, always as many."""

    def scaled(self, by: float) -> Moving:
        """Return the same, so many times as large, about the origin."""


class Straight(NamedTuple):
    """Points that move on straight paths."""

    a: ComplexArray
    b: ComplexArray

    def points(self, t: float) -> ComplexArray:
        """Return the points at a time."""
        return (1.0 - t) * self.a + t * self.b

    def scaled(self, by: float) -> Straight:
        """Return the same, so many times as large."""
        return Straight(self.a * by, self.b * by)


class Pressed(NamedTuple):
    """A ring that is pressed flat to a line, or a line that opens to one: both sides are one line for a while.

    `across` is how far each point of the ring lies beside the ring's axis.
    """

    a: ComplexArray
    b: ComplexArray
    across: ComplexArray
    opens: bool = False

    def points(self, t: float) -> ComplexArray:
        """Return the points at a time."""
        even = t if self.opens else 1.0 - t
        open_ = 1.0 - min(1.0, (1.0 - even) / PRESSED) ** SHUTS
        return (1.0 - t) * self.a + t * self.b + (open_ - even) * self.across

    def scaled(self, by: float) -> Pressed:
        """Return the same, so many times as large."""
        return self._replace(a=self.a * by, b=self.b * by, across=self.across * by)


def pressed(ring: ComplexArray, line: ComplexArray, *, opens: bool) -> Pressed:
    """Return how a ring is pressed flat to as many points of a line, or how these open to it."""
    end = line[np.abs(line - line[0]).argmax()]
    chord = complex(line[np.abs(line - end).argmax()] - end)
    way = chord / abs(chord) if chord else 1.0 + 0j
    beside = (ring * way.conjugate()).imag
    across = 1j * way * (beside - (beside.max() + beside.min()) / 2.0)
    return Pressed(line, ring, across, opens) if opens else Pressed(ring, line, across)


class Turning(NamedTuple):
    """A polyline whose edges change their lengths and angles evenly, about its own middle, which moves straight.

    `lengths`, of A and B, and `angles`, A's and by how much they change, in radians, are those of the edges.
    """

    a: ComplexArray
    b: ComplexArray
    lengths: tuple[np.ndarray, np.ndarray]
    angles: tuple[np.ndarray, np.ndarray]

    def points(self, t: float) -> ComplexArray:
        """Return the points at a time."""
        sizes = (1.0 - t) * self.lengths[0] + t * self.lengths[1]
        edges = sizes * np.exp(1j * (self.angles[0] + t * self.angles[1]))
        shape = np.append(0.0, np.cumsum(edges))
        middles = [
            np.average((each[1:] + each[:-1]) / 2.0, weights=sizes + 1e-9) for each in (shape, self.a, self.b)
        ]
        return shape - middles[0] + (1.0 - t) * middles[1] + t * middles[2]

    def scaled(self, by: float) -> Turning:
        """Return the same, so many times as large."""
        lengths = self.lengths[0] * by, self.lengths[1] * by
        return Turning(self.a * by, self.b * by, lengths, self.angles)


class Drawing(NamedTuple):
    """A polyline that is drawn on from its first point, or back towards it.

    `begin` and `until` are shares of the length that are drawn at the start and at the end; both ends of the line are
    drawn back if it is drawn `from_middle`. It is drawn in a `span` of the time.
    """

    line: ComplexArray
    begin: float
    until: float
    from_middle: bool = False
    span: tuple[float, float] = (0.0, 1.0)

    def points(self, t: float) -> ComplexArray:
        """Return the points at a time; those that are not drawn lie at the end of those that are."""
        along = cumulative_lengths(self.line)
        whole = along[-1]
        low, high = self.part(t)
        return points_at(np.clip(along, low * whole, high * whole), self.line, along)

    def part(self, t: float) -> tuple[float, float]:
        """Return the shares of the length between which the line is drawn at a time."""
        t = min(max((t - self.span[0]) / (self.span[1] - self.span[0]), 0.0), 1.0)
        share = (1.0 - t) * self.begin + t * self.until
        return (0.5 - share / 2.0, 0.5 + share / 2.0) if self.from_middle else (0.0, share)

    def scaled(self, by: float) -> Drawing:
        """Return the same, so many times as large."""
        return self._replace(line=self.line * by)


class Exchange(NamedTuple):
    """A polyline that is drawn back until half time, and then another one that is drawn on from the same place."""

    a: ComplexArray
    b: ComplexArray

    def points(self, t: float) -> ComplexArray:
        """Return the points at a time, those of both lines."""
        back, on = Drawing(self.a, 1.0, -1.0), Drawing(self.b, -1.0, 1.0)
        first = back.points(t) if t < 0.5 else np.repeat((1.0 - t) * self.a[:1] + t * self.b[:1], len(self.a))
        last = on.points(t) if t > 0.5 else np.repeat((1.0 - t) * self.a[:1] + t * self.b[:1], len(self.b))
        # The one that is drawn comes last.
        return np.concatenate([last, first]) if t < 0.5 else np.concatenate([first, last])

    def scaled(self, by: float) -> Exchange:
        """Return the same, so many times as large."""
        return Exchange(self.a * by, self.b * by)


class TurnedLine(NamedTuple):
    """A polyline of a drawing that is turned or flipped as a whole.

    It turns by `angle`, in radians, about `centre`, which moves on to `target`; or it is flipped across the direction
    `axis`, a unit vector, about these. What is then `left` of the way to the other drawing is gone evenly. Half way it
    is smaller by the share `dip`, and aside by `aside`, so that it stays in the picture.
    """

    a: ComplexArray
    centre: complex
    target: complex
    angle: float = 0.0
    axis: complex = 0j
    left: ComplexArray | float = 0.0
    dip: float = 0.0
    aside: complex = 0j

    def points(self, t: float) -> ComplexArray:
        """Return the points at a time."""
        offsets = (self.a - self.centre) * (1.0 - self.dip * math.sin(math.pi * t))
        if self.axis:
            across = offsets * self.axis.conjugate()
            offsets = (across.real + 1j * turned_over(t) * across.imag) * self.axis
        return self.middle(t) + offsets * np.exp(1j * self.angle * t) + t * self.left

    def middle(self, t: float) -> complex:
        """Return where the centre is at a time."""
        return (1.0 - t) * self.centre + t * self.target + self.aside * math.sin(math.pi * t)

    def scaled(self, by: float) -> TurnedLine:
        """Return the same, so many times as large."""
        centre, target = self.centre * by, self.target * by
        aside = self.aside * by
        return self._replace(a=self.a * by, centre=centre, target=target, left=self.left * by, aside=aside)


class Sliding(NamedTuple):
    """A stretch that slides along a path, from the pair of lengths `start` to `end`, with the vertices of the path.

    The path itself goes from `a` to `b`. Vertices beyond the ends are spread over the first and the last edge: edges
    without length have no caps.
    """

    a: ComplexArray
    b: ComplexArray
    start: tuple[float, float]
    end: tuple[float, float]

    def points(self, t: float) -> ComplexArray:
        """Return the points at a time."""
        path = (1.0 - t) * self.a + t * self.b
        lengths = cumulative_lengths(path)
        low, high = ((1.0 - t) * p + t * q for p, q in zip(self.start, self.end, strict=True))
        least = SHORTEST * lengths[-1]
        inside = (lengths > low + least) & (lengths < high - least)
        before = int(np.count_nonzero(lengths <= low + least))
        after = len(lengths) - before - int(np.count_nonzero(inside))
        first, last = (lengths[inside][0], lengths[inside][-1]) if inside.any() else (0.5 * (low + high),) * 2
        starts = low + (first - low) * np.arange(before) / max(before, 1)
        stops = last + (high - last) * np.arange(1, after + 1) / max(after, 1)
        return points_at(np.concatenate([starts, lengths[inside], stops]), path, lengths)

    def scaled(self, by: float) -> Sliding:
        """Return the same, so many times as large."""
        (low, high), (there, until) = self.start, self.end
        return Sliding(self.a * by, self.b * by, (low * by, high * by), (there * by, until * by))


class Riding(NamedTuple):
    """A polyline that is carried along by a place of another line, on whose edge it lies at a time.

    `span` is the time of its own start and end in that of the carrier.
    """

    own: Moving
    carrier: Moving
    edge: int
    share: float
    home: float
    span: tuple[float, float] = (0.0, 1.0)

    def _place(self, t: float) -> complex:
        points = self.carrier.points(t)
        return complex((1.0 - self.share) * points[self.edge] + self.share * points[self.edge + 1])

    def points(self, t: float) -> ComplexArray:
        """Return the points at a time."""
        time = (1.0 - t) * self.span[0] + t * self.span[1]
        return self.own.points(t) + (self._place(time) - self._place(self.home))

    def scaled(self, by: float) -> Riding:
        """Return the same, so many times as large."""
        return self._replace(own=self.own.scaled(by), carrier=self.carrier.scaled(by))


def between(a: ComplexArray, b: ComplexArray, *, closed: bool = False, always: bool = False) -> Moving:
    """Return how a polyline becomes another with as many points: straight, or it turns as it goes.

    It turns if it would shrink else, or `always`, but for where it would reach far across the drawing.
    """
    sizes = [float(np.abs(np.diff(each)).sum()) for each in (a, b, (a + b) / 2.0)]
    if closed or (sizes[2] >= BENDS * min(sizes[:2]) and not always):
        return Straight(a, b)
    edges_a, edges_b = np.diff(a), np.diff(b)
    seen = (np.abs(edges_a) > 1e-9) & (np.abs(edges_b) > 1e-9)
    if not seen.any():
        return Straight(a, b)
    lengths = np.abs(edges_a), np.abs(edges_b)
    # Each corner opens or closes on its own side: none folds up to pass through its own back.
    first, last = edges_a[seen], edges_b[seen]
    bends = np.angle(last[1:] / last[:-1]) - np.angle(first[1:] / first[:-1])
    own = np.angle(last[0] / first[0]) + np.append(0.0, np.cumsum(bends))
    turns = np.interp(np.arange(len(edges_a)), np.flatnonzero(seen), own)
    whole = float(np.average(turns, weights=lengths[0] + lengths[1]))
    turns -= 2.0 * np.pi * np.round(whole / (2.0 * np.pi))
    whole = (whole + np.pi) % (2.0 * np.pi) - np.pi
    if not always and abs(whole) < TURNS_OVER and sizes[2] >= FLATTENS * min(sizes[:2]):
        return Straight(a, b)  # it turns over in place, through a straight line
    angles = np.where(np.abs(edges_a) > 1e-9, np.angle(edges_a), np.angle(edges_b))
    turning = Turning(a, b, lengths, (angles, turns))
    # A line with many corners, such as a book, would unroll far across the drawing.
    middle = np.concatenate([a, b]).mean()
    reach = max(np.abs(each - middle).max() for each in (a, b))
    far = max(np.abs(turning.points(t) - middle).max() for t in (0.25, 0.5, 0.75))
    return turning if far <= FARTHEST * reach else Straight(a, b)


class Pen(NamedTuple):
    """A line whose pieces move one after the other, and the tails at its beginning and its end, outwards from there."""

    pieces: tuple[Moving, ...]
    tails: tuple[Moving | None, Moving | None] = (None, None)
    closed: bool = False
    shift: complex = 0j  # of the drawing as a whole, beside all else
    turn: tuple[float, float] = (0.0, 0.0)  # of the drawing as a whole, at its start and end, in radians
    pivot: complex = 0j

    @property
    def name(self) -> str:
        """No motion that can be asked for."""
        return "pen"

    def points(self, t: float) -> ComplexArray:
        """Return the vertices at a time, always as many."""
        points = self._unturned(t)
        if self.turn == (0.0, 0.0):
            return points
        angle = (1.0 - t) * self.turn[0] + t * self.turn[1]
        return self.pivot + (points - self.pivot) * np.exp(1j * angle)

    def _unturned(self, t: float) -> ComplexArray:
        points = np.concatenate([piece.points(t) for piece in self.pieces]) + t * self.shift
        if self.closed:
            return points[:-1]
        for side, tail in enumerate(self.tails):
            if tail is not None:
                moved = tail.points(t)
                moved = moved - moved[0] + points[-1 if side else 0]
                points = np.concatenate([points, moved] if side else [moved[::-1], points])
        return points

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of its one contour at time t."""
        return [cubics.lines(self.points(t), self.closed)]

    def scaled(self, by: float) -> Pen:
        """Return the same, so many times as large."""
        tails = [None if tail is None else tail.scaled(by) for tail in self.tails]
        pieces = tuple(piece.scaled(by) for piece in self.pieces)
        return Pen(pieces, (tails[0], tails[1]), self.closed, self.shift * by, self.turn, self.pivot * by)


class Together(NamedTuple):
    """Several lines that are painted together, so that a transparent pen does not show where they cross."""

    pens: tuple[Motion | None, ...]  # None for a line that moves straight
    spans: tuple[tuple[float, float], ...]  # the times of the start and the end of each

    @property
    def name(self) -> str:
        """No motion that can be asked for."""
        return "pen"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        found = []
        for contour, pen, (begin, until) in zip(contours, self.pens, self.spans, strict=True):
            own = min(max((t - begin) / (until - begin), 0.0), 1.0)
            found += [contour.straight(own)] if pen is None else pen.segments([contour], own)
        return found
