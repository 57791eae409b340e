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
still matter. Where the tables would not fit into memory they are made block by block in every sweep, and
the first pass is left out.
"""

from __future__ import annotations

import heapq
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.match import graph
from shapeblend_cli.match.work import EAST, SOUTH, SOUTHEAST, Window

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from shapeblend_cli.match.work import Tables, Wires
    from shapeblend_cli.model import FloatArray, IntArray

Dots = list[tuple[int, int]]

STEPS = (EAST, SOUTH, SOUTHEAST)
ENTERING = (EAST, SOUTHEAST)
"""The steps that enter a column."""

ROUNDING = 1e-12
"""Sums of work taken in another order differ by less than this share of them."""

SLACKS = (0.02, 0.2)
"""How far above its lower bound a first closed path is looked for, as a share, before it is looked for anywhere."""

STORED_DOTS = 12_000_000
"""Tables of more dots than these, about a gigabyte, are made block by block."""

BLOCK_DOTS = 1_000_000

PRICED, FIRST_SWEPT = 0.5, 0.6
"""Shares of a usual search that are done when the tables are, and when the first pass is."""


class Path(NamedTuple):
    """A path in columns and rows from its start to its end, and the sweeps it took to find."""

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


class Search:
    """Sweeps through the graph of two wires, or through a part of it.

    Parameters
    ----------
    wires : Wires
    region : Window
        The columns, 0 to m when closed, 0 to m - 1 when open, and the rows that paths may go through.
    band : float, optional
        Diagonal deviation, eq (30), that a path may have from its own start.
    forbidden : iterable of (int, int)
        Dots that no Southeast step may leave.
    watch : callable
        Told which share of the search is done, as far as that can be known.
    """

    def __init__(
        self,
        wires: Wires,
        region: Window,
        band: float | None = None,
        forbidden: Iterable[tuple[int, int]] = (),
        watch: Callable[[float], None] = lambda share: None,
    ) -> None:
        self.wires = wires
        self.closed = wires.closed
        self.region = region
        self.band = band
        self.forbidden = list(forbidden)
        self.watch = watch
        self.columns = len(region.low)
        self.span = wires.n if self.closed else wires.n - 1
        self.sweeps = 0
        self.proves = True  # until it turns out to be a corridor only
        self._to_go: FloatArray = np.empty((0, 3))
        self._visited: IntArray = np.empty((self.columns, 2), np.intp)
        self._tables: Tables | None = None
        whole = bool((region.high - region.low >= wires.n).any())
        if (wires.m * wires.n if whole else region.dots) <= STORED_DOTS:
            self._tables = self._priced(None if whole else region, 0)
            self.watch(PRICED)

    def _priced(self, window: Window | None, first_column: int) -> Tables:
        tables = self.wires.tables(window, first_column)
        m, n = self.wires.m, self.wires.n
        heights = np.diff(np.append(tables.place, len(tables.southeast)))
        for i, j in self.forbidden:
            for column in range((i - first_column) % m, len(tables.place), m):
                row = (j - tables.origin[column]) % n
                if row < heights[column]:
                    tables.southeast[tables.place[column] + row] = np.inf
        return tables

    def limits(self, starts: Starts) -> Window | None:
        """The part of the region that paths from a set of starts may go through; None when that is nothing."""
        low = np.maximum(self.region.low, starts.first_row)
        high = np.minimum(self.region.high, starts.last_row + self.span)
        if self.band is not None:
            diagonal = np.arange(self.columns) * (self.span / (self.columns - 1))
            reach = self.band * self.span + 1e-9
            low = np.maximum(low, np.ceil(starts.first_row + diagonal - reach).astype(np.intp))
            high = np.minimum(high, np.floor(starts.last_row + diagonal + reach).astype(np.intp))
        return Window.between(low, high) if (low <= high).all() else None

    def bound_starts(self) -> FloatArray | None:
        """Bound the work of every closed path by the row it starts in, from the first row of the region on.

        Later sweeps are pruned by the pass that this takes. None where tables are not stored.
        """
        if self._tables is None:
            return None
        first = int(self.region.low[0])
        self._bound_states(first, int(self.region.high[0]), south_at_end=False)
        rows = min(int(self.region.high[0]) - first + 1, self.wires.n)
        bounds: FloatArray = self._to_go[:rows, list(ENTERING)].min(axis=1)
        return bounds

    def _bound_states(self, first_row: int, last_row: int, south_at_end: bool) -> None:
        """Bound the work from every state to the ends of paths that start in these rows, for later sweeps."""
        assert self._tables is not None
        self._to_go = np.empty((self.region.dots, 3))
        graph.cost_to_go(
            *self._tables, self.region.low, self.region.high, first_row + self.span, last_row + self.span,
            south_at_end, self.region.place, self._to_go,
        )  # fmt: skip
        self.sweeps += 1
        self.watch(FIRST_SWEPT)

    def rows_near(self, path: Path, slack: float, reach: float | None) -> IntArray:
        """The rows of each column that a path of hardly more work than the given one can come by.

        Parameters
        ----------
        path : Path
            The least path of this search.
        slack : float
            How much more work, as a share.
        reach : float or None
            How far from where this path starts they may start, as a share of the second polygon's vertices; None
            where there is one start, reached by any step.

        Returns
        -------
        (columns, 2) int
            The first and the last row.
        """
        row = path.dots[0][1]
        away = int((reach or 0.0) * self.wires.n)
        first = max(row - away, int(self.region.low[0]))
        last = min(row + away, int(self.region.high[0]), first + self.wires.n - 1)
        self._bound_states(first, last, south_at_end=reach is None)
        columns, rows = np.array(path.dots).T
        self._visited[:] = rows.max(), rows.min()
        near = Starts(0.0, first, last, STEPS if reach is None else ENTERING)
        self.sweep(near, path.work * (1.0 + slack) + ROUNDING)
        np.minimum.at(self._visited[:, 0], columns, rows)
        np.maximum.at(self._visited[:, 1], columns, rows)
        return self._visited.copy()

    def sweep(self, starts: Starts, bound: float) -> tuple[float, Dots, bool] | None:
        """Find the least path from a set of starts to the ends that belong to them.

        Returns
        -------
        (work, dots, is_own) or None
            `dots` in columns and rows. `is_own`: the path ends in the state it started from and stays in
            the band around its own start. None when every path costs at least `bound`.
        """
        window = self.limits(starts)
        if window is None:
            return None
        source = np.full(3, np.inf)
        source[list(starts.steps)] = 0.0
        live = np.array([starts.first_row, starts.last_row, 0], np.intp)
        left = np.empty((4, int(window.high[-1] - window.low[0]) + 1))
        parents = np.empty(window.dots, np.uint8)
        ends = np.empty((int(window.high[-1] - window.low[-1]) + 1, 3))
        for tables, first, last in self._blocks(window):
            graph.sweep(
                *tables, first, last, window.low, window.high, starts.last_row, source, not self.closed,
                self.region.low, self.region.place, self._to_go, bound, live, left, window.place, parents,
                self._visited, ends,
            )  # fmt: skip
            if live[1] < live[0]:
                break
            if self.sweeps == 0:
                self.watch(FIRST_SWEPT * last / self.columns)
        self.sweeps += 1
        if live[1] < live[0]:
            return None

        # The ends that belong to the starts lie `span` rows further down.
        first_end = max(starts.first_row + self.span - int(window.low[-1]), 0)
        offered = ends[first_end:].copy()
        if not len(offered):
            return None
        if self.closed:
            offered[:, [step for step in STEPS if step not in starts.steps]] = np.inf
        place = int(offered.argmin())
        work = float(offered.flat[place])
        if not work < bound:
            return None
        row, step = int(window.low[-1]) + first_end + place // 3, place % 3
        dots, first_step = graph.backtrack(parents, window.place, window.low, row, step)
        own = dots[0][1] + self.span == row and (first_step == step or not self.closed)
        return work, dots, own and self._in_band(dots)

    def sweep_simplified(self, row: int, step: int) -> tuple[float, Dots] | None:
        """Follow the simplified algorithm from one state; None where it finds no way back to it."""
        window = self.limits(Starts(0.0, row, row, (step,)))
        if window is None or self._tables is None or window.high[-1] != row + self.span:
            return None
        left = np.empty((4, int(window.high[-1] - window.low[0]) + 1))
        parents = np.empty(window.dots, np.uint8)
        ends = np.empty(3)
        graph.sweep_simplified(
            *self._tables, window.low, window.high, step, not self.closed, left, window.place, parents, ends
        )
        self.sweeps += 1
        last = step if self.closed else int(ends.argmin())
        if not np.isfinite(ends[last]):
            return None
        dots, _ = graph.backtrack(parents, window.place, window.low, row + self.span, last)
        return float(ends[last]), dots

    def _blocks(self, window: Window) -> Iterable[tuple[Tables, int, int]]:
        """The tables for a window, all at once or in blocks of columns."""
        if self._tables is not None:
            yield self._tables, 0, self.columns - 1
            return
        for part in window.blocks(BLOCK_DOTS):
            low, high = window.low[part], window.high[part]
            period = Window.between(low, np.minimum(high, low + self.wires.n - 1))
            yield self._priced(period, part.start), part.start, part.stop - 1

    def _in_band(self, dots: Dots) -> bool:
        if self.band is None:
            return True
        path: IntArray = np.array(dots)
        gone = (path - path[0]) / (self.columns - 1, self.span)
        return bool(np.abs(gone[:, 0] - gone[:, 1]).max() <= self.band + 1e-9 / self.span)


def least_from(search: Search) -> Path | None:
    """Least path from the first dot of the region: back to it when closed, to the other ends when open."""
    row = int(search.region.low[0])
    if search.closed:
        return _branch_and_bound(search, [Starts(0.0, row, row, STEPS)], np.inf)
    found = search.sweep(Starts(0.0, row, row, STEPS), np.inf)
    return Path(found[1], found[0], search.sweeps) if found else None


def least_of_all(search: Search) -> Path | None:
    """Least closed path over all starts in the region's column 0."""
    first = int(search.region.low[0])
    bounds = search.bound_starts()
    if bounds is None:
        last = min(int(search.region.high[0]), first + search.wires.n - 1)
        return _branch_and_bound(search, [Starts(0.0, first, last, ENTERING)], np.inf)

    # A first closed path from the most promising start, looked for close above its bound first: the closer, the
    # fewer dots a sweep visits.
    row = int(bounds.argmin())
    lowest = float(bounds[row])
    if not np.isfinite(lowest):
        return None
    limits = [lowest + slack * max(lowest, 1.0) for slack in SLACKS] + [np.inf]
    best = None
    for limit in limits:
        best = best or _branch_and_bound(search, [Starts(lowest, first + row, first + row, ENTERING)], limit)

    # Then runs of neighbouring rows that could still do better.
    limit = best.work * (1.0 - ROUNDING) if best else np.inf
    rows = np.flatnonzero(bounds < limit)
    runs = np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1) if len(rows) else []
    sets = [Starts(float(bounds[r].min()), first + int(r[0]), first + int(r[-1]), ENTERING) for r in runs]
    best = _branch_and_bound(search, sets, limit) or best
    return best._replace(sweeps=search.sweeps) if best else None


def least_by_start(
    wires: Wires, vertex: int, band: float | None, watch: Callable[[float], None]
) -> FloatArray:
    """Least work of a closed path through a vertex of the first polygon and every vertex of the second.

    Cost: O(m n) for each of n starts.

    Parameters
    ----------
    wires : Wires
    vertex : int
        Of the first polygon.
    band : float or None
        Diagonal deviation, eq (30), that paths may have from there.
    watch : callable
        Told which share is done.

    Returns
    -------
    (n,) float
        Infinite where no path stays in the band.
    """
    columns, n = wires.m + 1, wires.n
    search = Search(wires.beginning_at(vertex), Window.full(columns, 2 * n), band)
    works = np.full(n, np.inf)
    for row in range(n):
        path = _branch_and_bound(search, [Starts(0.0, row, row, STEPS)], np.inf)
        works[row] = path.work if path else np.inf
        watch((row + 1) / n)
    return works


def simplified_from(search: Search) -> Path | None:
    """The simplified algorithm's best path from the first dot of the region."""
    row = int(search.region.low[0])
    found = [search.sweep_simplified(row, step) for step in (STEPS if search.closed else (SOUTHEAST,))]
    paths = [Path(dots, work, search.sweeps) for work, dots in filter(None, found)]
    return min(paths, key=lambda path: path.work, default=None)


def simplified_of_all(search: Search) -> Path | None:
    """The simplified algorithm's best path over all starts.

    Starts whose least work is above the best path so far need not be tried: the algorithm cannot do better.
    """
    first = int(search.region.low[0])
    bounds = search.bound_starts()
    assert bounds is not None, "the simplified algorithm works on stored tables"
    best = None
    for row in np.argsort(bounds, kind="stable").tolist():
        if best is not None and bounds[row] >= best.work:
            break
        for step in ENTERING:
            found = search.sweep_simplified(first + row, step)
            if found is not None and (best is None or found[0] < best.work):
                best = Path(found[1], found[0], search.sweeps)
    return best._replace(sweeps=search.sweeps) if best else None


def _branch_and_bound(search: Search, sets: list[Starts], limit: float) -> Path | None:
    """Least path of its own from any of the sets that costs less than `limit`, or None."""
    best = None
    queue = list(sets)
    heapq.heapify(queue)
    while queue and queue[0].bound < limit:
        waiting = sum(starts.last_row - starts.first_row + 1 for starts in queue if starts.bound < limit)
        search.watch(1.0 - (1.0 - FIRST_SWEPT) * min(waiting / search.wires.n, 1.0))
        starts = heapq.heappop(queue)
        found = search.sweep(starts, limit)
        if found is None:
            continue
        work, dots, is_own = found
        if is_own:
            best = Path(dots, work, search.sweeps)
            limit = work * (1.0 - ROUNDING)
        else:
            for half in starts.halves():
                heapq.heappush(queue, half._replace(bound=max(work, starts.bound)))
    return best
