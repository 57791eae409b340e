"""Where an outline crosses itself.

This file is compiled by Cython and runs uncompiled as well.
"""

from __future__ import annotations

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

COMPILED = cython.compiled


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _side(
    ax: cython.double,
    ay: cython.double,
    bx: cython.double,
    by: cython.double,
    px: cython.double,
    py: cython.double,
    noise: cython.double,
) -> cython.int:
    """Which side of the line a -> b the point p lies on: 1, -1, or 0 when on it to rounding."""
    area: cython.double = (bx - ax) * (py - ay) - (by - ay) * (px - ax)
    if area > noise:
        return 1
    if area < -noise:
        return -1
    return 0


@cython.boundscheck(False)
@cython.wraparound(False)
def count_crossings(edges: cython.double[:, ::1], noise: cython.double) -> int:
    """Count the pairs of edges that cross, each in the inside of the other.

    Edges that touch, at a vertex or along a common run, do not cross.

    Parameters
    ----------
    edges : (k, 4) float
        ``x0, y0, x1, y1`` of each edge with ``x0 <= x1``, in order of x0.
    noise : float >= 0
        Twice the area of a triangle that counts as flat.

    Returns
    -------
    int
        O(k log k + pairs whose x ranges overlap); the sorting is the caller's.
    """
    count: cython.Py_ssize_t = 0
    k: cython.Py_ssize_t = edges.shape[0]
    p: cython.Py_ssize_t
    q: cython.Py_ssize_t
    ax: cython.double
    ay: cython.double
    bx: cython.double
    by: cython.double
    cx: cython.double
    cy: cython.double
    dx: cython.double
    dy: cython.double
    for p in range(k):
        ax = edges[p, 0]
        ay = edges[p, 1]
        bx = edges[p, 2]
        by = edges[p, 3]
        for q in range(p + 1, k):
            cx = edges[q, 0]
            if cx > bx:
                break
            cy = edges[q, 1]
            dx = edges[q, 2]
            dy = edges[q, 3]
            if max(cy, dy) < min(ay, by) or min(cy, dy) > max(ay, by):
                continue
            if (
                _side(ax, ay, bx, by, cx, cy, noise) * _side(ax, ay, bx, by, dx, dy, noise) < 0
                and _side(cx, cy, dx, dy, ax, ay, noise) * _side(cx, cy, dx, dy, bx, by, noise) < 0
            ):
                count += 1
    return count
