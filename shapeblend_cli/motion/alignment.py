"""The best similarity between matched outlines."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.model import control_box
from shapeblend_cli.model.arrays import rolled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, FloatArray, ShapeBlend


REWEIGHTINGS = 20
"""Maximum number of times that points are weighted anew."""

SETTLED = 1e-3
"""Minimum gain of a reweighting to be followed by another, as a share of the movement that is left."""

NEAR = 0.02
"""Distance at which a moving point counts as half at rest, as a share of the size."""

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
    """The similarity ``a -> scale * exp(1j * rotation) * (a - centre_a) + centre_b``, in parts that change evenly.

    Half way it is smaller by the share `dip`, and aside by `aside`, so that what turns stays in the picture.
    """

    centre_a: complex
    centre_b: complex
    scale: float
    rotation: float  # in radians, positive from x towards y
    dip: float = 0.0
    aside: complex = 0j

    @property
    def is_in_place(self) -> bool:
        """Whether it maps every point to itself."""
        return self.scale == 1.0 and self.rotation == 0.0 and self.centre_a == self.centre_b

    @property
    def is_half_turn(self) -> bool:
        """Whether the other direction is as short."""
        return abs(self.rotation) > HALF_TURN

    def other_way_round(self) -> Alignment:
        """Return the same similarity, rotated in the other direction."""
        return self._replace(rotation=self.rotation - math.copysign(2.0 * math.pi, self.rotation))

    def undo(self, z: ComplexArray) -> ComplexArray:
        """Map points of B back over A's, with A's centre at the origin."""
        return (z - self.centre_b) * cmath.rect(1.0 / self.scale, -self.rotation)

    def apply(self, z: ComplexArray, t: float) -> ComplexArray:
        """Map points around the origin to time t; angle and scale change evenly, and the centre moves straight."""
        scale = (1.0 - t + t * self.scale) * (1.0 - self.dip * math.sin(math.pi * t))
        return z * cmath.rect(scale, self.rotation * t) + self.middle(t)

    def middle(self, t: float) -> complex:
        """Return where the centre is at time t."""
        return (1.0 - t) * self.centre_a + t * self.centre_b + self.aside * math.sin(math.pi * t)


class PointPairs(NamedTuple):
    """Corresponding points of outlines, and the shares of the outlines that they stand for; (k,) each."""

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


def align_contours(contours: Sequence[ContourBlend]) -> Alignment:
    """Return the similarity of matched contours; see `align`."""
    return align(point_pairs(contours))


def _adjacent_length(z: ComplexArray, closed: bool) -> FloatArray:
    edges = np.abs((rolled(z, -1) if closed else np.concatenate([z[1:], z[-1:]])) - z)
    before = rolled(edges, 1)
    if not closed:
        before[0] = 0.0
    return edges + before


def align(points: PointPairs) -> Alignment:
    """Return the similarity under which most of the outlines' length stays where it is.

    It minimises the mean logarithm of ``1 + (distance / NEAR)²``, so that a limb that swings far counts little more
    than one that swings less. It is found by iteratively reweighted least squares, once from even weights and once from
    the points that rest in place. Distances are in units of the geometric mean of both sizes, so that the order of the
    drawings makes no difference. If the movement left is not much less than without a similarity, there is none. Half
    turns go clockwise.
    """
    terms = _Terms(points)
    everywhere = terms.least_squares(points.weight)
    middle = 0.5 * (everywhere.centre_a + everywhere.centre_b)
    in_place = Alignment(middle, middle, 1.0, 0.0)
    found = [_reweighted(terms, start) for start in (in_place, everywhere)]
    alignment, least = min(found, key=lambda one: one[1])
    if IN_PLACE * terms.moving_length(in_place) <= least:
        return in_place
    if alignment.is_half_turn and alignment.rotation < 0.0:
        alignment = alignment.other_way_round()
    return _pivoted(terms, alignment)


class _Terms:
    """What sums over pairs of points are made of, so that a similarity, and what it leaves, are a product each.

    The terms are 1, both parts of p and of q, both squares, and both parts of conj(p) q: (9, k) float. p and q are the
    points relative to their means.
    """

    def __init__(self, points: PointPairs) -> None:
        a, b, self.weight = points
        self.mean_a, self.mean_b = complex(self.weight @ a), complex(self.weight @ b)
        p, q = a - self.mean_a, b - self.mean_b
        both = p.conj() * q
        squares = p.real**2 + p.imag**2, q.real**2 + q.imag**2
        self.terms = np.ones((9, len(a)))
        for k, term in enumerate((p.real, p.imag, q.real, q.imag, *squares, both.real, both.imag), 1):
            self.terms[k] = term
        self.unit = math.sqrt(self.weight @ squares[0]) * math.sqrt(self.weight @ squares[1])

    def least_squares(self, weight: FloatArray) -> Alignment:
        """Return the similarity of weighted least squares, but with the ratio of both sizes as its scale."""
        sums = self.terms @ weight
        px, py, qx, qy, square_p, square_q, x, y = (sums[1:] / sums[0]).tolist()
        p, q = complex(px, py), complex(qx, qy)
        common = complex(x, y) - p.conjugate() * q
        size_a = math.sqrt(max(square_p - abs(p) ** 2, 0.0))
        size_b = math.sqrt(max(square_q - abs(q) ** 2, 0.0))
        rotation = cmath.phase(common) if abs(common) > 1e-12 * size_a * size_b else 0.0
        scale = size_b / size_a if size_a > 0.0 and size_b > 0.0 else 1.0
        return Alignment(self.mean_a + p, self.mean_b + q, scale, rotation)

    def off(self, alignment: Alignment) -> FloatArray:
        """Return ``1 + (distance / NEAR)²`` of each point once a similarity is undone, (k,) float."""
        turn = cmath.rect(1.0 / alignment.scale, -alignment.rotation)
        shift = (alignment.centre_a - self.mean_a) - turn * (alignment.centre_b - self.mean_b)
        moved = 2.0 * turn * shift.conjugate()
        # The square of turn * q + shift - p, term by term.
        factors = (
            abs(shift) ** 2,
            *(-2.0 * shift.real, -2.0 * shift.imag, moved.real, -moved.imag),
            *(1.0, abs(turn) ** 2, -2.0 * turn.real, 2.0 * turn.imag),
        )
        near = alignment.scale / (self.unit * NEAR**2) if self.unit > 0.0 else 0.0
        return 1.0 + (near * np.array(factors)) @ self.terms

    def moving_length(self, alignment: Alignment) -> float:
        """Return the movement that a similarity leaves: the mean logarithm of `align`."""
        return float(self.weight @ np.log(self.off(alignment)))


def _pivoted(terms: _Terms, alignment: Alignment) -> Alignment:
    """Return a similarity as a rotation about its fixed point, if that is near the outlines.

    So the hand of a clock turns about its end, and shapes far away go straight.
    """
    factor = cmath.rect(alignment.scale, alignment.rotation)
    if abs(factor - 1.0) < 1e-9:
        return alignment
    pivot = (alignment.centre_b - factor * alignment.centre_a) / (1.0 - factor)
    if abs(pivot - terms.mean_a) * abs(pivot - terms.mean_b) > PIVOT_REACH**2 * terms.unit:
        return alignment
    return alignment._replace(centre_a=pivot, centre_b=pivot)


def _reweighted(terms: _Terms, alignment: Alignment) -> tuple[Alignment, float]:
    """Return a similarity improved by reweighting, and the movement that it leaves."""
    left = np.inf
    for _ in range(REWEIGHTINGS):
        off = terms.off(alignment)
        before, left = left, float(terms.weight @ np.log(off))
        if before - left <= SETTLED * left:
            break
        alignment = terms.least_squares(terms.weight / off)
    return alignment, left


def resting(points: PointPairs, alignment: Alignment) -> FloatArray:
    """Return how much each point rests once a similarity is undone, (k,) float: 1 if it stays where it is."""
    return 1.0 / _Terms(points).off(alignment)


def shared_alignments(shapes: Sequence[ShapeBlend]) -> list[Alignment | None]:
    """Return for each shape the similarity that its motion separates; None if no contour has a partner.

    Shapes that touch or lie in each other at both ends have one similarity, so that eyes do not drift against the head.
    Shapes that the similarity of the whole drawing suits about as well as their own have that.
    """
    found: list[Alignment | None] = [None] * len(shapes)
    groups = _together(shapes)
    if not groups:
        return found
    common = align_contours([contour for shape in shapes for contour in shape.contours])
    for group in groups:
        suiting = common
        if len(groups) > 1:
            pairs = point_pairs([contour for k in group for contour in shapes[k].contours])
            own, terms = align(pairs), _Terms(pairs)
            if terms.moving_length(common) > terms.moving_length(own) + SUITED:
                suiting = own
        for k in group:
            found[k] = suiting
    return found


def _together(shapes: Sequence[ShapeBlend]) -> list[list[int]]:
    """Return groups of shapes with partners, by number, whose boxes overlap at both ends."""
    matched = [k for k, shape in enumerate(shapes) if shape.is_matched]
    if not matched:
        return []
    from shapeblend_cli.geometry.grouping import grouped, overlaps

    starts = [control_box([contour.start for contour in shapes[k].contours]) for k in matched]
    ends = [control_box([contour.end for contour in shapes[k].contours]) for k in matched]
    return [[matched[k] for k in group] for group in grouped(overlaps(starts) & overlaps(ends))]


def residual(points: PointPairs, alignment: Alignment) -> float:
    """Return the root mean square distance that a similarity leaves between A and B, as a share of A's size."""
    a, b, weight = points
    a = a - alignment.centre_a
    left, size = _size(alignment.undo(b) - a, weight), _size(a, weight)
    return left / size if size > 0.0 else 0.0


def _size(z: ComplexArray, weight: FloatArray) -> float:
    return math.sqrt(weight @ (z.real**2 + z.imag**2))
