"""Gradients between two gradients of one kind."""

from __future__ import annotations

import cmath
import math
from bisect import bisect_left, bisect_right
from typing import TYPE_CHECKING, TypeVar

from shapeblend_cli.model import Gradient, LinearGradient, Pattern, RadialGradient, Stop
from shapeblend_cli.paint.oklab import blend_colours, blend_in_srgb

if TYPE_CHECKING:
    from collections.abc import Sequence


Number = TypeVar("Number", float, complex)


def plain_gradient(gradient: Gradient, colour: str) -> Gradient:
    """Return a gradient of one colour everywhere, which blends with another gradient."""
    if isinstance(gradient, Pattern):
        return gradient
    return gradient._replace(stops=tuple(Stop(stop.offset, colour) for stop in gradient.stops))


def blend_gradients(a: Gradient, b: Gradient, t: float) -> Gradient | None:
    """Return the gradient at time t; None where the two are of different kinds.

    Points, radii and stops move straight, an ellipse rotates the shorter way, and the spread changes at half time. At 0
    and 1 the gradient paints the same as `a` and `b`, perhaps with more stops.

    Colours are not premultiplied, as in SVG between stops: the colour of an invisible stop is seen beside it.
    """
    if isinstance(a, Pattern) or isinstance(b, Pattern):
        return blend_patterns(a, b, t) if isinstance(a, Pattern) and isinstance(b, Pattern) else None
    stops = tuple(
        Stop(p.offset, blend_colours(p.colour, q.colour, t), _between(p.opacity, q.opacity, t))
        for p, q in zip(*common_stops(a.stops, b.stops), strict=True)
    )
    spread = (a if t < 0.5 else b).spread
    if isinstance(a, LinearGradient) and isinstance(b, LinearGradient):
        return LinearGradient(_between(a.start, b.start, t), _between(a.end, b.end, t), stops, spread)
    if isinstance(a, RadialGradient) and isinstance(b, RadialGradient):
        a, b = _align_angles(a, b)
        return RadialGradient(
            centre=_between(a.centre, b.centre, t),
            radii=(_between(a.radii[0], b.radii[0], t), _between(a.radii[1], b.radii[1], t)),
            angle=_between(a.angle, b.angle, t),
            focus=_between(a.focus, b.focus, t),
            focal_radius=_between(a.focal_radius, b.focal_radius, t),
            stops=stops,
            spread=spread,
        )
    return None


def blend_patterns(a: Pattern, b: Pattern, t: float) -> Pattern | None:
    """Return the pattern at time t: the tile moves, turns the shorter way and is scaled; None if the tiles differ."""
    if a.content != b.content or a.size != b.size or (a.scale[1] < 0.0) != (b.scale[1] < 0.0):
        return None
    turned = b.angle + 360.0 * round((a.angle - b.angle) / 360.0)
    return a._replace(
        origin=_between(a.origin, b.origin, t),
        angle=_between(a.angle, turned, t),
        scale=(_between(a.scale[0], b.scale[0], t), _between(a.scale[1], b.scale[1], t)),
        skew=_between(a.skew, b.skew, t),
    )


def common_stops(a: Sequence[Stop], b: Sequence[Stop]) -> tuple[tuple[Stop, ...], tuple[Stop, ...]]:
    """Return two lists of stops at the same offsets that paint the same as `a` and `b`.

    They have every offset of either, twice if a colour changes abruptly there.
    """
    common_a: list[Stop] = []
    common_b: list[Stop] = []
    offsets_a, offsets_b = ([stop.offset for stop in stops] for stops in (a, b))
    for offset in sorted({*offsets_a, *offsets_b}):
        sides_a, sides_b = _both_sides(a, offsets_a, offset), _both_sides(b, offsets_b, offset)
        count = 2 if sides_a[0] != sides_a[1] or sides_b[0] != sides_b[1] else 1
        common_a += sides_a[:count]
        common_b += sides_b[:count]
    return tuple(common_a), tuple(common_b)


def _both_sides(stops: Sequence[Stop], offsets: Sequence[float], offset: float) -> tuple[Stop, Stop]:
    """Return the stops just before an offset and just after it, as SVG interpolates between stops."""
    first, last = bisect_left(offsets, offset), bisect_right(offsets, offset)
    if first < last:
        return stops[first], stops[last - 1]
    if first == 0 or first == len(stops):
        end = stops[0 if first == 0 else -1]._replace(offset=offset)
        return end, end
    low, high = stops[first - 1], stops[first]
    t = (offset - low.offset) / (high.offset - low.offset)
    mixed = Stop(offset, blend_in_srgb(low.colour, high.colour, t), _between(low.opacity, high.opacity, t))
    return mixed, mixed


def _align_angles(a: RadialGradient, b: RadialGradient) -> tuple[RadialGradient, RadialGradient]:
    """Return the same two ellipses with angles that differ least.

    The angle of a circle is arbitrary, the angle of an ellipse up to half turns; the focus rotates back.
    """
    if a.radii[0] == a.radii[1]:
        return _at_angle(a, b.angle), b
    if b.radii[0] == b.radii[1]:
        return a, _at_angle(b, a.angle)
    return a, _at_angle(b, b.angle + 180.0 * round((a.angle - b.angle) / 180.0))


def _at_angle(gradient: RadialGradient, angle: float) -> RadialGradient:
    back = cmath.rect(1.0, math.radians(gradient.angle - angle))
    return gradient._replace(angle=angle, focus=gradient.focus * back)


def _between(a: Number, b: Number, t: float) -> Number:
    return (1.0 - t) * a + t * b
