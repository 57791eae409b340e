"""Exteriors that become several: they are cut into as many pieces as they have partners."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import EXTERIOR, PlacedContour
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.polygons import signed_area, winding_numbers
from shapeblend_cli.geometry.polyline import may_be_near, thin
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

LEAST_SHARE = 0.02
"""Minimum area of a piece, as a share of the whole."""

SAME_PLACE = 0.5
"""Minimum area that the box around parts has in common with the box of the whole, as a share of the larger one."""

FILLED = 0.55
"""Minimum area of all parts' boxes together, as a share of the box around them."""

MOST_SHARED = 0.15
"""Maximum area common to boxes of parts, as a share of the box around all."""

LEAST_PART = 0.12
"""Minimum area of a part's box, as a share of the box around all parts."""

MOST_PART = 0.57
"""Maximum area of a part's box, as a share of the box around all parts."""

MOST_LIKE = 0.6
"""Maximum area that the boxes of a part and the whole have in common, as a share of both: such a part is the whole."""

MOST_OF_ALL = 0.8
"""Minimum area of such a part, as a share of the area of all parts."""

SAME_OUTLINE = 0.015
"""Maximum distance of outlines that are the same, as a share of the size."""

MOST_KEPT = 0.35
"""Minimum share of the outline of a whole that a part has, if the part is the whole but for a bite."""

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
            holes = [contour.polygon for contour in (a, b)[owner_side] if contour.exterior == owner.number]
            outline = _Outline(owner.contour, owner.polygon, holes)
            pieces = _pieces(outline, partners, vertices)
            if pieces is None:
                continue
            split.remove(pair)
            for section, partner in pieces:
                piece = owner._replace(contour=section, polygon=flatten(section, vertices), is_piece=True)
                split.append((partner, piece) if owner_side else (piece, partner))
    return split


def _tiles(parts: Sequence[PlacedContour], whole: PlacedContour) -> list[PlacedContour]:
    """Return the parts, without small ones, if they lie side by side and fill about the box of the whole."""
    union = Box.union([part.box for part in parts])
    tiles = [part for part in parts if part.box.area > LEAST_PART * union.area]
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
        and sum(p.intersection(q) for p, q in combinations(boxes, 2)) < MOST_SHARED * union.area
    )
    return tiles if fit else []


def _bitten(parts: Sequence[PlacedContour], whole: PlacedContour) -> PlacedContour | None:
    """Return the part that is the whole but for a bite, where what fills the bite is nothing of the whole: a sign.

    It has much of the whole's outline, and no other part has more than a little.
    """
    distance = SAME_OUTLINE * whole.box.larger_side
    kept = [float(may_be_near(whole.polygon.vertices, part.polygon.line, distance).mean()) for part in parts]
    order = np.argsort(kept)
    if len(parts) < 2 or kept[order[-1]] < MOST_KEPT or kept[order[-2]] > LEAST_KEPT:
        return None
    return parts[order[-1]]


def _is_like(part: Box, whole: Box) -> bool:
    common = part.intersection(whole)
    return common > MOST_LIKE * (part.area + whole.area - common)


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


def _pieces(
    outline: _Outline, partners: Sequence[PlacedContour], vertices: int
) -> list[tuple[Contour, PlacedContour]] | None:
    """Cut a contour into a piece for each partner, by halves; None if no cut lies inside."""
    if len(partners) == 1:
        return [(outline.contour, partners[0])]
    half = len(partners) // 2
    ranked = [sorted(partners, key=lambda p: ((p.centre * axis.conjugate()).real, p.number)) for axis in AXES]
    halved = [(contours[:half], contours[half:]) for contours in ranked]
    cuts = [
        _best_cut(outline, _area(first) / _area([*first, *second]), _centre(second) - _centre(first))
        for first, second in halved
    ]
    best = min(range(len(cuts)), key=lambda k: cuts[k][0])
    cost, i, j = cuts[best]
    if not np.isfinite(cost):
        return None
    pieces: list[tuple[Contour, PlacedContour]] = []
    for some, (start, end) in zip(halved[best], ((i, j), (j, i)), strict=True):
        contour = _section(outline.contour, outline.polygon, start, end)
        polygon = flatten(contour, vertices)
        inside = [hole for hole in outline.holes if winding_numbers(hole.vertices[:1], polygon.vertices)[0]]
        smaller = _pieces(_Outline(contour, polygon, inside), some, vertices)
        if smaller is None:
            return None
        pieces += smaller
    return pieces


def _centre(contours: Sequence[PlacedContour]) -> complex:
    return sum(contour.centre for contour in contours) / len(contours)


def _area(contours: Sequence[PlacedContour]) -> float:
    return sum(contour.area for contour in contours)


def _best_cut(outline: _Outline, share: float, offset: complex) -> tuple[float, int, int]:
    """Return the cost of the best straight cut, infinite if none lies inside, and the end vertices of the first piece.

    The first piece has about a share of the area, and the rest lies in the direction of an offset from it.
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
    boundaries = [z, *(hole.vertices for hole in outline.holes)]
    for flat in np.argsort(cost, axis=None, kind="stable")[:TRIES]:
        p, q = np.unravel_index(flat, cost.shape)
        if np.isfinite(cost[p, q]) and _lies_inside(complex(z[ends[p]]), complex(z[ends[q]]), boundaries):
            return float(cost[p, q]), int(ends[p]), int(ends[q])
    return np.inf, 0, 0


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


def _lies_inside(start: complex, end: complex, boundaries: Sequence[ComplexArray]) -> bool:
    """Return whether a line between two vertices of the first boundary lies inside it, and meets no boundary."""
    chord = end - start
    inner = start + chord * np.array([0.02, 0.25, 0.5, 0.75, 0.98])
    if not winding_numbers(inner, boundaries[0]).all():
        return False
    for p in boundaries:
        q = np.roll(p, -1)
        side_p, side_q = ((np.conj(chord) * (w - start)).imag for w in (p, q))
        side_start, side_end = ((np.conj(q - p) * (w - p)).imag for w in (start, end))
        if ((side_p * side_q < 0.0) & (side_start * side_end < 0.0)).any():
            return False
    return True


def _section(contour: Contour, polygon: Polygon, i: int, j: int) -> Contour:
    """Return the contour from vertex i to vertex j of its polygon, closed by a straight line."""
    segments, straight = run_of_segments(contour, polygon, i, j)
    closing = cubics.line(segments[-1, 3], segments[0, 0])
    return Contour(np.vstack([segments, closing]), np.append(straight, True), closed=True)


def run_of_segments(contour: Contour, polygon: Polygon, i: int, j: int) -> tuple[ComplexArray, BoolArray]:
    """Return the segments of a closed contour from vertex i to j, once round if i is j, and which of them are lines."""
    count = len(contour.segments)
    first, start = int(polygon.segment[i]), float(polygon.parameter[i])
    last, end = int(polygon.segment[j]), float(polygon.parameter[j])
    if end == 0.0:  # a node: the end of the segment before
        last, end = (last - 1) % count, 1.0
    steps = (last - first) % count
    if steps == 0 and end <= start:
        steps = count
    numbers = (first + np.arange(steps + 1)) % count
    starts, ends = np.zeros(steps + 1), np.ones(steps + 1)
    starts[0], ends[-1] = start, end
    return cubics.pieces(contour.segments[numbers], starts, ends), contour.straight[numbers]
