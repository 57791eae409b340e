"""Which motion a shape gets: the one asked for, or the first without a fault.

A motion other than a straight one may need the correspondence solved again, with B rotated back, and only the pipeline
can do that. So there are two steps: `try_straight` says on which shapes other motions are to be tried, and
`choose_motion` tries them on what was solved again.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.motion.alignment import Rigid, align, point_pairs, residual
from shapeblend_cli.motion.defects import COLLAPSE, OVERLAP, Fault, fault

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import ShapeBlend
    from shapeblend_cli.motion.alignment import Alignment
    from shapeblend_cli.motion.safe import Plan

ASKED = "asked for"

BLURRED, ROUND = 17, 20
"""Levels above which smoothed outlines have only large features left, and hardly any."""

AFFORDABLE = 600
"""Once other motions have been tried on shapes of so many segments, further ones move straight in any case. That
takes a few seconds; a drawing of hundreds of faulty shapes would take minutes."""

COMMON = 2.0
"""Shapes of a drawing move by one similarity unless it leaves so many times as much as their own."""


class Trial(NamedTuple):
    """A shape on straight paths, and whether other motions are to be tried on it.

    Attributes
    ----------
    shape : ShapeBlend
    is_settled : bool
        Whether the shape moves as it is.
    reason : str
        Why it does not.
    fault : Fault or None
        What is wrong with straight paths; None where they are out of the question.
    plan : Plan or None
        The way of `safe` motion for the shape as it is, where that is known already.
    """

    shape: ShapeBlend
    is_settled: bool = True
    reason: str = ""
    fault: Fault | None = None
    plan: Plan | None = None


class RotatedShape(NamedTuple):
    """A shape matched with B rotated back, and the similarity that its motion takes apart."""

    shape: ShapeBlend
    alignment: Alignment


def try_straight(
    shapes: Sequence[ShapeBlend], motion: str, times: Sequence[float], rotation: float | None
) -> list[Trial]:
    """Look at shapes on straight paths.

    Parameters
    ----------
    shapes : sequence of ShapeBlend
    motion : str
        As `--motion` has it.
    times : sequence of float
        When frames are made.
    rotation : float or None
        By what angle B is A rotated, in radians, if that is all there is between them.
    """
    trials = [
        Trial(shape._replace(reason=ASKED if shape.is_matched else "a point at one end")) for shape in shapes
    ]
    if motion == "linear":
        return trials
    numbers = [k for k, shape in enumerate(shapes) if shape.is_matched]
    if motion == "auto" and rotation is None:
        _find_faults(trials, numbers, times)
        return trials
    for k in numbers:
        if motion == "auto":
            trials[k] = Trial(
                shapes[k], False, f"B is A turned by {math.degrees(rotation or 0.0):.3g} degrees"
            )
        else:
            trials[k] = _try_safe(trials[k].shape) if motion == "safe" else Trial(trials[k].shape, False)
    return trials


def _find_faults(trials: list[Trial], numbers: Sequence[int], times: Sequence[float]) -> None:
    """Settle shapes without a fault, and those for which other motions would take too long, the smallest."""
    faults = {k: fault(trials[k].shape, times) for k in numbers}
    left = AFFORDABLE
    for k in sorted(numbers, key=lambda k: -_size(trials[k].shape)):
        shape, found = trials[k].shape, faults[k]
        if found is None:
            trials[k] = Trial(shape._replace(reason="no fault"))
            continue
        reason = f"linear: {found.says}"
        if left > 0:
            left -= sum(len(contour.start.segments) for contour in shape.contours)
            trials[k] = Trial(shape, False, reason, found)
        else:
            reason += "; too many shapes to try another motion on each"
            trials[k] = Trial(shape._replace(reason=reason))


def choose_motion(trial: Trial, motion: str, rotated: RotatedShape, times: Sequence[float]) -> ShapeBlend:
    """Give a shape the motion that is asked for; `auto` is the first without a fault, else that with the least.

    Parameters
    ----------
    trial : Trial
        Not settled.
    motion : str
    rotated : RotatedShape
    times : sequence of float
    """
    makers: dict[str, Callable[[], ShapeBlend]] = {
        "rigid": lambda: _rigid(rotated),
        "intrinsic": lambda: _intrinsic(rotated),
        "safe": lambda: _safe(trial, rotated),
    }
    if motion != "auto":
        return makers[motion]()
    reasons = [trial.reason]
    seen = [] if trial.fault is None else [(trial.shape, trial.fault)]
    for name, make in makers.items():
        shape = make()
        faults = [fault(shape, times), _blurred(shape)]
        worst = max(filter(None, faults), key=lambda one: one.rank, default=None)
        if worst is None:
            return shape._replace(reason="; ".join(reasons))
        reasons.append(f"{name}: {worst.says}")
        seen.append((shape, worst))
    least, _ = min(seen, key=lambda one: one[1].rank)
    return least._replace(reason="; ".join(reasons))


def is_as_good(common: Alignment, own: Alignment, shape: ShapeBlend) -> bool:
    """Whether the similarity of a whole drawing suits one of its shapes about as well as the shape's own."""
    points = point_pairs(shape.contours)
    return residual(points, common) <= COMMON * residual(points, own)


# What takes a while to import, and most blends do without, is imported where it is wanted.


def _rigid(rotated: RotatedShape, reason: str = ASKED) -> ShapeBlend:
    return rotated.shape._replace(motion=Rigid(rotated.alignment), reason=reason)


def _intrinsic(rotated: RotatedShape) -> ShapeBlend:
    from shapeblend_cli.motion.intrinsic import intrinsic

    motion = intrinsic(rotated.shape.contours, rotated.alignment)
    return rotated.shape._replace(motion=motion, reason=ASKED)


def _try_safe(shape: ShapeBlend) -> Trial:
    """Settle a shape that `safe` motion need not smooth anywhere."""
    from shapeblend_cli.motion.safe import plan, safe

    found = plan(shape, align(point_pairs(shape.contours)))
    if found is not None and found.is_level:
        return Trial(safe(found)._replace(reason=ASKED))
    return Trial(shape, is_settled=False, plan=found)


def _safe(trial: Trial, rotated: RotatedShape) -> ShapeBlend:
    """Move along the cheapest way, of the correspondences found with B as it is and rotated back."""
    from shapeblend_cli.motion.safe import plan, safe

    shape = trial.shape
    here = trial.plan or plan(shape, align(point_pairs(shape.contours)))
    if here is not None and here.is_level:
        return safe(here)._replace(reason=ASKED)
    there = plan(rotated.shape, rotated.alignment, math.inf if here is None else here.cost)
    found = there or here
    if found is None:
        return _rigid(rotated, "no way without crossings was found")
    return safe(found)._replace(reason=ASKED)


def _size(shape: ShapeBlend) -> float:
    """Of the larger side of its largest contour's box."""
    return max(max(contour.scale_a, contour.scale_b) for contour in shape.contours)


def _blurred(shape: ShapeBlend) -> Fault | None:
    """What smoothing takes away on the way, if that is too much."""
    heights = getattr(shape.motion, "heights", None)
    if heights is None or heights.max() <= BLURRED:
        return None
    if heights.max() > ROUND:
        return Fault(COLLAPSE, "nothing but round outlines half way")
    return Fault(OVERLAP, "details are smoothed away half way")
