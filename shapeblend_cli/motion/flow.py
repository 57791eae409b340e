"""The curve shortening flow of a polygon: every point moves by the curvature vector.

A closed curve without crossings becomes convex and then round under this flow, and never crosses itself on the way:
M. A. Grayson, "The heat equation shrinks embedded plane curves to round points", J. Differential Geometry 26
(1987). Two curves that do not touch keep apart. This file is compiled by Cython and runs uncompiled as well.
"""

from __future__ import annotations

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.libc.math import sqrt
else:
    from math import sqrt

COMPILED = cython.compiled


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def shorten(
    points: cython.double[:, ::1],
    scratch: cython.double[:, ::1],
    closed: cython.bint,
    time: cython.double,
    least_edge: cython.double,
) -> None:
    """Move the vertices of a polygon in place, by one implicit step of the flow.

    The flow is taken in the form ``dx/dt = x_uu / |x_u|^2`` with u the vertex number: across the curve that is its
    curvature, and along it vertices spread until they are even, so that runs of coincident vertices open. One step
    solves ``(1 + 2 c_i) x_i - c_i (x_{i-1} + x_{i+1}) = x_i(old)`` with ``c_i = time / h_i^2``, by elimination, the
    last vertex of closed polygons by itself. It is stable for any step.

    Parameters
    ----------
    points : (n, 2) float, n >= 3
        Moved in place. The ends of an open polygon stay.
    scratch : (n, 3) float
        Scratch space.
    closed : bool
    time : float > 0
        Length of the step; a circle of radius r shrinks by ``time / r``.
    least_edge : float > 0
        The two edges at a vertex count as no shorter than this on average.
    """
    n: cython.Py_ssize_t = points.shape[0]
    k: cython.Py_ssize_t
    before: cython.Py_ssize_t
    after: cython.Py_ssize_t
    before_x: cython.double
    before_y: cython.double
    after_x: cython.double
    after_y: cython.double
    h: cython.double
    pivot: cython.double
    # In scratch: c_i; the upper diagonal, eliminated; how the last vertex moves the others.
    last: cython.Py_ssize_t = n - 1
    for k in range(n):
        if not closed and (k == 0 or k == last):
            scratch[k, 0] = 0.0
            continue
        before = k - 1 if k > 0 else last
        after = k + 1 if k < last else 0
        before_x = points[k, 0] - points[before, 0]
        before_y = points[k, 1] - points[before, 1]
        after_x = points[k, 0] - points[after, 0]
        after_y = points[k, 1] - points[after, 1]
        h = 0.5 * (
            sqrt(before_x * before_x + before_y * before_y) + sqrt(after_x * after_x + after_y * after_y)
        )
        if h < least_edge:
            h = least_edge
        scratch[k, 0] = time / (h * h)
    # The first n - 1 rows, with what the last vertex adds to the first and the one before it as a second right side.
    for k in range(last):
        pivot = 1.0 + 2.0 * scratch[k, 0]
        scratch[k, 2] = scratch[k, 0] if (closed and k == 0) else 0.0
        if k == last - 1:
            scratch[k, 2] += scratch[k, 0]
        if k > 0:
            pivot -= scratch[k, 0] * scratch[k - 1, 1]
            points[k, 0] += scratch[k, 0] * points[k - 1, 0]
            points[k, 1] += scratch[k, 0] * points[k - 1, 1]
            scratch[k, 2] += scratch[k, 0] * scratch[k - 1, 2]
        scratch[k, 1] = scratch[k, 0] / pivot
        points[k, 0] /= pivot
        points[k, 1] /= pivot
        scratch[k, 2] /= pivot
    for k in range(last - 2, -1, -1):
        points[k, 0] += scratch[k, 1] * points[k + 1, 0]
        points[k, 1] += scratch[k, 1] * points[k + 1, 1]
        scratch[k, 2] += scratch[k, 1] * scratch[k + 1, 2]
    if closed:
        pivot = 1.0 + 2.0 * scratch[last, 0] - scratch[last, 0] * (scratch[last - 1, 2] + scratch[0, 2])
        points[last, 0] = (points[last, 0] + scratch[last, 0] * (points[last - 1, 0] + points[0, 0])) / pivot
        points[last, 1] = (points[last, 1] + scratch[last, 0] * (points[last - 1, 1] + points[0, 1])) / pivot
    for k in range(last):
        points[k, 0] += scratch[k, 2] * points[last, 0]
        points[k, 1] += scratch[k, 2] * points[last, 1]
