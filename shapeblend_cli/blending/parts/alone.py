"""Parts without a partner: which of them leave early and come late, and by how much, and which go with pen lines."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import signed_area_of
from shapeblend_cli.geometry.polyline import are_near, nearest_places
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Box
from shapeblend_cli.motion.early import PIECES, SPEED, Early, Ride, points_of

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from shapeblend_cli.model import ComplexArray, ContourBlend, CubicPath, ShapeBlend
    from shapeblend_cli.motion.early import Numbers

    Path = TypeVar("Path", bound=CubicPath)

EARLY = 0.5
"""Share of the time by which a part without a partner is gone before the end, or comes after the start."""

COMES = 0.2
"""Share of the time by which a hole comes after the start in a shape that is plain, as does any part of what changes
little: late, it would be a speck in what is nearly drawn."""

LEAVES = 0.75
"""Share of the time by which the smallest part without a partner is gone before the end: shrunk, it would be a crumb in
another shape. It falls with the size, to `LEAST_LEAVES`."""

LEAST_LEAVES = 0.6
"""Minimum share of the time by which a part without a partner is gone before the end: shrunk, even a large one would be
a small picture of itself on another drawing, as the arms of a crab on a hen."""

APPEARS = 0.58
"""Share of the time by which the smallest part without a partner comes after the start to what changes much, when that
is near its own form. It falls with the size, to `LEAST_APPEARS`, and with the change."""

LEAST_APPEARS = 0.25
"""Minimum share of the time by which a part without a partner comes after the start to what changes much: a large one
would be a small picture of itself on another drawing."""

MOST_LEAVES = 0.5
"""Share of the time by which parts are gone before the end if most of a drawing has no partner and would be missed."""

MOST_COMES = 0.05
"""Share of the time by which such parts come after the start: they are specks for a moment only, and yet soon there."""

LARGE = 0.5
"""Size at which the time by which a part comes late would fall to none, as a share of the view's side."""

CHANGES = 0.1
"""Minimum mean distance that places of a shape move, beside its shift, for its parts to leave early, as a share of the
view."""

TOGETHER = 0.05
"""Maximum difference of the shares of parts that leave, or come, together: motions of few steps are small files."""

STIRS = 0.02
"""Minimum mean distance, in the same measure, for parts to leave early or come late by their size: in what stays as it
is they are read at any size."""

WATCHED = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Times at which parts without a partner are looked at, their own end among them."""

TOUCHING = 0.01
"""Maximum distance of outlines that touch, as a share of the view."""

ON_LINE = 0.55
"""Maximum distance of an outline from the centre of a line that it touches, in widths of the line."""

AFFORDABLE = 60
"""Maximum number of contours of a blend whose parts are looked at."""

DETAILS = 0.2
"""Maximum area of all details, as a share of that of a drawing: those that are most of it are no details."""

SAME = 0.5
"""Minimum size of a part in another one that goes with it whatever it is, in sizes of that: an eye in its outline."""

ALIKE = 3.0
"""Maximum ratio of the areas of parts that go together."""


def change_of(shapes: Sequence[ShapeBlend], side: float) -> float:
    """Return how far places of what has a partner move on average, beside its shift, as a share of the view's side.

    That is much, more than `CHANGES`, where it becomes another shape, and is not filled, for example.
    """
    pairs = [contour.dot_points() for shape in shapes for contour in shape.contours if contour.is_matched]
    ways = [b - a for a, b in pairs]
    return float(np.mean([np.abs(way - way.mean()).mean() for way in ways])) / side if ways else 0.0


def alone_in_the_way(shapes: Sequence[ShapeBlend], side: float) -> frozenset[Numbers]:
    """Return the parts without a partner that lie apart and yet come to be touched by what moves; in a view of a side.

    They would stand out of its edge then, as the rays of a sun that becomes a moon. Others like these go with them: of
    the same paint, and of about the same area.
    """
    fills = [shape for shape in shapes if shape.style_a.fill is not None and not shape.pace]
    contours = [contour for shape in fills for contour in shape.contours]
    if len(contours) > AFFORDABLE or not any(map(_is_alone, contours)):
        return frozenset()
    reach = TOUCHING * side
    moving: list[list[tuple[ComplexArray, Box]]] = []
    alone: list[tuple[ShapeBlend, ContourBlend, list[ComplexArray]]] = []
    for shape in fills:
        at = [paths_at(shape, t) for t in WATCHED]
        for k, contour in enumerate(shape.contours):
            outlines = [cubics.polyline(paths[k].segments, PIECES) for paths in at]
            if contour.is_matched:
                closed = [np.append(outline, outline[0]) for outline in outlines]
                moving.append([(outline, Box.around(outline).expanded(2.0 * reach)) for outline in closed])
            elif _is_alone(contour):
                alone.append((shape, contour, outlines))

    def touches(outline: ComplexArray, t: int) -> bool:
        box, there = Box.around(outline), [other[t] for other in moving]
        return any(around.overlaps(box) and are_near(outline, other, reach).any() for other, around in there)

    def is_met(contour: ContourBlend, outlines: list[ComplexArray]) -> bool:
        own = len(WATCHED) - 1 if contour.grows else 0
        between = range(1, len(WATCHED) - 1)
        return any(touches(outlines[t], t) for t in between) and not touches(outlines[own], own)

    met = [(shape, contour) for shape, contour, outlines in alone if is_met(contour, outlines)]
    found = {
        contour.numbers
        for shape, contour, _ in alone
        if any(_are_alike(shape, contour, *other) for other in met)
    }
    for _, contour, _ in alone:  # and what is inside, as a hole is
        around = contour.parents[contour.whole_at]
        if around is not None and contour.alone(around) in found:
            found.add(contour.numbers)
    return alone_in(shapes) & found


def _is_alone(contour: ContourBlend) -> bool:
    """Return whether a contour comes or goes at a point."""
    return not (contour.is_matched or contour.follows_edge)


def _are_alike(
    shape: ShapeBlend, contour: ContourBlend, other_shape: ShapeBlend, other: ContourBlend
) -> bool:
    """Return whether two contours come or go alike, have the same paint, and about the same area."""
    if contour.grows != other.grows or (shape.style_a, shape.style_b) != (
        other_shape.style_a,
        other_shape.style_b,
    ):
        return False
    areas = [_area_at(each, each.whole_at) for each in (contour, other)]
    return min(areas) * max(areas) > 0.0 and max(map(abs, areas)) <= ALIKE * min(map(abs, areas))


def alone_in(shapes: Sequence[ShapeBlend], detail: float = 0.0) -> frozenset[Numbers]:
    """Return the parts without a partner, but not where most of a drawing has none: that would be missed.

    There, only the parts up to a size, `detail`, if these are a small share of the drawing.
    """
    matched, alone, small = [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]
    for shape in shapes:
        for end, style in enumerate((shape.style_a, shape.style_b)):
            if style.fill is not None:
                rest = [c for c in shape.contours if not c.is_matched]
                matched[end] += abs(sum(_area_at(c, end) for c in shape.contours if c.is_matched))
                alone[end] += abs(sum(_area_at(c, end) for c in rest))
                small[end] += abs(sum(_area_at(c, end) for c in rest if _size(c) <= detail))
    # What is beside lines has no matched area.
    most = [
        np.inf
        if alone[end] < matched[end] or not matched[end]
        else detail
        if small[end] < DETAILS * (matched[end] + alone[end])
        else 0.0
        for end in (0, 1)
    ]
    contours = (contour for shape in shapes for contour in shape.contours)
    return frozenset(c.numbers for c in contours if _is_alone(c) and _size(c) <= most[c.whole_at])


def _area_at(contour: ContourBlend, end: int) -> float:
    """Return the signed area at the start, 0, or the end, 1; none where it is a point."""
    return signed_area_of(contour.polygon(end))


def early_shares(
    shapes: Sequence[ShapeBlend], parts: Collection[Numbers], are_changed: bool
) -> dict[Numbers, float]:
    """Return the shares of the time by which parts without a partner leave early, or come late.

    Parameters
    ----------
    shapes : sequence of ShapeBlend
    parts : collection of (int or None, int or None)
    are_changed : bool
        Whether what has a partner changes much.
    """
    contours = [contour for shape in shapes for contour in shape.contours]
    areas = {contour.b: signed_area_of(contour.polygon_b) for contour in contours if contour.is_matched}
    is_plain = not any(contour.shrinks for contour in contours)

    def is_soon(contour: ContourBlend) -> bool:
        is_hole = areas.get(contour.parents[1], 0.0) * _area_at(contour, contour.whole_at) < 0.0
        return contour.grows and ((is_hole and is_plain) or not are_changed)

    alone = [contour for contour in contours if contour.numbers in parts]
    return {contour.numbers: COMES if is_soon(contour) else EARLY for contour in alone}


def shares_by_size(
    shapes: Sequence[ShapeBlend], parts: Collection[Numbers], side: float, change: float
) -> dict[Numbers, float]:
    """Return the shares of the time by which parts without a partner leave early or come late, the small ones most.

    What lies in another part without a partner and is about as large, is a hole in it, or a stroke on its edge, goes
    with it. In a view of a side, in which what has a partner changes so much.
    """
    stirred = min(change / CHANGES, 1.0)
    alone: dict[Numbers, tuple[int, ContourBlend]] = {}
    for k, shape in enumerate(shapes):
        alone |= {c.numbers: (k, c) for c in shape.contours if c.numbers in parts}

    def fill_of(number: int, contour: ContourBlend) -> tuple[int, ContourBlend] | None:
        """Return the fill with which a stroke on its edge goes."""
        if contour.root is None or not shapes[number].is_stroke:
            return None
        body = alone.get(contour.alone(contour.root.body))
        return None if body is None or shapes[body[0]].is_stroke else body

    def share(number: int, contour: ContourBlend) -> float:
        fill = fill_of(number, contour)
        if fill is not None:
            return share(*fill)
        size = _size(contour)
        around = contour.parents[contour.whole_at]
        host = None if around is None else alone.get(contour.alone(around))
        if (
            host is not None
            and fill_of(*host) is None
            and (host[0] == number or size > SAME * _size(host[1]))
        ):
            return share(*host)
        if contour.grows:
            least = LEAST_APPEARS * stirred
            return max(least, APPEARS * stirred * (1.0 - size / (LARGE * side)))
        return max(LEAST_LEAVES, LEAVES * (1.0 - size / side))

    return _together({numbers: share(*found) for numbers, found in alone.items()})


def gone_at(contour: ContourBlend, share: float) -> ContourBlend:
    """Return a part without a partner as it is until it is gone, or from when it comes, at its share of the time.

    It ends, or begins, where what it is attached to is then.
    """
    whole, point = contour.path(contour.whole_at), contour.path(1 - contour.whole_at).segments[0, 0]
    place = contour.root.place if contour.root else whole.segments[:, 0].mean()
    return from_point(contour, complex(point + share * (place - point)))


def most_shares(shapes: Sequence[ShapeBlend]) -> dict[Numbers, float]:
    """Return the shares of the time by which the parts of a drawing leave or come if most of it has no partner."""
    contours = (contour for shape in shapes for contour in shape.contours)
    return {c.numbers: MOST_COMES if c.grows else MOST_LEAVES for c in contours if _is_alone(c)}


def _together(shares: Mapping[Numbers, float]) -> dict[Numbers, float]:
    """Return the shares of parts that leave, or come, with those at about the same time the same."""
    found: dict[Numbers, float] = {}
    for comes in (False, True):
        first = -1.0
        own = [part for part in shares if (part[0] is None) == comes]
        for part in sorted(own, key=lambda part: shares[part]):
            first = shares[part] if shares[part] > first + TOGETHER else first
            found[part] = first
    return found


def _size(contour: ContourBlend) -> float:
    """Return the larger side of its box where it is not a point."""
    return contour.polygon(contour.whole_at).box.larger_side


def with_early_parts(
    shapes: Sequence[ShapeBlend], parts: Mapping[Numbers, float], *, evenly: bool = False
) -> tuple[ShapeBlend, ...]:
    """Let parts without a partner leave before all others have become other shapes, and come after that.

    The parts have the shares of the time by which they do. Their areas, or else their lengths, change evenly.
    """
    found = []
    for shape in shapes:
        numbers = {c.numbers for c in shape.contours} & parts.keys()
        knots = _knots([c for c in shape.contours if c.numbers in numbers], parts) if evenly else ()
        found.append(shape._replace(motion=Early(shape.motion, parts, knots=knots)) if numbers else shape)
    return tuple(found)


def _knots(contours: Sequence[ContourBlend], parts: Mapping[Numbers, float]) -> tuple[float, ...]:
    """Return the times at which some parts, or the parts that they go with, change their speed."""
    shares = set()
    for contour in contours:
        shares.add((contour.grows, parts.get(contour.numbers, 0.0)))
        if contour.root:
            shares.add((contour.grows, parts.get(contour.alone(contour.root.body), 0.0)))
    sizes = [
        (grows, share + (1.0 - share) * own) for grows, share in shares if share for own in SPEED[0][:-1]
    ]
    return tuple(sorted(size if grows else 1.0 - size for grows, size in sizes))


def carried_by_lines(shapes: Sequence[ShapeBlend]) -> tuple[ShapeBlend, ...]:
    """Let parts without a partner that touch a pen line go with it, as the head of an arrow with its shaft.

    Parts that move straight only.
    """
    lines = [shape for shape in shapes if _is_line(shape)]
    found = []
    for shape in shapes:
        motion = Early(None, {}) if shape.motion is None else shape.motion
        if isinstance(motion, Early) and motion.motion is None and not _is_line(shape):
            alone = [contour for contour in shape.contours if _is_alone(contour)]
            rides = {contour.numbers: ride for contour in alone if (ride := _ride(contour, lines))}
            if rides:
                contours = tuple(_to_line(contour, rides) for contour in shape.contours)
                shape = shape._replace(contours=contours, motion=motion._replace(rides=rides))
        found.append(shape)
    return tuple(found)


def _is_line(shape: ShapeBlend) -> bool:
    """Return whether a shape is one stroke."""
    return len(shape.contours) == 1 and shape.is_stroke


def _ride(contour: ContourBlend, lines: Sequence[ShapeBlend]) -> Ride | None:
    """Return the place on the nearest line that a contour touches where it is whole."""
    here = contour.whole_at
    polygon, middle = contour.polygon(here), contour.path(here).segments[:, 0].mean()
    best: tuple[float, Ride] | None = None
    for line in lines:
        points = points_of(line, float(contour.grows))
        width = line.style(here).stroke_width
        (away,), (place,) = nearest_places(middle[None], points)
        between = min(
            nearest_places(polygon.line, points)[0].min(), nearest_places(points, polygon.line)[0].min()
        )
        if between <= ON_LINE * width and (best is None or away < best[0]):
            best = float(away), Ride(line, float(place))
    return best[1] if best else None


def _to_line(contour: ContourBlend, rides: Mapping[Numbers, Ride]) -> ContourBlend:
    """Return a contour that comes of its place on a line, or goes to it."""
    ride = rides.get(contour.numbers)
    if ride is None:
        return contour
    return from_point(contour, ride.at(1.0 - float(contour.grows)))


def from_point(contour: ContourBlend, there: complex) -> ContourBlend:
    """Return a contour that comes of a point, or goes to it."""
    if contour.grows:
        return contour._replace(
            contour_a=_all_at(contour.contour_a, there),
            polygon_a=replace(contour.polygon_a, vertices=np.array([there])),
            start=_all_at(contour.start, there),
        )
    return contour._replace(
        contour_b=_all_at(contour.contour_b, there),
        polygon_b=replace(contour.polygon_b, vertices=np.array([there])),
        end=_all_at(contour.end, there),
    )


def _all_at(path: Path, place: complex) -> Path:
    """Return a path that is a point, at another place."""
    return replace(path, segments=np.full_like(path.segments, place))
