"""Drawings of one plain colour, and whether shapes paint them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.anatomy.decompose import LINE
from shapeblend_cli.model import Box, PaintedShape, Pair

if TYPE_CHECKING:
    from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing
    from shapeblend_cli.model import Shapes

SAME_PICTURE = 0.02
"""Maximum difference of a drawing and the shapes of a blend at its end, as a share of its ink."""


def is_plain(drawing: PlacedDrawing) -> bool:
    """Return whether a drawing has only fills of one plain colour, and no clips."""
    style = drawing.contours[0].style
    if style.fill is None or style.fill_gradient is not None or style.fill_opacity < 1.0:
        return False
    if any(drawing.drawing.shapes[contour.shape].clips for contour in drawing.contours):
        return False
    return all(
        contour.role != LINE and contour.style.stroke is None and contour.style.fill == style.fill
        for contour in drawing.contours
    )


def is_blend_of(shapes: Shapes, a: PlacedDrawing, b: PlacedDrawing, view: Box) -> bool:
    """Return whether shapes paint what two drawings do, at their start and at their end, but for a share of the ink."""
    return _paints_alike(shapes, 0.0, a, view) and _paints_alike(shapes, 1.0, b, view)


def _paints_alike(shapes: Shapes, t: float, drawing: PlacedDrawing, view: Box) -> bool:
    """Return whether shapes paint what a drawing does, but for a share of the ink."""
    from shapeblend_cli.frames.frames import shapes_at
    from shapeblend_cli.grading.painting import picture  # few blends come so far

    pair = Pair(0, 1, shapes, ((), ()), (view, view))
    whole: dict[int, list[PlacedContour]] = {}
    for contour in drawing.contours:
        whole.setdefault(contour.shape, []).append(contour)
    drawn = [PaintedShape(tuple(c.contour for c in group), group[0].style) for group in whole.values()]
    inks = [picture(painted, view)[3] for painted in (shapes_at(pair, t), drawn)]
    return float(np.abs(inks[0] - inks[1]).sum()) <= SAME_PICTURE * float(inks[1].sum())
