"""Several pairs one after the other: what goes on from one to the next as one path.

Each pair has cut its two outlines at places of its own. Where a drawing is the end of one pair and the start of
the next, its outline is cut at the places of both, and each cut is carried on to the outlines before and after, those
on the way from one drawing to the next among them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import reverse_polygon
from shapeblend_cli.interpolate.paths import waypoints
from shapeblend_cli.model import CubicPath, KeyframedShape, PaintedShape, Waypoint
from shapeblend_cli.paint.styles import keyed_styles

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import (
        BoolArray,
        ComplexArray,
        ContourBlend,
        FloatArray,
        Pair,
        Polygon,
        ShapeBlend,
        Style,
    )

SAME = 1e-6
"""Places nearer than this share of an edge are one."""

SAMPLES = 33
"""Points of a curve at which the search for the one nearest to a given point begins."""

STEPS = 6
"""Newton steps of that search."""


class _Run(NamedTuple):
    """A contour over several keys.

    Attributes
    ----------
    stations : list of (s, 4) complex
        Control points at each key, and between two keys at each waypoint; segment for segment alike.
    straight : (s,) bool
    closed : bool
    places : (s + 1,) float
        Where the last key's outline is cut, in vertices of its polygon, rising; once round if closed.
    polygon : Polygon
        The last key's outline.
    number : int or None
        The contour of the drawing that it is.
    """

    stations: list[ComplexArray]
    straight: BoolArray
    closed: bool
    places: FloatArray
    polygon: Polygon
    number: int | None


class _Shape(NamedTuple):
    """A shape over several keys.

    Attributes
    ----------
    first : int
        Number of the drawing it begins with.
    runs : list of _Run
    styles : list of Style
        At each key.
    times : list of tuple of float
        For each key but the last, those of the waypoints before the next one.
    """

    first: int
    runs: list[_Run]
    styles: list[Style]
    times: list[tuple[float, ...]]


class _Leg(NamedTuple):
    """A contour between two keys.

    Attributes
    ----------
    blend : ContourBlend
    waypoints : list of (s, 4) complex
        Control points on the way.
    """

    blend: ContourBlend
    waypoints: list[ComplexArray]


def keyframed_shapes(pairs: Sequence[Pair]) -> list[KeyframedShape]:
    """Put together what is painted together from one drawing to the next, for as long as it stays together.

    Parameters
    ----------
    pairs : sequence of Pair
        Each begins with the drawing that the one before it ends with.

    Returns
    -------
    list of KeyframedShape
        Those of the last pair in its paint order. A shape goes on if the next pair has one of just the same contours,
        each of them whole.
    """
    done: list[_Shape] = []
    going: list[_Shape] = []
    for pair in pairs:
        ended = {_ends(shape): shape for shape in going if _ends(shape)}
        begun: list[_Shape] = []
        for shape in pair.shapes:
            times, legs = _legs(shape)
            key = frozenset(contour.a for contour in shape.contours)
            old = ended.get(key) if len(key) == len(legs) else None
            if old is not None and keyed_styles([*old.styles, shape.style_b]) is None:
                old = None
            runs = _gone_on(old, legs) if old else None
            if old is None or runs is None:
                runs = [_run(leg) for leg in legs]
                begun.append(_Shape(pair.a, runs, [shape.style_a, shape.style_b], [times]))
            else:
                del ended[key]
                going = [other for other in going if other is not old]
                begun.append(_Shape(old.first, runs, [*old.styles, shape.style_b], [*old.times, times]))
        done += going
        going = begun
    return [coat for shape in [*done, *going] for coat in _coats(shape)]


def _ends(shape: _Shape) -> frozenset[int | None]:
    """The contours that a shape ends with; none at all if one of them is a point by then, or only a piece."""
    numbers = frozenset(run.number for run in shape.runs)
    return frozenset() if None in numbers or len(numbers) < len(shape.runs) else numbers


def _legs(shape: ShapeBlend) -> tuple[tuple[float, ...], list[_Leg]]:
    """Return the times of a shape's waypoints, and the legs of its contours."""
    points = waypoints(shape)
    legs = [
        _Leg(contour, [point.paths[k].segments for point in points])
        for k, contour in enumerate(shape.contours)
    ]
    return tuple(point.t for point in points), legs


def _run(leg: _Leg) -> _Run:
    blend = leg.blend
    stations = [blend.start.segments, *leg.waypoints, blend.end.segments]
    return _Run(stations, blend.start.straight, blend.start.closed, blend.cuts[1], blend.polygon_b, blend.b)


def _coats(shape: _Shape) -> list[KeyframedShape]:
    """Return a keyframed shape for every coat of paint."""
    coats = keyed_styles(shape.styles)
    assert coats is not None, "shapes go on only as long as their paint does"
    every = iter(
        [
            tuple(CubicPath(z, run.straight, run.closed) for z, run in zip(station, shape.runs, strict=True))
            for station in zip(*(run.stations for run in shape.runs), strict=True)
        ]
    )
    keys, ways = [next(every)], []
    for times in shape.times:
        ways.append(tuple(Waypoint(t, next(every)) for t in times))
        keys.append(next(every))
    return [
        KeyframedShape(tuple(map(PaintedShape, keys, styles)), shape.first, tuple(ways)) for styles in coats
    ]


def _gone_on(shape: _Shape, legs: Sequence[_Leg]) -> list[_Run] | None:
    """Return every contour of a shape, continued to the next key; None if one of them cannot be."""
    following = {leg.blend.a: leg for leg in legs}
    found = []
    for run in shape.runs:
        leg = following[run.number]
        if not _is_same(run.polygon, leg.blend.polygon_a):
            leg = _backwards(leg)
        if not _is_same(run.polygon, leg.blend.polygon_a):
            return None  # cut open, or a piece
        found.append(_longer(run, leg))
    return found


def _is_same(p: Polygon, q: Polygon) -> bool:
    return p.closed == q.closed and np.array_equal(p.vertices, q.vertices)


def _backwards(leg: _Leg) -> _Leg:
    """Return a leg with both its contours, and all between them, reversed."""
    blend = leg.blend
    polygons = [
        reverse_polygon(polygon, len(contour.segments))
        for polygon, contour in ((blend.polygon_a, blend.contour_a), (blend.polygon_b, blend.contour_b))
    ]
    start, end = (
        CubicPath(path.segments[::-1, ::-1], path.straight[::-1], path.closed)
        for path in (blend.start, blend.end)
    )
    ends = [len(polygon.vertices) - (0 if polygon.closed else 1) for polygon in polygons]
    cuts = [last - side[::-1] for last, side in zip(ends, blend.cuts, strict=True)]
    return _Leg(
        blend._replace(
            polygon_a=polygons[0], polygon_b=polygons[1], start=start, end=end, cuts=(cuts[0], cuts[1])
        ),
        [segments[::-1, ::-1] for segments in leg.waypoints],
    )


class _Part(NamedTuple):
    """What lies between two places: a part of a segment here and one of a segment there."""

    here: tuple[int, float, float]
    there: tuple[int, float, float]


def _longer(run: _Run, leg: _Leg) -> _Run:
    """A contour gone on by a pair that begins with its last outline; all stations are cut alike."""
    blend = leg.blend
    places, end_places = blend.cuts
    if run.closed:
        run = _begun_at(run, float(places[0]))
    parts = _parts(run.stations[-1], run.places, blend.start.segments, places)
    here, there = ([getattr(part, side) for part in parts] for side in ("here", "there"))
    numbers = np.array([k for k, _, _ in there])
    return _Run(
        stations=[
            *(_cut(station, here) for station in run.stations),
            *(_cut(segments, there) for segments in (*leg.waypoints, blend.end.segments)),
        ],
        straight=run.straight[[k for k, _, _ in here]] & blend.start.straight[numbers],
        closed=run.closed,
        places=_places(end_places, there),
        polygon=blend.polygon_b,
        number=blend.b,
    )


def _begun_at(run: _Run, place: float) -> _Run:
    """A closed contour whose list of segments begins at a place where there is a cut."""
    count = len(run.polygon.vertices)
    away = np.abs((run.places[:-1] - place + count / 2.0) % count - count / 2.0)
    first = int(away.argmin())
    rolled = np.concatenate([run.places[first:-1], run.places[: first + 1] + count])
    return run._replace(
        stations=[np.roll(station, -first, axis=0) for station in run.stations],
        straight=np.roll(run.straight, -first),
        places=rolled - rolled[0] + place,
    )


def _parts(
    here: ComplexArray, places: FloatArray, there: ComplexArray, other_places: FloatArray
) -> list[_Part]:
    """One outline, cut in two ways, cut at the places of both.

    Parameters
    ----------
    here, there : (s, 4) and (r, 4) complex
        The same outline from the same place on.
    places, other_places : (s + 1,) and (r + 1,) float
        Where they are cut, rising.

    Returns
    -------
    list of _Part
        Each has the parameters of its segments; it is a point where one way of cutting has one and the other has not.
    """
    parts = []
    i = j = 0
    u = v = 0.0
    count_i, count_j = len(here), len(there)
    while i < count_i or j < count_j:
        waits_here = i < count_i and u == 0.0 and places[i + 1] - places[i] <= SAME
        waits_there = j < count_j and v == 0.0 and other_places[j + 1] - other_places[j] <= SAME
        if i == count_i or j == count_j or waits_here or waits_there:
            # The other outline stands still meanwhile, unless it has a point here as well.
            moves_here = i < count_i and (waits_here or not waits_there)
            moves_there = j < count_j and (waits_there or not waits_here)
            parts.append(
                _Part(
                    (i, u, 1.0) if moves_here else _still(i, u, count_i),
                    (j, v, 1.0) if moves_there else _still(j, v, count_j),
                )
            )
            i, u = (i + 1, 0.0) if moves_here else (i, u)
            j, v = (j + 1, 0.0) if moves_there else (j, v)
            continue
        ahead = places[i + 1] - other_places[j + 1]
        next_u = 1.0 if ahead <= SAME else max(u, _parameter(here[i], there[j, 3]))
        next_v = 1.0 if ahead >= -SAME else max(v, _parameter(there[j], here[i, 3]))
        parts.append(_Part((i, u, next_u), (j, v, next_v)))
        i, u = (i + 1, 0.0) if ahead <= SAME else (i, next_u)
        j, v = (j + 1, 0.0) if ahead >= -SAME else (j, next_v)
    return parts


def _still(segment: int, parameter: float, count: int) -> tuple[int, float, float]:
    return (segment, parameter, parameter) if segment < count else (count - 1, 1.0, 1.0)


def _parameter(segment: ComplexArray, point: complex) -> float:
    """Where on a segment the point nearest to a given one lies."""
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


def _cut(segments: ComplexArray, parts: Sequence[tuple[int, float, float]]) -> ComplexArray:
    numbers, start, end = (np.array(column) for column in zip(*parts, strict=True))
    return cubics.pieces(segments[numbers], start, end)


def _places(places: FloatArray, parts: Sequence[tuple[int, float, float]]) -> FloatArray:
    """Where an outline is cut by parts of its segments: about, between two places of before."""
    numbers, _, end = (np.array(column) for column in zip(*parts, strict=True))
    return np.append(places[0], places[numbers] + end * (places[numbers + 1] - places[numbers]))
