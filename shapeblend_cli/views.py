"""What part of the plane a frame shows."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.paths import waypoints
from shapeblend_cli.model import Box, CubicPath, PaintedShape, Pair, Style

if TYPE_CHECKING:
    from collections.abc import Sequence


MARGIN = 0.02
"""Room around what a drawing without a viewBox paints, as a share of its larger side."""

SLACK = 1e-9
"""What sticks out of a viewBox by less than this share of its size does so by rounding."""


def view_of(drawn: Sequence[PaintedShape], viewbox: Box | None) -> Box:
    """Return what to show of a drawing: its viewBox and what it paints outside; without one, what it paints.

    Where drawings are laid by their own boxes, the viewBox of the first stands in for the others'.
    """
    painted = Box.union([_painted(shape.paths, shape.style) for shape in drawn])
    if viewbox is None:
        return _with_margin(painted)
    return viewbox if _is_inside(painted, viewbox) else Box.union([viewbox, _with_margin(painted)])


def views_with_room(pairs: Sequence[Pair]) -> list[Box]:
    """Return the view of each drawing, enlarged for what leaves it on the way to the next drawing or from the last.

    A drawing that ends one pair and begins the next has the same view in both.
    """
    views = [pairs[0].views[0], *(pair.views[1] for pair in pairs)]
    for pair in pairs:
        reach = _reach(pair)
        for k in (pair.a, pair.b):
            if reach is not None and not views[k].contains(reach):
                views[k] = Box.union([views[k], reach])
    return views


def _reach(pair: Pair) -> Box | None:
    """Return the box around what does not move straight and leaves the views of both drawings, if any does."""
    boxes = []
    for shape in pair.shapes:
        if shape.motion_name == "sweep":  # nothing is seen of it that is not seen in one of the drawings
            continue
        for point in waypoints(shape):
            painted = _painted(point.paths, shape.style_a, shape.style_b)
            if not _is_inside(painted, pair.views[0].interpolate(pair.views[1], point.t)):
                boxes.append(_with_margin(painted))
    return Box.union(boxes) if boxes else None


def _painted(paths: Sequence[CubicPath], *styles: Style) -> Box:
    """Return the box around paths, painted in the widest of some styles."""
    reach = max(style.stroke_width / 2.0 if style.stroke else 0.0 for style in styles)
    return Box.union([cubics.bounds(path.segments).expanded(reach) for path in paths])


def _with_margin(painted: Box) -> Box:
    return painted.expanded(MARGIN * painted.larger_side)


def _is_inside(painted: Box, view: Box) -> bool:
    return view.contains(painted, SLACK * view.larger_side)
