"""Matched contours put together into shapes that are painted in one go, those without a partner among them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import HOLE, PlacedContour
from shapeblend_cli.geometry.polygons import centroid, winding_numbers
from shapeblend_cli.geometry.polyline import nearest_places, thin
from shapeblend_cli.model import Box, ContourBlend, Fade, ShapeBlend, Style
from shapeblend_cli.pairing.changes import Change, unchanged
from shapeblend_cli.pairing.growth import (
    WATCHED,
    MatchedPoints,
    carried,
    growth_point_inside,
    nearest_paired,
)
from shapeblend_cli.pairing.paint_order import paint_places
from shapeblend_cli.pairing.riders import Ride, ride
from shapeblend_cli.wires.contour_blends import grow_from_point

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair
    from shapeblend_cli.model import ComplexArray, Motion, Place

TOUCHING = 0.02
"""Maximum distance of contours that touch, as a share of the drawing's diagonal."""

LEAST_HOST = 0.5
"""Minimum area of a contour that carries another along, as a share of the other one's area."""

NEARLY_ALL = 0.9
"""Minimum share of points inside of a contour that lies in another."""

COVERED = {None: None, 0: Fade(0.0, 0.1, comes=True), 1: Fade(0.9, 1.0, comes=False)}
"""Fades of strokes that have strokes of A, 0, or B, 1, in their places: at that end only the latter are seen, since no
stroke lies exactly on another."""


class Match(NamedTuple):
    """A pair of contours, and the blend between them."""

    pair: ContourPair
    blend: ContourBlend

    @property
    def group(self) -> _Group:
        """The shapes it is painted with."""
        return _Group(self.pair[0].shape, self.pair[1].shape)

    def points(self, here: int) -> MatchedPoints:
        """Return the vertices that correspond, as seen from A, 0, or B, 1."""
        points = self.blend.dot_points()
        return MatchedPoints(points[here], points[1 - here])


class _Group(NamedTuple):
    """What is painted together: the shapes it comes from, and whether a stroke grows with it.

    Or the drawing that has other strokes in its place: A, 0, or B, 1.
    """

    a: int | None
    b: int | None
    stroke_grows: bool = False
    covered_in: int | None = None


class _Unmatched(NamedTuple):
    """A contour without a partner, what it is painted with, and the point it grows from."""

    contour: PlacedContour
    group: _Group
    point: complex


def shape_blends(
    a: Sequence[PlacedContour],
    b: Sequence[PlacedContour],
    matches: Sequence[Match],
    changes: Sequence[Change] = (),
    riders: Sequence[Mapping[int, int]] = ({}, {}),
) -> tuple[tuple[ShapeBlend, ...], list[Place]]:
    """Put together the contours of two drawings, and let those without a partner grow from points.

    Return shapes and their places in the order of paint. Contours are painted together if they come from the same shape
    of A and the same shape of B. What grows out of one of them is painted with it, unless it has a stroke, whose width
    must grow from nothing too. Shapes that are the same but for a change are as that has them. Strokes that ride on the
    edge of a fill go where the edge goes; `riders` has their numbers and that of the fill, for each drawing.
    """
    groups: dict[_Group, list[ContourBlend]] = {}
    styles: dict[_Group, tuple[Style, Style]] = {}
    for match in matches:
        groups.setdefault(match.group, []).append(match.blend)
        styles.setdefault(match.group, _styles(*match.pair))
    motions: dict[_Group, Motion | None] = {}
    for change in changes:
        group = _Group(change.pair[0].shape, change.pair[1].shape)
        groups[group], styles[group] = list(change.contours), _styles(*change.pair)
        motions[group] = change.motion
    for here, side in enumerate((a, b)):
        contours = unchanged(side, changes, here)
        riding = _rides(contours, (a, b)[1 - here], matches, riders[here], here)
        for stroke in riding:
            own, other = stroke.contour.shape, stroke.shape
            group = _Group(other, own) if here else _Group(own, other)
            group = group._replace(stroke_grows=True, covered_in=None if other is None else 1 - here)
            groups.setdefault(group, []).append(stroke.blend)
            both = stroke.contour.style, stroke.style
            styles.setdefault(group, both[::-1] if here else both)
        rides = {stroke.contour.number for stroke in riding}
        contours = [contour for contour in contours if contour.number not in rides]
        for contour, group, point in _unmatched(contours, matches, here):
            groups.setdefault(group, []).append(grow_from_point(contour, point, of_b=bool(here)))
            nothing = contour.style._replace(stroke_width=0.0)
            styles.setdefault(group, (nothing, contour.style) if here else (contour.style, nothing))
    keys = list(groups)
    shapes = [
        (None if key.covered_in == 0 else key.a, None if key.covered_in == 1 else key.b) for key in keys
    ]
    blends = tuple(
        ShapeBlend(
            tuple(groups[key]), *styles[key], motions.get(key), fade=COVERED[key.covered_in], sources=sources
        )
        for key, sources in zip(keys, shapes, strict=True)
    )
    sizes = [sum(c.polygon_a.box.area + c.polygon_b.box.area for c in shape.contours) for shape in blends]
    return blends, paint_places(shapes, sizes, a, b)


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
    """Return the styles of a pair, under one fill rule where one paints both."""
    rules = {contour.style.fill_rule for contour in (a, b) if not contour.any_rule}
    rule = rules.pop() if len(rules) == 1 else None if rules else "nonzero"
    if rule is None:
        return a.style, b.style
    return a.style._replace(fill_rule=rule), b.style._replace(fill_rule=rule)


def _unmatched(contours: Sequence[PlacedContour], matches: Sequence[Match], here: int) -> list[_Unmatched]:
    """Return the contours of A, 0, or B, 1, without a partner: exteriors and lines, then holes."""
    paired = {match.pair[here].number: match for match in matches}
    opened = {match.pair[here].opened for match in matches}
    contours = [contour for contour in contours if contour.number not in opened]
    outer = [match for match in matches if match.pair[here].role != HOLE]
    points = [match.points(here) for match in outer]
    loose = [contour for contour in contours if contour.number not in paired and contour.role != HOLE]
    spots = _growth_points(loose, contours, matches, here) if loose else {}
    growing: dict[int, _Unmatched] = {}
    for contour in loose:
        near = [k for k, match in enumerate(outer) if match.pair[here].shape == contour.shape]
        hole = _hole_around(contour, matches, here)
        point = spots[contour.number]
        if hole is not None:
            match, point = hole, growth_point_inside(contour.polygon.vertices, hole.points(here))
        elif near:
            k, _ = nearest_paired(contour.polygon.vertices, [points[k] for k in near])
            match = outer[near[k]]
        if (near or hole) and contour.style.stroke is None:
            group = match.group
        else:
            own = _Group(None, contour.shape) if here else _Group(contour.shape, None)
            group = own._replace(stroke_grows=bool(contour.style.stroke))
        growing[contour.number] = _Unmatched(contour, group, point)
    holes = []
    for contour in contours:
        if contour.number in paired or contour.role != HOLE or contour.exterior is None:
            continue
        if contour.exterior in growing:
            holes.append(growing[contour.exterior]._replace(contour=contour))
            continue
        around = (match for match in outer if match.pair[here].contains_hole(contour))
        match = next(around, paired[contour.exterior])
        siblings = [other.points(here) for other in matches if other.pair[here].exterior == contour.exterior]
        point = growth_point_inside(contour.polygon.vertices, match.points(here), siblings)
        holes.append(_Unmatched(contour, match.group, point))
    return [*growing.values(), *holes]


def _growth_points(
    loose: Sequence[PlacedContour], contours: Sequence[PlacedContour], matches: Sequence[Match], here: int
) -> dict[int, complex]:
    """Return the points that exteriors and lines without a partner grow from, by their numbers.

    What lies in another one without a partner grows from that one's point, as a part of it. All others grow from their
    middle, which is carried along by the paired contour it lies in, or else by one that they touch.
    """
    paired = {match.pair[here].number: match for match in matches}
    hosts = [c for c in contours if c.polygon.closed and (c.number in paired or c.role != HOLE)]
    touching = TOUCHING * Box.union([contour.box for contour in contours]).diagonal
    areas = {contour.number: contour.area for contour in contours}
    bounds = np.array([contour.box.bounds for contour in hosts]).reshape(-1, 4)
    outer = [match.points(here) for match in matches if match.pair[here].role != HOLE]
    spots: dict[int, complex] = {}
    # The largest first, so that what lies in another one comes after it.
    for contour in sorted(loose, key=lambda contour: (-areas[contour.number], contour.number)):
        vertices = contour.polygon.vertices
        middle = centroid(vertices) if contour.polygon.closed else _middle_of_line(vertices)
        left, top, right, bottom = bounds.T
        inside = (
            (left <= middle.real) & (middle.real <= right) & (top <= middle.imag) & (middle.imag <= bottom)
        )
        near = sorted((hosts[k] for k in np.flatnonzero(inside)), key=lambda host: areas[host.number])
        for host in near:
            match = paired.get(host.number)
            if match is None:
                if host.number in spots and _lies_in(contour, host, touching):
                    spots[contour.number] = spots[host.number]
                    break
            elif (
                areas[host.number] > LEAST_HOST * areas[contour.number]
                and winding_numbers(np.array([middle]), host.polygon.vertices).any()
            ):
                spots[contour.number] = carried(middle, match.points(here), inside=True)
                break
        else:
            k, distance = nearest_paired(vertices, outer) if outer else (0, touching)
            touches = distance < touching
            spots[contour.number] = carried(middle, outer[k], inside=False) if touches else middle
    return spots


def _lies_in(contour: PlacedContour, host: PlacedContour, distance: float) -> bool:
    """Return whether nearly all of a contour lies in another one, or no further from it than a distance."""
    points, outline = thin(contour.polygon.vertices, WATCHED), host.polygon.vertices
    inside = winding_numbers(points, outline) != 0
    near = nearest_places(points, np.append(outline, outline[0]))[0] <= distance
    return float((inside | near).mean()) >= NEARLY_ALL


def _middle_of_line(vertices: ComplexArray) -> complex:
    """Return the mean of a line's points."""
    lengths = np.abs(np.diff(vertices))
    return complex((lengths * (vertices[1:] + vertices[:-1])).sum() / (2.0 * lengths.sum()))


def _hole_around(contour: PlacedContour, matches: Sequence[Match], here: int) -> Match | None:
    """Return the smallest paired hole of the same shape in which an exterior is an island, if there is one."""
    vertex = contour.polygon.vertices[:1]
    around = [
        match
        for match in matches
        if (side := match.pair[here]).role == HOLE
        and side.shape == contour.shape
        and winding_numbers(vertex, side.polygon.vertices)[0]
    ]
    return min(around, key=lambda match: match.pair[here].size, default=None)
