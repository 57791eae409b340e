"""Where drawings lie: B over A, as ``--place`` says, and each polygon in the unit box of section 3.3."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.model import Box, Drawing, Polygon

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray


def place_over(a: Drawing, b: Drawing, place: str) -> Similarity:
    """Return the map that lays B over A.

    Parameters
    ----------
    a, b : Drawing
    place : {'viewbox', 'bbox', 'asis'}
        ``viewbox`` fits B's viewBox into A's, or the bounds of a drawing that has none. Two viewBoxes that are as wide
        or as high, as in sets of icons of one height, keep their scale: centre on centre. ``bbox`` fits the bounds of
        what is drawn, without the width of strokes. ``asis`` leaves B where it is.
    """
    if place == "asis":
        return Similarity()
    if place == "bbox":
        return fit_box(_bounds(b), _bounds(a))
    if (
        a.viewbox
        and b.viewbox
        and (a.viewbox.width == b.viewbox.width or a.viewbox.height == b.viewbox.height)
    ):
        return Similarity(1.0, a.viewbox.centre - b.viewbox.centre)
    return fit_box(b.viewbox or _bounds(b), a.viewbox or _bounds(a))


def fit_box(box: Box, into: Box) -> Similarity:
    """Fit a box into another, centre on centre, as SVG's ``xMidYMid meet`` does.

    A side of length 0 decides nothing.
    """
    ratios = [t / s for s, t in ((box.width, into.width), (box.height, into.height)) if s > 0.0 and t > 0.0]
    scale = min(ratios, default=1.0)
    return Similarity(scale, into.centre - scale * box.centre)


def _bounds(drawing: Drawing) -> Box:
    return Box.union(
        [cubics.bounds(contour.segments) for shape in drawing.shapes for contour in shape.contours]
    )


def to_unit_box(polygon: Polygon) -> ComplexArray:
    """Return the vertices in the unit box, section 3.3: divided by the larger side of the polygon's box."""
    box = polygon.box
    return (polygon.vertices - complex(box.x, box.y)) / box.larger_side
