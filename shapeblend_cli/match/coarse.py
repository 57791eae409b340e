"""Graphs of any size: exact where that is quick, from coarse to fine beyond.

A problem too large to be solved at once is thinned out to a third of its vertices on each side, sharp
corners first, and solved so, by thinning again if need be. The path found is laid into the full graph, a
corridor around it is searched exactly, and where the best path touches the corridor's wall the corridor is
widened there and searched again. Under finer sampling stretching and bending work tend to a limit, so a
coarse optimum is near a fine one; but nothing is proven.

Cost: about linear in m + n.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.match import starts
from shapeblend_cli.match.work import Window, Wires, corners

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.match.starts import Path
    from shapeblend_cli.match.work import WorkConstants
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

    Dot = tuple[int, int]

FACTOR = 3
"""How many vertices become one."""

PAD = 16 * FACTOR
"""How far a corridor reaches to all sides of the coarse path, in vertices."""

MOST_WIDENINGS = 6

CORNER = 0.35
"""A vertex whose angle is this far from straight, in radians, is a corner."""

COARSEST_DOTS = 90_000
"""Problems of up to so many dots are not thinned out further."""


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """Two polygons whose vertices 0 are column 0 and row 0, and what is asked of a path between them.

    See `solve.least_work`.
    """

    p0: ComplexArray
    p1: ComplexArray
    closed: bool
    constants: WorkConstants
    weight: FloatArray | None
    band: float | None
    solver: str
    watch: Callable[[float], None]

    @property
    def wires(self) -> Wires:
        """The polygons, ready to be priced."""
        return Wires(self.p0, self.p1, self.closed, self.constants, self.weight)


def solve(problem: Problem, pins: list[Dot] | None, exact_dots: float) -> tuple[Path | None, bool]:
    """Find the least path.

    Parameters
    ----------
    problem : Problem
    pins : list of (int, int), or None
        Columns and rows the path goes through, in order, besides dot [0, 0], from which it leads back to
        itself or to the other ends. None for closed polygons: any start.
    exact_dots : float
        Graphs of more dots are solved from coarse to fine.

    Returns
    -------
    path : Path or None
        None when the band or the pins leave none.
    proven : bool
        Whether the path is the least, and not only the best in a corridor.
    """
    m, n = len(problem.p0), len(problem.p1)
    if m * n <= exact_dots:
        return _search(problem, _region(problem, pins), pins), problem.solver == "exact"
    return _refine(problem, pins), False


def _region(problem: Problem, pins: list[Dot] | None) -> Window:
    """The part of the graph that paths through the pins may go through."""
    m, n = len(problem.p0), len(problem.p1)
    columns = m + 1 if problem.closed else m
    if pins is None:
        return Window.full(columns, 2 * n)
    region = Window.full(columns, n + 1 if problem.closed else n)
    for c, r in pins:
        region.low[c + 1 :] = np.maximum(region.low[c + 1 :], r)
        region.high[:c] = np.minimum(region.high[:c], r)
    return Window.between(region.low, region.high)


def _search(problem: Problem, region: Window, pins: list[Dot] | None) -> Path | None:
    """Search a region exactly."""
    m, n = len(problem.p0), len(problem.p1)
    # A Southeast step past a pin would leave it out: into the row below it, or from the row above it.
    past = [dot for c, r in pins or [] for dot in ((c - 1, r), (c, r - 1))]
    forbidden = [(c, r) for c, r in past if 0 <= c < m and 0 <= r < n]
    search = starts.Search(problem.wires, region, problem.band, forbidden, problem.watch)
    if problem.solver == "simplified":
        return starts.simplified_of_all(search) if pins is None else starts.simplified_from(search)
    return starts.least_of_all(search) if pins is None else starts.least_from(search)


def _refine(problem: Problem, pins: list[Dot] | None) -> Path | None:
    """Solve a coarser problem and search a corridor around its path."""
    m, n = len(problem.p0), len(problem.p1)
    kept0 = thin(problem.p0, problem.closed, {c % m for c, _ in pins or []})
    kept1 = thin(problem.p1, problem.closed, {r % n for _, r in pins or []})
    coarser = replace(
        problem,
        p0=problem.p0[kept0],
        p1=problem.p1[kept1],
        weight=None if problem.weight is None else problem.weight[kept0],
        watch=lambda share: problem.watch(share / FACTOR),
    )
    coarse_pins = None
    if pins is not None:
        coarse_pins = [(_place_of(c, kept0, m), _place_of(r, kept1, n)) for c, r in pins]
    path, _ = solve(coarser, coarse_pins, COARSEST_DOTS)
    if path is None:
        return None
    dots = np.array(path.dots)
    laid = np.stack([_laid(dots[:, 0], kept0, m), _laid(dots[:, 1], kept1, n)], axis=1)
    sweeps = path.sweeps

    full = replace(problem, watch=lambda share: problem.watch((1.0 + (FACTOR - 1.0) * share) / FACTOR))
    walls = _region(problem, pins)
    pad = np.full(len(walls.low), PAD)
    for _ in range(MOST_WIDENINGS):
        region = corridor(laid, problem, pad, None if pins is None else walls)
        path = _search(full, region, pins)
        if path is None:
            pad *= 2
            continue
        sweeps += path.sweeps
        touching = _touching(np.array(path.dots), region, None if pins is None else walls)
        if not len(touching):
            break
        reach = np.zeros(len(pad), bool)
        for c in touching:
            reach[max(c - 2 * PAD, 0) : c + 2 * PAD + 1] = True
        pad[reach] *= 2
    if path is None:  # what fits at a third of the vertices need not fit near by in full
        path = _search(full, walls, pins)
    return path._replace(sweeps=sweeps) if path else None


def thin(vertices: ComplexArray, closed: bool, keep: set[int]) -> IntArray:
    """Numbers of about every third vertex.

    Of each run of `FACTOR` vertices the sharpest if it is a corner, else the first, so that smooth curves stay evenly
    divided; vertex 0, the last of an open polygon, and those to `keep`.
    """
    m = len(vertices)
    sharpness = np.abs(corners(vertices, closed)[:, 0] - np.pi)
    runs = -(-m // FACTOR)
    padded = np.zeros(runs * FACTOR)
    padded[:m] = np.where(sharpness > CORNER, sharpness, 0.0)
    kept = set((np.arange(runs) * FACTOR + padded.reshape(runs, FACTOR).argmax(axis=1)).tolist())
    return np.array(sorted(kept | keep | ({0} if closed else {0, m - 1})), np.intp)


def sharpest(vertices: ComplexArray) -> int:
    """The vertex of a closed polygon whose angle is furthest from straight."""
    return int(np.abs(corners(vertices, closed=True)[:, 0] - np.pi).argmax())


def corridor(path: IntArray, problem: Problem, pad: IntArray, walls: Window | None) -> Window:
    """The dots around a path.

    Parameters
    ----------
    path : (k, 2) int
        Columns and rows, not falling, from column 0 to the last; steps may be long.
    problem : Problem
    pad : (columns,) int
        How far the corridor reaches to all sides.
    walls : Window or None
        What it must stay inside; without walls its rows only must not be negative.
    """
    m, n = len(problem.p0), len(problem.p1)
    columns = len(pad)
    column = np.arange(columns)
    if problem.closed:  # the path goes on before its start and beyond its end as it does inside
        path = np.concatenate([path[:-1] - (m, n), path, path[1:] + (m, n)])
    # The boxes between neighbouring dots; those that hold a column reach from its first dot's row to its last's.
    before = np.clip(np.searchsorted(path[:, 0], column - pad, "left") - 1, 0, None)
    after = np.clip(np.searchsorted(path[:, 0], column + pad, "right"), None, len(path) - 1)
    low = np.minimum.accumulate((path[before, 1] - pad)[::-1])[::-1]
    high = np.maximum.accumulate(path[after, 1] + pad)
    if walls is not None:
        low, high = np.maximum(low, walls.low), np.minimum(high, walls.high)
    elif problem.closed:
        low[-1], high[-1] = low[0] + n, high[0] + n
        high = np.minimum(np.minimum(high, low + n - 1), high[-1])
        low = np.minimum(low, low[-1])
        lift = n if low[0] < 0 else 0
        low, high = low + lift, high + lift
    return Window.between(low, high)


def _touching(path: IntArray, region: Window, walls: Window | None) -> IntArray:
    """The columns in which a path runs along a wall of its corridor that is no wall of the graph."""
    c, r = path[:, 0], path[:, 1]
    at_low, at_high = r == region.low[c], r == region.high[c]
    if walls is not None:
        at_low &= region.low[c] > walls.low[c]
        at_high &= region.high[c] < walls.high[c]
    return np.unique(c[at_low | at_high])


def _laid(rows: IntArray, kept: IntArray, period: int) -> IntArray:
    """Vertex numbers of the full polygon, counted on beyond its period, from those of the thinned one."""
    return kept[rows % len(kept)] + period * (rows // len(kept))


def _place_of(row: int, kept: IntArray, period: int) -> int:
    """The inverse of `_laid` for a vertex that was kept."""
    return int(np.searchsorted(kept, row % period)) + len(kept) * (row // period)
