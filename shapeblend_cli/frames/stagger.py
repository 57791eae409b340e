"""Shapes that start one after the other, and shapes with a pace of their own."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.errors import OptionError
from shapeblend_cli.model import WHOLE, Pair, ShapeBlend, control_box

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import Drawing
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.options.timetable import Timetable

MOST_LISTED = 5
"""Maximum number of ids, and of numbers, that an error lists."""


def staggered(pair: Pair, stagger: float, by: str) -> Pair:
    """Return a pair whose shapes start in turn, the last after a share of the time, and take equally long.

    They start in paint order, by size, or from one side of the drawing. Copies of a shape start together.
    """
    key = _key(by)
    parts: dict[tuple[tuple[int | None, int | None], ...], list[int]] = {}
    for k, shape in enumerate(pair.shapes):
        parts.setdefault(tuple(c.numbers for c in shape.contours), []).append(k)
    if len(parts) < 2:
        return pair
    ranked = sorted(parts.values(), key=lambda numbers: key(pair.shapes[numbers[0]]))
    shapes = list(pair.shapes)
    for rank, numbers in enumerate(ranked):
        begin = stagger * rank / (len(ranked) - 1)
        for k in numbers:
            shapes[k] = shapes[k]._replace(span=(begin, begin + 1.0 - stagger))
    return pair._replace(shapes=tuple(shapes))


def timed(pairs: Sequence[Pair], drawings: Sequence[Drawing], timetable: Timetable) -> list[Pair]:
    """Return pairs whose parts move when a timetable says so; raise OptionError for a part that no drawing has."""
    spans = {name.removeprefix("#"): (begin, until) for name, begin, until in timetable.parts}
    called = [[_names(shape, pair, drawings) for shape in pair.shapes] for pair in pairs]
    names = dict.fromkeys(name for own in called for found in own for name in found.all)
    for name, *_ in timetable.parts:
        if name.removeprefix("#") not in names:
            numbers = [part for part in names if _is_number(part)]
            ids = [_key_of(part) for part in names if part not in numbers]
            listed = ", ".join(ids[:MOST_LISTED] + numbers[:MOST_LISTED])
            raise OptionError(f"--timing: no part is called {name!r:.60}; {listed} would work")

    def timed_shape(shape: ShapeBlend, found: _Names) -> ShapeBlend:
        return shape._replace(span=next((spans[name] for name in found.all if name in spans), WHOLE))

    return [
        pair._replace(shapes=tuple(map(timed_shape, pair.shapes, own)))
        for pair, own in zip(pairs, called, strict=True)
    ]


class Part(NamedTuple):
    """What one line of a timetable is about: shapes that move together."""

    name: str
    shapes: tuple[int, ...]  # numbers of shapes of the pair
    span: tuple[float, float]
    is_grouped: bool  # whether a line about a group around it holds where there is none of its own


def parts_of(
    pair: Pair, drawings: Sequence[Drawing], settings: Settings, is_plain: Callable[[str], object]
) -> list[Part]:
    """Return the parts of a pair, in paint order, each by the name that the timetable has for it.

    Those that it does not name go by their id, if that is plain, or else by their number.
    """
    if settings.stagger:
        pair = staggered(pair, settings.stagger, settings.stagger_by)
    elif settings.timing.parts:
        pair = timed([pair], drawings, settings.timing)[0]
    listed = {name.removeprefix("#"): name for name, *_ in settings.timing.parts}
    parts: dict[str, Part] = {}
    for k, shape in enumerate(pair.shapes):
        own, around = _names(shape, pair, drawings)
        if not own:
            continue  # it is of neither drawing
        name = next((listed[name] for name in own if name in listed), None) or _key_of(
            next(filter(is_plain, own))
        )
        known = parts.get(name) or Part(name, (), shape.span, any(group in listed for group in around))
        parts[name] = known._replace(shapes=(*known.shapes, k))
    return list(parts.values())


def _key_of(name: str) -> str:
    return name if _is_number(name) else f"#{name}"


def _is_number(name: str) -> bool:
    return name.removeprefix("B").isdigit()


class _Names(NamedTuple):
    """What a shape is called in a timetable, by itself and by the groups around it, the name that counts most first."""

    own: list[str]
    around: list[str]

    @property
    def all(self) -> list[str]:
        return [*self.own, *self.around]


def _names(shape: ShapeBlend, pair: Pair, drawings: Sequence[Drawing]) -> _Names:
    names = _Names([], [])
    for side, number, source in zip(("", "B"), (pair.a, pair.b), shape.sources, strict=True):
        if source is not None:
            drawn = drawings[number].shapes[source]
            names.own.extend([*([drawn.id] if drawn.id is not None else []), f"{side}{drawn.index}"])
            names.around.extend(
                group.name.id for group in reversed(drawn.groups) if group.name.id is not None
            )
    return names


def eased(pair: Pair, knots: Sequence[tuple[float, float]], *, each: bool) -> Pair:
    """Return a pair whose shapes have the pace of an easing: each within its own span, or all of them together."""
    return pair._replace(shapes=tuple(_eased(shape, knots, each=each) for shape in pair.shapes))


def paced(pair: Pair) -> Pair:
    """Return a pair in which spans of shapes are paces, which keyframes of other programs can have."""
    even = (0.0, 0.0), (1.0, 1.0)
    shapes = (shape if shape.span == WHOLE else _eased(shape, even, each=True) for shape in pair.shapes)
    return pair._replace(shapes=tuple(shapes))


def _eased(shape: ShapeBlend, knots: Sequence[tuple[float, float]], *, each: bool) -> ShapeBlend:
    effects = (
        effect._replace(span=WHOLE, pace=_pace(shape._replace(span=effect.span), knots, each=each))
        for effect in shape.effects
    )
    return shape._replace(span=WHOLE, pace=_pace(shape, knots, each=each), effects=tuple(effects))


def _pace(
    shape: ShapeBlend, knots: Sequence[tuple[float, float]], *, each: bool
) -> tuple[tuple[float, float], ...]:
    begin, until = shape.span
    whole = shape._replace(span=WHOLE, pace=tuple(knots))
    if each and not shape.pace:
        inner = [(begin + t * (until - begin), share) for t, share in knots]
        return (*([(0.0, 0.0)] if begin > 0.0 else []), *inner, *([(1.0, 1.0)] if until < 1.0 else []))
    if shape.span == WHOLE and not shape.pace:
        return whole.pace
    times = [0.0, *whole.times_of([t for t, _ in shape.pace] or shape.span), 1.0]
    return tuple((t, shape.own_time(whole.own_time(t))) for t in times)


def _key(by: str) -> Callable[[ShapeBlend], float]:
    if by == "order":
        return lambda shape: 0.0  # sorting keeps the order
    if by == "size":
        return lambda shape: -shape.size
    sign = -1.0 if by in ("right", "bottom") else 1.0
    if by in ("left", "right"):
        return lambda shape: sign * _centre(shape).real
    return lambda shape: sign * _centre(shape).imag


def _centre(shape: ShapeBlend) -> complex:
    """Return the middle of a shape in the first drawing; in the second if it is not in the first."""
    matched = [c for c in shape.contours if not c.grows] or list(shape.contours)
    return control_box([c.path(c.whole_at) for c in matched]).centre
