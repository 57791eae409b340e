"""Lines as a pen would draw them, however the file cuts them.

Strokes that go on from each other are one line. A solid shape that lies on a line of the other drawing, as where a
slash cuts it, is a piece of that line, though its slanting ends are no caps.
"""

from __future__ import annotations

from collections import Counter
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polyline import cumulative_lengths, nearest_edges
from shapeblend_cli.pens.line import End, PenLine, at, chains, ends_near, foot_points, length

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.model import ComplexArray
    from shapeblend_cli.pens.line import PenDrawing

TOUCHES = 0.06
"""Maximum distance of two ends that meet, in widths."""

GOES_ON = np.radians(25.0)
"""Maximum turn from one line to another that goes on from it, in radians, with any caps."""

MOST_TURN = np.radians(110.0)
"""Maximum turn of a corner that two lines make, in radians, where caps and joins look alike."""

OFF = 0.03
"""Maximum distance that a solid shape sticks out of the line that it is a piece of, in widths."""

SLANTED = 0.5
"""Minimum share of a piece of a line that a solid shape fills: its ends may slant."""

BOW = 0.7
"""Maximum distance of the ends of a bow, as a share of its length."""

MOST_BOW = 32.0
"""Maximum length of a bow, in units: a longer one is a body."""

REACH = 0.4
"""Length at the end of a line that gives its direction, in units."""


def joined(lines: Sequence[PenLine]) -> list[PenLine]:
    """Join the ends of lines that go on from each other: the least turn first."""
    cut = [_cut_at_tips(line, lines) for line in lines]
    pieces = [piece for every in cut for piece in every]
    origin = [k for k, every in enumerate(cut) for _ in every]
    ends = [
        End(k, side, *_ending(line.points if side else line.points[::-1]))
        for k, line in enumerate(pieces)
        if not line.closed and line.length > REACH and line.style.stroke_opacity == 1.0
        if not line.style.stroke_dasharray
        for side in (0, 1)
    ]
    turns = []
    reaches = [TOUCHES * pieces[end.piece].width for end in ends]
    for i, j in ends_near(ends, reaches):
        a, b = ends[i], ends[j]
        p, q = pieces[a.piece], pieces[b.piece]
        if not _is_alike(p, q):
            continue
        turn = abs(float(np.angle(-b.direction / a.direction)))
        if turn <= (MOST_TURN if _is_round(p) else GOES_ON):
            turns.append((turn, i, j))
        elif origin[a.piece] == origin[b.piece] and len(cut[origin[a.piece]]) > 1:
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


def _strung(pieces: Sequence[PenLine], ends: Sequence[End], partner: dict[int, int]) -> list[PenLine]:
    """String joined pieces up to lines, each with the paint and number of its longest piece."""
    joined = {(ends[i].piece, ends[i].side): (ends[j].piece, ends[j].side) for i, j in partner.items()}
    lines = []
    for chain, closed in chains(len(pieces), joined):
        longest = max((pieces[k] for k, _ in sorted(chain)), key=lambda each: each.length)
        names = dict.fromkeys(name for k, _ in chain for name in pieces[k].name.split("+"))
        points = [pieces[k].points[::-1] if side else pieces[k].points for k, side in chain]
        every = np.concatenate(points)
        every = (
            every[np.append(True, np.diff(cumulative_lengths(every)) > 0.02)] if len(points) > 1 else every
        )
        if closed:
            every = every[:-1] if abs(every[-1] - every[0]) < 0.02 else every
        lines.append(longest._replace(points=every, closed=closed or longest.closed, name="+".join(names)))
    seen: Counter[str] = Counter()
    for k, line in enumerate(lines):  # of a line that was cut, the pieces have names of their own
        seen[line.name] += 1
        if seen[line.name] > 1:
            lines[k] = line._replace(name=f"{line.name}.{seen[line.name]}")
    return lines


def with_pieces(one: PenDrawing, other: PenDrawing, scale: float) -> PenDrawing:
    """Return a drawing whose solid shapes are lines where these lie on lines of the other drawing."""
    ringed = {body.exterior for body in one.bodies if body.exterior is not None}
    lines, bodies = [], []
    for body in one.bodies:
        style = body.style
        is_plain = style.stroke is None and style.fill_gradient is None and body.exterior is None
        is_plain = is_plain and style.fill is not None and body.number not in ringed and body.contour.closed
        found = (_piece(body, line, scale) for line in other.lines) if is_plain else ()
        piece = next((each for each in found if each is not None), None)
        if piece is None:
            bodies.append(body)
        else:
            lines.append(piece)
    if not lines:
        return one
    left = sum(body.area for body in bodies) / max(sum(body.area for body in one.bodies), 1e-12)
    return one._replace(
        lines=[*one.lines, *lines], bodies=bodies, share=1.0 - (1.0 - one.share) * left, is_recovered=True
    )


def _piece(body: PlacedContour, line: PenLine, scale: float) -> PenLine | None:
    """Return the piece of a line on which a solid shape lies, if it does."""
    points, width, whole = body.polygon.vertices * scale, line.width, line.length
    if len(line.points) < 2:
        return None
    away, feet, _ = foot_points(points, line.outline)
    if away.max() > (0.5 + OFF) * width:
        return None
    begin, span = 0.0, float(np.ptp(feet))
    if line.closed:  # from where no point has its foot
        rising = np.sort(feet)
        gaps = np.diff(np.append(rising, rising[0] + whole))
        begin, span = float(rising[(int(gaps.argmax()) + 1) % len(rising)]), whole - float(gaps.max())
    else:
        begin = float(feet.min())
    area = body.area * scale**2
    if not SLANTED * width * span < area < width * (span + width):
        return None
    # Ends that slant are cut where they leave as much area; those of the line stay.
    is_round = line.style.stroke_linecap == "round"
    free = [line.closed or begin > 0.1 * width, line.closed or begin + span < whole - 0.1 * width]
    cut = (span - (area / width - (np.pi / 4.0 * width if is_round else 0.0))) / max(sum(free), 1)
    low, high = begin + cut * free[0], begin + span - cut * free[1]
    if high - low < 0.1 * width:
        return None
    style = line.style._replace(stroke=body.style.fill, stroke_opacity=body.style.fill_opacity)
    # A ring as wide as its radius, or wider, is a disc.
    is_whole = line.closed and high - low > whole - 0.1 * width
    if line.closed:
        low, high = low % whole, high % whole
    return PenLine(
        line.points if is_whole else line.part(low, high),
        closed=is_whole,
        style=style,
        width=width,
        contour=body.number,
        shape=body.shape,
        name=str(body.number),
    )


def with_bows(lines: Sequence[PenLine]) -> list[PenLine]:
    """Tell which lines are bows: bent, with both ends on other lines."""
    edges = [(line.outline[:-1], line.outline[1:]) for line in lines]
    found = []
    for k, line in enumerate(lines):
        others = [each for j, each in enumerate(edges) if j != k and len(each[0])]
        feet = line.points[[0, -1]]
        is_bent = not line.closed and abs(feet[1] - feet[0]) < BOW * line.length
        if others and is_bent and line.length < MOST_BOW:
            starts, ends = (np.concatenate(each) for each in zip(*others, strict=True))
            away, _, _ = nearest_edges(feet, starts, ends)
            line = line._replace(is_bow=bool(away.max() < line.reach))
        found.append(line)
    return found
