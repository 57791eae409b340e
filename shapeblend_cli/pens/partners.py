"""Which line becomes which, of those that do not stay: the least work, by symmetry and groups of both drawings."""

from __future__ import annotations

from itertools import pairwise, product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.crossings import line_crossings
from shapeblend_cli.geometry.grouping import assign
from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.model import Box
from shapeblend_cli.pens.line import apart, at, corners, evenly, foot_points, length, part_of
from shapeblend_cli.pens.line_costs import alone_cost, best_halves, partner_cost, ways_between
from shapeblend_cli.pens.moves import alike

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, FloatArray
    from shapeblend_cli.pens.line import PenLine

CUT_COST = 0.25
"""Cost of cutting lines at their corners, as a share of their length."""

CROSSING_COST = 8.0
"""Cost of lines that cross on their way and at neither end, in units: they look scrambled."""

CROSSING_TIMES = (0.3, 0.5, 0.7)
"""Times at which lines are looked at for crossings."""

MOST_CORNERS = 3
"""Maximum number of corners of a line that is cut at them."""

SPLIT_COST = 0.3
"""Cost of one line that becomes two twins, or of these that become one, as a share of its length."""

SPLIT_ON_AXIS_COST = 0.6
"""Cost of the same for a line along the axis of symmetry and twins beside that: its halves cross on their way."""

SHORTEST = 4.0
"""Minimum length of a line that splits into two twins, in widths."""

SYMMETRY_BONUS = 1.6
"""Maximum work of an assignment that keeps a symmetry of both drawings, as a multiple of the least."""

MOST_MITRE = 1.5
"""Maximum length of a piece beyond the corner at which it was cut, in half widths: a sharper corner is bevelled."""

TWIN_DISTANCE = 0.6
"""Maximum distance of a line's mirror image from its twin, in units."""

SAME_SHIFT = 0.45
"""Tolerance of the shifts of lines that travel together, and of their points, in units."""

SAME_LENGTH = 0.08
"""Tolerance of the lengths of lines that only travel, as a share."""


LEAST_SHIFT = 0.6
"""Minimum distance that a place of a sign goes as this leaves its ring, for it not to stay, in units."""

SAME_SIGN = 1.2
"""Tolerance of the places of a sign in a ring, scaled to the size of the sign without it, in units."""

MOST_SCALED = 3.0
"""Maximum ratio of the sizes of a sign with and without a ring."""

MOST_STRETCHED = 1.6
"""Maximum ratio of the scales of such a sign in both directions."""

FEW = 4
"""Maximum number of lines of a drawing that turns while its lines become others."""

MANY = 4
"""Minimum number of lines of both drawings for one to turn so."""

TURN_COST = 0.08
"""Cost of turning a drawing as a whole beside, as a share of the length of its lines."""


class Partners(NamedTuple):
    """A pair of lines by number, and their polylines in the direction and from the start that cost least."""

    a: int
    b: int
    points_a: ComplexArray
    points_b: ComplexArray


class Assignment(NamedTuple):
    """Lines, perhaps cut, and which become which, with the work that takes."""

    a: list[PenLine]
    b: list[PenLine]
    pairs: list[Partners]
    work: float


def travelling(a: Sequence[PenLine], b: Sequence[PenLine]) -> list[Partners]:
    """Return the lines that are the same but for one shift, if at least two have it: they travel as one."""
    votes: list[tuple[complex, Partners]] = []
    shares = np.linspace(0.0, 1.0, 17)
    for (i, p), (j, q) in product(enumerate(a), enumerate(b)):
        if (
            abs(p.length - q.length) > SAME_LENGTH * p.length + 0.1
            or p.closed != q.closed
            or len(p.points) < 2
        ):
            continue
        for one, image in ways_between(p, q):
            shifts = at(image, shares * length(image)) - at(one, shares * length(one))
            mean = complex(shifts.mean())
            if np.abs(shifts - mean).max() < SAME_SHIFT and 0.4 < abs(mean) < 12.0:
                votes.append((mean, Partners(i, j, one, image)))
                break
    best: dict[int, Partners] = {}
    for common, _ in votes:
        group: dict[int, Partners] = {}
        for other, pair in votes:
            if abs(other - common) < SAME_SHIFT and pair.a not in group:
                if pair.b not in {each.b for each in group.values()}:
                    group[pair.a] = pair
        if len(group) > 1 and sum(a[i].length for i in group) > sum(a[i].length for i in best):
            best = group
    return list(best.values())


def sign_in_ring(a: Sequence[PenLine], b: Sequence[PenLine]) -> list[Partners]:
    """Return which lines become which where one drawing is the other one in a ring, in another size; else none.

    The ring has no partner. If the sign is a closed line itself, the ring may better become that.
    """
    more, fewer = (a, b) if len(a) > len(b) else (b, a)
    if len(more) != len(fewer) + 1 or not fewer or (len(fewer) == 1 and fewer[0].closed):
        return []
    rings = [k for k, line in enumerate(more) if line.closed and _is_around(line, more)]
    if len(rings) != 1:
        return []
    inside = [k for k in range(len(more)) if k not in rings]
    mapped = _scaled_onto([more[k].drawn for k in inside], [line.drawn for line in fewer])
    if (
        mapped is None
        or max(np.abs(p - more[k].drawn).max() for p, k in zip(mapped, inside, strict=True)) < LEAST_SHIFT
    ):
        return []
    distances = np.array([[apart(p, line.drawn) for line in fewer] for p in mapped])
    found = []
    for i, j in assign(distances):
        p, q = more[inside[i]], fewer[j]
        if distances[i, j] > SAME_SIGN or p.closed != q.closed:
            return []
        moved = p._replace(points=mapped[i][: len(p.points)])
        shares = np.linspace(0.0, 1.0, 17)
        ways = [other for _, other in ways_between(moved, q)]
        own = at(mapped[i], shares * length(mapped[i]))
        points = min(ways, key=lambda other: float(np.abs(own - at(other, shares * length(other))).max()))
        pair = Partners(inside[i], j, p.outline, points)
        found.append(pair if more is a else Partners(j, inside[i], points, p.outline))
    return found


def _is_around(ring: PenLine, lines: Sequence[PenLine]) -> bool:
    """Return whether a ring is around all other lines."""
    others = [line.points for line in lines if line is not ring]
    return bool((winding_numbers(np.concatenate(others), ring.points) != 0).all())


def _scaled_onto(a: Sequence[ComplexArray], b: Sequence[ComplexArray]) -> list[ComplexArray] | None:
    """Return polylines scaled so that the box around them becomes that around others; None if that distorts them."""
    one, other = (Box.around(np.concatenate(list(lines))) for lines in (a, b))
    scales = [
        new / old if min(old, new) > LEAST_SHIFT else None
        for old, new in ((one.width, other.width), (one.height, other.height))
    ]
    known = [scale for scale in scales if scale is not None]
    if not known or max(known) > MOST_STRETCHED * min(known):
        return None
    if not 1.0 / MOST_SCALED < min(known) <= max(known) < MOST_SCALED:
        return None
    x, y = (known[0] if scale is None else scale for scale in scales)
    away = (points - one.centre for points in a)
    return [other.centre + x * each.real + 1j * y * each.imag for each in away]


def least_work(a: Sequence[PenLine], b: Sequence[PenLine], centres: tuple[complex, complex]) -> Assignment:
    """Assign lines to lines, whole or cut at their corners, whichever takes less work.

    The centres are those of both drawings, about which they may be symmetric.
    """
    tries: list[Assignment] = []
    for cut_a, cut_b in product((False, True), repeat=2):
        some, others = (_cut(a) if cut_a else list(a)), (_cut(b) if cut_b else list(b))
        if (cut_a and len(some) == len(a)) or (cut_b and len(others) == len(b)):
            continue
        work, pairs = _assigned(some, others, centres)
        cuts = CUT_COST * sum(line.length for line in (*(a if cut_a else ()), *(b if cut_b else ())))
        tries.append(Assignment(some, others, pairs, work + cuts))
    if len(tries) == 1:  # crossings decide nothing
        return tries[0]
    return min(tries, key=lambda each: each.work + CROSSING_COST * _new_crossings(each))


def least_work_turned(
    a: Sequence[PenLine], b: Sequence[PenLine], centres: tuple[complex, complex], *, may_turn: bool
) -> tuple[Assignment, float]:
    """Assign lines to lines while the drawing turns by a right angle, if it may and that takes less work.

    The bars of a menu become an arrow upwards as they become one to the right. Returns the assignment, with B turned
    back, and the angle, in radians.
    """
    found = least_work(a, b, centres), 0.0
    are_bars = any(all(line.is_straight for line in lines) for lines in (a, b))
    if not (may_turn and are_bars and a and b) or len(a) + len(b) < MANY or max(len(a), len(b)) > FEW:
        return found
    turning = TURN_COST * sum(line.length for line in (*a, *b)) / 2.0
    for angle in (0.5 * np.pi, -0.5 * np.pi):
        back = [
            line._replace(points=centres[1] + (line.points - centres[1]) * np.exp(-1j * angle)) for line in b
        ]
        turned = least_work(a, back, centres)
        if turned.work + (0.0 if found[1] else turning) < found[0].work - 1e-9:
            found = turned, angle
    return found


def _new_crossings(found: Assignment) -> int:
    """Return how much more often paired lines cross on straight ways than at either end."""
    if len(found.pairs) < 2:
        return 0
    ends = [
        alike(_without_caps(pair.points_a, found.a[pair.a]), _without_caps(pair.points_b, found.b[pair.b]))
        for pair in found.pairs
    ]
    counts = [line_crossings([p + t * (q - p) for p, q in ends]) for t in (0.0, *CROSSING_TIMES, 1.0)]
    return max(0, max(counts[1:-1]) - max(counts[0], counts[-1]))


def _without_caps(points: ComplexArray, line: PenLine) -> ComplexArray:
    """Return a polyline without half a width at either end: a line that ends on another one may stick out."""
    whole = length(points)
    cap = min(0.5 * line.width, 0.25 * whole)
    return points if line.closed else part_of(points, False, cap, whole - cap)


def _cut(lines: Sequence[PenLine]) -> list[PenLine]:
    """Cut open lines at their corners."""
    found = []
    for line in lines:
        places = [] if line.closed else corners(line.outline)
        if not 0 < len(places) <= MOST_CORNERS:
            found.append(line)
            continue
        ends = [0.0, *(place * line.length for place in places), line.length]
        for begin, end in pairwise(ends):
            share = begin / line.length, end / line.length
            piece = line.part(begin, end)
            found.append(line._replace(points=piece, is_piece=True, share=share, is_bow=False))
        if line.style.stroke_linecap == "butt" and line.style.stroke_linejoin == "miter":
            found[-len(ends) + 1 :] = _mitred(found[-len(ends) + 1 :])
    return found


def _mitred(pieces: Sequence[PenLine]) -> list[PenLine]:
    """Lengthen the pieces of a line at the corners between them, so that they paint its mitres."""
    ways = [[p[1] - p[0], p[-1] - p[-2]] for p in (piece.points for piece in pieces)]
    before, after = [0.0] * len(pieces), [0.0] * len(pieces)
    for k, (one, other) in enumerate(pairwise(ways)):
        turn = abs(float(np.angle(other[0] / one[1])))
        after[k] = before[k + 1] = 0.5 * pieces[k].width * min(np.tan(0.5 * turn), MOST_MITRE)
    found = []
    for piece, (first, last), back, on in zip(pieces, ways, before, after, strict=True):
        points = piece.points.copy()
        points[0] -= back * first / abs(first)
        points[-1] += on * last / abs(last)
        found.append(piece._replace(points=points))
    return found


def _assigned(
    a: Sequence[PenLine], b: Sequence[PenLine], centres: tuple[complex, complex]
) -> tuple[float, list[Partners]]:
    """Return the work of the best assignment of lines, and its pairs."""
    if not a or not b:
        return sum(map(alone_cost, (*a, *b))), []
    ways = [[partner_cost(p, q) for q in b] for p in a]
    costs = np.array([[way[0] for way in row] for row in ways])
    work, pairs = _of_orbits([(i,) for i in range(len(a))], [(j,) for j in range(len(b))], a, b, costs)
    most = SYMMETRY_BONUS * work
    for axis in (1j, 1.0):
        twins = [_twins(lines, centre, axis) for lines, centre in zip((a, b), centres, strict=True)]
        if any(None in found for found in twins) or all(
            k == twin for found in twins for k, twin in enumerate(found)
        ):
            continue
        orbits_a, orbits_b = (_orbits(found) for found in twins)
        from_axis = [
            [((line.points - centre) / axis).imag for line in lines]
            for lines, centre in zip((a, b), centres, strict=True)
        ]
        found_work, found_pairs = _of_orbits(orbits_a, orbits_b, a, b, costs, from_axis)
        if found_work < most:
            work, pairs, most = found_work, found_pairs, found_work
    return work, [Partners(i, j, *ways[i][j][1:]) for i, j in pairs]


def _orbits(twins: Sequence[int | None]) -> list[tuple[int, ...]]:
    """Return each line that is its own mirror image, and each two that are each other's."""
    return sorted({tuple(sorted({k, twin})) for k, twin in enumerate(twins) if twin is not None})


def _of_orbits(
    orbits_a: Sequence[tuple[int, ...]],
    orbits_b: Sequence[tuple[int, ...]],
    a: Sequence[PenLine],
    b: Sequence[PenLine],
    costs: FloatArray,
    from_axis: Sequence[Sequence[FloatArray]] = (),
) -> tuple[float, list[tuple[int, int]]]:
    """Assign lines that are alone, and pairs of twins, each to one of either kind, by distances from the axis."""
    m, n = len(orbits_a), len(orbits_b)
    table = np.full((m + n, m + n), 1e6)
    how: dict[tuple[int, int], list[tuple[int, int]]] = {}
    for (i, p), (j, q) in product(enumerate(orbits_a), enumerate(orbits_b)):
        if len(p) == len(q):
            options = [[*zip(p, q, strict=True)], [*zip(p, q[::-1], strict=True)]]
        else:
            one, twins = (a[p[0]], [b[k] for k in q]) if len(q) == 2 else (b[q[0]], [a[k] for k in p])
            if one.length < SHORTEST * one.width:
                continue
            along, beside = (from_axis[side][(p, q)[side][0]] for side in (len(p) - 1, len(q) - 1))
            is_on_axis = np.abs(along).max() < TWIN_DISTANCE and np.ptp(np.sign(beside)) == 0.0
            split = SPLIT_ON_AXIS_COST if is_on_axis else SPLIT_COST
            work = split * one.length + sum(half.cost for half in best_halves(one, twins))
            table[i, j], how[i, j] = work, [*product(p, q)]
            continue
        priced = [(sum(costs[pair] for pair in pairs), pairs) for pairs in options]
        table[i, j], how[i, j] = min(priced, key=lambda option: option[0])
    for i, p in enumerate(orbits_a):
        table[i, n + i] = sum(alone_cost(a[k]) for k in p)
    for j, q in enumerate(orbits_b):
        table[m + j, j] = sum(alone_cost(b[k]) for k in q)
    table[m:, n:] = 0.0
    chosen = assign(table)
    work = float(sum(table[i, j] for i, j in chosen))
    return work, [pair for i, j in chosen for pair in how.get((i, j), ())]


def _twins(lines: Sequence[PenLine], centre: complex, axis: complex) -> list[int | None]:
    """Return the mirror image of each line about an axis through a point: the number of a line, or None."""
    found: list[int | None] = []
    for line in lines:
        points = evenly(line.outline, 0.5) if len(line.points) > 1 else line.points
        images = centre + axis * axis * (points - centre).conj()
        twin = None
        for k, other in enumerate(lines):
            if abs(other.length - line.length) < 0.08 * line.length + 0.3:
                if foot_points(images, other.drawn)[0].max() < TWIN_DISTANCE:
                    twin = k
        found.append(twin)
    return found
