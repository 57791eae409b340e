"""Shapes that are the same in place except for parts that are added or removed: a microphone, and it crossed out.

Such shapes share most of their outlines, and the rest cuts a contour into pieces, so that contours cannot become each
other. Instead the contours of one drawing stay. Where both have a stretch of outline it cancels; the rest of B's
outlines, and the rest of A's in reverse, join up to loops. These wind round the parts that B adds, and the other way
round the parts that it removes. They open through windows: together along a bar, else each from its middle. A sign,
as a plus in a bag, grows from its middle.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import LINE
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flat_contour import FlatContour
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.grouping import assign
from shapeblend_cli.geometry.polygons import centroid, reverse_contour
from shapeblend_cli.geometry.polyline import distances_to
from shapeblend_cli.model import Box, Contour
from shapeblend_cli.pairing.costs import channels
from shapeblend_cli.wires.contour_blends import grow_from, keep_still
from shapeblend_cli.wires.stretches import TOLERANCE, mostly_shared, shared_stretches

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair, PlacedContour, PlacedDrawing
    from shapeblend_cli.model import BoolArray, ComplexArray, ContourBlend, Style
    from shapeblend_cli.motion.sweep import Sweep, Window
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.wires.stretches import Shared

LEAST_BOX = 0.6
"""Minimum diagonal of each shape's box, as a share of the diagonal of the box around both."""

LIKE_PAINT = 0.25
"""Maximum difference of two fills: the mean over their channels, from 0 to 1."""

LEAST_SHARED = 0.25
"""Minimum share of an outline that is one of the other drawing's, too, if that is no chance."""

STEP = 1.5e-2
"""Length of the pieces into which outlines that slant through a window are cut, as a share of the diagonal."""

SPECK = 1e-4
"""Maximum area of a loop that is none, as a share of the square of the diagonal: outlines are rounded differently."""

STAYS = "unchanged except where parts are added or removed"
"""Reason for the pairs of such shapes."""

ADDED = "a part that is added or removed"
"""Reason for the lack of a partner."""


class _Loop(NamedTuple):
    """Rests of outlines joined up to a closed contour."""

    contour: Contour
    rests: tuple[Sequence[ComplexArray], Sequence[ComplexArray]]  # of A and of B, (k, 4) each
    is_whole: bool = False  # whether it is all of an outline

    def joints(self, side: int) -> ComplexArray:
        """Return the segments, (k, 4), on the outlines of A, 0, or of B, 1."""
        return np.concatenate([np.empty((0, 4), np.complex128), *self.rests[side]])


def _loops(shared: Shared) -> list[_Loop]:
    """Join up the rests between shared stretches, B's forwards and A's backwards."""
    loops = [
        _Loop(_closed([outline.between(0.0, outline.total)], backwards=not side), ((), ()), True)
        for side, every in enumerate(shared.outlines)
        for k, outline in enumerate(every)
        if all(stretch.outlines[side] != k for stretch in shared.stretches)
    ]
    after, before = shared.following(1), {k: j for j, k in shared.following(0).items()}
    waiting = set(after)
    while waiting:
        first = k = min(waiting)
        pieces: list[tuple[ComplexArray, BoolArray]] = []
        rests: tuple[list[ComplexArray], list[ComplexArray]] = ([], [])
        while True:
            waiting.discard(k)
            beyond = after[k]
            back = before[beyond]
            for side, ends in ((1, (k, beyond)), (0, (back, beyond))):
                piece = shared.between(side, *ends)
                if piece is not None:
                    rests[side].append(piece[0])
                    pieces.append(piece if side else (piece[0][::-1, ::-1], piece[1][::-1]))
            k = back
            if k == first:
                break
        if pieces:
            loops.append(_Loop(_closed(pieces), rests))
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


def _loops_of(shared: Shared) -> tuple[Shared, list[_Loop]]:
    """Return loops that make B of A: whole outlines if those between shared stretches do not."""
    from shapeblend_cli.anatomy.slash import paint_the_same

    loops = _loops(shared)
    a, b = ([flat.contour for flat in side] for side in shared.outlines)
    if not paint_the_same([*a, *(loop.contour for loop in loops)], b):
        shared = shared._replace(stretches=())
        loops = _loops(shared)
    return shared, loops


class Change(NamedTuple):
    """Shapes of one paint that are the same in both drawings, except for parts that are added or removed."""

    sides: tuple[Sequence[PlacedContour], Sequence[PlacedContour]]  # their contours
    contours: tuple[
        ContourBlend, ...
    ]  # those of one drawing, which stay, and the loops, which grow or shrink
    motion: Sweep | None  # of these contours; None for straight paths

    @property
    def pair(self) -> ContourPair:
        """A contour of each drawing."""
        return self.sides[0][0], self.sides[1][0]


def unchanged(contours: Sequence[PlacedContour], changed: Sequence[Change], side: int) -> list[PlacedContour]:
    """Return the contours of A, 0, or B, 1, that belong to none of the changed shapes."""
    shapes = {contour.shape for change in changed for contour in change.sides[side]}
    return [contour for contour in contours if contour.shape not in shapes]


def changes(a: Sequence[PlacedContour], b: Sequence[PlacedContour], settings: Settings) -> list[Change]:
    """Return the shapes of two drawings that are the same in place except for parts that are added or removed.

    These shapes are filled with nearly the same colour, and have no stroke. None are returned if users ask for other
    pairs, cuts or motions.
    """
    if not _is_free(settings):
        return []
    shapes = [_filled_shapes(side) for side in (a, b)]
    if not all(shapes):
        return []
    diagonal = Box.union([contour.box for contour in (*a, *b)]).diagonal
    found: list[Change] = []
    taken_a: set[int] = set()
    taken_b: set[int] = set()
    kinds = [
        [(shape[0].style.fill, *(c.polygon.vertices.tobytes() for c in shape)) for shape in side]
        for side in shapes
    ]
    unlike: set[object] = set()  # kinds of two shapes without a change: copies of them have none, either
    for i, j in _near(*shapes):
        key = kinds[0][i], kinds[1][j]
        if i in taken_a or j in taken_b or key in unlike:
            continue
        p, q = shapes[0][i], shapes[1][j]
        change = _change(p, q, diagonal, settings) if are_painted_alike(p[0].style, q[0].style) else None
        if change is None:
            unlike.add(key)
        else:
            found.append(change)
            taken_a.add(i)
            taken_b.add(j)
    return found


def _is_free(settings: Settings) -> bool:
    free = not (settings.match or settings.pins or settings.start or settings.stiff)
    return free and settings.unmatched != "split" and settings.motion in ("auto", "linear")


def are_painted_alike(a: Style, b: Style) -> bool:
    """Return whether two fills have nearly the same colour."""
    return bool(np.abs(np.subtract(channels(a.fill), channels(b.fill))).mean() <= LIKE_PAINT)


def crossed_out(a: PlacedDrawing, b: PlacedDrawing, settings: Settings) -> list[Change]:
    """Return the changes of two drawings of which one is the other crossed out, one for each paint; else none."""
    if not _is_free(settings):
        return []
    paints = [_paints(side) for side in (a, b)]
    if not paints[0] or len(paints[0]) != len(paints[1]):
        return []
    if not all(are_painted_alike(p[0].style, q[0].style) for p, q in zip(*paints, strict=True)):
        return []
    from shapeblend_cli.anatomy.slash import slash_axis
    from shapeblend_cli.motion.sweep import window_along

    outlines = [[c.contour for c in side[-1]] for side in paints]  # the uppermost: it has the slash
    axis = slash_axis(*outlines)
    shrinks = axis is None
    axis = axis or slash_axis(*outlines[::-1])
    if axis is None:
        return []
    diagonal = Box.union([contour.box for contour in (*a.contours, *b.contours)]).diagonal
    sides = [*zip(*paints, strict=True)]
    shared = [shared_stretches([c.flat for c in p], [c.flat for c in q], diagonal) for p, q in sides]
    every = [_loops_of(each) for each in shared]
    window = window_along(axis, [loop.contour for _, loops in every for loop in loops])
    return [
        _opening(each, pair, loops, [window] * len(loops), settings, shrinks=shrinks)
        for (each, loops), pair in zip(every, sides, strict=True)
    ]


def _paints(drawing: PlacedDrawing) -> list[list[PlacedContour]]:
    """Return the contours of each paint of a drawing of plain fills, the lowest first; none of any other drawing."""
    groups: dict[tuple[str | None, float], list[PlacedContour]] = {}
    last = None
    for contour in drawing.contours:
        style = contour.style
        key = style.fill, style.fill_opacity
        is_plain = style.fill is not None and style.stroke is None and style.fill_gradient is None
        is_plain &= style.fill_rule == "nonzero" or contour.any_rule
        is_plain &= contour.contour.closed and not drawing.drawing.shapes[contour.shape].clips
        if not is_plain or (key != last and key in groups):
            return []
        groups.setdefault(key, []).append(contour)
        last = key
    return list(groups.values())


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
    shared = _without_signs(shared)
    loops = _loops(shared)
    if max((len(rests) for loop in loops for rests in loop.rests), default=0) < 2:
        return None
    # The simpler drawing stays.
    length_a, length_b = (sum(flat.total for flat in side) for side in sides)
    shrinks = length_b < length_a
    windows = _windows(loops, SPECK * diagonal**2, shrinks=shrinks)
    return _opening(shared, (a, b), loops, windows, settings, shrinks=shrinks)


def _without_signs(shared: Shared) -> Shared:
    """Leave out what outlines share by chance: the edge of a plus may continue that of a bag that is behind it."""
    stretches = list(shared.stretches)
    for side, outlines in enumerate(shared.outlines):
        for number, outline in enumerate(outlines):
            own = [one for one in stretches if one.outlines[side] == number]
            if sum(one.end[side] - one.start[side] for one in own) < LEAST_SHARED * outline.total:
                stretches = [one for one in stretches if one not in own]
    return shared._replace(stretches=stretches)


def _windows(loops: Sequence[_Loop], speck: float, *, shrinks: bool) -> list[Window | None]:
    """Return the windows of loops; None for a sign, as a plus in a bag or in a bite of it, and for a speck."""
    from shapeblend_cli.motion.sweep import windows_of

    contours = [_turned(loop, shrinks=shrinks) for loop in loops]
    large = [k for k, contour in enumerate(contours) if abs(cubics.signed_area(contour.segments)) > speck]
    joints = [loops[k].joints(int(shrinks)) for k in large]
    opening = windows_of([contours[k] for k in large], joints) if large else []
    found: list[Window | None] = [None] * len(loops)
    for k, window in zip(large, opening, strict=True):
        is_bar = window.start == window.ends[0]
        if is_bar or not loops[k].is_whole:
            found[k] = window
    return found


def _turned(loop: _Loop, *, shrinks: bool) -> Contour:
    return reverse_contour(loop.contour) if shrinks else loop.contour


def _opening(
    shared: Shared,
    sides: tuple[Sequence[PlacedContour], Sequence[PlacedContour]],
    found: Sequence[_Loop],
    windows: Sequence[Window | None],
    settings: Settings,
    *,
    shrinks: bool,
) -> Change:
    """Return the change in which loops open through windows, or grow from their middles where there is None.

    They close, or shrink, where the contours of B stay.
    """
    from shapeblend_cli.motion.sweep import Sweep

    still, others = sides[::-1] if shrinks else sides
    step = STEP / TOLERANCE * shared.distance
    bars = list({window: None for window in windows if window is not None})
    loops = [_turned(loop, shrinks=shrinks) for loop in found]
    numbers = _numbers([*(c.polygon.vertices for c in still), *(c.segments[:, 0] for c in loops)], others)
    contours = []
    for k, (contour, number) in enumerate(zip(still, numbers, strict=False)):
        both = (number, contour.number) if shrinks else (contour.number, number)
        if len(bars) == 1:
            cut = _cut_alike(shared, int(shrinks), k, bars[0], step)
            contour = contour._replace(contour=cut, polygon=flatten(cut, settings.vertices))
        contours.append(keep_still(contour, both)._replace(reason=STAYS))
    for loop, window, number in zip(loops, windows, numbers[len(still) :], strict=True):
        cut = loop if window is None else window.cut(loop, step)
        flat = FlatContour(cut, flatten(cut, settings.vertices))
        if window is None:
            nothing = np.full_like(cut.segments, centroid(flat.polygon.vertices))
        else:
            nothing = window.clip(cut.segments, 0.0)
        grown = grow_from(nothing, flat, number, of_b=not shrinks)
        contours.append(grown._replace(reason=ADDED))
    motion = Sweep((*(None for _ in still), *windows)) if settings.motion == "auto" else None
    return Change(sides, tuple(contours), motion)


def _cut_alike(shared: Shared, side: int, number: int, window: Window, step: float) -> Contour:
    """Return an outline that stays, cut where loops go back along it: what they cancel leaves no trace."""
    outline = shared.outlines[side][number]
    on_it = [each for each in shared.stretches if each.outlines[side] == number]
    if not on_it:
        return window.cut(outline.contour, step)
    pieces = []
    on_it.sort(key=lambda each: each.start[side] % outline.total)
    for one, other in zip(on_it, [*on_it[1:], on_it[0]], strict=True):
        start, end = one.start[side] % outline.total, one.end[side] - one.start[side]
        pieces.append(outline.between(start, start + end))
        rest = (other.start[side] - one.end[side]) % outline.total
        if rest <= outline.total - shared.distance:
            segments, straight = outline.between(
                (start + end) % outline.total, (start + end) % outline.total + rest
            )
            cut = window.cut(Contour(segments, straight, closed=False), step)
            pieces.append((cut.segments, cut.straight))
    return _closed(pieces)


def _numbers(outlines: Sequence[ComplexArray], contours: Sequence[PlacedContour]) -> list[int]:
    """Return for each outline the number of the nearest contour, on average; none twice while others are left."""
    away = np.array(
        [
            [distances_to(contour.polygon.vertices, points).mean() for contour in contours]
            for points in outlines
        ]
    )
    nearest = away.argmin(axis=1)
    for k, other in assign(away):
        nearest[k] = other
    return [contours[k].number for k in nearest.tolist()]
