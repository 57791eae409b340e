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
CHAIN = cython.declare(cython.int, 3)
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
    blocks : (b, 4) int
        The first and the last point, the run of edges that point into one quadrant, the chain; ordered by their left.
    boxes : (b, 4) float
        Left, top, right and bottom of each block.
    noise : float > 0
        Points nearer to each other than this coincide.
    reach : float
        Strands that stay together this far from where they meet run along each other.
    passages : dict
        Where strands have been found to cross at a vertex, by their edges.
    """

    points: cython.double[:, ::1]
    starts: cython.Py_ssize_t[::1]
    blocks: cython.Py_ssize_t[:, ::1]
    boxes: cython.double[:, ::1]
    noise: cython.double
    reach: cython.double
    passages: dict[int, list[_Passage]]

    def __init__(self, points: FloatArray, starts: IntArray, noise: float, reach: float) -> None:
        self.points, self.starts, self.noise, self.reach = points, starts, noise, reach
        blocks, boxes = np.empty((len(points), 4), np.intp), np.empty((len(points), 4))
        count = _cut_into_blocks(points, starts, blocks, boxes)
        order = np.argsort(boxes[:count, 0])
        self.blocks, self.boxes = blocks[order], boxes[order]
        self.passages = {}


@cython.cclass
class _Strand:
    """A chain where it passes through a circle.

    Attributes
    ----------
    chain, begin, end : int
        The chain, its first and its last point.
    closed : bool
    behind, ahead : int
        The points of the chain before and after the centre.
    first, last : int
        The edges on which it enters and leaves.
    in_x, in_y, out_x, out_y : float
        Where it does, from the centre.
    """

    chain: cython.Py_ssize_t
    begin: cython.Py_ssize_t
    end: cython.Py_ssize_t
    closed: cython.bint
    behind: cython.Py_ssize_t
    ahead: cython.Py_ssize_t
    first: cython.Py_ssize_t
    last: cython.Py_ssize_t
    in_x: cython.double
    in_y: cython.double
    out_x: cython.double
    out_y: cython.double


@cython.cclass
class _Passage:
    """Two strands that pass through each other in a circle."""

    x: cython.double
    y: cython.double
    radius: cython.double
    one: _Strand
    other: _Strand

    def __init__(
        self, x: cython.double, y: cython.double, radius: cython.double, one: _Strand, other: _Strand
    ) -> None:
        self.x, self.y, self.radius, self.one, self.other = x, y, radius, one, other


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
    axis: cython.int
    for k in range(segments.shape[0]):
        for n in range(counts[k]):
            t = cython.cast(cython.double, n) / counts[k]
            u = 1.0 - t
            a, b, c, d = u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t
            for axis in range(2):
                points[places[k] + n, axis] = (
                    a * segments[k, axis]
                    + b * segments[k, 2 + axis]
                    + c * segments[k, 4 + axis]
                    + d * segments[k, 6 + axis]
                )


@cython.cfunc
def _cut_into_blocks(
    points: cython.double[:, ::1],
    starts: cython.Py_ssize_t[::1],
    blocks: cython.Py_ssize_t[:, ::1],
    boxes: cython.double[:, ::1],
) -> cython.Py_ssize_t:
    """Fill the blocks and boxes of chains, see `_Chains`; return how many they are, at most as many as points."""
    count: cython.Py_ssize_t = 0
    run: cython.Py_ssize_t = -1
    edges: cython.Py_ssize_t = 0
    k: cython.Py_ssize_t
    i: cython.Py_ssize_t
    last_quadrant: cython.int
    quadrant: cython.int
    for k in range(starts.shape[0] - 1):
        last_quadrant = -1
        for i in range(starts[k], starts[k + 1] - 1):
            x, y = points[i, 0], points[i, 1]
            next_x, next_y = points[i + 1, 0], points[i + 1, 1]
            quadrant = (1 if next_x >= x else 0) + (2 if next_y >= y else 0)
            if quadrant != last_quadrant or edges == BLOCK:
                if quadrant != last_quadrant:
                    run += 1
                last_quadrant = quadrant
                edges = 0
                blocks[count, FIRST], blocks[count, RUN], blocks[count, CHAIN] = i, run, k
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
    chain_p: cython.Py_ssize_t = chains.blocks[p, CHAIN]
    chain_q: cython.Py_ssize_t = chains.blocks[q, CHAIN]
    count: cython.Py_ssize_t = 0
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    relation: cython.int
    for i in range(chains.blocks[p, FIRST], chains.blocks[p, LAST]):
        left = min(chains.points[i, 0], chains.points[i + 1, 0]) - noise
        right = max(chains.points[i, 0], chains.points[i + 1, 0]) + noise
        top = min(chains.points[i, 1], chains.points[i + 1, 1]) - noise
        bottom = max(chains.points[i, 1], chains.points[i + 1, 1]) + noise
        if (
            left > chains.boxes[q, RIGHT]
            or right < chains.boxes[q, LEFT]
            or top > chains.boxes[q, BOTTOM]
            or bottom < chains.boxes[q, TOP]
            or max(right - left, bottom - top) - 2.0 * noise <= SHORT * noise
        ):
            continue
        for j in range(chains.blocks[q, FIRST], chains.blocks[q, LAST]):
            if (
                (left > chains.points[j, 0] and left > chains.points[j + 1, 0])
                or (right < chains.points[j, 0] and right < chains.points[j + 1, 0])
                or (top > chains.points[j, 1] and top > chains.points[j + 1, 1])
                or (bottom < chains.points[j, 1] and bottom < chains.points[j + 1, 1])
                or max(
                    fabs(chains.points[j, 0] - chains.points[j + 1, 0]),
                    fabs(chains.points[j, 1] - chains.points[j + 1, 1]),
                )
                <= SHORT * noise
                or _adjoin(chains, chain_p, chain_q, i, j)
            ):
                continue
            relation = _relation(chains, i, j)
            if relation == CROSSING:
                count += 1
            elif relation == TOUCHING:
                if _is_on_edge(chains, i, j):
                    count += _pass_through(
                        chains, _strand(chains, chain_p, i - 1, i + 1), _strand(chains, chain_q, j, j + 1), i
                    )
                if _is_on_edge(chains, j, i):
                    count += _pass_through(
                        chains, _strand(chains, chain_q, j - 1, j + 1), _strand(chains, chain_p, i, i + 1), j
                    )
    return count


@cython.cfunc
@cython.exceptval(check=False)
def _adjoin(
    chains: _Chains,
    chain_i: cython.Py_ssize_t,
    chain_j: cython.Py_ssize_t,
    i: cython.Py_ssize_t,
    j: cython.Py_ssize_t,
) -> cython.bint:
    """Return whether two edges are one or follow each other in a chain."""
    if chain_i != chain_j:
        return False
    if i - j == 1 or j - i == 1 or i == j:
        return True
    first: cython.Py_ssize_t = chains.starts[chain_i]
    last: cython.Py_ssize_t = chains.starts[chain_i + 1] - 1
    return min(i, j) == first and max(i, j) == last - 1 and _is_closed(chains, first, last)


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _is_closed(chains: _Chains, first: cython.Py_ssize_t, last: cython.Py_ssize_t) -> cython.bint:
    x_is_same: cython.bint = chains.points[first, 0] == chains.points[last, 0]
    return x_is_same and chains.points[first, 1] == chains.points[last, 1]


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
    chains: _Chains, chain: cython.Py_ssize_t, behind: cython.Py_ssize_t, ahead: cython.Py_ssize_t
) -> _Strand:
    strand: _Strand = _Strand.__new__(_Strand)  # a call of the class would pass arguments as Python objects
    strand.chain, strand.behind, strand.ahead = chain, behind, ahead
    strand.begin, strand.end = chains.starts[chain], chains.starts[chain + 1] - 1
    strand.closed = _is_closed(chains, strand.begin, strand.end)
    return strand


@cython.cfunc
@cython.exceptval(check=False)
def _leave(
    points: cython.double[:, ::1],
    strand: _Strand,
    step: cython.int,
    x: cython.double,
    y: cython.double,
    radius: cython.double,
) -> cython.bint:
    """Follow a strand onwards (step 1) or back (-1) until it leaves a circle; return whether it does before it ends."""
    count: cython.Py_ssize_t
    ahead: cython.Py_ssize_t = strand.ahead if step > 0 else strand.behind
    behind: cython.Py_ssize_t
    for count in range(min(FARTHEST, strand.end - strand.begin + 1)):  # noqa: B007
        if ahead < strand.begin or ahead > strand.end:
            if not strand.closed:
                return False
            ahead = strand.end - 1 if ahead < strand.begin else strand.begin + 1
        ux, uy = points[ahead, 0] - x, points[ahead, 1] - y
        if ux * ux + uy * uy > radius * radius:
            behind = ahead - step
            dx = points[ahead, 0] - points[behind, 0]
            dy = points[ahead, 1] - points[behind, 1]
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
def _pass_through(chains: _Chains, one: _Strand, other: _Strand, v: cython.Py_ssize_t) -> cython.bint:
    """Return whether two strands cross at a vertex and that has not been counted."""
    points: cython.double[:, ::1] = chains.points
    x: cython.double = points[v, 0]
    y: cython.double = points[v, 1]
    radius: cython.double = 2.0 * chains.noise
    apart: cython.bint = False
    while not apart:
        radius *= 2.0
        if not (
            radius <= chains.reach
            and _leave(points, one, -1, x, y, radius)
            and _leave(points, one, 1, x, y, radius)
            and _leave(points, other, -1, x, y, radius)
            and _leave(points, other, 1, x, y, radius)
        ):
            return False
        apart = _are_apart(one, other, 2.0 * chains.noise)
    here = _Passage(x, y, radius, one, other)
    # Inside the circle two edges may cross beyond doubt. That is this crossing, and counted.
    if not _alternate(one, other) or _cross_inside(chains, here):
        return False
    edges = [*_edges(one), *_edges(other)]
    for edge in edges:
        for known in chains.passages.get(edge, ()):
            if _is_same(here, known):
                return False
    for edge in edges:
        chains.passages.setdefault(edge, []).append(here)
    return True


@cython.cfunc
def _cross_inside(chains: _Chains, here: _Passage) -> cython.bint:
    """Return whether two strands have an odd number of crossings beyond doubt in a circle."""
    points: cython.double[:, ::1] = chains.points
    is_odd: cython.bint = False
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    for i in _edges(here.one):
        for j in _edges(here.other):
            if _adjoin(chains, here.one.chain, here.other.chain, i, j) or _relation(chains, i, j) != CROSSING:
                continue
            ax, ay, bx, by = points[i, 0], points[i, 1], points[i + 1, 0], points[i + 1, 1]
            cx, cy, dx, dy = points[j, 0], points[j, 1], points[j + 1, 0], points[j + 1, 1]
            c = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
            d = (bx - ax) * (dy - ay) - (by - ay) * (dx - ax)
            at = c / (c - d)
            if not _is_beyond(cx + at * (dx - cx) - here.x, cy + at * (dy - cy) - here.y, here.radius):
                is_odd = not is_odd
    return is_odd


@cython.cfunc
def _edges(strand: _Strand) -> list[int]:
    """Return the edges of a strand, in a closed chain past its end if need be."""
    if strand.first <= strand.last:
        return list(range(strand.first, strand.last + 1))
    return [*range(strand.first, strand.end), *range(strand.begin, strand.last + 1)]


@cython.cfunc
def _is_same(p: _Passage, q: _Passage) -> cython.bint:
    """Return whether two passages are one: near each other, and of the same strands."""
    if _is_beyond(p.x - q.x, p.y - q.y, p.radius + q.radius):
        return False
    return (_overlap(p.one, q.one) and _overlap(p.other, q.other)) or (
        _overlap(p.one, q.other) and _overlap(p.other, q.one)
    )


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
