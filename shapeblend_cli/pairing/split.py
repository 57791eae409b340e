"""Exteriors that become several: they are cut into as many pieces as they have partners."""

from __future__ import annotations

from itertools import chain, combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import EXTERIOR, HOLE, PlacedContour
from shapeblend_cli.anatomy.rows import Row, rows_of
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.cutting import left_of, lie_inside, meet, run_of_segments, with_vertices
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.grouping import assign
from shapeblend_cli.geometry.polygons import signed_area, winding_numbers
from shapeblend_cli.geometry.polyline import are_near, nearest_places, thin
from shapeblend_cli.model import Box, Contour, Polygon
from shapeblend_cli.pairing.growth import WATCHED

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray
    from shapeblend_cli.options.settings import Settings


ENDS = 240
"""Maximum number of vertices between which cuts are tried."""

TRIES = 400
"""Maximum number of cuts, the cheapest first, that are checked for lying inside."""

AT_ONCE = 8
"""Number of these that are checked at first."""

MORE = 4
"""Number by which that is multiplied as long as none lies inside."""

LEAST_SHARE = 0.02
"""Minimum area of a piece, as a share of the whole."""

SAME_PLACE = 0.5
"""Minimum area that the box around parts has in common with the box of the whole, as a share of the larger one."""

FILLED = 0.55
"""Minimum area of all parts' boxes together, as a share of the box around them."""

MOST_SHARED = 0.15
"""Maximum area common to boxes of parts, as a share of the box around all."""

MOST_IN_ROWS = 24
"""Maximum number of exteriors of a drawing of rows."""

UPRIGHT = 0.2
"""Maximum slope of a cut that is made upright or level, as the sine of an angle."""

NOTCH = np.radians(45.0)
"""Minimum turn inwards at a notch of an outline, in radians."""

NEAR_CUT = 0.08
"""Maximum move of an end of such a cut, as a share of the number of vertices."""

AT_EDGE = 1e-3
"""Maximum distance of an edge of a piece from the outline of the whole to be part of it, as a share of the size."""

LEAST_PART = 0.12
"""Minimum area of a part's box, as a share of the box around all parts."""

LEAST_BOX = 0.04
"""The same where all parts fill their boxes, as in grids."""

BOX = 0.75
"""Minimum area of a part that fills its box, as a share of the box."""

MOST_PART = 0.57
"""Maximum area of a part's box, as a share of the box around all parts."""

MOST_LIKE = 0.6
"""Maximum area that the boxes of a part and the whole have in common, as a share of both: such a part is the whole."""

MOST_OF_ALL = 0.8
"""Minimum area of such a part, as a share of the area of all parts."""

LEAST_OF_MOVED = 0.4
"""Minimum area of a part that is the whole, moved, as a share of the whole's area."""

MOVED_OUTLINE = 0.04
"""Maximum distance of its outline from the whole's, laid over it, as a share of the size."""

MOST_NEAR = 0.9
"""Minimum share of its outline that is no further away."""

SAME_OUTLINE = 0.015
"""Maximum distance of outlines that are the same, as a share of the size."""

MOST_KEPT = 0.35
"""Minimum share of the outline of a whole that a part has, if the part is the whole but for a bite."""

MOST_INSIDE = 0.85
"""Minimum share of the vertices of such a part that lie in the whole, or on its outline."""

LEAST_KEPT = 0.15
"""Maximum share of the outline of a whole that what fills the bite has."""

AXES = (1.0 + 0.0j, 1.0j, 1.0 + 1.0j, 1.0 - 1.0j)
"""Directions along which partners are divided into two halves."""

SHARE_WEIGHT = 1.0
"""Cost of the wrong share of the area: 1 for all of it."""

LENGTH_WEIGHT = 0.3
"""Cost of a cut as long as the square root of the exterior's area."""

DIRECTION_WEIGHT = 1.5
"""Cost of pieces that lie to each other opposite to their partners."""


def split_exteriors(
    a: Sequence[PlacedContour],
    b: Sequence[PlacedContour],
    pairs: Sequence[ContourPair],
    settings: Settings,
    required: Mapping[int, int],
) -> list[ContourPair]:
    """Give exteriors without a partner a piece of the nearest exterior that has one. Return all pairs.

    Pieces have the number of the exterior that is cut. Unless ``unmatched="split"``, an exterior is cut only if its
    partner and the others tile it, see `_tiles`, and no required pair, B's numbers by A's, is cut. An exterior that no
    straight cut divides stays whole. One that is bitten, and has a sign in the bite, becomes what is left of it.
    """
    always, vertices = settings.unmatched == "split", settings.vertices
    split = list(pairs)
    for owner_side, contours in enumerate((b, a)):  # exteriors of A are cut for B's, then B's for A's
        paired = {pair[1 - owner_side].number for pair in split}
        wanting: dict[int, list[PlacedContour]] = {}
        owners = [pair for pair in split if pair[0].role == pair[1].role == EXTERIOR]
        bounds = np.array([pair[owner_side].box.bounds for pair in owners])
        for contour in contours:
            if contour.role == EXTERIOR and contour.number not in paired and owners:
                nearest = _nearest(contour, [pair[owner_side] for pair in owners], bounds)
                wanting.setdefault(nearest, []).append(contour)
        for k, partners in wanting.items():
            pair = owners[k]
            owner = pair[owner_side]
            partners = [pair[1 - owner_side], *partners]
            if not always:
                is_required = required.get(pair[0].number) == pair[1].number
                partners = [] if is_required else _tiles(partners, owner)
                bitten = _bitten(partners, owner)
                if bitten is not None:
                    split[split.index(pair)] = (bitten, owner) if owner_side else (owner, bitten)
                    continue
            if len(partners) < 2:
                continue
            sides = (b, a) if owner_side else (a, b)
            pieces = _cut(owner, partners, sides, vertices)
            if pieces:
                split.remove(pair)
                split += [(partner, piece) if owner_side else (piece, partner) for piece, partner in pieces]
    return split


def pairs_by_rows(a: Sequence[PlacedContour], b: Sequence[PlacedContour], vertices: int) -> list[ContourPair]:
    """Cut bars above or beside each other into the outlines of rows that are as wide. Return all pairs of exteriors.

    That keeps lists and grids as symmetric as they are. The first and the last bar are taken for the first and the last
    row, and others for the nearest ones; if there are more bars, the rest has no partner. There is nothing to return if
    the drawings have anything else, or one row only.
    """
    outer = [[contour for contour in side if contour.role != HOLE] for side in (a, b)]
    paints = {(contour.style.fill, contour.style.stroke) for side in outer for contour in side}
    if len(paints) > 1 or min(map(len, outer)) < 2 or max(map(len, outer)) > MOST_IN_ROWS:
        return []
    fill, stroke = paints.pop()
    if fill is None or stroke is not None:
        return []
    for owner_side in (0, 1):
        sides = (b, a) if owner_side else (a, b)
        for is_turned in (False, True):
            bars, rows = (rows_of(outer[k], is_turned=is_turned) for k in (owner_side, 1 - owner_side))
            if (
                2 <= len(rows) <= len(bars)
                and all(len(bar.contours) == 1 for bar in bars)
                and all(len(row.contours) > 1 for row in rows)
                and all(bar.is_as_wide_as(row) for bar in bars for row in rows)
            ):
                middles = (_from_first_to_last([row.middle for row in each]) for each in (bars, rows))
                away = np.abs(np.subtract.outer(*middles))
                taken = [(bars[i].contours[0], rows[j].contours) for i, j in assign(away)]
                found = [_cut(bar, row, sides, vertices) for bar, row in taken]
                if all(found):
                    pairs = [pair for pieces in found for pair in pieces]
                    return [pair[::-1] for pair in pairs] if owner_side else pairs
    return []


def _from_first_to_last(middles: Sequence[float]) -> FloatArray:
    """Return where middles lie, as shares of the way from the first to the last."""
    return (np.array(middles) - middles[0]) / (middles[-1] - middles[0])


def _cut(
    owner: PlacedContour,
    partners: Sequence[PlacedContour],
    sides: tuple[Sequence[PlacedContour], Sequence[PlacedContour]],
    vertices: int,
) -> list[ContourPair]:
    """Cut an exterior of the first side into a piece for each partner, of the other; nothing if no cut lies inside.

    Cuts go around holes. Upright and level ones go through, if the partners are a grid without holes: see
    `hole_in_piece`.
    """
    numbers = {partner.number for partner in partners}
    goes_around = _grid(partners) is None or any(contour.exterior in numbers for contour in sides[1])
    holes = [contour.polygon for contour in sides[0] if contour.exterior == owner.number]
    outline = _Outline(owner.contour, owner.polygon, holes, goes_around)
    pieces = _pieces(outline, partners, vertices) or []
    return [
        (owner._replace(contour=section, polygon=flatten(section, vertices), is_piece=True), partner)
        for section, partner in pieces
    ]


def hole_in_piece(hole: PlacedContour, piece: PlacedContour, owner: PlacedContour) -> PlacedContour | None:
    """Return the part of a hole that lies in a piece cut from its exterior, the owner; None if there is none."""
    line, size = owner.polygon.line, owner.size
    corners = piece.contour.segments[piece.contour.straight][:, [0, 3]]
    middles = corners.mean(axis=1)
    is_cut = nearest_places(middles, line)[0] > AT_EDGE * size
    part: Contour | None = hole.contour
    turn = 1 if signed_area(piece.polygon.vertices) > 0.0 else -1
    for cut in corners[is_cut & (winding_numbers(middles, owner.polygon.vertices) != 0)]:
        if part is not None:
            part = left_of(part, *cut[::turn])
    if part is None:
        return None
    return hole._replace(contour=part, polygon=flatten(part, len(hole.polygon.vertices)), is_piece=True)


def _tiles(parts: Sequence[PlacedContour], whole: PlacedContour) -> list[PlacedContour]:
    """Return the parts, without small ones, if they lie side by side and fill about the box of the whole."""
    union = Box.union([part.box for part in parts])
    are_boxes = all(part.area > BOX * part.box.area for part in parts)
    least = LEAST_BOX if are_boxes else LEAST_PART
    tiles = [part for part in parts if part.box.area > least * union.area]
    if len(tiles) < 2:
        return []
    boxes = [part.box for part in tiles]
    union = Box.union(boxes)
    most = MOST_OF_ALL * sum(tile.area for tile in tiles)
    fit = (
        len({part.style.fill for part in tiles}) == 1
        and None not in (tiles[0].style.fill, whole.style.fill)
        and {tile.style.stroke for tile in (*tiles, whole)} == {None}  # a stroke would show where it is cut
        and union.intersection(whole.box) > SAME_PLACE * max(union.area, whole.box.area)
        and sum(box.area for box in boxes) > FILLED * union.area
        and max(box.area for box in boxes) < MOST_PART * union.area
        and not any(tile.area > most and _is_like(tile.box, whole.box) for tile in tiles)
        and not any(_has_moved(tile, whole) for tile in tiles)
        and sum(p.intersection(q) for p, q in combinations(boxes, 2)) < MOST_SHARED * union.area
    )
    return tiles if fit else []


def _bitten(parts: Sequence[PlacedContour], whole: PlacedContour) -> PlacedContour | None:
    """Return the part that is the whole but for a bite, where what fills the bite is nothing of the whole: a sign.

    It has much of the whole's outline, and no other part has more than a little. Hardly any of it is outside.
    """
    distance = SAME_OUTLINE * whole.box.larger_side
    kept = [float(are_near(whole.polygon.vertices, part.polygon.line, distance).mean()) for part in parts]
    order = np.argsort(kept)
    if len(parts) < 2 or kept[order[-1]] < MOST_KEPT or kept[order[-2]] > LEAST_KEPT:
        return None
    left = parts[order[-1]]
    z = left.polygon.vertices
    is_inside = (winding_numbers(z, whole.polygon.vertices) != 0) | are_near(z, whole.polygon.line, distance)
    return left if is_inside.mean() >= MOST_INSIDE else None


def _is_like(part: Box, whole: Box) -> bool:
    common = part.intersection(whole)
    return common > MOST_LIKE * (part.area + whole.area - common)


def _has_moved(part: PlacedContour, whole: PlacedContour) -> bool:
    """Return whether a part is the whole, moved and perhaps smaller: a head beside which another one comes."""
    if part.area < LEAST_OF_MOVED * whole.area:
        return False
    there = whole.centre + (part.polygon.vertices - part.centre) * (whole.size / part.size)
    near = are_near(there, whole.polygon.line, MOVED_OUTLINE * whole.box.larger_side)
    return bool(near.mean() > MOST_NEAR)


def _nearest(contour: PlacedContour, owners: Sequence[PlacedContour], bounds: FloatArray) -> int:
    """Return the index of the exterior nearest to a contour, of equals the largest, given their bounds, (owners, 4)."""
    watched = thin(contour.polygon.vertices, WATCHED)
    low, high = Box.around(watched).bounds[:2], Box.around(watched).bounds[2:]
    apart = np.maximum(np.maximum(bounds[:, :2] - high, low - bounds[:, 2:]), 0.0)
    gaps = np.hypot(apart[:, 0], apart[:, 1])  # no vertex is nearer than the boxes are
    best: tuple[float, float, int] = (np.inf, 0.0, 0)
    sizes = np.hypot(bounds[:, 2] - bounds[:, 0], bounds[:, 3] - bounds[:, 1])
    for k in np.lexsort((-sizes, gaps)).tolist():
        if gaps[k] > best[0]:
            break
        if best[0] == 0.0 and sizes[k] < (1.0 - 1e-9) * -best[1]:
            continue
        owner = owners[k]
        if gaps[k] == 0.0 and winding_numbers(watched, owner.polygon.vertices).any():
            away = 0.0
        else:
            away = float(np.abs(owner.polygon.vertices[:, None] - watched).min())
        best = min(best, (away, -owner.size, k))
    return best[2]


class _Outline(NamedTuple):
    """A contour to cut, flattened, and the holes in it."""

    contour: Contour
    polygon: Polygon
    holes: Sequence[Polygon]
    goes_around: bool  # whether cuts that are upright or level go around holes, as all others do

    def may_be_cut(self, starts: ComplexArray, ends: ComplexArray) -> BoolArray:
        """Return whether lines between points of the contour lie inside, and meet no hole that they must not."""
        inside = lie_inside(starts, ends, self.polygon.vertices)
        for hole in self.holes:
            left = np.flatnonzero(inside)
            if not self.goes_around:
                chords = ends[left] - starts[left]
                left = left[[not _is_straight(chord) for chord in chords.tolist()]]
            inside[left] = ~meet(starts[left], ends[left], hole.vertices)
        return inside


def _pieces(
    outline: _Outline, partners: Sequence[PlacedContour], vertices: int
) -> list[tuple[Contour, PlacedContour]] | None:
    """Cut a contour into a piece for each partner, by halves; None if no cut lies inside."""
    if len(partners) == 1:
        return [(outline.contour, partners[0])]
    best: tuple[float, int, int] = (np.inf, 0, 0)
    for halves in _halved(partners):
        share = _area(halves[0]) / _area([*halves[0], *halves[1]])
        found = _best_cut(outline, share, _centre(halves[1]) - _centre(halves[0]), best[0])
        if found is not None:
            best, (first, second) = found, halves
    cost, i, j = best
    if not np.isfinite(cost):
        return None
    pieces: list[tuple[Contour, PlacedContour]] = []
    polygon, i, j = _straightened(outline, i, j, _area(first) / _area([*first, *second]))
    for some, (start, end) in zip((first, second), ((i, j), (j, i)), strict=True):
        contour = _section(outline.contour, polygon, start, end)
        piece = flatten(contour, vertices)
        inside = [hole for hole in outline.holes if winding_numbers(hole.vertices[:1], piece.vertices)[0]]
        smaller = _pieces(outline._replace(contour=contour, polygon=piece, holes=inside), some, vertices)
        if smaller is None:
            return None
        pieces += smaller
    return pieces


def _grid(contours: Sequence[PlacedContour]) -> list[list[Row]] | None:
    """Return the rows and the columns of a grid; None if contours are no grid."""
    grid = [rows_of(contours, is_turned=is_turned) for is_turned in (False, True)]
    is_even = all(len({len(row.contours) for row in rows}) == 1 and len(rows) > 1 for rows in grid)
    return grid if is_even else None


def _halved(partners: Sequence[PlacedContour]) -> list[tuple[list[PlacedContour], list[PlacedContour]]]:
    """Return the ways to divide partners into two halves: by whole rows or columns of a grid, else by place."""
    grid = _grid(partners)
    if grid is not None:
        lines = [[row.contours for row in rows] for rows in grid]
    else:
        ranked = (
            sorted(partners, key=lambda p: ((p.centre * axis.conjugate()).real, p.number)) for axis in AXES
        )
        lines = [[[contour] for contour in contours] for contours in ranked]
    return [(list(chain(*line[: len(line) // 2])), list(chain(*line[len(line) // 2 :]))) for line in lines]


def _centre(contours: Sequence[PlacedContour]) -> complex:
    return sum(contour.centre for contour in contours) / len(contours)


def _area(contours: Sequence[PlacedContour]) -> float:
    return sum(contour.area for contour in contours)


def _best_cut(outline: _Outline, share: float, offset: complex, most: float) -> tuple[float, int, int] | None:
    """Return the cost of the best straight cut, and the end vertices of the first piece.

    The first piece has about a share of the area, and the rest lies in the direction of an offset from it. None if no
    cut of a cost below `most` lies inside.
    """
    z = outline.polygon.vertices
    ends = np.round(np.linspace(0, len(z), min(ENDS, len(z)), endpoint=False)).astype(np.intp)
    shares, offsets = _halves(z, ends)
    # If the outline has no area, no cut is finite.
    with np.errstate(divide="ignore", invalid="ignore"):
        lengths = np.abs(z[ends][:, None] - z[ends]) / np.sqrt(abs(signed_area(z)))
        cosine = (offsets * np.conj(offset)).real / (np.abs(offsets) * abs(offset))
    cost = (
        SHARE_WEIGHT * np.abs(shares - share)
        + LENGTH_WEIGHT * lengths
        + DIRECTION_WEIGHT * 0.5 * (1.0 - cosine)
    )
    cost[~((shares > LEAST_SHARE) & (shares < 1.0 - LEAST_SHARE) & np.isfinite(cost))] = np.inf
    costs, last = cost.ravel(), min(TRIES, cost.size) - 1
    cheap = np.flatnonzero(costs <= np.partition(costs, last)[last])  # sorting all takes five times as long
    cheap = cheap[np.argsort(costs[cheap], kind="stable")][:TRIES]
    p, q = np.unravel_index(cheap[costs[cheap] < most], cost.shape)
    first, count = 0, AT_ONCE
    while first < len(p):
        some = slice(first, first + count)
        inside = np.flatnonzero(outline.may_be_cut(z[ends[p[some]]], z[ends[q[some]]]))
        if len(inside):
            k = first + int(inside[0])
            return float(cost[p[k], q[k]]), int(ends[p[k]]), int(ends[q[k]])
        first, count = first + count, MORE * count
    return None


def _straightened(outline: _Outline, i: int, j: int, share: float) -> tuple[Polygon, int, int]:
    """Return a polygon in which a cut that is about upright or level is so, and gives the first piece its share.

    The polygon has two more vertices then, the ends of the cut, whose numbers are returned with it.
    """
    polygon = outline.polygon
    z, chord = polygon.vertices, complex(polygon.vertices[j] - polygon.vertices[i])
    if not _is_straight(chord) or any(_is_notch(z, k) for k in (i, j)):
        return polygon, i, j
    turn = 1.0 if abs(chord.real) < abs(chord.imag) else -1j  # what is level becomes upright
    upright = z * turn
    piece = signed_area(upright[np.arange(i, j + 1 if j > i else j + 1 + len(z)) % len(z)])
    missing = share * signed_area(upright) - piece
    x = float((upright[i] + upright[j]).real / 2.0 + missing / -(chord * turn).imag)
    edges = upright.real - x, np.roll(upright.real, -1) - x
    crossing = np.flatnonzero((edges[0] < 0.0) != (edges[1] < 0.0))
    places = []
    for k in (i, j):
        apart = np.abs(crossing - k)
        near = crossing[np.minimum(apart, len(z) - apart) <= NEAR_CUT * len(z)]
        if not len(near):
            return polygon, i, j
        edge = near[np.abs(z[near] - z[k]).argmin()]
        places.append(float(edge + edges[0][edge] / (edges[0][edge] - edges[1][edge])))
    finer = with_vertices(polygon, np.array(places))
    start, end = (int(np.floor(place)) + 1 + (place > min(places)) for place in places)
    fine = outline._replace(polygon=finer)
    is_inside = fine.may_be_cut(finer.vertices[[start]], finer.vertices[[end]]).item()
    return (finer, start, end) if is_inside else (polygon, i, j)


def _is_notch(z: ComplexArray, k: int) -> bool:
    """Return whether an outline turns inwards at a vertex, as a heart does: cuts had best begin there."""
    turn = np.angle((z[(k + 1) % len(z)] - z[k]) / (z[k] - z[k - 1]))
    return bool(turn * np.sign(signed_area(z)) < -NOTCH)


def _is_straight(chord: complex) -> bool:
    """Return whether a cut is about upright or level; one without a length, where an outline touches itself, is not."""
    return chord != 0.0 and min(abs(chord.real), abs(chord.imag)) <= UPRIGHT * abs(chord)


def _halves(z: ComplexArray, ends: IntArray) -> tuple[FloatArray, ComplexArray]:
    """Return the share of the area from end i to end j, and the offset from its centroid to the rest's, (i, j) each."""
    origin = z[0]
    p, q = z - origin, np.roll(z, -1) - origin
    cross = (p.conj() * q).imag / 2.0
    areas = np.concatenate([[0.0], np.cumsum(cross)])
    moments = np.concatenate([[0.0], np.cumsum(cross * (p + q) / 3.0)])
    total, total_moment = areas[-1], moments[-1]
    end = p[ends]
    chord = (end.conj()[None, :] * end[:, None]).imag / 2.0  # from j back to i
    ahead = ends[None, :] >= ends[:, None]
    area = areas[ends][None, :] - areas[ends][:, None] + np.where(ahead, 0.0, total) + chord
    moment = (
        moments[ends][None, :]
        - moments[ends][:, None]
        + np.where(ahead, 0.0, total_moment)
        + chord * (end[None, :] + end[:, None]) / 3.0
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        return area / total, (total_moment - moment) / (total - area) - moment / area


def _section(contour: Contour, polygon: Polygon, i: int, j: int) -> Contour:
    """Return the contour from vertex i to vertex j of its polygon, closed by a straight line."""
    segments, straight = run_of_segments(contour, polygon, i, j)
    closing = cubics.line(segments[-1, 3], segments[0, 0])
    return Contour(np.vstack([segments, closing]), np.append(straight, True), closed=True)
