"""Outlines that are softer on their way: the detail of two silhouettes that have little in common is ragged halfway."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray

SOFT = 0.025
"""Standard deviation, along an outline, of the weights with which its points are averaged halfway, in sizes of all
outlines."""

MOST = 0.025
"""Maximum standard deviation of these weights in lengths of the outline: small ones stay large."""

PIECES = 8
"""Number of points on each segment by which an outline is followed."""

POINTS = 512
"""Number of points, evenly along an outline, that are averaged."""

STRAIGHT = 1e-6
"""Maximum distance of a straight segment from its chord, in lengths of the outline."""


def softness(t: float) -> float:
    """Return the softness at time t, as a share of that halfway."""
    return max(4.0 * t * (1.0 - t), 0.0) ** 2


def softened(segments: ComplexArray, deviation: float) -> ComplexArray:
    """Return a closed outline whose points are averaged along it, with weights of a normal distribution.

    Parameters
    ----------
    segments : (k, 4) complex
    deviation : float
        The standard deviation of the weights, in units of the drawing.

    Returns
    -------
    (k, 4) complex
        Straight segments stay straight.
    """
    along = np.arange(PIECES) / PIECES
    points = cubics.evaluate(segments[:, None], along).ravel()
    edges = np.abs(np.roll(points, -1) - points)
    whole = float(edges.sum())
    deviation = min(deviation, MOST * whole)
    if deviation <= 0.0:
        return segments
    places = np.append(0.0, np.cumsum(edges))
    even = np.arange(POINTS + 1) * (whole / POINTS)
    line = np.interp(even, places, np.append(points, points[0]))
    frequency = 2.0 * np.pi / whole * np.fft.fftfreq(POINTS, 1.0 / POINTS)
    weights = np.exp(-0.5 * (deviation * frequency) ** 2)
    shift = np.fft.ifft(np.fft.fft(line[:-1]) * weights) - line[:-1]
    starts = places[:-1:PIECES]
    lengths = np.diff(np.append(starts, whole))
    at = starts[:, None] + lengths[:, None] * np.array([0.0, 1.0, 2.0]) / 3.0
    found = segments.copy()
    found[:, :3] += np.interp(at, even, np.append(shift, shift[0]))
    found[:, 3] = np.roll(found[:, 0], -1)
    straight = cubics.chord_deviation(segments) <= STRAIGHT * whole
    found[straight, 1:3] = cubics.line(found[straight, :1], found[straight, 3:])[:, 1:3]
    return found
