"""Measure: how long a whole command takes, beside flubber run by node."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from tools.quality.data import SETS, icon_pairs, svg
from tools.quality.peers import flubber, shapeblend
from tools.quality.scores import STEPS
from tools.quality.tables import Section, Table

if TYPE_CHECKING:
    from collections.abc import Callable

    from tools.quality.data import Pair

EVERY = {"single": 8, "whole": 8}
"""One pair in so many is measured."""

RUNS = 5

TEXT = f"""\
Whole commands, start-up included, by turns for every eighth pair of icons: the best of {RUNS} runs each,
and of that the median over the pairs. shapeblend: `shapeblend a.svg b.svg -n {STEPS - 1}`, which writes {STEPS - 1}
files. flubber: `node` with a script that reads path data and writes {STEPS - 1} in-betweens as path data. Only the
ratio says much, and that roughly: it depends on the machine and on what else it does."""


def measured() -> dict:
    """Seconds of both, pair by pair."""
    found = {}
    for name, every in EVERY.items():
        pairs = icon_pairs(name)[::every]
        found[name] = {
            "pairs": [pair.id for pair in pairs],
            "seconds": dict(
                zip((shapeblend.NAME, flubber.NAME), zip(*map(_seconds, pairs), strict=True), strict=True)
            ),
        }
    return found


def _seconds(pair: Pair) -> list[float]:
    """The best of both, run by turns, so that what else the machine does falls on both."""
    seconds = [[_timed(run, pair) for run in (ours, theirs)] for _ in range(RUNS)]
    return [round(min(each), 3) for each in zip(*seconds, strict=True)]


def _timed(run: Callable[[Pair, str], None], pair: Pair) -> float:
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        run(pair, folder)
        return time.perf_counter() - began


def ours(pair: Pair, folder: str) -> None:
    files = [Path(folder, "a.svg"), Path(folder, "b.svg")]
    for file, data in zip(files, (pair.a, pair.b), strict=True):
        file.write_text(svg(data), encoding="utf-8")
    command = [
        sys.executable,
        "-m",
        "shapeblend_cli",
        *map(str, files),
        "--quiet",
        "--frames",
        str(STEPS - 1),
    ]
    subprocess.run([*command, "--output", f"{folder}/frames"], check=True)


def theirs(pair: Pair, folder: str) -> None:
    times = [k / STEPS for k in range(1, STEPS)]
    job = json.dumps(flubber.job(pair, times, strings=True, own_sides=False))
    with Path(folder, "frames").open("w", encoding="utf-8") as out:
        subprocess.run(
            ["node", flubber.SCRIPT],
            cwd=flubber.INSTALLED,
            input=f"{job}\n",
            stdout=out,
            text=True,
            check=True,
        )


def section(found: dict) -> Section:
    rows, ratios = [], {}
    for name, timed in found.items():
        own, other = (np.array(timed["seconds"][tool]) for tool in (shapeblend.NAME, flubber.NAME))
        ratios[name] = f"{np.median(own / other):.1f}"
        count = str(len(own))
        rows.append([SETS[name], count, f"{np.median(own):.2f} s", f"{np.median(other):.2f} s", ratios[name]])
    header = ["pairs of icons", "pairs", shapeblend.NAME, flubber.NAME, "ratio, median"]
    brief = [
        (
            "time of a whole command, icons of one contour, as a multiple of flubber's, median",
            {shapeblend.NAME: f"about {float(ratios['single']):.0f}", flubber.NAME: "1"},
        )
    ]
    return Section("Time", TEXT, Table(header, rows), brief)
