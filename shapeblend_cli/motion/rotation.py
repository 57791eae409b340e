"""Whether one outline is a rotated copy of another, or one drawing of another."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polyline import cumulative_lengths, from_end_to_end, points_at
from shapeblend_cli.motion.alignment import align, point_pairs, residual

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, Polygon

SAMPLES = 256
"""Points, evenly spread along an outline, that are compared."""

ALIKE = 0.999
"""Correlation of outlines that are the same but for a similarity: what remains is about 4 % of the size."""

NEARLY_BEST, ROUNDING = 1e-3, 1e-6
"""Starts whose correlation is less than this below the best are as good, and then the smallest angle is meant; those
whose correlation differs by less are the same."""

LEAST_ROTATION, MOST_RESIDUAL = np.radians(1.0), 0.03
"""B is a rotated copy if the angle is larger, and no more than this share of A's size is left, root mean square, once
it is rotated back."""


def rotation_between(a: Polygon, b: Polygon) -> float | None:
    """Return the angle by which one polygon is another rotated, in (-pi, pi]; None if they are not alike.

    The angle of least squares for every starting point is the argument of a cyclic correlation of both outlines, whose
    absolute value says how well they then agree. Closed polygons must have the same orientation.
    """
    if a.closed != b.closed:
        return None
    p, q = (_even(polygon) for polygon in (a, b))
    if a.closed:
        starts = np.arange(SAMPLES)
        # Summed here, since numpy.fft takes longer to import.
        common = q[(starts[:, None] + starts) % SAMPLES] @ p.conj() / SAMPLES
    else:
        common = np.stack([q, q[::-1]]) @ p.conj() / SAMPLES
    size = float(np.sqrt((np.abs(p) ** 2).mean() * (np.abs(q) ** 2).mean()))
    correlation = np.abs(common) / size
    if correlation.max() < ALIKE:
        return None
    angles = np.angle(common)
    good = np.flatnonzero(correlation >= correlation.max() - NEARLY_BEST)
    best = int(good[np.abs(angles[good]).argmin()])
    # A neighbour may be better still, and then its angle is right. On a circle none is.
    while a.closed:
        neighbour = max((best - 1) % SAMPLES, (best + 1) % SAMPLES, key=correlation.__getitem__)
        if correlation[neighbour] <= correlation[best] + ROUNDING:
            break
        best = neighbour
    angle = float(angles[best])
    return angle if abs(angle) > LEAST_ROTATION else None


def is_rotated_copy(contours: Sequence[ContourBlend]) -> bool:
    """Return whether B as a whole is A rotated, scaled and shifted."""
    if not all(contour.is_matched for contour in contours):
        return False
    points = point_pairs(contours)
    return residual(points, align(points)) < MOST_RESIDUAL


def _even(polygon: Polygon) -> ComplexArray:
    """Return points spread evenly along a polygon, relative to their mean."""
    points = from_end_to_end(polygon.vertices, polygon.closed)
    lengths = cumulative_lengths(points)
    even = points_at(np.linspace(0.0, lengths[-1], SAMPLES, endpoint=not polygon.closed), points, lengths)
    return even - even.mean()
