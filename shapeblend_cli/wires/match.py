"""The match of two contours: its direction, the way to solve it, and the blend along it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.anatomy.decompose import LINE, PlacedContour
from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.model import Contour, ContourBlend, Polygon
from shapeblend_cli.wires.common_cuts import solve_with_common_cuts
from shapeblend_cli.wires.contour_blends import blend_along
from shapeblend_cli.wires.contour_match import ContourMatch, Solved, rotated_back
from shapeblend_cli.wires.direction import choose_direction, wires_of
from shapeblend_cli.wires.rough import rough_work
from shapeblend_cli.wires.shared import solve_with_shared

if TYPE_CHECKING:
    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.wires.constraints import Constraints
    from shapeblend_cli.wires.direction import Watch

OPENINGS = 24
"""Maximum number of nodes at which opening a closed contour is tried."""


def match_contours(
    a: PlacedContour,
    b: PlacedContour,
    settings: Settings,
    constraints: Constraints,
    rotation: float = 0.0,
    watch: Watch | None = None,
) -> ContourBlend:
    """Solve the correspondence of two contours, with B rotated back by an angle in radians.

    B is reversed if that agrees better with A's direction. A closed contour that is to become a line is opened. `watch`
    is called with the share of the first search that is done, from 0 to 1. Constraints that cannot be met raise a
    MatchError.

    Where a match cuts both contours, vertex numbers in the start and in pins are those of the cut polygons.
    """
    if (a.role == LINE) != (b.role == LINE):
        a, b = (a, _open_for(a, b, settings)) if a.role == LINE else (_open_for(b, a, settings), b)
    required = constraints.rotated_back(rotation)
    free = required.without_numbers() if settings.makes_common_cuts else required
    is_reversed, first = choose_direction(a.polygon, rotated_back(b.polygon, rotation), settings, free, watch)
    flat_b = b.flat.reversed() if is_reversed else b.flat
    match = ContourMatch(a.flat, flat_b, first, settings, free, rotation)
    solved = Solved(match.a, match.b, first)
    if settings.makes_common_cuts:
        solved = _solved(match)
        if required != free:
            solved = match._replace(constraints=required).solve(solved.a, solved.b)
    polygons = solved.a.polygon, match.rotated_back(solved.b.polygon)
    scales = polygons[0].box.larger_side, polygons[1].box.larger_side
    return blend_along((a.number, b.number), solved, scales)._replace(rotation=rotation)


def _solved(match: ContourMatch) -> Solved:
    """Solve two contours, with common cuts, in the first way that has an answer.

    The last way always has one. It is the only one that keeps to pins and stiff regions.
    """
    if match.is_free:
        if (found := solve_with_shared(match)) is not None:
            return found
        from shapeblend_cli.wires.same_segments import solve_with_same_segments
        from shapeblend_cli.wires.symmetry import solve_with_symmetry

        for way in (solve_with_same_segments, solve_with_symmetry):
            if (found := way(match)) is not None:
                return found
    return solve_with_common_cuts(match)


def solved_wires(contour: ContourBlend, settings: Settings) -> Wires:
    """Return the wires as they were solved: in the unit box, B rotated or mirrored back, A stiff where required."""
    b = contour.polygon_b
    if contour.mirrored:
        b = replace(b, vertices=b.vertices.conj())
    return wires_of(contour.polygon_a, rotated_back(b, contour.rotation), settings)


def _open_for(line: PlacedContour, exterior: PlacedContour, settings: Settings) -> PlacedContour:
    """Open a closed contour at the node from which it becomes a line, or comes of it, with the least work."""
    nodes = np.flatnonzero(exterior.polygon.parameter == 0.0)
    nodes = nodes[:: -(-len(nodes) // OPENINGS)] if len(nodes) else np.zeros(1, np.intp)
    p, unit = to_unit_box(line.polygon), to_unit_box(exterior.polygon)

    def work(vertex: int) -> float:
        rolled = np.roll(unit, -vertex)
        return rough_work(p, np.append(rolled, rolled[0]), False, settings.constants)

    vertex = min(nodes.tolist(), key=work)
    polygon, contour = exterior.polygon, exterior.contour
    first = int(polygon.segment[vertex])
    count = len(contour.segments)
    rolled = Contour(
        np.roll(contour.segments, -first, axis=0), np.roll(contour.straight, -first), closed=False
    )
    opened = Polygon(
        np.append(np.roll(polygon.vertices, -vertex), polygon.vertices[vertex]),
        np.append((np.roll(polygon.segment, -vertex) - first) % count, count - 1),
        np.append(np.roll(polygon.parameter, -vertex), 1.0),
        closed=False,
    )
    return exterior._replace(contour=rolled, polygon=opened, role=LINE)
