"""SVG documents, by svgwrite."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree  # svgwrite has imported it anyway

from shapeblend_cli.svg.libraries import svgwrite
from shapeblend_cli.svg.writing.attributes import number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box


def empty(viewbox: Box, decimals: int) -> Any:
    """A document that draws nothing yet."""
    drawing = svgwrite.Drawing(debug=False, viewBox=box_text(viewbox, decimals))
    drawing.elements.remove(drawing.defs)
    return drawing


def box_text(box: Box, decimals: int) -> str:
    """A box as ``viewBox`` has it."""
    return " ".join(number(value, decimals) for value in box)


def text(drawing: Any, style: str | None = None, definitions: Sequence[ElementTree.Element] = ()) -> str:
    """Serialise, with a style sheet, with definitions, or without.

    What svgwrite adds unasked goes: a size of 100 %, a profile, two unused namespaces.
    """
    root = drawing.get_xml()
    for name in ("width", "height"):
        if root.get(name) == "100%":
            del root.attrib[name]
    for name in ("version", "baseProfile", "xmlns:ev", "xmlns:xlink"):
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
