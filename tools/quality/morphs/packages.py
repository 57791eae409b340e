"""What npm installs of icons and animations, and how it is read."""

from __future__ import annotations

import functools
import json
from pathlib import Path
from typing import TYPE_CHECKING

from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.svg.reading.read import read
from tools.quality.data import ROOT
from tools.quality.npm import install
from tools.quality.scores import area

if TYPE_CHECKING:
    from tools.quality.truth.write import Segments

HERE = Path(__file__).parent / "packages"
INSTALLED = ROOT / "out" / "quality" / "morphs"


def ready() -> str | None:
    """Install them, or say why that cannot be."""
    return install(HERE, INSTALLED)


@functools.cache
def icons(family: str) -> dict:
    """A family of icons."""
    file = INSTALLED / "node_modules" / "@iconify-json" / family / "icons.json"
    return json.loads(file.read_text(encoding="utf-8"))


def icon(family: str, name: str) -> Segments:
    """The largest contour of an icon."""
    known = icons(family)
    drawn = known["icons"][name]
    width, height = (drawn.get(side, known.get(side, 16)) for side in ("width", "height"))
    body = drawn["body"].replace("currentColor", "#000")
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}">{body}</svg>'
    contours = [contour for shape in read(name, text.encode()).shapes for contour in shape.contours]
    return list(max(contours, key=lambda contour: area(flatten(contour, 0).vertices)).segments)
