"""Measure whole commands beside the bare imports of NumPy and click: python -m tools.commands [FOLDER [OPTION ...]].

FOLDER has pairs.json as docs/icons has, which is the default; the options go to the command. Times are of the
processor, the least of `ROUNDS`; both kinds of command take turns.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

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


def seconds(arguments: Sequence[str]) -> float:
    """Return the seconds that processors work for a command of Python."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *arguments], check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def multiples(folder: Path, options: Sequence[str]) -> dict[str, float]:
    """Return what the commands of a folder's pairs take, as multiples of the imports, by the names of the pairs."""
    found = {}
    with tempfile.TemporaryDirectory() as out:
        for pair in json.loads((folder / "pairs.json").read_text("utf-8")):
            files = [str(folder / pair[side]) for side in "ab"]
            command = ["-m", "shapeblend_cli", *files, "-q", "--force", "-o", f"{out}/x.svg", *options]
            runs = [(seconds(command), seconds(IMPORTS)) for _ in range(ROUNDS)]
            ours, imports = map(min, zip(*runs, strict=True))
            found[pair["id"]] = ours / imports
    return found


def main(arguments: Sequence[str]) -> None:
    """Measure the pairs of a folder."""
    found = multiples(Path(arguments[0]) if arguments else FOLDER, arguments[1:])
    print(f"processor time of {len(found)} commands, as multiples of that of importing NumPy and click")
    for what, share in {"median": 50, "95 %": 95, "slowest": 100}.items():
        print(f"{what:10}{np.percentile([*found.values()], share):8.2f}")
    for name in sorted(found, key=found.__getitem__, reverse=True)[:SLOWEST]:
        print(f"  {found[name]:8.2f}  {name}")


if __name__ == "__main__":
    main(sys.argv[1:])
