"""What the judge says of a whole blend: how wrong it looks, and what is worst."""

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
    """How wrong a blend looks, and what is worst with it, a phrase; with the numbers of its drawings."""

    wrong: float
    fault: str
    a: int
    b: int

    @property
    def is_poor(self) -> bool:
        """Whether that is worth a word."""
        return self.wrong >= POOR


def verdict(pairs: Sequence[Pair], *, asked_too: bool = False) -> Verdict | None:
    """Return what the judge says of blends: of the worst, the mean over its shapes, by the area that each paints.

    Shapes that the judge did not see, as they come, go or stay, do not count. None if it saw nothing: where a motion
    was asked for, and shapes whose motion was `asked_too` are not to be judged now.
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
