"""What turns stays in the picture: it moves aside half way, and gets smaller where that is not enough."""

from __future__ import annotations

import math
from collections import defaultdict
from typing import TYPE_CHECKING, NamedTuple, cast

from shapeblend_cli.geometry import cubics
from shapeblend_cli.model import Box
from shapeblend_cli.motion.rigid import Rigid, Whole

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterator, Sequence

    from shapeblend_cli.model import Motion, ShapeBlend, Shapes
    from shapeblend_cli.motion import pen
    from shapeblend_cli.motion.alignment import Alignment

    Turning = Alignment | Whole | pen.TurnedLine

TIMES = tuple(k / 8 for k in range(1, 8))
"""Times at which it is looked up whether what turns is in the picture."""

HALVES = tuple(math.sin(math.pi * t) for t in TIMES)
"""Shares of the most by which something is smaller, and aside, at these times."""

UNSEEN = 0.01
"""Maximum overhang that is not seen, as a share of the larger side of the view."""

LEAST_TURN = math.radians(20.0)
"""Minimum turn of what may leave the picture, in radians."""

MOST_DIP = 0.3
"""Maximum share by which something gets smaller: in a narrow view more would be needed, and it has to grow."""


class _Turn(NamedTuple):
    """Contours of a shape that turn in one way."""

    shape: int
    contours: tuple[int, ...]
    way: Turning


def kept_in_view(shapes: Shapes, view: Box) -> Shapes:
    """Return shapes of which those that turn stay in a view, as far as both drawings do."""
    groups: dict[Hashable, list[_Turn]] = defaultdict(list)
    for k, shape in enumerate(shapes):
        for key, turn in _turns(k, shape.motion, len(shape.contours)):
            groups[key].append(turn)
    found = list(shapes)
    count = sum(len(shape.contours) for shape in shapes)
    for turns in groups.values():
        is_whole = sum(len(turn.contours) for turn in turns) == count
        if is_whole and shapes[0].motion_name != "pen":
            continue  # a solid drawing that turns as a whole keeps its size, and the view grows
        start, *between, end = (_box(shapes, turns, t) for t in (0.0, *TIMES, 1.0))
        room = Box.union([view, start, end])
        seen = room.expanded(UNSEEN * room.larger_side)
        if all(seen.contains(box) for box in between):
            continue
        centres = [turns[0].way.middle(t) for t in TIMES]
        reach = max(_reach(shapes[turn.shape]) for turn in turns)
        inner = [box.expanded(-reach) for box in between]
        dip, aside = _dip_and_aside(inner, centres, room.expanded(-reach), is_all=len(groups) == 1)
        if dip > MOST_DIP:
            continue
        dip = 0.0 if dip < UNSEEN else dip
        for turn in turns:
            motion = _with_way(found[turn.shape].motion, turn.way, turn.way._replace(dip=dip, aside=aside))
            found[turn.shape] = found[turn.shape]._replace(motion=motion)
    return tuple(found)


def _turns(number: int, motion: Motion | None, count: int) -> Iterator[tuple[Hashable, _Turn]]:
    """Yield what turns in a shape of so many contours, with what it shares with others that turn with it."""
    if isinstance(motion, Whole) and motion.angle:
        yield motion, _Turn(number, tuple(range(count)), motion)
    elif isinstance(motion, Rigid):
        for way in dict.fromkeys(motion.alignments):
            if abs(way.rotation) > LEAST_TURN:
                members = tuple(k for k, own in enumerate(motion.alignments) if own == way)
                yield way, _Turn(number, members, way)
    elif motion is not None and motion.name == "pen":
        from shapeblend_cli.motion import pen  # most drawings have no lines

        whole = motion.pieces[0] if isinstance(motion, pen.Pen) else None
        if isinstance(whole, pen.TurnedLine) and whole.angle:
            yield (whole.centre, whole.target, whole.angle), _Turn(number, (0,), whole)


def _with_way(motion: Motion | None, old: Turning, new: Turning) -> Motion:
    """Return a motion that turns in another way."""
    if isinstance(motion, Rigid):
        ways = (new if own == old else own for own in motion.alignments)
        return Rigid(tuple(cast("Iterator[Alignment]", ways)))
    if isinstance(motion, Whole):
        return cast("Whole", new)
    return cast("pen.Pen", motion)._replace(pieces=(cast("pen.TurnedLine", new),))


def _reach(shape: ShapeBlend) -> float:
    return max(shape.style_a.reach, shape.style_b.reach)


def _box(shapes: Shapes, turns: Sequence[_Turn], t: float) -> Box:
    """Return the box around parts that turn together at a time, with their strokes."""
    boxes = []
    for turn in turns:
        shape = shapes[turn.shape]
        if shape.motion is not None:
            paths = shape.motion.segments(shape.contours, t)
            boxes += [cubics.bounds(paths[k]).expanded(_reach(shape)) for k in turn.contours]
    return Box.union(boxes)


def _dip_and_aside(
    boxes: Sequence[Box], centres: Sequence[complex], room: Box, *, is_all: bool
) -> tuple[float, complex]:
    """Return by which share a part is smaller half way, and how far aside, to be in a room at all times.

    What is not all there is gets smaller for one half, and goes aside for the other half: it would run into the rest.
    What would have to go to both sides, one after the other, gets smaller only.
    """
    dip = _dip_to_fit(boxes, room) if is_all else 0.5 * _dip_in_place(boxes, centres, room, (0, 1))
    needs = _needs(boxes, centres, room, dip)
    torn = [k for k in (0, 1) if min(needs[k]) < 0.0 < max(needs[k])]
    if torn:
        dip = max(dip, _dip_in_place(boxes, centres, room, torn))
        needs = _needs(boxes, centres, room, dip)
    return dip, complex(*(0.0 if k in torn else max(needs[k], key=abs) for k in (0, 1)))


def _dip_to_fit(boxes: Sequence[Box], room: Box) -> float:
    """Return by which share a part is smaller half way to have the size of a room at most."""
    shares = [
        min(room.width / max(box.width, 1e-9), room.height / max(box.height, 1e-9), 1.0) for box in boxes
    ]
    return max((1.0 - share) / half for share, half in zip(shares, HALVES, strict=True))


def _dip_in_place(boxes: Sequence[Box], centres: Sequence[complex], room: Box, axes: Sequence[int]) -> float:
    """Return by which share a part is smaller half way to be in a room where it is, along some axes."""
    dip = 0.0
    for box, centre, half in zip(boxes, centres, HALVES, strict=True):
        for k in (n + axis for axis in axes for n in (0, 2)):
            away = box.bounds[k] - _parts(centre)[k % 2]
            if abs(away) > 1e-9:
                dip = max(dip, (1.0 - (room.bounds[k] - _parts(centre)[k % 2]) / away) / half)
    return dip


def _needs(
    boxes: Sequence[Box], centres: Sequence[complex], room: Box, dip: float
) -> tuple[list[float], list[float]]:
    """Return how far aside a part would have to go half way to be in a room at each time, along both axes."""
    needs: tuple[list[float], list[float]] = ([], [])
    for box, centre, half in zip(boxes, centres, HALVES, strict=True):
        for k, about in enumerate(_parts(centre)):
            low, high = ((box.bounds[k + n] - about) * (1.0 - dip * half) + about for n in (0, 2))
            need = max(room.bounds[k] - low, 0.0) - max(high - room.bounds[k + 2], 0.0)
            needs[k].append(need / half if abs(need) > 1e-9 else 0.0)
    return needs


def _parts(point: complex) -> tuple[float, float]:
    return point.real, point.imag
