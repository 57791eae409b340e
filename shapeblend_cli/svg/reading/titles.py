"""The names of elements: ids, the labels of Inkscape, titles and descriptions; and shapes by their numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.model import Group, Name
from shapeblend_cli.svg.xml.messages import Problem
from shapeblend_cli.svg.xml.xmltree import Node

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Shape

MAX_ID = 1000
_MAX_TEXT = 10_000


def name_of(node: Node) -> Name:
    """Return the names of an element."""
    title, description = (
        next((child.text for child in node.children if child.tag == tag), None) for tag in ("title", "desc")
    )
    return Name(
        clean(node.get("id")), clean(_prefixed(node, "label")), clean_text(title), clean_text(description)
    )


def group_of(node: Node, number: int) -> Group:
    """Return an element as a group, with a number that tells it from others."""
    return Group(number, name_of(node), _prefixed(node, "groupmode") == "layer")


def clean(name: str | None) -> str | None:
    """Return an id without control characters, and not too long."""
    return "".join(c for c in name[:MAX_ID] if c.isprintable()) or None if name else None


def clean_text(text: str | None) -> str | None:
    """Return words with one blank between them, and not too many; None if there are none."""
    words = "".join(c if c.isprintable() else " " for c in (text or "")[:_MAX_TEXT]).split()
    return " ".join(words) or None


def _prefixed(node: Node, name: str) -> str | None:
    """Return the value of an attribute of another namespace than SVG's, which only editors write, by its local name."""
    return next((value for key, value in node.attrib.items() if key.endswith(f":{name}")), None)


def numbered(shapes: Sequence[Shape], numbers: Sequence[int]) -> list[Shape]:
    """Return the shapes with some numbers; raise a Problem for a number that none has."""
    found = [shape for shape in shapes if shape.index in numbers]
    missing = sorted({*numbers} - {shape.index for shape in found})
    if missing:
        last = max(shape.index for shape in shapes)
        known = f"0 to {last} would work" if last else "0 is the only one"
        raise Problem(f"it paints no shape {missing[0]}; {known}")
    return found
