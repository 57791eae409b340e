"""The best similarity between matched outlines: turn, scale and shift."""

from __future__ import annotations

import cmath
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, FloatArray


class Alignment(NamedTuple):
    """The similarity ``a -> scale * exp(1j * turn) * (a - centre_a) + centre_b``, taken apart to move evenly.

    Attributes
    ----------
    centre_a, centre_b : complex
    scale : float > 0
    turn : float
        Radians, positive where x turns towards y.
    """

    centre_a: complex
    centre_b: complex
    scale: float
    turn: float

    def taken_back(self, z: ComplexArray) -> ComplexArray:
        """Points of B, turned, scaled and shifted so that they lie over A's; A's centre is the origin."""
        return (z - self.centre_b) * cmath.rect(1.0 / self.scale, -self.turn)

    def placed(self, z: ComplexArray, t: float) -> ComplexArray:
        """Points around the origin where they belong at time t.

        The turn goes through its angle evenly, the scale geometrically, the centre on a straight line.
        """
        centre = (1.0 - t) * self.centre_a + t * self.centre_b
        return z * cmath.rect(self.scale**t, self.turn * t) + centre


class Matched(NamedTuple):
    """What corresponds, point by point, of outlines that go together.

    Attributes
    ----------
    a, b : (k,) complex
    weight : (k,) float
        How much of the outlines each point stands for; together 1.
    """

    a: ComplexArray
    b: ComplexArray
    weight: FloatArray


def matched_points(contours: Sequence[ContourBlend]) -> Matched:
    """The dots of contours that have partners, weighted by the length of both outlines around each."""
    found = []
    for contour in contours:
        if not contour.is_matched:
            continue
        a, b = contour.dot_points()
        closed = contour.correspondence.closed
        weight = _around(a, closed) + _around(b, closed)
        found.append((a, b, weight))
    a, b, weight = (np.concatenate(side) for side in zip(*found, strict=True))
    return Matched(a, b, weight / weight.sum())


def _around(z: ComplexArray, closed: bool) -> FloatArray:
    """Length of the edges before and after each point."""
    edges = np.abs(np.diff(z, append=z[:1] if closed else z[-1:]))
    before = np.roll(edges, 1)
    if not closed:
        before[0] = 0.0
    return edges + before


def align(points: Matched) -> Alignment:
    """The similarity that takes A's points nearest to B's, by weighted least squares.

    The turn is that of the least squares; the scale is the ratio of both sizes, so that which of the drawings comes
    first makes no difference: where the outlines have little in common, least squares would shrink both ways.
    """
    a, b, weight = points
    centre_a, centre_b = complex((weight * a).sum()), complex((weight * b).sum())
    a, b = a - centre_a, b - centre_b
    common = complex((weight * a.conj() * b).sum())
    size_a, size_b = _size(a, weight), _size(b, weight)
    turn = cmath.phase(common) if abs(common) > 1e-12 * size_a * size_b else 0.0
    scale = size_b / size_a if size_a > 0.0 and size_b > 0.0 else 1.0
    return Alignment(centre_a, centre_b, scale, turn)


def residual(points: Matched, alignment: Alignment) -> float:
    """What a similarity leaves of the way from A to B: root mean square, as a share of A's size."""
    a, b, weight = points
    a = a - alignment.centre_a
    left, size = _size(alignment.taken_back(b) - a, weight), _size(a, weight)
    return left / size if size > 0.0 else 0.0


def _size(z: ComplexArray, weight: FloatArray) -> float:
    """Root mean square distance from the origin."""
    return float(np.sqrt((weight * (z.real**2 + z.imag**2)).sum()))
