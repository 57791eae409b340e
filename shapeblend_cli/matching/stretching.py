# cython: boundscheck=False, wraparound=False, cdivision=True
"""The work of stretching edges: section 3.1 of the paper, see `work`.

This file is compiled by Cython and runs uncompiled as well.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.options.constants import WorkConstants

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.cpython.exc import PyErr_CheckSignals as look_for_signals
    from cython.cimports.libc.math import fabs, pow
else:
    from math import fabs, pow

    from shapeblend_cli._cython import look_for_signals

if TYPE_CHECKING:
    from shapeblend_cli.matching.tables import Window
    from shapeblend_cli.model import FloatArray, IntArray

COMPILED = cython.compiled


def stretching_work(len0: FloatArray, len1: FloatArray, constants: WorkConstants) -> FloatArray:
    """Return the work to stretch edges of one wire onto edges of the other: equation (16), section 3.1.

    Parameters
    ----------
    len0, len1 : ndarray of float, mutually broadcastable
        Edge lengths L0 and L1 in unit-box lengths (section 3.3), >= 0.
    constants : WorkConstants
        Reads k_s, e_s, c_s.

    Returns
    -------
    ndarray of the broadcast shape, >= 0

    Notes
    -----
    Symmetric in the two lengths. Departure: L0 = L1 = 0 is 0/0 in (16); here it is 0.

    Examples
    --------
    Leg 1-2 of figure 23 (section 3.4):

    >>> w = stretching_work(0.5**0.5, 1.0, WorkConstants(k_s=0.5, c_s=0.5, e_s=1))
    >>> round(float(w), 4)
    0.1716
    """
    k_s, e_s, c_s = constants.k_s, constants.e_s, constants.c_s
    delta = np.abs(np.subtract(len1, len0))
    resistance = (1.0 - c_s) * np.minimum(len0, len1) + c_s * np.maximum(len0, len1)
    return k_s * delta**e_s / np.where(resistance > 0.0, resistance, 1.0)


def fill_stretching(
    lengths: tuple[FloatArray, FloatArray],
    constants: WorkConstants,
    columns: IntArray,
    weight: FloatArray,
    window: Window,
    southeast: FloatArray,
) -> None:
    """Fill in the work to stretch an edge of one wire onto an edge of the other, for every dot of a window.

    Parameters
    ----------
    lengths : ((m,) float, (n,) float)
        Of the edges of both wires.
    constants : WorkConstants
    columns : (columns,) int
        Edges of the first wire, one for each column; rows are edges of the second, modulo n.
    weight : (columns,) float
        Multiplies the work there.
    window : Window
    southeast : (dots,) float
    """
    len0: cython.double[::1] = lengths[0]
    len1: cython.double[::1] = lengths[1]
    edges: cython.Py_ssize_t[::1] = columns
    stiffness: cython.double[::1] = weight
    low: cython.Py_ssize_t[::1] = window.low
    high: cython.Py_ssize_t[::1] = window.high
    column_offset: cython.Py_ssize_t[::1] = window.column_offset
    work: cython.double[::1] = southeast
    k_s: cython.double = constants.k_s
    e_s: cython.double = constants.e_s
    c_s: cython.double = constants.c_s
    is_square: cython.bint = e_s == 2.0
    n: cython.Py_ssize_t = len1.shape[0]
    c: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    for c in range(edges.shape[0]):
        if c % 8 == 0:
            look_for_signals()
        length: cython.double = len0[edges[c]]
        j = low[c] % n
        for k in range(column_offset[c], column_offset[c] + high[c] - low[c] + 1):
            delta: cython.double = fabs(len1[j] - length)
            power: cython.double = delta * delta if is_square else pow(delta, e_s)
            resistance: cython.double = (1.0 - c_s) * min(length, len1[j]) + c_s * max(length, len1[j])
            if resistance <= 0.0:
                resistance = 1.0
            work[k] = k_s * power / resistance * stiffness[c]
            j += 1
            if j == n:
                j = 0
