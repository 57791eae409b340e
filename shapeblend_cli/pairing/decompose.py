"""A drawing taken apart into contours, each with the part it plays."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.errors import InputError
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.polygons import (
    orientation,
    reverse_contour,
    reverse_polygon,
    signed_area,
    winding_numbers,
)
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.model import Box, Contour
from shapeblend_cli.pairing.nesting import nest

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Drawing, Polygon, Shape, Style

EXTERIOR, HOLE, LINE = "exterior", "hole", "line"

MOST_CONTOURS = 2_000
"""Contours of a drawing that are blended; each is solved by itself, and every two are compared."""

MOST_SEGMENTS = 50_000
"""Segments of a contour that are blended."""


class PlacedContour(NamedTuple):
    """One contour of a drawing, as it is matched.

    Attributes
    ----------
    number : int
        Counted through the drawing's shapes in file order.
    shape : int
        Which of the drawing's shapes it belongs to, counted from 0.
    contour : Contour
        Laid over A. Outlines go one way round and holes the other, where that paints the same.
    polygon : Polygon
        Flattened, on this contour.
    box : Box
        The polygon's.
    role : str
        An outline, a hole, or an open line.
    exterior : int or None
        Number of the contour that a hole is in.
    style : Style
        Its shape's in A's coordinates, with the fill rule that paints its contours as they are directed here.
    any_rule : bool
        Whether the other rule would paint the shape alike.
    is_piece : bool
        Whether it is a piece that was cut from the contour with this number.
    """

    number: int
    shape: int
    contour: Contour
    polygon: Polygon
    box: Box
    role: str
    exterior: int | None
    style: Style
    any_rule: bool
    is_piece: bool = False

    @property
    def size(self) -> float:
        """Diagonal of the box."""
        return self.box.diagonal

    def has(self, hole: PlacedContour) -> bool:
        """Whether a contour is a hole in this one."""
        if hole.role != HOLE or hole.exterior != self.number:
            return False
        return not self.is_piece or bool(winding_numbers(hole.polygon.vertices[:1], self.polygon.vertices)[0])

    @property
    def centre(self) -> complex:
        """Middle of the box."""
        return self.box.centre

    def transformed(self, by: Similarity) -> PlacedContour:
        """Return the contour under a map that does not scale."""
        polygon = by.polygon(self.polygon)
        return self._replace(contour=by.contour(self.contour), polygon=polygon, box=polygon.box)


class _Usable(NamedTuple):
    """A contour with an extent."""

    number: int
    contour: Contour
    polygon: Polygon


def decompose(
    drawing: Drawing, over: Similarity, vertices: int, way: int | None = None
) -> tuple[list[PlacedContour], list[str]]:
    """Take a drawing apart into its contours.

    Parameters
    ----------
    drawing : Drawing
    over : Similarity
        What lays it over A.
    vertices : int >= 0
        Vertices a contour, about.
    way : {1, -1}, optional
        Which way round outlines go; without it that of the largest outline.

    Returns
    -------
    parts : list of PlacedContour
        By number. Contours without extent are left out.
    notes : list of str
        What was left out.

    Raises
    ------
    InputError
        If nothing is left, or there is too much of it.
    """
    _check_size(drawing)
    shapes: list[list[_Usable]] = []
    number = 0
    left_out: list[str] = []
    for shape in drawing.shapes:
        usable: list[_Usable] = []
        for given in shape.contours:
            contour = over.contour(_as_painted(given, shape.style))
            polygon = flatten(contour, vertices)
            if contour.closed and len(polygon.vertices) < 3 and shape.style.stroke is not None:
                contour = Contour(contour.segments, contour.straight, closed=False)  # a line there and back
                polygon = flatten(contour, vertices)
            if len(polygon.vertices) < (3 if contour.closed else 2):
                kind = "closed" if contour.closed else "open"
                left_out.append(f"contour {number}, {kind} with {len(polygon.vertices)} distinct vertices")
            else:
                usable.append(_Usable(number, contour, polygon))
            number += 1
        shapes.append(usable)
    if not any(shapes):
        raise InputError(
            drawing.file,
            f"nothing in it can be blended: {left_out[0]}; an open line of 2 or a closed outline of 3 would work",
        )
    way = way or main_orientation([found.polygon for usable in shapes for found in usable])
    parts = [
        part
        for index, usable in enumerate(shapes)
        for part in _parts_of(index, drawing.shapes[index], usable, over, way)
    ]
    return parts, [f"{drawing.file}: {phrase}, left out" for phrase in left_out]


def _check_size(drawing: Drawing) -> None:
    contours = [contour for shape in drawing.shapes for contour in shape.contours]
    if len(contours) > MOST_CONTOURS:
        raise InputError(
            drawing.file,
            f"it draws {len(contours)} contours, and {MOST_CONTOURS} are the most that are blended; selecting some of "
            "its shapes would work (--select-a, --select-b)",
        )
    largest = max(len(contour.segments) for contour in contours)
    if largest > MOST_SEGMENTS:
        raise InputError(
            drawing.file,
            f"it draws a contour of {largest} segments, and {MOST_SEGMENTS} are the most that are blended; a "
            "simpler drawing would work",
        )


def main_orientation(polygons: Sequence[Polygon]) -> int:
    """Which way round the largest closed polygon goes; 1 where that is not decided."""
    closed = [polygon for polygon in polygons if polygon.closed]
    largest = max(closed, key=lambda polygon: abs(signed_area(polygon.vertices)), default=None)
    return (orientation(largest) if largest else 0) or 1


def _as_painted(contour: Contour, style: Style) -> Contour:
    """Close an open contour that is only filled, as filling does."""
    if contour.closed or style.fill is None or style.stroke is not None:
        return contour
    start, end = contour.segments[0, 0], contour.segments[-1, 3]
    return Contour(
        segments=np.vstack([contour.segments, cubics.line(end, start)]),
        straight=np.append(contour.straight, True),
        closed=True,
    )


def _parts_of(
    index: int, shape: Shape, usable: list[_Usable], over: Similarity, way: int
) -> list[PlacedContour]:
    """The contours of one shape, outlines told from holes and directed."""
    closed = [(number, polygon) for number, contour, polygon in usable if contour.closed]
    outline_of: dict[int, int | None] = {}
    turned: dict[int, bool] = {}
    style = over.style(shape.style)
    if closed and style.fill is not None:
        nesting = nest([polygon for _, polygon in closed], style.fill_rule, way)
        for (number, _), home, turn in zip(closed, nesting.outline, nesting.turned, strict=True):
            outline_of[number] = None if home is None else closed[home][0]
            turned[number] = turn
        style, any_rule = style._replace(fill_rule=nesting.rule), nesting.any_rule
    else:
        style, any_rule = style._replace(fill_rule="nonzero"), True
    parts = []
    for number, contour, polygon in usable:
        home = outline_of.get(number)
        role = (EXTERIOR if home is None else HOLE) if contour.closed else LINE
        if turned.get(number, False):
            polygon = reverse_polygon(polygon, len(contour.segments))
            contour = reverse_contour(contour)
        parts.append(PlacedContour(number, index, contour, polygon, polygon.box, role, home, style, any_rule))
    return parts
