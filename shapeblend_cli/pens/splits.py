"""A line that splits into two, or two that join: play to pause, the bars of a list to boxes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.model import Box
from shapeblend_cli.motion.pen import Drawing, Pen, between
from shapeblend_cli.pens.line import corners
from shapeblend_cli.pens.line_costs import alone_cost, best_halves, partner_cost
from shapeblend_cli.pens.moves import Move, alike, becoming, smooth

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.pens.line import PenLine
    from shapeblend_cli.pens.partners import Assignment

COPY = "a pen line that splits, or joins another like it"

SAME_SIZE = 0.15
"""Tolerance of the sizes of closed lines of which one splits into the others, as a share."""

COPY_SIZE = 0.4
"""Tolerance of the sizes of closed lines of which one comes out of the other, as a share."""


SHUT = 0.25
"""Share of the time in which halves of a ring are shut: open, they would look torn."""


def split_moves(found: Assignment, moves: Sequence[Move]) -> tuple[list[Move], set[int], set[int]]:
    """Let lines without a partner come out of, or go into, the partner of one that is like them.

    Return the moves of all pairs, with those of the lines that come out of one or go into one, and the numbers of these
    lines in A and in B. Other lines without a partner are still alone.
    """
    twice: dict[tuple[int, int], list[int]] = {}
    for pair in found.pairs:
        twice.setdefault((0, pair.a), []).append(pair.b)
        twice.setdefault((1, pair.b), []).append(pair.a)
    paired = {pair.a for pair in found.pairs}, {pair.b for pair in found.pairs}
    free: list[Move] = []
    copied: tuple[set[int], set[int]] = set(), set()
    for side, lines in enumerate((found.a, found.b)):
        for k, line in enumerate(lines):
            if k in paired[side]:
                continue
            source = _source(line, k, side, found, twice)
            if source is not None:
                twice[source].append(k)
                copied[side].add(k)
            elif line.closed and (copy := _copy(line, side, moves)) is not None:
                free.append(copy)
                copied[side].add(k)
    several = {key: others for key, others in twice.items() if len(others) == 2}
    split: list[Move] = []
    for (side, k), others in several.items():
        one, many = (found.a, found.b) if side == 0 else (found.b, found.a)
        split += splitting(one[k], [many[j] for j in others], joins=side == 1)
    used = {k for side, k in several if side == 0}, {k for side, k in several if side == 1}
    for pair in found.pairs:
        if pair.a not in used[0] and pair.b not in used[1]:
            free.append(becoming(found.a[pair.a], found.b[pair.b], pair.points_a, pair.points_b))
    return free + split, copied[0], copied[1]


def _source(
    line: PenLine, number: int, side: int, found: Assignment, twice: dict[tuple[int, int], list[int]]
) -> tuple[int, int] | None:
    """Return the line of the other drawing out of which a line without a partner had best come, with its side."""
    own, others = (found.a, found.b) if side == 0 else (found.b, found.a)
    best: tuple[float, tuple[int, int] | None] = 0.0, None
    for (other_side, k), partners in twice.items():
        if (
            other_side == side
            or not others[k].closed
            or len(partners) != 1
            or len(twice[side, partners[0]]) != 1
        ):
            continue
        like = own[partners[0]]
        if not is_like(like, line, SAME_SIZE) or is_like(others[k], line, SAME_SIZE):
            continue
        others_like = [j for s, j in twice if s == side and is_like(own[j], line, SAME_SIZE)]
        away = [abs(line.centre - own[j].centre) for j in (partners[0], *others_like)]
        if others[k].length < 2.0 * others[k].width or sum(each < away[0] + 0.5 for each in away) > 2:
            continue  # too short to be cut, or as near to another one that is like it: the middle of three goes alone
        halves = best_halves(others[k], [like, line])
        before = partner_cost(like, others[k])[0] + alone_cost(line)
        gain = before - sum(half.cost for half in halves)
        if gain > best[0]:
            best = gain, (other_side, k)
    return best[1]


def splitting(line: PenLine, targets: Sequence[PenLine], *, joins: bool) -> list[Move]:
    """Split a line into two others, or let these join to be that one."""
    if line.closed and all(is_like(line, target, SAME_SIZE) for target in targets):
        return [_copied(line, target, joins=joins) for target in targets]
    moves = []
    for half, target in zip(best_halves(line, targets), targets, strict=True):
        if half.tails is None:
            own = line._replace(points=half.piece, closed=False)
            pair = (target, own) if joins else (own, target)
            ends = (half.target, half.ends) if joins else (half.ends, half.target)
            moves.append(becoming(*pair, *ends)._replace(reason=COPY))
            continue
        by_corners = len(corners(half.ends)) == len(corners(half.target))
        ends = alike(half.ends, half.target, by_corners=by_corners)  # else both sides alike
        before, after = (target, line) if joins else (line, target)
        shares = (1.0, 0.0) if joins else (0.0, 1.0)
        span = (1.0 - SHUT, 1.0) if joins else (0.0, SHUT)
        first, last = (Drawing(smooth(tail), *shares, span=span) for tail in half.tails)
        pieces = between(*(ends[::-1] if joins else ends), closed=True)
        moves.append(Move(before, after, Pen((pieces,), (first, last)), COPY))
    return moves


def _copied(line: PenLine, target: PenLine, *, joins: bool) -> Move:
    ends = (target, line) if joins else (line, target)
    return becoming(*ends, *partner_cost(*ends)[1:])._replace(reason=COPY)


def _copy(line: PenLine, side: int, moves: Sequence[Move]) -> Move | None:
    """Let a closed line come out of, or go into, the partner of one that is like it."""
    like = [
        (own, other)
        for move in moves
        for own, other in [(move.a, move.b) if side == 0 else (move.b, move.a)]
        if own is not None
        and other is not None
        and is_like(own, line, COPY_SIZE)
        and is_like(other, line, COPY_SIZE)
    ]
    if not like:
        return None
    _, other = min(like, key=lambda each: abs(each[0].centre - line.centre))
    return _copied(other, line, joins=side == 0)


def is_like(p: PenLine, q: PenLine, tolerance: float) -> bool:
    """Return whether two lines have about the same size: both closed, or both straight."""
    boxes = [Box.around(line.points) for line in (p, q)]
    size = max(box.larger_side for box in boxes)
    return (
        p.closed == q.closed
        and abs(p.length - q.length) <= tolerance * p.length
        and abs(boxes[0].width - boxes[1].width) <= tolerance * size
        and abs(boxes[0].height - boxes[1].height) <= tolerance * size
    )
