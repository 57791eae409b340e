"""A region by its outlines: what a ray from within hits, and what lies between two places.

All lengths are in units (see `pens.line.UNITS`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polygons import ring_edges
from shapeblend_cli.geometry.polyline import nearest_edges
from shapeblend_cli.geometry.raster import winding_grid
from shapeblend_cli.model.arrays import rolled
from shapeblend_cli.pens.line import length

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray, IntArray

MARGIN = 2.5
"""Width of the margin of a grid around a region, in steps."""


class Hits(NamedTuple):
    """Where rays leave a region, (n,) each: how far ahead, which edge, and the place on it from 0 to 1."""

    ahead: FloatArray
    edge: IntArray
    share: FloatArray


class Region:
    """A filled region, an exterior with its holes.

    Attributes
    ----------
    contour : int
        The number of its exterior.
    rings : list of (k,) complex
        Its outlines, with the region on their left.
    starts, ends : (n,) complex
        The edges of all outlines, in order.
    ring, first : (n,) int, (rings,) int
        The outline of each edge, and the first edge of each outline.
    """

    def __init__(self, contour: int, rings: Sequence[ComplexArray]) -> None:
        self.contour, self.rings = contour, list(rings)
        sizes = [len(ring) for ring in rings]
        self.starts = np.concatenate(self.rings)
        self.ends = np.concatenate([rolled(ring, -1) for ring in rings])
        self.ring = np.repeat(np.arange(len(rings)), sizes)
        self.first = np.cumsum([0, *sizes])
        self._grids: dict[float, tuple[complex, BoolArray]] = {}

    @property
    def area(self) -> float:
        """Its area."""
        return 0.5 * float((self.starts.conj() * self.ends).imag.sum())

    @property
    def thickness(self) -> float:
        """Its mean thickness, if it is slender."""
        perimeter = float(np.abs(self.ends - self.starts).sum())
        return 2.0 * self.area / max(perimeter, 1e-12)

    def grid(self, step: float) -> tuple[complex, BoolArray]:
        """Return the corner of a grid around the region, and which of its points are inside."""
        if step not in self._grids:
            self._grids[step] = self._grid(step)
        return self._grids[step]

    def _grid(self, step: float) -> tuple[complex, BoolArray]:
        low = complex(self.starts.real.min(), self.starts.imag.min()) - MARGIN * step * (1.0 + 1.0j)
        size = max(float(np.ptp(self.starts.real)), float(np.ptp(self.starts.imag)))
        side = int(np.ceil(size / step + 2.0 * MARGIN)) + 1
        return low, winding_grid(self.starts, self.ends, low, step, side) > 0

    def unlike(self, polygons: Sequence[ComplexArray], step: float) -> int:
        """Return how many points of a grid are only in the region, or only in the union of polygons."""
        low, inside = self.grid(step)
        starts, ends = ring_edges(polygons)
        painted = winding_grid(starts, ends, low, step, len(inside)) > 0
        return int((painted != inside).sum())

    def distances(self, points: ComplexArray) -> FloatArray:
        """Return how far points are from the outlines."""
        return nearest_edges(points, self.starts, self.ends)[0]

    def hits(self, points: ComplexArray, ways: ComplexArray) -> Hits:
        """Return where rays from points leave the region; infinitely far away if they do not."""
        edges = self.ends - self.starts
        offsets = (self.starts - points[:, None]).conj()
        slant = (ways.conj()[:, None] * edges).imag
        with np.errstate(divide="ignore", invalid="ignore"):
            ahead = (offsets * edges).imag / slant
            share = (offsets * ways[:, None]).imag / slant
            # With room for rounding, or what goes through a vertex would miss both of its edges.
            leaves = (slant > 1e-12) & (ahead > 0.0) & (share > -1e-9) & (share < 1.0 + 1e-9)
        table = np.where(leaves, ahead, np.inf)
        edge, row = table.argmin(axis=1), np.arange(len(points))
        return Hits(table[row, edge], edge, np.clip(np.nan_to_num(share[row, edge]), 0.0, 1.0))

    def between(self, first: tuple[int, float], last: tuple[int, float], most: float) -> ComplexArray | None:
        """Return the vertices of an outline from one place to another, each an edge and a share of it.

        None if they are on different outlines, or further apart along one than `most`.
        """
        number = self.ring[first[0]]
        if number != self.ring[last[0]]:
            return None
        ring, count = self.rings[number], len(self.rings[number])
        i, j = (int(place[0] - self.first[number]) for place in (first, last))
        inner = (j - i) % count
        if inner == 0 and last[1] < first[1]:
            inner = count
        vertices = ring[(i + 1 + np.arange(inner)) % count]
        ends = [ring[k] + s * (ring[(k + 1) % count] - ring[k]) for k, s in ((i, first[1]), (j, last[1]))]
        whole = length(np.concatenate([ends[:1], vertices, ends[1:]]))
        return vertices if whole < most else None
