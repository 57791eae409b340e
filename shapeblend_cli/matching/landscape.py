"""What other paths through the graph would cost: the work of the least path through every dot.

For looking at, as in figures 25 and 29 of Sederberg and Greenwood 1992, and for asking what else a vertex could
correspond to. Paths begin at a given start, in a given state (see `graph`), and closed ones come back to it.

Cost: O(m n) time and memory, about 80 bytes a dot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.matching.steps import (
    BEND_OF_STEPS,
    EAST,
    MIRRORED_BENDS,
    MOVES,
    NO_BEND,
    SOUTH,
    SOUTHEAST,
    STEPS,
    paired_step,
)
from shapeblend_cli.matching.sweeps import cost_to_go
from shapeblend_cli.matching.tables import Tables, Terminals, Window
from shapeblend_cli.model import frozen

if TYPE_CHECKING:
    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.model import FloatArray, IntArray, UIntArray


class Landscape(NamedTuple):
    """The least paths through the dots of a graph.

    Column c is vertex ``(start_a + c) mod m`` of the first polygon, row r vertex ``(start_b + r) mod n`` of the
    second. The last column and the last row of closed polygons are the first ones again.

    Attributes
    ----------
    start : (int, int)
        The vertices of column 0 and row 0.
    works : (columns, rows) float
        Work of the least path through each dot; infinite where there is none.
    step : (columns, rows) uint8
        The step that leads to the dot on that path.
    before : (columns, rows) uint8
        For each step out of the dot, the step in that costs least, see `steps.paired_step`.
    after : (columns, rows) uint8
        For each step into the dot, the step out that costs least.
    """

    start: tuple[int, int]
    works: FloatArray
    step: UIntArray
    before: UIntArray
    after: UIntArray

    def path_through(self, column: int, row: int) -> IntArray:
        """Follow the least path through a dot.

        Returns
        -------
        (k, 2) int
            Columns and rows from the start to the end, both included.

        Raises
        ------
        ValueError
            No path goes through the dot.
        """
        if not np.isfinite(self.works[column, row]):
            raise ValueError(f"no path goes through dot {column},{row}")
        end = np.array(self.works.shape) - 1
        dot, step = np.array([column, row]), int(self.step[column, row])
        back = []
        while dot.any():
            back.append(dot)
            dot = dot - MOVES[step]
            step = paired_step(self.before[tuple(dot)], step)
        path = [dot, *reversed(back)]
        dot, step = np.array([column, row]), int(self.step[column, row])
        while (dot != end).any():
            step = paired_step(self.after[tuple(dot)], step)
            dot = dot + MOVES[step]
            path.append(dot)
        return np.array(path)


def landscape(wires: Wires, dots: IntArray, band: float | None = None) -> Landscape:
    """Find the least path through every dot.

    Parameters
    ----------
    wires : Wires
    dots : (k, 2) int
        A correspondence: paths begin at its first dot, and closed ones in the state in which it comes back there.
    band : float, optional
        Diagonal deviation, eq (30), that paths may have from the start.
    """
    tables = _unrolled(wires, dots[0], band)
    shape = len(tables.east), len(tables.south)
    # Closed paths end in the state in which they begin; at the ends of open wires there is no state yet.
    states = list(STEPS)
    if wires.closed:
        states = [MOVES.index(tuple(((dots[0] - dots[-1]) % (wires.m, wires.n)).tolist()))]
    ends = np.full(3, np.inf)
    ends[states] = 0.0
    to_go, after = _works(tables, ends)

    # The mirrored graph has the work from the start to every dot by the step out of it, the bend there included.
    bends = np.where(BEND_OF_STEPS == NO_BEND, np.inf, tables.bends[0, BEND_OF_STEPS])
    starts = bends[states].min(axis=0)
    gone, before = (values[::-1, ::-1] for values in _works(_mirrored(tables), starts))
    before[0, 0] = sum(
        (states[0] if BEND_OF_STEPS[states[0], step] != NO_BEND else step) << 2 * step for step in STEPS
    )
    through = np.full((*shape, 3), np.inf)
    through[0, 0] = ends
    through[1:, :, EAST] = gone[:-1, :, EAST] + tables.east[:-1, None]
    through[:, 1:, SOUTH] = gone[:, :-1, SOUTH] + (tables.weight[:, None] * tables.south)[:, :-1]
    through[1:, 1:, SOUTHEAST] = (gone[..., SOUTHEAST] + tables.southeast.reshape(shape))[:-1, :-1]
    through += to_go
    return Landscape(
        start=(int(dots[0, 0]), int(dots[0, 1])),
        works=frozen(through.min(axis=2), np.float64),
        step=frozen(through.argmin(axis=2), np.uint8),
        before=frozen(before, np.uint8),
        after=frozen(after, np.uint8),
    )


def _unrolled(wires: Wires, start: IntArray, band: float | None) -> Tables:
    """Tables of every dot from a start on, none of them repeated; bends outside the band are infinite."""
    m, n, again = wires.m, wires.n, int(wires.closed)
    columns, rows = m + again, n + again
    i, j = (start[0] + np.arange(columns)) % m, (start[1] + np.arange(rows)) % n
    tables = wires.tables()
    bends = tables.bends.reshape(m, n, 7)[np.ix_(i, j)]
    if band is not None:
        share = np.linspace(0.0, 1.0, columns)[:, None] - np.linspace(0.0, 1.0, rows)
        bends[np.abs(share) > band + 1e-9 / n] = np.inf
    return Tables(
        window=Window.full(columns, rows),
        first_column=0,
        weight=tables.weight[i],
        east=tables.east[i],
        south=tables.south[j],
        southeast=tables.southeast.reshape(m, n)[np.ix_(i, j)].ravel(),
        bends=bends.reshape(-1, 7),
    )


def _mirrored(tables: Tables) -> Tables:
    """The tables for paths that are followed backwards."""
    shape = len(tables.east), len(tables.south)
    southeast = np.roll(tables.southeast[::-1].reshape(shape), (-1, -1), (0, 1))
    return tables._replace(
        weight=tables.weight[::-1].copy(),
        east=np.roll(tables.east[::-1], -1),  # the step that leads to a column is the one that leaves it
        south=np.roll(tables.south[::-1], -1),
        southeast=southeast.ravel(),
        bends=tables.bends[::-1, MIRRORED_BENDS].copy(),
    )


def _works(tables: Tables, ends: FloatArray) -> tuple[FloatArray, UIntArray]:
    """Work from every state to the last dot, where it is given by the step in; and the steps out."""
    shape = len(tables.east), len(tables.south)
    to_go, following = np.empty((tables.window.dots, 3)), np.empty(tables.window.dots, np.uint8)
    last_row = shape[1] - 1
    cost_to_go(tables, tables.window, Terminals(last_row, last_row, ends), to_go, following)
    return to_go.reshape(*shape, 3), following.reshape(shape)
