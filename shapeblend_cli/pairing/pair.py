"""Which contour of A becomes which of B."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.model import Box
from shapeblend_cli.pairing.costs import SKIP_COST, FramedContours, pairing_costs
from shapeblend_cli.pairing.decompose import EXTERIOR, HOLE, LINE, PlacedContour
from shapeblend_cli.pairing.opening import open_rings
from shapeblend_cli.pairing.paint_order import paint_order, visible_overlaps
from shapeblend_cli.pairing.split import split_exteriors

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from shapeblend_cli.model import FloatArray
    from shapeblend_cli.pairing.decompose import ContourPair
    from shapeblend_cli.settings import Settings

    Numbers = tuple[int, int]

ROUNDS, REFUSED_COST = 4, 1e6
"""How often contours that could not keep the order of paint get other partners, and the cost of a pair that is refused
for that: more than that of any number of others."""


def pair_contours(
    a: Sequence[PlacedContour],
    b: Sequence[PlacedContour],
    settings: Settings,
    required: Sequence[Numbers] = (),
) -> list[ContourPair]:
    """Pair the contours of two drawings.

    Exteriors are paired with exteriors and open lines with open lines, each set at the least total cost; holes with
    holes inside paired exteriors. As many are paired as possible. Where two paired shapes would have to swap places,
    one now on top and now below, the larger one keeps its partner and the other gets another one, or none. Only if
    the drawings have no kind in common is an exterior paired with an open line.

    Required pairs are pairs whatever they cost, and so are the exteriors of paired holes. Exteriors without a
    partner get pieces with ``unmatched="split"``, or by default where they tile what is cut; pieces have its number.
    The pairs are sorted by A's number.

    Raises
    ------
    MatchError
        Required pairs that name no contour, name one twice, or connect what cannot be paired.
    """
    fixed = _required_partners(a, b, required)
    outer = [[contour for contour in side if contour.role != HOLE] for side in (a, b)]
    kinds: list[tuple[str, ...]] = [(EXTERIOR,), (LINE,)]
    if {contour.role for contour in outer[0]}.isdisjoint(contour.role for contour in outer[1]):
        kinds = [(EXTERIOR, LINE)]
    framed_a, framed_b = (
        FramedContours(side, Box.union([contour.box for contour in side])) for side in outer
    )
    framed = framed_a, framed_b
    pairs = [pair for kind in kinds for pair in _cheapest_pairs(framed, kind, fixed)]
    below = visible_overlaps(a), visible_overlaps(b)
    refused: set[Numbers] = set()
    for _ in range(ROUNDS):
        kept = _without_swaps(pairs, fixed, below)
        if len(kept) == len(pairs):
            break
        settled = {(p.number, q.number) for p, q in kept}
        refused |= {(p.number, q.number) for p, q in pairs} - settled
        again = fixed | dict(settled)
        pairs = [pair for kind in kinds for pair in _cheapest_pairs(framed, kind, again, refused)]
    else:
        pairs = _without_swaps(pairs, fixed, below)
    if settings.unmatched != "point":
        pairs = split_exteriors(a, b, pairs, settings.vertices, always=settings.unmatched == "split")
        pairs = open_rings(a, b, pairs, settings)
    for pair in list(pairs):
        holes_a, holes_b = (
            FramedContours([c for c in side if exterior.contains_hole(c)], exterior.box)
            for side, exterior in zip((a, b), pair, strict=True)
        )
        pairs += _cheapest_pairs((holes_a, holes_b), (HOLE,), fixed)
    return sorted(pairs, key=lambda pair: pair[0].number)


def pair_rotated_contours(
    a: Sequence[PlacedContour],
    b: Sequence[PlacedContour],
    settings: Settings,
    required: Sequence[Numbers],
    rotation: float,
) -> list[ContourPair]:
    """Pair contours as if B were rotated back by an angle, its largest contour laid over A's; see `pair_contours`."""
    if not rotation:
        return pair_contours(a, b, settings, required)
    in_a, in_b = (max(side, key=lambda c: c.size).polygon.vertices.mean() for side in (a, b))
    back = Similarity.rotation(-rotation, about=in_b, onto=in_a)
    there = Similarity.rotation(rotation, about=in_a, onto=in_b)
    upright = [contour.transformed(back) for contour in b]
    as_drawn = {contour.number: contour for contour in b}
    return [
        (p, q.transformed(there) if q.is_piece else as_drawn[q.number])
        for p, q in pair_contours(a, upright, settings, required)
    ]


def _cheapest_pairs(
    framed: tuple[FramedContours, FramedContours],
    roles: tuple[str, ...],
    fixed: dict[int, int],
    refused: Collection[Numbers] = (),
) -> list[ContourPair]:
    """Pair the contours of some roles at the least total cost, those that are fixed first, none that is refused."""
    sides = [[contour for contour in side.contours if contour.role in roles] for side in framed]
    in_b = {contour.number: contour for contour in sides[1]}
    pairs = [
        (contour, in_b[fixed[contour.number]]) for contour in sides[0] if fixed.get(contour.number) in in_b
    ]
    taken = {p.number for p, _ in pairs}, {q.number for _, q in pairs}
    a, b = (
        side._replace(contours=[contour for contour in contours if contour.number not in numbers])
        for side, contours, numbers in zip(framed, sides, taken, strict=True)
    )
    if not a.contours or not b.contours:
        return pairs
    allowed = np.array([[(p.number, q.number) not in refused for q in b.contours] for p in a.contours])
    if allowed.size == 1:
        assigned = [(0, 0)]
    else:
        costs = pairing_costs(a, b)
        # Larger contours are cheaper on the side that has more, so that what is left out is small.
        if len(a.contours) < len(b.contours):
            costs -= SKIP_COST * b.sizes()
        elif len(a.contours) > len(b.contours):
            costs -= SKIP_COST * a.sizes()[:, None]
        assigned = assign(np.where(allowed, costs, REFUSED_COST))
    return pairs + [(a.contours[i], b.contours[j]) for i, j in assigned if allowed[i, j]]


def assign(costs: FloatArray) -> list[tuple[int, int]]:
    """Pair the rows of finite costs with columns at the least total: as many as there are of the fewer, by row."""
    if min(costs.shape) == 0:
        return []
    if 1 in costs.shape:
        return [divmod(int(costs.argmin()), costs.shape[1])]
    import lap  # most drawings that are blended have one exterior and no need of it

    _, columns, _ = lap.lapjv(np.ascontiguousarray(costs), extend_cost=True)
    return [(i, int(j)) for i, j in enumerate(columns) if j >= 0]


def _without_swaps(
    pairs: Sequence[ContourPair], fixed: dict[int, int], below: tuple[list[Numbers], list[Numbers]]
) -> list[ContourPair]:
    """Return the pairs that can keep the order of paint; of two that cannot both, what is fixed, or the larger."""

    def fits(some: Sequence[ContourPair]) -> bool:
        return paint_order([(p.shape, q.shape) for p, q in some], *below) is not None

    if fits(pairs):
        return list(pairs)
    kept = [pair for pair in pairs if pair[0].number in fixed]
    others = [pair for pair in pairs if pair[0].number not in fixed]
    others.sort(key=lambda pair: -pair[0].size * pair[1].size)
    waiting = [others]
    while waiting:  # by halves, since most of them fit
        some = waiting.pop()
        if fits([*kept, *some]):
            kept += some
        elif len(some) > 1:
            waiting += [some[len(some) // 2 :], some[: len(some) // 2]]
    return kept


def _required_partners(
    a: Sequence[PlacedContour], b: Sequence[PlacedContour], required: Sequence[Numbers]
) -> dict[int, int]:
    """Return B's number for each of A's that is required, and for the exteriors around required holes."""
    in_a, in_b = ({contour.number: contour for contour in side} for side in (a, b))
    partners: dict[int, int] = {}

    def add(i: int, j: int) -> None:
        if partners.get(i, j) != j or any(other != i and partners[other] == j for other in partners):
            raise MatchError(f"{i}={j} contradicts another pair; each contour has one partner")
        partners[i] = j

    for i, j in required:
        for number, side, name in ((i, in_a, "A"), (j, in_b, "B")):
            if number not in side:
                most = max(side)
                raise MatchError(f"{name} has no contour {number} to match; its contours are 0 to {most}")
        p, q = in_a[i], in_b[j]
        if (p.role == HOLE) != (q.role == HOLE) or (p.role != q.role and LINE in (p.role, q.role)):
            raise MatchError(
                f"contour {i} of A is {_named(p)} and contour {j} of B {_named(q)}; two of a kind would work"
            )
        add(i, j)
        if p.exterior is not None and q.exterior is not None:
            add(p.exterior, q.exterior)
    return partners


def _named(contour: PlacedContour) -> str:
    names = {EXTERIOR: "an outline", HOLE: f"a hole in contour {contour.exterior}", LINE: "an open line"}
    return names[contour.role]
