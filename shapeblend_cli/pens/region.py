"""Filled regions, and those that lines paint, by the edges of polygons."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

DISC = np.exp(2j * np.pi * np.arange(24) / 24.0) / np.sqrt(np.cos(np.pi / 24.0))
"""Vertices of a round cap or join of radius 1; the area is a circle's."""


class Recovered(NamedTuple):
    """A recovered line: a polyline, whether it is closed, its width, and its cap and join as SVG names them."""

    points: ComplexArray
    closed: bool
    width: float
    cap: str
    join: str


class Region:
    """A filled region, by the edges of its outlines."""

    def __init__(self, contours: Sequence[ComplexArray]) -> None:
        rings = [cubics.evaluate(each[:, None, :], np.arange(8) / 8.0).ravel() for each in contours]
        self.starts = np.concatenate(rings)
        self.ends = np.concatenate([np.roll(ring, -1) for ring in rings])

    def holds(self, point: complex) -> bool:
        """Return whether a point is inside, by the even-odd rule."""
        above, below = self.starts.imag <= point.imag, self.ends.imag <= point.imag
        p, q = self.starts[above != below], self.ends[above != below]
        x = p.real + (q.real - p.real) * (point.imag - p.imag) / (q.imag - p.imag)
        return bool((x > point.real).sum() % 2)

    def ahead(self, point: complex, direction: complex) -> float:
        """Return how far the outline is from a point in a direction; infinite if it is not there."""
        return distance_ahead(point, direction, self.starts, self.ends)[0]


def nearest_edge(
    points: ComplexArray, starts: ComplexArray, ends: ComplexArray
) -> tuple[FloatArray, IntArray]:
    """Return the distance of each point from the nearest edge, and which one that is."""
    edges = ends - starts
    squares = np.maximum(edges.real**2 + edges.imag**2, 1e-300)
    offsets = points[:, None] - starts
    shares = np.clip((offsets * edges.conj()).real / squares, 0.0, 1.0)
    distances = np.abs(offsets - shares * edges)
    nearest = distances.argmin(axis=1)
    return distances[np.arange(len(points)), nearest], nearest


def distance_ahead(
    point: complex, direction: complex, starts: ComplexArray, ends: ComplexArray
) -> tuple[float, int]:
    """Return how far the nearest edge in a direction is, and which one it is."""
    edges, offsets = ends - starts, (starts - point).conj()
    slant = (direction.conjugate() * edges).imag
    with np.errstate(divide="ignore", invalid="ignore"):
        ahead = (offsets * edges).imag / slant
        share = (offsets * direction).imag / slant
        hits = (np.abs(slant) > 1e-12) & (ahead > 0.0) & (share >= 0.0) & (share <= 1.0)
    if not hits.any():
        return np.inf, -1
    k = int(np.where(hits, ahead, np.inf).argmin())
    return float(ahead[k]), k


def stroke_edges(lines: Sequence[Recovered]) -> tuple[ComplexArray, ComplexArray]:
    """Return the starts and ends of the edges of polygons, wound alike, that cover what lines paint."""
    polygons: list[ComplexArray] = []
    for line in lines:
        points = np.append(line.points, line.points[0]) if line.closed else line.points
        reach = line.width / 2.0
        points = points[np.append(True, np.abs(np.diff(points)) > 1e-9)]
        ways = np.diff(points) / np.abs(np.diff(points))
        polygons += [
            np.array([p + 1j * way * reach, p - 1j * way * reach, q - 1j * way * reach, q + 1j * way * reach])
            for p, q, way in zip(points[:-1], points[1:], ways, strict=True)
        ]
        before = np.roll(ways, 1) if line.closed else ways[:-1]
        after = ways if line.closed else ways[1:]
        for place, way, out in zip(points[:-1] if line.closed else points[1:-1], before, after, strict=True):
            turn = float(np.angle(out / way))
            if line.join == "round" or abs(turn) > np.radians(150.0):
                polygons.append(place + reach * DISC)
            elif abs(turn) > 1e-3:
                side = -1j * np.sign(turn) * reach
                tip = place + side * (way + out) / abs(way + out) / np.cos(turn / 2.0)
                polygons.append(np.array([place, place + side * way, tip, place + side * out]))
        if not line.closed and line.cap == "round":
            polygons += [points[0] + reach * DISC, points[-1] + reach * DISC]
    if not polygons:
        return np.zeros(0, complex), np.zeros(0, complex)
    wound = [each if _area(each) > 0.0 else each[::-1] for each in polygons]
    return np.concatenate(wound), np.concatenate([np.roll(each, -1) for each in wound])


def _area(polygon: ComplexArray) -> float:
    return float((polygon.conj() * np.roll(polygon, -1)).imag.sum())
