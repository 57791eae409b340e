"""Contours that are the same in place, whatever their nodes and their direction."""

from __future__ import annotations

from functools import reduce
from operator import or_
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.anatomy.decompose import HOLE, PlacedContour
from shapeblend_cli.geometry.polyline import are_near, thin
from shapeblend_cli.model import Box
from shapeblend_cli.pairing.paint_order import paint_order, visible_overlaps

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair

    Numbers = tuple[int, int]

TOLERANCE = 2e-3
"""Maximum distance of contours that are the same, as a share of the drawings' diagonal."""

OWN_TOLERANCE = 1e-2
"""Maximum distance of contours that are the same, as a share of their own diagonal."""

LOOKED_AT_FIRST = (32, 1024)
"""Maximum numbers of points of a contour that are looked at before all: most contours differ in one of these."""


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
    distance = TOLERANCE * Box.union([contour.box for contour in (*a, *b)]).diagonal
    for i, j in _candidates(a, b, distance):
        pairs = _with_exteriors(a[i], b[j])
        is_free = all(partners[p] == q if p in partners else q not in taken for p, q in pairs)
        if is_free and are_same(a[i], b[j], distance):
            add(pairs)
            found.append((a[i], b[j]))
            if len(found) == min(len(a), len(b)):
                break  # contours drawn again and again in one place have no end of candidates
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


def _candidates(a: Sequence[PlacedContour], b: Sequence[PlacedContour], distance: float) -> Iterator[Numbers]:
    """Yield the indices of contours of two lists that have the same box, the most alike first."""
    bounds = [np.array([contour.box.bounds for contour in side]) for side in (a, b)]
    near = np.ones((len(a), len(b)), np.bool_)
    for of_a, of_b in zip(bounds[0].T, bounds[1].T, strict=True):
        near &= np.abs(of_a[:, None] - of_b) <= distance
    i, j = np.nonzero(near)
    codes: dict[str | None, int] = {None: 0}
    unlike, recoloured = np.zeros(len(i), np.bool_), np.zeros(len(i), np.bool_)
    for name in ("fill", "stroke"):
        of_a, of_b = (
            np.array([codes.setdefault(getattr(c.style, name), len(codes)) for c in side]) for side in (a, b)
        )
        unlike |= (of_a == 0)[i] != (of_b == 0)[j]
        recoloured |= of_a[i] != of_b[j]
    is_hole = np.array([contour.role == HOLE for contour in a])
    numbers = [np.array([contour.number for contour in side]) for side in (a, b)]
    order = np.lexsort((j, i, np.abs(numbers[0][i] - numbers[1][j]), recoloured, unlike, is_hole[i]))
    for k in order:
        yield int(i[k]), int(j[k])


def are_same(p: PlacedContour, q: PlacedContour, distance: float) -> bool:
    """Return whether two contours are of one kind and lie on each other, nowhere further apart than a distance."""
    if p.role != q.role or p.polygon.closed != q.polygon.closed:
        return False
    distance = min(distance, OWN_TOLERANCE * max(p.size, q.size))
    if np.array_equal(p.polygon.vertices, q.polygon.vertices):
        return True
    lines = p.polygon.line, q.polygon.line
    return all(
        are_near(thin(points, most), line, distance).all()
        for most in (*LOOKED_AT_FIRST, max(map(len, lines)))
        for points, line in (lines, lines[::-1])
    )
