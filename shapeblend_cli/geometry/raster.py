# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""Winding numbers of polygons around points, and on a grid of points; pictures that are thinned.

This file is compiled by Cython and runs uncompiled as well.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.cpython.exc import PyErr_CheckSignals as look_for_signals
    from cython.cimports.libc.math import ceil, fabs
else:
    from math import ceil, fabs

    from shapeblend_cli._cython import look_for_signals

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray

COMPILED = cython.compiled

MOST_BANDS = 256
"""Maximum number of bands into which edges are sorted."""


def winding_grid(
    starts: ComplexArray, ends: ComplexArray, corner: complex, step: float, side: int
) -> IntArray:
    """Return the winding numbers of closed polygons, taken together, around the points of a square grid.

    Parameters
    ----------
    starts, ends : (n,) complex
        The edges of all polygons, in any order.
    corner : complex
        Where the grid begins; its first point is half a step further, both ways.
    step : float
        The distance between neighbouring points.
    side : int
        The number of points along each side.

    Returns
    -------
    (side, side) int
        A row for each y; positive where a polygon runs from x towards y.
    """
    numbers = np.zeros((side, side), np.intc)
    _wind(starts, ends, corner, 1.0 / step, numbers)
    return numbers  # type: ignore[return-value]


def _wind(
    starts: cython.const[cython.doublecomplex][:],
    ends: cython.const[cython.doublecomplex][:],
    corner: cython.doublecomplex,
    scale: cython.double,
    numbers: cython.int[:, ::1],
) -> None:
    """Fill in the winding numbers; `scale` is the number of steps in a unit.

    At each crossing of an edge and a row the number changes for all points of the row beyond it.
    """
    side: cython.Py_ssize_t = numbers.shape[0]
    k: cython.Py_ssize_t
    row: cython.Py_ssize_t
    first: cython.Py_ssize_t
    last: cython.Py_ssize_t
    for k in range(starts.shape[0]):
        # In steps of the grid, whose rows and columns lie on whole numbers.
        x0: cython.double = (starts[k].real - corner.real) * scale - 0.5
        y0: cython.double = (starts[k].imag - corner.imag) * scale - 0.5
        x1: cython.double = (ends[k].real - corner.real) * scale - 0.5
        y1: cython.double = (ends[k].imag - corner.imag) * scale - 0.5
        change: cython.int = -1 if y1 > y0 else 1
        low: cython.double = min(y0, y1)
        high: cython.double = max(y0, y1)
        if high <= 0.0 or low > side - 1:
            continue
        first = 0 if low <= 0.0 else cython.cast(cython.Py_ssize_t, ceil(low))
        last = side if high > side - 1 else cython.cast(cython.Py_ssize_t, ceil(high))
        for row in range(first, last):
            x: cython.double = x0 + (row - y0) * (x1 - x0) / (y1 - y0)
            if x <= 0.0:
                numbers[row, 0] += change
            elif x <= side - 1:
                numbers[row, cython.cast(cython.Py_ssize_t, ceil(x))] += change
    for row in range(side):
        for k in range(1, side):
            numbers[row, k] += numbers[row, k - 1]


def count_folds(numbers: cython.const[cython.int][:, ::1]) -> int:
    """Return the number of points of a grid round which outlines wind the other way than round most, or twice."""
    # As wide as what is counted, so that the C compiler counts several at once.
    total: cython.int = 0
    wrong: cython.int = 0
    wrong_turned: cython.int = 0
    row: cython.Py_ssize_t
    k: cython.Py_ssize_t
    for row in range(numbers.shape[0]):
        for k in range(numbers.shape[1]):
            number: cython.int = numbers[row, k]
            total += number
            wrong += (number < 0) | (number > 1)
            wrong_turned += (number > 0) | (number < -1)
    return wrong_turned if total < 0 else wrong


def count_unlike(numbers: cython.const[cython.int][:, ::1]) -> tuple[int, int]:
    """Return how many points of a grid are inside, or else outside, unlike their mirror images in x; and all inside."""
    unlike: cython.int = 0
    inside: cython.int = 0
    last: cython.Py_ssize_t = numbers.shape[1] - 1
    row: cython.Py_ssize_t
    k: cython.Py_ssize_t
    for row in range(numbers.shape[0]):
        for k in range(last + 1):
            unlike += (numbers[row, k] != 0) != (numbers[row, last - k] != 0)
            inside += numbers[row, k] != 0
    return unlike, inside


class Bands(NamedTuple):
    """The edges of closed polygons by the bands of y that they reach, so that a point is compared with few of them."""

    edges: IntArray  # (e, 3), the vertices at both ends and the polygon of each edge in each band, band after band
    starts: IntArray  # (b + 1,), where each band begins there: first with edges across all of it, by their lowest x
    middles: IntArray  # (b,), where other edges begin
    lefts: FloatArray  # (e,), the lowest x of each edge
    reaches: FloatArray  # (e,), the highest x of each edge and those before it in the band
    low: float  # the lowest y
    scale: float  # bands per unit
    vertices: ComplexArray  # of all polygons
    boxes: (
        FloatArray  # (k, 4), the box of each polygon, as x, y, width and height: no other point is looked at
    )

    @classmethod
    def of(cls, polygons: Sequence[ComplexArray], boxes: FloatArray) -> Bands:
        """Sort the edges of polygons with these boxes into bands."""
        vertices, sizes = np.concatenate(polygons), np.array([len(polygon) for polygon in polygons])
        ends = np.arange(len(vertices))
        begins = ends - 1
        begins[np.cumsum(sizes) - sizes] = np.cumsum(sizes) - 1
        edges = np.stack([begins, ends, np.repeat(np.arange(len(sizes)), sizes)], axis=1)
        y = vertices.imag
        count = min(1 + len(polygons) // 4, MOST_BANDS)
        low = float(y.min())
        scale = count / max(float(y.max()) - low, 1e-300)
        band = np.clip((y - low) * scale, 0, count - 1).astype(np.intp)
        first, last = (pick(band[begins], band[ends]) for pick in (np.minimum, np.maximum))
        heights = np.where(y[begins] == y[ends], 0, last - first + 1)
        each = np.repeat(ends, heights)
        reached = np.arange(len(each)) - np.repeat(np.cumsum(heights) - heights - first, heights)
        x = vertices.real
        left, right = (pick(x[begins], x[ends])[each] for pick in (np.minimum, np.maximum))
        above, below = (pick(y[begins], y[ends])[each] for pick in (np.minimum, np.maximum))
        is_partial = ((above - low) * scale >= reached) | ((below - low) * scale <= reached + 1)
        order = np.lexsort((left, is_partial, reached))
        starts = np.searchsorted(reached[order], np.arange(count + 1))
        middles = starts[:count] + np.bincount(reached[~is_partial], minlength=count)
        reaches = [np.maximum.accumulate(run) for run in np.split(right[order], starts[1:count])]
        return cls(
            edges[each[order]],
            starts,
            middles,
            left[order],
            np.concatenate(reaches),
            low,
            scale,
            vertices,
            boxes,
        )


def winding_table(points: ComplexArray, bands: Bands) -> IntArray:
    """Return the winding numbers of the polygons of bands around points, (k, p), see `polygons.winding_numbers`."""
    numbers: IntArray = np.zeros((len(bands.boxes), len(points)), np.intc)
    edges, starts, low, scale = bands.edges, bands.starts, bands.low, bands.scale
    points = np.ascontiguousarray(points)
    _add_windings_in_bands(points, edges, starts, low, scale, bands.vertices, bands.boxes, numbers)
    return numbers


def winding_sums(points: ComplexArray, bands: Bands, factors: IntArray) -> IntArray:
    """Return the sum of these winding numbers around each point, (p,), each times the factor of its polygon.

    Of the edges across all of a point's band only those beside it are looked at: thousands may lie in each other.
    """
    begins, ends, polygons = bands.edges.T
    y = bands.vertices.imag
    values = np.where(y[begins] <= y[ends], factors[polygons], -factors[polygons])
    beyond = np.append(np.flip(np.cumsum(np.flip(values))), 0)
    sums: IntArray = np.zeros(len(points), np.intp)
    _sum_windings(np.ascontiguousarray(points), bands, values, beyond, sums)
    return sums


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _is_crossed(point: cython.doublecomplex, z: cython.doublecomplex, w: cython.doublecomplex) -> cython.bint:
    """Return whether the ray from a point along +x crosses the edge from z to w."""
    below: cython.bint = z.imag <= point.imag
    if below == (w.imag <= point.imag):
        return False
    # On which side of the edge the point lies.
    side: cython.double = (w.real - z.real) * (point.imag - z.imag) - (point.real - z.real) * (
        w.imag - z.imag
    )
    return side > 0.0 if below else side < 0.0


def _sum_windings(
    points: cython.const[cython.doublecomplex][::1],
    bands: Bands,
    values: cython.const[cython.Py_ssize_t][::1],
    beyond: cython.const[cython.Py_ssize_t][::1],
    sums: cython.Py_ssize_t[::1],
) -> None:
    """Add up the values of the edges that cross the ray from each point along +x."""
    edges: cython.const[cython.Py_ssize_t][:, ::1] = bands.edges
    starts: cython.const[cython.Py_ssize_t][::1] = bands.starts
    middles: cython.const[cython.Py_ssize_t][::1] = bands.middles
    lefts: cython.const[cython.double][::1] = bands.lefts
    reaches: cython.const[cython.double][::1] = bands.reaches
    vertices: cython.const[cython.doublecomplex][::1] = bands.vertices
    low: cython.double = bands.low
    scale: cython.double = bands.scale
    p: cython.Py_ssize_t
    e: cython.Py_ssize_t
    first: cython.Py_ssize_t
    last: cython.Py_ssize_t
    half: cython.Py_ssize_t
    band: cython.Py_ssize_t
    for p in range(points.shape[0]):
        if p % 64 == 0:
            look_for_signals()
        x: cython.double = points[p].real
        at: cython.double = (points[p].imag - low) * scale
        if not 0.0 <= at <= starts.shape[0] - 1:
            continue
        band = min(cython.cast(cython.Py_ssize_t, at), starts.shape[0] - 2)
        # Of the edges across the band, all that begin beyond the point are crossed.
        first, last = starts[band], middles[band]
        while first < last:
            half = (first + last) // 2
            if lefts[half] > x:
                last = half
            else:
                first = half + 1
        sums[p] = beyond[first] - beyond[middles[band]]
        e = first - 1
        while e >= starts[band] and reaches[e] >= x:
            if _is_crossed(points[p], vertices[edges[e, 0]], vertices[edges[e, 1]]):
                sums[p] += values[e]
            e -= 1
        for e in range(middles[band], starts[band + 1]):
            if _is_crossed(points[p], vertices[edges[e, 0]], vertices[edges[e, 1]]):
                sums[p] += values[e]


def _add_windings_in_bands(
    points: cython.const[cython.doublecomplex][::1],
    edges: cython.const[cython.Py_ssize_t][:, ::1],
    starts: cython.const[cython.Py_ssize_t][::1],
    low: cython.double,
    scale: cython.double,
    vertices: cython.const[cython.doublecomplex][::1],
    boxes: cython.const[cython.double][:, ::1],
    numbers: cython.int[:, ::1],
) -> None:
    """Count the edges that cross the ray from each point along +x, upwards less downwards."""
    p: cython.Py_ssize_t
    e: cython.Py_ssize_t
    k: cython.Py_ssize_t
    band: cython.Py_ssize_t
    for p in range(points.shape[0]):
        x: cython.double = points[p].real
        y: cython.double = points[p].imag
        at: cython.double = (y - low) * scale
        if not 0.0 <= at <= starts.shape[0] - 1:
            continue
        band = min(cython.cast(cython.Py_ssize_t, at), starts.shape[0] - 2)
        for e in range(starts[band], starts[band + 1]):
            z: cython.doublecomplex = vertices[edges[e, 0]]
            w: cython.doublecomplex = vertices[edges[e, 1]]
            k = edges[e, 2]
            if (
                _is_crossed(points[p], z, w)
                and fabs(x - boxes[k, 0] - boxes[k, 2] / 2) <= boxes[k, 2] / 2
                and fabs(y - boxes[k, 1] - boxes[k, 3] / 2) <= boxes[k, 3] / 2
            ):
                numbers[k, p] += 1 if z.imag <= y else -1
        look_for_signals()


def windings(points: ComplexArray, vertices: ComplexArray) -> IntArray:
    """Return the winding numbers of a closed polygon around points, see `polygons.winding_numbers`."""
    numbers: IntArray = np.zeros(len(points), np.intc)
    _add_windings(np.ascontiguousarray(points), np.ascontiguousarray(vertices), numbers)
    return numbers


def _add_windings(
    points: cython.const[cython.doublecomplex][::1],
    vertices: cython.const[cython.doublecomplex][::1],
    numbers: cython.int[::1],
) -> None:
    """Count the edges that cross the ray from each point along +x, upwards less downwards."""
    count: cython.Py_ssize_t = vertices.shape[0]
    p: cython.Py_ssize_t
    i: cython.Py_ssize_t
    before: cython.Py_ssize_t
    number: cython.int
    below: cython.bint
    for p in range(points.shape[0]):
        x: cython.double = points[p].real
        y: cython.double = points[p].imag
        number = 0
        before = count - 1
        below = vertices[before].imag <= y
        for i in range(count):
            if below == (vertices[i].imag <= y):
                before = i
                continue
            # On which side of the edge the point lies.
            side: cython.double = (vertices[i].real - vertices[before].real) * (y - vertices[before].imag) - (
                x - vertices[before].real
            ) * (vertices[i].imag - vertices[before].imag)
            if below and side > 0.0:
                number += 1
            elif not below and side < 0.0:
                number -= 1
            below = not below
            before = i
        numbers[p] = number
        if p % 64 == 0 or count > 1000:
            look_for_signals()


def thin(mask: BoolArray) -> BoolArray:
    """Return the pixels that are left when a picture is thinned from all sides, after Guo and Hall (1989).

    >>> thin(np.ones((3, 5), bool)).astype(int).tolist()
    [[0, 0, 0, 0, 0], [0, 1, 1, 1, 0], [0, 0, 0, 0, 0]]
    """
    picture = np.zeros((mask.shape[0] + 2, mask.shape[1] + 2), np.uint8)
    picture[1:-1, 1:-1] = mask
    _thin(picture, np.zeros(picture.shape, np.uint8), np.empty((3, picture.size), np.intp))
    return picture[1:-1, 1:-1].view(np.bool_)


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _is_loose(
    picture: cython.uchar[:, ::1], y: cython.Py_ssize_t, x: cython.Py_ssize_t, second: cython.bint
) -> cython.bint:
    """Return whether a pixel goes in the first pass of a round, or in the second."""
    n: cython.int = picture[y - 1, x]
    e: cython.int = picture[y, x + 1]
    s: cython.int = picture[y + 1, x]
    w: cython.int = picture[y, x - 1]
    ne: cython.int = picture[y - 1, x + 1]
    se: cython.int = picture[y + 1, x + 1]
    sw: cython.int = picture[y + 1, x - 1]
    nw: cython.int = picture[y - 1, x - 1]
    parts: cython.int = (
        ((1 - n) & (ne | e)) + ((1 - e) & (se | s)) + ((1 - s) & (sw | w)) + ((1 - w) & (nw | n))
    )
    if parts != 1:
        return False
    pairs: cython.int = min(
        (nw | n) + (ne | e) + (se | s) + (sw | w), (n | ne) + (e | se) + (s | sw) + (w | nw)
    )
    if pairs < 2 or pairs > 3:
        return False
    if second:
        return ((n | ne | (1 - se)) & e) == 0
    return ((s | sw | (1 - nw)) & w) == 0


def _thin(
    picture: cython.uchar[:, ::1], waits: cython.uchar[:, ::1], lists: cython.Py_ssize_t[:, ::1]
) -> None:
    """Take away pixels, 1, from a picture with a margin of 0, in rounds of two passes, until none goes.

    Each pass looks at those alone beside which something went since it looked at them last. `waits` has a bit for each
    pass where a pixel is in its list; the first two lists are those of the passes,
    the third is what goes.
    """
    width: cython.Py_ssize_t = picture.shape[1]
    second: cython.int
    k: cython.Py_ssize_t
    y: cython.Py_ssize_t
    x: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    gone: cython.Py_ssize_t
    first_count: cython.Py_ssize_t = 0
    for y in range(1, picture.shape[0] - 1):
        for x in range(1, width - 1):
            if picture[y, x]:
                waits[y, x] = 3
                lists[0, first_count] = lists[1, first_count] = y * width + x
                first_count += 1
    second_count: cython.Py_ssize_t = first_count
    while first_count or second_count:
        for second in range(2):
            count: cython.Py_ssize_t = second_count if second else first_count
            gone = 0
            for k in range(count):
                y, x = lists[second, k] // width, lists[second, k] % width
                waits[y, x] &= 1 if second else 2
                if picture[y, x] and _is_loose(picture, y, x, second):
                    lists[2, gone] = lists[second, k]
                    gone += 1
            if second:
                second_count = 0
            else:
                first_count = 0
            for k in range(gone):
                picture[lists[2, k] // width, lists[2, k] % width] = 0
            for k in range(gone):
                y, x = lists[2, k] // width, lists[2, k] % width
                for i in range(y - 1, y + 2):
                    for j in range(x - 1, x + 2):
                        if not picture[i, j]:
                            continue
                        if not waits[i, j] & 1:
                            lists[0, first_count] = i * width + j
                            first_count += 1
                        if not waits[i, j] & 2:
                            lists[1, second_count] = i * width + j
                            second_count += 1
                        waits[i, j] = 3
