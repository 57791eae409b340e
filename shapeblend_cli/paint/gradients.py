"""Gradients between two gradients of one kind."""

from __future__ import annotations

import cmath
import math
from bisect import bisect_left, bisect_right
from typing import TYPE_CHECKING, TypeVar

from shapeblend_cli.model import LinearGradient, RadialGradient, Stop
from shapeblend_cli.paint.colours import blend_colours, blend_in_srgb

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Gradient

Number = TypeVar("Number", float, complex)


def all_of(gradient: Gradient, colour: str) -> Gradient:
    """A gradient that paints the same everywhere: a plain colour on its way to another gradient."""
    return gradient._replace(stops=tuple(Stop(stop.offset, colour) for stop in gradient.stops))


def blend_gradients(a: Gradient, b: Gradient, t: float) -> Gradient | None:
    """The gradient at time t; None where the two are of different kinds.

    Points, radii and stops go straight from one to the other, an ellipse turns the shorter way, and what is beyond the
    ends changes at half time. At 0 and 1 it paints what `a` and `b` do, perhaps with more stops.

    Colours are not premultiplied here, because SVG does not do so between stops either: the colour even of a stop that
    cannot be seen is seen beside it.
    """
    stops = tuple(
        Stop(p.offset, blend_colours(p.colour, q.colour, t), _between(p.opacity, q.opacity, t))
        for p, q in zip(*common_stops(a.stops, b.stops), strict=True)
    )
    spread = (a if t < 0.5 else b).spread
    if isinstance(a, LinearGradient) and isinstance(b, LinearGradient):
        return LinearGradient(_between(a.start, b.start, t), _between(a.end, b.end, t), stops, spread)
    if isinstance(a, RadialGradient) and isinstance(b, RadialGradient):
        a, b = _turned_alike(a, b)
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


def common_stops(a: Sequence[Stop], b: Sequence[Stop]) -> tuple[tuple[Stop, ...], tuple[Stop, ...]]:
    """Two lists of stops at the same offsets, painting what `a` and `b` paint.

    Every offset of either is there, twice where one of them changes its colour abruptly.
    """
    offsets = sorted({stop.offset for stop in (*a, *b)})
    found: tuple[list[Stop], list[Stop]] = [], []
    for offset in offsets:
        sides = [_both_sides(stops, offset) for stops in (a, b)]
        number = 2 if any(before != after for before, after in sides) else 1
        for stops, pair in zip(found, sides, strict=True):
            stops.extend(pair[:number])
    return tuple(found[0]), tuple(found[1])


def _both_sides(stops: Sequence[Stop], offset: float) -> tuple[Stop, Stop]:
    """What a gradient paints just before an offset, and just after it, as SVG has it between stops."""
    offsets = [stop.offset for stop in stops]
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


def _turned_alike(a: RadialGradient, b: RadialGradient) -> tuple[RadialGradient, RadialGradient]:
    """The same two ellipses, turned so that the one has the shorter way to the other.

    A circle can be taken for turned by any angle, an ellipse for turned half around; the focus turns back.
    """
    if a.radii[0] == a.radii[1]:
        return _taken_as(a, b.angle), b
    if b.radii[0] == b.radii[1]:
        return a, _taken_as(b, a.angle)
    half_turns = round((a.angle - b.angle) / 180.0)
    return a, _taken_as(b, b.angle + 180.0 * half_turns)


def _taken_as(gradient: RadialGradient, angle: float) -> RadialGradient:
    back = cmath.rect(1.0, math.radians(gradient.angle - angle))
    return gradient._replace(angle=angle, focus=gradient.focus * back)


def _between(a: Number, b: Number, t: float) -> Number:
    return (1.0 - t) * a + t * b
