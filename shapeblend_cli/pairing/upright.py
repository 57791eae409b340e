"""Contours that would rotate for no good reason are kept upright.

Rotation takes no work: a wire alone in space has no up and down. So where outlines have little to tell one start from
another, an upright oval and one that lies flat for instance, the least path may rotate one into the other by any angle,
and of several contours each by its own. Here a contour among others has to work for its rotation, and one that is alone
rotates only if that takes less work: not if two starts cost the same, as with the four corners of a square.
"""

from __future__ import annotations

import cmath
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.geometry.polyline import cumulative_lengths, from_end_to_end, points_at
from shapeblend_cli.matching.solve import Search, least_work

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.model import ComplexArray, Correspondence, FloatArray, IntArray

UPRIGHT, ROTATION_ANGLES = np.radians(8.0), 5.0
"""A contour that rotates by less is upright. Rotating by more costs as much as bending so many angles by it: an oval
that is up to twice as high as wide then stays upright on its way to one that lies flat, and what has corners rotates if
they say so."""

SAME = 1e-9
"""Works that differ by less are the same, and so are those that differ by a smaller share."""

SAMPLES = 72
"""Points, evenly spread along an outline, that are compared."""

FOLDS, ALIKE = 12, 0.9995
"""An outline looks the same rotated from this correlation with itself on: samples need not fall on corners. If that is
by less than this part of a full turn, it is as good as round, and its rotation does not matter."""

REACH, RUNS = 1.0 / 8.0, (-1.0, -0.5, -0.2, -0.05, 0.05, 0.2, 0.5, 1.0)
"""Starts are searched within this share of B's outline from where both outlines overlap best, in runs between these
shares of that: the least path of a run may well lie at its end, and rotate that far. Runs are tried one by one, from
the middle on."""


def upright(wires: Wires, least: Correspondence, search: Search, *, alone: bool) -> Correspondence:
    """Choose between the least path over all starts, as searched, and one that rotates less.

    The other one is searched over some starts. Its lower bound is that over all starts.
    """
    p0, p1, constants = wires.p0, wires.p1, wires.constants
    if abs(rotation_along(p0, p1, least.dots)) < UPRIGHT:
        return least
    if alone and not (may_rotate_onto_itself(p0) or may_rotate_onto_itself(p1)):
        return least
    price = 0.0 if alone else ROTATION_ANGLES * constants.k_b

    def cost(found: Correspondence) -> float:
        return found.work + price * abs(rotation_along(p0, p1, found.dots)) ** constants.e_b

    candidates = [least]
    with suppress(MatchError):  # no path through these starts
        runs = overlapping_starts(p0, p1, (-1.0, 1.0) if alone else RUNS)
        tries = [partial(least_work, wires, search._replace(starts=run)) for run in runs]
        candidates.append(replace(_cheapest_from_middle(tries, cost), lower_bound=least.lower_bound))
    limit = min(map(cost, candidates)) * (1.0 + SAME) + SAME
    cheapest = [candidate for candidate in candidates if cost(candidate) <= limit]
    return min(cheapest, key=lambda candidate: abs(rotation_along(p0, p1, candidate.dots)))


def _cheapest_from_middle(
    tries: Sequence[Callable[[], Correspondence]], cost: Callable[[Correspondence], float]
) -> Correspondence:
    """Return the result of the middle try, or of those beside it as long as they cost less."""
    middle = len(tries) // 2
    best = first = tries[middle]()
    for onwards in (tries[middle + 1 :], tries[:middle][::-1]):
        for attempt in onwards:
            other = attempt()
            if cost(other) >= cost(best):
                break
            best = other
        if best is not first:
            break
    return best


def may_rotate_onto_itself(p: ComplexArray) -> bool:
    """Return whether a closed polygon looks much like itself when it is rotated by a part of a full turn.

    If neither of two polygons does, no two starts cost the same.
    """
    q, _ = _even(p)
    overlaps = [abs(np.vdot(q, np.roll(q, -shift))) for shift in range(SAMPLES // FOLDS, SAMPLES // 2 + 1)]
    return max(overlaps) > ALIKE * abs(np.vdot(q, q))


def rotation_along(p0: ComplexArray, p1: ComplexArray, dots: IntArray) -> float:
    """Return the angle by which edges rotate on the whole, from the first polygon to the second."""
    edges = [np.diff(p[dots[:, side]], append=p[dots[:1, side]]) for side, p in enumerate((p0, p1))]
    return cmath.phase(complex(np.vdot(*edges)))


def overlapping_starts(
    p0: ComplexArray, p1: ComplexArray, runs: Sequence[float]
) -> list[tuple[int, int, int]]:
    """Return starts at which both polygons lie much as they do: vertex 0, and runs of vertices of the second.

    Runs are from one of `runs` to the next, in units of `REACH` from where both overlap best. Each has a vertex, its
    first and its last partner; the last may be counted on beyond the end.
    """
    (q0, _), (q1, shares) = _even(p0), _even(p1)
    overlap = [np.vdot(q0, np.roll(q1, -shift)).real for shift in range(SAMPLES)]
    best = float(np.argmax(overlap)) / SAMPLES  # where on the second the first one's vertex 0 goes
    n = len(p1)
    around = np.concatenate([shares - 1.0, shares, shares + 1.0])
    first = np.searchsorted(around, best + REACH * np.array(runs)).tolist()
    return [(0, begin % n, begin % n + end - begin) for begin, end in pairwise(first)]


def _even(p: ComplexArray) -> tuple[ComplexArray, FloatArray]:
    """Return points evenly along a closed polygon, around their mean, and the share of its length up to each vertex."""
    points = from_end_to_end(p, closed=True)
    shares = cumulative_lengths(points)
    shares /= shares[-1]
    even = points_at(np.arange(SAMPLES) / SAMPLES, points, shares)
    return even - even.mean(), shares[:-1]
