"""Drawings of one colour in which much goes wrong: their gaps close, and open again in what their silhouette becomes.

Parts that are separated by thin gaps would each become another part, or none: a head shrinks beside its neck, and
feathers end as a ragged fringe. The silhouette is one outline, or few.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache, partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import HOLE, PlacedDrawing, decompose, main_orientation
from shapeblend_cli.anatomy.letters import has_letters
from shapeblend_cli.blending.graded import SUSPECT, grade_of_shapes, is_suspect
from shapeblend_cli.blending.plates.inverted import is_blend_of
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flat_contour import FlatContour
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.model import Box, Contour, Drawing, Polygon, ShapeBlend
from shapeblend_cli.pens.line import length
from shapeblend_cli.wires.contour_blends import grow_from

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.blending.silhouettes.ground import Parted, Rim
    from shapeblend_cli.model import ComplexArray
    from shapeblend_cli.options.settings import Settings

    Shapes = tuple[ShapeBlend, ...]
    Wanted = list[tuple[int, int]]
    Blend = Callable[[PlacedDrawing, PlacedDrawing, Wanted, float], tuple[Shapes, float]]

DETAILED = 5.0
"""Minimum length of the outlines of a drawing that may be torn, in sides of the view."""

PLAIN = 3.3
"""Maximum length of the outlines of a plain drawing, in the same measure: holes of the other one close as they are."""

VOID = 0.1
"""Maximum radius of a hole that closes, and of what gaps enclose, in the same measure."""

SPACING = 0.004
"""Minimum distance of points on straight outlines, in the same measure."""

EXACT = 0.0008
"""Maximum distance of the outlines of gaps from their edges, in the same measure."""

PLACE = 0.25
"""Maximum distance of holes that are alike, in sizes of the drawings."""

ALIKE = 0.4
"""Minimum ratio of the areas of holes that are alike."""

ROUND = 0.8
"""Minimum area of a round hole, such as an eye, as a share of that of a disc with an outline as long."""

ALIKE_IF_ROUND = 0.2
"""Minimum ratio of the areas of round holes that are alike."""

MOST_CONTOURS = 60
"""Maximum number of contours of a drawing whose gaps may close."""

SAME = 0.08
"""Maximum difference from the drawings at the ends, as a share of their ink: small pictures have lines at mouths."""

CLOSED = "gaps close before the silhouette becomes the other one, and open in that"


class Width(NamedTuple):
    """A width of gaps that close, and how good the blend of the silhouettes alone has to look for that."""

    radius: float  # the largest of balls in gaps, as a share of the view's side
    least: float  # the least grade of the usual blend
    better: float  # the least advantage over that, in grades
    most: float  # the largest grade
    fault: float  # the least of the worst outline of the usual blend


WIDTHS = (
    Width(0.03, 1.2, 0.6, 1.35, SUSPECT),
    Width(0.03, 1.7, 0.6, 1.35, 0.0),
    Width(0.045, 1.0, 0.7, 0.85, SUSPECT),
    Width(0.045, 0.7, 0.9, 1.05, 0.1),
)
"""Widths of gaps that are tried until one looks good enough: wide gaps may also be between parts that stand apart."""

WORSE = 0.9
"""Maximum disadvantage of the blend with its gaps, in grades: the judge misses the detail of gaps that are closed."""


class _Side(NamedTuple):
    """A drawing, and what it is as silhouette and gaps."""

    drawing: PlacedDrawing
    rim: Rim
    parted: Parted
    silhouette: PlacedDrawing

    @property
    def largest(self) -> int:
        """The number of the largest outline."""
        return max(self.silhouette.contours, key=lambda contour: contour.area).number

    @property
    def edges(self) -> float:
        """The length of the edges of all gaps."""
        return sum(float(np.abs(np.diff(self.rim.points[line])).sum()) for line in self.parted.gaps)

    def same_hole(self, hole: PlacedContour) -> int | None:
        """Return the number of a hole of the drawing in the largest outline, if it is there."""
        holes = [contour for contour in self.silhouette.contours if contour.exterior == self.largest]
        found = min(holes, key=lambda contour: abs(contour.centre - hole.centre), default=None)
        is_there = found is not None and abs(found.centre - hole.centre) <= 1e-3 * hole.size
        return found.number if found is not None and is_there else None


def with_silhouettes(
    a: PlacedDrawing, b: PlacedDrawing, settings: Settings, view: Box, usual: Shapes, blend: Blend
) -> Shapes:
    """Return the blend in which gaps close and open, if that of the silhouettes looks far better than the usual one.

    The drawings are plain, see `is_plain`; `blend` blends two of them, with pairs of contours that are wanted, and
    grades that, given the grade up to which it is taken.
    """
    if max(len(a.contours), len(b.contours)) > MOST_CONTOURS or not _may_be_torn(a, b, view, usual):
        return usual
    grade = grade_of_shapes(usual, view)
    rim = cache(partial(_rim, (a, b), SPACING * view.larger_side))
    # None is better by more than the usual grade, as no grade is below 0.
    widths = [
        width
        for width in WIDTHS
        if grade >= max(width.least, width.better) and is_suspect(usual, width.fault)
    ]

    blends: dict[tuple[tuple[bytes, ...], ...], tuple[Shapes, float]] = {}

    @cache
    def closed(radius: float) -> tuple[tuple[_Side, _Side], Shapes, float] | None:
        sides = _sides(a, b, rim, settings, view.larger_side, radius)
        if sides is None:
            return None
        # Wider gaps may be in parts of their own, and leave the silhouettes as they were. Their limits are stricter.
        outlines = tuple(
            tuple(c.contour.segments.tobytes() for c in side.silhouette.contours) for side in sides
        )
        if outlines not in blends:
            most = max(limit(width) for width in widths if width.radius == radius)
            blends[outlines] = blend(sides[0].silhouette, sides[1].silhouette, _wanted(sides), most)
        return sides, *blends[outlines]

    def limit(width: Width) -> float:
        return min(width.most, grade - width.better)

    for width in widths:
        found = closed(width.radius)
        if found is None or found[2] > limit(width):
            continue
        sides, shapes, _ = found
        riding = (_riding(shapes, sides, view.larger_side),)
        if grade_of_shapes(riding, view) <= grade + WORSE and is_blend_of(riding, a, b, view, SAME):
            return riding
    return usual


def _may_be_torn(a: PlacedDrawing, b: PlacedDrawing, view: Box, usual: Shapes) -> bool:
    """Return whether a drawing has much detail, and the other one some, and outlines are bent or have no partner."""
    lengths = [sum(length(contour.polygon.line) for contour in each.contours) for each in (a, b)]
    if max(lengths) < DETAILED * view.larger_side or min(lengths) < PLAIN * view.larger_side:
        return False
    if any(map(has_letters, (a, b))):
        return False
    return is_suspect(usual) or any(not contour.is_matched for shape in usual for contour in shape.contours)


def _rim(drawings: tuple[PlacedDrawing, PlacedDrawing], spacing: float, side: int) -> Rim:
    from shapeblend_cli.blending.silhouettes.ground import rim_of  # few blends come so far

    return rim_of(drawings[side].contours, spacing)


def _sides(
    a: PlacedDrawing,
    b: PlacedDrawing,
    rim_at: Callable[[int], Rim],
    settings: Settings,
    view: float,
    radius: float,
) -> tuple[_Side, _Side] | None:
    """Return two drawings as silhouettes with gaps up to a radius, in a view of a side; None if there are none.

    Given are the drawings' rims, by 0 and 1.
    """
    from shapeblend_cli.blending.silhouettes.ground import parted  # few blends come so far

    kept: tuple[set[int], set[int]] = set(), set()
    for pair in _like_holes(a.contours, b.contours):
        for side, k in zip(kept, pair, strict=True):
            side.add(k)
    found = []
    for number, drawing in enumerate((a, b)):
        rim, stays = rim_at(number), kept[number]
        each = list(enumerate(drawing.contours))
        closed = np.array([contour.role == HOLE and rim.largest(k) < VOID * view for k, contour in each])
        is_kept = np.array([k in stays for k, _ in each])
        own = parted(rim, radius * view, closed, is_kept, VOID * view)
        if not own.outlines:
            return None
        found.append(_Side(drawing, rim, own, _silhouette(drawing, rim, own, settings.vertices)))
    return (found[0], found[1]) if any(side.parted.gaps for side in found) else None


def _like_holes(a: Sequence[PlacedContour], b: Sequence[PlacedContour]) -> list[tuple[int, int]]:
    """Return the indices of holes that are alike, in about the same places."""
    boxes = [Box.union([contour.box for contour in side]) for side in (a, b)]
    away = boxes[1].centre - boxes[0].centre
    most = PLACE * max(box.larger_side for box in boxes)
    near = []
    for i, p in enumerate(a):
        for j, q in enumerate(b):
            apart = abs(q.centre - p.centre - away)
            if p.role == q.role == HOLE and apart <= most and _are_alike(p, q):
                near.append((apart, i, j))
    pairs: list[tuple[int, int]] = []
    for _, i, j in sorted(near):
        if all(i != other and j != another for other, another in pairs):
            pairs.append((i, j))
    return pairs


def _are_alike(p: PlacedContour, q: PlacedContour) -> bool:
    """Return whether two holes have about the same area: round ones are alike though one is far larger."""
    is_round = [4.0 * np.pi * hole.area >= ROUND * length(hole.polygon.line) ** 2 for hole in (p, q)]
    return min(p.area, q.area) >= (ALIKE_IF_ROUND if all(is_round) else ALIKE) * max(p.area, q.area)


def _wanted(sides: tuple[_Side, _Side]) -> Wanted:
    """Return the numbers of the largest outlines, and of holes in them that are alike, in both silhouettes."""
    wanted = [(sides[0].largest, sides[1].largest)]
    for i, j in _like_holes(sides[0].drawing.contours, sides[1].drawing.contours):
        first = sides[0].same_hole(sides[0].drawing.contours[i])
        last = sides[1].same_hole(sides[1].drawing.contours[j])
        if first is not None and last is not None:
            wanted.append((first, last))
    return wanted


def _silhouette(own: PlacedDrawing, rim: Rim, found: Parted, vertices: int) -> PlacedDrawing:
    """Return the silhouette of a drawing."""
    from shapeblend_cli.blending.silhouettes.ground import outline

    outlines = tuple(Contour(*outline(rim, own.contours, line), closed=True) for line in found.outlines)
    first = own.contours[0]
    style = first.style._replace(fill_rule="nonzero")
    shape = replace(own.drawing.shapes[first.shape], index=0, contours=outlines, style=style)
    drawing = Drawing(own.drawing.file, own.drawing.viewbox, (shape,))
    direction = main_orientation([contour.polygon for contour in own.contours])
    return PlacedDrawing(drawing, Similarity(), decompose(drawing, Similarity(), vertices, direction)[0])


def _riding(shapes: Shapes, sides: tuple[_Side, _Side], view: float) -> ShapeBlend:
    """Return silhouettes on their way with gaps in them, in a view of a side.

    As these run against the outlines, by the nonzero rule they are cut out.
    """
    from shapeblend_cli.blending.silhouettes.riding import Riding, closing_times, edge_of, nodes

    outlines = [contour for shape in shapes for contour in shape.contours]
    first, last = nodes(outlines)
    until = closing_times(sides[0].edges, sides[1].edges)
    edges, growing = [], []
    for here, side in enumerate(sides):
        for line in side.parted.gaps:
            edge = edge_of(side.rim, side.parted, line, outlines, here, until[here], EXACT * view)
            closed = cubics.lines(edge.at(first - last if here else last - first, 1.0 - here), closed=True)
            number = side.drawing.contours[int(side.rim.contour[line[0]])].number
            edges.append(edge)
            growing.append(grow_from(closed, _flat(edge.points), number, of_b=bool(here)))
    styles = [side.drawing.contours[0].style._replace(fill_rule="nonzero") for side in sides]
    sources = sides[0].drawing.contours[0].shape, sides[1].drawing.contours[0].shape
    motion = Riding(tuple(shapes), tuple(edges))
    return ShapeBlend(
        (*outlines, *growing), styles[0], styles[1], motion=motion, reason=CLOSED, sources=sources
    )


def _flat(points: ComplexArray) -> FlatContour:
    """Return a polygon as a contour."""
    count = len(points)
    contour = Contour(cubics.lines(points, closed=True), np.ones(count, bool), closed=True)
    return FlatContour(contour, Polygon(points, np.arange(count), np.zeros(count), closed=True))
