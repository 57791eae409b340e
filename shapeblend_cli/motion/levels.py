"""Outlines smoothed step by step until they are round, by the curve shortening flow."""

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
"""Of the flow, at which outlines are kept; in units of a contour's area, which scaling keeps as it is.

By the first, corners are rounded by less than a hundredth of the size. A bulge that comes k times round the outline
fades as ``exp(-pi (k^2 - 1) time)``, and vertices are evened out at least as ``exp(-pi time)``, so at the last time
any two outlines are circles with evenly spread vertices, to a few parts in a thousand.
"""

STEPS = 4
"""Steps of the flow from one time to the next."""

MOST_PIECES, LEAST_PIECES = 8, 4
"""Vertices for which a segment is taken: fewer where there are many segments. A cubic needs two besides its ends."""

VERTICES = 1600
"""Vertices of a contour, about, from which on segments are taken for fewer."""

CROWDED, LEAST_SIZE = 8, 0.25
"""Several contours become smaller from this level on, down to this share of their size at the last."""

AXES = np.array([1.0, 1.0j])

LEAST_EDGE = 0.02
"""Edges count as no shorter than this share of the mean one, or coincident vertices would leap apart."""

VANISHING = 1e-3
"""A contour stays as it is once its edges have this share of their length."""

MOST_GROWTH = 2.0
"""Scaling makes a contour so many times as large in a step, at most: where it crosses itself its area may come to 0."""

FLAT = 1e-3
"""A contour with less area, with its size as 1, has as good as none: a figure of eight, or a line there and back."""


def smoothed(outlines: Sequence[CubicPath]) -> list[list[ComplexArray]]:
    """Smooth the contours of a shape.

    Each keeps its area, and what is inside another is carried along with it, by its mean value coordinates, so that
    holes stay in their outlines. Contours that are points only go where they are carried; open ones keep their ends.
    Round contours need more room than they had: from level `CROWDED` on they become smaller, with all that is in them,
    but for an outline around all others.

    Parameters
    ----------
    outlines : sequence of CubicPath

    Returns
    -------
    list of list of (s, 4) complex
        Control points of every contour at each level: at first those given, then those at `TIMES`. Contours of
        straight lines alone stay such.
    """
    flowing = [_Flowing(outline) for outline in outlines]
    homes = _homes(flowing)
    levels = [[np.array(outline.segments) for outline in outlines]]
    housed = {k for k, _ in homes}
    alone = [k for k, one in enumerate(flowing) if k not in housed and not one.is_point]
    crowd = {k for k in range(len(flowing)) if alone != [k]}
    before = 0.0
    for level, time in enumerate(TIMES.tolist(), 1):
        old = [one.points for one in flowing]
        for one in flowing:
            one.go_on(time - before)
        # The outermost first, since what is in them moves with them.
        for k, home in homes:
            weights = mean_value_weights(flowing[k].centre, old[home] @ AXES)
            flowing[k].shift(complex(weights @ ((flowing[home].points - old[home]) @ AXES)))
        before = time
        size = LEAST_SIZE ** max(0.0, (level - CROWDED) / (len(TIMES) - CROWDED))
        drawn = [(size if k in crowd else 1.0, one.centre) for k, one in enumerate(flowing)]
        for k, home in homes:  # with all that is in it
            scale, centre = drawn[home]
            drawn[k] = scale * drawn[k][0], centre + scale * (flowing[k].centre - flowing[home].centre)
        levels.append([one.segments(*place) for one, place in zip(flowing, drawn, strict=True)])
    return levels


def _homes(flowing: Sequence[_Flowing]) -> list[tuple[int, int]]:
    """Contours that lie inside another, and the smallest one around each; those with the largest homes first."""
    found = []
    for k, one in enumerate(flowing):
        around = [
            (abs(other.area()), number)
            for number, other in enumerate(flowing)
            if number != k
            and other.has_area
            and abs(other.area()) > abs(one.area())
            and winding_numbers(one.points[:1] @ AXES, other.points @ AXES)[0]
        ]
        if around:
            found.append((*min(around), k))
    return [(k, home) for _, home, k in sorted(found, reverse=True)]


class _Flowing:
    """A contour under the flow, as a polygon.

    Attributes
    ----------
    points : (n, 2) float
    """

    def __init__(self, outline: CubicPath) -> None:
        segments = outline.segments
        self._count = len(segments)
        self._pieces = min(MOST_PIECES, max(LEAST_PIECES, VERTICES // self._count))
        self._closed = outline.closed
        self._as_lines = bool(outline.straight.all())
        self.is_point = outline.is_point
        share = np.arange(self._pieces) / self._pieces
        z = cubics.evaluate(segments[:, None, :], share).ravel()
        if not outline.closed:
            z = np.append(z, segments[-1, 3])
        self.points = np.ascontiguousarray(np.stack([z.real, z.imag], axis=1))
        edges = np.diff(self.points, axis=0, append=self.points[:1])
        self._edge = float(np.hypot(edges[:, 0], edges[:, 1]).mean())
        self._area = self.area()
        # Where nothing has an area, the time is in units of a square of the size, and nothing is scaled.
        square = float(np.ptp(self.points, axis=0).max()) ** 2
        self.has_area = abs(self._area) > FLAT * square
        self._unit = abs(self._area) if self.has_area else square

    @property
    def centre(self) -> complex:
        """The mean of the vertices."""
        return complex(self.points.mean(axis=0) @ AXES)

    def area(self) -> float:
        """The area inside, of closed contours, with its sign."""
        return signed_area(np.asarray(self.points @ AXES)) if self._closed else 0.0

    def shift(self, by: complex) -> None:
        """Move the contour."""
        self.points = self.points + [by.real, by.imag]

    def go_on(self, time: float) -> None:
        """Let the contour flow, for a time in units of its area."""
        if self.is_point:
            return
        points = self.points.copy()
        scratch = np.empty((len(points), 3))
        for _ in range(STEPS):
            edges = np.diff(points, axis=0, append=points[:1])
            mean_edge = np.hypot(edges[:, 0], edges[:, 1]).mean()
            if mean_edge < VANISHING * self._edge:
                return  # what has no area shrinks to nothing, unless it is stopped
            shorten(points, scratch, self._closed, time / STEPS * self._unit, LEAST_EDGE * mean_edge)
            if self.has_area:
                now = abs(signed_area(np.asarray(points @ AXES)))
                centre = points.mean(axis=0)
                points -= centre
                points *= min(np.sqrt(abs(self._area) / now), MOST_GROWTH) if now else 1.0
                points += centre
        self.points = points

    def segments(self, scale: float, centre: complex) -> ComplexArray:
        """Lines, or the cubics that lie nearest to the vertices, so many times as large and around a centre."""
        z = self.points @ AXES
        z = centre + scale * (z - self.centre)
        whole = z.reshape(self._count, -1) if self._closed else z[:-1].reshape(self._count, -1)
        start = whole[:, 0]
        if self._as_lines:
            return cubics.lines(start if self._closed else np.append(start, z[-1]), self._closed)
        end = np.append(start[1:], z[0] if self._closed else z[-1])
        ends, inner = _fitting(self._pieces)
        within = whole[:, 1:] - np.stack([start, end], axis=1) @ ends
        return np.column_stack([start, within @ inner, end])


def _fitting(pieces: int) -> tuple[FloatArray, FloatArray]:
    """Least squares of a cubic with given ends through points at even parameters.

    Returns
    -------
    ends : (2, pieces - 1) float
        What the ends add to the points.
    inner : (pieces - 1, 2) float
        The inner control points, from what the ends leave.
    """
    u = np.arange(1, pieces) / pieces
    v = 1.0 - u
    ends = np.stack([v**3, u**3])
    inner = np.linalg.pinv(np.stack([3.0 * v * v * u, 3.0 * v * u * u])).copy()
    return ends, inner
