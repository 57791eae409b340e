"""Two drawings become shapes that move: pair, match, move."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.blending.matched import explained, match_pairs, pair_drawings
from shapeblend_cli.blending.moved import move_shapes
from shapeblend_cli.frames.fades import in_paint_order
from shapeblend_cli.motion.rotation import is_rotated_copy, rotation_between
from shapeblend_cli.pens.line_blends import blend_lines, wants_lines

if TYPE_CHECKING:
    from shapeblend_cli.anatomy.decompose import PlacedDrawing
    from shapeblend_cli.model import Box, ShapeBlend
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.pens.line_blends import LineBlend
    from shapeblend_cli.system.clock import Clock
    from shapeblend_cli.system.kept import Kept
    from shapeblend_cli.wires.direction import Watch


def blend_shapes(
    a: PlacedDrawing,
    b: PlacedDrawing,
    settings: Settings,
    view: Box,
    progress: tuple[Clock, Watch | None],
    steps: Kept,
) -> tuple[ShapeBlend, ...]:
    """Pair the contours of two drawings, match them, and choose how their shapes move in a view."""
    clock, watch = progress
    rotation = 0.0
    if settings.motion != "linear":
        largest = [max(side.contours, key=lambda contour: contour.size) for side in (a, b)]
        rotation = rotation_between(*(contour.polygon for contour in largest)) or 0.0
    paired = pair_drawings(a, b, settings, rotation, (clock, steps))
    shapes, places = match_pairs(paired, watch)
    if rotation and not is_rotated_copy([contour for shape in shapes for contour in shape.contours]):
        paired = pair_drawings(a, b, settings, 0.0, (clock, steps))
        shapes, places = match_pairs(paired, watch)
    if not paired.rotation and wants_lines(settings):
        lines = blend_lines(a, b, settings, view)
        if lines is not None:
            return _with_lines(lines, a, b, settings, view, progress, steps)
    moved = in_paint_order(explained(move_shapes(paired, shapes, view), paired), places)
    clock.lap("interpolate")
    return moved


def _with_lines(
    lines: LineBlend,
    a: PlacedDrawing,
    b: PlacedDrawing,
    settings: Settings,
    view: Box,
    progress: tuple[Clock, Watch | None],
    steps: Kept,
) -> tuple[ShapeBlend, ...]:
    """Return the lines of two drawings above what else they have, blended as outlines."""
    rest = [drawing._replace(contours=contours) for drawing, contours in zip((a, b), lines.rest, strict=True)]
    if not any(drawing.contours for drawing in rest):
        return lines.shapes
    paired = pair_drawings(rest[0], rest[1], settings, 0.0, (progress[0], steps))
    shapes, places = match_pairs(paired, progress[1])
    return *in_paint_order(explained(move_shapes(paired, shapes, view), paired), places), *lines.shapes
