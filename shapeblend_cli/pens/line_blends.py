"""How the lines of two drawings become each other."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.model import WHOLE
from shapeblend_cli.motion.pen import Pen, Together, between
from shapeblend_cli.pens.around import slid_around
from shapeblend_cli.pens.joints import with_bows
from shapeblend_cli.pens.line import foot_points
from shapeblend_cli.pens.moves import (
    BECOMES,
    COMES,
    GOES,
    Move,
    alone,
    becoming,
    staying,
    thinned,
)
from shapeblend_cli.pens.named_lines import along_wires, required_lines
from shapeblend_cli.pens.partners import least_work_turned, sign_in_ring, travelling
from shapeblend_cli.pens.slashes import crossing_out, slash_among
from shapeblend_cli.pens.splits import split_moves
from shapeblend_cli.pens.stays import common_runs, common_shift, stayed
from shapeblend_cli.pens.turned import as_whole, centre_of, sign_turned, signs_turned, turned_among

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing
    from shapeblend_cli.model import ComplexArray, ShapeBlend
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.pens.line import PenDrawing, PenLine
    from shapeblend_cli.pens.named_lines import Pins, Required
    from shapeblend_cli.pens.partners import Assignment, Partners
    from shapeblend_cli.pens.stays import Run

KEPT = 0.3
"""Minimum share of a single stroke that stays for it to be matched as a line."""

ALL = 0.9
"""Minimum share of the ink in lines for drawings to be matched by these whatever outlines would be like."""

UNHIDDEN = 0.1
"""Maximum part of a dot that sticks out of a line that hides it, as a share of its width."""

EXACT = 0.01
"""Maximum distance of lines that are the same, in units."""

REQUIRED = "a pen line that becomes another, as required"


class LineBlend(NamedTuple):
    """How the lines of two drawings become each other, and what is left of both, with the settings for that."""

    shapes: tuple[ShapeBlend, ...]
    rest: tuple[list[PlacedContour], list[PlacedContour]]
    settings: Settings
    is_sure: bool = True  # whether outlines cannot be better
    # Length of what stays, as a share of all lines of the drawing that has less of them, and of that which has more: it
    # may be all of a check mark, and little of the pencil on whose edge that lies.
    kept_of_shorter: float = 1.0
    kept_of_longer: float = 1.0


def blend_lines(
    a: PlacedDrawing, b: PlacedDrawing, pens: tuple[PenDrawing, PenDrawing], settings: Settings, scale: float
) -> LineBlend | None:
    """Match two drawings by their pen lines, which are enough, see `enough_lines`.

    None is returned if outlines are named, or if a single stroke of each has too little in common.
    """
    is_asked = settings.strokes == "recover"
    one, other = pens
    bodies = a._replace(contours=one.bodies), b._replace(contours=other.bodies)
    required = required_lines(bodies, (one.lines, other.lines), settings, scale)
    if required is None:
        return None
    can_turn = not (one.bodies or other.bodies or required.pairs or settings.stiff)
    turned = None
    if can_turn and settings.motion != "linear":
        turned = as_whole(one.lines, other.lines) or signs_turned(one.lines, other.lines)
    if turned:
        return LineBlend(_shapes(turned, scale, settings), ([], []), settings)
    every = [*one.bodies, *other.bodies]
    moves, kept, leaves_ring = line_moves(one.lines, other.lines, required, settings, scale, bodies=every)
    # A stroke of each file leaves nothing to choose between.
    is_plain = len(one.lines) == len(other.lines) == 1 and not (one.is_recovered or other.is_recovered)
    if is_plain and kept < KEPT and not (is_asked or required.pairs):
        return None
    is_sure = is_asked or bool(required.pairs or settings.mix) or min(one.share, other.share) >= ALL
    rest = one.bodies, other.bodies
    shorter, longer = sorted(sum(line.length for line in drawing.lines) for drawing in (one, other))
    # Dots have no length. Of a sign that leaves a ring nothing is lost.
    kept_of_longer = 1.0 if leaves_ring else kept * shorter / max(longer, 1e-9)
    return LineBlend(_shapes(moves, scale, settings), rest, required.left, is_sure, kept, kept_of_longer)


def _shapes(moves: Sequence[Move], scale: float, settings: Settings) -> tuple[ShapeBlend, ...]:
    """Return the shapes of moves; those that come of a point, or go to one, leave no dot there."""
    shapes = [move.shape(scale, settings.constants) for move in moves]
    is_straight = settings.motion == "linear"
    if is_straight:  # as between two files: from vertex to vertex, all of the time
        shapes = [shape._replace(motion=None, span=WHOLE, fade=None, trim=None) for shape in shapes]
    shapes = [without_dots(shape, shapes, is_straight=is_straight) for shape in shapes]
    return tuple(shapes if settings.mix else _together(shapes))


def _together(shapes: Sequence[ShapeBlend]) -> list[ShapeBlend]:
    """Paint transparent lines of one style as one shape, which does not show where they cross."""
    groups: dict[object, list[ShapeBlend]] = {}
    for k, shape in enumerate(shapes):
        styles = shape.style_a, shape.style_b
        is_clear = any(style.stroke_opacity < 1.0 for style in styles) and not shape.fade
        groups.setdefault(styles if is_clear else k, []).append(shape)
    found = []
    for first, *others in groups.values():
        every = [first, *others]
        if others:
            motion = Together(tuple(shape.motion for shape in every), tuple(shape.span for shape in every))
            is_straight = all(shape.motion is None and shape.span == WHOLE for shape in every)
            first = first._replace(
                contours=tuple(contour for shape in every for contour in shape.contours),
                motion=None if is_straight else motion,
                span=WHOLE,
                trim=None,
            )
        found.append(first)
    return found


def without_dots(shape: ShapeBlend, shapes: Sequence[ShapeBlend], *, is_straight: bool) -> ShapeBlend:
    """Return a line that fades, or thins if it moves straight, where it is a dot that no other line hides."""
    (contour,) = shape.contours
    for end, style, fade in ((0, shape.style_a, COMES), (1, shape.style_b, GOES)):
        path = contour.path(end)
        if not path.is_point or contour.numbers[end] is not None or shape.fade is not None:
            continue
        if style.stroke_linecap == "butt" or style.stroke_width == 0.0:
            continue
        if any(_hides(other, end, path.segments[0, 0], style.stroke_width) for other in shapes):
            continue
        if is_straight:
            thin = style._replace(stroke_width=0.0)
            shape = shape._replace(style_b=thin) if end else shape._replace(style_a=thin)
        else:
            shape = shape._replace(fade=fade)
    return shape


def _hides(line: ShapeBlend, end: int, dot: complex, width: float) -> bool:
    """Return whether a line hides a dot of some width at an end."""
    (contour,) = line.contours
    path, style = contour.path(end), line.style(end)
    if path.is_point:
        return False
    points = np.append(path.segments[:, 0], path.segments[-1, 3])
    away = float(foot_points(np.array([dot]), points)[0][0])
    return away < (style.stroke_width - width) / 2.0 + UNHIDDEN * width


def line_moves(
    a: Sequence[PenLine],
    b: Sequence[PenLine],
    required: Required,
    settings: Settings,
    scale: float,
    *,
    bodies: Sequence[PlacedContour] = (),
) -> tuple[list[Move], float, bool]:
    """Return how the lines of one drawing become those of the other, and the share of their length that stays.

    The last is whether one drawing is the other one in a ring, in another size.

    `bodies` are what is no line in both drawings.
    """
    moves = [
        _by_wires((a[i], b[j]), pins, settings, scale, REQUIRED) for (i, j), pins in required.pairs.items()
    ]
    centres = centre_of(a), centre_of(b)
    a, b = (
        [line for k, line in enumerate(with_bows(lines)) if all(k != pair[side] for pair in required.pairs)]
        for side, lines in enumerate((a, b))
    )
    is_crossed = {sum(line.is_slash for line in lines) for lines in (a, b)} == {0, 1}
    shift = common_shift(a, b) if is_crossed and not settings.mix else 0j
    if shift:
        b = [line._replace(points=line.points - shift) for line in b]
        centres = centres[0], centres[1] - shift
    required_moves, moves = moves, []
    may_turn = settings.motion != "linear" and not (settings.mix or settings.stiff)
    shorter = min(sum(line.length for line in lines) for lines in (a, b))
    if may_turn:
        moves, a, b = _as_they_are(a, b, [body.polygon.vertices * scale for body in bodies])
    kept = sum(move.a.length for move in moves if move.a)
    ringed = sign_in_ring(a, b) if may_turn else []
    whole, length_kept, free = _kept_whole(a, b, ringed)
    moves += whole
    kept = (kept + length_kept) / max(shorter, 1e-9)
    slash = slash_among(free[0], free[1], kept)
    crossing = free[slash[0]].pop(slash[1]) if slash else None
    turned = sign_turned(free[0], free[1]) if may_turn else None
    if turned:
        moves += turned
        free = [[], []]
    is_alone = not (moves or required_moves or crossing or bodies) and may_turn
    found, angle = least_work_turned(free[0], free[1], centres, may_turn=is_alone)
    others, *copied = split_moves(found, moves)
    moves += others
    moves += _left_alone(found, copied, moves, has_bodies=bool(bodies))
    if slash is not None and crossing is not None:
        moves = crossing_out(crossing, moves, is_new=bool(slash[0]))
    moves = [
        move if (own := _wires(move, settings)) is None else _by_wires(own, [], settings, scale, BECOMES)
        for move in moves
    ]
    moves = [_turning(move, angle, centres) if angle else move for move in moves]
    moves = required_moves + [_shifted(move, shift) if shift else move for move in moves]
    return moves, kept, bool(ringed)


def _as_they_are(
    a: Sequence[PenLine], b: Sequence[PenLine], bodies: Sequence[ComplexArray]
) -> tuple[list[Move], Sequence[PenLine], Sequence[PenLine]]:
    """Return how lines move that turn, or slide around others, without being bent; and the other lines."""
    turned, a, b = turned_among(a, b, bodies)
    slides, a, b = slid_around(a, b, has_more=bool(turned or bodies))
    return turned + slides, a, b


def _kept_whole(
    a: Sequence[PenLine], b: Sequence[PenLine], ringed: list[Partners]
) -> tuple[list[Move], float, list[list[PenLine]]]:
    """Return how lines move that stay, travel as one or leave a ring, the length that is kept, and the other lines."""
    runs = [] if ringed else common_runs(a, b)
    together = ringed or _travelling_together(a, b, runs)
    taken = {pair.a for pair in together}, {pair.b for pair in together}
    runs = [run for run in runs if run.a not in taken[0] and run.b not in taken[1]]
    moves = [staying(each, a, b) for each in stayed(a, b, runs)]
    moves += [becoming(a[p.a], b[p.b], p.points_a, p.points_b) for p in together]
    kept = sum(run.length for run in runs) + sum(a[pair.a].length for pair in ringed)
    used = {run.a for run in runs} | taken[0], {run.b for run in runs} | taken[1]
    free = [
        [line for k, line in enumerate(lines) if k not in done]
        for lines, done in zip((a, b), used, strict=True)
    ]
    return moves, kept, free


def _travelling_together(a: Sequence[PenLine], b: Sequence[PenLine], runs: Sequence[Run]) -> list[Partners]:
    """Return the lines that travel as one, at least two; those that rest where they are do not."""
    resting = (
        {run.a for run in runs if run.length > 0.9 * a[run.a].length},
        {run.b for run in runs if run.length > 0.9 * b[run.b].length},
    )
    together = [pair for pair in travelling(a, b) if pair.a not in resting[0] and pair.b not in resting[1]]
    return together if len(together) > 1 else []


def _left_alone(
    found: Assignment, copied: Sequence[set[int]], moves: Sequence[Move], *, has_bodies: bool
) -> list[Move]:
    """Return how the lines without a partner come and go, beside the others."""
    alone_moves: list[Move] = []
    for side, lines in enumerate((found.a, found.b)):
        paired = {(pair.a, pair.b)[side] for pair in found.pairs} | copied[side]
        carriers = [move.motion for move in moves if (move.a, move.b)[side] is not None]
        free = [line for k, line in enumerate(lines) if k not in paired]
        for line in free:
            beside = [other for other in free if other is not line]
            alone_moves += alone(line, carriers, beside, is_new=bool(side), has_bodies=has_bodies)
    return alone_moves


def _shifted(move: Move, shift: complex) -> Move:
    """Let a line move on with its drawing, beside all else."""
    b = move.b and move.b._replace(points=move.b.points + shift)
    return move._replace(b=b, motion=move.motion._replace(shift=shift))


def _turning(move: Move, angle: float, centres: tuple[complex, complex]) -> Move:
    """Let a line turn with its drawing, beside all else, about the middle of the second drawing."""
    begin, until = (share * angle for share in move.span)
    b = move.b and move.b._replace(points=centres[1] + (move.b.points - centres[1]) * np.exp(1j * angle))
    return move._replace(b=b, motion=move.motion._replace(turn=(begin, until), pivot=centres[1]))


def _wires(move: Move, settings: Settings) -> tuple[PenLine, PenLine] | None:
    """Return the lines of which one becomes the other as wires do: rings, and all if places are stiff.

    Neither is a piece. Rings of one shape need no solver.
    """
    if move.a is None or move.b is None or move.reason != BECOMES or move.a.is_piece or move.b.is_piece:
        return None
    if not settings.stiff and not (move.a.closed and move.b.closed and _changes_shape(move.motion)):
        return None
    return move.a, move.b


def _changes_shape(motion: Pen) -> bool:
    """Return whether the points of a line move differently."""
    ways = motion.points(1.0) - motion.points(0.0)
    return bool(np.abs(ways - ways[0]).max() >= EXACT)


def _by_wires(
    lines: tuple[PenLine, PenLine], pins: Pins, settings: Settings, scale: float, reason: str
) -> Move:
    """Return how a line becomes another along the correspondence of their wires."""
    p, q = lines
    closed = p.closed and q.closed
    points = along_wires(p, q, pins, settings, scale)
    if reason == BECOMES:
        points = thinned(*points)
    return Move(p, q, Pen((between(*points, closed=closed),), closed=closed), reason)
