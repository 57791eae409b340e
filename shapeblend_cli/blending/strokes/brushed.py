"""Drawings that are brush strokes throughout, such as handwriting: their strokes become each other.

Matched outline to outline, the two sides of a stroke often go to one side of another, and it swells to a lump on the
way, or is turned inside out.
"""

from __future__ import annotations

from collections import defaultdict
from itertools import product
from typing import TYPE_CHECKING

from shapeblend_cli.anatomy.decompose import HOLE
from shapeblend_cli.blending.graded import BETTER, FINE, faults_of
from shapeblend_cli.blending.plates.plain import is_blend_of
from shapeblend_cli.model import ShapeBlend
from shapeblend_cli.pens.drawings import with_region_on_left
from shapeblend_cli.pens.line import UNITS, length
from shapeblend_cli.pens.named_lines import wants_lines

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing
    from shapeblend_cli.brushes.areas import Region
    from shapeblend_cli.brushes.sides import Brush
    from shapeblend_cli.brushes.stroke_blends import Matched
    from shapeblend_cli.brushes.strokes import Stroke
    from shapeblend_cli.model import Box, Shapes
    from shapeblend_cli.options.settings import Settings

SLENDER = 0.22 * UNITS
"""Maximum mean thickness of a drawing of brush strokes, in units."""

ALIKE = 2.0
"""Maximum ratio of the mean thicknesses of two drawings."""

WIDEST = 0.3 * UNITS
"""Maximum width of a brush stroke, in units."""

UNEVEN = 2.3
"""Maximum width of the widest stroke, in mean thicknesses of a drawing: a body with limbs is wider."""

MOST_STROKES = 6
"""Maximum number of strokes of a drawing."""

MOST_HOLES = 2
"""Maximum number of holes of a part of a drawing: bars between more are no strokes of a pen."""

LONGEST = 400.0
"""Maximum length of the outlines of a drawing, in units: longer ones are no letters."""

WRONG = 0.16
"""Minimum fault of a shape's outlines for a blend to be graded."""

TURNED = 0.1
"""Minimum advantage of strokes that turn as they go, which may leave the view, in faults."""

BECOMES = "a brush stroke that becomes another"
DRAWN_BACK, DRAWN_ON = "a brush stroke that is drawn back", "a brush stroke that is drawn on"


def with_brushes(a: PlacedDrawing, b: PlacedDrawing, settings: Settings, view: Box, usual: Shapes) -> Shapes:
    """Return the blend in which brush strokes become each other, if drawings are such and that looks better.

    The drawings are plain, see `plates.plain.is_plain`.
    """
    scale = UNITS / view.larger_side
    if settings.strokes != "auto" or not wants_lines(settings):
        return usual
    if any(style.stroke is not None for shape in usual for style in (shape.style_a, shape.style_b)):
        return usual
    if not any(shape.taken and shape.taken.wrong >= WRONG for shape in usual):
        return usual
    if _segments(a) == _segments(b):  # outlines that were made from each other, segment by segment
        return usual
    thicknesses = [scale * _thickness(drawing) for drawing in (a, b)]
    thin, thick = sorted(thicknesses)
    if thick > min(SLENDER, ALIKE * thin) or not (_may_be_brushed(a, scale) and _may_be_brushed(b, scale)):
        return usual
    widths = [min(WIDEST, UNEVEN * thickness) for thickness in thicknesses]
    strokes_a = _strokes(a, widths[0], scale)
    strokes_b = _strokes(b, widths[1], scale) if strokes_a is not None else None
    if strokes_a is None or strokes_b is None:
        return usual
    faults = faults_of(usual, view)
    if faults <= FINE:
        return usual
    brushes_a = _brushes(strokes_a, widths[0])
    brushes_b = _brushes(strokes_b, widths[1]) if brushes_a is not None else None
    if brushes_a is None or brushes_b is None:
        return usual
    from shapeblend_cli.brushes import stroke_blends  # few drawings are handwriting

    brushes = brushes_a, brushes_b
    best = faults - BETTER
    paired = stroke_blends.paired_strokes(*brushes)
    ways = (stroke_blends.vertices_of(paired, wires) for wires in (None, settings))
    for vertices, turns in product(ways, (False, True)):
        found = None if vertices is None else stroke_blends.matched(paired, vertices, turns=turns)
        if found is None:
            continue
        shape = _shape(found, brushes, (a, b), settings, scale)
        own = faults_of((shape,), view) + (TURNED if turns else 0.0)
        if own < best and is_blend_of((shape,), a, b, view):
            best, usual = own, (shape,)
    return usual


def _segments(drawing: PlacedDrawing) -> list[int]:
    """Return the number of segments of each contour."""
    return sorted(len(contour.contour.segments) for contour in drawing.contours)


def _may_be_brushed(drawing: PlacedDrawing, scale: float) -> bool:
    """Return whether a drawing is small enough to be handwriting; letters of texts become letters."""
    contours = drawing.contours
    if sum(contour.role != HOLE for contour in contours) > MOST_STROKES:
        return False
    if any(drawing.drawing.shapes[contour.shape].element == "text" for contour in contours):
        return False
    return sum(length(contour.polygon.line) for contour in contours) * scale <= LONGEST


def _thickness(drawing: PlacedDrawing) -> float:
    """Return the mean thickness of a drawing, if it is slender."""
    area = sum(contour.area * (-1.0 if contour.role == HOLE else 1.0) for contour in drawing.contours)
    around = sum(length(contour.polygon.line) for contour in drawing.contours)
    return 2.0 * area / max(around, 1e-12)


def _regions(drawing: PlacedDrawing, scale: float) -> list[Region]:
    """Return the regions of a drawing, each an exterior with its holes."""
    from shapeblend_cli.brushes.areas import Region
    from shapeblend_cli.pens.recovery.region import outline_points

    groups: dict[int, list[PlacedContour]] = defaultdict(list)
    for contour in drawing.contours:
        groups[contour.number if contour.exterior is None else contour.exterior].append(contour)
    return [
        Region(number, [outline_points(with_region_on_left(contour, scale)) for contour in members])
        for number, members in groups.items()
    ]


def _strokes(drawing: PlacedDrawing, widest: float, scale: float) -> list[tuple[Region, list[Stroke]]] | None:
    """Return the strokes of each region of a drawing; None if it is more than strokes up to a width, in units."""
    from shapeblend_cli.brushes.sides import least_width
    from shapeblend_cli.brushes.strokes import strokes_of

    regions = _regions(drawing, scale)
    if any(len(region.rings) > 1 + MOST_HOLES for region in regions):
        return None
    found = []
    for region in regions:
        strokes = strokes_of(region)
        if least_width(region, strokes) > widest:
            return None
        found.append((region, strokes))
    return found


def _brushes(found: Sequence[tuple[Region, list[Stroke]]], widest: float) -> list[Brush] | None:
    """Return the strokes of regions with their outlines; None if one is wider, or there are too many or none."""
    from shapeblend_cli.brushes.sides import brushes_of

    brushes = []
    for region, strokes in found:
        own = brushes_of(region, strokes)
        if any(2.0 * float(region.distances(brush.points).max()) > widest for brush in own):
            return None
        brushes += own
    return brushes if 0 < len(brushes) <= MOST_STROKES else None


def _shape(
    found: Matched,
    brushes: tuple[Sequence[Brush] | None, Sequence[Brush] | None],
    drawings: tuple[PlacedDrawing, PlacedDrawing],
    settings: Settings,
    scale: float,
) -> ShapeBlend:
    """Return all strokes as one shape, in A's coordinates."""
    from shapeblend_cli.pens.moves import contour_blend

    motion = found.motion.scaled(1.0 / scale)
    contours = []
    for pair, *ends in zip(found.pairs, motion.outlines(0.0), motion.outlines(1.0), strict=True):
        a, b = (
            None if k is None or own is None else own[k].contour for k, own in zip(pair, brushes, strict=True)
        )
        reason = DRAWN_BACK if b is None else DRAWN_ON if a is None else BECOMES
        blend = contour_blend((a, b), ends, True, settings.constants)
        contours.append(blend._replace(reason=reason))
    first = [drawing.contours[0] for drawing in drawings]
    style_a, style_b = (contour.style._replace(fill_rule="nonzero") for contour in first)
    sources = first[0].shape, first[1].shape
    return ShapeBlend(tuple(contours), style_a, style_b, motion=motion, reason=BECOMES, sources=sources)
