"""Positions along an outline: the polygon's vertex numbers, and the drawing's own segments under them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import edge_parts
from shapeblend_cli.geometry.polyline import cumulative_lengths, interpolated

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapeblend_cli.model import BoolArray, ComplexArray, Contour, FloatArray, IntArray, Polygon

CORNER = 0.1
"""Minimum turn of an outline at a corner, in radians (about 6 degrees); smooth joints stay far below."""


@dataclass(frozen=True, slots=True, eq=False)
class ContourParameter:
    """The parameter of positions on a contour.

    A position is a vertex number of the flattened polygon, or a number between two: 3.5 is halfway, in the curve's
    parameter, from vertex 3 to vertex 4. Vertices are whole numbers, so that the drawing's nodes stay exact under
    addition. A closed contour continues past its start: position `count` is vertex 0 again.

    Attributes
    ----------
    segment : (e,) int
        The segment of each edge of the polygon; as many edges as vertices if closed, else one less.
    start, end : (e,) float
        The edge's parameters on that segment.
    numbers : (e + 1,) float
        The vertices' own numbers as positions, rising.
    lengths : (e + 1,) float
        Length of the polygon up to each vertex.
    node, corner : (e + 1,) bool
        Whether the vertex ends a segment, and whether the outline turns there. Ends of open contours are both.
    """

    segments: ComplexArray
    straight: BoolArray
    vertices: ComplexArray
    closed: bool
    segment: IntArray
    start: FloatArray
    end: FloatArray
    numbers: FloatArray
    lengths: FloatArray
    node: BoolArray
    corner: BoolArray

    @property
    def count(self) -> int:
        """Edges of the polygon."""
        return len(self.segment)

    def is_node(self, positions: FloatArray) -> BoolArray:
        """Return whether each position is a node of the drawing."""
        return self._at_vertices(self.node, positions)

    def is_corner(self, positions: FloatArray) -> BoolArray:
        """Return whether each position is a corner of the drawing."""
        return self._at_vertices(self.corner, positions)

    def _at_vertices(self, flags: BoolArray, positions: FloatArray) -> BoolArray:
        whole = np.rint(positions)
        numbers = whole.astype(np.intp)
        return flags[numbers % self.count if self.closed else numbers] & (whole == positions)

    def length_at(self, positions: FloatArray) -> FloatArray:
        """Return the length of the polygon from vertex 0 to each position."""
        return interpolated(positions, self.numbers, self.lengths, self.closed)

    def position_at(self, lengths: FloatArray) -> FloatArray:
        """Return the positions at which the polygon has these lengths; at vertices, whole numbers."""
        positions = interpolated(lengths, self.lengths, self.numbers, self.closed)
        whole = np.rint(positions)
        return np.where(np.abs(positions - whole) < 1e-7, whole, positions)

    def points(self, positions: FloatArray) -> ComplexArray:
        """Return the contour's points at positions: on the curve, also between vertices."""
        edge = np.floor(positions).astype(np.intp)
        edge = edge % self.count if self.closed else np.minimum(edge, self.count - 1)
        share = positions - np.floor(positions) if self.closed else positions - edge
        parameter = self.start[edge] + (self.end[edge] - self.start[edge]) * share
        return cubics.evaluate(self.segments[self.segment[edge]], parameter)

    def parts(self, positions: FloatArray, *, joined: bool) -> tuple[ComplexArray, BoolArray, FloatArray]:
        """Return the pieces between neighbouring positions, see `cubics.pieces_between`."""
        edges = self.segment, self.start, self.end
        return cubics.pieces_between(
            self.segments, self.straight, edges, self.closed, positions, joined=joined
        )


def parametrize(contour: Contour, polygon: Polygon) -> ContourParameter:
    """Return the parameter of a contour whose polygon has two vertices or more."""
    segments, closed = contour.segments, polygon.closed
    vertices = polygon.vertices
    segment, start, end = edge_parts(contour, polygon)
    count = len(segment)
    lengths = cumulative_lengths(polygon.line)
    node = np.ones(count + 1, np.bool_)
    node[:-1] = start == 0.0
    if closed:
        node[-1] = node[0]
    corner = np.zeros(count + 1, np.bool_)
    numbers = node[:count].nonzero()[0]
    begin_direction, end_direction = cubics.directions(segments)
    turn = np.angle(begin_direction[segment[numbers]] * end_direction[segment[numbers - 1]].conj())
    corner[numbers] = np.abs(turn) > CORNER
    corner[-1] = corner[0]
    if not closed:
        corner[[0, -1]] = True
    own_numbers = np.arange(count + 1.0)
    return ContourParameter(
        segments, contour.straight, vertices, closed, segment, start, end, own_numbers, lengths, node, corner
    )


def segment_positions(contour: Contour, polygon: Polygon, positions: FloatArray) -> FloatArray:
    """Return positions as numbers of segments plus parameters, which do not depend on the polygon."""
    segment, start, end = edge_parts(contour, polygon)
    count = len(segment)
    rounds = np.floor_divide(positions, count) if polygon.closed else np.zeros_like(positions)
    edge = np.minimum((positions - rounds * count).astype(np.intp), count - 1)
    share = positions - rounds * count - edge
    parameter = start[edge] + (end[edge] - start[edge]) * share
    return rounds * len(contour.segments) + segment[edge] + parameter


def is_among(values: NDArray[Any], others: NDArray[Any]) -> BoolArray:
    """Return `numpy.isin(values, others)`, without its first call's import of all of `numpy.ma`."""
    if not len(others):
        return np.zeros(len(values), np.bool_)
    ranked = np.sort(others)
    at = ranked.searchsorted(values)
    return ranked[np.minimum(at, len(ranked) - 1)] == values
