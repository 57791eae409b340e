"""Make limbs and morphs of known truth into a folder, a split each."""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING

from tools.quality.data import ROOT
from tools.quality.morphs import articulated, authored
from tools.quality.npm import PACKAGES
from tools.quality.truth.form import SETS
from tools.quality.truth.write import write

if TYPE_CHECKING:
    from pathlib import Path

FOLDER = ROOT / "out" / "morphs"


def make(folder: Path) -> None:
    """Write both splits, and whose drawings they are."""
    write(folder / "articulated", {"single": articulated.morphs()})
    write(folder / "authored", {name: authored.morphs(name) for name in SETS})
    shutil.copy(PACKAGES / "LICENCE.md", folder)
