"""A technical figure as an SVG document: lines, areas and words, looked after by one style sheet.

And a contact sheet as such a document: rows of documents with a line of words above each.
"""

from __future__ import annotations

import base64
from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import svgwrite

from shapeblend_cli.model import Box
from shapeblend_cli.svg.writing import document
from shapeblend_cli.svg.writing.rounding import number

Point = tuple[float, float]

DECIMALS = 1  # of coordinates; a figure is some hundreds of units wide
SIZE = 2  # decimals of radii and the like


GAP = 6.0
"""Distance between pictures, in pixels."""

WORDS = 22.0
"""Height of the line of words above a row, in pixels."""

MARGIN = 12.0
"""Margin around all rows, in pixels."""

SHEET_STYLE = """\
.ground { fill: #fff }
.words { font: 13px system-ui, sans-serif; fill: #333 }
"""


class Figure:
    """A figure that is drawn piece by piece, later pieces on top.

    Sizes are in CSS pixels, which are the units of everything in it. Pieces name classes of its style sheet.
    """

    def __init__(self, width: float, height: float, style: str) -> None:
        width, height = round(width), round(height)
        self._style = style
        box = document.box_text(Box(0.0, 0.0, width, height), DECIMALS)
        self._drawing = svgwrite.Drawing(size=(str(width), str(height)), debug=False, viewBox=box)
        self._drawing.elements.remove(self._drawing.defs)
        self._drawing.add(svgwrite.shapes.Rect((0, 0), ("100%", "100%"), class_="ground", debug=False))

    def text(self) -> str:
        """Return the document."""
        root = self._drawing.get_xml()
        has_links = any("xlink:href" in element.attrib for element in root)
        for name in ("version", "baseProfile", "xmlns:ev", *(() if has_links else ("xmlns:xlink",))):
            del root.attrib[name]
        return document.text(root, style=self._style)

    def path(self, data: str, kind: str, **paint: str) -> None:
        """Add path data, of a class and with further attributes."""
        if data:
            self._drawing.add(self._drawing.path(d=data, class_=kind, **paint))

    def line(self, points: Iterable[Point], kind: str, *, closed: bool = False) -> None:
        """Add a line from point to point."""
        self.path(line_data(points, closed=closed), kind)

    def circle(self, centre: Point, radius: float, kind: str) -> None:
        """Add a disc."""
        x, y = (number(v, DECIMALS) for v in centre)
        self._drawing.add(self._drawing.circle((x, y), number(radius, SIZE), class_=kind))

    def words(self, text: str, at: Point, kind: str, turn: float = 0.0) -> None:
        """Add a line of text, rotated in degrees; its class tells whether it begins, is centred or ends at a point."""
        x, y = (number(v, DECIMALS) for v in at)
        more: dict[str, Any] = {"transform": f"rotate({number(turn, 1)} {x} {y})"} if turn else {}
        self._drawing.add(self._drawing.text(printable(text), insert=(x, y), class_=kind, **more))

    def image(self, href: str, at: Point, size: Point) -> None:
        """Add an image, drawn as large as fits into a box."""
        (x, y), (width, height) = ([number(v, DECIMALS) for v in pair] for pair in (at, size))
        self._drawing.add(self._drawing.image(href, insert=(x, y), size=(width, height)))


def printable(text: str) -> str:
    """Return `text` without characters that documents cannot have, such as control characters in a file's name."""
    return "".join(c if c.isprintable() else "�" for c in text)


def line_data(points: Iterable[Point], *, closed: bool = False) -> str:
    """Return path data of a line from point to point, each but the first relative to the one before it."""
    scale = 10**DECIMALS
    grid = [(round(x * scale), round(y * scale)) for x, y in points]
    if not grid:
        return ""
    offsets = " ".join(_pair(x1 - x0, y1 - y0) for (x0, y0), (x1, y1) in pairwise(grid)).replace(" -", "-")
    return f"M{_pair(*grid[0])}" + (f"l{offsets}" if offsets else "") + ("z" if closed else "")


def rect_data(x: float, y: float, width: float, height: float) -> str:
    """Return path data of a rectangle."""
    left, top, w, h = (number(v, SIZE) for v in (x, y, width, height))
    return f"M{left} {top}h{w}v{h}h{number(-width, SIZE)}z"


def _pair(x: int, y: int) -> str:
    first, second = (number(v / 10**DECIMALS, DECIMALS) for v in (x, y))
    return f"{first}{second}" if second.startswith("-") else f"{first} {second}"


class Row(NamedTuple):
    """SVG documents in a row, and the line of words above them."""

    words: str
    pictures: Sequence[str]


def sheet(rows: Sequence[Row], width: float, height: float) -> str:
    """Return rows of documents, each of the same width and height, as one document that needs no other file.

    Each document is an image in it, so that their ids and gradients do not meet.
    """
    longest = max(len(row.pictures) for row in rows)
    figure = Figure(
        2 * MARGIN + longest * (width + GAP) - GAP,
        2 * MARGIN + len(rows) * (WORDS + height + GAP) - GAP,
        SHEET_STYLE,
    )
    for n, row in enumerate(rows):
        top = MARGIN + n * (WORDS + height + GAP)
        figure.words(row.words, (MARGIN, top + 15.0), "words")
        for k, picture in enumerate(row.pictures):
            data = base64.b64encode(picture.encode("utf-8")).decode("ascii")
            place = (MARGIN + k * (width + GAP), top + WORDS)
            figure.image(f"data:image/svg+xml;base64,{data}", place, (width, height))
    return figure.text()
