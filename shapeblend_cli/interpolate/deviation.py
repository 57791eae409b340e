"""The deviation of in-betweens of curves from in-betweens of polygons."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polyline import add_deviations

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
    curves, lengths = cubics.in_betweens(segments_a, segments_b, counts, TIMES)
    at_cuts = np.zeros(len(cuts), np.intp)
    counts.cumsum(out=at_cuts[1:])
    far = np.full(len(match.positions), tolerance)
    polygons = *_polygons(match), progress
    add_deviations((curves, lengths, at_cuts), polygons, cut_progress, match.a.closed, far)
    return far


@lru_cache(maxsize=1)
def _polygons(match: ContinuousMatch) -> tuple[FloatArray, FloatArray]:
    """Return the in-betweens of the polygons of a match at all `TIMES`, (t, n, 2), and the lengths up to each, (t, n).

    They stay while cuts are made.
    """
    a, b = match.vertices
    points = a + TIMES[:, None] * (b - a)
    lengths = np.zeros(points.shape)
    np.abs(points[:, 1:] - points[:, :-1]).cumsum(axis=1, out=lengths[:, 1:])
    return points.view(np.float64).reshape(*points.shape, 2), lengths
