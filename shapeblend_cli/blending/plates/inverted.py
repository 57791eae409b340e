"""Signs that are dark on light in one drawing and light on dark in the other: an icon that is filled, sign and all.

Contours are paired by their places, whatever they are, an island in a ring with a hole of a disc; the hole of the ring
closes. By the even-odd rule its edge inverts the sign as it passes over it, and nothing else moves.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import HOLE, LINE
from shapeblend_cli.blending.graded import FINE, faults_of
from shapeblend_cli.geometry.polygons import centroid, winding_numbers
from shapeblend_cli.geometry.polyline import nearest_places
from shapeblend_cli.interpolate.paths import with_curves
from shapeblend_cli.model import Box, PaintedShape, Pair, ShapeBlend
from shapeblend_cli.pairing.growth import MatchedPoints, growth_point_inside
from shapeblend_cli.wires.constraints import Constraints
from shapeblend_cli.wires.contour_blends import grow_from_point
from shapeblend_cli.wires.match import match_contours

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair, PlacedContour, PlacedDrawing
    from shapeblend_cli.model import ContourBlend, Shapes
    from shapeblend_cli.options.settings import Settings

MOST_CONTOURS = 60
"""Maximum number of contours of a drawing that may be inverted."""

NEAR = 0.04
"""Maximum mean distance of contours in one place, as a share of the drawing's size."""

SAME_PICTURE = 0.02
"""Maximum difference of a drawing and its contours painted by the even-odd rule, as a share of its ink."""

INVERTED = "the sign is inverted as what is around it is filled"


class _Places(NamedTuple):
    """Contours that are in one place in both drawings, and the others."""

    pairs: list[ContourPair]
    alone: tuple[list[PlacedContour], list[PlacedContour]]

    @property
    def is_inverted(self) -> bool:
        """Whether holes of one drawing close, and islands in them are holes in the other."""
        kinds = {p.role == q.role for p, q in self.pairs}
        return (
            len(kinds) == 2
            and not all(self.alone)
            and all(c.role == HOLE for side in self.alone for c in side)
        )


def with_signs_inverted(
    a: PlacedDrawing, b: PlacedDrawing, settings: Settings, view: Box, usual: Shapes
) -> Shapes:
    """Return the blend in which a sign is inverted in place, unless there is none or the usual blend looks fine.

    The drawings are plain, see `is_plain`.
    """
    if max(len(a.contours), len(b.contours)) > MOST_CONTOURS:
        return usual
    places = _in_place(a.contours, b.contours, NEAR * view.larger_side)
    if not places.is_inverted or faults_of(usual, view) <= FINE:
        return usual
    matched = [(p, q, match_contours(p, q, settings, Constraints())) for p, q in places.pairs]
    contours = [blend for _, _, blend in matched]
    for here, side in enumerate(places.alone):
        contours += [growing(each, matched, here) for each in side]
    if settings.curves:
        contours = [with_curves(blend) for blend in contours]
    style_a, style_b = (each.contours[0].style._replace(fill_rule="evenodd") for each in (a, b))
    sources = a.contours[0].shape, b.contours[0].shape
    shape = ShapeBlend(tuple(contours), style_a, style_b, reason=INVERTED, sources=sources)
    return (shape,) if is_blend_of((shape,), a, b, view) else usual


def is_plain(drawing: PlacedDrawing) -> bool:
    """Return whether a drawing has only fills of one plain colour, and no clips."""
    style = drawing.contours[0].style
    if style.fill is None or style.fill_gradient is not None or style.fill_opacity < 1.0:
        return False
    if any(drawing.drawing.shapes[contour.shape].clips for contour in drawing.contours):
        return False
    return all(
        contour.role != LINE and contour.style.stroke is None and contour.style.fill == style.fill
        for contour in drawing.contours
    )


def _in_place(a: Sequence[PlacedContour], b: Sequence[PlacedContour], distance: float) -> _Places:
    """Pair contours that are in one place, the nearest first."""
    found = []
    for i, p in enumerate(a):
        for j, q in enumerate(b):
            apart = distance_between(p, q, distance)
            if apart is not None:
                found.append((apart, i, j))
    rest: list[dict[int, PlacedContour]] = [dict(enumerate(a)), dict(enumerate(b))]
    pairs = []
    for _, i, j in sorted(found):
        if i in rest[0] and j in rest[1]:
            pairs.append((rest[0].pop(i), rest[1].pop(j)))
    return _Places(pairs, (list(rest[0].values()), list(rest[1].values())))


def distance_between(p: PlacedContour, q: PlacedContour, most: float) -> float | None:
    """Return the mean distance of two contours; None if it is too large for one place."""
    if max(abs(x - y) for x, y in zip(p.box.bounds, q.box.bounds, strict=True)) > 2.0 * most:
        return None
    lines = p.polygon.line, q.polygon.line
    apart = max(float(nearest_places(one, other)[0].mean()) for one, other in (lines, lines[::-1]))
    return apart if apart <= min(most, 0.2 * p.box.larger_side) else None


def growing(
    contour: PlacedContour, matched: Sequence[tuple[PlacedContour, PlacedContour, ContourBlend]], here: int
) -> ContourBlend:
    """Return the blend of a contour without a partner, from its middle or from a place within what is around it."""
    middle = centroid(contour.polygon.vertices)
    around = [
        MatchedPoints(*blend.dot_points()[:: -1 if here else 1])
        for p, q, blend in matched
        if (p, q)[here].number == contour.exterior
    ]
    if contour.role == HOLE and around:
        middle = growth_point_inside(contour.polygon.vertices, around[0])
    elif not winding_numbers(np.array([middle]), contour.polygon.vertices)[0]:
        middle = complex(contour.polygon.vertices[0])
    return grow_from_point(contour, middle, of_b=bool(here))


def is_blend_of(shapes: Shapes, a: PlacedDrawing, b: PlacedDrawing, view: Box) -> bool:
    """Return whether shapes paint what two drawings do, at their start and at their end, but for a share of the ink."""
    return _paints_alike(shapes, 0.0, a, view) and _paints_alike(shapes, 1.0, b, view)


def _paints_alike(shapes: Shapes, t: float, drawing: PlacedDrawing, view: Box) -> bool:
    """Return whether shapes paint what a drawing does, but for a share of the ink."""
    from shapeblend_cli.frames.frames import shapes_at
    from shapeblend_cli.grading.painting import picture  # few blends come so far

    pair = Pair(0, 1, shapes, ((), ()), (view, view))
    whole: dict[int, list[PlacedContour]] = {}
    for contour in drawing.contours:
        whole.setdefault(contour.shape, []).append(contour)
    drawn = [PaintedShape(tuple(c.contour for c in group), group[0].style) for group in whole.values()]
    inks = [picture(painted, view)[3] for painted in (shapes_at(pair, t), drawn)]
    return float(np.abs(inks[0] - inks[1]).sum()) <= SAME_PICTURE * float(inks[1].sum())
