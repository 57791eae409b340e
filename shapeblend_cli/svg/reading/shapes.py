"""A shape element into contours in its own coordinates."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from shapeblend_cli.svg.reading import basic_shapes, path_data
from shapeblend_cli.svg.reading.cascade import diagonal
from shapeblend_cli.svg.reading.problem import Problem
from shapeblend_cli.svg.reading.units import NumberError, length, numbers

if TYPE_CHECKING:
    from shapeblend_cli.model import Contour
    from shapeblend_cli.svg.reading.declarations import Declarations
    from shapeblend_cli.svg.reading.notes import Notes
    from shapeblend_cli.svg.reading.xmltree import Node

_CSS_PATH = r"""path\(\s*+(?:(?:nonzero|evenodd)\s*+,\s*+)?(["'])([^"']*+)\1\s*+\)"""


def outline(
    node: Node,
    declared: Declarations,
    viewport: tuple[float, float],
    font_size: float,
    notes: Notes,
    lenient: bool = False,
) -> list[Contour]:
    """Return the contours of a shape; none when it has no extent.

    Parameters
    ----------
    node : Node
        With a tag out of `elements.SHAPES`.
    declared : dict
        What the cascade gives it: in SVG 2 sizes are properties too.
    viewport : pair of float
        What percentages refer to.
    font_size : float
        What 1em is.
    notes : Notes
    lenient : bool
        Take path data and points that break the grammar for what stands before the error, and note that.

    Raises
    ------
    Problem
        If they break the grammar and `lenient` is not given, or if they exceed a limit.
    """
    if node.tag == "path":
        return _path(node, declared, notes, lenient)
    if node.tag in ("polyline", "polygon"):
        contour = _points(node, notes, lenient)
    else:
        contour = _Sizes(node, declared, viewport, font_size, notes).contour()
    return [] if contour is None else [contour]


def _path(node: Node, declared: Declarations, notes: Notes, lenient: bool) -> list[Contour]:
    data = node.get("d") or ""
    if "d" in declared:
        match = re.fullmatch(_CSS_PATH, declared["d"])
        data = match[2] if match else "" if declared["d"] == "none" else data
    try:
        subpaths, error = path_data.scan(data)
        if error is not None:
            _broken(f"{node}: {error}", any(subpath.count for subpath in subpaths), notes, lenient)
        return path_data.trace(subpaths)
    except path_data.TooManySegments as limit:
        raise Problem(f"{node}: {limit}") from None


def _points(node: Node, notes: Notes, lenient: bool) -> Contour | None:
    try:
        values = numbers(node.get("points") or "")
    except NumberError as error:
        # Firefox draws that much, Chromium nothing.
        values = error.before
        found = f"{node}: at character {error.offset + 1} of its points: found {error.found}"
        _broken(found, len(values) > 3, notes, lenient)
    if len(values) > 2 * path_data.MAX_SEGMENTS:
        raise Problem(f"{node}: more than {path_data.MAX_SEGMENTS} points, the most that are read")
    if len(values) % 2:
        notes.add("a last coordinate without a partner left out")
    points = [complex(x, y) for x, y in zip(values[::2], values[1::2], strict=False)]
    return basic_shapes.polyline(points, closed=node.tag == "polygon")


def _broken(found: str, has_more: bool, notes: Notes, lenient: bool) -> None:
    """Note an error, or raise it."""
    if lenient:
        notes.add(f"{found}; {'what stands before it is drawn' if has_more else 'nothing stands before it'}")
    else:
        raise Problem(f"{found}; --lenient {'draws what stands before it' if has_more else 'leaves it out'}")


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
