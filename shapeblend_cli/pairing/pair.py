"""Which contour of A becomes which of B."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.model import Box
from shapeblend_cli.pairing.assign import assign
from shapeblend_cli.pairing.costs import SKIP_COST, View, costs
from shapeblend_cli.pairing.decompose import EXTERIOR, HOLE, LINE, PlacedContour
from shapeblend_cli.pairing.paint_order import paint_order, visible_overlaps
from shapeblend_cli.pairing.split import split_exteriors

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from shapeblend_cli.constants import WorkConstants
    from shapeblend_cli.model import FloatArray
    from shapeblend_cli.settings import Settings

    Numbers = tuple[int, int]
    Couple = tuple[PlacedContour, PlacedContour]

ROUNDS = 4
"""How often contours that could not keep the order of paint get other partners."""

NEVER = 1e6
"""Cost of a pair that is refused: more than that of any number of others."""


def pair_contours(
    a: Sequence[PlacedContour], b: Sequence[PlacedContour], settings: Settings, given: Sequence[Numbers] = ()
) -> list[Couple]:
    """Pair the contours of two drawings.

    Outlines are paired with outlines and open lines with open lines, each set at the least total cost. Holes are
    paired with holes inside paired outlines. As many are paired as can be. Where two paired shapes would have to swap
    places, one now on top and now below, the larger one keeps its partner and the other gets another one, or none. Only
    where the drawings have no kind in common is an outline paired with an open line.

    Parameters
    ----------
    a, b : sequence of PlacedContour
        The contours of each drawing, at least one, B's laid over A.
    settings : Settings
    given : sequence of (int, int)
        Numbers of contours that are pairs whatever they cost; the outlines of paired holes are, too.

    Returns
    -------
    list of (PlacedContour, PlacedContour)
        By A's number. Pieces, if outlines without a partner are to have them, go by the number of what was cut.

    Raises
    ------
    MatchError
        Given pairs that name no contour, name one twice, or join what cannot be joined.
    """
    constants = settings.constants
    fixed = _checked(a, b, given)
    tops_a, tops_b = ([part for part in parts if part.role != HOLE] for parts in (a, b))
    kinds: list[tuple[str, ...]] = [(EXTERIOR,), (LINE,)]
    if {part.role for part in tops_a}.isdisjoint(part.role for part in tops_b):
        kinds = [(EXTERIOR, LINE)]
    frames = [Box.union([part.box for part in parts]) for parts in (tops_a, tops_b)]
    views = View(tops_a, frames[0]), View(tops_b, frames[1])
    couples = [couple for kind in kinds for couple in _pairs(views, kind, constants, fixed)]
    below = visible_overlaps(a), visible_overlaps(b)
    refused: set[Numbers] = set()
    for _ in range(ROUNDS):
        kept = _without_swaps(couples, fixed, below)
        if len(kept) == len(couples):
            break
        settled = {(p.number, q.number) for p, q in kept}
        refused |= {(p.number, q.number) for p, q in couples} - settled
        again = fixed | dict(settled)
        couples = [couple for kind in kinds for couple in _pairs(views, kind, constants, again, refused)]
    else:
        couples = _without_swaps(couples, fixed, below)
    if settings.unmatched == "split":
        couples = split_exteriors(a, b, couples, settings.vertices)
    for outer_a, outer_b in list(couples):
        holes_a, holes_b = (
            [p for p in parts if outer.has(p)] for parts, outer in ((a, outer_a), (b, outer_b))
        )
        inside = View(holes_a, outer_a.box), View(holes_b, outer_b.box)
        couples += _pairs(inside, (HOLE,), constants, fixed)
    return sorted(couples, key=lambda couple: couple[0].number)


def _pairs(
    views: tuple[View, View],
    roles: tuple[str, ...],
    constants: WorkConstants,
    fixed: dict[int, int],
    refused: Collection[Numbers] = (),
) -> list[Couple]:
    """Pair the contours of some roles at the least total cost, those that are fixed first, none that is refused."""
    sides = [View([part for part in view.parts if part.role in roles], view.frame) for view in views]
    of_b = {part.number: part for part in sides[1].parts}
    couples = [(part, of_b[fixed[part.number]]) for part in sides[0].parts if fixed.get(part.number) in of_b]
    taken = {part.number for part, _ in couples}, {part.number for _, part in couples}
    free = [
        view._replace(parts=[part for part in view.parts if part.number not in numbers])
        for view, numbers in zip(sides, taken, strict=True)
    ]
    if not free[0].parts or not free[1].parts:
        return couples
    a, b = free[0].parts, free[1].parts
    allowed = np.array([[(p.number, q.number) not in refused for q in b] for p in a])
    if len(a) == len(b) == 1:
        found = [(0, 0)]
    else:
        table = _less_what_is_saved(costs(free[0], free[1], constants), free[0], free[1])
        found = assign(np.where(allowed, table, NEVER))
    return couples + [(a[i], b[j]) for i, j in found if allowed[i, j]]


def _less_what_is_saved(table: FloatArray, a: View, b: View) -> FloatArray:
    """Make it cheaper to pair the larger contours of the side that has more: what is left out had better be small."""
    if len(a.parts) < len(b.parts):
        return table - SKIP_COST * b.sizes()
    if len(a.parts) > len(b.parts):
        return table - SKIP_COST * a.sizes()[:, None]
    return table


def _without_swaps(
    couples: Sequence[Couple], fixed: dict[int, int], below: tuple[list[Numbers], list[Numbers]]
) -> list[Couple]:
    """The couples that can keep the order of paint; of two that cannot both, what is fixed, or the larger."""

    def fits(some: Sequence[Couple]) -> bool:
        return paint_order([(p.shape, q.shape) for p, q in some], *below) is not None

    if fits(couples):
        return list(couples)
    kept = [couple for couple in couples if couple[0].number in fixed]
    others = [couple for couple in couples if couple[0].number not in fixed]
    others.sort(key=lambda couple: -couple[0].size * couple[1].size)
    waiting = [others]
    while waiting:  # by halves, since most of them fit
        some = waiting.pop()
        if fits([*kept, *some]):
            kept += some
        elif len(some) > 1:
            waiting += [some[len(some) // 2 :], some[: len(some) // 2]]
    return kept


def _checked(
    a: Sequence[PlacedContour], b: Sequence[PlacedContour], given: Sequence[Numbers]
) -> dict[int, int]:
    """The pairs that were given, and those of the outlines around holes."""
    parts = tuple({part.number: part for part in side} for side in (a, b))
    fixed: dict[int, int] = {}

    def add(i: int, j: int) -> None:
        if fixed.get(i, j) != j or any(other != i and fixed[other] == j for other in fixed):
            raise MatchError(f"{i}={j} contradicts another pair; each contour has one partner")
        fixed[i] = j

    for i, j in given:
        for number, side, name in ((i, parts[0], "A"), (j, parts[1], "B")):
            if number not in side:
                most = max(side)
                raise MatchError(f"{name} has no contour {number} to match; its contours are 0 to {most}")
        p, q = parts[0][i], parts[1][j]
        if (p.role == HOLE) != (q.role == HOLE) or (p.role != q.role and LINE in (p.role, q.role)):
            raise MatchError(
                f"contour {i} of A is {_named(p)} and contour {j} of B {_named(q)}; two of a kind would work"
            )
        add(i, j)
        if p.exterior is not None and q.exterior is not None:
            add(p.exterior, q.exterior)
    return fixed


def _named(part: PlacedContour) -> str:
    return {EXTERIOR: "an outline", HOLE: f"a hole in contour {part.exterior}", LINE: "an open line"}[
        part.role
    ]
