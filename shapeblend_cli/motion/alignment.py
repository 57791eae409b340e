"""The best similarity between matched outlines."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.grouping import grouped, overlaps
from shapeblend_cli.model import control_box

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, FloatArray, ShapeBlend


REWEIGHTINGS = 20
"""Maximum number of times that points are weighted anew."""

SETTLED = 1e-3
"""Minimum gain of a reweighting to be followed by another, as a share of what still moves."""

NEAR = 0.02
"""Distance by which a point moves that counts as half at rest, as a share of the size."""

IN_PLACE = 0.7
"""Maximum movement that a similarity leaves, as a share of the movement without it; else there is none."""


SUITED = np.log(2.0)
"""Maximum additional movement that a common similarity leaves, compared with a shape's own. Points that rest under the
latter are then less than `NEAR` away."""

HALF_TURN = math.radians(179.0)
"""Minimum angle of a half turn, in radians: either direction is about as short, and rounding would choose."""

PIVOT_REACH = 1.75
"""Maximum distance of a pivot from the middle of a shape, in root mean square sizes; the end of a bar is at 1.73."""


class Alignment(NamedTuple):
    """The similarity ``a -> scale * exp(1j * rotation) * (a - centre_a) + centre_b``, in parts that move evenly.

    The rotation is in radians, positive from x towards y.
    """

    centre_a: complex
    centre_b: complex
    scale: float
    rotation: float

    @property
    def is_half_turn(self) -> bool:
        """Whether it may as well go the other way round."""
        return abs(self.rotation) > HALF_TURN

    def other_way_round(self) -> Alignment:
        """Return the same similarity, rotated the other way."""
        return self._replace(rotation=self.rotation - math.copysign(2.0 * math.pi, self.rotation))

    def undo(self, z: ComplexArray) -> ComplexArray:
        """Map points of B back over A's, with A's centre at the origin."""
        return (z - self.centre_b) * cmath.rect(1.0 / self.scale, -self.rotation)

    def apply(self, z: ComplexArray, t: float) -> ComplexArray:
        """Map points around the origin to where they are at time t.

        The angle and the scale change evenly, and the centre moves on a straight line.
        """
        centre = (1.0 - t) * self.centre_a + t * self.centre_b
        return z * cmath.rect(1.0 - t + t * self.scale, self.rotation * t) + centre


class PointPairs(NamedTuple):
    """Points of outlines that correspond, and weights of sum 1: how much of the outlines each stands for; (k,) each."""

    a: ComplexArray
    b: ComplexArray
    weight: FloatArray


def point_pairs(contours: Sequence[ContourBlend]) -> PointPairs:
    """Return the dots of matched contours, weighted by the length of both outlines around each."""
    pairs = []
    for contour in contours:
        if contour.is_matched:
            a, b = contour.dot_points()
            closed = contour.correspondence.closed
            pairs.append((a, b, _adjacent_length(a, closed) + _adjacent_length(b, closed)))
    a, b, weight = (np.concatenate(side) for side in zip(*pairs, strict=True))
    return PointPairs(a, b, weight / weight.sum())


def _adjacent_length(z: ComplexArray, closed: bool) -> FloatArray:
    """Return the length of the edges before and after each point."""
    edges = np.abs(np.diff(z, append=z[:1] if closed else z[-1:]))
    before = np.roll(edges, 1)
    if not closed:
        before[0] = 0.0
    return edges + before


def align(points: PointPairs) -> Alignment:
    """Return the similarity under which most of the outlines' length stays where it is.

    That is the one of the least mean logarithm of ``1 + (distance / NEAR)²``: a limb that swings hardly counts by how
    far it goes. It is found by least squares that are weighted anew again and again, once from those of even weights
    and once from what rests in its place. Distances are in units of the geometric mean of both sizes, so that it makes
    no difference which drawing comes first. If it leaves not much less than no similarity at all, there is none. What
    turns by half a round does so clockwise.
    """
    everywhere = _least_squares(points)
    middle = 0.5 * (everywhere.centre_a + everywhere.centre_b)
    in_place = Alignment(middle, middle, 1.0, 0.0)
    found = [_reweighted(points, start) for start in (in_place, everywhere)]
    alignment, least = min(found, key=lambda one: one[1])
    if IN_PLACE * _moving_length(points, in_place) <= least:
        return in_place
    if alignment.is_half_turn and alignment.rotation < 0.0:
        alignment = alignment.other_way_round()
    return _pivoted(points, alignment)


def _pivoted(points: PointPairs, alignment: Alignment) -> Alignment:
    """Return a similarity as a rotation about the point that it leaves where it is, if that is near the outlines.

    So the hand of a clock turns about its end, and what is far away goes straight.
    """
    factor = cmath.rect(alignment.scale, alignment.rotation)
    if abs(factor - 1.0) < 1e-9:
        return alignment
    pivot = (alignment.centre_b - factor * alignment.centre_a) / (1.0 - factor)
    a, b, weight = points
    mean_a, mean_b = complex(weight @ a), complex(weight @ b)
    if abs(pivot - mean_a) * abs(pivot - mean_b) > PIVOT_REACH**2 * _unit(points):
        return alignment
    return alignment._replace(centre_a=pivot, centre_b=pivot)


def _reweighted(points: PointPairs, alignment: Alignment) -> tuple[Alignment, float]:
    """Return the similarity near another one under which most stays, and what it leaves moving."""
    left, unit = np.inf, _unit(points)
    for _ in range(REWEIGHTINGS):
        off = _off(points, alignment, unit)
        before, left = left, float(points.weight @ np.log(off))
        if before - left <= SETTLED * left:
            break
        alignment = _least_squares(points._replace(weight=points.weight / off))
    return alignment, left


def resting(points: PointPairs, alignment: Alignment) -> FloatArray:
    """Return how much each point stays where it is once a similarity is undone, (k,) float: 1 if it does."""
    return 1.0 / _off(points, alignment, _unit(points))


def _moving_length(points: PointPairs, alignment: Alignment) -> float:
    """Return the mean logarithm of `align`."""
    return float(points.weight @ np.log(_off(points, alignment, _unit(points))))


def _unit(points: PointPairs) -> float:
    """Return the product of both sizes."""
    a, b, weight = points
    return _size(a - weight @ a, weight) * _size(b - weight @ b, weight)


def _off(points: PointPairs, alignment: Alignment, unit: float) -> FloatArray:
    """Return ``1 + (distance / NEAR)²`` of each point, (k,) float."""
    left = alignment.undo(points.b) - (points.a - alignment.centre_a)
    return 1.0 + (left.real**2 + left.imag**2) * (alignment.scale / (unit * NEAR**2) if unit > 0.0 else 0.0)


def _least_squares(points: PointPairs) -> Alignment:
    """Return the similarity that takes A's points nearest to B's by weighted least squares, but for its scale.

    That is the ratio of both sizes.
    """
    a, b, weight = points
    weight = weight / weight.sum()
    centre_a, centre_b = complex(weight @ a), complex(weight @ b)
    a, b = a - centre_a, b - centre_b
    common = complex(weight @ (a.conj() * b))
    size_a, size_b = _size(a, weight), _size(b, weight)
    rotation = cmath.phase(common) if abs(common) > 1e-12 * size_a * size_b else 0.0
    scale = size_b / size_a if size_a > 0.0 and size_b > 0.0 else 1.0
    return Alignment(centre_a, centre_b, scale, rotation)


def shared_alignments(shapes: Sequence[ShapeBlend]) -> list[Alignment | None]:
    """Return for each shape the similarity that its motion separates; None if it has no contour with a partner.

    Shapes that touch or lie in each other at both ends have one similarity, so that eyes do not drift against the head;
    and all have that of the whole drawing which it suits about as well as their own.
    """
    found: list[Alignment | None] = [None] * len(shapes)
    groups = _together(shapes)
    if not groups:
        return found
    points = [point_pairs([contour for k in group for contour in shapes[k].contours]) for group in groups]
    common = align(point_pairs([contour for shape in shapes for contour in shape.contours]))
    for group, pairs in zip(groups, points, strict=True):
        own = align(pairs) if len(groups) > 1 else common
        for k in group:
            found[k] = common if _suits(pairs, common, own) else own
    return found


def _suits(points: PointPairs, common: Alignment, own: Alignment) -> bool:
    """Return whether a similarity leaves hardly more than another one."""
    return _moving_length(points, common) <= _moving_length(points, own) + SUITED


def _together(shapes: Sequence[ShapeBlend]) -> list[list[int]]:
    """Return groups of shapes with partners, by number, whose boxes overlap at both ends."""
    matched = [k for k, shape in enumerate(shapes) if shape.is_matched]
    if not matched:
        return []
    starts = [control_box([contour.start for contour in shapes[k].contours]) for k in matched]
    ends = [control_box([contour.end for contour in shapes[k].contours]) for k in matched]
    return [[matched[k] for k in group] for group in grouped(overlaps(starts) & overlaps(ends))]


def residual(points: PointPairs, alignment: Alignment) -> float:
    """Return the distance that a similarity leaves between A and B: root mean square, as a share of A's size."""
    a, b, weight = points
    a = a - alignment.centre_a
    left, size = _size(alignment.undo(b) - a, weight), _size(a, weight)
    return left / size if size > 0.0 else 0.0


def _size(z: ComplexArray, weight: FloatArray) -> float:
    """Return the root mean square distance from the origin."""
    return math.sqrt(weight @ (z.real**2 + z.imag**2))
