"""How far in-betweens of curves lie from in-betweens of polygons."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics

if TYPE_CHECKING:
    from shapeblend_cli.interpolate.rails import Rail
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

TIMES = (0.25, 0.5, 0.75)
"""When in-betweens are compared."""

WINDOW = 3
"""Edges to either side among which the nearest is looked for."""

LEAST_SAMPLES = 4
"""Edges, at least, as which a piece is seen."""


def strays(
    segments_a: ComplexArray, segments_b: ComplexArray, a: Rail, b: Rail, places: FloatArray, cuts: FloatArray
) -> FloatArray:
    """Distance, near each of the given places, between the in-between of curves and that of polygons.

    Both are seen as polygons, and the distance of each one's vertices from the other one's edges is taken: which
    point is drawn where along an outline is of no account, but where the outline runs is. It is looked for nearby
    only, so that one limb lying on another does not hide that it has gone astray. The distance found is never
    less than the true one between these polygons.

    Parameters
    ----------
    segments_a, segments_b : (s, 4) complex
        Pieces between the cuts.
    a, b : Rail
    places : (k, 2) float
        The polygons' vertices: what corresponds, as places on both rails.
    cuts : (s + 1, 2) float
        Where the pieces begin and end.

    Returns
    -------
    (k,) float
        The largest over `TIMES`, in the drawing's unit.
    """
    along_places = along(a, b, places)
    along_cuts = along(a, b, cuts)
    spans = np.searchsorted(along_places, along_cuts)
    counts = LEAST_SAMPLES + 2 * np.diff(spans)
    piece = np.repeat(np.arange(len(counts)), counts)
    begins = np.cumsum(counts) - counts
    u = (np.arange(len(piece)) - begins[piece]) / counts[piece]
    samples = [
        np.append(cubics.evaluate(segments[piece], u), segments[-1, 3])
        for segments in (segments_a, segments_b)
    ]
    vertices = [r.points(places[:, side]) for side, r in enumerate((a, b))]
    far = np.zeros(len(places))
    curve: ComplexArray
    polygon: ComplexArray
    for t in TIMES:
        curve = samples[0] + t * (samples[1] - samples[0])
        polygon = vertices[0] + t * (vertices[1] - vertices[0])
        length_curve, length_polygon = _lengths(curve), _lengths(polygon)
        # Lengths along both, made equal at the cuts.
        at_cuts = np.interp(along_cuts, along_places, length_polygon)
        curve_cuts = length_curve[np.append(begins, len(piece))]
        there = (
            np.searchsorted(length_curve, np.interp(length_polygon, at_cuts, curve_cuts), side="right") - 1
        )
        np.maximum(far, _nearest(polygon, curve, there, a.closed), out=far)
        back = np.searchsorted(length_polygon, np.interp(length_curve, curve_cuts, at_cuts), side="right") - 1
        np.maximum.at(far, np.clip(back, 0, len(places) - 1), _nearest(curve, polygon, back, a.closed))
    return far


def along(a: Rail, b: Rail, places: FloatArray) -> FloatArray:
    """How far along both outlines places are: 0 at vertices 0, 2 once round."""
    return a.length_at(places[:, 0]) / a.lengths[-1] + b.length_at(places[:, 1]) / b.lengths[-1]


def _lengths(points: ComplexArray) -> FloatArray:
    return np.concatenate([[0.0], np.cumsum(np.abs(np.diff(points)))])


def _nearest(points: ComplexArray, line: ComplexArray, near: IntArray, closed: bool) -> FloatArray:
    """Distance of points from the edges of a line around the edges numbered `near`."""
    edges = np.diff(line)
    numbers = near[:, None] + np.arange(-WINDOW, WINDOW + 1)
    numbers = numbers % len(edges) if closed else np.clip(numbers, 0, len(edges) - 1)
    square = edges.real**2 + edges.imag**2
    scaled = edges.conj() / np.where(square > 0.0, square, 1.0)
    ahead = points[:, None] - line[numbers]
    share = np.clip((ahead * scaled[numbers]).real, 0.0, 1.0)
    ahead -= share * edges[numbers]
    return np.sqrt((ahead.real**2 + ahead.imag**2).min(axis=1))
