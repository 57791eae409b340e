"""Sets of icons that npm installs, and the files that draw them."""

from __future__ import annotations

import functools
import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pathlib import Path


@functools.cache
def icon_set(installed: Path, name: str) -> dict[str, Any]:
    """Return what a set of icons has, of those installed in a folder."""
    file = installed / "node_modules" / "@iconify-json" / name / "icons.json"
    return json.loads(file.read_text(encoding="utf-8"))


def icon_file(installed: Path, icons: str, name: str) -> str:
    """Return the document that draws an icon of a set."""
    known = icon_set(installed, icons)
    icon = known["icons"][name]
    width, height = (icon.get(side, known.get(side, 16)) for side in ("width", "height"))
    box = f"{icon.get('left', 0)} {icon.get('top', 0)} {width} {height}"
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">{icon["body"]}</svg>'
