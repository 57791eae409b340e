"""Motion as if shapes were moved by hand: turned, scaled and shifted, or turned over as cards are."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, Pose
    from shapeblend_cli.motion.alignment import Alignment

THINNEST = 0.1
"""Minimum size of a drawing across the axis about which it is turned over, as a share of its own: none vanishes."""

ON_EDGE = 0.45
"""Time at which what is turned over is seen from its edge: half way, the middle frame would be a line."""

BROADSIDE = 5
"""Power of the time by which it turns: broad for long, and thin for moments only."""


class Rigid(NamedTuple):
    """Motion in which a shape is rotated, scaled and shifted; all other change is on straight paths.

    A point from ``a`` to ``b`` is at time t at ``S(t) ((1 - t) a + t S^-1 b)``, where ``S(t)`` is the similarity
    ``S = S(1)`` as far as it has gone by then (`Alignment.apply`). If the shape is only rotated, ``S^-1 b`` is ``a``,
    and every in-between is that shape.
    """

    alignments: tuple[Alignment, ...]  # of each contour; contours of one part have the same

    @property
    def name(self) -> str:
        """The name for `--motion`."""
        return "rigid"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        return [
            alignment.apply(
                (1.0 - t) * (contour.start.segments - alignment.centre_a)
                + t * alignment.undo(contour.end.segments),
                t,
            )
            for contour, alignment in zip(contours, self.alignments, strict=True)
        ]


class Whole(NamedTuple):
    """Motion of a drawing that is turned as a whole, or turned over; all other change is on straight paths.

    It turns by `angle`, in radians, about its centre. Or what lies in the direction `over`, a unit vector, and what
    lies opposite change places: it is turned over about the axis at a right angle to that. Half way it is smaller by
    the share `dip`, and aside by `aside`, so that it stays in the picture.
    """

    centre_a: complex
    centre_b: complex
    angle: float = 0.0
    over: complex = 0j
    dip: float = 0.0
    aside: complex = 0j

    @property
    def name(self) -> str:
        """The name of the motion in reports."""
        return "flip" if self.over else "rigid"

    def undo(self, z: ComplexArray) -> ComplexArray:
        """Map points of B back over A's."""
        offsets = z - self.centre_b
        offsets = -(self.over**2) * offsets.conj() if self.over else offsets * cmath.rect(1.0, -self.angle)
        return self.centre_a + offsets

    def apply(self, z: ComplexArray, t: float = 1.0) -> ComplexArray:
        """Map points of A to time t."""
        offsets = z - self.centre_a
        if self.over:
            seen = turned_over(t)
            share = math.copysign(max(abs(seen), THINNEST), seen)
            offsets = offsets + (share - 1.0) * (offsets * self.over.conjugate()).real * self.over
        else:
            offsets = offsets * cmath.rect(1.0 - self.dip * math.sin(math.pi * t), self.angle * t)
        return self.middle(t) + offsets

    def middle(self, t: float) -> complex:
        """Return where the centre is at time t."""
        return (1.0 - t) * self.centre_a + t * self.centre_b + self.aside * math.sin(math.pi * t)

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        return [
            self.apply((1.0 - t) * contour.start.segments + t * self.undo(contour.end.segments), t)
            for contour in contours
        ]


def turned_over(t: float) -> float:
    """Return the size across the axis of what is turned over at time t, from 1 to -1, where it is its mirror image."""
    if t < ON_EDGE:
        return 1.0 - (t / ON_EDGE) ** BROADSIDE
    return ((1.0 - t) / (1.0 - ON_EDGE)) ** BROADSIDE - 1.0


class Posed(NamedTuple):
    """Motion of a picture from one pose to another; its corners are its outline."""

    start: Pose
    end: Pose

    @property
    def name(self) -> str:
        """The name of the motion in reports."""
        return "picture"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of the outline at time t."""
        return [cubics.lines(np.array(self.start.towards(self.end, t).corners), True) for _ in contours]
