"""From two contours, or one contour and a point, to the blend between them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.geometry.polygons import reverse_contour, reverse_polygon
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.model import Contour, ContourBlend, Correspondence, CubicPath, Polygon, unroll
from shapeblend_cli.pairing.constraints import Constraints, stiffness
from shapeblend_cli.pairing.costs import coarse_work
from shapeblend_cli.pairing.decompose import LINE, PlacedContour
from shapeblend_cli.pairing.direction import choose_direction

if TYPE_CHECKING:
    from shapeblend_cli.pairing.direction import Watch
    from shapeblend_cli.settings import Settings

OPENINGS = 24
"""Largest number of nodes at which opening a closed contour is tried."""


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
    is called with the share of the work that is done, from 0 to 1. Constraints that cannot be met raise a MatchError.
    """
    if (a.role == LINE) != (b.role == LINE):
        a, b = (a, _open_for(a, b, settings)) if a.role == LINE else (_open_for(b, a, settings), b)
    rotated = _rotated_back(b.polygon, rotation)
    constraints = constraints.rotated_back(rotation)
    is_reversed, correspondence = choose_direction(a.polygon, rotated, settings, constraints, watch)
    contour_b, polygon_b = b.contour, b.polygon
    if is_reversed:
        polygon_b = reverse_polygon(polygon_b, len(contour_b.segments))
        contour_b = reverse_contour(contour_b)
    scales = a.polygon.box.larger_side, rotated.box.larger_side
    blend = _blend(
        (a.number, b.number), (a.contour, contour_b), (a.polygon, polygon_b), scales, correspondence
    )
    return blend._replace(rotation=rotation)


def grow_from_point(contour: PlacedContour, point: complex, *, of_b: bool) -> ContourBlend:
    """Return a blend of a contour of B that grows from a point, or of A that shrinks to one. Nothing is solved."""
    size = contour.polygon.box.larger_side
    closed = contour.polygon.closed
    spot = Polygon(np.array([point]), np.zeros(1, np.intp), np.zeros(1), closed)
    shrunk = replace(contour.contour, segments=np.full_like(contour.contour.segments, point))
    vertices = np.arange(len(contour.polygon.vertices))
    dots = np.stack([0 * vertices, vertices] if of_b else [vertices, 0 * vertices], axis=1)
    free = Correspondence(dots, closed, 0.0, 0.0, 0.0, 0, 0.0, 0)
    if of_b:
        numbers, contours, polygons = (
            (None, contour.number),
            (shrunk, contour.contour),
            (spot, contour.polygon),
        )
        return _blend(numbers, contours, polygons, (size, size), free)
    return _blend(
        (contour.number, None), (contour.contour, shrunk), (contour.polygon, spot), (size, size), free
    )


def _blend(
    numbers: tuple[int | None, int | None],
    contours: tuple[Contour, Contour],
    polygons: tuple[Polygon, Polygon],
    scales: tuple[float, float],
    correspondence: Correspondence,
) -> ContourBlend:
    """Return a blend along the polygons, a line for every step of the correspondence."""
    dots, closed = correspondence.dots, correspondence.closed
    period = len(polygons[0].vertices), len(polygons[1].vertices)
    positions = unroll(dots, period if closed else None)
    start, end = (
        CubicPath(
            lines := cubics.lines(polygon.vertices[dots[:, side]], closed),
            np.ones(len(lines), np.bool_),
            closed,
        )
        for side, polygon in enumerate(polygons)
    )
    cuts = positions[:, 0], positions[:, 1]
    return ContourBlend(*numbers, *contours, *polygons, *scales, correspondence, start, end, cuts)


def solved_wires(contour: ContourBlend, settings: Settings) -> Wires:
    """Return the wires as they were solved: in the unit box, B rotated back, A stiff where required."""
    rotated = _rotated_back(contour.polygon_b, contour.rotation)
    return Wires(
        to_unit_box(contour.polygon_a),
        to_unit_box(rotated),
        contour.correspondence.closed,
        settings.constants,
        stiffness(contour.polygon_a, settings),
    )


def _rotated_back(polygon: Polygon, rotation: float) -> Polygon:
    return Similarity.rotation(-rotation).polygon(polygon) if rotation else polygon


def _open_for(line: PlacedContour, exterior: PlacedContour, settings: Settings) -> PlacedContour:
    """Open a closed contour at the node from which it becomes a line, or comes of it, with the least work."""
    nodes = np.flatnonzero(exterior.polygon.parameter == 0.0)
    nodes = nodes[:: -(-len(nodes) // OPENINGS)] if len(nodes) else np.zeros(1, np.intp)
    p = to_unit_box(line.polygon)
    unit = to_unit_box(exterior.polygon)

    def work(vertex: int) -> float:
        rolled = np.roll(unit, -vertex)
        return coarse_work(p, np.append(rolled, rolled[0]), False, settings.constants)

    return open_contour(exterior, min(nodes.tolist(), key=work))


def open_contour(exterior: PlacedContour, vertex: int) -> PlacedContour:
    """Return a closed contour as an open one that begins and ends at a vertex which is a node."""
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
