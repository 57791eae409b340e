"""The outlines at a time t: on straight vertex paths, eq (2), or as a motion moves them."""

from __future__ import annotations

from functools import cache, lru_cache
from itertools import pairwise
from operator import is_
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.interpolate.common_segments import common_segments
from shapeblend_cli.model import WHOLE, ContourBlend, CubicPath, ShapeBlend, Waypoint, control_box

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapeblend_cli.model import ComplexArray

WAYPOINT_TOLERANCE = 2e-3
"""Maximum deviation of an animation from a motion that is not straight, as a share of the shape's size."""

SWEEP_TOLERANCE = 1.2e-2
"""Maximum deviation of an animation from outlines that are laid bare, as a share of the shape's size. What is off lies
on the outlines still, a moment behind the others; their edges along the way are never off."""

MOST_HALVINGS = 6
"""Maximum number of times that the time between two drawings is halved into straight steps."""

MOST_FINER_HALVINGS = 11
"""Maximum number of times where finer steps are asked for: as short as the moment in which a line turns a corner."""


def with_curves(blend: ContourBlend) -> ContourBlend:
    """Return a blend of the drawings' own curves in place of the polygons' lines, see `common_segments`."""
    common = common_segments(
        blend.contour_a, blend.polygon_a, blend.contour_b, blend.polygon_b, blend.correspondence.dots
    )
    return blend._replace(**common._asdict())


def paths_at(shape: ShapeBlend, t: float) -> tuple[CubicPath, ...]:
    """Return the paths of a shape at time t: exactly its start at 0 and its end at 1.

    Without a motion every point moves straight, eq (2), also before 0 and after 1.
    """
    return tuple(
        CubicPath(segments, contour.start.straight, contour.start.closed)
        for contour, segments in zip(shape.contours, segments_at(shape, t), strict=True)
    )


def segments_at(shape: ShapeBlend, t: float) -> list[ComplexArray]:
    """Return the control points of a shape's paths at time t."""
    t = shape.own_time(t)
    if shape.motion_name == "sweep":  # it ends at the drawings
        t = min(max(t, 0.0), 1.0)
    if shape.motion is None or t in (0.0, 1.0):
        every = [contour.straight(t) for contour in shape.contours]
    else:
        every = shape.motion.segments(shape.contours, t)
    if not 0.0 <= t <= 1.0:  # beyond the point that they become, contours would grow inside out
        every = [
            (contour.start if t < 0.0 else contour.end).segments
            if (contour.grows if t < 0.0 else contour.shrinks)
            else segments
            for contour, segments in zip(shape.contours, every, strict=True)
        ]
    return every


def expect(shape: ShapeBlend, times: Iterable[float]) -> None:
    """Have a shape's outlines found at several times at once, if its motion does that sooner than one by one."""
    at_once = getattr(shape.motion, "expect", None)
    if at_once is not None:
        at_once(shape.contours, [own for t in times if 0.0 < (own := shape.own_time(t)) < 1.0])


def waypoints(shape: ShapeBlend, finer: float = 1.0) -> tuple[Waypoint, ...]:
    """Return the waypoints between which straight paths approximate a shape's motion.

    At the quarters between two waypoints no control point is off by more than a tolerance, which is divided by `finer`.
    Straight motion needs no waypoints.
    """
    if shape.pace:
        plain = shape._replace(span=WHOLE, pace=())
        shares = [share for _, share in shape.pace]
        own = [
            *_cuts(plain, min(shares), 0.0, finer),
            0.0,
            *_cuts(plain, 0.0, 1.0, finer),
            1.0,
            *_cuts(plain, 1.0, max(shares), finer),
        ]
        return tuple(Waypoint(t, paths_at(shape, t)) for t in shape.times_of(own))
    if shape.span != WHOLE:
        whole = shape._replace(span=WHOLE)
        inner = [(shape.time_of(point.t), point.paths) for point in waypoints(whole, finer)]
        ends = [(shape.span[k], paths_at(whole, float(k))) for k in (0, 1)]
        return tuple(Waypoint(t, paths) for t, paths in (ends[0], *inner, ends[1]) if 0.0 < t < 1.0)
    return tuple(Waypoint(t, paths_at(shape, t)) for t in _cuts(shape, 0.0, 1.0, finer))


class SameMotion:
    """A shape that moves all the time; equal are those with the same paths at both ends and the same motion."""

    def __init__(self, shape: ShapeBlend) -> None:
        self.shape = shape
        # Contours are made anew where they only get a reason.
        self._same = [path for contour in shape.contours for path in (contour.start, contour.end)]
        self._hash = hash((*map(id, self._same), id(shape.motion)))

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, SameMotion):
            return NotImplemented
        is_same = self.shape.motion is other.shape.motion and len(self._same) == len(other._same)
        return is_same and all(map(is_, self._same, other._same))


def _cuts(shape: ShapeBlend, begin: float, until: float, finer: float) -> Sequence[float]:
    """Return the times at which a shape's motion is cut into straight steps, from one time to another."""
    return (
        () if shape.motion is None or begin >= until else _found_cuts(SameMotion(shape), begin, until, finer)
    )


@lru_cache(maxsize=8)
def _found_cuts(moving: SameMotion, begin: float, until: float, finer: float) -> Sequence[float]:
    """Return `_cuts`, which the view of a blend asks for as animations do."""
    shape = moving.shape
    paths = [path for contour in shape.contours for path in (contour.start, contour.end)]
    tolerance = SWEEP_TOLERANCE if shape.motion_name == "sweep" else WAYPOINT_TOLERANCE
    halvings = MOST_HALVINGS if finer == 1.0 else MOST_FINER_HALVINGS
    most = tolerance / finer * control_box(paths).larger_side

    @cache
    def at(t: float) -> ComplexArray:
        return np.concatenate(segments_at(shape, t))

    def deviates(low: float, high: float) -> bool:
        """Return whether a straight step between two times is off by too much at a quarter of it."""
        first, ahead = at(low), at(high) - at(low)
        off = (np.abs(first + u * ahead - at(low + u * (high - low))).max() for u in (0.5, 0.25, 0.75))
        return not all(one <= most for one in off)

    knots = [t for t in getattr(shape.motion, "knots", ()) if begin < t < until]
    found = list(knots)
    steps = list(pairwise([begin, *knots, until]))
    for _ in range(halvings):
        expect(shape, (low + u * (high - low) for low, high in steps for u in (0.25, 0.5, 0.75)))
        cut = [(low, 0.5 * (low + high), high) for low, high in steps if deviates(low, high)]
        found += [middle for _, middle, _ in cut]
        steps = [step for times in cut for step in pairwise(times)]
    return sorted(found)
