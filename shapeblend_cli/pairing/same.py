"""Contours that are the same in place, whatever their nodes and their direction."""

from __future__ import annotations

from functools import reduce
from operator import or_
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.anatomy.decompose import HOLE, PlacedContour
from shapeblend_cli.geometry.polyline import nearest_places
from shapeblend_cli.model import Box
from shapeblend_cli.pairing.paint_order import paint_order, visible_overlaps

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair

    Numbers = tuple[int, int]

TOLERANCE = 2e-3
"""Maximum distance of contours that are the same, as a share of the drawings' diagonal."""

OWN_TOLERANCE = 1e-2
"""Maximum distance of contours that are the same, as a share of their own diagonal."""


def same_pairs(
    a: Sequence[PlacedContour], b: Sequence[PlacedContour], required: Sequence[Numbers] = ()
) -> list[Numbers]:
    """Return the numbers of pairs of contours that are the same in place, and so stay where they are.

    Of several contours in one place the most alike in paint are paired, then the nearest in the order of paint, which
    has to be kept. The pairs, and the pairs of the exteriors around their holes, do not contradict required pairs.
    """
    partners: dict[int | None, int | None] = {}
    taken: set[int | None] = set()

    def add(pairs: Sequence[tuple[int | None, int | None]]) -> None:
        partners.update(pairs)
        taken.update(j for _, j in pairs)

    in_a, in_b = ({contour.number: contour for contour in side} for side in (a, b))
    for i, j in required:
        if i in in_a and j in in_b:
            add(_with_exteriors(in_a[i], in_b[j]))
    found: list[ContourPair] = []
    for _, i, j in sorted((_difference(a[i], b[j]), i, j) for i, j in _same(a, b)):
        pairs = _with_exteriors(a[i], b[j])
        if all(partners[p] == q if p in partners else q not in taken for p, q in pairs):
            add(pairs)
            found.append((a[i], b[j]))
    return [(p.number, q.number) for p, q in _in_order_of_paint(found, a, b)]


def _in_order_of_paint(
    pairs: Sequence[ContourPair], a: Sequence[PlacedContour], b: Sequence[PlacedContour]
) -> list[ContourPair]:
    """Return the pairs that can all keep the order of paint; of two that cannot, the larger one."""
    below = visible_overlaps(a), visible_overlaps(b)
    if paint_order([(p.shape, q.shape) for p, q in pairs], *below) is not None:
        return list(pairs)
    neighbours = [_lower_and_higher(overlaps) for overlaps in below]
    kept: list[ContourPair] = []
    above: list[int] = []  # the kept pairs above each, directly or not: bit k is number k
    of_shapes: list[dict[int, int]] = [{}, {}]  # the kept pairs of each shape of A and of B
    for pair in sorted(pairs, key=lambda pair: -pair[0].size):
        shapes = pair[0].shape, pair[1].shape
        lower, higher = (
            _union(
                known.get(other, 0)
                for shape, known, near in zip(shapes, of_shapes, neighbours, strict=True)
                for other in near[end].get(shape, ())
            )
            for end in (0, 1)
        )
        higher |= _union(those for k, those in enumerate(above) if higher >> k & 1)
        if higher & lower:
            continue
        new = 1 << len(kept)
        above = [
            those | higher | new if lower >> k & 1 or those & lower else those
            for k, those in enumerate(above)
        ]
        above.append(higher)
        kept.append(pair)
        for shape, known in zip(shapes, of_shapes, strict=True):
            known[shape] = known.get(shape, 0) | new
    return kept


def _lower_and_higher(overlaps: Sequence[Numbers]) -> tuple[dict[int, list[int]], dict[int, list[int]]]:
    """Return the shapes directly below each shape, and the shapes directly above it."""
    lower: dict[int, list[int]] = {}
    higher: dict[int, list[int]] = {}
    for low, high in overlaps:
        lower.setdefault(high, []).append(low)
        higher.setdefault(low, []).append(high)
    return lower, higher


def _union(sets: Iterable[int]) -> int:
    return reduce(or_, sets, 0)


def _with_exteriors(p: PlacedContour, q: PlacedContour) -> list[tuple[int | None, int | None]]:
    """Return the numbers of two contours and, if they are holes, of the exteriors around them."""
    return [(p.number, q.number), (p.exterior, q.exterior)][: 2 if p.role == q.role == HOLE else 1]


def _same(a: Sequence[PlacedContour], b: Sequence[PlacedContour]) -> list[Numbers]:
    """Return the indices of contours of two lists that are of one kind and in one place."""
    bounds = [np.array([contour.box.bounds for contour in side]) for side in (a, b)]
    boxes = [Box.union([contour.box for contour in side]) for side in (a, b)]
    distance = TOLERANCE * Box.union(boxes).diagonal
    near = np.abs(bounds[0][:, None] - bounds[1]).max(axis=2) <= distance
    return [(i, j) for i, j in np.argwhere(near).tolist() if are_same(a[i], b[j], distance)]


def are_same(p: PlacedContour, q: PlacedContour, distance: float) -> bool:
    """Return whether two contours are of one kind and lie on each other, nowhere further apart than a distance."""
    if p.role != q.role or p.polygon.closed != q.polygon.closed:
        return False
    distance = min(distance, OWN_TOLERANCE * max(p.size, q.size))
    lines = p.polygon.line, q.polygon.line
    return all(nearest_places(points, line)[0].max() <= distance for points, line in (lines, lines[::-1]))


def _difference(p: PlacedContour, q: PlacedContour) -> tuple[bool, bool, bool, int]:
    """Return a key by which contours that lie on each other are sorted, the most alike first."""
    fills, strokes = ((getattr(p.style, name), getattr(q.style, name)) for name in ("fill", "stroke"))
    unlike = any((one is None) != (other is None) for one, other in (fills, strokes))
    recoloured = any(one != other for one, other in (fills, strokes))
    return p.role == HOLE, unlike, recoloured, abs(p.number - q.number)
