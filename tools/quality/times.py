"""Measure: how long a pair takes alone, by a command of its own, and among many, beside libraries run by node."""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from tools.quality.data import icon_pairs, svg
from tools.quality.npm import INSTALLED
from tools.quality.peers import LIBRARIES, flubber, shapeblend
from tools.quality.peers.node import Library
from tools.quality.scores import STEPS
from tools.quality.tables import Brief, Section, Table

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from tools.quality.data import Pair
    from tools.quality.peers import Tool

    Way = Callable[[Sequence[Pair], Path], float]

EVERY = 8
"""One pair in this many is measured alone."""

RUNS, RUNS_OF_MANY = 5, 3

TIMES = [k / STEPS for k in range(1, STEPS)]

TEXT = f"""\
Processor time of {STEPS - 1} in-betweens a pair, of icons of one contour.

- *alone*: a whole command for one pair, start-up included. Every eighth pair is measured, by turns with all tools: the
  best of {RUNS} runs, and the median of these over the pairs. shapeblend: `shapeblend a.svg b.svg -n {STEPS - 1}`,
  which reads two files and writes {STEPS - 1}. The libraries: `node` with a script that reads and writes path data.
- *among many*: one command for all pairs, start-up included once. The best of {RUNS_OF_MANY} runs is divided by the
  number of pairs. shapeblend: `shapeblend batch jobs.jsonl -j 1 -n {STEPS - 1}`, which blends in one process, writes as
  many files, and keeps a record of each blend. The libraries: the same script.

Programs in Python and in JavaScript do not compare well: shapeblend starts Python, reads and writes files, and searches
for the best correspondence; the libraries are made to blend while a page is shown. Take the ratios as rough."""

ALONE = "processor time of a whole command, icons of one contour, as a multiple of flubber's, median"
AMONG_MANY = "... of a pair among many in one run"


def measured(tools: Sequence[Tool]) -> dict:
    """Return seconds by tool, a number a pair where each is measured alone; the tools take turns."""
    pairs = icon_pairs("single")
    run = {library.name: theirs(library) for library in LIBRARIES}
    ways = {shapeblend.NAME: ours, **run}
    alone: dict[str, list[float]] = {name: [] for name in ways}
    for pair in pairs[::EVERY]:
        for name, seconds in _best(ways, [pair], RUNS).items():
            alone[name].append(seconds)
    many = _best({shapeblend.NAME: ours_in_bulk, **run}, pairs, RUNS_OF_MANY)
    return {"pairs": len(pairs), "alone": alone, "many": many}


def _best(ways: dict[str, Way], pairs: Sequence[Pair], runs: int) -> dict[str, float]:
    turns = [{name: _in_a_folder(way, pairs) for name, way in ways.items()} for _ in range(runs)]
    return {name: round(min(turn[name] for turn in turns), 4) for name in ways}


def _in_a_folder(way: Way, pairs: Sequence[Pair]) -> float:
    with tempfile.TemporaryDirectory() as folder:
        return way(pairs, Path(folder))


def processor_time(command: list[str], **options: Any) -> float:
    """Run a command; return the seconds that processors worked for it."""
    before = _worked()
    subprocess.run(command, check=True, **options)
    return _worked() - before


def _worked() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def ours(pairs: Sequence[Pair], folder: Path) -> float:
    """Blend one pair by the command."""
    (row,) = written(pairs, folder)
    return _shapeblend(row["a"], row["b"], "--output", row["o"], folder=folder)


def ours_in_bulk(pairs: Sequence[Pair], folder: Path) -> float:
    """Blend all pairs by the command, in one process that works."""
    rows = "".join(f"{json.dumps(row)}\n" for row in written(pairs, folder))
    (folder / "jobs.jsonl").write_text(rows, encoding="utf-8")
    return _shapeblend("batch", "jobs.jsonl", "--jobs", "1", folder=folder)


def written(pairs: Sequence[Pair], folder: Path) -> list[dict[str, str]]:
    """Write the drawings, and return what becomes of them as rows of a manifest."""
    rows = []
    for k, pair in enumerate(pairs):
        rows.append({"a": f"{k}-a.svg", "b": f"{k}-b.svg", "o": f"frames-{k}"})
        (folder / f"{k}-a.svg").write_text(svg(pair.a), encoding="utf-8")
        (folder / f"{k}-b.svg").write_text(svg(pair.b), encoding="utf-8")
    return rows


def _shapeblend(*arguments: str, folder: Path) -> float:
    command = [sys.executable, "-m", "shapeblend_cli", *arguments, "--quiet", "--frames", str(STEPS - 1)]
    return processor_time(command, cwd=folder)


def theirs(library: Library, times: Sequence[float] = TIMES) -> Way:
    """Return what blends pairs with a library, and writes in-betweens at these times."""

    def run(pairs: Sequence[Pair], folder: Path) -> float:
        with (folder / "frames").open("w", encoding="utf-8") as out:
            text = library.lines(pairs, times)
            return processor_time(library.command, cwd=INSTALLED, input=text, stdout=out, text=True)

    return run


def section(found: dict) -> Section:
    alone = {tool: np.array(seconds) for tool, seconds in found["alone"].items()}
    many = {tool: np.array([seconds / found["pairs"]]) for tool, seconds in found["many"].items()}
    rows = [
        [
            tool,
            *(f"{1000 * np.median(each[tool]):.1f} ms" for each in (alone, many)),
        ]
        for tool in many
    ]
    brief = [
        Brief(ALONE, _multiples(alone), "Processor time of one blend, compared with flubber"),
        Brief(AMONG_MANY, _multiples(many), "... of each blend in a run of many"),
    ]
    return Section("Time", TEXT, Table(("tool", "alone", "among many"), rows), brief)


def _multiples(seconds: dict[str, np.ndarray]) -> dict[str, str]:
    """Return the time of each tool as a multiple of flubber's, without decimals from 1 on."""
    ratios = {tool: float(np.median(each / seconds[flubber.NAME])) for tool, each in seconds.items()}
    told = {tool: f"about {ratio:.{0 if ratio >= 0.95 else 1}f}" for tool, ratio in ratios.items()}
    return {**told, flubber.NAME: "1"}
