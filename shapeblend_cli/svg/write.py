"""A frame to an SVG file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from shapeblend_cli.model import LinearGradient
from shapeblend_cli.svg import document
from shapeblend_cli.svg.attributes import (
    gradient_attributes,
    paint_attributes,
    path_data,
    plainest,
    without_defaults,
)

if TYPE_CHECKING:
    from shapeblend_cli.model import Frame, Gradient


def frame_svg(frame: Frame, decimals: int) -> str:
    """One frame as an SVG document, coordinates with so many decimals."""
    drawing = document.empty(frame.view, decimals)
    gradients = _Gradients(drawing, decimals)
    for shape in frame.shapes:
        data = path_data(shape.outlines, decimals)
        # At the end of time what is below is covered, and would only show at antialiased edges.
        styles = [shape.style] if shape.below is None or frame.t == 1.0 else [shape.below, shape.style]
        for style in map(plainest, styles):
            paint = paint_attributes(style, decimals)
            for name, gradient in (("fill", style.fill_gradient), ("stroke", style.stroke_gradient)):
                if gradient is not None:
                    paint[name] = gradients.link(gradient)
            drawing.add(drawing.path(d=data, **without_defaults(paint)))
    return document.text(drawing)


class _Gradients:
    """The gradients of a document, each written once.

    Parameters
    ----------
    drawing : Drawing
        Takes the definitions before anything is drawn.
    decimals : int
    """

    def __init__(self, drawing: Any, decimals: int) -> None:
        self._drawing = drawing
        self._decimals = decimals
        self._names: dict[Gradient, str] = {}

    def link(self, gradient: Gradient) -> str:
        """What a fill or a stroke says to be painted in a gradient."""
        if gradient not in self._names:
            self._names[gradient] = f"gradient-{len(self._names) + 1}"
            self._define(gradient, self._names[gradient])
        return f"url(#{self._names[gradient]})"

    def _define(self, gradient: Gradient, name: str) -> None:
        drawing = self._drawing
        if drawing.defs not in drawing.elements:
            drawing.elements.insert(0, drawing.defs)
        attributes, stops = gradient_attributes(gradient, self._decimals)
        make = drawing.linearGradient if isinstance(gradient, LinearGradient) else drawing.radialGradient
        element = make(id=name, **attributes)
        for stop in stops:
            element.add_stop_color(stop["offset"], stop["stop_color"], stop["stop_opacity"])
        drawing.defs.add(element)
