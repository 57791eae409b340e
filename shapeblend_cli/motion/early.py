"""Motion of shapes of which parts without a partner leave early, or come late: they ride on what becomes another."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polygons import signed_area

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, Motion, ShapeBlend

EARLY = 0.5
"""Share of the time by which a part without a partner is gone before the end, or comes after the start."""

CHANGES = 0.1
"""Minimum mean distance that places of a shape move, beside its shift, for its parts to leave early, as a share of the
view."""


class Early(NamedTuple):
    """Another motion, or straight paths, in which contours without a partner are small for longer."""

    motion: Motion | None
    grows: frozenset[bool]  # whether contours grow that are: those of one drawing, of both or of none

    @property
    def name(self) -> str:
        """The name of the motion of the others."""
        return self.motion.name if self.motion else "linear"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        straight = [(1.0 - t) * contour.start.segments + t * contour.end.segments for contour in contours]
        moved = self.motion.segments(contours, t) if self.motion else straight
        return [
            own
            if contour.is_matched or contour.follows_edge or contour.grows not in self.grows
            else _smaller(own, t if contour.grows else 1.0 - t)
            for contour, own in zip(contours, moved, strict=True)
        ]


def _smaller(segments: ComplexArray, size: float) -> ComplexArray:
    """Return a contour that has a share of its size as it is if all of its growth is in the last part of the time."""
    middle = segments[:, 0].mean()
    share = max(0.0, (size - EARLY) / (1.0 - EARLY)) / max(size, 1e-9)
    return np.asarray(middle + share * (segments - middle))


def changes_much(shapes: Sequence[ShapeBlend], side: float) -> bool:
    """Return whether what has a partner becomes another shape, and is not filled, for example; in a view of a side."""
    pairs = [contour.dot_points() for shape in shapes for contour in shape.contours if contour.is_matched]
    ways = [b - a for a, b in pairs]
    return bool(ways) and float(np.mean([np.abs(way - way.mean()).mean() for way in ways])) > CHANGES * side


def with_early_parts(shapes: Sequence[ShapeBlend]) -> tuple[ShapeBlend, ...]:
    """Let parts without a partner leave before all others have become other shapes, and come after that.

    Not where most of a drawing is without a partner: that would be missed.
    """
    matched, alone = [0.0, 0.0], [0.0, 0.0]
    for contour in (contour for shape in shapes for contour in shape.contours):
        for end, polygon in enumerate((contour.polygon_a, contour.polygon_b)):
            area = signed_area(polygon.vertices)
            if contour.is_matched:
                matched[end] += area
            elif contour.grows == bool(end):
                alone[end] += area
    # What is beside lines has no matched area.
    grows = frozenset(bool(end) for end in (0, 1) if abs(alone[end]) < abs(matched[end]) or not matched[end])
    return tuple(
        shape
        if all(contour.is_matched or contour.follows_edge for contour in shape.contours)
        else shape._replace(motion=Early(shape.motion, grows))
        for shape in shapes
    )
