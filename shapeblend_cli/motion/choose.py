"""Which motion a shape gets: the one asked for, or the first without a defect.

A motion other than a straight one may need the correspondence solved again, with B rotated back, and only the pipeline
can do that. So there are two steps: `try_straight` says on which shapes other motions are to be tried, and
`choose_motion` tries them on what was solved again.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.motion.alignment import Alignment, Rigid, align, point_pairs, residual
from shapeblend_cli.motion.defects import COLLAPSE, OVERLAP, Defect, worst_defect

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import ShapeBlend
    from shapeblend_cli.motion.safe import Route

ASKED = "asked for"
STILL = "what is the same stays"
FOLLOWS, GROWS = "it goes where the edge goes that it lies on", "a point at one end"

BLURRED_LEVEL, ROUND_LEVEL = 17, 20
"""Levels above which smoothed outlines have only large features left, and hardly any."""

AFFORDABLE_SEGMENTS = 600
"""Once other motions have been tried on shapes of so many segments, further ones move straight in any case. That
takes a few seconds; a drawing of hundreds of defective shapes would take minutes."""

LARGE, AT_REST = 0.5, 5e-3
"""A contour rests that moves nowhere further than the second share of its shape's size; that counts if it has the first
share of that size."""

COMMON_RESIDUAL = 2.0
"""Shapes of a drawing move by one similarity unless it leaves so many times as much as their own."""


class Trial(NamedTuple):
    """A shape on straight paths, and whether it is settled: no other motions are to be tried on it.

    If it is not: the reason, the defect of straight paths unless they are out of the question, and the route of `safe`
    motion if it is known already.
    """

    shape: ShapeBlend
    is_settled: bool = True
    reason: str = ""
    defect: Defect | None = None
    route: Route | None = None


class RotatedShape(NamedTuple):
    """A shape matched with B rotated back, and the similarity that its motion separates."""

    shape: ShapeBlend
    alignment: Alignment


def try_straight(
    shapes: Sequence[ShapeBlend], motion: str, times: Sequence[float], rotation: float | None
) -> list[Trial]:
    """Try shapes on straight paths, at the times of the frames.

    The rotation is the angle by which B is A rotated, in radians, if that is all there is between them.
    """
    trials = [
        Trial(shape._replace(reason=STILL if shape.motion else ASKED if shape.is_matched else _alone(shape)))
        for shape in shapes
    ]
    if motion == "linear":
        return trials
    matched = [k for k, shape in enumerate(shapes) if shape.is_matched and shape.motion is None]
    if motion == "auto" and rotation is None:
        _settle_without_defect(trials, matched, times)
        return trials
    for k in matched:
        if motion == "auto":
            reason = f"B is A turned by {math.degrees(rotation or 0.0):.3g} degrees"
            trials[k] = Trial(shapes[k], False, reason)
        else:
            trials[k] = _try_safe(trials[k].shape) if motion == "safe" else Trial(trials[k].shape, False)
    return trials


def _alone(shape: ShapeBlend) -> str:
    """Return why a shape moves as it does of which no contour has a partner."""
    reasons = (FOLLOWS if contour.follows_edge else GROWS for contour in shape.contours)
    return "; ".join(dict.fromkeys(reasons))


def _settle_without_defect(trials: list[Trial], matched: Sequence[int], times: Sequence[float]) -> None:
    """Settle shapes without a defect, and those for which other motions would take too long, the smallest."""
    defects = {k: worst_defect(trials[k].shape, times) for k in matched}
    affordable = AFFORDABLE_SEGMENTS
    # The larger side of a shape's largest box.
    sizes = {k: max(max(c.scale_a, c.scale_b) for c in trials[k].shape.contours) for k in matched}
    for k in sorted(matched, key=lambda k: -sizes[k]):
        shape, defect = trials[k].shape, defects[k]
        if defect is None:
            trials[k] = Trial(shape._replace(reason="no fault"))
            continue
        reason = f"linear: {defect.message}"
        if affordable > 0:
            affordable -= sum(len(contour.start.segments) for contour in shape.contours)
            trials[k] = Trial(shape, False, reason, defect)
        else:
            reason += "; too many shapes to try another motion on each"
            trials[k] = Trial(shape._replace(reason=reason))


def choose_motion(trial: Trial, motion: str, rotated: RotatedShape, times: Sequence[float]) -> ShapeBlend:
    """Give a shape that is not settled its motion; `auto` is the first without a defect, else that with the least.

    With a defect, `safe` is not taken: a blob that nothing needed is missed more than a crossing. What rests stays
    where it is, and so a shape with a contour that does is not turned as a whole.
    """
    if motion == "auto" and rests(trial.shape):
        rotated = RotatedShape(trial.shape, Alignment(0j, 0j, 1.0, 0.0))
        candidates = {"intrinsic": lambda: _intrinsic(rotated)}
        return _without_defect(trial, candidates, times)
    candidates = {
        "rigid": lambda: _rigid(rotated),
        "intrinsic": lambda: _intrinsic(rotated),
        "safe": lambda: _safe(trial, rotated),
    }
    return candidates[motion]() if motion != "auto" else _without_defect(trial, candidates, times)


def _without_defect(
    trial: Trial, candidates: dict[str, Callable[[], ShapeBlend]], times: Sequence[float]
) -> ShapeBlend:
    """Return the first candidate without a defect, else the one with the least, or straight paths."""
    reasons = [trial.reason]
    defective = [] if trial.defect is None else [(trial.shape, trial.defect)]
    for name, make in candidates.items():
        shape = make()
        defects = [worst_defect(shape, times), _blurred(shape)]
        worst = max(filter(None, defects), key=lambda defect: defect.rank, default=None)
        if worst is None:
            return shape._replace(reason="; ".join(reasons))
        reasons.append(f"{name}: {worst.message}")
        if name != "safe":
            defective.append((shape, worst))
    least, _ = min(defective, key=lambda candidate: candidate[1].rank)
    return least._replace(reason="; ".join(reasons))


def rests(shape: ShapeBlend) -> bool:
    """Return whether a large contour of a shape is the same in place at both ends."""
    matched = [contour for contour in shape.contours if contour.is_matched]
    size = max(contour.scale_a for contour in matched)
    large = (contour for contour in matched if contour.scale_a >= LARGE * size)
    return any(
        float(abs(a - b).max()) <= AT_REST * size for a, b in (contour.dot_points() for contour in large)
    )


def is_as_good(common: Alignment, own: Alignment, shape: ShapeBlend) -> bool:
    """Return whether the similarity of a whole drawing suits one of its shapes about as well as the shape's own."""
    points = point_pairs(shape.contours)
    return residual(points, common) <= COMMON_RESIDUAL * residual(points, own)


# Modules that take long to import, and that most blends do without, are imported where they are used.


def _rigid(rotated: RotatedShape, reason: str = ASKED) -> ShapeBlend:
    return rotated.shape._replace(motion=Rigid(rotated.alignment), reason=reason)


def _intrinsic(rotated: RotatedShape) -> ShapeBlend:
    from shapeblend_cli.motion.intrinsic import intrinsic

    motion = intrinsic(rotated.shape.contours, rotated.alignment)
    return rotated.shape._replace(motion=motion, reason=ASKED)


def _try_safe(shape: ShapeBlend) -> Trial:
    """Settle a shape that `safe` motion need not smooth anywhere."""
    from shapeblend_cli.motion.safe import find_route, follow_route

    route = find_route(shape, align(point_pairs(shape.contours)))
    if route is not None and route.is_level:
        return Trial(follow_route(route)._replace(reason=ASKED))
    return Trial(shape, is_settled=False, route=route)


def _safe(trial: Trial, rotated: RotatedShape) -> ShapeBlend:
    """Take the cheapest route, of the correspondences solved with B as it is and rotated back."""
    from shapeblend_cli.motion.safe import find_route, follow_route

    shape = trial.shape
    route = trial.route or find_route(shape, align(point_pairs(shape.contours)))
    if route is None or not route.is_level:
        most = math.inf if route is None else route.cost
        route = find_route(rotated.shape, rotated.alignment, most) or route
    if route is None:
        return _rigid(rotated, "no way without crossings was found")
    return follow_route(route)._replace(reason=ASKED)


def _blurred(shape: ShapeBlend) -> Defect | None:
    """Return a defect if smoothing takes away too much on the way."""
    levels = getattr(shape.motion, "levels", None)
    if levels is None or levels.max() <= BLURRED_LEVEL:
        return None
    if levels.max() > ROUND_LEVEL:
        return Defect(COLLAPSE, "nothing but round outlines half way")
    return Defect(OVERLAP, "details are smoothed away half way")
