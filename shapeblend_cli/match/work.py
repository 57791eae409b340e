"""The work it takes to bend and stretch one wire into another.

Section 3 of Sederberg and Greenwood, "A Physically Based Approach to 2-D Shape Blending", Computer
Graphics 26(2), 1992 (SIGGRAPH '92).

Both polygons are normalised to the unit box (section 3.3) before they come here. `i` runs over the
first and is axis 0 of every table, `j` runs over the second and is axis 1; figure 25 draws `i` as columns.
The paper's text calls eq (17) "equation 18".
"""

from __future__ import annotations

from copy import copy
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.constants import WorkConstants
from shapeblend_cli.match import angles

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

EE, ED, DE, SS, SD, DS, DD = range(7)
"""The bends of a dot by the step into it and the step out of it: the last axis of `Tables.bends`."""

EAST, SOUTH, SOUTHEAST = range(3)
"""Steps of a path: (1, 0), (0, 1) and (1, 1)."""

NO_BEND = -1
BEND_OF_STEPS = np.array([[EE, NO_BEND, ED], [NO_BEND, SS, SD], [DE, DS, DD]])
"""The bend by the step into a dot and the step out of it. Turns of 90 degrees are none: section 4 forbids them."""


STRETCHING_DOTS = 1 << 18
"""Stretching work is computed for so many dots at once: few enough to stay in the cache."""


class Window(NamedTuple):
    """The part of a graph that is stored or gone through, column by column.

    Attributes
    ----------
    low, high : (columns,) int
        First and last row of each column; neither ever falls.
    place : (columns,) int
        Where each column begins in a flat array of the window's dots.
    """

    low: IntArray
    high: IntArray
    place: IntArray

    @classmethod
    def between(cls, low: IntArray, high: IntArray) -> Window:
        """Lay out the columns one after the other."""
        heights = high - low + 1
        return cls(np.ascontiguousarray(low), np.ascontiguousarray(high), np.cumsum(heights) - heights)

    @classmethod
    def full(cls, columns: int, rows: int) -> Window:
        """Every row of every column."""
        return cls.between(np.zeros(columns, np.intp), np.full(columns, rows - 1, np.intp))

    @property
    def dots(self) -> int:
        """How many dots there are in all columns."""
        return int(self.place[-1] + self.high[-1] - self.low[-1]) + 1

    def blocks(self, dots: int) -> Iterator[slice]:
        """Cut the columns into runs of about so many dots."""
        ends = np.append(self.place[1:], self.dots)
        first = 0
        while first < len(ends):
            last = max(int(np.searchsorted(ends, self.place[first] + dots, "right")), first + 1)
            yield slice(first, last)
            first = last


class Tables(NamedTuple):
    """The work of every step and every bend in a window of a graph.

    Attributes
    ----------
    east : (columns,) float
        Stretching work of the East step that leaves each column.
    south : (n,) float
        Stretching work of the South step that leaves row j, where the first wire's stiffness is 1.
    southeast : (dots,) float
        Stretching work of the Southeast step that leaves each dot.
    bends : (dots, 7) float
        Bending work at each dot by the steps into it and out of it, see `BEND_OF_STEPS`.
    weight : (columns,) float
        Stiffness of the first wire.
    origin, place : (columns,) int
        `Window.low` and `Window.place` of the dots.
    """

    east: FloatArray
    south: FloatArray
    southeast: FloatArray
    bends: FloatArray
    weight: FloatArray
    origin: IntArray
    place: IntArray


class PathWork(NamedTuple):
    """What a path costs, and how many of its angles reach zero."""

    stretching: float
    bending: float
    zero_angles: int

    @property
    def total(self) -> float:
        """Stretching and bending work together."""
        return self.stretching + self.bending


def edge_lengths(vertices: ComplexArray, closed: bool) -> FloatArray:
    """Length of the edge that leaves each vertex; the last of an open polygon leads nowhere: 0."""
    edges = np.roll(vertices, -1) - vertices
    if not closed:
        edges[-1] = 0.0
    return np.abs(edges)


def corners(vertices: ComplexArray, closed: bool) -> FloatArray:
    """What the bends need to know of each vertex of a wire.

    Parameters
    ----------
    vertices : (m,) complex
        No two neighbours are equal. m >= 2 when open, >= 3 when closed.
    closed : bool
        An open wire goes straight on beyond its ends: the missing edge of an end vertex is the other one
        reversed, so a run of coincident vertices on it lies along the wire.

    Returns
    -------
    (m, 10) float
        theta = arg(conj(F) B) in [0, 2 pi); B; F; arg B; arg F; the direction d of the base on which
        coincident vertices lie (section 2.2), B turned by -(90 degrees + theta / 2): arg d, d.
    """
    fwd = np.roll(vertices, -1) - vertices
    back = np.roll(vertices, 1) - vertices
    if not closed:
        fwd[-1] = -back[-1]
        back[0] = -fwd[0]
    theta = np.angle(fwd.conj() * back)
    theta = np.where(theta < 0.0, theta + 2.0 * np.pi, theta)
    base = back / np.abs(back) * np.exp(-1j * (0.5 * np.pi + 0.5 * theta))
    columns = (
        theta, back.real, back.imag, fwd.real, fwd.imag,
        np.angle(back), np.angle(fwd), np.angle(base), base.real, base.imag,
    )  # fmt: skip
    return np.ascontiguousarray(np.stack(columns, axis=1))


def stretching_work(len0: FloatArray, len1: FloatArray, constants: WorkConstants) -> FloatArray:
    """Work to stretch edges of one wire onto edges of the other.

    Equation (16), section 3.1.

    Parameters
    ----------
    len0, len1 : ndarray of float, mutually broadcastable
        Edge lengths L0 and L1 in unit-box lengths (section 3.3), >= 0.
    constants : WorkConstants
        Reads k_s, e_s, c_s.

    Returns
    -------
    ndarray of the broadcast shape, >= 0

    Notes
    -----
    Symmetric in the two lengths. Departure: L0 = L1 = 0 is 0/0 in (16); here it is 0.

    Examples
    --------
    Leg 1-2 of figure 23 (section 3.4):

    >>> w = stretching_work(0.5**0.5, 1.0, WorkConstants(k_s=0.5, c_s=0.5, e_s=1))
    >>> round(float(w), 4)
    0.1716
    """
    k_s, e_s, c_s = constants.k_s, constants.e_s, constants.c_s
    delta = np.abs(np.subtract(len1, len0))
    resistance = (1.0 - c_s) * np.minimum(len0, len1) + c_s * np.maximum(len0, len1)
    return k_s * np.power(delta, e_s) / np.where(resistance > 0.0, resistance, 1.0)


class Wires:
    """Two polygons in the unit box, ready to be priced.

    Parameters
    ----------
    p0, p1 : (m,) and (n,) complex
    closed : bool
    constants : WorkConstants
    weight : (m,) float, optional
        Stiffness of the first wire at its vertices (section 6): k_s and k_b are multiplied by it, k_s of an edge
        by the mean of its ends.
    """

    def __init__(
        self,
        p0: ComplexArray,
        p1: ComplexArray,
        closed: bool,
        constants: WorkConstants,
        weight: FloatArray | None = None,
    ) -> None:
        self.closed = closed
        self.constants = constants
        self.m, self.n = len(p0), len(p1)
        self.weight = np.ones(self.m) if weight is None else np.asarray(weight, np.float64)
        self.edge_weight = 0.5 * (self.weight + np.roll(self.weight, -1))
        self.len0, self.len1 = edge_lengths(p0, closed), edge_lengths(p1, closed)
        self.corners0, self.corners1 = corners(p0, closed), corners(p1, closed)

    def beginning_at(self, vertex: int) -> Wires:
        """The same wires, closed, with vertex 0 of the first elsewhere."""
        other = copy(self)
        other.weight, other.edge_weight = np.roll(self.weight, -vertex), np.roll(self.edge_weight, -vertex)
        other.len0, other.corners0 = np.roll(self.len0, -vertex), np.roll(self.corners0, -vertex, axis=0)
        return other

    def tables(self, window: Window | None = None, first_column: int = 0) -> Tables:
        """Price every step and every bend in a window, the whole graph without one.

        O(dots) time and memory, 72 bytes a dot.

        Parameters
        ----------
        window : Window, optional
            Rows count on beyond n.
        first_column : int
            The column of the graph that column 0 of the window is; it counts on beyond m.
        """
        if window is None:
            window, columns = Window.full(self.m, self.n), np.arange(self.m)
        else:
            columns = (first_column + np.arange(len(window.low))) % self.m
        len0, edge_weight = self.len0[columns], self.edge_weight[columns]
        southeast = np.empty(window.dots)
        for part in window.blocks(STRETCHING_DOTS):
            heights = window.high[part] - window.low[part] + 1
            column = np.repeat(columns[part], heights)
            row = np.arange(len(column)) - np.repeat(np.cumsum(heights) - heights - window.low[part], heights)
            first = int(window.place[part.start])
            southeast[first : first + len(column)] = self.edge_weight[column] * stretching_work(
                self.len0[column], self.len1[row % self.n], self.constants
            )
        bends = np.empty((window.dots, 7))
        weight = self.weight[columns]
        angles.fill_bends(
            self.corners0[columns],
            self.corners1,
            weight,
            window.low,
            window.place,
            *self.constants.bending(),
            bends,
        )
        return Tables(
            east=stretching_work(len0, np.zeros(1), self.constants) * edge_weight,
            south=stretching_work(np.zeros(1), self.len1, self.constants),
            southeast=southeast,
            bends=bends,
            weight=weight,
            origin=window.low,
            place=window.place,
        )

    def path_work(self, dots: IntArray) -> PathWork:
        """Price a given path by the equations, without a graph.

        Parameters
        ----------
        dots : (k, 2) int
            The path, from its first dot; a closed path comes back to that dot after the last, which is
            not repeated. Every step goes East, South or Southeast, and none is followed by a turn of 90
            degrees. The bend at the first dot is charged when closed; open wires have no angle at their ends.

        Raises
        ------
        ValueError
            A step is none of the three, or a turn of 90 degrees.
        """
        dots = np.array(dots, np.intp)  # kernels take no read-only arrays
        following = np.roll(dots, -1, axis=0) if self.closed else dots[1:]
        start = dots[: len(following)]
        moves = (following - start) % (self.m, self.n)
        at, kinds, bending = self.bends_on(dots)
        stiff = np.where(moves[:, 0] > 0, self.edge_weight[start[:, 0]], self.weight[start[:, 0]])
        stretching = stiff * stretching_work(
            self.len0[start[:, 0]] * moves[:, 0], self.len1[start[:, 1]] * moves[:, 1], self.constants
        )
        zeros = self._bends(at, kinds, 0.0, 0.0, 1.0, 1.0)  # the penalty alone
        return PathWork(float(stretching.sum()), float(bending.sum()), int(zeros.sum()))

    def bends_on(self, dots: IntArray) -> tuple[IntArray, IntArray, FloatArray]:
        """The dots of a path that have an angle, their bends (see `BEND_OF_STEPS`), and the bending work of each.

        The path is that of `path_work`; ends of open wires have no angle.

        Raises
        ------
        ValueError
            A step is not East, South or Southeast, or a turn of 90 degrees.
        """
        dots = np.array(dots, np.intp)
        following = np.roll(dots, -1, axis=0) if self.closed else dots[1:]
        moves = (following - dots[: len(following)]) % (self.m, self.n)
        steps = moves @ (1, 2) - 1  # EAST, SOUTH, SOUTHEAST
        at, steps_in, steps_out = dots[1:-1], steps[:-1], steps[1:]
        if self.closed:
            at, steps_in, steps_out = dots, np.roll(steps, 1), steps
        legal = moves.max(initial=0) <= 1 and moves.any(axis=1).all()
        kinds = BEND_OF_STEPS[steps_in, steps_out] if legal else np.array([NO_BEND])
        if (kinds == NO_BEND).any():
            raise ValueError(
                "a path goes one step East, South or Southeast at a time, without turns of 90 degrees"
            )
        at = np.ascontiguousarray(at)
        return at, kinds, self._bends(at, kinds, *self.constants.bending())

    def _bends(
        self, at: IntArray, kinds: IntArray, k_b: float, m_b: float, e_b: float, p_b: float
    ) -> FloatArray:
        """Bending work at dots, by constants of eq (17)."""
        work = np.empty(len(at))
        angles.bends_along(self.corners0, self.corners1, self.weight, at, kinds, k_b, m_b, e_b, p_b, work)
        return work
