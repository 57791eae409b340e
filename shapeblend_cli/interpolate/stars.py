"""Several drawings, all paired with the first: shapes with the same path commands in every drawing.

A contour of another drawing with a partner in the first is that contour's outline there; without a partner, it is a
point in all other drawings.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.cubics import lines
from shapeblend_cli.interpolate.contour_chains import (
    ContourChain,
    is_continued,
    joined_at_end,
    opened,
    reversed_chain,
)
from shapeblend_cli.interpolate.stacks import NOWHERE, stacked
from shapeblend_cli.model import (
    CubicPath,
    KeyframedShape,
    Name,
    PaintedShape,
    Pair,
    ShapeBlend,
    Style,
    control_box,
)
from shapeblend_cli.paint.names import common_groups
from shapeblend_cli.paint.styles import blend_styles

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ContourBlend, IntArray

    Place = tuple[int, int]  # numbers of a pair and of a shape in it
    Places = tuple[Place, ...]  # of shapes that are painted together
    Outline = list[CubicPath]  # of a contour in all drawings

SAME = 1e-6
"""Maximum distance of ends that meet, in units of the drawing."""

SPECK = 1e-4
"""Minimum length of a line whose direction is seen, as a share of the view: about two units of the last decimal."""

UPRIGHT = 3.0
"""Maximum difference of a corner from a right angle, or from none, that a square cap fills, in degrees."""


def star_shapes(pairs: Sequence[Pair]) -> list[KeyframedShape]:
    """Return shapes with a key for each drawing, given the pairs of the first drawing with each other one."""
    count = len(pairs) + 1
    of_first: dict[int, dict[int, list[tuple[Place, ContourBlend]]]] = {}
    alone: list[tuple[Place, ContourBlend]] = []
    for k, pair in enumerate(pairs):
        for s, shape in enumerate(pair.shapes):
            for contour in () if shape.is_twin else shape.contours:
                if contour.a is None:
                    alone.append(((k, s), contour))
                else:
                    pieces = of_first.setdefault(contour.a, {}).setdefault(k, [])
                    pieces.append(((k, s), contour))
    groups: dict[Places, list[Outline]] = {}
    hosts: dict[
        Place, tuple[float, Places]
    ] = {}  # of each place the largest contour, and the group that it is in
    for found in [found for pieces in of_first.values() for found in _whole_or_pieces(pieces)]:
        group = tuple(place for place, _ in found.values())
        groups.setdefault(group, []).extend(_through_all({k: c for k, (_, c) in found.items()}, count))
        for place, contour in found.values():
            size = max(contour.scale_a, contour.scale_b)
            hosts[place] = max(hosts.get(place, (0.0, group)), (size, group), key=lambda host: host[0])
    for place, contour in alone:
        group = hosts[place][1] if place in hosts else (place,)
        paths = [contour.start] * count
        paths[place[0] + 1] = contour.end
        groups.setdefault(group, []).append(paths)
    ordered = _in_order(list(groups), pairs)
    shapes = [_shape(group, groups[group], pairs) for group in ordered]
    return stacked(shapes, _places(ordered, pairs))


def _whole_or_pieces(
    found: dict[int, list[tuple[Place, ContourBlend]]],
) -> list[dict[int, tuple[Place, ContourBlend]]]:
    """Return a contour of the first drawing in each pair; if some pair cuts it, its pieces in one pair instead.

    Strokes that follow the edge of a fill are cut where that is, and have no partner.
    """
    if all(len(pieces) == 1 for pieces in found.values()):
        return [{k: pieces[0] for k, pieces in found.items()}]
    k = min(found)
    return [{k: piece} for piece in found[k]]


def _through_all(blends: dict[int, ContourBlend], count: int) -> list[Outline]:
    """Return a contour of the first drawing in all drawings; what cannot be one path in all is several contours.

    A closed contour that is opened in some pair is open in all, with its ends in one place.
    """
    (first, blend), *others = blends.items()
    chain = reversed_in_time(ContourChain.of(blend))
    numbers, alone = [first], []
    for k, blend in others:
        own, after = _as_open(chain, ContourChain.of(blend))
        if not is_continued(own, after):
            after = reversed_chain(after)
        if is_continued(own, after):
            chain = joined_at_end(own, after)
            numbers.append(k)
        elif blend.b is not None:
            alone.append(_alone(blend.end, k, count))
    *paths, here = (CubicPath(station, chain.straight, chain.closed) for station in chain.stations)
    by_number = dict(zip(numbers, paths, strict=True))
    return [[here, *(by_number.get(k, _as_point(here)) for k in range(count - 1))], *alone]


def _as_open(chain: ContourChain, after: ContourChain) -> tuple[ContourChain, ContourChain]:
    """Open the one of two contours that is closed if the other, which has the same outline, is not.

    The first has that outline at its end, and the second at its start.
    """
    if chain.closed and not after.closed:
        return opened(chain, after.start.segments[0, 0]), after
    if after.closed and not chain.closed:
        return chain, reversed_in_time(opened(reversed_in_time(after), chain.end.segments[0, 0]))
    return chain, after


def _alone(path: CubicPath, pair: int, count: int) -> Outline:
    """Return a contour that only the second drawing of a pair has."""
    outline = [_as_point(path)] * count
    outline[pair + 1] = path
    return outline


def _as_point(path: CubicPath) -> CubicPath:
    """Return a path of the same commands that is a point in its middle."""
    return CubicPath(np.full_like(path.segments, path.segments[:, 0].mean()), path.straight, path.closed)


def reversed_in_time(chain: ContourChain) -> ContourChain:
    """Return a contour from its last key to its first."""
    return chain._replace(stations=chain.stations[::-1], start=chain.end, end=chain.start)


def _in_order(groups: Sequence[Places], pairs: Sequence[Pair]) -> list[Places]:
    """Return groups about in paint order: the first drawing's in its order, others directly above what is below them.

    Shapes that are one in some pair and several in another make groups that share a place.
    """
    by_place: dict[Place, list[Places]] = {}
    for group in groups:
        for place in group:
            by_place.setdefault(place, []).append(group)
    ordered: list[Places] = []
    for k, pair in enumerate(pairs):
        below = -1
        for s in range(len(pair.shapes)):
            for group in by_place.get((k, s), ()):
                if group not in ordered:
                    ordered.insert(below + 1, group)
                below = ordered.index(group)
    return ordered


def _places(groups: Sequence[Places], pairs: Sequence[Pair]) -> IntArray:
    """Return the place of each group in the order of paint of each drawing."""
    places = np.full((len(groups), len(pairs) + 1), NOWHERE)
    twins = [{_ends(shape): s for s, shape in enumerate(pair.shapes) if shape.is_twin} for pair in pairs]
    for row, group in zip(places, groups, strict=True):
        for k, s in group:
            if k == 0:
                row[0] = s
            row[k + 1] = twins[k].get(_ends(pairs[k].shapes[s]), s)
    return places


def _ends(shape: ShapeBlend) -> tuple[tuple[int | None, int | None], ...]:
    """Return the numbers of the contours of a shape, which its twin has, too."""
    return tuple(contour.numbers for contour in shape.contours)


def _shape(group: Places, outlines: Sequence[Outline], pairs: Sequence[Pair]) -> KeyframedShape:
    blends = {k: pairs[k].shapes[s] for k, s in group}
    first = next(iter(blends.values()))
    keys = []
    for number in range(len(pairs) + 1):
        blend, end = blends.get(number - 1), 1
        if blend is None:
            blend, end = first, 0
        paths = [outline[number] for outline in outlines]
        style = _joined(paths, _style(blend, end))
        if style.reach and style.stroke_linejoin != "round":
            paths = [_without_specks(path, SPECK * pairs[0].views[0].larger_side) for path in paths]
        if not any(contour.lines[end] for contour in blend.contours):
            keys.append(_without_dots(paths, style))
        else:  # a line may be a dot
            keys.append(PaintedShape(tuple(paths), style))
    groups = first.groups
    for blend in blends.values():
        groups = common_groups(groups, blend.groups)
    name = Name.common([name for blend in blends.values() for name in blend.names] or [Name()])
    return KeyframedShape(tuple(keys), 0, ((),) * len(pairs), (), name, groups)


def _without_specks(path: CubicPath, least: float) -> CubicPath:
    """Return a path of straight lines whose shortest lines are points: rounded, they would turn, and have mitres."""
    if not path.straight.all():
        return path
    points = np.append(path.segments[:, 0], path.segments[-1, 3])
    kept = 0
    for k in range(1, len(points)):
        if abs(points[k] - points[kept]) < least:
            points[k] = points[kept]
        else:
            kept = k
    return CubicPath(lines(points, closed=False), path.straight, path.closed)


def _joined(paths: Sequence[CubicPath], style: Style) -> Style:
    """Return the paint of paths, all of whose ends meet if they are open: there caps stand for joins."""
    opened = [path for path in paths if not path.closed and control_box([path]).larger_side > SAME]
    are_whole = all(abs(path.segments[-1, 3] - path.segments[0, 0]) < SAME for path in opened)
    if style.stroke_linecap != "butt" or style.stroke_dasharray or not (style.reach and opened and are_whole):
        return style
    if style.stroke_linejoin == "round":
        return style._replace(stroke_linecap="round")
    if style.stroke_linejoin != "miter":
        return style
    turns = [abs(np.angle(_way(path, 0) / _way(path, -1), deg=True)) for path in opened]
    is_square = all(min(turn, abs(turn - 90.0)) < UPRIGHT for turn in turns)
    return style._replace(stroke_linecap="square") if is_square else style


def _way(path: CubicPath, number: int) -> complex:
    """Return the direction in which a path begins, or ends."""
    points = path.segments.ravel()[:: -1 if number else 1]
    other = points[np.abs(points - points[0]) > 1e-9][0]
    return complex(points[0] - other if number else other - points[0])


def _without_dots(paths: Sequence[CubicPath], style: Style) -> PaintedShape:
    """Return painted paths, of which points lie on the stroke of the others, if it is seen: caps make them dots."""
    drawn = [path.segments for path in paths if not path.is_point]
    if not drawn:
        return PaintedShape(tuple(paths), style._replace(stroke_width=0.0) if style.reach else style)
    if not style.reach or not style.stroke_opacity:
        return PaintedShape(tuple(paths), style)
    middles = np.concatenate(drawn) @ np.array([0.125, 0.375, 0.375, 0.125])

    def moved(path: CubicPath) -> CubicPath:
        nearest = middles[np.abs(middles - path.segments[0, 0]).argmin()]
        return CubicPath(np.full_like(path.segments, nearest), path.straight, path.closed)

    return PaintedShape(tuple(moved(path) if path.is_point else path for path in paths), style)


def _style(blend: ShapeBlend, end: int) -> Style:
    """Return the paint of a shape at an end; strokes with others in their place are not seen."""
    style = blend.style(end)
    if blend.fade is None or None not in blend.sources:
        return style
    return style.faded(blend.fade.share(float(end)))


def drawings_in(mixes: Sequence[Sequence[float]]) -> list[int]:
    """Return the numbers of the drawings that have a share in some mixture; of two at least.

    Examples
    --------
    >>> drawings_in([(0.5, 0.0, 0.5), (1.0, 0.0, 0.0)]), drawings_in([(0.0, 0.0, 1.0)])
    ([0, 2], [0, 2])
    """
    used = [k for k, weights in enumerate(zip(*mixes, strict=True)) if any(weights)]
    return used if len(used) > 1 else sorted({*used, 0 if used[0] else 1})


def mixed_shape(shape: KeyframedShape, weights: Sequence[float]) -> PaintedShape | None:
    """Return the mixture of a shape's keys by weights of sum 1; None if nothing of it is seen."""
    paths = []
    used = [key for key, weight in zip(shape.keys, weights, strict=True) if weight]
    is_dot = len(shape.keys[0].paths) == 1 and any(key.style.reach for key in used)
    for k, path in enumerate(shape.keys[0].paths):
        segments = np.zeros_like(path.segments)
        for key, weight in zip(shape.keys, weights, strict=True):
            if weight:
                segments = segments + weight * key.paths[k].segments
        mixed = CubicPath(segments, path.straight, path.closed)
        if is_dot or not all(key.paths[k].is_point for key in used):
            paths.append(mixed)
    if not paths:
        return None
    return PaintedShape(tuple(paths), mixed_style(shape, weights), None, shape.name, shape.groups)


def mixed_style(shape: KeyframedShape, weights: Sequence[float]) -> Style:
    """Return the mixture of the paint of a shape's keys."""
    mixed, total = shape.keys[0].style, 0.0
    for key, weight in zip(shape.keys, weights, strict=True):
        if not weight:
            continue
        total += weight
        share = weight / total
        above, below = blend_styles(mixed, key.style, share)
        # Gradients of two kinds do not mix.
        mixed = above if below is None else key.style if share >= 0.5 else mixed
    return mixed
