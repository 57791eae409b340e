"""A frame to an SVG file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from xml.etree.ElementTree import Element, SubElement

from shapeblend_cli.model import LinearGradient
from shapeblend_cli.svg.writing import document
from shapeblend_cli.svg.writing.attributes import (
    gradient_attributes,
    paint_attributes,
    path_data,
    plainest,
    without_defaults,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Frame, Gradient, PaintedShape


def frame_svg(frame: Frame, decimals: int) -> str:
    """One frame as an SVG document, coordinates with so many decimals."""
    drawing = document.empty(frame.view, decimals)
    gradients = Gradients(decimals)
    for shape in frame.shapes:
        add_shape(drawing, drawing, gradients, shape, path_data(shape.paths, decimals), frame.t)
    return document.text(drawing, definitions=gradients.elements)


def add_shape(
    parent: Any, drawing: Any, gradients: Gradients, shape: PaintedShape, data: str, t: float
) -> None:
    """Add a shape to a document or to a group in it: a path, or two where one paint dissolves into another."""
    # At the end of time what is below is covered, and would only show at antialiased edges.
    styles = [shape.style] if shape.below is None or t == 1.0 else [shape.below, shape.style]
    for style in map(plainest, styles):
        paint = paint_attributes(style, gradients.decimals)
        for name, gradient in (("fill", style.fill_gradient), ("stroke", style.stroke_gradient)):
            if gradient is not None:
                paint[name] = gradients.link(gradient)
        parent.add(drawing.path(d=data, **without_defaults(paint)))


class Gradients:
    """The gradients of a document, each written once.

    Attributes
    ----------
    decimals : int
        Of coordinates.
    elements : list of Element
    """

    def __init__(self, decimals: int) -> None:
        self.decimals = decimals
        self.elements: list[Element] = []
        self._names: dict[Gradient, str] = {}

    def link(self, gradient: Gradient) -> str:
        """What a fill or a stroke says to be painted in a gradient."""
        if gradient not in self._names:
            self._names[gradient] = f"gradient-{len(self._names) + 1}"
            written = gradient_attributes(gradient, self.decimals)
            self.elements.append(gradient_element(self._names[gradient], gradient, *written))
        return f"url(#{self._names[gradient]})"


def gradient_element(
    name: str, gradient: Gradient, attributes: dict[str, str], stops: Sequence[dict[str, str]]
) -> Element:
    """The definition of a gradient, from what `gradient_attributes` says of it."""
    tag = "linearGradient" if isinstance(gradient, LinearGradient) else "radialGradient"
    element = Element(tag, {"id": name, **attributes})
    for stop in stops:
        SubElement(element, "stop", {key.replace("_", "-"): value for key, value in stop.items()})
    return element
