"""The deviation of in-betweens of curves from in-betweens of polygons."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polyline import cumulative_lengths

if TYPE_CHECKING:
    from shapeblend_cli.interpolate.continuous_match import ContinuousMatch
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

TIMES = (0.25, 0.5, 0.75)
"""Times at which in-betweens are compared."""

WINDOW = 3
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
    progress = match.progress(match.positions)
    cut_progress = match.progress(cuts)
    counts = LEAST_SAMPLES + 2 * np.diff(np.searchsorted(progress, cut_progress))
    piece = np.repeat(np.arange(len(counts)), counts)
    begins = np.cumsum(counts) - counts
    u = (np.arange(len(piece)) - begins[piece]) / counts[piece]
    curve_a, curve_b = (
        np.append(cubics.evaluate(segments[piece], u), segments[-1, 3])
        for segments in (segments_a, segments_b)
    )
    polygon_a, polygon_b = (
        one.points(match.positions[:, side]) for side, one in enumerate((match.a, match.b))
    )
    closed = match.a.closed
    far = np.zeros(len(match.positions))
    for t in TIMES:
        curve: ComplexArray = curve_a + t * (curve_b - curve_a)
        polygon: ComplexArray = polygon_a + t * (polygon_b - polygon_a)
        length_curve, length_polygon = cumulative_lengths(curve), cumulative_lengths(polygon)
        # Lengths along both, made equal at the cuts.
        polygon_cuts = np.interp(cut_progress, progress, length_polygon)
        curve_cuts = length_curve[np.append(begins, len(piece))]
        on_curve = np.interp(length_polygon, polygon_cuts, curve_cuts)
        nearest = np.searchsorted(length_curve, on_curve, side="right") - 1
        np.maximum(far, _distance(polygon, curve, nearest, closed), out=far)
        on_polygon = np.interp(length_curve, curve_cuts, polygon_cuts)
        nearest = np.searchsorted(length_polygon, on_polygon, side="right") - 1
        np.maximum.at(far, np.clip(nearest, 0, len(far) - 1), _distance(curve, polygon, nearest, closed))
    return far


def _distance(points: ComplexArray, line: ComplexArray, near: IntArray, closed: bool) -> FloatArray:
    """Return the distance of points from the edges of a line around the edges numbered `near`."""
    edges = np.diff(line)
    numbers = near[:, None] + np.arange(-WINDOW, WINDOW + 1)
    numbers = numbers % len(edges) if closed else np.clip(numbers, 0, len(edges) - 1)
    square = edges.real**2 + edges.imag**2
    scaled = edges.conj() / np.where(square > 0.0, square, 1.0)
    ahead = points[:, None] - line[numbers]
    share = np.clip((ahead * scaled[numbers]).real, 0.0, 1.0)
    ahead -= share * edges[numbers]
    return np.sqrt((ahead.real**2 + ahead.imag**2).min(axis=1))
