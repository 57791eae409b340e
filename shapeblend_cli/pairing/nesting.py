"""Outlines and their holes, told by what the fill rule paints and not by the way they were drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.crossings import polygon_crossings
from shapeblend_cli.geometry.polygons import orientation, winding_numbers
from shapeblend_cli.model import Box

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, IntArray, Polygon

SAMPLES = 32
"""Places of a contour on whose two sides the paint is looked at."""

STEP = 1e-4
"""How far from the contour that is, as a share of its larger side."""


class Nesting(NamedTuple):
    """The parts that the closed contours of one shape play.

    Attributes
    ----------
    outline : tuple of int or None
        For each contour the outline that it is a hole in; None for an outline.
    turned : tuple of bool
        Which contours have to be reversed so that all outlines go one way round and all holes the other.
    rule : {'nonzero', 'evenodd'}
        The fill rule that paints the contours, so turned, as they were painted. ``nonzero`` wherever that does: under
        it outlines that meet on their way do not cancel each other.
    any_rule : bool
        Whether the other rule would paint the same.
    """

    outline: tuple[int | None, ...]
    turned: tuple[bool, ...]
    rule: str
    any_rule: bool


def nest(polygons: Sequence[Polygon], rule: str, way: int = 1) -> Nesting:
    """Tell outlines from holes.

    A contour is a hole if there is paint outside it and none inside, along more of it than the other way round.
    Every other contour is an outline, also one with paint on both sides.

    Parameters
    ----------
    polygons : sequence of Polygon
        The closed contours of a shape.
    rule : {'nonzero', 'evenodd'}
    way : {1, -1}
        Which way round outlines are to go: 1 from x towards y.

    Returns
    -------
    Nesting
        Where contours cross each other or themselves, or no such directions paint the same, the rule stays the given
        one; and then, under ``nonzero``, all contours are turned or none.
    """
    ways = [orientation(polygon) for polygon in polygons]
    is_simple = polygon_crossings(polygons) == 0
    if len(polygons) == 1:
        return Nesting((None,), (ways[0] == -way,), "nonzero" if is_simple else rule, is_simple)

    boxes = [polygon.box for polygon in polygons]
    sides = [
        tuple(_windings(points, polygons, boxes) for points in _both_sides(polygon, box, own))
        for polygon, box, own in zip(polygons, boxes, ways, strict=True)
    ]
    painted = [tuple(_painted(side.sum(axis=0), rule) for side in both) for both in sides]
    is_hole = [(~inside & outside).sum() > (inside & ~outside).sum() for inside, outside in painted]
    outline = [
        _innermost(inner, is_hole, boxes) if hole else None
        for (inner, _), hole in zip(sides, is_hole, strict=True)
    ]
    turned = [own == (-way if home is None else way) for own, home in zip(ways, outline, strict=True)]
    signs = np.where(turned, -1, 1)
    stays = {
        new: all(
            np.array_equal(_painted(signs @ windings, new), paint)
            for both, paints in zip(sides, painted, strict=True)
            for windings, paint in zip(both, paints, strict=True)
        )
        for new in ("nonzero", "evenodd")
    }
    if is_simple and stays["nonzero"]:
        return Nesting(tuple(outline), tuple(turned), "nonzero", stays["evenodd"])
    if rule == "nonzero":
        largest = max(range(len(boxes)), key=lambda k: boxes[k].area)
        turned = [turned[largest]] * len(polygons)
    return Nesting(tuple(outline), tuple(turned), rule, False)


def _painted(windings: IntArray, rule: str) -> BoolArray:
    return windings != 0 if rule == "nonzero" else windings % 2 == 1


def _both_sides(polygon: Polygon, box: Box, way: int) -> tuple[ComplexArray, ComplexArray]:
    """Points just inside and just outside a contour, spread evenly along it."""
    vertices = polygon.vertices
    edges = np.roll(vertices, -1) - vertices
    ladder = np.concatenate([[0.0], np.cumsum(np.abs(edges))])
    at = (np.arange(SAMPLES) + 0.5) / SAMPLES * ladder[-1]
    edge = np.searchsorted(ladder, at, side="right") - 1
    along = edges[edge] / np.abs(edges[edge])
    points = vertices[edge] + (at - ladder[edge]) * along
    # A contour that goes from x towards y has its inside where its edges, turned from x to y, point.
    step = 1j * along * STEP * box.larger_side * (way or 1)
    return points + step, points - step


def _windings(points: ComplexArray, polygons: Sequence[Polygon], boxes: Sequence[Box]) -> IntArray:
    """How often each polygon goes round each point, (polygons, points) int."""
    found = np.zeros((len(polygons), len(points)), np.intp)
    for k, (polygon, box) in enumerate(zip(polygons, boxes, strict=True)):
        near = (np.abs(points.real - box.x - box.width / 2) <= box.width / 2) & (
            np.abs(points.imag - box.y - box.height / 2) <= box.height / 2
        )
        if near.any():
            found[k, near] = winding_numbers(points[near], polygon.vertices)
    return found


def _innermost(windings: IntArray, is_hole: Sequence[bool], boxes: Sequence[Box]) -> int | None:
    """The smallest outline around most of a hole."""
    around = (windings != 0).sum(axis=1) * 2 > SAMPLES
    homes = [k for k in range(len(boxes)) if around[k] and not is_hole[k]]
    return min(homes, key=lambda k: boxes[k].area, default=None)
