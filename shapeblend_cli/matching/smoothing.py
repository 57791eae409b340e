"""Outlines at a coarser scale, on which most of bending is measured.

Not in the paper. Two polygons of one curve are cut at different places, so that their angles never line up, and a
zigzag too small to be seen bends as much as a shoulder. What is left when an outline is smoothed along its length
depends little on where it was cut.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, FloatArray

REACH = 7.0
"""How far a corner is felt, in standard deviations: beyond, it moves nothing by more than rounding does."""

OUTLINE = 1e-3
"""The share of the outline itself that is left in, so that neighbours stay distinct."""

_LADDER = np.linspace(0.0, REACH, 1025)
_RUNGS = np.array(
    [math.exp(-0.5 * x * x) / math.sqrt(2 * math.pi) - 0.5 * x * math.erfc(x / math.sqrt(2)) for x in _LADDER]
)


def smoothed(vertices: ComplexArray, closed: bool, sigma: float) -> ComplexArray:
    """Return where vertices are when their outline is smoothed by a Gaussian along its length.

    Parameters
    ----------
    vertices : (m,) complex
        No two neighbours are equal.
    closed : bool
        An open outline is continued beyond each end by itself, rotated half a turn about the end, which thus stays.
    sigma : float
        Standard deviation, as a share of the outline's length, greater than 0 and at most 0.1.

    Returns
    -------
    (m,) complex
        The same wherever a closed outline begins, and however many vertices lie on straight lines.

    Notes
    -----
    Along its length a polygon is a sum of a line and, for each corner, a ramp that begins there with the change of
    direction as its slope. So nothing has to be sampled: a corner moves a vertex by how much a smoothed ramp lies above
    the ramp.
    """
    edges = np.diff(np.append(vertices, vertices[0]) if closed else vertices)
    lengths = np.abs(edges)
    direction = edges / lengths
    ends = np.append(0.0, np.cumsum(lengths))
    length = ends[-1]
    at = ends[: len(vertices)] / length
    if closed:
        turns = np.tile(direction - np.roll(direction, 1), 3)
        corners = np.concatenate([at - 1.0, at, at + 1.0])
    else:
        turn = np.diff(direction, prepend=direction[:1], append=direction[-1:])
        turns = np.concatenate([-turn[:0:-1], turn, -turn[-2::-1]])
        corners = np.concatenate([-at[:0:-1], at, 2.0 - at[-2::-1]])
    corners = np.concatenate([[-np.inf], corners, [np.inf]])
    turns = np.concatenate([[0.0], turns, [0.0]])
    own = int(np.searchsorted(corners, 0.0))
    moves = np.zeros(len(vertices), np.complex128)
    for step in (1, -1):
        near = np.arange(len(vertices))
        corner = near + own + min(step, 0)  # its own corner counts once
        while len(near):
            away = np.abs(corners[corner] - at[near]) / sigma
            felt = away < REACH
            near, corner = near[felt], corner[felt]
            moves[near] += turns[corner] * _above_ramp(away[felt])
            corner = corner + step
    return vertices + (1.0 - OUTLINE) * sigma * length * moves


def _above_ramp(x: FloatArray) -> FloatArray:
    """Return by how much the ramp max(x, 0), smoothed by the standard Gaussian, lies above itself at x or -x >= 0.

    Between rungs of a ladder, to about 2e-6.
    """
    return np.interp(x, _LADDER, _RUNGS)
