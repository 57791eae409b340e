"""Where a contour without a partner grows from, or shrinks to: its own middle, carried along by what it lies on.

Both are one question. Here is the drawing that has the contour, there the one that has not; the contours that are
paired are known on both sides, vertex for vertex, as `MatchedPoints`. The contour grows from a point there while the
paired ones move on straight paths to here.
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

    from shapeblend_cli.model import ComplexArray

TIMES = np.arange(1, 10) / 10
"""Times at which a growing hole is checked for lying inside."""

WATCHED = 24
"""Maximum number of vertices of an outline that are checked."""

GRID = 12
"""Number of rows and columns of the grid of points from which a hole may grow instead of its own."""

TRIES = 40
"""Maximum number of points that are tried."""

FALL = 4
"""Power of the distance by which the weight of a vertex falls for a point outside."""


class MatchedPoints(NamedTuple):
    """A paired contour: (k,) complex vertices here, and there, a pair for every dot."""

    here: ComplexArray
    there: ComplexArray


def nearest_paired(contour: ComplexArray, paired: Sequence[MatchedPoints]) -> tuple[int, float]:
    """Return which paired contour is nearest here to one given by its vertices, and how far it is."""
    watched = thin(contour, WATCHED)
    distances = [float(np.abs(points.here[:, None] - watched).min()) for points in paired]
    nearest = int(np.argmin(distances))
    return nearest, distances[nearest]


def carried(point: complex, by: MatchedPoints, *, inside: bool) -> complex:
    """Return where a point here lies there if a paired contour carries it.

    Inside a closed contour it keeps its mean value coordinates. Elsewhere, or if they lead out of the contour, it goes
    as far as the vertices do, the nearer ones by far.
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
    """Return the point there that a hole grows from, such that it stays inside its exterior all the way.

    The first choice has the mean value coordinates there that the hole's centroid has here. If a hole that grows from
    it does not stay inside, it is the nearest point of a grid from which it does; or, if there is none, the best.
    Nor must it meet its siblings, other holes of that exterior.
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
    """Return the share of times and vertices at which what grows from `point` is inside and in no other hole."""
    count = 0
    for t in TIMES:
        growing = (1.0 - t) * point + t * watched
        inside = winding_numbers(growing, (1.0 - t) * exterior.there + t * exterior.here) != 0
        for other in siblings:
            inside &= winding_numbers(growing, (1.0 - t) * other.there + t * other.here) == 0
        count += int(inside.sum())
    return count / (len(TIMES) * len(watched))
