"""What it costs that a line becomes another, or two, or has no partner."""

from __future__ import annotations

from functools import lru_cache
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.geometry.polyline import cumulative_lengths
from shapeblend_cli.model import Box
from shapeblend_cli.pens.line import at, corners, evenly, length, part_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapeblend_cli.model import ComplexArray, FloatArray
    from shapeblend_cli.pens.line import PenLine

REACH = 8.0
"""Distance that costs as much as a line's length, in units."""

FARTHEST = 1.5
"""Cost of the farthest way, as a share of a line's length: what moves at all may as well move far."""

SHIFT = 0.6
"""Weight of the common shift of all points of a line, against distances that differ along it."""

BEND_COST = 0.5
"""Cost of turning every part of a line round by half a turn, as a share of its length."""

TURN_COST = 0.4
"""Cost of turning a line as a whole by half a turn, as a share of its length: a corner rather opens and turns over."""

STRETCH_COST = 0.3
"""Cost of a change of length, as a share of it."""

CRUMPLES = 2.5
"""Minimum ratio of the lengths of two lines of which the longer one crumples up."""

CRUMPLE_COST = 0.6
"""Cost of the length that crumples, as a share of it."""

TORN_OFF_COST = 1.2
"""Cost of the same for a bow, as a share of the length: it is torn off what it stands on, too."""

CLOSING_COST = 0.25
"""Cost of opening or closing a line, as a share of its length."""

OPENING_COST = 0.1
"""The same where lines are brush strokes, which hide the cut."""

PRESSED_BENT_COST = 0.4
"""Cost of pressing a round ring to a bent line, as a share of their length: it opens as well, but one with corners
keeps these as kinks then."""

ROUND = 0.92
"""Minimum area of a round ring, as a share of the area of a circle of its length."""

DOT = 0.5, 1.1
"""Sizes of a ring that its stroke fills and that is more than a point, in widths."""

STRAIGHT = 0.9
"""Minimum distance of the ends of a line that is not bent, as a share of its length."""

STARTS = 24
"""Starts of a closed line that are compared."""

WATCHED = 17
"""Number of points of a line that are compared."""

PRESSED_STEP = 0.3
"""Distance of the points of a closed line that is pressed flat, in units."""

LONELY_COST = 0.6
"""Cost of a line without a partner, as a share of its length and width."""

LONG = 100.0
"""Length of a line that costs twice as much per unit as a short one if it has no partner, in units."""

LEFTOVER_COST = 1.2
"""Cost of a piece of a cut line without a partner, as a share of its length and width: pieces that float look torn."""

FACING = 512
"""Number of points of a closed line among which the side that faces a cut is found."""

LEVEL = 0.02
"""Tolerance of the side that faces a cut, as a share of the size of the line."""

STRAIGHT_SIDE = 0.12
"""Minimum share of the length of a closed line that is a straight side."""

ROUNDING = 0.06
"""Tolerance of a straight side with half of the rounding at its corners, as a share of the size of the line."""

MOST_CORNERS = 8
"""Maximum number of corners of a closed line that may be cut at two of them."""


def ways_between(p: PenLine, q: PenLine) -> list[tuple[ComplexArray, ComplexArray]]:
    """Return the polylines as which two lines may be matched: both directions, and the starts of a closed one."""
    if p.closed and not q.closed:
        return [(one, q.outline) for one in _turned(p).outlines]
    return [(p.outline, other) for other in _turned(q).outlines]


class _Turned(NamedTuple):
    """A line in both directions, a closed one from several starts, and points along each."""

    outlines: list[ComplexArray]
    points: ComplexArray  # (outlines, WATCHED)

    @classmethod
    def of(cls, outlines: Sequence[ComplexArray]) -> _Turned:
        """Put points along polylines."""
        both = [each for outline in outlines for each in (outline, outline[::-1])]
        return cls(both, np.array([_watched(each) for each in both]))


def _turned(line: PenLine) -> _Turned:
    return _turned_once(line.points.tobytes(), line.closed)


@lru_cache(maxsize=256)
def _turned_once(points: bytes, closed: bool) -> _Turned:
    """Turn a line, which may become any of many others, once."""
    outline = np.frombuffer(points, np.complex128)
    if not closed:
        return _Turned.of([outline])
    outline = np.append(outline, outline[0])
    starts = np.arange(STARTS) * length(outline) / STARTS
    return _Turned.of([part_of(outline, True, start, start) for start in starts])


def _watched(outline: ComplexArray) -> ComplexArray:
    """Return points evenly along a polyline."""
    return at(outline, np.linspace(0.0, 1.0, WATCHED) * length(outline))


def _pressed(ring: PenLine, line: PenLine) -> tuple[ComplexArray, ComplexArray]:
    """Return a closed line, and each of its points on an open one to which it is pressed flat."""
    points = evenly(ring.outline, PRESSED_STEP)
    other = line.drawn
    chord = complex(other[-1] - other[0])
    along = (points * (chord.conjugate() if chord else 1.0)).real
    shares = (along - along.min()) / max(float(np.ptp(along)), 1e-12)
    return points, at(other, shares * length(other))


def work_between(points: ComplexArray, images: ComplexArray) -> FloatArray:
    """Return what it costs to move points, which follow each other along a line, to others; for a line of length 1.

    Points lie along the last axis.
    """
    apart = points - images
    shift = np.mean(apart, axis=-1)
    distance = np.mean(np.abs(apart) ** 2, axis=-1) - (1.0 - SHIFT) * np.hypot(shift.real, shift.imag) ** 2
    turns = np.angle((np.diff(images) + 1e-9) / (np.diff(points) + 1e-9))
    whole = np.angle(np.exp(1j * turns).mean(axis=-1))
    bends = BEND_COST * np.abs(turns).mean(axis=-1)
    rest = np.angle(np.exp(1j * (turns - whole[..., None])))
    turned = BEND_COST * np.abs(rest).mean(axis=-1) + TURN_COST * np.abs(whole)
    distance = distance / REACH**2
    return np.asarray(distance / (1.0 + distance / FARTHEST) + np.minimum(bends, turned) / np.pi)


def partner_cost(p: PenLine, q: PenLine) -> tuple[float, ComplexArray, ComplexArray]:
    """Return what it costs that a line becomes another, and their polylines then.

    A closed line opens to become an open one, or is pressed flat.
    """
    mean = (p.length + q.length) / 2.0
    ways = ways_between(p, q)
    short, long = sorted((p.length, q.length))
    stretch = STRETCH_COST * (long - short)
    if short > p.width:
        crumpling = TORN_OFF_COST if (p if p.length == long else q).is_bow else CRUMPLE_COST
        stretch += crumpling * max(0.0, long - CRUMPLES * short)
    closing = CLOSING_COST * mean if p.closed != q.closed else 0.0
    if p.closed and not q.closed:
        works = work_between(_turned(p).points, _watched(q.outline))
    else:
        works = work_between(_watched(p.outline), _turned(q).points)
    costs = (mean * works + stretch + closing).tolist()
    if p.closed != q.closed:
        pressed = _pressed(p, q) if p.closed else _pressed(q, p)[::-1]
        ring, line = (p, q) if p.closed else (q, p)
        if _is_dot(ring):  # a line that bends round to one would curl up
            ways, costs = [], []
        ways.append(pressed)
        steps = np.linspace(0, len(pressed[0]) - 1, WATCHED).round().astype(np.intp)
        work = mean * float(work_between(pressed[0][steps], pressed[1][steps]))
        is_bent = line.is_piece or abs(line.points[-1] - line.points[0]) < STRAIGHT * line.length
        bending = PRESSED_BENT_COST * mean if is_bent and _is_round(ring) else 0.0
        costs.append(work + STRETCH_COST * abs(ring.length - 2.0 * line.length) + closing + bending)
    best = int(np.argmin(costs))
    return costs[best], *ways[best]


def opening_cost(p: PenLine, q: PenLine) -> tuple[float, ComplexArray, ComplexArray]:
    """Return what it costs that a line becomes another, and their polylines then; a closed line opens for an open one.

    Unlike `partner_cost`, it presses none flat: the sides of a broad ring would show.
    """
    ways = ways_between(p, q)
    works = work_between(*(np.array([_watched(way[side]) for way in ways]) for side in (0, 1)))
    mean = (p.length + q.length) / 2.0
    short, long = sorted((p.length, q.length))
    cost = STRETCH_COST * (long - short) + CRUMPLE_COST * max(0.0, long - CRUMPLES * short)
    cost += OPENING_COST * mean if p.closed != q.closed else 0.0
    best = int(np.argmin(works))
    return mean * float(works[best]) + cost, *ways[best]


def _is_dot(ring: PenLine) -> bool:
    """Return whether a ring is drawn as a dot, which its stroke fills."""
    return DOT[0] <= Box.around(ring.points).larger_side / ring.width <= DOT[1]


def _is_round(ring: PenLine) -> bool:
    """Return whether a ring is about a circle."""
    return 4.0 * np.pi * abs(signed_area(ring.points)) >= ROUND * ring.length**2


def alone_cost(line: PenLine) -> float:
    """Return what it costs that a line has no partner."""
    cost = LEFTOVER_COST if line.is_piece else LONELY_COST
    return cost * (line.length + line.width) * (1.0 + line.length / LONG)


class Half(NamedTuple):
    """A piece of a line and what it becomes, with the tails that close it."""

    cost: float
    piece: ComplexArray  # of the line
    ends: ComplexArray  # the same, as it becomes the target
    target: ComplexArray
    tails: tuple[ComplexArray, ComplexArray] | None = None


def best_halves(line: PenLine, targets: Sequence[PenLine]) -> list[Half]:
    """Cut a line in two so that its pieces become two others with the least work."""
    tries = []
    for halves in _halves(line, targets):
        for order in (halves, halves[::-1]):
            tries.append([_half(line, piece, q) for piece, q in zip(order, targets, strict=True)])
    return min(tries, key=lambda each: sum(half.cost for half in each))


def _halves(line: PenLine, targets: Sequence[PenLine]) -> Iterator[tuple[ComplexArray, ComplexArray]]:
    """Yield the ways of cutting a line: an open one in its middle, a closed one across or at two corners."""
    whole = line.length
    if not line.closed:
        yield line.part(0.0, whole / 2.0), line.part(whole / 2.0, whole)
        return
    points = line.outline
    way = targets[1].centre - targets[0].centre
    ahead = ((points - line.centre) * way.conjugate()).real
    before = np.flatnonzero((ahead[:-1] > 0.0) != (ahead[1:] > 0.0))
    along = cumulative_lengths(points)
    shares = ahead[before] / (ahead[before] - ahead[before + 1])
    places = along[before] + shares * (along[before + 1] - along[before])
    if len(places) != 2:
        places = np.array([0.0, whole / 2.0])
    cuts = [(float(places[0]), float(places[1]))]
    if not all(target.closed for target in targets):
        turned = (line.part(start, start) for start in (0.0, whole / 3.0))
        bends = {
            round((share * whole + start) % whole, 2)
            for each, start in zip(turned, (0.0, whole / 3.0), strict=True)
            for share in corners(each)
        }
        if len(bends) <= MOST_CORNERS:
            cuts += list(combinations(sorted(bends), 2))
    for low, high in cuts:
        yield line.part(low, high), line.part(high, low)


def _half(line: PenLine, piece: ComplexArray, target: PenLine) -> Half:
    """Return what it costs that a piece of a line becomes another, and how."""
    if not (line.closed and target.closed):
        cost, one, other = partner_cost(line._replace(points=piece, closed=False), target)
        return Half(cost, piece, one, other)
    whole, chord = target.length, abs(piece[-1] - piece[0])
    way = (piece[0] + piece[-1]) / 2.0 - evenly(piece, PRESSED_STEP).mean()
    across = 1j * (piece[-1] - piece[0])  # to the cut: a piece that is not quite even would look past it
    way = across if (across * way.conjugate()).real > 0.0 else -across
    ring = target.part(0.0, 0.0)
    # Of a straight side that faces the cut, the middle.
    facing = np.linspace(0.0, whole, FACING + 1)[:-1]
    reach = ((at(ring, facing) - target.centre) * way.conjugate()).real
    far = facing[reach > reach.max() - LEVEL * np.ptp(reach)]
    if len(far) >= STRAIGHT_SIDE * FACING:  # it is drawn on from its corners, half of their rounding with it
        share = float((reach > reach.max() - ROUNDING * np.ptp(reach)).mean())
    else:
        share = min(max(chord / (length(piece) + chord), 0.1), 0.5)
    middle = float(np.angle(np.exp(2j * np.pi * far / whole).mean()) / (2.0 * np.pi) * whole) % whole
    low, high = (middle - share * whole / 2.0) % whole, (middle + share * whole / 2.0) % whole
    rest = target.part(high, low)
    tails = target.part(middle, high)[::-1], target.part(low, middle)
    own = _watched(piece)
    tries = [
        (float(work_between(own, _watched(each))), each, closing)
        for each, closing in ((rest, tails), (rest[::-1], tails[::-1]))
    ]
    work, rest, tails = min(tries, key=lambda each: each[0])
    mean = (length(piece) + whole) / 2.0
    return Half(mean * work + 0.3 * abs(length(piece) - length(rest)), piece, piece, rest, tails)
