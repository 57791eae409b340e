"""Motion that never crosses itself, as long as its ends do not.

Published ways are compatible triangulations (C. Gotsman, V. Surazhsky, "Guaranteed intersection-free polygon morphing",
Computers & Graphics 25, 2001) and refolding by energy descent (H. N. Iben, J. F. O'Brien, E. D. Demaine, "Refolding
planar polygons", Discrete & Computational Geometry 41, 2009). This is of the second kind: both outlines go downhill
until the way between them is free, and the energy is their length. Its descent, the curve shortening flow, takes every
outline without crossings to a circle without crossing itself (`flow`), where repulsion between vertices can get stuck;
and a triangulation of both shapes at once needs many further vertices, whose thin triangles show.

Rather than down, across and up again, the way is planned. Let ``A_s`` and ``B_s`` be the outlines smoothed for a time s
of the flow, B's turned back by what turns ``A_s`` best into ``B_s``. The map of all in-betweens
``(1 - u) A_s + u B_s``, placed as in rigid motion, has free ground along three of its sides: at u = 0 and u = 1 because
the flow never crosses itself, and at the largest s because there two circles with evenly spread vertices lie one over
the other. So there is a way from A to B, and the one is taken that smooths least. Rigid motion without crossings is the
way along s = 0.

That is proven for one closed contour and the flow itself. Here it runs in steps on polygons, to which cubics are
fitted, so every place of the way is looked at; where a step is not free all the same, or contours are in each other's
way, it is taken only if there is no other.
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.crossings import chain_crossings, path_crossings
from shapeblend_cli.model import frozen
from shapeblend_cli.motion.alignment import Alignment
from shapeblend_cli.motion.defects import counted
from shapeblend_cli.motion.levels import smoothed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, CubicPath, FloatArray, ShapeBlend

    Place = tuple[float, float]
    """How far from A to B, and at which level."""

COLUMNS = 24
"""Steps of the map from A to B; half steps are looked at too."""

ALONG, HIGH, CLIMB = 0.02, 1.0, 0.1
"""What a way costs: for its length from A to B, for its height on the way (1 at the top), and for going up and down."""

BLOCKED = 20.0
"""And for a step over what is not free, taken only where there is no other way: more than any way that is free."""

CROSSED = 2.0
"""And for the part of it on which there are crossings, which only what A or B have itself allows."""

TOGETHER, ALONE = 12, 24
"""Up to the first level contours turn together; from the second on each turns as suits it best."""

SAMPLES = 8
"""Points of a segment by which smoothed outlines are turned over each other."""

MOST_PLANS = 40
"""How often a way is planned anew because on a closer look one of its steps is not free."""

CLOSELY = (0.125, 0.25, 0.375, 0.625, 0.75, 0.875)
"""Where on a step of the way it is looked at more closely."""

LIFTS = (1.5, 0.75)
"""By how many levels the way is lifted if it can be, so that narrow places are not as narrow as they might be."""

MOST_PLACES = 4000
"""Places of the map that are looked at, before the search for a way is given up; most ways take a few hundred."""

SMOOTHINGS = 4
"""How often the way is evened out, as long as it stays free."""

LEVEL_TIME = 0.01
"""A level up or down takes as much time as moving all points by this share of the size: or details, which are all that
moves then, would vanish at once."""

LEAST_AREA = 0.95
"""An in-between is scaled up to have this share of the straight line between the ends' areas."""

MOST_SCALE = 2.0
"""But by no more."""


@dataclass(frozen=True, slots=True, eq=False)
class Map:
    """All in-betweens of the outlines of a shape and of what they are smoothed to.

    Attributes
    ----------
    alignment : Alignment
        Its turn is that of the outlines as they are.
    lengths : sequence of int
        How many segments each contour has.
    around_a, around_b : (levels, s, 4) complex
        Control points of all contours, one after the other, at each level; each contour around its centre.
    centres_a, centres_b : (levels, contours) complex
        A's around the centre of the whole.
    turns : (levels, contours) float
        From A to B.
    """

    alignment: Alignment
    lengths: Sequence[int]
    around_a: ComplexArray
    around_b: ComplexArray
    centres_a: ComplexArray
    centres_b: ComplexArray
    turns: FloatArray

    @property
    def top(self) -> int:
        """The last level."""
        return len(self.turns) - 1

    def at(self, share: float, height: float, scale: float = 1.0) -> ComplexArray:
        """Control points of all contours at a place of the map, (s, 4) complex.

        The centres of contours go as in rigid motion; around its centre each contour turns by itself.
        """
        low = min(int(height), self.top)
        high = min(low + 1, self.top)
        f = height - low
        turn = (1.0 - f) * self.turns[low] + f * self.turns[high]
        placed = scale * self.alignment.scale**share * np.exp(1j * turn * share)
        of_a = placed * (1.0 - share)
        of_b = placed * share * np.exp(-1j * turn) / self.alignment.scale
        centre_a = (1.0 - f) * self.centres_a[low] + f * self.centres_a[high]
        centre_b = (1.0 - f) * self.centres_b[low] + f * self.centres_b[high]
        middle = (1.0 - share) * centre_a + share * self.alignment.undo(centre_b)
        centre = self.alignment.apply(scale * middle, share)
        a = (1.0 - f) * self.around_a[low] + f * self.around_a[high]
        b = (1.0 - f) * self.around_b[low] + f * self.around_b[high]
        of_a, of_b, centre = (np.repeat(values, self.lengths)[:, None] for values in (of_a, of_b, centre))
        return a * of_a + b * of_b + centre

    def split(self, segments: ComplexArray) -> list[ComplexArray]:
        """Control points contour by contour."""
        return np.split(segments, np.cumsum(self.lengths)[:-1])


@dataclass(frozen=True, slots=True, eq=False)
class Safe:
    """A way over the map of smoothed in-betweens.

    Attributes
    ----------
    map : Map
    times : (k,) float
        From 0 to 1, rising; evenly by how far the points go.
    shares, heights, scales : (k,) float
        At each of these times: how far from A to B, at which level, and how many times as large.
    """

    map: Map
    times: FloatArray
    shares: FloatArray
    heights: FloatArray
    scales: FloatArray

    def __post_init__(self) -> None:
        for name in ("times", "shares", "heights", "scales"):
            object.__setattr__(self, name, frozen(getattr(self, name), np.float64))

    @property
    def name(self) -> str:
        """As `--motion` has it."""
        return "safe"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Control points of each contour at time t."""
        share, height, scale = (
            float(np.interp(t, self.times, values)) for values in (self.shares, self.heights, self.scales)
        )
        return self.map.split(self.map.at(share, height, scale))


class Plan(NamedTuple):
    """A way over the map.

    Attributes
    ----------
    cost : float
        To be compared with that of other ways.
    way : sequence of (float, float)
        Places of the map.
    ground : Ground
    shape : ShapeBlend
    """

    cost: float
    way: Sequence[Place]
    ground: Ground
    shape: ShapeBlend

    @property
    def is_level(self) -> bool:
        """Whether nothing has to be smoothed."""
        return not any(height for _, height in self.way)


def plan(shape: ShapeBlend, alignment: Alignment, below: float = np.inf) -> Plan | None:
    """The way that smooths least.

    Parameters
    ----------
    shape : ShapeBlend
    alignment : Alignment
    below : float
        What the way may cost; a dearer one is of no use.

    Returns
    -------
    Plan or None
        None if a way has been searched for long enough, or would cost too much. One over what is not free has at
        least the cost `BLOCKED`.
    """
    levels_a, levels_b = (
        smoothed([getattr(contour, side) for contour in shape.contours]) for side in ("start", "end")
    )
    lengths = [len(contour.start.segments) for contour in shape.contours]
    around_a, centres_a = _centred(levels_a)
    around_b, centres_b = _centred(levels_b)
    turns = _turns(levels_a, levels_b, alignment.rotation)
    ground = Ground(
        Map(alignment, lengths, around_a, around_b, centres_a - alignment.centre_a, centres_b, turns),
        shape.contours,
    )
    found = None
    for _ in range(MOST_PLANS):
        way, cost = _cheapest(ground, below) or ([], np.inf)
        if not way:
            return found if below == np.inf else None
        found = Plan(cost, way, ground, shape)
        if not ground.close_steps(way):
            break
    return found


def safe(found: Plan) -> ShapeBlend:
    """The motion along a way, evened out: where outlines are smoothed their lines bend, but for those of polygons."""
    shape = found.shape
    places = np.array(found.way)
    if places[:, 1].any():
        contours = tuple(c._replace(start=_bent(c.start), end=_bent(c.end)) for c in shape.contours)
        shape = shape._replace(contours=contours)
        evened = _evened(places, found.ground)
        if _is_free(evened, found.ground, CLOSELY):
            places = evened
    return shape._replace(motion=_timed(found.ground.map, places, shape.contours))


def _centred(levels: list[list[ComplexArray]]) -> tuple[ComplexArray, ComplexArray]:
    """Control points of all contours around their centres, and the centres, as `Map` has them."""
    centres = np.array([[segments[:, 0].mean() for segments in level] for level in levels])
    lengths = [len(segments) for segments in levels[0]]
    around = np.array([np.concatenate(level) for level in levels])
    return around - np.repeat(centres, lengths, axis=1)[:, :, None], centres


def _turns(
    levels_a: list[list[ComplexArray]], levels_b: list[list[ComplexArray]], first: float
) -> FloatArray:
    """How far each contour turns from A to B at each level, (levels, contours) float.

    The outlines as they are turn together. By and by, the smoother they are, each contour turns by what takes it best
    from A to B, by least squares: on a circle that says which vertex is where.
    """
    share = np.arange(SAMPLES) / SAMPLES
    own = [np.full(len(levels_a[0]), first)]
    for level_a, level_b in zip(levels_a, levels_b, strict=True):
        found = []
        for a, b, before in zip(level_a, level_b, own[-1].tolist(), strict=True):
            p, q = (cubics.evaluate(z[:, None, :], share).ravel() for z in (a, b))
            weight = sum(np.abs(np.diff(z, append=z[:1])) for z in (p, q))
            p, q = p - p.mean(), q - q.mean()
            found.append(before + float(np.angle((weight * p.conj() * q).sum() * np.exp(-1j * before))))
        own.append(np.array(found))
    by_and_by = np.clip((np.arange(len(levels_a)) - TOGETHER) / (ALONE - TOGETHER), 0.0, 1.0)[:, None]
    return first + by_and_by * (np.array(own[1:]) - first)


class Ground:
    """How often in-betweens cross themselves; those that do no more often than A or B are free."""

    def __init__(self, whole: Map, contours: Sequence[ContourBlend]) -> None:
        self.map = whole
        numbers = counted(contours)
        self._lengths = [whole.lengths[k] for k in numbers]
        self._rows = np.repeat([k in numbers for k in range(len(contours))], whole.lengths)
        self._straight = np.concatenate([_bent(contours[k].start).straight for k in numbers])
        self._closed_contours = [contours[k].start.closed for k in numbers]
        ends = [[getattr(contours[k], side) for k in numbers] for side in ("start", "end")]
        self._most = max(path_crossings(outlines) for outlines in ends)
        self._known: dict[Place, int] = {}
        self._closed: set[tuple[Place, Place]] = set()

    def crossings(self, share: float, height: float) -> int:
        """Crossings of the in-between at a place, as far as they matter."""
        place = (share, height)
        if place not in self._known:
            segments = self.map.at(share, height)[self._rows]
            self._known[place] = chain_crossings(
                segments, self._straight, self._lengths, self._closed_contours, self._most + 1
            )
        return self._known[place]

    @property
    def has_been_searched(self) -> bool:
        """Whether so many places have been looked at that a way is hardly to be found."""
        return len(self._known) > MOST_PLACES

    def is_free(self, share: float, height: float) -> bool:
        """Whether the in-between at a place is free."""
        return self.crossings(share, height) <= self._most

    def is_open(self, start: Place, end: Place) -> bool:
        """Whether a step may be taken, as far as it is known: its end and its middle are free."""
        middle = 0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])
        return self.is_free(*end) and (start, end) not in self._closed and self.is_free(*middle)

    def close_steps(self, way: Sequence[Place]) -> bool:
        """Look closely at a way; steps that turn out not to be free are closed. Return whether there are such."""
        found = [
            (start, end)
            for start, end in pairwise(way)
            if self.is_open(start, end)
            and not all(self.is_free(*_on(start, end, share)) for share in CLOSELY)
        ]
        self._closed.update(found)
        return bool(found)


def _on(start: Place, end: Place, share: float) -> Place:
    return start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1])


def _cheapest(ground: Ground, below: float) -> tuple[list[Place], float] | None:
    """The cheapest way, by Dijkstra's algorithm, and its cost; None if there is none for less than `below`."""
    levels = ground.map.top + 1
    goal = (COLUMNS, 0)
    cost: dict[tuple[int, int], float] = {(0, 0): 0.0}
    before: dict[tuple[int, int], tuple[int, int]] = {}
    queue = [(0.0, 0, 0)]
    while queue and not ground.has_been_searched:
        spent, column, level = heapq.heappop(queue)
        here = (column, level)
        if spent > cost[here]:
            continue
        if spent >= below:
            return None
        if here == goal:
            break
        for right, up in ((1, 0), (1, 1), (1, -1), (0, 1), (0, -1), (1, 2), (1, -2)):
            there = (column + right, level + up)
            if not (there[0] <= COLUMNS and 0 <= there[1] < levels):
                continue
            height = (level + 0.5 * up) / levels
            total = spent + (ALONG + HIGH * height) * right / COLUMNS + CLIMB * abs(up) / levels
            # What is known to be reached for less is not asked for: asking is what takes time.
            if total >= cost.get(there, np.inf):
                continue
            if not ground.is_open(_place(here), _place(there)):
                total += BLOCKED
            # What A or B have of crossings is left behind soon.
            total += CROSSED * right / COLUMNS * (ground.crossings(*_place(there)) > 0)
            if total < cost.get(there, np.inf):
                cost[there] = total
                before[there] = here
                heapq.heappush(queue, (total, *there))
    if goal not in cost:
        return None
    way = [goal]
    while way[-1] in before:
        way.append(before[way[-1]])
    return [_place(node) for node in reversed(way)], cost[goal]


def _place(node: tuple[int, int]) -> Place:
    """Where a node of the plan is on the map."""
    return node[0] / COLUMNS, float(node[1])


def _evened(places: FloatArray, ground: Ground) -> FloatArray:
    """A way lifted off what is not free, and its corners cut, as far as it stays free; (k, 2) float."""
    for lift in LIFTS:
        lifted = places.copy()
        lifted[:, 1] += lift * np.minimum(places[:, 1] / 2.0, 1.0)
        lifted[:, 1] = np.minimum(lifted[:, 1], float(ground.map.top))
        if _is_free(lifted, ground, (0.0, 0.5)):
            places = lifted
            break
    for _ in range(SMOOTHINGS):
        cut = places.copy()
        cut[1:-1] = 0.25 * places[:-2] + 0.5 * places[1:-1] + 0.25 * places[2:]
        if not _is_free(cut, ground, (0.0, 0.5)):
            break
        places = cut
    return places


def _is_free(places: FloatArray, ground: Ground, shares: Sequence[float]) -> bool:
    """Whether the way through places is free, where it is looked at on each step."""
    steps = [places[:-1] + share * np.diff(places, axis=0) for share in shares]
    return all(ground.is_free(share, height) for share, height in np.concatenate(steps).tolist())


def _timed(whole: Map, places: FloatArray, contours: Sequence[ContourBlend]) -> Safe:
    """The motion along the way, its speed even, and its in-betweens scaled so as not to lose area."""
    shares, heights = places.T
    pictures = np.array([whole.at(share, height) for share, height in places.tolist()])
    closed = [k for k, contour in enumerate(contours) if contour.start.closed]
    contour_by_contour = [whole.split(picture) for picture in pictures]
    areas = np.array([abs(sum(cubics.signed_area(z[k]) for k in closed)) for z in contour_by_contour])
    line = (1.0 - shares) * areas[0] + shares * areas[-1]
    scales = np.ones(len(places))
    if min(areas[0], areas[-1]) > 0.0:
        scales = np.sqrt(np.clip(LEAST_AREA * line / np.maximum(areas, 1e-12 * line), 1.0, MOST_SCALE**2))
    for k in np.flatnonzero(scales > 1.0).tolist():
        pictures[k] = whole.at(shares[k], heights[k], scales[k])
    steps = np.sqrt((np.abs(np.diff(pictures, axis=0)) ** 2).mean(axis=(1, 2)))
    steps += LEVEL_TIME * float(np.std(pictures[0])) * np.abs(np.diff(heights))
    times = np.concatenate([[0.0], np.cumsum(steps)])
    times = times / times[-1] if times[-1] > 0.0 else shares
    return Safe(whole, times, shares, heights, scales)


def _bent(outline: CubicPath) -> CubicPath:
    if outline.straight.all():
        return outline
    return replace(outline, straight=np.zeros(len(outline.straight), np.bool_))
