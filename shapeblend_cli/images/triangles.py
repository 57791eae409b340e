"""A polygon cut into triangles, with points inside of it: a mesh that can be bent.

mapbox_earcut cuts it between its own vertices, which works for any simple polygon. Then points are added, and edges are
flipped where that makes better triangles (Lawson 1977). No edge inside connects two vertices of the polygon: such an
edge could not bend.
"""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

MARGIN = 0.6
"""Minimum distance of a point inside from the vertices of the polygon, in spacings."""

FLATTEST = 1e-9
"""Minimum area of a triangle that a new point makes, as a share of the square of the spacing."""

MOST_FLIPS = 100_000
"""Maximum number of flips: rounding could go on for ever."""


class NotSimpleError(ValueError):
    """A polygon that crosses itself, or runs clockwise, has no triangles."""


def is_available() -> bool:
    """Return whether polygons can be cut into triangles."""
    return find_spec("mapbox_earcut") is not None


def triangulated(polygon: ComplexArray, spacing: float) -> tuple[ComplexArray, IntArray]:
    """Return the vertices of a polygon and points inside of it, and triangles of them.

    Parameters
    ----------
    polygon : (n,) complex
        Simple, with a positive area, and no two neighbours equal.
    spacing : float
        The distance of points inside from each other, about.

    Returns
    -------
    points : (n + m,) complex
        The polygon's vertices come first.
    triangles : (k, 3) int
        Each with a positive area.

    Raises
    ------
    NotSimpleError
    """
    from mapbox_earcut import triangulate_float64

    corners = np.ascontiguousarray(np.stack([polygon.real, polygon.imag], axis=1))
    found = triangulate_float64(corners, np.array([len(polygon)], np.uint32)).reshape(-1, 3).astype(np.intp)
    areas = doubled_areas(polygon, found)
    found[areas < 0.0] = found[areas < 0.0][:, ::-1]
    whole = float((polygon.conj() * np.roll(polygon, -1)).imag.sum())
    if len(found) != len(polygon) - 2 or not np.isclose(np.abs(areas).sum(), whole, rtol=1e-6):
        raise NotSimpleError
    mesh = _Mesh(polygon, found)
    mesh.flip(list(mesh.across))
    for point in _grid(polygon, spacing):
        mesh.insert(point, FLATTEST * spacing**2)
    mesh.split_chords(len(polygon))
    return np.array(mesh.points), np.array(mesh.triangles, np.intp)


def doubled_areas(points: ComplexArray, triangles: IntArray) -> FloatArray:
    """Return twice the signed area of each triangle, (k,) float."""
    a, b, c = points[triangles.T]
    areas: FloatArray = ((b - a).conj() * (c - a)).imag
    return areas


def _grid(polygon: ComplexArray, spacing: float) -> list[complex]:
    """Return points of a grid of equal triangles inside a polygon, and not next to its vertices."""
    left, right = polygon.real.min(), polygon.real.max()
    top, bottom = polygon.imag.min(), polygon.imag.max()
    rows = np.arange(top + 0.37 * spacing, bottom, 0.866 * spacing)
    columns = np.arange(left, right, spacing)
    points = (columns + 0.5 * spacing * (np.arange(len(rows)) % 2)[:, None] + 1j * rows[:, None]).ravel()
    if not len(points):
        return []
    near = np.abs(points[:, None] - polygon).min(axis=1)
    points = points[near >= MARGIN * spacing]
    # Where a ray to the right crosses the edges an odd number of times.
    p, q = polygon, np.roll(polygon, -1)
    spans = (p.imag <= points.imag[:, None]) != (q.imag <= points.imag[:, None])
    rise = np.where(q.imag == p.imag, 1.0, q.imag - p.imag)
    x = p.real + (points.imag[:, None] - p.imag) / rise * (q.real - p.real)
    inside = (spans & (x > points.real[:, None])).sum(axis=1) % 2 == 1
    found: list[complex] = points[inside].tolist()
    return found


class _Mesh:
    """Triangles, with the triangle on the left of each directed edge."""

    def __init__(self, points: ComplexArray, triangles: IntArray) -> None:
        self.points: list[complex] = points.tolist()
        self.triangles: list[tuple[int, int, int]] = []
        self.across: dict[tuple[int, int], int] = {}
        for triangle in triangles.tolist():
            self._put(None, *triangle)

    def _put(self, number: int | None, a: int, b: int, c: int) -> int:
        """Put a triangle in the place of another one, or at the end; return its number."""
        if number is None:
            number = len(self.triangles)
            self.triangles.append((a, b, c))
        else:
            self.triangles[number] = (a, b, c)
        for edge in ((a, b), (b, c), (c, a)):
            self.across[edge] = number
        return number

    def _area(self, a: int, b: int, c: int) -> float:
        """Return twice the signed area of a triangle."""
        p = self.points[a]
        return ((self.points[b] - p).conjugate() * (self.points[c] - p)).imag

    def _tip(self, edge: tuple[int, int]) -> int:
        """Return the third corner of the triangle on the left of an edge."""
        a, b, c = self.triangles[self.across[edge]]
        return a + b + c - edge[0] - edge[1]

    def flip(self, edges: list[tuple[int, int]]) -> None:
        """Flip those edges, and others next to them, whose triangles are better then."""
        for _ in range(MOST_FLIPS):
            if not edges:
                return
            i, j = edges.pop()
            if (i, j) not in self.across or (j, i) not in self.across:
                continue
            k, m = self._tip((i, j)), self._tip((j, i))
            if not self._is_better((i, j), k, m):
                continue
            first, second = self.across.pop((i, j)), self.across.pop((j, i))
            self._put(first, k, i, m)
            self._put(second, m, j, k)
            edges += [(i, m), (m, j), (j, k), (k, i)]

    def _is_better(self, edge: tuple[int, int], k: int, m: int) -> bool:
        """Return whether the edge between the tips on both sides is better: they see it under more than 180 degrees."""
        i, j = edge
        if self._area(k, i, m) <= 0.0 or self._area(m, j, k) <= 0.0:
            return False
        p, q, r, s = (self.points[n] for n in (i, j, k, m))
        # The angles at both tips, in which the edge is seen, together: their sine is negative beyond two right angles.
        turn = (q - r) * (p - r).conjugate() * (p - s) * (q - s).conjugate()
        return turn.imag < -1e-12 * abs(turn)

    def insert(self, point: complex, least: float) -> None:
        """Add a point in a triangle, unless it lies on an edge of it, about."""
        found = self._around(point)
        if found is None:
            return
        a, b, c = self.triangles[found]
        new = len(self.points)
        self.points.append(point)
        if min(self._area(a, b, new), self._area(b, c, new), self._area(c, a, new)) <= least:
            self.points.pop()
            return
        self._put(found, a, b, new)
        self._put(None, b, c, new)
        self._put(None, c, a, new)
        self.flip([(a, b), (b, c), (c, a)])

    def _around(self, point: complex) -> int | None:
        """Return the triangle around a point, looked for from the newest one."""
        number = len(self.triangles) - 1
        for _ in range(len(self.triangles)):
            a, b, c = self.triangles[number]
            for i, j in ((a, b), (b, c), (c, a)):
                p, q = self.points[i], self.points[j]
                if ((q - p).conjugate() * (point - p)).imag < 0.0:
                    if (j, i) not in self.across:
                        return self._anywhere(point)
                    number = self.across[j, i]
                    break
            else:
                return number
        return self._anywhere(point)

    def _anywhere(self, point: complex) -> int | None:
        points, triangles = np.array(self.points), np.array(self.triangles)
        a, b, c = points[triangles.T]
        sides = [((q - p).conj() * (point - p)).imag for p, q in ((a, b), (b, c), (c, a))]
        found = np.flatnonzero(np.min(sides, axis=0) >= 0.0)
        return int(found[0]) if len(found) else None

    def split_chords(self, count: int) -> None:
        """Give each inner edge between two of the first `count` points a point in its middle."""
        chords = [(i, j) for i, j in self.across if i < j < count and (j, i) in self.across]
        for i, j in chords:
            k, m = self._tip((i, j)), self._tip((j, i))
            new = len(self.points)
            self.points.append(0.5 * (self.points[i] + self.points[j]))
            first, second = self.across.pop((i, j)), self.across.pop((j, i))
            self._put(first, i, new, k)
            self._put(None, new, j, k)
            self._put(second, j, new, m)
            self._put(None, new, i, m)
