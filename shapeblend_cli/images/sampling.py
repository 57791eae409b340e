# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""Pictures drawn in triangles, pixel by pixel, and laid over each other.

This file is compiled by Cython and runs uncompiled as well. Compiled, it lets other threads run meanwhile.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.libc.math import ceil, floor
else:
    from math import ceil, floor

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from shapeblend_cli.model import FloatArray, UIntArray

COMPILED = cython.compiled

BEYOND = 1.5
"""Distance to which pixels beyond an edge of a triangle are drawn, if no triangle has them, in pixels."""

EDGE = 0.75
"""Distance to which the edge of a picture is drawn on, in pixels: half of one may be seen within a clip path."""

ROUND = 1 << 20
"""Number of pixels, about, after which Python may handle signals."""


class Layer(NamedTuple):
    """A picture that is seen in triangles."""

    sources: FloatArray  # (k, 3, 2), the corners in pixels of the picture, whose centres are at halves
    picture: UIntArray  # (h, w, 4), premultiplied
    weight: float  # with which it is added, from 0 to 1


def draw_triangles(corners: FloatArray, layers: Sequence[Layer], width: int, height: int) -> UIntArray:
    """Return the sum of pictures that are drawn in triangles.

    Parameters
    ----------
    corners : (k, 3, 2) float
        Corners of the triangles in pixels of what is drawn, whose centres are at halves. Triangles without a positive
        area are left out.
    layers : sequence of Layer
        With weights that are at most 1 together.
    width, height : int
        Size of what is drawn, in pixels.

    Returns
    -------
    (height, width, 4) uint8
        Premultiplied; nothing further than `BEYOND` from triangles.
    """
    corners = np.ascontiguousarray(corners, np.float64)
    triangles = np.full((height, width), -1, np.intc)
    # First what lies inside; then what lies next to an edge: of a clip path it may be half a pixel that is seen.
    for beyond in (0.0, BEYOND):
        k = 0
        while k < len(corners):
            k = _find(corners, triangles, beyond, k)
    sums = np.full((height, width, 4), 128, np.uint16)
    for sources, picture, weight in layers:
        maps = _maps(corners, np.ascontiguousarray(sources, np.float64))
        share = round(weight * (1 << 15))
        pixels = _in_words(picture.astype(np.uint16))
        for first, last in _rounds(height, width):
            _add(pixels, share, maps, triangles[first:last], _in_words(sums[first:last]), first)
    drawn: UIntArray = (sums >> 8).astype(np.uint8)
    return drawn


def lay_over(target: UIntArray, layer: UIntArray, mask: UIntArray, left: int, top: int) -> None:
    """Lay a picture over a part of another one.

    Parameters
    ----------
    target : (h, w, 4) uint8
        Premultiplied; changed in place.
    layer : (n, m, 4) uint8
        Premultiplied.
    mask : (n, m) uint8
        How much is seen of each pixel.
    left, top : int
        Place of the layer in the target, which holds all of it.
    """
    height, width = mask.shape
    for first, last in _rounds(height, width):
        _lay(
            target[top + first : top + last], np.ascontiguousarray(layer[first:last]), mask[first:last], left
        )


def _in_words(values: NDArray[np.uint16]) -> NDArray[np.uint64]:
    """Return a view of (h, w, 4) colours as (h, w) words: sums and products of four colours take one step."""
    return values.view(np.uint64)[:, :, 0]


def _rounds(height: int, width: int) -> Iterator[tuple[int, int]]:
    """Yield the first and the last row of each part of a picture of about `ROUND` pixels."""
    rows = max(1, ROUND // max(width, 1))
    for first in range(0, height, rows):
        yield first, min(first + rows, height)


def _maps(corners: FloatArray, sources: FloatArray) -> FloatArray:
    """Return where the triangles' pixels are in a picture.

    Returns
    -------
    (k, 7) float
        x at pixel (0, 0) of the target, in pixels counted from the centre of the picture's first one; how far x goes
        from one column and from one row to the next; the same of y; and how far beyond the picture's edge it is drawn.
    """
    (bx, by), (cx, cy) = (np.moveaxis(corners[:, n] - corners[:, 0], -1, 0) for n in (1, 2))
    area = bx * cy - by * cx
    area = np.where(area > 0.0, area, 1.0)
    u, v = (sources[:, n] - sources[:, 0] for n in (1, 2))
    columns = (u * cy[:, None] - v * by[:, None]) / area[:, None]
    rows = (v * bx[:, None] - u * cx[:, None]) / area[:, None]
    own = 0.5 - corners[:, 0]
    start = sources[:, 0] - 0.5 + columns * own[:, :1] + rows * own[:, 1:]
    slack = 0.5 + EDGE * np.sqrt(np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / area)
    both = np.stack([start, columns, rows], axis=-1).reshape(-1, 6)
    return np.ascontiguousarray(np.append(both, slack[:, None], axis=1))


def _find(
    corners: cython.double[:, :, ::1],
    triangles: cython.int[:, ::1],
    beyond: cython.double,
    k: cython.Py_ssize_t,
) -> cython.Py_ssize_t:
    """Give pixels that have none yet the first triangle that holds them; return the number of the next triangle.

    Triangles reach as far as `beyond` around their sides, in pixels.
    """
    height: cython.Py_ssize_t = triangles.shape[0]
    width: cython.Py_ssize_t = triangles.shape[1]
    looked: cython.Py_ssize_t = 0
    most: cython.Py_ssize_t = ROUND
    row: cython.Py_ssize_t
    column: cython.Py_ssize_t
    with cython.nogil:
        while k < corners.shape[0] and looked < most:
            ax: cython.double = corners[k, 0, 0] - 0.5
            ay: cython.double = corners[k, 0, 1] - 0.5
            bx: cython.double = corners[k, 1, 0] - 0.5 - ax
            by: cython.double = corners[k, 1, 1] - 0.5 - ay
            cx: cython.double = corners[k, 2, 0] - 0.5 - ax
            cy: cython.double = corners[k, 2, 1] - 0.5 - ay
            area: cython.double = bx * cy - by * cx
            top: cython.double = ceil(max(ay + min(0.0, by, cy) - beyond, 0.0))
            bottom: cython.double = floor(min(ay + max(0.0, by, cy) + beyond, height - 1.0))
            left: cython.double = max(ax + min(0.0, bx, cx) - beyond, 0.0)
            right: cython.double = min(ax + max(0.0, bx, cx) + beyond, width - 1.0)
            k += 1
            if not area > 0.0 or top > bottom or left > right:
                continue
            # How much twice the area of the triangle of a point and a side is less, if the point is beyond it.
            side_a: cython.double = beyond * ((cx - bx) ** 2 + (cy - by) ** 2) ** 0.5 + 1e-9 * area
            side_b: cython.double = beyond * (cx * cx + cy * cy) ** 0.5 + 1e-9 * area
            side_c: cython.double = beyond * (bx * bx + by * by) ** 0.5 + 1e-9 * area
            for row in range(cython.cast(cython.Py_ssize_t, top), cython.cast(cython.Py_ssize_t, bottom) + 1):
                y: cython.double = row - ay
                # The same areas at the column 0; from each column to the next they grow by -by, cy and by - cy.
                b: cython.double = side_b - y * cx - ax * cy
                c: cython.double = side_c + y * bx + ax * by
                a: cython.double = side_a + area - y * (bx - cx) + ax * (cy - by)
                first: cython.double = _from(_from(_from(left, cy, b), -by, c), by - cy, a)
                last: cython.double = _until(_until(_until(right, cy, b), -by, c), by - cy, a)
                looked += 1
                if first > last:
                    continue
                for column in range(
                    cython.cast(cython.Py_ssize_t, ceil(first)),
                    cython.cast(cython.Py_ssize_t, floor(last)) + 1,
                ):
                    if triangles[row, column] < 0:
                        triangles[row, column] = k - 1
                    looked += 1
    return k


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _from(first: cython.double, slope: cython.double, value: cython.double) -> cython.double:
    """Return the first column, `first` or later, from which on what is `value` at the column 0 is not below 0."""
    if slope > 0.0:
        return max(first, -value / slope)
    return first if slope < 0.0 or value >= 0.0 else 1e300


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _until(last: cython.double, slope: cython.double, value: cython.double) -> cython.double:
    """Return the last column, `last` or earlier, until which it is not below 0."""
    return min(last, -value / slope) if slope < 0.0 else last


def _add(
    picture: cython.ulonglong[:, ::1],
    share: cython.int,
    maps: cython.double[:, ::1],
    triangles: cython.int[:, ::1],
    sums: cython.ulonglong[:, ::1],
    top: cython.Py_ssize_t,
) -> None:
    """Add a picture, its share in 2**15ths, to sums in 256ths of a colour, in rows from `top` on.

    A word has the four colours of a pixel, of 16 bits each.
    """
    row: cython.Py_ssize_t
    width: cython.Py_ssize_t = triangles.shape[1]
    with cython.nogil:
        for row in range(triangles.shape[0]):
            first: cython.Py_ssize_t = 0
            while first < width:
                last: cython.Py_ssize_t = first
                k: cython.Py_ssize_t = triangles[row, first]
                while last + 1 < width and triangles[row, last + 1] == k:
                    last += 1
                if k >= 0:
                    x: cython.double = maps[k, 0] + (top + row) * maps[k, 2] + first * maps[k, 1]
                    y: cython.double = maps[k, 3] + (top + row) * maps[k, 5] + first * maps[k, 4]
                    _add_run(picture, share, maps[k], x, y, sums[row, first : last + 1])
                first = last + 1


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _add_run(
    picture: cython.ulonglong[:, ::1],
    share: cython.int,
    own: cython.double[::1],
    x: cython.double,
    y: cython.double,
    sums: cython.ulonglong[::1],
) -> cython.void:
    """Add what a picture has along a row, between its pixels; nothing where that is beyond its edge."""
    height: cython.Py_ssize_t = picture.shape[0]
    width: cython.Py_ssize_t = picture.shape[1]
    dx: cython.double = own[1]
    dy: cython.double = own[4]
    slack: cython.double = own[6]
    begin: cython.double = _from(_from(0.0, dx, x + slack), -dx, width - 1.0 + slack - x)
    begin = _from(_from(begin, dy, y + slack), -dy, height - 1.0 + slack - y)
    end: cython.double = _until(_until(sums.shape[0] - 1.0, dx, x + slack), -dx, width - 1.0 + slack - x)
    end = _until(_until(end, dy, y + slack), -dy, height - 1.0 + slack - y)
    begin, end = ceil(begin), floor(end)
    if begin > end:
        return
    # From here on whole numbers, in 2**32ths of a pixel: they add up without an error that grows.
    place_x: cython.longlong = _place(x + begin * dx)
    place_y: cython.longlong = _place(y + begin * dy)
    step_x: cython.longlong = _place(dx) if begin < end else 0
    step_y: cython.longlong = _place(dy) if begin < end else 0
    most_x: cython.longlong = cython.cast(cython.longlong, width - 1) << 32
    most_y: cython.longlong = cython.cast(cython.longlong, height - 1) << 32
    every_other: cython.ulonglong = 0x0000FFFF0000FFFF
    half: cython.ulonglong = 0x0000400000004000
    k: cython.Py_ssize_t
    for k in range(cython.cast(cython.Py_ssize_t, begin), cython.cast(cython.Py_ssize_t, end) + 1):
        at_x: cython.longlong = min(max(place_x, 0), most_x)
        at_y: cython.longlong = min(max(place_y, 0), most_y)
        x0: cython.Py_ssize_t = at_x >> 32
        y0: cython.Py_ssize_t = at_y >> 32
        x1: cython.Py_ssize_t = min(x0 + 1, width - 1)
        y1: cython.Py_ssize_t = min(y0 + 1, height - 1)
        u: cython.int = (at_x >> 24) & 255
        v: cython.int = (at_y >> 24) & 255
        # The shares of four pixels are 256 together, so that no colour runs into the next one.
        both: cython.int = (u * v + 128) >> 8
        value: cython.ulonglong = (
            _word(picture[y0, x0]) * (256 - u - v + both)
            + _word(picture[y0, x1]) * (u - both)
            + _word(picture[y1, x0]) * (v - both)
            + _word(picture[y1, x1]) * both
        )
        even: cython.ulonglong = (((value & every_other) * share + half) >> 15) & every_other
        odd: cython.ulonglong = ((((value >> 16) & every_other) * share + half) >> 15) & every_other
        sums[k] = _word(sums[k]) + even + (odd << 16)
        place_x += step_x
        place_y += step_y


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def _word(value: cython.ulonglong) -> cython.ulonglong:
    """Return a word as what it is, also uncompiled."""
    return cython.cast(cython.ulonglong, value)


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def _number(colour: cython.uchar) -> cython.int:
    """Return a colour as a number that may become larger than a colour."""
    return cython.cast(cython.Py_ssize_t, colour)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def _place(value: cython.double) -> cython.longlong:
    """Return a place in 2**32ths of a pixel."""
    return cython.cast(cython.longlong, floor(value * 4294967296.0))


def _lay(
    target: cython.uchar[:, :, ::1],
    layer: cython.uchar[:, :, ::1],
    mask: cython.uchar[:, ::1],
    left: cython.Py_ssize_t,
) -> None:
    """Lay a picture over as many rows of a target, from a column on."""
    row: cython.Py_ssize_t
    column: cython.Py_ssize_t
    n: cython.Py_ssize_t
    with cython.nogil:
        for row in range(mask.shape[0]):
            for column in range(mask.shape[1]):
                share: cython.int = _number(mask[row, column])
                if share == 0:
                    continue
                own: cython.int = _number(layer[row, column, 3])
                through: cython.int = 65025 - share * own
                if through == 0:
                    for n in range(4):
                        target[row, left + column, n] = layer[row, column, n]
                    continue
                for n in range(4):
                    own = _number(layer[row, column, n])
                    below: cython.int = _number(target[row, left + column, n])
                    target[row, left + column, n] = (255 * share * own + through * below + 32512) // 65025
