"""The motion of a shape, and why: rules first, then the judge.

The first rule of `choose` that fits a shape decides. Where none does, straight paths that look right are taken, else
the motion that looks best to the judge (`best_motion`). For other motions than straight, shapes are matched again with
B rotated back. The reasons for motions of a single shape are here; special blends have theirs beside them.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.geometry.crossings import chain_crossings, path_crossings
from shapeblend_cli.interpolate.paths import SameMotion, expect, paths_at, segments_at
from shapeblend_cli.model import WHOLE, Candidate
from shapeblend_cli.motion.alignment import Alignment
from shapeblend_cli.motion.judge import judge_shape

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box, ContourBlend, ShapeBlend

ASKED = "asked for"
CHANGES_IN_PLACE = "the shape stays in place, except for parts that are added or removed"
FOLLOWS = "it follows the edge that it lies on"
GROWS = "a point at one end"
FADES = "it fades where it lies"
LEADS = "straight, because strokes on its edges move with it"
TINY = "too small for turns to be seen"
MANY = "too many shapes to try other motions on each"
LOOKS_RIGHT = "straight paths look right"
LEAST = "the least wrong"
NOT_MUCH_BETTER = "no other is much less wrong"
OTHERS_CROSS = "motions that are less wrong make outlines cross"

JUDGED = "judged"
"""Name of the motion that the judge has yet to choose."""

SMALL = 0.05
"""Maximum size of a shape that moves straight in any case, as a share of the largest shape's size: its turns are hardly
seen."""

AFFORDABLE_SEGMENTS = 2000
"""Maximum number of segments of shapes for which several motions are tried. These take a few seconds; a drawing of
hundreds of shapes would take minutes."""

RIGHT = 0.01
"""Maximum fault of straight paths for which no other motion is tried."""

CHECKED_TIMES = tuple(k / 10 for k in range(1, 10))
"""Times at which outlines are checked for crossings of any size. The judge weighs them by the area that turns over."""

CLEAN = 1.35
"""Maximum fault of a motion without crossings, relative to straight paths with crossings, to be preferred to them."""

BETTER = 0.8
"""Maximum fault of another motion, relative to straight paths, to be preferred to them: they are predictable."""

FAR_BETTER = 0.5
"""The same for shapes that seem to be edited: whoever moves nodes of a drawing mostly wants them to go straight."""


class RotatedShape(NamedTuple):
    """A shape matched with B rotated back, and the similarity that its motion separates.

    If parts of the shape turn on their own, the shape with these parts matched again, and the similarity of each
    contour.
    """

    shape: ShapeBlend
    alignment: Alignment
    turning: tuple[ShapeBlend, tuple[Alignment, ...]] | None = None

    def is_straight(self, straight: ShapeBlend) -> bool:
        """Return whether its rigid motion is that of the shape on straight paths."""
        is_same = self.turning is None and self.shape.contours is straight.contours
        return is_same and self.alignment.is_in_place


class Situation(NamedTuple):
    """Circumstances of the choice of a motion, besides the shape itself."""

    asked: str  # --motion
    rotation: float  # of B as a whole against A, in radians
    leads: bool  # strokes ride on the shape
    relative_size: float  # as a share of the largest shape's
    is_affordable: bool  # trying several motions


class Choice(NamedTuple):
    """A motion and the reason for it, a phrase; `JUDGED` has none yet."""

    motion: str
    reason: str = ""


def choose(shape: ShapeBlend, situation: Situation) -> Choice:
    """Choose the motion of a shape by rules: the first that fits decides."""
    asked, rotation, leads, relative_size, is_affordable = situation
    if shape.motion is not None:
        return Choice("linear", CHANGES_IN_PLACE)
    if not shape.is_matched:
        reasons = (FOLLOWS if contour.follows_edge else GROWS for contour in shape.contours)
        return Choice("linear", "; ".join(dict.fromkeys(reasons)))
    if asked != "auto":
        return Choice(asked, ASKED)
    if rotation:
        return Choice("rigid", "B is A turned by {degrees:.3g} degrees")
    if leads:
        return Choice("linear", LEADS)
    if relative_size < SMALL:
        return Choice("linear", TINY)
    return Choice(JUDGED) if is_affordable else Choice("linear", MANY)


def in_motion(rotated: RotatedShape, choice: Choice) -> ShapeBlend:
    """Return a shape in another motion than straight, as it was chosen by rules."""
    degrees = math.degrees(rotated.alignment.rotation)
    return _with_motion(rotated, choice.motion)._replace(reason=choice.reason.format(degrees=degrees))


def judged_straight(shape: ShapeBlend, view: Box) -> ShapeBlend:
    """Return a shape on straight paths, judged."""
    return shape._replace(reason=LOOKS_RIGHT, candidates=(candidate_of(shape, view),))


def looks_right(straight: ShapeBlend) -> bool:
    """Return whether a judged shape looks right on straight paths."""
    return straight.candidates[0].wrong <= RIGHT


def is_edited(shape: ShapeBlend) -> bool:
    """Return whether each line or curve of a shape becomes one of B's, node by node, as if nodes had been moved.

    Shapes of lines alone do not count: they have as many of them by accident.
    """
    contours = shape.contours
    return all(map(_keeps_its_nodes, contours)) and not all(one.contour_a.straight.all() for one in contours)


def _keeps_its_nodes(contour: ContourBlend) -> bool:
    """Return whether each vertex becomes another one, nodes become nodes, lines become lines, and curves curves."""
    a, b = contour.polygon_a, contour.polygon_b
    i, j = contour.correspondence.dots.T
    if not len(i) == len(a.vertices) == len(b.vertices):
        return False
    nodes = a.parameter[i] == 0.0
    if (nodes != (b.parameter[j] == 0.0)).any():
        return False
    lines = contour.contour_a.straight[a.segment[i[nodes]]], contour.contour_b.straight[b.segment[j[nodes]]]
    return bool((lines[0] == lines[1]).all())


def best_motion(straight: ShapeBlend, rotated: RotatedShape, view: Box) -> ShapeBlend:
    """Return the best of a judged shape on straight paths and the same shape in other motions."""
    tried = list(straight.candidates)
    better = FAR_BETTER if is_edited(straight) else BETTER
    best, least = straight, better * tried[0].wrong
    crossed = None
    for motion in ("rigid", "intrinsic"):
        if motion == "rigid" and rotated.is_straight(straight):
            tried.append(tried[0]._replace(name=motion))
            continue
        candidate = _with_motion(rotated, motion)
        tried.append(candidate_of(candidate, view))
        wrong = tried[-1].wrong
        if wrong > CLEAN * tried[0].wrong:
            continue
        is_less = wrong < least
        if is_less and not _crosses(candidate):  # whether straight paths cross does not matter
            best, least, crossed = candidate, wrong, False
            continue
        if crossed is None:
            crossed = _crosses(straight)
        if crossed and (is_less or not _crosses(candidate)):
            best, least, crossed = candidate, wrong, is_less
    numbers = ", ".join(f"{one.name} {one.wrong:.3f}" for one in tried)
    return best._replace(reason=f"{_why(best, tried, better)}: {numbers}", candidates=tuple(tried))


def _why(best: ShapeBlend, tried: Sequence[Candidate], better: float) -> str:
    """Return the reason for the best of several motions."""
    least = min(one.wrong for one in tried)
    if any(one.name == best.motion_name and one.wrong == least for one in tried):
        return LEAST
    return NOT_MUCH_BETTER if best.motion is None and least >= better * tried[0].wrong else OTHERS_CROSS


def _crosses(shape: ShapeBlend) -> bool:
    """Return whether the outlines of a shape cross themselves or each other more often than at either end."""
    if not _cross_more(shape, 0):  # the usual case, for which the ends need not be known
        return False
    most = max(path_crossings(paths_at(shape, t)) for t in (0.0, 1.0))
    return most == 0 or _cross_more(shape, most)


def _cross_more(shape: ShapeBlend, most: int) -> bool:
    """Return whether the outlines of a shape cross more than so often at any of the times that are checked."""
    expect(shape, CHECKED_TIMES)
    if most == 0:
        return any(crosses_at(shape, t) for t in CHECKED_TIMES)
    return any(path_crossings(paths_at(shape, t), most + 1) > most for t in CHECKED_TIMES)


def crosses_at(shape: ShapeBlend, t: float) -> bool:
    """Return whether the outlines of a shape cross themselves or each other at a time."""
    return _crosses_then(SameMotion(shape), shape.own_time(t))


@lru_cache(maxsize=8 * len(CHECKED_TIMES))
def _crosses_then(moving: SameMotion, t: float) -> bool:
    """Return `crosses_at` by a shape's own time, kept: `uncrossed` asks it again of the motion that was chosen."""
    shape = moving.shape
    if shape.pace or shape.span != WHOLE:
        shape = shape._replace(span=WHOLE, pace=())
    return chain_crossings(segments_at(shape, t), [contour.start for contour in shape.contours], 1) > 0


def candidate_of(shape: ShapeBlend, view: Box) -> Candidate:
    """Judge a shape; numbers are rounded, so that machines that differ in the last digit choose alike."""
    judgement, painted = judge_shape(shape, view)
    found = judgement.weighted
    terms = tuple((name, round(x, 4)) for name, x in found._asdict().items())
    return Candidate(shape.motion_name, round(sum(found), 4), terms, painted)


def _with_motion(rotated: RotatedShape, motion: str) -> ShapeBlend:
    shape, alignment, turning = rotated
    if motion == "rigid":
        from shapeblend_cli.motion.rigid import Rigid

        shape, alignments = turning or (shape, (alignment,) * len(shape.contours))
        return shape._replace(motion=Rigid(alignments))
    from shapeblend_cli.motion.intrinsic import intrinsic  # most blends do without it

    return shape._replace(motion=intrinsic(shape.contours, alignment))
