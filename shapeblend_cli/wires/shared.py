"""Outlines that share most of their length in place, and a match of two in which that stays.

The least work spreads a change over what is beside it: as the upright bar of a plus goes in, the other bar gets thick.
So where two outlines share enough of their length, the stretches that they share are held, and only what lies between
two of them is solved. A limb that has a straight line for a partner goes straight in: its sides become the ends of the
line.

Not in the paper.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polyline import cumulative_lengths, nearest_numbers
from shapeblend_cli.matching.solve import Search, least_work, priced
from shapeblend_cli.wires.common_cuts import refine
from shapeblend_cli.wires.contour_match import Solved
from shapeblend_cli.wires.stretches import mostly_shared

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.geometry.flat_contour import FlatContour
    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray
    from shapeblend_cli.wires.contour_match import ContourMatch

SAME = 1e-6
"""Maximum difference of shares of a length that are one."""

DECIMALS = 6
"""Number of decimals of such shares."""

STRAIGHT = 0.98
"""Minimum distance of the ends of a line that a limb goes into, as a share of the line's length."""

DETOUR = 1.5
"""Minimum length of a limb, as a multiple of its line's length."""

BACK = 0.1
"""Maximum backtracking of a limb along its line, as a share of the line's length."""

BEYOND = 0.25
"""Maximum distance that a limb reaches beyond the ends of its line, as a share of the line's length."""

MOST = 1.15
"""Maximum work of a match that holds the stretches, as a multiple of the least work, unless there is a limb."""


class Anchors(NamedTuple):
    """Places at which stretches begin and end, in turn, and the distances from each to the next, once round.

    Both are shares of the outline's length.
    """

    places: FloatArray
    steps: FloatArray


def solve_with_shared(match: ContourMatch) -> Solved | None:
    """Solve two contours, with common cuts, such that the stretches that they share stay in place.

    None if they share too little, or nothing that has an end; for lines, and where B is rotated; and if holding takes
    far more work than other matches.
    """
    anchors = None if match.rotation else _anchors(match.a, match.b)
    if anchors is None:
        return None
    cut = match.a.cut_at(anchors[0].places, SAME), match.b.cut_at(anchors[1].places, SAME)
    limbs = [_limb_of(p, q) for p, q in zip(*map(_gaps, cut, anchors), strict=True)]

    def solve_pieces(
        p: FlatContour, q: FlatContour, near: IntArray | None = None, known: float = np.inf
    ) -> Solved:
        whole = match.wires(p, q)
        dots = _joined((p, q), anchors, limbs, whole, match.settings.effort)
        return Solved(p, q, priced(whole, dots))

    solved = refine(solve_pieces(*cut), solve_pieces)
    return match.unless_far_more(solved, None if any(limbs) else MOST)


def _anchors(a: FlatContour, b: FlatContour) -> tuple[Anchors, Anchors] | None:
    """Return where stretches that two closed contours share begin and end; None if there are none to hold."""
    if not (a.polygon.closed and b.polygon.closed):
        return None
    shared = mostly_shared([a], [b])
    if shared is None:
        return None
    stretches = sorted(shared.stretches, key=lambda stretch: stretch.start[0] % a.total)
    if stretches[0].end[1] - stretches[0].start[1] >= b.total:
        return None
    first, second = (
        _anchors_on(flat.total, [(s.start[k], s.end[k]) for s in stretches]) for k, flat in enumerate((a, b))
    )
    if any(abs(anchors.steps.sum() - 1.0) > 0.5 for anchors in (first, second)):
        return None  # in another order on one outline than on the other
    return first, second


def _anchors_on(total: float, stretches: Sequence[tuple[float, float]]) -> Anchors:
    """Return the anchors at both ends of stretches of an outline of that length."""
    places = np.array(stretches) / total
    # Where the next stretch begins as this one ends, rounding may put it before.
    gaps = (np.roll(places[:, 0], -1) - places[:, 1] + SAME) % 1.0 - SAME
    steps = np.stack([places[:, 1] - places[:, 0], gaps], axis=1)
    return Anchors(places.ravel() % 1.0, steps.ravel())


def _pieces(flat: FlatContour, anchors: Anchors) -> list[IntArray]:
    """Return the numbers of the vertices from each anchor to the next, both ends included."""
    own = flat.shares[: len(flat.polygon.vertices)]
    ends = np.abs((own[:, None] - anchors.places + 0.5) % 1.0 - 0.5).argmin(axis=0)
    counts = (np.roll(ends, -1) - ends) % len(own)
    counts[(counts == 0) & (anchors.steps > 0.5)] = len(own)
    return [(end + np.arange(count + 1)) % len(own) for end, count in zip(ends, counts, strict=True)]


def _gaps(flat: FlatContour, anchors: Anchors) -> list[ComplexArray]:
    """Return the vertices between stretches that are shared."""
    return [flat.polygon.vertices[numbers] for numbers in _pieces(flat, anchors)[1::2]]


def _joined(
    contours: tuple[FlatContour, FlatContour],
    anchors: tuple[Anchors, Anchors],
    limbs: Sequence[str],
    whole: Wires,
    effort: str,
) -> IntArray:
    """Return the dots of all pieces, each solved from end to end; every second piece lies between two stretches."""
    dots = []
    for k, (i, j) in enumerate(zip(*map(_pieces, contours, anchors), strict=True)):
        limb = limbs[k // 2] if k % 2 else ""
        z, w = (flat.polygon.vertices[numbers] for flat, numbers in zip(contours, (i, j), strict=True))
        if len(i) == 1 or len(j) == 1:
            piece = np.stack([np.arange(max(len(i), len(j)))] * 2, axis=1).clip(0, [len(i) - 1, len(j) - 1])
        elif limb:
            piece = _into_line(z, w) if limb == "a" else _into_line(w, z)[:, ::-1]
        else:
            piece = least_work(whole.along(i, j), Search(effort=effort)).dots
        dots.append(np.stack([i[piece[:-1, 0]], j[piece[:-1, 1]]], axis=1))
    return _without_corners(np.concatenate(dots), (whole.m, whole.n))


def _limb_of(z: ComplexArray, w: ComplexArray) -> str:
    """Return which of two pieces of outline, a or b, is a limb that can go straight into the other; "" if neither can.

    Every piece can go into a point.
    """
    if len(z) == 1 or len(w) == 1:
        return "b" if len(w) > 1 else "a" if len(z) > 1 else ""
    for name, limb, line in (("a", z, w), ("b", w, z)):
        along, length = abs(line[-1] - line[0]), cumulative_lengths(line)[-1]
        if along >= STRAIGHT * length and cumulative_lengths(limb)[-1] >= DETOUR * length:
            share = _shares(limb, line)
            back = (np.maximum.accumulate(share) - share).max()
            if back <= BACK and share.min() >= -BEYOND and share.max() <= 1.0 + BEYOND:
                return name
    return ""


def _shares(z: ComplexArray, line: ComplexArray) -> FloatArray:
    """Return the positions of points along a line, as shares of the line's length."""
    return np.asarray(((z - line[0]) / (line[-1] - line[0])).real)


def _into_line(limb: ComplexArray, line: ComplexArray) -> IntArray:
    """Return the dots of a limb that goes straight into a line, (k, 2): each point to the nearest on the line."""
    share = _shares(limb, line).clip(0.0, 1.0).round(DECIMALS)
    share[0], share[-1] = 0.0, 1.0
    lengths = cumulative_lengths(line)
    beside = nearest_numbers(lengths / lengths[-1], np.maximum.accumulate(share))
    dots = [(0, 0)]
    for i, j in enumerate(beside[1:].tolist(), 1):
        # Corners that become an end of the line become that alone.
        later = share[i - 1] in (0.0, 1.0)
        dots += [(i if later else i - 1, between) for between in range(dots[-1][1] + 1, j)]
        dots.append((i, j))
    return np.array(dots, np.intp)


def _without_corners(dots: IntArray, counts: tuple[int, int]) -> IntArray:
    """Return a closed path whose turns of 90 degrees are cut short."""
    while True:
        moves = (np.roll(dots, -1, axis=0) - dots) % counts
        before = np.roll(moves, 1, axis=0)
        corner = (moves.sum(axis=1) == 1) & (before.sum(axis=1) == 1) & (moves[:, 0] != before[:, 0])
        if not corner.any():
            return dots
        dots = np.delete(dots, int(corner.argmax()), axis=0)
