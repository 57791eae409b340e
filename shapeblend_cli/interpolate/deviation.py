"""The deviation of in-betweens of curves from in-betweens of polygons."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polyline import add_distances, cumulative_lengths

if TYPE_CHECKING:
    from shapeblend_cli.interpolate.continuous_match import ContinuousMatch
    from shapeblend_cli.model import ComplexArray, FloatArray

TIMES = (0.25, 0.5, 0.75)
"""Times at which in-betweens are compared."""

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
        add_distances(*outlines, on_curve, length_curve, match.a.closed, True, far)
        add_distances(*outlines[::-1], on_polygon, length_polygon, match.a.closed, False, far)
    return far
