"""How further drawings are laid over the first, and what is seen of each."""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING

from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing, decompose, main_orientation
from shapeblend_cli.frames.views import view_of
from shapeblend_cli.geometry.placement import place_over
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.model import CubicPath, PaintedShape

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box, Drawing, Page
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.system.kept import Kept

AS_IT_IS = Similarity()


def place(drawings: Sequence[Drawing], place: str) -> list[Similarity]:
    """Return the maps that lay drawings over the first."""
    first, *others = drawings
    return [Similarity(), *(place_over(first, drawing, place) for drawing in others)]


def flattened(
    drawings: Sequence[Drawing], maps: Sequence[Similarity], vertices: int, kept: Kept
) -> tuple[list[PlacedDrawing], list[str]]:
    """Decompose drawings into flattened contours, those of all oriented as in the first."""
    placed: list[PlacedDrawing] = []
    notes: list[str] = []
    orientation = None
    for drawing, to_a in zip(drawings, maps, strict=True):
        contours, left_out = _contours(drawing, to_a, vertices, orientation, kept)
        orientation = orientation or main_orientation([contour.polygon for contour in contours])
        placed.append(PlacedDrawing(drawing, to_a, contours))
        notes += left_out
    return placed, notes


def _contours(
    drawing: Drawing, to_a: Similarity, vertices: int, orientation: int | None, kept: Kept
) -> tuple[list[PlacedContour], list[str]]:
    """Decompose a drawing, unless that is kept."""
    # The number of a drawing is no other one's for as long as it is there, and it is kept with its contours.
    key = id(drawing), to_a, vertices, orientation
    found = kept.find(key)
    if found is None:
        found = drawing, decompose(drawing, to_a, vertices, orientation)
        size = sum(contour.segments.nbytes for shape in drawing.shapes for contour in shape.contours)
        kept.keep(key, found, size)
    contours: tuple[list[PlacedContour], list[str]] = found[1]
    return contours


def as_drawn(drawing: Drawing, to_a: Similarity = AS_IT_IS) -> tuple[PaintedShape, ...]:
    """Return what a drawing paints, laid over A. Shapes that have a clip in common still do."""
    clips = {
        id(clip): clip._replace(
            paths=tuple(CubicPath(to_a.points(c.segments), c.straight, c.closed) for c in clip.paths)
        )
        for shape in drawing.shapes
        for clip in shape.clips
    }
    return tuple(
        PaintedShape(
            tuple(CubicPath(to_a.points(c.segments), c.straight, c.closed) for c in shape.contours),
            to_a.style(shape.style),
            name=shape.name,
            groups=shape.groups,
            clips=tuple(clips[id(clip)] for clip in shape.clips),
        )
        for shape in drawing.shapes
    )


def pages_of(drawings: Sequence[Drawing], maps: Sequence[Similarity], place: str) -> list[Page]:
    """Return the page of each drawing, laid over A; the first one's size if they are laid by their bounds."""
    pages = []
    for drawing, to_a in zip(drawings, maps, strict=True):
        own = drawing.page
        page = own._replace(box=own.box and to_a.box(own.box))
        if place == "bbox":
            page = drawings[0].page._replace(name=own.name)
        pages.append(page._replace(heading=PurePath(drawing.file).stem))
    return pages


def views_of(
    drawings: Sequence[Drawing],
    maps: Sequence[Similarity],
    drawn: Sequence[tuple[PaintedShape, ...]],
    settings: Settings,
) -> list[Box]:
    """Return what to show of each drawing: its own viewBox, or the first one's if they are laid by their bounds."""
    viewboxes = [
        drawing.viewbox and to_a.box(drawing.viewbox) for drawing, to_a in zip(drawings, maps, strict=True)
    ]
    is_bbox = settings.place == "bbox"
    if is_bbox:
        viewboxes = [drawings[0].viewbox] * len(drawings)
    return [
        view_of(shapes, viewbox, settings.viewbox, own=k == 0 or not is_bbox)
        for k, (shapes, viewbox) in enumerate(zip(drawn, viewboxes, strict=True))
    ]
