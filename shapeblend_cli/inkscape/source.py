"""A document of Inkscape as text: where its elements begin and end, so that all else stays as it is."""

from __future__ import annotations

import re
from typing import NamedTuple
from xml.parsers import expat

from shapeblend_cli.svg.xml.transforms import IDENTITY, Affine, parse

_TAG = re.compile(rb"""<(?:[^"'>]|"[^"]*"|'[^']*')*+>""")


class Element(NamedTuple):
    """An element, and where it is."""

    id: str | None
    transform: str
    is_layer: bool
    parent: int | None  # its number among all elements
    start: int  # in bytes
    end: int


class Document(NamedTuple):
    """The bytes of a file, and its elements in their order."""

    data: bytes
    elements: list[Element]

    @classmethod
    def of(cls, data: bytes) -> Document:
        """Read a document, which is well-formed."""
        elements: list[Element] = []
        around: list[int] = []
        parser = expat.ParserCreate()

        def start(name: str, attributes: dict[str, str]) -> None:
            is_layer = any(key.endswith(":groupmode") and attributes[key] == "layer" for key in attributes)
            parent = around[-1] if around else None
            found = attributes.get("id"), attributes.get("transform", ""), is_layer, parent
            around.append(len(elements))
            elements.append(Element(*found, parser.CurrentByteIndex, 0))

        def end(name: str) -> None:
            at = parser.CurrentByteIndex
            tag = _TAG.match(data, at)
            number = around.pop()
            elements[number] = elements[number]._replace(end=tag.end() if tag else at)

        parser.StartElementHandler, parser.EndElementHandler = start, end
        parser.Parse(data, True)
        return cls(data, elements)

    def number_of(self, name: str) -> int | None:
        """Return the number of the element with an id."""
        return next((k for k, element in enumerate(self.elements) if element.id == name), None)

    def ancestors(self, number: int) -> list[int]:
        """Return the numbers of the elements around one, the root first."""
        found: list[int] = []
        parent = self.elements[number].parent
        while parent is not None:
            found.append(parent)
            parent = self.elements[parent].parent
        return found[::-1]

    def matrix_in(self, numbers: list[int]) -> Affine:
        """Return the map to the root's coordinates from inside of elements, the root first."""
        matrix = IDENTITY
        for number in numbers[1:]:
            matrix = matrix @ (parse(self.elements[number].transform) or IDENTITY)
        return matrix

    def with_text_after(self, number: int, text: str) -> bytes:
        """Return the document with a text after an element."""
        at = self.elements[number].end
        return self.data[:at] + text.encode("utf-8") + self.data[at:]
