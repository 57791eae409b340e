"""Loose lines: straight strokes and slashes without a partner beside fills.

Bent strokes, which may run along the edge of a fill that changes, grow from a point.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.pens.drawings import file_line, recovered_lines
from shapeblend_cli.pens.named_lines import wants_lines

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.blending.matched import PairedDrawings, Progress
    from shapeblend_cli.model import ContourBlend, ShapeBlend
    from shapeblend_cli.pens.line import PenLine


def loose_lines(
    paired: PairedDrawings, shapes: Sequence[ShapeBlend], scale: float
) -> dict[int, list[PenLine]]:
    """Return the shapes, by index, of which each contour is a loose line that may be drawn on or back, as lines.

    `scale` is the number of units that a length of 1 has.
    """
    if not _are_free(paired) or not any(each.is_matched for shape in shapes for each in shape.contours):
        return {}
    placed = [{contour.number: contour for contour in side.contours} for side in (paired.a, paired.b)]
    lines = {k: _lines_of(s, placed, paired.progress, scale) for k, s in enumerate(shapes) if s.fade is None}
    return {k: found for k, found in lines.items() if found is not None}


def _are_free(paired: PairedDrawings) -> bool:
    """Return whether strokes and slashes without a partner may be drawn on and back, and there may be any."""
    settings = paired.settings
    is_free = settings.is_free and settings.unmatched == "auto" and not paired.rotation
    if not is_free or not wants_lines(settings) or paired.copies is not None:
        return False
    return any(
        each.style.stroke is not None or each.is_slender
        for side in (paired.a, paired.b)
        for each in side.contours
    )


def _lines_of(
    shape: ShapeBlend, placed: Sequence[dict[int, PlacedContour]], progress: Progress, scale: float
) -> list[PenLine] | None:
    """Return the lines of a shape of which each contour is a loose line; None for all others."""
    lines = []
    for contour in shape.contours:
        line = _loose_line(contour, placed, progress, scale)
        if line is None:
            return None
        lines.append(line)
    return lines


def _loose_line(
    contour: ContourBlend, placed: Sequence[dict[int, PlacedContour]], progress: Progress, scale: float
) -> PenLine | None:
    """Return a straight stroke or a slash that grows from a point, or shrinks to one, as a line; else None.

    A stroke that goes with a fill without a partner is none.
    """
    if contour.is_matched or not contour.path(1 - contour.whole_at).is_point:
        return None
    here = contour.whole_at
    number = contour.numbers[here]
    own = placed[here].get(number) if number is not None else None
    if own is None:
        return None
    body = placed[here].get(contour.root.body) if contour.root is not None else None
    if body is not None and body.style.fill is not None:
        return None  # it goes with that
    others = placed[here].values()
    line = progress.once("line", (own,), scale, lambda: _stroke_or_slash(own, others, scale))
    if line is None or not line.can_be_drawn_on:
        return None
    return line if line.is_straight else None


def _stroke_or_slash(own: PlacedContour, others: Iterable[PlacedContour], scale: float) -> PenLine | None:
    """Return a stroke, or a filled slash, as a line; None for all others."""
    if own.style.fill is None:
        return None if own.style.stroke is None else file_line(own, scale)
    if own.style.stroke is not None or not own.is_slender:
        return None
    if any(other.exterior == own.number for other in others):
        return None
    lines, rests = recovered_lines([own], scale) or ([], [])
    return lines[0] if len(lines) == 1 and not rests and lines[0].is_slash else None
