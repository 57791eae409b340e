"""A technical figure as an SVG document: lines, areas and words, looked after by one style sheet."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

from shapeblend_cli.model import Box
from shapeblend_cli.svg.libraries import svgwrite
from shapeblend_cli.svg.writing import document
from shapeblend_cli.svg.writing.rounding import number

if TYPE_CHECKING:
    from collections.abc import Iterable

    Point = tuple[float, float]

DECIMALS = 1
"""Of coordinates; a figure is some hundreds of units wide."""

SIZE = 2
"""Decimals of radii and the like."""


class Figure:
    """A figure that is drawn piece by piece, what comes later over what came before.

    Parameters
    ----------
    width, height : float
        In CSS pixels, which are the units of everything in it.
    style : str
        A style sheet; the pieces name its classes.
    """

    def __init__(self, width: float, height: float, style: str) -> None:
        width, height = round(width), round(height)
        self._style = style
        self._drawing = document.empty(Box(0.0, 0.0, width, height), DECIMALS)
        self._drawing["width"], self._drawing["height"] = str(width), str(height)
        self._drawing.add(svgwrite.shapes.Rect((0, 0), ("100%", "100%"), class_="ground", debug=False))

    def text(self) -> str:
        """The document."""
        return document.text(self._drawing, style=self._style)

    def path(self, data: str, kind: str, **paint: str) -> None:
        """Path data as it stands, of a class, with further attributes."""
        if data:
            self._drawing.add(self._drawing.path(d=data, class_=kind, **paint))

    def line(self, points: Iterable[Point], kind: str, *, closed: bool = False) -> None:
        """A line from point to point."""
        self.path(line_data(points, closed=closed), kind)

    def circle(self, centre: Point, radius: float, kind: str) -> None:
        """A disc."""
        place = tuple(number(v, DECIMALS) for v in centre)
        self._drawing.add(self._drawing.circle(place, number(radius, SIZE), class_=kind))

    def words(self, text: str, at: Point, kind: str, turn: float = 0.0) -> None:
        """A line of text, its baseline beginning, centred or ending at a point as its class says.

        Parameters
        ----------
        text : str
        at : (float, float)
        kind : str
        turn : float
            In degrees, about the point.
        """
        x, y = (number(v, DECIMALS) for v in at)
        more: dict[str, Any] = {"transform": f"rotate({number(turn, 1)} {x} {y})"} if turn else {}
        self._drawing.add(self._drawing.text(printable(text), insert=(x, y), class_=kind, **more))


def printable(text: str) -> str:
    """Text without what cannot stand in a document, such as control characters in the name of a file."""
    return "".join(c if c.isprintable() else "�" for c in text)


def line_data(points: Iterable[Point], *, closed: bool = False) -> str:
    """Path data of a line from point to point, each but the first by its way from the one before."""
    scale = 10**DECIMALS
    grid = [(round(x * scale), round(y * scale)) for x, y in points]
    if not grid:
        return ""
    parts = [f"M{_pair(*grid[0])}"]
    letter = "l"
    for (x0, y0), (x1, y1) in pairwise(grid):
        way = _pair(x1 - x0, y1 - y0)
        parts.append(way if not letter and way.startswith("-") else (letter or " ") + way)
        letter = ""
    return "".join(parts) + ("z" if closed else "")


def rect_data(x: float, y: float, width: float, height: float) -> str:
    """Path data of a rectangle."""
    left, top, across, down = (number(v, SIZE) for v in (x, y, width, height))
    return f"M{left} {top}h{across}v{down}h{number(-width, SIZE)}z"


def _pair(x: int, y: int) -> str:
    first, second = (number(v / 10**DECIMALS, DECIMALS) for v in (x, y))
    return f"{first}{second}" if second.startswith("-") else f"{first} {second}"
