"""Contours through several drawings, with the same segments in all of them.

Each pair cuts its two outlines at positions of its own. If a drawing is in two pairs, its outline is cut at the
positions of both, and each cut is carried on to the outlines before and after it, waypoints included.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.parametrization import segment_positions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, Contour, ContourBlend, FloatArray, Polygon

SAME = 1e-6
"""Maximum distance of positions that are one, as a share of a segment."""

SAMPLES = 33
"""Number of points of a curve at which the search for the nearest point begins."""

STEPS = 6
"""Number of Newton steps of that search."""


NO_CUTS = np.empty(0)


class Key(NamedTuple):
    """A contour of a drawing, and its cuts."""

    number: int | None
    segments: ComplexArray
    cuts: FloatArray  # numbers of segments plus parameters, rising; once round if closed

    @classmethod
    def of(cls, number: int | None, contour: Contour, polygon: Polygon, cuts: FloatArray) -> Key:
        """Return the key of a contour that is cut at positions on its polygon, see `ContourBlend.cuts`."""
        if number is not None:  # a point has no positions
            cuts = segment_positions(contour, polygon, cuts)
        return cls(number, contour.segments, cuts)

    @classmethod
    def each_of(cls, blend: ContourBlend) -> list[Key]:
        """Return the keys of both contours of a blend. Pen lines are cut at the vertices of their paths as it is."""
        contours, numbers = (blend.contour_a, blend.contour_b), blend.numbers
        if any(blend.lines):
            every = zip(numbers, contours, blend.cuts, strict=True)
            return [cls(number, contour.segments, cuts) for number, contour, cuts in every]
        polygons = blend.polygon_a, blend.polygon_b
        return [cls.of(*each) for each in zip(numbers, contours, polygons, blend.cuts, strict=True)]

    @classmethod
    def whole_of(cls, blend: ContourBlend) -> list[Key]:
        """Return the keys of both contours of a blend without cuts."""
        sides = (blend.a, blend.contour_a), (blend.b, blend.contour_b)
        return [cls(number, contour.segments, NO_CUTS) for number, contour in sides]


class ContourChain(NamedTuple):
    """A contour over two keys or more."""

    stations: list[ComplexArray]  # control points, (s, 4) each, at the keys and at the waypoints between them
    straight: BoolArray
    closed: bool
    start: Key  # the first, cut as in its own pair
    end: Key  # the last

    @classmethod
    def of(
        cls, blend: ContourBlend, between: Sequence[ComplexArray] = (), *, is_joined: bool = True
    ) -> ContourChain:
        """Return a contour of one pair, and the control points at waypoints between.

        Unless it is to be joined to others, its keys have no cuts.
        """
        return cls(
            [blend.start.segments, *between, blend.end.segments],
            blend.start.straight,
            blend.start.closed,
            *(Key.each_of(blend) if is_joined else Key.whole_of(blend)),
        )


def is_continued(contour: ContourChain, after: ContourChain) -> bool:
    """Return whether a contour begins with the outline that another one ends with."""
    return contour.closed == after.closed and np.array_equal(contour.end.segments, after.start.segments)


def reversed_chain(contour: ContourChain) -> ContourChain:
    """Traverse a contour in reverse; a closed one keeps its first node."""

    def reverse(key: Key) -> Key:
        return Key(key.number, key.segments[::-1, ::-1], len(key.segments) - key.cuts[::-1])

    return contour._replace(
        stations=[segments[::-1, ::-1] for segments in contour.stations],
        straight=contour.straight[::-1],
        start=reverse(contour.start),
        end=reverse(contour.end),
    )


class Part(NamedTuple):
    """A part of a segment, by its number and two parameters."""

    segment: int
    start: float
    end: float


def extended(contour: ContourChain, after: ContourChain) -> ContourChain:
    """Extend a contour by one that begins with its last outline, and cut all stations alike."""
    contour, parts, parts_after, straight = _aligned(contour, after)
    return contour._replace(
        stations=[
            *(cut(station, parts) for station in contour.stations),
            *(cut(station, parts_after) for station in after.stations[1:]),
        ],
        straight=straight,
        end=after.end._replace(cuts=cut_positions(after.end.cuts, parts_after)),
    )


def joined_at_end(contour: ContourChain, after: ContourChain) -> ContourChain:
    """Insert the end of a contour that begins with another's last outline before that outline.

    The last outline stays, so that further contours may begin with it.
    """
    contour, parts, parts_after, straight = _aligned(contour, after)
    *others, last = (cut(station, parts) for station in contour.stations)
    return contour._replace(
        stations=[*others, cut(after.stations[-1], parts_after), last],
        straight=straight,
        end=contour.end._replace(cuts=cut_positions(contour.end.cuts, parts)),
    )


def _aligned(
    contour: ContourChain, after: ContourChain
) -> tuple[ContourChain, list[Part], list[Part], BoolArray]:
    """Return the parts of a contour's last outline and of the same outline, which begins another, cut alike.

    Return first the contour, beginning where the other does, and last which parts are straight in both.
    """
    if contour.closed:
        contour = rolled_to(contour, float(after.start.cuts[0]))
    parts, parts_after = common_parts(
        contour.stations[-1], contour.end.cuts, after.stations[0], after.start.cuts
    )
    numbers, numbers_after = ([part.segment for part in each] for each in (parts, parts_after))
    return contour, parts, parts_after, contour.straight[numbers] & after.straight[numbers_after]


def rolled_to(contour: ContourChain, position: float) -> ContourChain:
    """Start a closed contour's list of segments at the cut of the last key at a position."""
    cuts, count = contour.end.cuts, len(contour.end.segments)
    away = np.abs((cuts[:-1] - position + count / 2.0) % count - count / 2.0)
    first = int(away.argmin())
    rolled = np.concatenate([cuts[first:-1], cuts[: first + 1] + count])
    return contour._replace(
        stations=[np.roll(station, -first, axis=0) for station in contour.stations],
        straight=np.roll(contour.straight, -first),
        end=contour.end._replace(cuts=rolled - rolled[0] + position),
    )


def opened(contour: ContourChain, place: complex) -> ContourChain:
    """Open a closed contour at the node of its last outline that is nearest to a place."""
    count, cuts = len(contour.end.segments), contour.end.cuts
    first = int(np.abs(contour.end.segments[:, 0] - place).argmin())
    position = cuts[0] + (first - cuts[0]) % count
    k = min(int(np.searchsorted(cuts, position, side="right")), len(cuts) - 1) - 1
    parts = [Part(n, 0.0, 1.0) for n in range(len(cuts) - 1)]
    if min(position - cuts[k], cuts[k + 1] - position) > SAME:
        u = _nearest_parameter(contour.stations[-1][k], contour.end.segments[first, 0])
        parts[k : k + 1] = [Part(k, 0.0, u), Part(k, u, 1.0)]
        cuts = np.insert(cuts, k + 1, position)
    rolled = rolled_to(
        contour._replace(
            stations=[cut(station, parts) for station in contour.stations],
            straight=contour.straight[[part.segment for part in parts]],
            end=contour.end._replace(cuts=cuts),
        ),
        float(first),
    )
    end = rolled.end._replace(
        segments=np.roll(rolled.end.segments, -first, axis=0), cuts=rolled.end.cuts - first
    )
    return rolled._replace(closed=False, end=end)


def common_parts(
    segments: ComplexArray, cuts: FloatArray, others: ComplexArray, other_cuts: FloatArray
) -> tuple[list[Part], list[Part]]:
    """Return the parts of two lists of segments of one outline, both cut at the positions of both.

    Both lists begin at the same position. Their parts correspond one for one; a part is a point where only the other
    list has a point.
    """
    parts, other_parts = [], []
    i = j = 0
    u = v = 0.0
    count_i, count_j = len(segments), len(others)
    while i < count_i or j < count_j:
        is_point = i < count_i and u == 0.0 and cuts[i + 1] - cuts[i] <= SAME
        is_other_point = j < count_j and v == 0.0 and other_cuts[j + 1] - other_cuts[j] <= SAME
        if i == count_i or j == count_j or is_point or is_other_point:
            # Meanwhile the other list waits, unless it has a point here as well.
            ends_i = i < count_i and (is_point or not is_other_point)
            ends_j = j < count_j and (is_other_point or not is_point)
            next_u, next_v = (1.0 if ends_i else u), (1.0 if ends_j else v)
        else:
            ahead = cuts[i + 1] - other_cuts[j + 1]
            ends_i, ends_j = ahead <= SAME, ahead >= -SAME
            next_u = 1.0 if ends_i else max(u, _nearest_parameter(segments[i], others[j, 3]))
            next_v = 1.0 if ends_j else max(v, _nearest_parameter(others[j], segments[i, 3]))
        parts.append(Part(i, u, next_u) if i < count_i else Part(count_i - 1, 1.0, 1.0))
        other_parts.append(Part(j, v, next_v) if j < count_j else Part(count_j - 1, 1.0, 1.0))
        i, u = (i + 1, 0.0) if ends_i else (i, next_u)
        j, v = (j + 1, 0.0) if ends_j else (j, next_v)
    return parts, other_parts


def _nearest_parameter(segment: ComplexArray, point: complex) -> float:
    """Return the parameter of the point of a segment that is nearest to a given point."""
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


def cut(segments: ComplexArray, parts: Sequence[Part]) -> ComplexArray:
    """Return parts of segments."""
    numbers, start, end = (np.array(column) for column in zip(*parts, strict=True))
    return cubics.pieces(segments[numbers], start, end)


def cut_positions(cuts: FloatArray, parts: Sequence[Part]) -> FloatArray:
    """Return the positions at which parts of segments cut an outline, interpolated between the former cuts."""
    numbers, _, end = (np.array(column) for column in zip(*parts, strict=True))
    return np.append(cuts[0], cuts[numbers] + end * (cuts[numbers + 1] - cuts[numbers]))
