"""Measure the solver and write docs/solver.json, and docs/solver.md and the figures of docs/guide.md from it.

python -m tools.solver_table, a few minutes; with `--again` nothing is measured, and the documents are made from what
docs/solver.json has.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time

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
from tools.quality.data import ROOT, icon_pairs
from tools.quality.raw import text
from tools.quality.tables import Table, with_figures

RAW, DOCUMENT, GUIDE = (ROOT / "docs" / name for name in ("solver.json", "solver.md", "guide.md"))
BEGIN, END = "<!-- solver: written by make tables -->", "<!-- end of solver -->"
DIGITS = 9
VERTICES, FINE = 200, 2000
EVERY = 2
"""Of the icons one in so many is solved with `FINE` vertices."""

WORKS = {"": WorkConstants(), "paper_": WorkConstants(**PAPER)}
"""The default work and the paper's, by what stands before the names of their records."""

SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="{}"/></svg>'


def outlines(pair, vertices):
    """Both outlines of a pair of icons in unit boxes, in one direction."""
    contours = [read("icon", SVG.format(data).encode()).shapes[0].contours[0] for data in (pair.a, pair.b)]
    a, b = (flatten(contour, vertices) for contour in contours)
    if orientation(a) != orientation(b):
        b = reverse_polygon(b, len(contours[1].segments))
    return to_unit_box(a), to_unit_box(b)


def divide_and_conquer(wires):
    """Least work by the method of Fuchs, Kedem and Uselton, which takes it that least paths never cross.

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


def share(condition):
    return f"{100 * np.mean(condition):.0f} %"


def percent(values, at):
    value = 100 * np.percentile(values, at)
    return f"{value:.0f} %" if value >= 10 else f"{value:.2g} %"


def on_icon(p0, p1):
    """What is measured on a pair: work above the least of the simplified solver, of divide and conquer; time."""
    record = {}
    for name, constants in WORKS.items():
        wires = Wires(p0, p1, constants=constants)
        exact = least_work(wires).work
        record[f"{name}simplified"] = least_work(wires, Search(solver="simplified")).work / exact - 1.0
        record[f"{name}divided"] = divide_and_conquer(wires) / exact - 1.0
    seconds = {}
    for start in (None, (0, 0)):
        runs = []
        for _ in range(3):
            before = time.perf_counter()
            least_work(Wires(p0, p1), Search(start=start))
            runs.append(time.perf_counter() - before)
        seconds[start] = min(runs)
    return {**record, "times": seconds[None] / seconds[0, 0]}


def on_fine_icon(p0, p1):
    """Coarse to fine beside the exact answer: work above the least, and the seconds of both."""
    work, seconds = {}, {}
    for effort in ("auto", "exact"):
        before = time.perf_counter()
        work[effort] = least_work(Wires(p0, p1), Search(effort=effort)).work
        seconds[effort] = time.perf_counter() - before
    return {"coarse": work["auto"] / work["exact"] - 1.0, **seconds}


def columns(records):
    """A list for each name."""
    return {name: [round(record[name], DIGITS) for record in records] for name in records[0]}


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
    """Every shape of the family with every other and itself."""
    shapes = family()
    records = []
    for p0 in shapes.values():
        for p1 in shapes.values():
            before = time.perf_counter()
            found = least_work(Wires(p0, p1))
            between = time.perf_counter()
            least_work(Wires(p0, p1), Search(start=(0, 0)))
            ratio = (between - before) / (time.perf_counter() - between)
            records.append({"sweeps": found.sweeps, "proven": int(found.gap == 0.0), "times": ratio})
    names = [f"{name0} to {name1}" for name0 in shapes for name1 in shapes]
    return {"pairs": names, **columns(records)}


LARGE = """
import resource, sys, time
import numpy as np
from shapeblend_cli.matching.solve import least_work
from shapeblend_cli.matching.work import Wires

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
least_work(Wires(p0, p1))
print(time.perf_counter() - before, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
"""


def on_coastlines():
    """Time and memory on rough outlines of many vertices, each in a process of its own."""
    records = []
    for m in (1000, 5000, 10_000, 20_000):
        done = subprocess.run(
            [sys.executable, "-c", LARGE, str(m)], capture_output=True, text=True, check=True
        )
        seconds, megabytes = map(float, done.stdout.split())
        records.append({"vertices": m, "seconds": seconds, "megabytes": megabytes})
    return columns(records)


def measured():
    # First, because Linux counts what this process has used by then as used by those it starts.
    coastlines = on_coastlines()
    pairs = icon_pairs("single")
    return {
        "icons": columns([on_icon(*outlines(pair, VERTICES)) for pair in pairs]),
        "fine": columns([on_fine_icon(*outlines(pair, FINE)) for pair in pairs[::EVERY]]),
        "coastlines": coastlines,
        "family": on_family(),
    }


def rows(found):
    """The lines of docs/solver.md."""
    simplified, divided, of_paper, divided_paper, times = (
        np.array(found["icons"][name])
        for name in ("simplified", "divided", "paper_simplified", "paper_divided", "times")
    )
    coarse = np.array(found["fine"]["coarse"])
    family, coast = found["family"], found["coastlines"]
    most = int(np.argmax(family["sweeps"]))
    first = coast["seconds"][0]
    return {
        "pairs": str(len(simplified)),
        "simplified solver (section 4.1): work above the least, median": percent(simplified, 50),
        "... 95th percentile": percent(simplified, 95),
        "... at most": percent(simplified, 100),
        "... no work above it": share(simplified < 1e-9),
        "... with the paper's work: median": percent(of_paper, 50),
        "... with the paper's work: 95th percentile": percent(of_paper, 95),
        "divide and conquer, as in the paper: does not find the least work": share(divided > 1e-9),
        "... with the paper's work": share(divided_paper > 1e-9),
        "... with the paper's work: misses it by at most": percent(divided_paper, 100),
        "time for all starts, with proof, compared with one given start: median": f"{np.median(times):.1f} times",
        "... longest": f"{times.max():.1f} times",
        f"coarse to fine, {FINE} vertices, {len(coarse)} pairs: within 1 % of the least work": share(
            coarse <= 0.01
        ),
        "... exactly the least": share(coarse < 1e-9),
        "... worst": percent(coarse, 100),
        "... time compared with the exact search": (
            f"{sum(found['fine']['auto']) / sum(found['fine']['exact']):.1f} times"
        ),
        **{
            f"coastlines, {m} by {m}: time compared with {coast['vertices'][0]} by {coast['vertices'][0]}; memory of "
            "the whole process": f"{seconds / first:.1f} times; {megabytes:.0f} MB"
            for m, seconds, megabytes in zip(*coast.values(), strict=True)
        },
        "symmetric and degenerate shapes: pairs": str(len(family["pairs"])),
        "... not proven": str(family["proven"].count(0)),
        "... sweeps through the graph, median": f"{np.median(family['sweeps']):.0f}",
        "... most sweeps": f"{family['sweeps'][most]} ({family['pairs'][most]})",
        "... time compared with one given start, longest": f"{max(family['times']):.1f} times",
    }


def document(found):
    """The text of docs/solver.md."""
    return (
        "# The solver, measured\n\nWritten by `make tables`, from [solver.json](solver.json). Icon pairs: "
        f"`tests/bench/data/pairs.json`, with {VERTICES} vertices unless a line says otherwise. The work is the "
        "default one, except where the table says it is the paper's (`--preset paper`). Polygons are given, so no "
        "common cuts are made.\n\n"
        "Divide and conquer assumes that two least paths never cross. With the paper's bending they do. With bending "
        "by turning, none did here in a way that mattered, but nothing proves that none can.\n\n"
        + Table(["what", "measured"], list(rows(found).items())).markdown()
    )


def figures(found):
    """What the guide says, with the marks around it."""
    icons, coast = found["icons"], found["coastlines"]
    large = coast["megabytes"][coast["vertices"].index(10_000)]
    told = {
        "time for all starts, with proof, compared with one given start (median)": (
            f"{np.median(icons['times']):.1f} times"
        ),
        'the simplified algorithm of section 4.1 ("virtually identical results"): work above the least': (
            f"{percent(icons['simplified'], 50)} (median)"
        ),
        "... for one pair in twenty": f"{percent(icons['simplified'], 95)} or more",
        "... with the paper's work: work above the least": (
            f"{percent(icons['paper_simplified'], 50)} (median); {percent(icons['paper_simplified'], 95)} or more "
            "for one pair in twenty"
        ),
        "divide and conquer over starts, as in the paper: does not find the least work": (
            f"for {share(np.array(icons['divided']) > 1e-9)} of the pairs"
        ),
        "... with the paper's work": f"for {share(np.array(icons['paper_divided']) > 1e-9)} of the pairs",
        f"from coarse to fine, {FINE} vertices: within 1 % of the least work": (
            f"for {share(np.array(found['fine']['coarse']) <= 0.01)} of {len(found['fine']['coarse'])} pairs"
        ),
        "memory of the whole process, 10,000 by 10,000 vertices": f"{large:.0f} MB",
    }
    return f"{BEGIN}\n\n{Table(['what', 'measured'], list(told.items())).markdown()}\n{END}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--again", action="store_true", help="make the documents anew, without measuring")
    if not parser.parse_args().again:
        RAW.write_text(f"{text(measured())}\n", encoding="utf-8")
    found = json.loads(RAW.read_text(encoding="utf-8"))
    DOCUMENT.write_text(document(found), encoding="utf-8")
    guide = GUIDE.read_text(encoding="utf-8")
    GUIDE.write_text(with_figures(guide, figures(found), BEGIN, END), encoding="utf-8")
    print(document(found))


if __name__ == "__main__":
    main()
