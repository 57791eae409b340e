"""The deviation of in-betweens of curves from in-betweens of polygons.

This file is compiled by Cython and runs uncompiled as well.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polyline import cumulative_lengths

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.libc.math import sqrt
else:
    from math import sqrt

if TYPE_CHECKING:
    from shapeblend_cli.interpolate.continuous_match import ContinuousMatch
    from shapeblend_cli.model import ComplexArray, FloatArray

COMPILED = cython.compiled

TIMES = (0.25, 0.5, 0.75)
"""Times at which in-betweens are compared."""

cython.declare(REACH=cython.Py_ssize_t)
REACH = 3
"""Number of edges to either side among which the nearest is looked for."""

LEAST_SAMPLES = 4
"""Minimum number of edges that approximate a piece."""


def deviation(
    segments_a: ComplexArray, segments_b: ComplexArray, match: ContinuousMatch, cuts: FloatArray
) -> FloatArray:
    """Return the distance between the in-betweens of curves and of polygons, near each position of a match.

    Both are approximated by polygons, and the distances of the vertices of each from the edges of the other are taken:
    the course of the outline counts, not the places of points along it. Only edges nearby are considered, so that a
    limb that lies on another does not hide its deviation. The result, the largest at any of `TIMES` in the drawing's
    unit, is never less than the true distance between these polygons.

    Parameters
    ----------
    segments_a, segments_b : (s, 4) complex
        Pieces between the cuts.
    match : ContinuousMatch
        Its k positions are the polygons' vertices.
    cuts : (s + 1, 2) float
        Positions where the pieces begin and end.
    """
    progress = match.own_progress
    cut_progress = match.progress(cuts)
    counts = LEAST_SAMPLES + 2 * np.diff(np.searchsorted(progress, cut_progress))
    piece = np.repeat(np.arange(len(counts)), counts)
    begins = np.cumsum(counts) - counts
    u = (np.arange(len(piece)) - begins[piece]) / counts[piece]
    curve_a, curve_b = (
        np.append(cubics.evaluate(segments[piece], u), segments[-1, 3])
        for segments in (segments_a, segments_b)
    )
    polygon_a, polygon_b = match.vertices
    curve_cuts = np.append(begins, len(piece))
    far = np.zeros(len(match.positions))
    for t in TIMES:
        curve: ComplexArray = curve_a + t * (curve_b - curve_a)
        polygon: ComplexArray = polygon_a + t * (polygon_b - polygon_a)
        length_curve, length_polygon = cumulative_lengths(curve), cumulative_lengths(polygon)
        # Lengths along both, made equal at the cuts.
        polygon_at_cuts = np.interp(cut_progress, progress, length_polygon)
        curve_at_cuts = length_curve[curve_cuts]
        on_curve = np.interp(length_polygon, polygon_at_cuts, curve_at_cuts)
        on_polygon = np.interp(length_curve, curve_at_cuts, polygon_at_cuts)
        outlines = [points.view(np.float64).reshape(-1, 2) for points in (polygon, curve)]
        _add_distances(*outlines, on_curve, length_curve, match.a.closed, True, far)
        _add_distances(*outlines[::-1], on_polygon, length_polygon, match.a.closed, False, far)
    return far


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _add_distances(
    points: cython.double[:, ::1],
    line: cython.double[:, ::1],
    places: cython.const[cython.double][::1],
    lengths: cython.const[cython.double][::1],
    closed: cython.bint,
    at_points: cython.bint,
    far: cython.double[::1],
) -> None:
    """Take the distances of points from the edges of a line near some places, and keep the largest.

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
        The largest distances so far, by points or vertices.
    """
    edges: cython.Py_ssize_t = line.shape[0] - 1
    p: cython.Py_ssize_t
    k: cython.Py_ssize_t
    for p in range(points.shape[0]):
        first: cython.Py_ssize_t = 0  # the number of lengths up to this place
        last: cython.Py_ssize_t = lengths.shape[0]
        while first < last:
            middle: cython.Py_ssize_t = (first + last) // 2
            if lengths[middle] <= places[p]:
                first = middle + 1
            else:
                last = middle
        near: cython.Py_ssize_t = first - 1
        least: cython.double = -1.0
        for k in range(near - REACH, near + REACH + 1):
            number: cython.Py_ssize_t = min(max(k, 0), edges - 1)
            if closed:
                number = (k + REACH * edges) % edges
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
            if least < 0.0 or apart < least:
                least = apart
        least = sqrt(least)
        k = p if at_points else min(max(near, 0), far.shape[0] - 1)
        if least > far[k]:
            far[k] = least
