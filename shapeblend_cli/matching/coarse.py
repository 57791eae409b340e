"""Graphs of any size: exact where that is quick, from coarse to fine beyond.

A problem too large to be solved at once is thinned out to a third of its vertices on each side, sharp
corners first, and solved so, by thinning again if need be. In the full graph only a corridor is searched:
the dots that correspond to those of coarse paths of little more work than the best, as many as there is
room for, and some around them. Where the best path touches the corridor's wall the corridor is widened and
searched again. Under finer sampling stretching and bending work tend to a limit, so a coarse optimum
is near a fine one; but nothing is proven.

Cost: about linear in m + n.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.matching import starts
from shapeblend_cli.matching.angles import turns
from shapeblend_cli.matching.graph import Graph, Path
from shapeblend_cli.matching.tables import Window
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.model.arrays import numbered

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray

    Dot = tuple[int, int]

FACTOR = 3
"""Number of vertices that become one."""

PADS = (16, 24, 32, 48, 64, 96, 128, 192, 256)
"""Widths of the margin of a corridor around coarse paths, in vertices to all sides: the largest with room is taken."""

NEAR_PAD = 12
"""Width of the margin of a corridor around a given path, in vertices to all sides."""

DETAILED = 400
"""Minimum number of vertices of a polygon of much detail, which has more paths of nearly the same work."""

MOST_NEAR = 48
"""Maximum width of that margin, in vertices."""

NEAR_SHARE = 24
"""Number of its vertices for each vertex of that margin, where it has much detail."""

FOLLOWED = (
    (0.4, 1 / 16),
    (0.2, 1 / 16),
    (0.1, 1 / 16),
    (0.05, 1 / 32),
    (0.02, 1 / 64),
    (0.01, 1 / 128),
    (0.0, 0.0),
)
"""Coarse paths to follow: maximum extra work, as a share of the best path's, and maximum distance from its start, as a
share of the vertices. The first with room is taken."""

CORRIDOR_DOTS = 1_500_000
"""Maximum size of a corridor, in dots."""

CORRIDOR_ROWS = 120
"""Maximum size of a corridor, in rows a column, if that is more."""

MOST_WIDENINGS = 6
"""Maximum number of times that a corridor is searched."""

HUGE = 10_000
"""Minimum number of vertices of polygons whose corridor has half the rows and is searched twice at the most: what is
beyond cannot be seen."""

MOST_SWEPT_UNPROVEN = 50_000_000
"""Maximum size of a corridor, or of a problem that was thinned out, in dots times sweeps: nothing is proven there."""

CORNER = 0.35
"""Minimum turn of a corner, in radians."""

COARSEST_DOTS = 600_000
"""Maximum size of a problem that is not thinned out further, in dots."""

LEAST_VERTICES = 100
"""Maximum number of vertices of a polygon that is not thinned out, however many the other polygon has."""


class Problem(NamedTuple):
    """A search (see `solve.Search`) from vertices 0, or from any start; `near` has rows from 0 on, modulo n."""

    wires: Wires
    band: float | None = None
    solver: str = "exact"
    watch: Callable[[float], None] = lambda share: None
    near: IntArray | None = None
    known: float = np.inf
    most: float = np.inf
    most_swept: float = np.inf  # dots, in all sweeps


def solve(problem: Problem, pins: list[Dot] | None, exact_dots: float) -> tuple[Path | None, float]:
    """Find the least path.

    Parameters
    ----------
    problem : Problem
    pins : list of (int, int), or None
        Columns and rows the path goes through, in order, from dot [0, 0] back to itself or to the other ends. None for
        closed polygons: any start.
    exact_dots : float
        Graphs of more dots are solved from coarse to fine.

    Returns
    -------
    path : Path or None
        None when the band or the pins leave none.
    lower_bound : float
        Of all paths, through the pins and in the band or not; infinite if the path itself is the least of all, 0 where
        nothing is known.
    """
    if problem.near is not None:
        return _search_near(problem, problem.near, pins), 0.0
    path, graph = _solve(problem, pins, exact_dots)
    if not is_small(problem.wires.m, problem.wires.n, exact_dots):
        return path, 0.0
    is_free = problem.band is None and (pins is None if problem.wires.closed else not pins)
    is_least = is_free and problem.solver == "exact" and path is not None and path.is_least
    return path, np.inf if is_least else graph.lower_bound()


def is_small(m: int, n: int, exact_dots: float) -> bool:
    """Return whether graphs of m and n vertices are solved as they are."""
    return m * n <= exact_dots or max(m, n) <= LEAST_VERTICES


def _search_near(problem: Problem, near: IntArray, pins: list[Dot] | None) -> Path | None:
    """Search a corridor around a path; where that has none, everywhere that the pins leave.

    None where only paths that take less than a given work are of use, and the corridor has none.
    """
    m, n, closed = problem.wires.m, problem.wires.n, problem.wires.closed
    walls = _region(problem, pins)
    rows = near
    if closed:  # counted on beyond n; what falls is rounding
        begin = (int(near[0]) + n // 2) % n - n // 2
        steps = (near[1:] - near[:-1] + n // 2) % n - n // 2
        rows = np.concatenate([[begin], begin + steps.cumsum(), [begin + n]])
    rows = np.maximum.accumulate(rows)
    inside = None if pins is None else walls
    region = corridor(
        np.arange(len(rows)),
        np.stack([rows, rows], axis=1),
        np.full(len(rows), NEAR_PAD if n < DETAILED else min(n // NEAR_SHARE, MOST_NEAR)),
        (m, n) if closed else None,
        inside,
    )
    reaches_pins = (region.low <= region.high).all()
    path = _search(problem, region, pins)[0] if reaches_pins else None
    if path is not None or (pins is None and problem.most < np.inf):
        return path
    return _search(problem, walls, pins)[0]


def _solve(problem: Problem, pins: list[Dot] | None, exact_dots: float) -> tuple[Path | None, Graph]:
    """Find a path, and the graph that was searched for it."""
    if is_small(problem.wires.m, problem.wires.n, exact_dots):
        return _search(problem, _region(problem, pins), pins)
    return _refine(problem, pins)


def _region(problem: Problem, pins: list[Dot] | None) -> Window:
    """Return the part of the graph where paths through the pins may run."""
    m, n, closed = problem.wires.m, problem.wires.n, problem.wires.closed
    columns = m + 1 if closed else m
    if pins is None:
        return Window.full(columns, 2 * n)
    region = Window.full(columns, n + 1 if closed else n)
    for c, r in pins:
        region.low[c + 1 :] = np.maximum(region.low[c + 1 :], r)
        region.high[:c] = np.minimum(region.high[:c], r)
    return Window.between(region.low, region.high)


def _search(problem: Problem, region: Window, pins: list[Dot] | None) -> tuple[Path | None, Graph]:
    m, n = problem.wires.m, problem.wires.n
    graph = Graph(problem.wires, region, problem.band, problem.watch)
    # A Southeast step past a pin would leave it out: into the row below it, or from the row above it.
    past = [dot for c, r in pins or [] for dot in ((c - 1, r), (c, r - 1))]
    graph.forbid([(c, r) for c, r in past if 0 <= c < m and 0 <= r < n])
    if problem.solver == "simplified":
        find = starts.simplified_of_all if pins is None else starts.simplified_from
        return find(graph), graph
    if pins is None and problem.most < np.inf:
        return starts.least_of_all(graph, problem.most, problem.most_swept), graph
    if pins is None:
        found = starts.least_of_all(graph, problem.known, problem.most_swept)
        return found or starts.least_of_all(graph, most_swept=problem.most_swept), graph
    return starts.least_from(graph), graph


def _refine(problem: Problem, pins: list[Dot] | None) -> tuple[Path | None, Graph]:
    """Solve a coarser problem and search a corridor around its best paths."""
    problem = problem._replace(most_swept=min(MOST_SWEPT_UNPROVEN, problem.most_swept))
    wires, watch = problem.wires, problem.watch
    m, n = wires.m, wires.n
    at0 = thin(wires.p0, wires.closed, {c % m for c, _ in pins or []})
    at1 = thin(wires.p1, wires.closed, {r % n for _, r in pins or []})
    kept0, kept1 = np.round(at0).astype(np.intp), np.round(at1).astype(np.intp)
    walls = _region(problem, pins)
    if len(at0) + len(at1) == m + n:  # pins everywhere
        return _search(problem, walls, pins)
    coarser = problem._replace(
        wires=Wires(
            wires.wires[0].at(at0), wires.wires[1].at(at1), wires.closed, wires.constants, wires.weight[kept0]
        ),
        watch=lambda share: watch(share / FACTOR),
        known=np.inf,
    )
    problem = problem._replace(watch=lambda share: watch((1.0 + (FACTOR - 1.0) * share) / FACTOR))
    coarse_pins = None
    if pins is not None:
        coarse_pins = [(_coarse_row(c, kept0, m), _coarse_row(r, kept1, n)) for c, r in pins]

    path, coarse_graph = _solve(coarser, coarse_pins, COARSEST_DOTS)
    if path is None:  # what fits in full need not fit at a third of the vertices
        return _search(problem, walls, pins)
    columns = _fine_rows(np.arange(coarse_graph.columns), kept0, m)
    inside = None if pins is None else walls

    def around(pad: IntArray) -> Window:
        return corridor(columns, rows, pad, (m, n) if wires.closed else None, inside)

    is_huge = max(m, n) >= HUGE
    room = max(CORRIDOR_DOTS, CORRIDOR_ROWS * m // (2 if is_huge else 1))
    pads = [np.full(len(walls.low), pad) for pad in PADS]
    for slack, reach in FOLLOWED:
        covered = coarse_graph.rows_near(path, slack, None if pins is not None else reach)
        rows = _fine_rows(covered, kept1, n)
        if around(pads[0]).dots <= room:
            break
    pad = max((p for p in pads if around(p).dots <= room), key=lambda p: int(p[0]), default=pads[0])
    del coarse_graph  # its tables are not needed beside those of the corridor

    sweeps = path.sweeps
    for _ in range(2 if is_huge else MOST_WIDENINGS):
        region = around(pad)
        found, graph = _search(problem, region, pins)
        widen = np.ones(len(pad), bool)
        if found is not None:
            sweeps += found.sweeps
            touching = _touching(found.dots, region, inside)
            near = np.arange(-2 * PADS[0], 2 * PADS[0] + 1) + np.flatnonzero(touching)[:, None]
            widen[:] = False
            widen[np.clip(near, 0, len(pad) - 1)] = True
        pad[widen] *= 2
        if not widen.any() or (found is not None and around(pad).dots > 2 * room):
            break
    if found is None:
        found, graph = _search(problem, walls, pins)
    return (found._replace(sweeps=sweeps) if found else None), graph


def thin(vertices: ComplexArray, closed: bool, keep: set[int]) -> FloatArray:
    """Choose about a third of the vertices, or all where there are few.

    Corners stay, one in `FACTOR` vertices at the most; so do vertex 0, the last of an open polygon, and those to
    `keep`. Between them places are spread evenly over the vertices there are, on edges if need be: edges of changing
    lengths would look like work.

    Returns
    -------
    (k,) float
        Places by vertex numbers, rising.
    """
    m = len(vertices)
    if m <= LEAST_VERTICES:
        return np.arange(m, dtype=np.float64)
    runs = -(-m // FACTOR)
    padded = np.zeros(runs * FACTOR)
    padded[:m] = np.abs(turns(vertices, closed))
    sharp = np.arange(runs) * FACTOR + padded.reshape(runs, FACTOR).argmax(axis=1)
    fixed = set(sharp[padded[sharp] > CORNER].tolist()) | keep | {0}
    if not closed:
        fixed |= {m - 1}
    stops = np.array([*sorted(fixed), m] if closed else sorted(fixed))

    pieces = np.maximum(np.round(np.diff(stops) / FACTOR).astype(np.intp), 1)
    part = numbered(pieces)
    start, end = np.repeat(stops[:-1], pieces), np.repeat(stops[1:], pieces)
    at = start + (end - start) * part / np.repeat(pieces, pieces)
    return at if closed else np.append(at, m - 1.0)


def corridor(
    columns: IntArray, rows: IntArray, pad: IntArray, period: Dot | None, walls: Window | None
) -> Window:
    """Return the dots that coarse paths reach, with a margin.

    Parameters
    ----------
    columns : (k,) int
        Columns of the full graph that coarse paths have, rising, from the first to the last.
    rows : (k, 2) int
        First and last row that coarse paths reach in each.
    pad : (columns,) int
        How far the corridor reaches beyond, to all sides.
    period : (int, int) or None
        m and n of closed polygons: the corridor ends as it began.
    walls : Window or None
        What it stays inside.
    """
    low, high = rows[:, 0], np.maximum.accumulate(rows[:, 1])
    if period is not None:
        m, n = period
        columns = np.concatenate([columns[:-1] - m, columns, columns[1:] + m])
        low = np.concatenate([low[:-1] - n, low, low[1:] + n])
        high = np.concatenate([high[:-1] - n, high, high[1:] + n])
    column = np.arange(len(pad))
    # Between two such columns a path may run anywhere between their rows.
    before = np.clip(np.searchsorted(columns, column - pad, "right") - 1, 0, None)
    after = np.clip(np.searchsorted(columns, column + pad, "left"), None, len(columns) - 1)
    low, high = low[before], high[after]
    low, high = low - pad, high + pad
    if walls is not None:
        low, high = np.maximum(low, walls.low), np.minimum(high, walls.high)
    elif period is not None:  # no column may hold a row and its repetition n rows further down
        middle, most = (low + high) // 2, (n - 1) // 2
        low, high = np.maximum(low, middle - most), np.minimum(high, middle + most)
    low, high = np.minimum.accumulate(low[::-1])[::-1], np.maximum.accumulate(high)
    if walls is None and period is not None:
        low[-1], high[-1] = low[0] + n, high[0] + n
        low, high = np.minimum(low, low[-1]), np.minimum(high, high[-1])
        high = np.minimum(high, low + n - 1)
        lift = n if low[0] < 0 else 0
        low, high = low + lift, high + lift
    return Window.between(low, high)


def _touching(path: IntArray, region: Window, walls: Window | None) -> BoolArray:
    """Return the columns in which a path runs along a wall of its corridor that is no wall of the graph."""
    c, r = path[:, 0], path[:, 1]
    at_low, at_high = r == region.low[c], r == region.high[c]
    if walls is not None:
        at_low &= region.low[c] > walls.low[c]
        at_high &= region.high[c] < walls.high[c]
    touching = np.zeros(len(region.low), bool)
    touching[c[at_low | at_high]] = True
    return touching


def _fine_rows(rows: IntArray, kept: IntArray, period: int) -> IntArray:
    """Return the nearest vertices of the full polygon for vertices of the thinned one, round after round."""
    return kept[rows % len(kept)] + period * (rows // len(kept))


def _coarse_row(row: int, kept: IntArray, period: int) -> int:
    """Invert `_fine_rows` for a vertex that was kept."""
    return int(np.searchsorted(kept, row % period)) + len(kept) * (row // period)
