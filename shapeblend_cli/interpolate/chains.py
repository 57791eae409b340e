"""Several pairs in a row: what continues from one to the next becomes one path.

Each pair has cut its two outlines at positions of its own, and its polygons have vertices of their own. Where a drawing
ends one pair and starts the next, its outline is cut at the positions of both, and each cut is carried on to the
outlines before and after, waypoints included.
"""

from __future__ import annotations

from bisect import bisect_left
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.parametrization import parametrize
from shapeblend_cli.interpolate.paths import waypoints
from shapeblend_cli.model import (
    UNNAMED,
    CubicPath,
    Group,
    KeyframedShape,
    Name,
    PaintedShape,
    Pair,
    ShapeBlend,
    Style,
    Waypoint,
)
from shapeblend_cli.names import common_groups
from shapeblend_cli.paint.styles import faded_coats, keyed_styles

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, Contour, FloatArray, Polygon

SAME = 1e-6
"""Positions nearer than this share of a segment are one."""

SAMPLES = 33
"""Points of a curve at which the search for the one nearest to a given point begins."""

STEPS = 6
"""Newton steps of that search."""


class _Key(NamedTuple):
    """A contour of a drawing: its number, its segments, and where it is cut.

    Cuts are numbers of segments and parameters on them, added up, which rise; once round if closed.
    """

    number: int | None
    segments: ComplexArray
    cuts: FloatArray

    @classmethod
    def of(cls, number: int | None, contour: Contour, polygon: Polygon, cuts: FloatArray) -> _Key:
        """Return the key of a contour that is cut at positions on its polygon, see `ContourBlend.cuts`."""
        if number is not None:  # a point has no positions
            cuts = parametrize(contour, polygon).segment_positions(cuts)
        return cls(number, contour.segments, cuts)


class _ContourChain(NamedTuple):
    """A contour over two keys or more.

    Its stations, (s, 4) complex, are the control points at each key, and between two keys at each waypoint. `start` is
    the first key, cut as in its own pair, and `end` the last one.
    """

    stations: list[ComplexArray]
    straight: BoolArray
    closed: bool
    start: _Key
    end: _Key


class _ShapeChain(NamedTuple):
    """A shape over two keys or more, `first` being the number of the drawing it begins with.

    It has a style at each key, and for each key but the last the times of the waypoints before the next one. What fades
    has two keys and no more.
    """

    first: int
    contours: list[_ContourChain]
    styles: list[Style]
    times: list[tuple[float, ...]]
    fading: ShapeBlend | None = None  # the shape, if it fades
    names: tuple[Name, ...] = ()
    groups: tuple[Group, ...] = ()


def keyframed_shapes(pairs: Sequence[Pair]) -> list[KeyframedShape]:
    """Join what is painted together from one drawing to the next, for as long as it stays together.

    Parameters
    ----------
    pairs : sequence of Pair
        Each begins with the drawing that the one before it ends with.

    Returns
    -------
    list of KeyframedShape
        In an order of paint that is each pair's own. A shape continues if the next pair has one of exactly the same
        contours, each of them whole, and as long as it keeps its place among others that continue.
    """
    chains: list[_ShapeChain] = []
    for pair in pairs:
        ending = {
            _numbers([contour.end for contour in chain.contours]): k
            for k, chain in enumerate(chains)
            if chain.fading is None and chain.first + len(chain.styles) - 1 == pair.a
        }
        started = [_start(shape, pair.a) for shape in pair.shapes]
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
    return [coat for chain in chains for coat in _coats(chain)]


def _longest_rise(numbers: Sequence[int]) -> list[int]:
    """Return as many numbers as can be left in a list such that they rise.

    Examples
    --------
    >>> _longest_rise([4, 0, 1, 3, 2])
    [0, 1, 2]
    """
    rises: list[list[int]] = []  # of each length the one that ends lowest
    for number in numbers:
        k = bisect_left([rise[-1] for rise in rises], number)
        rises[k : k + 1] = [[*(rises[k - 1] if k else []), number]]
    return rises[-1] if rises else []


def _numbers(keys: Sequence[_Key]) -> frozenset[int | None]:
    """Return the numbers of a shape's contours; none at all if one of them is a point, or only a piece."""
    numbers = frozenset(key.number for key in keys)
    return frozenset() if None in numbers or len(numbers) < len(keys) else numbers


def _start(shape: ShapeBlend, first: int) -> _ShapeChain:
    """Start a chain with a shape of one pair."""
    points = waypoints(shape)
    contours = [
        _ContourChain(
            [blend.start.segments, *(point.paths[k].segments for point in points), blend.end.segments],
            blend.start.straight,
            blend.start.closed,
            _Key.of(blend.a, blend.contour_a, blend.polygon_a, blend.cuts[0]),
            _Key.of(blend.b, blend.contour_b, blend.polygon_b, blend.cuts[1]),
        )
        for k, blend in enumerate(shape.contours)
    ]
    styles = [shape.style_a, shape.style_b]
    times = [tuple(p.t for p in points)]
    fading = shape if shape.fade else None
    return _ShapeChain(first, contours, styles, times, fading, shape.names, shape.groups)


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
    last = len(keys) - 1
    return [
        KeyframedShape(
            tuple(map(PaintedShape, keys, (*styles[:last], styles[-1]))),
            chain.first,
            tuple(between),
            (tuple(zip(times, styles[1:-1], strict=True)),) if times else (),
            Name.common(chain.names) if chain.names and styles is coats[-1] else UNNAMED,
            chain.groups,
        )
        for styles in coats
    ]


def _continue(chain: _ShapeChain, following: _ShapeChain) -> _ShapeChain | None:
    """Continue every contour, and the paint, of a shape to the next key; None if one of them cannot be."""
    styles = [*chain.styles, following.styles[-1]]
    if keyed_styles(styles) is None:
        return None
    by_number = {contour.start.number: contour for contour in following.contours}
    contours = []
    for contour in chain.contours:
        after = by_number[contour.end.number]
        if not _is_continued(contour, after):
            after = _reverse(after)
        if not _is_continued(contour, after):
            return None  # cut open, or a piece
        contours.append(_extend(contour, after))
    return chain._replace(
        contours=contours,
        styles=styles,
        times=[*chain.times, *following.times],
        names=(*chain.names, *following.names),
        groups=common_groups(chain.groups, following.groups),
    )


def _is_continued(contour: _ContourChain, after: _ContourChain) -> bool:
    return contour.closed == after.closed and np.array_equal(contour.end.segments, after.start.segments)


def _reverse(contour: _ContourChain) -> _ContourChain:
    """Traverse a contour in reverse; a closed one keeps its first node."""

    def reverse(key: _Key) -> _Key:
        return _Key(key.number, key.segments[::-1, ::-1], len(key.segments) - key.cuts[::-1])

    return contour._replace(
        stations=[segments[::-1, ::-1] for segments in contour.stations],
        straight=contour.straight[::-1],
        start=reverse(contour.start),
        end=reverse(contour.end),
    )


class _Part(NamedTuple):
    """A part of a segment, by its number and two parameters."""

    segment: int
    start: float
    end: float


def _extend(contour: _ContourChain, after: _ContourChain) -> _ContourChain:
    """Extend a contour by one that begins with its last outline, and cut all stations alike."""
    if contour.closed:
        contour = _roll_to(contour, float(after.start.cuts[0]))
    parts, parts_after = _common_parts(
        contour.stations[-1], contour.end.cuts, after.stations[0], after.start.cuts
    )
    numbers, numbers_after = ([part.segment for part in each] for each in (parts, parts_after))
    return contour._replace(
        stations=[
            *(_cut(station, parts) for station in contour.stations),
            *(_cut(station, parts_after) for station in after.stations[1:]),
        ],
        straight=contour.straight[numbers] & after.straight[numbers_after],
        end=after.end._replace(cuts=_cut_positions(after.end.cuts, parts_after)),
    )


def _roll_to(contour: _ContourChain, position: float) -> _ContourChain:
    """Start a closed contour's list of segments at a position of the last key where there is a cut."""
    cuts, count = contour.end.cuts, len(contour.end.segments)
    away = np.abs((cuts[:-1] - position + count / 2.0) % count - count / 2.0)
    first = int(away.argmin())
    rolled = np.concatenate([cuts[first:-1], cuts[: first + 1] + count])
    return contour._replace(
        stations=[np.roll(station, -first, axis=0) for station in contour.stations],
        straight=np.roll(contour.straight, -first),
        end=contour.end._replace(cuts=rolled - rolled[0] + position),
    )


def _common_parts(
    segments: ComplexArray, cuts: FloatArray, others: ComplexArray, other_cuts: FloatArray
) -> tuple[list[_Part], list[_Part]]:
    """Cut an outline that is cut in two ways, into `segments` and into `others`, at the positions of both.

    Both begin at the same position. Their parts correspond one for one; a part is a point where the other list of
    segments has a point and its own has none.
    """
    parts, other_parts = [], []
    i = j = 0
    u = v = 0.0
    count_i, count_j = len(segments), len(others)
    while i < count_i or j < count_j:
        is_point = i < count_i and u == 0.0 and cuts[i + 1] - cuts[i] <= SAME
        is_other_point = j < count_j and v == 0.0 and other_cuts[j + 1] - other_cuts[j] <= SAME
        if i == count_i or j == count_j or is_point or is_other_point:
            # The other one is held meanwhile, unless it has a point here as well.
            ends_i = i < count_i and (is_point or not is_other_point)
            ends_j = j < count_j and (is_other_point or not is_point)
            next_u, next_v = (1.0 if ends_i else u), (1.0 if ends_j else v)
        else:
            ahead = cuts[i + 1] - other_cuts[j + 1]
            ends_i, ends_j = ahead <= SAME, ahead >= -SAME
            next_u = 1.0 if ends_i else max(u, _nearest_parameter(segments[i], others[j, 3]))
            next_v = 1.0 if ends_j else max(v, _nearest_parameter(others[j], segments[i, 3]))
        parts.append(_Part(i, u, next_u) if i < count_i else _Part(count_i - 1, 1.0, 1.0))
        other_parts.append(_Part(j, v, next_v) if j < count_j else _Part(count_j - 1, 1.0, 1.0))
        i, u = (i + 1, 0.0) if ends_i else (i, next_u)
        j, v = (j + 1, 0.0) if ends_j else (j, next_v)
    return parts, other_parts


def _nearest_parameter(segment: ComplexArray, point: complex) -> float:
    """Return where on a segment the point nearest to a given one lies."""
    samples = np.linspace(0.0, 1.0, SAMPLES)
    u = float(samples[np.abs(cubics.evaluate(segment, samples) - point).argmin()])
    for _ in range(STEPS):
        p = segment[:3] + (segment[1:] - segment[:3]) * u
        q = p[:2] + (p[1:] - p[:2]) * u
        speed = 3.0 * (q[1] - q[0])
        if abs(speed) == 0.0:
            break
        away = q[0] + (q[1] - q[0]) * u - point
        u = min(max(u - (away * speed.conjugate()).real / abs(speed) ** 2, 0.0), 1.0)
    return u


def _cut(segments: ComplexArray, parts: Sequence[_Part]) -> ComplexArray:
    numbers, start, end = (np.array(column) for column in zip(*parts, strict=True))
    return cubics.pieces(segments[numbers], start, end)


def _cut_positions(cuts: FloatArray, parts: Sequence[_Part]) -> FloatArray:
    """Return where parts of segments cut an outline: about, between two cuts of before."""
    numbers, _, end = (np.array(column) for column in zip(*parts, strict=True))
    return np.append(cuts[0], cuts[numbers] + end * (cuts[numbers + 1] - cuts[numbers]))
