"""A drawing and the same one filled, as icons that are selected: a level rises in their common silhouette.

Below the level the one with more ink is seen, and above it the other one. So what is black on white in an outline and
white on black in its fill, such as a check mark in a shield, changes along the level, and nothing else moves.

Not in the paper, whose shapes have no insides.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.blending.graded import faults_of
from shapeblend_cli.blending.swaps.swapped import FILLED, is_swapped, shapes_of_one
from shapeblend_cli.blending.swaps.traced import grown
from shapeblend_cli.blending.swaps.unlike import ink_of, is_faulty
from shapeblend_cli.geometry.polygons import rectangle
from shapeblend_cli.model import Box, ClipBlend, ShapeBlend, Style
from shapeblend_cli.wires.contour_blends import keep_still, vertex_by_vertex

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing
    from shapeblend_cli.model import BoolArray, ContourBlend, FloatArray, Paint, PictureArray, Shapes

ALIKE = 0.75
"""Minimum area that is common to both silhouettes, as a share of that of both together."""

WITHIN = 0.95
"""Minimum ink of the fuller drawing within the silhouette of the other one, as a share of its ink."""

MORE = 0.12
"""Minimum ink that the fuller drawing has more, as a share of the area of both silhouettes together."""

NEAR = 4
"""Maximum number of pixels from the edge of a hole to ink of the other drawing, for it to be no other hole."""

OTHER = 0.1
"""Minimum share of the edges of holes that are others for the usual blend to be broken before a level is better."""

BROKEN = 1.25
"""Minimum sum of the faults of a blend that is broken: a knob that slides, or a hole that bends, may have less."""

SEEN = 0.25
"""Minimum change of opacity in a row of pixels that the level passes slowly, as a share of the largest change."""

FASTER = 32.0
"""Speed of the level in other rows, as a multiple of its speed in these."""

OVERLAP = 0.01
"""Height in which both drawings are seen, as a share of the view's larger side: a gap would shine through."""

OVERLAP_INSIDE = 0.04
"""The same for opaque drawings of which nearly all ink of the one is within that of the other."""

INSIDE = 0.05
"""Maximum ink of the drawing with less that lies outside that of the other one for `OVERLAP_INSIDE`, as a share of its
ink."""


def filled(a: PlacedDrawing, b: PlacedDrawing, usual: Shapes, view: Box, *, curves: bool) -> Shapes:
    """Return the usual blend of two drawings, or if it looks bad one in which they stay, and a level moves.

    That is so if each has one colour, the one with more ink lies within the silhouette of the other one, and nothing is
    clipped, filtered or a picture.
    """
    sides = a, b
    if any(
        shape.clips or shape.effects or shape.has_pictures for side in sides for shape in side.drawing.shapes
    ):
        return usual
    if not (is_swapped(usual) or is_faulty(usual, view)):
        return usual
    paints = [_paints(side) for side in sides]
    colours = [{paint.colour for paint in each} for each in paints]
    if max(map(len, colours)) > 1 or any(paint.gradient for each in paints for paint in each):
        return usual
    inks = ink_of(usual, view)
    fuller = int(inks[1].sum() > inks[0].sum())
    sparse, full = inks[1 - fuller], inks[fuller]
    outer = _silhouette(sparse)
    if not _is_filled(sparse, full, outer):
        return usual
    if not is_swapped(usual) and faults_of(usual, view) < BROKEN and _has_other_holes(sparse, full, outer):
        return usual
    is_opaque = all(paint.opacity == 1.0 for each in paints for paint in each)
    is_inside = is_opaque and np.maximum(sparse - full, 0.0).sum() <= INSIDE * sparse.sum()
    either = np.maximum(full, sparse)
    changes = (either if colours[0] != colours[1] else np.abs(full - sparse)).max(axis=1)
    first, *_, last = np.flatnonzero(either.any(axis=1)).tolist()
    step = view.larger_side / len(full)
    levels = view.centre.imag - 0.5 * view.larger_side + step * np.array([first - 1, last + 2])
    is_slow = changes[first : last + 1] > SEEN * changes.max()
    if fuller:
        levels, is_slow = levels[::-1], is_slow[::-1]
    overlap = (OVERLAP_INSIDE if is_inside else OVERLAP) * view.larger_side
    drawn = [contour.box.expanded(contour.style.reach) for side in sides for contour in side.contours]
    above, below = _regions(levels, overlap, Box.union([*drawn, view]).expanded(2.0 * step))
    pace = _pace(is_slow)
    return (
        *_still(sides[1 - fuller], 1 - fuller, above, pace, curves=curves),
        *_still(sides[fuller], fuller, below, pace, curves=curves),
    )


def _paints(side: PlacedDrawing) -> list[Paint]:
    """Return all paint of a drawing that is seen."""
    paints = [paint for contour in side.contours for paint in contour.style.paints]
    return [paint for paint in paints if paint.colour is not None and paint.opacity > 0.0]


def _regions(levels: FloatArray, overlap: float, around: Box) -> tuple[ClipBlend, ClipBlend]:
    """Return the regions above and below a level, which is at one place in A and at another one in B, in a box."""
    left, top, right, bottom = around.expanded(overlap).bounds

    def region(tops: FloatArray, bottoms: FloatArray) -> ClipBlend:
        start, end = (
            rectangle(Box(left, high, right - left, low - high)).segments[:, 0]
            for high, low in zip(tops, bottoms, strict=True)
        )
        contour = vertex_by_vertex((0, 0), start, end, (right - left,) * 2)
        return ClipBlend((ShapeBlend((contour,), Style(), Style()),))

    return region(np.full(2, top), levels + overlap), region(levels, np.full(2, bottom))


def _pace(is_slow: BoolArray) -> tuple[tuple[float, float], ...]:
    """Return the pace of a level over rows of pixels, in the order in which it passes them."""
    times = np.append(0.0, np.cumsum(np.where(is_slow, 1.0, 1.0 / FASTER)))
    own = np.arange(len(times)) / (len(times) - 1)
    is_knot = np.concatenate([[True], np.diff(is_slow), [True]])
    return tuple(zip((times / times[-1])[is_knot].tolist(), own[is_knot].tolist(), strict=True))


def _is_filled(sparse: PictureArray, full: PictureArray, outer: BoolArray) -> bool:
    """Return whether the second of two pictures is the first one filled, whose silhouette is given."""
    inner = _silhouette(full)
    area = float((outer | inner).sum())
    if not area or (outer & inner).sum() < ALIKE * area or full.sum() - sparse.sum() < MORE * area:
        return False
    return bool(full[outer].sum() >= WITHIN * full.sum())


def _silhouette(ink: PictureArray) -> BoolArray:
    """Return the pixels with ink, and those around which there is ink."""
    free = np.pad(ink <= 0.5, 1, constant_values=True)
    outside = np.zeros_like(free)
    outside[0] = True
    while True:
        wide = grown(outside, 1) & free
        if (wide == outside).all():
            return ~outside[1:-1, 1:-1]
        outside = wide


def _has_other_holes(sparse: PictureArray, full: PictureArray, outer: BoolArray) -> bool:
    """Return whether the fuller picture has holes with edges where the other one has no ink, as a knob that moves."""
    holes = outer & (full <= 0.5)
    edges = (full > 0.5) & grown(holes, 1)
    return bool((edges & ~grown(sparse > 0.5, NEAR)).sum() > OTHER * edges.sum())


def _still(
    side: PlacedDrawing, here: int, clip: ClipBlend, pace: tuple[tuple[float, float], ...], *, curves: bool
) -> Iterator[ShapeBlend]:
    """Yield the shapes of a drawing, 0 or 1, as they are, clipped."""

    def blend(contour: PlacedContour) -> ContourBlend:
        return keep_still(contour, (None, contour.number) if here else (contour.number, None))

    for shape in shapes_of_one(side, here, blend, curves=curves):
        yield shape._replace(reason=FILLED, clips=(clip,), pace=pace)
