"""Lines that are drawn on or back, for formats that trim paths: the whole line, and the part of it that is seen."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polygons import polyline_contour
from shapeblend_cli.model import Trim
from shapeblend_cli.motion.pen import Drawing, Riding

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray
    from shapeblend_cli.motion.pen import Moving, Pen

    Seen = tuple[ComplexArray, tuple[float, float]]

OFF = 5e-3
"""Tolerance of a trimmed line, as a share of its length: it moves straight, and the part seen of it changes evenly."""


def trim_of(motion: Pen) -> Trim | None:
    """Return the trimmed line that moves as a pen does; None if it changes otherwise, too."""
    drawings = [found for each in (*motion.pieces, *motion.tails) if (found := _drawing(each)) is not None]
    inner = {t for drawing in drawings for t in drawing.span if 0.0 < t < 1.0}
    if motion.closed or not drawings or motion.turn != (0.0, 0.0):
        return None
    stops = [(t, _seen(motion, t)) for t in (0.0, *sorted(inner), 1.0)]
    (start, _), (end, _) = stops[0][1], stops[-1][1]
    if min(_length(start), _length(end)) == 0.0:
        return None
    for (before, (_, part)), (after, (_, next_part)) in pairwise(stops):
        t = (before + after) / 2.0
        points, shares = _seen(motion, t)
        off = np.abs(points - (1.0 - t) * start - t * end).max() / _length(points)
        if max(off, np.abs(np.array(shares) - (np.array(part) + next_part) / 2.0).max()) > OFF:
            return None
    parts = tuple((t, part) for t, (_, part) in stops)
    return Trim(polyline_contour(start, False), polyline_contour(end, False), parts)


def _drawing(moving: Moving | None) -> Drawing | None:
    """Return what is drawn of a moving polyline, perhaps while it rides along."""
    own = moving.own if isinstance(moving, Riding) else moving
    return own if isinstance(own, Drawing) else None


def _whole(moving: Moving, t: float) -> ComplexArray:
    """Return the points of a moving polyline at a time, as if all of it were drawn."""
    drawing = _drawing(moving)
    return (
        moving.points(t) if drawing is None else drawing.line + (moving.points(t)[0] - drawing.points(t)[0])
    )


def _seen(motion: Pen, t: float) -> Seen:
    """Return all points of a line at a time, and the shares of its length between which it is seen."""
    points = np.concatenate([_whole(piece, t) for piece in motion.pieces])
    drawing = _drawing(motion.pieces[0])
    hidden = [0.0, 0.0]
    if drawing is not None:
        low, high = drawing.part(t)
        hidden = [low * _length(points), (1.0 - high) * _length(points)]
    for side, tail in enumerate(motion.tails):
        if tail is None:
            continue
        own = _whole(tail, t)
        joined = own - own[0] + points[-1 if side else 0]
        points = np.concatenate([points, joined] if side else [joined[::-1], points])
        drawing = _drawing(tail)
        if drawing is not None:
            hidden[side] = _length(own) * (1.0 - drawing.part(t)[1])
    whole = max(_length(points), 1e-12)
    return points, (hidden[0] / whole, 1.0 - hidden[1] / whole)


def _length(points: ComplexArray) -> float:
    return float(np.abs(np.diff(points)).sum())
