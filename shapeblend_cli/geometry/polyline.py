"""Polylines: length along them, points at given lengths, repeated and fewer points, what is near, cuts, even values.

This file is compiled by Cython and runs uncompiled as well.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.libc.math import floor, fmod, sqrt
else:
    from math import floor, fmod, sqrt

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray

COMPILED = cython.compiled

INFINITY = cython.declare(cython.double, float("inf"))

cython.declare(REACH=cython.Py_ssize_t)
REACH = 3
"""Number of edges to either side of a place that are near it."""

cython.declare(BLOCK=cython.Py_ssize_t, LEAST_SQUARE=cython.double)
BLOCK = 16
"""Number of edges, one after the other, that are passed over together where their box is not near."""

LEAST_SQUARE = 1e-300
"""Minimum squared length of an edge: of one without a length, every place is its start."""

SURELY_LESS = cython.declare(cython.double, 1.0 - 1e-12)
"""Maximum ratio of squared distances of which the lesser one is less, whatever is rounded."""

AT_ONCE = 1 << 20
"""Maximum number of distances computed at once: arrays of sixteen times as many bytes."""


def from_end_to_end(vertices: ComplexArray, closed: bool) -> ComplexArray:
    """Return the vertices, of a closed polygon with the first repeated at the end."""
    return np.concatenate([vertices, vertices[:1]]) if closed else vertices


def cumulative_lengths(points: ComplexArray) -> FloatArray:
    """Return the length from the first point up to each, (n,) float."""
    lengths = np.zeros(len(points))
    np.cumsum(np.abs(points[1:] - points[:-1]), out=lengths[1:])
    return lengths


def interpolated(
    values: FloatArray, known: FloatArray, results: FloatArray, closed: bool = False
) -> FloatArray:
    """Return what `numpy.interp` does, sooner where there are few values.

    Parameters
    ----------
    values : (k,) float
    known, results : (n,) float
        The results at known values, which rise.
    closed : bool
        Both go on beyond the last one as from 0, again and again.

    Examples
    --------
    >>> interpolated(np.array([0.5, 3.5]), np.array([0.0, 1.0, 3.0]), np.array([0.0, 10.0, 20.0])).tolist()
    [5.0, 20.0]
    >>> interpolated(np.array([0.5, 3.5]), np.array([0.0, 1.0, 3.0]), np.array([0.0, 10.0, 20.0]), True).tolist()
    [5.0, 25.0]
    """
    found = np.empty(len(values))
    _interpolate(values, known, results, closed, found)
    return found


@cython.cfunc
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _interpolate(
    values: cython.const[cython.double][:],
    known: cython.const[cython.double][:],
    results: cython.const[cython.double][:],
    closed: cython.bint,
    found: cython.double[::1],
) -> cython.void:
    """Fill in the results at values; the search begins where the last one ended."""
    last: cython.Py_ssize_t = known.shape[0] - 1
    end: cython.double = known[last]
    at: cython.Py_ssize_t = 0
    k: cython.Py_ssize_t
    for k in range(values.shape[0]):
        value: cython.double = values[k]
        lift: cython.double = 0.0
        if closed and not 0.0 <= value < end:
            # Whole rounds, as `numpy.floor_divide` has them.
            rest: cython.double = fmod(value, end)
            rounds: cython.double = (value - rest) / end
            if rest < 0.0:
                rounds -= 1.0
            whole: cython.double = floor(rounds)
            rounds = whole + 1.0 if rounds - whole > 0.5 else whole
            lift = rounds * results[last]
            value -= rounds * end
        if value < known[0]:
            found[k] = lift + results[0]
            continue
        # The last known value that is no greater.
        if known[at] > value:
            at = 0
        beyond: cython.Py_ssize_t = at + 1
        step: cython.Py_ssize_t = 1
        while beyond <= last and known[beyond] <= value:
            at = beyond
            step *= 2
            beyond += step
        beyond = min(beyond, last + 1)
        while at + 1 < beyond:
            middle: cython.Py_ssize_t = (at + beyond) // 2
            if known[middle] <= value:
                at = middle
            else:
                beyond = middle
        result: cython.double = results[at]
        if at < last and known[at] != value:
            slope: cython.double = (results[at + 1] - results[at]) / (known[at + 1] - known[at])
            result = slope * (value - known[at]) + results[at]
        found[k] = lift + result


def points_at(positions: FloatArray, points: ComplexArray, known: FloatArray) -> ComplexArray:
    """Return points at positions along a polyline, where the positions of its own points are known."""
    flat = positions.ravel()
    x, y = interpolated(flat, known, points.real), interpolated(flat, known, points.imag)
    return (x + 1j * y).reshape(positions.shape)


def distinct(points: ComplexArray, closed: bool, distance: float) -> IntArray:
    """Return the numbers of the points that are further than `distance` from the last one kept."""
    near = np.abs(np.diff(points)) <= distance
    if near.any():
        kept = [0]
        for k in range(1, len(points)):
            if abs(points[k] - points[kept[-1]]) > distance:
                kept.append(k)
    else:
        kept = list(range(len(points)))
    while closed and len(kept) > 1 and abs(points[kept[-1]] - points[kept[0]]) <= distance:
        kept.pop()
    return np.array(kept, np.intp)


def thin(points: ComplexArray, most: int) -> ComplexArray:
    """Return every k-th point, with the smallest k for at most `most` points."""
    return points[:: -(-len(points) // most)]


def needed(points: ComplexArray, tolerance: float) -> BoolArray:
    """Return which points of a polyline are needed to keep within a tolerance of it (Douglas and Peucker 1973).

    >>> needed(np.array([0.0, 1.0 + 0.1j, 2.0, 2.0 + 2.0j]), 0.2).tolist()
    [True, False, True, True]
    """
    keep = np.zeros(len(points), np.uint8)
    keep[[0, -1]] = 1
    _keep_needed(np.ascontiguousarray(points), tolerance, np.empty(2 * len(points), np.intp), keep)
    return keep.view(np.bool_)


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _keep_needed(
    points: cython.const[cython.doublecomplex][::1],
    tolerance: cython.double,
    spans: cython.Py_ssize_t[::1],
    keep: cython.uchar[::1],
) -> None:
    """Mark the furthest point of each span between marked ones, while that is beyond the tolerance."""
    k: cython.Py_ssize_t
    count: cython.Py_ssize_t = 1
    spans[0], spans[1] = 0, points.shape[0] - 1
    while count:
        count -= 1
        first: cython.Py_ssize_t = spans[2 * count]
        last: cython.Py_ssize_t = spans[2 * count + 1]
        dx: cython.double = points[last].real - points[first].real
        dy: cython.double = points[last].imag - points[first].imag
        size: cython.double = sqrt(dx * dx + dy * dy)
        furthest: cython.Py_ssize_t = -1
        most: cython.double = tolerance
        for k in range(first + 1, last):
            x: cython.double = points[k].real - points[first].real
            y: cython.double = points[k].imag - points[first].imag
            away: cython.double = abs(y * dx - x * dy) / size if size > 1e-12 else sqrt(x * x + y * y)
            if away > most:
                most, furthest = away, k
        if furthest >= 0:
            keep[furthest] = 1
            spans[2 * count], spans[2 * count + 1] = first, furthest
            spans[2 * count + 2], spans[2 * count + 3] = furthest, last
            count += 2


def clipped(polygon: ComplexArray, corner: complex, edge: complex) -> ComplexArray:
    """Return the part of a convex polygon on one side of a line, perhaps nothing (Sutherland and Hodgman 1974).

    Parameters
    ----------
    polygon : (n,) complex
    corner, edge : complex
        A point of the line, and its direction. What stays is to the right of it where y points down, as in SVG.

    Examples
    --------
    >>> clipped(np.array([0j, 2 + 0j, 2 + 2j, 2j]), 1j, 1 + 0j).tolist()
    [(2+1j), (2+2j), 2j, 1j]
    """
    found = np.empty(2 * len(polygon), np.complex128)
    return found[: _clip(np.ascontiguousarray(polygon), corner, edge, found)]


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _clip(
    polygon: cython.const[cython.doublecomplex][::1],
    corner: cython.doublecomplex,
    edge: cython.doublecomplex,
    found: cython.doublecomplex[::1],
) -> int:
    """Fill in the corners of what stays, and return their number."""
    count: cython.Py_ssize_t = 0
    size: cython.Py_ssize_t = polygon.shape[0]
    k: cython.Py_ssize_t
    for k in range(size):
        p: cython.doublecomplex = polygon[k]
        q: cython.doublecomplex = polygon[k + 1 if k + 1 < size else 0]
        # Distances from the line, in lengths of the edge squared.
        here: cython.double = (p.imag - corner.imag) * edge.real - (p.real - corner.real) * edge.imag
        there: cython.double = (q.imag - corner.imag) * edge.real - (q.real - corner.real) * edge.imag
        if here > 0.0:
            found[count] = p
            count += 1
        if (here > 0.0) != (there > 0.0):
            share: cython.double = here / (here - there)
            found[count] = p + share * (q - p)
            count += 1
    return count


def nearest_edges(
    points: ComplexArray, starts: ComplexArray, ends: ComplexArray
) -> tuple[FloatArray, IntArray, FloatArray]:
    """Return the nearest of some edges to each point: the first of those as near.

    Parameters
    ----------
    points : (p,) complex
    starts, ends : (n,) complex, n >= 1

    Returns
    -------
    distance : (p,) float
    edge : (p,) int
    share : (p,) float
        The place on the edge that is nearest, from 0 at its start to 1 at its end.
    """
    distance, edge, share = np.empty(len(points)), np.empty(len(points), np.intp), np.empty(len(points))
    boxes, slopes = np.empty((-(-len(starts) // BLOCK), 4)), np.empty(len(starts))
    whole = [np.ascontiguousarray(each) for each in (points, starts, ends - starts)]
    _find_nearest(*whole, boxes, slopes, distance, edge, share)
    return distance, edge, share


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _find_nearest(
    points: cython.const[cython.doublecomplex][::1],
    starts: cython.const[cython.doublecomplex][::1],
    ways: cython.const[cython.doublecomplex][::1],
    boxes: cython.double[:, ::1],
    slopes: cython.double[::1],
    distance: cython.double[::1],
    edge: cython.Py_ssize_t[::1],
    share: cython.double[::1],
) -> None:
    """Find the nearest edge to each point: in the block of the last one first, then in those whose boxes are near.

    The boxes around blocks, and the reciprocals of squared lengths, are filled in.
    """
    nearest: cython.Py_ssize_t = 0
    p: cython.Py_ssize_t
    b: cython.Py_ssize_t
    k: cython.Py_ssize_t
    for b in range(boxes.shape[0]):
        boxes[b, 0] = boxes[b, 2] = INFINITY
        boxes[b, 1] = boxes[b, 3] = -INFINITY
    for k in range(starts.shape[0]):
        x: cython.double = starts[k].real
        y: cython.double = starts[k].imag
        dx: cython.double = ways[k].real
        dy: cython.double = ways[k].imag
        b = k // BLOCK
        boxes[b, 0] = min(boxes[b, 0], min(x, x + dx))
        boxes[b, 1] = max(boxes[b, 1], max(x, x + dx))
        boxes[b, 2] = min(boxes[b, 2], min(y, y + dy))
        boxes[b, 3] = max(boxes[b, 3], max(y, y + dy))
        slopes[k] = 1.0 / max(dx * dx + dy * dy, LEAST_SQUARE)
    for p in range(points.shape[0]):
        px: cython.double = points[p].real
        py: cython.double = points[p].imag
        least: cython.double = INFINITY
        place: cython.double = 0.0
        last: cython.Py_ssize_t = nearest // BLOCK
        for b in range(-1, boxes.shape[0]):
            block: cython.Py_ssize_t = last if b < 0 else b
            if b == last:
                continue
            aside: cython.double = max(boxes[block, 0] - px, px - boxes[block, 1])
            above: cython.double = max(boxes[block, 2] - py, py - boxes[block, 3])
            if (aside > 0.0 and aside * aside > least) or (above > 0.0 and above * above > least):
                continue
            for k in range(block * BLOCK, min(starts.shape[0], (block + 1) * BLOCK)):
                x = px - starts[k].real
                y = py - starts[k].imag
                dx = ways[k].real
                dy = ways[k].imag
                at: cython.double = (x * dx + y * dy) * slopes[k]
                at = 0.0 if at < 0.0 else (1.0 if at > 1.0 else at)
                x -= at * dx
                y -= at * dy
                away: cython.double = x * x + y * y
                if away < least or (away == least and k < nearest):
                    least, nearest, place = away, k, at
        distance[p] = sqrt(least)
        edge[p] = nearest
        share[p] = place


def nearest_places(points: ComplexArray, line: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """Return the distance of each point from a polyline, and the nearest place: edge number plus share of the edge.

    Parameters
    ----------
    points : (p,) complex
    line : (n,) complex, n >= 2

    Returns
    -------
    distance, place : (p,) float
    """
    distance, edge, share = nearest_edges(points, line[:-1], line[1:])
    return distance, edge + share


def distances_to(vertices: ComplexArray, points: ComplexArray) -> FloatArray:
    """Return how far each point is from the nearest vertex, (p,) float."""
    step = max(1, AT_ONCE // len(vertices))
    some = (points[first : first + step] for first in range(0, len(points), step))
    return np.concatenate([np.abs(vertices[:, None] - part).min(axis=0) for part in some])


def nearest_numbers(values: FloatArray, wanted: FloatArray) -> IntArray:
    """Return the number of the value nearest to each wanted one, of two as near the first.

    >>> nearest_numbers(np.array([0.0, 3.0, 1.0, 3.0]), np.array([-1.0, 0.5, 2.5, 4.0])).tolist()
    [0, 0, 1, 1]
    """
    order = np.argsort(values, kind="stable")
    rising = values[order]
    above = np.searchsorted(rising, wanted)
    below = np.searchsorted(rising, rising[np.maximum(above - 1, 0)])  # of equal values the first
    above = np.minimum(above, len(values) - 1)
    away = np.abs(wanted - rising[below]) - np.abs(wanted - rising[above])
    below, above = order[below], order[above]
    return np.where((away < 0.0) | ((away == 0.0) & (below < above)), below, above)


def are_near(points: ComplexArray, line: ComplexArray, distance: float) -> BoolArray:
    """Return which points are within a distance of a polyline."""
    return nearest_places(points, line)[0] <= distance


@cython.ccall
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def add_distances(
    points: cython.double[:, ::1],
    line: cython.double[:, ::1],
    places: cython.const[cython.double][:],
    lengths: cython.const[cython.double][:],
    closed: cython.bint,
    at_points: cython.bint,
    far: cython.double[::1],
) -> cython.void:
    """Keep the largest distances of points from the edges of a line near some places, `REACH` to either side.

    Parameters
    ----------
    points, line : (p, 2) and (n, 2) float
        x and y.
    places : (p,) float
        The length along the line near which each point lies.
    lengths : (n,) float
        The length up to each vertex of the line.
    closed : bool
    at_points : bool
        Keep the distance at the point, else at the last vertex of the line before its place.
    far : (p,) or (n,) float
        The largest distances so far, by points or vertices; only larger ones are taken down.
    """
    edges: cython.Py_ssize_t = line.shape[0] - 1
    count: cython.Py_ssize_t = lengths.shape[0]
    p: cython.Py_ssize_t
    k: cython.Py_ssize_t
    step: cython.Py_ssize_t
    first: cython.Py_ssize_t = 0  # the number of lengths up to a place; places mostly rise
    for p in range(points.shape[0]):
        while first > 0 and lengths[first - 1] > places[p]:
            first -= 1
        while first < count and lengths[first] <= places[p]:
            first += 1
        near: cython.Py_ssize_t = first - 1
        at: cython.Py_ssize_t = p if at_points else min(max(near, 0), far.shape[0] - 1)
        enough: cython.double = SURELY_LESS * far[at] * far[at]
        least: cython.double = INFINITY
        # The nearest edges come first: mostly one of them is near enough.
        for step in range(2 * REACH + 1):
            k = near - (step + 1) // 2 if step % 2 else near + step // 2
            number: cython.Py_ssize_t = (k + REACH * edges) % edges if closed else min(max(k, 0), edges - 1)
            x: cython.double = points[p, 0] - line[number, 0]
            y: cython.double = points[p, 1] - line[number, 1]
            dx: cython.double = line[number + 1, 0] - line[number, 0]
            dy: cython.double = line[number + 1, 1] - line[number, 1]
            square: cython.double = dx * dx + dy * dy
            along: cython.double = x * dx + y * dy
            if along > 0.0:
                share: cython.double = min(along / square, 1.0)
                x -= share * dx
                y -= share * dy
            apart: cython.double = x * x + y * y
            if apart < least:
                least = apart
            if least < enough:
                break
        least = sqrt(least)
        if least > far[at]:
            far[at] = least


@cython.boundscheck(False)
@cython.wraparound(False)
def add_deviations(
    curve: tuple[FloatArray, FloatArray, IntArray],
    polygon: tuple[FloatArray, FloatArray, FloatArray],
    cuts: FloatArray,
    closed: cython.bint,
    far: cython.double[::1],
) -> None:
    """Keep the largest distances between two lines on their way, near each vertex of the second.

    They correspond at cuts, and between these by their lengths. The distances of the vertices of each from the edges of
    the other nearby are taken.

    Parameters
    ----------
    curve : ((t, n, 2) float, (t, n) float, (c,) int)
        x and y at some times, the lengths up to each vertex, and the vertices at cuts.
    polygon : ((t, p, 2) float, (t, p) float, (p,) float)
        The same, and the progress at each vertex.
    cuts : (c,) float
        The progress there.
    closed : bool
    far : (p,) float
        The largest distances so far; only larger ones are taken down.
    """
    points: cython.double[:, :, ::1] = curve[0]
    vertices: cython.double[:, :, ::1] = polygon[0]
    lengths: cython.const[cython.double][:, :] = curve[1]
    own_lengths: cython.const[cython.double][:, :] = polygon[1]
    at_cuts: cython.const[cython.Py_ssize_t][:] = curve[2]
    progress: cython.const[cython.double][:] = polygon[2]
    given: cython.const[cython.double][:] = cuts
    count: cython.Py_ssize_t = given.shape[0]
    # What is filled in, and the same to be read.
    work = np.empty(count), np.empty(count), np.empty(vertices.shape[1]), np.empty(points.shape[1])
    polygon_at_cuts: cython.double[::1] = work[0]
    curve_at_cuts: cython.double[::1] = work[1]
    on_curve: cython.double[::1] = work[2]
    on_polygon: cython.double[::1] = work[3]
    cut_lengths: cython.const[cython.double][:] = work[0]
    cut_places: cython.const[cython.double][:] = work[1]
    vertex_places: cython.const[cython.double][:] = work[2]
    point_places: cython.const[cython.double][:] = work[3]
    t: cython.Py_ssize_t
    k: cython.Py_ssize_t
    for t in range(points.shape[0]):
        _interpolate(given, progress, own_lengths[t], False, polygon_at_cuts)
        for k in range(count):
            curve_at_cuts[k] = lengths[t, at_cuts[k]]
        _interpolate(own_lengths[t], cut_lengths, cut_places, False, on_curve)
        _interpolate(lengths[t], cut_places, cut_lengths, False, on_polygon)
        add_distances(vertices[t], points[t], vertex_places, lengths[t], closed, True, far)
        add_distances(points[t], vertices[t], point_places, own_lengths[t], closed, False, far)


def tridiagonal(diagonal: FloatArray, beside: FloatArray, right: FloatArray) -> FloatArray:
    """Solve a symmetric, diagonally dominant system of values along a polyline, each tied to the next.

    Parameters
    ----------
    diagonal : (n,) float
    beside : (n - 1,) float
        The elements beside the diagonal, each times -1.
    right : (n,) float

    Returns
    -------
    (n,) float

    Examples
    --------
    >>> tridiagonal(np.array([2.0, 2.0]), np.array([1.0]), np.array([1.0, 1.0])).tolist()
    [1.0, 1.0]
    """
    values = right.copy()
    _solve_tridiagonal(diagonal.copy(), beside, values)
    return values


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _solve_tridiagonal(
    pivots: cython.double[::1], beside: cython.const[cython.double][::1], values: cython.double[::1]
) -> None:
    """Put the solution in the place of the right side; the diagonal is lost."""
    last: cython.Py_ssize_t = values.shape[0] - 1
    k: cython.Py_ssize_t
    for k in range(last):
        share: cython.double = beside[k] / pivots[k]
        pivots[k + 1] -= share * beside[k]
        values[k + 1] += share * values[k]
    values[last] /= pivots[last]
    for k in range(last - 1, -1, -1):
        values[k] = (values[k] + beside[k] * values[k + 1]) / pivots[k]
