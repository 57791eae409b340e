"""Decompose a drawing into flattened contours, and tell exteriors from holes and open lines."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.nesting import nest
from shapeblend_cli.errors import InputError
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flat_contour import FlatContour
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.polygons import orientation, signed_area_of, winding_numbers
from shapeblend_cli.model import MOST_CONTOURS, MOST_SEGMENTS, Box, Contour, Drawing, Polygon, Style

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.geometry.flatten import Known
    from shapeblend_cli.geometry.similarity import Similarity
    from shapeblend_cli.model import ComplexArray, FloatArray

    ContourPair = tuple["PlacedContour", "PlacedContour"]

EXTERIOR, HOLE, LINE = "exterior", "hole", "line"

CROWD = 40
"""Maximum number of contours that get all the vertices that their sizes ask for."""

CUT_ONE_BY_ONE = 150
"""Maximum number of contours that are all cut into edges, whether they are of one form or not."""

LEAST_SHARE = 0.15
"""Minimum share of the wanted vertices that any contour gets."""

LARGE = 0.25
"""Minimum size of a contour that gets all the wanted vertices, as a share of the drawing's diagonal."""

SLENDER = 0.2
"""Maximum area of a slender exterior, such as a slash, as a share of the square of its diagonal."""

STRAIGHT = 1e-9
"""Tolerance of a contour that encloses nothing, as a share of its length."""

HIDDEN_GAP = 0.05
"""Maximum distance of the ends of a stroke that looks closed, in widths: editors round the coordinates of paths."""

MOST_LARGE = 200
"""Maximum number of large contours that get all the wanted vertices; more of them get as many together."""


class PlacedContour(NamedTuple):
    """One contour of a drawing, laid over A, flattened, and with its role.

    Exteriors run one way round and holes the other, where that paints the same.
    """

    number: int  # counted through the drawing's shapes in file order
    shape: int  # index
    contour: Contour
    polygon: Polygon
    role: str  # EXTERIOR, HOLE or LINE
    exterior: int | None  # number of the contour that a hole is in
    style: Style  # the shape's, in A's coordinates, with the fill rule that suits the contours' directions
    any_rule: bool = True  # whether the other fill rule would paint the shape the same
    is_piece: bool = False  # whether it is a piece cut from the contour with this number
    opened: int | None = None  # number of the hole that is part of it, where it is a ring that is cut open

    @property
    def flat(self) -> FlatContour:
        """The contour and its polygon."""
        return FlatContour(self.contour, self.polygon)

    @property
    def box(self) -> Box:
        """The polygon's box."""
        return self.polygon.box

    @property
    def size(self) -> float:
        """Diagonal of the box."""
        return self.box.diagonal

    @property
    def area(self) -> float:
        """Area within the polygon; 0 for an open one."""
        return abs(signed_area_of(self.polygon)) if self.polygon.closed else 0.0

    @property
    def is_slender(self) -> bool:
        """Whether it is an exterior that is small for its length."""
        return self.role == EXTERIOR and self.area <= SLENDER * self.size**2

    @property
    def centre(self) -> complex:
        """Centre of the box."""
        return self.box.centre

    def contains_hole(self, hole: PlacedContour) -> bool:
        """Return whether a contour is a hole in this one."""
        if hole.role != HOLE or hole.exterior != self.number or hole.number == self.opened:
            return False
        return not self.is_piece or bool(winding_numbers(hole.polygon.vertices[:1], self.polygon.vertices)[0])

    def reversed(self) -> PlacedContour:
        """Return the contour traversed in reverse."""
        back = self.flat.reversed()
        return self._replace(contour=back.contour, polygon=back.polygon)

    def transformed(self, by: Callable[[ComplexArray], ComplexArray]) -> PlacedContour:
        """Return the contour under a map of points; its style stays, so that strokes keep their widths."""
        contour = replace(self.contour, segments=by(self.contour.segments))
        return self._replace(
            contour=contour, polygon=replace(self.polygon, vertices=by(self.polygon.vertices))
        )


def holes_by_exterior(contours: Sequence[PlacedContour]) -> dict[int, list[PlacedContour]]:
    """Return the holes in each exterior that has some, by its number."""
    found: dict[int, list[PlacedContour]] = {}
    for contour in contours:
        if contour.role == HOLE and contour.exterior is not None:
            found.setdefault(contour.exterior, []).append(contour)
    return found


class PlacedDrawing(NamedTuple):
    """A drawing, the map that lays it over A, its contours there, by number, and the part of the plane that is seen."""

    drawing: Drawing
    to_a: Similarity
    contours: Sequence[PlacedContour]
    view: Box | None = None


def decompose(
    drawing: Drawing, to_a: Similarity, vertices: int, exterior_orientation: int | None = None
) -> tuple[list[PlacedContour], list[str]]:
    """Flatten the contours of a drawing laid over A, find their roles, and orient exteriors alike.

    Each gets about the wanted number of vertices. By default exteriors are oriented as the largest closed contour.

    Returns
    -------
    contours : list of PlacedContour
        By number, without those that have no extent.
    notes : list of str
        About contours that were left out.

    Raises
    ------
    InputError
        If nothing is left, or there is too much of it.
    """
    _check_size(drawing)
    by_shape, left_out = _flatten_shapes(drawing, to_a, vertices)
    if not any(by_shape):
        raise InputError(
            drawing.file,
            f"nothing in it can be blended: {left_out[0]}; an open line of 2 or a closed outline of 3 would work",
        )
    flat = [contour for contours in by_shape for contour in contours]
    target = exterior_orientation or main_orientation([contour.polygon for contour in flat])
    placed = [contour for contours in by_shape for contour in _with_roles(contours, target)]
    return placed, [f"{drawing.file}: {phrase}, left out" for phrase in left_out]


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
    """Return the orientation of the largest closed polygon; 1 where it has none."""
    closed = [polygon for polygon in polygons if polygon.closed]
    largest = max(closed, key=lambda polygon: abs(signed_area_of(polygon)), default=None)
    return (orientation(largest) if largest else 0) or 1


def _flatten_shapes(
    drawing: Drawing, to_a: Similarity, vertices: int
) -> tuple[list[list[PlacedContour]], list[str]]:
    """Return the contours of each shape, all closed ones as exteriors, and phrases that name those without extent."""
    by_shape: list[list[PlacedContour]] = []
    left_out: list[str] = []
    every = _vertex_counts(drawing, vertices)
    counts = iter(every)
    known: Known | None = {} if len(every) > CUT_ONE_BY_ONE else None
    number = 0
    for index, shape in enumerate(drawing.shapes):
        by_shape.append([])
        style = to_a.style(shape.style)
        if style.stroke is not None and all(is_straight(each.segments.ravel()) for each in shape.contours):
            style = style._replace(fill=None, fill_gradient=None)  # which paints nothing
        for drawn in shape.contours:
            contour = to_a.contour(_closed_as_seen(drawn, shape.style))
            count = next(counts)
            polygon = flatten(contour, count, known)
            if contour.closed and len(polygon.vertices) < 3 and style.stroke is not None:
                contour = Contour(contour.segments, contour.straight, closed=False)  # a line there and back
                polygon = flatten(contour, count, known)
            if len(polygon.vertices) < (3 if contour.closed else 2):
                kind = "closed" if contour.closed else "open"
                left_out.append(f"contour {number}, {kind} with {len(polygon.vertices)} distinct vertices")
            else:
                role = EXTERIOR if contour.closed else LINE
                by_shape[-1].append(PlacedContour(number, index, contour, polygon, role, None, style))
            number += 1
    return by_shape, left_out


def is_straight(points: ComplexArray, breadth: float = 0.0) -> bool:
    """Return whether points lie on one line, or within a distance of it."""
    offsets = points - points[0]
    longest = offsets[np.abs(offsets).argmax()]
    most = STRAIGHT * abs(longest) ** 2 + breadth * abs(longest)
    return bool(np.abs((offsets * longest.conjugate()).imag).max() <= most)


def _vertex_counts(drawing: Drawing, vertices: int) -> list[int]:
    """Return the number of vertices of each contour: the wanted number if it is `LARGE`, and the smaller the fewer.

    A crowd gets fewer still: all together have about as many as `CROWD` contours, but none less than `LEAST_SHARE` of
    the wanted number.
    """
    boxes = [cubics.bounds(c.segments) for shape in drawing.shapes for c in shape.contours]
    size = Box.union(boxes).diagonal or 1.0
    shares = np.array([box.diagonal for box in boxes]) / size

    is_large = shares >= LARGE
    of_large = min(1.0, max(LEAST_SHARE, MOST_LARGE / max(is_large.sum(), 1)))

    def counts(scale: float) -> FloatArray:
        return np.where(is_large, of_large, np.clip(scale * np.sqrt(shares / LARGE), LEAST_SHARE, of_large))

    low, high = 0.0, 1.0
    if counts(high).sum() <= CROWD:
        low = high
    while high - low > 1e-6:
        scale = 0.5 * (low + high)
        low, high = (scale, high) if counts(scale).sum() < CROWD else (low, scale)
    return np.ceil(vertices * counts(low)).astype(int).tolist()


def _closed_as_seen(contour: Contour, style: Style) -> Contour:
    """Close an open contour that is only filled, as filling does, and a stroke whose gap cannot be seen."""
    if contour.closed:
        return contour
    segments, (start, end) = contour.segments, (contour.segments[0, 0], contour.segments[-1, 3])
    if style.stroke is None:
        closing = np.vstack([segments, cubics.line(end, start)])
        return Contour(closing, np.append(contour.straight, True), closed=True) if style.fill else contour
    is_far = abs(end - start) > HIDDEN_GAP * style.stroke_width
    if (
        len(segments) < 2
        or is_far
        or style.stroke_dasharray
        or is_straight(segments.ravel(), style.stroke_width)
    ):
        return contour
    last = cubics.line(segments[-1, 0], start) if contour.straight[-1] else [*segments[-1, :3], start]
    return Contour(np.vstack([segments[:-1], last]), contour.straight, closed=True)


def _with_roles(contours: Sequence[PlacedContour], exterior_orientation: int) -> list[PlacedContour]:
    """Tell the exteriors of one shape from its holes, and orient them."""
    closed = [contour for contour in contours if contour.role == EXTERIOR]
    if not closed or closed[0].style.fill is None:
        return [c._replace(style=c.style._replace(fill_rule="nonzero")) for c in contours]
    nesting = nest([c.polygon for c in closed], closed[0].style.fill_rule, exterior_orientation)
    style = closed[0].style._replace(fill_rule=nesting.rule)
    placed = {c.number: c._replace(style=style, any_rule=nesting.any_rule) for c in contours}
    for (number, *_), parent, is_reversed in zip(closed, nesting.exterior, nesting.reversed, strict=True):
        contour = placed[number]
        if parent is not None:
            contour = contour._replace(role=HOLE, exterior=closed[parent].number)
        placed[number] = contour.reversed() if is_reversed else contour
    return list(placed.values())


def without_specks(drawing: Drawing, least: float | str) -> tuple[Drawing, list[str]]:
    """Return a drawing without contours whose larger side is below a length, and phrases about the others.

    The length is in the drawing's own units, or a share of its larger side such as ``1%``. Raises InputError if nothing
    is left.
    """
    boxes = [[cubics.bounds(contour.segments) for contour in shape.contours] for shape in drawing.shapes]
    whole = Box.union([box for own in boxes for box in own])
    limit = whole.larger_side * float(least[:-1]) / 100.0 if isinstance(least, str) else least
    shapes = []
    left_out = 0
    for shape, own in zip(drawing.shapes, boxes, strict=True):
        kept = tuple(c for c, box in zip(shape.contours, own, strict=True) if box.larger_side >= limit)
        left_out += len(own) - len(kept)
        if kept:
            shapes.append(replace(shape, contours=kept))
    if not shapes:
        raise InputError(
            drawing.file,
            f"all of its contours are smaller than {limit:.6g}; a smaller --specks would leave some",
        )
    if not left_out:
        return drawing, []
    what = "1 contour" if left_out == 1 else f"{left_out} contours"
    return drawing._replace(shapes=tuple(shapes)), [
        f"{drawing.file}: {what} smaller than {limit:.6g} left out"
    ]
