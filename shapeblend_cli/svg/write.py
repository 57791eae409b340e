"""A frame to an SVG file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.svg import document
from shapeblend_cli.svg.attributes import paint_attributes, path_data, without_defaults

if TYPE_CHECKING:
    from shapeblend_cli.model import Frame


def frame_svg(frame: Frame, decimals: int) -> str:
    """One frame as an SVG document, coordinates with so many decimals."""
    drawing = document.empty(frame.view, decimals)
    for shape in frame.shapes:
        paint = without_defaults(paint_attributes(shape.style, decimals))
        drawing.add(drawing.path(d=path_data(shape.outlines, decimals), **paint))
    return document.text(drawing)
