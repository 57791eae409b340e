"""Lines that cross a drawing out."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.motion.pen import Drawing
from shapeblend_cli.pens.line import evenly, foot_points, length
from shapeblend_cli.pens.moves import drawn

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray
    from shapeblend_cli.motion.pen import Moving
    from shapeblend_cli.pens.line import PenLine
    from shapeblend_cli.pens.moves import Move

LEAST_KEPT = 0.4
"""Minimum share of a drawing that stays for a line to cross it out."""

GAP_REACH = 2.5
"""Maximum distance of the gap along a slash from it, in widths."""

LEAST_TIME = 0.2
"""Minimum time in which a line is drawn back from a slash, or on to it, as a share."""


def slash_among(a: Sequence[PenLine], b: Sequence[PenLine], kept: float) -> tuple[int, int] | None:
    """Return the drawing and the index of the one slash among lines that do not stay, where much else stays."""
    found = [(side, k) for side, lines in enumerate((a, b)) for k, line in enumerate(lines) if line.is_slash]
    return found[0] if len(found) == 1 and kept >= LEAST_KEPT else None


def crossing_out(slash: PenLine, moves: Sequence[Move], *, is_new: bool) -> list[Move]:
    """Draw a slash on, or back, and the ends of other lines where it goes, as its tip comes by."""
    points = slash.outline
    if points[0].real > points[-1].real:  # as one writes
        points = points[::-1]
    own = drawn(slash, points, is_new=is_new)
    paced = []
    for move in moves:
        tails = [tail and _paced(tail, points, slash.width, is_new=is_new) for tail in move.motion.tails]
        paced.append(move._replace(motion=move.motion._replace(tails=(tails[0], tails[1]))))
    return [*paced, own]


def _paced(tail: Moving, slash: ComplexArray, width: float, *, is_new: bool) -> Moving:
    """Draw a tail back as the tip of a new slash comes by, or on as that of an old one leaves."""
    goes = isinstance(tail, Drawing) and tail.until < tail.begin
    if not isinstance(tail, Drawing) or goes != is_new:
        return tail
    sampled = evenly(tail.line, 0.2)
    away, along, _ = foot_points(sampled, slash)
    if away.min() > GAP_REACH * width:
        return tail
    whole = length(slash)
    time = min(max(LEAST_TIME, length(tail.line) / whole), 1.0)
    begin = min(float(along[int(away.argmin())]) / whole, 1.0 - time)
    return tail._replace(span=(begin, begin + time) if is_new else (1.0 - begin - time, 1.0 - begin))
