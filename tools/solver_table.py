"""Measure the solver and write docs/solver.md: solver_table.py, no arguments. Takes about a minute."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.normalise import to_unit_box
from shapeblend_cli.geometry.outline import direction, reversed_polygon
from shapeblend_cli.match import starts
from shapeblend_cli.match.solve import least_work
from shapeblend_cli.match.work import Window, Wires, WorkConstants
from shapeblend_cli.svg.read import read

ROOT = Path(__file__).resolve().parents[1]
PAIRS = ROOT / "tests" / "bench" / "data" / "pairs.json"
SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="{}"/></svg>'


def icon_pairs(vertices):
    """The icon outlines in unit boxes, both in one direction."""
    for pair in json.loads(PAIRS.read_text(encoding="utf-8"))["single"]:
        contours = [read("icon", SVG.format(pair[side]).encode()).shapes[0].contours[0] for side in "ab"]
        a, b = (flatten(contour, vertices) for contour in contours)
        if direction(a) != direction(b):
            b = reversed_polygon(b)
        yield to_unit_box(a)[0], to_unit_box(b)[0]


def divide_and_conquer(p0, p1):
    """Least work by the method of Fuchs, Kedem and Uselton, which takes it that least paths never cross.

    The least path from a row in the middle is looked for only between those from the rows on both sides.
    """
    wires = Wires(p0, p1, True, WorkConstants())
    m, n = wires.m, wires.n

    def least(row, above, below):
        low, high = np.full(m + 1, row), np.full(m + 1, row + n)
        if above is not None:
            for c, r in reversed(above):
                low[c] = max(row, r)  # its first row in each column
            for c, r in below:
                high[c] = min(row + n, r)  # its last
        low, high = np.maximum.accumulate(low), np.minimum.accumulate(high[::-1])[::-1]
        return starts.least_from(starts.Search(wires, Window.between(low, np.maximum(high, low))))

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


def share(condition):
    return f"{100 * np.mean(condition):.0f} %"


def percent(values, at):
    value = 100 * np.percentile(values, at)
    return f"{value:.0f} %" if value >= 10 else f"{value:.2g} %"


def on_icons():
    """Rows on icon pairs at 200 vertices: the simplified solver, divide and conquer, time against one start."""
    above, missed, ratios = [], [], []
    for p0, p1 in icon_pairs(200):
        seconds = {}
        for start in (None, (0, 0)):
            runs = []
            for _ in range(3):
                before = time.perf_counter()
                found = least_work(p0, p1, start=start)
                runs.append(time.perf_counter() - before)
                if start is None:
                    exact = found.work
            seconds[start] = min(runs)
        ratios.append(seconds[None] / seconds[0, 0])
        above.append(least_work(p0, p1, solver="simplified").work / exact - 1.0)
        missed.append(divide_and_conquer(p0, p1) / exact - 1.0)
    above, missed = np.array(above), np.array(missed)
    return [
        ("pairs", str(len(above))),
        ("simplified solver (4.1): work above the least, median", percent(above, 50)),
        ("... 95th percentile", percent(above, 95)),
        ("... at most", percent(above, 100)),
        ("... the least after all", share(above < 1e-9)),
        ("divide and conquer of [8]: missed the least work", share(missed > 1e-9)),
        ("... by at most", percent(missed, 100)),
        ("time of all starts, proven, beside one given start, median", f"{np.median(ratios):.1f} times"),
        ("... at most", f"{max(ratios):.1f} times"),
    ]


def on_fine_icons():
    """Rows on icon pairs at 2000 vertices: coarse to fine against the exact answer."""
    above, seconds = [], {"auto": 0.0, "exact": 0.0}
    for p0, p1 in list(icon_pairs(2000))[::2]:
        work = {}
        for effort in seconds:
            before = time.perf_counter()
            work[effort] = least_work(p0, p1, effort=effort).work
            seconds[effort] += time.perf_counter() - before
        above.append(work["auto"] / work["exact"] - 1.0)
    above = np.array(above)
    return [
        (
            f"coarse to fine, 2000 vertices, {len(above)} pairs: within 1 % of the least work",
            share(above <= 0.01),
        ),
        ("... the least after all", share(above < 1e-9)),
        ("... worst", percent(above, 100)),
        ("... time beside the exact search", f"{seconds['auto'] / seconds['exact']:.1f} times"),
    ]


def unit(z):
    z = np.asarray(z, complex)
    z = z - complex(z.real.min(), z.imag.min())
    return z / max(z.real.max(), z.imag.max())


def family():
    """Shapes that look the same from many starts, or that degenerate, by name."""

    def regular(m, turn=0.0):
        return unit(np.exp(1j * (2 * np.pi * np.arange(m) / m + turn)))

    def wheel(teeth, depth, turn=0.0):
        k = np.arange(4 * teeth)
        return unit(np.where(k % 4 < 2, 1.0, 1.0 - depth) * np.exp(1j * (2 * np.pi * k / (4 * teeth) + turn)))

    def along(corners, m):
        """So many vertices evenly along each side of a polygon."""
        z = np.asarray(corners, complex)
        return unit((z[:, None] + (np.roll(z, -1) - z)[:, None] * np.arange(m) / m).ravel())

    def star(points, inner):
        k = np.arange(2 * points)
        return along(np.where(k % 2, inner, 1.0) * np.exp(1j * np.pi * k / points), 8)

    def spikes(count):
        k = np.arange(3 * count)
        return unit(np.where(k % 3 == 1, 1.0, 0.5) * np.exp(2j * np.pi * (k - (k % 3)) / (3 * count)))[
            k % 3 != 2
        ]

    return {
        "circle, 100": regular(100),
        "circle, 97": regular(97, 0.1),
        "square, 25 a side": along([0, 1, 1 + 1j, 1j], 25),
        "triangle, 33 a side": along([0, 1, 0.5 + 0.8j], 33),
        "thin rectangle": along([0, 1, 1 + 0.002j, 0.002j], 25),
        "gear, 24 teeth": wheel(24, 0.2),
        "gear, 25 teeth, turned": wheel(25, 0.25, 0.3),
        "star, 5 points": star(5, 0.4),
        "star, 12 points": star(12, 0.6),
        "spikes, 30": spikes(30),
    }


def on_family():
    """Rows on the family, every shape with every other and itself."""
    shapes = family()
    worst, sweeps, unproven, ratios = ("", 0), [], 0, []
    for name0, p0 in shapes.items():
        for name1, p1 in shapes.items():
            before = time.perf_counter()
            found = least_work(p0, p1)
            between = time.perf_counter()
            least_work(p0, p1, start=(0, 0))
            ratios.append((between - before) / (time.perf_counter() - between))
            sweeps.append(found.sweeps)
            unproven += found.gap != 0.0
            if found.sweeps > worst[1]:
                worst = f"{name0} to {name1}", found.sweeps
    return [
        ("symmetric and degenerate shapes: pairs", str(len(sweeps))),
        ("... not proven", str(unproven)),
        ("... sweeps through the graph, median", f"{np.median(sweeps):.0f}"),
        ("... at most", f"{worst[1]} ({worst[0]})"),
        ("... time beside one given start, at most", f"{max(ratios):.1f} times"),
    ]


LARGE = """
import resource, sys, time
import numpy as np
from shapeblend_cli.match.solve import least_work

def coast(m, seed):
    rng = np.random.default_rng(seed)
    angle = 2 * np.pi * np.arange(m) / m
    waves = sum(rng.normal() / k**1.1 * np.cos(k * angle + rng.uniform(0, 7)) for k in range(1, 400))
    z = np.exp(0.15 * waves + 1j * angle)
    z = z - complex(z.real.min(), z.imag.min())
    return z / max(z.real.max(), z.imag.max())

m = int(sys.argv[1])
p0, p1 = coast(m, 0), coast(m, 50)
before = time.perf_counter()
least_work(p0, p1)
print(time.perf_counter() - before, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
"""


def on_coastlines():
    """Rows on rough outlines of many vertices, each in a process of its own: time and memory."""
    rows, first = [], None
    for m in (1000, 5000, 10_000, 20_000):
        done = subprocess.run(
            [sys.executable, "-c", LARGE, str(m)], capture_output=True, text=True, check=True
        )
        seconds, megabytes = map(float, done.stdout.split())
        first = first or seconds
        rows.append((f"coastlines, {m} by {m}: time beside 1000 by 1000", f"{seconds / first:.1f} times"))
        rows.append(("... most memory of the whole process", f"{megabytes:.0f} MB"))
    return rows


def main() -> None:
    # First, because Linux counts what this process has used by then as used by those it starts.
    coastlines = on_coastlines()
    rows = [*on_icons(), *on_fine_icons(), *coastlines, *on_family()]
    table = "\n".join(f"| {what} | {value} |" for what, value in rows)
    target = ROOT / "docs" / "solver.md"
    target.write_text(
        "# The solver, measured\n\nWritten by `make tables`. Icon pairs: `tests/bench/data/pairs.json`, "
        f"200 vertices unless it says otherwise.\n\n| what | measured |\n| --- | --- |\n{table}\n",
        encoding="utf-8",
    )
    print(target.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
