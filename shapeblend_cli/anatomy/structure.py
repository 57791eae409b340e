"""The nesting of all contours of a drawing, whatever their shapes and paint."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import HOLE
from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.geometry.polyline import cumulative_lengths, points_at, thin

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.model import ComplexArray, FloatArray, Polygon

SAMPLES = 16
"""Number of points of a contour that are compared with another one; most lie inside a contour that contains it."""

WOUND = 100
"""Maximum number of vertices of a contour for the test of points inside."""

LARGER = 1.03
"""Minimum area of a contour around another contour, as a multiple of the inner area."""

ALIKE = 0.02
"""Maximum difference of the boxes of one outline that is drawn twice, as a share of its size."""


class Structure(NamedTuple):
    """The contours of a drawing as a forest, by their places in the sequence.

    Contours that coincide, the fill and the stroke of one outline, are siblings; the first of them stands for all as a
    parent.
    """

    parent: list[int | None]
    same: list[int]  # the first contour that coincides with each; itself for most
    within: NDArray[np.float32]  # [i, j], how much of contour j is in contour i; 1 in all that it lies in

    def ancestors(self, k: int) -> list[int]:
        """Return the contours around a contour, the innermost first."""
        found = []
        at = self.parent[k]
        while at is not None:
            found.append(at)
            at = self.parent[at]
        return found


def structure_of(contours: Sequence[PlacedContour]) -> Structure:
    """Find for each contour the smallest contour that it lies in: a hole in its exterior, all others in any."""
    lows, highs = corners([contour.polygon for contour in contours])
    areas = np.array([contour.area for contour in contours])
    same = _coincident(contours, lows, highs, areas)
    points = [along(contour.polygon, SAMPLES) for contour in contours]
    inside = _inside(contours, points, (lows, highs), areas)
    number = {contour.number: k for k, contour in enumerate(contours)}
    found = Structure([None] * len(contours), same, inside)
    for k, contour in enumerate(contours):
        around = np.flatnonzero(inside[:, k] > 0.5)
        outer: list[int] = around[np.argsort(areas[around], kind="stable")].tolist()
        if contour.role == HOLE and contour.exterior in number:
            outer.insert(0, number[contour.exterior])
        # What stands for the contours around may coincide with this one, or lie in it: they are almost of one size.
        roots = (same[i] for i in outer)
        found.parent[k] = next((i for i in roots if k not in (i, *found.ancestors(i))), None)
    for k in range(len(contours)):
        inside[found.ancestors(k), k] = 1.0
    return found


def corners(polygons: Sequence[Polygon]) -> tuple[ComplexArray, ComplexArray]:
    """Return the lowest and the highest corner of each polygon's box."""
    boxes = np.array([polygon.box for polygon in polygons]).reshape(-1, 4)
    lows = boxes[:, 0] + 1j * boxes[:, 1]
    return lows, lows + boxes[:, 2] + 1j * boxes[:, 3]


def along(polygon: Polygon, count: int) -> ComplexArray:
    """Return points evenly spread along a polygon, (count,) complex; of an open polygon without its ends."""
    lengths = cumulative_lengths(polygon.line)
    return points_at((np.arange(count) + 0.5) / count * lengths[-1], polygon.line, lengths)


def _coincident(
    contours: Sequence[PlacedContour], lows: ComplexArray, highs: ComplexArray, areas: FloatArray
) -> list[int]:
    """Return the first closed contour that each coincides with, by their boxes and areas."""
    same = list(range(len(contours)))
    sizes = np.abs(highs - lows)
    for k, contour in enumerate(contours):
        if not contour.polygon.closed:
            continue
        apart = np.maximum(np.abs(lows[k] - lows[:k]), np.abs(highs[k] - highs[:k]))
        near = np.flatnonzero((apart <= ALIKE * sizes[k]) & (areas[:k] > 0.0))
        equal = near[np.abs(areas[near] - areas[k]) <= (LARGER - 1.0) * areas[k]]
        if len(equal):
            same[k] = same[int(equal[0])]
    return same


def _inside(
    contours: Sequence[PlacedContour],
    points: Sequence[ComplexArray],
    boxes: tuple[ComplexArray, ComplexArray],
    areas: FloatArray,
) -> NDArray[np.float32]:
    """Return the share of contour j that is in contour i, (i, j) float; 0 in contours that are no larger."""
    lows, highs = boxes
    sampled = np.array(points)
    x, y = sampled.real.copy(), sampled.imag.copy()
    inside = np.zeros((len(contours), len(contours)), np.float32)  # whole sixteenths
    for i, contour in enumerate(contours):
        if not contour.polygon.closed:
            continue
        low, high = lows[i], highs[i]
        meets = (lows.real < high.real) & (highs.real > low.real)
        meets &= (lows.imag < high.imag) & (highs.imag > low.imag) & (areas[i] > LARGER * areas)
        meets[i] = False
        some = np.flatnonzero(meets)
        near = (x[some] > low.real) & (x[some] < high.real) & (y[some] > low.imag) & (y[some] < high.imag)
        likely = some[near.any(axis=1)]
        if len(likely):
            wound = winding_numbers(sampled[likely].ravel(), thin(contour.polygon.vertices, WOUND)) != 0
            inside[i, likely] = wound.reshape(-1, SAMPLES).mean(axis=1)
    return inside
