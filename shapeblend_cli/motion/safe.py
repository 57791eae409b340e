"""Motion that never crosses itself, as long as its ends do not.

The curve shortening flow takes every outline without crossings to a circle without crossing itself (`flow`);
docs/motion.md says what other solutions are known. Let ``A_s`` and ``B_s`` be the outlines smoothed for a time s of the
flow, B's rotated back by what rotates ``A_s`` best into ``B_s``. The space of all in-betweens
``(1 - u) A_s + u B_s``, placed as in rigid motion, is free of crossings along three of its sides: at u = 0 and u = 1
because the flow never crosses itself, and at the largest s because there two circles with evenly spread vertices
coincide. So there is a route from A to B, and the one is taken that smooths least. Rigid motion without crossings is
the route along s = 0.

That is proven for one closed contour and the flow itself. Here it runs in steps on polygons, to which cubics are
fitted, so every position of the route is checked; an edge that is not free all the same, or where contours collide, is
taken only if there is no other.
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.crossings import chain_crossings, path_crossings
from shapeblend_cli.model import ContourBlend, CubicPath, ShapeBlend, frozen
from shapeblend_cli.motion.alignment import Alignment
from shapeblend_cli.motion.levels import smoothing_levels

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, FloatArray

    Position = tuple[float, float]
    """The share of the way from A to B, and the level of smoothing."""

COLUMNS = 24
"""Steps of the search from A to B; their middles are checked too."""

LENGTH_COST, LEVEL_COST, LEVEL_CHANGE_COST, CROSSED_COST, BLOCKED_COST = 0.02, 1.0, 0.1, 2.0, 20.0
"""What a route costs from A to B: for its length, for its level (1 at the top), for changing levels, for the part of it
on which there are crossings that A or B have themselves, and for an edge that is not free: more than all that is."""

TOGETHER_LEVEL, ALONE_LEVEL = 12, 24
"""Up to the first level contours rotate together; from the second on each by its own best angle."""

SAMPLES = 8
"""Points of a segment by which smoothed outlines are rotated onto each other."""

CLOSELY, MOST_SEARCHES = (0.125, 0.25, 0.375, 0.625, 0.75, 0.875), 40
"""Where edges of the route are inspected closely, and how often it is searched again if one of them is not free."""

LIFTS, SMOOTHINGS = (1.5, 0.75), 4
"""By how many levels the route is lifted if it can be, so that narrow places are less narrow, and how often it is then
evened out, as long as it stays free."""

MOST_POSITIONS = 4000
"""Number of positions checked before the search is given up; most routes take a few hundred."""

LEVEL_TIME = 0.01
"""A change by one level takes as much time as moving all points by this share of the size: or details, which are all
that moves then, would vanish at once."""

LEAST_AREA, MOST_SCALE = 0.95, 2.0
"""An in-between is scaled up to have this share of the straight line between the ends' areas, but by no more."""


@dataclass(frozen=True, slots=True, eq=False)
class BlendSpace:
    """All in-betweens of the outlines of a shape and of what they are smoothed to.

    Attributes
    ----------
    alignment : Alignment
        Its rotation is that of the outlines as they are.
    lengths : sequence of int
        Number of segments of each contour.
    around_a, around_b : (levels, s, 4) complex
        Control points of all contours, one after the other, at each level; each contour around its centre.
    centres_a, centres_b : (levels, contours) complex
        A's around the centre of the whole.
    rotations : (levels, contours) float
        From A to B.
    """

    alignment: Alignment
    lengths: Sequence[int]
    around_a: ComplexArray
    around_b: ComplexArray
    centres_a: ComplexArray
    centres_b: ComplexArray
    rotations: FloatArray

    @property
    def top(self) -> int:
        """The last level."""
        return len(self.rotations) - 1

    def at(self, share: float, level: float, scale: float = 1.0) -> ComplexArray:
        """Return the control points of all contours at a position, (s, 4) complex.

        The centres of contours move as in rigid motion; around its centre each contour rotates by itself.
        """
        low = min(int(level), self.top)
        high = min(low + 1, self.top)
        f = level - low
        rotation = (1.0 - f) * self.rotations[low] + f * self.rotations[high]
        placed = scale * (1.0 - share + share * self.alignment.scale) * np.exp(1j * rotation * share)
        of_a = placed * (1.0 - share)
        of_b = placed * share * np.exp(-1j * rotation) / self.alignment.scale
        centre_a = (1.0 - f) * self.centres_a[low] + f * self.centres_a[high]
        centre_b = (1.0 - f) * self.centres_b[low] + f * self.centres_b[high]
        mean = (1.0 - share) * centre_a + share * self.alignment.undo(centre_b)
        centre = self.alignment.apply(scale * mean, share)
        a = (1.0 - f) * self.around_a[low] + f * self.around_a[high]
        b = (1.0 - f) * self.around_b[low] + f * self.around_b[high]
        of_a, of_b, centre = (np.repeat(values, self.lengths)[:, None] for values in (of_a, of_b, centre))
        return a * of_a + b * of_b + centre

    def split(self, segments: ComplexArray) -> list[ComplexArray]:
        """Return control points contour by contour."""
        return np.split(segments, np.cumsum(self.lengths)[:-1])


@dataclass(frozen=True, slots=True, eq=False)
class Safe:
    """Motion along a route through a space of smoothed in-betweens.

    Times, (k,) float, rise from 0 to 1, evenly by how far the points move. At each there is a position, share and
    level, and a scale.
    """

    space: BlendSpace
    times: FloatArray
    shares: FloatArray
    levels: FloatArray
    scales: FloatArray
    name = "safe"

    def __post_init__(self) -> None:
        for name in ("times", "shares", "levels", "scales"):
            object.__setattr__(self, name, frozen(getattr(self, name), np.float64))

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        share, level, scale = (
            float(np.interp(t, self.times, values)) for values in (self.shares, self.levels, self.scales)
        )
        return self.space.split(self.space.at(share, level, scale))


class Route(NamedTuple):
    """A route through the space of in-betweens, and what it was searched in."""

    cost: float
    positions: Sequence[Position]
    crossings: CrossingMap
    shape: ShapeBlend

    @property
    def is_level(self) -> bool:
        """Whether nothing has to be smoothed."""
        return not any(level for _, level in self.positions)


def find_route(shape: ShapeBlend, alignment: Alignment, most_cost: float = np.inf) -> Route | None:
    """Return the route that smooths least.

    None if it would cost `most_cost` or more, or has been searched for long enough. A route with an edge that is not
    free costs at least `BLOCKED_COST`.
    """
    levels_a = smoothing_levels([contour.start for contour in shape.contours])
    levels_b = smoothing_levels([contour.end for contour in shape.contours])
    lengths = [len(contour.start.segments) for contour in shape.contours]
    around_a, centres_a = _centred(levels_a)
    around_b, centres_b = _centred(levels_b)
    rotations = _rotations(levels_a, levels_b, alignment.rotation)
    centres_a = centres_a - alignment.centre_a
    space = BlendSpace(alignment, lengths, around_a, around_b, centres_a, centres_b, rotations)
    crossings = CrossingMap(space, shape.contours)
    route = None
    for _ in range(MOST_SEARCHES):
        cheapest = _cheapest_path(crossings, most_cost)
        if cheapest is None:
            return route if most_cost == np.inf else None
        route = Route(*cheapest, crossings, shape)
        if not crossings.close_edges(route.positions):
            break
    return route


def follow_route(route: Route) -> ShapeBlend:
    """Return the shape with motion along a route, evened out; lines bend where outlines are smoothed, but polygons'."""
    shape = route.shape
    path = np.array(route.positions)
    if path[:, 1].any():
        contours = tuple(c._replace(start=_bent(c.start), end=_bent(c.end)) for c in shape.contours)
        shape = shape._replace(contours=contours)
        smooth = _evened(path, route.crossings)
        if _is_free(smooth, route.crossings, CLOSELY):
            path = smooth
    return shape._replace(motion=_timed(route.crossings.space, path, shape.contours))


def _centred(levels: list[list[ComplexArray]]) -> tuple[ComplexArray, ComplexArray]:
    """Return the control points of all contours around their centres, and the centres, as `BlendSpace` has them."""
    centres = np.array([[segments[:, 0].mean() for segments in level] for level in levels])
    lengths = [len(segments) for segments in levels[0]]
    around = np.array([np.concatenate(level) for level in levels])
    return around - np.repeat(centres, lengths, axis=1)[:, :, None], centres


def _rotations(
    levels_a: list[list[ComplexArray]], levels_b: list[list[ComplexArray]], first: float
) -> FloatArray:
    """Return how far each contour rotates from A to B at each level, (levels, contours) float.

    The outlines as they are rotate together. The smoother they are, the more each contour rotates by its own best
    angle, by least squares: on a circle that determines which vertex is where.
    """
    samples = np.arange(SAMPLES) / SAMPLES
    own = [np.full(len(levels_a[0]), first)]
    for level_a, level_b in zip(levels_a, levels_b, strict=True):
        angles = []
        for a, b, below in zip(level_a, level_b, own[-1].tolist(), strict=True):
            p, q = (cubics.evaluate(z[:, None, :], samples).ravel() for z in (a, b))
            weight = sum(np.abs(np.diff(z, append=z[:1])) for z in (p, q))
            p, q = p - p.mean(), q - q.mean()
            angles.append(below + float(np.angle((weight * p.conj() * q).sum() * np.exp(-1j * below))))
        own.append(np.array(angles))
    levels = np.arange(len(levels_a))
    share_of_own = np.clip((levels - TOGETHER_LEVEL) / (ALONE_LEVEL - TOGETHER_LEVEL), 0.0, 1.0)[:, None]
    return first + share_of_own * (np.array(own[1:]) - first)


class CrossingMap:
    """Crossings of the in-betweens in a space; those with no more than A or B are free."""

    def __init__(self, space: BlendSpace, contours: Sequence[ContourBlend]) -> None:
        self.space = space
        checked = _checked_contours(contours)
        self._lengths = [space.lengths[k] for k in checked]
        self._rows = np.repeat([k in checked for k in range(len(contours))], space.lengths)
        self._straight = np.concatenate([_bent(contours[k].start).straight for k in checked])
        self._closed = [contours[k].start.closed for k in checked]
        ends = [[contours[k].start for k in checked], [contours[k].end for k in checked]]
        self._most = max(path_crossings(paths) for paths in ends)
        self._counts: dict[Position, int] = {}
        self._closed_edges: set[tuple[Position, Position]] = set()

    def count(self, share: float, level: float) -> int:
        """Return the crossings of the in-between at a position, as far as they matter."""
        position = (share, level)
        if position not in self._counts:
            segments = self.space.at(share, level)[self._rows]
            self._counts[position] = chain_crossings(
                segments, self._straight, self._lengths, self._closed, self._most + 1
            )
        return self._counts[position]

    @property
    def is_exhausted(self) -> bool:
        """Whether so many positions have been checked that a route is hardly to be found."""
        return len(self._counts) > MOST_POSITIONS

    def is_free(self, share: float, level: float) -> bool:
        """Return whether the in-between at a position is free."""
        return self.count(share, level) <= self._most

    def edge_is_free(self, start: Position, end: Position) -> bool:
        """Return whether an edge is free, as far as it is known: its end and its middle are."""
        middle = 0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])
        return self.is_free(*end) and (start, end) not in self._closed_edges and self.is_free(*middle)

    def close_edges(self, positions: Sequence[Position]) -> bool:
        """Inspect a route closely, close the edges that are not free, and return whether there are any."""
        blocked = [
            (start, end)
            for start, end in pairwise(positions)
            if self.edge_is_free(start, end) and not _is_free(np.array([start, end]), self, CLOSELY)
        ]
        self._closed_edges.update(blocked)
        return bool(blocked)


def _cheapest_path(crossings: CrossingMap, most_cost: float) -> tuple[float, list[Position]] | None:
    """Find the cheapest path from A to B by Dijkstra's algorithm; None if there is none for less than `most_cost`."""
    levels = crossings.space.top + 1
    goal = (COLUMNS, 0)
    costs: dict[tuple[int, int], float] = {(0, 0): 0.0}
    parents: dict[tuple[int, int], tuple[int, int]] = {}
    queue = [(0.0, 0, 0)]
    while queue and not crossings.is_exhausted:
        spent, column, level = heapq.heappop(queue)
        node = (column, level)
        if spent > costs[node]:
            continue
        if spent >= most_cost:
            return None
        if node == goal:
            break
        for right, up in ((1, 0), (1, 1), (1, -1), (0, 1), (0, -1), (1, 2), (1, -2)):
            following = (column + right, level + up)
            if not (following[0] <= COLUMNS and 0 <= following[1] < levels):
                continue
            mean_level = (level + 0.5 * up) / levels
            cost = (
                spent
                + (LENGTH_COST + LEVEL_COST * mean_level) * right / COLUMNS
                + LEVEL_CHANGE_COST * abs(up) / levels
            )
            # Crossings are not counted for what has been reached for less: counting is what takes time.
            if cost >= costs.get(following, np.inf):
                continue
            if not crossings.edge_is_free(_position(node), _position(following)):
                cost += BLOCKED_COST
            # Crossings that A or B have are to be left behind soon.
            cost += CROSSED_COST * right / COLUMNS * (crossings.count(*_position(following)) > 0)
            if cost < costs.get(following, np.inf):
                costs[following] = cost
                parents[following] = node
                heapq.heappush(queue, (cost, *following))
    if goal not in costs:
        return None
    path = [goal]
    while path[-1] in parents:
        path.append(parents[path[-1]])
    return costs[goal], [_position(node) for node in reversed(path)]


def _position(node: tuple[int, int]) -> Position:
    """Return the position of a node of the search."""
    return node[0] / COLUMNS, float(node[1])


def _evened(path: FloatArray, crossings: CrossingMap) -> FloatArray:
    """Lift a path off what is not free, and cut its corners, as far as it stays free; (k, 2) float."""
    for lift in LIFTS:
        lifted = path.copy()
        lifted[:, 1] += lift * np.minimum(path[:, 1] / 2.0, 1.0)
        lifted[:, 1] = np.minimum(lifted[:, 1], float(crossings.space.top))
        if _is_free(lifted, crossings, (0.0, 0.5)):
            path = lifted
            break
    for _ in range(SMOOTHINGS):
        cut = path.copy()
        cut[1:-1] = 0.25 * path[:-2] + 0.5 * path[1:-1] + 0.25 * path[2:]
        if not _is_free(cut, crossings, (0.0, 0.5)):
            break
        path = cut
    return path


def _is_free(path: FloatArray, crossings: CrossingMap, shares: Sequence[float]) -> bool:
    """Return whether a path is free, as checked at some shares of each edge."""
    checked = [path[:-1] + share * np.diff(path, axis=0) for share in shares]
    return all(crossings.is_free(share, level) for share, level in np.concatenate(checked).tolist())


def _timed(space: BlendSpace, path: FloatArray, contours: Sequence[ContourBlend]) -> Safe:
    """Return the motion along a path at even speed, its in-betweens scaled so as not to lose area."""
    shares, levels = path.T
    in_betweens = np.array([space.at(share, level) for share, level in path.tolist()])
    closed = [k for k, contour in enumerate(contours) if contour.start.closed]
    by_contour = [space.split(segments) for segments in in_betweens]
    areas = np.array([abs(sum(cubics.signed_area(split[k]) for k in closed)) for split in by_contour])
    line = (1.0 - shares) * areas[0] + shares * areas[-1]
    scales = np.ones(len(path))
    if min(areas[0], areas[-1]) > 0.0:
        scales = np.sqrt(np.clip(LEAST_AREA * line / np.maximum(areas, 1e-12 * line), 1.0, MOST_SCALE**2))
    for k in np.flatnonzero(scales > 1.0).tolist():
        in_betweens[k] = space.at(shares[k], levels[k], scales[k])
    steps = np.sqrt((np.abs(np.diff(in_betweens, axis=0)) ** 2).mean(axis=(1, 2)))
    steps += LEVEL_TIME * float(np.std(in_betweens[0])) * np.abs(np.diff(levels))
    times = np.concatenate([[0.0], np.cumsum(steps)])
    times = times / times[-1] if times[-1] > 0.0 else shares
    return Safe(space, times, shares, levels, scales)


def _bent(path: CubicPath) -> CubicPath:
    """Return a path whose lines may bend, unless it has nothing else."""
    if path.straight.all():
        return path
    return replace(path, straight=np.zeros(len(path.straight), np.bool_))


def _checked_contours(contours: Sequence[ContourBlend]) -> list[int]:
    """Return the indices of the contours that are not to cross.

    Not those of exteriors that grow out of others, or shrink into them: these begin or end on the border of another
    one, painted alike, and are seen to come out of it.
    """
    larger = [
        max((c.start, c.end), key=lambda path: abs(cubics.signed_area(path.segments))) for c in contours
    ]
    areas = [cubics.signed_area(path.segments) if path.closed else 0.0 for path in larger]
    largest = max(areas, key=abs)
    return [
        k
        for k, (contour, area) in enumerate(zip(contours, areas, strict=True))
        if not ((contour.grows or contour.shrinks) and area * largest > 0.0)
    ]
