"""flubber, the library most used to morph paths in web pages, run by node.

It is installed from the lock file beside this one into `out/`. For several contours its calls are
`interpolateAll` (as many on both sides), `separate` (one to several) and `combine` (several to one). The first takes
contours as they come, so they are given in order of size. There is no call for, say, two to four: the largest are
taken, and the rest is left out.
"""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import numpy as np

from tools.quality.data import ROOT, Pair, polygon, subpaths
from tools.quality.npm import install
from tools.quality.scores import STEPS, area
from tools.quality.truth.form import TIMES, Linked, Truth

HERE = Path(__file__).parent
INSTALLED = ROOT / "out" / "quality" / "peers"
SCRIPT = "flubber.mjs"
VERSION = json.loads((HERE / "package.json").read_text(encoding="utf-8"))["dependencies"]["flubber"]
NAME = f"flubber {VERSION}"

VERTICES = 120
"""The longest contour gets about so many."""

COARSE = f"{NAME}, sides of 10"
"""What it is called where it is left its default, a longest side of 10 units whatever the drawing's size."""


def ready() -> str | None:
    """Install it, or say why it cannot run here."""
    return install(HERE, INSTALLED, SCRIPT)


def blends(pairs: list[Pair], own_sides: bool = False) -> list[list[list[np.ndarray]] | None]:
    return points(pairs, [k / STEPS for k in range(STEPS + 1)], own_sides)


def linked(truths: list[Truth], own_sides: bool = False) -> list[Linked | None]:
    """In-betweens beside what goes where, which its first and last frame say: both have the same vertices."""
    blends = points([truth.pair for truth in truths], [0.0, *TIMES, 1.0], own_sides)
    return [frames and _linked(frames) for frames in blends]


def _linked(frames: list[list[np.ndarray]]) -> Linked:
    first, *between, last = frames
    middle = between[TIMES.index(0.5)]
    return Linked(between, list(zip(first, last, strict=True)), sum(len(ring) for ring in middle))


def points(pairs: list[Pair], times: list[float], own_sides: bool) -> list[list[list[np.ndarray]] | None]:
    """For each pair, the frames as polygons."""
    return [
        frames and [[np.array(ring) @ [1, 1j] for ring in frame] for frame in frames]
        for frames in _run(pairs, times, strings=False, own_sides=own_sides)
    ]


def path_data(pairs: list[Pair], times: list[float], own_sides: bool) -> list[list[str] | None]:
    """For each pair, the frames as the library writes them.

    Parameters
    ----------
    pairs, times : list
    own_sides : bool
        Leave the length of sides to the library.
    """
    return _run(pairs, times, strings=True, own_sides=own_sides)


def _run(pairs: list[Pair], times: list[float], strings: bool, own_sides: bool) -> list:
    jobs = "".join(f"{json.dumps(job(pair, times, strings, own_sides))}\n" for pair in pairs)
    done = subprocess.run(
        ["node", SCRIPT], cwd=INSTALLED, input=jobs, stdout=subprocess.PIPE, text=True, check=True
    )
    return [json.loads(line).get("frames") for line in done.stdout.splitlines()]


def job(pair: Pair, times: list[float], strings: bool, own_sides: bool) -> dict:
    """What the script is told of a pair."""
    a, b = subpaths(pair.a), subpaths(pair.b)
    longest = max(perimeter(polygon(contour)) for contour in a + b)
    if min(len(a), len(b)) > 1:
        a, b = (
            sorted(c, key=lambda d: area(polygon(d)), reverse=True)[: min(len(a), len(b))] for c in (a, b)
        )
    side = None if own_sides else longest / VERTICES
    return {"a": a, "b": b, "side": side, "times": times, "strings": strings}


def perimeter(contour: np.ndarray) -> float:
    return float(np.abs(np.diff(contour, append=contour[0])).sum())
