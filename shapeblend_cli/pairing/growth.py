"""Where a contour without a partner grows from, or shrinks to: a point of the shape it belongs to.

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

TIMES, WATCHED = np.arange(1, 10) / 10, 24
"""When a growing hole is checked for lying inside, and at how many of its vertices at most."""

GRID, TRIES = 12, 40
"""A point that will not do is replaced by one of a grid of so many rows and columns; so many are tried at most."""


class MatchedPoints(NamedTuple):
    """A paired contour: (k,) complex vertices here, and there, a pair for every dot."""

    here: ComplexArray
    there: ComplexArray


def growth_point_on(contour: ComplexArray, paired: Sequence[MatchedPoints]) -> tuple[int, complex]:
    """Return which paired contour an exterior or a line, given by its vertices here, grows from, and the point there.

    It is what corresponds to the vertex of a paired contour which is nearest here.
    """
    watched = thin(contour, WATCHED)
    nearest = []
    for k, points in enumerate(paired):
        distances = np.abs(points.here[:, None] - watched).min(axis=1)
        vertex = int(distances.argmin())
        nearest.append((float(distances[vertex]), k, complex(points.there[vertex])))
    _, index, point = min(nearest, key=lambda candidate: candidate[:2])
    return index, point


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
