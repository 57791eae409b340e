# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""The largest balls inside a region that touch its outline at given points.

This file is compiled by Cython and runs uncompiled as well.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, FloatArray

COMPILED = cython.compiled

GRAZING = cython.declare(cython.double, 1e-6)
"""Minimum sine of the angle between the tangent at a point and the chord to one that bounds its ball."""


def ball_diameters(points: ComplexArray, normals: ComplexArray, most: float) -> FloatArray:
    """Return the diameter of the largest ball inside an outline that touches it at each point, at most `most`.

    A ball that touches at p, where n is the inner normal, and also holds q on its rim has the diameter
    ``|q - p|^2 / (n . (q - p))``; the largest one inside is the least of these over all other points.

    Parameters
    ----------
    points : (n,) complex
        Of all contours of a region.
    normals : (n,) complex
        Unit vectors into the region.
    most : float

    Returns
    -------
    (n,) float
    """
    order = np.argsort(points.real, kind="stable")
    found = np.full(len(points), most)
    arrays = (points[order].real, points[order].imag, normals[order].real, normals[order].imag)
    x, y, u, v = (np.ascontiguousarray(each) for each in arrays)
    ranks = np.empty(len(points), np.intp)
    ranks[order] = np.arange(len(points))
    _narrow(x, y, u, v, ranks, found)
    return found[ranks]


@cython.cfunc
def _narrow(
    x: cython.double[::1],
    y: cython.double[::1],
    u: cython.double[::1],
    v: cython.double[::1],
    ranks: cython.Py_ssize_t[::1],
    found: cython.double[::1],
) -> None:
    """Narrow the balls of points, which rise in x, by each other; only points within a diameter matter.

    They are looked at in the order of the outline: what bounds the last ball most often nearly bounds the next one.
    """
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    step: cython.int
    count: cython.Py_ssize_t = x.shape[0]
    bounding: cython.Py_ssize_t = -1
    for k in range(count):
        i = ranks[k]
        best: cython.double = found[i]
        last: cython.Py_ssize_t = bounding
        bounding = -1
        for step in (0, 1, -1):
            j = last if step == 0 else i + step
            while 0 <= j < count:
                dx: cython.double = x[j] - x[i]
                if dx * step > best:
                    break
                dy: cython.double = y[j] - y[i]
                if -best < dy < best:
                    inward: cython.double = u[i] * dx + v[i] * dy
                    square: cython.double = dx * dx + dy * dy
                    if (
                        inward > 0.0
                        and inward * inward > GRAZING * GRAZING * square
                        and square < best * inward
                    ):
                        best = square / inward
                        bounding = j
                if step == 0:
                    break
                j += step
        found[i] = best
