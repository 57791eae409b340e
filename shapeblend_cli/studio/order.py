"""What a process of the studio is asked to do."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

from shapeblend_cli.rows.project import Project
from shapeblend_cli.system.write import is_inside, real_path


class Consent(NamedTuple):
    """What may be written: new files in a folder, and else only files that the person at the page has agreed to."""

    folder: str = ""
    agreed: frozenset[str] = frozenset()

    def asks(self, targets: Iterable[Path]) -> dict[str, list[str]]:
        """Return the files to ask about: those outside the folder, and those in it that exist."""
        named = [name for name in map(real_path, targets) if name not in self.agreed]
        outside = [name for name in named if not is_inside(Path(name), self.folder)]
        return {"outside": outside, "existing": [name for name in named if os.path.lexists(name)]}


class Order(NamedTuple):
    """Something to do with a project, and the drawings that were dropped into the page, by name."""

    what: str  # of `answers.ORDERS`
    project: Project
    sources: Mapping[str, bytes]
    consent: Consent = Consent()
