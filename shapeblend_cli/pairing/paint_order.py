"""In which order paired shapes are painted, so that what is on top stays on top."""

from __future__ import annotations

import heapq
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.model import Box

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Style
    from shapeblend_cli.pairing.decompose import PlacedContour

    Shapes = tuple[int | None, int | None]


def paint_order(
    groups: Sequence[Shapes], a: Sequence[tuple[int, int]], b: Sequence[tuple[int, int]]
) -> list[int] | None:
    """Order groups of contours.

    Parameters
    ----------
    groups : sequence of (int or None, int or None)
        The shape of A and the shape of B that each group comes from.
    a, b : sequence of (int, int)
        Shapes of A, and of B, of which the first is visibly below the second.

    Returns
    -------
    list of int or None
        Numbers of the groups from the lowest to the highest; as near to the order in both files as can be. None where
        the two drawings contradict each other.
    """
    below: list[set[int]] = [set() for _ in groups]
    for side, pairs in enumerate((a, b)):
        members: dict[int, list[int]] = {}
        for number, group in enumerate(groups):
            shape = group[side]
            if shape is not None:
                members.setdefault(shape, []).append(number)
        for low, high in pairs:
            for number in members.get(high, ()):
                below[number].update(members.get(low, ()))
    above: list[list[int]] = [[] for _ in groups]
    for number, lower in enumerate(below):
        for other in lower:
            above[other].append(number)
    waiting = [len(lower) for lower in below]
    ready = [(_height(groups[k]), k) for k in range(len(groups)) if not waiting[k]]
    heapq.heapify(ready)
    found = []
    while ready:
        _, number = heapq.heappop(ready)
        found.append(number)
        for other in above[number]:
            waiting[other] -= 1
            if not waiting[other]:
                heapq.heappush(ready, (_height(groups[other]), other))
    return found if len(found) == len(groups) else None


def _height(group: Shapes) -> tuple[int, int]:
    known = [shape for shape in group if shape is not None]
    return min(known), max(known)


def visible_overlaps(parts: Sequence[PlacedContour]) -> list[tuple[int, int]]:
    """Pairs of shapes of one drawing of which the first is visibly below the second: painted otherwise, and near."""
    shapes = sorted({part.shape for part in parts})
    boxes: dict[int, list[Box]] = {shape: [] for shape in shapes}
    looks: dict[int, object] = {}
    for part in parts:
        reach = part.style.stroke_width if part.style.stroke else 0.0
        boxes[part.shape].append(part.box.expanded(reach / 2))
        looks.setdefault(part.shape, _look(part.style))
    x, y, width, height = np.array([Box.union(boxes[shape]) for shape in shapes]).T
    meet = (x[:, None] < x + width) & (y[:, None] < y + height)
    return [
        (shapes[low], shapes[high])
        for low, high in np.argwhere(np.triu(meet & meet.T, 1)).tolist()
        if looks[shapes[low]] != looks[shapes[high]]
        and any(p.overlaps(q) for p in boxes[shapes[low]] for q in boxes[shapes[high]])
    ]


def _look(style: Style) -> object:
    """What tells which of two shapes is on top: nothing does, where both are all of one and the same colour."""
    paints = {
        (colour, opacity)
        for colour, opacity in ((style.fill, style.fill_opacity), (style.stroke, style.stroke_opacity))
        if colour is not None
    }
    return paints if len(paints) == 1 else object()
