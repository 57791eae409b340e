"""Pairs of contours: which contour of A becomes which contour of B."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

from shapeblend_cli.anatomy.decompose import EXTERIOR, HOLE, LINE, PlacedContour
from shapeblend_cli.errors import MatchError
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.pairing.costs import USUAL, Rates

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair
    from shapeblend_cli.model import Box
    from shapeblend_cli.options.settings import Settings

    Numbers = tuple[int, int]

MOST_HOLES = 12
"""Maximum number of holes that are looked through for those that pass through each other."""

PASSING_TIMES = tuple(k / 8 for k in range(9))
"""Times at which that is looked up."""


def pair_contours(
    a: Sequence[PlacedContour],
    b: Sequence[PlacedContour],
    settings: Settings,
    required: Sequence[Numbers] = (),
    *,
    frames: tuple[Box, Box] | None = None,
    rates: Rates = USUAL,
) -> list[ContourPair]:
    """Pair the contours of two drawings, from the outermost in, each time at the least total cost.

    The place of a contour is relative to the part around it, laid over the partner of that part. Exteriors are paired
    with exteriors, open lines with open lines, and holes with holes inside paired exteriors; an exterior is paired with
    an open line only if the drawings have no kind in common. A contour stays without a partner if all partners cost
    more than that. One pair is made in any case, unless the contours are the rest of drawings whose other contours are
    decided; then `frames` are the boxes of the whole drawings.

    Required pairs are made whatever they cost, and so are pairs of the exteriors of paired holes. Exteriors without a
    partner get pieces with ``unmatched="split"``, or by default if they tile the exterior that is cut; pieces have the
    number of that exterior. Pairs are sorted by A's number.

    Raises
    ------
    MatchError
        Required pairs that name no contour, name a contour twice, or connect contours that cannot be paired.
    """
    fixed = _required_partners(a, b, required)
    if len(a) == len(b) == 1 and frames is None:
        return [(a[0], b[0])]
    from shapeblend_cli.pairing.assignment import Pairing
    from shapeblend_cli.pairing.split import pairs_by_rows

    is_free = settings.unmatched == "auto" and not fixed and frames is None
    pairs = pairs_by_rows(a, b, settings.vertices) if is_free else []
    if pairs:
        pairs = _with_holes(a, b, pairs, fixed)
    else:
        pairing = Pairing(a, b, fixed, frames, rates)
        pairing.from_outermost_in()
        pairs = [(a[i], b[j]) for i, j in pairing.partner.items()]
        if settings.unmatched != "point":
            pairs = _with_pieces(a, b, pairs, fixed, dict(required), settings)
    return sorted(_without_passing(pairs, fixed), key=lambda pair: pair[0].number)


def pair_rotated_contours(
    a: Sequence[PlacedContour],
    b: Sequence[PlacedContour],
    settings: Settings,
    required: Sequence[Numbers],
    rotation: float,
    *,
    frames: tuple[Box, Box] | None = None,
    rates: Rates = USUAL,
) -> list[ContourPair]:
    """Pair contours as `pair_contours` does, with B rotated back by an angle and its largest contour laid over A's."""
    if not rotation:
        return pair_contours(a, b, settings, required, frames=frames, rates=rates)
    in_a, in_b = _middles(a, b)
    there = Similarity.rotation(rotation, about=in_a, onto=in_b)
    upright = rotated_back(a, b, rotation)
    as_drawn = {contour.number: contour for contour in b}
    return [
        (p, q.transformed(there.points) if q.is_piece else as_drawn[q.number])
        for p, q in pair_contours(a, upright, settings, required)
    ]


def rotated_back(
    a: Sequence[PlacedContour], b: Sequence[PlacedContour], rotation: float
) -> list[PlacedContour]:
    """Return B's contours rotated back by an angle, the largest one laid over A's."""
    in_a, in_b = _middles(a, b)
    back = Similarity.rotation(-rotation, about=in_b, onto=in_a)
    return [contour.transformed(back.points) for contour in b]


def _middles(a: Sequence[PlacedContour], b: Sequence[PlacedContour]) -> tuple[complex, complex]:
    in_a, in_b = (complex(max(side, key=lambda c: c.size).polygon.vertices.mean()) for side in (a, b))
    return in_a, in_b


def _without_passing(pairs: Sequence[ContourPair], fixed: dict[int, int]) -> list[ContourPair]:
    """Exchange the partners of holes in one contour that would pass through each other, if they do not then.

    Where holes overlap the contour would be seen again, as a black spot where the dot of an i goes through its stem.
    """
    found = list(pairs)
    holes = [k for k, (p, _) in enumerate(pairs) if p.role == HOLE and p.number not in fixed]
    for i, k in combinations(holes if len(holes) <= MOST_HOLES else (), 2):
        (p, q), (r, s) = found[i], found[k]
        are_together = (p.exterior, q.exterior) == (r.exterior, s.exterior)
        if are_together and _pass((p, q), (r, s)) and not _pass((p, s), (r, q)):
            found[i], found[k] = (p, s), (r, q)
    return found


def _pass(one: ContourPair, other: ContourPair) -> bool:
    """Return whether two contours that are apart in both drawings overlap on their way, by their boxes."""
    start, *between, end = (
        one[0].box.interpolate(one[1].box, t).overlaps(other[0].box.interpolate(other[1].box, t))
        for t in PASSING_TIMES
    )
    return any(between) and not (start or end)


def _with_pieces(
    a: Sequence[PlacedContour],
    b: Sequence[PlacedContour],
    pairs: Sequence[ContourPair],
    fixed: dict[int, int],
    required: dict[int, int],
    settings: Settings,
) -> list[ContourPair]:
    """Split exteriors for those without a partner, open rings, and pair the holes of pieces anew."""
    from shapeblend_cli.pairing.opening import open_rings
    from shapeblend_cli.pairing.split import split_exteriors

    outer = [pair for pair in pairs if pair[0].role != HOLE]
    split = split_exteriors(a, b, outer, settings, fixed)
    split = open_rings(a, b, split, settings, required)
    before = {(p.number, q.number) for p, q in outer}
    cut = [(p, q) for p, q in split if p.is_piece or q.is_piece or (p.number, q.number) not in before]
    if not cut:
        return list(pairs)
    numbers = [{pair[side].number for pair in cut} for side in (0, 1)]
    kept = [pair for pair in split if pair not in cut] + [
        pair
        for pair in pairs
        if pair[0].role == HOLE and pair[0].exterior not in numbers[0] and pair[1].exterior not in numbers[1]
    ]
    return kept + _with_holes(a, b, cut, fixed)


def _with_holes(
    a: Sequence[PlacedContour],
    b: Sequence[PlacedContour],
    cut: Sequence[ContourPair],
    fixed: dict[int, int],
) -> list[ContourPair]:
    """Return pairs of pieces, and the pairs of the holes in them."""
    from shapeblend_cli.pairing.assignment import Pairing

    found = []
    for p, q in cut:
        inner_a, inner_b = (
            [c, *(hole for hole in side if c.contains_hole(hole))] for side, c in ((a, p), (b, q))
        )
        wanted = {hole.number: fixed.get(hole.number) for hole in inner_a[1:]}
        there = {hole.number for hole in inner_b}
        inner = Pairing(
            inner_a, inner_b, {p.number: q.number} | {i: j for i, j in wanted.items() if j in there}
        )
        inner.from_outermost_in()
        found += [(inner_a[i], inner_b[j]) for i, j in inner.partner.items()]
    return found


def _required_partners(
    a: Sequence[PlacedContour], b: Sequence[PlacedContour], required: Sequence[Numbers]
) -> dict[int, int]:
    """Return B's numbers by A's of required pairs, and of the exteriors around required holes."""
    in_a, in_b = ({contour.number: contour for contour in side} for side in (a, b))
    partners: dict[int, int] = {}
    taken: dict[int, int] = {}

    def add(i: int, j: int) -> None:
        if partners.get(i, j) != j or taken.get(j, i) != i:
            raise MatchError(f"{i}={j} contradicts another pair; each contour has one partner")
        partners[i], taken[j] = j, i

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
