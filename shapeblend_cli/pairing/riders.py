"""Riders: strokes that move with the edge of a fill on which they lie.

Many drawings outline a fill by a stroke on its edge, often cut into several lines. If the fill has a partner, such a
stroke needs none: it becomes the same stretch of the edge in the other drawing. Where strokes of the other drawing lie
on that stretch it takes their width; elsewhere its width becomes 0.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import EXTERIOR, LINE, PlacedContour
from shapeblend_cli.geometry.flat_contour import FlatContour
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.polyline import are_near, cumulative_lengths, nearest_numbers, nearest_places
from shapeblend_cli.model import Box, Contour, Style, unroll
from shapeblend_cli.wires.contour_blends import follow

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair
    from shapeblend_cli.model import BoolArray, ComplexArray, ContourBlend, FloatArray, IntArray

ON_EDGE = 0.5
"""Maximum distance of a stroke from the edge on which it rides, in widths of the stroke."""

COVERED = 0.25
"""Maximum distance of a stroke from another that covers it, in widths of the narrower one."""

LEAST_SHARE = 0.5
"""Minimum share of a stroke that lies on the edge on which it rides."""

SURE_SHARE = 0.9
"""Minimum share of a stroke that lies on another that covers it."""

AS_WELL = 0.95
"""Minimum share of a stroke that another one covers to cover it as well as the one that covers most."""

ONE_WAY = 0.9
"""Minimum share of a stroke's length in its main direction along the edge."""

LEAST_SECTION = 2.0
"""Minimum length of a section that is covered, or is not, in widths of the stroke."""


def riders(contours: Sequence[PlacedContour], leaders: Collection[int]) -> dict[int, int]:
    """Return the numbers of strokes that lie on the edge of a fill, each with the number of the fill.

    Only leaders, by number, are considered; of several the fill on whose edge most of the stroke lies, or the largest.
    """
    strokes = [c for c in contours if c.style.stroke is not None and c.style.fill is None]
    fills = [c for c in contours if c.number in leaders and c.style.fill is not None and c.role == EXTERIOR]
    bounds = np.array([fill.box.bounds for fill in fills]).reshape(-1, 4)
    found: dict[int, int] = {}
    for stroke in strokes:
        x, y = (part(stroke.polygon.vertices)[:, None] for part in (np.real, np.imag))
        width = stroke.style.stroke_width
        left, top, right, bottom = (bounds + [-width, -width, width, width]).T
        near = ((left <= x) & (x <= right) & (top <= y) & (y <= bottom)).mean(axis=0) >= LEAST_SHARE
        shares = []
        for k in np.flatnonzero(near).tolist():
            track = _track(stroke, fills[k].polygon.line)
            if track is not None and track.share >= LEAST_SHARE:
                shares.append((round(track.share, 1), fills[k].size, fills[k].number))
        if shares:
            found[stroke.number] = max(shares)[2]
    return found


class _Track(NamedTuple):
    """The places of a stroke's vertices along an edge."""

    share: float  # of the stroke's length on the edge
    lengths: FloatArray  # along the edge, rising or falling, one for each point of the stroke's line


def _track(stroke: PlacedContour, line: ComplexArray) -> _Track | None:
    """Return the places of a stroke on a closed edge; None if it does not run along the edge in one direction."""
    points = stroke.polygon.line
    reach = ON_EDGE * stroke.style.stroke_width
    distance, place = nearest_places(points, line)
    near = distance <= reach
    if near.sum() < 2:
        return None
    lengths = cumulative_lengths(line)
    total = float(lengths[-1])
    along = np.interp(place, np.arange(len(lengths)), lengths)[near]
    steps = (np.diff(along) + 0.5 * total) % total - 0.5 * total
    way, back = float(steps.sum()), float(np.abs(steps).sum())
    if back == 0.0 or abs(way) < ONE_WAY * back or abs(way) > (1.0 + ONE_WAY) * total:
        return None
    if stroke.polygon.closed and abs(abs(way) - total) > (1.0 - ONE_WAY) * total:
        return None
    sign = 1.0 if way > 0.0 else -1.0
    passed = np.concatenate([[0.0], np.cumsum(np.maximum(sign * steps, 0.0))])
    if stroke.polygon.closed:
        passed *= total / passed[-1]
    own = cumulative_lengths(points)
    every = np.interp(own, own[near], passed)
    share = float(np.diff(own)[near[:-1] & near[1:]].sum() / own[-1])
    return _Track(share, along[0] + sign * every)


class Ride(NamedTuple):
    """A stroke on the edge of a fill, or a piece of such a stroke."""

    contour: PlacedContour
    blend: ContourBlend
    shape: int | None  # index of the other drawing's shape that has a stroke in its place
    style: Style  # in the other drawing


def riders_of_pairs(
    sides: tuple[Sequence[PlacedContour], Sequence[PlacedContour]],
    pairs: Sequence[ContourPair],
    required: Collection[tuple[int, int]],
) -> tuple[dict[int, int], dict[int, int]]:
    """Return the strokes of both drawings that ride on paired fills, except for required pairs; see `riders`."""
    found = []
    for side, contours in enumerate(sides):
        leaders = {
            pair[side].number
            for pair in pairs
            if all(one.style.fill is not None and one.role == EXTERIOR for one in pair)
        }
        bound = {numbers[side] for numbers in required}
        free = [contour for contour in contours if contour.number in leaders or contour.number not in bound]
        found.append(riders(free, leaders))
    return found[0], found[1]


def ride(
    stroke: PlacedContour, leader: ContourBlend, here: int, there: Sequence[PlacedContour]
) -> list[Ride]:
    """Return the pieces of a stroke of A, 0, or B, 1, that rides on the edge of a matched fill.

    It is cut where strokes of the other drawing, whose contours are `there`, begin or end to cover its image. Nothing
    is returned if it does not run along the edge.
    """
    strokes = [contour for contour in there if _has_line(contour.style)]
    whole = _follow_edge(stroke, leader, here)
    if whole is None:
        return []
    near = _near(whole.points, stroke.style.stroke_width, strokes)
    sections = _sections(stroke, np.asarray(near.any(axis=0)))
    found = [_follow_edge(_piece(stroke, *section), leader, here) for section in sections]
    parts = [part for part in found if part is not None]
    rides = []
    for part in parts if parts and len(parts) == len(found) else [whole]:
        near = _near(part.points, stroke.style.stroke_width, strokes)
        if near.any(axis=0).mean() >= SURE_SHARE:
            shares = near.mean(axis=1)
            cover = strokes[int(np.flatnonzero(shares >= AS_WELL * shares.max())[-1])]  # painted last
            style = cover.style._replace(fill=None, fill_gradient=None)
            rides.append(Ride(stroke, part.blend, cover.shape, style))
        else:
            rides.append(Ride(stroke, part.blend, None, stroke.style._replace(stroke_width=0.0)))
    return rides


def _has_line(style: Style) -> bool:
    """Return whether there is a stroke that is seen as a line: not one of the paint of its fill, which it enlarges."""
    return style.stroke is not None and style.paints[0] != style.paints[1]


class _Following(NamedTuple):
    """A stroke that follows an edge, and the images of its vertices."""

    blend: ContourBlend
    points: ComplexArray


def _follow_edge(stroke: PlacedContour, leader: ContourBlend, here: int) -> _Following | None:
    """Return the blend of a stroke along the edge of a fill; None if it does not run along the edge."""
    edges = (
        FlatContour(leader.contour_a, leader.polygon_a),
        FlatContour(leader.contour_b, leader.polygon_b),
    )
    track = _track(stroke, edges[here].line)
    if track is None:
        return None
    counts = [len(flat.polygon.vertices) for flat in edges]
    dots = unroll(leader.correspondence.dots, (counts[0], counts[1]))
    known = [_lengths_at(edge, dots[:, side]) for side, edge in enumerate(edges)]
    total = edges[here].total, edges[1 - here].total
    rounds, rest = np.divmod(track.lengths - known[here][0], total[0])
    beyond = np.interp(known[here][0] + rest, known[here], known[1 - here]) + rounds * total[1]
    image = _image(edges[1 - here], beyond, stroke.polygon.closed)
    if image is None:
        return None
    flat, vertices = image
    points = flat.polygon.vertices[vertices[: len(stroke.polygon.vertices)] % len(flat.polygon.vertices)]
    return _Following(follow(stroke, flat, vertices, of_b=bool(here)), points)


def _sections(stroke: PlacedContour, covered: BoolArray) -> list[tuple[int, int]]:
    """Return the end vertices of each section of a stroke that is covered, or is not; none if it has only one kind.

    Short sections count as their neighbours. The last section of a closed stroke may pass its last vertex.
    """
    closed, count = stroke.polygon.closed, len(covered)
    lengths = cumulative_lengths(stroke.polygon.line)
    lengths = np.concatenate([lengths[:count], lengths[-1] + lengths]) if closed else lengths
    covered = covered.copy()
    while True:
        changes = np.flatnonzero(covered != np.roll(covered, 1))
        ends = (
            [*changes, changes[0] + count]
            if closed and len(changes)
            else [0, *changes[changes > 0], count - 1]
        )
        sections = [(int(first), int(last)) for first, last in pairwise(ends)]
        if len(sections) < 2:
            return []
        shortest = min(sections, key=lambda section: lengths[section[1]] - lengths[section[0]])
        if lengths[shortest[1]] - lengths[shortest[0]] >= LEAST_SECTION * stroke.style.stroke_width:
            return sections
        within = np.arange(shortest[0], shortest[1] + (0 if closed or shortest[1] < count - 1 else 1)) % count
        covered[within] = ~covered[within]


def _piece(stroke: PlacedContour, first: int, last: int) -> PlacedContour:
    outline = stroke.flat
    count = len(stroke.polygon.vertices)
    start, end = (float(outline.lengths[k % count]) for k in (first, last))
    contour = Contour(*outline.between(start, end + (outline.total if last >= count else 0.0)), closed=False)
    return stroke._replace(contour=contour, polygon=flatten(contour, last - first), role=LINE)


def _lengths_at(edge: FlatContour, positions: FloatArray) -> FloatArray:
    """Return the lengths at positions in vertices, which may be more than once round."""
    rounds, rest = np.divmod(positions, len(edge.lengths) - 1)
    return np.interp(rest, np.arange(len(edge.lengths)), edge.lengths) + rounds * edge.total


def _image(edge: FlatContour, lengths: FloatArray, closed: bool) -> tuple[FlatContour, IntArray] | None:
    """Return the stretch of an edge along some lengths, flattened, and the number of the vertex nearest to each."""
    first, last = float(lengths[0]), float(lengths[-1])
    low, high = min(first, last), max(first, last)
    if high - low <= 1e-6 * edge.total:
        return None
    start = low % edge.total
    segments, straight = edge.between(start, start + high - low)
    if last < first:
        segments, straight = segments[::-1, ::-1], straight[::-1]
    if closed:
        segments = segments.copy()
        segments[-1, 3] = segments[0, 0]
    contour = Contour(segments, straight, closed)
    polygon = flatten(contour, len(lengths))
    own = cumulative_lengths(polygon.line)
    places = np.abs(lengths - first) * (own[-1] / (high - low))
    return FlatContour(contour, polygon), np.maximum.accumulate(nearest_numbers(own, places))


def _near(points: ComplexArray, width: float, strokes: Sequence[PlacedContour]) -> BoolArray:
    """Return which points of a stroke of a width each stroke covers, (strokes, points)."""
    near = np.zeros((len(strokes), len(points)), np.bool_)
    box = Box.around(points).expanded(width)
    for k, other in enumerate(strokes):
        if box.overlaps(other.box.expanded(width)):
            reach = COVERED * min(width, other.style.stroke_width)
            near[k] = are_near(points, other.polygon.line, reach)
    return near
