"""Flatten contours to polygons: every node is a vertex, and further vertices lie evenly along the curves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polyline import distinct
from shapeblend_cli.model import Contour, Polygon
from shapeblend_cli.model.arrays import numbered, rolled

if TYPE_CHECKING:
    from collections.abc import Hashable

    from shapeblend_cli.model import FloatArray, IntArray

    Known = dict[Hashable, tuple[IntArray, FloatArray]]

TOLERANCE = 5e-4
"""Maximum distance of a polygon from its curve, as a share of the larger side of the contour's box."""

MOST_CUTS = 32
"""Maximum number of rounds of cutting; a few are enough for any curve, cusps included."""

MOST_GROWTH = 3
"""Maximum number of even pieces of a segment, as a multiple of the number for its length."""

COINCIDENT = 1e-9
"""Maximum distance of vertices that are one, as a share of the larger side of the box."""


STEPS = np.linspace(0.0, 1.0, cubics.ARC_PIECES + 1)
"""Parameters up to which the lengths of a segment are known."""

HALVINGS = 40
"""Number of times that the length of a piece is bisected."""

DECIMALS = 5
"""Number of decimals of coordinates in which outlines agree that are cut alike, in sizes of their boxes: far less than
`TOLERANCE`."""


def flatten(contour: Contour, vertices: int, known: Known | None = None) -> Polygon:
    """Flatten a contour to about `vertices` vertices.

    Parameters
    ----------
    contour : Contour
    vertices : int >= 0
        How many vertices are wanted. Every node of the drawing is one in any case; the others are spread evenly by
        arc length over curves and long edges. 0 adds only those that a curve needs.
    known : dict, optional
        The vertices of outlines that were flattened before, on their segments. Others of that form, wherever they lie
        and however large they are, get the same.

    Returns
    -------
    Polygon
        Nowhere further from the contour than `TOLERANCE` times its size. Repeated vertices are
        left out, so it may be degenerate: fewer than three vertices when closed, fewer than two when open.
    """
    segments = contour.segments
    size = cubics.bounds(segments).larger_side
    if known is None:
        segment, parameter = _vertices(contour, vertices, size)
    else:
        form = np.round((segments - segments[0, 0]) / (size or 1.0), DECIMALS) + 0.0
        key = vertices, contour.closed, contour.straight.tobytes(), form.tobytes()
        if key not in known:
            known[key] = _vertices(contour, vertices, size)
        segment, parameter = known[key]
    points = cubics.evaluate(segments.take(segment, axis=0), parameter)
    points = np.where(parameter == 0.0, segments[segment, 0], points)
    if not contour.closed:  # nothing begins at the end of the last segment, so it is added by itself
        points = np.append(points, segments[-1, 3])
        segment = np.append(segment, len(segments) - 1)
        parameter = np.append(parameter, 1.0)
    kept = distinct(points, contour.closed, COINCIDENT * size)
    return Polygon(points[kept], segment[kept], parameter[kept], contour.closed)


def _vertices(contour: Contour, vertices: int, size: float) -> tuple[IntArray, FloatArray]:
    """Return the segment and the parameter of each vertex, but for the end of an open contour, given its size."""
    segments = contour.segments
    tolerance = TOLERANCE * size
    ladders = _length_ladders(segments)
    counts = _share_out(ladders[:, -1], vertices - (0 if contour.closed else 1))
    wanted = counts.copy()
    for _ in range(MOST_CUTS):
        segment, share = _even(counts)
        parameter, deviation = _measure(contour, ladders, segment, share)
        worst = np.zeros(len(segments))
        np.maximum.at(worst, segment, deviation / tolerance)
        more = np.ceil(counts * np.sqrt(np.minimum(worst, 4.0))).astype(np.intp)
        coarse = (worst > 1.0) & (more <= MOST_GROWTH * wanted)
        if not coarse.any():
            break
        counts[coarse] = np.maximum(more, counts + 1)[coarse]
    # What still deviates is a sharp bend in a long segment: cut there alone.
    for _ in range(MOST_CUTS):
        if deviation.max() <= tolerance:
            break
        parts = np.ceil(np.sqrt(np.maximum(deviation / tolerance, 1.0))).astype(np.intp)
        following = np.append(np.where(segment[1:] == segment[:-1], share[1:], 1.0), 1.0)
        share = np.repeat(share, parts) + numbered(parts) * np.repeat((following - share) / parts, parts)
        segment = np.repeat(segment, parts)
        parameter, deviation = _measure(contour, ladders, segment, share)
    return segment, parameter


def edge_parts(contour: Contour, polygon: Polygon) -> tuple[IntArray, FloatArray, FloatArray]:
    """Return the segment on which each edge of a contour's polygon lies, and its parameters there, from and to.

    There are as many edges as vertices if closed, else one less. Segments that are a point have none.
    """
    count = len(polygon.vertices) if polygon.closed else len(polygon.vertices) - 1
    found = np.empty(count, np.intp), np.empty(count), np.empty(count)
    cubics.fill_edge_parts(contour.segments, polygon, COINCIDENT, *found)
    return found


def _even(counts: IntArray) -> tuple[IntArray, FloatArray]:
    """Return the segment of each piece, and the share of the segment's length at which it begins."""
    segment = np.arange(len(counts)).repeat(counts)
    return segment, numbered(counts) / counts[segment]


def _measure(
    contour: Contour, ladders: FloatArray, segment: IntArray, share: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the parameter at which each piece begins, and a bound on its distance from its chord."""
    if share.any():
        # A point has no lengths to go by.
        parameter = np.where(share > 0.0, _parameters(ladders, segment, share), 0.0)
    else:
        parameter = np.zeros(len(share))
    end = rolled(parameter, -1)
    end[-1] = 1.0
    end[:-1][segment[1:] != segment[:-1]] = 1.0
    deviation = cubics.chord_deviation(cubics.pieces(contour.segments.take(segment, axis=0), parameter, end))
    return parameter, np.where(contour.straight[segment], 0.0, deviation)


def _length_ladders(segments: np.ndarray) -> FloatArray:
    """Return arc lengths from the start of each segment at equal steps of its parameter, (k, pieces + 1)."""
    ladders = np.zeros((len(segments), len(STEPS)))
    cubics.arc_lengths(segments).cumsum(axis=1, out=ladders[:, 1:])
    return ladders


def _share_out(lengths: FloatArray, pieces: int) -> IntArray:
    """Cut segments into about `pieces` pieces of even length, at least one each.

    The longest pieces are halved, thirded and so on until there are enough: the piece length is
    bisected so that the counts ``ceil(length / piece)`` add up to at most `pieces`.
    """
    if pieces <= len(lengths) or not lengths.any():
        return np.ones(len(lengths), np.intp)
    even, longest = lengths.sum() / pieces, lengths.max()
    high = cubics.longest_piece(np.ascontiguousarray(lengths), even, longest, pieces, HALVINGS)
    return np.maximum(np.ceil(lengths / high).astype(np.intp), 1)


def _parameters(ladders: FloatArray, segment: IntArray, share: FloatArray) -> FloatArray:
    """Return the parameter in [0, 1) at which a given share of a segment's length is reached."""
    # One interpolation for all segments: each ladder is lifted above the one before it.
    lift = 2.0 * np.arange(len(ladders))
    totals = np.where(ladders[:, -1:] > 0.0, ladders[:, -1:], 1.0)
    rungs = ladders / totals + lift[:, None]
    steps = STEPS + lift[:, None]
    return np.interp(share + lift[segment], rungs.ravel(), steps.ravel()) - lift[segment]
