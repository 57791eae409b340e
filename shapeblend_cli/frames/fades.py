"""Where a shape changes its place in the order of paint, and when: on the way, at a time when least is seen of it.

It is there twice, with the same outlines and paint. The copy at B's place comes first; the one at A's place then goes.
Of paint that is not opaque, one comes while the other goes.
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
    """Return shapes by their places, twice where they have two: one that goes, and its twin, which comes."""
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
            # Two coats that are half transparent come and go at once, lest they be seen through each other.
            begin = time - LENGTH if end or not is_opaque else time
            until = time + LENGTH if not end or not is_opaque else time
            blend = blend._replace(fade=Fade(begin, until, comes=bool(end)), is_twin=bool(end))
        ordered.append(blend)
    return tuple(ordered)


def _is_opaque(style: Style) -> bool:
    paints = [paint for paint in style.paints if paint.colour is not None]
    stops = [stop for paint in paints if paint.gradient for stop in paint.gradient.stops]
    return all(paint.opacity == 1.0 for paint in paints) and all(stop.opacity == 1.0 for stop in stops)
