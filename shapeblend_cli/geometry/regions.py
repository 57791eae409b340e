# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""Connected regions of equal numbers in pictures.

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
    from shapeblend_cli.model import IntArray

COMPILED = cython.compiled


def count_regions(picture: IntArray, least: int) -> tuple[int, int]:
    """Count the regions of pixels that have one number and share sides.

    Parameters
    ----------
    picture : (rows, columns) int
        0 is the ground.
    least : int
        Minimum number of pixels of a region that counts.

    Returns
    -------
    painted : int
        Regions of numbers but 0.
    holes : int
        Regions of the ground that do not reach the border.
    """
    numbers = np.ascontiguousarray(picture, dtype=np.intc)
    parents = np.arange(numbers.size, dtype=np.intc)
    sizes = np.zeros(numbers.size, np.intc)
    framed = np.zeros(numbers.size, np.intc)
    _join(numbers, parents)
    _measure(parents.reshape(numbers.shape), sizes, framed)
    roots = np.flatnonzero(sizes >= least)
    ground = numbers.ravel()[roots] == 0
    return int((~ground).sum()), int((ground & (framed[roots] == 0)).sum())


def _join(numbers: cython.int[:, ::1], parents: cython.int[::1]) -> None:
    """Give each pixel the first pixel of its region."""
    rows: cython.Py_ssize_t = numbers.shape[0]
    columns: cython.Py_ssize_t = numbers.shape[1]
    row: cython.Py_ssize_t
    column: cython.Py_ssize_t
    for row in range(rows):
        for column in range(columns):
            at: cython.int = cython.cast(cython.int, row * columns + column)
            number: cython.int = numbers[row, column]
            is_left: cython.bint = column > 0 and numbers[row, column - 1] == number
            is_above: cython.bint = row > 0 and numbers[row - 1, column] == number
            if is_left:
                parents[at] = parents[at - 1]
            # Where the pixel between them is also alike, both are in one region already.
            if is_above and not (is_left and numbers[row - 1, column - 1] == number):
                _unite(parents, at, at - cython.cast(cython.int, columns))
    k: cython.Py_ssize_t
    for k in range(parents.shape[0]):
        parents[k] = _root(parents, cython.cast(cython.int, k))


def _measure(roots: cython.int[:, ::1], sizes: cython.int[::1], framed: cython.int[::1]) -> None:
    """Count the pixels of each region, by its first pixel, and those of them at the border."""
    last_row: cython.Py_ssize_t = roots.shape[0] - 1
    last_column: cython.Py_ssize_t = roots.shape[1] - 1
    row: cython.Py_ssize_t
    column: cython.Py_ssize_t
    for row in range(last_row + 1):
        for column in range(last_column + 1):
            root: cython.int = roots[row, column]
            sizes[root] += 1
            framed[root] += row == 0 or row == last_row or column == 0 or column == last_column


@cython.cfunc
def _root(parents: cython.int[::1], k: cython.int) -> cython.int:
    while parents[k] != k:
        parents[k] = parents[parents[k]]
        k = parents[k]
    return k


@cython.cfunc
def _unite(parents: cython.int[::1], i: cython.int, j: cython.int) -> None:
    i = _root(parents, i)
    j = _root(parents, j)
    if i < j:
        parents[j] = i
    else:
        parents[i] = j
