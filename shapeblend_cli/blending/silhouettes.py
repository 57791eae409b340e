"""Other ways to match the outlines of one colour in which much goes wrong, where the judge prefers them.

Silhouettes of animals and things have limbs, and what is cut out of them by slots in one drawing is one body in the
other. The ordinary way takes one leg for another, or lets a head shrink beside the neck from which another one grows.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from shapeblend_cli.blending.graded import BETTER, FINE, grade_of_shapes, is_suspect
from shapeblend_cli.blending.matched import pair_drawings
from shapeblend_cli.blending.pairings import partners_in
from shapeblend_cli.blending.plates.inverted import is_plain
from shapeblend_cli.pairing.costs import Rates

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from shapeblend_cli.blending.matched import PairedDrawings
    from shapeblend_cli.model import Box, ShapeBlend

    Shapes = tuple[ShapeBlend, ...]

IN_PLACE = 20.0
"""Stiffness against travel with which points stay where they are, as far as they can."""

TORN = 0.25
"""Minimum advantage of a blend in which outlines are cut to pieces, in grades: it opens slots."""

WAYS: tuple[tuple[Mapping[str, Any], float], ...] = (
    ({"k_t": IN_PLACE}, BETTER),
    ({"unmatched": "split"}, TORN),
    ({"k_t": IN_PLACE, "unmatched": "split"}, TORN),
)
"""Settings that are tried, with what each has to gain to be taken, in grades."""


def with_other_matches(
    paired: PairedDrawings,
    usual: Shapes,
    move: Callable[[PairedDrawings], Shapes],
    view: Box,
    works: dict[tuple[int, int], float],
) -> tuple[PairedDrawings, Shapes]:
    """Return paired drawings and their blend, or those of another way to match that the judge prefers in a view.

    `move` blends paired drawings, and `works` are those that the ordinary pairing has found. Ways differ in a constant
    of the wire, in whether parts split, or in both.
    """
    found = paired, usual
    is_fixed = paired.changes or paired.required or paired.copies is not None
    if is_fixed or not (is_suspect(usual) and is_plain(paired.a) and is_plain(paired.b)):
        return found
    best = grade_of_shapes(usual, view)
    if best <= FINE:
        return found
    seen = [(paired.settings.k_t, partners_in(paired))]
    for changed, gain in WAYS:
        if any(paired.settings.is_given(name) for name in changed):
            continue
        settings = paired.settings.replace(**changed)
        other = pair_drawings(paired.a, paired.b, settings, 0.0, paired.progress, rates=Rates(works=works))
        way = settings.k_t, partners_in(other)
        if way not in seen:
            seen.append(way)
            shapes = move(other)
            grade = grade_of_shapes(shapes, view) + gain
            if grade < best:
                best, found = grade, (other, shapes)
    return found
