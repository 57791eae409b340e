"""The centre lines of the brush strokes of a region.

Its middle lines are cut clear of spurs, and those that go on in each other where strokes meet or cross are one stroke.
All lengths are in units.
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.brushes.middles import Graph, graph_of
from shapeblend_cli.geometry.polyline import cumulative_lengths
from shapeblend_cli.geometry.raster import thin
from shapeblend_cli.pens.line import at, chains, length

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.brushes.areas import Region
    from shapeblend_cli.model import ComplexArray

    End = tuple[int, int]

STEP = 0.3
"""Distance of the points of a centre line, in units."""

PIXELS = 7.0
"""Pixels across a stroke in the picture that is thinned."""

FINEST = 0.05
"""Minimum size of a pixel, in units."""

COARSEST = 0.14
"""Maximum size of a pixel, in units."""

SPUR = 0.6
"""Maximum length by which a spur sticks out of the ball around its base, as a share of that ball's radius."""

ONE_NODE = 1.8
"""Maximum distance of two nodes that are one crossing, as a share of the radius of the ball around either."""

GOES_ON = np.radians(65.0)
"""Maximum turn from a line to the one in which it goes on, in radians."""

BESIDE_NODE = 1.15
"""Length of a middle line that a node bends, as a share of the radius of the ball around the node."""

MOST_BENT = 0.8
"""Maximum share of a middle line that nodes bend."""

SMOOTHED = 0.4
"""Standard deviation by which centre lines are smoothed, in units."""

DOT = 0.25
"""Length of half of the centre line of a dot, in thicknesses of its region."""


class Stroke(NamedTuple):
    """The centre line of a stroke: of a closed one the last point is the first one again.

    `is_free` says of its beginning and its end whether that is in no other stroke.
    """

    points: ComplexArray
    closed: bool
    is_free: tuple[bool, bool]


def strokes_of(region: Region) -> list[Stroke]:
    """Return the centre lines of a region."""
    step = float(np.clip(region.thickness / PIXELS, FINEST, COARSEST))
    low, inside = region.grid(step)
    graph = graph_of(thin(inside))
    corner = low + 0.5 * step * (1.0 + 1.0j)
    graph.nodes = {node: corner + step * place for node, place in graph.nodes.items()}
    graph.edges = {k: (u, v, corner + step * points) for k, (u, v, points) in graph.edges.items()}
    if not graph.edges:
        y, x = np.nonzero(inside)
        return [_dot(region, (corner + step * (x + 1j * y)).astype(np.complex128))] if len(x) else []
    radii = _Radii(region)
    _tidy(graph, radii)
    joined = _joined(graph, radii)
    numbers = sorted(graph.edges)
    own = {edge: k for k, edge in enumerate(numbers)}
    by_number = {(own[k], side): (own[i], j) for (k, side), (i, j) in joined.items()}
    return [
        _stroke(graph, [(numbers[k], side) for k, side in chain], closed, radii)
        for chain, closed in chains(len(numbers), by_number)
    ]


def _dot(region: Region, inside: ComplexArray) -> Stroke:
    """Return the centre line of a dot, along its longer axis."""
    middle = inside.mean()
    way = np.exp(0.5j * np.angle(((inside - middle) ** 2).sum()))
    reach = DOT * region.thickness
    return Stroke(middle + reach * way * np.linspace(-1.0, 1.0, 5), closed=False, is_free=(True, True))


class _Radii:
    """The radii of the largest balls around places, each looked up once."""

    def __init__(self, region: Region) -> None:
        self._region, self._known = region, {}  # type: tuple[Region, dict[complex, float]]

    def at(self, place: complex) -> float:
        """Return the radius of the largest ball in the region around a place."""
        if place not in self._known:
            self._known[place] = float(self._region.distances(np.array([place]))[0])
        return self._known[place]


def _tidy(graph: Graph, radii: _Radii) -> None:
    """Cut off spurs, make one crossing of two nodes beside each other, and join lines where only two meet."""
    is_changed = True
    while is_changed:
        is_changed = any([_without_spur(graph, k, radii) for k in list(graph.edges)])
        for node in list(graph.nodes):
            is_changed |= _is_joined(graph, node)


def _without_spur(graph: Graph, edge: int, radii: _Radii) -> bool:
    """Remove a line that is a spur, or that is within one crossing; return whether it was one."""
    if edge not in graph.edges:
        return False
    u, v, points = graph.edges[edge]
    counts = len(graph.ends_at(u)), len(graph.ends_at(v))
    at_u, at_v = radii.at(graph.nodes[u]), radii.at(graph.nodes[v])
    if u != v and min(counts) == 1 and max(counts) > 2:
        tip, base = (at_v, at_u) if counts[1] == 1 else (at_u, at_v)
        if length(points) + tip - base >= SPUR * base:
            return False
        del graph.edges[edge], graph.nodes[v if counts[1] == 1 else u]
        return True
    if u == v or min(counts) < 3 or length(points) >= ONE_NODE * max(at_u, at_v):
        return False
    middle = 0.5 * (graph.nodes[u] + graph.nodes[v])
    del graph.edges[edge], graph.nodes[v]
    graph.nodes[u] = middle
    for k, (first, last, own) in list(graph.edges.items()):
        if {first, last} & {u, v}:
            own = own.copy()
            own[0] = middle if first in (u, v) else own[0]
            own[-1] = middle if last in (u, v) else own[-1]
            graph.edges[k] = u if first == v else first, u if last == v else last, own
    return True


def _is_joined(graph: Graph, node: int) -> bool:
    """Make one line of the two that meet at a node, and remove a node without lines; return whether it was such."""
    ends = graph.ends_at(node)
    if not ends:
        del graph.nodes[node]
        return True
    if len(ends) != 2 or ends[0][0] == ends[1][0]:
        return False
    (k, side), (other, other_side) = ends
    points = np.concatenate([graph.from_end(k, 1 - side), graph.from_end(other, other_side)[1:]])
    graph.edges[k] = graph.node_at(k, 1 - side), graph.node_at(other, 1 - other_side), points
    del graph.edges[other], graph.nodes[node]
    return True


def _joined(graph: Graph, radii: _Radii) -> dict[End, End]:
    """Return which ends of lines go on in which: at each node first those with the least turn."""
    joined: dict[End, End] = {}
    for node, place in graph.nodes.items():
        ends, radius = graph.ends_at(node), radii.at(place)
        if len(ends) == 2 and ends[0][0] == ends[1][0]:  # a ring
            joined[ends[0]], joined[ends[1]] = ends[1], ends[0]
            continue
        ways = [_way(graph.from_end(*end), radius) for end in ends]
        pairs = list(combinations(range(len(ends)), 2))
        turns = {(i, j): float(abs(np.angle(-ways[j] / ways[i]))) for i, j in pairs}
        if len(ends) == 4:  # both strokes count
            squares = {pair: min(turn, GOES_ON) ** 2 for pair, turn in turns.items()}
            crossings = [pairs[k] for k in range(3)], [pairs[5 - k] for k in range(3)]
            best = min(zip(*crossings, strict=True), key=lambda both: sum(squares[pair] for pair in both))
            pairs = list(best)
        done: set[int] = set()
        for i, j in sorted(pairs, key=lambda pair: turns[pair]):
            if turns[i, j] < GOES_ON and not done & {i, j}:
                joined[ends[i]], joined[ends[j]] = ends[j], ends[i]
                done |= {i, j}
    return joined


def _way(points: ComplexArray, radius: float) -> complex:
    """Return the direction in which a line leaves the node at its beginning, beyond the ball around that."""
    whole = length(points)
    skip = min(1.2 * radius, 0.5 * whole)
    near, far = at(points, [skip, min(skip + 1.5 * radius + 0.3, whole)])
    return complex(far - near) / max(abs(far - near), 1e-9)


def _stroke(graph: Graph, chain: Sequence[End], closed: bool, radii: _Radii) -> Stroke:
    """Return the stroke of a chain of lines, each with the side that comes first; nodes no longer bend it."""
    counts = {node: len(graph.ends_at(node)) for node in graph.nodes}
    parts, nodes = [], []
    for k, side in chain:
        points, both = graph.from_end(k, side), (graph.node_at(k, side), graph.node_at(k, 1 - side))
        parts.append(_clear(points, [_bent(graph, node, counts, radii) for node in both]))
        nodes.append(both)
    first, last = nodes[0][0], nodes[-1][1]
    is_free = counts[first] == 1, counts[last] == 1
    if closed:
        points = np.concatenate(parts)
        return Stroke(
            _smoothed(np.append(points, points[0]), closed=True), closed=True, is_free=(False, False)
        )
    if not is_free[0]:
        parts.insert(0, np.array([graph.nodes[first]]))
    if not is_free[1]:
        parts.append(np.array([graph.nodes[last]]))
    return Stroke(_smoothed(np.concatenate(parts), closed=False), closed=False, is_free=is_free)


def _bent(graph: Graph, node: int, counts: Mapping[int, int], radii: _Radii) -> float:
    """Return how much of the lines at a node it bends."""
    return BESIDE_NODE * radii.at(graph.nodes[node]) if counts[node] > 2 else 0.0


def _clear(points: ComplexArray, bent: Sequence[float]) -> ComplexArray:
    """Return a line without what nodes bend at its ends."""
    along = cumulative_lengths(points)
    whole = float(along[-1])
    share = min(1.0, MOST_BENT * whole / max(sum(bent), 1e-9))
    low, high = share * bent[0], whole - share * bent[1]
    inner = points[(along > low) & (along < high)]
    return np.concatenate([at(points, [low]), inner, at(points, [high])])


def _smoothed(points: ComplexArray, *, closed: bool) -> ComplexArray:
    """Return a polyline smoothed with a Gaussian, with points at even lengths; the ends of an open one stay."""
    whole = length(points)
    count = max(8, int(np.ceil(whole / STEP)) + 1)
    even = at(points, np.linspace(0.0, whole, count))
    deviation = SMOOTHED / max(whole / (count - 1), 1e-9)
    reach = min(int(np.ceil(2.5 * deviation)), count - 1)
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / deviation) ** 2)
    weights /= weights.sum()
    if closed:
        around = even[np.arange(-reach, count - 1 + reach) % (count - 1)]
        ring = np.convolve(around, weights, "valid")
        return np.append(ring, ring[0])
    before, after = 2.0 * even[0] - even[reach:0:-1], 2.0 * even[-1] - even[-2 : -reach - 2 : -1]
    return np.convolve(np.concatenate([before, even, after]), weights, "valid")
