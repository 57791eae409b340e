"""A shape element into contours in its own coordinates."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from shapeblend_cli.svg import basic_shapes, pathdata
from shapeblend_cli.svg.problem import Problem
from shapeblend_cli.svg.style import diagonal
from shapeblend_cli.svg.units import NumberError, length, numbers

if TYPE_CHECKING:
    from shapeblend_cli.model import Contour
    from shapeblend_cli.svg.css import Declarations
    from shapeblend_cli.svg.notes import Notes
    from shapeblend_cli.svg.xmltree import Node

POINT_LISTS = frozenset(("path", "polyline", "polygon"))
SHAPES = POINT_LISTS | {"rect", "circle", "ellipse", "line"}

_CSS_PATH = r"""path\(\s*+(?:(?:nonzero|evenodd)\s*+,\s*+)?(["'])([^"']*+)\1\s*+\)"""


def outline(
    node: Node, declared: Declarations, viewport: tuple[float, float], font_size: float, notes: Notes
) -> list[Contour]:
    """Return the contours of a shape; none when it has no extent.

    Parameters
    ----------
    node : Node
        With a tag out of `SHAPES`.
    declared : dict
        What the cascade gives it: in SVG 2 sizes are properties too.
    viewport : pair of float
        What percentages refer to.
    font_size : float
        What 1em is.
    notes : Notes

    Raises
    ------
    Problem
        If path data or points break the grammar.
    """
    if node.tag == "path":
        return _path(node, declared)
    if node.tag in ("polyline", "polygon"):
        contour = _points(node, notes)
    else:
        contour = _Sizes(node, declared, viewport, font_size, notes).contour()
    return [] if contour is None else [contour]


def _path(node: Node, declared: Declarations) -> list[Contour]:
    data = node.get("d") or ""
    if "d" in declared:
        match = re.fullmatch(_CSS_PATH, declared["d"])
        data = match[2] if match else "" if declared["d"] == "none" else data
    try:
        return pathdata.read(data)
    except pathdata.PathDataError as error:
        raise Problem(f"{node}: {error}") from None


def _points(node: Node, notes: Notes) -> Contour | None:
    try:
        values = numbers(node.get("points") or "")
    except NumberError as error:
        raise Problem(f"{node}: at character {error.offset + 1} of its points: found {error.found}") from None
    if len(values) > 2 * pathdata.MAX_SEGMENTS:
        raise Problem(f"{node}: more than {pathdata.MAX_SEGMENTS} points, the most that are read")
    if len(values) % 2:
        notes.add("a last coordinate without a partner left out")
    points = [complex(x, y) for x, y in zip(values[::2], values[1::2], strict=False)]
    return basic_shapes.polyline(points, closed=node.tag == "polygon")


class _Sizes:
    """The lengths that make up a basic shape."""

    def __init__(
        self,
        node: Node,
        declared: Declarations,
        viewport: tuple[float, float],
        font_size: float,
        notes: Notes,
    ) -> None:
        self._node = node
        self._declared = declared
        self._viewport = viewport
        self._font_size = font_size
        self._notes = notes

    def contour(self) -> Contour | None:
        """Return the shape's contour."""
        tag = self._node.tag
        if tag == "rect":
            width, height = self._across("width"), self._down("height")
            radii = (self._across("rx"), self._down("ry"))
            return basic_shapes.rect(
                self._across("x") or 0.0, self._down("y") or 0.0, width or 0.0, height or 0.0, radii
            )
        if tag == "line":
            start = complex(self._across("x1") or 0.0, self._down("y1") or 0.0)
            end = complex(self._across("x2") or 0.0, self._down("y2") or 0.0)
            return basic_shapes.polyline([start, end], closed=False)
        cx, cy = self._across("cx") or 0.0, self._down("cy") or 0.0
        if tag == "circle":
            r = self._length("r", diagonal(*self._viewport)) or 0.0
            return basic_shapes.ellipse(cx, cy, r, r)
        rx, ry = self._across("rx"), self._down("ry")
        rx, ry = (ry if rx is None else rx), (rx if ry is None else ry)
        return basic_shapes.ellipse(cx, cy, rx or 0.0, ry or 0.0)

    def _across(self, name: str) -> float | None:
        return self._length(name, self._viewport[0])

    def _down(self, name: str) -> float | None:
        return self._length(name, self._viewport[1])

    def _length(self, name: str, whole: float) -> float | None:
        """Return a length; None is ``auto``, or one that cannot be read."""
        for text in (self._declared.get(name), self._node.get(name)):
            if text is None or text.strip() in ("", "auto"):
                continue
            value = length(text, whole, self._font_size)
            if value is not None:
                return value
            self._notes.add(f"{name} of a {self._node.tag} that cannot be read")
        return None
