"""The order in which paired shapes are painted, so that what is on top stays on top."""

from __future__ import annotations

import heapq
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.model import Box, Style

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.pairing.decompose import PlacedContour

    Shapes = tuple[int | None, int | None]


def paint_order(
    groups: Sequence[Shapes], a: Sequence[tuple[int, int]], b: Sequence[tuple[int, int]]
) -> list[int] | None:
    """Return the indices of groups of contours from the lowest to the highest, None if the drawings contradict.

    That is as near to the order in both files as possible. A group comes from a shape of A and a shape of B, `a` and
    `b` are pairs of shapes of which the first is visibly below the second.
    """
    below: list[set[int]] = [set() for _ in groups]
    for side, pairs in enumerate((a, b)):
        members: dict[int, list[int]] = {}
        for k, group in enumerate(groups):
            shape = group[side]
            if shape is not None:
                members.setdefault(shape, []).append(k)
        for low, high in pairs:
            for k in members.get(high, ()):
                below[k].update(members.get(low, ()))
    above: list[list[int]] = [[] for _ in groups]
    for k, lower in enumerate(below):
        for other in lower:
            above[other].append(k)
    waiting = [len(lower) for lower in below]
    ready = [(_file_order(groups[k]), k) for k in range(len(groups)) if not waiting[k]]
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
    """Return pairs of shapes of one drawing of which the first is visibly below the second.

    That is, their boxes overlap and they are not painted all in one and the same colour.
    """
    shapes = sorted({contour.shape for contour in contours})
    boxes: dict[int, list[Box]] = {shape: [] for shape in shapes}
    paints: dict[int, object] = {}
    for contour in contours:
        reach = contour.style.stroke_width if contour.style.stroke else 0.0
        boxes[contour.shape].append(contour.box.expanded(reach / 2))
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
    """Return the colour and opacity of a style that has only one, else something unequal to all others."""
    paints = {
        (colour, opacity)
        for colour, opacity in ((style.fill, style.fill_opacity), (style.stroke, style.stroke_opacity))
        if colour is not None
    }
    return paints if len(paints) == 1 else object()
