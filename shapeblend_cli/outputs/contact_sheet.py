"""All frames side by side in one PNG."""

from __future__ import annotations

import io
import math
from typing import TYPE_CHECKING

from shapeblend_cli.errors import OptionError
from shapeblend_cli.outputs.composed import Composed, draw_all
from shapeblend_cli.outputs.formats import WHITE, OutputSpec, Rendered, frame_svgs
from shapeblend_cli.outputs.pixels import Size, check_pixels, read_png, size_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from PIL import Image

    from shapeblend_cli.model import Pair

PAGE, CLEAR = "#e4e4e1", "#ffffff00"

ONE_ROW = 8
"""Maximum number of drawings that stand in a single row."""

WIDEST = 1.6
"""Maximum ratio of columns to rows of a larger sheet, about."""


def columns_for(count: int) -> int:
    """Return a number of columns that leaves few cells empty; sheets are rather wide than high.

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


def contact_sheet(
    svgs: Sequence[str | Composed],
    cell: Size,
    columns: int | None = None,
    ground: str | None = WHITE,
    page: str | None = PAGE,
) -> Image.Image:
    """Return a picture of one or more drawings in rows, each in a cell of its own.

    The default number of columns is that of `columns_for`. Colours of None, behind the drawings and between the cells,
    are transparent. Raises PictureError if the picture has too many pixels.
    """
    from PIL import Image, ImageColor

    columns = min(columns or columns_for(len(svgs)), len(svgs))
    rows = -(-len(svgs) // columns)
    gap = max(1, cell.width // 20)
    step = Size(cell.width + gap, cell.height + gap)
    size = check_pixels(Size(columns * step.width + gap, rows * step.height + gap))
    sheet = Image.new("RGBA", size, page or CLEAR)
    for k, drawn in enumerate(draw_all(svgs, cell)):
        x, y = gap + (k % columns) * step.width, gap + (k // columns) * step.height
        sheet.paste(ImageColor.getcolor(ground or CLEAR, "RGBA"), (x, y, x + cell.width, y + cell.height))
        sheet.alpha_composite(read_png(drawn), (x, y))
    return sheet.convert("RGB") if page and ground else sheet


def render(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    """Return the picture."""
    cell, ground = size_of(spec.width, pairs, spec.frame_count), spec.ground
    sheet = contact_sheet(frame_svgs(spec, pairs), cell, spec.columns, ground, PAGE if ground else None)
    file = io.BytesIO()
    sheet.save(file, "PNG", optimize=True)
    return Rendered([file.getvalue()])


def check(spec: OutputSpec) -> None:
    """Raise OptionError where there are no frames."""
    if not spec.frame_count:
        raise OptionError("--frames 0 leaves nothing for a contact sheet; --frames 1 or --ends would work")
