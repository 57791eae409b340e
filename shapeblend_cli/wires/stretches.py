"""Stretches that outlines share, in place and in the same direction."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.wires.outline import Outline

TOLERANCE = 2e-3
"""Outlines nearer than this share of the drawings' diagonal are the same."""

LEAST_STRETCH = 1e-2
"""A stretch that two outlines share is at least so long, as a share of the diagonal."""

REACH, EXACT = 4.0, 0.1
"""Where a stretch ends is looked for within so many times that tolerance; nearer than by the second share of it is
as near as can be."""

LEAST_SHARED, LEAST_OF_LONGER = 0.6, 0.4
"""So much of the shorter outlines is shared at least, and of the longer ones."""

UNEVEN = 0.2
"""By how much a stretch may be longer on one outline than on the other."""


class Stretch(NamedTuple):
    """A stretch that two outlines share, by the outlines' indices and the lengths where it begins and ends."""

    outlines: tuple[int, int]
    start: tuple[float, float]
    end: tuple[float, float]  # beyond the start, perhaps more than once round

    @property
    def length(self) -> float:
        """Its length on the first outline."""
        return self.end[0] - self.start[0]


def shared_stretches(a: Sequence[Outline], b: Sequence[Outline], diagonal: float) -> list[Stretch]:
    """Return the stretches that outlines of two drawings share, none twice; none if they do not share enough.

    The diagonal is that of both drawings, or of the outlines.
    """
    distance = TOLERANCE * diagonal
    found = [
        stretch
        for i, p in enumerate(a)
        for j, q in enumerate(b)
        if p.flat.polygon.box.expanded(distance).overlaps(q.flat.polygon.box)
        for stretch in _shared((i, j), (p, q), distance)
        if stretch.length >= LEAST_STRETCH * diagonal
    ]
    kept: list[Stretch] = []
    for stretch in sorted(found, key=lambda stretch: -stretch.length):
        if not any(_overlap(stretch, other, (a, b), distance) for other in kept):
            kept.append(stretch)
    totals = [sum(outline.total for outline in side) for side in (a, b)]
    shared = sum(stretch.length for stretch in kept)
    return kept if shared >= max(LEAST_SHARED * min(totals), LEAST_OF_LONGER * max(totals)) else []


def _overlap(
    one: Stretch, other: Stretch, sides: tuple[Sequence[Outline], Sequence[Outline]], slack: float
) -> bool:
    """Return whether two stretches have more in common than their ends."""
    for side in (0, 1):
        if one.outlines[side] != other.outlines[side]:
            continue
        total = sides[side][one.outlines[side]].total
        ahead = (other.start[side] - one.start[side]) % total
        behind = (one.start[side] - other.start[side]) % total
        if (
            ahead < one.end[side] - one.start[side] - slack
            or behind < other.end[side] - other.start[side] - slack
        ):
            return True
    return False


def _shared(numbers: tuple[int, int], outlines: tuple[Outline, Outline], distance: float) -> list[Stretch]:
    """Return the stretches that two outlines share in the same direction."""
    p, q = outlines
    away_p, on_q = q.lengths_near(p.line[:-1])
    away_q, on_p = p.lengths_near(q.line[:-1])
    near_p, near_q = away_p <= distance, away_q <= distance
    if near_p.sum() + near_q.sum() < 2:
        return []
    along = np.concatenate([p.lengths[:-1], on_p[near_q]])
    beside = np.concatenate([on_q, q.lengths[:-1][near_q]])
    away = np.concatenate([away_p, away_q[near_q]])
    order = np.argsort(along, kind="stable")
    along, beside, away = along[order], beside[order], away[order]
    is_near = away <= distance
    # Between two that follow each other the outlines have the same length.
    ahead = np.roll(along, -1) - along
    ahead[-1] += p.total
    advance = (np.roll(beside, -1) - beside + 0.5 * q.total) % q.total - 0.5 * q.total
    joined = is_near & np.roll(is_near, -1) & (np.abs(advance - ahead) <= UNEVEN * ahead + 2.0 * distance)
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
