# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""Pictures drawn in triangles, pixel by pixel.

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
    from cython.cimports.cpython.exc import PyErr_CheckSignals as look_for_signals
    from cython.cimports.libc.math import ceil, fabs, floor
else:
    from math import ceil, fabs, floor

    from shapeblend_cli._cython import look_for_signals

if TYPE_CHECKING:
    from shapeblend_cli.model import FloatArray, UIntArray

COMPILED = cython.compiled

BEYOND = 1.5
"""Distance to which pixels beyond an edge of a triangle are drawn, if no triangle has them, in pixels."""

EDGE = 0.75
"""Distance to which the edge of a picture is drawn on, in pixels: half of one may be seen within a clip path."""


def draw_triangles(
    corners: FloatArray, sources: FloatArray, picture: UIntArray, target: UIntArray, weight: float
) -> None:
    """Add a picture, drawn in triangles, to a target.

    Parameters
    ----------
    corners : (k, 3, 2) float
        Corners of the triangles in pixels of the target, with a positive area; pixels have their centres at halves.
    sources : (k, 3, 2) float
        The same corners in pixels of the picture.
    picture : (h, w, 4) uint8
        Premultiplied.
    target : (h, w, 4) uint8
        Premultiplied; changed in place.
    weight : float
        Share of the picture that is added.
    """
    done = np.zeros(target.shape[:2], np.uint8)
    # First what lies inside; then what lies next to an edge: of a clip path it may be half a pixel that is seen.
    for beyond in (0.0, BEYOND):
        _draw(
            np.ascontiguousarray(corners, np.float64),
            np.ascontiguousarray(sources, np.float64),
            np.array(picture, np.uint8, order="C"),
            target,
            done,
            weight,
            beyond,
        )


def _draw(
    corners: cython.double[:, :, ::1],
    sources: cython.double[:, :, ::1],
    picture: cython.uchar[:, :, ::1],
    target: cython.uchar[:, :, ::1],
    done: cython.uchar[:, ::1],
    weight: cython.double,
    beyond: cython.double,
) -> None:
    """Draw pixels whose centres are in triangles, or within a distance of them, unless they are done."""
    height: cython.Py_ssize_t = target.shape[0]
    width: cython.Py_ssize_t = target.shape[1]
    k: cython.Py_ssize_t
    row: cython.Py_ssize_t
    column: cython.Py_ssize_t
    for k in range(corners.shape[0]):
        if k % 64 == 0:
            look_for_signals()
        ax: cython.double = corners[k, 0, 0]
        ay: cython.double = corners[k, 0, 1]
        bx: cython.double = corners[k, 1, 0] - ax
        by: cython.double = corners[k, 1, 1] - ay
        cx: cython.double = corners[k, 2, 0] - ax
        cy: cython.double = corners[k, 2, 1] - ay
        area: cython.double = bx * cy - by * cx
        if area <= 0.0:
            continue
        left: cython.double = ax + min(0.0, bx, cx) - beyond - 0.5
        right: cython.double = ax + max(0.0, bx, cx) + beyond - 0.5
        top: cython.double = ay + min(0.0, by, cy) - beyond - 0.5
        bottom: cython.double = ay + max(0.0, by, cy) + beyond - 0.5
        if right < 0.0 or bottom < 0.0 or left > width - 1 or top > height - 1:
            continue
        first_row: cython.Py_ssize_t = cython.cast(cython.Py_ssize_t, ceil(max(top, 0.0)))
        last_row: cython.Py_ssize_t = cython.cast(cython.Py_ssize_t, floor(min(bottom, height - 1.0)))
        first: cython.Py_ssize_t = cython.cast(cython.Py_ssize_t, ceil(max(left, 0.0)))
        last: cython.Py_ssize_t = cython.cast(cython.Py_ssize_t, floor(min(right, width - 1.0)))
        # How much of a share one pixel beyond each side is.
        side_a: cython.double = beyond * ((cx - bx) ** 2 + (cy - by) ** 2) ** 0.5 / area + 1e-9
        side_b: cython.double = beyond * (cx * cx + cy * cy) ** 0.5 / area + 1e-9
        side_c: cython.double = beyond * (bx * bx + by * by) ** 0.5 / area + 1e-9
        ux: cython.double = sources[k, 1, 0] - sources[k, 0, 0]
        uy: cython.double = sources[k, 1, 1] - sources[k, 0, 1]
        vx: cython.double = sources[k, 2, 0] - sources[k, 0, 0]
        vy: cython.double = sources[k, 2, 1] - sources[k, 0, 1]
        slack: cython.double = 0.5 + EDGE * (fabs(ux * vy - uy * vx) / area) ** 0.5
        for row in range(first_row, last_row + 1):
            for column in range(first, last + 1):
                if done[row, column]:
                    continue
                px: cython.double = column + 0.5 - ax
                py: cython.double = row + 0.5 - ay
                b: cython.double = (px * cy - py * cx) / area
                c: cython.double = (bx * py - by * px) / area
                a: cython.double = 1.0 - b - c
                if a < -side_a or b < -side_b or c < -side_c:
                    continue
                done[row, column] = 1
                x: cython.double = a * sources[k, 0, 0] + b * sources[k, 1, 0] + c * sources[k, 2, 0]
                y: cython.double = a * sources[k, 0, 1] + b * sources[k, 1, 1] + c * sources[k, 2, 1]
                _add_pixel(picture, x - 0.5, y - 0.5, slack, target, row, column, weight)


@cython.cfunc
@cython.exceptval(check=False)
def _add_pixel(
    picture: cython.uchar[:, :, ::1],
    x: cython.double,
    y: cython.double,
    slack: cython.double,
    target: cython.uchar[:, :, ::1],
    row: cython.Py_ssize_t,
    column: cython.Py_ssize_t,
    weight: cython.double,
) -> cython.void:
    """Add what a picture has at a place, between its pixels; nothing where that is beyond its edge."""
    height: cython.Py_ssize_t = picture.shape[0]
    width: cython.Py_ssize_t = picture.shape[1]
    if x < -slack or y < -slack or x > width - 1.0 + slack or y > height - 1.0 + slack:
        return
    x = min(max(x, 0.0), width - 1.0)
    y = min(max(y, 0.0), height - 1.0)
    x0: cython.Py_ssize_t = cython.cast(cython.Py_ssize_t, x)
    y0: cython.Py_ssize_t = cython.cast(cython.Py_ssize_t, y)
    x1: cython.Py_ssize_t = min(x0 + 1, width - 1)
    y1: cython.Py_ssize_t = min(y0 + 1, height - 1)
    u: cython.double = x - x0
    v: cython.double = y - y0
    n: cython.Py_ssize_t
    for n in range(4):
        upper: cython.double = (1.0 - u) * picture[y0, x0, n] + u * picture[y0, x1, n]
        lower: cython.double = (1.0 - u) * picture[y1, x0, n] + u * picture[y1, x1, n]
        value: cython.double = target[row, column, n] + weight * ((1.0 - v) * upper + v * lower)
        target[row, column, n] = cython.cast(cython.Py_ssize_t, min(value + 0.5, 255.0))
