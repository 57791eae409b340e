"""Similarities: laying one drawing over another, and the unit box of section 3.3."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.model import Box, Contour, Polygon

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray


class Similarity(NamedTuple):
    """Uniform scaling and a shift: ``z -> scale * z + shift``."""

    scale: float = 1.0
    shift: complex = 0j

    def points(self, z: ComplexArray) -> ComplexArray:
        """Map points."""
        return self.scale * z + self.shift

    def box(self, box: Box | None) -> Box | None:
        """Map a box, if there is one."""
        if box is None:
            return None
        corner = self.scale * complex(box.x, box.y) + self.shift
        return Box(corner.real, corner.imag, self.scale * box.width, self.scale * box.height)

    def contour(self, contour: Contour) -> Contour:
        """Map a contour."""
        return replace(contour, segments=self.points(contour.segments))


def box_of(points: ComplexArray) -> Box:
    """The box of a set of points."""
    x, y = points.real, points.imag
    return Box(float(x.min()), float(y.min()), float(np.ptp(x)), float(np.ptp(y)))


def union(boxes: list[Box]) -> Box:
    """The box around boxes, of which there is at least one."""
    x, y = min(b.x for b in boxes), min(b.y for b in boxes)
    return Box(x, y, max(b.x + b.width for b in boxes) - x, max(b.y + b.height for b in boxes) - y)


def grown(box: Box, reach: float) -> Box:
    """The box moved outwards on all sides."""
    return Box(box.x - reach, box.y - reach, box.width + 2 * reach, box.height + 2 * reach)


def holds(outer: Box, inner: Box, slack: float) -> bool:
    """Whether a box lies inside another, or sticks out by no more than `slack`."""
    return (
        inner.x >= outer.x - slack
        and inner.y >= outer.y - slack
        and inner.x + inner.width <= outer.x + outer.width + slack
        and inner.y + inner.height <= outer.y + outer.height + slack
    )


def between_boxes(a: Box, b: Box, t: float) -> Box:
    """The box on the way from one to another."""
    return Box(*((1.0 - t) * x + t * y for x, y in zip(a, b, strict=True)))


def lay_over(box: Box, onto: Box) -> Similarity:
    """Fit a box into another, centre on centre, as SVG's ``xMidYMid meet`` does.

    A side of length 0 decides nothing.
    """
    ratios = [t / s for s, t in ((box.width, onto.width), (box.height, onto.height)) if s > 0.0 and t > 0.0]
    scale = min(ratios, default=1.0)
    return Similarity(scale, _centre(onto) - scale * _centre(box))


def _centre(box: Box) -> complex:
    return complex(box.x + box.width / 2, box.y + box.height / 2)


def to_unit_box(polygon: Polygon) -> tuple[ComplexArray, float]:
    """Map a polygon into the unit box, section 3.3: the larger side of its box becomes 1.

    Returns
    -------
    vertices : (m,) complex
    scale : float > 0
        What the coordinates were divided by, after the box's corner was moved to the origin.
    """
    box = box_of(polygon.vertices)
    scale = max(box.width, box.height)
    return (polygon.vertices - complex(box.x, box.y)) / scale, scale
