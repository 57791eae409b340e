"""Further drawings laid over the first, with their views and pages."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing, decompose, main_orientation
from shapeblend_cli.frames.views import view_of
from shapeblend_cli.geometry.placement import place_over
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.model import Box, CubicPath, Page, PaintedShape

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Drawing
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.system.kept import Kept

AS_IT_IS = Similarity()


class LaidDrawing(NamedTuple):
    """A drawing laid over the first."""

    placed: PlacedDrawing
    painted: tuple[PaintedShape, ...]
    view: Box  # the part of the plane to show
    page: Page


def lay(
    drawings: Sequence[Drawing], settings: Settings, kept: Kept
) -> tuple[list[LaidDrawing], Sequence[str]]:
    """Lay drawings over the first and flatten them. Return also notes on contours that were left out."""
    maps = place(drawings, settings.place)
    placed, notes = flattened(drawings, maps, settings.vertices, kept)
    laid = []
    for k, (drawing, to_a) in enumerate(zip(drawings, maps, strict=True)):
        painted = as_drawn(drawing, to_a)
        viewbox, own_page = drawing.viewbox, drawing.page
        if settings.place == "bbox":  # the first drawing's view and size stand in for the others'
            viewbox, page = drawings[0].viewbox, drawings[0].page._replace(name=own_page.name)
        else:
            viewbox, page = (
                viewbox and to_a.box(viewbox),
                own_page._replace(box=own_page.box and to_a.box(own_page.box)),
            )
        is_own = k == 0 or settings.place != "bbox"
        view = view_of(painted, viewbox, settings.viewbox, own=is_own)
        laid.append(
            LaidDrawing(
                placed[k]._replace(view=view),
                painted,
                view,
                page._replace(heading=own_page.heading),
            )
        )
    return laid, notes


def place(drawings: Sequence[Drawing], place: str) -> list[Similarity]:
    """Return the maps that lay drawings over the first."""
    first, *others = drawings
    return [Similarity(), *(place_over(first, drawing, place) for drawing in others)]


def flattened(
    drawings: Sequence[Drawing], maps: Sequence[Similarity], vertices: int, kept: Kept
) -> tuple[list[PlacedDrawing], list[str]]:
    """Decompose drawings into flattened contours, all oriented as in the first; return also notes."""
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
    """Decompose a drawing, unless that is kept.

    What is kept is oriented as the drawing is, if that will do: so it is the same whichever drawing comes first.
    """
    if kept.keeps and orientation is not None:
        own = _contours(drawing, to_a, vertices, None, kept)
        if main_orientation([contour.polygon for contour in own[0]]) == orientation:
            return own
    # The drawing is kept with its contours, so that no other object gets its id.
    key = id(drawing), to_a, vertices, orientation
    found = kept.find(key)
    if found is None:
        found = drawing, decompose(drawing, to_a, vertices, orientation)
        kept.keep(key, found, drawing.bytes_of_segments)
    contours: tuple[list[PlacedContour], list[str]] = found[1]
    return contours


def as_drawn(drawing: Drawing, to_a: Similarity = AS_IT_IS) -> tuple[PaintedShape, ...]:
    """Return the shapes that a drawing paints, laid over A. Shapes that share a clip still share it."""

    def laid(paths: Sequence[CubicPath]) -> tuple[CubicPath, ...]:
        return tuple(CubicPath(to_a.points(path.segments), path.straight, path.closed) for path in paths)

    given = [
        clip
        for shape in drawing.shapes
        for found in (shape.clips, *(effect.clips for effect in shape.effects))
        for clip in found
    ]
    clips = {id(clip): clip._replace(paths=laid(clip.paths)) for clip in given}
    return tuple(
        PaintedShape(
            laid(shape.contours),
            to_a.style(shape.style),
            name=shape.name,
            groups=shape.groups,
            clips=tuple(clips[id(clip)] for clip in shape.clips),
            page_coloured=shape.page_coloured,
            effects=tuple(
                to_a.effect(effect, tuple(clips[id(clip)] for clip in effect.clips))
                for effect in shape.effects
            ),
        )
        for shape in drawing.shapes
    )
