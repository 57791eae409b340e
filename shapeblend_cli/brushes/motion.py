"""Motion of brush strokes: their centre lines move as pen lines do, and their outlines beside these.

Each outline runs along the right side of its stroke, around its end, back along the left side, and around its
beginning. Its places are known as offsets from vertices of the centre line, in the direction of that.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.brushes.sides import tangents
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polyline import cumulative_lengths, needed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, ContourBlend, FloatArray
    from shapeblend_cli.motion.pen import Moving

FADES = 0.3
"""Time in which what is added to strokes where they meet is gone, as a share."""

THINS = 0.5
"""Length of a stroke below which it is thinner, as a share of its whole length."""

DOT = 0.8
"""Maximum length of the centre line of a dot, in widths."""

WATCHED = 0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0
"""Times at which outlines are thinned."""

EXACT = 0.012
"""Tolerance of outlines at both ends, in units: a quarter of a pixel where 24 units are 512."""

ROUGH = 0.03
"""Tolerance of outlines on the way, in units."""

MOST_UNFOLDED = 4
"""Maximum number of times that a side is looked through for folds."""


def is_dot(length: float, width: float) -> bool:
    """Return whether a stroke is so short that it comes and goes as a dot."""
    return length < DOT * width


class Offsets(NamedTuple):
    """The outline of a stroke beside the vertices of its centre line.

    Attributes
    ----------
    right, left : (k,) complex
    begin, end : (m,) complex, (n,) complex
        Caps, beside the first and the last vertex.
    added : ((k,) complex, (k,) complex)
        What is added to the right and to the left where strokes meet.
    """

    right: ComplexArray
    end: ComplexArray
    left: ComplexArray
    begin: ComplexArray
    added: tuple[ComplexArray, ComplexArray]

    def scaled(self, by: float) -> Offsets:
        """Return the same, so many times as large."""
        added = self.added[0] * by, self.added[1] * by
        return Offsets(self.right * by, self.end * by, self.left * by, self.begin * by, added)


class Rest(NamedTuple):
    """A vertex of another stroke's centre line on which a stroke rests."""

    stroke: int
    vertex: int


class Becoming(NamedTuple):
    """A stroke that becomes another.

    `rests` has for its beginning and its end on what these rest in A and in B.
    """

    middle: Moving
    a: Offsets
    b: Offsets
    rests: tuple[tuple[Rest | None, Rest | None], tuple[Rest | None, Rest | None]] = ((None, None),) * 2

    def outline(self, centre: ComplexArray, t: float) -> ComplexArray:
        """Return the outline about a centre line."""
        right, end, left, begin = ((1.0 - t) * p + t * q for p, q in zip(self.a[:4], self.b[:4], strict=True))
        for own, share in ((self.a, 1.0 - t / FADES), (self.b, 1.0 - (1.0 - t) / FADES)):
            if share > 0.0:
                right, left = right + share * own.added[0], left + share * own.added[1]
        return _outline(centre, tangents(centre), (right, end, left, begin))

    def scaled(self, by: float) -> Becoming:
        """Return the same, so many times as large."""
        return self._replace(middle=self.middle.scaled(by), a=self.a.scaled(by), b=self.b.scaled(by))


class Alone(NamedTuple):
    """A stroke that is drawn back to a place on it, or on from there.

    Attributes
    ----------
    line : (k,) complex
        Its centre line.
    offsets : Offsets
    place : float
        The place on the line, from 0 to 1.
    is_new : bool
        Whether it is drawn on.
    rest : Rest or None
        On what the place rests.
    span : (float, float)
        The times at which it begins to be drawn and is done.
    """

    line: ComplexArray
    offsets: Offsets
    place: float
    is_new: bool
    rest: Rest | None = None
    span: tuple[float, float] = (0.0, 1.0)

    def centre(self, shift: complex) -> ComplexArray:
        """Return all of the centre line while what it rests on has moved; its far end waits, or is where it ends."""
        along = cumulative_lengths(self.line)
        away = np.abs(along / max(float(along[-1]), 1e-9) - self.place)
        return self.line + shift * (1.0 - away / max(self.place, 1.0 - self.place))

    def outline(self, shift: complex, t: float) -> ComplexArray:
        """Return the outline of what is drawn."""
        begin, until = self.span
        t = min(max((t - begin) / (until - begin), 0.0), 1.0)
        share = t if self.is_new else 1.0 - t
        along = cumulative_lengths(self.line)
        sizes = np.abs(self.offsets.right - self.offsets.left)
        centre, ways = self.centre(shift), tangents(self.line)
        if is_dot(float(along[-1]), float(sizes.mean())):
            middle = complex(np.interp(self.place * along[-1], along, centre))
            parts = [share * part for part in self.offsets[:4]]
            return _outline(middle + share * (centre - middle), ways, parts)
        low = self.place * (1.0 - share) * along[-1]
        high = (self.place + (1.0 - self.place) * share) * along[-1]
        places = np.clip(along, low, high)

        def there(values: ComplexArray) -> ComplexArray:
            return np.asarray(np.interp(places, along, values))

        own, thin = max(0.0, 1.0 - (1.0 - share) / FADES), min(1.0, share / THINS)
        right, left = (
            thin * there(side + own * added)
            for side, added in zip((self.offsets.right, self.offsets.left), self.offsets.added, strict=True)
        )
        ways = there(ways)
        ways /= np.maximum(np.abs(ways), 1e-9)
        size = thin * np.interp(places, along, sizes) / np.maximum(sizes, 1e-9)
        end = _cap(right[-1], left[-1], size[-1] * self.offsets.end, own)
        start = _cap(left[0], right[0], size[0] * self.offsets.begin, own)
        return _outline(there(centre), ways, (right, end, left, start))

    def scaled(self, by: float) -> Alone:
        """Return the same, so many times as large."""
        return self._replace(line=self.line * by, offsets=self.offsets.scaled(by))


class Brushes(NamedTuple):
    """All strokes of a drawing; those that rest on others come after them, if they are alone.

    `kept` says which vertices of their outlines are, all if it is empty.
    """

    strokes: tuple[Becoming | Alone, ...]
    kept: tuple[BoolArray, ...] = ()

    @property
    def name(self) -> str:
        """No motion that can be asked for."""
        return "brush"

    def outlines(self, t: float) -> list[ComplexArray]:
        """Return the outlines of all strokes at a time."""
        lines: list[
            tuple[ComplexArray, ComplexArray, ComplexArray]
        ] = []  # at the start, at the time, at the end
        shifts: list[complex] = []
        for stroke in self.strokes:
            shift = 0j
            if isinstance(stroke, Becoming):
                middle = stroke.middle
                lines.append((middle.points(0.0), middle.points(t), middle.points(1.0)))
            else:
                if stroke.rest is not None:
                    shift = _shift(lines[stroke.rest.stroke], stroke.rest.vertex, 2 if stroke.is_new else 0)
                lines.append((stroke.line, stroke.centre(shift), stroke.line))
            shifts.append(shift)
        outlines = [
            stroke.outline(_resting(stroke, own, lines, t), t)
            if isinstance(stroke, Becoming)
            else stroke.outline(shift, t)
            for stroke, own, shift in zip(self.strokes, lines, shifts, strict=True)
        ]
        if not self.kept:
            return outlines
        return [outline[kept] for outline, kept in zip(outlines, self.kept, strict=True)]

    def thinned(self) -> Brushes:
        """Return the same, in units, without the vertices that are needed at no time."""
        times = [self.outlines(t) for t in WATCHED]
        kept = [
            np.any(
                [
                    needed(outline, EXACT if t in (0.0, 1.0) else ROUGH)
                    for t, outline in zip(WATCHED, own, strict=True)
                ],
                axis=0,
            )
            for own in zip(*times, strict=True)
        ]
        return self._replace(kept=tuple(kept))

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each stroke at a time."""
        return [cubics.lines(outline, True) for outline in self.outlines(t)]

    def scaled(self, by: float) -> Brushes:
        """Return the same, so many times as large."""
        return self._replace(strokes=tuple(stroke.scaled(by) for stroke in self.strokes))


Line = tuple["ComplexArray", "ComplexArray", "ComplexArray"]


def _shift(line: Line, vertex: int, end: int) -> complex:
    """Return how far a vertex of a line is from where it is at an end: 0 for the start, 2 for the end."""
    return complex(line[1][vertex] - line[end][vertex])


def _resting(stroke: Becoming, own: Line, lines: Sequence[Line], t: float) -> ComplexArray:
    """Return the centre line of a stroke whose ends stay on what they rest on."""
    centre = own[1]
    for vertex, rests in zip((0, -1), stroke.rests, strict=True):
        off = 0j
        for rest, end, weight in zip(rests, (0, 2), (1.0 - t, t), strict=True):
            if rest is not None:
                off += weight * (_shift(lines[rest.stroke], rest.vertex, end) - _shift(own, vertex, end))
        share: FloatArray = np.linspace(1.0, 0.0, len(centre))
        centre = centre + off * (share[::-1] if vertex else share)
    return centre


def _outline(centre: ComplexArray, ways: ComplexArray, parts: Sequence[ComplexArray]) -> ComplexArray:
    """Return an outline from its offsets: right, end, left and beginning."""
    right, end, left, begin = parts
    sides = [_unfolded(centre + ways * each, ways) for each in (right, left)]
    around = centre[-1] + ways[-1] * end, centre[0] + ways[0] * begin
    return np.concatenate([sides[0], around[0], sides[1][::-1], around[1]])


def _unfolded(side: ComplexArray, ways: ComplexArray) -> ComplexArray:
    """Return one side of a stroke, in one point where it would run back on the inside of a sharp bend."""
    is_back = ((side[1:] - side[:-1]) * ways[1:].conj()).real < 0.0
    for _ in range(MOST_UNFOLDED):
        if not is_back.any():
            break
        padded = np.zeros(len(side) + 1, np.bool_)
        padded[1:-1] = is_back
        bounds = np.flatnonzero(padded[1:] != padded[:-1])
        counts = bounds[1::2] - bounds[::2] + 1
        inside = np.flatnonzero(padded[1:] | padded[:-1])
        number = np.repeat(np.arange(len(counts)), counts)
        # With a 0 before each run, it is added up as it would be alone, to the last bit.
        runs = np.zeros(len(inside) + len(counts), np.complex128)
        runs[np.arange(1, len(inside) + 1) + number] = side[inside]
        means = np.add.reduceat(runs, np.cumsum(counts + 1) - counts - 1) / counts
        side = side.copy()
        side[inside] = means[number]
        new = ((side[1:] - side[:-1]) * ways[1:].conj()).real < -1e-9
        is_back = is_back | new if new.any() else new
    return side


def _cap(first: complex, last: complex, cap: ComplexArray, own: float) -> ComplexArray:
    """Return a cap from one side to the other: its own by a share, and else round."""
    turn = np.exp(1j * np.pi * np.linspace(0.0, 1.0, len(cap) + 2)[1:-1])
    return own * cap + (1.0 - own) * (0.5 * (first + last) + 0.5 * (first - last) * turn)
