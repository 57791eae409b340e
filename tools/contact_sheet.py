"""Drawings side by side, as the pictures of the documents have them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.outputs.contact_sheet import contact_sheet
from shapeblend_cli.outputs.raster import Size

if TYPE_CHECKING:
    from PIL import Image

GROUND, PAGE = "#f6f6f4", "#ffffff"


def sheet(svgs: list[str], columns: int, cell: int) -> Image.Image:
    """All drawings in rows of `columns`, each in a square of `cell` pixels."""
    return contact_sheet(svgs, Size(cell, cell), columns, ground=GROUND, page=PAGE)
