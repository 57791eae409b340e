"""Outlines smoothed level by level until they are round, by the curve shortening flow."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import mean_value_weights, signed_area, winding_numbers
from shapeblend_cli.motion.flow import shorten

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, CubicPath, FloatArray

TIMES = np.geomspace(2e-5, 2.0, 28)
"""Times of the flow at which there are levels, in units of a contour's area, which scaling keeps as it is.

By the first, corners are rounded by less than a hundredth of the size. A bulge that occurs k times round the outline
fades as ``exp(-pi (k^2 - 1) time)``, and vertices are evened out at least as ``exp(-pi time)``, so at the last time
any two outlines are circles with evenly spread vertices, to a few parts in a thousand.
"""

STEPS = 4
"""Steps of the flow from one level to the next."""

MOST_PIECES, LEAST_PIECES, VERTICES = 8, 4, 1600
"""Vertices of a segment; the fewer, the more the contour would have. A cubic needs two besides its ends."""

SHRINKING_LEVEL, LEAST_SIZE = 8, 0.25
"""Contours beside others become smaller from this level on, down to this share of their size at the last."""

AXES = np.array([1.0, 1.0j])

LEAST_EDGE, VANISHING = 0.02, 1e-3
"""Edges count as no shorter than this share of the mean one, or coincident vertices would leap apart. A contour stays
as it is once its edges have this share of their length."""

MOST_GROWTH = 2.0
"""Scaling makes a contour so many times as large in a step, at most: if it crosses itself its area may become 0."""

NEGLIGIBLE_AREA = 1e-3
"""A contour with less area, with its size as 1, has as good as none: a figure of eight, or a line there and back."""


def smoothing_levels(paths: Sequence[CubicPath]) -> list[list[ComplexArray]]:
    """Return the contours of a shape as given, and at each level of smoothing.

    Each keeps its area, and moves with the one it is nested in, by its mean value coordinates, so that holes stay in
    their exteriors. Contours that are points are only moved; open ones keep their ends. Round contours need more room
    than they had: from `SHRINKING_LEVEL` on they become smaller, with all that is in them, but for an exterior around
    all others.

    Returns
    -------
    list of list of (s, 4) complex
        Control points of every contour at each level. Contours of straight lines alone stay such.
    """
    flowing = [_FlowingContour(path) for path in paths]
    parents = _parents(flowing)
    levels = [[np.array(path.segments) for path in paths]]
    nested = {child for child, _ in parents}
    outermost = [k for k, contour in enumerate(flowing) if k not in nested and not contour.is_point]
    shrinking = {k for k in range(len(flowing)) if outermost != [k]}
    previous_time = 0.0
    for level, time in enumerate(TIMES.tolist(), 1):
        before = [contour.points for contour in flowing]
        for contour in flowing:
            contour.advance(time - previous_time)
        # The outermost first, since what is in them moves with them.
        for child, parent in parents:
            weights = mean_value_weights(flowing[child].centre, before[parent] @ AXES)
            flowing[child].shift(complex(weights @ ((flowing[parent].points - before[parent]) @ AXES)))
        previous_time = time
        size = LEAST_SIZE ** max(0.0, (level - SHRINKING_LEVEL) / (len(TIMES) - SHRINKING_LEVEL))
        drawn = [(size if k in shrinking else 1.0, contour.centre) for k, contour in enumerate(flowing)]
        for child, parent in parents:
            scale, centre = drawn[parent]
            offset = flowing[child].centre - flowing[parent].centre
            drawn[child] = scale * drawn[child][0], centre + scale * offset
        levels.append(
            [contour.segments(*placement) for contour, placement in zip(flowing, drawn, strict=True)]
        )
    return levels


def _parents(flowing: Sequence[_FlowingContour]) -> list[tuple[int, int]]:
    """Return contours nested in others, each with the smallest one around it; those with the largest parents first."""
    nested = []
    for k, contour in enumerate(flowing):
        around = [
            (abs(other.area()), index)
            for index, other in enumerate(flowing)
            if index != k
            and other.has_area
            and abs(other.area()) > abs(contour.area())
            and winding_numbers(contour.points[:1] @ AXES, other.points @ AXES)[0]
        ]
        if around:
            nested.append((*min(around), k))
    return [(k, parent) for _, parent, k in sorted(nested, reverse=True)]


class _FlowingContour:
    """A contour under the flow, as a polygon of `points`, (n, 2) float."""

    def __init__(self, path: CubicPath) -> None:
        segments = path.segments
        self._count = len(segments)
        self._pieces = min(MOST_PIECES, max(LEAST_PIECES, VERTICES // self._count))
        self._closed = path.closed
        self._as_lines = bool(path.straight.all())
        self.is_point = path.is_point
        parameters = np.arange(self._pieces) / self._pieces
        z = cubics.evaluate(segments[:, None, :], parameters).ravel()
        if not path.closed:
            z = np.append(z, segments[-1, 3])
        self.points = np.ascontiguousarray(np.stack([z.real, z.imag], axis=1))
        self._edge = _mean_edge(self.points)
        self._area = self.area()
        # Where nothing has an area, the time is in units of a square of the size, and nothing is scaled.
        square = float(np.ptp(self.points, axis=0).max()) ** 2
        self.has_area = abs(self._area) > NEGLIGIBLE_AREA * square
        self._unit = abs(self._area) if self.has_area else square

    @property
    def centre(self) -> complex:
        """The mean of the vertices."""
        return complex(self.points.mean(axis=0) @ AXES)

    def area(self) -> float:
        """Return the signed area inside; 0 of open contours."""
        return signed_area(np.asarray(self.points @ AXES)) if self._closed else 0.0

    def shift(self, offset: complex) -> None:
        """Move the contour."""
        self.points = self.points + [offset.real, offset.imag]

    def advance(self, time: float) -> None:
        """Let the contour flow, for a time in units of its area."""
        if self.is_point:
            return
        points = self.points.copy()
        scratch = np.empty((len(points), 3))
        for _ in range(STEPS):
            mean_edge = _mean_edge(points)
            if mean_edge < VANISHING * self._edge:
                return  # what has no area shrinks to nothing, unless it is stopped
            shorten(points, scratch, self._closed, time / STEPS * self._unit, LEAST_EDGE * mean_edge)
            if self.has_area:
                area = abs(signed_area(np.asarray(points @ AXES)))
                centre = points.mean(axis=0)
                points -= centre
                points *= min(np.sqrt(abs(self._area) / area), MOST_GROWTH) if area else 1.0
                points += centre
        self.points = points

    def segments(self, scale: float, centre: complex) -> ComplexArray:
        """Return lines, or the cubics nearest to the vertices, so many times as large and around a centre."""
        z = self.points @ AXES
        z = centre + scale * (z - self.centre)
        pieces = z.reshape(self._count, -1) if self._closed else z[:-1].reshape(self._count, -1)
        start = pieces[:, 0]
        if self._as_lines:
            return cubics.lines(start if self._closed else np.append(start, z[-1]), self._closed)
        end = np.append(start[1:], z[0] if self._closed else z[-1])
        ends, inner = _cubic_fit(self._pieces)
        rest = pieces[:, 1:] - np.stack([start, end], axis=1) @ ends
        return np.column_stack([start, rest @ inner, end])


def _mean_edge(points: FloatArray) -> float:
    """Return the mean length of the edges, closed."""
    edges = np.diff(points, axis=0, append=points[:1])
    return float(np.hypot(edges[:, 0], edges[:, 1]).mean())


def _cubic_fit(pieces: int) -> tuple[FloatArray, FloatArray]:
    """Return the least squares fit of a cubic with given ends through points at even parameters.

    That is what the ends add to the points, (2, pieces - 1), and the inner control points from the rest,
    (pieces - 1, 2).
    """
    u = np.arange(1, pieces) / pieces
    v = 1.0 - u
    ends = np.stack([v**3, u**3])
    inner = np.linalg.pinv(np.stack([3.0 * v * v * u, 3.0 * v * u * u])).copy()
    return ends, inner
