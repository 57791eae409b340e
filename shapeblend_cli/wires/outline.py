"""A contour by lengths along its polygon."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import edge_parts
from shapeblend_cli.geometry.polyline import cumulative_lengths, from_end_to_end, nearest_places

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray
    from shapeblend_cli.wires.common_cuts import FlatContour


class Outline(NamedTuple):
    """A contour with the lengths up to its vertices."""

    flat: FlatContour
    line: ComplexArray  # its polygon, the first vertex of a closed one repeated
    lengths: FloatArray

    @classmethod
    def of(cls, flat: FlatContour) -> Outline:
        """Return the outline of a contour."""
        line = from_end_to_end(flat.polygon.vertices, flat.polygon.closed)
        return cls(flat, line, cumulative_lengths(line))

    @property
    def total(self) -> float:
        """The whole length."""
        return float(self.lengths[-1])

    def lengths_near(self, points: ComplexArray) -> tuple[FloatArray, FloatArray]:
        """Return how far points are, and at what length the nearest place is."""
        distance, place = nearest_places(points, self.line)
        return distance, np.interp(place, np.arange(len(self.lengths)), self.lengths)

    def between(self, start: float, end: float) -> tuple[ComplexArray, BoolArray]:
        """Return the segments from one length to another, further along, and which are straight."""
        contour = self.flat.contour
        count = len(contour.segments)
        segment, low, high = edge_parts(contour, self.flat.polygon)

        def position(length: float) -> float:
            rounds, rest = divmod(length, self.total)
            edge = min(int(np.searchsorted(self.lengths, rest, side="right")) - 1, len(segment) - 1)
            share = (rest - self.lengths[edge]) / (self.lengths[edge + 1] - self.lengths[edge])
            return rounds * count + segment[edge] + low[edge] + share * (high[edge] - low[edge])

        first, last = position(start), position(end)
        numbers = np.arange(int(np.floor(first)), int(np.ceil(last)))
        starts, ends = np.clip(first - numbers, 0.0, 1.0), np.clip(last - numbers, 0.0, 1.0)
        kept = ends > starts
        numbers = numbers[kept] % count
        return cubics.pieces(contour.segments[numbers], starts[kept], ends[kept]), contour.straight[numbers]
