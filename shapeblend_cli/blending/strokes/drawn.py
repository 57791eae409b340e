"""Loose lines beside fills: drawn on or back at their width."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.model import Box, Fade, Place
from shapeblend_cli.motion.pen import Drawing, Pen, Riding, Straight
from shapeblend_cli.pairing.growth import MatchedPoints, carried
from shapeblend_cli.pens.line_blends import without_dots
from shapeblend_cli.pens.moves import Move, alone
from shapeblend_cli.pens.slashes import crossing_out

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.model import ContourBlend, ShapeBlend
    from shapeblend_cli.options.constants import WorkConstants
    from shapeblend_cli.pens.line import PenLine


def with_drawn_strokes(
    shapes: Sequence[ShapeBlend],
    places: Sequence[Place],
    loose: Mapping[int, Sequence[PenLine]],
    constants: WorkConstants,
    scale: float,
) -> tuple[list[ShapeBlend], list[Place]]:
    """Draw loose lines on or back, and return all shapes with their places.

    `loose` has the lines by the index of their shape.
    """
    carriers = [_carrier(each, scale) for shape in shapes for each in shape.contours if each.is_matched]
    strokes = [shape for shape in shapes if len(shape.contours) == 1 and shape.style_a.stroke is not None]
    found: list[ShapeBlend] = []
    numbers: list[range] = []
    for k, shape in enumerate(shapes):
        begin = len(found)
        if k not in loose:
            found.append(shape)
        else:
            for contour, line in zip(shape.contours, loose[k], strict=True):
                drawn = _drawn(line, carriers, is_new=contour.a is None)
                own = drawn.shape(scale, constants)
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


def _drawn(line: PenLine, carriers: Sequence[Pen], *, is_new: bool) -> Move:
    """Draw a line on, or back, carried along by what it touches, else by what is around it or near."""
    if line.is_slash:
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
