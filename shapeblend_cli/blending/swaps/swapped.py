"""A drawing shrinks away, and the other one grows in its place, as interfaces swap icons with nothing in common."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.interpolate.paths import with_curves
from shapeblend_cli.model import Box, ShapeBlend
from shapeblend_cli.wires.contour_blends import grow_from_point

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing
    from shapeblend_cli.options.settings import Settings

    Shapes = tuple[ShapeBlend, ...]

GONE = 0.46
"""Time at which the drawing that leaves is gone: it is quicker than the one that comes."""

COMES = 0.445
"""Time at which a drawing begins to come: nearly when the other one is gone, else both would be a lump."""

KNOTS = 12
"""Number of even steps of which the pace of a drawing is made."""

SNAP = 16
"""Power of the time by which a drawing shrinks, and backwards grows: large for long, and small for moments only."""

SAME_VIEW = 1e-6
"""Maximum distance of the sides of two views that are the same, as a share of the larger side."""

SWAPPED = "the drawings have too little in common, so one takes the other's place"
RESHAPED = "the drawings change over half way, where their silhouettes meet"
ASKED = "one drawing takes the other's place, as asked"


def is_swapped(shapes: Sequence[ShapeBlend]) -> bool:
    """Return whether a drawing takes the place of the other one."""
    return bool(shapes) and all(shape.reason in (ASKED, RESHAPED, SWAPPED) for shape in shapes)


def is_reshaped(shapes: Sequence[ShapeBlend]) -> bool:
    """Return whether the drawings change over half way, where their silhouettes meet."""
    return bool(shapes) and all(shape.reason == RESHAPED for shape in shapes)


def swapped(
    a: PlacedDrawing, b: PlacedDrawing, settings: Settings, view: Box, reason: str = SWAPPED
) -> Shapes:
    """Return shapes of A that shrink to the centre of the view, below shapes of B that grow from it."""
    centre, is_one_view = view.centre, all(_fills(side, view) for side in (a, b))

    def scaled(contours: Sequence[PlacedContour], here: int) -> Iterator[ShapeBlend]:
        for number, members in groupby(contours, key=lambda contour: contour.shape):
            of_shape = list(members)
            blends = [grow_from_point(contour, centre, of_b=bool(here)) for contour in of_shape]
            style = of_shape[0].style
            styles = style, style._replace(stroke_width=0.0)
            yield ShapeBlend(
                tuple(map(with_curves, blends) if settings.curves else blends),
                *(styles[::-1] if here else styles),
                reason=reason,
                sources=(None, number) if here else (number, None),
                pace=_coming(is_one_view) if here else _leaving(is_one_view),
            )

    return (*scaled(a.contours, here=0), *scaled(b.contours, here=1))


def _fills(side: PlacedDrawing, view: Box) -> bool:
    """Return whether a drawing is seen in all of a view."""
    if side.drawing.viewbox is None:
        return False
    own = side.to_a.box(side.drawing.viewbox)
    return max(map(abs, np.subtract(own.bounds, view.bounds))) <= SAME_VIEW * view.larger_side


def _leaving(is_one_view: bool) -> tuple[tuple[float, float], ...]:
    """Return the pace of a drawing that shrinks away: ever faster, so that it is large for most of its time.

    In a view that changes it shrinks at least evenly, so that it stays in the picture.
    """
    steps = [k / KNOTS for k in range(KNOTS + 1)]
    shrunk = [step**SNAP if is_one_view else max(step**SNAP, GONE * step) for step in steps]
    return (*((GONE * step, share) for step, share in zip(steps, shrunk, strict=True)), (1.0, 1.0))


def _coming(is_one_view: bool) -> tuple[tuple[float, float], ...]:
    """Return the pace of a drawing that grows: ever slower."""
    times = [COMES + (1.0 - COMES) * k / KNOTS for k in range(KNOTS + 1)]
    grown = [1.0 - ((1.0 - t) / (1.0 - COMES)) ** SNAP for t in times]
    shares = grown if is_one_view else [min(share, t) for share, t in zip(grown, times, strict=True)]
    return ((0.0, 0.0), *zip(times, shares, strict=True))
