"""SVG documents, by svgwrite."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree  # svgwrite has imported it anyway

from shapeblend_cli.svg.attributes import number
from shapeblend_cli.svg.foreign import svgwrite

if TYPE_CHECKING:
    from shapeblend_cli.model import Box


def empty(viewbox: Box, decimals: int) -> Any:
    """A document that draws nothing yet."""
    drawing = svgwrite.Drawing(debug=False, viewBox=" ".join(number(v, decimals) for v in viewbox))
    drawing.elements.remove(drawing.defs)
    return drawing


def text(drawing: Any) -> str:
    """Serialise without what svgwrite adds unasked: a size of 100 %, a profile, two unused namespaces."""
    root = drawing.get_xml()
    for name in ("width", "height", "version", "baseProfile", "xmlns:ev", "xmlns:xlink"):
        root.attrib.pop(name, None)
    return ElementTree.tostring(root, encoding="unicode") + "\n"
