"""Straight strokes and slashes without a partner beside fills: drawn on or back at their width.

Others, which may run along the edge of a fill that changes, grow from a point.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.model import Box, Fade, Place
from shapeblend_cli.motion.pen import Drawing, Pen, Riding, Straight
from shapeblend_cli.pairing.growth import MatchedPoints, carried
from shapeblend_cli.pens.drawings import file_line, recovered_lines
from shapeblend_cli.pens.line import UNITS
from shapeblend_cli.pens.line_blends import without_dots
from shapeblend_cli.pens.moves import SHORT, Move, alone
from shapeblend_cli.pens.slashes import STRAIGHT, crossing_out, is_slash

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.blending.matched import PairedDrawings, Progress
    from shapeblend_cli.model import ContourBlend, ShapeBlend
    from shapeblend_cli.pens.line import PenLine


def with_drawn_strokes(
    paired: PairedDrawings, shapes: Sequence[ShapeBlend], places: Sequence[Place], view: Box
) -> tuple[list[ShapeBlend], list[Place]]:
    """Let straight strokes and slashes that would grow from points be drawn on or back.

    Return all shapes with their places.
    """
    scale = UNITS / view.larger_side
    carriers = [_carrier(each, scale) for shape in shapes for each in shape.contours if each.is_matched]
    strokes = [shape for shape in shapes if len(shape.contours) == 1 and shape.style_a.stroke is not None]
    placed = [{contour.number: contour for contour in side.contours} for side in (paired.a, paired.b)]
    found: list[ShapeBlend] = []
    numbers: list[range] = []
    for shape in shapes:
        begin = len(found)
        may_be_drawn = bool(carriers) and shape.fade is None
        lines = _loose_lines(shape, placed, paired.progress, scale) if may_be_drawn else None
        if lines is None:
            found.append(shape)
        else:
            for contour, line in zip(shape.contours, lines, strict=True):
                drawn = _drawn(line, carriers, is_new=contour.a is None)
                own = drawn.shape(scale, paired.settings.constants)
                (path,) = own.contours
                own = own._replace(contours=(path._replace(parents=contour.parents, lines=(None, None)),))
                found.append(_faded_in_time(without_dots(own, strokes, is_straight=False), drawn))
        numbers.append(range(begin, len(found)))
    return found, [Place(k, place.end) for place in places for k in numbers[place.shape]]


def _faded_in_time(shape: ShapeBlend, move: Move) -> ShapeBlend:
    """Return a line that fades, if it does, when it is drawn back or begins to be drawn on: it is no dot for longer."""
    (piece,) = move.motion.pieces
    drawing = piece.own if isinstance(piece, Riding) else piece
    if shape.fade is None or not isinstance(drawing, Drawing):
        return shape
    begin, until = drawing.span
    length = shape.fade.until - shape.fade.begin
    if shape.fade.comes:
        return shape._replace(fade=Fade(begin, begin + length, comes=True))
    return shape._replace(fade=Fade(until - length, until, comes=False))


def _carrier(contour: ContourBlend, scale: float) -> Pen:
    """Return how a contour with a partner carries what touches it, in units."""
    ends = [path.segments[:, 0] for path in (contour.start, contour.end)]
    if not contour.start.closed:
        ends = [
            np.append(own, path.segments[-1, 3])
            for own, path in zip(ends, (contour.start, contour.end), strict=True)
        ]
    return Pen((Straight(ends[0] * scale, ends[1] * scale),), closed=contour.start.closed)


def _loose_lines(
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
    if line is None or line.closed or line.length < SHORT * line.width:
        return None
    return line if abs(line.points[-1] - line.points[0]) > STRAIGHT * line.length else None


def _stroke_or_slash(own: PlacedContour, others: Iterable[PlacedContour], scale: float) -> PenLine | None:
    """Return a stroke, or a filled slash, as a line; None for all others."""
    if own.style.fill is None:
        return None if own.style.stroke is None else file_line(own, scale)
    if own.style.stroke is not None or not own.is_slender:
        return None
    if any(other.exterior == own.number for other in others):
        return None
    lines, rests = recovered_lines([own], scale) or ([], [])
    return lines[0] if len(lines) == 1 and not rests and is_slash(lines[0]) else None


def _drawn(line: PenLine, carriers: Sequence[Pen], *, is_new: bool) -> Move:
    """Draw a line on, or back, carried along by what it touches, else by what is around it or near."""
    if is_slash(line):
        move = crossing_out(line, [], is_new=is_new)[0]
    else:
        (move,) = alone(line, carriers, is_new=is_new)
    (piece,) = move.motion.pieces
    if isinstance(piece, Riding):
        return move
    middle = complex(line.points.mean())
    sides = [MatchedPoints(each.points(float(is_new)), each.points(float(not is_new))) for each in carriers]
    around = [
        side
        for side, carrier in zip(sides, carriers, strict=True)
        if carrier.closed and winding_numbers(np.array([middle]), side.here)[0]
    ]
    nearest = min(sides, key=lambda side: float(np.abs(side.here - middle).min()))
    by = min(around, key=lambda side: Box.around(side.here).area, default=nearest)
    image = carried(middle, by, inside=bool(around))
    ends = (image, middle) if is_new else (middle, image)
    carrier = Straight(*(np.array([end, end + 1.0]) for end in ends))
    return move._replace(motion=Pen((Riding(piece, carrier, 0, 0.0, float(is_new)),)))
