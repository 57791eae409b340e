"""The least-work correspondence of two polygons, from vertices to dots."""

from __future__ import annotations

from itertools import pairwise, product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.matching import angles, coarse, graph
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.model import Correspondence, Figures
from shapeblend_cli.model.arrays import rolled

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import IntArray

    Dot = tuple[int, int]

COMPILED: bool = angles.COMPILED
"""Whether the kernels were compiled; uncompiled they give the same results, far slower."""

EXACT_DOTS = {"exact": np.inf, "auto": 2_500_000, "fast": 40_000}
"""Maximum size of a graph, m n in dots, that is searched exactly, by effort; larger ones go from coarse to fine."""

MOST_SWEPT = {"exact": np.inf, "auto": 200_000_000, "fast": 200_000_000}
"""Maximum number of dots swept for one path, by effort; after that, the best path so far will do."""


class Search(NamedTuple):
    """Where the least path is searched, and how; by default everywhere.

    Attributes
    ----------
    start : (int, int) or None
        A vertex of the first polygon and the vertex of the second that must correspond to it.
    pins : sequence of (int, int)
        Further vertices that must correspond.
    band : float or None
        Largest diagonal deviation, eq (30), of the path, measured from `start`, else from the first pin, else
        from where the path enters vertex 0 of the first polygon (section 5.2).
    solver : {'exact', 'simplified'}
        The rigorous algorithm, or the one of section 4.1.
    effort : {'auto', 'exact', 'fast'}
        `exact` proves the result however long it takes, `auto` where that is quick. Otherwise a coarser problem is
        solved exactly and refined.
    near : (m,) int, optional
        Roughly which vertex of the second polygon corresponds to each of the first. Only paths that keep near that are
        searched, whatever the effort.
    known : float
        The work of some path among those that are searched: only others that take less need be looked for, and it.
    most : float
        Maximum work that is of use, for closed polygons near a path: `NothingLess` is raised where all take more.
    """

    start: Dot | None = None
    pins: Sequence[Dot] = ()
    band: float | None = None
    solver: str = "exact"
    effort: str = "auto"
    near: IntArray | None = None
    known: float = np.inf
    most: float = np.inf


EVERYWHERE = Search()


class NothingLess(Exception):
    """All paths that were searched take more than the maximum work that is of use."""


def least_work(
    wires: Wires, search: Search = EVERYWHERE, watch: Callable[[float], None] | None = None
) -> Correspondence:
    """Find the correspondence that takes the least work.

    Parameters
    ----------
    wires : Wires
        Open polygons correspond end to end, first vertex to first.
    search : Search
    watch : callable, optional
        Called with the share of the work that is done, from 0 to 1.

    Returns
    -------
    Correspondence
        Closed paths begin at the search's start, else at the first pin, else where they enter vertex 0 of the first
        polygon. The lower bound is that of all paths between these wires: from any start, through any vertices, in no
        band. It is the work itself where all of them were searched, and 0 where no bound is known cheaply: near a path,
        beyond the effort, and in very large graphs.

    Raises
    ------
    MatchError
        Pins that name no vertex or cross each other, or a band that no path fits into.
    NothingLess
        Every path takes more than is of use.
    """
    m, n, closed = wires.m, wires.n, wires.closed
    pins = _checked_pins([*filter(None, [search.start]), *search.pins], m, n)
    first = _first_dot(wires, search, pins)
    near = search.near
    if near is not None:
        near = (rolled(near, -first[0]) - first[1]) % n
    problem = coarse.Problem(
        wires=wires.beginning_at(*first),
        band=search.band,
        solver=search.solver,
        watch=watch or (lambda share: None),
        near=near,
        known=search.known,
        most=search.most,
        most_swept=MOST_SWEPT[search.effort],
    )
    limit = EXACT_DOTS[search.effort]
    if search.solver == "simplified":  # it works on tables that are all there
        limit = min(limit, graph.STORED_DOTS)
    solved = [coarse.solve(problem, placement, limit) for placement in _placements(pins, first, wires)]
    found, lower_bound = min(solved, key=lambda s: s[0].work if s[0] else np.inf)
    if found is None:
        if search.most < np.inf:
            raise NothingLess
        raise MatchError(
            f"no path stays within {search.band:g} of the diagonal of {m} and {n} vertices; a wider band would work"
            if search.band is not None
            else "no path goes through these pins without a turn of 90 degrees; others would work"
        )
    dots = found.dots
    if closed:
        dots = dots[:-1]  # the end is the start again
    size = np.array([m, n])
    own = (dots + first) % size
    if closed and not pins:
        own = from_column_0(own)
    return _correspondence(own, problem.wires, dots % size, lower_bound, found.sweeps)


def _first_dot(wires: Wires, search: Search, pins: Sequence[Dot]) -> Dot:
    """Return the dot at which the graph of closed wires begins; the first one of open wires.

    That is the first pin, or the sharpest corner, where the fewest rows are worth a look. A band is measured from
    vertex 0.
    """
    if not wires.closed or not (pins or search.band is None):
        return 0, 0
    if pins:
        return pins[0]
    i = int(np.abs(angles.turns(wires.p0, closed=True)).argmax())
    return i, int(search.near[i]) if search.near is not None else 0


def _correspondence(
    dots: IntArray, wires: Wires, path: IntArray, lower_bound: float, sweeps: int
) -> Correspondence:
    """Return dots as a correspondence; the same path, by the vertices of these wires, is priced."""
    work = wires.path_work(path)
    figures = _Figures(wires, path, dots)
    return Correspondence(dots, wires.closed, work, min(lower_bound, work.total), figures, sweeps)


class _Figures:
    """The figures of a path, counted when one of them is asked for."""

    def __init__(self, wires: Wires, path: IntArray, dots: IntArray) -> None:
        # Not the wires, whose angles would fill the memory: zero angles depend on the vertices alone.
        self._wires = wires.p0, wires.p1, wires.closed, wires.constants
        self._path, self._dots = path, dots

    def __call__(self) -> Figures:
        """Return the figures."""
        wires = Wires(*self._wires)
        deviation = diagonal_deviation(self._dots, wires.m, wires.n, wires.closed)
        return Figures(wires.zero_angles(self._path), deviation)


def is_proven(m: int, n: int, effort: str) -> bool:
    """Return whether the least path of m and n vertices is searched everywhere, by effort."""
    return coarse.is_small(m, n, EXACT_DOTS[effort])


def priced(wires: Wires, dots: IntArray, sweeps: int = 0) -> Correspondence:
    """Return a given path as a correspondence, with no lower bound; a closed one begins where it enters column 0.

    A path with a turn of 90 degrees raises a ValueError.
    """
    if wires.closed:
        dots = from_column_0(dots)
    return _correspondence(dots, wires, dots, 0.0, sweeps)


def diagonal_deviation(dots: IntArray, m: int, n: int, closed: bool) -> float:
    """Return the deviation of a path from the diagonal through its first dot, eqs (29) and (30).

    The m and n of the equations count edges: an open polygon has one less than vertices.
    """
    moves = (dots[1:] - dots[:-1]) % (m, n)
    gone = moves.cumsum(axis=0) / ((m, n) if closed else (m - 1, n - 1))
    return float(np.abs(gone[:, 0] - gone[:, 1]).max(initial=0.0))


def _checked_pins(pins: list[Dot], m: int, n: int) -> list[Dot]:
    """Drop repetitions, and check that the pins lie within the polygons."""
    for i, j in pins:
        if not (0 <= i < m and 0 <= j < n):
            raise MatchError(f"pin {i},{j} names no vertices; 0,0 to {m - 1},{n - 1} would")
    return list(dict.fromkeys(pins))


def _placements(pins: list[Dot], first: Dot, wires: Wires) -> Sequence[list[Dot] | None]:
    """Return the dots of the graph that the pins can be so that one path goes through all of them, in its order.

    A pin that shares a vertex with the first dot lies in the first column or in the last, in the first row or in
    the last. Closed wires without pins have one placement, None.
    """
    m, n, closed = wires.m, wires.n, wires.closed
    if closed and not pins:
        return [None]
    rolled = [((i - first[0]) % m, (j - first[1]) % n) for i, j in pins]

    def dots(i: int, j: int) -> list[Dot]:
        if not closed:
            return [(i, j)]
        return [(c, r) for c in ([0, m] if i == 0 else [i]) for r in ([0, n] if j == 0 else [j])]

    ordered = [
        sorted(choice) for choice in product(*(dots(*pin) for pin in (rolled[1:] if closed else rolled)))
    ]
    found = [p for p in ordered if all(r1 <= r2 for (_, r1), (_, r2) in pairwise(p))]
    if not found:
        raise MatchError(_crossing(rolled, pins, closed))
    return found


def _crossing(rolled: list[Dot], pins: list[Dot], closed: bool) -> str:
    order = sorted(range(len(pins)), key=lambda k: rolled[k])
    for first, second in pairwise(order):
        if rolled[first][1] > rolled[second][1]:
            named = [pins[first], pins[second]]
            round_ = f", going round from {pins[0][0]},{pins[0][1]}" if closed else ""
            return (
                f"pins {named[0][0]},{named[0][1]} and {named[1][0]},{named[1][1]} cross each other{round_}; "
                "vertices must correspond in the same order on both outlines"
            )
    raise AssertionError("pins that do not cross have a placement")


def from_column_0(dots: IntArray) -> IntArray:
    """Return a closed path from where it enters column 0 from another column."""
    first = (dots[:, 0] == 0) & (rolled(dots[:, 0], 1) != 0)
    return rolled(dots, -int(first.argmax()))
