"""Vertex paths: where outlines are at a time, on straight paths, eq (2), or as a motion has it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.interpolate.curves import common_segments
from shapeblend_cli.interpolate.track import counted_on
from shapeblend_cli.model import Box, CubicPath, MovingContour, Waypoint

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, MatchedContour, MovingShape

WAY_TOLERANCE = 2e-3
"""How far an animation may be from a motion that is not straight, as a share of the size of what moves."""

MOST_HALVINGS = 6
"""From a drawing to the next an animation takes at most two to this power steps."""


def moving(matched: MatchedContour, *, curves: bool) -> MovingContour:
    """Two matched contours as outlines that are alike segment for segment.

    Parameters
    ----------
    matched : MatchedContour
    curves : bool
        Segments of the drawings' own curves, see `curves`; otherwise a line for every step of the solver's path.

    Returns
    -------
    MovingContour
        With curves, its ends are the contours; without, the polygons, some of their vertices repeated.
    """
    closed = matched.correspondence.closed
    dots = matched.correspondence.dots
    if curves:
        common = common_segments(
            matched.contour_a, matched.polygon_a, matched.contour_b, matched.polygon_b, dots
        )
        segments_a, segments_b, straight = common.segments_a, common.segments_b, common.straight
        places = common.places_a, common.places_b
    else:
        segments_a = cubics.lines(matched.polygon_a.vertices[dots[:, 0]], closed)
        segments_b = cubics.lines(matched.polygon_b.vertices[dots[:, 1]], closed)
        straight = np.ones(len(segments_a), np.bool_)
        period = len(matched.polygon_a.vertices), len(matched.polygon_b.vertices)
        along = counted_on(dots, period if closed else None)
        places = along[:, 0], along[:, 1]
    return MovingContour(
        start=CubicPath(segments_a, straight, closed),
        end=CubicPath(segments_b, straight, closed),
        places=places,
        grows=matched.a is None,
        shrinks=matched.b is None,
    )


def between(shape: MovingShape, t: float) -> tuple[CubicPath, ...]:
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


def waypoints(shape: MovingShape) -> tuple[Waypoint, ...]:
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
