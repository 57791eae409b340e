"""The deviation of in-betweens of curves from in-betweens of polygons."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polyline import add_distances, interpolated

if TYPE_CHECKING:
    from shapeblend_cli.interpolate.continuous_match import ContinuousMatch
    from shapeblend_cli.model import ComplexArray, FloatArray

TIMES = np.array([0.25, 0.5, 0.75])
"""Times at which in-betweens are compared."""

LEAST_SAMPLES = 4
"""Minimum number of edges that approximate a piece."""


def deviation(
    segments_a: ComplexArray,
    segments_b: ComplexArray,
    match: ContinuousMatch,
    cuts: FloatArray,
    tolerance: float,
) -> FloatArray:
    """Return the distance between the in-betweens of curves and of polygons, near each position of a match.

    Where it is within the tolerance, that is returned.

    Both are approximated by polygons, and the distances of the vertices of each from the edges of the other are taken:
    the course of the outline counts, not the places of points along it. Only edges nearby are considered, so that a
    limb that lies on another does not hide its deviation. The result, the largest at any of `TIMES`, is never less than
    the true distance between these polygons.

    Parameters
    ----------
    segments_a, segments_b : (s, 4) complex
        Pieces between the cuts.
    match : ContinuousMatch
        Its k positions are the polygons' vertices.
    cuts : (s + 1, 2) float
        Positions where the pieces begin and end.
    tolerance : float
        Like the result, in the drawing's unit.
    """
    progress = match.own_progress
    cut_progress = match.progress(cuts)
    first = progress.searchsorted(cut_progress)
    counts = LEAST_SAMPLES + 2 * (first[1:] - first[:-1])
    piece = np.arange(len(counts)).repeat(counts)
    begins = counts.cumsum() - counts
    u = (np.arange(len(piece)) - begins[piece]) / counts[piece]
    ends = np.concatenate([piece, [len(counts) - 1]]), np.concatenate([u, [1.0]])
    curve_a, curve_b = (cubics.evaluate(segments[ends[0]], ends[1]) for segments in (segments_a, segments_b))
    curve_a[-1], curve_b[-1] = segments_a[-1, 3], segments_b[-1, 3]
    curves, curve_lengths = _in_betweens(curve_a, curve_b)
    polygons, polygon_lengths = _polygons(match)
    curve_cuts = np.concatenate([begins, [len(piece)]])
    far = np.full(len(match.positions), tolerance)
    for curve, length_curve, polygon, length_polygon in zip(
        curves, curve_lengths, polygons, polygon_lengths, strict=True
    ):
        # Lengths along both, made equal at the cuts.
        polygon_at_cuts = interpolated(cut_progress, progress, length_polygon)
        curve_at_cuts = length_curve[curve_cuts]
        on_curve = interpolated(length_polygon, polygon_at_cuts, curve_at_cuts)
        on_polygon = interpolated(length_curve, curve_at_cuts, polygon_at_cuts)
        add_distances(polygon, curve, on_curve, length_curve, match.a.closed, True, far)
        add_distances(curve, polygon, on_polygon, length_polygon, match.a.closed, False, far)
    return far


@lru_cache(maxsize=1)
def _polygons(match: ContinuousMatch) -> tuple[FloatArray, FloatArray]:
    """Return the in-betweens of the polygons of a match, which stay while cuts are made."""
    return _in_betweens(*match.vertices)


def _in_betweens(a: ComplexArray, b: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """Return the points between two rows of points at all `TIMES`, (t, n, 2), and the lengths up to each, (t, n)."""
    points = a + TIMES[:, None] * (b - a)
    lengths = np.zeros(points.shape)
    np.abs(points[:, 1:] - points[:, :-1]).cumsum(axis=1, out=lengths[:, 1:])
    return points.view(np.float64).reshape(*points.shape, 2), lengths
