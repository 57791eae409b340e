"""Whether one outline is another one turned, or one drawing another one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.motion.alignment import align, matched_points, residual

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, Polygon

SAMPLES = 256
"""Points, evenly spread, as which an outline is seen."""

ALIKE = 0.999
"""Correlation of outlines that are the same but for turn, scale and place: what remains is about 4 % of the size."""

NEARLY_BEST = 1e-3
"""Starts whose correlation is less than this below the best are as good; then the least turn is meant."""

ROUNDING = 1e-6
"""Correlations that differ by less are the same."""

LEFT = 0.03
"""B is A turned if no more than this share of A's size is left, root mean square, once it is turned back."""

LEAST_TURN = np.radians(1.0)
"""A lesser turn goes straight."""


def turn_between(a: Polygon, b: Polygon) -> float | None:
    """The turn that makes one polygon of another, in radians, the short way; None if they are not alike.

    The turn of least squares for every starting point is the argument of a cyclic correlation of both outlines, and its
    absolute value says how well they then agree.

    Parameters
    ----------
    a, b : Polygon
        Going round the same way.
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
    fit = np.abs(common) / size
    if fit.max() < ALIKE:
        return None
    turns = np.angle(common)
    good = np.flatnonzero(fit >= fit.max() - NEARLY_BEST)
    best = int(good[np.abs(turns[good]).argmin()])
    # Its neighbours may fit better still, and then the turn is theirs. On a circle none does.
    while a.closed:
        beside = max((best - 1) % SAMPLES, (best + 1) % SAMPLES, key=fit.__getitem__)
        if fit[beside] <= fit[best] + ROUNDING:
            break
        best = beside
    turn = float(turns[best])
    return turn if abs(turn) > LEAST_TURN else None


def is_turned(contours: Sequence[ContourBlend]) -> bool:
    """Whether B is A turned, as a whole."""
    if not all(contour.is_matched for contour in contours):
        return False
    points = matched_points(contours)
    return residual(points, align(points)) < LEFT


def _even(polygon: Polygon) -> ComplexArray:
    """Points spread evenly along a polygon, around their mean."""
    z = np.append(polygon.vertices, polygon.vertices[:1]) if polygon.closed else polygon.vertices
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(z)))])
    places = np.linspace(0.0, along[-1], SAMPLES, endpoint=not polygon.closed)
    points = np.interp(places, along, z.real) + 1j * np.interp(places, along, z.imag)
    return np.asarray(points - points.mean())
