"""The one place that joins the stages: read, flatten, normalise, match, interpolate, write.

`blend` works on values and touches no file.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.clock import Clock
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.normalise import Similarity, lay_over
from shapeblend_cli.geometry.outline import curve_crossings
from shapeblend_cli.interpolate.paths import between, waypoints
from shapeblend_cli.interpolate.styles import blend_styles, painted_as
from shapeblend_cli.interpolate.times import frame_times
from shapeblend_cli.model import (
    Box,
    Correspondence,
    CubicPath,
    Drawing,
    Frame,
    MatchedShape,
    PaintedShape,
    Pair,
    Polygon,
    Style,
)
from shapeblend_cli.motion.choose import Chooser, Chosen
from shapeblend_cli.motion.turned import is_turned, turn_between
from shapeblend_cli.pairing.join import join, least_work_either_way, part_of
from shapeblend_cli.pairing.pair import pair_parts
from shapeblend_cli.pairing.parts import Part, main_way, take_apart, turned_parts
from shapeblend_cli.pairing.shapes import Joint, matched_shapes
from shapeblend_cli.pairing.wishes import Wishes, check_stiff, given_pairs, pinned, wishes_for
from shapeblend_cli.settings import Settings

MARGIN = 0.02
"""Room around what a drawing without a viewBox paints, as a share of its larger side."""

SLACK = 1e-9
"""What sticks out of a viewBox by less than this share of its size does so by rounding."""

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import ArrayLike


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
    wishes = Wishes(settings.start, settings.pins)
    check_stiff([a], settings)
    backwards, found = least_work_either_way(a, b, settings, wishes, None, alone=True)
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
    """Find the correspondences of drawings, each with the next one: everything up to the first frame.

    Parameters
    ----------
    drawings : sequence of Drawing
        Two or more; all are laid over the first.
    settings : Settings
    clock : Clock, optional
        Told of the stages `flatten`, `match` and `interpolate`.
    watch : callable, optional
        Told now and then which share of the matching is done, from 0 to 1.

    Returns
    -------
    pairs : list of Pair
    notes : list of str
        What was left out, one phrase each.
    """
    clock = clock or Clock()
    first = drawings[0]
    laid: list[_Laid] = []
    notes: list[str] = []
    way = None
    for number, drawing in enumerate(drawings):
        over = place_over(first, drawing, settings.place) if number else Similarity()
        parts, left_out = take_apart(drawing, over, settings.vertices, way)
        way = way or main_way([part.polygon for part in parts])
        drawn = as_drawn(drawing, over)
        viewbox = first.viewbox if settings.place == "bbox" else over.box(drawing.viewbox)
        laid.append(_Laid(drawing, over, parts, drawn, view_of(drawn, viewbox)))
        notes += left_out
    check_stiff([part.polygon for part in laid[0].parts], settings)
    clock.lap("flatten")
    pairs = []
    for number, (a, b) in enumerate(pairwise(laid)):
        chosen = _matched(a, b, settings, clock, part_of(watch, number, len(laid) - 1))
        pairs.append(
            Pair(
                number,
                number + 1,
                shapes=tuple(one.matched for one in chosen),
                moving=tuple(one.moving for one in chosen),
                reasons=tuple(one.because for one in chosen),
                drawn=(a.drawn, b.drawn),
                views=(a.view, b.view),
            )
        )
        clock.lap("interpolate")
    return _with_room(pairs), notes


def _with_room(pairs: list[Pair]) -> list[Pair]:
    """Pairs that show what leaves the views of both drawings on its way between them.

    A drawing that ends one pair and begins the next has the same view in both.
    """
    views = [pairs[0].views[0], *(pair.views[1] for pair in pairs)]
    for pair in pairs:
        reach = _reach(pair)
        for k in (pair.a, pair.b):
            if reach is not None and not views[k].contains(reach):
                views[k] = Box.union([views[k], reach])
    return [pair._replace(views=(views[pair.a], views[pair.b])) for pair in pairs]


def _reach(pair: Pair) -> Box | None:
    """The box around what does not go straight and leaves the views of both drawings, if any does."""
    boxes = []
    for shape in pair.moving:
        for point in waypoints(shape):
            painted = _painted(point.paths, shape.style_a, shape.style_b)
            if not _is_inside(painted, pair.views[0].interpolate(pair.views[1], point.t)):
                boxes.append(_with_margin(painted))
    return Box.union(boxes) if boxes else None


class _Laid(NamedTuple):
    """A drawing, what lays it over the first, and laid there its contours, what it paints, and what to show of it."""

    drawing: Drawing
    over: Similarity
    parts: list[Part]
    drawn: tuple[PaintedShape, ...]
    view: Box


def _matched(
    a: _Laid, b: _Laid, settings: Settings, clock: Clock, watch: Callable[[float], None] | None
) -> list[Chosen]:
    """Pair the contours of two drawings, find the correspondence of each pair, and choose how shapes move."""
    turned = None if settings.motion == "linear" else _turn(a.parts, b.parts)
    shapes, rematch = _match(a, b, settings, clock, watch, turned or 0.0)
    if turned is not None and not is_turned([contour for shape in shapes for contour in shape.contours]):
        turned = None
        shapes, rematch = _match(a, b, settings, clock, watch, 0.0)
    times = frame_times(settings.frames, settings.ends, settings.ease)
    chooser = Chooser(settings.motion, settings.curves, times, rematch, turned)
    chosen = chooser.choose(shapes)
    clock.lap("interpolate")
    return chosen


def _turn(a: Sequence[Part], b: Sequence[Part]) -> float | None:
    """By what angle the largest contour of B is that of A turned, if it is."""
    return turn_between(*(max(parts, key=lambda part: part.size).polygon for parts in (a, b)))


def _match(
    a: _Laid,
    b: _Laid,
    settings: Settings,
    clock: Clock,
    watch: Callable[[float], None] | None,
    turn: float,
) -> tuple[tuple[MatchedShape, ...], Callable[[MatchedShape, float], MatchedShape]]:
    """Pair the contours of two drawings and find the correspondence of each pair, with B turned back by an angle.

    Returns
    -------
    shapes : tuple of MatchedShape
    rematch : callable
        Solves the correspondences of a shape anew for another angle.
    """
    pins = pinned(a.parts, b.parts, settings, b.over)
    given = given_pairs((a.drawing, b.drawing), (a.parts, b.parts), settings)
    couples = _couples(a.parts, b.parts, settings, given + [found.pair for found in pins], turn)
    clock.lap("match")
    largest = max(couples, key=lambda couple: couple[0].size)
    wishes = [wishes_for(couple, settings, pins, is_largest=couple is largest) for couple in couples]
    alone = len(couples) == 1
    joints = []
    for run, couple in enumerate(couples):
        watched = part_of(watch, run, len(couples))
        matched = join(*couple, settings, wishes[run], watched, turn, alone=alone)
        joints.append(Joint(*couple, matched._replace(seconds=clock.lap("match"))))
    shapes = tuple(_in_style(shape, settings.style) for shape in matched_shapes(a.parts, b.parts, joints))
    runs = {(joint.matched.a, joint.matched.b): run for run, joint in enumerate(joints)}

    def rematch(shape: MatchedShape, other: float) -> MatchedShape:
        clock.lap("interpolate")
        contours = []
        for contour in shape.contours:
            run = runs.get((contour.a, contour.b))
            if run is not None:
                solved = join(*couples[run], settings, wishes[run], None, other, alone=alone)
                contour = solved._replace(seconds=clock.lap("match"))
            contours.append(contour)
        return shape._replace(contours=tuple(contours))

    clock.lap("match")
    return shapes, rematch


def _couples(
    a: Sequence[Part],
    b: Sequence[Part],
    settings: Settings,
    given: Sequence[tuple[int, int]],
    turn: float,
) -> list[tuple[Part, Part]]:
    """The pairs of contours, found with B turned back by an angle about its largest one, which is laid over A's."""
    if not turn:
        return pair_parts(a, b, settings, given)
    onto, about = (max(parts, key=lambda part: part.size).polygon.vertices.mean() for parts in (a, b))
    couples = pair_parts(a, turned_parts(b, -turn, about, onto), settings, given)
    own = {part.number: part for part in b}
    return [
        (one, turned_parts([other], turn, onto, about)[0] if other.is_piece else own[other.number])
        for one, other in couples
    ]


def _in_style(shape: MatchedShape, style: str) -> MatchedShape:
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
            shape.style.moved(*over),
        )
        for shape in drawing.shapes
    )


def view_of(drawn: Sequence[PaintedShape], viewbox: Box | None) -> Box:
    """What part of the plane to show of a drawing: its viewBox and what it paints outside; without one, what it paints.

    Where drawings are laid by their own boxes, the viewBox of the first stands in for the others'.
    """
    painted = Box.union([_painted(shape.paths, shape.style) for shape in drawn])
    if viewbox is None:
        return _with_margin(painted)
    return viewbox if _is_inside(painted, viewbox) else Box.union([viewbox, _with_margin(painted)])


def _painted(outlines: Sequence[CubicPath], *styles: Style) -> Box:
    """The box around outlines, painted in the widest of some styles."""
    reach = max(style.stroke_width / 2.0 if style.stroke else 0.0 for style in styles)
    return Box.union([cubics.bounds(outline.segments).expanded(reach) for outline in outlines])


def _with_margin(painted: Box) -> Box:
    return painted.expanded(MARGIN * painted.larger_side)


def _is_inside(painted: Box, view: Box) -> bool:
    return view.contains(painted, SLACK * view.larger_side)


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


def place_over(a: Drawing, b: Drawing, place: str) -> Similarity:
    """The map that lays B over A; a drawing without a viewBox has its bounds for one."""
    if place == "asis":
        return Similarity()
    if place == "bbox":
        return lay_over(drawn_box(b), drawn_box(a))
    return lay_over(b.viewbox or drawn_box(b), a.viewbox or drawn_box(a))


def drawn_box(drawing: Drawing) -> Box:
    """The box around everything a drawing paints, without the width of strokes."""
    return Box.union(
        [cubics.bounds(contour.segments) for shape in drawing.shapes for contour in shape.contours]
    )


def shapes_at(pair: Pair, t: float) -> tuple[PaintedShape, ...]:
    """The shapes of a pair at time t, command for command alike at all times; what has no partner ends as a point."""
    return tuple(
        PaintedShape(
            between(shape, t),
            *blend_styles(shape.style_a, shape.style_b, t),
        )
        for shape in pair.moving
    )


def frame_at(pair: Pair, t: float, *, as_drawn: bool) -> Frame:
    """The frame at time t; at t = 0 and t = 1 it may be the drawing itself."""
    moved = shapes_at(pair, t)
    crossings = sum(curve_crossings(shape.paths) for shape in moved)
    area = sum(abs(sum(cubics.signed_area(o.segments) for o in shape.paths)) for shape in moved)
    if t in (0.0, 1.0):
        moved = pair.drawn[int(t)] if as_drawn else _without_points(pair, moved, t)
    return Frame(
        t=t,
        pair=pair.a,
        shapes=moved,
        view=pair.views[0].interpolate(pair.views[1], t),
        self_crossings=crossings,
        area=area,
    )


def _without_points(pair: Pair, shapes: tuple[PaintedShape, ...], t: float) -> tuple[PaintedShape, ...]:
    """The shapes at an end of time, but for contours that are a point there."""
    found = []
    for moving_shape, shape in zip(pair.moving, shapes, strict=True):
        outlines = tuple(
            outline
            for contour, outline in zip(moving_shape.contours, shape.paths, strict=True)
            if not (contour.shrinks if t else contour.grows)
        )
        if outlines:
            found.append(shape._replace(paths=outlines))
    return tuple(found)
