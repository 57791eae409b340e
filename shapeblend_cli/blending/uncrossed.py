"""Other ways to match outlines that would cross themselves on their way, or lose much of their area.

The least work knows nothing of what lies across: a gap closes from the wrong side, or the two sides of a limb change
places. With other constants of the work the outlines mostly take another way round.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapeblend_cli.blending.graded import BETTER, faults_of
from shapeblend_cli.blending.swaps.swapped import is_swapped
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.interpolate.paths import expect, paths_at, segments_at
from shapeblend_cli.motion.choose import ASKED, CHECKED_TIMES, OTHERS_CROSS, crosses_at
from shapeblend_cli.motion.rigid import Whole

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.blending.matched import PairedDrawings
    from shapeblend_cli.model import Box, ShapeBlend, Shapes

SUSPECT = 0.1
"""Minimum fault of a shape's outlines for them to be looked at: what hardly changes does not cross."""

WAYS: tuple[tuple[dict[str, Any], ...], ...] = (
    tuple({"k_t": stiffness} for stiffness in (20.0, 40.0, 70.0, 120.0, 200.0, 400.0, 800.0)),
    (
        {"k_t": 20.0, "k_b": 0.2},
        {"k_t": 100.0, "k_b": 0.2},
        {"k_b": 0.5},
        {"k_t": 100.0, "k_b": 0.5},
        {"k_b": 2.0},
        {"k_t": 40.0, "k_b": 2.0},
        {"k_b": 4.0},
        {"k_t": 20.0, "k_b": 4.0},
    ),
    tuple({"motion": "intrinsic"} | way for way in ({}, {"k_t": 20.0}, {"k_t": 100.0})),
)
"""Settings that are tried, until a group of them has one without faults: stiffnesses against travel, with those against
bending, and motion by lengths and angles."""

WORSE = 0.15
"""Maximum disadvantage of a blend without crossings over one with them for it to be taken, in faults."""

LEAST_AREA = 0.7
"""Minimum area of an in-between, as a share of an even change, for no other way to be tried."""

LOOKED_AT = (0.0, 0.2, 0.4, 0.5, 0.6, 0.8, 1.0)
"""Times at which areas are compared."""

LITTLE = 0.02
"""Maximum weighted fault in the area of outlines that keep theirs at all times."""

MOST = 12
"""Maximum number of contours of a drawing for which other ways are tried."""

MOST_CROSSED = 7
"""Maximum number of times at which contours cross themselves, over all of these, for other ways to be tried: those that
cross more often hardly ever stop."""

AFFORDABLE = 1_000_000
"""Maximum number of dots in the graphs of all pairs of contours and of all ways together; else only some of each group
are tried."""


class Fault(NamedTuple):
    """What is wrong with the outlines of a blend."""

    crossed: int = 0  # at how many of the times that are checked a contour crosses itself, over all contours
    is_lost: bool = False  # too much area

    def is_less(self, other: Fault) -> bool:
        """Return whether less is wrong than with another blend, and nothing more."""
        return self != other and self.crossed <= other.crossed and self.is_lost <= other.is_lost


def with_crossings_undone(
    usual: Shapes, pair: Callable[[], PairedDrawings], move: Callable[[PairedDrawings], Shapes], view: Box
) -> Shapes:
    """Return a blend of two drawings of one colour, or another one in which no outline crosses itself.

    `pair` pairs their contours, and `move` blends paired drawings; the blends are graded in a view.
    """
    if is_swapped(usual) or any(map(_is_other, usual)) or not _are_suspect(usual):
        return usual
    fault = fault_of(usual)
    if not any(fault) or fault.crossed > MOST_CROSSED:
        return usual
    paired = pair()
    if paired.is_fixed or max(len(paired.a.contours), len(paired.b.contours)) > MOST:
        return usual
    faults = faults_of(usual, view)
    clean, better = _limits(usual, faults)
    found, least = usual, (fault, np.inf)
    share = min(1.0, AFFORDABLE / max(_dots(paired) * sum(map(len, WAYS)), 1))
    for ways in WAYS:
        for way in ways[: round(share * len(ways))]:
            if any(paired.settings.is_given(name) for name in ("k_t", "k_b") if name in way):
                continue
            shapes = move(paired._replace(settings=paired.settings.replace(**way)))
            its = fault_of(shapes)
            if its != fault and (its == least[0] or its.is_less(least[0])):
                its_faults = faults_of(shapes, view)
                is_taken = its_faults <= (better if its.crossed else clean)
                if is_taken and (its != least[0] or its_faults < least[1]):
                    found, least = shapes, (its, its_faults)
        if not any(least[0]):
            break
    return found if found is usual else tuple(map(_with_reason, found))


def _dots(paired: PairedDrawings) -> int:
    """Return the number of dots in the graphs of all pairs."""
    return sum(len(p.polygon.vertices) * len(q.polygon.vertices) for (p, q), _ in paired.pairs.values())


def _limits(shapes: Shapes, faults: float) -> tuple[float, float]:
    """Return the faults up to which a blend is taken without crossings, and with fewer, in place of one with so many.

    Crossings of a hair hardly show.
    """
    is_seen = any(dict(shape.taken.terms)["folds"] > 0.0 for shape in shapes if shape.taken is not None)
    return faults + (WORSE if is_seen else 0.0), faults - BETTER


def _is_other(shape: ShapeBlend) -> bool:
    """Return whether a shape is a pen line, which has no outline, or is turned over as a whole."""
    return (
        shape.style_a.stroke is not None
        or shape.style_b.stroke is not None
        or isinstance(shape.motion, Whole)
    )


def _with_reason(shape: ShapeBlend) -> ShapeBlend:
    return shape._replace(reason=OTHERS_CROSS) if shape.reason == ASKED else shape


def _are_suspect(shapes: Shapes) -> bool:
    """Return whether outlines may cross themselves, by the judge of outlines, which has looked at most of them."""
    return any(shape.is_matched and (shape.taken is None or shape.taken.wrong >= SUSPECT) for shape in shapes)


def fault_of(shapes: Shapes) -> Fault:
    """Return what is wrong with the outlines of a blend."""
    filled = [shape for shape in shapes if shape.style_a.fill is not None or shape.style_b.fill is not None]
    crossed = sum(_crossed(shape) for shape in filled)
    return Fault(crossed, _is_lost(filled))


def _crossed(shape: ShapeBlend) -> int:
    """Return at how many times contours of a shape cross themselves, unless they do so at an end, over all of these."""
    expect(shape, CHECKED_TIMES)
    if len(shape.contours) == 1:  # which has been asked of most motions that were chosen
        counts = [sum(crosses_at(shape, t) for t in CHECKED_TIMES)] if shape.contours[0].start.closed else [0]
    else:
        every = [paths_at(shape, t) for t in CHECKED_TIMES]
        counts = [
            sum(path_crossings([path], 1) for path in paths) if paths[0].closed else 0
            for paths in zip(*every, strict=True)
        ]
    return sum(
        count
        for count, contour in zip(counts, shape.contours, strict=True)
        if count > 0 and not any(path_crossings([path], 1) for path in (contour.start, contour.end))
    )


def _keeps_area(shape: ShapeBlend) -> bool:
    """Return whether a shape loses hardly any area, by the judge of outlines."""
    is_whole = all(contour.is_matched for contour in shape.contours)
    return is_whole and shape.taken is not None and dict(shape.taken.terms)["area"] < LITTLE


def _is_lost(shapes: Sequence[ShapeBlend]) -> bool:
    """Return whether an in-between of shapes lacks area."""
    if all(_keeps_area(shape) for shape in shapes):
        return False
    areas = np.array(
        [
            sum(abs(cubics.signed_area(segments)) for shape in shapes for segments in segments_at(shape, t))
            for t in LOOKED_AT
        ]
    )
    even = areas[0] + np.array(LOOKED_AT) * (areas[-1] - areas[0])
    return bool((areas < LEAST_AREA * even).any())
