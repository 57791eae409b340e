"""What stays of one set of lines in another: runs along which lines of both lie on each other.

Runs that follow each other in both drawings make one line that stays, and so does a piece between them that differs.
What else a line has beyond its runs is a tail: it is drawn back or on along its own curve, or becomes the other's tail.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.pens.line import at, begun, evenly, foot_points, length

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray
    from shapeblend_cli.pens.line import PenLine

STEP = 0.15
"""Distance of sample points along lines, in units."""

NEAR = 0.3
"""Maximum distance of two lines along a run, in widths."""

MOST_ANGLE = 22.0
"""Maximum angle between two lines along a run, in degrees."""

SHORTEST = 1.2
"""Minimum length of a run, in widths."""

LEAST_SHARE = 0.4
"""Minimum share of the shorter of two lines that their runs make up."""

LEAST_OF_RING = 0.32
"""Minimum share of a closed line that its runs make up: it would unravel to one of its sides."""

WHOLE = 0.995
"""Minimum share of a closed line that is all of it."""

SPREAD = 0.4
"""Distance of points of which two drawings may be shifted copies, in units."""

SAME_SLANT = 0.1
"""Maximum sine of the angle between lines at places that may be the same but for a shift."""

SHIFT_STEP = 0.2
"""Tolerance of shifts that are the same, in units."""

FARTHEST_SHIFT = 4.0
"""Maximum shift of a drawing that stays but for that, in units."""

REST_KEPT = 0.35
"""Maximum share of the shorter drawing's lines that stay in place if the drawing moves as a whole."""

MOVED_KEPT = 0.7
"""Minimum share of the shorter drawing's lines that stay but for a shift."""


class Run(NamedTuple):
    """A stretch along which a line of A lies on a line of B.

    `begin` and `end` are lengths along each; B's fall if the lines run against each other, where `way` is -1.
    """

    a: int
    b: int
    begin: tuple[float, float]
    end: tuple[float, float]
    way: int
    length: float

    def spans(self, side: int) -> tuple[float, float]:
        """Return where it begins and ends along a line of A, 0, or B, 1, in that line's direction."""
        both = self.begin[side], self.end[side]
        return both[::-1] if side and self.way < 0 else both


class Tail(NamedTuple):
    """What follows the end of a line that stays, in A and in B; from the end outwards."""

    a: ComplexArray
    b: ComplexArray


class Stayed(NamedTuple):
    """A line that stays.

    Attributes
    ----------
    lines : (int, int)
        Its first run's line of A, and of B.
    parts : list of (complex array, complex array)
        Pieces of A and what they are in B, one after the other: runs, and what lies between them.
    tails : (Tail, Tail)
        At its beginning and its end.
    closed : bool
    """

    lines: tuple[int, int]
    parts: list[tuple[ComplexArray, ComplexArray]]
    tails: tuple[Tail, Tail]
    closed: bool


def common_runs(a: Sequence[PenLine], b: Sequence[PenLine]) -> list[Run]:
    """Return the runs of two sets of lines, the longest first; none overlap."""
    found = [run for i, p in enumerate(a) for j, q in enumerate(b) for run in _runs_of(i, p, j, q)]
    together: dict[tuple[int, int], float] = {}
    for run in found:
        together[run.a, run.b] = together.get((run.a, run.b), 0.0) + run.length
    found = [
        run for run in found if together[run.a, run.b] > LEAST_SHARE * min(a[run.a].length, b[run.b].length)
    ]
    unravel = [_unravel(lines, found, side) for side, lines in enumerate((a, b))]
    found = [run for run in found if run.a not in unravel[0] and run.b not in unravel[1]]
    taken: dict[tuple[int, int], list[FloatArray]] = {}
    chosen = []
    for run in sorted(found, key=lambda run: -run.length):
        sides = [(0, run.a, a[run.a]), (1, run.b, b[run.b])]
        if any(run.spans(side)[1] < run.spans(side)[0] and not line.closed for side, _, line in sides):
            continue
        places = [_places(line, *run.spans(side), steps=24) for side, _, line in sides]
        if any(
            np.mean(np.abs(own[:, None] - other).min(axis=1) < STEP) > 0.2
            for own, (side, number, _) in zip(places, sides, strict=True)
            for other in taken.get((side, number), ())
        ):
            continue
        for side, number, line in sides:
            taken.setdefault((side, number), []).append(_places(line, *run.spans(side), steps=None))
        chosen.append(run)
    return chosen


def _unravel(lines: Sequence[PenLine], runs: Sequence[Run], side: int) -> set[int]:
    """Return the closed lines of a drawing of which too little would stay."""
    kept = [sum(run.length for run in runs if (run.a, run.b)[side] == k) for k in range(len(lines))]
    return {k for k, line in enumerate(lines) if line.closed and kept[k] < LEAST_OF_RING * line.length}


def common_shift(a: Sequence[PenLine], b: Sequence[PenLine]) -> complex:
    """Return by how much a drawing moves of which most stays but for that; 0 if more than a little stays in place."""
    some, others = (_spread(lines) for lines in (a, b))
    if not (len(some[0]) and len(others[0])):
        return 0j
    shorter = min(sum(line.length for line in lines) for lines in (a, b))
    if sum(run.length for run in common_runs(a, b)) > REST_KEPT * shorter:
        return 0j
    ways = others[0] - some[0][:, None]
    slants = np.abs((others[1] * some[1][:, None].conj()).imag)
    ways = ways[(slants < SAME_SLANT) & (np.abs(ways) < FARTHEST_SHIFT) & (np.abs(ways) > SHIFT_STEP)]
    if not len(ways):
        return 0j
    places = np.round(ways.real / SHIFT_STEP) + 1j * np.round(ways.imag / SHIFT_STEP)
    order = np.sort_complex(places)
    firsts = np.flatnonzero(np.append(True, order[1:] != order[:-1]))
    counts = np.diff(np.append(firsts, len(order)))
    most = order[firsts[int(counts.argmax())]] * SHIFT_STEP
    shift = complex(ways[np.abs(ways - most) < SHIFT_STEP].mean())
    moved = [line._replace(points=line.points - shift) for line in b]
    kept = sum(run.length for run in common_runs(a, moved))
    return shift if kept > MOVED_KEPT * shorter else 0j


def _spread(lines: Sequence[PenLine]) -> tuple[ComplexArray, ComplexArray]:
    """Return points along lines, and the directions of the lines there."""
    parts = [evenly(line.outline, SPREAD) for line in lines if len(line.points) > 1 and line.length > SPREAD]
    ways = [np.gradient(part) for part in parts]
    nothing = np.zeros(0, complex)
    return np.concatenate([nothing, *parts]), np.concatenate([nothing, *(way / np.abs(way) for way in ways)])


def _places(line: PenLine, begin: float, end: float, steps: int | None) -> FloatArray:
    """Return lengths along a line, evenly from one to another; of a closed line also through its beginning."""
    whole = line.length
    span = ((end - begin) % whole or whole) if line.closed else end - begin
    places = begin + (np.linspace(0.0, span, steps) if steps else np.arange(0.0, span, 0.1))
    return places % whole if line.closed else places


def _runs_of(i: int, p: PenLine, j: int, q: PenLine) -> list[Run]:
    """Return the runs of two lines, both ways."""
    width = min(p.width, q.width)
    along_p, along_q = p.outline, q.outline
    whole_p, whole_q = length(along_p), length(along_q)
    if min(whole_p, whole_q) < 1e-6:
        return []
    places = np.linspace(0.0, whole_p, max(3, int(whole_p / STEP) + 1))
    points = at(along_p, places)
    away, foot, slope = foot_points(points, along_q)
    near = away < NEAR * width
    if not q.closed:  # beyond an end of a line nothing lies along it
        near &= (away < STEP) | ((foot > 1e-6) & (foot < whole_q - 1e-6))
    if not near.any():
        return []
    angles = np.angle(np.gradient(points)) - slope
    found = []
    for way in (1, -1):
        fits = near & (np.abs(np.angle(way * np.exp(1j * angles), deg=True)) < MOST_ANGLE)
        if fits.all() and p.closed and q.closed:
            begin, end = (0.0, float(foot[0])), (whole_p, float(foot[0]) + way * whole_q)
            found.append(Run(i, j, begin, end, way, whole_p))
            continue
        for first, last in _stretches(fits, foot * way, p.closed, whole_q if q.closed else 0.0):
            begin, end = (float(places[first]), float(foot[first])), (float(places[last]), float(foot[last]))
            long = (end[0] - begin[0]) % whole_p if p.closed else end[0] - begin[0]
            if long > min(SHORTEST * width, 0.8 * min(whole_p, whole_q)):
                found.append(Run(i, j, begin, end, way, long))
    return found


def _stretches(fits: BoolArray, foot: FloatArray, is_ring: bool, round_: float) -> list[tuple[int, int]]:
    """Return the first and last of neighbouring points that fit while their feet advance; round a ring if need be."""
    count = len(fits)
    order = np.arange(count)
    if is_ring and fits[0] and fits[-1] and not fits.all():
        start = int(np.argmin(fits))
        order = np.concatenate([np.arange(start, count - 1), np.arange(start + 1)])
    found = []
    k = 0
    while k < len(order):
        if not fits[order[k]]:
            k += 1
            continue
        first = k
        while k + 1 < len(order) and fits[order[k + 1]]:
            step = foot[order[k + 1]] - foot[order[k]]
            if round_:
                step = (step + round_ / 2.0) % round_ - round_ / 2.0
            if not -0.05 < step < 4.0 * STEP + 0.3:
                break
            k += 1
        found.append((int(order[first]), int(order[k])))
        k += 1
    return found


def stayed(a: Sequence[PenLine], b: Sequence[PenLine], runs: Sequence[Run]) -> list[Stayed]:
    """String runs up to lines that stay, with their tails."""
    links: dict[int, tuple[int, ComplexArray | None, ComplexArray | None]] = {}
    tails: dict[tuple[int, int], Tail] = {}
    for number, run in enumerate(runs):
        if _is_whole(run, a, b):
            links[number] = number, None, None
            continue
        for end in (1, 0):
            beyond = [_beyond(lines, run, number, runs, end, side) for side, lines in enumerate((a, b))]
            (piece_a, next_a), (piece_b, next_b) = beyond
            sizes = [0.0 if piece is None else length(piece) for piece in (piece_a, piece_b)]
            goes_on = next_a is not None and next_a == next_b and runs[next_a].way == run.way
            if goes_on and max(sizes) < 4.0 * min(sizes) + 1.0:
                if end:
                    links[number] = next_a, piece_a, piece_b  # type: ignore[assignment]
                continue
            # A piece between two lines that part is drawn back from both of its ends.
            halves = [
                piece if piece is None or following is None else begun(piece, 0.5)
                for piece, following in beyond
            ]
            tails[number, end] = _tail(run, end, a, b, halves)
    return [*_strung(a, b, runs, links, tails)]


def _is_whole(run: Run, a: Sequence[PenLine], b: Sequence[PenLine]) -> bool:
    return a[run.a].closed and b[run.b].closed and run.length > WHOLE * a[run.a].length


def _beyond(
    lines: Sequence[PenLine], run: Run, number: int, runs: Sequence[Run], end: int, side: int
) -> tuple[ComplexArray | None, int | None]:
    """Return the piece of a line beyond an end of a run, outwards, up to the next run or the end; and that run."""
    which = (run.a, run.b)[side]
    line = lines[which]
    whole = line.length
    place = (run.end if end else run.begin)[side]
    way = (1 if end else -1) * (run.way if side else 1)
    best, following = (whole - place if way > 0 else place), None
    nearest = np.inf
    for other, each in enumerate(runs):
        if (each.a, each.b)[side] != which or (other == number and not line.closed):
            continue
        low, high = each.spans(side)
        ahead = ((low if way > 0 else high) - place) * way
        if line.closed:
            ahead %= whole
            ahead = 0.0 if ahead > whole - 0.02 else ahead
        if -0.11 <= ahead < nearest:
            nearest, following = ahead, other
    if following is not None:
        best = nearest
    if best <= 1e-3:
        return None, following
    begin, finish = (place, place + best) if way > 0 else (place - best, place)
    if line.closed:
        begin, finish = begin % whole, finish % whole
    piece = line.part(begin, finish)
    return (piece if way > 0 else piece[::-1]), following


def _tail(
    run: Run,
    end: int,
    a: Sequence[PenLine],
    b: Sequence[PenLine],
    pieces: Sequence[ComplexArray | None],
) -> Tail:
    """Return the tail at an end of a run; where a drawing has none, the point at the end."""
    places = run.end if end else run.begin
    sides = zip(pieces, (a[run.a], b[run.b]), places, strict=True)
    found = [
        at(line.outline, [place % line.length if line.closed else place]) if piece is None else piece
        for piece, line, place in sides
    ]
    return Tail(*found)


def _strung(
    a: Sequence[PenLine],
    b: Sequence[PenLine],
    runs: Sequence[Run],
    links: Mapping[int, tuple[int, ComplexArray | None, ComplexArray | None]],
    tails: Mapping[tuple[int, int], Tail],
) -> list[Stayed]:
    """Follow the links from run to run, and return each chain as one line that stays."""
    followers = {following for following, _, _ in links.values()}
    order = sorted(range(len(runs)), key=lambda number: number in followers)
    done: set[int] = set()
    strings = []
    for first in order:
        if first in done:
            continue
        here, parts, closed = first, [], False
        while True:
            done.add(here)
            parts.append(_pieces(runs[here], a, b))
            if here not in links:
                break
            following, piece_a, piece_b = links[here]
            if piece_a is not None or piece_b is not None:
                ends = parts[-1]
                between = [
                    end[-1:] if piece is None else piece
                    for piece, end in zip((piece_a, piece_b), ends, strict=True)
                ]
                parts.append((between[0], between[1]))
            if following in done:
                closed = following == first
                break
            here = following
        nothing = Tail(parts[0][0][:1], parts[0][1][:1]), Tail(parts[-1][0][-1:], parts[-1][1][-1:])
        own = tails.get((first, 0), nothing[0]), tails.get((here, 1), nothing[1])
        strings.append(Stayed((runs[first].a, runs[first].b), parts, own, closed))
    return strings


def _pieces(run: Run, a: Sequence[PenLine], b: Sequence[PenLine]) -> tuple[ComplexArray, ComplexArray]:
    """Return the piece of each line that a run takes, both from its beginning."""
    p, q = a[run.a], b[run.b]
    if _is_whole(run, a, b):
        start = run.begin[1] % q.length
        ring = q.part(start, start)
        return p.outline, ring if run.way > 0 else ring[::-1]
    low, high = run.spans(1)
    other = q.part(low % q.length, high % q.length) if q.closed else q.part(low, high)
    return p.part(*run.spans(0)), other if run.way > 0 else other[::-1]
