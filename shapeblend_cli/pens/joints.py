"""Strokes as a pen would draw them: pieces that go on from each other are one line, however the file cuts them."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polyline import cumulative_lengths
from shapeblend_cli.pens.line import at, length

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray
    from shapeblend_cli.pens.line import PenLine

TOUCHES = 0.06
"""Maximum distance of two ends that meet, in widths."""

GOES_ON = np.radians(25.0)
"""Maximum turn from one line to another that goes on from it, in radians, with any caps."""

MOST_TURN = np.radians(110.0)
"""Maximum turn of a corner that two lines make, in radians, where caps and joins look alike."""

SHARP = np.radians(100.0)
"""Minimum turn of a corner at which a line is cut where others end, in radians: an arrow's shaft and half its head."""

REACH = 0.4
"""Length at the end of a line that gives its direction, in units."""


class _End(NamedTuple):
    """An end of an open line: whose, which, where, and the direction out of it."""

    line: int
    side: int
    place: complex
    direction: complex


def joined(lines: Sequence[PenLine]) -> list[PenLine]:
    """Join the ends of lines that go on from each other: the least turn first."""
    pieces = [piece for line in lines for piece in _cut_at_tips(line, lines)]
    ends = [
        _End(k, side, *_ending(line.points if side else line.points[::-1]))
        for k, line in enumerate(pieces)
        if not line.closed and line.length > REACH and line.style.stroke_opacity == 1.0
        if not line.style.stroke_dasharray
        for side in (0, 1)
    ]
    turns = []
    for i, a in enumerate(ends):
        for j in range(i + 1, len(ends)):
            b = ends[j]
            p, q = pieces[a.line], pieces[b.line]
            if abs(a.place - b.place) > TOUCHES * p.width or not _is_alike(p, q):
                continue
            turn = abs(float(np.angle(-b.direction / a.direction)))
            if turn <= (MOST_TURN if _is_round(p) else GOES_ON):
                turns.append((turn, i, j))
    partner: dict[int, int] = {}
    for _, i, j in sorted(turns):
        if i not in partner and j not in partner:
            partner[i], partner[j] = j, i
    return _strung(pieces, ends, partner) if partner else list(lines)


def _is_alike(p: PenLine, q: PenLine) -> bool:
    """Return whether two lines are drawn with the same pen."""
    return p.style == q.style and abs(p.width - q.width) < 1e-3 * p.width


def _is_round(line: PenLine) -> bool:
    return line.style.stroke_linecap == line.style.stroke_linejoin == "round"


def _ending(points: ComplexArray) -> tuple[complex, complex]:
    """Return where a polyline ends, and in which direction."""
    whole = length(points)
    back = at(points, [max(0.0, whole - REACH)])[0]
    return complex(points[-1]), complex((points[-1] - back) / max(abs(points[-1] - back), 1e-12))


def _cut_at_tips(line: PenLine, lines: Sequence[PenLine]) -> list[PenLine]:
    """Cut a line at sharp corners where others end."""
    if line.closed or not _is_round(line) or len(line.points) < 3:
        return [line]
    edges = np.diff(line.points)
    turns = np.abs(np.angle(edges[1:] / edges[:-1]))
    others = [other for other in lines if other is not line and not other.closed and _is_alike(other, line)]
    tips = [end for other in others for end in other.points[[0, -1]]]
    cuts = [
        k
        for k in (np.flatnonzero(turns > SHARP) + 1).tolist()
        if any(abs(tip - line.points[k]) < TOUCHES * line.width for tip in tips)
    ]
    places = [0, *cuts, len(line.points) - 1]
    return [line._replace(points=line.points[i : j + 1]) for i, j in pairwise(places)]


def _strung(pieces: Sequence[PenLine], ends: Sequence[_End], partner: dict[int, int]) -> list[PenLine]:
    """String joined pieces up to lines, each with the paint and number of its longest piece."""
    number = {(end.line, end.side): k for k, end in enumerate(ends)}
    done: set[int] = set()
    lines = []
    for k, piece in enumerate(pieces):
        if k in done:
            continue
        here, side, seen = k, 0, {k}
        while (end := number.get((here, side))) in partner:  # back to where the line begins
            other = ends[partner[end]]
            if other.line in seen:
                break
            here, side = other.line, 1 - other.side
            seen.add(here)
        first, points, longest, closed = here, [], piece, False
        while True:
            done.add(here)
            own = pieces[here]
            longest = max(longest, own, key=lambda each: each.length)
            points.append(own.points[::-1] if side else own.points)
            end = number.get((here, 1 - side))
            if end not in partner:
                break
            other = ends[partner[end]]
            if other.line in done:
                closed = other.line == first
                break
            here, side = other.line, other.side
        every = np.concatenate(points)
        every = (
            every[np.append(True, np.diff(cumulative_lengths(every)) > 0.02)] if len(points) > 1 else every
        )
        if closed:
            every = every[:-1] if abs(every[-1] - every[0]) < 0.02 else every
        lines.append(longest._replace(points=every, closed=closed or piece.closed))
    return lines
