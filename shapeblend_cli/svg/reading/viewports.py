"""Viewports: the root's, and those that nested ``svg`` and ``symbol`` elements set up."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.model import Box
from shapeblend_cli.svg.reading import transforms
from shapeblend_cli.svg.reading.units import NumberError, length, numbers

if TYPE_CHECKING:
    from shapeblend_cli.svg.reading.notes import Notes
    from shapeblend_cli.svg.reading.xmltree import Node

Size = tuple[float, float]

_MAX_LENGTH = 1000
_DEFAULT: Size = (300.0, 150.0)
"""What browsers give a drawing without a size of its own."""


def viewbox(node: Node, notes: Notes) -> Box | None:
    """Return the viewBox of an element, or None when it has none that is valid."""
    text = node.get("viewBox")
    if text is None:
        return None
    try:
        x, y, width, height = numbers(text[:_MAX_LENGTH])
    except (NumberError, ValueError):
        width = height = 0.0
    if width <= 0 or height <= 0:
        notes.add("an invalid viewBox ignored")
        return None
    return Box(x, y, width, height)


def root_box(root: Node, notes: Notes) -> Box | None:
    """Return the root's viewBox, else the box of its width and height."""
    box = viewbox(root, notes)
    if box is not None:
        return box
    width, height = (length(root.get(name) or "") for name in ("width", "height"))
    return Box(0.0, 0.0, width, height) if width and height and width > 0 and height > 0 else None


def root_size(box: Box | None) -> Size:
    """Return what percentages refer to in the root's coordinates."""
    return (box.width, box.height) if box else _DEFAULT


def nested(
    node: Node, given: tuple[str | None, str | None], outer: Size, font_size: float, notes: Notes
) -> tuple[transforms.Matrix, Size] | None:
    """Return the map out of a nested viewport, and its size in its own units.

    Parameters
    ----------
    node : Node
        An ``svg`` or a ``symbol``.
    given : pair of str or None
        The width and the height of the ``use`` that refers to it.
    outer : pair of float
        The size of the viewport around it.
    font_size : float
    notes : Notes

    Returns
    -------
    tuple or None
        None when the viewport has no area: then nothing in it is drawn.
    """
    x, y = offset(node, outer, font_size)
    width = length(given[0] or node.get("width") or "100%", outer[0], font_size)
    height = length(given[1] or node.get("height") or "100%", outer[1], font_size)
    width = outer[0] if width is None else width
    height = outer[1] if height is None else height
    if width <= 0 or height <= 0:
        return None
    matrix = transforms.translation(x, y)
    box = viewbox(node, notes)
    if box is None:
        return matrix, (width, height)
    fit = transforms.viewbox_fit(box, width, height, node.get("preserveAspectRatio") or "")
    return transforms.multiply(matrix, fit), (box.width, box.height)


def offset(node: Node, outer: Size, font_size: float) -> tuple[float, float]:
    """Return ``x`` and ``y`` of an element, 0 where one is not given."""
    x = length(node.get("x") or "", outer[0], font_size)
    y = length(node.get("y") or "", outer[1], font_size)
    return x or 0.0, y or 0.0
