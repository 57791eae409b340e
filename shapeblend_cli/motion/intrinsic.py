"""Motion by lengths and angles: limbs swing and keep their lengths, where straight paths shorten them.

After T. W. Sederberg, P. Gao, G. Wang and H. Mu, "2-D Shape Blending: An Intrinsic Solution to the Vertex Path
Problem", Computer Graphics (Proceedings of SIGGRAPH 93), 1993, pages 15-18.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.closing import closing_lengths
from shapeblend_cli.motion.alignment import PointPairs, resting
from shapeblend_cli.motion.rigid import Rigid
from shapeblend_cli.motion.turning import FULL_TURN, directions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, ContourBlend, CubicPath, FloatArray, IntArray
    from shapeblend_cli.motion.alignment import Alignment

LEAST_CHANGE = 0.2
"""Minimum relative change of length in an edge's compliance, the paper's ``L_tol``."""

MOST_KNOWN = 1 << 16
"""Maximum number of control points of a motion that are kept, at all times together: a megabyte."""

POINT = 1e-9
"""Maximum length of an edge that counts as a point, as a share of the chain's length."""


class ControlPolygons(NamedTuple):
    """The control polygons of a contour at the start and the end, edge for edge.

    Of n edges m are more than a point at either end; the arrays of edges have m elements.
    """

    path: CubicPath
    control_points: IntArray  # (s, 4), indices of each segment's points
    points: tuple[ComplexArray, ComplexArray]  # (n + 1,) each; closed contours repeat the first
    moves: BoolArray  # (n,), true for the m edges
    start: FloatArray  # lengths L_A
    end: FloatArray  # lengths L_B
    direction: FloatArray  # at the start, in radians
    direction_change: FloatArray  # in radians
    share: FloatArray  # mean share of the edge in both lengths

    def changes_near(self, rotation: float) -> FloatArray:
        """Return the changes of direction, plus whole rounds that bring their mean nearest to a rotation."""
        mean = float((self.share * self.direction_change).sum())
        return self.direction_change - FULL_TURN * round((mean - rotation) / FULL_TURN)


class MovingPolygon(NamedTuple):
    """A control polygon that moves, with the similarity undone."""

    polygons: ControlPolygons
    end: FloatArray
    direction_change: FloatArray
    compliance: FloatArray  # (m,), readiness of a length to change to close the polygon; 1 on average
    weight: FloatArray  # (n + 1,), of each control point for the position; of sum 1
    positions: tuple[complex, complex]  # weighted means of the control points, at the start and the end

    def at(self, times: FloatArray) -> ComplexArray:
        """Return the control points at some times, (times, n + 1) complex, with the similarity undone."""
        t = times[:, None]
        moves = self.polygons.moves
        length = (1.0 - t) * self.polygons.start + t * self.end
        u = np.exp(1j * (self.polygons.direction + t * self.direction_change))
        if self.polygons.path.closed:
            length = np.array([closing_lengths(*one, self.compliance) for one in zip(length, u, strict=True)])
            u = u - (length * u).sum(axis=1, keepdims=True) / length.sum(axis=1, keepdims=True)
        points = np.zeros((len(times), len(moves) + 1), np.complex128)
        points[:, 1:][:, moves] = length * u
        points = points.cumsum(axis=1)
        position = (1.0 - t) * self.positions[0] + t * self.positions[1]
        return points + (position - (self.weight * points).sum(axis=1, keepdims=True))


@dataclass(frozen=True, eq=False)
class Intrinsic:
    """Motion in which lengths of edges and the angles between them change evenly; `intrinsic` makes it."""

    alignment: Alignment
    polygons: tuple[MovingPolygon | None, ...]  # of each contour; None for rigid motion
    _known: dict[float, list[ComplexArray]] = field(default_factory=dict, repr=False)  # segments by time

    @property
    def name(self) -> str:
        """The name for `--motion`."""
        return "intrinsic"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t, of the contours that this was made of."""
        if t not in self._known:
            self._find(contours, [t])
        return list(self._known[t])

    def expect(self, contours: Sequence[ContourBlend], times: Sequence[float]) -> None:
        """Find the control points at several times at once, for `segments`."""
        new = [t for t in times if t not in self._known]
        if new and len(new) * _points_of(contours) <= MOST_KNOWN:
            self._find(contours, new)

    def _find(self, contours: Sequence[ContourBlend], times: Sequence[float]) -> None:
        # The judge, the check for crossings and animations ask for the same times.
        if (len(self._known) + len(times)) * _points_of(contours) > MOST_KNOWN:
            self._known.clear()
        every = [self._moved(contours, k, times) for k in range(len(contours))]
        self._known.update((t, [moved[k] for moved in every]) for k, t in enumerate(times))

    def _moved(
        self, contours: Sequence[ContourBlend], number: int, times: Sequence[float]
    ) -> list[ComplexArray]:
        """Return the control points of a contour at some times."""
        contour, polygon = contours[number], self.polygons[number]
        if polygon is None:
            rigid = Rigid((self.alignment,))
            found = [rigid.segments([contour], t)[0] for t in times]
        else:
            straight = contour.start.straight
            points = polygon.at(np.array(times))
            moved = [self.alignment.apply(own, t) for own, t in zip(points, times, strict=True)]
            every = np.array(moved)[:, polygon.polygons.control_points]
            lines = every[:, straight]
            chord = lines[:, :, 3] - lines[:, :, 0]
            lines[:, :, 1], lines[:, :, 2] = (
                lines[:, :, 0] + chord / 3.0,
                lines[:, :, 0] + chord * (2.0 / 3.0),
            )
            every[:, straight] = lines
            found = list(every)
        for segments in found:
            segments.setflags(write=False)
        return found


def _points_of(contours: Sequence[ContourBlend]) -> int:
    """Return the number of control points of contours."""
    return sum(contour.start.segments.size for contour in contours)


def intrinsic(contours: Sequence[ContourBlend], alignment: Alignment) -> Intrinsic:
    """Return the intrinsic motion of contours that are painted together, given their best similarity.

    Notes
    -----
    The paper describes a polygon as a turtle would walk it: lengths of edges ``L_i``, turns ``θ_i`` at the vertices,
    the first direction ``α_0``. In between,

        θ_i = (1 - t) θ_Ai + t θ_Bi,    α_i = α_(i-1) + θ_i,    L_i = (1 - t) L_Ai + t L_Bi + S_i,

    with the least ``S_i`` that close the polygon, ``Σ L_i (cos α_i, sin α_i) = 0``: of all, those which minimise
    ``Σ S_i² / w_i²``, where ``w_i = max(|L_Ai - L_Bi|, L_tol)`` so that edges alike in both stay as they are. With a
    Lagrange multiplier ``λ`` for each coordinate that is ``S_i = w_i² (λ_1 cos α_i + λ_2 sin α_i)`` and two linear
    equations for ``λ``.

    Departures from the paper:

    * The control polygons move, with an edge for a straight segment and three for a curve. Where the outlines are
      smooth at a joint in both drawings, the turn there is zero at both ends, and so always.
    * The similarity is first taken out of B, and then added again as in `Rigid`. All in-betweens of a shape and the
      same shape rotated, scaled and moved are that shape, and several contours stay together.
    * ``w_i²`` is ``σ_i L_i`` with ``σ_i = ((L_Ai - L_Bi) / (L_Ai + L_Bi))² + LEAST_CHANGE²``. An edge cut into two then
      gives way as much as before, while the paper's, twice as stiff, would depend on where curves happen to be cut.
    * Lengths change by a factor, ``L_i exp(σ_i (λ_1 cos α_i + λ_2 sin α_i))``, which differs from the paper's in the
      second order and never makes a length negative, which would reverse its edge. See `closing_lengths`.
    * Edges that are a point in one of the drawings, cusps and sums of turns: see `turning.directions`.
    * B's directions are A's plus a change, in which a whole number of rounds is free. The mean change, weighted by
      length, is the nearest possible to the similarity's rotation.
    * The paper puts the first vertex on a straight path. Here a weighted mean of the control points is where rigid
      motion would put it. Edges weigh by their lengths, and by how much their ends rest once the similarity is undone;
      so a limb that swings does not push the body away.

    Contours that are a point at one end move rigidly. So do contours with different turning numbers in both drawings,
    such as an outline that becomes a figure of eight: no even turning leads from one to the other.
    """
    polygons = [_matched_polygons(contour) for contour in contours]
    return Intrinsic(alignment, tuple(polygon and _moving(polygon, alignment) for polygon in polygons))


def _matched_polygons(contour: ContourBlend) -> ControlPolygons | None:
    """Return the control polygons of a contour, or None if there are no directions to move by."""
    if contour.grows or contour.shrinks:
        return None
    straight, closed = contour.start.straight, contour.start.closed
    counts = np.where(straight, 1, 3)
    segment = np.repeat(np.arange(len(straight)), counts)
    first = np.cumsum(counts) - counts
    number = np.arange(len(segment)) - first[segment]
    control_points = first[:, None] + np.where(straight[:, None], [0, 0, 1, 1], [0, 1, 2, 3])
    a, b = (
        np.append(path.segments[segment, number], path.segments[0, 0] if closed else path.segments[-1, 3])
        for path in (contour.start, contour.end)
    )
    if closed:
        control_points[-1, 3] = 0  # to the bit the same point
    edges_a, edges_b = np.diff(a), np.diff(b)
    for edges in (edges_a, edges_b):
        edges[np.abs(edges) <= POINT * np.abs(edges).sum()] = 0.0
    moves = (edges_a != 0.0) | (edges_b != 0.0)
    edges_a, edges_b = edges_a[moves], edges_b[moves]
    both = directions(edges_a, edges_b, segment[moves], closed)
    if both is None:
        return None
    start, end = np.abs(edges_a), np.abs(edges_b)
    share = start / start.sum() + end / end.sum()
    share /= share.sum()
    change = both[1] - both[0]
    return ControlPolygons(contour.start, control_points, (a, b), moves, start, end, both[0], change, share)


def _moving(polygon: ControlPolygons, alignment: Alignment) -> MovingPolygon:
    """Return the movement of a control polygon once a similarity is undone."""
    start, end = polygon.start, polygon.end / alignment.scale
    change = polygon.changes_near(alignment.rotation) - alignment.rotation
    compliance = ((start - end) / (start + end)) ** 2 + LEAST_CHANGE**2
    compliance /= (polygon.share * compliance).sum()
    of_edge = np.zeros(len(polygon.moves))
    of_edge[polygon.moves] = polygon.share
    weight = np.append(of_edge, 0.0) + np.append(0.0, of_edge)
    weight *= resting(PointPairs(*polygon.points, weight / weight.sum()), alignment)
    weight /= weight.sum()
    a, b = polygon.points[0] - alignment.centre_a, alignment.undo(polygon.points[1])
    positions = complex((weight * a).sum()), complex((weight * b).sum())
    return MovingPolygon(polygon, end, change, compliance, weight, positions)
