"""What can be said of one outline: area, direction, crossings."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import crossings
from shapeblend_cli.model import Polygon

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray

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


def reversed_polygon(polygon: Polygon) -> Polygon:
    """The same polygon the other way round; a closed one keeps its first vertex."""
    order = np.arange(len(polygon.vertices))[::-1]
    if polygon.closed:
        order = np.roll(order, 1)
    return Polygon(polygon.vertices[order], polygon.segment[order], polygon.parameter[order], polygon.closed)


def self_crossings(vertices: ComplexArray, closed: bool) -> int:
    """How often an outline crosses itself, see `crossings.count_crossings`."""
    starts, ends = (vertices, np.roll(vertices, -1)) if closed else (vertices[:-1], vertices[1:])
    flip = starts.real > ends.real
    starts, ends = np.where(flip, ends, starts), np.where(flip, starts, ends)
    edges = np.stack([starts.real, starts.imag, ends.real, ends.imag], axis=1)
    size = max(float(np.ptp(vertices.real)), float(np.ptp(vertices.imag)))
    return crossings.count_crossings(np.ascontiguousarray(edges[np.argsort(edges[:, 0])]), FLAT * size * size)
