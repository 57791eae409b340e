"""Measure the solver beside the paper's other ways, and print the table of docs/solver.md: `make bench-solver`.

No arguments. It takes a few minutes; times are measured by `make bench`.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.geometry.polygons import orientation, reverse_polygon
from shapeblend_cli.matching.graph import Graph
from shapeblend_cli.matching.solve import Search, least_work
from shapeblend_cli.matching.starts import least_from
from shapeblend_cli.matching.tables import Window
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.options.constants import PAPER, WorkConstants
from shapeblend_cli.svg.reading.read import read
from tools.quality.data import Pair, icon_pairs, svg
from tools.quality.tables import Table

VERTICES, FINE = 200, 2000
EVERY = 2
"""One pair in this many is solved with `FINE` vertices."""

WORKS = {"": WorkConstants(), ", with the paper's work": WorkConstants(**PAPER)}

EQUAL = 1e-9
"""Maximum difference of works that count as equal, as a share of the work."""


def outlines(pair: Pair, vertices: int) -> tuple[np.ndarray, np.ndarray]:
    """Return both outlines of a pair of icons in unit boxes, in one direction."""
    contours = [read("icon", svg(data).encode()).shapes[0].contours[0] for data in (pair.a, pair.b)]
    a, b = (flatten(contour, vertices) for contour in contours)
    if orientation(a) != orientation(b):
        b = reverse_polygon(b, len(contours[1].segments))
    return to_unit_box(a), to_unit_box(b)


def divide_and_conquer(wires: Wires) -> float:
    """Return the least work by the method of Fuchs, Kedem and Uselton, which takes it that least paths never cross.

    The least path from a row in the middle is looked for only between those from the rows on both sides.
    """
    m, n = wires.m, wires.n

    def least(row, above, below):
        low, high = np.full(m + 1, row), np.full(m + 1, row + n)
        if above is not None:
            for c, r in reversed(above):
                low[c] = max(row, r)  # its first row in each column
            for c, r in below:
                high[c] = min(row + n, r)  # its last
        low, high = np.maximum.accumulate(low), np.minimum.accumulate(high[::-1])[::-1]
        return least_from(Graph(wires, Window.between(low, np.maximum(high, low))))

    top = least(0, None, None)
    best = top.work
    stack = [(0, n, top.dots, [(c, r + n) for c, r in top.dots])]
    while stack:
        first, last, above, below = stack.pop()
        middle = (first + last) // 2
        if middle == first:
            continue
        found = least(middle, above, below)
        if found is None:
            continue
        best = min(best, found.work)
        stack += [(first, middle, above, found.dots), (middle, last, found.dots, below)]
    return best


def work_above(wires: Wires) -> tuple[float, float]:
    """Return how far above the least work the simplified solver ends, and divide and conquer, as shares of it."""
    exact = least_work(wires).work
    simplified = least_work(wires, Search(solver="simplified")).work
    return _above(simplified, exact), _above(divide_and_conquer(wires), exact)


def coarse_above(p0: np.ndarray, p1: np.ndarray) -> float:
    """Return how far above the least work the search from coarse to fine ends, as a share of it."""
    auto, exact = (least_work(Wires(p0, p1), Search(effort=effort)).work for effort in ("auto", "exact"))
    return _above(auto, exact)


def _above(work: float, least: float) -> float:
    share = work / least - 1.0
    return share if share > EQUAL else 0.0


def rows() -> Iterator[tuple[str, str]]:
    """Yield the lines of the table."""
    pairs = icon_pairs("single")
    for told, constants in WORKS.items():
        wires = [Wires(*outlines(pair, VERTICES), constants=constants) for pair in pairs]
        simplified, divided = np.array([work_above(each) for each in wires]).T
        yield f"simplified solver (section 4.1){told}: work above the least, median", _percent(simplified, 50)
        yield "... 95th percentile", _percent(simplified, 95)
        yield "... at most", _percent(simplified, 100)
        yield f"divide and conquer{told}: does not find the least work", _share(divided > 0.0)
        yield "... misses it by at most", _percent(divided, 100)
    coarse = np.array([coarse_above(*outlines(pair, FINE)) for pair in pairs[::EVERY]])
    yield (
        f"from coarse to fine, {FINE} vertices, {len(coarse)} pairs: exactly the least",
        _share(coarse == 0.0),
    )
    yield "... misses it by at most", _percent(coarse, 100)


def _share(condition: np.ndarray) -> str:
    return f"{100 * np.mean(condition):.0f} %"


def _percent(values: np.ndarray, at: int) -> str:
    value = 100 * np.percentile(values, at)
    return f"{value:.0f} %" if value >= 10 else f"{value:.2g} %"


if __name__ == "__main__":
    print(Table(("what", "measured"), list(rows())).markdown(), end="")
