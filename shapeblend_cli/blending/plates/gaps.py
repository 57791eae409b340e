"""Gaps that close: a ring around a disc becomes solid, as the lens of a solid magnifier that becomes a solid box.

The hole comes to lie on its island evenly. By the even-odd rule both edges cancel each other then, and the holes of the
other drawing open in what is solid.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import EXTERIOR, HOLE
from shapeblend_cli.blending.graded import faults_of
from shapeblend_cli.blending.plates.plain import is_blend_of
from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.geometry.polyline import nearest_places
from shapeblend_cli.interpolate.paths import with_curves
from shapeblend_cli.model import Box, ShapeBlend
from shapeblend_cli.motion.early import Early, Edge
from shapeblend_cli.pairing.growth import MatchedPoints, growth_point_inside
from shapeblend_cli.wires.constraints import Constraints
from shapeblend_cli.wires.contour_blends import grow_from_point
from shapeblend_cli.wires.match import match_contours

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing
    from shapeblend_cli.model import ContourBlend, Shapes
    from shapeblend_cli.options.settings import Settings

SHIPS = 1.25
"""Minimum sum of the faults of the usual blend for gaps to close in a ring without a handle."""

NEAR = 0.04
"""Maximum mean distance of contours in one place, as a share of the drawing's size."""

LEAST_FILLED = 0.3
"""Minimum share of a hole that its island fills."""

MOST_HOLES = 8
"""Maximum number of holes of the drawing without a gap."""

ALIKE = 0.6
"""Minimum ratio of the areas of two holes in one place that are the same hole."""

CLOSED_FOR = 0.6
"""Time for which a gap is closed, as a share of all time."""

OPENS = 0.4
"""Time for which holes in what is solid are closed, as a share of all time."""

SIZES = (1.0, 0.8, 0.6)
"""Sizes of an island in what is solid, as shares of its own."""

PLACES = 9
"""Number of places for it in each direction."""

CLOSED = "the gap around an island closes"


class _Gap(NamedTuple):
    """A shape with a hole, an island in it, and nothing else."""

    exterior: PlacedContour
    hole: PlacedContour
    island: PlacedContour


def with_gaps_closed(
    a: PlacedDrawing, b: PlacedDrawing, settings: Settings, view: Box, usual: Shapes
) -> Shapes:
    """Return the blend in which the gap around an island closes or opens, unless there is none or the usual can ship.

    The drawings are plain, see `is_plain`.
    """
    for here, (own, other) in enumerate(((a, b), (b, a))):
        gap, solid = _gap(own.contours), _solid(other.contours)
        if gap is None or solid is None or (seat := _seat(gap.island, solid[0])) is None:
            continue
        if any(_is_same(gap.hole, hole) for hole in solid[1:]):
            return usual
        drawn: list[ShapeBlend] = []
        if not _are_in_place(gap.exterior, solid[0], NEAR * view.larger_side):
            from shapeblend_cli.blending.plates.handles import ring_and_handles  # few drawings have gaps

            edge, drawn = ring_and_handles(own, settings, view, here)
            gap = gap._replace(exterior=_outer_edge(gap, edge)) if edge else gap
        if not drawn and faults_of(usual, view) < SHIPS:
            return usual
        shapes = (_closing(gap, solid, seat, settings, here), *drawn)
        return shapes if is_blend_of(shapes, a, b, view) else usual
    return usual


def _outer_edge(gap: _Gap, ring: Box) -> PlacedContour:
    """Return the exterior of a gap without handles: its island, as large as the ring."""
    edge = _scaled(gap.island, ring.centre, ring.larger_side / gap.island.box.larger_side)
    return gap.exterior._replace(contour=edge.contour, polygon=edge.polygon)


def _seat(island: PlacedContour, whole: PlacedContour) -> PlacedContour | None:
    """Return an island where a solid shape has room for it: as large, and as near to its own place, as may be."""
    if _holds(whole, island):
        return island
    places = whole.box.grid(PLACES)
    places = places[np.argsort(np.abs(places - island.centre), kind="stable")]
    seats = (_scaled(island, place, size) for size in SIZES for place in places.tolist())
    return next((seat for seat in seats if _holds(whole, seat)), None)


def _scaled(contour: PlacedContour, centre: complex, size: float) -> PlacedContour:
    """Return a contour about another centre, so many times as large."""
    return contour.transformed(lambda points: centre + size * (points - contour.centre))


def _gap(contours: Sequence[PlacedContour]) -> _Gap | None:
    """Return the gap of a drawing that is a shape with one and no more."""
    holes = [contour for contour in contours if contour.role == HOLE]
    solid = sorted((c for c in contours if c.role == EXTERIOR), key=lambda c: -c.area)
    if len(contours) != 3 or len(holes) != 1:
        return None
    gap = _Gap(solid[0], holes[0], solid[1])
    is_filled = gap.island.area >= LEAST_FILLED * gap.hole.area
    return gap if is_filled and _holds(gap.exterior, gap.hole) and _holds(gap.hole, gap.island) else None


def _solid(contours: Sequence[PlacedContour]) -> list[PlacedContour] | None:
    """Return the one exterior of a drawing and its holes."""
    first = [contour for contour in contours if contour.role == EXTERIOR]
    holes = [contour for contour in contours if contour.role == HOLE]
    return [*first, *holes] if len(first) == 1 and len(holes) <= MOST_HOLES else None


def _holds(outer: PlacedContour, inner: PlacedContour) -> bool:
    """Return whether a contour lies within another."""
    return bool(winding_numbers(inner.polygon.vertices, outer.polygon.vertices).all())


def _are_in_place(p: PlacedContour, q: PlacedContour, most: float) -> bool:
    """Return whether the mean distance of two contours is small enough for them to be in one place."""
    if p.box.sides_apart(q.box) > 2.0 * most:
        return False
    lines = p.polygon.line, q.polygon.line
    apart = max(float(nearest_places(one, other)[0].mean()) for one, other in (lines, lines[::-1]))
    return apart <= min(most, 0.2 * p.box.larger_side)


def _is_same(gap: PlacedContour, hole: PlacedContour) -> bool:
    """Return whether two holes are one, of about the same area and in about the same place."""
    areas = sorted((gap.area, hole.area))
    is_inside = winding_numbers(np.array([hole.centre]), gap.polygon.vertices)[0] != 0
    return bool(is_inside and areas[0] >= ALIKE * areas[1])


def _closing(
    gap: _Gap, solid: Sequence[PlacedContour], seat: PlacedContour, settings: Settings, here: int
) -> ShapeBlend:
    """Return the blend of a drawing with a gap, A's if `here` is 0 and else B's, and one without."""
    whole, *holes = solid

    def matched(own: PlacedContour, other: PlacedContour) -> ContourBlend:
        blend = match_contours(*((other, own) if here else (own, other)), settings, Constraints())
        return with_curves(blend) if settings.curves else blend

    outline = matched(gap.exterior, whole)
    edges = [matched(edge, seat) for edge in (gap.hole, gap.island)]
    edges = [edge._replace(a=None) if here else edge._replace(b=None) for edge in edges]
    first, last = (whole, gap.exterior) if here else (gap.exterior, whole)
    around = MatchedPoints(*outline.dot_points()[:: 1 if here else -1])
    opening = [
        grow_from_point(hole, growth_point_inside(hole.polygon.vertices, around), of_b=not here)
        for hole in holes
    ]
    on_seat = edges[0].path(1 - here).segments
    on_island = gap.island.centre + gap.island.box.larger_side / seat.box.larger_side * (
        on_seat - seat.centre
    )
    closed = Edge(on_seat, on_island) if here else Edge(on_island, on_seat)
    motion = Early(
        None,
        {edges[0].numbers: CLOSED_FOR} | {each.numbers: OPENS for each in opening},
        {edges[0].numbers: closed},
    )
    style_a, style_b = (each.style._replace(fill_rule="evenodd") for each in (first, last))
    sources = first.shape, last.shape
    return ShapeBlend(
        (outline, *edges, *opening), style_a, style_b, motion=motion, reason=CLOSED, sources=sources
    )
