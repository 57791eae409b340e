"""Outlines that are their own mirror image, and a match of two such that keeps them so on the way.

The least work does not know that two halves which mirror each other should do the same: a path may lead one way
through the left half and another way through the right one, and a smile becomes a frown by one corner of the mouth. So
where both outlines have an axis, and both axes run the same way, the ends of one become the ends of the other, and only
half of each outline is solved. The other half does the same in the mirror.

Not in the paper.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.geometry.polyline import cumulative_lengths, from_end_to_end, points_at
from shapeblend_cli.matching.solve import Search, diagonal_deviation, from_column_0, least_work
from shapeblend_cli.matching.work import Wire, Wires
from shapeblend_cli.model import Polygon
from shapeblend_cli.pairing.common_cuts import solve_with_common_cuts

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray
    from shapeblend_cli.pairing.common_cuts import FlatContour, Solved
    from shapeblend_cli.settings import Settings

SAMPLES = 128
"""An axis is looked for at so many points, evenly along the outline."""

TOLERANCE = 0.012
"""How far the mirror image of an outline may be from it, as a share of its size; and the mirror image of a node from
the node that it is, as a share of the outline's length."""

DIRECTIONS = (1j, 1.0)
"""Axes that are looked for besides the long and the short one of an outline: upright first."""

PARALLEL = 0.99
"""Cosine of the angle within which two axes run the same way."""

MOST, MORE = 1.4, 0.05
"""A match that keeps an outline its own mirror image may take so many times the least work, and a little more."""

NEAR, SAME = 0.3, 1e-9
"""A vertex nearer to a node than this share of the usual edge is left out; and shares of a half that are one."""


class Axis(NamedTuple):
    """An axis of a closed outline: its direction, and the places where the outline meets it, as shares of its length.

    The first end lies further in that direction. The other one is half the outline's length away.
    """

    direction: complex
    ends: tuple[float, float]


class Halves(NamedTuple):
    """A contour cut at places that mirror each other about an axis.

    `first` are the numbers of the vertices from the axis's first end to its other one, and `second` those of their
    mirror images, (k,) int each; both begin and end with the same.
    """

    flat: FlatContour
    first: IntArray
    second: IntArray


def solve_with_symmetry(
    a: FlatContour,
    b: FlatContour,
    turned: Callable[[Polygon], Polygon],
    solve: Callable[[FlatContour, FlatContour], Solved],
    settings: Settings,
) -> Solved | None:
    """Solve two contours that have an axis each, with common cuts, such that both halves do the same.

    Parameters
    ----------
    a, b : FlatContour
        In the same direction.
    turned : callable
        Returns B's polygons as they are solved, perhaps rotated back.
    solve : callable
        Finds the least work, whatever becomes of the axes.
    settings : Settings

    Returns
    -------
    a, b : FlatContour
        With all nodes of those given, and other vertices.
    correspondence : Correspondence
        Of these two. The lower bound is that of all matches, where it was looked for.

    None without such axes, or if it takes far more work than other matches.
    """
    axes = common_axes(a.polygon, turned(b.polygon)) if a.polygon.closed else None
    if axes is None:
        return None

    def solve_halves(p: FlatContour, q: FlatContour, near: IntArray | None = None) -> Solved:
        return _solve_halves((p, q), axes, turned, settings)

    cut_a, cut_b, found = solve_with_common_cuts(*solve_halves(a, b), solve_halves, settings.effort)
    least = solve(cut_a, cut_b)[2]
    if found.work > MOST * least.work + MORE:
        return None
    return cut_a, cut_b, replace(found, lower_bound=min(least.lower_bound, found.work))


def common_axes(a: Polygon, b: Polygon) -> tuple[Axis, Axis] | None:
    """Return an axis of each of two closed polygons that run the same way, the upright ones if they have such."""
    for first in _axes(a):
        for second in _axes(b, first.direction):
            return first, second
    return None


def _axes(polygon: Polygon, direction: complex | None = None) -> Iterator[Axis]:
    """Yield the axes of a closed polygon; with a direction only one that runs that way."""
    outline = from_end_to_end(polygon.vertices, closed=True)
    lengths = cumulative_lengths(outline)
    places = lengths / lengths[-1]
    even = np.arange(SAMPLES) / SAMPLES
    points = points_at(even, outline, places)
    middle = points.mean()
    for candidate in _directions(points - middle):
        along = candidate
        if direction is not None:
            cosine = (candidate * np.conj(direction)).real
            if abs(cosine) < PARALLEL:
                continue
            along = complex(candidate * np.sign(cosine))
        images = middle + along * along * (points - middle).conj()
        across = ((outline - middle) * np.conj(along)).imag
        at = np.flatnonzero((across[:-1] < 0.0) != (across[1:] < 0.0))
        met = places[at] + (places[at + 1] - places[at]) * across[at] / (across[at] - across[at + 1])
        off = [
            float(np.abs(points_at((2.0 * end - even) % 1.0, outline, places) - images).max()) for end in met
        ]
        if off and min(off) <= TOLERANCE * polygon.box.larger_side:
            end = float(met[int(np.argmin(off))])
            ends = np.array([end, (end + 0.5) % 1.0])
            ends = ends[np.argsort(-(points_at(ends, outline, places) * np.conj(along)).real)]
            yield Axis(along, (float(ends[0]), float(ends[1])))


def _directions(points: ComplexArray) -> list[complex]:
    """Return the directions in which points about their middle may have an axis."""
    moment = complex((points**2).mean())
    long = complex(np.exp(0.5j * np.angle(moment)))
    return [*DIRECTIONS, long, 1j * long]


def cut_in_halves(flat: FlatContour, axis: Axis) -> Halves:
    """Cut a closed contour where it meets an axis of it, and at places that mirror each other.

    All nodes stay vertices. A node is the mirror image of the node nearest to its own image, if that is near; else the
    other half gets a vertex there. Further vertices are those of the first half.
    """
    own = flat.lengths()[:-1]
    is_node = flat.polygon.parameter == 0.0
    ends = [_at_node(end, own[is_node]) for end in axis.ends]
    length = (ends[1] - ends[0]) % 1.0
    # How far each vertex is along each half, as a share of it; beyond 1 it is on the other one.
    along = np.stack([(own - ends[0]) % 1.0 / length, (ends[0] - own) % 1.0 / (1.0 - length)], axis=1)
    within = (along > SAME) & (along < 1.0 - SAME)
    nodes = [np.flatnonzero(is_node & within[:, side]) for side in (0, 1)]
    twins = _twins(*(along[some, side] for side, some in enumerate(nodes)))
    pairs = np.stack([nodes[0][twins[0]], nodes[1][twins[1]]], axis=1)
    known = np.stack([along[pairs[:, 0], 0], along[pairs[:, 1], 1]], axis=1)
    known = np.sort(np.concatenate([[[0.0, 0.0]], known, [[1.0, 1.0]]]), axis=0)

    def with_images(vertices: IntArray, side: int) -> tuple[IntArray, FloatArray]:
        """Return the numbers of vertices on both halves, -1 where there is none yet, and where they are."""
        places = along[vertices, side]
        images = np.interp(places, known[:, side], known[:, 1 - side])
        order = slice(None, None, -1 if side else 1)
        return (
            np.stack([vertices, np.full_like(vertices, -1)], axis=1)[:, order],
            np.stack([places, images], axis=1)[:, order],
        )

    rungs = [(pairs, np.stack([along[pairs[:, 0], 0], along[pairs[:, 1], 1]], axis=1))]
    rungs += [with_images(np.delete(nodes[side], twins[side]), side) for side in (0, 1)]
    taken = np.concatenate([[0.0, 1.0], *(places[:, 0] for _, places in rungs)])
    others = np.flatnonzero(~is_node & within[:, 0])
    others = others[np.abs(along[others, :1] - taken).min(axis=1) > NEAR / len(own)]
    rungs.append(with_images(others, 0))
    vertices, places = (np.concatenate(parts) for parts in zip(*rungs, strict=True))
    order = np.argsort(places[:, 0], kind="stable")
    vertices, places = vertices[order], places[order]
    at = (
        np.concatenate([ends, ends[0] + places[:, 0] * length, ends[0] - places[:, 1] * (1.0 - length)]) % 1.0
    )
    kept = np.concatenate([[_number(end, own) for end in ends], vertices[:, 0], vertices[:, 1]])
    return _halves(flat, at, kept.astype(np.intp))


def _at_node(place: float, nodes: FloatArray) -> float:
    """Return the place of the nearest node if that is near, else the place."""
    away = np.abs((nodes - place + 0.5) % 1.0 - 0.5)
    return float(nodes[away.argmin()]) if away.min() <= 0.5 * TOLERANCE else place


def _number(place: float, own: FloatArray) -> int:
    """Return the number of the vertex at a place, -1 if there is none."""
    return int(np.flatnonzero(own == place)[0]) if (own == place).any() else -1


def _twins(first: FloatArray, second: FloatArray) -> tuple[IntArray, IntArray]:
    """Return which places of two halves are nearest to each other, both ways, and near."""
    if not len(first) or not len(second):
        return np.zeros(0, np.intp), np.zeros(0, np.intp)
    away = np.abs(first[:, None] - second)
    partner = away.argmin(axis=1)
    number = np.arange(len(first))
    both = (away.argmin(axis=0)[partner] == number) & (away[number, partner] <= 2.0 * TOLERANCE)
    return number[both], partner[both]


def _halves(flat: FlatContour, places: FloatArray, kept: IntArray) -> Halves:
    """Cut a contour at places: both ends of an axis, rising on one half, and their images on the other one.

    `kept` are the numbers of vertices that are there already, else -1.
    """
    polygon = flat.polygon
    new = kept < 0
    points, segment, parameter = (
        np.where(new, 0, values[kept]) for values in (polygon.vertices, polygon.segment, polygon.parameter)
    )
    points[new], segment[new], parameter[new] = flat.points_between(places[new])
    order = np.argsort(np.where(new, places, flat.lengths()[kept]), kind="stable")
    number = np.empty(len(order), np.intp)
    number[order] = np.arange(len(order))
    half = (len(order) - 2) // 2
    begin, end, first, second = number[:1], number[1:2], number[2 : 2 + half], number[2 + half :]
    cut = Polygon(points[order], segment[order], parameter[order], True)
    return Halves(
        flat._replace(polygon=cut),
        np.concatenate([begin, first, end]),
        np.concatenate([begin, second, end]),
    )


def _solve_halves(
    flats: Sequence[FlatContour],
    axes: Sequence[Axis],
    turned: Callable[[Polygon], Polygon],
    settings: Settings,
) -> Solved:
    """Solve the first halves of two contours, end to end, and let the second ones do the same in the mirror.

    Return the contours cut in halves, and the correspondence. Its lower bound is 0, as other matches of the whole may
    take less work.
    """
    halves = [cut_in_halves(flat, axis) for flat, axis in zip(flats, axes, strict=True)]
    a, b = (half.flat for half in halves)
    whole = Wires(to_unit_box(a.polygon), to_unit_box(turned(b.polygon)), True, settings.constants)
    first = [
        Wire(*(points[half.first] for points in wire)) for wire, half in zip(whole.wires, halves, strict=True)
    ]
    found = least_work(Wires(first[0], first[1], False, settings.constants), Search(effort=settings.effort))
    back = found.dots[-2:0:-1]
    columns, rows = (
        np.concatenate([half.first[found.dots[:, k]], half.second[back[:, k]]])
        for k, half in enumerate(halves)
    )
    dots = from_column_0(np.stack([columns, rows], axis=1))
    price = whole.path_work(dots)
    mirrored = replace(
        found,
        dots=dots,
        closed=True,
        stretching=price.stretching,
        bending=price.bending,
        travel=price.travel,
        lower_bound=0.0,
        zero_angles=price.zero_angles,
        diagonal_deviation=diagonal_deviation(dots, whole.m, whole.n, True),
    )
    return a, b, mirrored
