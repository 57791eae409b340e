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

from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.geometry.polyline import cumulative_lengths, thin
from shapeblend_cli.matching.solve import Search, least_work, priced
from shapeblend_cli.matching.work import Wire, Wires
from shapeblend_cli.model import Box
from shapeblend_cli.wires.common_cuts import solve_among
from shapeblend_cli.wires.outline import Outline
from shapeblend_cli.wires.stretches import TOLERANCE, shared_stretches

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.wires.common_cuts import FlatContour, Solve, Solved

WATCHED, FIRST_SHARE = 32, 0.15
"""So many points of A are looked at first, and so many of them at least lie on B."""

SAME, ROUNDED = 1e-6, 6
"""Shares of a length that are one; and as decimals."""

STRAIGHT, DETOUR = 0.98, 1.5
"""A limb goes into a line whose ends are no nearer than the first share of its length; and it is so many times as long
as the line."""

BACK, BEYOND = 0.1, 0.25
"""A limb goes back along the line, and beyond its ends, by these shares of it at most."""

MOST = 1.15
"""Without a limb, a match that holds what is shared may take so many times the least work."""


class Anchors(NamedTuple):
    """Places at which stretches begin and end, in turn, on an outline, and how far it is from each to the next one.

    Both as shares of its length; the steps make one round.
    """

    places: FloatArray
    steps: FloatArray


def solve_with_shared(
    a: FlatContour,
    b: FlatContour,
    solve: Solve,
    settings: Settings,
) -> Solved | None:
    """Solve two contours, with common cuts, such that what they share stays where it is.

    Parameters
    ----------
    a, b : FlatContour
        In the same direction.
    solve : callable
        Finds the least work, whatever is shared; see `solve_with_common_cuts`.
    settings : Settings

    Returns
    -------
    a, b : FlatContour
        With all nodes of those given, and other vertices.
    correspondence : Correspondence
        Of these two. The lower bound is that of all matches, where it was looked for.

    None if they share too little, or nothing that has an end; and for lines, and where holding takes far more work.
    """
    anchors = _anchors(a, b)
    if anchors is None:
        return None
    cut = a.cut_at(anchors[0].places, SAME), b.cut_at(anchors[1].places, SAME)
    limbs = [_limb_of(p, q) for p, q in zip(*map(_gaps, cut, anchors), strict=True)]

    def solve_pieces(
        p: FlatContour, q: FlatContour, near: IntArray | None = None, known: float = np.inf
    ) -> Solved:
        whole = Wires(to_unit_box(p.polygon), to_unit_box(q.polygon), True, settings.constants)
        return p, q, priced(whole, _joined((p, q), anchors, limbs, whole, settings.effort))

    most = None if any(limbs) else MOST
    return solve_among(solve_pieces(*cut), solve_pieces, solve, settings.effort, most)


def _anchors(a: FlatContour, b: FlatContour) -> tuple[Anchors, Anchors] | None:
    """Return where stretches that two closed contours share begin and end; None if there are none to hold."""
    if not (a.polygon.closed and b.polygon.closed):
        return None
    outlines = Outline.of(a), Outline.of(b)
    diagonal = Box.union([flat.polygon.box for flat in (a, b)]).diagonal
    away = outlines[1].lengths_near(thin(a.polygon.vertices, WATCHED))[0]
    if (away <= TOLERANCE * diagonal).mean() < FIRST_SHARE:
        return None
    stretches = shared_stretches(outlines[:1], outlines[1:], diagonal)
    stretches = sorted(stretches, key=lambda stretch: stretch.start[0] % outlines[0].total)
    if not stretches or stretches[0].end[1] - stretches[0].start[1] >= outlines[1].total:
        return None
    found = [
        _anchors_on(outline.total, [(s.start[k], s.end[k]) for s in stretches])
        for k, outline in enumerate(outlines)
    ]
    if any(abs(anchors.steps.sum() - 1.0) > 0.5 for anchors in found):
        return None  # in another order on one outline than on the other
    return found[0], found[1]


def _anchors_on(total: float, stretches: Sequence[tuple[float, float]]) -> Anchors:
    """Return the anchors at both ends of stretches of an outline of that length."""
    places = np.array(stretches) / total
    # Where the next stretch begins as this one ends, rounding may put it before.
    gaps = (np.roll(places[:, 0], -1) - places[:, 1] + SAME) % 1.0 - SAME
    steps = np.stack([places[:, 1] - places[:, 0], gaps], axis=1)
    return Anchors(places.ravel() % 1.0, steps.ravel())


def _pieces(flat: FlatContour, anchors: Anchors) -> list[IntArray]:
    """Return the numbers of the vertices from each anchor to the next, both ends included."""
    own = flat.lengths[: len(flat.polygon.vertices)]
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
    """Return the dots of all pieces, each solved from end to end; every second one lies between two shared ones."""
    dots = []
    for k, (i, j) in enumerate(zip(*map(_pieces, contours, anchors), strict=True)):
        limb = limbs[k // 2] if k % 2 else ""
        z, w = (flat.polygon.vertices[numbers] for flat, numbers in zip(contours, (i, j), strict=True))
        if len(i) == 1 or len(j) == 1:
            piece = np.stack([np.arange(max(len(i), len(j)))] * 2, axis=1).clip(0, [len(i) - 1, len(j) - 1])
        elif limb:
            piece = _into_line(z, w) if limb == "a" else _into_line(w, z)[:, ::-1]
        else:
            first, second = (
                Wire(*(points[numbers] for points in wire))
                for wire, numbers in zip(whole.wires, (i, j), strict=True)
            )
            wires = Wires(first, second, False, whole.constants)
            piece = least_work(wires, Search(effort=effort)).dots
        dots.append(np.stack([i[piece[:-1, 0]], j[piece[:-1, 1]]], axis=1))
    return _without_corners(np.concatenate(dots), (whole.m, whole.n))


def _limb_of(z: ComplexArray, w: ComplexArray) -> str:
    """Return which of two pieces of outline, a or b, is a limb that can go straight into the other; "" if none can.

    What has a point for a partner goes into that.
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
    """Return how far along a line points are, as shares of it."""
    return np.asarray(((z - line[0]) / (line[-1] - line[0])).real)


def _into_line(limb: ComplexArray, line: ComplexArray) -> IntArray:
    """Return the dots of a limb that goes straight into a line, (k, 2).

    A point becomes the one beside it on the line, and what is beyond its ends becomes these.
    """
    share = _shares(limb, line).clip(0.0, 1.0).round(ROUNDED)
    share[0], share[-1] = 0.0, 1.0
    lengths = cumulative_lengths(line)
    beside = np.abs(np.maximum.accumulate(share)[:, None] - lengths / lengths[-1]).argmin(axis=1)
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
