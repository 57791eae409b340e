"""Shapes of contours that are painted together: matched ones, and contours without a partner."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np

from shapeblend_cli.anatomy.decompose import HOLE, PlacedContour
from shapeblend_cli.geometry.polygons import orientation, signed_area, winding_numbers
from shapeblend_cli.geometry.polyline import nearest_places
from shapeblend_cli.model import Box, ContourBlend, Fade, Root, ShapeBlend, Style
from shapeblend_cli.pairing.changes import Change, unchanged
from shapeblend_cli.pairing.growth import (
    Carrier,
    MatchedPoints,
    growth_point_inside,
    growth_points,
    nearest_paired,
)
from shapeblend_cli.pairing.paint_order import Overlaps, paint_places
from shapeblend_cli.pairing.riders import Ride, ride
from shapeblend_cli.wires.contour_blends import grow_from_point

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair
    from shapeblend_cli.anatomy.twins import Mirror
    from shapeblend_cli.model import ComplexArray, Motion, Place

T = TypeVar("T")

SAME_AXIS = 0.02
"""Maximum distance of the axes of two drawings that are one, as a share of a drawing's diagonal."""

LEAST_PART_OF_HOLE = 1e-3
"""Minimum area of a part of a hole that is cut, as a share of the hole's area."""

COVERED = {None: None, 0: Fade(0.0, 0.1, comes=True), 1: Fade(0.9, 1.0, comes=False)}
"""Fades of strokes that have strokes of A, 0, or B, 1, in their places: at that end only the latter are seen, since no
stroke lies exactly on another."""


class Match(NamedTuple):
    """A pair of contours, and the blend between them."""

    pair: ContourPair
    blend: ContourBlend

    @property
    def group(self) -> _Group:
        """The group that it is painted with."""
        return _Group(self.pair[0].shape, self.pair[1].shape)

    @property
    def is_turned(self) -> bool:
        """Whether the contour of B was reversed to be matched, and maybe opened as well."""
        polygon, own = self.blend.polygon_b, self.pair[1].polygon
        if own.closed and not polygon.closed:
            return signed_area(polygon.vertices) * signed_area(own.vertices) < 0.0
        return orientation(polygon) == -orientation(own)

    def points(self, here: int) -> MatchedPoints:
        """Return the vertices that correspond, as seen from A, 0, or B, 1."""
        points = self.blend.dot_points()
        return MatchedPoints(points[here], points[1 - here])


class _Group(NamedTuple):
    """A group of contours that are painted together."""

    a: int | None  # index of its shape in A
    b: int | None  # index of its shape in B
    stroke_grows: bool = False  # from nothing, with the contours
    covered_in: int | None = None  # the drawing that has other strokes in its place: A, 0, or B, 1
    rides: bool = False  # on the edges of fills, as its contours do

    @property
    def sources(self) -> tuple[int | None, int | None]:
        """The shapes in A and B that are seen."""
        return None if self.covered_in == 0 else self.a, None if self.covered_in == 1 else self.b


class _Unmatched(NamedTuple):
    """A contour without a partner, the group that it is painted with, and the point from which it grows."""

    contour: PlacedContour
    group: _Group
    point: complex
    root: Root | None = None


def shape_blends(
    a: Sequence[PlacedContour],
    b: Sequence[PlacedContour],
    matches: Sequence[Match],
    changes: Sequence[Change] = (),
    riders: Sequence[Mapping[int, int]] = ({}, {}),
    overlaps: Sequence[Overlaps] | None = None,
) -> tuple[tuple[ShapeBlend, ...], list[Place]]:
    """Put together the contours of two drawings. Return shapes and their places in the order of paint.

    Contours of the same shape of A and the same shape of B are painted together. Contours without a partner grow from
    points: with their shape, unless they have a stroke, whose width must grow from 0. Changed shapes have the contours
    of their change. Riders, numbers of strokes with the numbers of fills for each drawing, follow the fills' edges. The
    overlaps of both drawings may be known.
    """
    groups: dict[_Group, tuple[list[ContourBlend], tuple[Style, Style], Motion | None]] = {}

    def add(
        group: _Group, blend: ContourBlend, styles: tuple[Style, Style], motion: Motion | None = None
    ) -> None:
        groups.setdefault(group, ([], styles, motion))[0].append(blend)

    for match in matches:
        add(match.group, match.blend, _styles(*match.pair))
    for change in changes:
        group = _Group(change.pair[0].shape, change.pair[1].shape)
        for contour in change.contours:
            add(group, contour, _styles(*change.pair), change.motion)
    for here, side in enumerate((a, b)):
        contours = unchanged(side, changes, here)
        riding = _rides(contours, (a, b)[1 - here], matches, riders[here], here)
        for stroke in riding:
            covered_in = None if stroke.shape is None else 1 - here
            group = _Group(*_from_a(stroke.contour.shape, stroke.shape, here), True, covered_in, True)
            add(group, stroke.blend, _from_a(stroke.contour.style, stroke.style, here))
        rides = {stroke.contour.number for stroke in riding}
        contours = [contour for contour in contours if contour.number not in rides]
        growing = _unmatched(_as_their_exteriors(contours, matches, here), matches, here)
        for loose, group, point, root in _mirrored(growing, (a, b), matches, here):
            nothing = loose.style._replace(stroke_width=0.0)
            blend = grow_from_point(loose, point, of_b=bool(here))._replace(root=root)
            add(group, blend, _from_a(loose.style, nothing, here))
    shapes = tuple(
        ShapeBlend(tuple(blends), *styles, motion, fade=COVERED[group.covered_in], sources=group.sources)
        for group, (blends, styles, motion) in groups.items()
    )
    sizes = [sum(c.polygon_a.box.area + c.polygon_b.box.area for c in shape.contours) for shape in shapes]
    overlaps = overlaps or (Overlaps(a), Overlaps(b))
    return shapes, paint_places([shape.sources for shape in shapes], sizes, overlaps)


def _from_a(own: T, other: T, here: int) -> tuple[T, T]:
    return (other, own) if here else (own, other)


def _rides(
    contours: Sequence[PlacedContour],
    there: Sequence[PlacedContour],
    matches: Sequence[Match],
    riders: Mapping[int, int],
    here: int,
) -> list[Ride]:
    """Return the strokes of A, 0, or B, 1, that ride on the edges of matched fills."""
    leaders = {match.pair[here].number: match.blend for match in matches}
    return [
        stroke
        for contour in contours
        if contour.number in riders
        for stroke in ride(contour, leaders[riders[contour.number]], here, there)
    ]


def _styles(a: PlacedContour, b: PlacedContour) -> tuple[Style, Style]:
    """Return the styles of a pair, with one fill rule if that paints both."""
    rules = {contour.style.fill_rule for contour in (a, b) if not contour.any_rule}
    rule = rules.pop() if len(rules) == 1 else None if rules else "nonzero"
    if rule is None:
        return a.style, b.style
    return a.style._replace(fill_rule=rule), b.style._replace(fill_rule=rule)


def _as_their_exteriors(
    contours: Sequence[PlacedContour], matches: Sequence[Match], here: int
) -> list[PlacedContour]:
    """Reverse the holes of exteriors that were reversed to be matched, or these would be no holes on the way."""
    if not here or all(contour.exterior is None for contour in contours):
        return [*contours]
    turned = {match.pair[1].number for match in matches if match.is_turned}
    return [contour.reversed() if contour.exterior in turned else contour for contour in contours]


def _unmatched(contours: Sequence[PlacedContour], matches: Sequence[Match], here: int) -> list[_Unmatched]:
    """Return the contours of A, 0, or B, 1, without a partner: exteriors and lines, then holes."""
    paired = {match.pair[here].number: match for match in matches}
    opened = {match.pair[here].opened for match in matches}
    contours = [contour for contour in contours if contour.number not in opened]
    outer = [match for match in matches if match.pair[here].role != HOLE]
    points = [match.points(here) for match in outer]
    bounds = np.array([Box.around(one.here).bounds for one in points])
    loose = [contour for contour in contours if contour.number not in paired and contour.role != HOLE]
    spots = {}
    if loose:
        carriers = [Carrier(match.pair[here], match.points(here)) for match in matches]
        spots = growth_points(loose, contours, carriers)
    growing: dict[int, _Unmatched] = {}
    for contour in loose:
        near = [k for k, match in enumerate(outer) if match.pair[here].shape == contour.shape]
        hole = _hole_around(contour, matches, here)
        point, root = spots[contour.number]
        if hole is not None:
            match, root, point = hole, None, growth_point_inside(contour.polygon.vertices, hole.points(here))
        elif near:
            k, _ = nearest_paired(contour.polygon.vertices, [points[k] for k in near], bounds[near])
            match = outer[near[k]]
        if (near or hole) and contour.style.stroke is None:
            group = match.group
        else:
            group = _Group(*_from_a(contour.shape, None, here), bool(contour.style.stroke))
        growing[contour.number] = _Unmatched(contour, group, point, root)
    holes = []
    for contour in contours:
        if contour.number in paired or contour.role != HOLE or contour.exterior is None:
            continue
        if contour.exterior in growing:
            holes.append(growing[contour.exterior]._replace(contour=contour))
            continue
        parts = _parts_of_hole(contour, contours, outer, here)
        if len(parts) > 1:
            holes += parts
            continue
        around = (match for match in outer if match.pair[here].contains_hole(contour))
        match = next(around, paired[contour.exterior])
        siblings = [other.points(here) for other in matches if other.pair[here].exterior == contour.exterior]
        point = growth_point_inside(contour.polygon.vertices, match.points(here), siblings)
        holes.append(_Unmatched(contour, match.group, point))
    return [*growing.values(), *holes]


def _parts_of_hole(
    hole: PlacedContour, contours: Sequence[PlacedContour], matches: Sequence[Match], here: int
) -> list[_Unmatched]:
    """Return the parts of a hole in the pieces that were cut from its exterior; they stay at the cuts."""
    pieces = [
        match for match in matches if match.pair[here].is_piece and match.pair[here].number == hole.exterior
    ]
    if len(pieces) < 2:
        return []
    from shapeblend_cli.pairing.split import hole_in_piece

    owner = next(contour for contour in contours if contour.number == hole.exterior)
    found = []
    for match in pieces:
        part = hole_in_piece(hole, match.pair[here], owner)
        if part is not None and part.area > LEAST_PART_OF_HOLE * hole.area:
            points = match.points(here)
            point = _place_on_edge(part, hole.centre, np.append(points.here, points.here[0]))
            there = np.append(points.there, points.there[0])
            at = complex(np.interp(point, np.arange(len(there)), there))
            found.append(_Unmatched(part, match.group, at))
    return found


def _place_on_edge(part: PlacedContour, middle: complex, line: ComplexArray) -> float:
    """Return the place on an outline, edge number plus share, where a part of a hole stays: on its longest cut edge.

    It is the one nearest to the middle of the hole that is not near an end of the edge, where corners are round. Of two
    edges that are about equally long it is where they meet.
    """
    from shapeblend_cli.pairing.split import AT_EDGE

    edges = part.contour.segments[part.contour.straight][:, [0, 3]]
    edges = edges[nearest_places(edges.mean(axis=1), line)[0] < AT_EDGE * part.size]
    if not len(edges):
        return float(nearest_places(np.array([middle]), line)[1][0])
    lengths = np.abs(edges[:, 1] - edges[:, 0])
    start, end = edges[lengths.argmax()]
    from_end = 0.0 if len(edges) > 1 and np.sort(lengths)[-2] > 0.5 * lengths.max() else 0.25
    share = ((middle - start) / (end - start)).real
    point = start + min(max(share, from_end), 1.0 - from_end) * (end - start)
    return float(nearest_places(np.array([point]), line)[1][0])


def _mirrored(
    growing: list[_Unmatched],
    sides: tuple[Sequence[PlacedContour], Sequence[PlacedContour]],
    matches: Sequence[Match],
    here: int,
) -> list[_Unmatched]:
    """Let outlines of A, 0, or B, 1, that mirror each other grow from points that do so; the drawings share an axis.

    These are the means of the two points and each other's mirror images. An outline that is its own mirror image grows
    from the axis. Points of holes stay: they lie in outlines.
    """
    outlines = [k for k, one in enumerate(growing) if one.contour.role != HOLE]
    if not outlines or not all(sides):
        return growing
    mirrors = [
        _mirror_of_paired(side, {match.pair[k].number for match in matches}) for k, side in enumerate(sides)
    ]
    own, other = mirrors[here], mirrors[1 - here]
    reach = SAME_AXIS * Box.union([contour.box for contour in sides[here]]).diagonal
    if own is None or other is None or abs(own.x - other.x) > reach:
        return growing
    at = {growing[k].contour.number: k for k in outlines}
    for k, contour in enumerate(sides[here]):
        if own.twin[k] == k and contour.number in at:
            one = growing[at[contour.number]]
            growing[at[contour.number]] = one._replace(point=complex(other.x, one.point.imag))
    for twins in own.twins(sides[here]):
        i, j = (at.get(sides[here][k].number) for k in twins)
        if i is not None and j is not None:
            left = 0.5 * (growing[i].point + 2.0 * other.x - growing[j].point.conjugate())
            growing[i] = growing[i]._replace(point=left)
            growing[j] = growing[j]._replace(point=2.0 * other.x - left.conjugate())
    return growing


def _mirror_of_paired(side: Sequence[PlacedContour], paired: set[int]) -> Mirror | None:
    """Return the axis of a drawing if all paired contours, by their numbers, have a mirror image; else None."""
    from shapeblend_cli.anatomy.twins import anatomy_of

    mirror = anatomy_of(side)[1]
    if mirror is None or any(
        contour.number in paired and twin is None for contour, twin in zip(side, mirror.twin, strict=True)
    ):
        return None
    return mirror


def _hole_around(contour: PlacedContour, matches: Sequence[Match], here: int) -> Match | None:
    """Return the smallest paired hole of the same shape around an exterior, if there is one."""
    vertex = contour.polygon.vertices[:1]
    around = [
        match
        for match in matches
        if (side := match.pair[here]).role == HOLE
        and side.shape == contour.shape
        and winding_numbers(vertex, side.polygon.vertices)[0]
    ]
    return min(around, key=lambda match: match.pair[here].size, default=None)
