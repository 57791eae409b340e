"""Arguments of sweeps through a graph: windows, the work of steps and bends, ends of paths, and bounds.

`columns`, `rows` and `dots` in the shapes of arrays are those of a window.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapeblend_cli.model import FloatArray, IntArray


class Window(NamedTuple):
    """A part of a graph: the first and the last row of each column, and where the column begins in flat arrays.

    Neither of the rows ever falls.
    """

    low: IntArray
    high: IntArray
    column_offset: IntArray

    @classmethod
    def between(cls, low: IntArray, high: IntArray) -> Window:
        """Lay out the columns one after the other."""
        heights = high - low + 1
        return cls(np.ascontiguousarray(low), np.ascontiguousarray(high), heights.cumsum() - heights)

    @classmethod
    def full(cls, columns: int, rows: int) -> Window:
        """Every row of every column."""
        return cls.between(np.zeros(columns, np.intp), np.full(columns, rows - 1, np.intp))

    @property
    def dots(self) -> int:
        """Number of dots in all columns."""
        return int(self.column_offset[-1] + self.high[-1] - self.low[-1]) + 1

    def blocks(self, dots: int) -> Iterator[slice]:
        """Yield runs of columns with about this number of dots."""
        ends = np.append(self.column_offset[1:], self.dots)
        first = 0
        while first < len(ends):
            last = max(int(np.searchsorted(ends, self.column_offset[first] + dots, "right")), first + 1)
            yield slice(first, last)
            first = last


class Tables(NamedTuple):
    """The work of every step and every bend in a window.

    A sweep reads them modulo the window's columns, and modulo n rows, so no row of a column may be there twice.

    Attributes
    ----------
    window : Window
    first_column : int
        The column of the graph that column 0 of the window is.
    weight : (columns,) float
        Stiffness of the first wire.
    east : (columns,) float
        Stretching work of the East step that leaves each column.
    south : (n,) float
        Stretching work of the South step that leaves row j, where the first wire's stiffness is 1.
    southeast : (dots,) float
        Stretching work of the Southeast step that leaves each dot.
    bends : (dots, 7) float
        Bending work at each dot, see `steps`; 0 at the ends of open wires.
    """

    window: Window
    first_column: int
    weight: FloatArray
    east: FloatArray
    south: FloatArray
    southeast: FloatArray
    bends: FloatArray


class Terminals(NamedTuple):
    """The dots of a column where paths may begin or end, and the work there by the step into the dot: (3,)."""

    first_row: int
    last_row: int
    work: FloatArray


class Progress:
    """The progress of a sweep through a window, and its findings.

    Attributes
    ----------
    column : int
        The next column.
    live_rows : (int, int)
        First and last row of the previous column that paths can leave.
    leaving : (4, rows + 2) float
        Work of leaving each dot by East, and by Southeast, with a row more above and below; those of the previous
        column begin at `current`.
    parents : (dots,) uint8
        For each step out of a dot, the step in that costs least: two bits each, East lowest.
    visited : (columns, 2) int
        First and last row of each column that paths can reach.
    ends : (rows, 3) float
        Work at the dots of the last column, by the step in.
    rows : (int, int)
        First and last row of all columns where paths may run.
    """

    __slots__ = ("column", "current", "ends", "leaving", "live_rows", "parents", "rows", "visited")

    def again(self, starts: Terminals, rows: tuple[int, int]) -> Progress:
        """Begin anew in the same window, with other starts: findings so far are overwritten."""
        self.column = self.current = 0
        self.live_rows, self.rows = starts[:2], rows
        self.ends.fill(np.inf)
        return self

    def __init__(
        self, window: Window, starts: Terminals, visited: IntArray, rows: tuple[int, int] | None = None
    ) -> None:
        self.column = self.current = 0
        self.live_rows = starts.first_row, starts.last_row
        self.rows = rows or (int(window.low[0]), int(window.high[-1]))
        self.leaving = np.empty((4, int(window.high[-1] - window.low[0]) + 3))
        self.parents = np.empty(window.dots, np.uint8)
        self.visited = visited
        self.ends = np.full((int(window.high[-1] - window.low[-1]) + 1, 3), np.inf)

    @property
    def is_dead(self) -> bool:
        """Whether no path costs less than the limit."""
        return self.live_rows[1] < self.live_rows[0]
