"""Lengths that close a polygon whose edges have given directions.

This file is compiled by Cython and runs uncompiled as well.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.libc.math import exp, fabs, sqrt
else:
    from math import exp, fabs, sqrt

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, FloatArray

COMPILED = cython.compiled

MULTIPLIER_LIMIT = cython.declare(cython.double, 4.0)
"""Approximate maximum of the multipliers; an edge of mean compliance then changes by a factor of 50."""

NEWTON_STEPS = 40
"""Maximum number of Newton steps; four to six are usual."""

CLOSED = cython.declare(cython.double, 1e-13)
"""Maximum gap after Newton's method, as a share of the chain's length; the chain is closed exactly then."""


def closing_lengths(length: FloatArray, u: ComplexArray, compliance: FloatArray) -> FloatArray:
    """Return lengths near given ones that close a polygon of given directions.

    Parameters
    ----------
    length : (m,) float >= 0
    u : (m,) complex
        Directions, of length 1.
    compliance : (m,) float > 0

    Returns
    -------
    (m,) float >= 0
        ``L_i exp(σ_i u_i·λ)``, with ``u_i·λ`` the inner product. Zero stays zero.

    Notes
    -----
    ``λ`` minimises ``Σ (L_i / σ_i) exp(σ_i u_i·λ)``, a convex function whose gradient is the gap of the polygon.
    Newton's first step from zero solves the paper's two linear equations.

    A minimum exists if the directions do not all lie in one half of the circle: for turns of less than half a round
    each that make one round together. For others ``λ`` would go to infinity. Therefore
    ``|λ|⁸ / (8 MULTIPLIER_LIMIT⁸)``, times the whole length, is added. For the ``|λ|`` of common shapes, less than 1,
    that is less than rounding in a drawing, 1e-5 of the length; otherwise it leaves a gap that is continuous in time,
    which the caller has to distribute.
    """
    closing = np.empty(len(length))
    _close(length, u.view(np.float64), compliance, closing)
    return closing


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _close(
    length: cython.double[::1],
    u: cython.double[::1],
    compliance: cython.double[::1],
    closing: cython.double[::1],
) -> None:
    """Fill in the closing lengths by Newton's method; `u` are x and y of each direction."""
    k: cython.Py_ssize_t
    count: cython.Py_ssize_t = length.shape[0]
    total: cython.double = 0.0
    most: cython.double = 0.0
    for k in range(count):
        total += length[k]
        most = max(most, compliance[k])
    x: cython.double = 0.0
    y: cython.double = 0.0
    for _ in range(NEWTON_STEPS):
        open_x: cython.double = 0.0
        open_y: cython.double = 0.0
        weights: cython.double = 0.0
        xx: cython.double = 0.0
        xy: cython.double = 0.0
        for k in range(count):
            cos: cython.double = u[2 * k]
            sin: cython.double = u[2 * k + 1]
            closed: cython.double = length[k] * exp(compliance[k] * (cos * x + sin * y))
            closing[k] = closed
            open_x += closed * cos
            open_y += closed * sin
            weight: cython.double = compliance[k] * closed
            weights += weight
            xx += weight * cos * cos
            xy += weight * cos * sin
        square: cython.double = x * x + y * y
        hold: cython.double = total * square * square * square / MULTIPLIER_LIMIT**8
        open_x += hold * x
        open_y += hold * y
        if fabs(open_x) + fabs(open_y) <= CLOSED * total:
            break
        growth: cython.double = 6.0 * total * square * square / MULTIPLIER_LIMIT**8
        # The small share avoids a division by zero for directions that are all alike, or opposite.
        yy: cython.double = weights - xx + hold + growth * y * y + 1e-12 * weights
        xx += hold + growth * x * x + 1e-12 * weights
        xy += growth * x * y
        determinant: cython.double = xx * yy - xy * xy
        step_x: cython.double = (xy * open_y - yy * open_x) / determinant
        step_y: cython.double = (xy * open_x - xx * open_y) / determinant
        size: cython.double = sqrt(step_x * step_x + step_y * step_y)
        shorter: cython.double = min(1.0, 2.0 / (most * size)) if size > 0.0 else 1.0
        x += shorter * step_x
        y += shorter * step_y
