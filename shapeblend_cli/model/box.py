"""Boxes parallel to the axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model.arrays import BoolArray, ComplexArray

ENCLOSING = 0.05
"""Maximum distance of points from the sides of a box that they enclose, as a share of its smaller side."""


class Box(NamedTuple):
    """An axis-parallel box: a viewBox, or the bounds of a drawing."""

    x: float
    y: float
    width: float
    height: float

    @classmethod
    def around(cls, points: ComplexArray) -> Box:
        """Return the smallest box around points."""
        x, y = points.real, points.imag
        left, top = float(x.min()), float(y.min())
        return cls(left, top, float(x.max()) - left, float(y.max()) - top)

    @classmethod
    def union(cls, boxes: Sequence[Box]) -> Box:
        """Return the smallest box around one or more boxes."""
        if len(boxes) == 1:  # most drawings have one contour; its sides are rounded as those of several are
            x, y, width, height = boxes[0]
            return cls(x, y, x + width - x, y + height - y)
        x, y = min(b.x for b in boxes), min(b.y for b in boxes)
        return cls(x, y, max(b.x + b.width for b in boxes) - x, max(b.y + b.height for b in boxes) - y)

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Left, top, right and bottom."""
        return self.x, self.y, self.x + self.width, self.y + self.height

    @property
    def centre(self) -> complex:
        """The point in the middle."""
        return complex(self.x + self.width / 2, self.y + self.height / 2)

    @property
    def larger_side(self) -> float:
        """The larger of width and height."""
        return max(self.width, self.height)

    @property
    def diagonal(self) -> float:
        """Distance between opposite corners."""
        return abs(complex(self.width, self.height))

    @property
    def area(self) -> float:
        """Width times height."""
        return self.width * self.height

    def expanded(self, margin: float) -> Box:
        """Return the box with each side moved outwards."""
        return Box(self.x - margin, self.y - margin, self.width + 2 * margin, self.height + 2 * margin)

    def contains(self, other: Box, slack: float = 0.0) -> bool:
        """Return whether another box lies inside, or protrudes by at most `slack`."""
        left, top, right, bottom = self.bounds
        x0, y0, x1, y1 = other.bounds
        return x0 >= left - slack and y0 >= top - slack and x1 <= right + slack and y1 <= bottom + slack

    def holds(self, points: ComplexArray) -> BoolArray:
        """Return which points lie inside or on the edge."""
        left, top, right, bottom = self.bounds
        x, y = points.real, points.imag
        inside: BoolArray = (left <= x) & (x <= right) & (top <= y) & (y <= bottom)
        return inside

    def overlaps(self, other: Box) -> bool:
        """Return whether two boxes have interior points in common."""
        left, top, right, bottom = self.bounds
        x0, y0, x1, y1 = other.bounds
        return left < x1 and x0 < right and top < y1 and y0 < bottom

    def is_enclosed_by(self, points: ComplexArray) -> bool:
        """Return whether points reach all sides of the box, nearly."""
        return self.sides_apart(Box.around(points)) <= ENCLOSING * min(self.width, self.height)

    def sides_apart(self, other: Box) -> float:
        """Return the largest distance between a side and that of another box."""
        return max(abs(x - y) for x, y in zip(self.bounds, other.bounds, strict=True))

    def intersection(self, other: Box) -> float:
        """Return the area common to two boxes."""
        left, top, right, bottom = self.bounds
        x0, y0, x1, y1 = other.bounds
        return max(0.0, min(right, x1) - max(left, x0)) * max(0.0, min(bottom, y1) - max(top, y0))

    def grid(self, side: int) -> ComplexArray:
        """Return `side` by `side` points evenly spread over the box, (side²,) complex."""
        across = (np.arange(side) + 0.5) / side
        return (self.x + self.width * across[:, None] + 1j * (self.y + self.height * across)).ravel()

    def interpolate(self, other: Box, t: float) -> Box:
        """Return the box at time t between this one and another."""
        return Box(*((1.0 - t) * p + t * q for p, q in zip(self, other, strict=True)))
