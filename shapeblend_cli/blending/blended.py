"""Two drawings become shapes that move: pair, match, move."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.blending.matched import match_pairs, pair_drawings, with_reasons
from shapeblend_cli.blending.moved import move_shapes
from shapeblend_cli.frames.fades import in_paint_order
from shapeblend_cli.motion.rotation import is_rotated_copy, rotation_between

if TYPE_CHECKING:
    from shapeblend_cli.anatomy.decompose import PlacedDrawing
    from shapeblend_cli.blending.matched import Progress
    from shapeblend_cli.model import Box, ShapeBlend
    from shapeblend_cli.options.settings import Settings


def blend_shapes(
    a: PlacedDrawing, b: PlacedDrawing, settings: Settings, view: Box, progress: Progress
) -> tuple[ShapeBlend, ...]:
    """Pair the contours of two drawings, match them, and choose how their shapes move in a view."""
    rotation = 0.0
    if settings.motion != "linear":
        largest = [max(side.contours, key=lambda contour: contour.size) for side in (a, b)]
        rotation = rotation_between(*(contour.polygon for contour in largest)) or 0.0
    paired = pair_drawings(a, b, settings, rotation, progress)
    shapes, places = match_pairs(paired)
    if rotation and not is_rotated_copy([contour for shape in shapes for contour in shape.contours]):
        paired = pair_drawings(a, b, settings, 0.0, progress)
        shapes, places = match_pairs(paired)
    moved = in_paint_order(with_reasons(move_shapes(paired, shapes, view), paired), places)
    progress.clock.lap("interpolate")
    return moved
