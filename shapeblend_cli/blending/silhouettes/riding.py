"""Where the edges of gaps meet when they close, and how they move until then: they ride on the silhouette."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.blending.silhouettes.softening import SOFT, softened, softness
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import weighted_sums, winding_numbers
from shapeblend_cli.geometry.polyline import needed
from shapeblend_cli.interpolate.paths import segments_at

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.blending.silhouettes.ground import Parted, Rim
    from shapeblend_cli.model import ComplexArray, ContourBlend, FloatArray, IntArray, ShapeBlend

EARLY = 0.4
"""Time, from its end on, at which the gaps of the drawing that has less of them are closed: those of the other one are
open from then on, so that the silhouette is blank for a moment only, and not where it has least of both drawings."""

OVER = 0.15
"""Share of the way by which edges go beyond each other, so that no light is seen between them."""

LATE = 4
"""Power of the share of the time until then that is the share of the way of edges: narrow gaps look like cracks."""

FALL = 3
"""Power of the distance with which nodes of an outline count less for the shift of a point."""

BESIDE = 1.45
"""Maximum distance of a point from the middle of a ball that it is near, in radii: a corner of a square is."""

AHEAD = 0.3
"""Minimum cosine of the angle between the way into the ground and that to the middle of such a ball."""

LARGEST = 0.85
"""Minimum radius of such balls that count, in those of the largest one."""


class Edge(NamedTuple):
    """An edge of a gap in one of the drawings: a closed line around it, or around an island in it."""

    points: ComplexArray
    middles: ComplexArray  # where they meet those of other edges
    weights: FloatArray  # of the nodes of the outlines, for each point
    met: FloatArray  # the same for each middle
    here: int  # 0 in A, 1 in B
    until: float  # when it is closed, as time from its drawing on

    def at(self, shift: ComplexArray, t: float) -> ComplexArray:
        """Return the edge at time t, where the nodes are moved by a shift from their places in its drawing."""
        share = (1.0 - t if self.here else t) / self.until
        there = self.middles + weighted_sums(self.met, shift)
        if share >= 1.0:
            return np.full_like(there, there.mean())
        own = self.points + weighted_sums(self.weights, shift)
        return np.asarray(own + (1.0 + OVER) * share**LATE * (there - own))


class Riding(NamedTuple):
    """The motion of the shapes of a silhouette, and of edges of gaps in it, which come after these."""

    shapes: tuple[ShapeBlend, ...]
    edges: tuple[Edge, ...]

    @property
    def name(self) -> str:
        """The name of the motion of the largest shape."""
        return max(self.shapes, key=lambda shape: shape.size).motion_name

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        own = [segments for shape in self.shapes for segments in segments_at(shape, t)]
        outlines = contours[: len(own)]
        corners = np.concatenate([segments[:, 0] for segments in own])
        deviation = SOFT * softness(t) * float(max(np.ptp(corners.real), np.ptp(corners.imag)))
        own = [
            softened(segments, deviation) if each.is_matched else segments
            for segments, each in zip(own, outlines, strict=True)
        ]
        matched = [segments for segments, each in zip(own, outlines, strict=True) if each.is_matched]
        now = np.concatenate([segments[:, 0] for segments in matched])
        shifts = [now - there for there in nodes(outlines)]
        return own + [cubics.lines(edge.at(shifts[edge.here], t), closed=True) for edge in self.edges]


def nodes(outlines: Sequence[ContourBlend]) -> tuple[ComplexArray, ComplexArray]:
    """Return the nodes of those outlines that have a partner, in A and in B."""
    matched = [contour for contour in outlines if contour.is_matched]
    first = np.concatenate([contour.start.segments[:, 0] for contour in matched])
    return first, np.concatenate([contour.end.segments[:, 0] for contour in matched])


def closing_times(a: float, b: float) -> tuple[float, float]:
    """Return when gaps are closed whose edges have some lengths in A and in B, each as time from its drawing on."""
    return (EARLY, 1.0 - EARLY) if a < b else (1.0 - EARLY, EARLY)


def edge_of(
    rim: Rim,
    found: Parted,
    line: IntArray,
    outlines: Sequence[ContourBlend],
    here: int,
    until: float,
    most: float,
) -> Edge:
    """Return an edge of a gap that rides on outlines until a time, by points that stray from it by so much at most."""
    points, middles = rim.points[line], _middles(rim, found, line)
    keep = needed(points, most) | needed(middles, most) | np.isin(line, list(found.across))
    points, middles = points[keep], middles[keep]
    weights = [_weights(each, outlines, here) for each in (points, middles)]
    return Edge(points, middles, weights[0], weights[1], here, until)


def _middles(rim: Rim, found: Parted, line: IntArray) -> ComplexArray:
    """Return where points of an edge meet others: in the middles of balls, or halfway across where these lie outside.

    The ends of sides meet in the middles of mouths.
    """
    points, normals, radii = rim.points[line], rim.normals[line], rim.radii[line]
    centres = points + normals * np.minimum(radii, 1e6 * np.abs(points).max())
    around = np.array([winding_numbers(centres, rim.points[each]) for each in found.outlines])
    is_inside = around.sum(axis=0) != 0
    middles = 0.5 * (points + rim.points[rim.touching[line]])
    if is_inside.any():
        own = points[is_inside], normals[is_inside], centres[is_inside], radii[is_inside]
        middles[is_inside] = _main_middles(*own)
    for k, point in enumerate(line.tolist()):
        if point in found.across:
            middles[k] = 0.5 * (rim.points[point] + rim.points[found.across[point]])
    return np.asarray(middles)


def _main_middles(
    points: ComplexArray, normals: ComplexArray, centres: ComplexArray, radii: FloatArray
) -> ComplexArray:
    """Return for each point the middle of the largest balls that it is near: of corners those between the sides."""
    ways = centres - points[:, None]
    away = np.abs(ways)
    is_near = (away <= BESIDE * radii) & ((normals[:, None].conj() * ways).real >= AHEAD * away)
    np.fill_diagonal(is_near, val=True)
    near = np.where(is_near, radii, 0.0)
    weights = np.maximum(near / near.max(axis=1, keepdims=True) - LARGEST, 0.0)
    return np.asarray((weights @ centres) / weights.sum(axis=1))


def _weights(points: ComplexArray, outlines: Sequence[ContourBlend], here: int) -> FloatArray:
    """Return how much each node of the outlines counts for the shift of each point: the nearer ones far more."""
    spans = []
    for contour in outlines:
        if contour.is_matched:
            ring = (contour.start, contour.end)[here].segments[:, 0]
            edges = np.abs(np.roll(ring, -1) - ring)
            spans.append(edges + np.roll(edges, 1))
    length = np.concatenate(spans)
    whole = max(float(length.sum()), 1e-12)
    away = np.abs(points[:, None] - nodes(outlines)[here])
    found = (length + 1e-6 * whole) / np.maximum(away, 1e-5 * whole) ** FALL
    return np.asarray(found / found.sum(axis=1, keepdims=True))
