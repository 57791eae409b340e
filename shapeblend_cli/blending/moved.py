"""The motions of the matched shapes of two drawings; shapes that turn are matched again."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.blending.copies import CROWD
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.interpolate.paths import segments_at
from shapeblend_cli.model import Box
from shapeblend_cli.motion.alignment import Alignment, align_contours, shared_alignments
from shapeblend_cli.motion.choose import (
    AFFORDABLE_SEGMENTS,
    JUDGED,
    RotatedShape,
    Situation,
    best_motion,
    choose,
    in_motion,
    judged_straight,
    looks_right,
)
from shapeblend_cli.motion.rigid import Rigid
from shapeblend_cli.motion.rotation import MUCH, is_rotated_copy, rotation_between, turn_between

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.blending.matched import PairedDrawings
    from shapeblend_cli.model import ContourBlend, ShapeBlend

IN_PLACE = 0.03
"""Maximum distance that a contour moves that stays where it is, as a share of its larger side."""

SAME_SIZE = 0.8
"""Minimum ratio of the sides of a contour and its partner for it to be turned."""

MOST_CONTOURS = 32
"""Maximum number of contours of a shape of which parts are turned."""

TIMES = 0.25, 0.5, 0.75
"""Times at which it is looked up what a part that turns runs into."""

PLACES = np.arange(6) / 6.0
"""Places on each of its segments that are looked up."""

PARTS_TURN = "parts are turned, and little else"


def move_shapes(paired: PairedDrawings, shapes: Sequence[ShapeBlend], view: Box) -> tuple[ShapeBlend, ...]:
    """Choose how shapes move in a view, the largest first: their faults are seen most."""
    shared = _shared(paired, shapes)
    chosen: dict[int, ShapeBlend] = {}
    affordable = AFFORDABLE_SEGMENTS
    largest = max((shape.size for shape in shapes), default=0.0) or 1.0
    for k in sorted(range(len(shapes)), key=lambda k: -shapes[k].size):
        paired.progress.tell("moving", len(chosen) / len(shapes))
        shape = paired.curved(shapes[k])
        situation = Situation(
            asked=paired.settings.motion,
            rotation=paired.rotation,
            leads=paired.leads(shape),
            relative_size=shape.size / largest,
            is_affordable=affordable > 0 and len(shape.contours) <= CROWD,
        )
        choice = choose(shape, situation)
        turn = partial(_with_parts_turned, paired, shapes, k)
        rotate = partial(_rotated, paired, shapes[k], shape, shared[k])
        if choice.motion == JUDGED:
            affordable -= sum(len(contour.start.segments) for contour in shape.contours)
            chosen[k] = paired.judged(shape, view, shared[k], partial(_judged, shape, view, turn, rotate))
        elif choice.motion == "linear":
            chosen[k] = shape._replace(reason=choice.reason)
        else:
            chosen[k] = in_motion(rotate(), choice)
    return tuple(chosen[k] for k in range(len(shapes)))


def _judged(
    shape: ShapeBlend,
    view: Box,
    turn: Callable[[], ShapeBlend | None],
    rotate: Callable[[], RotatedShape],
) -> ShapeBlend:
    """Return a shape whose parts turn, or on straight paths if these look right, else as the judge prefers."""
    turned = turn()
    if turned is not None:
        return turned
    straight = judged_straight(shape, view)
    return straight if looks_right(straight) else best_motion(straight, rotate(), view)


def _with_parts_turned(
    paired: PairedDrawings, shapes: Sequence[ShapeBlend], number: int
) -> ShapeBlend | None:
    """Return one of the shapes with some parts turned far, which turn as they are; None if there are none.

    What stays in place is no part: an arrow that is cut out of a plate turns in it. Parts that would run into other
    shapes do not turn.
    """
    matched = shapes[number]
    contours = list(matched.contours)
    if len(contours) > MOST_CONTOURS:
        return None
    moving = [k for k, contour in enumerate(contours) if contour.is_matched and not _stays(contour)]
    angles = {k: _turn_of(paired, contours[k]) for k in moving if _may_turn(contours[k])}
    if not any(angles.values()):
        return None
    from shapeblend_cli.motion.parts import parts_of, turn_of

    middle = Box.union([contour.polygon_a.box for contour in contours]).centre
    alignments = [_at_rest(contour) for contour in contours]
    turned = set()
    for part in parts_of([contours[k] for k in moving]):
        numbers = [moving[k] for k in part]
        angle = angles.get(max(numbers, key=lambda k: contours[k].scale_a))
        if angle is None:
            continue
        own = paired.match_again(matched._replace(contours=tuple(contours[k] for k in numbers)), angle)
        turn = turn_of(own.contours, middle)
        if abs(turn.rotation) < MUCH:
            continue
        for k, contour in zip(numbers, own.contours, strict=True):
            contours[k], alignments[k] = contour, turn
        turned.update(numbers)
    if not turned:
        return None
    shape = paired.curved(matched._replace(contours=tuple(contours)))
    shape = shape._replace(motion=Rigid(tuple(alignments)), reason=PARTS_TURN)
    beside = [contour for k, contour in enumerate(matched.contours) if k not in turned]
    others = [contour for other in shapes if other is not matched for contour in other.contours]
    return shape if _keeps_clear(shape, turned, [*beside, *others]) else None


def _turn_of(paired: PairedDrawings, contour: ContourBlend) -> float | None:
    """Return by which large angle a contour is turned to become about its partner; None if it is not."""
    polygons = contour.polygon_a, contour.polygon_b
    return paired.progress.once("turn", polygons, (), partial(turn_between, *polygons))


def _stays(contour: ContourBlend) -> bool:
    """Return whether a contour hardly changes."""
    a, b = contour.dot_points()
    return bool(np.abs(a - b).max() < IN_PLACE * contour.polygon_a.box.larger_side)


def _at_rest(contour: ContourBlend) -> Alignment:
    """Return the similarity that leaves a contour on straight paths."""
    centre = contour.polygon_a.box.centre
    return Alignment(centre, centre, 1.0, 0.0)


def _may_turn(contour: ContourBlend) -> bool:
    """Return whether a contour has about the size of its partner, which may be turned."""
    if not (contour.start.closed and contour.end.closed):
        return False
    sides = [sorted((box.width, box.height)) for box in (contour.polygon_a.box, contour.polygon_b.box)]
    return all(min(pair) > SAME_SIZE * max(pair) for pair in zip(*sides, strict=True))


def _keeps_clear(shape: ShapeBlend, turned: set[int], others: Sequence[ContourBlend]) -> bool:
    """Return whether parts that turn stay within the outlines that they lie in, and off other ones."""
    sides = [
        {
            other.polygon(k)
            for other in others
            if other.numbers[k] is not None and (other.contour_a, other.contour_b)[k].closed
        }
        for k in (0, 1)
    ]
    for k in turned:
        places = [cubics.evaluate(segments_at(shape, t)[k][:, None], PLACES).ravel() for t in TIMES]
        between = np.concatenate(places)
        for here, polygons in enumerate(sides):
            own = shape.contours[k].path(here)
            for polygon in polygons:
                is_in = winding_numbers(own.segments[:1, 0], polygon.vertices)[0] != 0
                if ((winding_numbers(between, polygon.vertices) != 0) != is_in).any():
                    return False
    return True


def _shared(paired: PairedDrawings, shapes: Sequence[ShapeBlend]) -> Sequence[Alignment | None]:
    """Return for each shape the similarity that it has in common with others, if any."""
    if paired.rotation:
        whole = align_contours([contour for shape in shapes for contour in shape.contours])
        return [whole] * len(shapes)
    if paired.settings.motion == "linear" or len(shapes) < 2:
        return [None] * len(shapes)
    return shared_alignments(shapes)


def _rotated(
    paired: PairedDrawings, matched: ShapeBlend, shape: ShapeBlend, common: Alignment | None
) -> RotatedShape:
    """Return a shape, matched with B rotated back if its largest contour is A's rotated, for motions that turn.

    The first match does not show the rotation, since points that travel cost work; so the shape is matched again.
    """
    if paired.rotation:
        assert common is not None, "rotated drawings are aligned"
        return RotatedShape(shape, common)
    rotation = _rotation_of(paired, matched)
    if rotation is not None:
        matched, common = paired.match_again(matched, rotation), None
        shape = paired.curved(matched)
    alignment = common or align_contours(matched.contours)
    if rotation is not None and is_rotated_copy(matched.contours):
        return RotatedShape(shape, alignment)
    return RotatedShape(shape, alignment, _turn_parts(paired, matched, alignment))


def _turn_parts(
    paired: PairedDrawings, shape: ShapeBlend, alignment: Alignment
) -> tuple[ShapeBlend, tuple[Alignment, ...]] | None:
    """Match those parts of a shape again that are rotated copies; return it with the similarity of each contour.

    The other parts keep the given similarity. None if no part is a rotated copy.
    """
    contours = list(shape.contours)
    if len(contours) < 2:
        return None
    from shapeblend_cli.motion.parts import parts_of, turn_of

    alignments = [alignment] * len(contours)
    parts = parts_of(contours)
    middle = Box.union([contour.polygon_a.box for contour in contours]).centre
    turns = False
    for numbers in parts if len(parts) > 1 else ():
        part = shape._replace(contours=tuple(contours[k] for k in numbers))
        rotation = _rotation_of(paired, part)
        if rotation is None:
            continue
        part = paired.match_again(part, rotation)
        if is_rotated_copy(part.contours):
            turns = True
            turn = turn_of(part.contours, middle)
            for k, contour in zip(numbers, part.contours, strict=True):
                contours[k], alignments[k] = contour, turn
    return (paired.curved(shape._replace(contours=tuple(contours))), tuple(alignments)) if turns else None


def _rotation_of(paired: PairedDrawings, shape: ShapeBlend) -> float | None:
    """Return the angle of rotation from A's largest contour to B's; None if B's is no rotated copy."""
    matched = [contour for contour in shape.contours if contour.is_matched]
    if not matched:
        return None
    largest = max(matched, key=lambda contour: contour.scale_a)
    polygons = largest.polygon_a, largest.polygon_b
    return paired.progress.once("rotation", polygons, (), partial(rotation_between, *polygons))
