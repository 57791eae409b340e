"""A contour together with its polygon, and places along it by length."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import edge_parts
from shapeblend_cli.geometry.polygons import reverse_contour, reverse_polygon
from shapeblend_cli.geometry.polyline import cumulative_lengths, nearest_places
from shapeblend_cli.model import Polygon
from shapeblend_cli.model.arrays import median

if TYPE_CHECKING:
    from shapeblend_cli.model import BoolArray, ComplexArray, Contour, FloatArray, IntArray

NEAR = 0.15
"""Maximum distance of a new vertex from one that is there already, as a share of the median edge, to be left out."""


@dataclass(frozen=True, eq=False)
class FlatContour:
    """A contour and its polygon."""

    contour: Contour
    polygon: Polygon

    @property
    def line(self) -> ComplexArray:
        """The vertices of its polygon from end to end."""
        return self.polygon.line

    @cached_property
    def lengths(self) -> FloatArray:
        """The length of the line up to each of its points."""
        return cumulative_lengths(self.line)

    @cached_property
    def shares(self) -> FloatArray:
        """The lengths as shares of the whole: from 0 to 1."""
        return self.lengths / self.lengths[-1]

    @property
    def total(self) -> float:
        """The whole length."""
        return float(self.lengths[-1])

    @cached_property
    def _edges(self) -> tuple[IntArray, FloatArray, FloatArray]:
        return edge_parts(self.contour, self.polygon)

    def reversed(self) -> FlatContour:
        """Return the contour traversed in reverse; a closed one keeps its first node."""
        polygon = reverse_polygon(self.polygon, len(self.contour.segments))
        return FlatContour(reverse_contour(self.contour), polygon)

    def lengths_near(self, points: ComplexArray) -> tuple[FloatArray, FloatArray]:
        """Return the distance of points from the line, and the length at which the nearest place lies."""
        distance, place = nearest_places(points, self.line)
        return distance, np.interp(place, np.arange(len(self.lengths)), self.lengths)

    def points_at(self, shares: FloatArray) -> tuple[ComplexArray, IntArray, FloatArray]:
        """Return points of the contour at shares of its length in [0, 1), their segments, and their parameters."""
        # On the edge from one vertex to the next the parameter of the segment grows evenly.
        own = self.shares
        edge = own.searchsorted(shares, side="right") - 1
        segments, low, high = self._edges
        passed = (shares - own[edge]) / (own[edge + 1] - own[edge])
        segment, parameter = segments[edge], low[edge] + (high - low)[edge] * passed
        return cubics.evaluate(self.contour.segments.take(segment, axis=0), parameter), segment, parameter

    def between(self, start: float, end: float) -> tuple[ComplexArray, BoolArray]:
        """Return the segments from one length to a larger one, which may be further round, and which are straight."""
        contour = self.contour
        count = len(contour.segments)
        segment, low, high = self._edges

        def position(length: float) -> float:
            rounds, rest = divmod(length, self.total)
            edge = min(int(np.searchsorted(self.lengths, rest, side="right")) - 1, len(segment) - 1)
            passed = (rest - self.lengths[edge]) / (self.lengths[edge + 1] - self.lengths[edge])
            return rounds * count + segment[edge] + low[edge] + passed * (high[edge] - low[edge])

        first, last = position(start), position(end)
        numbers = np.arange(int(np.floor(first)), int(np.ceil(last)))
        starts, ends = np.clip(first - numbers, 0.0, 1.0), np.clip(last - numbers, 0.0, 1.0)
        kept = ends > starts
        numbers = numbers[kept] % count
        return cubics.pieces(contour.segments[numbers], starts[kept], ends[kept]), contour.straight[numbers]

    def cut_at(self, shares: FloatArray, near: float = NEAR) -> FlatContour:
        """Return the contour with more vertices, on its curves, at shares of its length.

        A share of the median edge is the least distance of a new vertex from all others.
        """
        polygon, own = self.polygon, self.shares
        shares = np.sort(shares % 1.0 if polygon.closed else shares)
        least = near * median(own[1:] - own[:-1])
        before = np.minimum(np.maximum(own.searchsorted(shares, side="right") - 1, 0), len(own) - 2)
        shares = shares[np.minimum(shares - own[before], own[before + 1] - shares) > least]
        shares = shares[_apart(shares, least)]

        points, segment, parameter = self.points_at(shares)
        order = np.concatenate([own[: len(polygon.vertices)], shares]).argsort(kind="stable")
        cut = Polygon(
            np.concatenate([polygon.vertices, points])[order],
            np.concatenate([polygon.segment, segment])[order],
            np.concatenate([polygon.parameter, parameter])[order],
            polygon.closed,
        )
        return replace(self, polygon=cut)


def _apart(places: FloatArray, least: float) -> IntArray:
    """Return the numbers of rising places that lie further than `least` from the place kept before."""
    if (places[1:] - places[:-1] > least).all():  # the usual case
        return np.arange(len(places))
    kept: list[int] = []
    last = -np.inf
    for k, place in enumerate(places.tolist()):
        if place - last > least:
            kept.append(k)
            last = place
    return np.array(kept, np.intp)
