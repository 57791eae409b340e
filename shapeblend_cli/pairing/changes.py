"""Shapes that are the same in place except for parts that are added or removed: a microphone, and it crossed out.

Such shapes share most of their outlines, and the rest cuts a contour into pieces, so that contours cannot become each
other. Instead the contours of one drawing stay. Where both have a stretch of outline it cancels; the rest of B's
outlines, and the rest of A's in reverse, join up to loops. These wind round the parts that B adds, and the other way
round the parts that it removes. They open through windows: together along a bar, else each from its middle.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import LINE
from shapeblend_cli.geometry.flat_contour import FlatContour
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.polygons import reverse_contour
from shapeblend_cli.model import Box, Contour
from shapeblend_cli.motion.sweep import Sweep, windows_of
from shapeblend_cli.pairing.assignment import assign
from shapeblend_cli.pairing.costs import channels
from shapeblend_cli.wires.contour_blends import grow_from, keep_still
from shapeblend_cli.wires.stretches import mostly_shared

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair, PlacedContour
    from shapeblend_cli.model import BoolArray, ComplexArray, ContourBlend
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.wires.stretches import Shared

LEAST_BOX = 0.6
"""Minimum diagonal of each shape's box, as a share of the diagonal of the box around both."""

LIKE_PAINT = 0.25
"""Maximum difference of two fills: the mean over their channels, from 0 to 1."""

STEP = 1.5e-2
"""Length of the pieces into which outlines that slant through a window are cut, as a share of the diagonal."""

STAYS = "unchanged except where parts are added or removed"
"""Reason for the pairs of such shapes."""

ADDED = "a part that is added or removed"
"""Reason for the lack of a partner."""


class _Loop(NamedTuple):
    """Rests of outlines joined up to a closed contour."""

    contour: Contour
    pieces: tuple[int, int]  # numbers of rests of A and of B


def _loops(shared: Shared) -> list[_Loop]:
    """Join up the rests between shared stretches, B's forwards and A's backwards."""
    loops = [
        _Loop(_closed([outline.between(0.0, outline.total)], backwards=not side), (1 - side, side))
        for side, every in enumerate(shared.outlines)
        for k, outline in enumerate(every)
        if all(stretch.outlines[side] != k for stretch in shared.stretches)
    ]
    after, before = shared.following(1), {k: j for j, k in shared.following(0).items()}
    waiting = set(after)
    while waiting:
        first = k = min(waiting)
        pieces, counts = [], [0, 0]
        while True:
            waiting.discard(k)
            beyond = after[k]
            back = before[beyond]
            for side, ends in ((1, (k, beyond)), (0, (back, beyond))):
                piece = shared.between(side, *ends)
                if piece is not None:
                    counts[side] += 1
                    pieces.append(piece if side else (piece[0][::-1, ::-1], piece[1][::-1]))
            k = back
            if k == first:
                break
        if pieces:
            loops.append(_Loop(_closed(pieces), (counts[0], counts[1])))
    return loops


def _closed(pieces: Sequence[tuple[ComplexArray, BoolArray]], *, backwards: bool = False) -> Contour:
    """Join pieces, whose ends nearly meet, to a closed contour."""
    segments, straight = (np.concatenate(part) for part in zip(*pieces, strict=True))
    if backwards:
        segments, straight = segments[::-1, ::-1], straight[::-1]
    segments = segments.copy()
    segments[:, 0] = np.roll(segments[:, 3], 1)
    lines = segments[straight]
    chords = lines[:, 3] - lines[:, 0]
    lines[:, 1], lines[:, 2] = lines[:, 0] + chords / 3.0, lines[:, 0] + chords * (2.0 / 3.0)
    segments[straight] = lines
    return Contour(segments, straight, closed=True)


class Change(NamedTuple):
    """Two shapes that are the same except for parts that are added or removed."""

    pair: ContourPair  # a contour of each shape
    contours: tuple[ContourBlend, ...]  # those of one shape, which stay, and the loops, which grow or shrink
    motion: Sweep | None  # of these contours; None for straight paths


def unchanged(contours: Sequence[PlacedContour], changed: Sequence[Change], side: int) -> list[PlacedContour]:
    """Return the contours of A, 0, or B, 1, that belong to none of the changed shapes."""
    shapes = {change.pair[side].shape for change in changed}
    return [contour for contour in contours if contour.shape not in shapes]


def changes(a: Sequence[PlacedContour], b: Sequence[PlacedContour], settings: Settings) -> list[Change]:
    """Return the shapes of two drawings that are the same in place except for parts that are added or removed.

    These shapes are filled with nearly the same colour, and have no stroke. None are returned if users ask for other
    pairs, cuts or motions.
    """
    free = not (settings.match or settings.pins or settings.start or settings.stiff)
    if not free or settings.unmatched == "split" or settings.motion not in ("auto", "linear"):
        return []
    shapes = [_filled_shapes(side) for side in (a, b)]
    if not all(shapes):
        return []
    diagonal = Box.union([contour.box for contour in (*a, *b)]).diagonal
    found: list[Change] = []
    taken_a: set[int] = set()
    taken_b: set[int] = set()
    for i, j in _near(*shapes):
        p, q = shapes[0][i], shapes[1][j]
        colours = channels(p[0].style.fill), channels(q[0].style.fill)
        alike = np.abs(np.subtract(*colours)).mean() <= LIKE_PAINT
        change = None
        if alike and i not in taken_a and j not in taken_b:
            change = _change(p, q, diagonal, settings)
        if change is not None:
            found.append(change)
            taken_a.add(i)
            taken_b.add(j)
    return found


def _near(
    a: Sequence[Sequence[PlacedContour]], b: Sequence[Sequence[PlacedContour]]
) -> list[tuple[int, int]]:
    """Return the indices of shapes of two drawings that have about the same box."""
    bounds = [
        np.array([Box.union([contour.box for contour in shape]).bounds for shape in side]) for side in (a, b)
    ]
    sizes = [np.hypot(*(one[:, 2:] - one[:, :2]).T) for one in bounds]
    low = np.minimum(bounds[0][:, None, :2], bounds[1][:, :2])
    high = np.maximum(bounds[0][:, None, 2:], bounds[1][:, 2:])
    both = np.hypot(*np.moveaxis(high - low, 2, 0))
    near = np.argwhere(np.minimum(sizes[0][:, None], sizes[1]) >= LEAST_BOX * both)
    return [(int(i), int(j)) for i, j in near]


def _filled_shapes(contours: Sequence[PlacedContour]) -> list[list[PlacedContour]]:
    """Return the contours of each shape that is filled by the rule `nonzero` and has no stroke."""
    shapes: dict[int, list[PlacedContour]] = {}
    for contour in contours:
        shapes.setdefault(contour.shape, []).append(contour)
    return [
        shape
        for shape in shapes.values()
        if (style := shape[0].style).fill is not None
        and style.stroke is None
        and style.fill_rule == "nonzero"
        and all(contour.role != LINE for contour in shape)
    ]


def _change(
    a: Sequence[PlacedContour], b: Sequence[PlacedContour], diagonal: float, settings: Settings
) -> Change | None:
    """Return the change between two shapes, if they share enough and a contour is cut into pieces."""
    sides = [c.flat for c in a], [c.flat for c in b]
    shared = mostly_shared(*sides, diagonal)
    if shared is None:
        return None
    found = _loops(shared)
    if max((max(loop.pieces) for loop in found), default=0) < 2:
        return None
    # The simpler drawing stays.
    length_a, length_b = (sum(flat.total for flat in side) for side in sides)
    shrinks = length_b < length_a
    still, others = (b, a) if shrinks else (a, b)
    loops = [reverse_contour(loop.contour) if shrinks else loop.contour for loop in found]
    windows = windows_of(loops)
    numbers = _numbers([*(c.polygon.vertices for c in still), *(c.segments[:, 0] for c in loops)], others)
    contours = []
    for contour, number in zip(still, numbers, strict=False):
        both = (number, contour.number) if shrinks else (contour.number, number)
        contours.append(keep_still(contour, both)._replace(reason=STAYS))
    for loop, window, number in zip(loops, windows, numbers[len(still) :], strict=True):
        cut = window.cut(loop, STEP * diagonal)
        flat = FlatContour(cut, flatten(cut, settings.vertices))
        grown = grow_from(window.clip(cut.segments, 0.0), flat, number, of_b=not shrinks)
        contours.append(grown._replace(reason=ADDED))
    motion = Sweep((*(None for _ in still), *windows)) if settings.motion == "auto" else None
    return Change((a[0], b[0]), tuple(contours), motion)


def _numbers(outlines: Sequence[ComplexArray], contours: Sequence[PlacedContour]) -> list[int]:
    """Return for each outline the number of the nearest contour, on average; none twice while others are left."""
    away = np.array(
        [
            [np.abs(contour.polygon.vertices[:, None] - points).min(axis=0).mean() for contour in contours]
            for points in outlines
        ]
    )
    nearest = away.argmin(axis=1)
    for k, other in assign(away):
        nearest[k] = other
    return [contours[k].number for k in nearest.tolist()]
