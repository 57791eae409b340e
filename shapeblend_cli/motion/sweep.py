"""Motion in which outlines are laid bare, as a blind is drawn, and nothing else moves."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend


class Window(NamedTuple):
    """A band across an axis, a unit vector, that opens from a line; all are lengths along the axis."""

    axis: complex
    start: float
    ends: tuple[float, float]  # of the open window

    def clip(self, z: ComplexArray, t: float) -> ComplexArray:
        """Return points at time t: those outside of the band are moved along the axis to its nearer side."""
        low, high = (self.start + t * (end - self.start) for end in self.ends)
        turned = z * self.axis.conjugate()
        return np.asarray((np.clip(turned.real, low, high) + 1j * turned.imag) * self.axis)


class Sweep(NamedTuple):
    """Motion of contours that are seen through windows, which open where a contour grows and close where it shrinks."""

    windows: tuple[Window | None, ...]  # of each contour; None for one that stays

    @property
    def name(self) -> str:
        """The motion's name in reports; it cannot be asked for."""
        return "sweep"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        return [
            contour.start.segments
            if window is None
            else window.clip(contour.end.segments, t)
            if contour.grows
            else window.clip(contour.start.segments, 1.0 - t)
            for contour, window in zip(contours, self.windows, strict=True)
        ]
