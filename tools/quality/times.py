"""Measure: how long a pair takes alone, by a command of its own, and among many, beside libraries run by node."""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from tools.quality.data import SETS, icon_pairs, svg
from tools.quality.peers import arc_length, flubber, kute, polymorph, shapeblend
from tools.quality.peers.node import INSTALLED, Library
from tools.quality.scores import STEPS
from tools.quality.tables import NONE, Section, Table

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from tools.quality.data import Pair

EVERY = {"single": 8, "whole": 8}
"""One pair in so many is measured alone."""

RUNS, RUNS_OF_MANY = 5, 3

TIMES = [k / STEPS for k in range(1, STEPS)]

TIMED = (flubber.FINE, kute.FINE, kute.OF_CURVES, polymorph.FINE)
"""The libraries, each but with the coarser of its settings."""

TEXT = f"""\
{STEPS - 1} in-betweens a pair. *Seconds* pass until the command is back. Beside them is the time of processors: more
where several work at once, less where other programs need them.

- *alone*: a whole command for one pair, start-up included. Every eighth pair is measured, by turns with all tools: the
  best of {RUNS} runs, and the median of these over the pairs. shapeblend: `shapeblend a.svg b.svg -n {STEPS - 1}`,
  which reads two files and writes {STEPS - 1}. The libraries: `node` with a script that reads and writes path data.
- *in bulk*: one command for all pairs, start-up included once. The best of {RUNS_OF_MANY} runs is divided by the number
  of pairs. shapeblend: `shapeblend batch jobs.jsonl -j 1 -n {STEPS - 1}`, which blends in one process, writes as many
  files, and keeps a record of each blend. The libraries: the same script. Even arc length: a function that is called
  for each pair.

Programs in Python and in JavaScript do not compare well: shapeblend starts Python, reads and writes files, and searches
for the best correspondence; the libraries are made to blend while a page is shown. Take the ratios as rough, and those
of processor time as better than those of seconds, which depend on what else the machine does."""

ALONE = "processor time of a whole command, icons of one contour, as a multiple of flubber's, median"
IN_BULK = "... of a pair among many in one run"


class Seconds(NamedTuple):
    """How long something took, and how long processors worked for it."""

    wall: float
    cpu: float


def measured() -> dict:
    """Seconds of all tools that run here."""
    libraries = [library for library in TIMED if library.ready() is None]
    found = {}
    for name, every in EVERY.items():
        pairs = icon_pairs(name)
        found[name] = {
            "pairs": [pair.id for pair in pairs[::every]],
            "alone": alone(pairs[::every], libraries),
            "many": len(pairs),
            "bulk": bulk(pairs, libraries),
        }
    return found


def alone(pairs: Sequence[Pair], libraries: Sequence[Library]) -> dict[str, dict[str, list[float]]]:
    """Return seconds by tool, a number a pair; the tools take turns, so that what else goes on falls on all."""
    ways: dict[str, Callable[[Sequence[Pair], Path], Seconds]] = {shapeblend.NAME: ours}
    ways |= {library.name: theirs(library) for library in libraries}
    best: dict[str, list[Seconds]] = {name: [] for name in ways}
    for pair in pairs:
        turns = [{name: _in_a_folder(way, [pair]) for name, way in ways.items()} for _ in range(RUNS)]
        for name in ways:
            best[name].append(min(turn[name] for turn in turns))
    return {name: _columns(seconds) for name, seconds in best.items()}


def bulk(pairs: Sequence[Pair], libraries: Sequence[Library]) -> dict[str, dict[str, list[float]]]:
    """Return seconds by tool, for all pairs together."""
    ways: dict[str, Callable[[Sequence[Pair], Path], Seconds]] = {shapeblend.NAME: ours_in_bulk}
    ways |= {library.name: theirs(library) for library in libraries}
    ways[arc_length.NAME] = evenly
    turns = [{name: _in_a_folder(way, pairs) for name, way in ways.items()} for _ in range(RUNS_OF_MANY)]
    return {name: _columns([min(turn[name] for turn in turns)]) for name in ways}


def _columns(seconds: Iterable[Seconds]) -> dict[str, list[float]]:
    columns = zip(*seconds, strict=True)
    return {
        name: [round(x, 4) for x in column] for name, column in zip(Seconds._fields, columns, strict=True)
    }


def _in_a_folder(way: Callable[[Sequence[Pair], Path], Seconds], pairs: Sequence[Pair]) -> Seconds:
    with tempfile.TemporaryDirectory() as folder:
        return way(pairs, Path(folder))


def _run(command: list[str], **options: Any) -> Seconds:
    """Run a command to its end."""
    before, began = _worked(), time.perf_counter()
    subprocess.run(command, check=True, **options)
    return Seconds(time.perf_counter() - began, _worked() - before)


def _worked() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def ours(pairs: Sequence[Pair], folder: Path) -> Seconds:
    """Blend one pair by the command."""
    (row,) = _written(pairs, folder)
    return _shapeblend(row["a"], row["b"], "--output", row["o"], folder=folder)


def ours_in_bulk(pairs: Sequence[Pair], folder: Path) -> Seconds:
    """Blend all pairs by the command, in one process that works."""
    rows = "".join(f"{json.dumps(row)}\n" for row in _written(pairs, folder))
    (folder / "jobs.jsonl").write_text(rows, encoding="utf-8")
    return _shapeblend("batch", "jobs.jsonl", "--jobs", "1", folder=folder)


def _written(pairs: Sequence[Pair], folder: Path) -> list[dict[str, str]]:
    """Write the drawings, and return what becomes of them as rows of a manifest."""
    rows = []
    for k, pair in enumerate(pairs):
        rows.append({"a": f"{k}-a.svg", "b": f"{k}-b.svg", "o": f"frames-{k}"})
        (folder / f"{k}-a.svg").write_text(svg(pair.a), encoding="utf-8")
        (folder / f"{k}-b.svg").write_text(svg(pair.b), encoding="utf-8")
    return rows


def _shapeblend(*arguments: str, folder: Path) -> Seconds:
    command = [sys.executable, "-m", "shapeblend_cli", *arguments, "--quiet", "--frames", str(STEPS - 1)]
    return _run(command, cwd=folder)


def theirs(library: Library) -> Callable[[Sequence[Pair], Path], Seconds]:
    """Return what blends pairs with a library."""

    def run(pairs: Sequence[Pair], folder: Path) -> Seconds:
        with (folder / "frames").open("w", encoding="utf-8") as out:
            text = library.lines(pairs, TIMES)
            return _run(library.command, cwd=INSTALLED, input=text, stdout=out, text=True)

    return run


def evenly(pairs: Sequence[Pair], folder: Path) -> Seconds:
    """Blend all pairs at even arc length."""
    before, began = time.process_time(), time.perf_counter()
    frames = [line for pair in pairs for line in arc_length.path_data(pair, TIMES)]
    (folder / "frames").write_text("\n".join(frames), encoding="utf-8")
    return Seconds(time.perf_counter() - began, time.process_time() - before)


def section(found: dict) -> Section:
    rows = []
    for name, timed in found.items():
        for tool, many in timed["bulk"].items():
            row = [SETS[name], tool, *[NONE] * 3, str(timed["many"])]
            if tool in timed["alone"]:
                few = timed["alone"][tool]
                row[2:5] = [str(len(few["wall"])), *(_told(np.median(few[key])) for key in ("wall", "cpu"))]
            rows.append(row + [_told(many[key][0] / timed["many"]) for key in ("wall", "cpu")])
    header = [
        "pairs of icons",
        "tool",
        "alone: pairs",
        "seconds",
        "of processors",
        "in bulk: pairs",
        "seconds a pair",
        "of processors",
    ]
    single = found["single"]
    brief = [(name, _multiples(single[way])) for name, way in ((ALONE, "alone"), (IN_BULK, "bulk"))]
    return Section("Time", TEXT, Table(header, rows), brief)


def _multiples(seconds: dict[str, dict[str, list[float]]]) -> dict[str, str]:
    """Return the processor time of each tool as a multiple of flubber's, without decimals from 1 on."""
    one = np.array(seconds[flubber.NAME]["cpu"])
    ratios = {tool: float(np.median(np.array(each["cpu"]) / one)) for tool, each in seconds.items()}
    told = {
        tool: f"about {ratio:.0f}" if ratio >= 0.95 else f"about {ratio:.1g}"
        for tool, ratio in ratios.items()
    }
    return {**told, flubber.NAME: "1"}


def _told(seconds: float) -> str:
    """Return a time with two digits or three."""
    milliseconds = 1000.0 * seconds
    if milliseconds < 9.95:
        return f"{milliseconds:.1f} ms"
    return f"{milliseconds:.0f} ms" if milliseconds < 99.5 else f"{seconds:.2f} s"
