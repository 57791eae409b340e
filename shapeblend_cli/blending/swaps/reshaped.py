"""Drawings whose silhouettes are alike: one takes the other's place where both have the same shape.

Until half way the first one is bent as its silhouette becomes the other one, and from there on the second one, as bent
at first as the first one was at last: what is inside changes at once, and its outline goes on.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import PlacedDrawing, decompose
from shapeblend_cli.blending.swaps.swapped import RESHAPED, shapes_of_one
from shapeblend_cli.blending.swaps.traced import silhouette
from shapeblend_cli.geometry.flat_contour import FlatContour
from shapeblend_cli.geometry.polygons import mean_value_table, polyline_contour, weighted_sums
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.interpolate.paths import segments_at
from shapeblend_cli.model import Contour, Drawing, Fade, ShapeBlend, Style
from shapeblend_cli.model.arrays import rolled
from shapeblend_cli.wires.contour_blends import follow

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.model import Box, ComplexArray, ContourBlend, FloatArray, PictureArray, Shapes

FARTHEST = 0.42
"""Maximum distance of the points of both silhouettes from each other, as a share of that from their own middles."""

MOST_TURNED = 0.5
"""Maximum mean angle by which the edges of the silhouettes turn, in radians."""

APPEARS = Fade(0.45, 0.47, comes=True)
"""Shares of the way between which B comes, on top of A."""

VANISHES = Fade(0.47, 0.48, comes=False)
"""Shares of the way between which A goes, covered by B."""

MOVING = (0.0, 0.49), (0.45, 1.0)
"""Times between which each drawing moves, and beyond which it is not seen."""

KNOTS = 5
"""Number of even steps of which the pace of either drawing is made."""


class Bent(NamedTuple):
    """The motion of contours of a drawing that are bent with its silhouette.

    Each control point is shifted as far as the mean of the silhouette's nodes, by its mean value coordinates there.
    """

    outline: ShapeBlend  # the silhouette
    own: ComplexArray  # its nodes in the drawing, (n,)
    weights: tuple[FloatArray, ...]  # of its nodes, for each contour: (4 k, n)
    here: int  # 0 for the first drawing, 1 for the second

    @property
    def name(self) -> str:
        """The name of the silhouette's motion."""
        return self.outline.motion_name

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        shift = nodes(self.outline, t) - self.own
        own = [contour.path(self.here).segments for contour in contours]
        return [
            segments + weighted_sums(weights, shift).reshape(segments.shape)
            for segments, weights in zip(own, self.weights, strict=True)
        ]


def reshaped(
    a: PlacedDrawing,
    b: PlacedDrawing,
    ink: tuple[PictureArray, PictureArray],
    view: Box,
    blend: Callable[[PlacedDrawing, PlacedDrawing], Shapes],
    *,
    curves: bool,
) -> Shapes | None:
    """Return shapes of A that are bent until half way, below shapes of B that are bent from there on.

    None if the silhouettes are too unlike, or are no single outlines, or if anything is clipped, filtered or a picture.

    Parameters
    ----------
    a, b : PlacedDrawing
    ink : tuple of (side, side) float
        What is painted of both, in the middle of square pictures of the view.
    view : Box
    blend : callable
        Blends the silhouettes, which are drawings of a single contour.
    curves : bool
        Whether shapes have the drawings' own curves.
    """
    sides = a, b
    if any(
        shape.clips or shape.effects or shape.has_pictures for side in sides for shape in side.drawing.shapes
    ):
        return None
    step = view.larger_side / len(ink[0])
    corner = view.centre - 0.5 * view.larger_side * (1.0 + 1.0j)
    placed = []
    for side, picture in zip(sides, ink, strict=True):
        line = silhouette(picture)
        if line is None:
            return None
        placed.append(_as_drawing(side, corner + step * line))
    outlines = blend(placed[0], placed[1])
    if len(outlines) != 1 or len(outlines[0].contours) != 1 or not outlines[0].is_matched:
        return None
    ends = nodes(outlines[0], 0.0), nodes(outlines[0], 1.0)
    if not are_alike(*ends):
        return None
    return tuple(
        shape
        for here, side in enumerate(sides)
        for shape in _bent(side, outlines[0], ends, here, curves=curves)
    )


def are_alike(a: ComplexArray, b: ComplexArray) -> bool:
    """Return whether two outlines, by points that correspond, are near each other, and their edges nearly parallel.

    Parameters
    ----------
    a, b : (n,) complex
        Along closed outlines.
    """
    edges = rolled(a, -1) - a, rolled(b, -1) - b
    shares = 0.5 * sum(np.abs(each) / np.abs(each).sum() for each in edges)
    weights = 0.5 * (shares + rolled(shares, 1))
    apart = (weights * np.abs(b - a) ** 2).sum()
    spread = sum((weights * np.abs(line - (weights * line).sum()) ** 2).sum() for line in (a, b))
    turns = np.abs(np.angle(edges[1] * edges[0].conj()))
    return bool(apart <= FARTHEST**2 * 0.5 * spread and (shares * turns).sum() <= MOST_TURNED)


def nodes(outline: ShapeBlend, t: float) -> ComplexArray:
    """Return the nodes of a silhouette at time t, (n,) complex."""
    points: ComplexArray = segments_at(outline, t)[0][:, 0]
    return points


def _as_drawing(side: PlacedDrawing, line: ComplexArray) -> PlacedDrawing:
    """Return a drawing of a single polygon, of which nothing else is known, in place of a drawing."""
    first = side.drawing.shapes[0]
    shape = replace(first, index=0, contours=(polyline_contour(line),), style=Style(), groups=())
    drawing = Drawing(side.drawing.file, None, (shape,))
    return PlacedDrawing(drawing, Similarity(), decompose(drawing, Similarity(), len(line), 1)[0])


def _bent(
    side: PlacedDrawing,
    outline: ShapeBlend,
    ends: tuple[ComplexArray, ComplexArray],
    here: int,
    *,
    curves: bool,
) -> Iterator[ShapeBlend]:
    """Yield the shapes of a drawing, 0 or 1, which are bent with a silhouette."""
    own, shift = ends[here], ends[1 - here] - ends[here]
    blend = partial(_with_image, own=own, shift=shift, here=here)
    for shape in shapes_of_one(side, here, blend, curves=curves):
        weights = tuple(mean_value_table(each.path(here).segments.ravel(), own) for each in shape.contours)
        yield shape._replace(
            motion=Bent(outline, own, weights, here),
            reason=RESHAPED,
            fade=APPEARS if here else VANISHES,
            pace=_pace(here),
        )


def _pace(here: int) -> tuple[tuple[float, float], ...]:
    """Return the pace of a drawing while it is seen: slow near its own time, so that it is seen as it is."""
    begin, until = MOVING[here]
    times = [begin + (until - begin) * k / KNOTS for k in range(KNOTS + 1)]
    knots = [(t, t**2 * (3.0 - 2.0 * t)) for t in times]
    return ((0.0, knots[0][1]), *knots) if here else (*knots, (1.0, knots[-1][1]))


def _with_image(contour: PlacedContour, own: ComplexArray, shift: ComplexArray, here: int) -> ContourBlend:
    """Return the blend of a contour and its image, where a silhouette is shifted."""

    def image(points: ComplexArray) -> ComplexArray:
        moved = points.ravel() + weighted_sums(mean_value_table(points.ravel(), own), shift)
        return moved.reshape(points.shape)

    segments, polygon = contour.contour.segments, contour.polygon
    far = Contour(image(segments), np.zeros(len(segments), np.bool_), contour.contour.closed)
    vertices = np.arange(len(polygon.vertices) + polygon.closed)
    there = FlatContour(far, replace(polygon, vertices=image(polygon.vertices)))
    return follow(contour, there, vertices, of_b=bool(here))
