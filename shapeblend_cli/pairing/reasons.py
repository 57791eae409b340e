"""Reasons for pairs of contours, for the report; `changes` has the reasons for shapes that change in place."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair, PlacedContour
    from shapeblend_cli.model import ContourBlend
    from shapeblend_cli.pairing.assignment import Pairing

    Numbers = tuple[int, int]


class Reasons(NamedTuple):
    """The reasons for pairs of contours, and the parent of each contour, by number."""

    of_pairs: Mapping[Numbers, str]
    parents: tuple[Mapping[int, int], Mapping[int, int]]
    riders: tuple[Mapping[int, int], Mapping[int, int]]

    def added_to(self, blend: ContourBlend) -> ContourBlend:
        """Return a blend with its reason and its parents."""
        a, b = blend.a, blend.b
        fills = [
            side[number]
            for side, number in zip(self.riders, (a, b), strict=True)
            if number is not None and number in side
        ]
        if blend.reason:
            reason = blend.reason
        elif fills:
            reason = f"a stroke on the edge of {fills[0]}"
        elif a is not None and b is not None:
            reason = self.of_pairs[a, b]
        else:
            reason = f"{'B' if b is None else 'A'} has nothing like it there"
        in_a, in_b = (
            None if number is None else parents.get(number)
            for number, parents in zip((a, b), self.parents, strict=True)
        )
        return blend._replace(reason=reason, parents=(in_a, in_b))


def reasons_for(
    a: Sequence[PlacedContour],
    b: Sequence[PlacedContour],
    pairs: Sequence[ContourPair],
    required: Collection[Numbers],
    riders: tuple[Mapping[int, int], Mapping[int, int]],
) -> Reasons:
    """Return the reasons for pairs of contours, some required by users, and the parents of contours.

    Riders are numbers of strokes, with the numbers of the fills on whose edges they lie.
    """
    if len(a) == len(b) == 1:
        return Reasons({(a[0].number, b[0].number): "the only ones"}, ({}, {}), riders)
    from shapeblend_cli.pairing.assignment import Pairing

    whole = {p.number: q.number for p, q in pairs if not (p.is_piece or q.is_piece)}
    pairing = Pairing(a, b, whole)
    found = {
        (p.number, q.number): "a piece cut for it" if p.opened is q.opened else "a ring that opens for it"
        for p, q in pairs
        if p.is_piece or q.is_piece
    }
    inside = Counter(pairing.a.structure.parent), Counter(pairing.b.structure.parent)
    for i, j in pairing.partner.items():
        numbers = a[i].number, b[j].number
        found[numbers] = "asked for" if numbers in required else _reason(pairing, i, j, inside)
    parents = [
        {
            contour.number: contours[parent].number
            for contour, parent in zip(contours, side.structure.parent, strict=True)
            if parent is not None
        }
        for contours, side in ((a, pairing.a), (b, pairing.b))
    ]
    return Reasons(found, (parents[0], parents[1]), riders)


def _reason(pairing: Pairing, i: int, j: int, inside: tuple[Counter[int | None], Counter[int | None]]) -> str:
    """Return the reason for a pair, given the numbers of contours that lie directly inside each."""
    a, b = pairing.a, pairing.b
    contours_a, contours_b = a.described.contours, b.described.contours
    if a.mirror and b.mirror and a.has_twin(i) and b.has_twin(j):
        other = a.mirror.twin[i]
        if other is not None and pairing.partner.get(other) == b.mirror.twin[j]:
            return f"twin of {contours_a[other].number}={contours_b[pairing.partner[other]].number}"
    (part_a, _), (part_b, _) = a.part(i), b.part(j)
    if part_a >= 0 and a.onto[part_a] == part_b and inside[0][part_a] == inside[1][part_b] == 1:
        return f"the only ones inside {contours_a[part_a].number}={contours_b[part_b].number}"
    share = round(100 * pairing.overlap(i, j))
    return f"overlaps {share} %" if share else "the nearest of its kind"
