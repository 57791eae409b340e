# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""Winding numbers of polygons around points, and on a grid of points.

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
    from cython.cimports.libc.math import ceil, fabs
else:
    from math import ceil, fabs

    from shapeblend_cli._cython import look_for_signals

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

COMPILED = cython.compiled


def winding_grid(
    starts: ComplexArray, ends: ComplexArray, corner: complex, step: float, side: int
) -> IntArray:
    """Return the winding numbers of closed polygons, taken together, around the points of a square grid.

    Parameters
    ----------
    starts, ends : (n,) complex
        The edges of all polygons, in any order.
    corner : complex
        Where the grid begins; its first point is half a step further, both ways.
    step : float
        The distance between neighbouring points.
    side : int
        The number of points along each side.

    Returns
    -------
    (side, side) int
        A row for each y; positive where a polygon runs from x towards y.
    """
    # At each crossing of an edge and a row the number changes for all points of the row beyond it.
    changes = np.zeros((side, side + 1), np.intc)
    p, q = (starts - corner) / step - (0.5 + 0.5j), (ends - corner) / step - (0.5 + 0.5j)
    x0, y0, x1, y1 = (np.ascontiguousarray(one) for one in (p.real, p.imag, q.real, q.imag))
    _add_crossings(x0, y0, x1, y1, changes)
    return changes.cumsum(axis=1)[:, :side]


def _add_crossings(
    x0: cython.double[::1],
    y0: cython.double[::1],
    x1: cython.double[::1],
    y1: cython.double[::1],
    changes: cython.int[:, ::1],
) -> None:
    """Add the changes at crossings of each edge, in steps of the grid; rows and columns lie on whole numbers."""
    side: cython.Py_ssize_t = changes.shape[0]
    k: cython.Py_ssize_t
    row: cython.Py_ssize_t
    first: cython.Py_ssize_t
    last: cython.Py_ssize_t
    for k in range(x0.shape[0]):
        change: cython.int = -1 if y1[k] > y0[k] else 1
        low: cython.double = min(y0[k], y1[k])
        high: cython.double = max(y0[k], y1[k])
        if high <= 0.0 or low > side - 1:
            continue
        first = 0 if low <= 0.0 else cython.cast(cython.Py_ssize_t, ceil(low))
        last = side if high > side - 1 else cython.cast(cython.Py_ssize_t, ceil(high))
        for row in range(first, last):
            x: cython.double = x0[k] + (row - y0[k]) * (x1[k] - x0[k]) / (y1[k] - y0[k])
            if x <= 0.0:
                changes[row, 0] += change
            elif x <= side - 1:
                changes[row, cython.cast(cython.Py_ssize_t, ceil(x))] += change


def winding_table(
    points: ComplexArray, vertices: ComplexArray, starts: IntArray, boxes: FloatArray
) -> IntArray:
    """Return the winding numbers of closed polygons around points, see `polygons.winding_numbers`.

    Parameters
    ----------
    points : (p,) complex
    vertices : (m,) complex
        Of all polygons, one after the other.
    starts : (k + 1,) int
        Where each polygon begins there, and m.
    boxes : (k, 4) float, or empty
        The box of each polygon, as x, y, width and height: no other point is looked at.

    Returns
    -------
    (k, p) int
    """
    numbers: IntArray = np.zeros((len(starts) - 1, len(points)), np.intc)
    _add_windings(np.ascontiguousarray(points), np.ascontiguousarray(vertices), starts, boxes, numbers)
    return numbers


def _add_windings(
    points: cython.const[cython.doublecomplex][::1],
    vertices: cython.const[cython.doublecomplex][::1],
    starts: cython.Py_ssize_t[::1],
    boxes: cython.const[cython.double][:, ::1],
    numbers: cython.int[:, ::1],
) -> None:
    """Count the edges that cross the ray from each point along +x, upwards less downwards."""
    has_boxes: cython.bint = boxes.shape[0] > 0
    k: cython.Py_ssize_t
    p: cython.Py_ssize_t
    i: cython.Py_ssize_t
    first: cython.Py_ssize_t
    last: cython.Py_ssize_t
    before: cython.Py_ssize_t
    number: cython.int
    below: cython.bint
    for k in range(numbers.shape[0]):
        first, last = starts[k], starts[k + 1]
        for p in range(points.shape[0]):
            x: cython.double = points[p].real
            y: cython.double = points[p].imag
            if has_boxes and not (
                fabs(x - boxes[k, 0] - boxes[k, 2] / 2) <= boxes[k, 2] / 2
                and fabs(y - boxes[k, 1] - boxes[k, 3] / 2) <= boxes[k, 3] / 2
            ):
                continue
            number = 0
            before = last - 1
            below = vertices[before].imag <= y
            for i in range(first, last):
                if below == (vertices[i].imag <= y):
                    before = i
                    continue
                # On which side of the edge the point lies.
                side: cython.double = (vertices[i].real - vertices[before].real) * (
                    y - vertices[before].imag
                ) - (x - vertices[before].real) * (vertices[i].imag - vertices[before].imag)
                if below and side > 0.0:
                    number += 1
                elif not below and side < 0.0:
                    number -= 1
                below = not below
                before = i
            numbers[k, p] = number
        if k % 64 == 0 or last - first > 1000:
            look_for_signals()
