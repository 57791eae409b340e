"""Similarities: laying one drawing over another, and the unit box of section 3.3."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.model import Box, Polygon

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray


def lay_over(box: Box, onto: Box) -> Similarity:
    """Fit a box into another, centre on centre, as SVG's ``xMidYMid meet`` does.

    A side of length 0 decides nothing.
    """
    ratios = [t / s for s, t in ((box.width, onto.width), (box.height, onto.height)) if s > 0.0 and t > 0.0]
    scale = min(ratios, default=1.0)
    return Similarity(scale, onto.centre - scale * box.centre)


def to_unit_box(polygon: Polygon) -> tuple[ComplexArray, float]:
    """Map a polygon into the unit box, section 3.3: the larger side of its box becomes 1.

    Returns
    -------
    vertices : (m,) complex
    scale : float > 0
        What the coordinates were divided by, after the box's corner was moved to the origin.
    """
    box = Box.around(polygon.vertices)
    scale = box.larger_side
    return (polygon.vertices - complex(box.x, box.y)) / scale, scale
