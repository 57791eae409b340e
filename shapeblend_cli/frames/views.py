"""The part of the plane that a frame shows."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.paths import paths_at, waypoints
from shapeblend_cli.model import Box, CubicPath, PaintedShape, Pair, Style

if TYPE_CHECKING:
    from collections.abc import Sequence


MARGIN = 0.02
"""Margin around the painted area of a drawing without a viewBox, as a share of its larger side."""

CUT_OFF = 0.04
"""Maximum overhang of a moving shape beyond the viewBox that is not missed, as a share of its size: a unit of 24."""

SLACK = 1e-9
"""Maximum overhang that is due to rounding, as a share of the viewBox."""


def view_of(
    drawn: Sequence[PaintedShape], viewbox: Box | None, keeping: str = "auto", *, own: bool = True
) -> Box:
    """Return the view of a drawing: its viewBox, as in browsers; without one, the painted area.

    `keeping` is the value of `--viewbox`. The painted area outside of the viewBox is added with `grow`, if nothing else
    would be seen, or if the viewBox is not the drawing's own but stands in for it.
    """
    painted = Box.union([_painted(shape.paths, shape.style) for shape in drawn])
    if viewbox is None:
        return _with_margin(painted)
    is_shown = own and viewbox.overlaps(painted)
    if keeping == "keep" or (keeping == "auto" and is_shown) or _overhang(painted, viewbox) <= SLACK:
        return viewbox
    return Box.union([viewbox, _with_margin(painted)])


def with_room(pairs: Sequence[Pair], keeping: str) -> list[Pair]:
    """Return pairs whose views are enlarged for shapes that leave them between the drawings.

    `keeping` is the value of `--viewbox`. A drawing that ends one pair and begins the next has the same view in both.
    """
    views = [pairs[0].views[0], *(pair.views[1] for pair in pairs)]
    for pair in () if keeping == "keep" else pairs:
        reach = _reach(pair, SLACK if keeping == "grow" else CUT_OFF)
        for k in (pair.a, pair.b):
            if reach is not None and not views[k].contains(reach):
                views[k] = Box.union([views[k], reach])
    return [pair._replace(views=(views[pair.a], views[pair.b])) for pair in pairs]


def _reach(pair: Pair, slack: float) -> Box | None:
    """Return the box around shapes that leave the views of both drawings on curved paths, if any do.

    An overhang is ignored up to `slack`, a share of the view's size, and up to the overhangs at the ends.
    """
    boxes = []
    for shape in pair.shapes:
        # Straight paths and sweeps stay within the drawings.
        if shape.motion is None or shape.motion_name == "sweep":
            continue
        ends = [
            _overhang(_painted(paths_at(shape, float(t)), style), pair.views[t])
            for t, style in enumerate((shape.style_a, shape.style_b))
        ]
        for point in waypoints(shape):
            painted = _painted(point.paths, shape.style_a, shape.style_b)
            view = pair.views[0].interpolate(pair.views[1], point.t)
            if _overhang(painted, view) > max(slack, *ends):
                boxes.append(_with_margin(painted))
    return Box.union(boxes) if boxes else None


def _painted(paths: Sequence[CubicPath], *styles: Style) -> Box:
    """Return the box around paths with the widest stroke of some styles."""
    reach = max(style.reach for style in styles)
    return Box.union([cubics.bounds(path.segments).expanded(reach) for path in paths])


def _with_margin(painted: Box) -> Box:
    return painted.expanded(MARGIN * painted.larger_side)


def _overhang(painted: Box, view: Box) -> float:
    left, top, right, bottom = view.bounds
    x0, y0, x1, y1 = painted.bounds
    return max(left - x0, top - y0, x1 - right, y1 - bottom, 0.0) / view.larger_side
