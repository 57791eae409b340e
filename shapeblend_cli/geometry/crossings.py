# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""How often polygons and cubic paths cross themselves and each other.

This file is compiled by Cython and runs uncompiled as well.

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
from shapeblend_cli.model import Box

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.libc.math import fabs, sqrt
else:
    from math import fabs, sqrt

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, CubicPath, FloatArray, IntArray, Polygon

COMPILED = cython.compiled

CHORD_ERROR = 1e-6
"""How far chords may deviate from their curve; this and what follows are shares of the size of all paths together."""

NOISE = 1e-9
"""Points of polygons nearer to each other than this coincide."""

ROUNDING = 1e-15
"""The same for coordinates of size 1."""

REACH = 0.05
"""Strands that stay together this far run along each other."""

# Edges in a block: longer blocks have larger boxes, shorter ones are more to sort.
BLOCK = cython.declare(cython.Py_ssize_t, 12)

# Points after which a strand is no longer followed: it has then been near the other one for long.
FARTHEST = cython.declare(cython.Py_ssize_t, 64)

# Edges this much shorter than noise are passed over; their neighbours do as well.
SHORT = cython.declare(cython.double, 1e-3)

# The columns of `_Chains.blocks` and of `_Chains.boxes`.
FIRST = cython.declare(cython.int, 0)
LAST = cython.declare(cython.int, 1)
RUN = cython.declare(cython.int, 2)
LEFT = cython.declare(cython.int, 0)
TOP = cython.declare(cython.int, 1)
RIGHT = cython.declare(cython.int, 2)
BOTTOM = cython.declare(cython.int, 3)

# How two edges lie to each other.
APART = cython.declare(cython.int, 0)
CROSSING = cython.declare(cython.int, 1)
TOUCHING = cython.declare(cython.int, 2)


def polygon_crossings(polygons: Sequence[Polygon]) -> int:
    """Count how often polygons cross themselves and each other, see `path_crossings`."""
    points = [from_end_to_end(polygon.vertices, polygon.closed) for polygon in polygons]
    starts = np.concatenate([[0], np.cumsum([len(chain) for chain in points])])
    return _count(np.concatenate(points), starts, NOISE, None)


def path_crossings(paths: Sequence[CubicPath], most: int | None = None) -> int:
    """Count how often cubic paths cross themselves and each other.

    Touching is no crossing, nor is running along each other, also if the strands part to other sides than they met.
    Strands that pass through each other at a node of one or both cross once. Curves are cut into chords that deviate
    from them by at most `CHORD_ERROR` of the size; strands that stay within four times that of each other touch.

    Parameters
    ----------
    paths : sequence of CubicPath
        Closed ones end where they begin.
    most : int, optional
        Stop counting there: 1 asks whether anything crosses.
    """
    if not paths:
        return 0
    return chain_crossings(
        np.concatenate([path.segments for path in paths]),
        np.concatenate([path.straight for path in paths]),
        [len(path.segments) for path in paths],
        [path.closed for path in paths],
        most,
    )


def chain_crossings(
    segments: ComplexArray,
    straight: BoolArray,
    lengths: Sequence[int],
    closed: Sequence[bool],
    most: int | None = None,
) -> int:
    """Count crossings as `path_crossings` does, of paths whose segments are in one array.

    Parameters
    ----------
    segments : (s, 4) complex
    straight : (s,) bool
    lengths : sequence of int
        How many segments each path has.
    closed : sequence of bool
    most : int, optional
    """
    bends = np.abs(segments[:, :2] - 2.0 * segments[:, 1:3] + segments[:, 2:]).max(axis=1)
    bends[straight] = 0.0
    tolerance = CHORD_ERROR * Box.around(segments).larger_side
    if tolerance == 0.0:
        return 0
    # A piece of 1/n of a segment deviates from its chord by at most 1/8 of its second derivative over n^2.
    counts = np.maximum(np.ceil(np.sqrt(0.75 / tolerance * bends)).astype(np.intp), 1)
    # Every segment gives the starts of its pieces, and the last one of a path its end as well.
    last = np.cumsum(lengths) - 1
    before = np.cumsum(counts)
    starts = np.concatenate([[0], before[last] + np.arange(1, len(lengths) + 1)])
    points = np.empty(int(counts.sum()) + len(lengths), np.complex128)
    places = before - counts + np.repeat(np.arange(len(lengths)), lengths)
    _cut_into_chords(segments.view(np.float64), counts, places, _xy(points))
    # Rounding may have left the end of a closed one beside its start.
    first = last + 1 - np.asarray(lengths)
    points[starts[1:] - 1] = np.where(closed, segments[first, 0], segments[last, 3])
    return _count(points, starts, 4.0 * CHORD_ERROR if counts.max() > 1 else NOISE, most)


def _count(points: ComplexArray, starts: IntArray, noise: float, most: int | None) -> int:
    """Count the crossings of chains, with noise as a share of their size."""
    size = Box.around(points).larger_side
    # Far from the origin rounding is more than the share.
    noise = max(noise * size, ROUNDING * float(np.abs(points).max()))
    chains = _Chains(_xy(points), starts, noise, REACH * size)
    return _count_crossings(chains, len(points) ** 2 if most is None else most)


def _xy(points: ComplexArray) -> FloatArray:
    """Return the same memory as (n, 2) float."""
    return points.view(np.float64).reshape(len(points), 2)


@cython.cclass
class _Chains:
    """Runs of points, one after the other, and the blocks of their edges.

    Attributes
    ----------
    points : (n, 2) float
    starts : (c + 1,) int
        Where each chain begins in `points`, and the number of points.
    closed : (c,) bool
    chain : (n,) int
        Which chain each point belongs to.
    blocks : (b, 3) int
        The first and the last point, and the run of edges that point into one quadrant; ordered by their left.
    boxes : (b, 4) float
        Left, top, right and bottom of each block.
    noise : float > 0
        Points nearer to each other than this coincide.
    reach : float
        Strands that stay together this far from where they meet run along each other.
    passages : dict
        Pairs of strands that have been found to cross at a vertex, by their edges.
    """

    points: cython.double[:, ::1]
    starts: cython.Py_ssize_t[::1]
    closed: cython.uchar[::1]
    chain: cython.Py_ssize_t[::1]
    blocks: cython.Py_ssize_t[:, ::1]
    boxes: cython.double[:, ::1]
    noise: cython.double
    reach: cython.double
    passages: dict[int, list[tuple[_Strand, _Strand]]]

    def __init__(self, points: FloatArray, starts: IntArray, noise: float, reach: float) -> None:
        self.points, self.starts, self.noise, self.reach = points, starts, noise, reach
        self.closed, self.chain = np.empty(len(starts) - 1, np.uint8), np.empty(len(points), np.intp)
        blocks, boxes = np.empty((len(points), 3), np.intp), np.empty((len(points), 4))
        count = _cut_into_blocks(self, blocks, boxes)
        order = np.argsort(boxes[:count, 0])
        self.blocks, self.boxes = blocks[order], boxes[order]
        self.passages = {}


@cython.cclass
class _Strand:
    """A chain where it passes through a circle.

    Attributes
    ----------
    x, y, radius : float
        The circle.
    chain, begin, end : int
        The chain, its first and its last point.
    behind, ahead : int
        The points of the chain before and after the centre.
    first, last : int
        The edges on which it enters and leaves.
    in_x, in_y, out_x, out_y : float
        Where it does, from the centre.
    """

    x: cython.double
    y: cython.double
    radius: cython.double
    chain: cython.Py_ssize_t
    begin: cython.Py_ssize_t
    end: cython.Py_ssize_t
    behind: cython.Py_ssize_t
    ahead: cython.Py_ssize_t
    first: cython.Py_ssize_t
    last: cython.Py_ssize_t
    in_x: cython.double
    in_y: cython.double
    out_x: cython.double
    out_y: cython.double


@cython.cfunc
def _cut_into_chords(
    segments: cython.double[:, ::1],
    counts: cython.Py_ssize_t[::1],
    places: cython.Py_ssize_t[::1],
    points: cython.double[:, ::1],
) -> None:
    """Cut cubics into pieces of equal parameter, and write where they start into `points`.

    Parameters
    ----------
    segments : (k, 8) float
        x and y of the four control points.
    counts, places : (k,) int
        How many pieces a segment has, and where in `points` the first of them belongs.
    points : (n, 2) float
    """
    k: cython.Py_ssize_t
    n: cython.Py_ssize_t
    for k in range(segments.shape[0]):
        for n in range(counts[k]):
            t = cython.cast(cython.double, n) / counts[k]
            u = 1.0 - t
            a, b, c, d = u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t
            points[places[k] + n, 0] = (
                a * segments[k, 0] + b * segments[k, 2] + c * segments[k, 4] + d * segments[k, 6]
            )
            points[places[k] + n, 1] = (
                a * segments[k, 1] + b * segments[k, 3] + c * segments[k, 5] + d * segments[k, 7]
            )


@cython.cfunc
def _cut_into_blocks(
    chains: _Chains, blocks: cython.Py_ssize_t[:, ::1], boxes: cython.double[:, ::1]
) -> cython.Py_ssize_t:
    """Find the blocks of chains and their boxes; return how many they are, at most as many as points."""
    points: cython.double[:, ::1] = chains.points
    count: cython.Py_ssize_t = 0
    run: cython.Py_ssize_t = -1
    edges: cython.Py_ssize_t = 0
    k: cython.Py_ssize_t
    i: cython.Py_ssize_t
    begin: cython.Py_ssize_t
    end: cython.Py_ssize_t
    last_quadrant: cython.int
    quadrant: cython.int
    for k in range(chains.closed.shape[0]):
        begin, end = chains.starts[k], chains.starts[k + 1] - 1
        chains.closed[k] = points[begin, 0] == points[end, 0] and points[begin, 1] == points[end, 1]
        chains.chain[end] = k
        last_quadrant = -1
        for i in range(begin, end):
            chains.chain[i] = k
            x, y = points[i, 0], points[i, 1]
            next_x, next_y = points[i + 1, 0], points[i + 1, 1]
            quadrant = (1 if next_x >= x else 0) + (2 if next_y >= y else 0)
            if quadrant != last_quadrant or edges == BLOCK:
                if quadrant != last_quadrant:
                    run += 1
                last_quadrant = quadrant
                edges = 0
                blocks[count, FIRST], blocks[count, RUN] = i, run
                boxes[count, LEFT] = boxes[count, RIGHT] = x
                boxes[count, TOP] = boxes[count, BOTTOM] = y
                count += 1
            edges += 1
            blocks[count - 1, LAST] = i + 1
            boxes[count - 1, LEFT] = min(boxes[count - 1, LEFT], next_x)
            boxes[count - 1, TOP] = min(boxes[count - 1, TOP], next_y)
            boxes[count - 1, RIGHT] = max(boxes[count - 1, RIGHT], next_x)
            boxes[count - 1, BOTTOM] = max(boxes[count - 1, BOTTOM], next_y)
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
    p: cython.Py_ssize_t
    q: cython.Py_ssize_t
    for p in range(blocks.shape[0]):
        for q in range(p + 1, blocks.shape[0]):
            if boxes[q, LEFT] > boxes[p, RIGHT] + noise:
                break
            if boxes[q, TOP] > boxes[p, BOTTOM] + noise or boxes[q, BOTTOM] < boxes[p, TOP] - noise:
                continue
            if blocks[p, RUN] != blocks[q, RUN]:
                count += _block_crossings(chains, p, q)
                if count >= most:
                    return most
    return count


@cython.cfunc
def _block_crossings(chains: _Chains, p: cython.Py_ssize_t, q: cython.Py_ssize_t) -> cython.Py_ssize_t:
    """Count how often edges of one block cross edges of another."""
    noise: cython.double = chains.noise
    count: cython.Py_ssize_t = 0
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    relation: cython.int
    for i in range(chains.blocks[p, FIRST], chains.blocks[p, LAST]):
        ax, ay = chains.points[i, 0], chains.points[i, 1]
        bx, by = chains.points[i + 1, 0], chains.points[i + 1, 1]
        left, right = min(ax, bx) - noise, max(ax, bx) + noise
        top, bottom = min(ay, by) - noise, max(ay, by) + noise
        if (
            left > chains.boxes[q, RIGHT]
            or right < chains.boxes[q, LEFT]
            or top > chains.boxes[q, BOTTOM]
            or bottom < chains.boxes[q, TOP]
            or max(right - left, bottom - top) - 2.0 * noise <= SHORT * noise
        ):
            continue
        for j in range(chains.blocks[q, FIRST], chains.blocks[q, LAST]):
            cx, cy = chains.points[j, 0], chains.points[j, 1]
            dx, dy = chains.points[j + 1, 0], chains.points[j + 1, 1]
            if (
                (left > cx and left > dx)
                or (right < cx and right < dx)
                or (top > cy and top > dy)
                or (bottom < cy and bottom < dy)
                or max(fabs(cx - dx), fabs(cy - dy)) <= SHORT * noise
                or _adjoin(chains, i, j)
            ):
                continue
            relation = _relation(chains, i, j)
            if relation == CROSSING:
                count += 1
            elif relation == TOUCHING:
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
    ax, ay = chains.points[i, 0], chains.points[i, 1]
    bx, by = chains.points[i + 1, 0] - ax, chains.points[i + 1, 1] - ay
    cx, cy = chains.points[j, 0] - ax, chains.points[j, 1] - ay
    dx, dy = chains.points[j + 1, 0] - ax, chains.points[j + 1, 1] - ay
    # Twice the areas of triangles over the first edge, and over the second.
    c = bx * cy - by * cx
    d = bx * dy - by * dx
    limit = chains.noise * sqrt(bx * bx + by * by)
    if (c > limit and d > limit) or (c < -limit and d < -limit):
        return APART
    ex, ey = dx - cx, dy - cy
    a = ey * cx - ex * cy
    b = ex * (by - cy) - ey * (bx - cx)
    other = chains.noise * sqrt(ex * ex + ey * ey)
    if (a > other and b > other) or (a < -other and b < -other):
        return APART
    if fabs(c) > limit and fabs(d) > limit and fabs(a) > other and fabs(b) > other:
        return CROSSING
    return TOUCHING


@cython.cfunc
@cython.exceptval(check=False)
def _is_on_edge(chains: _Chains, v: cython.Py_ssize_t, e: cython.Py_ssize_t) -> cython.bint:
    """Return whether a vertex lies on an edge."""
    px, py = chains.points[v, 0] - chains.points[e, 0], chains.points[v, 1] - chains.points[e, 1]
    dx = chains.points[e + 1, 0] - chains.points[e, 0]
    dy = chains.points[e + 1, 1] - chains.points[e, 1]
    # Where on the edge the nearest point lies, from 0 to 1.
    at = max(0.0, min(1.0, (px * dx + py * dy) / (dx * dx + dy * dy)))
    x = chains.points[e, 0] + at * dx - chains.points[v, 0]
    y = chains.points[e, 1] + at * dy - chains.points[v, 1]
    return x * x + y * y <= chains.noise * chains.noise


@cython.cfunc
def _strand(
    chains: _Chains, v: cython.Py_ssize_t, behind: cython.Py_ssize_t, ahead: cython.Py_ssize_t
) -> _Strand:
    """Return a strand through a circle around a vertex, between points of its chain behind and ahead."""
    strand: _Strand = _Strand.__new__(_Strand)  # a call of the class would pass arguments as Python objects
    strand.x, strand.y = chains.points[v, 0], chains.points[v, 1]
    strand.chain, strand.behind, strand.ahead = chains.chain[ahead - 1], behind, ahead
    strand.begin, strand.end = chains.starts[strand.chain], chains.starts[strand.chain + 1] - 1
    return strand


@cython.cfunc
@cython.exceptval(check=False)
def _leave(chains: _Chains, strand: _Strand, step: cython.int) -> cython.bint:
    """Follow a strand onwards (step 1) or back (-1) until it leaves the circle; return whether it does."""
    radius: cython.double = strand.radius
    count: cython.Py_ssize_t
    ahead: cython.Py_ssize_t = strand.ahead if step > 0 else strand.behind
    behind: cython.Py_ssize_t
    for count in range(min(FARTHEST, strand.end - strand.begin + 1)):  # noqa: B007
        if ahead < strand.begin or ahead > strand.end:
            if not chains.closed[strand.chain]:
                return False
            ahead = strand.end - 1 if ahead < strand.begin else strand.begin + 1
        ux, uy = chains.points[ahead, 0] - strand.x, chains.points[ahead, 1] - strand.y
        if ux * ux + uy * uy > radius * radius:
            behind = ahead - step
            dx = chains.points[ahead, 0] - chains.points[behind, 0]
            dy = chains.points[ahead, 1] - chains.points[behind, 1]
            length = sqrt(dx * dx + dy * dy)
            dx, dy = dx / length, dy / length
            # From the foot of the centre, so that nothing cancels where the circle is far smaller than the edge.
            across = ux * dy - uy * dx
            half = sqrt(max(0.0, radius * radius - across * across))
            if step > 0:
                strand.last = behind
                strand.out_x, strand.out_y = across * dy + half * dx, half * dy - across * dx
            else:
                strand.first = ahead
                strand.in_x, strand.in_y = across * dy + half * dx, half * dy - across * dx
            return True
        ahead += step
    return False


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _bearing(x: cython.double, y: cython.double) -> cython.double:
    """Return a number from 0 to 4 that grows with the angle of a direction."""
    share: cython.double = y / (fabs(x) + fabs(y))
    if x < 0.0:
        return 2.0 - share
    return share if y >= 0.0 else 4.0 + share


@cython.cfunc
@cython.exceptval(check=False)
def _alternate(one: _Strand, other: _Strand) -> cython.bint:
    """Return whether the ends of two strands alternate around the circle."""
    a, b = _bearing(one.in_x, one.in_y), _bearing(one.out_x, one.out_y)
    c, d = _bearing(other.in_x, other.in_y), _bearing(other.out_x, other.out_y)
    return (min(a, b) < c < max(a, b)) != (min(a, b) < d < max(a, b))


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _is_beyond(x: cython.double, y: cython.double, distance: cython.double) -> cython.bint:
    return x * x + y * y > distance * distance


@cython.cfunc
@cython.exceptval(check=False)
def _are_apart(one: _Strand, other: _Strand, distance: cython.double) -> cython.bint:
    """Return whether each end of a strand is farther than that from each end of another."""
    return (
        _is_beyond(one.in_x - other.in_x, one.in_y - other.in_y, distance)
        and _is_beyond(one.in_x - other.out_x, one.in_y - other.out_y, distance)
        and _is_beyond(one.out_x - other.in_x, one.out_y - other.in_y, distance)
        and _is_beyond(one.out_x - other.out_x, one.out_y - other.out_y, distance)
    )


@cython.cfunc
def _pass_through(chains: _Chains, v: cython.Py_ssize_t, e: cython.Py_ssize_t) -> cython.bint:
    """Return whether the strand through a vertex crosses that of an edge there, and that has not been counted."""
    one: _Strand = _strand(chains, v, v - 1, v + 1)
    other: _Strand = _strand(chains, v, e, e + 1)
    one.radius = other.radius = 4.0 * chains.noise
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
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    for i in _edges(one):
        for j in _edges(other):
            if _adjoin(chains, i, j) or _relation(chains, i, j) != CROSSING:
                continue
            ax, ay = chains.points[i, 0], chains.points[i, 1]
            bx, by = chains.points[i + 1, 0], chains.points[i + 1, 1]
            cx, cy = chains.points[j, 0], chains.points[j, 1]
            dx, dy = chains.points[j + 1, 0], chains.points[j + 1, 1]
            c = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
            d = (bx - ax) * (dy - ay) - (by - ay) * (dx - ax)
            at = c / (c - d)
            if not _is_beyond(cx + at * (dx - cx) - one.x, cy + at * (dy - cy) - one.y, one.radius):
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
    if _is_beyond(one.x - p.x, one.y - p.y, one.radius + p.radius):
        return False
    return (_overlap(one, p) and _overlap(other, q)) or (_overlap(one, q) and _overlap(other, p))


@cython.cfunc
@cython.exceptval(check=False)
def _overlap(one: _Strand, other: _Strand) -> cython.bint:
    """Return whether two strands have an edge in common."""
    return one.chain == other.chain and (_has_edge(one, other.first) or _has_edge(other, one.first))


@cython.cfunc
@cython.exceptval(check=False)
def _has_edge(strand: _Strand, edge: cython.Py_ssize_t) -> cython.bint:
    if strand.first <= strand.last:
        return strand.first <= edge <= strand.last
    return edge >= strand.first or edge <= strand.last
