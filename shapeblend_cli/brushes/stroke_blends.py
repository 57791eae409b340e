"""Which brush stroke becomes which, and how."""

from __future__ import annotations

from collections import Counter
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.brushes.motion import Alone, Becoming, Brushes, Offsets, Rest, is_dot
from shapeblend_cli.brushes.sides import tangents
from shapeblend_cli.geometry.grouping import assign
from shapeblend_cli.geometry.polyline import cumulative_lengths
from shapeblend_cli.model import Style
from shapeblend_cli.motion.pen import between
from shapeblend_cli.pens.line import PenLine, at, corners, each_once, length, lengths_along
from shapeblend_cli.pens.line_costs import alone_cost, opening_cost
from shapeblend_cli.pens.moves import matched_corners
from shapeblend_cli.pens.named_lines import along_wires

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.brushes.sides import Brush
    from shapeblend_cli.model import ComplexArray, FloatArray
    from shapeblend_cli.options.settings import Settings

    Polylines = tuple[ComplexArray, ComplexArray]

STEP = 0.25
"""Maximum distance of vertices along a stroke, in units."""

FEWEST = 16
"""Minimum number of steps along a stroke."""

MOST_STEPS = 400
"""Maximum number of steps along a stroke."""

CAP_STEPS = 8
"""Minimum number of steps around a cap."""

RESTS = 0.6
"""Maximum distance of an end from the centre line on which it rests, in widths of that."""

REACH = 0.3
"""Additional distance, in units."""


class Matched(NamedTuple):
    """How the strokes of two drawings become each other: the numbers of both for each, and the motion of all."""

    pairs: list[tuple[int | None, int | None]]
    motion: Brushes


class PairedStrokes(NamedTuple):
    """The strokes of two drawings, their centre lines, and for those that become each other their polylines then."""

    brushes: tuple[Sequence[Brush], Sequence[Brush]]
    lines: tuple[list[PenLine], list[PenLine]]
    ways: dict[tuple[int, int], Polylines]


class Vertices(NamedTuple):
    """The vertices of two strokes that become each other, and their outlines beside these."""

    points: Polylines
    offsets: tuple[Offsets, Offsets]


def paired_strokes(a: Sequence[Brush], b: Sequence[Brush]) -> PairedStrokes:
    """Return which strokes of two drawings become each other."""
    lines = [_line(brush) for brush in a], [_line(brush) for brush in b]
    return PairedStrokes((a, b), lines, _partners(*lines))


def vertices_of(paired: PairedStrokes, wires: Settings | None = None) -> list[Vertices] | None:
    """Return the vertices of all pairs, by even lengths or along wires, with settings for these.

    None if a stroke is too crooked for its vertices to be found along it.
    """
    found = []
    for (i, j), ways in paired.ways.items():
        p, q = paired.lines[0][i], paired.lines[1][j]
        if wires is None or p.closed or q.closed:
            points = _alike(*ways)
        else:
            points = _refined(*along_wires(p, q, [], wires, 1.0))
        first = _offsets(paired.brushes[0][i], p, points[0])
        last = _offsets(paired.brushes[1][j], q, points[1])
        if first is None or last is None:
            return None
        found.append(Vertices(points, _with_alike_caps(first, last)))
    return found


def matched(paired: PairedStrokes, vertices: Sequence[Vertices], *, turns: bool = False) -> Matched | None:
    """Return how strokes become each other.

    They turn as they go, or only where they would shrink otherwise. None if one without a partner is too crooked for
    its vertices to be found along it.
    """
    (a, b), lines, chosen = paired
    found = [Becoming(between(*each.points, always=turns), *each.offsets) for each in vertices]
    numbers = {i: k for k, (i, _) in enumerate(chosen)}, {j: k for k, (_, j) in enumerate(chosen)}
    pairs: list[tuple[int | None, int | None]] = list(chosen)
    every: list[Becoming | Alone] = [
        stroke._replace(rests=_rests(stroke, (a[i], b[j]), found, (a, b), numbers))
        for stroke, (i, j) in zip(found, chosen, strict=True)
    ]
    for side, brushes in enumerate((a, b)):
        alone = _alone(brushes, lines[side], found, numbers[side], len(every), is_new=bool(side))
        if alone is None:
            return None
        every += alone.values()
        pairs += [(None, k) if side else (k, None) for k in alone]
    return Matched(pairs, Brushes(tuple(every)).thinned())


def _line(brush: Brush) -> PenLine:
    """Return the centre line of a stroke as a pen line."""
    points = brush.points[:-1] if brush.closed else brush.points
    return PenLine(points, brush.closed, Style(), brush.width, brush.contour, 0)


def _partners(a: Sequence[PenLine], b: Sequence[PenLine]) -> dict[tuple[int, int], Polylines]:
    """Return which strokes become which with the least work, and their polylines then."""
    m, n = len(a), len(b)
    table = np.full((m + n, m + n), 1e6)
    ways: dict[tuple[int, int], Polylines] = {}
    dots = _dots(a), _dots(b)
    for i, j in product(range(m), range(n)):
        if dots[0][i] != dots[1][j]:
            continue
        table[i, j], *both = opening_cost(a[i], b[j])
        ways[i, j] = both[0], both[1]
    for i, line in enumerate(a):
        table[i, n + i] = alone_cost(line)
    for j, line in enumerate(b):
        table[m + j, j] = alone_cost(line)
    table[m:, n:] = 0.0
    return {pair: ways[pair] for pair in assign(table) if pair in ways}


def _dots(lines: Sequence[PenLine]) -> list[bool]:
    """Return which strokes are dots, each alone in its region: they become only each other."""
    counts = Counter(line.contour for line in lines)
    return [counts[line.contour] == 1 and is_dot(line.length, line.width) for line in lines]


def _alike(a: ComplexArray, b: ComplexArray) -> Polylines:
    """Return two polylines with as many vertices: corners go to corners if that takes less way, else even lengths."""
    sizes = length(a), length(b)
    knots = matched_corners(corners(a), corners(b))
    even = np.linspace(0.0, 1.0, int(np.clip(np.ceil(max(sizes) / STEP), FEWEST, MOST_STEPS)) + 1)
    tries = []
    for x, y in (knots, ([0.0, 1.0], [0.0, 1.0])):
        shares = each_once(np.concatenate([even, x]))
        p, q = at(a, shares * sizes[0]), at(b, np.interp(shares, x, y) * sizes[1])
        tries.append((float((np.abs(p - q)[1:] ** 2 * np.diff(shares)).sum()), p, q))
    _, p, q = min(tries, key=lambda one: one[0])
    return p, q


def _refined(a: ComplexArray, b: ComplexArray) -> Polylines:
    """Return two polylines whose vertices correspond with more of these."""
    steps = np.ceil(np.maximum(np.abs(np.diff(a)), np.abs(np.diff(b))) / STEP).clip(1.0).astype(np.intp)
    shares = [np.arange(count) / count + k for k, count in enumerate(steps.tolist())]
    places = np.append(np.concatenate(shares), float(len(steps)))
    every = np.arange(len(a))
    return np.interp(places, every, a), np.interp(places, every, b)


def _offsets(brush: Brush, line: PenLine, points: ComplexArray) -> Offsets | None:
    """Return the outline of a stroke beside vertices along it; None if these are not found there."""
    along = lengths_along(line, points)
    if along is None:
        return None
    own, whole = cumulative_lengths(brush.points), line.length
    places = along % whole if line.closed else np.clip(along, 0.0, whole)
    full = [np.interp(places, own, side) for side in (brush.right, brush.left)]
    plain = [np.interp(places, own, side) for side in brush.plain]
    begin, end = brush.caps
    if along[-1] < along[0]:
        full, plain, begin, end = full[::-1], plain[::-1], end, begin
    ways = tangents(points)
    # Free ends have a shape of their own; elsewhere a stroke is even.
    weight = np.ones(len(places))
    for place, is_free in zip((0.0, whole), brush.is_free, strict=True):
        if is_free:
            weight = np.minimum(
                weight, np.clip(np.abs(places - place) / max(brush.width, 1e-9) - 0.5, 0.0, 1.0)
            )
    sides, added = [], []
    for own_side, even_side, way in zip(full, plain, (-1j, 1j), strict=True):
        exact = (own_side - points) / ways
        even = way * _eased(((even_side - points) / (way * ways)).real).clip(0.0)
        sides.append(exact + weight * (even - exact))
        added.append(exact - sides[-1])
    caps = (begin - points[0]) / ways[0], (end - points[-1]) / ways[-1]
    return Offsets(sides[0], caps[1], sides[1], caps[0], (added[0], added[1]))


def _eased(values: FloatArray) -> FloatArray:
    """Return values smoothed a little, but for the first and the last."""
    for _ in range(2):
        inner = 0.25 * (values[:-2] + 2.0 * values[1:-1] + values[2:])
        values = np.concatenate([values[:1], inner, values[-1:]])
    return values


def _with_alike_caps(a: Offsets, b: Offsets) -> tuple[Offsets, Offsets]:
    """Give both outlines caps with as many points, even lengths to even lengths."""
    ends = _alike_caps(*(np.concatenate([each.right[-1:], each.end, each.left[-1:]]) for each in (a, b)))
    begins = _alike_caps(*(np.concatenate([each.left[:1], each.begin, each.right[:1]]) for each in (a, b)))
    return a._replace(end=ends[0], begin=begins[0]), b._replace(end=ends[1], begin=begins[1])


def _alike_caps(a: ComplexArray, b: ComplexArray) -> Polylines:
    """Return the points between both ends of two polylines, as many of both."""
    shares = []
    for cap in (a, b):
        along = cumulative_lengths(cap)
        shares.append(along / along[-1] if along[-1] > 1e-9 else np.linspace(0.0, 1.0, len(cap)))
    even = np.linspace(0.0, 1.0, CAP_STEPS + 1)[1:-1]
    every = each_once(np.concatenate([shares[0][1:-1], shares[1][1:-1], even]))
    return np.interp(every, shares[0], a), np.interp(every, shares[1], b)


def _rests(
    stroke: Becoming,
    own: tuple[Brush, Brush],
    found: Sequence[Becoming],
    brushes: tuple[Sequence[Brush], Sequence[Brush]],
    numbers: tuple[Mapping[int, int], Mapping[int, int]],
) -> tuple[tuple[Rest | None, Rest | None], tuple[Rest | None, Rest | None]]:
    """Return on what the beginning and the end of a stroke rest in A and in B."""
    rests: list[list[Rest | None]] = [[None, None], [None, None]]
    for (end, vertex), side in product(((0, 0), (1, -1)), (0, 1)):
        place = complex(stroke.middle.points(float(side))[vertex])
        brush = own[side]
        hidden = [z for z, is_free in zip((0, -1), brush.is_free, strict=True) if not is_free]
        if brush.closed or all(abs(brush.points[z] - place) >= REACH for z in hidden):
            continue
        tries = []
        for other, number in numbers[side].items():
            carrier = brushes[side][other]
            if found[number] is stroke or carrier.contour != brush.contour:
                continue
            away = np.abs(found[number].middle.points(float(side)) - place)
            nearest = int(away.argmin())
            if away[nearest] < RESTS * carrier.width + REACH:
                tries.append((float(away[nearest]), Rest(number, nearest)))
        if tries:
            rests[end][side] = min(tries)[1]
    return (rests[0][0], rests[0][1]), (rests[1][0], rests[1][1])


def _alone(
    brushes: Sequence[Brush],
    lines: Sequence[PenLine],
    found: Sequence[Becoming],
    numbers: Mapping[int, int],
    first: int,
    *,
    is_new: bool,
) -> dict[int, Alone] | None:
    """Return how the strokes without a partner are drawn back to what they rest on, or on from there.

    Those that rest on others without a partner go before these, and come after them. `first` is the number of the
    first one among all strokes.
    """
    known = {k: (n, found[n].middle.points(float(is_new)), 0) for k, n in numbers.items()}
    left = [k for k in range(len(brushes)) if k not in known]
    strokes: dict[int, Alone] = {}
    while left:
        tries = [(2, 0, 0.0, left[0], 0, Rest(0, 0))]
        for k, (other, (number, centre, depth)) in product(left, known.items()):
            if brushes[k].contour == brushes[other].contour:
                away = np.abs(brushes[k].points[:, None] - centre)
                place, vertex = divmod(int(away.argmin()), len(centre))
                tries.append((1, depth, float(away[place, vertex]), k, place, Rest(number, vertex)))
        is_apart, depth, _, k, place, rest = min(tries)
        brush = brushes[k]
        offsets = _offsets(brush, lines[k], brush.points)
        if offsets is None:
            return None
        share = 0.5 if is_apart == 2 else place / (len(brush.points) - 1)
        known[k] = first + len(strokes), brush.points, depth + 1
        strokes[k] = Alone(brush.points, offsets, share, is_new, None if is_apart == 2 else rest)
        left.remove(k)
    most = max((known[k][2] for k in strokes), default=1)
    for k, stroke in strokes.items():
        begin, until = (known[k][2] - 1) / most, known[k][2] / most
        strokes[k] = stroke._replace(span=(begin, until) if is_new else (1.0 - until, 1.0 - begin))
    return strokes
