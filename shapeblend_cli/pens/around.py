"""Lines that slide around others: a bracket that becomes its mirror image, and would be pressed through an arrow."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polyline import cumulative_lengths
from shapeblend_cli.model import Box
from shapeblend_cli.motion.pen import Pen, Sliding
from shapeblend_cli.pens.line import apart, farthest, length, part_of
from shapeblend_cli.pens.moves import Move, alike

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray
    from shapeblend_cli.pens.line import PenLine

LEAST_LENGTH = 10.0
"""Minimum length of a line that slides around others, in units."""

SAME_LENGTH = 0.9
"""Minimum ratio of the lengths of such a line and its mirror image."""

NEAR = 0.6
"""Maximum distance of a line from the mirror image of its partner, in units."""

IN_LINE = 0.25
"""Maximum distance of an end of one line from the straight line that ends the other one, in units."""

LEAST_BULGE = 0.12
"""Minimum distance of a line from the straight line between its ends, as a share of that."""

EXACT = 0.01
"""Maximum gap between ends that meet, in units."""

FARTHEST = 12.0
"""Maximum gap between the ends of both lines, in units."""

MOST_GAP = 0.35
"""Maximum gap in a box, as a share of the length of its line."""

FACING = 0.9
"""Minimum cosine of the angle at which the ends of such a line face each other."""

OVERLAP = 0.1
"""Overlap of both halves of such a line, in widths."""

DOORS = "a gap closes while one opens on the other side"
SLIDES = "a pen line that slides around others"


def slid_around(
    a: Sequence[PenLine], b: Sequence[PenLine], *, has_more: bool
) -> tuple[list[Move], list[PenLine], list[PenLine]]:
    """Return how lines move that have others between them and their mirror image, and the other lines of both drawings.

    Brackets slide around what is between. Boxes with a gap on one side get it on the other side: as a door shuts,
    another one opens. There is something between only if there are more lines, or bodies.
    """
    rest, others = list(a), list(b)
    moves: list[Move] = []
    for line in a:
        for other in others if _may_go(line, b) else ():
            if not (has_more or (len(rest) > 1 and len(others) > 1)):
                break
            found = _around(line, other) if _may_go(other, a) else []
            if found:
                moves += found
                rest = [each for each in rest if each is not line]
                others = [each for each in others if each is not other]
                break
    return moves, rest, others


def _may_go(line: PenLine, others: Sequence[PenLine]) -> bool:
    """Return whether a line is long, open and bent, and not where another one is in the other drawing."""
    if line.closed or len(line.points) < 3 or line.length < LEAST_LENGTH:
        return False
    return all(farthest(line.points, other.drawn) > NEAR for other in others)


def _around(line: PenLine, other: PenLine) -> list[Move]:
    """Return how a line moves to its mirror image; none if it is none, or goes there as others do."""
    lengths = line.length, other.length
    if min(lengths) < SAME_LENGTH * max(lengths):
        return []
    p = line.points if line.points[-1].imag <= line.points[0].imag else line.points[::-1]
    for q in (other.points, other.points[::-1]):
        path = _path(p, q)  # above what is between
        if path is not None:
            return [Move(line, other, Pen((path,)), SLIDES)]
        halves = _halves(p, q, OVERLAP * line.width)
        if halves is not None:
            return [Move(line, other, Pen((half,)), DOORS) for half in halves]
    return []


def _halves(p: ComplexArray, q: ComplexArray, overlap: float) -> list[Sliding] | None:
    """Return how both halves of a box with a gap become those of its mirror image; None if it has no gap.

    They slide along the box, while that goes where its mirror image is.
    """
    gap, bulge = p[0] - p[-1], _bulge(p)
    if bulge is None or abs(gap) > MOST_GAP * length(p):
        return None
    for end, next_to_it, there in ((p[-1], p[-2], gap), (p[0], p[1], -gap)):
        if ((end - next_to_it) * there.conjugate()).real < FACING * abs(end - next_to_it) * abs(gap):
            return None
    mirrored = _mirrored(p, (_centre(p) + _centre(q)) / 2.0, bulge)
    if apart(mirrored, q) > NEAR:
        return None
    if abs(mirrored[0] - q[0]) > abs(mirrored[0] - q[-1]):
        q = q[::-1]
    found = []
    for own, other in ((p, q), (p[::-1], q[::-1])):
        a, b = (_half(each, overlap) for each in (own, other))
        open_a, open_b = (0.5 * abs(each[0] - each[-1]) + overlap for each in (own, other))
        a, b = alike(a, b[::-1])
        found.append(Sliding(a, b, (open_a, length(a)), (0.0, length(b) - open_b)))
    return found


def _half(p: ComplexArray, overlap: float) -> ComplexArray:
    """Return the first half of a box with a gap, from the middle of that, both ends a little longer."""
    middle = 0.5 * (p[0] + p[-1])
    beyond = middle - overlap * (p[0] - middle) / abs(p[0] - middle)
    return np.append(beyond, part_of(p, False, 0.0, 0.5 * length(p) + overlap))


def _bulge(p: ComplexArray) -> complex | None:
    """Return the direction in which a line bulges out from the straight line between its ends; None if it does not."""
    chord = p[0] - p[-1]
    if abs(chord) < EXACT:
        return None
    up = chord / abs(chord)
    depths = ((p - p[-1]) * up.conjugate()).imag
    deepest = float(depths[np.abs(depths).argmax()])
    return None if abs(deepest) < LEAST_BULGE * abs(chord) else complex(1j * up * np.sign(deepest))


def _mirrored(p: ComplexArray, middle: complex, across: complex) -> ComplexArray:
    """Return a line as its mirror image: what lies in a direction from a point, and opposite, change places."""
    return middle - across * ((p - middle) * across.conjugate()).conjugate()


def _centre(p: ComplexArray) -> complex:
    return Box.around(p).centre


def _path(p: ComplexArray, q: ComplexArray) -> Sliding | None:
    """Return how a line slides over its last point to the first point of its mirror image; None if it cannot."""
    away = _bulge(p)
    if away is None:
        return None
    mirrored = _mirrored(p, (p[-1] + q[0]) / 2.0, away)
    if apart(mirrored, q) > NEAR or abs(mirrored[-1] - q[0]) > NEAR:
        return None
    gap = float(((p[-1] - q[0]) * away.conjugate()).real)
    last, first = p[-1] - p[-2], q[1] - q[0]
    for edge in (last, first):
        if abs((edge / abs(edge) * away.conjugate()).imag) > IN_LINE:
            return None
    if gap > FARTHEST or gap < -min(abs(last), abs(first)) or abs((p[-1] - q[0]) - gap * away) > IN_LINE:
        return None
    if gap < -EXACT:  # they overlap, and each goes as far as half way
        half = (p[-1] + q[0]) / 2.0
        path = np.concatenate([p[:-1], [half], q[1:]])
        own, partner = length(p) + 0.5 * gap, length(q) + 0.5 * gap
        return Sliding(path, path, (0.0, own - 0.5 * gap), (own + 0.5 * gap, own + partner))
    path = np.concatenate([p, q[1:] if gap < EXACT else q])
    whole = float(cumulative_lengths(path)[-1])
    return Sliding(path, path, (0.0, length(p)), (whole - length(q), whole))
