"""Where a contour without a partner comes from, or goes to: a point of the shape it belongs to.

Both are one question. Here is the drawing that has the contour, there the one that has not; what has been paired is
known on both sides, vertex for vertex, as a `MatchedPoints`. The contour grows from a point there as the paired ones
go on their straight paths to here.
"""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polygons import mean_value_weights, signed_area, winding_numbers
from shapeblend_cli.model import Box

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapeblend_cli.model import ComplexArray

TIMES = np.arange(1, 10) / 10
"""When it is looked at whether a growing hole lies inside."""

WATCHED = 24
"""Vertices of the growing contour that are looked at."""

GRID = 12
"""A point that will not do is replaced by one of a grid of so many rows and columns..."""

TRIES = 40
"""...of which so many are tried, the nearest first."""


class MatchedPoints(NamedTuple):
    """A paired contour: (k,) complex vertices here, and there, a pair for every dot."""

    here: ComplexArray
    there: ComplexArray


def point_on(contour: ComplexArray, pairings: Sequence[MatchedPoints]) -> tuple[int, complex]:
    """The point there that an outline or a line grows from: of the paired contours the nearest point.

    Parameters
    ----------
    contour : (m,) complex
        Vertices of the contour here.
    pairings : sequence of MatchedPoints
        At least one.

    Returns
    -------
    number : int
        Which matched it is on.
    point : complex
        What corresponds to the vertex of the matched that is nearest to the contour here.
    """
    watched = _watched(contour)
    nearest = []
    for number, matched in enumerate(pairings):
        distances = np.abs(matched.here[:, None] - watched).min(axis=1)
        vertex = int(distances.argmin())
        nearest.append((float(distances[vertex]), number, complex(matched.there[vertex])))
    _, number, point = min(nearest, key=lambda found: found[:2])
    return number, point


def point_inside(hole: ComplexArray, outline: MatchedPoints, others: Sequence[MatchedPoints] = ()) -> complex:
    """The point there that a hole grows from, such that it stays inside its outline all the way.

    The first choice has the mean value coordinates there that the hole's centroid has here. If a hole that grows from
    it does not stay inside, it is the nearest point of a grid from which it does; or, if there is none, the best.

    Parameters
    ----------
    hole : (m,) complex
        Vertices of the hole here.
    outline : MatchedPoints
        The outline it is a hole in.
    others : sequence of MatchedPoints
        Other holes of that outline, which the growing one must not meet.

    Returns
    -------
    complex
    """
    watched = _watched(hole)
    best, share = 0j, -1.0
    for point in islice(_candidates(hole, outline), TRIES):
        found = _share_inside(watched, point, outline, others)
        if found > share:
            best, share = point, found
        if share == 1.0:
            break
    return best


def _candidates(hole: ComplexArray, outline: MatchedPoints) -> Iterator[complex]:
    wanted = complex(mean_value_weights(_centroid(hole), outline.here) @ outline.there)
    yield wanted
    box = Box.around(outline.there)
    steps = (np.arange(GRID) + 0.5) / GRID
    grid = (box.x + box.width * steps[:, None] + 1j * (box.y + box.height * steps)).ravel()
    inside = grid[winding_numbers(grid, outline.there) != 0]
    yield from inside[np.argsort(np.abs(inside - wanted), kind="stable")].tolist()


def _share_inside(
    watched: ComplexArray, point: complex, outline: MatchedPoints, others: Sequence[MatchedPoints]
) -> float:
    """Share of times and vertices at which what grows from `point` is inside the outline and in no other hole."""
    found = 0
    for t in TIMES:
        growing = (1.0 - t) * point + t * watched
        inside = winding_numbers(growing, (1.0 - t) * outline.there + t * outline.here) != 0
        for other in others:
            inside &= winding_numbers(growing, (1.0 - t) * other.there + t * other.here) == 0
        found += int(inside.sum())
    return found / (len(TIMES) * len(watched))


def _centroid(polygon: ComplexArray) -> complex:
    """Middle of the area of a closed polygon; of its vertices, if it has no area."""
    area = signed_area(polygon)
    origin = polygon[0]
    p, q = polygon - origin, np.roll(polygon, -1) - origin
    size = float(np.abs(p).max())
    if abs(area) < 1e-9 * size * size:
        return complex(polygon.mean())
    return complex(origin + ((p + q) * (p.conj() * q).imag).sum() / (6.0 * area))


def _watched(vertices: ComplexArray) -> ComplexArray:
    return vertices[:: -(-len(vertices) // WATCHED)]
