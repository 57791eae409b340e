"""The grade and the faults of a blend, by pictures of it."""

from __future__ import annotations

from functools import lru_cache
from operator import is_
from typing import TYPE_CHECKING

from shapeblend_cli.blending.swaps.swapped import is_filled, is_swapped
from shapeblend_cli.model import Box, Pair

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.grading.grade import Grade
    from shapeblend_cli.grading.seen import Seen
    from shapeblend_cli.model import PictureArray, ShapeBlend, Shapes

STEPS = 6
"""Number of steps between the pictures that are graded."""

FINE = 0.5
"""Maximum sum of the faults of a blend for no other to be tried."""

BETTER = 0.2
"""Minimum advantage of another blend over the ordinary one for it to be taken, in faults."""

SWAP_GRADE = 1.0
"""Grade of drawings that take each other's place: whole and clean, though nothing becomes anything."""

FILLED_GRADE = 0.75
"""Grade of a drawing and the same one filled, between which a level moves: the mean of 120 grades by two designers."""

SUSPECT = 0.2
"""Minimum fault of a shape's outlines for a blend to be graded that nobody asked about."""


def grade_of(pair: Pair) -> Grade:
    """Return how good a blend of two drawings looks on its way, as `shapeblend judge` grades its frames.

    Drawings that take each other's place, or that a level fills, have a grade of their own: the judge finds nothing of
    what it looks for in frames of the former, and does not see the clips of the latter.
    """
    from shapeblend_cli.grading.grade import Grade, grade  # most blends are not graded

    if is_swapped(pair.shapes):
        return Grade(SWAP_GRADE, None)
    return Grade(FILLED_GRADE, None) if is_filled(pair.shapes) else grade(_strip(pair))


def grade_of_shapes(shapes: Sequence[ShapeBlend], view: Box) -> float:
    """Return the grade of some shapes alone in a view, by which it is decided whether they are good enough."""
    from shapeblend_cli.grading.grade import grade_of_seen  # most blends are not graded

    return SWAP_GRADE if is_swapped(shapes) else grade_of_seen(seen_of(shapes, view)).number


def faults_of(shapes: Sequence[ShapeBlend], view: Box) -> float:
    """Return the sum of the faults of some shapes alone in a view, by which blends of them compare."""
    return SWAP_GRADE if is_swapped(shapes) else _faults(_Same(tuple(shapes)), view)


class _Same:
    """Shapes that are equal to the very same ones only, in whatever tuple they are."""

    def __init__(self, shapes: tuple[ShapeBlend, ...]) -> None:
        self.shapes = shapes

    def __hash__(self) -> int:
        return hash(tuple(map(id, self.shapes)))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _Same) or len(self.shapes) != len(other.shapes):
            return False
        return all(map(is_, self.shapes, other.shapes))


def seen_of(shapes: Sequence[ShapeBlend], view: Box) -> Seen:
    """Return what is seen of some shapes alone in a view."""
    return _seen(_Same(tuple(shapes)), view)


def in_full_width(shapes: Sequence[ShapeBlend]) -> Shapes:
    """Return shapes whose lines neither thicken as they come nor thin as they go: the judge takes these for spikes.

    They are the very same ones when asked for again, so that they are not graded again.
    """
    return _in_full_width(_Same(tuple(shapes)))


@lru_cache(maxsize=4)
def _in_full_width(same: _Same) -> Shapes:
    found = []
    for shape in same.shapes:
        if bool(shape.style_a.stroke_width) != bool(shape.style_b.stroke_width):
            whole = shape.style_a if shape.style_a.stroke_width else shape.style_b
            shape = shape._replace(style_a=whole, style_b=whole)
        found.append(shape)
    return tuple(found)


@lru_cache(maxsize=16)
def _faults(same: _Same, view: Box) -> float:
    from shapeblend_cli.grading.grade import sum_of_faults  # most blends are not graded

    return sum_of_faults(_seen(same, view))


@lru_cache(maxsize=2)
def _seen(same: _Same, view: Box) -> Seen:
    """Return what is seen of shapes: of the usual blend it is asked wherever another one is tried."""
    from shapeblend_cli.grading.grade import seen_in  # most blends are not graded

    return seen_in(_strip(Pair(0, 1, same.shapes, ((), ()), (view, view))))


def _strip(pair: Pair) -> list[PictureArray]:
    """Return pictures of a pair at even times."""
    from shapeblend_cli.frames.frames import shapes_at
    from shapeblend_cli.frames.outlined import with_outlined_text
    from shapeblend_cli.grading.painting import picture

    view, pair = Box.union(list(pair.views)), with_outlined_text(pair)
    return [picture(shapes_at(pair, k / STEPS), view) for k in range(STEPS + 1)]


def is_suspect(shapes: Sequence[ShapeBlend]) -> bool:
    """Return whether the judge of outlines, which has looked at them already, found a fault in a shape."""
    return any(shape.taken is not None and shape.taken.wrong >= SUSPECT for shape in shapes)
