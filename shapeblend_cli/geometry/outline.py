"""What can be said of one outline: area, direction, what it goes round, crossings."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import crossings
from shapeblend_cli.model import Contour, Polygon

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, IntArray

FLAT = 1e-12
"""A triangle of this area, with the outline's size as 1, is flat."""


def signed_area(vertices: ComplexArray) -> float:
    """Area inside a closed polygon; positive where x turns towards y."""
    return 0.5 * float((vertices.conj() * np.roll(vertices, -1)).imag.sum())


def direction(polygon: Polygon) -> int:
    """Which way round a polygon goes: 1, -1, or 0 where that is not decided.

    The sign of the area decides if the outline does not cross itself. If it does, the sum of its turns must agree:
    in a figure of eight they cancel, and one lobe's being larger says nothing. Open lines have no direction.
    """
    if not polygon.closed:
        return 0
    vertices = polygon.vertices
    way = int(np.sign(signed_area(vertices)))
    if self_crossings(vertices, closed=True):
        edges = np.roll(vertices, -1) - vertices
        turns = np.angle(edges * np.roll(edges, 1).conj()).sum() / (2.0 * np.pi)
        return way if way * round(float(turns)) > 0 else 0
    return way


def reversed_contour(contour: Contour) -> Contour:
    """The same contour the other way round; a closed one keeps its first node."""
    return Contour(contour.segments[::-1, ::-1], contour.straight[::-1], contour.closed)


def reversed_polygon(polygon: Polygon, segments: int) -> Polygon:
    """The same polygon the other way round, on the contour the other way round.

    Parameters
    ----------
    polygon : Polygon
    segments : int
        How many segments its contour has.

    Returns
    -------
    Polygon
        A closed one keeps its first vertex.
    """
    order = np.arange(len(polygon.vertices))[::-1]
    if polygon.closed:
        order = np.roll(order, 1)
    segment, parameter = polygon.segment[order], polygon.parameter[order]
    is_node = parameter == 0.0
    segment = np.where(is_node, segments - segment, segments - 1 - segment)
    parameter = np.where(is_node, 0.0, 1.0 - parameter)
    if polygon.closed:
        segment %= segments
    elif is_node[-1]:  # nothing begins at the end of an open contour
        segment[-1], parameter[-1] = segments - 1, 1.0
    return Polygon(polygon.vertices[order], segment, parameter, polygon.closed)


def winding_numbers(points: ComplexArray, vertices: ComplexArray) -> IntArray:
    """How often a closed polygon goes round points, positive where x turns towards y.

    Parameters
    ----------
    points : (p,) complex
        Points on the polygon itself count to either side of it.
    vertices : (m,) complex

    Returns
    -------
    (p,) int
        The edges that cross the ray from each point along +x, upwards counted against downwards.
    """
    following = np.roll(vertices, -1)
    x, y = points.real[:, None], points.imag[:, None]
    below, above = vertices.imag <= y, following.imag <= y
    # On which side of the edge the point lies.
    side = (following.real - vertices.real) * (y - vertices.imag) - (x - vertices.real) * (
        following.imag - vertices.imag
    )
    up = below & ~above & (side > 0.0)
    down = ~below & above & (side < 0.0)
    return up.sum(axis=1) - down.sum(axis=1)


def self_crossings(vertices: ComplexArray, closed: bool) -> int:
    """How often an outline crosses itself, see `crossings.count_crossings`."""
    return _crossings(*_edges(vertices, closed))


def all_crossings(polygons: Sequence[Polygon]) -> int:
    """How often outlines cross themselves and each other."""
    edges = [_edges(polygon.vertices, polygon.closed) for polygon in polygons]
    starts, ends = (np.concatenate(side) for side in zip(*edges, strict=True))
    return _crossings(starts, ends)


def _edges(vertices: ComplexArray, closed: bool) -> tuple[ComplexArray, ComplexArray]:
    """Where the edges begin, and where they end."""
    return (vertices, np.roll(vertices, -1)) if closed else (vertices[:-1], vertices[1:])


def _crossings(starts: ComplexArray, ends: ComplexArray) -> int:
    flip = starts.real > ends.real
    starts, ends = np.where(flip, ends, starts), np.where(flip, starts, ends)
    edges = np.stack([starts.real, starts.imag, ends.real, ends.imag], axis=1)
    size = max(float(np.ptp(starts.real)), float(np.ptp(starts.imag)))
    return crossings.count_crossings(np.ascontiguousarray(edges[np.argsort(edges[:, 0])]), FLAT * size * size)
