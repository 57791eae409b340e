"""Drawings side by side, as the pictures of the documents have them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from shapeblend_cli.outputs.contact_sheet import contact_sheet
from shapeblend_cli.outputs.pixels import Size

if TYPE_CHECKING:
    from PIL import Image

GROUND, PAGE = "#f6f6f4", "#ffffff"


def sheet(svgs: list[str], columns: int, cell: int) -> Image.Image:
    """All drawings in rows of `columns`, each in a square of `cell` pixels, whatever size its file has."""
    return contact_sheet(
        [without_size(svg) for svg in svgs], Size(cell, cell), columns, ground=GROUND, page=PAGE
    )


def without_size(svg: str) -> str:
    """Return a document as the command writes it without the width and height of its root: its viewBox stays."""
    root, end, rest = svg.partition(">")
    return re.sub(r' (width|height)="[^"]*"', "", root) + end + rest
