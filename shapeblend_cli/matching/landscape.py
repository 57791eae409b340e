"""The work of the least path through every dot of a graph, to be drawn as in figures 25 and 29 of the paper.

Paths begin at a given start, in a given state (see `sweeps`), and closed ones return to it.

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
        For each step out of the dot, the step in that costs least, as in `Progress.parents`.
    after : (columns, rows) uint8
        For each step into the dot, the step out that costs least.
    """

    start: tuple[int, int]
    works: FloatArray
    step: UIntArray
    before: UIntArray
    after: UIntArray


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
    # Closed paths end in the state in which they begin; at the ends of open wires there is no state yet.
    states = list(STEPS)
    if wires.closed:
        states = [MOVES.index(tuple(((dots[0] - dots[-1]) % (wires.m, wires.n)).tolist()))]
    ends = np.full(3, np.inf)
    ends[states] = 0.0
    to_go, after = _works(tables, ends)

    # The mirrored graph has the work from the start to every dot by the step out of it, the bend there included.
    has_bend = BEND_OF_STEPS != NO_BEND
    starts = np.where(has_bend, tables.bends[0, BEND_OF_STEPS], np.inf)[states].min(axis=0)
    so_far, before = (values[::-1, ::-1] for values in _works(_mirrored(tables), starts))
    before[0, 0] = sum(np.where(has_bend[states[0]], states[0], STEPS) << np.array((0, 2, 4)))
    through = np.full_like(to_go, np.inf)
    through[0, 0] = ends
    through[1:, :, EAST] = so_far[:-1, :, EAST] + tables.east[:-1, None]
    through[:, 1:, SOUTH] = so_far[:, :-1, SOUTH] + (tables.weight[:, None] * tables.south)[:, :-1]
    southeast = tables.southeast.reshape(through.shape[:2])
    through[1:, 1:, SOUTHEAST] = (so_far[..., SOUTHEAST] + southeast)[:-1, :-1]
    through += to_go
    return Landscape(
        start=(int(dots[0, 0]), int(dots[0, 1])),
        works=frozen(through.min(axis=2), np.float64),
        step=frozen(through.argmin(axis=2), np.uint8),
        before=frozen(before, np.uint8),
        after=frozen(after, np.uint8),
    )


def _unrolled(wires: Wires, start: IntArray, band: float | None) -> Tables:
    """Return tables of every dot from a start on, without repetition; bends outside the band are infinite."""
    columns, rows = wires.m + wires.closed, wires.n + wires.closed
    tables = wires.beginning_at(int(start[0]), int(start[1])).tables(Window.full(columns, rows))
    if band is not None:
        share = np.linspace(0.0, 1.0, columns)[:, None] - np.linspace(0.0, 1.0, rows)
        tables.bends[(np.abs(share) > band + 1e-9 / wires.n).ravel()] = np.inf
    return tables._replace(south=np.resize(tables.south, rows))


def _mirrored(tables: Tables) -> Tables:
    """Return the tables for paths that are followed backwards."""
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
    """Find the work from every state to the last dot, where it is given by the step in; and the steps out."""
    shape = len(tables.east), len(tables.south)
    to_go, following = np.empty((tables.window.dots, 3)), np.empty(tables.window.dots, np.uint8)
    last_row = shape[1] - 1
    cost_to_go(tables, tables.window, Terminals(last_row, last_row, ends), to_go, following)
    return to_go.reshape(*shape, 3), following.reshape(shape)
