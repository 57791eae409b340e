"""Lines that stand on a ring, as the handle of a magnifier does: they are drawn back to it, or on from there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.model import Box
from shapeblend_cli.pens.drawings import pen_drawing
from shapeblend_cli.pens.line import UNITS
from shapeblend_cli.pens.moves import drawn

if TYPE_CHECKING:
    from shapeblend_cli.anatomy.decompose import PlacedDrawing
    from shapeblend_cli.model import ShapeBlend
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.pens.line import PenLine
    from shapeblend_cli.pens.moves import Move


def ring_and_handles(
    drawing: PlacedDrawing, settings: Settings, view: Box, here: int
) -> tuple[Box | None, list[ShapeBlend]]:
    """Return the box around the one ring of a drawing, A's if `here` is 0 and else B's, and how its handles move.

    There is none where a drawing has not one ring with handles.
    """
    scale = UNITS / view.larger_side
    lines = pen_drawing(drawing, scale).lines
    rings = [line for line in lines if line.closed]
    handles = [line for line in lines if not line.closed]
    if len(rings) != 1 or not handles:
        return None, []
    box = Box.around(rings[0].points / scale).expanded(rings[0].width / scale / 2.0)
    return box, [_drawn(line, box.centre, scale, here).shape(scale, settings.constants) for line in handles]


def _drawn(line: PenLine, centre: complex, scale: float, here: int) -> Move:
    """Return how a line is drawn back to what is around a centre, early, or on from there, late."""
    points = line.points
    if abs(points[0] / scale - centre) > abs(points[-1] / scale - centre):
        points = points[::-1]
    return drawn(line, points, is_new=bool(here), is_early=True)
