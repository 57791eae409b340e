"""Viewports: the root's, and those that nested ``svg`` and ``symbol`` elements set up."""

from __future__ import annotations

import re

from shapeblend_cli.model import Box, Length, Page
from shapeblend_cli.svg.reading.titles import name_of
from shapeblend_cli.svg.styles.declarations import Declarations
from shapeblend_cli.svg.xml.messages import Notes
from shapeblend_cli.svg.xml.transforms import IDENTITY, Affine, transform_of, translation
from shapeblend_cli.svg.xml.units import LEAST, Lengths, length, measured, numbers
from shapeblend_cli.svg.xml.xmltree import Node

_MAX_LENGTH = 1000
_MAX_FIT = 10_000
_SHARES = {"min": 0.0, "mid": 0.5, "max": 1.0}


def viewbox(node: Node, notes: Notes) -> Box | None:
    """Return the viewBox of an element, or None when it has none that is valid."""
    text = node.get("viewBox")
    if text is None:
        return None
    try:
        x, y, width, height = numbers(text[:_MAX_LENGTH])
    except ValueError:
        width = height = 0.0
    if width < LEAST or height < LEAST:
        notes.add("an invalid viewBox ignored")
        return None
    return Box(x, y, width, height)


def root_box(root: Node, notes: Notes) -> Box | None:
    """Return the root's viewBox, else the box of its width and height."""
    box = viewbox(root, notes)
    if box is not None:
        return box
    width, height = (length(root.get(name) or "") for name in ("width", "height"))
    return Box(0.0, 0.0, width, height) if width and height and min(width, height) >= LEAST else None


def root_page(root: Node, box: Box | None) -> Page:
    """Return the size of the root as it is written, the box that it shows, and its names."""
    width, height = (_written(root.get(name) or "") for name in ("width", "height"))
    if box is None:
        return Page(name=name_of(root))
    words = (root.get("preserveAspectRatio") or "")[:_MAX_FIT].split()
    is_known = re.fullmatch(r"(none|x(Min|Mid|Max)Y(Min|Mid|Max))( meet| slice)?", " ".join(words))
    is_default = words in (["xMidYMid"], ["xMidYMid", "meet"])
    return Page(width, height, box, name_of(root), " ".join(words) if is_known and not is_default else "")


def root_pixel(root: Node, box: Box | None) -> float:
    """Return how long a CSS pixel is in the root's coordinates at its own size; 1 if it has none."""
    size = _root_size(root, box)
    if box is None or size is None:
        return 1.0
    return abs(fit(box, *size, root.get("preserveAspectRatio") or "").determinant) ** -0.5


def _root_size(root: Node, box: Box | None) -> tuple[float, float] | None:
    """Return the width and the height of the root in CSS pixels; None if it has none of its own."""
    width, height = (max(length(root.get(name) or "") or 0.0, 0.0) for name in ("width", "height"))
    if box is None or not (width or height):
        return None
    width, height = width or height * box.width / box.height, height or width * box.height / box.width
    return (width, height) if min(width, height) >= LEAST else None


def root_transform(root: Node, declared: Declarations, box: Box | None, notes: Notes) -> Affine:
    """Return the transform of the root in its own coordinates.

    It has a box in the page, as elements of HTML have: browsers apply transforms to that, in CSS pixels, and about its
    centre. Without a size a pixel is a unit.
    """
    lengths = root_lengths(box)
    width, height = _root_size(root, box) or (lengths.width, lengths.height)
    declared = {"transform-origin": "50% 50%", **declared}
    moved = transform_of(root, declared, Lengths(width, height), notes)
    if box is None or moved == IDENTITY:
        return moved
    inner = fit(box, width, height, root.get("preserveAspectRatio") or "")
    back = Affine(1.0 / inner.a, 0.0, 0.0, 1.0 / inner.d, -inner.e / inner.a, -inner.f / inner.d)
    return back @ moved @ inner


def _written(text: str) -> Length | None:
    """Return a length as it is written, if it is one that needs no font and is greater than 0."""
    found = measured(text)
    return found if found is not None and found.number > 0.0 else None


def root_lengths(box: Box | None) -> Lengths:
    """Return the lengths for percentages in the root's coordinates; without a size, browsers give it 300 by 150."""
    return Lengths(box.width, box.height) if box else Lengths(300.0, 150.0)


def nested(
    node: Node, given: tuple[str | None, str | None], outer: Lengths, notes: Notes
) -> tuple[Affine, Lengths, Box] | None:
    """Return the map out of a nested viewport, the lengths inside it, and its box outside; None without an area.

    A ``use`` that refers to the ``svg`` or ``symbol`` may have `given` it a width and a height.
    """
    width = outer.x(given[0] or node.get("width") or "100%")
    height = outer.y(given[1] or node.get("height") or "100%")
    width = outer.width if width is None else width
    height = outer.height if height is None else height
    if width <= 0 or height <= 0:
        return None
    x, y = offset(node, outer)
    matrix, window = translation(x, y), Box(x, y, width, height)
    box = viewbox(node, notes)
    if box is None:
        return matrix, outer._replace(width=width, height=height), window
    matrix = matrix @ fit(box, width, height, node.get("preserveAspectRatio") or "")
    return matrix, outer._replace(width=box.width, height=box.height), window


def offset(node: Node, lengths: Lengths) -> tuple[float, float]:
    """Return ``x`` and ``y`` of an element, 0 where one is not given."""
    return lengths.x(node.get("x") or "") or 0.0, lengths.y(node.get("y") or "") or 0.0


def fit(box: Box, width: float, height: float, preserve_aspect_ratio: str) -> Affine:
    """Return the map of a viewBox onto a viewport at the origin.

    https://www.w3.org/TR/SVG2/coords.html#ComputingAViewportsTransform
    """
    words = preserve_aspect_ratio[:_MAX_FIT].replace("defer", "").split()
    align = words[0].lower() if words else "xmidymid"
    x_scale, y_scale = width / box.width, height / box.height
    if align != "none":
        x_scale = y_scale = max(x_scale, y_scale) if words[1:2] == ["slice"] else min(x_scale, y_scale)
    free_x, free_y = width - x_scale * box.width, height - y_scale * box.height
    match = re.fullmatch(r"x(min|mid|max)y(min|mid|max)", align)
    share_x, share_y = (_SHARES[word] for word in (match.groups() if match else ("mid", "mid")))
    x, y = share_x * free_x - x_scale * box.x, share_y * free_y - y_scale * box.y
    return Affine(x_scale, 0.0, 0.0, y_scale, x, y)
