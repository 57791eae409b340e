"""The order in which paired shapes are painted: shapes on top stay on top, or change their place on the way."""

from __future__ import annotations

import heapq
from collections import Counter
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.geometry.polyline import thin
from shapeblend_cli.model import Box, Place, Style
from shapeblend_cli.model.arrays import rolled

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

    Shapes = tuple[int | None, int | None]


SAMPLES = 128
"""Maximum number of a contour's vertices that are checked for meeting another contour."""


class Overlaps:
    """Pairs of shapes of one drawing, the lower first, that are visibly on each other, found when they are wanted."""

    def __init__(self, contours: Sequence[PlacedContour]) -> None:
        """Keep the contours of the drawing."""
        self._contours = contours

    @cached_property
    def by_boxes(self) -> list[tuple[int, int]]:
        """Those whose boxes overlap."""
        return visible_overlaps(self._contours)

    @cached_property
    def by_outlines(self) -> list[tuple[int, int]]:
        """Those that meet, and not only their boxes."""
        return _without_near_misses(self._contours, self.by_boxes)


def paint_places(
    groups: Sequence[Shapes], sizes: Sequence[float], overlaps: Sequence[Overlaps]
) -> list[Place]:
    """Return the places of groups of contours in the order of paint, from the lowest.

    If the drawings contradict each other, a few groups, rather small ones, have a place in A and another one in B.
    """
    a, b = overlaps
    below = a.by_boxes, b.by_boxes
    order = paint_order(groups, *below)
    if order is None:
        below = a.by_outlines, b.by_outlines
        order = paint_order(groups, *below)
    if order is not None:
        return [Place(k) for k in order]
    twice = _in_two_places(groups, sizes, below)
    parts: list[tuple[Place, Shapes]] = []
    for k, (in_a, in_b) in enumerate(groups):
        if k in twice:
            parts += [(Place(k, 0), (in_a, None)), (Place(k, 1), (None, in_b))]
        else:
            parts.append((Place(k), (in_a, in_b)))
    order = paint_order([shapes for _, shapes in parts], *below)
    assert order is not None, "each drawing by itself has an order"
    return [parts[k][0] for k in order]


def _in_two_places(
    groups: Sequence[Shapes],
    sizes: Sequence[float],
    below: tuple[list[tuple[int, int]], list[tuple[int, int]]],
) -> set[int]:
    """Return the groups that need a place for each drawing, found one by one."""
    found = [
        (low, high, side)
        for side, pairs in enumerate(below)
        for low, high in _between_groups(groups, pairs, side)
    ]
    edges, count = np.array(found, np.intp).reshape(-1, 3), len(groups)
    twice: list[int] = []
    while len(core := _core(_split(edges, twice, count), count)):
        # Two places for a group cut each path that leads to it by one drawing and away from it by the other.
        into, out_of = (
            [np.bincount(core[core[:, 2] == side, end], minlength=2 * count)[:count] for side in (0, 1)]
            for end in (1, 0)
        )
        cut = into[0] * out_of[1] + into[1] * out_of[0]
        twice.append(min(np.flatnonzero(cut).tolist(), key=lambda k: (-cut[k], sizes[k], k)))
    for k in list(twice):  # later groups may have made this one needless
        others = [other for other in twice if other != k]
        if not len(_core(_split(edges, others, count), count)):
            twice = others
    return set(twice)


def _split(edges: IntArray, twice: Sequence[int], count: int) -> IntArray:
    """Give groups a second number, by `count` larger, in the edges of B."""
    has_two = np.zeros(count, np.intp)
    has_two[list(twice)] = count
    of_b = edges[:, 2:] == 1
    return np.concatenate([edges[:, :2] + of_b * has_two[edges[:, :2]], edges[:, 2:]], axis=1)


def _core(edges: IntArray, count: int) -> IntArray:
    """Return the edges (lower group, higher group, side) between groups that have others below and above them."""
    while True:
        is_low, is_high = np.zeros(2 * count, np.bool_), np.zeros(2 * count, np.bool_)
        is_low[edges[:, 0]] = is_high[edges[:, 1]] = True
        inner = is_high[edges[:, 0]] & is_low[edges[:, 1]]
        if inner.all():
            return edges
        edges = edges[inner]


def _between_groups(
    groups: Sequence[Shapes], pairs: Sequence[tuple[int, int]], side: int
) -> Iterator[tuple[int, int]]:
    """Yield pairs of groups, the lower first, given such pairs of shapes of one drawing."""
    members: dict[int | None, list[int]] = {}
    for k, group in enumerate(groups):
        members.setdefault(group[side], []).append(k)
    for low, high in pairs:
        yield from product(members.get(low, ()), members.get(high, ()))


def paint_order(
    groups: Sequence[Shapes], a: Sequence[tuple[int, int]], b: Sequence[tuple[int, int]]
) -> list[int] | None:
    """Return the indices of groups of contours from the lowest to the highest; None if the drawings contradict.

    The order is as near as possible to the order in both files. A group belongs to a shape of A and a shape of B; `a`
    and `b` are pairs of shapes, the lower first, that are visibly on each other.
    """
    above: list[set[int]] = [set() for _ in groups]
    for side, pairs in enumerate((a, b)):
        for low, high in _between_groups(groups, pairs, side):
            above[low].add(high)
    waiting = Counter(k for higher in above for k in higher)
    ready = [(_file_order(group), k) for k, group in enumerate(groups) if not waiting[k]]
    heapq.heapify(ready)
    ordered = []
    while ready:
        _, k = heapq.heappop(ready)
        ordered.append(k)
        for other in above[k]:
            waiting[other] -= 1
            if not waiting[other]:
                heapq.heappush(ready, (_file_order(groups[other]), other))
    return ordered if len(ordered) == len(groups) else None


def _file_order(group: Shapes) -> tuple[int, int]:
    known = [shape for shape in group if shape is not None]
    return min(known), max(known)


def visible_overlaps(contours: Sequence[PlacedContour]) -> list[tuple[int, int]]:
    """Return pairs of shapes of one drawing, the lower first, whose boxes overlap and whose paint differs."""
    shapes = sorted({contour.shape for contour in contours})
    if len(shapes) < 2:  # none at all if all that the drawing has are pen lines
        return []
    boxes: dict[int, list[Box]] = {shape: [] for shape in shapes}
    paints: dict[int, object] = {}
    for contour in contours:
        boxes[contour.shape].append(contour.box.expanded(contour.style.reach))
        paints.setdefault(contour.shape, _single_paint(contour.style))
    x, y, width, height = np.array([Box.union(boxes[shape]) for shape in shapes]).T
    meet = (x[:, None] < x + width) & (y[:, None] < y + height)
    return [
        (shapes[low], shapes[high])
        for low, high in np.argwhere(np.triu(meet & meet.T, 1)).tolist()
        if paints[shapes[low]] != paints[shapes[high]]
        and any(p.overlaps(q) for p in boxes[shapes[low]] for q in boxes[shapes[high]])
    ]


def _single_paint(style: Style) -> object:
    """Return the paint of a style that has only one, else an object unequal to all others."""
    paints = {paint for paint in style.paints if paint.colour is not None}
    return paints if len(paints) == 1 else object()


def _without_near_misses(
    contours: Sequence[PlacedContour], pairs: Sequence[tuple[int, int]]
) -> list[tuple[int, int]]:
    """Return the pairs of shapes that meet, and not only their boxes."""
    shapes: dict[int, list[PlacedContour]] = {}
    for contour in contours:
        shapes.setdefault(contour.shape, []).append(contour)
    return [(low, high) for low, high in pairs if _meet(shapes[low], shapes[high])]


def _meet(p: Sequence[PlacedContour], q: Sequence[PlacedContour]) -> bool:
    """Return whether two shapes have points in common, about."""
    outlines_p, outlines_q = ([thin(c.polygon.vertices, SAMPLES) for c in shape] for shape in (p, q))
    reach = p[0].style.reach + q[0].style.reach
    if any(_touch(one, other, reach) for one in outlines_p for other in outlines_q):
        return True
    return _is_around(p, outlines_p, outlines_q) or _is_around(q, outlines_q, outlines_p)


def _is_around(
    shape: Sequence[PlacedContour], around: Sequence[ComplexArray], inner: Sequence[ComplexArray]
) -> bool:
    """Return whether an inner outline begins inside a shape, which crosses none of them."""
    if shape[0].style.fill is None:
        return False
    return any(sum(winding_numbers(points[:1], outline)[0] for outline in around) for points in inner)


def _touch(p: ComplexArray, q: ComplexArray, reach: float) -> bool:
    """Return whether two closed polygons cross, or have vertices within `reach` of each other."""
    if reach and np.abs(p[:, None] - q).min() <= reach:
        return True
    after_p, after_q = rolled(p, -1), rolled(q, -1)

    def sides(start: ComplexArray, end: ComplexArray, point: ComplexArray) -> FloatArray:
        return ((end - start).conj()[:, None] * (point - start[:, None])).imag

    q_apart = sides(p, after_p, q) * sides(p, after_p, after_q) < 0.0
    p_apart = sides(q, after_q, p) * sides(q, after_q, after_p) < 0.0
    return bool((q_apart & p_apart.T).any())
