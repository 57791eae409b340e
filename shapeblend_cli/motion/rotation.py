"""Whether an outline, or a drawing, is a rotated copy of another."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polyline import cumulative_lengths, points_at
from shapeblend_cli.motion.alignment import align, point_pairs, residual

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, ContourBlend, Polygon

SAMPLES = 256
"""Number of points, evenly spread along an outline, that are compared."""

ALIKE = 0.999
"""Minimum correlation of outlines that are the same but for a similarity: the rest is about 4 % of the size."""

NEARLY_BEST = 1e-3
"""Maximum difference from the best correlation of starts that are as good; of these the smallest angle is taken."""

ROUNDING = 1e-6
"""Maximum difference of correlations that are equal."""

HINGE = 0.4
"""Maximum distance of a hinge, the fixed point of a rotation, from the outline, in root mean square sizes."""

END = 0.8
"""Minimum distance of a hinge from the middle of the outline, in root mean square sizes."""

LONG = 0.8
"""Minimum difference of a long outline's spreads along and across, as a share of their sum: a bar three times as long
as wide has this one."""

MUCH = np.radians(80.0)
"""Minimum angle of a turn that shapes make for its own sake, in radians."""

ABOUT_ALIKE = 0.987
"""Minimum correlation of outlines that are about the same when one of them is turned so."""

FEWER = 2
"""Step between the starts that are tried for such a turn, in points, and half of that between the points."""

FAR_MORE = 3.0
"""Minimum ratio of what outlines lack to be the same if turned less to what they lack if turned so."""

UNLIKE = 0.97
"""Maximum correlation of outlines that are turned less: discs are as good in any way."""

EIGHTH = np.pi / 4.0
"""Angle of which such a turn is about a multiple, in radians."""

OFF = np.radians(8.0)
"""Maximum distance of such a turn from a multiple of that, in radians."""

CORNER = np.radians(50.0)
"""Minimum turn inwards at a corner, in radians."""

BENT = np.radians(60.0)
"""Minimum turn inwards of an outline that is bent, in radians; one without a corner, as a mouth, bends back."""

AT_CORNER = 9
"""Number of the points, of `SAMPLES`, along a corner."""

LEAST_ROTATION = np.radians(1.0)
"""Minimum angle of a rotation, in radians."""

MOST_RESIDUAL = 0.03
"""Maximum distance from a rotated copy, root mean square, as a share of A's size."""


def rotation_between(a: Polygon, b: Polygon) -> float | None:
    """Return the angle of rotation from one polygon to another, in (-pi, pi]; None if they are not alike.

    A cyclic correlation of both outlines has the angle of least squares for every starting point as its argument, and
    their agreement as its absolute value. Of angles that agree as well, the smallest is taken; but first angles that
    leave the end of a long outline where it is, as the hand of a clock. Closed polygons must have the same orientation.
    """
    if a.closed != b.closed:
        return None
    (p, mean_a), (q, mean_b) = (_even(polygon) for polygon in (a, b))
    if _spread_differently(p, q, ALIKE):
        return None
    common = _common(p, q, a.closed)
    size_a, size_b = _size(p), _size(q)
    correlation = np.abs(common) / (size_a * size_b)
    if correlation.max() < ALIKE:
        return None
    angles = np.angle(common)
    good = np.flatnonzero(correlation >= correlation.max() - NEARLY_BEST)
    hinged = _are_hinged(p, mean_b - mean_a, size_b / size_a * np.exp(1j * angles[good]))
    good = good[hinged] if hinged.any() else good
    best = int(good[np.abs(angles[good]).argmin()])
    # The angle of a neighbour that agrees better is right. On a circle no neighbour does.
    while a.closed:
        neighbour = max((best - 1) % SAMPLES, (best + 1) % SAMPLES, key=correlation.__getitem__)
        if correlation[neighbour] <= correlation[best] + ROUNDING:
            break
        best = neighbour
    angle = float(angles[best])
    return angle if abs(angle) > LEAST_ROTATION else None


def turn_between(a: Polygon, b: Polygon) -> float | None:
    """Return by which large angle a closed polygon is turned to become about another one; None if it is not.

    It would be far from the other one if it were turned less.
    """
    p, q = (_even(polygon)[0] for polygon in (a, b))
    if _spread_differently(p, q, ABOUT_ALIKE):
        return None
    round_twice = np.concatenate([q, q[:-1]])
    begun = np.lib.stride_tricks.sliding_window_view(round_twice, SAMPLES)[::FEWER, :: 2 * FEWER]
    own = p[:: 2 * FEWER]
    # A product of matrices would start threads, which take longer than this.
    common = np.einsum("ij,j->i", begun, own.conj()) / len(own)
    correlation, angles = np.abs(common) / (_size(p) * _size(q)), np.angle(common)
    best = int(correlation.argmax())
    if correlation[best] < ABOUT_ALIKE or abs(angles[best]) < MUCH:
        return None
    less = correlation[np.abs(angles) < MUCH].max(initial=0.0)
    angle = float(angles[best])
    is_turned = less < UNLIKE and 1.0 - less > FAR_MORE * (1.0 - correlation[best])
    is_regular = abs(angle - EIGHTH * round(angle / EIGHTH)) < OFF
    return angle if is_turned and is_regular and not _is_bent(p) else None


def _is_bent(p: ComplexArray) -> bool:
    """Return whether a closed outline is bent inwards without a corner there."""
    edges = np.diff(p, append=p[:1])
    turns = np.angle(np.roll(edges, -1) / np.where(edges == 0.0, 1.0, edges))
    turns = turns * np.sign(turns.sum())
    round_twice = np.concatenate([turns, turns[: AT_CORNER - 1]])
    corners = np.convolve(round_twice, np.ones(AT_CORNER), "valid")
    inwards = -np.convolve(np.concatenate([turns, turns]), np.ones(AT_CORNER), "same")[:SAMPLES] / AT_CORNER
    return bool(inwards.clip(0.0).sum() > BENT and corners.min() > -CORNER)


def _common(p: ComplexArray, q: ComplexArray, closed: bool) -> ComplexArray:
    """Return the mean product of points of two outlines for every start, or in both directions of open ones."""
    if not closed:
        return np.stack([q, q[::-1]]) @ p.conj() / SAMPLES
    # Summed here, since numpy.fft takes longer to import.
    round_twice = np.concatenate([q, q[:-1]])
    begun = np.ascontiguousarray(np.lib.stride_tricks.sliding_window_view(round_twice, SAMPLES))
    return begun @ p.conj() / SAMPLES


def _size(z: ComplexArray) -> float:
    return float(np.sqrt((np.abs(z) ** 2).mean()))


def _spread_differently(p: ComplexArray, q: ComplexArray, alike: float) -> bool:
    """Return whether the distances of points from their mean rule out a correlation of two outlines.

    Outlines of size 1 with a correlation c differ by ``2 - 2 c`` in the sum of squares. Their distances differ by no
    more, whatever the angle, and by the least if both are sorted.
    """
    spreads = [np.sort(np.abs(z)) for z in (p, q)]
    of_a, of_b = (spread / np.sqrt((spread**2).sum()) for spread in spreads)
    return bool(((of_a - of_b) ** 2).sum() > 2.0 - 2.0 * alike)


def _are_hinged(z: ComplexArray, shift: complex, factors: ComplexArray) -> BoolArray:
    """Return which rotations, complex factors, leave an end of a long outline where it is.

    The points of the outline are relative to their mean, which is shifted.
    """
    square = float((np.abs(z) ** 2).mean())
    if abs((z * z).mean()) < LONG * square:
        return np.zeros(len(factors), np.bool_)
    size = square**0.5
    hinges = shift / np.where(np.abs(factors - 1.0) > 1e-9, 1.0 - factors, 1e-9)
    return (np.abs(hinges[:, None] - z).min(axis=1) <= HINGE * size) & (np.abs(hinges) >= END * size)


def is_rotated_copy(contours: Sequence[ContourBlend]) -> bool:
    """Return whether B as a whole is A rotated, scaled and shifted."""
    if not all(contour.is_matched for contour in contours):
        return False
    points = point_pairs(contours)
    return residual(points, align(points)) < MOST_RESIDUAL


def _even(polygon: Polygon) -> tuple[ComplexArray, complex]:
    """Return points spread evenly along a polygon, relative to their mean, and that mean."""
    lengths = cumulative_lengths(polygon.line)
    steps = SAMPLES if polygon.closed else SAMPLES - 1
    along = np.arange(float(SAMPLES)) * (lengths[-1] / steps)  # as `numpy.linspace` has them, sooner
    if not polygon.closed:
        along[-1] = lengths[-1]
    even = points_at(along, polygon.line, lengths)
    mean = complex(even.sum() / SAMPLES)
    return even - mean, mean
