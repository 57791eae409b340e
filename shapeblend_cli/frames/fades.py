"""Shapes that change their place in the order of paint, at a time when little is seen of it.

Such a shape is there twice, with the same outlines and paint. First the copy at B's place appears, then the copy at A's
place disappears; if the paint is not opaque, both at once.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Box, Fade, Place, ShapeBlend

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Style

TIMES = (0.5, 0.4, 0.6, 0.3, 0.7)
"""Times at which a shape may change its place, the best first: at one of them it may meet no shape that it passes."""

LENGTH = 0.1
"""Duration of a copy's fade, as a share of the time."""


def in_paint_order(shapes: Sequence[ShapeBlend], places: Sequence[Place]) -> tuple[ShapeBlend, ...]:
    """Return shapes in the order of their places; if they have two, a copy that disappears, and a twin that appears."""
    positions: dict[int, list[int]] = {}
    for position, place in enumerate(places):
        positions.setdefault(place.shape, []).append(position)

    @cache
    def boxes(shape: int, t: float) -> list[Box]:
        reach = max(shapes[shape].style_a.reach, shapes[shape].style_b.reach)
        return [cubics.bounds(path.segments).expanded(reach) for path in paths_at(shapes[shape], t)]

    @cache
    def time_of(shape: int) -> float:
        first, last = positions[shape]
        passed = {place.shape for place in places[first + 1 : last]}
        for t in TIMES:
            if not any(p.overlaps(q) for other in passed for q in boxes(other, t) for p in boxes(shape, t)):
                return t
        return TIMES[0]

    ordered = []
    for shape, end in places:
        blend = shapes[shape]
        if end is not None:
            time = time_of(shape)
            is_opaque = _is_opaque(blend.style_a) and _is_opaque(blend.style_b)
            # Transparent copies fade at the same time: together they would look darker.
            begin = time - LENGTH if end or not is_opaque else time
            until = time + LENGTH if not end or not is_opaque else time
            blend = blend._replace(fade=Fade(begin, until, comes=bool(end)), is_twin=bool(end))
        ordered.append(blend)
    return tuple(ordered)


def _is_opaque(style: Style) -> bool:
    return all(paint.least_opacity == 1.0 for paint in style.paints if paint.colour is not None)
