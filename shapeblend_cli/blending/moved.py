"""The motions of the matched shapes of two drawings; shapes that turn are matched again."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from shapeblend_cli.blending.copies import CROWD
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
from shapeblend_cli.motion.parts import parts_of, turn_of
from shapeblend_cli.motion.rotation import is_rotated_copy, rotation_between

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.blending.matched import PairedDrawings
    from shapeblend_cli.model import ShapeBlend


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
        rotate = partial(_rotated, paired, shapes[k], shape, shared[k])
        if choice.motion == JUDGED:
            affordable -= sum(len(contour.start.segments) for contour in shape.contours)
            chosen[k] = paired.judged(shape, view, shared[k], partial(_judged, shape, view, rotate))
        elif choice.motion == "linear":
            chosen[k] = shape._replace(reason=choice.reason)
        else:
            chosen[k] = in_motion(rotate(), choice)
    return tuple(chosen[k] for k in range(len(shapes)))


def _judged(shape: ShapeBlend, view: Box, rotate: Callable[[], RotatedShape]) -> ShapeBlend:
    """Return a shape on straight paths if these look right, else in the motion that the judge prefers."""
    straight = judged_straight(shape, view)
    return straight if looks_right(straight) else best_motion(straight, rotate(), view)


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
    alignments = [alignment] * len(contours)
    parts = parts_of(contours) if len(contours) > 1 else []
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
