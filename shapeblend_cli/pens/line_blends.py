"""How the lines of two drawings become each other."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.model import Box
from shapeblend_cli.motion.pen import Pen, Whole
from shapeblend_cli.pens.drawings import pen_drawing
from shapeblend_cli.pens.line import UNITS, evenly, foot_points
from shapeblend_cli.pens.moves import Move, alone, becoming, staying
from shapeblend_cli.pens.partners import least_work, partner_cost, travelling
from shapeblend_cli.pens.stays import common_runs, stayed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing
    from shapeblend_cli.model import ComplexArray, ShapeBlend
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.pens.line import PenLine
    from shapeblend_cli.pens.partners import Assignment

LEAST_INK = 0.45
"""Minimum share of the ink of a drawing in its lines."""

KEPT = 0.3
"""Minimum share of the length of lines that stays for drawings to be matched by their lines."""

ALL = 0.9
"""Minimum share of the ink in lines for drawings to be matched by these though less stays."""

LOOSE = 0.45
"""Maximum share of the length of lines without a partner for strokes of which little stays. Where more would come and
go, whole strokes are matched as they are."""

MOST_LINES = 60
"""Maximum number of lines of a drawing: more are an illustration."""

LEAST_TURNED = 0.5
"""Minimum share of lines that stay where they are for a drawing not to be turned or flipped as a whole."""

SAME_PLACE = 0.35
"""Maximum distance of lines that are in one place, in widths."""

TURNED, FLIPPED = "the drawing is turned as a whole", "the drawing is flipped as a whole"
COPY = "a pen line that splits, or joins another like it"


class LineBlend(NamedTuple):
    """How the lines of two drawings become each other, and what is left of both."""

    shapes: tuple[ShapeBlend, ...]
    rest: tuple[list[PlacedContour], list[PlacedContour]]


def wants_lines(settings: Settings) -> bool:
    """Return whether settings leave it open how lines are matched."""
    named = settings.match or settings.pins or settings.start or settings.stiff or settings.mix
    free = not named and settings.motion == "auto" and settings.unmatched == "auto" and settings.curves
    return free and settings.strokes != "keep"


def blend_lines(a: PlacedDrawing, b: PlacedDrawing, settings: Settings, view: Box) -> LineBlend | None:
    """Match two drawings by their pen lines, if both are mostly drawn with a pen, or if that is asked for."""
    scale = UNITS / view.larger_side
    is_asked = settings.strokes == "recover"
    one, other = pen_drawing(a, scale), pen_drawing(b, scale)
    least = 0.0 if is_asked else LEAST_INK
    if not (one.lines and other.lines) or max(len(one.lines), len(other.lines)) > MOST_LINES:
        return None
    if min(one.share, other.share) < least:
        return None
    whole = _as_whole(one.lines, other.lines) if not (one.bodies or other.bodies) else None
    if whole is not None:
        return LineBlend(tuple(move.shape(scale, settings.constants) for move in whole), ([], []))
    moves, kept, loose = _moves(one.lines, other.lines)
    is_recovered = one.is_recovered or other.is_recovered
    if is_recovered and not is_asked and _segment_counts(a) == _segment_counts(b):
        return None  # made from each other, as letters of a family, and matched so: segment by segment
    suits_strokes = loose <= LOOSE and not _is_whole(moves)
    is_alike = kept >= KEPT or (min(one.share, other.share) >= ALL and (is_recovered or suits_strokes))
    if not (is_alike or is_asked):
        return None
    shapes = tuple(move.shape(scale, settings.constants) for move in moves)
    return LineBlend(shapes, (one.bodies, other.bodies))


def _segment_counts(drawing: PlacedDrawing) -> list[tuple[int, int]]:
    """Return the shape of each contour and the number of its segments."""
    return [(contour.shape, len(contour.contour.segments)) for contour in drawing.contours]


def _is_whole(moves: Sequence[Move]) -> bool:
    """Return whether each line becomes another as a whole; strokes are matched so by their outlines, and better."""
    pairs = [(move.a, move.b) for move in moves]
    return all(p is not None and q is not None and not (p.is_piece or q.is_piece) for p, q in pairs)


def _moves(a: Sequence[PenLine], b: Sequence[PenLine]) -> tuple[list[Move], float, float]:
    """Return how the lines of one drawing become those of the other.

    Also the share of their length that stays, and the largest share that has no partner in either drawing.
    """
    centres = _centre(a), _centre(b)
    runs = common_runs(a, b)
    resting = (
        {run.a for run in runs if run.length > 0.9 * a[run.a].length},
        {run.b for run in runs if run.length > 0.9 * b[run.b].length},
    )
    together = [pair for pair in travelling(a, b) if pair.a not in resting[0] and pair.b not in resting[1]]
    if len(together) < 2:
        together = []
    taken = {pair.a for pair in together}, {pair.b for pair in together}
    runs = [run for run in runs if run.a not in taken[0] and run.b not in taken[1]]
    moves = [staying(each, a, b) for each in stayed(a, b, runs)]
    moves += [becoming(a[p.a], b[p.b], p.points_a, p.points_b) for p in together]
    shorter = min(sum(line.length for line in lines) for lines in (a, b))
    kept = sum(run.length for run in runs) / max(shorter, 1e-9)
    used = {run.a for run in runs} | taken[0], {run.b for run in runs} | taken[1]
    free = [
        [line for k, line in enumerate(lines) if k not in done]
        for lines, done in zip((a, b), used, strict=True)
    ]
    found = least_work(free[0], free[1], centres)
    moves += [becoming(found.a[p.a], found.b[p.b], p.points_a, p.points_b) for p in found.pairs]
    copies = _copies(found, moves)
    moves += copies
    loose = 0.0
    for side, lines in enumerate((found.a, found.b)):
        paired = {(pair.a, pair.b)[side] for pair in found.pairs}
        others = [line for k, line in enumerate((a, b)[side]) if k in used[side]]
        others += [line for k, line in enumerate(lines) if k in paired]
        copied = {id((move.a, move.b)[side]) for move in copies}
        left = [line for k, line in enumerate(lines) if k not in paired and id(line) not in copied]
        moves += [alone(line, others, is_new=bool(side)) for line in left]
        whole = sum(line.length for line in (a, b)[side])
        loose = max(loose, sum(line.length for line in left) / max(whole, 1e-9))
    return moves, kept, loose


def _as_whole(a: Sequence[PenLine], b: Sequence[PenLine]) -> list[Move] | None:
    """Turn or flip a drawing as a whole, if that gives the other one; None if it does not, or if much stays."""
    if _covers(a, b, _outlines(a), LEAST_TURNED):
        return None
    centre, target = _centre(a), _centre(b)
    ways: list[dict[str, complex]] = [{"angle": np.pi / 2}, {"angle": -np.pi / 2}, {"angle": np.pi}]
    ways += [{"axis": 1.0 + 0j}, {"axis": 1j}]
    for way in ways:
        moving = [Whole(points, centre, target, **way) for points in _outlines(a)]  # type: ignore[arg-type]
        if not _covers(a, b, [each.points(1.0) for each in moving], 1.0):
            continue
        reason = FLIPPED if "axis" in way else TURNED
        nearest = _partners_of(moving, b)
        return [
            Move(line, b[other], Pen((each,), closed=line.closed), reason)
            for line, each, other in zip(a, moving, nearest, strict=True)
        ]
    return None


def _outlines(lines: Sequence[PenLine]) -> list[ComplexArray]:
    return [line.outline if len(line.points) > 1 else np.repeat(line.points, 2) for line in lines]


def _partners_of(moving: Sequence[Whole], b: Sequence[PenLine]) -> list[int]:
    """Return the line of B on which each moved line ends up, for its paint."""
    middles = [complex(each.points(1.0).mean()) for each in moving]
    return [
        int(np.argmin([foot_points(np.array([middle]), points)[0][0] for points in _outlines(b)]))
        for middle in middles
    ]


def _covers(a: Sequence[PenLine], b: Sequence[PenLine], moved: Sequence[ComplexArray], least: float) -> bool:
    """Return whether the lines of A, moved, lie on those of B along a share of both, and the reverse."""
    there = _outlines(b)
    width = min(line.width for line in (*a, *b))
    for lines, others in ((moved, there), (there, moved)):
        points = np.concatenate([evenly(line, 0.3) for line in lines])
        away = np.min([foot_points(points, other)[0] for other in others], axis=0)
        if np.mean(away < SAME_PLACE * width) < least:
            return False
    return True


def _centre(lines: Sequence[PenLine]) -> complex:
    return Box.around(np.concatenate([line.points for line in lines])).centre


def _copies(found: Assignment, moves: Sequence[Move]) -> list[Move]:
    """Let a closed line without a partner come out of, or go into, the partner of one that is like it."""
    copies = []
    for side, lines in enumerate((found.a, found.b)):
        paired = {(pair.a, pair.b)[side] for pair in found.pairs}
        for k, line in enumerate(lines):
            if k in paired or not line.closed:
                continue
            like = [
                (own, other)
                for move in moves
                for own, other in [(move.a, move.b) if side == 0 else (move.b, move.a)]
                if own is not None
                and other is not None
                and own.closed
                and other.closed
                and _is_like(own, line)
                and _is_like(other, line)
            ]
            if like:
                _, other = min(like, key=lambda each: abs(_centre([each[0]]) - _centre([line])))
                ends = (line, other) if side == 0 else (other, line)
                _, a, b = partner_cost(*ends)
                copies.append(becoming(*ends, a, b)._replace(reason=COPY))
    return copies


def _is_like(p: PenLine, q: PenLine) -> bool:
    """Return whether two closed lines have about the same size."""
    boxes = [Box.around(line.points) for line in (p, q)]
    size = max(box.larger_side for box in boxes)
    return (
        abs(p.length - q.length) < 0.15 * p.length
        and abs(boxes[0].width - boxes[1].width) < 0.15 * size
        and abs(boxes[0].height - boxes[1].height) < 0.15 * size
    )
