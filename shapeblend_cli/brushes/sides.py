"""Both sides of the strokes of a region, and their caps.

Wherever a side of a stroke is on the outline of its region, and around free ends, a brush has the outline itself. Where
strokes meet or cross, its sides are where they would be without the others. All lengths are in units.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polyline import cumulative_lengths
from shapeblend_cli.pens.line import at

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.brushes.areas import Hits, Region
    from shapeblend_cli.brushes.strokes import Stroke
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray

WIDENS = 1.7
"""Maximum distance of the outline from a centre line for it to be the side of the stroke, in radii of the stroke."""

NEAR = 0.05
"""Additional distance for thin strokes, in units."""

EVEN = 1.8
"""Maximum ratio of the distances of both sides where these give the radius of a stroke."""

ROUND = 1.4
"""Maximum mean distance of both sides there, in radii of the largest ball."""

BESIDE = 0.7
"""Length of a centre line beside another stroke that this changes, in radii."""

TRIM = 0.7
"""Length by which the centre line of a stroke ends before a free end's, in radii: there it bends to a corner."""

MOST_TRIMMED = 0.3
"""Maximum length of that, as a share of the stroke."""

ROUNDING = 1e-9
"""Maximum rounding error of a width, as a share of it."""

LONGEST_CAP = 15.0
"""Maximum length of a cap, in radii."""

CAP_POINTS = 7
"""Number of points of a round cap."""

PIXEL = 0.12
"""Size of the pixels of the pictures in which brushes are compared with their region, in units."""


class Brush(NamedTuple):
    """A stroke with its outline.

    Attributes
    ----------
    contour : int
        The number of the exterior of its region.
    points : (k,) complex
        Its centre line; of a closed one the last point is the first one again.
    closed : bool
    is_free : (bool, bool)
        Whether its beginning and its end are in no other stroke.
    right, left : (k,) complex
        Its sides beside these points, as one looks along it where the region is on the left of its outline.
    plain : ((k,) complex, (k,) complex)
        The right and the left side, without what is added where strokes meet.
    caps : ((m,) complex, (n,) complex)
        The outline between its sides at the beginning, from left to right, and at the end, from right to left.
    width : float
    """

    contour: int
    points: ComplexArray
    closed: bool
    is_free: tuple[bool, bool]
    right: ComplexArray
    left: ComplexArray
    plain: tuple[ComplexArray, ComplexArray]
    caps: tuple[ComplexArray, ComplexArray]
    width: float

    @property
    def polygon(self) -> ComplexArray:
        """Its outline."""
        return np.concatenate([self.right, self.caps[1], self.left[::-1], self.caps[0]])


def brushes_of(region: Region, strokes: Sequence[Stroke]) -> list[Brush]:
    """Return the strokes of a region with their outlines: trimmed at free ends, or not, whichever is more like it."""
    if not strokes:
        return []
    tries = []
    # Where no end is free, there is nothing to trim.
    for trims in (True, False) if any(any(stroke.is_free) for stroke in strokes) else (False,):
        found = [_brush(region, stroke, trims=trims) for stroke in strokes]
        tries.append((region.unlike([brush.polygon for brush in found], PIXEL), found))
    return min(tries, key=lambda one: one[0])[1]


def least_width(region: Region, strokes: Sequence[Stroke]) -> float:
    """Return a width that the widest brush of strokes is sure to have, before their outlines are known.

    Where an end is free, the centre line may yet be trimmed, and is divided anew.
    """
    found = 0.0
    for stroke in strokes:
        away = region.distances(stroke.points)
        if any(stroke.is_free):
            along = cumulative_lengths(stroke.points)
            whole = float(along[-1])
            stays = np.abs(along - 0.5 * whole) <= (0.5 - MOST_TRIMMED) * whole
            away = away[stays] - 0.5 * whole / max(len(along) - 1, 1)
        found = max(found, 2.0 * (1.0 - ROUNDING) * float(away.max(initial=0.0)))
    return found


def tangents(points: ComplexArray, *, closed: bool = False) -> ComplexArray:
    """Return the directions of a polyline at its vertices; where vertices are one, that of one before."""
    if closed:
        points = np.concatenate([points[-2:-1], points, points[1:2]])
        ways = points[2:] - points[:-2]
    else:
        ways = np.concatenate(
            [points[1:2] - points[:1], points[2:] - points[:-2], points[-1:] - points[-2:-1]]
        )
    sizes = np.abs(ways)
    known = sizes > 1e-9
    if not known.any():
        return np.ones(len(ways), complex)
    last = np.maximum.accumulate(np.where(known, np.arange(len(ways)), -1))
    last = np.where(last < 0, int(known.argmax()), last)
    return np.asarray(ways[last] / sizes[last])


class _Rays(NamedTuple):
    """What is to the right and to the left of the points of a centre line."""

    points: ComplexArray
    ways: ComplexArray  # the directions of the line
    hits: tuple[Hits, Hits]
    near: FloatArray  # the distance of the outline
    radius: FloatArray  # of the stroke, also where it meets others
    is_even: BoolArray  # where both sides gave it
    is_side: tuple[BoolArray, BoolArray]  # where the outline is its side

    @classmethod
    def of(cls, region: Region, points: ComplexArray, *, closed: bool) -> _Rays:
        """Look to both sides of a line."""
        ways = tangents(points, closed=closed)
        hits = region.hits(points, -1j * ways), region.hits(points, 1j * ways)
        near = region.distances(points)
        less, more = (pick(hits[0].ahead, hits[1].ahead) for pick in (np.minimum, np.maximum))
        is_even = (more < EVEN * less + 2.0 * NEAR) & (less + more < 2.0 * (ROUND * near + 2.0 * NEAR))
        radius = _filled(0.5 * (less + more), is_even) if is_even.any() else near
        is_side = [each.ahead < WIDENS * radius + NEAR for each in hits]
        return cls(points, ways, hits, near, radius, is_even, (is_side[0], is_side[1]))

    @property
    def is_both(self) -> BoolArray:
        """Where the outline is on both sides."""
        return self.is_side[0] & self.is_side[1]


def _filled(values: FloatArray, known: BoolArray) -> FloatArray:
    """Return values, those that are not known between their neighbours."""
    every = np.arange(len(values))
    return np.interp(every, every[known], values[known])


def _brush(region: Region, stroke: Stroke, *, trims: bool) -> Brush:
    """Return a stroke with its outline."""
    rays = _Rays.of(region, stroke.points, closed=stroke.closed)
    if trims and any(stroke.is_free):
        cuts = [_cut(rays, end) if stroke.is_free[end] else 0.0 for end in (0, 1)]
        whole = float(cumulative_lengths(stroke.points)[-1])
        shorter = at(stroke.points, np.linspace(cuts[0], whole - cuts[1], len(stroke.points)))
        rays = _Rays.of(region, shorter, closed=False)
    sides = [_side(rays, k) for k in (0, 1)]
    caps = []
    for end, z in ((0, 0), (1, -1)):
        cap = _cap(region, rays, end) if stroke.is_free[end] else None
        if not stroke.closed and not stroke.is_free[end]:  # its end is hidden in the other stroke
            radius = min(rays.radius[z], rays.near[z])
            for k, way in ((0, -1j), (1, 1j)):
                sides[k][z] = rays.points[z] + radius * way * rays.ways[z]
        if cap is None:
            right, left = sides[0][z], sides[1][z]
            turn = np.exp(1j * np.pi * np.arange(1, CAP_POINTS + 1) / (CAP_POINTS + 1))
            cap = 0.5 * (right + left) + 0.5 * (right - left if end else left - right) * turn
        caps.append(np.empty(0, complex) if stroke.closed else cap)
    return Brush(
        region.contour,
        rays.points,
        stroke.closed,
        stroke.is_free,
        sides[0],
        sides[1],
        _plain(rays, sides, stroke),
        (caps[0], caps[1]),
        float(2.0 * rays.radius.mean()),
    )


def _cut(rays: _Rays, end: int) -> float:
    """Return by how much a centre line ends before a free end, so that the outline is on both sides there."""
    order = slice(None, None, -1 if end else 1)
    steps = np.abs(np.diff(rays.points))[order]
    away = np.concatenate([[0.0], np.cumsum(steps)])
    most = min(3.0 * float(rays.radius.mean()), MOST_TRIMMED * float(away[-1]))
    fits = rays.is_both[order] & (away >= TRIM * rays.near[order][0]) & (away < most)
    return float(away[int(fits.argmax())]) if fits.any() else 0.0


def _side(rays: _Rays, side: int) -> ComplexArray:
    """Return one side of a stroke."""
    ahead, is_side = rays.hits[side].ahead, rays.is_side[side]
    between = _filled(ahead, is_side) if is_side.any() else rays.radius
    room = 1.1 * np.where(rays.is_even, rays.radius, np.minimum(rays.radius, rays.near))
    away = np.where(is_side, ahead, np.minimum(between, room))
    return np.asarray(rays.points + away * (1j if side else -1j) * rays.ways)


def _cap(region: Region, rays: _Rays, end: int) -> ComplexArray | None:
    """Return the outline around a free end; None if it is not the stroke's."""
    z = -1 if end else 0
    if not rays.is_both[z]:
        return None
    right, left = ((int(each.edge[z]), float(each.share[z])) for each in rays.hits)
    most = LONGEST_CAP * float(rays.radius[z]) + 0.5
    return region.between(right, left, most) if end else region.between(left, right, most)


def _plain(rays: _Rays, sides: Sequence[ComplexArray], stroke: Stroke) -> tuple[ComplexArray, ComplexArray]:
    """Return both sides without what is added where strokes meet."""
    count = len(rays.points)
    is_odd = ~rays.is_both
    step = float(cumulative_lengths(rays.points)[-1]) / (count - 1)
    is_changed = is_odd.copy()
    for k in np.flatnonzero(is_odd).tolist():
        reach = int(np.ceil(BESIDE * rays.radius[k] / max(step, 1e-9)))
        is_changed[max(0, k - reach) : k + reach + 1] = True
    if is_changed.all():
        return sides[0], sides[1]
    found = []
    for side, way in zip(sides, (-1j, 1j), strict=True):
        away = ((side - rays.points) / (way * rays.ways)).real
        found.append(np.where(is_changed, rays.points + way * rays.ways * _filled(away, ~is_changed), side))
    return found[0], found[1]
