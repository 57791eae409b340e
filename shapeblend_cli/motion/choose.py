"""Which motion a shape gets: the one asked for, or the best of several by the judge.

Straight paths that look right settle it. Other motions may need the correspondence solved again, with B rotated back,
and only the pipeline can do that: it hands over what it solved.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Candidate
from shapeblend_cli.motion.alignment import Alignment, Rigid, align, point_pairs
from shapeblend_cli.motion.judge import judged

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box, ShapeBlend

ASKED = "asked for"
RIGHT_ENOUGH = "little is wrong with it"
STILL = "what is the same stays"
FOLLOWS, GROWS = "it follows the edge that it lies on", "a point at one end"
LEADS = "straight, because strokes on its edges move with it"
TINY = "too small to be seen to turn"
MANY = "too many shapes to try other motions on each"

RIGHT = 0.01
"""With so little wrong nothing else is tried."""

CHECKED_TIMES = tuple(k / 10 for k in range(1, 10))
"""When outlines are looked at for crossings of any size; the judge weighs what they turn over."""

CLEAN = 1.35
"""A motion without crossings is taken for one with them if it has at most so many times as much wrong with it."""

BETTER = 0.8
"""Another motion is taken if it has at most this share of what is wrong on straight paths: these are predictable."""


class RotatedShape(NamedTuple):
    """A shape matched with B rotated back, and the similarity that its motion separates.

    Parts of it may turn on their own: then the shape is also given with these matched with B rotated back, and the
    similarity of each contour.
    """

    shape: ShapeBlend
    alignment: Alignment
    turning: tuple[ShapeBlend, tuple[Alignment, ...]] | None = None


def reason_to_be_straight(shape: ShapeBlend) -> str:
    """Return why a shape does not get another motion, a phrase; empty if it may."""
    if shape.motion is not None:
        return STILL
    if not shape.is_matched:
        reasons = (FOLLOWS if contour.follows_edge else GROWS for contour in shape.contours)
        return "; ".join(dict.fromkeys(reasons))
    return ""


def moved_as_asked(shape: ShapeBlend, motion: str, rotated: RotatedShape) -> ShapeBlend:
    """Return a shape with the motion that is asked for, not a straight one."""
    return _safe(shape, rotated) if motion == "safe" else _with_motion(rotated, motion)._replace(reason=ASKED)


def turned(rotated: RotatedShape) -> ShapeBlend:
    """Return a shape of a drawing that is turned as a whole."""
    degrees = math.degrees(rotated.alignment.rotation)
    return _with_motion(rotated, "rigid")._replace(reason=f"B is A turned by {degrees:.3g} degrees")


def straight(shape: ShapeBlend, view: Box) -> ShapeBlend:
    """Return a shape on straight paths, judged."""
    return shape._replace(reason=RIGHT_ENOUGH, candidates=(judged_shape(shape, view),))


def best_motion(shape: ShapeBlend, rotated: RotatedShape, view: Box) -> ShapeBlend:
    """Return the best of a shape on straight paths, which are judged, and in other motions."""
    tried = list(shape.candidates)
    best, least = shape, BETTER * tried[0].wrong
    crossed = _crosses(shape)
    for motion in ("rigid", "intrinsic"):
        candidate = _with_motion(rotated, motion)
        tried.append(judged_shape(candidate, view))
        wrong = tried[-1].wrong
        if crossed and wrong <= CLEAN * tried[0].wrong and not _crosses(candidate):
            best, least, crossed = candidate, wrong, False
        elif wrong < least and (crossed or not _crosses(candidate)):
            best, least = candidate, wrong
    numbers = ", ".join(f"{one.name} {one.wrong:.3f}" for one in tried)
    return best._replace(reason=f"{_why(best, tried)}: {numbers}", candidates=tuple(tried))


def _why(best: ShapeBlend, tried: Sequence[Candidate]) -> str:
    """Return why one of the motions that were tried is taken, a phrase."""
    least = min(one.wrong for one in tried)
    if any(one.name == best.motion_name and one.wrong == least for one in tried):
        return "the least wrong"
    if best.motion is None and least >= BETTER * tried[0].wrong:
        return "no other is much less wrong"
    return "less wrong ones cross"


def _crosses(shape: ShapeBlend) -> bool:
    """Return whether an outline crosses itself, or another of its shape, more often on the way than at either end."""
    most = max(path_crossings(paths_at(shape, t)) for t in (0.0, 1.0))
    return any(path_crossings(paths_at(shape, t), most + 1) > most for t in CHECKED_TIMES)


def judged_shape(shape: ShapeBlend, view: Box) -> Candidate:
    """Judge a shape; the number is rounded, so that the last digit of a machine's arithmetic does not choose."""
    judgement, painted = judged(shape, view)
    found = judgement.weighted
    terms = tuple((name, round(x, 4)) for name, x in found._asdict().items())
    return Candidate(shape.motion_name, round(sum(found), 4), terms, painted)


# Modules that take long to import, and that most blends do without, are imported where they are used.


def _with_motion(rotated: RotatedShape, motion: str) -> ShapeBlend:
    shape, alignment, turning = rotated
    if motion == "rigid":
        shape, alignments = turning or (shape, (alignment,) * len(shape.contours))
        return shape._replace(motion=Rigid(alignments))
    from shapeblend_cli.motion.intrinsic import intrinsic

    return shape._replace(motion=intrinsic(shape.contours, alignment))


def _safe(shape: ShapeBlend, rotated: RotatedShape) -> ShapeBlend:
    """Take the cheaper route, of the correspondences solved with B as it is and, if something crosses, rotated back."""
    from shapeblend_cli.motion.safe import find_route, follow_route

    route = find_route(shape, align(point_pairs(shape.contours)))
    if route is None or not route.is_level:
        most = math.inf if route is None else route.cost
        route = find_route(rotated.shape, rotated.alignment, most) or route
    if route is None:
        return _with_motion(rotated, "rigid")._replace(reason="no way without crossings was found")
    return follow_route(route)._replace(reason=ASKED)
