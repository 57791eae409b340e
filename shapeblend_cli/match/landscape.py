"""What other paths through the graph would cost: the work of the least path through every dot.

For looking at, as in figures 25 and 29 of Sederberg and Greenwood 1992, and for asking what else a vertex could
correspond to. Paths begin at a given start, in a given state (see `graph`), and closed ones come back to it.

Cost: O(m n) time and memory, about 80 bytes a dot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.match.work import BEND_OF_STEPS, EAST, SOUTH, SOUTHEAST, Wires
from shapeblend_cli.model import frozen

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapeblend_cli.model import FloatArray, IntArray, UIntArray

MOVES = {EAST: (1, 0), SOUTH: (0, 1), SOUTHEAST: (1, 1)}
"""Columns and rows of each step."""

BEFORE_AND_AFTER = {EAST: (EAST, SOUTHEAST), SOUTH: (SOUTH, SOUTHEAST), SOUTHEAST: (EAST, SOUTH, SOUTHEAST)}
"""Steps that may come before a step, or after it: no turns of 90 degrees."""

BITS = {EAST: 0, SOUTH: 2, SOUTHEAST: 4}
"""Where a byte of `Landscape.before` and `Landscape.after` has the step that belongs to each step, two bits each."""


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
        The step that leads to the dot on that path: 0 East, 1 South, 2 Southeast.
    before : (columns, rows) uint8
        For each step out of the dot, the best step in: bits 0 and 1 for East, 2 and 3 for South, 4 and 5 for Southeast.
    after : (columns, rows) uint8
        For each step into the dot, the best step out, in the same bits.
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
            step = _decoded(self.before[tuple(dot)], step)
        path = [dot, *reversed(back)]
        dot, step = np.array([column, row]), int(self.step[column, row])
        while (dot != end).any():
            step = _decoded(self.after[tuple(dot)], step)
            dot = dot + MOVES[step]
            path.append(dot)
        return np.array(path)


def _decoded(byte: int, step: int) -> int:
    return int(byte) >> BITS[step] & 3


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
    graph = _Graph(wires, dots, band)
    reach, before = _work_to(graph)
    to_go, after = _work_from(graph)
    shape = (graph.columns, graph.rows)
    through = np.stack([(reach[s] + to_go[s]).reshape(graph.padded)[: shape[0], : shape[1]] for s in MOVES])
    through[:, graph.outside] = np.inf
    return Landscape(
        start=(int(dots[0, 0]), int(dots[0, 1])),
        works=frozen(through.min(axis=0), np.float64),
        step=frozen(through.argmin(axis=0), np.uint8),
        before=frozen(before.reshape(graph.padded)[: shape[0], : shape[1]], np.uint8),
        after=frozen(after.reshape(graph.padded)[: shape[0], : shape[1]], np.uint8),
    )


class _Graph:
    """Every step and every bend from a start on, in flat arrays with a column and a row of nothing beyond the end.

    A bend is 0 at the ends of open wires. Steps and bends outside the band are infinite.
    """

    def __init__(self, wires: Wires, dots: IntArray, band: float | None) -> None:
        m, n, closed = wires.m, wires.n, wires.closed
        self.columns, self.rows = (m + 1, n + 1) if closed else (m, n)
        self.padded = (self.columns + 1, self.rows + 1)
        at = (dots[0, 0] + np.arange(self.columns)) % m, (dots[0, 1] + np.arange(self.rows)) % n
        tables = wires.tables()
        bends = tables.bends.reshape(m, n, 7)[np.ix_(*at)]
        if not closed:
            bends[0, 0] = bends[-1, -1] = 0.0
        share = np.linspace(0.0, 1.0, self.columns)[:, None] - np.linspace(0.0, 1.0, self.rows)
        self.outside = np.zeros(share.shape, np.bool_) if band is None else np.abs(share) > band + 1e-9 / n
        bends[self.outside] = np.inf
        ones = np.ones((self.columns, self.rows))
        stretching = {
            EAST: tables.east[at[0]][:, None] * ones,
            SOUTH: tables.weight[at[0]][:, None] * tables.south[at[1]],
            SOUTHEAST: tables.southeast.reshape(m, n)[np.ix_(*at)],
        }
        self.bends = {
            (step_in, step_out): self._flat(bends[:, :, BEND_OF_STEPS[step_in, step_out]])
            for step_in, outs in BEFORE_AND_AFTER.items()
            for step_out in outs
        }
        self.stretching = {step: self._flat(work) for step, work in stretching.items()}
        # Closed paths end in the state in which they begin; at the ends of open wires there is no state yet.
        states: list[int] = list(MOVES)
        if closed:
            columns, rows = ((dots[0] - dots[-1]) % (m, n)).tolist()
            states = [columns + 2 * rows - 1]
        self.states = states
        self.start, self.end = 0, (self.columns - 1) * self.padded[1] + self.rows - 1

    def _flat(self, values: FloatArray) -> FloatArray:
        padded = np.full(self.padded, np.inf)
        padded[: self.columns, : self.rows] = values
        return padded.ravel()

    def diagonals(self) -> Iterator[slice]:
        """The dots with equal column + row, from the start to the end: no step leads from one to another of them."""
        stride = self.padded[1]
        for total in range(self.columns + self.rows - 1):
            first = max(0, total - self.rows + 1)
            last = min(self.columns - 1, total)
            begin = first * stride + total - first
            yield slice(begin, begin + (last - first) * (stride - 1) + 1, stride - 1)

    def moved(self, diagonal: slice, step: int) -> slice:
        """The dots one step on."""
        by = MOVES[step][0] * self.padded[1] + MOVES[step][1]
        return slice(diagonal.start + by, diagonal.stop + by, diagonal.step)


def _nowhere(graph: _Graph, dot: int) -> tuple[dict[int, FloatArray], UIntArray]:
    """Work by state, nothing known but the states of one dot; and a byte a dot."""
    size = graph.padded[0] * graph.padded[1]
    works = {step: np.full(size, np.inf) for step in MOVES}
    for step in graph.states:
        works[step][dot] = 0.0
    return works, np.zeros(size, np.uint8)


def _work_to(graph: _Graph) -> tuple[dict[int, FloatArray], UIntArray]:
    """Least work from the start to every state, the bend there not included, eqs (20)-(22); and the steps in."""
    reach, before = _nowhere(graph, graph.start)
    for here in graph.diagonals():
        for step_out, ins in BEFORE_AND_AFTER.items():
            offers = np.stack(
                [reach[step_in][here] + graph.bends[step_in, step_out][here] for step_in in ins]
            )
            best = offers.argmin(axis=0)
            there = graph.moved(here, step_out)
            reach[step_out][there] = offers.min(axis=0) + graph.stretching[step_out][here]
            before[here] |= np.array(ins, np.uint8)[best] << np.uint8(BITS[step_out])
    return reach, before


def _work_from(graph: _Graph) -> tuple[dict[int, FloatArray], UIntArray]:
    """Least work from every state to the end, the bend there included; and the steps out."""
    to_go, after = _nowhere(graph, graph.end)
    for here in reversed(list(graph.diagonals())):
        if here.start == graph.end:
            continue
        onward = {step: graph.stretching[step][here] + to_go[step][graph.moved(here, step)] for step in MOVES}
        for step_in, outs in BEFORE_AND_AFTER.items():
            offers = np.stack([graph.bends[step_in, step_out][here] + onward[step_out] for step_out in outs])
            best = offers.argmin(axis=0)
            to_go[step_in][here] = offers.min(axis=0)
            after[here] |= np.array(outs, np.uint8)[best] << np.uint8(BITS[step_in])
    return to_go, after
