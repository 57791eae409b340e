"""Vertex paths: where outlines are at a time, on straight paths, eq (2), or as a motion has it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.interpolate.curves import common_segments
from shapeblend_cli.model import Box, CubicPath, Waypoint

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, ContourBlend, ShapeBlend

WAY_TOLERANCE = 2e-3
"""How far an animation may be from a motion that is not straight, as a share of the size of what moves."""

MOST_HALVINGS = 6
"""From a drawing to the next an animation takes at most two to this power steps."""


def with_curves(contour: ContourBlend) -> ContourBlend:
    """Return a blend that moves between the drawings' own curves, cut alike, see `curves`."""
    common = common_segments(
        contour.contour_a,
        contour.polygon_a,
        contour.contour_b,
        contour.polygon_b,
        contour.correspondence.dots,
    )
    closed = contour.correspondence.closed
    return contour._replace(
        start=CubicPath(common.segments_a, common.straight, closed),
        end=CubicPath(common.segments_b, common.straight, closed),
        cuts=(common.places_a, common.places_b),
    )


def between(shape: ShapeBlend, t: float) -> tuple[CubicPath, ...]:
    """The outlines of a shape at time t; at 0 and 1 exactly its start and its end.

    Without a motion every point goes straight, eq (2).
    """
    if shape.motion is None or t in (0.0, 1.0):
        every = [(1.0 - t) * contour.start.segments + t * contour.end.segments for contour in shape.contours]
    else:
        every = shape.motion.segments(shape.contours, t)
    return tuple(
        replace(contour.start, segments=segments)
        for contour, segments in zip(shape.contours, every, strict=True)
    )


def waypoints(shape: ShapeBlend) -> tuple[Waypoint, ...]:
    """Where the outlines of a shape come by, so near to each other that straight paths between them will do.

    Nowhere is a control point further off than `WAY_TOLERANCE`, as seen at the middle and the quarters between two
    neighbours. Straight motion needs none.
    """
    if shape.motion is None:
        return ()
    points = np.concatenate(
        [outline.segments.ravel() for contour in shape.contours for outline in (contour.start, contour.end)]
    )
    distance = WAY_TOLERANCE * Box.around(points).larger_side
    seen: dict[float, ComplexArray] = {}

    def at(t: float) -> ComplexArray:
        if t not in seen:
            seen[t] = np.concatenate([outline.segments for outline in between(shape, t)])
        return seen[t]

    def cut(low: float, high: float, depth: int) -> list[float]:
        """Times within an interval at which it is to be cut."""
        shares = (0.25, 0.5, 0.75)
        off = max(
            float(np.abs(at(low) + u * (at(high) - at(low)) - at(low + u * (high - low))).max())
            for u in shares
        )
        if off <= distance or depth == 0:
            return []
        middle = 0.5 * (low + high)
        return [*cut(low, middle, depth - 1), middle, *cut(middle, high, depth - 1)]

    return tuple(Waypoint(t, between(shape, t)) for t in cut(0.0, 1.0, MOST_HALVINGS))
