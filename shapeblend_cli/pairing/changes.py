"""Shapes that are the same in place but for a part that is cut away, or put on: a microphone, and it crossed out.

Where outlines share most of their length, and what they do not share cuts one of them into pieces, no contour of one
becomes a contour of the other. But stretches that they share cancel: what is left of B's outlines, and of A's traversed
in reverse, joins up to loops. Such a loop winds once round what B adds, and once the other way round what it takes
away. So one drawing's contours stay as they are, and the loops open in them, each from a line: all from one end to the
other if together they make a bar, else each from its middle.
"""

from __future__ import annotations

import cmath
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import LINE
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flat_contour import FlatContour
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.grouping import grouped, overlaps
from shapeblend_cli.geometry.polygons import reverse_contour
from shapeblend_cli.model import Box, Contour
from shapeblend_cli.motion.sweep import Sweep, Window
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
"""A box around both shapes is filled by each one's at least to this share, by their diagonals."""

LIKE_PAINT = 0.25
"""The channels of what both shapes are filled with differ by this at most, on average; 1 is black and white."""

BAR = 0.4
"""What a bar measures across, at most, as a share of what it does along itself."""

STEP = 1.5e-2
"""Outlines that run slantwise through a window are cut into pieces of about this share of the diagonal."""

CLEARLY = 1.2
"""What spreads along another axis than its outlines is opened along that if it is so many times narrower there."""

UPRIGHT = 0.1
"""What runs about as much across as up and down is opened up and down, unless it is a bar; that counts by this share of
its length."""

PARALLEL, ROUNDING = np.radians(10.0), 1e-6
"""Outlines along a bar are off its axis by this angle at most; and how exactly an axis is upright."""

CUTS = "it cuts what is the same"
"""Why a loop has no partner, for the report."""


class _Loop(NamedTuple):
    """What is left of the outlines, joined up: a closed contour, and how many pieces of each drawing it has."""

    contour: Contour
    pieces: tuple[int, int]


def _loops(shared: Shared) -> list[_Loop]:
    """Join up what the stretches leave, B's forwards and A's backwards."""
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
    """Join pieces to a closed contour; the ends of neighbours are about the same."""
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


def _windows(loops: Sequence[Contour]) -> list[Window]:
    """Return how loops open: all along one bar, from its left end, else those that overlap along themselves together.

    What overlaps may cancel, and so must open together.
    """
    window = _window(loops, from_middle=False)
    if window is not None:
        return [window] * len(loops)
    together = overlaps([cubics.bounds(loop.segments) for loop in loops])
    found: dict[int, Window | None] = {}
    for group in grouped(together):
        window = _window([loops[k] for k in group], from_middle=True)
        found.update(dict.fromkeys(group, window))
    return [window for k in range(len(loops)) if (window := found[k])]


def _window(loops: Sequence[Contour], *, from_middle: bool) -> Window | None:
    """Return how loops open together, from their middle, or from their left end if they make a bar.

    The axis is that in which most of their outlines run, if they are a bar along it, else that along which they spread.
    """
    points = np.concatenate([loop.segments.ravel() for loop in loops])
    edges = np.concatenate([np.diff(loop.segments, axis=1).ravel() for loop in loops])
    edges = edges[edges != 0.0]
    doubled = edges**2 / np.abs(edges)
    upright = UPRIGHT if from_middle else 0.0
    mostly = _half(doubled.sum() - upright * np.abs(edges).sum())
    parallel = np.abs(np.angle(doubled * (mostly.conjugate() ** 2))) <= 2.0 * PARALLEL
    found: list[tuple[float, Window]] = []
    for axis in (_half(doubled[parallel].sum()), _half(((points - points.mean()) ** 2).sum())):
        turned = points * axis.conjugate()
        low, high = float(turned.real.min()), float(turned.real.max())
        share = float(np.ptp(turned.imag)) / (high - low)
        found.append((share, Window(axis, 0.5 * (low + high) if from_middle else low, (low, high))))
    share, window = found[0] if found[0][0] <= max(BAR, CLEARLY * found[1][0]) else found[1]
    return window if from_middle or share <= BAR else None


def _half(doubled: complex) -> complex:
    """Return a direction to the right, or downwards, whose angle is half that of a number."""
    axis = cmath.rect(1.0, 0.5 * cmath.phase(doubled))
    return -axis if axis.imag < -1.0 + ROUNDING else axis


def _cut_along(loop: Contour, window: Window, step: float) -> Contour:
    """Cut segments that run slantwise through a window into pieces of about a step."""
    turned = loop.segments * window.axis.conjugate()
    slant = np.minimum(np.ptp(turned.real, axis=1), np.ptp(turned.imag, axis=1))
    counts = np.maximum(np.ceil(slant / step), 1).astype(np.intp)
    numbers = np.repeat(np.arange(len(counts)), counts)
    within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    segments = cubics.pieces(loop.segments[numbers], within / counts[numbers], (within + 1) / counts[numbers])
    return Contour(segments, loop.straight[numbers], closed=True)


class Change(NamedTuple):
    """Two shapes, one of which is the other with something added or taken away.

    Attributes
    ----------
    pair : (PlacedContour, PlacedContour)
        A contour of each of the shapes.
    contours : tuple of ContourBlend
        The contours of one shape, which stay, and the loops, which grow or shrink.
    motion : Sweep or None
        The motion of these contours; None for straight paths.
    """

    pair: ContourPair
    contours: tuple[ContourBlend, ...]
    motion: Sweep | None


def unchanged(contours: Sequence[PlacedContour], changed: Sequence[Change], side: int) -> list[PlacedContour]:
    """Return the contours of A, 0, or B, 1, that belong to none of the changed shapes."""
    shapes = {change.pair[side].shape for change in changed}
    return [contour for contour in contours if contour.shape not in shapes]


def changes(a: Sequence[PlacedContour], b: Sequence[PlacedContour], settings: Settings) -> list[Change]:
    """Return the shapes of two drawings that are the same in place but for something that cuts them.

    They must be filled, with nearly the same colour, and nothing else. Nothing is found if contours are to be matched,
    cut or moved otherwise.
    """
    free = not (settings.match or settings.pins or settings.start or settings.stiff)
    if not free or settings.unmatched == "split" or settings.motion not in ("auto", "linear"):
        return []
    shapes = [_filled_shapes(side) for side in (a, b)]
    if not all(shapes):
        return []
    diagonal = Box.union([contour.box for contour in (*a, *b)]).diagonal
    found: list[Change] = []
    taken: set[int] = set()
    for i, j in _near(*shapes):
        paint_a, paint_b = (channels(shapes[side][k][0].style.fill) for side, k in enumerate((i, j)))
        like = np.abs(np.subtract(paint_a, paint_b)).mean() <= LIKE_PAINT
        if like and i not in taken and ~j not in taken:
            change = _change(shapes[0][i], shapes[1][j], diagonal, settings.vertices)
            if change is not None:
                found.append(change if settings.motion == "auto" else change._replace(motion=None))
                taken |= {i, ~j}
    return found


def _near(
    a: Sequence[Sequence[PlacedContour]], b: Sequence[Sequence[PlacedContour]]
) -> list[tuple[int, int]]:
    """Return the indices of shapes of two drawings whose boxes are about the same."""
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
    a: Sequence[PlacedContour], b: Sequence[PlacedContour], diagonal: float, vertices: int
) -> Change | None:
    """Return the change between two shapes, if they share enough and a contour is cut into pieces."""
    sides = [c.flat for c in a], [c.flat for c in b]
    shared = mostly_shared(*sides, diagonal)
    if shared is None:
        return None
    totals = [sum(flat.total for flat in side) for side in sides]
    found = _loops(shared)
    if max((max(loop.pieces) for loop in found), default=0) < 2:
        return None
    # The simpler drawing stays.
    shrinks = totals[1] < totals[0]
    still, others = (b, a) if shrinks else (a, b)
    loops = [loop.contour for loop in found]
    if shrinks:
        loops = [reverse_contour(loop) for loop in loops]
    windows = _windows(loops)
    numbers = _numbers([*(c.polygon.vertices for c in still), *(c.segments[:, 0] for c in loops)], others)
    contours = [
        keep_still(contour, (number, contour.number) if shrinks else (contour.number, number))
        for contour, number in zip(still, numbers, strict=False)
    ]
    for loop, window, number in zip(loops, windows, numbers[len(still) :], strict=True):
        cut = _cut_along(loop, window, STEP * diagonal)
        flat = FlatContour(cut, flatten(cut, vertices))
        grown = grow_from(window.clip(cut.segments, 0.0), flat, number, of_b=not shrinks)
        contours.append(grown._replace(reason=CUTS))
    return Change((a[0], b[0]), tuple(contours), Sweep((*(None for _ in still), *windows)))


def _numbers(outlines: Sequence[ComplexArray], contours: Sequence[PlacedContour]) -> list[int]:
    """Return the number of a contour that is near each outline, on average, and none twice while others are left."""
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
