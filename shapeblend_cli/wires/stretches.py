"""Stretches that two sets of outlines share, in place and in the same direction; outlines may be open or closed.

`mostly_shared` finds them where they are most of both sets. `Shared` has the stretches, and for each one the next on
either outline with what lies between the two.
"""

from __future__ import annotations

from bisect import bisect
from collections import Counter, defaultdict
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polyline import are_near, thin
from shapeblend_cli.model import Box

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.geometry.flat_contour import FlatContour
    from shapeblend_cli.model import BoolArray, ComplexArray

    Outlines = Sequence[FlatContour]

TOLERANCE = 2e-3
"""Maximum distance of outlines that are the same, as a share of the drawings' diagonal."""

LEAST_STRETCH = 1e-2
"""Minimum length of a stretch, as a share of the diagonal."""

REACH = 4.0
"""Maximum length that a stretch loses at each end, in tolerances: its ends are where the outlines still meet."""

EXACT = 0.1
"""Maximum distance of outlines that meet, as a share of the tolerance."""

WATCHED = 32
"""Number of points of each outline of A that are looked at before anything else."""

LEAST_WATCHED = 0.15
"""Minimum share of these points that lie on outlines of B."""

MOST_DISTANCES = 50_000_000
"""Maximum number of pairs of vertices, one of each drawing: seconds. Larger drawings are taken to share nothing."""

LEAST_OF_SHORTER = 0.6
"""Minimum length of all stretches, as a share of the length of the shorter set of outlines."""

LEAST_OF_LONGER = 0.4
"""Minimum length of all stretches, as a share of the length of the longer set of outlines."""

UNEVEN = 0.2
"""Maximum difference in length of a stretch on both outlines, as a share of it."""


class Stretch(NamedTuple):
    """A stretch that two outlines share, by the outlines' indices and the lengths where it begins and ends."""

    outlines: tuple[int, int]
    start: tuple[float, float]
    end: tuple[float, float]  # beyond the start, perhaps more than once round

    @property
    def length(self) -> float:
        """Its length on the first outline."""
        return self.end[0] - self.start[0]


class Shared(NamedTuple):
    """Two sets of outlines, A's and B's, and the stretches that they share, the longest first, none twice."""

    outlines: tuple[Outlines, Outlines]
    stretches: Sequence[Stretch]
    distance: float  # within which outlines are the same

    def following(self, side: int) -> dict[int, int]:
        """Return the stretch that follows each stretch on its outline of A, 0, or B, 1; the last of a line has none."""
        found: dict[int, int] = {}
        for number, outline in enumerate(self.outlines[side]):
            on_it = [k for k, stretch in enumerate(self.stretches) if stretch.outlines[side] == number]
            on_it.sort(key=lambda k: self.stretches[k].start[side] % outline.total)
            found |= pairwise(on_it + on_it[:1] * outline.polygon.closed)
        return found

    def between(self, side: int, one: int, other: int) -> tuple[ComplexArray, BoolArray] | None:
        """Return the segments from the end of a stretch to the start of another one, and which are straight.

        None if both are in one place.
        """
        outline = self.outlines[side][self.stretches[one].outlines[side]]
        end, start = self.stretches[one].end[side], self.stretches[other].start[side]
        gap = (start - end) % outline.total
        if min(gap, outline.total - gap) <= self.distance:
            return None
        return outline.between(end % outline.total, end % outline.total + gap)


def mostly_shared(a: Outlines, b: Outlines, diagonal: float | None = None) -> Shared | None:
    """Return the stretches that two sets of outlines share if they are long enough.

    The diagonal is of both drawings, or else of the outlines.
    """
    if diagonal is None:
        diagonal = Box.union([flat.polygon.box for flat in (*a, *b)]).diagonal
    if not _is_affordable(a, b):
        return None
    watched = np.concatenate([thin(flat.polygon.vertices, WATCHED) for flat in a])
    if _near_any(watched, b, TOLERANCE * diagonal).mean() < LEAST_WATCHED:
        return None
    shared = shared_stretches(a, b, diagonal)
    totals = [sum(outline.total for outline in side) for side in (a, b)]
    length = sum(stretch.length for stretch in shared.stretches)
    least = max(LEAST_OF_SHORTER * min(totals), LEAST_OF_LONGER * max(totals))
    return shared if shared.stretches and length >= least else None


def shared_stretches(a: Outlines, b: Outlines, diagonal: float) -> Shared:
    """Return the stretches that outlines of two drawings share."""
    distance = TOLERANCE * diagonal
    if not _is_affordable(a, b):
        return Shared((a, b), (), distance)
    found = [
        stretch
        for i, j in _candidates(a, b, distance)
        for stretch in _shared((i, j), (a[i], b[j]), distance)
        if stretch.length >= LEAST_STRETCH * diagonal
    ]
    kept: list[Stretch] = []
    in_order: defaultdict[tuple[int, int], list[tuple[float, Stretch]]] = defaultdict(list)
    for stretch in sorted(found, key=lambda stretch: -stretch.length):
        places = []
        for side, number in enumerate(stretch.outlines):
            entry = stretch.start[side] % (a, b)[side][number].total, stretch
            others = in_order[side, number]
            places.append((others, bisect(others, entry), entry))
        # Those kept overlap no others, so that of each outline only the one before and the one after can.
        beside = [others[k % len(others)][1] for others, at, _ in places if others for k in (at - 1, at)]
        if not any(_overlap(stretch, other, (a, b), distance) for other in beside):
            kept.append(stretch)
            for others, at, entry in places:
                others.insert(at, entry)
    return Shared((a, b), kept, distance)


def _is_affordable(a: Outlines, b: Outlines) -> bool:
    counts = [sum(len(outline.polygon.vertices) for outline in side) for side in (a, b)]
    return counts[0] * counts[1] <= MOST_DISTANCES


def _candidates(a: Outlines, b: Outlines, distance: float) -> list[tuple[int, int]]:
    """Return the indices of outlines whose boxes overlap, or nearly.

    Copies of an outline are alike for all others: the first goes with first copies, the second with second ones.
    """
    boxes = [[flat.polygon.box for flat in side] for side in (a, b)]
    left, top, right, bottom = np.array([box.expanded(distance).bounds for box in boxes[0]]).T[:, :, None]
    x0, y0, x1, y1 = np.array([box.bounds for box in boxes[1]]).T
    overlap = (left < x1) & (x0 < right) & (top < y1) & (y0 < bottom)
    copies = [np.array(_copies(side)) for side in (a, b)]
    return [(i, j) for i, j in np.argwhere(overlap & (copies[0][:, None] == copies[1])).tolist()]


def _copies(outlines: Outlines) -> list[int]:
    """Return the number of copies of each outline among the outlines before it."""
    counts: Counter[bytes] = Counter()
    found = []
    for outline in outlines:
        key = outline.polygon.vertices.tobytes()
        found.append(counts[key])
        counts[key] += 1
    return found


def _near_any(points: ComplexArray, outlines: Outlines, distance: float) -> BoolArray:
    """Return which points are within a distance of any outline."""
    near = np.zeros(len(points), bool)
    for outline in outlines:
        # Others than those near its box are further away, and computing how far is most of the work in a crowd.
        asked = np.flatnonzero(~near & outline.polygon.box.expanded(2.0 * distance).holds(points))
        near[asked] = are_near(points[asked], outline.polygon.line, distance)
    return near


def _overlap(one: Stretch, other: Stretch, sides: tuple[Outlines, Outlines], slack: float) -> bool:
    """Return whether two stretches have more in common than their ends."""
    for side in (0, 1):
        if one.outlines[side] == other.outlines[side]:
            total = sides[side][one.outlines[side]].total
            for first, second in ((one, other), (other, one)):
                ahead = (second.start[side] - first.start[side]) % total
                if ahead < first.end[side] - first.start[side] - slack:
                    return True
    return False


def _shared(
    numbers: tuple[int, int], outlines: tuple[FlatContour, FlatContour], distance: float
) -> list[Stretch]:
    """Return the stretches that two outlines share in the same direction."""
    p, q = outlines
    own_p, own_q = (flat.lengths[: len(flat.polygon.vertices)] for flat in outlines)
    away_p, on_q = q.lengths_near(p.polygon.vertices)
    away_q, on_p = p.lengths_near(q.polygon.vertices)
    near_p, near_q = away_p <= distance, away_q <= distance
    if near_p.sum() + near_q.sum() < 2:
        return []
    along = np.concatenate([own_p, on_p[near_q]])
    beside = np.concatenate([on_q, own_q[near_q]])
    away = np.concatenate([away_p, away_q[near_q]])
    order = np.argsort(along, kind="stable")
    along, beside, away = along[order], beside[order], away[order]
    is_near = away <= distance
    # Between two that follow each other the outlines have the same length.
    ahead = np.roll(along, -1) - along
    ahead[-1] += p.total
    advance = np.roll(beside, -1) - beside
    if q.polygon.closed:
        advance = (advance + 0.5 * q.total) % q.total - 0.5 * q.total
    joined = is_near & np.roll(is_near, -1) & (np.abs(advance - ahead) <= UNEVEN * ahead + 2.0 * distance)
    joined[-1] &= p.polygon.closed
    if joined.all():
        return [Stretch(numbers, (0.0, float(beside[0])), (p.total, float(beside[0]) + q.total))]
    stretches = []
    count = len(along)
    for first in np.flatnonzero(joined & ~np.roll(joined, 1)).tolist():
        steps = 1
        while joined[(first + steps) % count]:
            steps += 1
        within = (first + np.arange(steps + 1)) % count
        passed, passed_beside = (
            np.concatenate([[0.0], np.cumsum(lengths[within[:-1]])]) for lengths in (ahead, advance)
        )
        # The outlines part where they still lie on each other, not where they are too far apart.
        apart = np.maximum(away[within], EXACT * distance)
        low = int(np.where(passed <= REACH * distance, apart, np.inf).argmin())
        apart = np.where(passed[-1] - passed <= REACH * distance, apart, np.inf)
        high = steps - int(apart[::-1].argmin())
        if low < high:
            start, end = (
                (float(along[first] + passed[k]), float(beside[first] + passed_beside[k]))
                for k in (low, high)
            )
            stretches.append(Stretch(numbers, start, end))
    return stretches
