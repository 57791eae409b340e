"""Several pairs in a row: shapes that continue from pair to pair become one path; see `contour_chains`."""

from __future__ import annotations

from bisect import bisect_left
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.interpolate.contour_chains import (
    ContourChain,
    Key,
    extended,
    is_continued,
    reversed_chain,
)
from shapeblend_cli.interpolate.paths import waypoints
from shapeblend_cli.model import (
    UNNAMED,
    WHOLE,
    ClipBlend,
    CubicPath,
    EffectBlend,
    Group,
    KeyframedEffect,
    KeyframedShape,
    Name,
    PaintedShape,
    Pair,
    ShapeBlend,
    Style,
    Waypoint,
)
from shapeblend_cli.paint.names import common_groups
from shapeblend_cli.paint.styles import faded_coats, keyed_styles

if TYPE_CHECKING:
    from collections.abc import Sequence

    Span = tuple[float, float]


class _ShapeChain(NamedTuple):
    """A shape over two keys or more; over two if it fades."""

    first: int  # number of the first drawing
    contours: list[ContourChain]
    styles: list[Style]  # at each key
    times: list[tuple[float, ...]]  # of the waypoints after each key but the last
    fading: ShapeBlend | None = None  # the shape, if it fades or has a pace
    names: tuple[Name, ...] = ()
    groups: tuple[Group, ...] = ()
    spans: tuple[tuple[float, float], ...] = ()
    clips: tuple[ClipBlend, ...] = ()
    effects: tuple[EffectBlend, ...] = ()


def keyframed_shapes(pairs: Sequence[Pair], finer: float = 1.0) -> list[KeyframedShape]:
    """Join shapes that stay together from one drawing to the next.

    Parameters
    ----------
    pairs : sequence of Pair
        Each begins with the drawing with which the one before it ends.
    finer : float
        Divides the tolerance of paths that are not straight; see `waypoints`.

    Returns
    -------
    list of KeyframedShape
        In an order of paint that agrees with each pair's. A shape continues if the next pair has a shape of exactly the
        same contours, all whole, and if it keeps its place among the others that continue.
    """
    chains: list[_ShapeChain] = []
    for pair in pairs:
        ending = {
            _numbers([contour.end for contour in chain.contours]): k
            for k, chain in enumerate(chains)
            if chain.fading is None and chain.first + len(chain.styles) - 1 == pair.a
        }
        started = [_start(shape, pair.a, finer, len(pairs) > 1) for shape in pair.shapes]
        continued: dict[int, tuple[int, _ShapeChain]] = {}
        for k, chain in enumerate(started):
            numbers = _numbers([contour.start for contour in chain.contours])
            if numbers in ending and numbers and chain.fading is None:
                before = ending.pop(numbers)
                extended = _continue(chains[before], chain)
                if extended:
                    continued[k] = before, extended
        kept = set(_longest_rise([before for before, _ in continued.values()]))
        merged: list[_ShapeChain] = []
        new: list[_ShapeChain] = []
        merged_before = 0
        for k, chain in enumerate(started):
            before, extended = continued.get(k, (-1, chain))
            if before not in kept:
                new.append(chain)
                continue
            merged += [*chains[merged_before:before], *new, extended]
            new, merged_before = [], before + 1
        chains = [*merged, *chains[merged_before:], *new]
    regions: dict[
        tuple[int, int, Span, tuple[Span, ...]], tuple[KeyframedShape, ...]
    ] = {}  # shapes that share a clip still share it

    def regions_of(
        clips: Sequence[ClipBlend], first: int, span: Span, pace: tuple[Span, ...]
    ) -> tuple[tuple[KeyframedShape, ...], ...]:
        for clip in clips:
            if (id(clip), first, span, pace) not in regions:
                started = [
                    _start(shape._replace(span=span, pace=pace), first, finer, False) for shape in clip.shapes
                ]
                regions[id(clip), first, span, pace] = tuple(_coats(shape)[-1] for shape in started)
        return tuple(regions[id(clip), first, span, pace] for clip in clips)

    def around(chain: _ShapeChain) -> tuple[KeyframedEffect, ...]:
        return tuple(
            KeyframedEffect(each, chain.first, regions_of(each.clips, chain.first, each.span, each.pace))
            for each in chain.effects
        )

    def complete(chain: _ShapeChain) -> list[KeyframedShape]:
        pace = chain.fading.pace if chain.fading else ()
        clips = regions_of(chain.clips, chain.first, chain.spans[0], pace)
        return [coat._replace(clips=clips, effects=around(chain)) for coat in _coats(chain)]

    return [coat for chain in chains for coat in complete(chain)]


def _longest_rise(numbers: Sequence[int]) -> list[int]:
    """Return the longest rising list that is left when other numbers are taken out.

    Examples
    --------
    >>> _longest_rise([4, 0, 1, 3, 2])
    [0, 1, 2]
    """
    rises: list[list[int]] = []  # of each length the list that ends lowest
    for number in numbers:
        k = bisect_left([rise[-1] for rise in rises], number)
        rises[k : k + 1] = [[*(rises[k - 1] if k else []), number]]
    return rises[-1] if rises else []


def _numbers(keys: Sequence[Key]) -> frozenset[int | None]:
    """Return the numbers of a shape's contours; none at all if one of them is a point."""
    numbers = frozenset(key.number for key in keys)
    return frozenset() if None in numbers else numbers


def _start(shape: ShapeBlend, first: int, finer: float, is_joined: bool) -> _ShapeChain:
    points = waypoints(shape, finer)
    contours = [
        ContourChain.of(blend, [point.paths[k].segments for point in points], is_joined=is_joined)
        for k, blend in enumerate(shape.contours)
    ]
    styles = [shape.style_a, shape.style_b]
    times = [tuple(p.t for p in points)]
    fading = shape if shape.fade or shape.pace else None
    return _ShapeChain(
        first,
        contours,
        styles,
        times,
        fading,
        shape.names,
        shape.groups,
        (shape.span,),
        shape.clips,
        shape.effects,
    )


def _coats(chain: _ShapeChain) -> list[KeyframedShape]:
    """Return a keyframed shape for every coat of paint."""
    times: tuple[float, ...] = ()
    coats = keyed_styles(chain.styles)
    if chain.fading is not None:
        times, coats = faded_coats(chain.fading)
    assert coats is not None, "shapes continue only as long as their paint does"
    stations = iter(
        [
            tuple(CubicPath(z, c.straight, c.closed) for z, c in zip(station, chain.contours, strict=True))
            for station in zip(*(contour.stations for contour in chain.contours), strict=True)
        ]
    )
    keys, between = [next(stations)], []
    for own_times in chain.times:
        between.append(tuple(Waypoint(t, next(stations)) for t in own_times))
        keys.append(next(stations))
    last, is_paced = len(keys) - 1, chain.fading is not None and bool(chain.fading.pace)
    return [
        KeyframedShape(
            tuple(map(PaintedShape, keys, (*styles[:last], styles[-1]))),
            chain.first,
            tuple(between),
            (tuple(zip(times, styles[1:-1], strict=True)),) if times else (),
            Name.common(chain.names) if chain.names and styles is coats[-1] else UNNAMED,
            chain.groups,
            () if is_paced or all(span == WHOLE for span in chain.spans) else chain.spans,
            is_paced=is_paced,
        )
        for styles in coats
    ]


def _continue(chain: _ShapeChain, following: _ShapeChain) -> _ShapeChain | None:
    """Return a shape whose contours and paint all continue to the next key; None if one of them cannot."""
    if chain.clips or following.clips or chain.effects or following.effects:
        return None
    styles = [*chain.styles, following.styles[-1]]
    if keyed_styles(styles) is None:
        return None
    by_number = {contour.start.number: contour for contour in following.contours}
    contours = []
    for contour in chain.contours:
        after = by_number[contour.end.number]
        if not is_continued(contour, after):
            after = reversed_chain(after)
        if not is_continued(contour, after):
            return None  # cut open, or a piece
        contours.append(extended(contour, after))
    return chain._replace(
        contours=contours,
        styles=styles,
        times=[*chain.times, *following.times],
        names=(*chain.names, *following.names),
        spans=(*chain.spans, *following.spans),
        groups=common_groups(chain.groups, following.groups),
    )
