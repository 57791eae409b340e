"""What npm installs of icons and animations, and how it is read."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.svg.reading.read import read
from tools.quality.data import ROOT
from tools.quality.icon_sets import icon_file
from tools.quality.npm import install
from tools.quality.scores import area

if TYPE_CHECKING:
    from tools.quality.truth.write import Segments

HERE = Path(__file__).parent / "packages"
INSTALLED = ROOT / "out" / "quality" / "morphs"


def ready() -> str | None:
    """Install them, or say why that cannot be."""
    return install(HERE, INSTALLED)


def icon(family: str, name: str) -> Segments:
    """The largest contour of an icon."""
    text = icon_file(INSTALLED, family, name).replace("currentColor", "#000")
    contours = [contour for shape in read(name, text.encode()).shapes for contour in shape.contours]
    return list(max(contours, key=lambda contour: area(flatten(contour, 0).vertices)).segments)
