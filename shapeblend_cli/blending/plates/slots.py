"""Slots that a plate loses before it parts, or gets after its parts have met, as a list that becomes a grid.

Where the cut crosses a slot, each part would have a notch of it, which would be seen as a scrap until the end.
"""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.anatomy.decompose import HOLE, SLENDER
from shapeblend_cli.blending.plates.plain import is_blend_of
from shapeblend_cli.wires.contour_blends import grow_from_point

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing
    from shapeblend_cli.model import Box, ComplexArray, ContourBlend, Motion, ShapeBlend, Shapes

CLOSING = 0.4
"""Time in which the slots close, as a share of all time."""

CLOSED = "the slots close before the plate parts"


class Parting(NamedTuple):
    """The motion of the parts of a plate, and of slots that are whole while these rest."""

    motion: Motion | None  # of the parts; None for straight paths
    parts: int  # number of the contours that are parts, which come first
    is_joining: bool  # whether the parts meet, and the holes open then

    @property
    def name(self) -> str:
        """The name of the motion of the parts."""
        return self.motion.name if self.motion else "linear"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        parts, slots = contours[: self.parts], contours[self.parts :]
        if self.is_joining:
            own, along = min(1.0, t / (1.0 - CLOSING)), max(0.0, (t - 1.0 + CLOSING) / CLOSING)
        else:
            own, along = max(0.0, (t - CLOSING) / (1.0 - CLOSING)), min(1.0, t / CLOSING)
        if self.motion is None:
            found = [part.straight(own) for part in parts]
        else:
            found = self.motion.segments(parts, own)
        return found + [slot.straight(along) for slot in slots]


def with_slots_closed(a: PlacedDrawing, b: PlacedDrawing, view: Box, usual: Shapes) -> Shapes:
    """Return the blend in which a plate parts after its slots have closed, unless no cut crosses any.

    The drawings are plain, see `is_plain`.
    """
    found = []
    for shape in usual:
        parted = next((own for here in (0, 1) if (own := _parted(shape, (a, b)[here], here))), None)
        found.append(parted or shape)
    is_new = any(one is not other for one, other in zip(found, usual, strict=True))
    return tuple(found) if is_new and is_blend_of(tuple(found), a, b, view) else usual


def _parted(shape: ShapeBlend, drawing: PlacedDrawing, here: int) -> ShapeBlend | None:
    """Return a shape with the holes of a drawing whole; None if no slot is cut there, or there is more to it."""
    parts = [contour for contour in shape.contours if contour.is_matched]
    alone = [contour for contour in shape.contours if not contour.is_matched]
    numbers = Counter(contour.numbers[here] for contour in alone)
    if None in numbers or max(numbers.values(), default=0) < 2 or shape.pace:
        return None
    holes = [contour for contour in drawing.contours if contour.number in numbers]
    plates = {hole.exterior for hole in holes}
    if not all(map(_is_slot, holes)) or plates != {part.numbers[here] for part in parts}:
        return None
    whole = [grow_from_point(hole, hole.centre, of_b=bool(here)) for hole in holes]
    return shape._replace(
        contours=(*parts, *(each._replace(reason=CLOSED) for each in whole)),
        motion=Parting(shape.motion, len(parts), bool(here)),
    )


def _is_slot(contour: PlacedContour) -> bool:
    """Return whether a contour is a long hole."""
    return contour.role == HOLE and contour.area <= SLENDER * contour.size**2
