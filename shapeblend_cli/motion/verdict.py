"""The judge's verdict on a whole blend: how wrong it looks, and its worst fault."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Box, Candidate
from shapeblend_cli.motion.choose import ASKED, candidate_of
from shapeblend_cli.motion.judge import TIMES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Pair, ShapeBlend

POOR = 0.4
"""Minimum fault of a blend that looks poor."""

FAULTS = {
    "sweep": "parts go a long way round",
    "strain": "limbs shrink or swell while they turn",
    "stretch": "the outlines have little in common, and melt",
    "area": "area is lost or gained on the way",
    "symmetry": "a symmetry of both drawings is lost",
    "folds": "outlines turn over or cross",
    "limbs": "limbs get too thin or too fat",
    "view": "something leaves the view",
    "alone": "much of what is drawn comes from nothing, or goes",
    "shrinks": "lines get shorter or longer on the way",
    "melts": "lines have little in common, and melt",
}
"""Faults that the terms of the judge measure, and the last three those of pen lines, as people see them."""

ALONE = 0.5
"""Fault of a pen line without a partner. Where four fifths of the ink have none, the blend is poor."""


class Verdict(NamedTuple):
    """The verdict on a pair of drawings."""

    wrong: float  # the mean of its shapes' faults
    fault: str  # the worst, a phrase
    a: int  # numbers of the drawings
    b: int

    @property
    def is_poor(self) -> bool:
        """Whether people should be told."""
        return self.wrong >= POOR


def verdict(pairs: Sequence[Pair], *, asked_too: bool = False) -> Verdict | None:
    """Return the verdict on the worst of several pairs: the mean of its shapes' faults, by the areas that they paint.

    Pen lines count by simple measures. Other shapes that were not judged, as they come, go or stay, do not count;
    shapes whose motion was asked for are judged now if they are `asked_too`. None without any.
    """
    found = [one for pair in pairs if (one := _of_pair(pair, asked_too))]
    return max(found, key=lambda one: one.wrong, default=None)


def _of_pair(pair: Pair, asked_too: bool) -> Verdict | None:
    view = Box.union(list(pair.views))
    taken = [shape.taken for shape in pair.each_shape if shape.taken is not None]
    if asked_too:
        taken += [candidate_of(shape, view) for shape in pair.each_shape if shape.reason == ASKED]
    taken += [_line_of(shape) for shape in pair.each_shape if any(shape.contours[0].lines)]
    painted = sum(one.painted for one in taken)
    if painted == 0.0:
        return None
    terms = dict.fromkeys(FAULTS, 0.0)
    for one in taken:
        for name, amount in one.terms:
            terms[name] += amount * one.painted / painted
    worst = max(terms, key=terms.__getitem__)
    return Verdict(round(sum(terms.values()), 3), FAULTS[worst], pair.a, pair.b)


def _line_of(shape: ShapeBlend) -> Candidate:
    """Judge pen lines: whether they have partners, keep their length, and do not melt; by the ink that they take."""
    edges = [
        np.concatenate([np.abs(path.segments[:, 3] - path.segments[:, 0]) for path in paths_at(shape, t)])
        for t in (shape.time_of(float(own)) for own in TIMES)
    ]
    lengths = np.array([each.sum() for each in edges])
    longest = max(lengths[0], lengths[-1], 1e-12)
    widths = [style.stroke_width for style in (shape.style_a, shape.style_b)]
    terms = dict.fromkeys(("alone", "shrinks", "melts"), 0.0)
    if not shape.is_matched:
        terms["alone"] = ALONE
    elif min(lengths[0], lengths[-1]) > 0.0:
        even = (1.0 - TIMES) * lengths[0] + TIMES * lengths[-1]
        terms["shrinks"] = float(np.abs(lengths - even).mean() / longest)
        terms["melts"] = float(np.abs(edges[0] / lengths[0] - edges[-1] / lengths[-1]).sum()) / 2.0
    wrong = round(float(sum(terms.values())), 4)
    return Candidate(shape.motion_name, wrong, tuple(terms.items()), float(longest) * max(widths))
