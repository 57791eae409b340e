"""Paint that is `currentColor` in both drawings stays that, so that a blend takes the colour of its page as they do.

Everything before this, from pairing to the judge, sees the black that it stands for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli.model import PAGE_COLOUR, LinearGradient, RadialGradient

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import PaintedShape, Pair, ShapeBlend, Style

LOST = "currentColor is black wherever only one of the drawings has it"
"""Note on paint that does not stay `currentColor`."""

_PAINTS = ("fill", "stroke")

_MARKED, _OTHER = "#ffffff", "#000000"


class _Source(NamedTuple):
    """A paint in a drawing."""

    drawing: int
    shape: int
    paint: str


def with_page_colour(pairs: Sequence[Pair], style: str) -> tuple[Sequence[Pair], Sequence[str]]:
    """Return pairs in which paint is `PAGE_COLOUR` where that is what it is in all drawings; and notes.

    Paints that become each other have it together or not at all. A shape without a partner has it if every drawing
    has some. Gradients have it in some stops or in all, and become each other where it does not mix with other colours.
    The `style` is that of the settings: under `a` and `b` the paint of one drawing alone counts.
    """
    drawn = {k: shapes for pair in pairs for k, shapes in zip((pair.a, pair.b), pair.drawn, strict=True)}
    asked = {
        _Source(k, i, paint)
        for k, shapes in drawn.items()
        for i, shape in enumerate(shapes)
        for paint in _asked(shape)
    }
    if not asked:
        return pairs, []
    is_in_all = {source.drawing for source in asked} == drawn.keys()
    kept = asked if is_in_all or style != "blend" else set()
    links = set()
    for pair in pairs:
        for shape in pair.shapes:
            for paint in _PAINTS:
                ends = _sources(pair, shape, paint, style)
                if len(ends) < 2:
                    continue
                links.add((ends[0], ends[1]))
                if not _stays_apart(*(_gradient(each, paint) for each in (shape.style_a, shape.style_b))):
                    kept = kept.difference(ends.values())
    while parted := [link for link in links if (link[0] in kept) != (link[1] in kept)]:
        kept = kept.difference(*parted)
    notes = [LOST] if kept < asked else []
    return [_with_kept(pair, kept, style) for pair in pairs], notes


def _with_kept(pair: Pair, kept: set[_Source], style: str) -> Pair:
    shapes = []
    for shape in pair.shapes:
        found = {paint: _sources(pair, shape, paint, style) for paint in _PAINTS}
        a, b = ({paint for paint in _PAINTS if found[paint].get(end) in kept} for end in (0, 1))
        shapes.append(
            shape._replace(style_a=_coloured(shape.style_a, a), style_b=_coloured(shape.style_b, b))
        )
    drawn = [
        tuple(
            shape._replace(
                style=_coloured(shape.style, {paint for paint in _PAINTS if _Source(k, i, paint) in kept})
            )
            for i, shape in enumerate(side)
        )
        for k, side in zip((pair.a, pair.b), pair.drawn, strict=True)
    ]
    return pair._replace(shapes=tuple(shapes), drawn=(drawn[0], drawn[1]))


def _asked(shape: PaintedShape) -> list[str]:
    """Return which of fill and stroke a drawing leaves to its page, all of it or some stops."""
    return [
        paint
        for paint in _PAINTS
        if paint in shape.page_coloured
        or (
            (gradient := _gradient(shape.style, paint)) is not None
            and any(stop.of_page for stop in gradient.stops)
        )
    ]


def _gradient(style: Style, paint: str) -> LinearGradient | RadialGradient | None:
    """Return the gradient of a fill or a stroke that has stops."""
    found = getattr(style, f"{paint}_gradient")
    return found if isinstance(found, LinearGradient | RadialGradient) else None


def _stays_apart(
    a: LinearGradient | RadialGradient | None, b: LinearGradient | RadialGradient | None
) -> bool:
    """Return whether two paints that become each other, plain ones or gradients, do not mix the page's colour."""
    if a is None or b is None:
        stops = [stop for each in (a, b) if each is not None for stop in each.stops]
        return len({stop.of_page for stop in stops}) < 2
    if type(a) is not type(b):
        return True  # one dissolves into the other

    from shapeblend_cli.paint.gradients import common_stops  # few drawings have any

    marked = (
        [stop._replace(colour=_MARKED if stop.of_page else _OTHER, opacity=1.0) for stop in each.stops]
        for each in (a, b)
    )
    return all(p.colour == q.colour in (_MARKED, _OTHER) for p, q in zip(*common_stops(*marked), strict=True))


def _coloured(style: Style, paints: set[str]) -> Style:
    changed: dict[str, Any] = {}
    for name in paints:
        gradient = _gradient(style, name)
        if gradient is None:
            changed[name] = PAGE_COLOUR
            continue
        stops = [stop._replace(colour=PAGE_COLOUR) if stop.of_page else stop for stop in gradient.stops]
        changed[f"{name}_gradient"] = gradient._replace(stops=tuple(stops))
        if stops[0].of_page:  # it stands for the gradient where there are none
            changed[name] = PAGE_COLOUR
    return style._replace(**changed)


def _sources(pair: Pair, shape: ShapeBlend, paint: str, style: str) -> dict[int, _Source]:
    """Return where a paint of a shape comes from, at each end that has it."""
    colours = {0: getattr(shape.style_a, paint), 1: getattr(shape.style_b, paint)}
    return {
        end: _source(pair, shape, {"a": 0, "b": 1}.get(style, end), colour, paint)
        for end, colour in colours.items()
        if colour is not None
    }


def _source(pair: Pair, shape: ShapeBlend, side: int, colour: str, paint: str) -> _Source:
    """Return the paint with a colour in the shape's own drawings, at first in that on one side.

    A stroke may have become a fill, and a fill a stroke.
    """
    for near in (side, 1 - side):
        index = shape.sources[near]
        if index is not None:
            own = pair.drawn[near][index].style
            for name in sorted(_PAINTS, key=lambda name: name != paint):
                if getattr(own, name) == colour:
                    return _Source((pair.a, pair.b)[near], index, name)
    return _Source(-1, -1, paint)
