"""Parts of closed contours: runs of their segments, what lies on one side of a line, and lines through them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.model import Contour, Polygon
from shapeblend_cli.model.arrays import rolled

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray

ON_LINE = 1e-9
"""Maximum distance of a point on a line, as a share of the contour's size."""

AT_END = 1e-7
"""Maximum distance of a crossing from the end of a segment to be there, as a share of the segment's parameter."""


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


def with_vertices(polygon: Polygon, places: FloatArray) -> Polygon:
    """Return a closed polygon with vertices at more places: the number of an edge plus a share of it, (k,) each."""
    places = np.sort(places)
    edge = np.floor(places).astype(np.intp)
    share = places - edge
    after = (edge + 1) % len(polygon.vertices)
    start, end = polygon.vertices[edge], polygon.vertices[after]
    last = np.where(polygon.segment[after] == polygon.segment[edge], polygon.parameter[after], 1.0)
    parameter = (1.0 - share) * polygon.parameter[edge] + share * last
    return Polygon(
        np.insert(polygon.vertices, edge + 1, (1.0 - share) * start + share * end),
        np.insert(polygon.segment, edge + 1, polygon.segment[edge]),
        np.insert(polygon.parameter, edge + 1, parameter),
        closed=True,
    )


def left_of(contour: Contour, start: complex, end: complex) -> Contour | None:
    """Return the part of a closed contour to the left of a line, with y up; None if there is nothing.

    It is closed along the line. Several parts are one contour, joined along the line.
    """
    way = (end - start) / abs(end - start)
    segments = (contour.segments - start) * way.conjugate()
    slack = ON_LINE * float(np.abs(segments - segments[0, 0]).max())
    segments, straight = _cut_at_axis(segments, contour.straight, slack)
    middles = segments @ np.array([1.0, 3.0, 3.0, 1.0]) / 8.0
    kept = middles.imag > slack
    if not kept.any():
        return None
    segments, straight = segments[kept], straight[kept]
    found, lines = [], []
    for k in range(len(segments)):
        gap = cubics.line(segments[k - 1, 3], segments[k, 0])
        if abs(gap[3] - gap[0]) > slack:
            found.append(gap)
            lines.append(True)
        found.append(segments[k])
        lines.append(bool(straight[k]))
    return Contour(np.array(found) * way + start, np.array(lines), closed=True)


def _cut_at_axis(segments: ComplexArray, straight: BoolArray, slack: float) -> tuple[ComplexArray, BoolArray]:
    """Cut segments where they cross the real axis."""
    starts, ends, numbers = [], [], []
    for k, (p, q, r, s) in enumerate(segments.imag):
        times = np.array([])
        if min(p, q, r, s) < -slack and max(p, q, r, s) > slack:
            roots = np.roots([s - 3.0 * (r - q) - p, 3.0 * (r - 2.0 * q + p), 3.0 * (q - p), p])
            times = np.sort(roots.real[np.abs(roots.imag) < AT_END])
            times = times[(times > AT_END) & (times < 1.0 - AT_END)]
        starts += [0.0, *times]
        ends += [*times, 1.0]
        numbers += [k] * (len(times) + 1)
    return cubics.pieces(segments[numbers], np.array(starts), np.array(ends)), straight[numbers]


def lie_inside(starts: ComplexArray, ends: ComplexArray, boundary: ComplexArray) -> BoolArray:
    """Return whether lines between vertices of a boundary lie inside it, and do not meet it."""
    inner = starts[:, None] + (ends - starts)[:, None] * np.array([0.02, 0.25, 0.5, 0.75, 0.98])
    inside = (winding_numbers(inner.ravel(), boundary) != 0).reshape(inner.shape).all(axis=1)
    left = np.flatnonzero(inside)
    inside[left] = ~meet(starts[left], ends[left], boundary)
    return inside


def meet(starts: ComplexArray, ends: ComplexArray, boundary: ComplexArray) -> BoolArray:
    """Return whether lines cross a boundary."""
    start, end = starts[:, None], ends[:, None]
    following = rolled(boundary, -1)
    back, edges = np.conj(end - start), np.conj(following - boundary)
    sides = [(back * (each - start)).imag for each in (boundary, following)]
    own_sides = [(edges * (each - boundary)).imag for each in (start, end)]
    return ((sides[0] * sides[1] < 0.0) & (own_sides[0] * own_sides[1] < 0.0)).any(axis=1)
