"""Pictures of pixels in drawings."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

HALF_TURN = 180.0

ROUNDING = 1e-12
"""Tolerance of angles that are 0, in radians."""


@dataclass(frozen=True)
class Raster:
    """A picture as a PNG, JPEG or WebP file, upright as it is seen."""

    data: bytes
    kind: str  # its media type
    width: int  # in pixels
    height: int
    colour: str  # the mean, ``#rrggbb``
    is_opaque: bool

    @cached_property
    def digest(self) -> str:
        """A short name for the same bytes."""
        import hashlib  # most drawings have no pictures

        return hashlib.sha256(self.data).hexdigest()[:16]

    @cached_property
    def uri(self) -> str:
        """The picture as a link."""
        import base64

        return f"data:{self.kind};base64,{base64.b64encode(self.data).decode('ascii')}"

    def __repr__(self) -> str:
        return f"Raster({self.digest})"


class Pose(NamedTuple):
    """Where a picture is, by numbers that change evenly when it moves."""

    centre: complex
    angle: float  # in degrees, of its upper side
    skew: float  # in degrees, as ``skewX``
    width: float
    height: float  # signed: negative if it is a mirror image

    @property
    def is_upright(self) -> bool:
        """Whether its sides are parallel to the axes, and it is neither turned over nor upside down."""
        return self.angle == 0.0 and self.skew == 0.0 and self.width > 0.0 and self.height > 0.0

    @property
    def sides(self) -> tuple[complex, complex]:
        """The vectors along its upper and its left side."""
        unit = cmath.rect(1.0, math.radians(self.angle))
        return unit * self.width, unit * self.height * complex(math.tan(math.radians(self.skew)), 1.0)

    @property
    def corners(self) -> tuple[complex, complex, complex, complex]:
        """The corners from the picture's upper left one, clockwise as it is seen."""
        across, down = self.sides
        origin = self.centre - 0.5 * (across + down)
        return origin, origin + across, origin + across + down, origin + down

    @property
    def flipped(self) -> Pose:
        """The same place, by another angle."""
        angle = self.angle - math.copysign(HALF_TURN, self.angle)
        return self._replace(angle=angle, width=-self.width, height=-self.height)

    def near(self, other: Pose) -> Pose:
        """Return the same place by the numbers that are nearest to another's: it turns as little as can be."""
        is_other = (self.width * self.height < 0.0) != (other.width * other.height < 0.0)
        ways = (self, self.flipped) if is_other else (self,)
        if not is_other and (self.width < 0.0) != (other.width < 0.0):
            ways = (self.flipped,)
        turned = [way._replace(angle=_near(way.angle, other.angle)) for way in ways]
        return min(turned, key=lambda way: abs(way.angle - other.angle))

    def towards(self, other: Pose, t: float) -> Pose:
        """Return the pose at time t on the way to another one."""
        end = other.near(self)
        centre = (1.0 - t) * self.centre + t * end.centre
        return Pose(centre, *((1.0 - t) * p + t * q for p, q in zip(self[1:], end[1:], strict=True)))


class Picture(NamedTuple):
    """Paint that is a picture: a parallelogram, in the coordinates of the drawing, and nothing outside of it."""

    raster: Raster
    origin: complex  # where its upper left corner is
    across: complex  # from there to the upper right corner
    down: complex  # and to the lower left one
    is_smooth: bool = True  # between its pixels

    @property
    def is_upright(self) -> bool:
        """Whether its sides are parallel to the axes, and it is neither turned over nor upside down."""
        off = max(abs(self.across.imag), abs(self.down.real))
        return off <= ROUNDING * abs(self.across + self.down) and min(self.across.real, self.down.imag) > 0.0

    @property
    def pose(self) -> Pose:
        """Where it is, by numbers that change evenly."""
        width = abs(self.across)
        along = self.across / width if width else 1.0  # seen from its edge, it has no width
        turned = self.down * along.conjugate()
        height = turned.imag
        centre = self.origin + 0.5 * (self.across + self.down)
        angle, skew = (
            cmath.phase(self.across),
            math.atan2(turned.real, abs(height)) * math.copysign(1.0, height),
        )
        return Pose(centre, math.degrees(angle), math.degrees(skew), width, height)

    def posed(self, pose: Pose) -> Picture:
        """Return the picture at another place."""
        across, down = pose.sides
        return self._replace(origin=pose.centre - 0.5 * (across + down), across=across, down=down)


def _near(angle: float, other: float) -> float:
    """Return an angle in degrees, or that and full turns, next to another one."""
    return other + math.remainder(angle - other, 2.0 * HALF_TURN)
