"""A slash that crosses out a drawing, found on rasters: a bar that is new, and around it nearly all that changes.

Only what is painted counts, so that the drawing may be cut into pieces or drawn a little differently beside the bar.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import axis_of, ring_edges
from shapeblend_cli.geometry.raster import winding_grid

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, Contour, FloatArray, IntArray

GRID = 144
"""Number of points along the side of the rasters."""

CURVE_POINTS = 8
"""Number of edges of a curved segment."""

MOST_AXES = 4
"""Maximum number of directions that are tried."""

SAME_AXIS = np.radians(2.0)
"""Maximum angle between edges of one direction, in radians."""

LEAST_EDGE = 0.06
"""Minimum length of edges along a slash, as a share of the raster's side."""

EDGES = 1.15
"""Minimum length of the edges along a slash and its gap, as a share of its length: an outline's corner has one edge."""

LEAST_SLASH = 0.6
"""Minimum length of a slash, as a share of the larger side of the drawing that it crosses out."""

LEAST_SLANT = np.radians(15.0)
"""Minimum angle of a slash with the horizontal and the vertical, in radians: bars along these belong to the drawing."""

THINNEST = 0.04
"""Minimum thickness of a slash, as a share of its length."""

THICKEST = 0.15
"""Maximum thickness of a slash, as a share of its length."""

COVERED = 0.85
"""Minimum share of a slash's length that is painted: what it crosses may cut it into pieces."""

OLD = 0.97
"""Maximum share of a slash's length that is painted in the other drawing."""

BESIDE_ROWS = 4
"""Number of points of the raster beside a slash where the drawing may leave it alone."""

REACH = 1.6
"""Maximum distance of what is cut away from the slash, in thicknesses: the gap on either side."""

LEAST_SIDE = 0.02
"""Minimum share of the drawing on each side of the slash and its gap."""

MOST_WRONG = 0.42
"""Maximum share of a slash's length along which the drawing touches it on both sides, plus what else is added and
removed. Of 180 icons crossed out the worst has 0.40; of 1,600 other pairs those that pass are better for it."""

CLEAN = 0.02
"""The same where nearly all of the drawing is on one side, as of some fans of wireless signs."""

LEAST_STAYING = 0.4
"""Minimum share of a drawing that is still painted when it is crossed out: a pencil crosses no bin out."""

STRAY_WEIGHT = 2.0
"""Weight of what else is added and removed, as a share of the drawing."""

SLIVER = 3
"""Width of the slivers that do not count as a change, in points of the raster: the drawing may be redrawn a little."""


def slash_axis(plain: Sequence[Contour], crossed: Sequence[Contour]) -> complex | None:
    """Return the direction of the slash that crosses out a drawing; None if that is not how the drawings differ."""
    chords = _slanted_chords(crossed)
    if not len(chords):
        return None
    edges, centre, side = _framed(plain, crossed)
    size = max(float(np.ptp(edges[0][0].real)), float(np.ptp(edges[0][0].imag)))
    for axis, along in _axes(chords[np.abs(chords) > LEAST_EDGE * side]):
        least, most = (length * GRID / side for length in (LEAST_SLASH * size, along / EDGES))
        if least > most:
            continue
        before, after = _rasters(edges, centre, side, axis)
        if _is_crossed_out(before, after, least, most):
            return axis
    return None


def paint_the_same(one: Sequence[Contour], other: Sequence[Contour]) -> bool:
    """Return whether outlines paint the same, but for slivers."""
    rasters = _rasters(*_framed(one, other), 1.0 + 0j)
    return not _opened(rasters[0] != rasters[1]).any()


def _framed(*drawings: Sequence[Contour]) -> tuple[list[tuple[ComplexArray, ComplexArray]], complex, float]:
    """Return the edges of drawings, and the centre and the side of a square that holds them however it is turned."""
    edges = [ring_edges([cubics.polyline(each.segments, CURVE_POINTS) for each in side]) for side in drawings]
    points = np.concatenate([starts for starts, _ in edges])
    corners = complex(points.real.min(), points.imag.min()), complex(points.real.max(), points.imag.max())
    centre = sum(corners) / 2.0
    return edges, centre, 2.05 * float(np.abs(points - centre).max())


def _rasters(
    edges: Sequence[tuple[ComplexArray, ComplexArray]], centre: complex, side: float, axis: complex
) -> list[BoolArray]:
    """Return which points of a grid are painted by each drawing; the rows run along an axis."""
    corner, back = -0.5 * side * (1 + 1j), axis.conjugate()
    return [
        winding_grid((starts - centre) * back, (ends - centre) * back, corner, side / GRID, GRID) != 0
        for starts, ends in edges
    ]


def _slanted_chords(contours: Sequence[Contour]) -> ComplexArray:
    """Return the straight edges of outlines that are slanting, from their starts to their ends."""
    parts = [each.segments[each.straight][:, [0, 3]] for each in contours]
    chords = np.concatenate([part[:, 1] - part[:, 0] for part in parts])
    slant = np.abs((_angles(chords) + np.pi / 4.0) % (np.pi / 2.0) - np.pi / 4.0)
    return chords[slant >= LEAST_SLANT]


def _angles(chords: ComplexArray) -> FloatArray:
    """Return the angles of edges, in [0, pi): either way along an edge is one."""
    return np.angle(chords) % np.pi


def _axes(chords: ComplexArray) -> list[tuple[complex, float]]:
    """Return the directions in which most edges run, with the length of these."""
    angles, sizes = _angles(chords), np.abs(chords)
    found: list[tuple[complex, float]] = []
    while len(angles) and len(found) < MOST_AXES:
        near = np.abs((angles[:, None] - angles + np.pi / 2.0) % np.pi - np.pi / 2.0) < SAME_AXIS
        best = int((near @ sizes).argmax())
        doubled = complex((sizes[near[best]] * np.exp(2j * angles[near[best]])).sum())
        axis = axis_of(doubled)
        found.append((axis, float(sizes[near[best]].sum())))
        angles, sizes = angles[~near[best]], sizes[~near[best]]
    return found


def _is_crossed_out(before: BoolArray, after: BoolArray, least: float, most: float) -> bool:
    """Return whether a raster is another one with a bar along its rows, and what is beside it cut away.

    `least` and `most` limit the length of the bar.
    """
    if (before & after).sum() < LEAST_STAYING * before.sum():
        return False
    is_bar, firsts, beyonds = _bars(before, after, least)
    is_bar &= beyonds - firsts <= most
    borders = np.flatnonzero(np.diff(np.concatenate([[False], is_bar, [False]]).astype(np.int8)))
    for top, bottom in borders.reshape(-1, 2).tolist():
        ends = np.stack([firsts[top:bottom], beyonds[top:bottom]])
        first, last = ends[:, (bottom - top) // 2].tolist()
        thickness = bottom - top
        if not THINNEST < thickness / (last - first) < THICKEST:
            continue
        if np.ptp(ends, axis=1).max() > 2 * thickness + SLIVER:
            continue
        rows = slice(max(top - BESIDE_ROWS, 0), bottom + BESIDE_ROWS)
        touched = after[rows, first:last].mean(axis=1).min()
        reach = int(REACH * thickness) + SLIVER
        slash, near = np.zeros_like(before), np.zeros_like(before)
        near[max(0, top - reach) : bottom + reach] = True
        slash[max(0, top - SLIVER) : bottom + SLIVER, max(0, first - reach) : last + reach] = True
        whole, added, removed = max(int(before.sum()), 1), _opened(after & ~before), _opened(before & ~after)
        stray = (added & ~slash).sum() + (removed & ~near).sum()
        left = before[: max(0, top - reach)].sum(), before[bottom + reach :].sum()
        wrong = touched + STRAY_WEIGHT * stray / whole
        if wrong < (MOST_WRONG if min(left) > LEAST_SIDE * whole else CLEAN):
            return True
    return False


def _bars(before: BoolArray, after: BoolArray, least: float) -> tuple[BoolArray, IntArray, IntArray]:
    """Return in which rows there is a bar that is painted after but not before, and its first point and beyond."""
    added = after & ~before
    rows, places = np.arange(GRID), np.arange(GRID)
    low, high = added.argmax(axis=1), GRID - 1 - added[:, ::-1].argmax(axis=1)
    # The nearest points that are not painted, on either side.
    firsts = np.maximum.accumulate(np.where(after, -1, places), axis=1)[rows, low] + 1
    beyonds = np.minimum.accumulate(np.where(after, GRID, places)[:, ::-1], axis=1)[:, ::-1][rows, high]
    painted = [
        np.concatenate([np.zeros((GRID, 1), int), each.cumsum(axis=1)], axis=1) for each in (after, before)
    ]
    shares = [
        (each[rows, beyonds] - each[rows, firsts]) / np.maximum(beyonds - firsts, 1) for each in painted
    ]
    is_bar = added.any(axis=1) & (beyonds - firsts >= least) & (shares[0] >= COVERED) & (shares[1] <= OLD)
    return is_bar, firsts, beyonds


def _opened(points: BoolArray) -> BoolArray:
    """Return points without those in slivers."""
    for axis in (0, 1):
        kept = points.copy()
        for k in range(1, SLIVER):
            kept &= np.roll(points, -k, axis=axis)
        points = kept.copy()
    for axis in (0, 1):
        grown = points.copy()
        for k in range(1, SLIVER):
            grown |= np.roll(points, k, axis=axis)
        points = grown
    return points
