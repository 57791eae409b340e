"""What is between the parts of a drawing of one colour: a silhouette, and the gaps in it.

A gap is where the largest ball in the ground that touches the outline is small. Its sides are taken out of the
outlines, and what is left of these is joined across the mouths of gaps.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.pairing.costs import assign
from shapeblend_cli.pens.recovery.balls import touching_points

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray

PIECES = 8
"""Minimum number of points on a curved segment."""

BENT = 1e-3
"""Minimum distance of a curved segment from its chord, in lengths of the segment."""

MOST_POINTS = 1500
"""Maximum number of points on all outlines, about."""

DEEP = 2.5
"""Minimum length of the outline of a notch that is a gap, in widths of its mouth."""

ACROSS = 3.0
"""Maximum width of a mouth, in radii of the widest gap."""

GRAZING = 0.15
"""Minimum sine of the angle between an outline and the chord to a point that bounds a ball: segments meet at kinks."""

ROUNDS = 20
"""Maximum number of attempts to find gaps that fit together."""


class Rim(NamedTuple):
    """Points on the outlines of a drawing, with the largest balls in the ground that touch these there."""

    points: ComplexArray
    normals: ComplexArray  # into the ground
    radii: FloatArray
    touching: IntArray  # the point on the other side of each ball
    after: IntArray  # the next point of the outline
    contour: IntArray  # index of each point's outline
    segment: IntArray  # of the outline
    parameter: FloatArray  # on the segment

    def largest(self, k: int) -> float:
        """Return the largest radius at a contour."""
        return float(self.radii[self.contour == k].max())


class Parted(NamedTuple):
    """A drawing as silhouette and gaps, whose closed lines are given by points of the rim."""

    outlines: list[IntArray]
    gaps: list[IntArray]
    across: dict[int, int]  # the point on the other side of a mouth


class _Sides(NamedTuple):
    """The sides of gaps: first and last points, and their lengths between these."""

    first: IntArray
    last: IntArray
    lengths: FloatArray


NOTHING = Parted([], [], {})


def rim_of(contours: Sequence[PlacedContour], least: float) -> Rim:
    """Return points along outlines, at least so far from each other where these are straight."""
    lengths = [cubics.lengths(contour.contour.segments) for contour in contours]
    step = max(sum(float(each.sum()) for each in lengths) / MOST_POINTS, least)
    rings = [_ring(contour, each, step) for contour, each in zip(contours, lengths, strict=True)]
    sizes = [len(ring[0]) for ring in rings]
    begins = (np.cumsum(sizes) - sizes).tolist()
    after = [np.roll(np.arange(n), -1) + begin for n, begin in zip(sizes, begins, strict=True)]
    points = np.concatenate([ring[0] for ring in rings])
    main = max(contours, key=lambda contour: contour.area)
    way = -1j if signed_area(main.polygon.vertices) > 0.0 else 1j
    normals = way * np.concatenate([_tangents(ring[0]) for ring in rings])
    return Rim(
        points,
        normals,
        *_balls(points, normals),
        np.concatenate(after),
        np.repeat(np.arange(len(rings)), sizes),
        np.concatenate([ring[1] for ring in rings]),
        np.concatenate([ring[2] for ring in rings]),
    )


def _ring(
    contour: PlacedContour, lengths: FloatArray, step: float
) -> tuple[ComplexArray, IntArray, FloatArray]:
    """Return points along a contour, with their segments and parameters."""
    segments = contour.contour.segments
    is_bent = cubics.chord_deviation(segments) > BENT * np.maximum(lengths, 1e-12)
    counts = np.maximum(np.where(is_bent, PIECES, 1), np.ceil(lengths / step)).astype(np.intp)
    counts[lengths < 1e-6 * lengths.sum()] = 0
    segment = np.repeat(np.arange(len(segments)), counts)
    firsts = np.cumsum(counts) - counts
    parameter = (np.arange(len(segment)) - firsts[segment]) / counts[segment]
    return cubics.evaluate(segments[segment], parameter), segment, parameter


def _tangents(ring: ComplexArray) -> ComplexArray:
    """Return unit vectors along a closed line."""
    edges = np.roll(ring, -1) - ring
    edges /= np.maximum(np.abs(edges), 1e-300)
    both = edges + np.roll(edges, 1)
    both = np.where(np.abs(both) > 1e-6, both, edges)
    return np.asarray(both / np.maximum(np.abs(both), 1e-300))


def _balls(points: ComplexArray, normals: ComplexArray) -> tuple[FloatArray, IntArray]:
    """Return the radius of the largest ball on the side of the normals at each point, and the point that bounds it.

    The radius is infinite where no point does.
    """
    touching = touching_points(points, normals, GRAZING)
    is_bounded = touching >= 0
    touching = np.maximum(touching, 0)
    ways = points[touching] - points
    inward = (normals.conj() * ways).real
    diameters = (ways.real**2 + ways.imag**2) / np.where(is_bounded, inward, 1.0)
    return 0.5 * np.where(is_bounded, diameters, np.inf), touching


def parted(rim: Rim, width: float, closed: BoolArray, kept: BoolArray, void: float) -> Parted:
    """Return a drawing as silhouette and gaps.

    Parameters
    ----------
    rim : Rim
    width : float
        The maximum radius of a gap.
    closed, kept : (n,) bool
        Which contours are the edges of gaps whatever their width, and which are none.
    void : float
        The maximum radius of what gaps enclose that is one with them.
    """
    is_gap = ((rim.radii < width) | closed[rim.contour]) & ~kept[rim.contour]
    for _ in range(ROUNDS):
        sides = _sides(rim, is_gap)
        across, lost = _mouths(rim, sides, width)
        if lost:
            for k in lost:
                is_gap[_walk(rim, int(sides.first[k]), int(sides.last[k]))] = False
            continue
        outlines = _lines(rim, is_gap, across, of_gaps=False)
        areas = [signed_area(rim.points[line]) for line in outlines]
        if not areas:
            return NOTHING
        largest = max(areas, key=abs)
        pockets = [
            line
            for line, area in zip(outlines, areas, strict=True)
            if area * largest < 0.0 and not kept[rim.contour[line]].any() and rim.radii[line].max() < void
        ]
        if not pockets:
            return Parted(outlines, _lines(rim, is_gap, across, of_gaps=True), across)
        for line in pockets:
            is_gap[line] = True
    return NOTHING


def _walk(rim: Rim, first: int, last: int) -> list[int]:
    """Return the points of an outline from one to another."""
    found = [first]
    while found[-1] != last:
        found.append(int(rim.after[found[-1]]))
    return found


def _sides(rim: Rim, is_gap: BoolArray) -> _Sides:
    """Return the stretches of outlines that are sides of gaps and have ends."""
    is_first = np.zeros(len(is_gap), bool)
    is_first[rim.after] = ~is_gap
    first = np.flatnonzero(is_first & is_gap)
    last, lengths = [], []
    for start in first.tolist():
        k, length = start, 0.0
        while is_gap[rim.after[k]]:
            length += abs(complex(rim.points[rim.after[k]] - rim.points[k]))
            k = int(rim.after[k])
        last.append(k)
        lengths.append(length)
    return _Sides(first, np.array(last, np.intp), np.array(lengths))


def _mouths(rim: Rim, sides: _Sides, width: float) -> tuple[dict[int, int], set[int]]:
    """Return the ends of sides that lie across mouths from each other, and the sides that are in no gap."""
    if not len(sides.first):
        return {}, set()
    p, q = rim.points[sides.first], rim.points[sides.last]
    wide = np.abs(p[:, None] - q)
    beside = np.abs(rim.points[rim.touching[sides.first]][:, None] - q)
    costs = wide + beside + np.abs(rim.points[rim.touching[sides.last]] - p[:, None])
    across: dict[int, int] = {}
    lost = set(np.flatnonzero(sides.first == sides.last).tolist())
    for i, j in assign(costs):
        if wide[i, j] > ACROSS * width:
            lost |= {i, j}
        elif i == j and sides.lengths[i] < DEEP * wide[i, j]:
            lost.add(i)
        across[int(sides.first[i])] = int(sides.last[j])
        across[int(sides.last[j])] = int(sides.first[i])
    return across, lost


def _lines(rim: Rim, is_gap: BoolArray, across: dict[int, int], *, of_gaps: bool) -> list[IntArray]:
    """Return the closed lines along sides of gaps, or along the rest of the outlines, and across mouths."""
    found = []
    left = dict.fromkeys(np.flatnonzero(is_gap == of_gaps).tolist())
    while left:
        first = next(iter(left))
        line, k = [], first
        while k in left:
            del left[k]
            line.append(k)
            following = int(rim.after[k])
            if of_gaps and not is_gap[following]:
                following = across[k]
            elif not of_gaps and is_gap[following]:
                line += [following, across[following]]
                following = int(rim.after[across[following]])
            k = following
        found.append(np.array(line, np.intp))
    return found


def outline(rim: Rim, contours: Sequence[PlacedContour], line: IntArray) -> tuple[ComplexArray, BoolArray]:
    """Return a line along outlines and across mouths as segments, and which of these are straight."""
    pieces: list[list[float]] = []  # contour, segment, and the parameters between which it is followed
    found: list[ComplexArray] = []
    straight: list[bool] = []

    def follow() -> None:
        for k, j, low, high in pieces:
            whole = contours[int(k)].contour
            part = cubics.pieces(whole.segments[int(j)][None], np.array([low]), np.array([high]))
            found.append(part[0])
            straight.append(bool(whole.straight[int(j)]))
        pieces.clear()

    for p, q in zip(line.tolist(), np.roll(line, -1).tolist(), strict=True):
        if q != rim.after[p]:
            follow()
            found.append(cubics.line(complex(rim.points[p]), complex(rim.points[q])))
            straight.append(True)
            continue
        k, j, low = int(rim.contour[p]), int(rim.segment[p]), float(rim.parameter[p])
        is_within = rim.segment[q] == j and rim.parameter[q] > low
        high = float(rim.parameter[q]) if is_within else 1.0
        if pieces and pieces[-1][:2] == [k, j] and pieces[-1][3] == low:
            pieces[-1][3] = high
        else:
            pieces.append([k, j, low, high])
    follow()
    segments = np.array(found)
    segments[:, 3] = np.roll(segments[:, 0], -1)
    return segments, np.array(straight)
