"""How often chains of cubics, cut into straight edges, cross themselves and each other.

This file is compiled by Cython and runs uncompiled as well.

A chain is a run of points; it is closed if it ends where it began. Chains are often curves that were cut into chords,
so places nearer to each other than `noise` cannot be told apart, and the plain test of two edges only counts where
all four ends are farther than that from the other edge's line. Where an end of one edge lies on another edge, the two
strands through that place are followed outwards, both ways, until a circle around it has them apart. They cross
if they leave the circle in turn. Strands that are still together at the distance `reach` run along each other, and
do not cross, to whichever side they part in the end.

Chains are gone through in blocks: a few edges that all point into one quadrant. Such edges cannot cross.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.libc.math import fabs, sqrt
else:
    from math import fabs, sqrt

COMPILED = cython.compiled

# Edges in a block: longer ones have larger boxes, shorter ones are more to sort.
BLOCK = cython.declare(cython.Py_ssize_t, 12)

# Points after which a strand is no longer followed: it has then been near the other one for long.
FARTHEST = cython.declare(cython.Py_ssize_t, 64)

# Edges this much shorter than noise are passed over; those beside them say the same.
SHORT = cython.declare(cython.double, 1e-3)

# The columns of an array of blocks, and of an array of boxes.
FIRST = cython.declare(cython.int, 0)
LAST = cython.declare(cython.int, 1)
RUN = cython.declare(cython.int, 2)
CHAIN = cython.declare(cython.int, 3)
LEFT = cython.declare(cython.int, 0)
TOP = cython.declare(cython.int, 1)
RIGHT = cython.declare(cython.int, 2)
BOTTOM = cython.declare(cython.int, 3)

# What two edges do.
APART = cython.declare(cython.int, 0)
CROSSES = cython.declare(cython.int, 1)
TOUCHES = cython.declare(cython.int, 2)

CHORD_ERROR = 1e-6
"""How far chords may deviate from their curve; this and what follows are shares of the size of all paths together."""

NOISE = 1e-9
"""Points of polygons nearer to each other than this coincide."""

ROUNDING = 1e-15
"""The same for coordinates of size 1."""

REACH = 0.05
"""Strands that stay together this far run along each other."""

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, CubicPath, FloatArray, IntArray, Polygon

    # The place and how far round it was looked; of both strands the chain, the first edge and the last.
    _Passage = tuple[float, float, float, int, int, int, int, int, int]


def polygon_crossings(polygons: Sequence[Polygon]) -> int:
    """Count how often polygons cross themselves and each other, see `path_crossings`."""
    points = [np.append(p.vertices, p.vertices[0]) if p.closed else p.vertices for p in polygons]
    chains = np.concatenate([[0], np.cumsum([len(run) for run in points])])
    return _count(np.concatenate(points), chains, NOISE, None)


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
    tolerance = CHORD_ERROR * _size(segments)
    if tolerance == 0.0:
        return 0
    # A piece of 1/n of a segment deviates from its chord by at most 1/8 of its second derivative over n^2.
    counts = np.maximum(np.ceil(np.sqrt(0.75 / tolerance * bends)).astype(np.intp), 1)
    # Every segment gives the starts of its pieces, and the last one of a path its end as well.
    last = np.cumsum(lengths) - 1
    before = np.cumsum(counts)
    chains = np.concatenate([[0], before[last] + np.arange(1, len(lengths) + 1)])
    points = np.empty(chains[-1], np.complex128)
    places = before - counts + np.repeat(np.arange(len(lengths)), lengths)
    cut_into_chords(segments.view(np.float64), counts, places, _xy(points))
    # Rounding may have left the end of a closed one beside its start.
    first = last + 1 - np.asarray(lengths)
    points[chains[1:] - 1] = np.where(closed, segments[first, 0], segments[last, 3])
    return _count(points, chains, 4.0 * CHORD_ERROR if counts.max() > 1 else NOISE, most)


def _count(points: ComplexArray, chains: IntArray, noise: float, most: int | None) -> int:
    """Count the crossings of chains, with noise as a share of their size."""
    size = _size(points)
    # Far from the origin rounding is more than the share.
    noise = max(noise * size, ROUNDING * float(np.abs(points).max()))
    xy = _xy(points)
    blocks = np.empty((len(points), 4), np.intp)
    boxes = np.empty((len(points), 4))
    found = find_blocks(xy, chains, blocks, boxes)
    order = np.argsort(boxes[:found, 0])
    limit = len(points) ** 2 if most is None else most
    return count_crossings(xy, chains, blocks[order], boxes[order], noise, REACH * size, limit)


def _size(points: ComplexArray) -> float:
    return max(float(np.ptp(points.real)), float(np.ptp(points.imag)))


def _xy(points: ComplexArray) -> FloatArray:
    """Return the same memory as (n, 2) float."""
    return points.view(np.float64).reshape(-1, 2)


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def cut_into_chords(
    segments: cython.double[:, ::1],
    counts: cython.Py_ssize_t[::1],
    places: cython.Py_ssize_t[::1],
    points: cython.double[:, ::1],
) -> None:
    """Cut cubics into pieces of equal parameter.

    Parameters
    ----------
    segments : (k, 8) float
        x and y of the four control points.
    counts : (k,) int
        How many pieces.
    places : (k,) int
        Where in `points` a segment's go.
    points : (n, 2) float
        Is filled with the starts of the pieces.
    """
    k: cython.Py_ssize_t
    n: cython.Py_ssize_t
    t: cython.double
    u: cython.double
    a: cython.double
    b: cython.double
    c: cython.double
    d: cython.double
    for k in range(segments.shape[0]):
        for n in range(counts[k]):
            t = cython.cast(cython.double, n) / counts[k]
            u = 1.0 - t
            a = u * u * u
            b = 3.0 * u * u * t
            c = 3.0 * u * t * t
            d = t * t * t
            points[places[k] + n, 0] = (
                a * segments[k, 0] + b * segments[k, 2] + c * segments[k, 4] + d * segments[k, 6]
            )
            points[places[k] + n, 1] = (
                a * segments[k, 1] + b * segments[k, 3] + c * segments[k, 5] + d * segments[k, 7]
            )


@cython.boundscheck(False)
@cython.wraparound(False)
def find_blocks(
    points: cython.double[:, ::1],
    chains: cython.Py_ssize_t[::1],
    blocks: cython.Py_ssize_t[:, ::1],
    boxes: cython.double[:, ::1],
) -> int:
    """Cut chains into blocks of edges that point into one quadrant.

    Parameters
    ----------
    points : (n, 2) float
        The chains one after the other.
    chains : (c + 1,) int
        Where each chain begins in `points`, and the number of points.
    blocks : (n, 4) int
        Is filled: the first point, the last point, the run of edges of one quadrant, the chain.
    boxes : (n, 4) float
        Is filled: the least x and y, the largest x and y.

    Returns
    -------
    int
        How many blocks there are, at most `n`.
    """
    count: cython.Py_ssize_t = 0
    run: cython.Py_ssize_t = -1
    edges: cython.Py_ssize_t = 0
    quadrant: cython.int = -1
    here: cython.int
    k: cython.Py_ssize_t
    i: cython.Py_ssize_t
    x: cython.double
    y: cython.double
    next_x: cython.double
    next_y: cython.double
    for k in range(chains.shape[0] - 1):
        quadrant = -1
        for i in range(chains[k], chains[k + 1] - 1):
            x = points[i, 0]
            y = points[i, 1]
            next_x = points[i + 1, 0]
            next_y = points[i + 1, 1]
            here = (1 if next_x >= x else 0) + (2 if next_y >= y else 0)
            if here != quadrant or edges == BLOCK:
                if here != quadrant:
                    run += 1
                quadrant = here
                edges = 0
                blocks[count, FIRST] = i
                blocks[count, RUN] = run
                blocks[count, CHAIN] = k
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


@cython.boundscheck(False)
@cython.wraparound(False)
def count_crossings(
    points: cython.double[:, ::1],
    chains: cython.Py_ssize_t[::1],
    blocks: cython.Py_ssize_t[:, ::1],
    boxes: cython.double[:, ::1],
    noise: cython.double,
    reach: cython.double,
    most: cython.Py_ssize_t,
) -> int:
    """Count how often chains cross themselves and each other.

    Touching, at a vertex or along a common run, is no crossing; passing through each other at a vertex is one.

    Parameters
    ----------
    points, chains
        As in `find_blocks`.
    blocks, boxes : (b, 4) int and float
        What `find_blocks` found, in order of the boxes' least x.
    noise : float > 0
        Places nearer than this to each other are one place.
    reach : float
        Strands that stay together this far from such a place run along each other.
    most : int
        Stop counting there.

    Returns
    -------
    int
        O(b + pairs of blocks whose x ranges overlap), with more time for blocks whose boxes overlap.
    """
    count: cython.Py_ssize_t = 0
    met: dict[int, list[_Passage]] = {}
    exits: cython.double[:, ::1] = memoryview(bytearray(64)).cast("d", (4, 2))
    p: cython.Py_ssize_t
    q: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    found: cython.int
    left: cython.double
    top: cython.double
    right: cython.double
    bottom: cython.double
    short: cython.double = SHORT * noise
    for p in range(blocks.shape[0]):
        for q in range(p + 1, blocks.shape[0]):
            if boxes[q, LEFT] > boxes[p, RIGHT] + noise:
                break
            if boxes[q, TOP] > boxes[p, BOTTOM] + noise or boxes[q, BOTTOM] < boxes[p, TOP] - noise:
                continue
            if blocks[p, RUN] == blocks[q, RUN]:
                continue
            for i in range(blocks[p, FIRST], blocks[p, LAST]):
                left = min(points[i, 0], points[i + 1, 0]) - noise
                right = max(points[i, 0], points[i + 1, 0]) + noise
                top = min(points[i, 1], points[i + 1, 1]) - noise
                bottom = max(points[i, 1], points[i + 1, 1]) + noise
                if (
                    left > boxes[q, RIGHT]
                    or right < boxes[q, LEFT]
                    or top > boxes[q, BOTTOM]
                    or bottom < boxes[q, TOP]
                    or max(right - left, bottom - top) - 2.0 * noise <= short
                ):
                    continue
                for j in range(blocks[q, FIRST], blocks[q, LAST]):
                    if (
                        (left > points[j, 0] and left > points[j + 1, 0])
                        or (right < points[j, 0] and right < points[j + 1, 0])
                        or (top > points[j, 1] and top > points[j + 1, 1])
                        or (bottom < points[j, 1] and bottom < points[j + 1, 1])
                        or max(fabs(points[j, 0] - points[j + 1, 0]), fabs(points[j, 1] - points[j + 1, 1]))
                        <= short
                        or _adjoin(points, chains, blocks[p, CHAIN], blocks[q, CHAIN], i, j)
                    ):
                        continue
                    found = _crosses(points, i, j, noise)
                    if found == CROSSES:
                        count += 1
                    elif found == TOUCHES:
                        if _is_near(points, i, j, noise):
                            count += _passes(
                                points,
                                chains,
                                blocks[p, CHAIN],
                                blocks[q, CHAIN],
                                i,
                                j,
                                noise,
                                reach,
                                exits,
                                met,
                            )
                        if _is_near(points, j, i, noise):
                            count += _passes(
                                points,
                                chains,
                                blocks[q, CHAIN],
                                blocks[p, CHAIN],
                                j,
                                i,
                                noise,
                                reach,
                                exits,
                                met,
                            )
                    if count >= most:
                        return count
    return count


@cython.cfunc
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
def _adjoin(
    points: cython.double[:, ::1],
    chains: cython.Py_ssize_t[::1],
    chain_i: cython.Py_ssize_t,
    chain_j: cython.Py_ssize_t,
    i: cython.Py_ssize_t,
    j: cython.Py_ssize_t,
) -> cython.bint:
    """Whether two edges follow each other in a chain."""
    if chain_i != chain_j:
        return False
    if i - j == 1 or j - i == 1 or i == j:
        return True
    first: cython.Py_ssize_t = chains[chain_i]
    last: cython.Py_ssize_t = chains[chain_i + 1] - 1
    return min(i, j) == first and max(i, j) == last - 1 and _is_closed(points, first, last)


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
def _is_closed(
    points: cython.double[:, ::1], first: cython.Py_ssize_t, last: cython.Py_ssize_t
) -> cython.bint:
    return points[first, 0] == points[last, 0] and points[first, 1] == points[last, 1]


@cython.cfunc
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
def _crosses(
    points: cython.double[:, ::1], i: cython.Py_ssize_t, j: cython.Py_ssize_t, noise: cython.double
) -> cython.int:
    """Whether two edges cross beyond doubt, lie apart, or come as near to each other as noise."""
    ax: cython.double = points[i, 0]
    ay: cython.double = points[i, 1]
    bx: cython.double = points[i + 1, 0] - ax
    by: cython.double = points[i + 1, 1] - ay
    cx: cython.double = points[j, 0] - ax
    cy: cython.double = points[j, 1] - ay
    dx: cython.double = points[j + 1, 0] - ax
    dy: cython.double = points[j + 1, 1] - ay
    # Twice the areas of triangles over the first edge, and over the second.
    c: cython.double = bx * cy - by * cx
    d: cython.double = bx * dy - by * dx
    limit: cython.double = noise * sqrt(bx * bx + by * by)
    if (c > limit and d > limit) or (c < -limit and d < -limit):
        return APART
    ex: cython.double = dx - cx
    ey: cython.double = dy - cy
    a: cython.double = ey * cx - ex * cy
    b: cython.double = ex * (by - cy) - ey * (bx - cx)
    other: cython.double = noise * sqrt(ex * ex + ey * ey)
    if (a > other and b > other) or (a < -other and b < -other):
        return APART
    if fabs(c) > limit and fabs(d) > limit and fabs(a) > other and fabs(b) > other:
        return CROSSES
    return TOUCHES


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _foot(points: cython.double[:, ::1], v: cython.Py_ssize_t, e: cython.Py_ssize_t) -> cython.double:
    """Where on an edge, from 0 to 1, the point nearest to a vertex lies."""
    dx: cython.double = points[e + 1, 0] - points[e, 0]
    dy: cython.double = points[e + 1, 1] - points[e, 1]
    along: cython.double = (points[v, 0] - points[e, 0]) * dx + (points[v, 1] - points[e, 1]) * dy
    return max(0.0, min(1.0, along / (dx * dx + dy * dy)))


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
def _on_edge(
    points: cython.double[:, ::1], e: cython.Py_ssize_t, at: cython.double, axis: cython.int
) -> cython.double:
    return points[e, axis] + at * (points[e + 1, axis] - points[e, axis])


@cython.cfunc
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
def _is_near(
    points: cython.double[:, ::1], v: cython.Py_ssize_t, e: cython.Py_ssize_t, noise: cython.double
) -> cython.bint:
    """Whether a vertex lies on an edge."""
    at: cython.double = _foot(points, v, e)
    x: cython.double = _on_edge(points, e, at, 0) - points[v, 0]
    y: cython.double = _on_edge(points, e, at, 1) - points[v, 1]
    return x * x + y * y <= noise * noise


@cython.cfunc
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def _leaves(
    points: cython.double[:, ::1],
    first: cython.Py_ssize_t,
    last: cython.Py_ssize_t,
    ahead: cython.Py_ssize_t,
    step: cython.int,
    x: cython.double,
    y: cython.double,
    radius: cython.double,
    exits: cython.double[:, ::1],
    row: cython.int,
) -> cython.Py_ssize_t:
    """Follow a strand until it leaves a circle.

    Parameters
    ----------
    points : (n, 2) float
    first, last : int
        The first and the last point of the chain.
    ahead : int
        The next point on the way.
    step : {1, -1}
        Onwards or back.
    x, y, radius
        The circle. The strand begins inside.
    exits : (4, 2) float
        In the given row the place is filled in, from the centre.
    row : int

    Returns
    -------
    int
        The edge on which it leaves; -1 if it ends before, or does not get out.
    """
    closed: cython.bint = _is_closed(points, first, last)
    count: cython.Py_ssize_t
    behind: cython.Py_ssize_t
    ux: cython.double
    uy: cython.double
    dx: cython.double
    dy: cython.double
    length: cython.double
    across: cython.double
    half: cython.double
    for count in range(min(FARTHEST, last - first + 1)):  # noqa: B007
        if ahead < first:
            if not closed:
                return -1
            ahead = last - 1
        elif ahead > last:
            if not closed:
                return -1
            ahead = first + 1
        ux = points[ahead, 0] - x
        uy = points[ahead, 1] - y
        if ux * ux + uy * uy > radius * radius:
            behind = ahead - step
            dx = points[ahead, 0] - points[behind, 0]
            dy = points[ahead, 1] - points[behind, 1]
            length = sqrt(dx * dx + dy * dy)
            dx = dx / length
            dy = dy / length
            # From the foot of the centre, so that nothing cancels where the circle is far smaller than the edge.
            across = ux * dy - uy * dx
            half = sqrt(max(0.0, radius * radius - across * across))
            exits[row, 0] = across * dy + half * dx
            exits[row, 1] = half * dy - across * dx
            return min(ahead, behind)
        ahead += step
    return -1


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
@cython.cdivision(True)
def _bearing(x: cython.double, y: cython.double) -> cython.double:
    """Grow with the angle of a direction, from 0 to 4."""
    share: cython.double = y / (fabs(x) + fabs(y))
    if x < 0.0:
        return 2.0 - share
    return share if y >= 0.0 else 4.0 + share


@cython.cfunc
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
def _in_turn(exits: cython.double[:, ::1]) -> cython.bint:
    """Whether going round meets one strand, the other, the one, the other: rows 0 and 1 are one strand's."""
    a: cython.double = _bearing(exits[0, 0], exits[0, 1])
    b: cython.double = _bearing(exits[1, 0], exits[1, 1])
    c: cython.double = _bearing(exits[2, 0], exits[2, 1])
    d: cython.double = _bearing(exits[3, 0], exits[3, 1])
    return (min(a, b) < c < max(a, b)) != (min(a, b) < d < max(a, b))


@cython.cfunc
@cython.exceptval(check=False)
@cython.boundscheck(False)
@cython.wraparound(False)
def _are_apart(
    exits: cython.double[:, ::1], p: cython.int, q: cython.int, distance: cython.double
) -> cython.bint:
    x: cython.double = exits[p, 0] - exits[q, 0]
    y: cython.double = exits[p, 1] - exits[q, 1]
    return x * x + y * y > distance * distance


@cython.cfunc
@cython.boundscheck(False)
@cython.wraparound(False)
def _passes(
    points: cython.double[:, ::1],
    chains: cython.Py_ssize_t[::1],
    chain_v: cython.Py_ssize_t,
    chain_e: cython.Py_ssize_t,
    v: cython.Py_ssize_t,
    e: cython.Py_ssize_t,
    noise: cython.double,
    reach: cython.double,
    exits: cython.double[:, ::1],
    met: dict[int, list[_Passage]],
) -> cython.bint:
    """Whether the strand through a vertex crosses the one through an edge there, and nobody has counted that.

    Parameters
    ----------
    points, chains, noise, reach
        As in `count_crossings`.
    chain_v, chain_e, v, e : int
        A vertex that lies on an edge, and the chains of both.
    exits : (4, 2) float
        Room to work in.
    met : dict
        Where strands were found to cross so, under each edge of theirs; another one is added.
    """
    v_first: cython.Py_ssize_t = chains[chain_v]
    v_last: cython.Py_ssize_t = chains[chain_v + 1] - 1
    e_first: cython.Py_ssize_t = chains[chain_e]
    e_last: cython.Py_ssize_t = chains[chain_e + 1] - 1
    v_from: cython.Py_ssize_t
    v_to: cython.Py_ssize_t
    e_from: cython.Py_ssize_t
    e_to: cython.Py_ssize_t
    x: cython.double = points[v, 0]
    y: cython.double = points[v, 1]
    radius: cython.double = 4.0 * noise
    while radius <= reach:
        v_from = _leaves(points, v_first, v_last, v - 1, -1, x, y, radius, exits, 0)
        v_to = _leaves(points, v_first, v_last, v + 1, 1, x, y, radius, exits, 1)
        e_from = _leaves(points, e_first, e_last, e, -1, x, y, radius, exits, 2)
        e_to = _leaves(points, e_first, e_last, e + 1, 1, x, y, radius, exits, 3)
        if v_from < 0 or v_to < 0 or e_from < 0 or e_to < 0:
            return False
        if (
            _are_apart(exits, 0, 2, 2.0 * noise)
            and _are_apart(exits, 0, 3, 2.0 * noise)
            and _are_apart(exits, 1, 2, 2.0 * noise)
            and _are_apart(exits, 1, 3, 2.0 * noise)
        ):
            break
        radius *= 2.0
    else:
        return False
    if not _in_turn(exits):
        return False
    # Between the exits two edges may cross beyond doubt. That is this crossing, and counted.
    if _cross_inside(points, chains, chain_v, chain_e, (v_from, v_to, e_from, e_to), x, y, radius, noise):
        return False
    here: _Passage = (x, y, radius, chain_v, v_from, v_to, chain_e, e_from, e_to)
    edges = [*_strand(chains, chain_v, v_from, v_to), *_strand(chains, chain_e, e_from, e_to)]
    for edge in edges:
        for other in met.get(edge, ()):
            if _is_same(here, other, chains):
                return False
    for edge in edges:
        met.setdefault(edge, []).append(here)
    return True


def _cross_inside(
    points: cython.double[:, ::1],
    chains: cython.Py_ssize_t[::1],
    chain_p: cython.Py_ssize_t,
    chain_q: cython.Py_ssize_t,
    edges: tuple[int, int, int, int],
    x: cython.double,
    y: cython.double,
    radius: cython.double,
    noise: cython.double,
) -> bool:
    """Whether two strands have an odd number of crossings beyond doubt in a circle."""
    is_odd = False
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    ax: cython.double
    ay: cython.double
    bx: cython.double
    by: cython.double
    cx: cython.double
    cy: cython.double
    dx: cython.double
    dy: cython.double
    for i in _strand(chains, chain_p, edges[0], edges[1]):
        for j in _strand(chains, chain_q, edges[2], edges[3]):
            if _adjoin(points, chains, chain_p, chain_q, i, j) or _crosses(points, i, j, noise) != CROSSES:
                continue
            ax, ay, bx, by = points[i, 0], points[i, 1], points[i + 1, 0], points[i + 1, 1]
            cx, cy, dx, dy = points[j, 0], points[j, 1], points[j + 1, 0], points[j + 1, 1]
            c = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
            d = (bx - ax) * (dy - ay) - (by - ay) * (dx - ax)
            at = c / (c - d)
            px, py = cx + at * (dx - cx) - x, cy + at * (dy - cy) - y
            is_odd ^= px * px + py * py <= radius * radius
    return is_odd


def _strand(chains: cython.Py_ssize_t[::1], chain: cython.Py_ssize_t, first: int, last: int) -> list[int]:
    """The edges of a chain from one to another, round the end if it has to be."""
    if first <= last:
        return list(range(first, last + 1))
    return [*range(first, chains[chain + 1] - 1), *range(chains[chain], last + 1)]


def _is_same(one: _Passage, other: _Passage, chains: cython.Py_ssize_t[::1]) -> bool:
    """Whether two places where strands cross are one: near each other, and on the same strands."""
    x, y, reach = one[0] - other[0], one[1] - other[1], one[2] + other[2]
    if x * x + y * y > reach * reach:
        return False
    p, q, r, s = one[3:6], one[6:9], other[3:6], other[6:9]
    return (_overlap(p, r, chains) and _overlap(q, s, chains)) or (
        _overlap(p, s, chains) and _overlap(q, r, chains)
    )


def _overlap(one: tuple[int, int, int], other: tuple[int, int, int], chains: cython.Py_ssize_t[::1]) -> bool:
    """Whether two strands, each a chain and its first and last edge, have an edge in common."""
    if one[0] != other[0]:
        return False
    chain: cython.Py_ssize_t = one[0]
    around = chains[chain + 1] - 1 - chains[chain]
    ahead = (other[1] - one[1]) % around
    return ahead <= (one[2] - one[1]) % around or around - ahead <= (other[2] - other[1]) % around
