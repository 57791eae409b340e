"""Make limbs and morphs of known truth into a folder, a split each: python -m tools.quality.morphs.make [DIR]."""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path

from tools.quality.data import ROOT
from tools.quality.morphs import articulated, authored
from tools.quality.morphs.packages import HERE, ready
from tools.quality.truth.form import SETS
from tools.quality.truth.write import write

FOLDER = ROOT / "out" / "morphs"

SPLITS = {"articulated": "limbs turned", "authored": "authored morphs"}
"""The splits, and what is in each."""


def make(folder: Path) -> None:
    """Write both splits, and whose drawings they are."""
    write(folder / "articulated", {"single": articulated.morphs()})
    write(folder / "authored", {name: authored.morphs(name) for name in SETS})
    shutil.copy(HERE / "LICENCE.md", folder)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", default=FOLDER)
    folder = parser.parse_args().folder
    if problem := ready():
        raise SystemExit(f"no morphs: {problem}")
    make(folder)
    print(folder)


if __name__ == "__main__":
    main()
