"""The point from which a contour without a partner grows: its own middle, carried along by the contour around it.

"Here" is the drawing with the contour, "there" the drawing without it. The contour grows from a point there while the
paired contours, `MatchedPoints`, move from there to here on straight paths. A contour that shrinks does so in reverse.
"""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polygons import centroid, mean_value_weights, winding_numbers
from shapeblend_cli.geometry.polyline import thin
from shapeblend_cli.model import Box

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapeblend_cli.model import ComplexArray, FloatArray

TIMES = np.arange(1, 10) / 10
"""Times at which a growing hole is checked for lying inside."""

WATCHED = 24
"""Maximum number of vertices of an outline that are checked."""

GRID = 12
"""Number of rows and columns of the grid of points from which a hole may grow instead of its own."""

TRIES = 40
"""Maximum number of points that are tried."""

FALL = 4
"""Power of the distance with which the weight of a vertex falls for a point outside."""


class MatchedPoints(NamedTuple):
    """Corresponding vertices of a paired contour, (k,) complex each."""

    here: ComplexArray
    there: ComplexArray


def nearest_paired(
    contour: ComplexArray, paired: Sequence[MatchedPoints], bounds: FloatArray
) -> tuple[int, float]:
    """Return the index of the paired contour that is nearest here to a contour, (n,) complex, and its distance.

    The bounds of the paired contours here are (paired, 4).
    """
    watched = thin(contour, WATCHED)
    low, high = (Box.around(watched).bounds[k : k + 2] for k in (0, 2))
    apart = np.maximum(np.maximum(bounds[:, :2] - high, low - bounds[:, 2:]), 0.0)
    gaps = (1.0 - 1e-9) * np.hypot(apart[:, 0], apart[:, 1])  # no vertex is nearer than the boxes are
    best = np.inf, 0
    for k in np.argsort(gaps, kind="stable").tolist():
        if gaps[k] > best[0]:
            break
        best = min(best, (float(np.abs(paired[k].here[:, None] - watched).min()), k))
    return best[1], best[0]


def carried(point: complex, by: MatchedPoints, *, inside: bool) -> complex:
    """Return the image there of a point here that a paired contour carries along.

    Inside a closed contour the point keeps its mean value coordinates. Elsewhere, or if these lead out of the contour,
    it moves as far as the vertices on average, of which the nearer weigh far more.
    """
    if inside:
        image = complex(mean_value_weights(point, by.here) @ by.there)
        if winding_numbers(np.array([image]), by.there)[0]:
            return image
    distances = np.abs(by.here - point)
    weights = 1.0 / np.maximum(distances, 1e-3 * max(float(distances.max()), 1e-12)) ** FALL
    return point + complex((weights * (by.there - by.here)).sum() / weights.sum())


def growth_point_inside(
    hole: ComplexArray, exterior: MatchedPoints, siblings: Sequence[MatchedPoints] = ()
) -> complex:
    """Return the point there from which a hole grows without leaving its exterior or meeting its siblings.

    The first choice has the mean value coordinates of the hole's centroid. If that will not do, the nearest point of a
    grid that will is taken, or else the best. Siblings are other holes of the exterior.
    """
    watched = thin(hole, WATCHED)
    best, most = 0j, -1.0
    for point in islice(_candidates(hole, exterior), TRIES):
        share = _share_inside(watched, point, exterior, siblings)
        if share > most:
            best, most = point, share
        if most == 1.0:
            break
    return best


def _candidates(hole: ComplexArray, exterior: MatchedPoints) -> Iterator[complex]:
    first = complex(mean_value_weights(centroid(hole), exterior.here) @ exterior.there)
    yield first
    grid = Box.around(exterior.there).grid(GRID)
    inside = grid[winding_numbers(grid, exterior.there) != 0]
    yield from inside[np.argsort(np.abs(inside - first), kind="stable")].tolist()


def _share_inside(
    watched: ComplexArray, point: complex, exterior: MatchedPoints, siblings: Sequence[MatchedPoints]
) -> float:
    """Return the share of times and vertices of a hole growing from `point` that are inside and in no other hole."""
    count = 0
    for t in TIMES:
        growing = (1.0 - t) * point + t * watched
        inside = winding_numbers(growing, (1.0 - t) * exterior.there + t * exterior.here) != 0
        for other in siblings:
            inside &= winding_numbers(growing, (1.0 - t) * other.there + t * other.here) == 0
        count += int(inside.sum())
    return count / (len(TIMES) * len(watched))
