"""A shape element into contours in its own coordinates: https://www.w3.org/TR/SVG2/shapes.html."""

from __future__ import annotations

import itertools
import math
import re

from shapeblend_cli.model import Contour
from shapeblend_cli.svg.reading import contours, path_commands
from shapeblend_cli.svg.styles.declarations import Declarations
from shapeblend_cli.svg.xml.messages import Notes, Problem
from shapeblend_cli.svg.xml.units import GrammarError, Lengths, length, numbers
from shapeblend_cli.svg.xml.xmltree import Node

_CSS_PATH = r"""path\(\s*+(?:(?:nonzero|evenodd)\s*+,\s*+)?(["'])([^"']*+)\1\s*+\)"""
_VERTICAL = frozenset(("y", "y1", "y2", "cy", "ry", "height"))


def contours_of(
    node: Node, declared: Declarations, lengths: Lengths, notes: Notes, lenient: bool = False
) -> list[Contour]:
    """Return the contours of an element whose tag is one of `xmltree.SHAPES`; none when it has no extent.

    Its `declared` properties count, because in SVG 2 sizes are properties too. Path data and points that break the
    grammar raise a Problem, or if `lenient` are read up to the error and noted.
    """
    if node.tag == "path":
        return _path(node, declared, notes, lenient)
    if node.tag in ("polyline", "polygon"):
        contour = _points(node, notes, lenient)
    else:
        contour = _basic_shape(node, declared, lengths, notes)
    return [] if contour is None else [contour]


def is_for_us(node: Node) -> bool:
    """Return whether a conditional element is drawn.

    https://www.w3.org/TR/SVG2/struct.html#ConditionalProcessing; the language is English.
    """
    if "requiredExtensions" in node.attrib:
        return False
    languages = node.get("systemLanguage")
    return languages is None or any(
        tag.strip().lower().split("-")[0] == "en" for tag in languages[:1000].split(",")
    )


def _path(node: Node, declared: Declarations, notes: Notes, lenient: bool) -> list[Contour]:
    data = node.get("d") or ""
    if "d" in declared:
        match = re.fullmatch(_CSS_PATH, declared["d"])
        data = match[2] if match else "" if declared["d"] == "none" else data
    try:
        subpaths, error = path_commands.scan(data)
        if error is not None:
            has_more = any(subpath.count for subpath in subpaths)
            _report(f"{node}: {error.message_in('path data')}", has_more, notes, lenient)
        return path_commands.trace(subpaths)
    except path_commands.TooManySegments as limit:
        raise Problem(f"{node}: {limit}") from None


def _points(node: Node, notes: Notes, lenient: bool) -> Contour | None:
    try:
        values = numbers(node.get("points") or "")
    except GrammarError as error:
        # Firefox draws what stands before the error, Chromium nothing.
        values = error.before
        _report(f"{node}: {error.message_in('points')}", len(values) > 3, notes, lenient)
    if len(values) > 2 * path_commands.MAX_SEGMENTS:
        raise Problem(f"{node}: more than {path_commands.MAX_SEGMENTS} points, the limit")
    if len(values) % 2:
        notes.add("the last coordinate, which has no partner, left out")
    points = [complex(x, y) for x, y in zip(values[::2], values[1::2], strict=False)]
    return _polyline(points, closed=node.tag == "polygon")


def _report(message: str, has_more: bool, notes: Notes, lenient: bool) -> None:
    if not lenient:
        raise Problem(
            f"{message}; --lenient {'draws what stands before it' if has_more else 'leaves it out'}"
        )
    notes.add(f"{message}; {'what stands before it is drawn' if has_more else 'nothing stands before it'}")


def _basic_shape(node: Node, declared: Declarations, lengths: Lengths, notes: Notes) -> Contour | None:
    def size(name: str) -> float | None:
        """Return a length; None is ``auto``, or one that cannot be read."""
        whole = lengths.diagonal if name == "r" else lengths.height if name in _VERTICAL else lengths.width
        for text in (declared.get(name), node.get(name)):
            if text is None or text.strip() in ("", "auto"):
                continue
            value = length(text, whole, lengths.font_size)
            if value is not None:
                return value
            notes.add(f"{name} of a {node.tag} that cannot be read")
        return None

    if node.tag == "rect":
        width, height, rx, ry, x, y = map(size, ("width", "height", "rx", "ry", "x", "y"))
        return _rectangle(complex(x or 0.0, y or 0.0), width or 0.0, height or 0.0, rx, ry)
    if node.tag == "line":
        x1, y1, x2, y2 = (size(name) or 0.0 for name in ("x1", "y1", "x2", "y2"))
        return _polyline([complex(x1, y1), complex(x2, y2)], closed=False)
    cx, cy = size("cx") or 0.0, size("cy") or 0.0
    if node.tag == "circle":
        rx = ry = size("r")
    else:
        rx, ry = size("rx"), size("ry")
    return _ellipse(complex(cx, cy), (ry if rx is None else rx) or 0.0, (rx if ry is None else ry) or 0.0)


def _rectangle(
    corner: complex, width: float, height: float, rx: float | None, ry: float | None
) -> Contour | None:
    """Return a rectangle, clockwise from its top left as browsers draw it; None when it has no area."""
    if width <= 0 or height <= 0:
        return None
    rx, ry = _corner_radii(width, height, rx, ry)
    x, y = corner.real, corner.imag
    right, bottom = x + width, y + height
    if rx == 0:
        return _polyline([corner, complex(right, y), complex(right, bottom), complex(x, bottom)], closed=True)
    segments: list[contours.Segment] = []
    straight: list[bool] = []
    sides = (
        (complex(x + rx, y), complex(right - rx, y), complex(right, y + ry), -math.pi / 2),
        (complex(right, y + ry), complex(right, bottom - ry), complex(right - rx, bottom), 0.0),
        (complex(right - rx, bottom), complex(x + rx, bottom), complex(x, bottom - ry), math.pi / 2),
        (complex(x, bottom - ry), complex(x, y + ry), complex(x + rx, y), math.pi),
    )
    for start, end, next_start, angle in sides:
        centre = end - complex(rx * math.cos(angle), ry * math.sin(angle))
        arc = contours.elliptic(centre, rx, 1j * ry, angle, math.pi / 2)
        arc[-1] = (*arc[-1][:3], next_start)
        segments += [contours.line(start, end), *arc]
        straight += [True] + [False] * len(arc)
    return contours.chain(segments, straight, closed=True)


def _corner_radii(width: float, height: float, rx: float | None, ry: float | None) -> tuple[float, float]:
    """Return the radii in force: None, ``auto``, takes the other's value; half a side at most; both zero or neither."""
    given_x, given_y = (None if r is None or r < 0 else r for r in (rx, ry))
    rx = given_x if given_x is not None else given_y or 0.0
    ry = given_y if given_y is not None else rx
    rx, ry = min(rx, width / 2), min(ry, height / 2)
    return (rx, ry) if rx > 0 and ry > 0 else (0.0, 0.0)


def _ellipse(centre: complex, rx: float, ry: float) -> Contour | None:
    """Return an ellipse, clockwise from its rightmost point; None when it has no area."""
    if rx <= 0 or ry <= 0:
        return None
    # Through the start: what rounding does to cx + rx, it does to all points.
    segments = contours.elliptic(complex(centre.real + rx, centre.imag) - rx, rx, 1j * ry, 0.0, 2 * math.pi)
    return contours.chain(segments, [False] * len(segments), closed=True)


def _polyline(points: list[complex], closed: bool) -> Contour | None:
    segments = [contours.line(p, q) for p, q in itertools.pairwise(points)]
    return contours.chain(segments, [True] * len(segments), closed)
