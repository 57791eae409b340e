"""Pen lines that turn, or are flipped, as a whole."""

from __future__ import annotations

from itertools import permutations
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.grouping import grouped
from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.geometry.polyline import cumulative_lengths
from shapeblend_cli.model import Box
from shapeblend_cli.motion.pen import Pen, TurnedLine
from shapeblend_cli.pens.line import at, each_once, evenly, foot_points, length
from shapeblend_cli.pens.moves import Move, alike

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray
    from shapeblend_cli.pens.line import PenLine

LEAST_TURNED = 0.5
"""Minimum share of lines that stay where they are for a drawing not to be turned or flipped as a whole."""

SAME_PLACE = 0.35
"""Maximum distance of lines that are in one place, in widths."""

MOST_LEAVES = 0.7
"""Maximum share of lines that are in place in both drawings, around the rest, for them to leave it on the way."""

LEAST_RESTS = 0.85
"""Minimum share of such lines that is in place on the way for more of them to turn, as a ring around what turns."""

STEP = 0.3
"""Maximum distance of the points along lines that are compared, in units."""

LEAST_COPIED = 0.9
"""Minimum share of lines that a turn or flip brings to their place for the drawing to be turned or flipped."""

EXACT = 0.01
"""Maximum distance of lines that are the same, in units."""

LEAST_OF_SIGN = 2
"""Minimum number of lines of a sign among other lines that turns."""

LEAST_WAY = 1.0
"""Minimum mean way that places of such a sign would go without, in units."""

TIMES = (0.0, 1.0), (0.25, 0.5, 0.75)
"""Times at which such a sign is at its ends, and in between."""

TOUCHING = 0.9
"""Maximum distance of lines that touch, in widths."""

MOST_OF_SIGN = 4
"""Maximum number of lines of a sign that turns."""

MOST_LEFT = 0.35
"""Maximum way that places of a sign go besides turning, as a share of the way that they go without."""

SIGN_TURNED = "a sign is turned as a whole"
TURNED, FLIPPED = "the drawing is turned as a whole", "the drawing is flipped as a whole"


def as_whole(a: Sequence[PenLine], b: Sequence[PenLine]) -> list[Move] | None:
    """Turn or flip a drawing as a whole, if that gives the other one; None if it does not, or if much stays."""
    if _covers(a, b, _outlines(a), LEAST_TURNED) and _covers_by_kind(a, b):
        return None
    centre, target = centre_of(a), centre_of(b)
    ways: list[dict[str, complex]] = [{"angle": np.pi / 2}, {"angle": -np.pi / 2}, {"angle": np.pi}]
    ways += [{"axis": 1.0 + 0j}, {"axis": 1j}]
    for way in ways:
        moving = [TurnedLine(points, centre, target, **way) for points in _outlines(a)]  # type: ignore[arg-type]
        if not _covers(a, b, [each.points(1.0) for each in moving], LEAST_COPIED):
            continue
        stays = _staying(a, b)
        if stays is not None and ("axis" in way or not _rests(TurnedLine(stays, centre, target, **way), a)):  # type: ignore[arg-type]
            continue
        reason = FLIPPED if "axis" in way else TURNED
        nearest = _partners_of(moving, b)
        return [
            Move(line, b[other], Pen((_onto(each, b),), closed=line.closed), reason)
            for line, each, other in zip(a, moving, nearest, strict=True)
        ]
    return None


def sign_turned(a: Sequence[PenLine], b: Sequence[PenLine]) -> list[Move] | None:
    """Turn a sign of several lines by half a turn, if that nearly gives the other one; None if it does not.

    An i becomes an exclamation mark so: its dot would pass through its stem.
    """
    if len(a) != len(b) or not (_may_turn(a) and _may_turn(b)):
        return None
    centre, target = centre_of(a), centre_of(b)
    moving = [TurnedLine(points, centre, target, angle=np.pi) for points in _outlines(a)]
    moved, least = _nearest([each.points(1.0) for each in moving], _outlines(b))
    if least > MOST_LEFT * _nearest(_outlines(a), _outlines(b))[1]:
        return None
    found = []
    for line, each, (other, image) in zip(a, moving, moved, strict=True):
        own, image = alike(each.a, image)
        whole = each._replace(a=own)
        whole = whole._replace(left=image - whole.points(1.0))
        found.append(Move(line, b[other], Pen((whole,)), SIGN_TURNED))
    return found


def signs_turned(a: Sequence[PenLine], b: Sequence[PenLine]) -> list[Move] | None:
    """Turn the signs of a drawing by half a turn each, if that nearly gives those of the other; None if it does not.

    Signs are lines that touch. Arrows that point the other way stay arrows so: they would be crosses half way.
    """
    signs, others = _signs(a), _signs(b)
    if len(signs) != len(others):
        return None
    moves: list[Move] = []
    for sign in signs:
        ways = [abs(centre_of(other) - centre_of(sign)) for other in others]
        turned = sign_turned(sign, others.pop(int(np.argmin(ways))))
        if turned is None:
            return None
        moves += turned
    return moves


def turned_among(
    a: Sequence[PenLine], b: Sequence[PenLine], bodies: Sequence[ComplexArray]
) -> tuple[list[Move], list[PenLine], list[PenLine]]:
    """Return how signs that are turned where they are move, and the other lines of both drawings.

    A shaft that stays while its head is folded over would be a cross half way. Signs do not turn that would run into
    other lines, or lie in bodies, polygons in units.
    """
    moves: list[Move] = []
    rest, others = list(a), list(b)
    if min(len(a), len(b)) < LEAST_OF_SIGN:
        return moves, rest, others
    signs = [[sign for sign in _signs(lines) if _may_turn(sign)] for lines in (a, b)]
    for sign in signs[0]:
        there = [other for other in signs[1] if len(other) == len(sign)]
        if not there:
            continue
        other = min(there, key=lambda each: abs(centre_of(each) - centre_of(sign)))
        if _nearest(_outlines(sign), _outlines(other))[1] < LEAST_WAY:
            continue
        found = sign_turned(sign, other)
        beside = [line for side, own in ((a, sign), (b, other)) for line in _without(side, own)]
        if found is not None and not _run_into(found, beside, bodies):
            moves += found
            signs[1] = [each for each in signs[1] if each is not other]
            rest, others = _without(rest, sign), _without(others, other)
    return moves, rest, others


def _without(lines: Sequence[PenLine], some: Sequence[PenLine]) -> list[PenLine]:
    return [line for line in lines if not any(line is each for each in some)]


def _run_into(moves: Sequence[Move], beside: Sequence[PenLine], bodies: Sequence[ComplexArray]) -> bool:
    """Return whether lines that turn touch others more than at their ends, or lie in bodies."""
    for move in moves:
        ends, middle = [np.concatenate([evenly(move.motion.points(t), 0.5) for t in some]) for some in TIMES]
        reach = TOUCHING * max(line.width for line in (move.a, move.b) if line is not None)
        for body in bodies:
            near = foot_points(middle, np.append(body, body[0]))[0].min()
            if near < reach or winding_numbers(np.append(ends, middle), body).any():
                return True
        for line in beside:
            apart = [float(foot_points(points, line.drawn)[0].min()) for points in (ends, middle)]
            if apart[1] < min(apart[0], TOUCHING * line.width):
                return True
    return False


def _may_turn(sign: Sequence[PenLine]) -> bool:
    return LEAST_OF_SIGN <= len(sign) <= MOST_OF_SIGN and not any(line.closed for line in sign)


def _signs(lines: Sequence[PenLine]) -> list[list[PenLine]]:
    """Return lines in groups of those that touch."""
    together = np.array([[_touch(line, other) for other in lines] for line in lines])
    return [[lines[k] for k in group] for group in grouped(together)]


def _touch(line: PenLine, other: PenLine) -> bool:
    """Return whether an end of one of two lines lies on the other one."""
    return any(
        bool((foot_points(each.drawn[[0, -1]], onto.drawn)[0] < onto.reach).any())
        for each, onto in ((line, other), (other, line))
    )


def _nearest(
    lines: Sequence[ComplexArray], others: Sequence[ComplexArray]
) -> tuple[list[tuple[int, ComplexArray]], float]:
    """Return which line becomes which other, in what direction, and how far their places move, in units.

    It is the mean over lines of the mean over places.
    """
    places = np.linspace(0.0, 1.0, 9)
    sampled = [[at(each, places * length(each)) for each in side] for side in (lines, others)]
    ways = [[[np.abs(p - q).mean(), np.abs(p - q[::-1]).mean()] for q in sampled[1]] for p in sampled[0]]
    costs = np.array(ways)
    order = min(
        permutations(range(len(others))), key=lambda order: sum(costs[range(len(lines)), order].min(1))
    )
    found = []
    for k, other in enumerate(order):
        is_back = costs[k, other, 1] < costs[k, other, 0]
        found.append((other, others[other][::-1] if is_back else others[other]))
    return found, float(np.mean([costs[k, other].min() for k, other in enumerate(order)]))


def _onto(moving: TurnedLine, b: Sequence[PenLine]) -> TurnedLine:
    """Let a line that is turned or flipped end exactly on the lines of B."""
    ends = moving.points(1.0)
    if max(np.min([foot_points(ends, line)[0] for line in _outlines(b)], axis=0)) < EXACT:
        return moving
    known = np.concatenate(
        [np.linspace(0.0, length(moving.a), len(evenly(moving.a, 0.2))), cumulative_lengths(moving.a)]
    )
    moving = moving._replace(a=at(moving.a, each_once(known)))
    ends = moving.points(1.0)
    feet = [(foot[0], at(line, foot[1])) for line in _outlines(b) for foot in [foot_points(ends, line)]]
    nearest = np.argmin([away for away, _ in feet], axis=0)
    return moving._replace(left=np.choose(nearest, [places for _, places in feet]) - ends)


def _outlines(lines: Sequence[PenLine]) -> list[ComplexArray]:
    return [line.drawn for line in lines]


def _partners_of(moving: Sequence[TurnedLine], b: Sequence[PenLine]) -> list[int]:
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
        points = np.concatenate([evenly(line, STEP) for line in lines])
        away = np.min([foot_points(points, other)[0] for other in others], axis=0)
        if np.mean(away < SAME_PLACE * width) < least or (least > LEAST_TURNED and away.max() > width):
            return False
    return True


def _staying(a: Sequence[PenLine], b: Sequence[PenLine]) -> ComplexArray | None:
    """Return points along A's lines where B's lie, too; None if that is not most of them, or not around the rest."""
    points = np.concatenate([evenly(line, STEP) for line in _outlines(a)])
    staying = points[_are_near(points, b, SAME_PLACE * min(line.width for line in (*a, *b)))]
    if len(staying) <= MOST_LEAVES * len(points):
        return None
    return staying if Box.around(points).is_enclosed_by(staying) else None


def _rests(points: TurnedLine, lines: Sequence[PenLine]) -> bool:
    """Return whether points that turn are on some lines on the way, too."""
    reach = SAME_PLACE * min(line.width for line in lines)
    return all(_are_near(points.points(t), lines, reach).mean() >= LEAST_RESTS for t in (1 / 3, 1 / 2))


def _are_near(points: ComplexArray, lines: Sequence[PenLine], reach: float) -> BoolArray:
    """Return which points are within reach of any of some lines."""
    near: BoolArray = np.min([foot_points(points, line)[0] for line in _outlines(lines)], axis=0) < reach
    return near


def _covers_by_kind(a: Sequence[PenLine], b: Sequence[PenLine]) -> bool:
    """Return whether closed lines lie on closed ones, and open lines on open ones, along enough of all.

    The bar of a skip button lies on a side of the triangle that skips the other way, and does not stay there.
    """
    whole = min(sum(line.length for line in lines) for lines in (a, b))
    kinds = [
        [[line for line in lines if line.closed is closed] for lines in (a, b)] for closed in (False, True)
    ]
    alike = [(p, q) for p, q in kinds if p and q and _covers(p, q, _outlines(p), LEAST_TURNED)]
    kept = sum(min(sum(line.length for line in lines) for lines in pair) for pair in alike)
    return kept >= LEAST_TURNED * whole


def centre_of(lines: Sequence[PenLine]) -> complex:
    """Return the centre of the box around lines."""
    return Box.around(np.concatenate([line.points for line in lines])).centre
