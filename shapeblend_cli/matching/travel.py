# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""The work of travel of a wire's points. Not in the paper. This file is compiled by Cython and runs uncompiled.

Nothing in the paper's work knows where a point is: a wire alone in space may rotate for nothing. Here the boxes of
both wires are made the unit square, axis by axis, and a dot whose points are at distance d there costs

    k_t d^2 l,

l being a quarter of the lengths of the steps into the dot and out of it, on both wires, added up: so the sum over dots
is an integral along the wires, whatever the number of vertices.
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
else:
    from shapeblend_cli._cython import look_for_signals

if TYPE_CHECKING:
    from shapeblend_cli.matching.tables import Window
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

COMPILED = cython.compiled

FLAT = cython.declare(cython.double, 0.02)
"""Minimum height of a box, as a share of its width, and the other way round."""


def places(vertices: ComplexArray) -> ComplexArray:
    """Return where points are in their box, made the unit square axis by axis."""
    found = np.empty(len(vertices), np.complex128)
    _fill_places(np.ascontiguousarray(vertices, np.complex128), found.view(np.float64))
    return found


@cython.cfunc
def _fill_places(vertices: cython.const[cython.doublecomplex][::1], found: cython.double[::1]) -> None:
    """Fill in x and y of places by turns."""
    k: cython.Py_ssize_t
    left: cython.double = vertices[0].real
    top: cython.double = vertices[0].imag
    right: cython.double = left
    bottom: cython.double = top
    for k in range(vertices.shape[0]):
        left, right = min(left, vertices[k].real), max(right, vertices[k].real)
        top, bottom = min(top, vertices[k].imag), max(bottom, vertices[k].imag)
    width: cython.double = right - left
    height: cython.double = bottom - top
    least: cython.double = FLAT * max(width, height)
    width, height = max(width, least), max(height, least)
    for k in range(vertices.shape[0]):
        found[2 * k] = (vertices[k].real - left) / width
        found[2 * k + 1] = (vertices[k].imag - top) / height


@cython.final
@cython.cclass
class Stations:
    """The vertices of a wire: places, and a quarter of the length of the edges before and after them."""

    place: cython.doublecomplex[::1]
    before: cython.double[::1]
    after: cython.double[::1]

    def __init__(self, place: ComplexArray, lengths: FloatArray) -> None:
        self.place = place
        last = len(lengths) - 1
        self.after = 0.25 * lengths
        self.before = 0.25 * np.concatenate([lengths[last:], lengths[:last]])


def add_travel(
    p: Stations, q: Stations, k_t: float, columns: IntArray, window: Window, bends: FloatArray
) -> None:
    """Add the work of travel to the seven bends of every dot of a window.

    Parameters
    ----------
    p, q : Stations
        Of the first wire and the second.
    k_t : float
    columns : (columns,) int
        Vertices of the first wire, one for each column; rows are vertices of the second, modulo n.
    window : Window
    bends : (dots, 7) float
    """
    vertices: cython.Py_ssize_t[::1] = columns
    low: cython.Py_ssize_t[::1] = window.low
    high: cython.Py_ssize_t[::1] = window.high
    column_offset: cython.Py_ssize_t[::1] = window.column_offset
    work: cython.double[:, ::1] = bends
    stiffness: cython.double = k_t
    n: cython.Py_ssize_t = q.place.shape[0]
    c: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    for c in range(vertices.shape[0]):
        if c % 8 == 0:
            look_for_signals()
        i = vertices[c]
        j = low[c] % n
        x, y = p.place[i].real, p.place[i].imag
        into_p, out_p = p.before[i], p.after[i]
        for k in range(column_offset[c], column_offset[c] + high[c] - low[c] + 1):
            dx: cython.double = x - q.place[j].real
            dy: cython.double = y - q.place[j].imag
            rate: cython.double = stiffness * (dx * dx + dy * dy)
            into_q, out_q = q.before[j], q.after[j]
            # In the order of `steps.BENDS`, whose names the C compiler takes for variables: it would read them again.
            work[k, 0] += rate * (into_p + out_p)
            work[k, 1] += rate * (into_p + out_p + out_q)
            work[k, 2] += rate * (into_p + into_q + out_p)
            work[k, 3] += rate * (into_q + out_q)
            work[k, 4] += rate * (into_q + out_p + out_q)
            work[k, 5] += rate * (into_p + into_q + out_q)
            work[k, 6] += rate * (into_p + into_q + out_p + out_q)
            j += 1
            if j == n:
                j = 0
