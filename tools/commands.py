"""Measure whole commands beside the bare imports of NumPy and click: python -m tools.commands [FOLDER [OPTION ...]].

FOLDER has pairs.json as docs/icons has, which is the default; the options go to the command. Times are of the
processor, and memory is what was in use at most, in MB: the least of `ROUNDS` each. Both kinds of command take turns.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tools.quality.data import ROOT

if TYPE_CHECKING:
    from collections.abc import Sequence

FOLDER = ROOT / "docs" / "icons"

ROUNDS = 3
"""Number of times that each pair is blended."""

SLOWEST = 5
"""Number of pairs that are listed, the slowest first."""

IMPORTS = ["-c", "import numpy, click"]


WATCH = """
import os, sys
_, status, used = os.wait4(os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ), 0)
print(used.ru_utime + used.ru_stime, used.ru_maxrss / 1024)
sys.exit(status != 0)
"""
"""What runs a command and prints its time and memory: alone, since a process begins with the peak of its parent."""


class Cost(NamedTuple):
    """What a command takes: its time as a multiple of that of the imports, and its memory in MB."""

    time: float
    memory: float


def costs(folder: Path, options: Sequence[str]) -> dict[str, Cost]:
    """Return what the commands of a folder's pairs take, by the names of the pairs."""
    found = {}
    with tempfile.TemporaryDirectory() as out:
        for pair in json.loads((folder / "pairs.json").read_text("utf-8")):
            files = [str(folder / pair[side]) for side in "ab"]
            command = ["-m", "shapeblend_cli", *files, "-q", "--force", "-o", f"{out}/x.svg", *options]
            runs = np.array([[_watched(each) for each in (command, IMPORTS)] for _ in range(ROUNDS)])
            ours, imports = runs.min(axis=0)
            found[pair["id"]] = Cost(ours[0] / imports[0], ours[1])
    return found


def _watched(command: Sequence[str]) -> tuple[float, ...]:
    """Run a command of Python; return the seconds that processors worked for it, and its memory in MB."""
    watch = [sys.executable, "-I", "-S", "-c", WATCH, sys.executable, *command]
    printed = subprocess.run(watch, check=True, capture_output=True, text=True).stdout
    return tuple(map(float, printed.split()))


def main(arguments: Sequence[str]) -> None:
    """Measure the pairs of a folder."""
    found = costs(Path(arguments[0]) if arguments else FOLDER, arguments[1:])
    print(
        f"{len(found)} commands: processor time as multiples of that of importing NumPy and click, and memory in MB"
    )
    for what, share in {"median": 50, "95 %": 95, "most": 100}.items():
        time, memory = np.percentile([*found.values()], share, axis=0)
        print(f"{what:10}{time:8.2f}{memory:8.1f}")
    for name in sorted(found, key=found.__getitem__, reverse=True)[:SLOWEST]:
        print(f"  {found[name].time:8.2f}{found[name].memory:8.1f}  {name}")


if __name__ == "__main__":
    main(sys.argv[1:])
