"""Outlines that are their own mirror image, and a match of two such that keeps them so on the way.

The least work does not know that two halves which mirror each other should do the same: a path may lead one way
through the left half and another way through the right one, and a smile becomes a frown by one corner of the mouth. So
where both outlines have an axis, and both axes run the same way, the ends of one become the ends of the other, and only
half of each outline is solved. The other half does the same in the mirror. Where both have two axes, at right angles,
it is a quarter. A line has an axis if its second half is the mirror image of its first.

Not in the paper.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polyline import (
    cumulative_lengths,
    interpolated,
    nearest_numbers,
    points_at,
)
from shapeblend_cli.matching.solve import Search, least_work, priced
from shapeblend_cli.model import Polygon
from shapeblend_cli.wires.common_cuts import refine
from shapeblend_cli.wires.contour_match import Solved

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapeblend_cli.geometry.flat_contour import FlatContour
    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.model import ComplexArray, Correspondence, FloatArray, IntArray
    from shapeblend_cli.wires.contour_match import ContourMatch

    Path = tuple[FloatArray, FloatArray]  # shares of the first parts of two contours that correspond

SAMPLES = 128
"""Number of points, evenly along an outline, that are compared to recognise an axis."""

TOLERANCE = 0.02
"""Maximum distance of an outline from its mirror image, as a share of its size; and of a node from the mirror image of
another node, as a share of the outline's length."""

EVERY = 8
"""Number of points for each one that is compared first."""

AT_ONCE = 512
"""Number of places where an outline meets a line that are compared at once: an outline may have thousands."""

DIRECTIONS = (1j, 1.0)
"""Directions of axes besides the long and the short one of an outline: upright first."""

PARALLEL = 0.99
"""Minimum cosine of the angle between axes that run the same way."""

SQUARE = 1e-6
"""Maximum cosine of the angle between axes at right angles."""

MOST = 1.4
"""Maximum work of a match that keeps an outline its own mirror image, as a multiple of the least work."""

NEAR = 0.3
"""Minimum distance of a vertex from all nodes, as a share of the mean edge, to be kept."""

SAME = 1e-9
"""Maximum difference of shares of a part that are one."""

POINT = 1e-12
"""Maximum distance of vertices in one place, as a share of the outline's size."""


class Axis(NamedTuple):
    """An axis of an outline: its direction, and the places where the outline meets it, as shares of its length.

    The first end lies further in that direction, the second half a round away. A line has one end, in the middle.
    """

    direction: complex
    ends: tuple[float, ...]

    def reversed(self) -> Axis:
        """Return the same axis seen from its other end."""
        return Axis(-self.direction, self.ends[::-1])


class Part(NamedTuple):
    """A half or a quarter of an outline, from one end to the other, forwards, 1, or backwards, -1."""

    begin: float
    end: float
    way: int

    def shares(self, places: FloatArray) -> FloatArray:
        """Return the distances of places from the beginning of the part, as shares of it; beyond 1 in another part."""
        return (self.way * (places - self.begin)) % 1.0 / self.length

    def places(self, shares: FloatArray) -> FloatArray:
        """Return places on the outline."""
        return (self.begin + self.way * shares * self.length) % 1.0

    @property
    def length(self) -> float:
        """Its share of the outline."""
        return (self.way * (self.end - self.begin)) % 1.0


class Parts(NamedTuple):
    """A contour cut at places that mirror each other about its axes.

    For each part the numbers of its vertices, (k,) int, both ends included. The first part goes forwards.
    """

    flat: FlatContour
    vertices: Sequence[IntArray]

    def around(self, along: IntArray) -> IntArray:
        """Return the vertices along the whole outline, given those along each part, by their places in it."""
        if not self.flat.polygon.closed:
            first, second = self.vertices
            return np.concatenate([first[along[::-1]], second[along[1:]]])
        # Every second part is gone through from its end, so that each begins where the one before it ends.
        order = (0, 1) if len(self.vertices) == 2 else (0, 2, 3, 1)
        return np.concatenate(
            [self.vertices[part][along[:-1] if k % 2 == 0 else along[:0:-1]] for k, part in enumerate(order)]
        )


class CutsMeet(Exception):
    """Two places where a contour was to be cut are one."""


def solve_with_symmetry(match: ContourMatch) -> Solved | None:
    """Solve two contours that have an axis each, with common cuts, such that both halves do the same.

    None without such axes, if cuts of the halves meet, or if that takes far more work than other matches.
    """
    axes = common_axes(match.a.polygon, match.rotated_back(match.b.polygon))
    if not axes:
        return None
    axes_a, axes_b = zip(*axes, strict=True)
    found: dict[tuple[bytes, ...], Correspondence] = {}
    path: Path | None = None

    def solve_part(
        p: FlatContour, q: FlatContour, near: IntArray | None = None, known: float = np.inf
    ) -> Solved:
        nonlocal path
        parts = cut_in_parts(p, axes_a), cut_in_parts(q, axes_b)
        flats = parts[0].flat, parts[1].flat
        cuts = tuple(
            some.tobytes() for side in parts for some in (side.flat.polygon.vertices, *side.vertices)
        )
        if cuts not in found:
            near_by = path if len(found) > 1 else None  # without common cuts a path shows too little
            found[cuts], path = _solve_parts(parts, match.wires(*flats), match.settings.effort, near_by)
        return Solved(*flats, found[cuts])

    try:
        solved = refine(solve_part(match.a, match.b), solve_part)
    except CutsMeet:
        return None
    return match.unless_far_more(solved, MOST)


def common_axes(a: Polygon, b: Polygon) -> list[tuple[Axis, Axis]]:
    """Return the axes of two polygons that run the same way: one of each, two at right angles, or none.

    Upright axes come before others.
    """
    axes_b = list(_axes(b))
    if not axes_b:
        return []
    common = [
        (axis, other if cosine > 0.0 else other.reversed())
        for axis in _axes(a)
        for other in axes_b
        if abs(cosine := (axis.direction * np.conj(other.direction)).real) >= PARALLEL
    ]
    square = [
        pair for pair in common if abs((pair[0].direction * np.conj(common[0][0].direction)).real) < SQUARE
    ]
    return common[:1] + square[:1] if a.closed else common[:1]


def _axes(polygon: Polygon) -> Iterator[Axis]:
    """Yield the axes of a polygon; the axes of an open polygon take each half to the other."""
    closed, tolerance = polygon.closed, TOLERANCE * polygon.box.larger_side
    outline = polygon.line
    lengths = cumulative_lengths(outline)
    places = lengths / lengths[-1]
    even = np.arange(SAMPLES) / SAMPLES if closed else np.linspace(0.0, 1.0, SAMPLES)
    points = points_at(even, outline, places)
    middle = points.mean()
    for along in _directions(points - middle):
        images = middle + along * along * (points - middle).conj()
        if not closed:
            if np.abs(points[::-1] - images).max() <= tolerance:
                yield Axis(along, (0.5,))
            continue
        across = ((outline - middle) * np.conj(along)).imag
        is_left = across < 0.0
        at = (is_left[:-1] != is_left[1:]).nonzero()[0]
        met = places[at] + (places[at + 1] - places[at]) * across[at] / (across[at] - across[at + 1])
        few = (2.0 * met[:, None] - even[::EVERY]) % 1.0  # which rule out most places
        met = met[np.abs(points_at(few, outline, places) - images[::EVERY]).max(axis=1) <= tolerance]
        if not len(met):
            continue
        away = [
            np.abs(points_at((2.0 * some[:, None] - even) % 1.0, outline, places) - images).max(axis=1)
            for some in (np.array_split(met, 1 + len(met) // AT_ONCE) if len(met) > AT_ONCE else [met])
        ]
        off = np.concatenate(away)
        if off.min() <= tolerance:
            end = float(met[int(off.argmin())])
            ends = np.array([end, (end + 0.5) % 1.0])
            ends = ends[np.argsort(-(points_at(ends, outline, places) * np.conj(along)).real)]
            yield Axis(along, (float(ends[0]), float(ends[1])))


def _directions(points: ComplexArray) -> list[complex]:
    """Return the directions in which points about their middle may have an axis."""
    moment = complex((points**2).mean())
    long = complex(np.exp(0.5j * np.angle(moment)))
    return [*DIRECTIONS, long, 1j * long]


def cut_in_parts(flat: FlatContour, axes: Sequence[Axis]) -> Parts:
    """Cut a contour where it meets one or two axes of it, and at places that mirror each other.

    All nodes stay vertices. A node of one part is the mirror image of the nearest node of another part, if it is near;
    else that part gets a vertex. Further vertices come from the first part.

    CutsMeet is raised where a vertex would be in the place of another.
    """
    own = flat.shares[: len(flat.polygon.vertices)]
    is_node = flat.polygon.parameter == 0.0
    ends = [_at_node(end, own[is_node]) for axis in axes for end in axis.ends]
    if not flat.polygon.closed:
        ends += [0.0, 1.0]
    parts = _parts(ends, flat.polygon.closed)
    shares = np.stack([part.shares(own) for part in parts], axis=1)
    within = (shares > SAME) & (shares < 1.0 - SAME)

    # A row for each place: the numbers of the vertices that mirror each other, -1 where there is none yet, and where
    # on each part they are.
    vertices = np.zeros((0, len(parts)), np.intp)
    places = np.zeros((0, len(parts)))
    for part in range(len(parts)):
        nodes = (is_node & within[:, part]).nonzero()[0]
        rows, twins = _twins(places[:, part], shares[nodes, part])
        vertices[rows, part] = nodes[twins]
        places[rows, part] = shares[nodes[twins], part]
        # What has no twin there keeps between those that have.
        alone = vertices[:, part] < 0
        known = _ladder(places[~alone])
        places[alone, part] = np.interp(places[alone, 0], known[:, 0], known[:, part])
        vertices, places = _with_images(vertices, places, np.delete(nodes, twins), part, shares)
    others = (~is_node & within[:, 0]).nonzero()[0]
    taken = np.concatenate([[0.0, 1.0], places[:, 0]])
    away = np.abs(shares[others, 0] - taken[nearest_numbers(taken, shares[others, 0])])
    others = others[away > NEAR / (parts[0].length * len(own))]
    vertices, places = _with_images(vertices, places, others, 0, shares)
    order = np.argsort(places[:, 0], kind="stable")
    at = [part.places(places[order, k]) for k, part in enumerate(parts)]
    return _cut(flat, ends, parts, at, vertices[order])


def _at_node(place: float, nodes: FloatArray) -> float:
    """Return the place of the nearest node if that is near, else the place."""
    away = np.abs((nodes - place + 0.5) % 1.0 - 0.5)
    return float(nodes[away.argmin()]) if away.min() <= 0.5 * TOLERANCE else place


def _parts(ends: Sequence[float], closed: bool) -> list[Part]:
    """Return the parts between the ends of one or two axes, each a mirror image of the first one or that turned.

    Of a line these are the place in the middle, its beginning and its end.
    """
    if not closed:
        middle, begin, end = ends
        return [Part(middle, begin, -1), Part(middle, end, 1)]
    front, back = ends[:2]
    if len(ends) == 2:
        return [Part(front, back, 1), Part(front, back, -1)]
    after, before = ends[2:] if (ends[2] - front) % 1.0 < 0.5 else ends[:1:-1]
    return [Part(front, after, 1), Part(front, before, -1), Part(back, after, -1), Part(back, before, 1)]


def _ladder(places: FloatArray) -> FloatArray:
    """Return places that correspond on all parts, rising, both ends among them."""
    ends = np.array([[0.0], [1.0]]) * np.ones(places.shape[1])
    return np.sort(np.concatenate([places, ends]), axis=0)


def _with_images(
    vertices: IntArray, places: FloatArray, new: IntArray, part: int, shares: FloatArray
) -> tuple[IntArray, FloatArray]:
    """Add rows for vertices of one part that have no mirror images yet; between the others' they have places."""
    known = _ladder(places)
    rows = np.full((len(new), places.shape[1]), -1, np.intp)
    rows[:, part] = new
    own = shares[new, part]
    images = np.empty(rows.shape)
    for other in range(rows.shape[1]):
        images[:, other] = own if other == part else interpolated(own, known[:, part], known[:, other])
    return np.concatenate([vertices, rows]), np.concatenate([places, images])


def _twins(first: FloatArray, second: FloatArray) -> tuple[IntArray, IntArray]:
    """Return the numbers of places in two lists that are nearest to each other, both ways, and near."""
    if not len(first) or not len(second):
        return np.zeros(0, np.intp), np.zeros(0, np.intp)
    partner, number = nearest_numbers(second, first), np.arange(len(first))
    near = np.abs(first - second[partner]) <= 2.0 * TOLERANCE
    both = (nearest_numbers(first, second)[partner] == number) & near
    return number[both], partner[both]


def _cut(
    flat: FlatContour, ends: Sequence[float], parts: Sequence[Part], at: Sequence[FloatArray], kept: IntArray
) -> Parts:
    """Cut a contour at the ends of parts and at places on each; kept are the numbers of vertices already there."""
    polygon, own = flat.polygon, flat.shares[: len(flat.polygon.vertices)]
    places = np.concatenate([ends, *at])
    at_ends = [(own == end).nonzero()[0] for end in ends]
    vertex = np.concatenate([[found[0] if len(found) else -1 for found in at_ends], kept.T.ravel()]).astype(
        np.intp
    )
    new = vertex < 0
    points, segment, parameter = (
        np.where(new, 0, values[vertex]) for values in (polygon.vertices, polygon.segment, polygon.parameter)
    )
    points[new], segment[new], parameter[new] = flat.points_at(places[new])
    order = np.argsort(np.where(new, places, own[vertex]), kind="stable")
    number = np.empty(len(order), np.intp)
    number[order] = np.arange(len(order))
    inner = number[len(ends) :].reshape(len(parts), -1)
    first, last = (
        [number[ends.index(end)] for end in some] for some in zip(*(part[:2] for part in parts), strict=True)
    )
    cut = Polygon(points[order], segment[order], parameter[order], polygon.closed)
    line = cut.line
    if np.abs(line[1:] - line[:-1]).min() <= POINT * cut.box.larger_side:
        raise CutsMeet
    return Parts(
        replace(flat, polygon=cut),
        [np.concatenate([[first[k]], inner[k], [last[k]]]) for k in range(len(parts))],
    )


def _solve_parts(
    parts: tuple[Parts, Parts], whole: Wires, effort: str, path: Path | None
) -> tuple[Correspondence, Path]:
    """Solve the first parts of two contours, end to end, and let the others do the same in the mirror.

    If a path through these parts with other vertices is known, only paths near that are searched, unless the effort is
    `exact`. The lower bound is 0, as other matches of the whole may take less work. The path that is found is returned,
    too.
    """
    first = [side.vertices[0] for side in parts]
    along = [cumulative_lengths(side.flat.polygon.vertices[k]) for side, k in zip(parts, first, strict=True)]
    shares = [lengths / lengths[-1] for lengths in along]
    near = None
    if path is not None and effort != "exact":
        partners = interpolated(interpolated(shares[0], *path), shares[1], np.arange(float(len(shares[1]))))
        near = np.round(partners).astype(np.intp)
    found = least_work(whole.along(*first), Search(effort=effort, near=near))
    dots = np.stack([side.around(found.dots[:, k]) for k, side in enumerate(parts)], axis=1)
    passed = shares[0][found.dots[:, 0]], shares[1][found.dots[:, 1]]
    return priced(whole, dots, found.sweeps), passed
