"""Cubic Bezier segments, all in one array and computed at once.

A chain of k segments is a (k, 4) complex array of control points, as in `model.Contour`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.model import Box

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

ARC_PIECES = 32
"""Number of pieces of equal parameter on which a segment's length is summed."""

# Gauss-Legendre nodes and weights of order 4 on [0, 1], spelt out because numpy.polynomial is slow to import.
_NODES = 0.5 + 0.5 * np.array(
    [-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526]
)
_WEIGHTS = 0.5 * np.array([0.34785484513745385, 0.6521451548625461, 0.6521451548625461, 0.34785484513745385])

_THIRDS = np.array([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0])


def evaluate(segments: ComplexArray, t: FloatArray) -> ComplexArray:
    """Return points at parameters `t`, which broadcast against the segments' leading axes."""
    p0, p1, p2, p3 = np.moveaxis(segments, -1, 0)
    u = 1.0 - t
    return u * u * (u * p0 + 3.0 * t * p1) + t * t * (3.0 * u * p2 + t * p3)


def polyline(segments: ComplexArray, parts: int) -> ComplexArray:
    """Return points along a path at even parameters, `parts` a segment, without its end."""
    return evaluate(segments[:, None, :], np.arange(parts) / parts).ravel()


def arc_lengths(segments: ComplexArray) -> FloatArray:
    """Return lengths of `ARC_PIECES` pieces of equal parameter of each segment, (k, ARC_PIECES) float.

    They are four-point Gauss quadratures of the speed.
    """
    t = (np.arange(ARC_PIECES)[:, None] + _NODES).ravel() / ARC_PIECES
    hodograph = 3.0 * np.diff(segments, axis=1)
    basis = np.stack([(1.0 - t) ** 2, 2.0 * t * (1.0 - t), t * t])
    speed = np.abs(hodograph @ basis).reshape(len(segments), ARC_PIECES, len(_NODES))
    return speed @ (_WEIGHTS / ARC_PIECES)


def lengths(segments: ComplexArray) -> FloatArray:
    """Return the arc length of each segment, (k,) float."""
    return arc_lengths(segments).sum(axis=1)


def pieces(segments: ComplexArray, start: FloatArray, end: FloatArray) -> ComplexArray:
    """Return the part of each segment between two parameters in [0, 1], (k, 4) complex, by blossoming."""

    def blossom(r: FloatArray, s: FloatArray, t: FloatArray) -> ComplexArray:
        points = segments
        for parameter in (r, s, t):
            points = points[:, :-1] + (points[:, 1:] - points[:, :-1]) * parameter[:, None]
        return points[:, 0]

    return np.stack(
        [
            blossom(start, start, start),
            blossom(start, start, end),
            blossom(start, end, end),
            blossom(end, end, end),
        ],
        axis=1,
    )


def chord_deviation(segments: ComplexArray) -> FloatArray:
    """Return a bound on each segment's distance from its chord, (k,) float.

    The distance to a convex set is convex, and at parameter t the two inner control points weigh
    ``3 t (1 - t) <= 3/4`` together; the ends lie on the chord. So three quarters of the larger distance
    of an inner point bounds the curve's, and is reached where both lie equally far off.
    """
    origin = segments[:, 0]
    chord = segments[:, 3] - origin
    square = np.abs(chord) ** 2
    inner = segments[:, 1:3] - origin[:, None]
    along = (inner * chord.conj()[:, None]).real / np.where(square > 0.0, square, 1.0)[:, None]
    foot = np.clip(along, 0.0, 1.0) * chord[:, None]
    return 0.75 * np.abs(inner - foot).max(axis=1)


def extremal_parameters(segments: ComplexArray) -> tuple[IntArray, FloatArray]:
    """Return where x or y is extremal inside a segment: segment numbers, and parameters in (0, 1)."""
    d0, d1, d2 = np.moveaxis(np.diff(segments, axis=1), -1, 0)
    found: list[tuple[IntArray, FloatArray]] = []
    for part in (np.real, np.imag):
        # The derivative in monomial form: a t^2 + 2 b t + c. Written so that neither root cancels.
        c, b = part(d0), part(d1) - part(d0)
        a = part(d2) - 2.0 * part(d1) + c
        root = np.sqrt(np.maximum(b * b - a * c, 0.0))
        big = -(b + np.where(b >= 0.0, root, -root))
        with np.errstate(divide="ignore", invalid="ignore"):
            candidates = np.stack([big / a, c / big], axis=1)
        inside = (candidates > 0.0) & (candidates < 1.0) & (b * b >= a * c)[:, None]
        found.append((np.nonzero(inside)[0], candidates[inside]))
    return np.concatenate([s for s, _ in found]), np.concatenate([t for _, t in found])


def bounds(segments: ComplexArray) -> Box:
    """Return the smallest box around the curves."""
    which, t = extremal_parameters(segments)
    points = np.concatenate([segments[:, 0], segments[:, 3], evaluate(segments[which], t)])
    return Box.around(points)


def signed_area(segments: ComplexArray) -> float:
    """Return the area between a chain of segments and the line from its end to its start, see `polygons`."""
    points = evaluate(segments[:, None, :], _NODES)
    hodograph = 3.0 * np.diff(segments, axis=1)
    basis = np.stack([(1.0 - _NODES) ** 2, 2.0 * _NODES * (1.0 - _NODES), _NODES**2])
    swept = ((points.conj() * (hodograph @ basis)).imag @ _WEIGHTS).sum()
    return 0.5 * float(swept + (segments[-1, 3].conj() * segments[0, 0]).imag)


def line(start: complex, end: complex) -> ComplexArray:
    """Return a straight segment, (4,) complex, its inner points at thirds."""
    return start + (end - start) * _THIRDS


def lines(vertices: ComplexArray, closed: bool) -> ComplexArray:
    """Return straight segments from vertex to vertex, (k, 4) complex; of a closed polygon as many as its vertices."""
    starts, ends = (vertices, np.roll(vertices, -1)) if closed else (vertices[:-1], vertices[1:])
    return starts[:, None] + (ends - starts)[:, None] * _THIRDS


def directions(segments: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
    """Return unit tangents at the start and the end of each segment, both (k,) complex, in the direction of travel.

    Where a handle has no length the next control point that lies elsewhere gives the direction, as it does in
    the limit. A segment that is a point has none: zero.
    """
    extent = np.abs(segments - segments[:, :1]).max(axis=1)
    return _towards(segments, extent), -_towards(segments[:, ::-1], extent)


def _towards(segments: ComplexArray, extent: FloatArray) -> ComplexArray:
    ahead = segments[:, 1:] - segments[:, :1]
    apart = np.abs(ahead) > 1e-6 * extent[:, None]
    chosen = ahead[np.arange(len(segments)), apart.argmax(axis=1)]
    length = np.abs(chosen)
    return np.where(apart.any(axis=1), chosen / np.where(length > 0.0, length, 1.0), 0.0)
