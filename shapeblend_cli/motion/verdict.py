"""The judge's verdict on a whole blend: how wrong it looks, and its worst fault."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.model import Box
from shapeblend_cli.motion.choose import ASKED, candidate_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Pair

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
}
"""Faults that the terms of the judge measure, as people see them."""


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

    Shapes that were not judged, as they come, go or stay, do not count; shapes whose motion was asked for are judged
    now if they are `asked_too`. None without any.
    """
    found = [one for pair in pairs if (one := _of_pair(pair, asked_too))]
    return max(found, key=lambda one: one.wrong, default=None)


def _of_pair(pair: Pair, asked_too: bool) -> Verdict | None:
    view = Box.union(list(pair.views))
    taken = [shape.taken for shape in pair.each_shape if shape.taken is not None]
    if asked_too:
        taken += [candidate_of(shape, view) for shape in pair.each_shape if shape.reason == ASKED]
    painted = sum(one.painted for one in taken)
    if painted == 0.0:
        return None
    terms = dict.fromkeys(FAULTS, 0.0)
    for one in taken:
        for name, amount in one.terms:
            terms[name] += amount * one.painted / painted
    worst = max(terms, key=terms.__getitem__)
    return Verdict(round(sum(terms.values()), 3), FAULTS[worst], pair.a, pair.b)
