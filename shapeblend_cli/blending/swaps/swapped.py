"""A drawing shrinks away, and the other one grows in its place, as interfaces swap icons with nothing in common."""

from __future__ import annotations

from functools import partial
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.interpolate.paths import with_curves
from shapeblend_cli.model import Box, Pattern, ShapeBlend
from shapeblend_cli.wires.contour_blends import grow_from_point

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing
    from shapeblend_cli.model import ContourBlend, FloatArray, Shapes, Style
    from shapeblend_cli.options.settings import Settings

GONE = 0.46
"""Time at which the drawing that leaves is gone: it is quicker than the one that comes."""

COMES = 0.445
"""Time at which a drawing begins to come: nearly when the other one is gone, else both would be a lump."""

KNOTS = 12
"""Number of even steps of which the pace of a drawing is made."""

SHRINKS = 4
"""Power of the time by which a drawing shrinks: slowly enough for that to be seen, else the change would be a cut."""

GROWS = 15
"""Power of the time, backwards, by which a drawing grows: it is soon large."""

SPECK = 1e-4
"""Size of the gradients of what is gone, as a share of their own: those of size 0 would have no direction."""

STEPS = np.arange(KNOTS + 1) / KNOTS
"""Even shares of the time that a drawing takes to leave or to come."""

LEAVING = GONE * STEPS
"""Times of these steps for the drawing that leaves."""

COMING = COMES + (1.0 - COMES) * STEPS
"""Times of these steps for the drawing that comes."""

SWAPPED = "the drawings would not blend well, so one takes the other's place"
RESHAPED = "the drawings change over half way, where their silhouettes meet"
ASKED = "one drawing takes the other's place, as asked"
FILLED = "one drawing is the other one filled, so a level moves in it"


def is_swapped(shapes: Sequence[ShapeBlend]) -> bool:
    """Return whether a drawing takes the place of the other one."""
    return bool(shapes) and all(shape.reason in (ASKED, RESHAPED, SWAPPED) for shape in shapes)


def is_filled(shapes: Sequence[ShapeBlend]) -> bool:
    """Return whether a level moves between a drawing and the same one filled."""
    return bool(shapes) and all(shape.reason == FILLED for shape in shapes)


def is_reshaped(shapes: Sequence[ShapeBlend]) -> bool:
    """Return whether the drawings change over half way, where their silhouettes meet."""
    return bool(shapes) and all(shape.reason == RESHAPED for shape in shapes)


def swapped(
    a: PlacedDrawing, b: PlacedDrawing, settings: Settings, view: Box, reason: str = SWAPPED
) -> Shapes:
    """Return shapes of A that shrink to the centre of the view, below shapes of B that grow from it."""
    centre = view.centre
    leaving, coming = _rooms((a, b), centre)
    paces = _leaving(leaving), _coming(coming)

    def scaled(side: PlacedDrawing, here: int) -> Iterator[ShapeBlend]:
        blend = partial(grow_from_point, point=centre, of_b=bool(here))
        for shape in shapes_of_one(side, here, blend, curves=settings.curves):
            gone = _as_speck(shape.style_a, centre)
            shape = shape._replace(style_a=gone) if here else shape._replace(style_b=gone)
            yield shape._replace(reason=reason, pace=paces[here])

    return (*scaled(a, here=0), *scaled(b, here=1))


def _as_speck(style: Style, centre: complex) -> Style:
    """Return the style of what is gone: strokes and gradients shrink with what they paint.

    Patterns stay, which CSS would move in steps.
    """
    gone = (
        Similarity(SPECK, onto=centre, about=centre)
        .style(style)
        ._replace(pixel=style.pixel, stroke_width=0.0)
    )
    if isinstance(style.fill_gradient, Pattern):
        gone = gone._replace(fill_gradient=style.fill_gradient)
    if isinstance(style.stroke_gradient, Pattern):
        gone = gone._replace(stroke_gradient=style.stroke_gradient)
    return gone


def shapes_of_one(
    side: PlacedDrawing, here: int, blend: Callable[[PlacedContour], ContourBlend], *, curves: bool
) -> Iterator[ShapeBlend]:
    """Yield the shapes of a drawing, 0 or 1, which have none of the other one, with contours as `blend` has them."""
    for number, members in groupby(side.contours, key=lambda contour: contour.shape):
        of_shape = list(members)
        blends = map(blend, of_shape)
        style = of_shape[0].style
        yield ShapeBlend(
            tuple(map(with_curves, blends) if curves else blends),
            style,
            style,
            sources=(None, number) if here else (number, None),
        )


def _rooms(sides: tuple[PlacedDrawing, PlacedDrawing], centre: complex) -> list[FloatArray]:
    """Return how large each drawing may be at each step to stay in the picture, whose view changes: shares of its size.

    Parts of a drawing outside its own view do not count, nor does a side of it beyond which the centre lies.
    """
    views = [side.view for side in sides if side.view is not None]
    if len(views) < 2 or not all(side.contours for side in sides):
        return [np.ones(len(STEPS))] * 2
    found = []
    for side, view, times in zip(sides, views, (LEAVING, COMING), strict=True):
        ink = Box.union([contour.box.expanded(contour.style.reach) for contour in side.contours])
        own = np.minimum(_distances(ink, centre), _distances(view, centre))
        there = np.array([_distances(views[0].interpolate(views[1], t), centre) for t in times.tolist()])
        found.append((there[:, own > 0.0] / own[own > 0.0]).min(axis=1, initial=1.0).clip(0.0))
    return found


def _distances(box: Box, centre: complex) -> FloatArray:
    """Return how far the sides of a box are from a point: left, top, right and bottom, below 0 if it is beyond them."""
    left, top, right, bottom = box.bounds
    return np.array([centre.real - left, centre.imag - top, right - centre.real, bottom - centre.imag])


def _leaving(rooms: FloatArray) -> tuple[tuple[float, float], ...]:
    """Return the pace of a drawing that shrinks away: ever faster.

    It shrinks early where there is no room for it.
    """
    shrunk = np.maximum(STEPS**SHRINKS, 1.0 - rooms)
    return (*zip(LEAVING.tolist(), shrunk.tolist(), strict=True), (1.0, 1.0))


def _coming(rooms: FloatArray) -> tuple[tuple[float, float], ...]:
    """Return the pace of a drawing that grows: ever slower, and into no more room than there is."""
    grown = np.minimum(1.0 - (1.0 - STEPS) ** GROWS, rooms)
    return ((0.0, 0.0), *zip(COMING.tolist(), grown.tolist(), strict=True))
