"""A band across an axis that opens from a line."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray


class Window(NamedTuple):
    """What lies along an axis, a unit vector, between two ends that move away from one place or from each other."""

    axis: complex
    start: float
    ends: tuple[float, float]

    def clip(self, z: ComplexArray, t: float) -> ComplexArray:
        """Return points, those outside of the band at time t moved along the axis to its nearer side."""
        low, high = (self.start + t * (end - self.start) for end in self.ends)
        turned = z * self.axis.conjugate()
        return np.asarray((np.clip(turned.real, low, high) + 1j * turned.imag) * self.axis)
