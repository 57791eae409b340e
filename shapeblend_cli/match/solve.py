"""The least-work correspondence of two polygons, from vertices to dots."""

from __future__ import annotations

from itertools import pairwise, product
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.constants import WorkConstants
from shapeblend_cli.errors import MatchError
from shapeblend_cli.match import angles, coarse
from shapeblend_cli.match import starts as searches
from shapeblend_cli.match.work import Wires
from shapeblend_cli.model import Correspondence

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

    Dot = tuple[int, int]

COMPILED: bool = angles.COMPILED
"""Whether the kernels were compiled; uncompiled they give the same results, far slower."""

EXACT_DOTS = {"exact": np.inf, "auto": 2_500_000, "fast": 40_000}
"""Up to how many dots, m n, the search is exact, by effort; beyond that it goes from coarse to fine."""


def least_work(
    p0: ComplexArray,
    p1: ComplexArray,
    closed: bool = True,
    constants: WorkConstants | None = None,
    *,
    start: Dot | None = None,
    pins: Sequence[Dot] = (),
    starts: tuple[int, int, int] | None = None,
    band: float | None = None,
    weight: FloatArray | None = None,
    solver: str = "exact",
    effort: str = "auto",
    watch: Callable[[float], None] | None = None,
) -> Correspondence:
    """Find the correspondence that takes the least work.

    Parameters
    ----------
    p0, p1 : (m,) and (n,) complex
        Vertices in the unit box (section 3.3), both polygons in the same direction, neighbours distinct,
        the first vertex not repeated. m, n >= 3 when closed, >= 2 when open.
    closed : bool
        Open polygons correspond end to end, first vertex to first.
    constants : WorkConstants, optional
    start : (int, int), optional
        A vertex of `p0` and the vertex of `p1` it must correspond to. Without it, and without pins, every
        start is considered, and the result is the least over all of them.
    pins : sequence of (int, int)
        Further vertices that must correspond.
    starts : (int, int, int), optional
        A vertex of `p0`, and the first and the last vertex of `p1` it may correspond to when a closed path comes to it;
        the last may be counted on beyond n. Without it, and without `start` and pins, that may be any.
    band : float, optional
        Largest diagonal deviation, eq (30), of the path, measured from `start`, else from the first pin, else
        from where the path comes to vertex 0 of `p0` (section 5.2).
    weight : (m,) float > 0, optional
        Stiffness along the first wire (section 6): multiplies k_s and k_b there.
    solver : {'exact', 'simplified'}
        The rigorous algorithm, or that of section 4.1.
    effort : {'auto', 'exact', 'fast'}
        `exact` proves the result however long it takes; `auto` does where it is quick; otherwise a
        coarser problem is solved exactly and refined, and nothing is proven.
    watch : callable, optional
        Told now and then which share of the work is done, from 0 to 1.

    Returns
    -------
    Correspondence
        Closed paths begin at `start`, else at the first pin, else where they come to vertex 0 of `p0`.

    Raises
    ------
    MatchError
        Pins that name no vertex or cross each other, or a band that no path fits into.
    """
    constants = constants or WorkConstants()
    m, n = len(p0), len(p1)
    pins = _checked_pins(([start] if start else []) + list(pins), m, n)

    # Column 0 of the graph: the first pin, or the sharpest corner, where the fewest rows are worth a look.
    # A band is measured from vertex 0.
    first0, first1 = 0, 0
    if closed and pins:
        first0, first1 = pins[0]
    elif closed and starts:
        first0, first1 = starts[0], starts[1] % n
    elif closed and band is None:
        first0 = coarse.sharpest(p0)
    problem = coarse.Problem(
        p0=np.roll(p0, -first0),
        p1=np.roll(p1, -first1),
        closed=closed,
        constants=constants,
        weight=None if weight is None else np.roll(np.asarray(weight, np.float64), -first0),
        band=band,
        solver=solver,
        start_rows=starts[2] - starts[1] + 1 if starts else None,
        watch=watch or (lambda share: None),
    )
    limit = EXACT_DOTS[effort]
    if solver == "simplified":  # it works on tables that are all there
        limit = min(limit, searches.STORED_DOTS)
    if closed and not pins:
        found, proven = coarse.solve(problem, None, limit)
    else:
        rolled = [((i - first0) % m, (j - first1) % n) for i, j in pins]
        placements = _placements(rolled[1:] if closed else rolled, m, n, closed)
        if not placements:
            raise MatchError(_crossing(rolled, pins, closed))
        solved = [coarse.solve(problem, placement, limit) for placement in placements]
        found, proven = min(solved, key=lambda s: s[0].work if s[0] else np.inf)
    if found is None:
        raise MatchError(
            f"no path stays within {band:g} of the diagonal of {m} and {n} vertices; a wider band would work"
            if band is not None
            else "no path goes through these pins without a turn of 90 degrees; others would work"
        )

    dots = np.array(found.dots, np.intp)
    if closed:
        dots = dots[:-1]  # the end is the start again
    dots = (dots + np.array([first0, first1])) % np.array([m, n])
    if closed and not pins:
        dots = np.roll(dots, -_enters_column_0(dots[:, 0]), axis=0)
    price = Wires(p0, p1, closed, constants, weight).path_work(dots)
    return Correspondence(
        dots=dots,
        closed=closed,
        stretching=price.stretching,
        bending=price.bending,
        lower_bound=price.total if proven else None,
        zero_angles=price.zero_angles,
        diagonal_deviation=diagonal_deviation(dots, m, n, closed),
        sweeps=found.sweeps,
    )


def diagonal_deviation(dots: IntArray, m: int, n: int, closed: bool) -> float:
    """How far a path deviates from the diagonal through its first dot, eqs (29) and (30).

    The m and n of the equations count edges: an open polygon has one less than vertices.
    """
    moves = np.diff(dots, axis=0) % (m, n)
    gone = np.cumsum(moves, axis=0) / ((m, n) if closed else (m - 1, n - 1))
    return float(np.abs(gone[:, 0] - gone[:, 1]).max(initial=0.0))


def _checked_pins(pins: list[Dot], m: int, n: int) -> list[Dot]:
    """The pins without repetitions, all of them within the polygons."""
    for i, j in pins:
        if not (0 <= i < m and 0 <= j < n):
            raise MatchError(f"pin {i},{j} names no vertices; 0,0 to {m - 1},{n - 1} would")
    return list(dict.fromkeys(pins))


def _placements(pins: list[Dot], m: int, n: int, closed: bool) -> list[list[Dot]]:
    """Where in the graph the pins can lie so that one path goes through all of them, in order along it.

    A pin that shares a vertex with the first dot lies in the first column or in the last, in the first row or in
    the last.
    """

    def places(i: int, j: int) -> list[Dot]:
        if not closed:
            return [(i, j)]
        return [(c, r) for c in ([0, m] if i == 0 else [i]) for r in ([0, n] if j == 0 else [j])]

    ordered = [sorted(choice) for choice in product(*(places(i, j) for i, j in pins))]
    return [p for p in ordered if all(r1 <= r2 for (_, r1), (_, r2) in pairwise(p))]


def _crossing(rolled: list[Dot], pins: list[Dot], closed: bool) -> str:
    """Say which pins cross."""
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


def _enters_column_0(columns: IntArray) -> int:
    """Where a closed path comes to column 0 from another column."""
    return int(np.flatnonzero((columns == 0) & (np.roll(columns, 1) != 0))[0])
