"""Stretches of centre lines strung up to the lines of a pen: once, joined, and with their ends.

The centres of balls give each stretch of a stroke twice, once from each side. Each is kept once; ends that face each
other are joined, where lines cross, meet or turn a corner; and caps are found for the others.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polyline import cumulative_lengths, nearest_edges, needed
from shapeblend_cli.pens.line import UNITS, End, chains, ends_near, evenly, length, part_of
from shapeblend_cli.pens.recovery.region import Stretch, distance_ahead

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, IntArray
    from shapeblend_cli.pens.recovery.region import Region

SHORTEST = 0.3
"""Minimum length of a stretch of centre line, in widths."""

THINNED = 0.012
"""Tolerance of the polylines of centre lines, in units: a quarter of a pixel where 24 units are 512."""

WIDEST_CUT = 0.1 * UNITS
"""Maximum width of a line with a cut end and a round cap, in units: wider ones are limbs."""

COVERED = 0.25
"""Maximum distance from others of a short line that they cover, in widths."""

CUT_BACK = np.pi / 8.0
"""Length by which a line with a round cap is shorter than a line of the same area with a cut end, in widths."""

OVER = 0.03
"""Maximum distance that a round join sticks out of the region, in widths: a sharper corner is rounded."""

REACH = 3.2
"""Maximum distance of ends that are joined, in widths."""

ROUND_POINTS = 9
"""Number of points of a corner that is rounded."""


def strung_up(stretches: Sequence[Stretch], region: Region, step: float) -> list[Stretch]:
    """Return the lines of a region along stretches, which are compared at points a step apart."""
    lines = _joined(_once(stretches, step), region)
    _end(lines, region)
    lines = _seen(lines)
    for line in lines:
        _round_off(line)
        line.points = _thinned(line)
    return lines


def _edges(stretches: Sequence[Stretch]) -> tuple[ComplexArray, ComplexArray, IntArray]:
    """Return the starts and ends of the edges of stretches, and whose they are."""
    outlines = [stretch.outline for stretch in stretches]
    owner = np.repeat(np.arange(len(outlines)), [len(points) - 1 for points in outlines])
    starts, ends = ([points[part] for points in outlines] for part in (slice(-1), slice(1, None)))
    return np.concatenate(starts), np.concatenate(ends), owner


def _once(stretches: Sequence[Stretch], step: float) -> list[Stretch]:
    """Keep each stretch of centre line once, of both sides of the stroke: the longest first."""
    kept: list[Stretch] = []
    for one in sorted(stretches, key=lambda each: (not each.closed, -round(length(each.points), 3))):
        if not kept:
            kept.append(one)
            continue
        starts, ends, _ = _edges(kept)
        points = evenly(one.outline, step) if len(one.points) > 1 else one.points
        away, edge, _ = nearest_edges(points, starts, ends)
        if len(points) == 1:
            if away[0] >= 0.2 * one.width:
                kept.append(one)
            continue
        slope, way = _slopes(points), (ends - starts)[edge]
        slant = np.abs((slope * way.conj()).imag) / np.maximum(np.abs(slope) * np.abs(way), 1e-12)
        is_new = ~((away < 0.12 * one.width + 0.02) & (slant < 0.4) | (away < 0.05 * one.width))
        if one.closed:
            if is_new.mean() >= 0.5:
                kept.append(one)
            continue
        borders = np.flatnonzero(np.diff(np.concatenate([[False], is_new, [False]]).astype(np.int8)))
        for first, beyond in borders.reshape(-1, 2).tolist():
            part = points[first:beyond]
            if length(part) > SHORTEST * one.width:
                known = one.ends[0] if first == 0 else None, one.ends[1] if beyond == len(points) else None
                kept.append(Stretch(part, one.width, ends=known))
    return kept


def _slopes(points: ComplexArray) -> ComplexArray:
    """Return the mean step to and from each point of a polyline: `numpy.gradient`, sooner."""
    steps = points[1:] - points[:-1]
    return np.concatenate([steps[:1], (points[2:] - points[:-2]) / 2.0, steps[-1:]])


def _direction(points: ComplexArray, width: float) -> complex:
    """Return the direction in which a polyline ends; one that curves goes on to turn."""
    along = cumulative_lengths(points)
    whole = float(along[-1])
    back, skip = whole - min(0.8 * width, 0.8 * whole), whole - min(0.1 * width, 0.2 * whole)
    places = np.array([back, (back + skip) / 2.0, skip])
    p, q, r = np.interp(places, along, points.real) + 1j * np.interp(places, along, points.imag)
    ahead = (r - p) / abs(r - p)
    turn = float(np.angle((r - q) / (q - p))) if q not in (p, r) else 0.0
    return complex(ahead * np.exp(0.9j * turn) if abs(turn) < 0.5 else ahead)


def _joined(stretches: Sequence[Stretch], region: Region) -> list[Stretch]:
    """Join stretches whose ends face each other, or meet at a corner: the least turn first."""
    ends = [
        End(k, side, complex(one.ending(side)[-1]), _direction(one.ending(side), one.width))
        for k, one in enumerate(stretches)
        for side in (0, 1)
        if not one.closed and len(one.points) > 1 and one.ends[side] is None
    ]
    joints: list[tuple[float, int, int, list[complex]]] = []
    reach = REACH * max(one.width for one in stretches)
    for i, j in ends_near(ends, [reach] * len(ends)):
        joint = _joint(ends[i], ends[j], stretches, region)
        if joint is not None:
            joints.append((joint[0], i, j, joint[1]))
    partner: dict[int, tuple[int, list[complex]]] = {}
    for _, i, j, between in sorted(joints, key=lambda joint: joint[0]):
        if i not in partner and j not in partner:
            partner[i], partner[j] = (j, between), (i, between[::-1])
    return _strung(stretches, ends, partner)


def _joint(
    a: End, b: End, stretches: Sequence[Stretch], region: Region
) -> tuple[float, list[complex]] | None:
    """Return what joining two ends costs, and the corner between them if there is one; None if they do not fit."""
    p, q = stretches[a.piece], stretches[b.piece]
    width, gap = max(p.width, q.width), abs(b.place - a.place)
    turn = abs(float(np.angle(-b.direction / a.direction)))
    if min(p.width, q.width) < 0.8 * width or gap > REACH * width or turn > np.radians(155.0):
        return None
    if p is q and gap > 1.2 * width and length(p.points) < 3.0 * gap:
        return None
    cost = turn + 0.15 * gap / width
    if gap <= 0.25 * width:
        return cost, []
    if turn < 0.35:
        across = (b.place - a.place) / gap
        off = max(abs(np.angle(across / a.direction)), abs(np.angle(-across / b.direction)))
        return (cost, []) if off <= 0.45 and region.holds((a.place + b.place) / 2.0) else None
    slant = (a.direction.conjugate() * b.direction).imag
    if abs(slant) < 0.05:
        return None
    offset = (b.place - a.place).conjugate()
    reach = (offset * b.direction).imag / slant, (offset * a.direction).imag / slant
    if not all(-0.4 * width < each < 3.0 * width for each in reach):
        return None
    corner = a.place + reach[0] * a.direction
    near = nearest_edges(np.array([corner]), region.starts, region.ends)[0][0]
    inside = region.holds(corner) or near <= 0.08 * width
    inside = inside and region.holds((a.place + corner) / 2.0) and region.holds((b.place + corner) / 2.0)
    if not inside:
        return None
    over = width / 2.0 - near
    return cost, [corner] if over < OVER * width else _rounded(a, b, corner, over, near)


def _rounded(a: End, b: End, corner: complex, over: float, near: float) -> list[complex]:
    """Return a curve in place of a corner that is too near to the outline: outside, it is rounder than the pen."""
    ways = -a.direction, -b.direction
    half = abs(float(np.angle(ways[1] / ways[0]))) / 2.0
    # Along the axis of the corner, the outline is nearer to the middle of the curve by as much as that is inside.
    reach = 2.0 * over / max(np.cos(half), 0.1)
    p, q = corner + reach * ways[0], corner + reach * ways[1]
    t = np.linspace(0.0, 1.0, ROUND_POINTS)
    return list((1.0 - t) ** 2 * p + 2.0 * t * (1.0 - t) * corner + t**2 * q)


def _strung(
    stretches: Sequence[Stretch], ends: Sequence[End], partner: dict[int, tuple[int, list[complex]]]
) -> list[Stretch]:
    """String joined stretches up to lines."""
    sides = [(end.piece, end.side) for end in ends]
    joined = {sides[i]: sides[j] for i, (j, _) in partner.items()}
    corners = {sides[i]: np.array(between, complex) for i, (_, between) in partner.items()}
    lines = []
    for chain, closed in chains(len(stretches), joined):
        parts = [
            part
            for k, side in chain
            for part in (stretches[k].ending(1 - side), corners.get((k, 1 - side), np.zeros(0, complex)))
        ]
        (first, start), (last, end) = chain[0], chain[-1]
        known = stretches[first].ends[start], stretches[last].ends[1 - end]
        one = stretches[min(k for k, _ in chain)]
        lines.append(Stretch(np.concatenate(parts), one.width, closed or one.closed, known))
    return lines


def _end(lines: Sequence[Stretch], region: Region) -> None:
    """Draw the ends of lines that are still open on to what they run into: another line, or the outline, by a cap."""
    for number, line in enumerate(lines):
        for side in (0, 1):
            if line.closed or len(line.points) < 2 or line.ends[side] is not None:
                continue
            points = line.ending(side)
            place, width = complex(points[-1]), line.width
            ahead = _direction(points, width)
            starts, ends, owner = _edges(lines)
            edge_away = np.minimum(np.abs(starts - place), np.abs(ends - place))
            others = (owner != number) | (edge_away > 0.3 * width)
            rim = region.ahead(place, ahead)
            meets, _ = distance_ahead(place + 0.02 * width * ahead, ahead, starts[others], ends[others])
            if meets < 2.6 * width and meets < rim:
                line.ends[side], reach = "joint", meets + 0.02 * width
            else:
                line.ends[side], reach = _cap(region, place, ahead, width, rim)
            points = np.append(points, place + reach * ahead)
            line.points = points if side else points[::-1]


def _seen(lines: Sequence[Stretch]) -> list[Stretch]:
    """Return lines without the short ones that others cover, at corners rounder outside than inside."""
    found = []
    for number, line in enumerate(lines):
        if length(line.outline) < line.width and len(line.points) > 1:
            starts, ends, owner = _edges(lines)
            others = owner != number
            if (
                others.any()
                and nearest_edges(line.points, starts[others], ends[others])[0].max() < COVERED * line.width
            ):
                continue
        found.append(line)
    return found


def _round_off(line: Stretch) -> None:
    """Let a line with a round cap and a cut end have round caps at both, with the same area: strokes have one cap."""
    if line.closed or set(line.ends) != {"round", "butt"} or line.width > WIDEST_CUT:
        return
    whole = length(line.points)
    back = min(CUT_BACK * line.width, 0.9 * whole)
    low, high = (0.0, whole - back) if line.ends[1] == "butt" else (back, whole)
    line.points = part_of(line.points, False, low, high)
    line.ends = ["cut" if end == "butt" else end for end in line.ends]


def _cap(region: Region, place: complex, ahead: complex, width: float, rim: float) -> tuple[str, float]:
    """Return the cap of a line that ends ahead, and how far from here the line ends."""
    aside = [place + 0.42j * ahead * sign * width for sign in (1.0, -1.0)]
    beside = [min(region.ahead(at, ahead), 3.0 * width) if region.holds(at) else 0.0 for at in aside]
    rim, at_sides = min(rim, 3.0 * width), sum(beside) / 2.0
    if rim - at_sides > 0.11 * width:
        return "round", max(0.0, rim - width / 2.0)
    return "butt", min((rim + at_sides) / 2.0, 1.2 * width)


def _thinned(line: Stretch) -> ComplexArray:
    points = line.points
    if len(points) < 3:
        return points
    if not line.closed:
        return points[needed(points, THINNED)]
    far = int(np.abs(points - points[0]).argmax())
    halves = points[: far + 1], np.append(points[far:], points[0])
    return np.concatenate([half[needed(half, THINNED)][:-1] for half in halves])
