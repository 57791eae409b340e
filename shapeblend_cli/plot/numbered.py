"""The contours and pen lines of one drawing with their numbers, as `--match` takes them and reports have them."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.pieces import with_areas
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import polyline_contour, winding_numbers
from shapeblend_cli.geometry.polyline import nearest_places, thin
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.model import Box, Contour
from shapeblend_cli.pens.drawings import file_pens
from shapeblend_cli.plot.axes import titled_figure
from shapeblend_cli.svg.reading.read import STANDARD_INPUT, title_of
from shapeblend_cli.svg.writing.paint import paint_attributes, without_defaults
from shapeblend_cli.svg.writing.path_data import path_data
from shapeblend_cli.system.write import check_targets, write_files

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, CubicPath, Drawing

SIDE = 720.0
"""Longer side of the drawing on the page, in pixels."""

MARGIN = 36.0
"""Margin on the left, on the right and at the bottom, in pixels."""

TOP = 84.0
"""Room for the heading, in pixels."""

COLOURS = ("#1f4fa3", "#b3261e", "#1b7a3d", "#7b2fa6", "#a65200", "#00707a", "#a3155f", "#4d5a00")
"""Colours of outlines and numbers, in turn."""

ROOM = 9.0
"""Half the width of a number, in pixels, about."""

GRID = 14
"""Number of rows, and of columns, of the places for a number in its contour."""

AROUND = 16
"""Number of directions of the places for a number beside its contour."""

OUTWARDS = (2.0, 3.2, 4.4, 6.0, 8.0)
"""Distances of these places from the contour, in units of `ROOM`."""

VERTICES = 96
"""Maximum number of points of an outline that numbers keep clear of."""

CURVE = np.linspace(0.0, 1.0, 8, endpoint=False)
"""Parameters of these points on a segment."""

DECIMALS = 2

_STYLE = (
    "\n.number{font-size:13px;font-weight:600;text-anchor:middle;paint-order:stroke;stroke:#fff;stroke-width:3.5}\n"
    ".outline{stroke-width:1.4}\n.leader{stroke-width:0.8}\n"
    + "".join(
        f".k{k}{{stroke:{colour}}}\ntext.k{k}{{fill:{colour};stroke:#fff}}\n"
        for k, colour in enumerate(COLOURS)
    )
)


def write_picture(drawing: Drawing, file: str, picture: str, *, force: bool) -> None:
    """Write the picture of a drawing that was read from a file; raises OutputError where that cannot be."""
    target = Path(picture)
    check_targets([target], [] if file == STANDARD_INPUT else [Path(file)], force)
    write_files({target: draw(drawing)}, force)


def draw(drawing: Drawing) -> str:
    """Return a drawing, pale, with each of its contours and pen lines and their numbers, as a document."""
    drawing = with_areas(drawing)
    contours = [contour for shape in drawing.shapes for contour in shape.contours]
    box = Box.union([cubics.bounds(contour.segments) for contour in contours])
    box = Box.union([box, drawing.viewbox]) if drawing.viewbox else box
    scale = SIDE / box.larger_side if box.larger_side > 0.0 else 1.0
    to_page = Similarity(scale, complex(MARGIN, TOP) - scale * complex(box.x, box.y))
    size = MARGIN + scale * box.width + MARGIN, TOP + scale * box.height + MARGIN
    named = _named(drawing, contours)
    numbers = (
        "one contour, 0" if len(contours) == 1 else f"contours 0 to {len(contours) - 1}, the lowest first"
    )
    count = sum(is_line for _, _, is_line in named)
    numbers += f"; {count} pen line{'s' * (count != 1)}" if count else ""
    figure = titled_figure(*size, _STYLE, title_of(drawing.file), numbers)
    laid = [to_page.contour(contour) for contour in contours]
    rest = iter(laid)
    for shape in drawing.shapes:
        paint = paint_attributes(to_page.style(shape.style._replace(pixel=None)), DECIMALS)
        data = path_data([next(rest) for _ in shape.contours], DECIMALS)
        figure.path(data, "pale", opacity="0.3", **without_defaults(paint))
    shown = [to_page.contour(path) for _, path, _ in named]
    for number, path in enumerate(shown):
        figure.path(path_data([path], DECIMALS), f"outline k{number % len(COLOURS)}")
    page = Box(0.0, TOP, size[0], size[1] - TOP)
    for number, label in _labels([_Outline.of(path) for path in shown], page):
        colour = f"k{number % len(COLOURS)}"
        if label.leader is not None:
            figure.line([(z.real, z.imag) for z in (label.at, label.leader)], f"leader {colour}")
        figure.words(named[number][0], (label.at.real, label.at.imag + 4.5), f"number {colour}")
    return figure.text()


def _named(drawing: Drawing, contours: Sequence[Contour]) -> list[tuple[str, Contour, bool]]:
    """Return the names of a drawing's contours and lines, with their paths, and whether they are lines.

    Contours of which lines were recovered are left out.
    """
    pens, scale = file_pens(drawing)
    bodies = {contour.number for contour in pens.bodies} if pens.lines else set(range(len(contours)))
    found = [(str(number), contour, False) for number, contour in enumerate(contours) if number in bodies]
    for line in pens.lines:
        points = line.points if len(line.points) > 1 else np.repeat(line.points, 2)
        found.append((line.name, polyline_contour(points / scale, line.closed), True))
    return sorted(found, key=lambda each: [int(part) for part in each[0].replace("+", ".").split(".")])


class _Outline(NamedTuple):
    """A contour as seen at some of its points."""

    points: ComplexArray
    box: Box
    closed: bool

    @classmethod
    def of(cls, path: CubicPath) -> _Outline:
        points = np.append(cubics.evaluate(path.segments[:, None, :], CURVE).ravel(), path.segments[-1, 3])
        return cls(np.append(thin(points, VERTICES), points[-1]), cubics.bounds(path.segments), path.closed)


class _Label(NamedTuple):
    """Where a number stands, and if that is beside its contour, where a line to it ends."""

    at: complex
    leader: complex | None = None


def _labels(outlines: Sequence[_Outline], page: Box) -> list[tuple[int, _Label]]:
    """Return a place for each contour's number, the smaller ones' first: inside with room around it, or beside."""
    placed: list[tuple[int, _Label]] = []
    taken: list[complex] = []
    for number in sorted(range(len(outlines)), key=lambda k: outlines[k].box.area):
        outline = outlines[number]
        near = [other for other in outlines if other.box.expanded(ROOM).overlaps(outline.box)]
        label = _inside(outline, near, np.array(taken)) or _beside(outline, np.array(taken), page)
        taken.append(label.at)
        placed.append((number, label))
    return sorted(placed)


def _inside(outline: _Outline, near: Sequence[_Outline], taken: ComplexArray) -> _Label | None:
    """Return the place farthest from all outlines in a contour and in none that is smaller, if there is room."""
    if not outline.closed or min(outline.box.width, outline.box.height) < 2.0 * ROOM:
        return None
    spots = outline.box.grid(GRID)
    spots = spots[winding_numbers(spots, outline.points) != 0]
    for other in near:
        if other.closed and other.box.area < outline.box.area:
            spots = spots[winding_numbers(spots, other.points) == 0]
    if not len(spots):
        return None
    room = np.min([nearest_places(spots, other.points)[0] for other in near], axis=0)
    if len(taken):
        room = np.minimum(room, np.abs(spots[:, None] - taken).min(axis=1) - ROOM)
    best = int(room.argmax())
    return _Label(complex(spots[best])) if room[best] >= ROOM else None


def _beside(outline: _Outline, taken: ComplexArray, page: Box) -> _Label:
    """Return the first free place around a point of an outline, or the one with the most room."""
    middle = complex(outline.points[np.abs(outline.points - outline.box.centre).argmin()])
    best, most = middle, -math.inf
    for distance in OUTWARDS:
        for k in range(AROUND):
            angle = 2.0 * math.pi * (k - 2) / AROUND
            spot = middle + distance * ROOM * complex(math.cos(angle), math.sin(angle))
            if not page.expanded(-ROOM).contains(Box(spot.real, spot.imag, 0.0, 0.0)):
                continue
            room = float(np.abs(taken - spot).min()) if len(taken) else math.inf
            if room >= 2.0 * ROOM:
                return _Label(spot, middle)
            if room > most:
                best, most = spot, room
    return _Label(best, middle)
