"""Strokes as a pen would draw them: pieces that go on from each other are one line, however the file cuts them."""

from __future__ import annotations

from collections import Counter
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
    cut = [_cut_at_tips(line, lines) for line in lines]
    pieces = [piece for every in cut for piece in every]
    origin = [k for k, every in enumerate(cut) for _ in every]
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
            elif origin[a.line] == origin[b.line] and len(cut[origin[a.line]]) > 1:
                turns.append((turn + np.pi, i, j))  # as they were, if nothing else goes on from there
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
    """Cut a line at corners where others end: an arrow's shaft and half its head are no line of their own."""
    if not _is_round(line) or len(line.points) < 3:
        return [line]
    points = line.outline
    edges = np.diff(points)
    turns = np.abs(np.angle(np.roll(edges, -1) / edges))
    others = [other for other in lines if other is not line and not other.closed and _is_alike(other, line)]
    tips = np.array([end for other in others for end in other.points[[0, -1]]])
    vertices = (np.flatnonzero(turns[: None if line.closed else -1] > GOES_ON) + 1).tolist()
    cuts = [k for k in vertices if len(tips) and np.abs(tips - points[k]).min() < TOUCHES * line.width]
    if not cuts:
        return [line]
    if line.closed:
        points = np.concatenate([points[cuts[0] : -1], points[: cuts[0] + 1]])
        cuts = [k - cuts[0] for k in cuts[1:]]
    places = [0, *cuts, len(points) - 1]
    pieces = [line._replace(points=points[i : j + 1], closed=False) for i, j in pairwise(places)]
    return [piece for piece in pieces if piece.length > TOUCHES * line.width]


def _strung(pieces: Sequence[PenLine], ends: Sequence[_End], partner: dict[int, int]) -> list[PenLine]:
    """String joined pieces up to lines, each with the paint and number of its longest piece."""
    number = {(end.line, end.side): k for k, end in enumerate(ends)}
    done: set[int] = set()
    lines = []
    for k, piece in enumerate(pieces):
        if k in done:
            continue
        here, side, known = k, 0, {k}
        while (end := number.get((here, side))) in partner:  # back to where the line begins
            other = ends[partner[end]]
            if other.line in known:
                break
            here, side = other.line, 1 - other.side
            known.add(here)
        first, points, longest, closed = here, [], piece, False
        names: dict[str, None] = {}
        while True:
            done.add(here)
            own = pieces[here]
            longest = max(longest, own, key=lambda each: each.length)
            names |= dict.fromkeys(own.name.split("+"))
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
        lines.append(longest._replace(points=every, closed=closed or piece.closed, name="+".join(names)))
    seen: Counter[str] = Counter()
    for k, line in enumerate(lines):  # of a line that was cut, the pieces have names of their own
        seen[line.name] += 1
        if seen[line.name] > 1:
            lines[k] = line._replace(name=f"{line.name}.{seen[line.name]}")
    return lines
