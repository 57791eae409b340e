# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""Crossings of polygons and cubic paths with themselves and each other. Compiled by Cython; runs uncompiled as well.

Curves are cut into chords, so that all are chains of straight edges; a chain is closed if it ends where it began.
Points nearer to each other than `noise` cannot be told apart, and the plain test of two edges only counts where all
four ends are farther than that from the other edge's line. Where an end of one edge lies on another edge, the strands
of both chains are followed outwards, both ways, until a circle around that place has them apart. They cross if they
alternate around the circle. Strands that are still together at the distance `reach` run along each other, and do not
cross, to whichever side they part in the end.

Edges are compared in blocks: a few consecutive ones that all point into one quadrant, and so cannot cross each other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polyline import from_end_to_end

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.cpython.exc import PyErr_CheckSignals as look_for_signals
    from cython.cimports.libc.math import ceil, fabs, sqrt
else:
    from math import ceil, fabs, sqrt

    from shapeblend_cli._cython import look_for_signals

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, CubicPath, IntArray, Polygon

COMPILED = cython.compiled

CHORD_ERROR = cython.declare(cython.double, 1e-6)
"""Maximum deviation of chords from their curve, as a share of the larger side of the box around all paths."""

NOISE = 1e-9
"""Maximum distance of points of polygons that coincide, as a share of that side."""

ROUNDING = 1e-15
"""Maximum distance of points that coincide, as a share of the largest coordinate: where rounding is more than noise."""

REACH = 0.05
"""Minimum distance at which strands that are still together run along each other, as a share of that side."""

# Maximum number of edges in a block: longer blocks have larger boxes, shorter ones are more to sort.
BLOCK = cython.declare(cython.Py_ssize_t, 12)

# Maximum number of points of a strand that is followed: it has then been near the other one for long.
FARTHEST = cython.declare(cython.Py_ssize_t, 64)

# Maximum length of edges that are passed over, as a share of noise: their neighbours do as well.
SHORT = cython.declare(cython.double, 1e-3)

# Maximum number of pairs of edges that touch. Outlines drawn again and again in one place touch everywhere; beyond,
# only what has been found is counted.
MOST_TOUCHES = cython.declare(cython.Py_ssize_t, 200_000)

# The columns of `_Chains.blocks` and of `_Chains.boxes`.
cython.declare(FIRST=cython.int, LAST=cython.int, RUN=cython.int)
FIRST, LAST, RUN = 0, 1, 2
cython.declare(LEFT=cython.int, TOP=cython.int, RIGHT=cython.int, BOTTOM=cython.int)
LEFT, TOP, RIGHT, BOTTOM = 0, 1, 2, 3

# How two edges lie to each other.
cython.declare(APART=cython.int, CROSSING=cython.int, TOUCHING=cython.int)
APART, CROSSING, TOUCHING = 0, 1, 2


def polygon_crossings(polygons: Sequence[Polygon], most: int | None = None) -> int:
    """Count how often polygons cross themselves and each other, up to `most`, see `path_crossings`."""
    return line_crossings([from_end_to_end(polygon.vertices, polygon.closed) for polygon in polygons], most)


def line_crossings(lines: Sequence[ComplexArray], most: int | None = None) -> int:
    """Count how often polylines cross themselves and each other, up to `most`, see `path_crossings`."""
    starts = np.concatenate([[0], np.cumsum([len(line) for line in lines])])
    return _count(np.concatenate(lines), starts, NOISE, most)


def path_crossings(paths: Sequence[CubicPath], most: int | None = None) -> int:
    """Count how often cubic paths cross themselves and each other.

    Touching is no crossing, nor is running along each other, also if the strands part to other sides than they met.
    Strands that pass through each other at a node of one or both cross once. Curves are cut into chords that deviate
    from them by at most `CHORD_ERROR` of the size; strands that stay within four times that of each other touch.
    Counting stops at `most`: 1 asks whether anything crosses.
    """
    return chain_crossings([path.segments for path in paths], paths, most)


def chain_crossings(
    chains: Sequence[ComplexArray], like: Sequence[CubicPath], most: int | None = None
) -> int:
    """Count how often chains of cubics cross, see `path_crossings`; they are straight and closed as some paths are."""
    if not chains:
        return 0
    segments = np.ascontiguousarray(chains[0]) if len(chains) == 1 else np.concatenate(chains)
    straight = like[0].straight if len(chains) == 1 else np.concatenate([path.straight for path in like])
    closed = np.array([path.closed for path in like])
    ends = np.array([len(chain) for chain in chains]).cumsum()
    coordinates, counts = segments.view(np.float64), np.empty(len(segments), np.intp)
    pieces = _count_chords(coordinates, straight.view(np.uint8), counts)
    if pieces == 0:
        return 0
    # Every segment gives the starts of its pieces, and the last one of a path its end as well.
    points = np.empty(pieces + len(chains), np.complex128)
    starts = np.zeros(len(chains) + 1, np.intp)
    _cut_into_chords(coordinates, counts, ends, closed.view(np.uint8), points.view(np.float64), starts)
    return _count(points, starts, 4.0 * CHORD_ERROR if pieces > len(counts) else NOISE, most)


def _count(points: ComplexArray, starts: IntArray, noise: float, most: int | None) -> int:
    """Count the crossings of chains, with noise as a share of their size."""
    size, farthest = _extent(points)
    chains = _Chains(points, starts, max(noise * size, ROUNDING * farthest), REACH * size)
    return _count_crossings(chains, len(points) ** 2 if most is None else most)


def _extent(points: cython.doublecomplex[::1]) -> tuple[float, float]:
    """Return the larger side of the box around points, and the largest distance of a point from the origin."""
    left: cython.double = points[0].real
    top: cython.double = points[0].imag
    right: cython.double = left
    bottom: cython.double = top
    farthest: cython.double = 0.0
    k: cython.Py_ssize_t
    for k in range(points.shape[0]):
        x: cython.double = points[k].real
        y: cython.double = points[k].imag
        left, right, top, bottom = min(left, x), max(right, x), min(top, y), max(bottom, y)
        farthest = max(farthest, x * x + y * y)
    return max(right - left, bottom - top), sqrt(farthest)


@cython.cclass
class _Chains:
    """Runs of points, one after the other, and the blocks of their edges."""

    points: cython.doublecomplex[::1]
    starts: cython.Py_ssize_t[::1]  # (c + 1,), where each chain begins in `points`, and the number of points
    closed: cython.uchar[::1]  # (c,)
    chain: cython.Py_ssize_t[::1]  # (n,), which chain each point belongs to
    blocks: cython.Py_ssize_t[
        :, ::1
    ]  # (b, 3), first and last point, and run of edges that point into one quadrant
    boxes: cython.double[:, ::1]  # (b, 4), left, top, right, bottom; blocks are ordered by their left
    noise: cython.double  # points nearer to each other than this coincide
    reach: cython.double  # strands that stay together this far from where they meet run along each other
    touches: cython.Py_ssize_t  # pairs of edges that may have an end on each other, as far as they were found
    passages: dict[
        int, list[tuple[_Strand, _Strand]]
    ]  # strands that have been found to cross, by their edges

    def __init__(self, points: ComplexArray, starts: IntArray, noise: float, reach: float) -> None:
        self.points, self.starts, self.noise, self.reach = points, starts, noise, reach
        self.touches = 0
        self.closed, self.chain = np.empty(len(starts) - 1, np.uint8), np.empty(len(points), np.intp)
        blocks, boxes = np.empty((len(points), 3), np.intp), np.empty((len(points), 4))
        count = _cut_into_blocks(self, blocks, boxes)
        order = np.argsort(boxes[:count, 0])
        self.blocks, self.boxes = blocks.take(order, axis=0), boxes.take(order, axis=0)
        self.passages = {}


@cython.cclass
class _Strand:
    """A chain where it passes through a circle around a vertex of it."""

    centre: cython.doublecomplex
    radius: cython.double
    begin: cython.Py_ssize_t  # the first and the last point of the chain
    end: cython.Py_ssize_t
    behind: cython.Py_ssize_t  # the points of the chain before and after the centre
    ahead: cython.Py_ssize_t
    first: cython.Py_ssize_t  # the edges on which it enters and leaves the circle
    last: cython.Py_ssize_t
    entry: cython.doublecomplex  # where it does, from the centre
    exit: cython.doublecomplex


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _dot(z: cython.doublecomplex, w: cython.doublecomplex) -> cython.double:
    return z.real * w.real + z.imag * w.imag


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _cross(z: cython.doublecomplex, w: cython.doublecomplex) -> cython.double:
    return z.real * w.imag - z.imag * w.real


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _is_longer(z: cython.doublecomplex, distance: cython.double) -> cython.bint:
    return _dot(z, z) > distance * distance


@cython.cfunc
def _count_chords(
    segments: cython.const[cython.double][:, ::1],
    straight: cython.const[cython.uchar][::1],
    counts: cython.Py_ssize_t[::1],
) -> cython.Py_ssize_t:
    """Fill in the number of chords of each cubic, and return the number of all; 0 where all is one point.

    Points are x and y in turn. A piece of 1/n of a segment deviates from its chord by at most 1/8 of its second
    derivative over n^2.
    """
    cython.declare(k=cython.Py_ssize_t, i=cython.Py_ssize_t, pieces=cython.Py_ssize_t)
    left: cython.double = segments[0, 0]
    top: cython.double = segments[0, 1]
    right: cython.double = left
    bottom: cython.double = top
    for k in range(segments.shape[0]):
        for i in range(0, 8, 2):
            left, right = min(left, segments[k, i]), max(right, segments[k, i])
            top, bottom = min(top, segments[k, i + 1]), max(bottom, segments[k, i + 1])
    tolerance: cython.double = CHORD_ERROR * max(right - left, bottom - top)
    if tolerance == 0.0:
        return 0
    pieces = 0
    for k in range(segments.shape[0]):
        bend: cython.double = 0.0
        for i in range(0, 4, 2):
            x: cython.double = segments[k, i] - 2.0 * segments[k, i + 2] + segments[k, i + 4]
            y: cython.double = segments[k, i + 1] - 2.0 * segments[k, i + 3] + segments[k, i + 5]
            bend = max(bend, x * x + y * y)
        wanted: cython.double = 1.0 if straight[k] else ceil(sqrt(0.75 / tolerance * sqrt(bend)))
        counts[k] = max(1, cython.cast(cython.Py_ssize_t, wanted))
        pieces += counts[k]
    return pieces


@cython.cfunc
def _cut_into_chords(
    segments: cython.const[cython.double][:, ::1],
    counts: cython.Py_ssize_t[::1],
    ends: cython.Py_ssize_t[::1],
    closed: cython.uchar[::1],
    points: cython.double[::1],
    starts: cython.Py_ssize_t[::1],
) -> None:
    """Cut each cubic into a number of pieces of equal parameter, and write the points and starts of chains.

    Points are x and y in turn; `ends` are the numbers of segments up to the end of each path.
    """
    cython.declare(k=cython.Py_ssize_t, n=cython.Py_ssize_t, path=cython.Py_ssize_t, first=cython.Py_ssize_t)
    at: cython.Py_ssize_t = 0
    first = 0
    for path in range(ends.shape[0]):
        for k in range(first, ends[path]):
            for n in range(counts[k]):
                t = cython.cast(cython.double, n) / counts[k]
                u = 1.0 - t
                a, b, c, d = u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t
                x = a * segments[k, 0] + b * segments[k, 2] + c * segments[k, 4] + d * segments[k, 6]
                y = a * segments[k, 1] + b * segments[k, 3] + c * segments[k, 5] + d * segments[k, 7]
                points[at], points[at + 1] = x, y
                at += 2
        # Rounding may have left the end of a closed one beside its start.
        if closed[path]:
            points[at], points[at + 1] = segments[first, 0], segments[first, 1]
        else:
            k = ends[path] - 1
            points[at], points[at + 1] = segments[k, 6], segments[k, 7]
        at += 2
        first = ends[path]
        starts[path + 1] = at // 2


@cython.cfunc
def _cut_into_blocks(
    chains: _Chains, blocks: cython.Py_ssize_t[:, ::1], boxes: cython.double[:, ::1]
) -> cython.Py_ssize_t:
    """Find the blocks of chains and their boxes; return their number, at most the number of points."""
    points: cython.doublecomplex[::1] = chains.points
    count: cython.Py_ssize_t = 0
    run: cython.Py_ssize_t = -1
    edges: cython.Py_ssize_t = 0
    cython.declare(k=cython.Py_ssize_t, i=cython.Py_ssize_t, begin=cython.Py_ssize_t, end=cython.Py_ssize_t)
    cython.declare(last_quadrant=cython.int, quadrant=cython.int)
    for k in range(chains.closed.shape[0]):
        begin, end = chains.starts[k], chains.starts[k + 1] - 1
        chains.closed[k] = points[begin] == points[end]
        chains.chain[end] = k
        last_quadrant = -1
        for i in range(begin, end):
            chains.chain[i] = k
            z, w = points[i], points[i + 1]
            quadrant = (1 if w.real >= z.real else 0) + (2 if w.imag >= z.imag else 0)
            if quadrant != last_quadrant or edges == BLOCK:
                if quadrant != last_quadrant:
                    run += 1
                last_quadrant = quadrant
                edges = 0
                blocks[count, FIRST], blocks[count, RUN] = i, run
                boxes[count, LEFT] = boxes[count, RIGHT] = z.real
                boxes[count, TOP] = boxes[count, BOTTOM] = z.imag
                count += 1
            edges += 1
            blocks[count - 1, LAST] = i + 1
            boxes[count - 1, LEFT] = min(boxes[count - 1, LEFT], w.real)
            boxes[count - 1, TOP] = min(boxes[count - 1, TOP], w.imag)
            boxes[count - 1, RIGHT] = max(boxes[count - 1, RIGHT], w.real)
            boxes[count - 1, BOTTOM] = max(boxes[count - 1, BOTTOM], w.imag)
    return count


@cython.cfunc
def _count_crossings(chains: _Chains, most: cython.Py_ssize_t) -> cython.Py_ssize_t:
    """Count how often chains cross themselves and each other, up to `most`.

    O(b + pairs of blocks whose x ranges overlap), with more time for blocks whose boxes overlap.
    """
    blocks: cython.Py_ssize_t[:, ::1] = chains.blocks
    boxes: cython.double[:, ::1] = chains.boxes
    noise: cython.double = chains.noise
    count: cython.Py_ssize_t = 0
    cython.declare(p=cython.Py_ssize_t, q=cython.Py_ssize_t)
    for p in range(blocks.shape[0]):
        if p % 8 == 0:
            look_for_signals()
        for q in range(p + 1, blocks.shape[0]):
            if boxes[q, LEFT] > boxes[p, RIGHT] + noise:
                break
            if boxes[q, TOP] > boxes[p, BOTTOM] + noise or boxes[q, BOTTOM] < boxes[p, TOP] - noise:
                continue
            if blocks[p, RUN] != blocks[q, RUN]:
                count += _block_crossings(chains, p, q)
                if count >= most:
                    return most
                if chains.touches > MOST_TOUCHES:
                    return count
    return count


@cython.cfunc
def _block_crossings(chains: _Chains, p: cython.Py_ssize_t, q: cython.Py_ssize_t) -> cython.Py_ssize_t:
    """Count how often edges of one block cross edges of another."""
    noise: cython.double = chains.noise
    count: cython.Py_ssize_t = 0
    cython.declare(i=cython.Py_ssize_t, j=cython.Py_ssize_t)
    relation: cython.int
    for i in range(chains.blocks[p, FIRST], chains.blocks[p, LAST]):
        a, b = chains.points[i], chains.points[i + 1]
        left, right = min(a.real, b.real) - noise, max(a.real, b.real) + noise
        top, bottom = min(a.imag, b.imag) - noise, max(a.imag, b.imag) + noise
        if (
            left > chains.boxes[q, RIGHT]
            or right < chains.boxes[q, LEFT]
            or top > chains.boxes[q, BOTTOM]
            or bottom < chains.boxes[q, TOP]
            or max(right - left, bottom - top) - 2.0 * noise <= SHORT * noise
        ):
            continue
        for j in range(chains.blocks[q, FIRST], chains.blocks[q, LAST]):
            c, d = chains.points[j], chains.points[j + 1]
            if (
                (left > c.real and left > d.real)
                or (right < c.real and right < d.real)
                or (top > c.imag and top > d.imag)
                or (bottom < c.imag and bottom < d.imag)
                or max(fabs(c.real - d.real), fabs(c.imag - d.imag)) <= SHORT * noise
                or _adjoin(chains, i, j)
            ):
                continue
            relation = _relation(chains, i, j)
            if relation == CROSSING:
                count += 1
            elif relation == TOUCHING:
                chains.touches += 1
                count += _is_on_edge(chains, i, j) and _pass_through(chains, i, j)
                count += _is_on_edge(chains, j, i) and _pass_through(chains, j, i)
    return count


@cython.cfunc
@cython.exceptval(check=False)
def _adjoin(chains: _Chains, i: cython.Py_ssize_t, j: cython.Py_ssize_t) -> cython.bint:
    """Return whether two edges are one or follow each other in a chain."""
    chain: cython.Py_ssize_t = chains.chain[i]
    if chain != chains.chain[j]:
        return False
    if -1 <= i - j <= 1:
        return True
    last: cython.Py_ssize_t = chains.starts[chain + 1] - 2
    return chains.closed[chain] and min(i, j) == chains.starts[chain] and max(i, j) == last


@cython.cfunc
@cython.exceptval(check=False)
def _relation(chains: _Chains, i: cython.Py_ssize_t, j: cython.Py_ssize_t) -> cython.int:
    """Return whether two edges cross beyond doubt, lie apart, or are as near to each other as noise."""
    origin = chains.points[i]
    edge = chains.points[i + 1] - origin
    start, end = chains.points[j] - origin, chains.points[j + 1] - origin
    # Twice the areas of triangles over the first edge, and over the second.
    c, d = _cross(edge, start), _cross(edge, end)
    limit = chains.noise * sqrt(_dot(edge, edge))
    if (c > limit and d > limit) or (c < -limit and d < -limit):
        return APART
    other_edge = end - start
    a, b = _cross(start, other_edge), _cross(other_edge, edge - start)
    other = chains.noise * sqrt(_dot(other_edge, other_edge))
    if (a > other and b > other) or (a < -other and b < -other):
        return APART
    if fabs(c) > limit and fabs(d) > limit and fabs(a) > other and fabs(b) > other:
        return CROSSING
    return TOUCHING


@cython.cfunc
@cython.exceptval(check=False)
def _is_on_edge(chains: _Chains, v: cython.Py_ssize_t, e: cython.Py_ssize_t) -> cython.bint:
    """Return whether a vertex lies on an edge."""
    vertex, start = chains.points[v], chains.points[e]
    edge = chains.points[e + 1] - start
    # Where on the edge the nearest point lies, from 0 to 1.
    at = max(0.0, min(1.0, _dot(vertex - start, edge) / _dot(edge, edge)))
    x = start.real + at * edge.real - vertex.real
    y = start.imag + at * edge.imag - vertex.imag
    return x * x + y * y <= chains.noise * chains.noise


@cython.cfunc
def _strand(
    chains: _Chains, v: cython.Py_ssize_t, behind: cython.Py_ssize_t, ahead: cython.Py_ssize_t
) -> _Strand:
    """Return a strand through a circle around a vertex, between points of its chain behind and ahead."""
    strand: _Strand = _Strand.__new__(_Strand)  # a call of the class would pass arguments as Python objects
    strand.centre, strand.radius = chains.points[v], 4.0 * chains.noise
    chain: cython.Py_ssize_t = chains.chain[ahead - 1]
    strand.behind, strand.ahead = behind, ahead
    strand.begin, strand.end = chains.starts[chain], chains.starts[chain + 1] - 1
    return strand


@cython.cfunc
@cython.exceptval(check=False)
def _leave(chains: _Chains, strand: _Strand, step: cython.int) -> cython.bint:
    """Follow a strand onwards (step 1) or back (-1) until it leaves the circle; return whether it does."""
    radius: cython.double = strand.radius
    count: cython.Py_ssize_t
    ahead: cython.Py_ssize_t = strand.ahead if step > 0 else strand.behind
    for count in range(min(FARTHEST, strand.end - strand.begin + 1)):  # noqa: B007
        if ahead < strand.begin or ahead > strand.end:
            if not chains.closed[chains.chain[strand.begin]]:
                return False
            ahead = strand.end - 1 if ahead < strand.begin else strand.begin + 1
        away = chains.points[ahead] - strand.centre
        if _is_longer(away, radius):
            edge = chains.points[ahead] - chains.points[ahead - step]
            length = sqrt(_dot(edge, edge))
            dx, dy = edge.real / length, edge.imag / length
            # From the foot of the centre, so that nothing cancels where the circle is far smaller than the edge.
            across = away.real * dy - away.imag * dx
            half = sqrt(max(0.0, radius * radius - across * across))
            x, y = across * dy + half * dx, half * dy - across * dx
            if step > 0:
                strand.last, strand.exit = ahead - step, x + 1j * y
            else:
                strand.first, strand.entry = ahead, x + 1j * y
            return True
        ahead += step
    return False


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _bearing(z: cython.doublecomplex) -> cython.double:
    """Return a number from 0 to 4 that grows with the angle of a direction."""
    share: cython.double = z.imag / (fabs(z.real) + fabs(z.imag))
    if z.real < 0.0:
        return 2.0 - share
    return share if z.imag >= 0.0 else 4.0 + share


@cython.cfunc
@cython.exceptval(check=False)
def _alternate(one: _Strand, other: _Strand) -> cython.bint:
    """Return whether the ends of two strands alternate around the circle."""
    a, b, c, d = _bearing(one.entry), _bearing(one.exit), _bearing(other.entry), _bearing(other.exit)
    return (min(a, b) < c < max(a, b)) != (min(a, b) < d < max(a, b))


@cython.cfunc
@cython.exceptval(check=False)
def _are_apart(one: _Strand, other: _Strand, distance: cython.double) -> cython.bint:
    """Return whether each end of a strand is farther than that from each end of another."""
    return (
        _is_longer(one.entry - other.entry, distance)
        and _is_longer(one.entry - other.exit, distance)
        and _is_longer(one.exit - other.entry, distance)
        and _is_longer(one.exit - other.exit, distance)
    )


@cython.cfunc
def _pass_through(chains: _Chains, v: cython.Py_ssize_t, e: cython.Py_ssize_t) -> cython.bint:
    """Return whether the strand through a vertex crosses the strand of an edge there, uncounted so far."""
    one: _Strand = _strand(chains, v, v - 1, v + 1)
    other: _Strand = _strand(chains, v, e, e + 1)
    while True:
        if not (
            one.radius <= chains.reach
            and _leave(chains, one, -1)
            and _leave(chains, one, 1)
            and _leave(chains, other, -1)
            and _leave(chains, other, 1)
        ):
            return False
        if _are_apart(one, other, 2.0 * chains.noise):
            break
        one.radius = other.radius = 2.0 * one.radius
    # Inside the circle two edges may cross beyond doubt. That is this crossing, and counted.
    if not _alternate(one, other) or _cross_inside(chains, one, other):
        return False
    edges = [*_edges(one), *_edges(other)]
    for edge in edges:
        for p, q in chains.passages.get(edge, ()):
            if _is_same(one, other, p, q):
                return False
    for edge in edges:
        chains.passages.setdefault(edge, []).append((one, other))
    return True


@cython.cfunc
def _cross_inside(chains: _Chains, one: _Strand, other: _Strand) -> cython.bint:
    """Return whether two strands have an odd number of crossings beyond doubt in their circle."""
    is_odd: cython.bint = False
    cython.declare(i=cython.Py_ssize_t, j=cython.Py_ssize_t)
    for i in _edges(one):
        for j in _edges(other):
            if _adjoin(chains, i, j) or _relation(chains, i, j) != CROSSING:
                continue
            edge, start = chains.points[i + 1] - chains.points[i], chains.points[j]
            c = _cross(edge, start - chains.points[i])
            at = c / (c - _cross(edge, chains.points[j + 1] - chains.points[i]))
            along = chains.points[j + 1] - start
            x = start.real + at * along.real - one.centre.real
            y = start.imag + at * along.imag - one.centre.imag
            if x * x + y * y <= one.radius * one.radius:
                is_odd = not is_odd
    return is_odd


@cython.cfunc
def _edges(strand: _Strand) -> list[int]:
    """Return the edges of a strand, in a closed chain past its end if need be."""
    if strand.first <= strand.last:
        return list(range(strand.first, strand.last + 1))
    return [*range(strand.first, strand.end), *range(strand.begin, strand.last + 1)]


@cython.cfunc
def _is_same(one: _Strand, other: _Strand, p: _Strand, q: _Strand) -> cython.bint:
    """Return whether two strands pass through each other where p and q do, being the same."""
    if _is_longer(one.centre - p.centre, one.radius + p.radius):
        return False
    both, those = (set(_edges(one)), set(_edges(other))), (_edges(p), _edges(q))
    meets = [not mine.isdisjoint(theirs) for mine in both for theirs in those]
    return (meets[0] and meets[3]) or (meets[1] and meets[2])
