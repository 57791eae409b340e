"""Cubics into contours: chained, closed, without pieces of no length; and lines, quadratics and arcs into cubics."""

from __future__ import annotations

import cmath
import itertools
import math
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.model import MOST_CONTOURS, MOST_SEGMENTS, Contour
from shapeblend_cli.svg.xml.messages import Problem
from shapeblend_cli.svg.xml.transforms import IDENTITY, Affine
from shapeblend_cli.svg.xml.units import LEAST

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray

Segment = tuple[complex, ...]  # the four control points of a cubic
_CLOSE = 1e-9  # ends closer than this share of the largest coordinate coincide
_NO_LENGTH = 1e-12  # a segment smaller than this share of the largest coordinate is rounding
_MAX_ARC = math.radians(45)  # a cubic over this angle is off its circle by 4e-6 of the radius


def line(start: complex, end: complex) -> Segment:
    """Return a straight line as a cubic with its inner points at thirds."""
    third = (end - start) / 3
    return (start, start + third, end - third, end)


def quadratic(start: complex, control: complex, end: complex) -> Segment:
    """Return a quadratic segment as a cubic."""
    return (start, start + 2 / 3 * (control - start), end + 2 / 3 * (control - end), end)


def chain(segments: list[Segment], straight: list[bool], closed: bool) -> Contour | None:
    """Return the contour of one subpath, or None when nothing of it has a length.

    Each segment begins where the one before it ends. A `closed` subpath ends in ``Z``; its ends need not coincide.
    """
    if not segments:
        return None
    first, last = segments[0][0], segments[-1][3]
    points = np.array(segments, dtype=np.complex128)
    flags = np.array(straight, dtype=np.bool_)
    size = float(np.abs(points.view(np.float64)).max())
    gap = abs(last - first)
    if closed and gap > _CLOSE * size:
        points = np.concatenate([points, [line(last, first)]])
        flags = np.append(flags, True)
    kept = np.abs(points[:, 1:] - points[:, :1]).max(axis=1) > _NO_LENGTH * size
    if not kept.all():
        points, flags = points[kept], flags[kept]
    if not len(points):
        return None
    closed = closed or gap <= _CLOSE * size
    return Contour(_join(points, closed), flags, closed)


def transform(contour: Contour, matrix: Affine) -> Contour:
    """Return a contour with its control points mapped."""
    if matrix == IDENTITY:
        return contour
    return Contour(_join(matrix.points(contour.segments), contour.closed), contour.straight, contour.closed)


def placed(contour: Contour, matrix: Affine) -> Contour | None:
    """Return a contour in the root's coordinates, or None if it is a point there."""
    found = transform(contour, matrix)
    parts = np.ascontiguousarray(found.segments).view(float)
    is_small = np.abs(parts) < LEAST
    if not is_small.any():
        return found
    parts = np.where(is_small, 0.0, parts)
    return Contour(parts.view(np.complex128), found.straight, found.closed) if parts.any() else None


def check_size(drawn: int, added: Sequence[Contour]) -> None:
    """Refuse a drawing that is too large to blend as soon as it shows: it has some contours, with those just added."""
    if drawn > MOST_CONTOURS:
        raise Problem(
            f"it draws {drawn} contours or more, and {MOST_CONTOURS} are the most that are blended; "
            "selecting some of its shapes would work (--select-a, --select-b)"
        )
    largest = max(len(contour.segments) for contour in added)
    if largest > MOST_SEGMENTS:
        raise Problem(
            f"it draws a contour of {largest} segments, and {MOST_SEGMENTS} are the most that are blended; a "
            "simpler drawing would work"
        )


def _join(points: ComplexArray, closed: bool) -> ComplexArray:
    """Return `points` with each segment beginning exactly where the one before it ends."""
    joined = points.copy()
    joined[1:, 0] = joined[:-1, 3]
    if closed:
        joined[-1, 3] = joined[0, 0]
    return joined


def arc(
    start: complex, end: complex, radii: tuple[float, float], rotation: float, large: bool, sweep: bool
) -> list[Segment]:
    """Return an elliptical arc between two points as cubics; none when the points coincide.

    The rotation is that of the ellipse's x axis, in degrees. Radii that are too small to reach both points are scaled
    up: https://www.w3.org/TR/SVG2/implnote.html#ArcConversionEndpointToCenter.
    """
    rx, ry = abs(radii[0]), abs(radii[1])
    turn = cmath.rect(1.0, math.radians(rotation))
    # Half of the chord, seen from the unit circle that the ellipse is an image of.
    half = (start - end) / 2 / turn
    chord = complex(half.real / rx, half.imag / ry)
    if abs(chord) > 1:
        rx, ry = rx * abs(chord), ry * abs(chord)
        chord /= abs(chord)
    # Nearer than this the two ends cannot be told apart on the unit circle.
    if abs(chord) < 1e-15:
        return []
    offset = math.sqrt(max(0.0, 1 / abs(chord) ** 2 - 1))
    centre = -1j * chord * (offset if large != sweep else -offset)
    begin = cmath.phase(chord - centre)
    angle = cmath.phase((-chord - centre) / (chord - centre))
    if sweep and angle < 0:
        angle += 2 * math.pi
    elif not sweep and angle > 0:
        angle -= 2 * math.pi
    centre = (start + end) / 2 + complex(centre.real * rx, centre.imag * ry) * turn
    curves = elliptic(centre, rx * turn, 1j * ry * turn, begin, angle)
    curves[0] = (start, *curves[0][1:])
    curves[-1] = (*curves[-1][:3], end)
    return curves


def elliptic(centre: complex, x_axis: complex, y_axis: complex, begin: float, angle: float) -> list[Segment]:
    """Return an arc of the ellipse with two half axes as cubics, each for at most 45 degrees of a circle."""
    count = max(1, math.ceil(abs(angle) / _MAX_ARC - 1e-9))
    handle = 1j * 4 / 3 * math.tan(angle / count / 4)
    ends = [cmath.rect(1.0, begin + angle * k / count) for k in range(count + 1)]
    return [
        tuple(centre + z.real * x_axis + z.imag * y_axis for z in (p, p * (1 + handle), q * (1 - handle), q))
        for p, q in itertools.pairwise(ends)
    ]
