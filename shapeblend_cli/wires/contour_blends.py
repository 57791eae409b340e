"""From two contours, or one contour and a point, to the blend between them."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.anatomy.decompose import LINE, PlacedContour
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.geometry.polygons import reverse_contour, reverse_polygon
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.model import Contour, ContourBlend, Correspondence, CubicPath, Polygon, unroll
from shapeblend_cli.wires.common_cuts import FlatContour, solve_with_common_cuts
from shapeblend_cli.wires.constraints import Constraints, stiffness
from shapeblend_cli.wires.direction import choose_direction, solve
from shapeblend_cli.wires.rough import rough_work
from shapeblend_cli.wires.same_segments import solve_with_same_segments
from shapeblend_cli.wires.shared import solve_with_shared
from shapeblend_cli.wires.symmetry import solve_with_symmetry

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, IntArray
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.wires.common_cuts import Solved
    from shapeblend_cli.wires.direction import Watch

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
    is called with the share of the first search that is done, from 0 to 1. Constraints that cannot be met raise a
    MatchError.

    Vertex numbers are those of the match without them: where both contours are cut for it, the start and the pins with
    numbers are for the polygons that were cut.
    """
    if (a.role == LINE) != (b.role == LINE):
        a, b = (a, _open_for(a, b, settings)) if a.role == LINE else (_open_for(b, a, settings), b)
    required = constraints.rotated_back(rotation)
    free = required.without_numbers() if settings.makes_common_cuts else required
    is_reversed, found = choose_direction(
        a.polygon, _rotated_back(b.polygon, rotation), settings, free, watch
    )
    flat_a, flat_b = FlatContour(a.contour, a.polygon), FlatContour(b.contour, b.polygon)
    if is_reversed:
        flat_b = FlatContour(reverse_contour(b.contour), reverse_polygon(b.polygon, len(b.contour.segments)))

    def solve_again(
        p: FlatContour,
        q: FlatContour,
        near: IntArray | None = None,
        known: float = np.inf,
        required: Constraints = free,
    ) -> Solved:
        directed = _rotated_back(q.polygon, rotation)
        return p, q, solve(p.polygon, directed, settings, required, near=near, known=known)

    if settings.makes_common_cuts:
        turned = partial(_rotated_back, rotation=rotation)
        solved = None
        if not (free.pins or settings.stiff):
            if not rotation:
                solved = solve_with_shared(flat_a, flat_b, solve_again, settings)
            solved = solved or solve_with_same_segments(
                flat_a, flat_b, found, turned, solve_again, settings.constants
            )
            solved = solved or solve_with_symmetry(flat_a, flat_b, found, turned, solve_again, settings)
        solved = solved or solve_with_common_cuts(flat_a, flat_b, found, solve_again, settings.effort)
        if required != free:
            solved = solve_again(*solved[:2], required=required)
        flat_a, flat_b, found = solved
    scales = flat_a.polygon.box.larger_side, _rotated_back(flat_b.polygon, rotation).box.larger_side
    return _blend((a.number, b.number), (flat_a, flat_b), scales, found)._replace(rotation=rotation)


def grow_from_point(contour: PlacedContour, point: complex, *, of_b: bool) -> ContourBlend:
    """Return a blend of a contour of B that grows from a point, or of A that shrinks to one. Nothing is solved."""
    segments = np.full_like(contour.contour.segments, point)
    return grow_from(segments, FlatContour(contour.contour, contour.polygon), contour.number, of_b=of_b)


def grow_from(segments: ComplexArray, grown: FlatContour, number: int, *, of_b: bool) -> ContourBlend:
    """Return a blend of a contour that grows from segments without an area, as many as it has, or shrinks to them."""
    size = grown.polygon.box.larger_side
    closed = grown.polygon.closed
    spot = Polygon(segments[:1, 0], np.zeros(1, np.intp), np.zeros(1), closed)
    vertices = np.arange(len(grown.polygon.vertices))
    dots = np.stack([0 * vertices, vertices] if of_b else [vertices, 0 * vertices], axis=1)
    free = Correspondence(dots, closed, 0.0, 0.0, 0.0, 0.0, 0, 0.0, 0)
    nothing = FlatContour(replace(grown.contour, segments=segments), spot)
    if of_b:
        return _blend((None, number), (nothing, grown), (size, size), free)
    return _blend((number, None), (grown, nothing), (size, size), free)


def follow(contour: PlacedContour, image: FlatContour, vertices: IntArray, *, of_b: bool) -> ContourBlend:
    """Return a blend of a contour of one drawing and its image in the other, which has no such contour.

    There is a vertex of the image for each of the contour's, and of a closed one for its first once more; they rise.
    """
    size = contour.polygon.box.larger_side
    closed = contour.polygon.closed
    count = len(contour.polygon.vertices)
    steps = []
    for k, j in enumerate(np.minimum(vertices[:count], len(image.polygon.vertices) - 1).tolist()):
        last = int(vertices[k + 1]) if k + 1 < len(vertices) else j
        steps.append((k, j))
        steps += [(k, between) for between in range(j + 1, last)]
    dots = np.array(steps, np.intp)
    flats = FlatContour(contour.contour, contour.polygon), image
    free = Correspondence(dots[:, ::-1] if of_b else dots, closed, 0.0, 0.0, 0.0, 0.0, 0, 0.0, 0)
    if of_b:
        return _blend((None, contour.number), flats[::-1], (size, size), free)
    return _blend((contour.number, None), flats, (size, size), free)


def keep_still(contour: PlacedContour, numbers: tuple[int, int]) -> ContourBlend:
    """Return a blend of a contour that stays as it is, for two contours with these numbers. Nothing is solved."""
    size = contour.polygon.box.larger_side
    flat = FlatContour(contour.contour, contour.polygon)
    vertices = np.arange(len(contour.polygon.vertices))
    every = Correspondence(
        np.stack([vertices, vertices], axis=1), flat.polygon.closed, 0.0, 0.0, 0.0, 0.0, 0, 0.0, 0
    )
    return _blend(numbers, (flat, flat), (size, size), every)


def _blend(
    numbers: tuple[int | None, int | None],
    contours: tuple[FlatContour, FlatContour],
    scales: tuple[float, float],
    correspondence: Correspondence,
) -> ContourBlend:
    """Return a blend along the polygons, a line for every step of the correspondence."""
    dots, closed = correspondence.dots, correspondence.closed
    a, b = contours
    period = len(a.polygon.vertices), len(b.polygon.vertices)
    positions = unroll(dots, period if closed else None)
    start, end = (
        CubicPath(
            lines := cubics.lines(polygon.vertices[dots[:, side]], closed),
            np.ones(len(lines), np.bool_),
            closed,
        )
        for side, polygon in enumerate((a.polygon, b.polygon))
    )
    cuts = positions[:, 0], positions[:, 1]
    return ContourBlend(
        *numbers, a.contour, b.contour, a.polygon, b.polygon, *scales, correspondence, start, end, cuts
    )


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
        return rough_work(p, np.append(rolled, rolled[0]), False, settings.constants)

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
