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

    from shapeblend_cli.model import ComplexArray, Style

Segment = tuple[complex, ...]  # the four control points of a cubic
_CLOSE = 1e-9  # ends closer than this share of the largest coordinate coincide
_NO_LENGTH = 1e-12  # a segment smaller than this share of the largest coordinate is rounding
_MAX_ARC = math.radians(45)  # a cubic over this angle is off its circle by 4e-6 of the radius

DOT = 0.002
"""Length of the line that stands for a dot, a stroked subpath without length, as a share of the width of the stroke."""


def line(start: complex, end: complex) -> Segment:
    """Return a straight line as a cubic with its inner points at thirds."""
    third = (end - start) / 3
    return (start, start + third, end - third, end)


def quadratic(start: complex, control: complex, end: complex) -> Segment:
    """Return a quadratic segment as a cubic."""
    return (start, start + 2 / 3 * (control - start), end + 2 / 3 * (control - end), end)


def chain(segments: list[Segment], straight: list[bool], closed: bool) -> Contour | None:
    """Return the contour of one subpath, a point when nothing of it has a length; None when there is nothing of it.

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
    if not kept.any():
        return point(first)
    if not kept.all():
        points, flags = points[kept], flags[kept]
    closed = closed or gap <= _CLOSE * size
    return Contour(_join(points, closed), flags, closed)


def point(place: complex) -> Contour:
    """Return a contour that is a point."""
    return Contour(np.array([line(place, place)]), np.ones(1, np.bool_), closed=True)


def transform(contour: Contour, matrix: Affine) -> Contour:
    """Return a contour with its control points mapped."""
    if matrix == IDENTITY:
        return contour
    return Contour(_join(matrix.points(contour.segments), contour.closed), contour.straight, contour.closed)


def with_length(found: list[Contour]) -> list[Contour]:
    """Return contours without those that are points."""
    return [contour for contour in found if not _is_dot(contour)]


def placed(found: Sequence[Contour], matrix: Affine, style: Style) -> list[Contour]:
    """Return contours in the root's coordinates, without those that are points there and that no stroke paints."""
    cap = style.stroke_width if style.stroke is not None and style.stroke_linecap != "butt" else 0.0
    each_placed = (_placed(contour, matrix, cap) for contour in found)
    return [contour for contour in each_placed if contour is not None]


def _placed(contour: Contour, matrix: Affine, cap: float) -> Contour | None:
    if _is_dot(contour):
        return _dot(contour, matrix, cap) if cap else None
    found = transform(contour, matrix)
    parts = np.ascontiguousarray(found.segments).view(float)
    is_small = np.abs(parts) < LEAST
    if not is_small.any():
        return found
    parts = np.where(is_small, 0.0, parts)
    return Contour(parts.view(np.complex128), found.straight, found.closed) if parts.any() else None


def _is_dot(contour: Contour) -> bool:
    return len(contour.segments) == 1 and contour.is_point


def _dot(contour: Contour, matrix: Affine, cap: float) -> Contour:
    """Return the dot of two caps as a line, which is too short to be seen as one.

    So icons draw their dots themselves, as ``h.01``. Whatever measures, matches and moves lines does so with these,
    while a filled outline would be no line to become another one. It is upright, with which square caps are as they
    are along the x axis, and the dot of a question mark becomes the stem of an i.
    """
    centre = complex(matrix.points(contour.segments[0, 0]))
    along = complex(matrix.c, matrix.d)
    half = DOT / 2.0 * cap * along / abs(along)
    return Contour(np.array([line(centre - half, centre + half)]), np.ones(1, np.bool_), closed=False)


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
