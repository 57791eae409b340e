"""The starting correspondence: least work over every start, proven (section 4.2).

The paper takes the divide and conquer of its reference [8] (Fuchs, Kedem and Uselton, "Optimal surface
reconstruction from planar contours", Comm. ACM 20(10), 1977), which rests on two least paths never
crossing. With bending work they may: swapping tails where they cross changes the bends there.

Departure: what is exact is branch and bound on the start. Every closed path enters column 0 by an East
or a Southeast step, so the rows of column 0 with these two steps are all the starts there are. One pass
backwards with every row as start and as end gives a lower bound on the work from every state on. A set of
starts is then solved in one sweep, leaving out whatever cannot beat the best closed path known: if
the best path of the set ends in the state it began in, it is the set's least, else its work is a lower
bound and the set is cut in two. Sets are taken up in the order of their bounds, until the best closed
path is not above the next bound.

Cost: O(m n) time and memory for the tables and the first pass; a later sweep visits only the dots that could
still matter.
"""

from __future__ import annotations

import heapq
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.match import graph
from shapeblend_cli.match.work import EAST, SOUTH, SOUTHEAST

if TYPE_CHECKING:
    from shapeblend_cli.match.work import Tables
    from shapeblend_cli.model import FloatArray

Dots = list[tuple[int, int]]

STEPS = (EAST, SOUTH, SOUTHEAST)
ENTERING = (EAST, SOUTHEAST)
"""The steps that enter a column."""

ROUNDING = 1e-12
"""Sums of work taken in another order differ by less than this share of them."""

FIRST_SLACK = 0.02
SLACK_GROWTH = 8.0
"""How far above its lower bound a first closed path is looked for, as a share, and how that grows."""


class Path(NamedTuple):
    """A path proven least, in columns and rows from its start to its end, and the sweeps that took."""

    dots: Dots
    work: float
    sweeps: int


class Starts(NamedTuple):
    """A set of starting states in column 0, and a bound no closed path from one of them is below."""

    bound: float
    first_row: int
    last_row: int
    steps: tuple[int, ...]

    def halves(self) -> tuple[Starts, Starts]:
        """Cut the set in two, rows before steps. A single state cannot be cut, and its paths are closed."""
        if self.first_row < self.last_row:
            middle = (self.first_row + self.last_row) // 2
            return self._replace(last_row=middle), self._replace(first_row=middle + 1)
        return self._replace(steps=self.steps[:1]), self._replace(steps=self.steps[1:])


class Graph:
    """The graph of two polygons, with room for sweeping through it."""

    def __init__(self, tables: Tables, closed: bool) -> None:
        self.tables = tables
        self.closed = closed
        self.m, self.n = tables.southeast.shape
        self.columns = self.m + 1 if closed else self.m
        self.rows = 2 * self.n if closed else self.n
        self.sweeps = 0
        self._to_go: FloatArray = np.empty((0, 0, 0))
        self._left = np.empty((4, self.rows + 1))
        self._parents = np.empty((self.columns, self.rows + 1), np.uint8)
        self._ends = np.empty((self.rows + 1, 3))

    def bound_states(self) -> FloatArray:
        """Bound the work of every closed path by the row and step it starts with, (n, 3) float.

        Later sweeps are pruned by the pass that this takes.
        """
        self._to_go = np.empty((self.columns, self.rows, 3))
        graph.cost_to_go(*self.tables, self.n, self._to_go)
        self.sweeps += 1
        return self._to_go[0, : self.n]

    def sweep(self, starts: Starts, bound: float) -> tuple[float, Dots, bool] | None:
        """Find the least path from a set of starts to the ends that belong to them.

        Returns
        -------
        (work, dots, is_closed) or None
            `dots` in columns and rows; None when every path costs at least `bound`.
        """
        span = self.n if self.closed else self.n - 1
        low = np.full(self.columns, starts.first_row, np.intp)
        high = np.full(self.columns, starts.last_row + span, np.intp)
        source = np.full(3, np.inf)
        source[list(starts.steps)] = 0.0
        graph.sweep(
            *self.tables, low, high, starts.last_row, source, not self.closed,
            self._to_go, bound, self._left, self._parents, self._ends,
        )  # fmt: skip
        self.sweeps += 1
        # Ends lie as many rows below the starts as the second polygon has vertices.
        ends = self._ends[span : span + starts.last_row - starts.first_row + 1]
        allowed = np.full(3, np.inf)
        allowed[list(starts.steps if self.closed else STEPS)] = 0.0
        offered = ends + allowed
        place = int(offered.argmin())
        work = float(offered.flat[place])
        if not work < bound:
            return None
        row, step = starts.first_row + span + place // 3, place % 3
        dots, first_step = graph.backtrack(self._parents, low, row, step)
        is_closed = dots[0][1] + span == row and (first_step == step or not self.closed)
        return work, dots, is_closed


def least_open(tables: Tables) -> Path:
    """Least path between open polygons: their ends correspond."""
    search = Graph(tables, closed=False)
    found = search.sweep(Starts(0.0, 0, 0, STEPS), np.inf)
    assert found is not None, "an open graph always has a path"
    work, dots, _ = found
    return Path(dots, work, search.sweeps)


def least_from_zero(tables: Tables) -> Path:
    """Least path between closed polygons whose vertices 0 correspond."""
    search = Graph(tables, closed=True)
    found = _branch_and_bound(search, [Starts(0.0, 0, 0, STEPS)], np.inf)
    assert found is not None, "a closed graph always has a path"
    return found


def least_closed(tables: Tables) -> Path:
    """Least path between closed polygons over all starting correspondences."""
    search = Graph(tables, closed=True)
    bounds = search.bound_states()[:, list(ENTERING)].min(axis=1)
    row = int(bounds.argmin())
    lowest = float(bounds[row])

    # A first closed path from the most promising start, looked for close above its bound first: the closer,
    # the fewer dots a sweep visits.
    first, slack = None, FIRST_SLACK
    while first is None:
        limit = lowest + slack * max(lowest, 1.0) if slack < 1.0 else np.inf
        first = _branch_and_bound(search, [Starts(lowest, row, row, ENTERING)], limit)
        slack *= SLACK_GROWTH

    # Then runs of neighbouring rows that could still do better.
    rows = np.flatnonzero(bounds < first.work * (1.0 - ROUNDING))
    runs = np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1) if len(rows) else []
    sets = [Starts(float(bounds[run].min()), int(run[0]), int(run[-1]), ENTERING) for run in runs]
    better = _branch_and_bound(search, sets, first.work * (1.0 - ROUNDING))
    return (better or first)._replace(sweeps=search.sweeps)


def _branch_and_bound(search: Graph, sets: list[Starts], limit: float) -> Path | None:
    """Least closed path from any of the sets that costs less than `limit`, or None."""
    best = None
    queue = list(sets)
    heapq.heapify(queue)
    while queue and queue[0].bound < limit:
        starts = heapq.heappop(queue)
        found = search.sweep(starts, limit)
        if found is None:
            continue
        work, dots, is_closed = found
        if is_closed:
            best = Path(dots, work, search.sweeps)
            limit = work * (1.0 - ROUNDING)
        else:
            for half in starts.halves():
                heapq.heappush(queue, half._replace(bound=max(work, starts.bound)))
    return best
