"""When parts without a partner come and go."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.motion.early import (
    CHANGES,
    STIRS,
    alone_in,
    alone_in_the_way,
    carried_by_lines,
    change_of,
    early_shares,
    shares_by_size,
    with_early_parts,
)

if TYPE_CHECKING:
    from shapeblend_cli.model import ShapeBlend

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
    evenly = by_size and kept is None and change > STIRS
    if evenly:
        small = shares_by_size(shapes, alone_in(shapes), side, change)
        # What others would run into comes when it is told, which may be soon.
        told = {
            part: share for part, share in early.items() if part[0] is None or share > small.get(part, 0.0)
        }
        early = small | told
    shapes = with_early_parts(shapes, early, evenly=evenly)
    return shapes if kept is None else carried_by_lines(shapes)
