"""The order of paint of several drawings at once.

Where drawings contradict each other, a shape is there twice or more, and each copy is seen in some drawings only.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.model import Box

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, FloatArray, IntArray, KeyframedShape, PaintedShape

NOWHERE = -1
"""The place of a shape in a drawing that does not have it."""


def stacked(shapes: Sequence[KeyframedShape], places: IntArray) -> list[KeyframedShape]:
    """Return shapes with a key for each drawing such that each drawing is painted in its own order.

    Parameters
    ----------
    shapes : sequence of KeyframedShape
        In the order that they keep where they do not lie on each other.
    places : (n, drawings) array of int
        The place of each shape in the order of each drawing; equal places have no order.
    """
    if not shapes:
        return []
    boxes = [[_box(key) for key in shape.keys] for shape in shapes]
    seen = np.array([[box is not None for box in own] for own in boxes])
    above = [
        _above([own[k] for own in boxes], [shape.keys[k] for shape in shapes], places[:, k])
        for k in range(places.shape[1])
    ]
    sizes = np.array([max((box.area for box in own if box is not None), default=0.0) for own in boxes])
    copies = _copies(seen, np.stack(above, axis=-1), sizes)
    several = {n for n, is_seen in copies if not np.array_equal(is_seen, seen[n])}
    return [_seen_in(shapes[n], is_seen) if n in several else shapes[n] for n, is_seen in copies]


def _box(key: PaintedShape) -> Box | None:
    """Return the box of what is seen of a shape in a drawing; None if that is nothing."""
    drawn = [path for path in key.paths if not path.is_point]
    if not drawn and key.style.reach:  # dots
        drawn = [*key.paths]
    if not drawn or not any(paint.colour is not None and paint.opacity for paint in key.style.paints):
        return None
    return Box.union([cubics.bounds(path.segments) for path in drawn]).expanded(key.style.reach)


def _above(boxes: Sequence[Box | None], keys: Sequence[PaintedShape], places: IntArray) -> BoolArray:
    """Return for each shape which others lie on it in a drawing, and are painted otherwise."""
    x, y, width, height = np.array([box or Box(np.nan, np.nan, np.nan, np.nan) for box in boxes]).T
    meet = (x[:, None] < x + width) & (y[:, None] < y + height)
    is_known = places != NOWHERE
    found = meet & meet.T & (places[:, None] < places) & is_known[:, None] & is_known
    for low, high in np.argwhere(found):
        style = keys[low].style
        has_one_paint = sum(paint.colour is not None for paint in style.paints) == 1
        found[low, high] = not has_one_paint or style != keys[high].style
    return found


def _copies(seen: BoolArray, above: BoolArray, sizes: FloatArray) -> list[tuple[int, BoolArray]]:
    """Return shapes from the lowest, each with the drawings in which it is seen there.

    If each shape that is left has another below it in some drawing, the one on which most others wait, of these the
    smallest, is painted in the drawings where it can be, and once more later.
    """
    left, is_waiting = seen.copy(), np.ones(len(seen), np.bool_)
    below = above.sum(axis=0)
    copies = []
    while is_waiting.any():
        can = left & (below == 0)
        whole = is_waiting & (can == left).all(axis=1)
        if whole.any():
            n = int(whole.argmax())
        else:
            waiting = [int((above[k] & left & can[k]).sum()) for k in range(len(left))]
            n = max(np.flatnonzero(can.any(axis=1)).tolist(), key=lambda k: (waiting[k], -sizes[k]))
        copies.append((n, can[n]))
        below -= above[n] & can[n]
        left[n] &= ~can[n]
        is_waiting[n] = left[n].any()
    return copies


def _seen_in(shape: KeyframedShape, is_seen: BoolArray) -> KeyframedShape:
    """Return a copy of a shape that is seen in some drawings only."""
    keys = zip(shape.keys, is_seen, strict=True)
    return shape._replace(
        keys=tuple(key if each else key._replace(style=key.style.faded(0.0)) for key, each in keys)
    )
