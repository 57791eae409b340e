"""Cubic Bezier segments, all in one array and computed at once.

A chain of k segments is a (k, 4) complex array of control points, as in `model.Contour`. This file is compiled by
Cython and runs uncompiled as well.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.model import Box

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.libc.math import ceil, floor, sqrt
else:
    from math import ceil, floor, sqrt

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray, Polygon

COMPILED = cython.compiled

ARC_PIECES = 32
"""Number of pieces of equal parameter on which a segment's length is summed."""

# Gauss-Legendre nodes and weights of order 4 on [0, 1], spelt out because numpy.polynomial is slow to import.
_NODES = 0.5 + 0.5 * np.array(
    [-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526]
)
_WEIGHTS = 0.5 * np.array([0.34785484513745385, 0.6521451548625461, 0.6521451548625461, 0.34785484513745385])

# The places of all nodes on a segment, and what each control point adds to the derivative there.
_PLACES = (np.arange(ARC_PIECES)[:, None] + _NODES).ravel() / ARC_PIECES
_BASIS = np.stack([(1.0 - _PLACES) ** 2, 2.0 * _PLACES * (1.0 - _PLACES), _PLACES * _PLACES])

_THIRDS = np.array([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0])


def evaluate(segments: ComplexArray, t: FloatArray) -> ComplexArray:
    """Return points at parameters `t`, which broadcast against the segments' leading axes."""
    if segments.ndim == 2 and np.shape(t) == segments.shape[:1]:
        found = np.empty(len(segments), np.complex128)
        _evaluate(_coordinates(segments), t, found.view(np.float64))
        return found
    p0, p1, p2, p3 = (segments[..., k] for k in range(4))
    u = 1.0 - t
    return u * u * (u * p0 + 3.0 * t * p1) + t * t * (3.0 * u * p2 + t * p3)


def _coordinates(segments: ComplexArray) -> FloatArray:
    """Return x and y of the control points by turns, (k, 8)."""
    return np.ascontiguousarray(segments, np.complex128).view(np.float64)


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _at(
    a: cython.double, b: cython.double, c: cython.double, d: cython.double, t: cython.double
) -> cython.double:
    """Return a coordinate of a segment at a parameter."""
    u: cython.double = 1.0 - t
    return u * u * (u * a + 3.0 * t * b) + t * t * (3.0 * u * c + t * d)


@cython.boundscheck(False)
@cython.wraparound(False)
def _evaluate(
    segments: cython.const[cython.double][:, ::1],
    t: cython.const[cython.double][:],
    found: cython.double[::1],
) -> None:
    """Fill in x and y of each segment at its parameter, one after the other."""
    k: cython.Py_ssize_t
    for k in range(segments.shape[0]):
        found[2 * k] = _at(segments[k, 0], segments[k, 2], segments[k, 4], segments[k, 6], t[k])
        found[2 * k + 1] = _at(segments[k, 1], segments[k, 3], segments[k, 5], segments[k, 7], t[k])


def polyline(segments: ComplexArray, parts: int) -> ComplexArray:
    """Return points along a path at even parameters, `parts` a segment, without its end."""
    return evaluate(segments[:, None, :], np.arange(parts) / parts).ravel()


def arc_lengths(segments: ComplexArray) -> FloatArray:
    """Return lengths of `ARC_PIECES` pieces of equal parameter of each segment, (k, ARC_PIECES) float.

    They are four-point Gauss quadratures of the speed.
    """
    hodograph = 3.0 * (segments[:, 1:] - segments[:, :-1])
    speed = np.abs(hodograph @ _BASIS).reshape(len(segments), ARC_PIECES, len(_NODES))
    return speed @ (_WEIGHTS / ARC_PIECES)


def lengths(segments: ComplexArray) -> FloatArray:
    """Return the arc length of each segment, (k,) float."""
    return arc_lengths(segments).sum(axis=1)


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def longest_piece(
    lengths: cython.const[cython.double][::1],
    low: cython.double,
    high: cython.double,
    pieces: cython.double,
    halvings: cython.int,
) -> float:
    """Return the length of a piece, from low to high, of which all lengths have so many at the most, by bisection."""
    for _ in range(halvings):
        middle: cython.double = 0.5 * (low + high)
        count: cython.double = 0.0
        k: cython.Py_ssize_t
        for k in range(lengths.shape[0]):
            count += ceil(lengths[k] / middle)
        if count <= pieces:
            high = middle
        else:
            low = middle
    return high


def pieces(segments: ComplexArray, start: FloatArray, end: FloatArray) -> ComplexArray:
    """Return the part of each segment between two parameters in [0, 1], (k, 4) complex, by blossoming."""
    found = np.empty((len(segments), 4), np.complex128)
    _cut(_coordinates(segments), start, end, found.view(np.float64))
    return found


@cython.boundscheck(False)
@cython.wraparound(False)
def _cut(
    segments: cython.const[cython.double][:, ::1],
    start: cython.const[cython.double][:],
    end: cython.const[cython.double][:],
    found: cython.double[:, ::1],
) -> None:
    """Fill in x and y of the points of the parts of segments between two parameters."""
    k: cython.Py_ssize_t
    for k in range(segments.shape[0]):
        _cut_one(segments, k, start[k], end[k], found, k)


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _cut_one(
    segments: cython.const[cython.double][:, ::1],
    number: cython.Py_ssize_t,
    start: cython.double,
    end: cython.double,
    found: cython.double[:, ::1],
    row: cython.Py_ssize_t,
) -> cython.void:
    """Fill in a row: x and y of the points of the part of a segment between two parameters."""
    which: cython.int
    for which in range(4):
        r: cython.double = end if which > 2 else start
        s: cython.double = end if which > 1 else start
        t: cython.double = end if which > 0 else start
        x0, x1, x2, x3 = (
            segments[number, 0],
            segments[number, 2],
            segments[number, 4],
            segments[number, 6],
        )
        y0, y1, y2, y3 = (
            segments[number, 1],
            segments[number, 3],
            segments[number, 5],
            segments[number, 7],
        )
        x0, x1, x2 = x0 + (x1 - x0) * r, x1 + (x2 - x1) * r, x2 + (x3 - x2) * r
        y0, y1, y2 = y0 + (y1 - y0) * r, y1 + (y2 - y1) * r, y2 + (y3 - y2) * r
        x0, x1 = x0 + (x1 - x0) * s, x1 + (x2 - x1) * s
        y0, y1 = y0 + (y1 - y0) * s, y1 + (y2 - y1) * s
        found[row, 2 * which] = x0 + (x1 - x0) * t
        found[row, 2 * which + 1] = y0 + (y1 - y0) * t


def pieces_between(
    segments: ComplexArray,
    straight: BoolArray,
    edges: tuple[IntArray, FloatArray, FloatArray],
    closed: bool,
    positions: FloatArray,
    *,
    joined: bool,
) -> tuple[ComplexArray, BoolArray, FloatArray]:
    """Return the parts of segments between neighbouring positions on the edges of a contour's polygon.

    Parameters
    ----------
    segments : (k, 4) complex
    straight : (k,) bool
    edges : ((e,) int, (e,) float, (e,) float)
        The segment on which each edge lies, and its parameters there, from and to.
    closed : bool
    positions : (s + 1,) float
        Numbers of edges, and between them; they rise, on closed contours on beyond e.
    joined : bool
        Each part is to end where the next begins, and a part between equal positions is a point.

    Returns
    -------
    parts : (s, 4) complex
    straight : (s,) bool
        Those of straight segments, and points that are asked for.
    spans : (s,) float
        Their extents in the parameters of their segments.
    """
    count = len(positions) - 1
    found = np.empty((count, 4), np.complex128), np.empty(count, np.bool_), np.empty(count)
    _fill_pieces(_coordinates(segments), straight, edges, closed, positions, joined, found)
    return found


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _fill_pieces(
    segments: cython.const[cython.double][:, ::1],
    are_straight: BoolArray,
    edges: tuple[IntArray, FloatArray, FloatArray],
    closed: cython.bint,
    positions: cython.const[cython.double][:],
    joined: cython.bint,
    found: tuple[ComplexArray, BoolArray, FloatArray],
) -> None:
    """Fill in what `pieces_between` returns."""
    straight: cython.const[cython.uchar][:] = are_straight.view(np.uint8)
    segment: cython.const[cython.Py_ssize_t][:] = edges[0]
    start: cython.const[cython.double][:] = edges[1]
    end: cython.const[cython.double][:] = edges[2]
    parts: cython.double[:, ::1] = found[0].view(np.float64)
    lines: cython.uchar[::1] = found[1].view(np.uint8)
    spans: cython.double[::1] = found[2]
    count: cython.Py_ssize_t = segment.shape[0]
    last: cython.Py_ssize_t = spans.shape[0] - 1
    k: cython.Py_ssize_t
    i: cython.Py_ssize_t
    for k in range(last + 1):
        begins: cython.Py_ssize_t = cython.cast(cython.Py_ssize_t, floor(positions[k]))
        ends: cython.Py_ssize_t = max(cython.cast(cython.Py_ssize_t, ceil(positions[k + 1])) - 1, begins)
        if not closed:
            begins, ends = min(begins, count - 1), min(ends, count - 1)
        at: cython.Py_ssize_t = begins % count if begins >= 0 else count - 1 - (-1 - begins) % count
        till: cython.Py_ssize_t = ends % count if ends >= 0 else count - 1 - (-1 - ends) % count
        low: cython.double = start[at] + (end[at] - start[at]) * (positions[k] - begins)
        high: cython.double = start[till] + (end[till] - start[till]) * (positions[k + 1] - ends)
        high = max(high, low)
        _cut_one(segments, segment[at], low, high, parts, k)
        lines[k] = straight[segment[at]]
        spans[k] = high - low
    if not joined:
        return
    for k in range(last + 1):
        if k < last or closed:
            parts[k, 6] = parts[k + 1 if k < last else 0, 0]
            parts[k, 7] = parts[k + 1 if k < last else 0, 1]
    for k in range(last + 1):
        if positions[k + 1] <= positions[k]:
            lines[k] = 1
            for i in range(1, 4):
                parts[k, 2 * i], parts[k, 2 * i + 1] = parts[k, 0], parts[k, 1]


def in_betweens(
    segments_a: ComplexArray, segments_b: ComplexArray, counts: IntArray, times: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return points of paths between two others, at even parameters of each segment, and the lengths up to each.

    Parameters
    ----------
    segments_a, segments_b : (s, 4) complex
    counts : (s,) int
        The number of points on each segment; the end of the last one is one more.
    times : (t,) float

    Returns
    -------
    points : (t, n, 2) float
    lengths : (t, n) float
    """
    number = int(counts.sum()) + 1
    points, lengths = np.empty((len(times), number, 2)), np.empty((len(times), number))
    _sample(_coordinates(segments_a), _coordinates(segments_b), counts, times, points, lengths)
    return points, lengths


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _sample(
    segments_a: cython.const[cython.double][:, ::1],
    segments_b: cython.const[cython.double][:, ::1],
    counts: cython.const[cython.Py_ssize_t][::1],
    times: cython.const[cython.double][::1],
    points: cython.double[:, :, ::1],
    lengths: cython.double[:, ::1],
) -> None:
    """Fill in what `in_betweens` returns."""
    at: cython.Py_ssize_t = 0
    last: cython.Py_ssize_t = counts.shape[0] - 1
    k: cython.Py_ssize_t
    i: cython.Py_ssize_t
    n: cython.Py_ssize_t
    axis: cython.int
    for k in range(last + 1):
        for n in range(counts[k] + (1 if k == last else 0)):
            t: cython.double = cython.cast(cython.double, n) / counts[k]
            for axis in range(2):
                a: cython.double = segments_a[k, 6 + axis]
                b: cython.double = segments_b[k, 6 + axis]
                if n < counts[k]:
                    a = _at(segments_a[k, axis], segments_a[k, 2 + axis], segments_a[k, 4 + axis], a, t)
                    b = _at(segments_b[k, axis], segments_b[k, 2 + axis], segments_b[k, 4 + axis], b, t)
                for i in range(times.shape[0]):
                    points[i, at, axis] = a + times[i] * (b - a)
            at += 1
    for i in range(times.shape[0]):
        lengths[i, 0] = 0.0
        for k in range(1, at):
            x: cython.double = points[i, k, 0] - points[i, k - 1, 0]
            y: cython.double = points[i, k, 1] - points[i, k - 1, 1]
            lengths[i, k] = lengths[i, k - 1] + sqrt(x * x + y * y)


def chord_deviation(segments: ComplexArray) -> FloatArray:
    """Return a bound on each segment's distance from its chord, (k,) float.

    The distance to a convex set is convex, and at parameter t the two inner control points weigh
    ``3 t (1 - t) <= 3/4`` together; the ends lie on the chord. So three quarters of the larger distance
    of an inner point bounds the curve's, and is reached where both lie equally far off.
    """
    found = np.empty(len(segments))
    _find_deviations(_coordinates(segments), found)
    return found


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _find_deviations(segments: cython.const[cython.double][:, ::1], found: cython.double[::1]) -> None:
    """Fill in what `chord_deviation` returns."""
    k: cython.Py_ssize_t
    i: cython.Py_ssize_t
    for k in range(segments.shape[0]):
        across: cython.double = segments[k, 6] - segments[k, 0]
        down: cython.double = segments[k, 7] - segments[k, 1]
        square: cython.double = across * across + down * down
        if square == 0.0:
            square = 1.0
        most: cython.double = 0.0
        for i in range(2, 6, 2):
            x: cython.double = segments[k, i] - segments[k, 0]
            y: cython.double = segments[k, i + 1] - segments[k, 1]
            along: cython.double = min(max((x * across + y * down) / square, 0.0), 1.0)
            x -= along * across
            y -= along * down
            most = max(most, x * x + y * y)
        found[k] = 0.75 * sqrt(most)


def bounds(segments: ComplexArray) -> Box:
    """Return the smallest box around the curves."""
    left, right = _range(segments.real)
    top, bottom = _range(segments.imag)
    return Box(left, top, right - left, bottom - top)


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _range(points: cython.const[cython.double][:, :]) -> tuple[float, float]:
    """Return the least and the largest value of one coordinate of the curves."""
    low: cython.double = points[0, 0]
    high: cython.double = low
    k: cython.Py_ssize_t
    which: cython.int
    for k in range(points.shape[0]):
        p0, p1, p2, p3 = points[k, 0], points[k, 1], points[k, 2], points[k, 3]
        low, high = min(low, p0, p3), max(high, p0, p3)
        if low <= p1 <= high and low <= p2 <= high:
            continue  # the curve lies between its control points
        # The derivative in monomial form: a t^2 + 2 b t + c. Written so that neither root cancels.
        c: cython.double = p1 - p0
        b: cython.double = (p2 - p1) - c
        a: cython.double = (p3 - p2) - 2.0 * (p2 - p1) + c
        discriminant: cython.double = b * b - a * c
        if discriminant < 0.0:
            continue
        big: cython.double = -b - sqrt(discriminant) if b >= 0.0 else -b + sqrt(discriminant)
        for which in range(2):
            above: cython.double = c if which else big
            below: cython.double = big if which else a
            if below != 0.0 and 0.0 < above / below < 1.0:
                value: cython.double = _at(p0, p1, p2, p3, above / below)
                low, high = min(low, value), max(high, value)
    return low, high


def signed_area(segments: ComplexArray) -> float:
    """Return the area between a chain of segments and the line from its end to its start, see `polygons`."""
    return _area(_coordinates(segments), _NODES, _WEIGHTS)


@cython.boundscheck(False)
@cython.wraparound(False)
def _area(
    segments: cython.const[cython.double][:, ::1],
    nodes: cython.const[cython.double][::1],
    weights: cython.const[cython.double][::1],
) -> float:
    """Return what `signed_area` does, by a quadrature that is exact."""
    last: cython.Py_ssize_t = segments.shape[0] - 1
    swept: cython.double = 0.0
    k: cython.Py_ssize_t
    n: cython.Py_ssize_t
    for k in range(last + 1):
        x0, x1, x2, x3 = (
            segments[k, 0],
            segments[k, 2],
            segments[k, 4],
            segments[k, 6],
        )
        y0, y1, y2, y3 = (
            segments[k, 1],
            segments[k, 3],
            segments[k, 5],
            segments[k, 7],
        )
        for n in range(nodes.shape[0]):
            t: cython.double = nodes[n]
            u: cython.double = 1.0 - t
            dx: cython.double = u * u * (x1 - x0) + 2.0 * t * u * (x2 - x1) + t * t * (x3 - x2)
            dy: cython.double = u * u * (y1 - y0) + 2.0 * t * u * (y2 - y1) + t * t * (y3 - y2)
            x: cython.double = _at(x0, x1, x2, x3, t)
            y: cython.double = _at(y0, y1, y2, y3, t)
            swept += weights[n] * 3.0 * (x * dy - y * dx)
    return 0.5 * (swept + segments[last, 6] * segments[0, 1] - segments[last, 7] * segments[0, 0])


def line(start: complex | ComplexArray, end: complex | ComplexArray) -> ComplexArray:
    """Return a straight segment, (4,) complex, its inner points at thirds; or several, from (k, 1) to (k, 1)."""
    return start + (end - start) * _THIRDS


def lines(vertices: ComplexArray, closed: bool) -> ComplexArray:
    """Return straight segments from vertex to vertex, (k, 4) complex; of a closed polygon as many as its vertices."""
    starts, ends = (vertices, np.roll(vertices, -1)) if closed else (vertices[:-1], vertices[1:])
    return starts[:, None] + (ends - starts)[:, None] * _THIRDS


def directions(segments: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
    """Return unit tangents at the start and the end of each segment, both (k,) complex, in the direction of travel.

    Where a handle has no length the next control point that lies elsewhere gives the direction, as it does in
    the limit. A segment that is a point has none: zero.
    """
    found = np.empty((2, len(segments)), np.complex128)
    _find_directions(_coordinates(segments), found.view(np.float64))
    return found[0], found[1]


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _find_directions(segments: cython.const[cython.double][:, ::1], found: cython.double[:, ::1]) -> None:
    """Fill in x and y of the unit tangents at the starts, and of those at the ends."""
    k: cython.Py_ssize_t
    i: cython.Py_ssize_t
    end: cython.int
    for k in range(segments.shape[0]):
        extent: cython.double = 0.0
        for i in range(1, 4):
            x: cython.double = segments[k, 2 * i] - segments[k, 0]
            y: cython.double = segments[k, 2 * i + 1] - segments[k, 1]
            extent = max(extent, sqrt(x * x + y * y))
        for end in range(2):
            found[end, 2 * k] = found[end, 2 * k + 1] = 0.0
            for i in range(1, 4):
                x = segments[k, 6 - 2 * i] - segments[k, 6] if end else segments[k, 2 * i] - segments[k, 0]
                y = (
                    segments[k, 7 - 2 * i] - segments[k, 7]
                    if end
                    else segments[k, 2 * i + 1] - segments[k, 1]
                )
                length: cython.double = sqrt(x * x + y * y)
                if length > 1e-6 * extent:
                    found[end, 2 * k] = -x / length if end else x / length
                    found[end, 2 * k + 1] = -y / length if end else y / length
                    break


def fill_edge_parts(
    segments: ComplexArray,
    polygon: Polygon,
    coincident: float,
    segment: IntArray,
    start: FloatArray,
    end: FloatArray,
) -> None:
    """Fill in the segment on which each edge of a contour's polygon lies, and its parameters there, from and to.

    Parameters
    ----------
    segments : (k, 4) complex
    polygon : Polygon
    coincident : float
        Maximum extent of a segment that is a point and has no edge, as a share of the contour's.
    segment, start, end : (e,) int and float
        As many as edges.
    """
    before = np.empty(len(segments), np.intp)
    _find_real_before(_coordinates(segments), coincident, before)
    _fill_edge_parts(polygon.segment, polygon.parameter, polygon.closed, before, segment, start, end)


@cython.boundscheck(False)
@cython.wraparound(False)
def _find_real_before(
    segments: cython.const[cython.double][:, ::1], coincident: cython.double, before: cython.Py_ssize_t[::1]
) -> None:
    """Find the segment before each that is more than a point, before the first one the last."""
    k: cython.Py_ssize_t
    i: cython.Py_ssize_t
    size: cython.double = 0.0
    for k in range(segments.shape[0]):
        for i in range(4):
            x: cython.double = segments[k, 2 * i] - segments[0, 0]
            y: cython.double = segments[k, 2 * i + 1] - segments[0, 1]
            size = max(size, x * x + y * y)
    size = coincident * sqrt(size)
    last: cython.Py_ssize_t = 0
    for _ in range(2):
        for k in range(segments.shape[0]):
            before[k] = last
            extent: cython.double = 0.0
            for i in range(1, 4):
                x = segments[k, 2 * i] - segments[k, 0]
                y = segments[k, 2 * i + 1] - segments[k, 1]
                extent = max(extent, x * x + y * y)
            if sqrt(extent) > size:
                last = k


@cython.boundscheck(False)
@cython.wraparound(False)
def _fill_edge_parts(
    own_segment: cython.const[cython.Py_ssize_t][::1],
    parameter: cython.const[cython.double][::1],
    closed: cython.bint,
    before: cython.const[cython.Py_ssize_t][::1],
    segment: cython.Py_ssize_t[::1],
    start: cython.double[::1],
    end: cython.double[::1],
) -> None:
    """Fill in the segments and parameters of edges, given those of vertices, and the segment before each segment."""
    k: cython.Py_ssize_t
    vertices: cython.Py_ssize_t = own_segment.shape[0]
    count: cython.Py_ssize_t = segment.shape[0]
    for k in range(count):
        following: cython.Py_ssize_t = k + 1 if k + 1 < vertices else 0
        # An edge that ends at a node lies on the segment before it.
        at_node: cython.bint = parameter[following] == 0.0
        segment[k] = before[own_segment[following]] if at_node else own_segment[following]
        start[k] = parameter[k] if segment[k] == own_segment[k] else 0.0
        end[k] = 1.0 if at_node else parameter[following]
    for k in range(count):
        if segment[k + 1 if k + 1 < count else 0] != segment[k] or (k == count - 1 and not closed):
            end[k] = 1.0
