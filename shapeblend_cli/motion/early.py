"""Motion of shapes of which parts without a partner leave early, come late, or go with the pen line that they touch."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.paths import paths_at

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, CubicPath, Motion, ShapeBlend

    Numbers = tuple[int | None, int | None]  # of a contour in both drawings

SPEED = ((0.0, 0.15, 1.0), (0.0, 0.4, 1.0))
"""Shares of a part's own time, and its sizes at these, so that its area changes about evenly."""

PIECES = 4
"""Number of straight pieces of a curve that is looked at."""


class Ride(NamedTuple):
    """A place on a pen line, and the line on its way."""

    line: ShapeBlend
    place: float  # in points of the line, from 0

    def at(self, t: float) -> complex:
        """Return where the place is at time t."""
        points = points_of(self.line, t)
        return complex(np.interp(self.place, np.arange(len(points)), points))


class Edge(NamedTuple):
    """The edge that closes a gap, in the segments of the contour that comes to lie on it, on its way."""

    a: ComplexArray
    b: ComplexArray

    def at(self, t: float) -> ComplexArray:
        """Return its control points at time t."""
        return (1.0 - t) * self.a + t * self.b


class Early(NamedTuple):
    """Another motion, or straight paths, in which parts without a partner are points for longer, or ride on lines."""

    motion: Motion | None
    small: Mapping[Numbers, float]  # the contours that are, each for this share of the time
    rides: Mapping[Numbers, Ride | Edge] = MappingProxyType({})
    knots: tuple[float, ...] = ()  # times at which parts change their speed, if by `SPEED`

    @property
    def name(self) -> str:
        """The name of the motion of the others."""
        return self.motion.name if self.motion else "linear"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        if self.motion is None:
            moved = [contour.straight(t) for contour in contours]
        else:
            moved = self.motion.segments(contours, t)
        return [self._own(contour, own, t) for contour, own in zip(contours, moved, strict=True)]

    def _own(self, contour: ContourBlend, segments: ComplexArray, t: float) -> ComplexArray:
        """Return the control points of a contour at time t, which would otherwise be these."""
        numbers, whole = contour.numbers, contour.path(contour.whole_at)
        size = t if contour.grows else 1.0 - t
        left = self._left(numbers, size)
        if numbers in self.rides:
            ride = self.rides[numbers]
            return np.asarray(ride.at(t) + left * (whole.segments - ride.at(float(contour.grows))))
        if self.small.get(numbers, 0.0):
            middle = segments[:, 0].mean()
            here = middle + self._slide(contour, whole, segments, size) if contour.root else middle
            return np.asarray(here + left / max(size, 1e-9) * (segments - middle))
        return segments

    def _left(self, numbers: Numbers, size: float) -> float:
        """Return how large a part is, from 0 to 1, where it would have a size if it changed all of the time.

        It is nothing during its share of the time, and grows to 1 after that; without a share it has that size.
        """
        share = self.small.get(numbers, 0.0)
        left = max(0.0, (size - share) / (1.0 - share))
        return float(np.interp(left, *SPEED)) if share and self.knots else left

    def _slide(self, contour: ContourBlend, whole: CubicPath, segments: ComplexArray, size: float) -> complex:
        """Return how far the middle of a contour is from where it would be: its body stays where it is attached."""
        assert contour.root is not None, "it is attached"
        middles = [each[:, 0].mean() for each in (segments, whole.segments)]
        ways = [each[:, 0] - middle for each, middle in zip((segments, whole.segments), middles, strict=True)]
        turned = (ways[1].conj() @ ways[0]) / max(float((np.abs(ways[1]) ** 2).sum()), 1e-12)
        from_root = turned * (middles[1] - contour.root.place)
        body = contour.alone(contour.root.body)
        return complex((self._left(body, size) / max(size, 1e-9) - 1.0) * from_root)


def points_of(line: ShapeBlend, t: float) -> ComplexArray:
    """Return the points of a pen line at time t, always as many."""
    (path,) = paths_at(line, t)
    return np.append(cubics.polyline(path.segments, PIECES), path.segments[-1, 3])
