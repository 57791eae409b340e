"""Whether a drawing has letters: text, or a row of parts as letters are that became outlines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.model import Box

if TYPE_CHECKING:
    from shapeblend_cli.anatomy.decompose import PlacedDrawing

ROW = 3
"""Minimum number of parts side by side that are a row of letters."""

TALL = 0.5
"""Minimum height of each of them, as a share of the tallest one's."""


def has_letters(drawing: PlacedDrawing) -> bool:
    """Return whether a drawing has text, or is a row of parts side by side, as letters are that became outlines."""
    if any(shape.element == "text" for shape in drawing.drawing.shapes):
        return True
    columns: list[Box] = []
    for box in sorted(contour.box for contour in drawing.contours):
        if columns and box.x < columns[-1].x + columns[-1].width:
            columns[-1] = Box.union([columns[-1], box])
        else:
            columns.append(box)
    heights = [box.height for box in columns]
    return len(columns) >= ROW and min(heights) >= TALL * max(heights)
