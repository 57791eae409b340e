"""Drawings side by side in one picture."""

from __future__ import annotations

import io
import math
from typing import TYPE_CHECKING

from PIL import Image, ImageColor

from shapeblend_cli.outputs.raster import Size, check_pixels, drawn, opened

if TYPE_CHECKING:
    from collections.abc import Sequence

PAGE, CELL, CLEAR = "#e4e4e1", "#ffffff", "#ffffff00"

ONE_ROW = 8
"""So many drawings stand side by side."""

WIDEST = 1.6
"""How much more columns than rows there may be beyond that, about."""


def columns_for(count: int) -> int:
    """A number of columns that leaves little room empty, and rather wide sheets than high ones.

    Examples
    --------
    >>> [columns_for(count) for count in (1, 7, 9, 10, 11, 24, 100)]
    [1, 7, 3, 5, 6, 8, 10]
    """
    if count <= ONE_ROW:
        return count
    root = math.sqrt(count)
    choices = range(math.ceil(root), math.ceil(WIDEST * root) + 1)
    return min(choices, key=lambda columns: (-count % columns, -columns))


def sheet(
    svgs: Sequence[str],
    cell: Size,
    columns: int | None = None,
    ground: str | None = CELL,
    page: str | None = PAGE,
) -> Image.Image:
    """All drawings in rows, each in a cell of its own.

    Parameters
    ----------
    svgs : sequence of str
        Documents without an XML declaration, at least one.
    cell : Size
        Drawings are fitted into it as large as they can be.
    columns : int, optional
        By default as many as look well.
    ground, page : str or None
        Colours behind the drawings and between the cells; None is transparent.

    Raises
    ------
    PictureError
        More pixels than there is reason for.
    """
    columns = min(columns or columns_for(len(svgs)), len(svgs))
    rows = -(-len(svgs) // columns)
    gap = max(1, cell.width // 20)
    step = Size(cell.width + gap, cell.height + gap)
    size = Size(columns * step.width + gap, rows * step.height + gap)
    check_pixels(1, size)
    found = Image.new("RGBA", size, page or CLEAR)
    for k, svg in enumerate(svgs):
        at = gap + (k % columns) * step.width, gap + (k // columns) * step.height
        found.paste(
            ImageColor.getcolor(ground or CLEAR, "RGBA"), (*at, at[0] + cell.width, at[1] + cell.height)
        )
        found.alpha_composite(opened(drawn(svg, cell)), at)
    return found.convert("RGB") if page and ground else found


def as_png(image: Image.Image) -> bytes:
    """The file of a picture."""
    file = io.BytesIO()
    image.save(file, "PNG", optimize=True)
    return file.getvalue()
