"""Libraries that morph paths in web pages, run by node.

npm installs them into `out/npm`. Each has a script here, which gets a line of JSON a
pair and answers with path data at the times that were asked for.
"""

from __future__ import annotations

import functools
import json
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tools.quality.data import Pair, pieces, polygon, subpaths, vertices
from tools.quality.npm import INSTALLED, PACKAGES, install
from tools.quality.scores import STEPS, area
from tools.quality.truth.form import TIMES, Linked, Truth

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import numpy as np

    from tools.quality.scores import Frame

HERE = Path(__file__).parent
RUN = "run.mjs"

VERTICES = 120
"""Where a library takes a longest side, the longest contour gets about so many."""


def version(package: str) -> str:
    """Return which version of a package is installed."""
    known = json.loads((PACKAGES / "package.json").read_text(encoding="utf-8"))
    return known["dependencies"][package]


@dataclass(frozen=True)
class Library:
    """A library with its settings.

    Attributes
    ----------
    name : str
        What it is called in tables.
    script : str
        The script that runs it, without the suffix.
    job : callable
        Gives what the script is told of a pair.
    """

    name: str
    script: str
    job: Callable[[Pair], dict[str, Any]]

    def ready(self) -> str | None:
        """Install it, or return why it cannot run here."""
        return install() or _starts(self.script)

    def lines(self, pairs: Sequence[Pair], times: Sequence[float]) -> str:
        """Return what the script gets on standard input."""
        return "".join(f"{json.dumps({**self.job(pair), 'times': times})}\n" for pair in pairs)

    @property
    def command(self) -> list[str]:
        """What runs it in the folder `INSTALLED`."""
        return ["node", RUN, self.script]

    def path_data(self, pairs: Sequence[Pair], times: Sequence[float]) -> list[list[str] | None]:
        """Return the frames of each pair as the library writes them, or None where it fails."""
        done = subprocess.run(
            self.command,
            cwd=INSTALLED,
            input=self.lines(pairs, times),
            stdout=subprocess.PIPE,
            text=True,
            check=True,
        )
        return [json.loads(line).get("frames") for line in done.stdout.splitlines()]

    def blends(self, pairs: Sequence[Pair]) -> list[list[list[np.ndarray]] | None]:
        """Return the frames of each pair at even times, as polygons."""
        return [
            frames and list(map(contours, frames))
            for frames in self.path_data(pairs, [k / STEPS for k in range(STEPS + 1)])
        ]

    def linked(self, truths: Sequence[Truth]) -> list[Linked | None]:
        """Return in-betweens of each pair beside what goes where."""
        pairs = [truth.pair for truth in truths]
        each = zip(self.path_data(pairs, TIMES), self.links(pairs), strict=True)
        return [
            frames
            and Linked([contours(frame) for frame in frames], links or [], pieces(frames[TIMES.index(0.5)]))
            for frames, links in each
        ]

    def links(self, pairs: Sequence[Pair]) -> list[list[tuple[np.ndarray, np.ndarray]] | None]:
        """Return what goes where, which the first and the last frame say: both have the same vertices."""
        return [
            frames and list(zip(*map(contours, frames), strict=True))
            for frames in self.path_data(pairs, [0.0, 1.0])
        ]


def contours(data: str) -> Frame:
    """Return the vertices of path data, a contour each."""
    return [vertices(subpath) for subpath in subpaths(data)]


@functools.cache
def _starts(script: str) -> str | None:
    """Put a script beside its library and start it without jobs, or return why it does not start."""
    for name in (RUN, f"{script}.mjs"):
        if not (there := INSTALLED / name).exists() or there.read_bytes() != (HERE / name).read_bytes():
            shutil.copyfile(HERE / name, there)
    done = subprocess.run(
        ["node", RUN, script], cwd=INSTALLED, input="", capture_output=True, text=True, check=False
    )
    return "it does not start in this version of node" if done.returncode else None


def largest(pair: Pair) -> tuple[list[str], list[str]]:
    """Return as many contours of both as the one with fewer has, the largest first."""
    a, b = (sorted(subpaths(data), key=lambda d: area(polygon(d)), reverse=True) for data in (pair.a, pair.b))
    count = min(len(a), len(b))
    return a[:count], b[:count]


def longest_side(pair: Pair) -> float:
    """Return the side that gives the longest contour about `VERTICES` vertices."""
    lengths = [_perimeter(polygon(contour)) for data in (pair.a, pair.b) for contour in subpaths(data)]
    return max(lengths) / VERTICES


def _perimeter(contour: np.ndarray) -> float:
    return float(abs(contour - [*contour[1:], contour[0]]).sum())
