"""The middle lines of a region, as a graph: the pixels that are left when a picture of it is thinned."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray

    Pixel = tuple[int, int]
    Edge = tuple[int, int, ComplexArray]

STRAIGHT = (0, 1), (1, 0), (0, -1), (-1, 0)
SLANTED = (1, 1), (1, -1), (-1, 1), (-1, -1)

LEAST_RING = 4
"""Minimum number of pixels of a ring without nodes."""


class Graph:
    """Middle lines between nodes.

    Attributes
    ----------
    nodes : dict of int to complex
        The place of each node.
    edges : dict of int to (int, int, (k,) complex)
        The nodes at both ends of each line, and its points from one to the other.
    """

    def __init__(self) -> None:
        self.nodes: dict[int, complex] = {}
        self.edges: dict[int, Edge] = {}

    def ends_at(self, node: int) -> list[tuple[int, int]]:
        """Return the lines that end at a node, each with the side that does."""
        return [(k, side) for k, edge in self.edges.items() for side in (0, 1) if edge[side] == node]

    def from_end(self, edge: int, side: int) -> ComplexArray:
        """Return the points of a line from one of its ends."""
        return self.edges[edge][2][::-1] if side else self.edges[edge][2]

    def node_at(self, edge: int, side: int) -> int:
        """Return the node at one of the ends of a line."""
        first, last, _ = self.edges[edge]
        return last if side else first

    def new_node(self, place: complex) -> int:
        """Add a node."""
        number = len(self.nodes)
        self.nodes[number] = place
        return number

    def new_edge(self, first: int, last: int, points: Sequence[complex]) -> None:
        """Add a line."""
        self.edges[len(self.edges)] = first, last, np.array(points)


def graph_of(skeleton: BoolArray) -> Graph:
    """Return the graph of a thinned picture, in pixels: x right, y down."""
    tracer = _Tracer(skeleton)
    tracer.trace_lines()
    tracer.trace_rings()
    return tracer.graph


class _Tracer:
    """Pixels on their way to a graph."""

    def __init__(self, skeleton: BoolArray) -> None:
        self.pixels = [(y, x) for y, x in np.argwhere(skeleton).tolist()]
        known = set(self.pixels)
        self.near = {pixel: _neighbours(pixel, known) for pixel in self.pixels}
        self.used: set[Pixel] = set()
        self.node_of: dict[Pixel, int] = {}
        self.graph = Graph()
        for pixel in self.pixels:
            if len(self.near[pixel]) > 2 and pixel not in self.node_of:
                self._add_meeting(pixel)
        for pixel in self.pixels:
            if len(self.near[pixel]) < 2:
                self.node_of[pixel] = self.graph.new_node(_place(pixel))

    def _add_meeting(self, pixel: Pixel) -> None:
        """Make one node of all pixels with more than two neighbours that touch each other."""
        number = self.graph.new_node(0j)
        self.node_of[pixel] = number
        cluster = [pixel]
        for one in cluster:  # which grows meanwhile
            for other in self.near[one]:
                if len(self.near[other]) > 2 and other not in self.node_of:
                    self.node_of[other] = number
                    cluster.append(other)
        self.graph.nodes[number] = complex(np.mean([_place(each) for each in cluster]))

    def _chain(self, start: Pixel, first: Pixel) -> tuple[list[Pixel], Pixel]:
        """Return the pixels from the first one to the next node, and the pixel there."""
        chain, here, before = [], first, start
        while here not in self.node_of and here not in self.used:
            self.used.add(here)
            chain.append(here)
            ahead = [each for each in self.near[here] if each != before]
            ahead = [each for each in ahead if each in self.node_of] or ahead
            if not ahead:
                break
            here, before = ahead[0], here
        return chain, here

    def trace_lines(self) -> None:
        """Add the lines between nodes."""
        for pixel in sorted(self.node_of):
            for other in self.near[pixel]:
                own = self.node_of[pixel]
                if other in self.used or self.node_of.get(other) == own:
                    continue
                if other in self.node_of and other < pixel:
                    continue  # seen from there
                chain, last = self._chain(pixel, other)
                if last in self.node_of:
                    end = self.node_of[last]
                    nodes = self.graph.nodes
                    self.graph.new_edge(own, end, [nodes[own], *map(_place, chain), nodes[end]])

    def trace_rings(self) -> None:
        """Add the rings without nodes, each with one."""
        for pixel in self.pixels:
            if pixel in self.used or pixel in self.node_of:
                continue
            points = [_place(each) for each in self._chain(pixel, pixel)[0]]
            if len(points) >= LEAST_RING:
                node = self.graph.new_node(points[0])
                self.graph.new_edge(node, node, [*points, points[0]])


def _place(pixel: Pixel) -> complex:
    return complex(pixel[1], pixel[0])


def _neighbours(pixel: Pixel, known: set[Pixel]) -> list[Pixel]:
    """Return the pixels next to one; those across a corner only if none is beside both."""
    y, x = pixel
    found = [(y + dy, x + dx) for dy, dx in STRAIGHT if (y + dy, x + dx) in known]
    for dy, dx in SLANTED:
        if (y + dy, x + dx) in known and (y + dy, x) not in known and (y, x + dx) not in known:
            found.append((y + dy, x + dx))
    return found
