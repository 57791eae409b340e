# cython: boundscheck=False, cdivision=True, initializedcheck=False
"""Outlines at a coarser scale, on which most of bending is measured.

Not in the paper. Two polygons of one curve are cut at different places, so that their angles never line up, and a
zigzag too small to be seen bends as much as a shoulder. What is left when an outline is smoothed along its length
depends little on where it was cut. This file is compiled by Cython and runs uncompiled.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.model.arrays import rolled

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.cpython.exc import PyErr_CheckSignals as look_for_signals
    from cython.cimports.libc.math import erfc, exp, fabs
else:
    from math import erfc, exp, fabs

    from shapeblend_cli._cython import look_for_signals

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, FloatArray

COMPILED = cython.compiled

REACH = cython.declare(cython.double, 7.0)
"""Maximum distance at which a corner is felt, in standard deviations: beyond, it moves less than rounding does."""

FINE = cython.declare(cython.double, 1024.0)
"""Number of places in a standard deviation at which the smoothed ramp is known."""

MOST = 8 * 1024
"""Number of all these places: a little beyond `REACH`."""

GRID = 16
"""Number of places in a standard deviation at which the outline of many vertices is smoothed."""

MANY = 4
"""Minimum number of vertices for that, as a multiple of such places."""

ORDER = 10
"""Number of such places from which the outline between them is interpolated: with this grid to about ten digits."""

STRAIGHT = 1e-12
"""Minimum change of direction at a corner: on straight lines rounding makes smaller ones, at every vertex."""

OUTLINE = 1e-3
"""Share of the outline itself in the smoothed one, so that neighbours stay distinct."""

ROOT_HALF = cython.declare(cython.double, 0.5**0.5)
ROOT_TWO_PI = cython.declare(cython.double, 2.5066282746310002)


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
    the ramp. A smoothed outline hardly bends between two places of a fine grid, and where there are far more vertices
    it is interpolated between these: each corner is felt at `GRID` times twice `REACH` of them.
    """
    outline = np.concatenate([vertices, vertices[:1]]) if closed else vertices
    edges = outline[1:] - outline[:-1]
    lengths = np.abs(edges)
    direction = edges / lengths
    ends = np.concatenate([[0.0], lengths.cumsum()])
    length = ends[-1]
    at = ends[: len(vertices)] / length
    if closed:
        turn = direction - rolled(direction, 1)
        bends = np.abs(turn) > STRAIGHT
        turn, place = turn[bends], at[bends]
        turns = np.concatenate([turn, turn, turn])
        corners = np.concatenate([place - 1.0, place, place + 1.0])
    else:
        turn = np.diff(direction, prepend=direction[:1], append=direction[-1:])
        turns = np.concatenate([-turn[:0:-1], turn, -turn[-2::-1]])
        corners = np.concatenate([-at[:0:-1], at, 2.0 - at[-2::-1]])
    count = int(np.ceil(GRID / sigma))
    if len(vertices) <= MANY * count:
        moves = np.zeros(len(vertices), np.complex128)
        _add_moves(at, corners, turns, sigma, moves)
        return vertices + (1.0 - OUTLINE) * sigma * length * moves
    grid, moves = np.arange(count + 1) / count, np.zeros(count + 1, np.complex128)
    _add_moves(grid, corners, turns, sigma, moves)
    smooth = np.interp(grid, ends / length, outline) + sigma * length * moves
    return vertices + (1.0 - OUTLINE) * (_interpolated(smooth, count * at) - vertices)


def _interpolated(values: ComplexArray, at: FloatArray) -> ComplexArray:
    """Return values between those at whole numbers, by the polynomials through `ORDER` of these."""
    first = np.clip(at.astype(np.intp) - (ORDER // 2 - 1), 0, len(values) - ORDER)
    sought = np.zeros(len(at), np.complex128)
    for k in range(ORDER):
        weight = np.ones(len(at))
        for other in range(ORDER):
            if other != k:
                weight *= (at - first - other) / (k - other)
        sought += weight * values[first + k]
    return sought


@cython.cfunc
@cython.wraparound(False)
def _add_moves(
    at: cython.double[::1],
    corners: cython.double[::1],
    turns: cython.doublecomplex[::1],
    sigma: cython.double,
    moves: cython.doublecomplex[::1],
) -> None:
    """Add up the moves of vertices, at rising places, by the corners within reach, in standard deviations."""
    first: cython.Py_ssize_t = 0
    corner: cython.Py_ssize_t
    vertex: cython.Py_ssize_t
    reach: cython.double = REACH * sigma
    fine: cython.double = FINE / sigma
    ramp: cython.double[:, ::1] = _ramp()
    for vertex in range(at.shape[0]):
        if vertex % 64 == 0:
            look_for_signals()
        while first < corners.shape[0] and corners[first] < at[vertex] - reach:
            first += 1
        corner = first
        x: cython.double = 0.0
        y: cython.double = 0.0
        while corner < corners.shape[0] and corners[corner] <= at[vertex] + reach:
            place: cython.double = fabs(corners[corner] - at[vertex]) * fine
            k: cython.Py_ssize_t = cython.cast(cython.Py_ssize_t, place)
            u: cython.double = place - k
            height: cython.double = ramp[k, 0] + u * (ramp[k, 1] + u * (ramp[k, 2] + u * ramp[k, 3]))
            x += turns[corner].real * height
            y += turns[corner].imag * height
            corner += 1
        moves[vertex] = x + 1j * y


@cache
def _ramp() -> FloatArray:
    """Return the ramp max(x, 0), smoothed by the standard Gaussian, above itself at x, in pieces: (MOST, 4) float.

    There are `FINE` of them in a standard deviation. Each is the cubic with its heights and slopes at both ends, by its
    coefficients, the constant first. It is off by 1e-15.
    """
    ramp = np.empty((MOST, 4))
    _fill_ramp(ramp)
    return ramp


def _fill_ramp(ramp: cython.double[:, ::1]) -> None:
    """Fill in the pieces, the last one first."""
    k: cython.Py_ssize_t
    end: cython.double = 0.0
    end_slope: cython.double = 0.0
    for k in range(ramp.shape[0], -1, -1):
        x: cython.double = k / FINE
        slope: cython.double = -0.5 * erfc(x * ROOT_HALF)
        height: cython.double = exp(-0.5 * x * x) / ROOT_TWO_PI + x * slope
        slope /= FINE
        if k < ramp.shape[0]:
            ramp[k, 0], ramp[k, 1] = height, slope
            ramp[k, 2] = 3.0 * (end - height) - 2.0 * slope - end_slope
            ramp[k, 3] = 2.0 * (height - end) + slope + end_slope
        end, end_slope = height, slope
