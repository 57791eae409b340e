"""Strokes that are to become fills, or come of them, as the outlines of what they paint: never a grey in between."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.anatomy.decompose import EXTERIOR, HOLE
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.polygons import polyline_contour, ring_edges, signed_area
from shapeblend_cli.geometry.polyline import are_near, needed
from shapeblend_cli.geometry.raster import winding_grid
from shapeblend_cli.model import Box
from shapeblend_cli.pairing.riders import riders
from shapeblend_cli.pens.drawings import file_line
from shapeblend_cli.pens.line import UNITS, evenly

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing
    from shapeblend_cli.model import ComplexArray
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.pens.line import PenLine

STEP = 0.1
"""Distance of points along a stroke, in units."""

ARC = np.radians(6.0)
"""Maximum angle between neighbouring points of a round cap or join."""

MOST_POINTS = 2000
"""Maximum number of points of a line that becomes outlines: each is compared with all others."""

INSIDE = 2e-3
"""Tolerance of the distance of an outline from its line, as a share of it: nearer points are inside the stroke."""

KEPT = 6e-3
"""Tolerance of an outline with fewer vertices, in units."""

GOOD = 0.98
"""Minimum overlap of a stroke and its outline, as a share of both together."""

GRID = 160
"""Points along the side of the grid on which these are compared."""


def with_outlines(
    a: PlacedDrawing, b: PlacedDrawing, settings: Settings, view: Box
) -> tuple[PlacedDrawing, PlacedDrawing]:
    """Expand the strokes of one of two drawings to outlines, if all that the other one has are fills.

    Beside fills of its own only closed strokes are expanded: open ones are drawn on or back, and those that run along
    the edge of a fill follow it.
    """
    if settings.strokes == "keep" or settings.mix or settings.bending == "paper" or not settings.curves:
        return a, b
    sides = [a, b]
    strokes, fills = ([_paints(side.contours, paint) for side in sides] for paint in ("stroke", "fill"))
    for k in (0, 1):
        if strokes[k] and fills[1 - k] and not strokes[1 - k]:
            exteriors = [contour for contour in sides[1 - k].contours if contour.role == EXTERIOR]
            largest = max(exteriors, key=lambda contour: contour.area, default=None)
            way = -1.0 if largest is not None and signed_area(largest.polygon.vertices) < 0.0 else 1.0
            filled = {contour.number for contour in sides[k].contours if contour.style.fill is not None}
            kept = riders(sides[k].contours, filled)
            scale = UNITS / view.larger_side
            sides[k] = _expanded(sides[k], settings, scale, way, kept, only_closed=fills[k])
    return sides[0], sides[1]


def all_outlines(
    a: PlacedDrawing, b: PlacedDrawing, settings: Settings, view: Box
) -> tuple[PlacedDrawing, PlacedDrawing] | None:
    """Expand all strokes of two drawings to outlines, if there are strokes and fills in them; else None."""
    every = [*a.contours, *b.contours]
    if not (_paints(every, "stroke") and _paints(every, "fill")):
        return None
    scale = UNITS / view.larger_side
    found = [_expanded(side, settings, scale, 1.0, (), only_closed=False) for side in (a, b)]
    if any(_paints(side.contours, "stroke") for side in found):
        return None
    return found[0], found[1]


def _paints(contours: Sequence[PlacedContour], paint: str) -> bool:
    return any(getattr(contour.style, paint) is not None for contour in contours)


def _expanded(
    drawing: PlacedDrawing,
    settings: Settings,
    scale: float,
    way: float,
    kept: Collection[int],
    *,
    only_closed: bool,
) -> PlacedDrawing:
    """Return a drawing of strokes as one of outlines, exteriors with areas of the sign of `way`.

    Dashes, what crosses itself, and strokes with numbers that are `kept` stay strokes.
    """
    found: list[PlacedContour] = []
    free = 1 + max(contour.number for contour in drawing.contours)
    for contour in drawing.contours:
        line, style = file_line(contour, scale), contour.style
        is_plain = style.stroke is not None and style.fill is None and not style.stroke_dasharray
        is_plain = is_plain and contour.number not in kept
        rings = _outlines(line) if is_plain and (line.closed or not only_closed) else []
        if not rings:
            found.append(contour)
            continue
        style = style._replace(
            fill=style.stroke,
            fill_opacity=style.stroke_opacity,
            fill_gradient=style.stroke_gradient,
            fill_rule="nonzero",
            stroke=None,
            stroke_gradient=None,
        )
        for k, ring in enumerate(rings):
            outline = polyline_contour((ring if way > 0.0 else ring[::-1]) / scale)
            number = free if k else contour.number
            free += bool(k)
            found.append(
                contour._replace(
                    number=number,
                    contour=outline,
                    polygon=flatten(outline, settings.vertices),
                    role=HOLE if k else EXTERIOR,
                    exterior=contour.number if k else None,
                    style=style,
                )
            )
    return drawing._replace(contours=found)


def _outlines(line: PenLine) -> list[ComplexArray]:
    """Return the outline of a stroke, and its hole if it has one, which runs the other way; nothing if that fails."""
    reach, cap = line.width / 2.0, line.style.stroke_linecap
    points = line.outline
    if not 2 <= len(points) <= MOST_POINTS:
        return []
    if cap == "square" and not line.closed:
        ways = [points[0] - points[1], points[-1] - points[-2]]
        points = np.concatenate([[points[0]], points, [points[-1]]])
        points[[0, -1]] += reach * np.array([way / abs(way) for way in ways])
        cap = "butt"
    sides = [_side(points, side * reach, line) for side in (1, -1)]
    if line.closed:
        rings = sides
    else:
        ends = [_cap(points, reach, cap), _cap(points[::-1], reach, cap)]
        rings = [np.concatenate([sides[0], ends[0], sides[1][::-1], ends[1]])]
    rings = [_clean(ring, points, reach) for ring in rings]
    rings = sorted((ring for ring in rings if len(ring) > 2), key=lambda ring: -abs(signed_area(ring)))
    if not rings:
        return []
    wound = [ring if (signed_area(ring) > 0.0) == (k == 0) else ring[::-1] for k, ring in enumerate(rings)]
    return wound if _is_right(wound, line, points, cap) else []


def _side(points: ComplexArray, reach: float, line: PenLine) -> ComplexArray:
    """Return points at a distance from a polyline, on its left if that is positive, joins among them."""
    ways = np.diff(points) / np.abs(np.diff(points))
    found = []
    for k, way in enumerate(ways):
        edge = evenly(points[k : k + 2], STEP) + 1j * reach * way
        found.append(edge)
        if k + 1 == len(ways) and not line.closed:
            continue
        corner, after = points[k + 1], ways[(k + 1) % len(ways)]
        turn = float(np.angle(after / way))
        if turn * reach >= 0.0:  # this side is the inner one
            continue
        ratio = 1.0 / max(np.cos(turn / 2.0), 1e-9)
        if line.style.stroke_linejoin == "round":
            steps = np.linspace(0.0, turn, 2 + int(abs(turn) / ARC))[1:-1]
            found.append(corner + 1j * reach * way * np.exp(1j * steps))
        elif line.style.stroke_linejoin == "miter" and ratio <= line.style.stroke_miterlimit:
            found.append(np.array([corner + 1j * reach * ratio * way * np.exp(0.5j * turn)]))
    return np.concatenate(found)


def _cap(points: ComplexArray, reach: float, cap: str) -> ComplexArray:
    """Return what lies between both sides of a polyline beyond its last point, from the left to the right."""
    if cap != "round":
        return np.zeros(0, complex)
    way = (points[-1] - points[-2]) / abs(points[-1] - points[-2])
    angles = np.arange(np.pi / 2.0, -np.pi / 2.0, -ARC)[1:]
    return points[-1] + reach * way * np.exp(1j * angles)


def _clean(ring: ComplexArray, points: ComplexArray, reach: float) -> ComplexArray:
    """Return an outline without the points that lie inside the stroke, but with the corners where its sides meet."""
    outside = ~are_near(ring, points, reach * (1.0 - INSIDE))
    if outside.sum() < 3:
        return ring[:0]
    first = int(np.argmax(~outside)) if not outside.all() else 0
    ring, outside = np.roll(ring, -first), np.roll(outside, -first)
    found: list[complex] = []
    numbers = np.flatnonzero(outside)
    for k, number in enumerate(numbers):
        found.append(ring[number])
        after = numbers[(k + 1) % len(numbers)]
        if after == (number + 1) % len(ring):
            continue
        before, beyond = ring[number] - ring[number - 1], ring[(after + 1) % len(ring)] - ring[after]
        slant = (before.conjugate() * beyond).imag
        if abs(slant) > 0.05 * abs(before) * abs(beyond):
            share = ((ring[after] - ring[number]).conjugate() * beyond).imag / slant
            corner = ring[number] + share * before
            if abs(corner - ring[number]) < 4.0 * STEP:
                found.append(corner)
    every = np.array(found)
    closed = np.append(every, every[0])
    return closed[needed(closed, KEPT)][:-1]


def _is_right(rings: Sequence[ComplexArray], line: PenLine, points: ComplexArray, cap: str) -> bool:
    """Return whether outlines cover what a stroke paints."""
    from shapeblend_cli.pens.recovery.region import Recovered, stroke_edges

    own = points[:-1] if line.closed else points
    join = "round" if line.style.stroke_linejoin == "round" else "miter"
    wanted = stroke_edges([Recovered(own, line.closed, line.width, cap, join)])
    box = Box.around(points).expanded(2.0 * line.width)
    step, corner = box.larger_side / GRID, complex(box.x, box.y)
    one, other = (
        winding_grid(starts, ends, corner, step, GRID) != 0 for starts, ends in (wanted, ring_edges(rings))
    )
    return bool((one & other).sum() >= GOOD * (one | other).sum())
