"""When parts without a partner come and go."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from shapeblend_cli.blending.parts.alone import (
    CHANGES,
    STIRS,
    alone_in,
    alone_in_the_way,
    carried_by_lines,
    change_of,
    early_shares,
    from_point,
    gone_at,
    most_shares,
    shares_by_size,
    with_early_parts,
)
from shapeblend_cli.model import WHOLE

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from shapeblend_cli.model import ContourBlend, ShapeBlend
    from shapeblend_cli.motion.early import Numbers
    from shapeblend_cli.motion.pen import Moving, Pen

DETAIL = 0.2
"""Maximum size of a part that is a detail of a drawing, as a share of the view's side."""

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
    is_by_size = by_size and change > STIRS and (kept is None or is_coloured(shapes))
    if is_by_size:
        small = most_shares(shapes) | shares_by_size(shapes, alone_in(shapes, DETAIL * side), side, change)
        # What others would run into comes when it is told, which may be soon.
        told = {
            part: share for part, share in early.items() if part[0] is None or share > small.get(part, 0.0)
        }
        early = small | told
        shapes = tuple(_drawn_in_time(shape, early) if _is_drawn(shape, early) else shape for shape in shapes)
        drawn = {c.numbers for shape in shapes if _is_drawn(shape, early) for c in shape.contours}
        early = {part: share for part, share in early.items() if part not in drawn}
    has_strokes = any(_are_strokes_alone(shape, early) for shape in shapes)
    shapes = with_early_parts(shapes, early, evenly=is_by_size and not has_strokes)
    if is_by_size:
        shapes = tuple(
            part
            for shape in shapes
            for part in (_in_time(shape, early) if _are_strokes_alone(shape, early) else (shape,))
        )
    return shapes if kept is None else carried_by_lines(shapes)


def is_coloured(shapes: Sequence[ShapeBlend]) -> bool:
    """Return whether there are several colours in both drawings together."""
    paints = {
        paint.colour for shape in shapes for style in (shape.style_a, shape.style_b) for paint in style.paints
    }
    return len(paints - {None}) > 1


def _are_strokes_alone(shape: ShapeBlend, parts: Collection[Numbers]) -> bool:
    """Return whether a shape with a stroke is one of some parts, or several that are lines, and no other."""
    numbers = {contour.numbers for contour in shape.contours}
    return (
        shape.style_a.stroke is not None
        and (len(numbers) == 1 or shape.is_stroke)
        and numbers <= set(parts)
        and shape.fade is None
    )


def _is_drawn(shape: ShapeBlend, parts: Collection[Numbers]) -> bool:
    """Return whether a shape is one of some parts that is drawn on or back."""
    if shape.motion_name != "pen":
        return False
    from shapeblend_cli.motion.pen import Pen  # most drawings have no lines

    return isinstance(shape.motion, Pen) and all(c.numbers in parts for c in shape.contours)


def _drawn_in_time(shape: ShapeBlend, parts: Mapping[Numbers, float]) -> ShapeBlend:
    """Return a part that is drawn on or back in its share of the time, and carried along as it would be anyway."""
    from shapeblend_cli.motion.pen import Riding  # as above
    from shapeblend_cli.motion.trims import trim_of

    (contour,), motion = shape.contours, cast("Pen", shape.motion)
    share = parts[contour.numbers]
    span = (share, 1.0) if contour.grows else (0.0, 1.0 - share)
    pieces = tuple(
        piece._replace(own=_all_along(piece.own), span=span)
        if isinstance(piece, Riding)
        else _all_along(piece)
        for piece in motion.pieces
    )
    motion = motion._replace(pieces=pieces)
    contour = from_point(contour, complex(motion.points(1.0 - float(contour.grows))[0]))
    return shape._replace(contours=(contour,), motion=motion, span=span, trim=trim_of(motion))


def _all_along(moving: Moving) -> Moving:
    """Return a polyline that is drawn in all of its own time."""
    from shapeblend_cli.motion.pen import Drawing  # as above

    return moving._replace(span=WHOLE) if isinstance(moving, Drawing) else moving


def _in_time(shape: ShapeBlend, parts: Mapping[Numbers, float]) -> list[ShapeBlend]:
    """Return a shape of parts that are there in their shares of the time, their strokes too, which would be dots."""
    spans: dict[tuple[float, float], list[ContourBlend]] = {}
    for contour in shape.contours:
        share = parts[contour.numbers]
        span = (share, 1.0) if contour.grows else (0.0, 1.0 - share)
        spans.setdefault(span, []).append(gone_at(contour, share))
    return [shape._replace(contours=tuple(own), motion=None, span=span) for span, own in spans.items()]
