"""The least-work correspondence of two polygons, from vertices to dots."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.match import angles, starts
from shapeblend_cli.match.work import WorkConstants, corners, path_work, tables
from shapeblend_cli.model import Correspondence

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, IntArray

COMPILED: bool = angles.COMPILED
"""Whether the kernels were compiled; uncompiled they give the same results, far slower."""


def least_work(
    p0: ComplexArray,
    p1: ComplexArray,
    closed: bool,
    constants: WorkConstants | None = None,
    start: tuple[int, int] | None = None,
) -> Correspondence:
    """Find the correspondence that takes the least work.

    Parameters
    ----------
    p0, p1 : (m,) and (n,) complex
        Vertices in the unit box (section 3.3), both polygons in the same direction, neighbours distinct,
        the first vertex not repeated. m, n >= 3 when closed, >= 2 when open.
    closed : bool
        Open polygons correspond end to end, first vertex to first.
    constants : WorkConstants, optional
    start : (int, int), optional
        A vertex of `p0` and the vertex of `p1` it must correspond to. Without it every start is considered,
        and the result is the least over all of them.

    Returns
    -------
    Correspondence
        Closed paths begin at `start`, else where they come to vertex 0 of `p0`.

    Raises
    ------
    MatchError
        A start that names no vertex, or any start for open polygons, whose ends correspond.
    """
    constants = constants or WorkConstants()
    m, n = len(p0), len(p1)
    if start is not None:
        if not closed:
            raise MatchError("the outlines are open: their ends correspond, and a start cannot be chosen")
        if not (0 <= start[0] < m and 0 <= start[1] < n):
            raise MatchError(f"start {start[0]},{start[1]} names no vertices; 0,0 to {m - 1},{n - 1} would")

    # Column 0 of the graph: the given start, or the sharpest corner, where the fewest rows are worth a look.
    first0, first1 = start or (_sharpest(p0) if closed else 0, 0)
    rolled0, rolled1 = np.roll(p0, -first0), np.roll(p1, -first1)
    priced = tables(rolled0, rolled1, closed, constants)
    if not closed:
        path = starts.least_open(priced)
    elif start is not None:
        path = starts.least_from_zero(priced)
    else:
        path = starts.least_closed(priced)

    dots = np.array(path.dots, np.intp)
    if closed:
        dots = dots[:-1]  # the end is the start again
    dots = (dots + np.array([first0, first1])) % np.array([m, n])
    if closed and start is None:
        dots = np.roll(dots, -_enters_column_0(dots[:, 0]), axis=0)
    price = path_work(p0, p1, dots, closed, constants)
    return Correspondence(
        dots=dots,
        closed=closed,
        stretching=price.stretching,
        bending=price.bending,
        lower_bound=price.total,
        zero_angles=price.zero_angles,
        diagonal_deviation=diagonal_deviation(dots, m, n, closed),
        sweeps=path.sweeps,
    )


def diagonal_deviation(dots: IntArray, m: int, n: int, closed: bool) -> float:
    """How far a path deviates from the diagonal through its first dot, eqs (29) and (30).

    The m and n of the equations count edges: an open polygon has one less than vertices.
    """
    moves = np.diff(dots, axis=0) % (m, n)
    gone = np.cumsum(moves, axis=0) / ((m, n) if closed else (m - 1, n - 1))
    return float(np.abs(gone[:, 0] - gone[:, 1]).max(initial=0.0))


def _sharpest(vertices: ComplexArray) -> int:
    theta = corners(vertices, closed=True)[:, 0]
    return int(np.abs(theta - np.pi).argmax())


def _enters_column_0(columns: IntArray) -> int:
    """Where a closed path comes to column 0 from another column."""
    return int(np.flatnonzero((columns == 0) & (np.roll(columns, 1) != 0))[0])
