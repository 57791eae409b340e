"""Contours that would turn for no good reason kept upright.

To turn takes no work: a wire alone in space has no up and down. So where outlines have little to tell one start from
another, an upright oval and one that lies flat for instance, the least path may turn one into the other by any angle,
and of several contours each by its own. Here a contour among others has work to do for turning, and one that is alone
turns only if that takes less work: not where two starts cost the same, as with the four corners of a square.
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
from shapeblend_cli.matching.solve import least_work

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.matching.solve import Search
    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.model import ComplexArray, Correspondence, FloatArray, IntArray

TURNED = np.radians(8.0)
"""A contour that turns less is upright."""

ANGLES = 5.0
"""Turning a contour by an angle costs as much as bending so many angles by it. An oval that is up to twice as high as
wide then stays upright on its way to one that lies flat, and what has corners turns if they say so."""

SAME = 1e-9
"""Works that differ by less are the same, and so are those that differ by a smaller share."""

PLACES = 72
"""At so many even places outlines are laid over each other."""

FOLDS = 12
"""What looks the same turned by less than this part of a full turn is as good as round, and its turn no matter."""

ALIKE = 0.9995
"""Correlation of an outline with itself turned, from which on it is the same: places need not fall on corners."""

REACH = 1.0 / 8.0
"""How far from where they lie best over each other starts are looked for, as a share of B's outline."""

RUNS = (-1.0, -0.5, -0.2, -0.05, 0.05, 0.2, 0.5, 1.0)
"""In which runs of starts, within the reach: the least path of a run may well lie at its end, and turn that far. One
run after the other is tried, from the middle on."""


def upright(wires: Wires, least: Correspondence, search: Search, *, alone: bool) -> Correspondence:
    """Choose between the least path and one that turns less.

    Parameters
    ----------
    wires : Wires
        Closed, as solved.
    least : Correspondence
        Found over all starts.
    search : Search
        How it was found; the other one is looked for in some `starts`.
    alone : bool
        Whether it is the only contour that is matched.

    Returns
    -------
    Correspondence
        Its lower bound is that over all starts.
    """
    p0, p1, constants = wires.p0, wires.p1, wires.constants
    turned = abs(turn_along(p0, p1, least.dots))
    if turned < TURNED or (alone and not (may_turn_onto_itself(p0) or may_turn_onto_itself(p1))):
        return least
    price = 0.0 if alone else ANGLES * constants.k_b

    def cost(one: Correspondence) -> float:
        return one.work + price * abs(turn_along(p0, p1, one.dots)) ** constants.e_b

    runs = starts_laid_over(p0, p1, (-1.0, 1.0) if alone else RUNS)
    found = [least]
    with suppress(MatchError):  # no path through these
        tries = [partial(least_work, wires, search._replace(starts=run)) for run in runs]
        found.append(replace(_downhill(tries, cost), lower_bound=least.lower_bound))
    limit = min(map(cost, found)) * (1.0 + SAME) + SAME
    return min(
        (one for one in found if cost(one) <= limit), key=lambda one: abs(turn_along(p0, p1, one.dots))
    )


def _downhill(
    tries: Sequence[Callable[[], Correspondence]], cost: Callable[[Correspondence], float]
) -> Correspondence:
    """What the middle one of some tries gives, or those beside it as long as they cost less."""
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


def may_turn_onto_itself(p: ComplexArray) -> bool:
    """Whether a closed polygon looks much like itself when it is turned by a part of a full turn.

    Where neither of two does, no two starts cost the same.
    """
    q, _ = _even(p)
    alike = [abs(np.vdot(q, np.roll(q, -shift))) for shift in range(PLACES // FOLDS, PLACES // 2 + 1)]
    return max(alike) > ALIKE * abs(np.vdot(q, q))


def turn_along(p0: ComplexArray, p1: ComplexArray, dots: IntArray) -> float:
    """By what angle edges turn on the whole, those of the first polygon to those of the second."""
    edges = [np.diff(p[dots[:, side]], append=p[dots[:1, side]]) for side, p in enumerate((p0, p1))]
    return cmath.phase(complex(np.vdot(*edges)))


def starts_laid_over(p0: ComplexArray, p1: ComplexArray, runs: Sequence[float]) -> list[tuple[int, int, int]]:
    """Where a vertex of the first polygon may go on the second if both are to lie much as they do.

    Parameters
    ----------
    p0, p1 : (m,) and (n,) complex
    runs : sequence of float
        Where runs of starts begin and end, from where both lie best over each other, in units of `REACH`.

    Returns
    -------
    list of (int, int, int)
        The vertex, and the first and the last one of a run of the second polygon's, which may go on beyond its end.
    """
    (q0, _), (q1, at1) = _even(p0), _even(p1)
    overlap = [np.vdot(q0, np.roll(q1, -shift)).real for shift in range(PLACES)]
    middle = float(np.argmax(overlap)) / PLACES  # where on the second the first one's vertex 0 goes
    n = len(p1)
    around = np.concatenate([at1 - 1.0, at1, at1 + 1.0])
    first = np.searchsorted(around, middle + REACH * np.array(runs)).tolist()
    return [(0, begin % n, begin % n + end - begin) for begin, end in pairwise(first)]


def _even(p: ComplexArray) -> tuple[ComplexArray, FloatArray]:
    """Return points evenly along a closed polygon, around their mean, and the share of its length up to each vertex."""
    points = from_end_to_end(p, closed=True)
    shares = cumulative_lengths(points)
    shares /= shares[-1]
    even = points_at(np.arange(PLACES) / PLACES, points, shares)
    return even - even.mean(), shares[:-1]
