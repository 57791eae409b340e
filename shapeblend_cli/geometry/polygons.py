"""Area, orientation and interior of polygons, and contours traversed in reverse."""

from __future__ import annotations

import cmath
from functools import wraps
from typing import TYPE_CHECKING, TypeVar
from weakref import WeakKeyDictionary

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.crossings import polygon_crossings
from shapeblend_cli.geometry.raster import windings
from shapeblend_cli.model import Box, Contour, Polygon
from shapeblend_cli.model.arrays import rolled

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import ComplexArray, CubicPath, FloatArray, IntArray

NEARLY_ALL = 0.95
"""Minimum share of the interior of a polygon with crossings round which it runs one way, to have that orientation."""

UPRIGHT = 1e-6
"""Maximum slant of the sides of an upright rectangle, as a share of its larger side."""

Value = TypeVar("Value")

GRID = 24
"""Number of points along each side of the box at which the interior is sampled."""

ROUNDING = 1e-6
"""Tolerance of an upright unit vector."""


def signed_area(vertices: ComplexArray) -> float:
    """Return the area of a closed polygon; positive if it runs from x towards y."""
    return 0.5 * float((vertices.conj() * rolled(vertices, -1)).imag.sum())


def _found_once(find: Callable[[Polygon], Value]) -> Callable[[Polygon], Value]:
    """Keep what is found of a polygon as long as there is that: several stages ask for it."""
    found: WeakKeyDictionary[Polygon, Value] = WeakKeyDictionary()

    @wraps(find)
    def known(polygon: Polygon) -> Value:
        value = found.get(polygon)
        if value is None:
            value = found[polygon] = find(polygon)
        return value

    return known


@_found_once
def signed_area_of(polygon: Polygon) -> float:
    """Return `signed_area` of a closed polygon, which is known after the first time."""
    return signed_area(polygon.vertices)


def ring_edges(rings: Sequence[ComplexArray]) -> tuple[ComplexArray, ComplexArray]:
    """Return the starts and the ends of the edges of closed polygons, all in one."""
    return np.concatenate(rings), np.concatenate([part for ring in rings for part in (ring[1:], ring[:1])])


def centroid(vertices: ComplexArray) -> complex:
    """Return the centroid of a closed polygon's area; the mean of its vertices if it has none."""
    area = signed_area(vertices)
    origin = vertices[0]
    p, q = vertices - origin, rolled(vertices, -1) - origin
    size = float(np.abs(p).max())
    if abs(area) < 1e-9 * size * size:
        return complex(vertices.mean())
    return complex(origin + ((p + q) * (p.conj() * q).imag).sum() / (6.0 * area))


@_found_once
def crosses_itself(polygon: Polygon) -> bool:
    """Return whether a polygon crosses itself, which is known after the first time."""
    return polygon_crossings([polygon], most=1) > 0


@_found_once
def orientation(polygon: Polygon) -> int:
    """Return 1 if a polygon runs from x towards y, -1 if it runs the other way, 0 if that is undecided.

    The sign of the area decides if the polygon does not cross itself. If it does, the sum of its turns must agree, or
    nearly all of its interior must be on that side: the turns of a figure of eight cancel, and that one lobe is larger
    means nothing, but a small loop in a drawing's outline is a slip. Open polygons have no orientation.
    """
    if not polygon.closed:
        return 0
    vertices = polygon.vertices
    sign = int(np.sign(signed_area_of(polygon)))
    if crosses_itself(polygon):
        edges = rolled(vertices, -1) - vertices
        turns = np.angle(edges * rolled(edges, 1).conj()).sum() / (2.0 * np.pi)
        if sign * round(float(turns)) <= 0 and _share_with_sign(vertices, sign) < NEARLY_ALL:
            return 0
    return sign


def _share_with_sign(vertices: ComplexArray, sign: int) -> float:
    """Return the share of the interior, at a grid of points, whose winding number has the given sign."""
    numbers = winding_numbers(Box.around(vertices).grid(GRID), vertices)
    inside = np.count_nonzero(numbers)
    return float(np.count_nonzero(numbers * sign > 0) / inside) if inside else 0.0


def axis_of(doubled: complex) -> complex:
    """Return the unit vector, to the right or downwards, at half the angle of a number, as of a sum of squares."""
    axis = cmath.rect(1.0, 0.5 * cmath.phase(doubled))
    axis = axis if axis.real >= 0.0 else -axis
    return -axis if axis.imag < -1.0 + ROUNDING else axis


def polyline_contour(vertices: ComplexArray, closed: bool = True) -> Contour:
    """Return the contour that goes straight from vertex to vertex, (k,) complex; closed, as that of a polygon."""
    segments = cubics.lines(vertices, closed)
    return Contour(segments, np.ones(len(segments), bool), closed)


def rectangle(box: Box) -> Contour:
    """Return the outline of a box, from its first corner along its width."""
    left, top, right, bottom = box.bounds
    corners = [complex(left, top), complex(right, top), complex(right, bottom), complex(left, bottom)]
    return polyline_contour(np.array(corners))


def is_rectangle(path: CubicPath) -> bool:
    """Return whether a closed path is an upright rectangle."""
    nodes = path.segments[:, 0]
    sides = rolled(nodes, -1) - nodes
    slant = np.minimum(np.abs(sides.real), np.abs(sides.imag)).max()
    return len(nodes) == 4 and bool(path.straight.all()) and bool(slant <= UPRIGHT * np.abs(sides).max())


def reverse_contour(contour: Contour) -> Contour:
    """Return the contour traversed in reverse; a closed one keeps its first node."""
    return Contour(contour.segments[::-1, ::-1], contour.straight[::-1], contour.closed)


def reverse_polygon(polygon: Polygon, segments: int) -> Polygon:
    """Return the polygon of a reversed contour with this number of segments; a closed one keeps its first vertex."""
    order = np.arange(len(polygon.vertices))[::-1]
    if polygon.closed:
        order = rolled(order, 1)
    segment, parameter = polygon.segment[order], polygon.parameter[order]
    is_node = parameter == 0.0
    segment = np.where(is_node, segments - segment, segments - 1 - segment)
    parameter = np.where(is_node, 0.0, 1.0 - parameter)
    if polygon.closed:
        segment %= segments
    elif is_node[-1]:  # no segment begins at the end of an open contour
        segment[-1], parameter[-1] = segments - 1, 1.0
    return Polygon(polygon.vertices[order], segment, parameter, polygon.closed)


def winding_numbers(points: ComplexArray, vertices: ComplexArray) -> IntArray:
    """Return the winding number of a closed polygon around each point, positive from x towards y.

    These are the edges that cross the ray from a point along +x, upwards counted against downwards. Points on the
    polygon itself count to either side.

    Parameters
    ----------
    points : (p,) complex
    vertices : (m,) complex

    Returns
    -------
    (p,) int
    """
    return windings(points, vertices).astype(np.intp)


def mean_value_weights(point: complex, vertices: ComplexArray) -> FloatArray:
    """Return mean value coordinates: weights of a closed polygon's vertices, of sum 1, whose mean is the point.

    Parameters
    ----------
    point : complex
        Not on the polygon; on it, the nearest vertex has all the weight.
    vertices : (k,) complex
        Neighbours may coincide.

    Returns
    -------
    (k,) float
        Where the polygon is not convex some may be negative.

    References
    ----------
    M. S. Floater, "Mean value coordinates", Computer Aided Geometric Design 20 (2003), eq (2.1).
    """
    return mean_value_table(np.array([point]), vertices)[0]


def weighted_sums(weights: FloatArray, values: ComplexArray) -> ComplexArray:
    """Return sums of (k,) complex values by (p, k) weights, (p,) complex."""
    both = weights @ np.ascontiguousarray(values).view(np.float64).reshape(-1, 2)
    return np.ascontiguousarray(both).view(np.complex128).ravel()


def mean_value_table(points: ComplexArray, vertices: ComplexArray) -> FloatArray:
    """Return the mean value coordinates of several points, (p, k) float; see `mean_value_weights`."""
    spokes = vertices - points[:, None]
    lengths = np.abs(spokes)
    following, beyond = np.roll(spokes, -1, axis=1), np.roll(lengths, -1, axis=1)
    turned = spokes.conj() * following
    # tan(alpha / 2) of the angle between neighbouring spokes.
    below = lengths * beyond + turned.real
    is_off = (lengths.min(axis=1) > 0.0) & (below > 1e-12 * lengths * beyond).all(axis=1)
    weights = np.zeros(spokes.shape)
    tangents = turned.imag[is_off] / below[is_off]
    weights[is_off] = (np.roll(tangents, 1, axis=1) + tangents) / lengths[is_off]
    totals = weights.sum(axis=1)
    is_sound = np.abs(totals) > 1e-12 * np.abs(weights).sum(axis=1)
    weights[is_sound] /= totals[is_sound, None]
    weights[~is_sound] = 0.0
    weights[~is_sound, lengths[~is_sound].argmin(axis=1)] = 1.0
    return weights
