"""Where the lengths and places of a filter are in the drawing."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.model import Box

if TYPE_CHECKING:
    from shapeblend_cli.svg.xml.transforms import Affine
    from shapeblend_cli.svg.xml.units import Lengths

STRAIGHT = 1e-9
"""Tolerance of a map that leaves axes parallel to themselves, as a share of its largest number."""


class Units(NamedTuple):
    """What numbers of a filter mean: the map of its element to the root, and the box if they are shares of it."""

    matrix: Affine
    box: Box | None
    lengths: Lengths

    @property
    def scale(self) -> float:
        """The factor of lengths that have no direction."""
        return float(abs(self.matrix.determinant) ** 0.5)

    def own(self, x: float, y: float) -> tuple[float, float]:
        """Return lengths in the units of the element."""
        return (x, y) if self.box is None else (x * self.box.width, y * self.box.height)

    def spread(self, x: float, y: float) -> tuple[float, float]:
        """Return a horizontal and a vertical length without sign, in the root's coordinates."""
        x, y = self.own(x, y)
        a, b, c, d, *_ = self.matrix
        slack = STRAIGHT * max(map(abs, (a, b, c, d)))
        if max(abs(b), abs(c)) <= slack:
            return abs(a) * x, abs(d) * y
        if max(abs(a), abs(d)) <= slack:
            return abs(c) * y, abs(b) * x
        return self.scale * x, self.scale * y

    def vector(self, x: float, y: float) -> tuple[float, float]:
        """Return an offset in the root's coordinates."""
        x, y = self.own(x, y)
        a, b, c, d, *_ = self.matrix
        return a * x + c * y, b * x + d * y

    def point(self, x: float, y: float) -> tuple[float, float]:
        """Return a place in the root's coordinates."""
        if self.box is not None:
            x, y = self.box.x + x * self.box.width, self.box.y + y * self.box.height
        at = complex(self.matrix.points(np.array([complex(x, y)]))[0])
        return at.real, at.imag

    def region(self, box: Box) -> Box:
        """Return the box around a box of the element, in the root's coordinates."""
        corners = [complex(x, y) for x in (box.x, box.x + box.width) for y in (box.y, box.y + box.height)]
        return Box.around(self.matrix.points(np.array(corners)))
