# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""The largest balls inside a region that touch its outline at given points.

This file is compiled by Cython and runs uncompiled as well.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, FloatArray

COMPILED = cython.compiled

INFINITY = cython.declare(cython.double, float("inf"))

GRAZING = cython.declare(cython.double, 1e-6)
"""Minimum sine of the angle between the tangent at a point and the chord to one that bounds its ball."""

BLOCK = cython.declare(cython.Py_ssize_t, 16)
"""Number of points that are left out together where none is in a ball."""

NO_LESS = cython.declare(cython.double, 1.0 + 1e-9)
"""Minimum square of the distance of such points from the ball's centre, in squares of its radius: above rounding."""


class Ample(NamedTuple):
    """What it takes for balls to be wide enough together."""

    weight: FloatArray  # (n,), of each ball
    wide: float  # the minimum diameter of a wide one
    enough: float  # the weight that wide ones together exceed


def ball_diameters(
    points: ComplexArray, normals: ComplexArray, most: float, ample: Ample | None = None
) -> FloatArray | None:
    """Return the diameter of the largest ball inside an outline that touches it at each point, at most `most`.

    None as soon as so many balls are wide that the others do not matter.

    A ball that touches at p, where n is the inner normal, and also holds q on its rim has the diameter
    ``|q - p|^2 / (n . (q - p))``; the largest one inside is the least of these over all other points.

    Parameters
    ----------
    points : (n,) complex
        Of all contours of a region.
    normals : (n,) complex
        Unit vectors into the region.
    most : float
    ample : Ample, optional

    Returns
    -------
    (n,) float, or None
    """
    found = np.full(len(points), most)
    weight, wide, enough = ample or Ample(np.zeros(len(points)), INFINITY, 0.0)
    parts = (points.real, points.imag, normals.real, normals.imag)
    x, y, u, v = map(np.ascontiguousarray, parts)
    boxes = np.empty(((len(points) + BLOCK - 1) // BLOCK, 4))
    is_ample = _narrow(x, y, u, v, boxes, weight, np.array([wide, enough], np.float64), found)
    return None if is_ample else found


@cython.cfunc
@cython.exceptval(check=False)
def _fill_boxes(x: cython.double[::1], y: cython.double[::1], boxes: cython.double[:, ::1]) -> cython.void:
    """Fill in the boxes around blocks of points: left, right, top and bottom."""
    b: cython.Py_ssize_t
    j: cython.Py_ssize_t
    for b in range(boxes.shape[0]):
        j = b * BLOCK
        boxes[b, 0] = boxes[b, 1] = x[j]
        boxes[b, 2] = boxes[b, 3] = y[j]
        for j in range(b * BLOCK + 1, min(x.shape[0], (b + 1) * BLOCK)):
            boxes[b, 0], boxes[b, 1] = min(boxes[b, 0], x[j]), max(boxes[b, 1], x[j])
            boxes[b, 2], boxes[b, 3] = min(boxes[b, 2], y[j]), max(boxes[b, 3], y[j])


@cython.cfunc
def _narrow(
    x: cython.double[::1],
    y: cython.double[::1],
    u: cython.double[::1],
    v: cython.double[::1],
    boxes: cython.double[:, ::1],
    weight: cython.double[::1],
    limits: cython.double[::1],
    found: cython.double[::1],
) -> cython.bint:
    """Narrow the balls of points by each other, until there are enough wide ones; only points inside a ball matter.

    What bounds the last ball most often nearly bounds the next one, so it is looked at first. Then come the blocks that
    reach into the ball. The boxes around blocks are filled in.
    """
    wide: cython.double = limits[0]
    enough: cython.double = limits[1]
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    b: cython.Py_ssize_t
    count: cython.Py_ssize_t = x.shape[0]
    bounding: cython.Py_ssize_t = 0
    heavy: cython.double = 0.0
    _fill_boxes(x, y, boxes)
    for i in range(count):
        px: cython.double = x[i]
        py: cython.double = y[i]
        nx: cython.double = u[i]
        ny: cython.double = v[i]
        best: cython.double = found[i]
        first: cython.Py_ssize_t = bounding
        for b in range(-1, boxes.shape[0]):
            begin: cython.Py_ssize_t = first
            end: cython.Py_ssize_t = first + 1
            if b >= 0:
                radius: cython.double = 0.5 * best
                away_x: cython.double = px + radius * nx
                away_y: cython.double = py + radius * ny
                away_x = max(boxes[b, 0] - away_x, away_x - boxes[b, 1], 0.0)
                away_y = max(boxes[b, 2] - away_y, away_y - boxes[b, 3], 0.0)
                if away_x * away_x + away_y * away_y > radius * radius * NO_LESS:
                    continue
                begin = b * BLOCK
                end = min(count, begin + BLOCK)
            for j in range(begin, end):
                dx: cython.double = x[j] - px
                dy: cython.double = y[j] - py
                inward: cython.double = nx * dx + ny * dy
                square: cython.double = dx * dx + dy * dy
                if square < best * inward and inward * inward > GRAZING * GRAZING * square:
                    best = square / inward
                    bounding = j
        found[i] = best
        if best >= wide:
            heavy += weight[i]
            if heavy > enough:
                return True
    return False
