"""Lines that slide around others: a bracket that becomes its mirror image, and would be pressed through an arrow."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polyline import cumulative_lengths
from shapeblend_cli.motion.pen import Pen, Sliding
from shapeblend_cli.pens.line import foot_points, length
from shapeblend_cli.pens.moves import Move

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

LEAST_BULGE = 0.25
"""Minimum distance of a line from the straight line between its ends, as a share of that."""

FARTHEST = 8.0
"""Maximum gap between the ends of both lines, in units."""

SLIDES = "a pen line that slides around others"


def slid_around(
    a: Sequence[PenLine], b: Sequence[PenLine], *, has_more: bool
) -> tuple[list[Move], list[PenLine], list[PenLine]]:
    """Return how lines that slide around others move, and the other lines of both drawings.

    There is something to slide around if there are more lines, or bodies.
    """
    rest, others = list(a), list(b)
    moves: list[Move] = []
    for line in a:
        for other in others:
            if not (has_more or (len(rest) > 1 and len(others) > 1)):
                break
            move = _slide(line, other)
            if move is not None:
                moves.append(move)
                rest = [each for each in rest if each is not line]
                others = [each for each in others if each is not other]
                break
    return moves, rest, others


def _slide(line: PenLine, other: PenLine) -> Move | None:
    """Return how a line slides to its mirror image; None if it is none, or if their ends do not meet.

    It slides above what is between.
    """
    if line.closed or other.closed or min(len(line.points), len(other.points)) < 3:
        return None
    lengths = line.length, other.length
    if min(lengths) < max(LEAST_LENGTH, SAME_LENGTH * max(lengths)):
        return None
    ways = [
        _path(p, q)
        for p in (line.points, line.points[::-1])
        for q in (other.points, other.points[::-1])
        if p[-1].imag <= p[0].imag
    ]
    return next((Move(line, other, Pen((path,)), SLIDES) for path in ways if path is not None), None)


def _path(p: ComplexArray, q: ComplexArray) -> Sliding | None:
    """Return how a line slides over its last point to the first point of its mirror image; None if it cannot."""
    chord = p[0] - p[-1]
    if abs(chord) < 1e-6:
        return None
    up = chord / abs(chord)
    depths = ((p - p[-1]) * up.conjugate()).imag
    deepest = float(depths[np.abs(depths).argmax()])
    if abs(deepest) < LEAST_BULGE * abs(chord):
        return None
    away = 1j * up * np.sign(deepest)  # from the ends towards the bulge
    middle = (p[-1] + q[0]) / 2.0
    mirrored = middle - (away * ((p - middle) * away.conjugate()).conjugate())
    near = [float(foot_points(some, onto)[0].max()) for some, onto in ((mirrored, q), (q, mirrored))]
    if max(near) > NEAR or abs(mirrored[-1] - q[0]) > NEAR:
        return None
    gap = float(((p[-1] - q[0]) * away.conjugate()).real)
    last, first = p[-1] - p[-2], q[1] - q[0]
    for edge in (last, first):
        if abs((edge / abs(edge) * away.conjugate()).imag) > IN_LINE:
            return None
    if gap > FARTHEST or gap < -min(abs(last), abs(first)) or abs((p[-1] - q[0]) - gap * away) > IN_LINE:
        return None
    if gap < 0.0:  # they overlap, and each goes as far as half way
        half = (p[-1] + q[0]) / 2.0
        path = np.concatenate([p[:-1], [half], q[1:]])
        own, partner = length(p) + 0.5 * gap, length(q) + 0.5 * gap
        return Sliding(path, (0.0, own - 0.5 * gap), (own + 0.5 * gap, own + partner))
    path = np.concatenate([p, q])
    whole = float(cumulative_lengths(path)[-1])
    return Sliding(path, (0.0, length(p)), (whole - length(q), whole))
