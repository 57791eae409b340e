"""SVG documents, by svgwrite: empty ones, frames, and their text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any
from xml.etree import ElementTree  # svgwrite has imported it anyway

from shapeblend_cli.model import Box, Frame
from shapeblend_cli.svg.libraries import svgwrite
from shapeblend_cli.svg.writing.paint import Gradients, visible_styles
from shapeblend_cli.svg.writing.path_data import path_data
from shapeblend_cli.svg.writing.rounding import number


def empty(viewbox: Box, decimals: int) -> Any:
    """Return an svgwrite drawing that draws nothing yet."""
    drawing = svgwrite.Drawing(debug=False, viewBox=box_text(viewbox, decimals))
    drawing.elements.remove(drawing.defs)
    return drawing


def box_text(box: Box, decimals: int) -> str:
    """Return the value of ``viewBox``."""
    return " ".join(number(value, decimals) for value in box)


def text(drawing: Any, style: str | None = None, definitions: Sequence[ElementTree.Element] = ()) -> str:
    """Return the text of a drawing, with a style sheet and definitions if there are any.

    What svgwrite adds unasked is removed: a size of 100 %, a profile, unused namespaces.
    """
    root = drawing.get_xml()
    for name in ("width", "height"):
        if root.get(name) == "100%":
            del root.attrib[name]
    unused = ["version", "baseProfile", "xmlns:ev"]
    if not any("xlink:href" in element.attrib for element in root.iter()):
        unused.append("xmlns:xlink")
    for name in unused:
        root.attrib.pop(name, None)
    if definitions:
        holder = ElementTree.Element("defs")
        holder.extend(definitions)
        root.insert(0, holder)
    if style is not None:
        sheet = ElementTree.Element("style")
        sheet.text = style
        root.insert(0, sheet)
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def frame_svg(frame: Frame, decimals: int) -> str:
    """Return a frame as an SVG document, its coordinates rounded to so many decimals."""
    drawing = empty(frame.view, decimals)
    gradients = Gradients(decimals)
    for shape in frame.shapes:
        data = path_data(shape.paths, decimals)
        for style in visible_styles(shape, frame.t):
            drawing.add(drawing.path(d=data, **gradients.attributes(style)))
    return text(drawing, definitions=gradients.elements)
