"""The graph of two wires, searched by sweeps through it.

Tables that would not fit into memory are made block by block in every sweep.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.matching import sweeps
from shapeblend_cli.matching.steps import ENTERING, STEPS
from shapeblend_cli.matching.tables import Bounds, Progress, Terminals, Window

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from shapeblend_cli.matching.tables import Tables
    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.model import FloatArray, IntArray

Dots = list[tuple[int, int]]

ROUNDING = 1e-12
"""Sums of work taken in another order differ by less than this share of them."""

STORED_DOTS = 12_000_000
"""Tables of more dots than these, about a gigabyte, are made block by block."""

BLOCK_DOTS = 1_000_000

BOUND_DOTS = 250_000
"""Up to so many dots tables of the whole graph are made for a lower bound alone."""

NO_STEPS = np.empty(0, np.uint8)

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

    def terminals(self, further: int = 0) -> Terminals:
        """The dots of these starts, or those so many rows further down."""
        work = np.full(3, np.inf)
        work[list(self.steps)] = 0.0
        return Terminals(self.first_row + further, self.last_row + further, work)

    def halves(self) -> tuple[Starts, Starts]:
        """Cut the set in two, rows before steps. A single state cannot be cut, and its paths are closed."""
        if self.first_row < self.last_row:
            middle = (self.first_row + self.last_row) // 2
            return self._replace(last_row=middle), self._replace(first_row=middle + 1)
        return self._replace(steps=self.steps[:1]), self._replace(steps=self.steps[1:])


class Graph:
    """The graph of two wires, or a part of it, to be searched by sweeps.

    Parameters
    ----------
    wires : Wires
    region : Window
        The columns, 0 to m when closed, 0 to m - 1 when open, and the rows that paths may go through.
    band : float, optional
        Diagonal deviation, eq (30), that a path may have from its own start.
    watch : callable
        Told which share of the search is done, as far as that can be known.
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
        self._tables: Tables | None = None
        if self.closed:
            self._is_whole = bool((region.high - region.low >= wires.n).any())
        else:
            self._is_whole = region.dots == wires.m * wires.n
        if (wires.m * wires.n if self._is_whole else region.dots) <= STORED_DOTS:
            self._tables = wires.tables(None if self._is_whole else region)
            self.watch(PRICED)

    def forbid(self, dots: Sequence[tuple[int, int]]) -> None:
        """Let no Southeast step leave these dots."""
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
        first, last = int(self.region.low[0]), int(self.region.high[0])
        self._bound_states(Starts(0.0, first, last, ENTERING))
        rows = min(last - first + 1, self.wires.n)
        bounds: FloatArray = self._to_go[:rows, list(ENTERING)].min(axis=1)
        if rows == self.wires.n:
            self._least = float(bounds.min())
        return bounds

    def lower_bound(self) -> float:
        """Bound the work of every path between the wires, wherever it begins, whatever the region and the band.

        The least of `bound_starts`, or else that of a pass of its own, which keeps two columns in memory. 0 where
        tables of the whole graph are not stored and would take long.
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
        sweeps.cost_to_go(tables, window, starts.terminals(self.span), to_go, NO_STEPS)
        return float(to_go[: starts.last_row + 1, list(starts.steps)].min())

    def _bound_states(self, starts: Starts) -> None:
        """Bound the work from every state to the ends of paths from these starts, for later sweeps."""
        assert self._tables is not None
        self._to_go = np.empty((self.region.dots, 3))
        sweeps.cost_to_go(self._tables, self.region, starts.terminals(self.span), self._to_go, NO_STEPS)
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
        near = Starts(0.0, first, last, STEPS if reach is None else ENTERING)
        self._bound_states(near)
        columns, rows = np.array(path.dots).T
        self._visited[:] = rows.max(), rows.min()
        self.sweep(near, path.work * (1.0 + slack) + ROUNDING)
        np.minimum.at(self._visited[:, 0], columns, rows)
        np.maximum.at(self._visited[:, 1], columns, rows)
        return self._visited.copy()

    def sweep(
        self, starts: Starts, limit: float = np.inf, simplified: bool = False
    ) -> tuple[float, Dots, bool] | None:
        """Find the least path from a set of starts to the ends that belong to them.

        Parameters
        ----------
        starts : Starts
        limit : float
            What it must cost less than.
        simplified : bool
            Use the simplified algorithm (section 4.1), from one start.

        Returns
        -------
        (work, dots, is_own) or None
            `dots` in columns and rows. `is_own`: the path ends in the state it started from and stays in
            the band around its own start. None when there is no path.
        """
        window = self.limits(starts)
        if window is None:
            return None
        sources = starts.terminals()
        progress = Progress(window, sources, self._visited)
        bounds = Bounds(self.region, self._to_go[:0] if simplified else self._to_go, limit)
        for tables, last_column in self._blocks(window):
            sweeps.sweep(tables, window, sources, bounds, progress, last_column, simplified)
            if progress.is_dead:
                break
            if self.sweeps == 0:
                self.watch(FIRST_SWEPT * last_column / self.columns)
        self.sweeps += 1
        if progress.is_dead:
            return None

        # The ends that belong to the starts lie `span` rows further down.
        first_end = max(starts.first_row + self.span - int(window.low[-1]), 0)
        offered = progress.ends[first_end:].copy()
        if not len(offered):
            return None
        if self.closed:
            offered[:, [step for step in STEPS if step not in starts.steps]] = np.inf
        at = int(offered.argmin())
        work = float(offered.flat[at])
        if not work < limit:
            return None
        row, step = int(window.low[-1]) + first_end + at // 3, at % 3
        dots, first_step = sweeps.backtrack(progress.parents, window, row, step)
        own = dots[0][1] + self.span == row and (first_step == step or not self.closed)
        return work, dots, own and self._in_band(dots)

    def _blocks(self, window: Window) -> Iterable[tuple[Tables, int]]:
        """The tables for a window and the last column they have, all at once or in blocks of columns."""
        if self._tables is not None:
            yield self._tables, self.columns - 1
            return
        for part in window.blocks(BLOCK_DOTS):
            low, high = window.low[part], window.high[part]
            period = Window.between(low, np.minimum(high, low + self.wires.n - 1))
            yield self._without_forbidden(self.wires.tables(period, part.start)), part.stop - 1

    def _in_band(self, dots: Dots) -> bool:
        if self.band is None:
            return True
        path: IntArray = np.array(dots)
        gone = (path - path[0]) / (self.columns - 1, self.span)
        return bool(np.abs(gone[:, 0] - gone[:, 1]).max() <= self.band + 1e-9 / self.span)
