"""The best similarity between matched outlines, and rigid motion along it."""

from __future__ import annotations

import cmath
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, FloatArray


REWEIGHTINGS, SETTLED = 20, 1e-3
"""How often points are weighted anew at most, and what share less that leaves moving ends it."""

NEAR = 0.02
"""A point that moves by this share of the size half stays where it is."""

IN_PLACE = 0.7
"""A similarity leaves at most this share of what moves without it, or there is none."""


class Alignment(NamedTuple):
    """The similarity ``a -> scale * exp(1j * rotation) * (a - centre_a) + centre_b``, in parts that move evenly.

    The rotation is in radians, positive from x towards y.
    """

    centre_a: complex
    centre_b: complex
    scale: float
    rotation: float

    def undo(self, z: ComplexArray) -> ComplexArray:
        """Map points of B back over A's, with A's centre at the origin."""
        return (z - self.centre_b) * cmath.rect(1.0 / self.scale, -self.rotation)

    def apply(self, z: ComplexArray, t: float) -> ComplexArray:
        """Map points around the origin to where they are at time t.

        The angle and the scale change evenly, and the centre moves on a straight line.
        """
        centre = (1.0 - t) * self.centre_a + t * self.centre_b
        return z * cmath.rect(1.0 - t + t * self.scale, self.rotation * t) + centre


class Rigid(NamedTuple):
    """Motion as if a shape were moved by hand: rotated, scaled and shifted, and what else changes moves straight.

    A point between ``a`` and ``b`` is at time t ``S(t) ((1 - t) a + t S^-1 b)``, where ``S(t)`` is the part of the
    similarity ``S = S(1)`` gone through by then (`Alignment.apply`). Of a shape and the same shape rotated, ``S^-1 b``
    is ``a``, and every in-between is that shape.
    """

    alignment: Alignment

    @property
    def name(self) -> str:
        """As `--motion` has it."""
        return "rigid"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        alignment = self.alignment
        return [
            alignment.apply(
                (1.0 - t) * (contour.start.segments - alignment.centre_a)
                + t * alignment.undo(contour.end.segments),
                t,
            )
            for contour in contours
        ]


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
    no difference which drawing comes first. If it leaves not much less than no similarity at all, there is none.
    """
    everywhere = _least_squares(points)
    middle = 0.5 * (everywhere.centre_a + everywhere.centre_b)
    in_place = Alignment(middle, middle, 1.0, 0.0)
    found = [_reweighted(points, start) for start in (in_place, everywhere)]
    alignment, least = min(found, key=lambda one: one[1])
    return in_place if IN_PLACE * _moving_length(points, in_place) <= least else alignment


def _reweighted(points: PointPairs, alignment: Alignment) -> tuple[Alignment, float]:
    """Return the similarity near another one under which most stays, and what it leaves moving."""
    left = np.inf
    for _ in range(REWEIGHTINGS):
        before, left = left, _moving_length(points, alignment)
        if before - left <= SETTLED * left:
            break
        alignment = _least_squares(points._replace(weight=points.weight * resting(points, alignment)))
    return alignment, left


def resting(points: PointPairs, alignment: Alignment) -> FloatArray:
    """Return how much each point stays where it is once a similarity is undone, (k,) float: 1 if it does."""
    return 1.0 / (1.0 + _squares(points, alignment) / NEAR**2)


def _moving_length(points: PointPairs, alignment: Alignment) -> float:
    """Return the mean logarithm of `align`."""
    return float(points.weight @ np.log1p(_squares(points, alignment) / NEAR**2))


def _squares(points: PointPairs, alignment: Alignment) -> FloatArray:
    """Return the squares of the distances that a similarity leaves, in units of both sizes; (k,) float."""
    a, b, weight = points
    left = alignment.undo(b) - (a - alignment.centre_a)
    unit = _size(a - weight @ a, weight) * _size(b - weight @ b, weight)
    return alignment.scale * (left.real**2 + left.imag**2) / unit if unit > 0.0 else np.zeros(len(a))


def _least_squares(points: PointPairs) -> Alignment:
    """Return the similarity that takes A's points nearest to B's by weighted least squares, but for its scale.

    That is the ratio of both sizes.
    """
    a, b, weight = points
    weight = weight / weight.sum()
    centre_a, centre_b = complex((weight * a).sum()), complex((weight * b).sum())
    a, b = a - centre_a, b - centre_b
    common = complex((weight * a.conj() * b).sum())
    size_a, size_b = _size(a, weight), _size(b, weight)
    rotation = cmath.phase(common) if abs(common) > 1e-12 * size_a * size_b else 0.0
    scale = size_b / size_a if size_a > 0.0 and size_b > 0.0 else 1.0
    return Alignment(centre_a, centre_b, scale, rotation)


def residual(points: PointPairs, alignment: Alignment) -> float:
    """Return the distance that a similarity leaves between A and B: root mean square, as a share of A's size."""
    a, b, weight = points
    a = a - alignment.centre_a
    left, size = _size(alignment.undo(b) - a, weight), _size(a, weight)
    return left / size if size > 0.0 else 0.0


def _size(z: ComplexArray, weight: FloatArray) -> float:
    """Return the root mean square distance from the origin."""
    return float(np.sqrt((weight * (z.real**2 + z.imag**2)).sum()))
