"""Which motion a shape gets: the one asked for, or the best of several by the judge.

The rules of `choose` come first. Where they leave it open, straight paths that look right settle it, else the judge
compares motions. Motions other than straight need the correspondence solved again, with B rotated back.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Candidate
from shapeblend_cli.motion.alignment import Alignment
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
JUDGED, TURNED = "judged", "turned"

SMALL = 0.05
"""Maximum size of a shape that moves straight in any case, as a share of the largest one's: how it turns is hardly
seen."""

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


class Situation(NamedTuple):
    """What the choice of a motion hangs on besides the shape itself."""

    asked: str  # --motion
    is_turned: bool  # B as a whole is A turned
    leads: bool  # strokes ride on the shape
    relative_size: float  # as a share of the largest shape's
    is_affordable: bool  # time is left to try several motions


class Choice(NamedTuple):
    """A motion, and why, a phrase. `JUDGED` is that of least wrong, which says why itself."""

    motion: str
    reason: str = ""


def choose(shape: ShapeBlend, situation: Situation) -> Choice:
    """Choose the motion of a shape: the first rule that fits decides."""
    asked, is_turned, leads, relative_size, is_affordable = situation
    if shape.motion is not None:
        return Choice("linear", STILL)
    if not shape.is_matched:
        reasons = (FOLLOWS if contour.follows_edge else GROWS for contour in shape.contours)
        return Choice("linear", "; ".join(dict.fromkeys(reasons)))
    if asked != "auto":
        return Choice(asked, ASKED)
    if is_turned:
        return Choice("rigid", TURNED)
    if leads:
        return Choice("linear", LEADS)
    if relative_size < SMALL:
        return Choice("linear", TINY)
    return Choice(JUDGED) if is_affordable else Choice("linear", MANY)


def moved(rotated: RotatedShape, choice: Choice) -> ShapeBlend:
    """Return a shape that was matched for another motion than straight paths, in this motion."""
    reason = choice.reason
    if reason == TURNED:
        reason = f"B is A turned by {math.degrees(rotated.alignment.rotation):.3g} degrees"
    return _with_motion(rotated, choice.motion)._replace(reason=reason)


def straight(shape: ShapeBlend, view: Box) -> ShapeBlend:
    """Return a shape on straight paths, judged."""
    return shape._replace(reason=RIGHT_ENOUGH, candidates=(judged_shape(shape, view),))


def is_right(straight: ShapeBlend) -> bool:
    """Return whether so little is wrong with a shape on straight paths that no other motion is tried."""
    return straight.candidates[0].wrong <= RIGHT


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


def _with_motion(rotated: RotatedShape, motion: str) -> ShapeBlend:
    shape, alignment, turning = rotated
    if motion == "rigid":
        from shapeblend_cli.motion.rigid import Rigid

        shape, alignments = turning or (shape, (alignment,) * len(shape.contours))
        return shape._replace(motion=Rigid(alignments))
    from shapeblend_cli.motion.intrinsic import intrinsic  # which most blends do without

    return shape._replace(motion=intrinsic(shape.contours, alignment))
