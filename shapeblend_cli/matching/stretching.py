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


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _work(
    k_s: cython.double, e_s: cython.double, c_s: cython.double, len0: cython.double, len1: cython.double
) -> cython.double:
    """Return the work to stretch an edge onto another one, see `stretching_work`."""
    delta: cython.double = fabs(len1 - len0)
    power: cython.double = delta * delta if e_s == 2.0 else pow(delta, e_s)
    resistance: cython.double = (1.0 - c_s) * min(len0, len1) + c_s * max(len0, len1)
    if resistance <= 0.0:
        resistance = 1.0
    return k_s * power / resistance


def stretching_work(
    len0: cython.const[cython.double][::1], len1: cython.const[cython.double][::1], constants: WorkConstants
) -> FloatArray:
    """Return the work to stretch edges of one wire onto edges of the other: equation (16), section 3.1.

    Parameters
    ----------
    len0, len1 : (k,) float, or (1,)
        Edge lengths L0 and L1 in unit-box lengths (section 3.3), >= 0; one length is that of all edges of its wire.
    constants : WorkConstants
        Reads k_s, e_s, c_s.

    Returns
    -------
    (k,) float, >= 0

    Notes
    -----
    Symmetric in the two lengths. Departure: L0 = L1 = 0 is 0/0 in (16); here it is 0.

    Examples
    --------
    Leg 1-2 of figure 23 (section 3.4):

    >>> w = stretching_work(np.array([0.5**0.5]), np.array([1.0]), WorkConstants(k_s=0.5, c_s=0.5, e_s=1))
    >>> w.round(4).tolist()
    [0.1716]
    """
    k_s: cython.double = constants.k_s
    e_s: cython.double = constants.e_s
    c_s: cython.double = constants.c_s
    found = np.empty(max(len0.shape[0], len1.shape[0]))
    work: cython.double[::1] = found
    step0: cython.Py_ssize_t = len0.shape[0] > 1
    step1: cython.Py_ssize_t = len1.shape[0] > 1
    k: cython.Py_ssize_t
    for k in range(work.shape[0]):
        work[k] = _work(k_s, e_s, c_s, len0[step0 * k], len1[step1 * k])
    return found


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
            work[k] = _work(k_s, e_s, c_s, length, len1[j]) * stiffness[c]
            j += 1
            if j == n:
                j = 0
