"""Filled regions, those that lines paint, and what sticks out of lines: by the edges of polygons."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import ring_edges, signed_area
from shapeblend_cli.pens.line import evenly

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

DISC = np.exp(2j * np.pi * np.arange(24) / 24.0) / np.sqrt(np.cos(np.pi / 24.0))
"""Vertices of a round cap or join of radius 1; the area is a circle's."""


SLIGHT = 0.3
"""Maximum turn at which a round join is drawn as a mitred one, in radians: it has no more than a hundredth beyond."""

SHARPEST = np.radians(150.0)
"""Maximum turn of a mitred join, in radians."""


OUTLINE_STEP = 0.1
"""Distance of sample points along an outline, in units."""

OFF = 0.03
"""Maximum distance of an outline from what a line paints where it is the line's edge, in widths."""

STICKS_OUT = 0.12
"""Minimum distance by which something sticks out of a line, in widths."""


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
        self.starts, self.ends = ring_edges([cubics.polyline(each, 8) for each in contours])

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
    x, y = points.real[:, None] - starts.real, points.imag[:, None] - starts.imag
    shares = np.clip(x * (edges.real / squares) + y * (edges.imag / squares), 0.0, 1.0)
    x -= shares * edges.real
    y -= shares * edges.imag
    away = x * x + y * y
    nearest = away.argmin(axis=1)
    return np.sqrt(away[np.arange(len(points)), nearest]), nearest


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
    polygons = [each for line in lines for each in _polygons(line)]
    if not polygons:
        return np.zeros(0, complex), np.zeros(0, complex)
    starts, ends = [], []
    for each in polygons:
        following = np.concatenate([each[:, 1:], each[:, :1]], axis=1)
        back = ((each.conj() * following).imag.sum(axis=1) < 0.0)[:, None]
        starts.append(np.where(back, following, each).ravel())
        ends.append(np.where(back, each, following).ravel())
    return np.concatenate(starts), np.concatenate(ends)


def _polygons(line: Recovered) -> list[ComplexArray]:
    """Return the polygons of a line's edges, (n, 4), of mitred or slight corners, (n, 4), and discs, (n, 24)."""
    points = np.append(line.points, line.points[0]) if line.closed else line.points
    reach = line.width / 2.0
    points = points[np.append(True, np.abs(np.diff(points)) > 1e-9)]
    ways = np.diff(points) / np.abs(np.diff(points))
    p, q, aside = points[:-1], points[1:], 1j * ways * reach
    edges = np.stack([p + aside, p - aside, q - aside, q + aside], axis=1)
    before, after = (np.roll(ways, 1), ways) if line.closed else (ways[:-1], ways[1:])
    places = p if line.closed else points[1:-1]
    turns = np.angle(after * before.conj())
    is_round = np.abs(turns) > (SLIGHT if line.join == "round" else SHARPEST)
    is_mitred = ~is_round & (np.abs(turns) > 1e-3)
    place, way, out, turn = (each[is_mitred] for each in (places, before, after, turns))
    side = -1j * np.sign(turn) * reach
    tip = place + side * (way + out) / np.abs(way + out) / np.cos(turn / 2.0)
    corners = np.stack([place, place + side * way, tip, place + side * out], axis=1)
    centres = places[is_round]
    if not line.closed and line.cap == "round":
        centres = np.append(centres, points[[0, -1]])
    return [edges, corners, centres[:, None] + reach * DISC]


def rests_of(contours: Sequence[ComplexArray], lines: Sequence[Recovered]) -> list[ComplexArray]:
    """Return the polygons that stick out of lines: stretches of outline, closed along the centre lines.

    Parameters
    ----------
    contours : sequence of (k, 4) complex
        An exterior and its holes, closed chains of cubic segments in units, with the region on their left.
    lines : sequence of Recovered
    """
    found = []
    for segments in contours:
        polyline = cubics.polyline(segments, 8)
        points = evenly(np.append(polyline, polyline[0]), OUTLINE_STEP)[:-1]
        away, feet, width = _from_lines(points, lines)
        is_out = away > OFF * width
        if is_out.all() or not is_out.any():
            continue
        order = np.roll(np.arange(len(points)), -int(np.flatnonzero(~is_out)[0]))
        points, feet = points[order], feet[order]
        away, width, is_out = away[order], width[order], is_out[order]
        borders = np.flatnonzero(np.diff(np.append(is_out, False).astype(np.int8)))
        for before, last in borders.reshape(-1, 2).tolist():
            run = slice(before + 1, last + 1)
            if away[run].max() < STICKS_OUT * width[run].max():
                continue
            after = (last + 1) % len(points)
            polygon = np.concatenate(
                [feet[[before]], points[before : last + 1], [points[after], feet[after]]]
            )
            if abs(signed_area(polygon)) > 1e-3:
                found.append(polygon[np.append(True, np.abs(np.diff(polygon)) > 1e-9)])
    return found


def _from_lines(
    points: ComplexArray, lines: Sequence[Recovered]
) -> tuple[FloatArray, ComplexArray, FloatArray]:
    """Return the distance of points from what the nearest line paints, the nearest place on it, and its width."""
    best = np.full(len(points), np.inf)
    feet, widths = points.copy(), np.ones(len(points))
    for line in lines:
        outline = (
            np.append(line.points, line.points[0]) if line.closed or len(line.points) == 1 else line.points
        )
        starts, ends = outline[:-1], outline[1:]
        away, edge = nearest_edge(points, starts, ends)
        ways = (ends - starts)[edge]
        shares = ((points - starts[edge]) * ways.conj()).real / np.maximum(np.abs(ways) ** 2, 1e-12)
        own = starts[edge] + np.clip(shares, 0.0, 1.0) * ways
        is_nearer = away - line.width / 2.0 < best
        best = np.where(is_nearer, away - line.width / 2.0, best)
        feet, widths = np.where(is_nearer, own, feet), np.where(is_nearer, line.width, widths)
    return best, feet, widths
