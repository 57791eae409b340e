"""The graph of two wires, or a part of it, and the paths that a sweep finds there."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.matching import sweeps
from shapeblend_cli.matching.steps import ENTERING, STEPS
from shapeblend_cli.matching.tables import Progress, Tables, Terminals, Window

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.model import FloatArray, IntArray

ROUNDING = 1e-12
"""Maximum difference of sums of work taken in another order, as a share of them."""

STORED_DOTS = 12_000_000
"""Maximum number of dots whose tables are kept, about a gigabyte; larger tables are made in blocks for every sweep."""

BLOCK_DOTS = 1_000_000
"""Maximum number of dots of such a block."""

BOUND_DOTS = 100_000
"""Maximum number of dots whose tables are made for a lower bound alone."""

KEPT = 31 << 20
"""Maximum size of memory that the C library keeps for the next tables where it is glibc, in bytes: half of what it then
keeps. It gives the rest back to the system, and taking that again page by page costs as much as a search."""

np.empty(KEPT, np.uint8)  # glibc learns from the largest block that was freed, which is not touched

NOT_KEPT = np.empty(0, np.uint8)

NO_ENDS = np.empty(0)

PRICED = 0.5
"""Share of a usual search that is done when the tables are."""

FIRST_SWEPT = 0.6
"""Share of a usual search that is done after one pass."""


class Path(NamedTuple):
    """A path in columns and rows from its start to its end, the number of sweeps, and whether no other takes less."""

    dots: IntArray  # (k, 2)
    work: float
    sweeps: int
    is_least: bool = True


class Found(NamedTuple):
    """The least path of a sweep.

    Attributes
    ----------
    work : float
    dots : (k, 2) int
        Columns and rows.
    is_own : bool
        Whether it ends in the state it started from, and stays in the band around its own start.
    ends : (rows,) float
        The least work of paths to the end of each row of the set, wherever in it they start, where it is not its own.
    """

    work: float
    dots: IntArray
    is_own: bool
    ends: FloatArray


@cache
def _work_of(steps: tuple[int, ...]) -> FloatArray:
    """Return the work before some steps, and any other."""
    work = np.full(3, np.inf)
    work[list(steps)] = 0.0
    return work


class Starts(NamedTuple):
    """A set of states in column 0, the dots of some rows and steps, and a lower bound of closed paths from there."""

    bound: float
    first_row: int
    last_row: int
    steps: tuple[int, ...]

    @property
    def rows(self) -> int:
        """The number of rows."""
        return self.last_row - self.first_row + 1

    def terminals(self, below: int = 0) -> Terminals:
        """Return these states, or the same ones a number of rows below."""
        return Terminals(self.first_row + below, self.last_row + below, _work_of(self.steps))

    def without(self, start: int, end: int) -> tuple[Starts, Starts]:
        """Cut the set in two such that neither has both rows of a path that ends in another state than its start's.

        Where the rows are one, steps are cut. Where there is nothing to cut so, rows are halved, then steps: a single
        state's paths are closed.
        """
        bound, first, last, steps = self
        if start != end or (first < last and len(steps) == 1):
            middle = (start + end) // 2 if start != end else (first + last) // 2
            return Starts(bound, first, middle, steps), Starts(bound, middle + 1, last, steps)
        return Starts(bound, first, last, steps[:1]), Starts(bound, first, last, steps[1:])


class Graph:
    """The graph of two wires, or a region of it.

    Parameters
    ----------
    wires : Wires
    region : Window
        The columns, 0 to m when closed, 0 to m - 1 when open, and the rows where paths may run.
    band : float, optional
        Diagonal deviation, eq (30), that a path may have from its own start.
    watch : callable
        Called with the share of the search that is done, as far as it is known.
    """

    def __init__(
        self,
        wires: Wires,
        region: Window,
        band: float | None = None,
        watch: Callable[[float], None] = lambda share: None,
    ) -> None:
        self.wires = wires
        self.closed = wires.closed
        self.region = region
        self.band = band
        self.watch = watch
        self.columns = len(region.low)
        self.span = wires.n if self.closed else wires.n - 1
        self.sweeps = 0
        self._forbidden: Sequence[tuple[int, int]] = ()
        self._to_go: FloatArray = np.empty((0, 3))
        self._visited: IntArray = np.empty((self.columns, 2), np.intp)
        self._least: float | None = None
        self._progress: Progress | None = None
        self._arrays: sweeps.Arrays | None = None  # of that progress
        self._dots = region.dots
        self._tables: Tables | None = None
        if self.closed:
            self._is_whole = bool((region.high - region.low >= wires.n).any())
        else:
            self._is_whole = region.dots == wires.m * wires.n
        if (wires.m * wires.n if self._is_whole else self._dots) <= STORED_DOTS:
            self._tables = wires.tables(None if self._is_whole else region)
            self.watch(PRICED)

    @property
    def swept(self) -> int:
        """The number of dots in all sweeps so far, those left out too."""
        return self.sweeps * self._dots

    def forbid(self, dots: Sequence[tuple[int, int]]) -> None:
        """Forbid Southeast steps from these dots."""
        self._forbidden = dots
        if self._tables is not None:
            self._without_forbidden(self._tables)

    def _without_forbidden(self, tables: Tables) -> Tables:
        m, n, window = self.wires.m, self.wires.n, tables.window
        for i, j in self._forbidden:
            for column in range((i - tables.first_column) % m, len(window.low), m):
                row = (j - window.low[column]) % n
                if row <= window.high[column] - window.low[column]:
                    tables.southeast[window.column_offset[column] + row] = np.inf
        return tables

    def limits(self, starts: Starts) -> Window | None:
        """Return the part of the region where paths from a set of starts may run, or None."""
        low = np.maximum(self.region.low, starts.first_row)
        high = np.minimum(self.region.high, starts.last_row + self.span)
        if self.band is not None:
            diagonal = np.arange(self.columns) * (self.span / (self.columns - 1))
            reach = self.band * self.span + 1e-9
            low = np.maximum(low, np.ceil(starts.first_row + diagonal - reach).astype(np.intp))
            high = np.minimum(high, np.floor(starts.last_row + diagonal + reach).astype(np.intp))
        return Window.between(low, high) if (low <= high).all() else None

    def bound_starts(self) -> FloatArray | None:
        """Bound the work of closed paths from each row, from the first row of the region on.

        The bounds of the pass prune later sweeps. None where tables are not stored.
        """
        if self._tables is None:
            return None
        first, last = int(self.region.low[0]), int(self.region.high[0])
        self._bound_states(Starts(0.0, first, last, ENTERING))
        rows = min(last - first + 1, self.wires.n)
        bounds: FloatArray = np.minimum(*(self._to_go[:rows, step] for step in ENTERING))
        if rows == self.wires.n:
            self._least = float(bounds.min())
        return bounds

    def lower_bound(self) -> float:
        """Bound the work of all paths between the wires, in any region and band and through any dots.

        One pass backwards, with two columns in memory, unless `bound_starts` knows. 0 where that would take long.
        """
        if self._least is not None:
            return self._least
        m, n = self.wires.m, self.wires.n
        tables = self._tables
        if not self._is_whole or self._forbidden:
            tables = self.wires.tables() if m * n <= BOUND_DOTS else None
        if tables is None:
            return 0.0
        columns, rows, starts = m, n, Starts(0.0, 0, 0, STEPS)
        if self.closed:
            columns, rows, starts = m + 1, 2 * n, Starts(0.0, 0, n - 1, ENTERING)
        window = Window.full(columns, rows)._replace(column_offset=np.arange(columns) % 2 * rows)
        to_go = np.empty((2 * rows, 3))
        sweeps.cost_to_go(tables, window, starts.terminals(self.span), to_go, NOT_KEPT)
        return float(to_go[: starts.last_row + 1, list(starts.steps)].min())

    def _bound_states(self, starts: Starts) -> None:
        """Bound the work from every state to the ends of paths from these starts."""
        assert self._tables is not None
        self._to_go, self._arrays = np.empty((self._dots, 3)), None
        sweeps.cost_to_go(self._tables, self.region, starts.terminals(self.span), self._to_go, NOT_KEPT)
        self.sweeps += 1
        self.watch(FIRST_SWEPT)

    def rows_near(self, path: Path, slack: float, reach: float | None) -> IntArray:
        """Return the first and the last row of each column that paths of little more work can reach: (columns, 2).

        Parameters
        ----------
        path : Path
            The least path of this graph.
        slack : float
            The share of its work that others may take more.
        reach : float or None
            How far from its start others may start, as a share of the second polygon's vertices; None where there is
            one start, with any step.
        """
        row = int(path.dots[0, 1])
        away = int((reach or 0.0) * self.wires.n)
        first = max(row - away, int(self.region.low[0]))
        last = min(row + away, int(self.region.high[0]), first + self.wires.n - 1)
        near = Starts(0.0, first, last, STEPS if reach is None else ENTERING)
        self._bound_states(near)
        columns, rows = path.dots.T
        self._visited[:] = rows.max(), rows.min()
        self.sweep(near, path.work * (1.0 + slack) + ROUNDING)
        np.minimum.at(self._visited[:, 0], columns, rows)
        np.maximum.at(self._visited[:, 1], columns, rows)
        return self._visited.copy()

    def end_of(self, starts: Starts) -> int:
        """Return the row, `span` rows above its end, of the least path from starts to any end; their bound is its work.

        Where that is not found, or in a band, it is the first row of the starts.
        """
        if self.band is not None:
            return starts.first_row
        self.sweep(starts, starts.bound * (1.0 + ROUNDING))
        progress = self._progress
        if progress is None or progress.is_dead:
            return starts.first_row
        first, last = progress.live_rows
        low = int(self.region.low[-1])
        ends = progress.ends[first - low : last + 1 - low]
        return first + int(ends.argmin()) // ends.shape[1] - self.span

    def sweep(self, starts: Starts, limit: float = np.inf, simplified: bool = False) -> Found | None:
        """Find the least path from a set of starts to the ends that belong to them.

        Parameters
        ----------
        starts : Starts
        limit : float
            The path costs less.
        simplified : bool
            Use the simplified algorithm (section 4.1).
        """
        is_stored = self._tables is not None
        window = self.region if is_stored and self.band is None else self.limits(starts)
        if window is None:
            return None
        sources, rows = starts.terminals(), (starts.first_row, starts.last_row + self.span)
        if window is not self.region:
            progress = Progress(window, sources, self._visited, rows)
        elif self._progress is None:
            progress = self._progress = Progress(window, sources, self._visited, rows)
        else:
            progress = self._progress.again(sources, rows)
        for tables, last_column in self._blocks(window):
            arrays = self._arrays_of(tables, window, progress)
            sweeps.sweep(arrays, sources, limit, progress, last_column, simplified)
            if progress.is_dead:
                break
            if self.sweeps == 0:
                self.watch(FIRST_SWEPT * last_column / self.columns)
        self.sweeps += 1
        return None if progress.is_dead else self._least_end(starts, window, arrays, limit)

    def _arrays_of(self, tables: Tables, window: Window, progress: Progress) -> sweeps.Arrays:
        """Return the arrays of a sweep; those of sweeps through the whole region are the same ones."""
        arrays = self._arrays if progress is self._progress else None
        if arrays is None:
            arrays = sweeps.Arrays(tables, window, self.region, self._to_go, progress)
            if progress is self._progress:
                self._arrays = arrays
        return arrays

    def _least_end(self, starts: Starts, window: Window, arrays: sweeps.Arrays, limit: float) -> Found | None:
        """Return the least path to the ends that belong to the starts, `span` rows further down."""
        low = int(window.low[-1])
        first_end = starts.first_row + self.span - low
        least = np.empty(starts.rows)
        row, step = sweeps.least_end(arrays, first_end, starts.steps if self.closed else STEPS, least)
        if row < 0 or not least[row] < limit:
            return None
        work, row = float(least[row]), row + low + first_end
        dots, first_step = sweeps.backtrack(arrays, row, step, starts.first_row)
        own = int(dots[0, 1]) + self.span == row and (first_step == step or not self.closed)
        if own and self._in_band(dots):
            return Found(work, dots, True, NO_ENDS)
        return Found(work, dots, False, least)

    def _blocks(self, window: Window) -> Iterable[tuple[Tables, int]]:
        """Yield tables for runs of columns of a window, and the last column of each run."""
        if self._tables is not None:
            yield self._tables, self.columns - 1
            return
        for part in window.blocks(BLOCK_DOTS):
            low, high = window.low[part], window.high[part]
            period = Window.between(low, np.minimum(high, low + self.wires.n - 1))
            yield self._without_forbidden(self.wires.tables(period, part.start)), part.stop - 1

    def _in_band(self, dots: IntArray) -> bool:
        if self.band is None:
            return True
        gone = (dots - dots[0]) / (self.columns - 1, self.span)
        return bool(np.abs(gone[:, 0] - gone[:, 1]).max() <= self.band + 1e-9 / self.span)
