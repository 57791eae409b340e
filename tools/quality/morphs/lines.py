"""How near a blend of lines with ends is to the truth, where regions mean nothing."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

from tools.quality.truth.form import TIMES
from tools.quality.truth.measures import PLACES, extent, line

if TYPE_CHECKING:
    from tools.quality.truth.form import Linked, Truth

POINTS = 201
"""Lines are compared at so many places, at even distances."""

GROSS = 0.1
"""A correspondence that is off by more than this has missed the shape somewhere; nothing here goes round."""


class Nearness(NamedTuple):
    """One blend beside the truth.

    Attributes
    ----------
    dist : float
        How far in-betweens are from the true ones, mean over places, both ways and `TIMES`, as a share of the size.
    corr : float
        How far along B's line points of A's arrive from where they should, mean, as a share of its length.
    """

    dist: float
    corr: float


NO_ANSWER = Nearness(1.0, 0.5)


def nearness(truth: Truth, found: Linked | None) -> Nearness:
    """Judge a blend of one line; one that is none, or of several, is as far off as can be."""
    if found is None or any(len(contours) != 1 for contours in (*found.frames, found.links)):
        return NO_ANSWER
    size = extent([*truth.frames[0], *truth.frames[-1]])
    each = zip(TIMES, found.frames, strict=True)
    apart = [_apart(truth.laid_back(frame, t)[0], truth.at(t)[0]) for t, frame in each]
    return Nearness(float(np.mean(apart)) / size, _corr(truth, *found.links[0]))


def _apart(p: np.ndarray, q: np.ndarray) -> float:
    """The mean distance of places on each line to the other."""
    lines = [line(p), line(q)]
    ways = np.linspace(0.0, 1.0, POINTS)
    places = [shapely.line_interpolate_point(one, ways, normalized=True) for one in lines]
    return float(np.mean([shapely.distance(places[k], lines[1 - k]).mean() for k in (0, 1)]))


def _corr(truth: Truth, p: np.ndarray, q: np.ndarray) -> float:
    ((a, b),) = truth.true_links()
    u, v = _along(a, p), _along(b, q)
    if u[-1] < u[0]:
        u, v = u[::-1], v[::-1]
    places = (np.arange(PLACES) + 0.5) / PLACES
    ((true_u, true_v),) = truth.along
    if true_v[-1] < true_v[0]:
        true_v = 1.0 - true_v  # B's file goes the other way than the true end, along which `v` is counted
    arrived = np.interp(places, np.maximum.accumulate(u), v)
    return float(np.abs(arrived - np.interp(places, true_u, true_v)).mean())


def _along(contour: np.ndarray, points: np.ndarray) -> np.ndarray:
    """How far along a line the places nearest to points are, as shares of its length."""
    return shapely.line_locate_point(line(contour), shapely.points(points.real, points.imag), normalized=True)
