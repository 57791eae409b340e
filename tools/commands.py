"""Measure whole commands beside the bare imports of NumPy and click: python -m tools.commands [FOLDER [OPTION ...]].

FOLDER has pairs.json as docs/icons has, which is the default; the options go to the command. Times are of the
processor, the least of `ROUNDS`; both kinds of command take turns.
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from tools.quality.data import ROOT
from tools.quality.times import processor_time

if TYPE_CHECKING:
    from collections.abc import Sequence

FOLDER = ROOT / "docs" / "icons"

ROUNDS = 3
"""Number of times that each pair is blended."""

SLOWEST = 5
"""Number of pairs that are listed, the slowest first."""

IMPORTS = ["-c", "import numpy, click"]


def multiples(folder: Path, options: Sequence[str]) -> dict[str, float]:
    """Return what the commands of a folder's pairs take, as multiples of the imports, by the names of the pairs."""
    found = {}
    with tempfile.TemporaryDirectory() as out:
        for pair in json.loads((folder / "pairs.json").read_text("utf-8")):
            files = [str(folder / pair[side]) for side in "ab"]
            command = ["-m", "shapeblend_cli", *files, "-q", "--force", "-o", f"{out}/x.svg", *options]
            runs = [
                [processor_time([sys.executable, *each], capture_output=True) for each in (command, IMPORTS)]
                for _ in range(ROUNDS)
            ]
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
