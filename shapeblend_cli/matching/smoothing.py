"""Outlines at a coarser scale, on which most of bending is measured.

Not in the paper. Two polygons of one curve are cut at different places, so that their angles never line up, and a
zigzag too small to be seen bends as much as a shoulder. What is left when an outline is smoothed along its length
depends little on where it was cut.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, FloatArray

SAMPLES, SAMPLES_PER_VERTEX = 1024, 4
"""Points, evenly spread along an outline, that are smoothed: at least so many, and so many for each vertex."""

REACH = 4.0
"""Where the Gaussian is cut off, in standard deviations."""

OUTLINE = 1e-3
"""The share of the outline itself that is left in, so that neighbours stay distinct."""


def smoothed(vertices: ComplexArray, closed: bool, sigma: float) -> ComplexArray:
    """Return where vertices are when their outline is smoothed by a Gaussian along its length.

    Parameters
    ----------
    vertices : (m,) complex
        No two neighbours are equal.
    closed : bool
        An open outline is continued beyond each end by itself, rotated half a turn about the end, which thus stays.
    sigma : float
        Standard deviation, as a share of the outline's length, greater than 0.

    Returns
    -------
    (m,) complex
    """
    points = np.append(vertices, vertices[0]) if closed else vertices
    at = np.append(0.0, np.cumsum(np.abs(np.diff(points))))
    at /= at[-1]
    count = max(SAMPLES, SAMPLES_PER_VERTEX * len(vertices))
    even = np.arange(count) / count if closed else np.linspace(0.0, 1.0, count)
    samples = np.interp(even, at, points)
    reach = int(np.ceil(REACH * sigma * count))
    if closed:
        beyond = np.concatenate([samples[len(samples) - reach :], samples, samples[:reach]])
    else:
        before, after = samples[reach:0:-1], samples[-2 : -reach - 2 : -1]
        beyond = np.concatenate([2.0 * samples[0] - before, samples, 2.0 * samples[-1] - after])
    smooth = np.convolve(beyond, _gaussian(np.arange(-reach, reach + 1) / (sigma * count)), "valid")
    if closed:
        even, smooth = np.append(even, 1.0), np.append(smooth, smooth[0])
    here = np.interp(at[:-1] if closed else at, even, smooth)
    return (1.0 - OUTLINE) * here + OUTLINE * vertices


def _gaussian(x: FloatArray) -> FloatArray:
    """Return weights of sum 1."""
    weights: FloatArray = np.exp(-0.5 * x * x)
    return weights / weights.sum()
