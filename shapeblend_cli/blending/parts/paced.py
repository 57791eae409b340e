"""When parts without a partner come and go."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.motion.early import (
    CHANGES,
    DETAIL,
    STIRS,
    alone_in,
    alone_in_the_way,
    carried_by_lines,
    change_of,
    early_shares,
    most_shares,
    shares_by_size,
    with_early_parts,
)

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from shapeblend_cli.model import ShapeBlend
    from shapeblend_cli.motion.early import Numbers

KEPT = 0.3
"""Minimum share of lines that stay for what sticks out of the others to take all of the time to come or go."""


def with_parts_paced(
    shapes: tuple[ShapeBlend, ...], side: float, kept: float | None, *, by_size: bool
) -> tuple[ShapeBlend, ...]:
    """Let parts without a partner leave early and come late.

    Parameters
    ----------
    shapes : tuple of ShapeBlend
    side : float
        The larger side of the view.
    kept : float or None
        The share of the pen lines that stay, where one of the drawings is a sign of lines; else None.
    by_size : bool
        Whether the small ones leave the sooner and come the later, in what is no sign.
    """
    change = change_of(shapes, side)
    are_changed = change > CHANGES
    if kept is not None and (kept < KEPT or are_changed):
        early = early_shares(shapes, alone_in(shapes), are_changed=True)
    else:
        early = early_shares(shapes, alone_in_the_way(shapes, side), are_changed)
    is_by_size = by_size and change > STIRS and (kept is None or _is_coloured(shapes))
    if is_by_size:
        small = most_shares(shapes) | shares_by_size(shapes, alone_in(shapes, DETAIL * side), side, change)
        # What others would run into comes when it is told, which may be soon.
        told = {
            part: share for part, share in early.items() if part[0] is None or share > small.get(part, 0.0)
        }
        early = small | told
    has_strokes = any(_is_stroke_alone(shape, early) for shape in shapes)
    shapes = with_early_parts(shapes, early, evenly=is_by_size and not has_strokes)
    if is_by_size:
        shapes = tuple(
            _in_time(shape, early) if _is_stroke_alone(shape, early) else shape for shape in shapes
        )
    return shapes if kept is None else carried_by_lines(shapes)


def _is_coloured(shapes: Sequence[ShapeBlend]) -> bool:
    """Return whether there are several colours."""
    paints = {
        paint.colour for shape in shapes for style in (shape.style_a, shape.style_b) for paint in style.paints
    }
    return len(paints - {None}) > 1


def _is_stroke_alone(shape: ShapeBlend, parts: Collection[Numbers]) -> bool:
    """Return whether a shape with a stroke is one of some parts, and no other."""
    numbers = {(contour.a, contour.b) for contour in shape.contours}
    return (
        shape.style_a.stroke is not None
        and len(numbers) == 1
        and numbers <= set(parts)
        and shape.fade is None
    )


def _in_time(shape: ShapeBlend, parts: Mapping[Numbers, float]) -> ShapeBlend:
    """Return a shape that is one of some parts in its share of the time, its stroke too, which would be a dot."""
    (contour,) = shape.contours
    share = parts[contour.a, contour.b]
    return shape._replace(motion=None, span=(share, 1.0) if contour.grows else (0.0, 1.0 - share))
