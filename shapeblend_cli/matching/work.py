"""The work it takes to bend, stretch and move one wire into another.

Section 3 of Sederberg and Greenwood, "A Physically Based Approach to 2-D Shape Blending", Computer
Graphics 26(2), 1992 (SIGGRAPH '92).

Both polygons are normalised to the unit box (section 3.3) before they come here. `i` runs over the
first and is axis 0 of every table, `j` runs over the second and is axis 1; figure 25 draws `i` as columns.
The paper's text calls eq (17) "equation 18".

Departures: the paper's work is stretching, and bending along straight vertex paths. By default bending is by turning
(`angles.Bending`), most of it is taken on smoothed outlines (`smoothing`), and points pay for their way (`travel`).
The constants of a preset leave all of that out.
"""

from __future__ import annotations

from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.matching.angles import Bending, Corners, fill_bends, turns
from shapeblend_cli.matching.smoothing import smoothed
from shapeblend_cli.matching.steps import EAST, SOUTH
from shapeblend_cli.matching.stretching import fill_stretching, stretching_work
from shapeblend_cli.matching.sweeps import find_bends
from shapeblend_cli.matching.tables import Tables, Window
from shapeblend_cli.matching.travel import Stations, add_travel, places
from shapeblend_cli.model import Work
from shapeblend_cli.model.arrays import rolled
from shapeblend_cli.options.constants import WorkConstants

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

    Dots = tuple[IntArray, IntArray]
    TakeWork = Callable[[IntArray, Window, FloatArray], None]

SMOOTH_SHARE = 0.7
"""Share of bending that is measured on smoothed outlines, if they are smoothed; the outlines have the corners."""


FEW = 32
"""Maximum number of vertices of a wire whose angles are kept."""


def edge_lengths(vertices: ComplexArray, closed: bool) -> FloatArray:
    """Return the length of the edge that leaves each vertex; 0 for the last of an open polygon."""
    edges = np.concatenate([vertices[1:], vertices[:1]]) - vertices
    if not closed:
        edges[-1] = 0.0
    return np.abs(edges)


class Wire(NamedTuple):
    """The vertices of a polygon, and where they are in other views of it: (m,) complex each."""

    vertices: ComplexArray
    smooth: ComplexArray  # on the smoothed outline
    place: ComplexArray  # in the box made the unit square

    @classmethod
    def of(cls, vertices: ComplexArray, closed: bool, constants: WorkConstants) -> Wire:
        """Look at a polygon as the constants say."""
        smooth = vertices
        if constants.smoothing:
            smooth = _smoothed(np.asarray(vertices, np.complex128).tobytes(), closed, constants.smoothing)
        return cls(vertices, smooth, places(vertices))

    def at(self, places: FloatArray) -> Wire:
        """Return the wire with vertices at these places, vertex numbers or between them, and no others."""
        number = np.arange(len(self.vertices) + 1)
        outlines = (np.append(points, points[0]) for points in self)
        return Wire(*(np.interp(places, number, outline) for outline in outlines))

    def along(self, numbers: IntArray) -> Wire:
        """Return a wire through vertices with these numbers."""
        return Wire(*(points[numbers] for points in self))


@lru_cache(maxsize=64)
def _smoothed(vertices: bytes, closed: bool, sigma: float) -> ComplexArray:
    """Return `smoothed` vertices; the same polygon is matched more than once, near a path and then everywhere."""
    return smoothed(np.frombuffer(vertices, np.complex128), closed, sigma)


def _corners(vertices: ComplexArray, smooth: ComplexArray | None, closed: bool) -> Corners:
    """Return the angles of a wire, and of where its vertices are when it is smoothed."""
    return Corners(vertices, closed, None if smooth is None else turns(smooth, closed))


@lru_cache(maxsize=256)
def _kept_corners(vertices: bytes, smooth: bytes | None, closed: bool) -> Corners:
    """Return `_corners` of a wire of `FEW` vertices, which is compared with one after the other."""
    some, others = (
        None if each is None else np.frombuffer(each, np.complex128) for each in (vertices, smooth)
    )
    assert some is not None
    return _corners(some, others, closed)


class Wires:
    """Two polygons in the unit box, ready to be priced.

    Parameters
    ----------
    p0, p1 : (m,) and (n,) complex, or Wire
        Vertices in the unit box (section 3.3), both polygons in the same direction, neighbours distinct,
        the first vertex not repeated. m, n >= 3 when closed, >= 2 when open.
    closed : bool
    constants : WorkConstants, optional
    weight : (m,) float > 0, optional
        Stiffness of the first wire at its vertices (section 6): k_s and k_b are multiplied by it, k_s of an edge
        by the mean of its ends.
    """

    def __init__(
        self,
        p0: ComplexArray | Wire,
        p1: ComplexArray | Wire,
        closed: bool = True,
        constants: WorkConstants | None = None,
        weight: FloatArray | None = None,
    ) -> None:
        self.closed, self.constants = closed, constants or WorkConstants()
        self.wires = tuple(p if isinstance(p, Wire) else Wire.of(p, closed, self.constants) for p in (p0, p1))
        self.p0, self.p1 = (wire.vertices for wire in self.wires)
        self.m, self.n = len(self.p0), len(self.p1)
        self.is_even = weight is None
        self.weight = self.edge_weight = np.ones(self.m)
        if weight is not None:
            self.weight = np.asarray(weight, np.float64)
            self.edge_weight = 0.5 * (self.weight + rolled(self.weight, -1))

    @cached_property
    def lengths(self) -> tuple[FloatArray, FloatArray]:
        """The lengths of the edges that leave the vertices of the first wire and of the second."""
        len0, len1 = (edge_lengths(wire.vertices, self.closed) for wire in self.wires)
        return len0, len1

    @cached_property
    def corners0(self) -> Corners:
        """The angles of the first wire."""
        return self._corners_of(0)

    @cached_property
    def corners1(self) -> Corners:
        """The angles of the second wire."""
        return self._corners_of(1)

    def _corners_of(self, side: int) -> Corners:
        wire, c = self.wires[side], self.constants
        smooth = wire.smooth if c.smoothing and c.bending == "turn" else None
        if len(wire.vertices) > FEW:
            return _corners(wire.vertices, smooth, self.closed)
        return _kept_corners(
            wire.vertices.tobytes(), None if smooth is None else smooth.tobytes(), self.closed
        )

    @property
    def _corners(self) -> tuple[Corners, Corners]:
        return self.corners0, self.corners1

    @cached_property
    def _smooth_corners(self) -> tuple[Corners, Corners]:
        first, second = (Corners(wire.smooth, self.closed) for wire in self.wires)
        return first, second

    @cached_property
    def _stations(self) -> tuple[Stations, Stations]:
        first, second = (
            Stations(wire.place, own) for wire, own in zip(self.wires, self.lengths, strict=True)
        )
        return first, second

    def beginning_at(self, i: int, j: int) -> Wires:
        """Return the same closed wires with vertex i of the first and vertex j of the second as their first ones."""
        if i == j == 0:
            return self
        p, q = (
            Wire(*(rolled(points, -first) for points in wire)) if first else wire
            for wire, first in zip(self.wires, (i, j), strict=True)
        )
        return Wires(p, q, True, self.constants, None if self.is_even else rolled(self.weight, -i))

    def along(self, i: IntArray, j: IntArray) -> Wires:
        """Return open wires along these vertices of the first wire and of the second, as stiff as anywhere."""
        first, second = self.wires
        return Wires(first.along(i), second.along(j), False, self.constants)

    def tables(self, window: Window | None = None, first_column: int = 0) -> Tables:
        """Price every step and every bend in a window, or the whole graph: O(dots) time, 64 bytes a dot.

        Rows of the window, and its `first_column` in the graph, are counted on beyond n and m.
        """
        window = window or Window.full(self.m, self.n)
        columns = (first_column + np.arange(len(window.low))) % self.m
        southeast, weight = np.empty(window.dots), self.edge_weight[columns]
        fill_stretching(self.lengths, self.constants, columns, weight, window, southeast)
        bends = np.empty((window.dots, 7))
        for take in self._terms_of_bends:
            take(columns, window, bends)
        if not self.closed:
            if columns[0] == 0 and window.low[0] == 0:
                bends[0] = 0.0
            if columns[-1] == self.m - 1 and window.high[-1] == self.n - 1:
                bends[-1] = 0.0
        (len0, len1), nothing = self.lengths, np.zeros(1)
        return Tables(
            window=window,
            first_column=first_column,
            weight=self.weight[columns],
            east=stretching_work(len0[columns], nothing, self.constants) * weight,
            south=stretching_work(nothing, len1, self.constants),
            southeast=southeast,
            bends=bends,
        )

    @property
    def _terms_of_bends(self) -> tuple[TakeWork, ...]:
        """The terms of the work that belong to dots, as in `Work` after stretching; the first one overwrites."""
        return self._fill_bending, self._add_travel

    def _fill_bending(self, columns: IntArray, window: Window, bends: FloatArray) -> None:
        """Fill in the bending work of the dots of a window, whose columns are these vertices of the first wire."""
        c = self.constants
        smooth = c.k_b * SMOOTH_SHARE if c.smoothing else 0.0
        weight = self.weight[columns]
        if c.bending == "turn":
            bending = Bending(c, c.k_b - smooth, c.p_b, smooth)
            fill_bends(*self._corners, bending, columns, weight, window, bends)
            return
        fill_bends(*self._corners, Bending(c, c.k_b - smooth, c.p_b), columns, weight, window, bends)
        if smooth:
            more = np.empty_like(bends)
            fill_bends(*self._smooth_corners, Bending(c, smooth, 0.0), columns, weight, window, more)
            bends += more

    def _fill_zeros(self, columns: IntArray, window: Window, bends: FloatArray) -> None:
        """Count the angles that reach zero."""
        bending = Bending(self.constants, 0.0, 1.0)
        fill_bends(*self._corners, bending, columns, self.weight[columns], window, bends)

    def _add_travel(self, columns: IntArray, window: Window, bends: FloatArray) -> None:
        if self.constants.k_t:
            add_travel(*self._stations, self.constants.k_t, columns, window, bends)

    def path_work(self, dots: IntArray) -> Work:
        """Return the work of a given path, by the equations and without a graph.

        Parameters
        ----------
        dots : (k, 2) int
            From the first dot, to which a closed path returns after the last; it is not repeated.

        Raises
        ------
        ValueError
            A step is not East, South or Southeast, or a turn of 90 degrees.
        """
        columns, rows, steps, at, kinds = self._path(dots)
        columns, rows = columns[: len(steps)], rows[: len(steps)]
        moves0, moves1 = steps != SOUTH, steps != EAST
        len0, len1 = self.lengths
        stretching = stretching_work(len0[columns] * moves0, len1[rows] * moves1, self.constants)
        if not self.is_even:
            stretching *= np.where(moves0, self.edge_weight[columns], self.weight[columns])
        terms = self._bends_along(at, kinds, *self._terms_of_bends)
        return Work(float(stretching.sum()), *(float(term.sum()) for term in terms))

    def zero_angles(self, dots: IntArray) -> int:
        """Return the number of dots of a path (see `path_work`) whose angle reaches zero."""
        _, _, _, at, kinds = self._path(dots)
        return int(self._bends_along(at, kinds, self._fill_zeros)[0].sum())

    def bends_on(self, dots: IntArray) -> tuple[IntArray, IntArray, FloatArray]:
        """Return the dots of a path (see `path_work`) that have an angle, their bends, and the bending work of each."""
        _, _, _, at, kinds = self._path(dots)
        return np.stack(at, axis=1), kinds, self._bends_along(at, kinds, self._fill_bending)[0]

    def _path(self, dots: IntArray) -> tuple[IntArray, IntArray, IntArray, Dots, IntArray]:
        """Return the columns and rows of dots, and the steps that leave them; the dots with an angle, and their bends.

        Dots are columns and rows, too.
        """
        columns, rows = np.array(dots.T, np.intp, order="C")
        closed = self.closed
        steps, kinds = (
            np.empty(len(dots) if closed else max(len(dots) - gone, 0), np.intp) for gone in (1, 2)
        )
        if not find_bends(columns, rows, (self.m, self.n), closed, steps, kinds):
            raise ValueError(
                "a path goes one step East, South or Southeast at a time, without turns of 90 degrees"
            )
        at = (columns, rows) if closed else (columns[1:-1], rows[1:-1])
        return columns, rows, steps, at, kinds

    def _bends_along(self, at: Dots, kinds: IntArray, *terms: TakeWork) -> list[FloatArray]:
        """Return terms of the work of a bend at each dot."""
        columns, rows = at
        numbers = np.arange(len(rows))
        window = Window(rows, rows, numbers)
        found = []
        for take in terms:
            bends = np.zeros((len(rows), 7))
            if len(rows):
                take(columns, window, bends)
            found.append(bends[numbers, kinds])
        return found
