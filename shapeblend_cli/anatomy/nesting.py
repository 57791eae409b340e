"""Exteriors and their holes, told apart by the painted areas and not by directions."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.crossings import polygon_crossings
from shapeblend_cli.geometry.polygons import crosses_itself, orientation
from shapeblend_cli.geometry.polyline import cumulative_lengths, from_end_to_end
from shapeblend_cli.geometry.raster import Bands, winding_sums, winding_table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, Box, ComplexArray, FloatArray, IntArray, Polygon

SAMPLES = 32
"""Number of points of a contour beside which paint is looked for."""

STEP = 1e-4
"""Distance of the places that are looked at from the contour, as a share of its larger side."""


class Nesting(NamedTuple):
    """Roles and directions of the closed contours of one shape.

    For each contour there is the exterior that it is a hole in, None for an exterior, and whether it must be reversed
    so that all exteriors run one way round and all holes the other. The fill rule is one under which they then paint
    what they painted, ``nonzero`` if possible, as exteriors that meet on their way do not cancel each other under it.
    `any_rule` says whether the other rule would do as well.
    """

    exterior: tuple[int | None, ...]
    reversed: tuple[bool, ...]
    rule: str
    any_rule: bool


def nest(polygons: Sequence[Polygon], rule: str, exterior_orientation: int = 1) -> Nesting:
    """Tell the exteriors of a shape's closed contours from its holes, and orient them.

    A contour is a hole if there is paint outside it and none inside, along more of it than the reverse. Every other
    contour is an exterior, also one with paint on both sides. If contours cross each other or themselves, or no such
    directions paint the same, the fill rule is the given one; then, under ``nonzero``, all are reversed or none.
    """
    signs = [orientation(polygon) for polygon in polygons]
    if len(polygons) == 1:
        is_simple = not crosses_itself(polygons[0])
        is_reversed = signs[0] == -exterior_orientation
        return Nesting((None,), (is_reversed,), "nonzero" if is_simple else rule, is_simple)

    is_simple = polygon_crossings(polygons, most=1) == 0
    boxes = [polygon.box for polygon in polygons]
    bands = Bands.of([polygon.vertices for polygon in polygons], np.array(boxes))
    first: dict[bytes, int] = {}
    # Of contours that are drawn again and again, one is looked at.
    copied = [first.setdefault(polygon.vertices.tobytes(), k) for k, polygon in enumerate(polygons)]
    kinds = list(first.values())
    sides = np.array([_both_sides(polygons[k], boxes[k], signs[k]) for k in kinds])

    def windings(factors: IntArray) -> IntArray:
        return winding_sums(sides.ravel(), bands, factors).reshape(sides.shape)

    paint = _painted(windings(np.ones(len(polygons), np.intp)), rule)
    inside, outside = paint[:, 0], paint[:, 1]
    hollow = (~inside & outside).sum(axis=1) > (inside & ~outside).sum(axis=1)
    is_hollow = dict(zip(kinds, hollow.tolist(), strict=True))
    is_hole = np.array([is_hollow[k] for k in copied])
    areas = np.array([box.area for box in boxes])
    around = {
        k: _smallest_around(points, bands, is_hole, areas)
        for k, (points, _) in zip(kinds, sides, strict=True)
        if is_hollow[k]
    }
    exterior = tuple(around.get(k) for k in copied)
    reverse = [
        sign == (-exterior_orientation if parent is None else exterior_orientation)
        for sign, parent in zip(signs, exterior, strict=True)
    ]
    directed = windings(np.where(reverse, -1, 1))
    paints_the_same = {new: np.array_equal(_painted(directed, new), paint) for new in ("nonzero", "evenodd")}
    if is_simple and paints_the_same["nonzero"]:
        return Nesting(exterior, tuple(reverse), "nonzero", paints_the_same["evenodd"])
    if rule == "nonzero":
        reverse = [reverse[int(areas.argmax())]] * len(polygons)
    return Nesting(exterior, tuple(reverse), rule, False)


def _painted(windings: IntArray, rule: str) -> BoolArray:
    return windings != 0 if rule == "nonzero" else windings % 2 == 1


def _both_sides(polygon: Polygon, box: Box, sign: int) -> tuple[ComplexArray, ComplexArray]:
    """Return points just inside and just outside a contour, spread evenly along it."""
    vertices = polygon.vertices
    edges = np.roll(vertices, -1) - vertices
    distance = cumulative_lengths(from_end_to_end(vertices, closed=True))
    sampled = (np.arange(SAMPLES) + 0.5) / SAMPLES * distance[-1]
    edge = np.searchsorted(distance, sampled, side="right") - 1
    tangent = edges[edge] / np.abs(edges[edge])
    points = vertices[edge] + (sampled - distance[edge]) * tangent
    # The interior of a contour that runs from x towards y is on that side of its edges.
    step = 1j * tangent * STEP * box.larger_side * (sign or 1)
    return points + step, points - step


def _smallest_around(points: ComplexArray, bands: Bands, is_hole: BoolArray, areas: FloatArray) -> int | None:
    """Return the smallest exterior around most of the points just inside a hole."""
    around = np.flatnonzero((winding_table(points, bands) != 0).sum(axis=1) * 2 > SAMPLES)
    around = around[~is_hole[around]]
    return int(around[areas[around].argmin()]) if len(around) else None
