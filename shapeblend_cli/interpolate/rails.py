"""Places along an outline: a polygon's vertex numbers, and the drawing's own segments under them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import COINCIDENT

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapeblend_cli.model import BoolArray, ComplexArray, Contour, FloatArray, IntArray, Polygon

CORNER = 0.1
"""Radians (about 6 degrees) an outline turns at a node that is a corner; smooth drawings stay below by far."""


@dataclass(frozen=True, slots=True, eq=False)
class Rail:
    """A contour as a rail on which places slide.

    A place is a vertex number of the flattened polygon, and anything between two for what lies between them: 3.5 is
    half of the way, in the parameter, from vertex 3 to vertex 4. Vertices are whole numbers, so that the drawing's
    nodes stay exact whatever is added to them. A closed outline goes on past its start: vertex `count` is vertex 0.

    Attributes
    ----------
    segments : (k, 4) complex
    straight : (k,) bool
    vertices : (m,) complex
    closed : bool
    segment : (e,) int
        The segment on which each edge of the polygon lies; as many edges as vertices if closed, else one less.
    start, end : (e,) float
        The edge's parameters on it.
    lengths : (e + 1,) float
        Length of the polygon up to each vertex.
    node, corner : (e + 1,) bool
        Whether the vertex is an end of a segment, and whether the outline turns there. Ends of open outlines are
        both.
    """

    segments: ComplexArray
    straight: BoolArray
    vertices: ComplexArray
    closed: bool
    segment: IntArray
    start: FloatArray
    end: FloatArray
    lengths: FloatArray
    node: BoolArray
    corner: BoolArray

    @property
    def count(self) -> int:
        """Edges once round, or from end to end."""
        return len(self.segment)

    def flag(self, flags: BoolArray, places: FloatArray) -> BoolArray:
        """What `flags`, one for each vertex, say of places; between vertices nothing."""
        whole = np.rint(places)
        numbers = whole.astype(np.intp)
        return flags[numbers % self.count if self.closed else numbers] & (whole == places)

    def length_at(self, places: FloatArray) -> FloatArray:
        """Length of the polygon from vertex 0 up to the places."""
        rounds = np.floor_divide(places, self.count) if self.closed else np.zeros_like(places)
        within = np.interp(places - rounds * self.count, np.arange(self.count + 1.0), self.lengths)
        return rounds * self.lengths[-1] + within

    def place_at(self, lengths: FloatArray) -> FloatArray:
        """The places up to which the polygon has these lengths; at vertices, to rounding, whole numbers."""
        total = self.lengths[-1]
        rounds = np.floor_divide(lengths, total) if self.closed else np.zeros_like(lengths)
        places = rounds * self.count + np.interp(
            lengths - rounds * total, self.lengths, np.arange(self.count + 1.0)
        )
        whole = np.rint(places)
        return np.where(np.abs(places - whole) < 1e-7, whole, places)

    def points(self, places: FloatArray) -> ComplexArray:
        """The contour's points at places: on the curve also between vertices."""
        edge = np.floor(places).astype(np.intp)
        edge = edge % self.count if self.closed else np.minimum(edge, self.count - 1)
        share = places - np.floor(places) if self.closed else places - edge
        parameter = self.start[edge] + (self.end[edge] - self.start[edge]) * share
        return cubics.evaluate(self.segments[self.segment[edge]], parameter)

    def parts(self, places: FloatArray) -> tuple[IntArray, FloatArray, FloatArray]:
        """What lies between neighbouring places: segment, first and last parameter.

        Where two places are one, the part is a point of the segment that begins or goes on there.
        """
        first, last = places[:-1], places[1:]
        begins = np.floor(first).astype(np.intp)
        ends = np.maximum(np.ceil(last).astype(np.intp) - 1, begins)
        if not self.closed:
            begins, ends = np.minimum(begins, self.count - 1), np.minimum(ends, self.count - 1)
        at, till = begins % self.count, ends % self.count
        low = self.start[at] + (self.end[at] - self.start[at]) * (first - begins)
        high = self.start[till] + (self.end[till] - self.start[till]) * (last - ends)
        return self.segment[at], low, np.maximum(high, low)


def rail(contour: Contour, polygon: Polygon) -> Rail:
    """A contour and its polygon, of two vertices or more, as a rail."""
    segments, closed = contour.segments, polygon.closed
    vertices = polygon.vertices
    count = len(vertices) if closed else len(vertices) - 1
    following = (np.arange(count) + 1) % len(vertices)
    size = float(np.abs(segments - segments[0, 0]).max())
    segment = polygon.segment[following].copy()
    at_node = polygon.parameter[following] == 0.0
    if at_node.any():
        # An edge that ends at a node lies on the segment before it; segments that are a point have no edge.
        extent = np.abs(segments - segments[:, :1]).max(axis=1)
        real = np.flatnonzero(extent > COINCIDENT * size)
        rank = np.searchsorted(real, segment[at_node], side="left") - 1
        segment[at_node] = real[rank]
    same = segment == polygon.segment[:count]
    start = np.where(same, polygon.parameter[:count], 0.0)
    end = np.where(at_node, 1.0, polygon.parameter[following])
    changes = np.roll(segment, -1) != segment
    if not closed:
        changes[-1:] = True
    end = np.where(changes, 1.0, end)
    lengths = np.concatenate([[0.0], np.cumsum(np.abs(vertices[following] - vertices[:count]))])
    node = np.append(start == 0.0, True)
    if closed:
        node[-1] = node[0]
    corner = np.zeros(count + 1, np.bool_)
    numbers = np.flatnonzero(node[:count])
    turn = np.abs(
        np.angle(
            cubics.directions(segments)[0][segment[numbers]]
            * cubics.directions(segments)[1][segment[numbers - 1]].conj()
        )
    )
    corner[numbers] = turn > CORNER
    corner[-1] = corner[0]
    if not closed:
        corner[[0, -1]] = True
    return Rail(segments, contour.straight, vertices, closed, segment, start, end, lengths, node, corner)


def is_among(values: NDArray[Any], others: NDArray[Any]) -> BoolArray:
    """Which values are among others, as `numpy.isin` says, whose first call imports all of `numpy.ma`."""
    if not len(others):
        return np.zeros(len(values), np.bool_)
    ranked = np.sort(others)
    at = np.searchsorted(ranked, values)
    return ranked[np.minimum(at, len(ranked) - 1)] == values
