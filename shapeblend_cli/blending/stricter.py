"""Pairings in which contours rather have no partner than an unlike one, where the judge prefers them.

The ordinary costs pair as much as they can, and in a drawing of many coloured parts that may be too much: a heart that
comes loose becomes a brow. Whether such a pair reads as a change or as a mistake is seen only in the picture.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.anatomy.decompose import EXTERIOR
from shapeblend_cli.blending.graded import FINE, grade_of_shapes
from shapeblend_cli.blending.matched import pair_drawings
from shapeblend_cli.pairing.costs import ALONE_COST, PAINT_WEIGHT, Rates
from shapeblend_cli.pairing.riders import riders

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.blending.matched import PairedDrawings
    from shapeblend_cli.model import Box, ShapeBlend

    Shapes = tuple[ShapeBlend, ...]

STRICTER = (Rates(paint=1.5 * PAINT_WEIGHT), Rates(alone=ALONE_COST - 0.13), Rates(alone=ALONE_COST - 0.23))
"""Costs of pairings that are tried: another colour counts more, or it costs less to have no partner."""

PREFERRED = 0.05
"""Minimum advantage of a stricter pairing over the ordinary one for it to be taken, in grades."""

MOST_STEPS = 1000
"""Maximum number of steps that are kept for the other pairings."""

AFFORDABLE = 80
"""Maximum number of contours of a drawing of which other pairings are tried."""


def with_steps_kept(paired: PairedDrawings) -> PairedDrawings:
    """Let a blend keep its steps where other pairings may be tried: most of the pairs are in all of them."""
    return paired._replace(progress=paired.progress.keeping(MOST_STEPS)) if _has_others(paired) else paired


def with_stricter_pairs(
    paired: PairedDrawings,
    usual: Shapes,
    move: Callable[[PairedDrawings], Shapes],
    view: Box,
    works: dict[tuple[int, int], float],
) -> tuple[PairedDrawings, Shapes]:
    """Return paired drawings and their blend, or those of a stricter pairing that the judge prefers in a view.

    `move` blends paired drawings, and `works` are those that the ordinary pairing has found.
    """
    a, b = paired.a, paired.b
    if not _has_others(paired):
        return paired, usual
    best = grade_of_shapes(usual, view)
    if best <= FINE:
        return paired, usual
    seen = [_partners(paired)]
    found = paired, usual
    for rates in STRICTER:
        other = pair_drawings(a, b, paired.settings, 0.0, paired.progress, rates=rates._replace(works=works))
        if _partners(other) in seen:
            continue
        seen.append(_partners(other))
        shapes = move(other)
        grade = grade_of_shapes(shapes, view)
        if grade < best - (PREFERRED if found[0] is paired else 0.0):
            best, found = grade, (other, shapes)
    other = _without_torn_lines(found[0])
    if _partners(other) in seen:
        return found
    shapes = move(other)
    return (other, shapes) if grade_of_shapes(shapes, view) < best - PREFERRED else found


def _without_torn_lines(paired: PairedDrawings) -> PairedDrawings:
    """Leave strokes on the edges of fills that have no partner without one, too: both then move as one."""
    torn = []
    for side, contours in enumerate((paired.a.contours, paired.b.contours)):
        known = {numbers[side] for numbers in paired.pairs}
        alone = {c.number for c in contours if c.role == EXTERIOR and c.style.fill is not None} - known
        torn.append(riders(contours, alone))
    kept = {
        numbers: each
        for numbers, each in paired.pairs.items()
        if not any(number in lines for number, lines in zip(numbers, torn, strict=True))
    }
    return paired._replace(pairs=kept)


def _partners(paired: PairedDrawings) -> set[tuple[int | None, int | None, bool]]:
    return {(*numbers, any(one.is_piece for one in pair)) for numbers, (pair, _) in paired.pairs.items()}


def _has_others(paired: PairedDrawings) -> bool:
    """Return whether other pairings may be tried: where pairs are free, and not all parts are painted alike."""
    sides = paired.a.contours, paired.b.contours
    is_fixed = paired.changes or paired.required or paired.settings.unmatched != "auto"
    if is_fixed or max(map(len, sides)) > AFFORDABLE:
        return False
    return all(len({contour.style.paints for contour in side}) > 1 for side in sides)
