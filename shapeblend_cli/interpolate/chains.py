"""Several pairs one after the other: what goes on from one to the next as one path.

Each pair has cut its two outlines at places of its own. Where a drawing is the end of one pair and the start of
the next, its outline is cut at the places of both, and each cut is carried on to the outlines before and after, those
on the way from one drawing to the next among them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.outline import reversed_polygon
from shapeblend_cli.interpolate.paths import waypoints
from shapeblend_cli.interpolate.styles import keyed_styles
from shapeblend_cli.model import CubicPath, MovingContour, PaintedShape, Track, Waypoint

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import (
        BoolArray,
        ComplexArray,
        FloatArray,
        MatchedContour,
        MatchedShape,
        MovingShape,
        Pair,
        Polygon,
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


class _Couple(NamedTuple):
    """A contour that a pair moves.

    Attributes
    ----------
    matched : MatchedContour
    moving : MovingContour
    ways : list of (s, 4) complex
        Control points at the waypoints.
    """

    matched: MatchedContour
    moving: MovingContour
    ways: list[ComplexArray]


def tracks(pairs: Sequence[Pair]) -> list[Track]:
    """Put together what is painted together from one drawing to the next, for as long as it stays together.

    Parameters
    ----------
    pairs : sequence of Pair
        Each begins with the drawing that the one before it ends with.

    Returns
    -------
    list of Track
        Those of the last pair in its paint order. A shape goes on if the next pair has one of just the same contours,
        each of them whole.
    """
    done: list[_Shape] = []
    going: list[_Shape] = []
    for pair in pairs:
        ended = {_ends(shape): shape for shape in going if _ends(shape)}
        begun: list[_Shape] = []
        for matched, moving in zip(pair.shapes, pair.moving, strict=True):
            times, couples = _coupled(matched, moving)
            key = frozenset(contour.a for contour in matched.contours)
            old = ended.get(key) if len(key) == len(couples) else None
            if old is not None and keyed_styles([*old.styles, moving.style_b]) is None:
                old = None
            runs = _gone_on(old, couples) if old else None
            if old is None or runs is None:
                runs = [_run(couple) for couple in couples]
                begun.append(_Shape(pair.a, runs, [moving.style_a, moving.style_b], [times]))
            else:
                del ended[key]
                going = [shape for shape in going if shape is not old]
                begun.append(_Shape(old.first, runs, [*old.styles, moving.style_b], [*old.times, times]))
        done += going
        going = begun
    return [track for shape in [*done, *going] for track in _tracks(shape)]


def _ends(shape: _Shape) -> frozenset[int | None]:
    """The contours that a shape ends with; none at all if one of them is a point by then, or only a piece."""
    numbers = frozenset(run.number for run in shape.runs)
    return frozenset() if None in numbers or len(numbers) < len(shape.runs) else numbers


def _coupled(matched: MatchedShape, moving: MovingShape) -> tuple[tuple[float, ...], list[_Couple]]:
    """The contours of a shape that a pair moves, and the times of its waypoints."""
    ways = waypoints(moving)
    couples = [
        _Couple(*contours, [waypoint.paths[k].segments for waypoint in ways])
        for k, contours in enumerate(zip(matched.contours, moving.contours, strict=True))
    ]
    return tuple(waypoint.t for waypoint in ways), couples


def _run(couple: _Couple) -> _Run:
    matched, moving, ways = couple
    start, end = moving.start, moving.end
    stations = [start.segments, *ways, end.segments]
    return _Run(stations, start.straight, start.closed, moving.places[1], matched.polygon_b, matched.b)


def _tracks(shape: _Shape) -> list[Track]:
    """A track for every coat of paint."""
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
    return [Track(tuple(map(PaintedShape, keys, styles)), shape.first, tuple(ways)) for styles in coats]


def _gone_on(shape: _Shape, couples: Sequence[_Couple]) -> list[_Run] | None:
    """Every contour of a shape, gone on by a pair; None if one of them cannot."""
    following = {couple.matched.a: couple for couple in couples}
    found = []
    for run in shape.runs:
        couple = following[run.number]
        if not _is_same(run.polygon, couple.matched.polygon_a):
            couple = _backwards(couple)
        if not _is_same(run.polygon, couple.matched.polygon_a):
            return None  # cut open, or a piece
        found.append(_longer(run, couple))
    return found


def _is_same(p: Polygon, q: Polygon) -> bool:
    return p.closed == q.closed and np.array_equal(p.vertices, q.vertices)


def _backwards(couple: _Couple) -> _Couple:
    """A contour gone through the other way round, both sides and all on the way."""
    matched, moving, ways = couple
    polygons = [
        reversed_polygon(polygon, len(contour.segments))
        for polygon, contour in (
            (matched.polygon_a, matched.contour_a),
            (matched.polygon_b, matched.contour_b),
        )
    ]
    start, end = (
        CubicPath(outline.segments[::-1, ::-1], outline.straight[::-1], outline.closed)
        for outline in (moving.start, moving.end)
    )
    ends = [len(polygon.vertices) - (0 if polygon.closed else 1) for polygon in polygons]
    places = [last - side[::-1] for last, side in zip(ends, moving.places, strict=True)]
    return _Couple(
        matched._replace(polygon_a=polygons[0], polygon_b=polygons[1]),
        moving._replace(start=start, end=end, places=(places[0], places[1])),
        [segments[::-1, ::-1] for segments in ways],
    )


class _Part(NamedTuple):
    """What lies between two places: a part of a segment here and one of a segment there."""

    here: tuple[int, float, float]
    there: tuple[int, float, float]


def _longer(run: _Run, couple: _Couple) -> _Run:
    """A contour gone on by a pair that begins with its last outline; all stations are cut alike."""
    matched, moving, ways = couple
    places, end_places = moving.places
    if run.closed:
        run = _begun_at(run, float(places[0]))
    parts = _parts(run.stations[-1], run.places, moving.start.segments, places)
    here, there = ([getattr(part, side) for part in parts] for side in ("here", "there"))
    numbers = np.array([k for k, _, _ in there])
    return _Run(
        stations=[
            *(_cut(station, here) for station in run.stations),
            *(_cut(segments, there) for segments in (*ways, moving.end.segments)),
        ],
        straight=run.straight[[k for k, _, _ in here]] & moving.start.straight[numbers],
        closed=run.closed,
        places=_places(end_places, there),
        polygon=matched.polygon_b,
        number=matched.b,
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
