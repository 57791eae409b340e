"""Blends of contours along a correspondence, found by a match or given."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.flat_contour import FlatContour
from shapeblend_cli.geometry.polygons import polyline_contour
from shapeblend_cli.model import ContourBlend, Correspondence, Polygon, unroll
from shapeblend_cli.wires.contour_match import Solved

if TYPE_CHECKING:
    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.model import ComplexArray, IntArray


def blend_along(
    numbers: tuple[int | None, int | None], solved: Solved, scales: tuple[float, float]
) -> ContourBlend:
    """Return a blend along the polygons, a line for every step of the correspondence."""
    a, b, correspondence = solved
    dots, closed = correspondence.dots, correspondence.closed
    period = len(a.polygon.vertices), len(b.polygon.vertices)
    positions = unroll(dots, period if closed else None)
    start, end = (
        polyline_contour(flat.polygon.vertices[dots[:, side]], closed) for side, flat in enumerate((a, b))
    )
    cuts = positions[:, 0], positions[:, 1]
    return ContourBlend(
        *numbers, a.contour, b.contour, a.polygon, b.polygon, *scales, correspondence, start, end, cuts
    )


def vertex_by_vertex(
    numbers: tuple[int | None, int | None], a: ComplexArray, b: ComplexArray, scales: tuple[float, float]
) -> ContourBlend:
    """Return a blend of two closed polygons of as many vertices, each of which becomes one."""
    count = len(a)
    flat_a, flat_b = (
        FlatContour(polyline_contour(points), Polygon(points, np.arange(count), np.zeros(count), True))
        for points in (a, b)
    )
    return blend_along(numbers, Solved(flat_a, flat_b, Correspondence.one_to_one(count, closed=True)), scales)


def grow_from_point(contour: PlacedContour, point: complex, *, of_b: bool) -> ContourBlend:
    """Return a blend of a contour of B that grows from a point, or of A that shrinks to one."""
    segments = np.full_like(contour.contour.segments, point)
    return grow_from(segments, contour.flat, contour.number, of_b=of_b)


def grow_from(segments: ComplexArray, grown: FlatContour, number: int, *, of_b: bool) -> ContourBlend:
    """Return a blend of a contour that grows from segments without an area, as many as it has, or shrinks to them."""
    spot = Polygon(segments[:1, 0], np.zeros(1, np.intp), np.zeros(1), grown.polygon.closed)
    nothing = FlatContour(replace(grown.contour, segments=segments), spot)
    vertices = np.arange(len(grown.polygon.vertices))
    return _without_partner(grown, nothing, number, np.stack([vertices, 0 * vertices], axis=1), of_b=of_b)


def follow(contour: PlacedContour, image: FlatContour, vertices: IntArray, *, of_b: bool) -> ContourBlend:
    """Return a blend of a contour of one drawing and its image in the other, which has no such contour.

    There is a vertex of the image for each of the contour's, and of a closed one for its first once more; they rise.
    """
    count = len(contour.polygon.vertices)
    steps = []
    for k, j in enumerate(np.minimum(vertices[:count], len(image.polygon.vertices) - 1).tolist()):
        last = int(vertices[k + 1]) if k + 1 < len(vertices) else j
        steps.append((k, j))
        steps += [(k, between) for between in range(j + 1, last)]
    return _without_partner(contour.flat, image, contour.number, np.array(steps, np.intp), of_b=of_b)


def keep_still(contour: PlacedContour, numbers: tuple[int | None, int | None]) -> ContourBlend:
    """Return a blend of a contour that stays as it is, for two contours with these numbers."""
    found = Correspondence.one_to_one(len(contour.polygon.vertices), contour.polygon.closed)
    size = contour.box.larger_side
    return blend_along(numbers, Solved(contour.flat, contour.flat, found), (size, size))


def _without_partner(
    own: FlatContour, other: FlatContour, number: int, dots: IntArray, *, of_b: bool
) -> ContourBlend:
    """Return a blend of a contour of A, or of B, and its image in the other drawing."""
    size = own.polygon.box.larger_side
    found = Correspondence.without_work(dots[:, ::-1] if of_b else dots, own.polygon.closed)
    if of_b:
        return blend_along((None, number), Solved(other, own, found), (size, size))
    return blend_along((number, None), Solved(own, other, found), (size, size))
