"""The one place that joins the stages: read, flatten, normalise, match, interpolate, write.

`blend` works on values and touches no file.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.clock import Clock
from shapeblend_cli.easing import frame_times
from shapeblend_cli.geometry.placement import place_over
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.interpolate.paths import between, with_curves
from shapeblend_cli.model import (
    Box,
    Correspondence,
    CubicPath,
    Drawing,
    Frame,
    PaintedShape,
    Pair,
    Polygon,
    ShapeBlend,
)
from shapeblend_cli.motion.alignment import align, matched_points
from shapeblend_cli.motion.choose import RotatedShape, choose_motion, is_as_good, try_straight
from shapeblend_cli.motion.rotation import is_turned, turn_between
from shapeblend_cli.paint.styles import blend_styles, painted_as
from shapeblend_cli.pairing.constraints import Constraints, check_stiff, constraints_for, given_pairs, pinned
from shapeblend_cli.pairing.decompose import PlacedContour, decompose, main_orientation
from shapeblend_cli.pairing.matching import choose_direction, match_contours, part_of
from shapeblend_cli.pairing.pair import pair_contours
from shapeblend_cli.pairing.shapes import Match, shape_blends
from shapeblend_cli.settings import Settings
from shapeblend_cli.views import view_of, views_with_room

ROUNDS = 5
"""How often a shape is aligned and matched again, at most; two or three are enough."""

SAME_ANGLE = 2e-3
"""An angle stays that changes by less, in radians."""

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import ArrayLike

    from shapeblend_cli.motion.alignment import Alignment


def blend(a: Drawing, b: Drawing, settings: Settings) -> tuple[Pair, list[Frame]]:
    """Match two drawings and make the frames between them.

    Raises
    ------
    InputError
        A drawing in which nothing can be blended; its file is named.
    MatchError
        Starts, pins, bands, pairs and stiff regions that do not fit the outlines.
    """
    (pair,), _ = match_all([a, b], settings)
    return pair, make_frames([pair], settings)


def correspond(
    p0: ArrayLike, p1: ArrayLike, closed: bool = True, settings: Settings | None = None
) -> Correspondence:
    """Find the least-work correspondence of two polygons, without any SVG.

    Parameters
    ----------
    p0, p1 : (m,) and (n,) complex
        Vertices, ``x + 1j * y``, in any unit; the first is not repeated at the end. Each polygon is scaled to the
        unit box (section 3.3).
    closed : bool
        Open polygons correspond end to end.
    settings : Settings, optional
        Its start, pins, reverse, stiff, solver, band, effort and constants count; points are those of `p0` and `p1`.

    Returns
    -------
    Correspondence
        Its dots number the vertices as they were given, also where `p1` was gone through backwards.

    Raises
    ------
    ValueError
        Vertices that are not finite, neighbours that coincide, or too few.
    MatchError
        Starts, pins, bands and stiff regions that do not fit the polygons.

    Examples
    --------
    The triangle and the square of figures 23 and 24:

    >>> found = correspond([0, 1j, 1], [0, 1j, 1 + 1j, 1])
    >>> len(found.dots), round(found.stretching, 4), found.gap
    (4, 2.1421, 0.0)
    """
    a, b = _given_polygon(p0, closed), _given_polygon(p1, closed)
    settings = settings or Settings()
    constraints = Constraints(settings.start, settings.pins)
    check_stiff([a], settings)
    backwards, found = choose_direction(a, b, settings, constraints, None, alone=True)
    if not backwards:
        return found
    # Backwards a closed polygon keeps its first vertex, and an open one begins at its last.
    last = len(b.vertices) - (0 if closed else 1)
    vertices = (last - found.dots[:, 1]) % len(b.vertices)
    return replace(found, dots=np.stack([found.dots[:, 0], vertices], axis=1))


def _given_polygon(points: ArrayLike, closed: bool) -> Polygon:
    """A polygon whose segments are its vertices' numbers."""
    vertices = np.array(points, np.complex128)
    least = 3 if closed else 2
    if vertices.ndim != 1 or len(vertices) < least:
        raise ValueError(f"a polygon is a list of {least} or more complex numbers")
    if not np.isfinite(vertices).all():
        raise ValueError("a vertex is not finite")
    if (np.diff(vertices) == 0.0).any() or (closed and vertices[0] == vertices[-1]):
        raise ValueError(
            "neighbouring vertices coincide; leave out repetitions, also of the first vertex at the end"
        )
    return Polygon(vertices, np.arange(len(vertices)), np.zeros(len(vertices)), closed)


def match_all(
    drawings: Sequence[Drawing],
    settings: Settings,
    clock: Clock | None = None,
    watch: Callable[[float], None] | None = None,
) -> tuple[list[Pair], list[str]]:
    """Blend drawings, each with the next one: everything up to the first frame.

    Parameters
    ----------
    drawings : sequence of Drawing
        Two or more; all are laid over the first.
    settings : Settings
    clock : Clock, optional
        Measures the stages `flatten`, `match` and `interpolate`.
    watch : callable, optional
        Called now and then with the share of the matching that is done, from 0 to 1.

    Returns
    -------
    pairs : list of Pair
    notes : list of str
        What was left out, one phrase each.
    """
    clock = clock or Clock()
    placed, notes = _place(drawings, settings)
    check_stiff([part.polygon for part in placed[0].parts], settings)
    clock.lap("flatten")
    pairs = []
    for number, (a, b) in enumerate(pairwise(placed)):
        shapes = _blend_shapes(a, b, settings, clock, part_of(watch, number, len(placed) - 1))
        pairs.append(Pair(number, number + 1, shapes, drawn=(a.drawn, b.drawn), views=(a.view, b.view)))
        clock.lap("interpolate")
    views = views_with_room(pairs)
    return [pair._replace(views=(views[pair.a], views[pair.b])) for pair in pairs], notes


class _PlacedDrawing(NamedTuple):
    """A drawing, the map that lays it over the first, and laid there its contours, what it paints, and its view."""

    drawing: Drawing
    to_a: Similarity
    parts: list[PlacedContour]
    drawn: tuple[PaintedShape, ...]
    view: Box


def _place(drawings: Sequence[Drawing], settings: Settings) -> tuple[list[_PlacedDrawing], list[str]]:
    """Lay all drawings over the first, and take them apart into flattened contours."""
    first = drawings[0]
    placed: list[_PlacedDrawing] = []
    notes: list[str] = []
    way = None
    for number, drawing in enumerate(drawings):
        to_a = place_over(first, drawing, settings.place) if number else Similarity()
        parts, left_out = decompose(drawing, to_a, settings.vertices, way)
        way = way or main_orientation([part.polygon for part in parts])
        drawn = as_drawn(drawing, to_a)
        viewbox = first.viewbox if settings.place == "bbox" else drawing.viewbox and to_a.box(drawing.viewbox)
        placed.append(_PlacedDrawing(drawing, to_a, parts, drawn, view_of(drawn, viewbox)))
        notes += left_out
    return placed, notes


def _blend_shapes(
    a: _PlacedDrawing,
    b: _PlacedDrawing,
    settings: Settings,
    clock: Clock,
    watch: Callable[[float], None] | None,
) -> tuple[ShapeBlend, ...]:
    """Pair the contours of two drawings, match each pair, and choose how shapes move."""
    rotation = None if settings.motion == "linear" else _rotation(a.parts, b.parts)
    matching = _pair_contours(a, b, settings, rotation or 0.0, clock)
    shapes = _match(matching, rotation or 0.0, watch)
    if rotation is not None and not is_turned([contour for shape in shapes for contour in shape.contours]):
        rotation = None
        matching = _pair_contours(a, b, settings, 0.0, clock)
        shapes = _match(matching, 0.0, watch)
    moved = _choose_motions(matching, shapes, is_rotated=rotation is not None)
    clock.lap("interpolate")
    return moved


def _rotation(a: Sequence[PlacedContour], b: Sequence[PlacedContour]) -> float | None:
    """Return by what angle the largest contour of B is that of A rotated, if it is."""
    return turn_between(*(max(parts, key=lambda part: part.size).polygon for parts in (a, b)))


class _Matching(NamedTuple):
    """The contours of two drawings that are paired, and all that matching them takes."""

    a: _PlacedDrawing
    b: _PlacedDrawing
    couples: list[tuple[PlacedContour, PlacedContour]]
    constraints: list[Constraints]
    settings: Settings
    clock: Clock

    def match(self, number: int, rotation: float, watch: Callable[[float], None] | None = None) -> Match:
        """Match one of the couples, with B rotated back by an angle."""
        a, b = self.couples[number]
        alone = len(self.couples) == 1
        blend = match_contours(a, b, self.settings, self.constraints[number], watch, rotation, alone=alone)
        return Match(a, b, blend._replace(seconds=self.clock.lap("match")))


def _pair_contours(
    a: _PlacedDrawing, b: _PlacedDrawing, settings: Settings, rotation: float, clock: Clock
) -> _Matching:
    """Pair the contours of two drawings, with B rotated back by an angle."""
    pins = pinned(a.parts, b.parts, settings, b.to_a)
    given = given_pairs((a.drawing, b.drawing), (a.parts, b.parts), settings)
    couples = _couples(a.parts, b.parts, settings, given + [found.pair for found in pins], rotation)
    clock.lap("match")
    largest = max(couples, key=lambda couple: couple[0].size)
    constraints = [
        constraints_for(couple, settings, pins, is_largest=couple is largest) for couple in couples
    ]
    return _Matching(a, b, couples, constraints, settings, clock)


def _match(
    matching: _Matching, rotation: float, watch: Callable[[float], None] | None
) -> tuple[ShapeBlend, ...]:
    """Match all couples, and put them together to shapes, with the contours that grow or shrink."""
    count = len(matching.couples)
    matches = [matching.match(k, rotation, part_of(watch, k, count)) for k in range(count)]
    shapes = shape_blends(matching.a.parts, matching.b.parts, matches)
    styled = tuple(_in_style(shape, matching.settings.style) for shape in shapes)
    matching.clock.lap("match")
    return styled


def _match_again(matching: _Matching, shape: ShapeBlend, rotation: float) -> ShapeBlend:
    """Match the contours of a shape for another angle by which B is rotated back."""
    matching.clock.lap("interpolate")
    numbers: dict[tuple[int | None, int | None], int] = {
        (a.number, b.number): k for k, (a, b) in enumerate(matching.couples)
    }
    contours = [
        matching.match(numbers[contour.a, contour.b], rotation).blend
        if (contour.a, contour.b) in numbers
        else contour
        for contour in shape.contours
    ]
    return shape._replace(contours=tuple(contours))


def _choose_motions(
    matching: _Matching, shapes: Sequence[ShapeBlend], *, is_rotated: bool
) -> tuple[ShapeBlend, ...]:
    """Choose how shapes move; what is to move otherwise than straight is matched again first."""
    settings = matching.settings
    times = frame_times(settings.frames, settings.ends, settings.ease)
    common = None
    if settings.motion != "linear" and (is_rotated or len(shapes) > 1):
        common = align(matched_points([contour for shape in shapes for contour in shape.contours]))
    straight = [_with_curves(shape, settings) for shape in shapes]
    rotation = common.turn if is_rotated and common else None
    moved = []
    for matched, trial in zip(shapes, try_straight(straight, settings.motion, times, rotation), strict=True):
        if trial.is_settled:
            moved.append(trial.shape)
            continue
        if is_rotated and common:
            rotated = RotatedShape(trial.shape, common)
        else:
            again, alignment = _rotated_back(matching, matched, common)
            rotated = RotatedShape(_with_curves(again, settings), alignment)
        moved.append(choose_motion(trial, settings.motion, rotated, times))
    return tuple(moved)


def _rotated_back(
    matching: _Matching, shape: ShapeBlend, common: Alignment | None
) -> tuple[ShapeBlend, Alignment]:
    """Align a shape and match it again, with B rotated back so, until the angle stays."""
    own = align(matched_points(shape.contours))
    if common is not None and is_as_good(common, own, shape):
        return _match_again(matching, shape, common.turn), common
    for _ in range(ROUNDS):
        angle = own.turn
        shape = _match_again(matching, shape, angle)
        own = align(matched_points(shape.contours))
        if abs(own.turn - angle) < SAME_ANGLE:
            break
    return shape, own


def _with_curves(shape: ShapeBlend, settings: Settings) -> ShapeBlend:
    """Return a shape that moves between the drawings' own curves, unless polygons are asked for."""
    if not settings.curves:
        return shape
    return shape._replace(contours=tuple(map(with_curves, shape.contours)))


def _couples(
    a: Sequence[PlacedContour],
    b: Sequence[PlacedContour],
    settings: Settings,
    given: Sequence[tuple[int, int]],
    turn: float,
) -> list[tuple[PlacedContour, PlacedContour]]:
    """The pairs of contours, found with B turned back by an angle about its largest one, which is laid over A's."""
    if not turn:
        return pair_contours(a, b, settings, given)
    in_a, in_b = (max(parts, key=lambda part: part.size).polygon.vertices.mean() for parts in (a, b))
    back = Similarity.rotation(-turn, about=in_b, onto=in_a)
    there = Similarity.rotation(turn, about=in_a, onto=in_b)
    couples = pair_contours(a, [part.transformed(back) for part in b], settings, given)
    own = {part.number: part for part in b}
    return [
        (one, other.transformed(there) if other.is_piece else own[other.number]) for one, other in couples
    ]


def _in_style(shape: ShapeBlend, style: str) -> ShapeBlend:
    """A shape painted as the settings say; one without a partner keeps its own paint."""
    if all(c.a is None for c in shape.contours) or all(c.b is None for c in shape.contours):
        return shape
    style_a, style_b = painted_as(shape.style_a, shape.style_b, style)
    return shape._replace(style_a=style_a, style_b=style_b)


def as_drawn(drawing: Drawing, over: Similarity) -> tuple[PaintedShape, ...]:
    """What a drawing paints, laid over the first."""
    return tuple(
        PaintedShape(
            tuple(CubicPath(over.points(c.segments), c.straight, c.closed) for c in shape.contours),
            over.style(shape.style),
        )
        for shape in drawing.shapes
    )


def make_frames(pairs: Sequence[Pair], settings: Settings) -> list[Frame]:
    """Make the in-betweens of all pairs, and with `settings.ends` the drawings, in order of time."""
    frames = []
    for pair in pairs:
        times = frame_times(settings.frames, settings.ends, settings.ease)
        if settings.ends and pair.a:
            times = times[1:]  # the pair before has ended with this one's start
        as_drawn = settings.curves and settings.style == "blend"
        frames += [frame_at(pair, t, as_drawn=as_drawn) for t in times]
    return frames


def shapes_at(pair: Pair, t: float) -> tuple[PaintedShape, ...]:
    """The shapes of a pair at time t, command for command alike at all times; what has no partner ends as a point."""
    return tuple(
        PaintedShape(
            between(shape, t),
            *blend_styles(shape.style_a, shape.style_b, t),
        )
        for shape in pair.shapes
    )


def frame_at(pair: Pair, t: float, *, as_drawn: bool) -> Frame:
    """The frame at time t; at t = 0 and t = 1 it may be the drawing itself."""
    view = pair.views[0].interpolate(pair.views[1], t)
    if t not in (0.0, 1.0):
        return Frame(t, pair.a, shapes_at(pair, t), view)
    return Frame(t, pair.a, pair.drawn[int(t)] if as_drawn else _without_points(pair, t), view)


def _without_points(pair: Pair, t: float) -> tuple[PaintedShape, ...]:
    """Return the shapes at an end of time, but for contours that are a point there."""
    found = []
    for blend, shape in zip(pair.shapes, shapes_at(pair, t), strict=True):
        paths = tuple(
            path
            for contour, path in zip(blend.contours, shape.paths, strict=True)
            if not (contour.shrinks if t else contour.grows)
        )
        if paths:
            found.append(shape._replace(paths=paths))
    return tuple(found)
