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
from shapeblend_cli.geometry.normalise import Similarity, between_boxes, grown, holds, lay_over, union
from shapeblend_cli.geometry.outline import self_crossings, signed_area
from shapeblend_cli.interpolate.paths import between, moving
from shapeblend_cli.interpolate.styles import blend_styles, painted_as
from shapeblend_cli.interpolate.times import frame_times
from shapeblend_cli.model import (
    Box,
    Correspondence,
    Drawing,
    Frame,
    MatchedShape,
    MovingShape,
    Outline,
    PaintedShape,
    Pair,
    Polygon,
)
from shapeblend_cli.pairing.join import join, least_work_either_way, part_of
from shapeblend_cli.pairing.pair import pair_parts
from shapeblend_cli.pairing.parts import Part, main_way, take_apart
from shapeblend_cli.pairing.shapes import Joint, matched_shapes
from shapeblend_cli.pairing.wishes import Wishes, check_stiff, given_pairs, pinned, wishes_for
from shapeblend_cli.settings import BlendSettings

MARGIN = 0.02
"""Room around what a drawing without a viewBox paints, as a share of its larger side."""

SLACK = 1e-9
"""What sticks out of a viewBox by less than this share of its size does so by rounding."""

FLAT_PIECES = 12
"""Lines for which a curve is taken where crossings are counted and areas measured."""

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import ArrayLike


def blend(a: Drawing, b: Drawing, settings: BlendSettings) -> tuple[Pair, list[Frame]]:
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
    p0: ArrayLike, p1: ArrayLike, closed: bool = True, settings: BlendSettings | None = None
) -> Correspondence:
    """Find the least-work correspondence of two polygons, without any SVG.

    Parameters
    ----------
    p0, p1 : (m,) and (n,) complex
        Vertices, ``x + 1j * y``, in any unit; the first is not repeated at the end. Each polygon is scaled to the
        unit box (section 3.3).
    closed : bool
        Open polygons correspond end to end.
    settings : BlendSettings, optional
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
    settings = settings or BlendSettings()
    wishes = Wishes(settings.start, settings.pins)
    check_stiff([a], settings)
    backwards, found = least_work_either_way(a, b, settings, wishes, None)
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
    settings: BlendSettings,
    clock: Clock | None = None,
    watch: Callable[[float], None] | None = None,
) -> tuple[list[Pair], list[str]]:
    """Find the correspondences of drawings, each with the next one: everything up to the first frame.

    Parameters
    ----------
    drawings : sequence of Drawing
        Two or more; all are laid over the first.
    settings : BlendSettings
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
        shapes = _match(a, b, settings, clock, part_of(watch, number, len(laid) - 1))
        moving_shapes = tuple(
            MovingShape(
                tuple(moving(contour, curves=settings.curves) for contour in shape.contours),
                shape.style_a,
                shape.style_b,
            )
            for shape in shapes
        )
        pairs.append(Pair(number, number + 1, shapes, moving_shapes, (a.drawn, b.drawn), (a.view, b.view)))
        clock.lap("interpolate")
    return pairs, notes


class _Laid(NamedTuple):
    """A drawing, what lays it over the first, and laid there its contours, what it paints, and what to show of it."""

    drawing: Drawing
    over: Similarity
    parts: list[Part]
    drawn: tuple[PaintedShape, ...]
    view: Box


def _match(
    a: _Laid, b: _Laid, settings: BlendSettings, clock: Clock, watch: Callable[[float], None] | None
) -> tuple[MatchedShape, ...]:
    """Pair the contours of two drawings and find the correspondence of each pair."""
    pins = pinned(a.parts, b.parts, settings, b.over)
    given = given_pairs((a.drawing, b.drawing), (a.parts, b.parts), settings)
    couples = pair_parts(a.parts, b.parts, settings, given + [found.pair for found in pins])
    clock.lap("match")
    largest = max(couples, key=lambda couple: couple[0].size)
    joints = []
    for run, couple in enumerate(couples):
        wishes = wishes_for(couple, settings, pins, is_largest=couple is largest)
        matched = join(*couple, settings, wishes, part_of(watch, run, len(couples)))
        joints.append(Joint(*couple, matched._replace(seconds=clock.lap("match"))))
    shapes = tuple(_in_style(shape, settings.style) for shape in matched_shapes(a.parts, b.parts, joints))
    clock.lap("match")
    return shapes


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
            tuple(Outline(over.points(c.segments), c.straight, c.closed) for c in shape.contours),
            shape.style.moved(*over),
        )
        for shape in drawing.shapes
    )


def view_of(drawn: Sequence[PaintedShape], viewbox: Box | None) -> Box:
    """What part of the plane to show of a drawing: its viewBox and what it paints outside; without one, what it paints.

    Where drawings are laid by their own boxes, the viewBox of the first stands in for the others'.
    """
    boxes = []
    for shape in drawn:
        reach = shape.style.stroke_width / 2.0 if shape.style.stroke else 0.0
        boxes += [grown(cubics.bounds(outline.segments), reach) for outline in shape.outlines]
    painted = union(boxes)
    with_margin = grown(painted, MARGIN * max(painted.width, painted.height))
    if viewbox is None:
        return with_margin
    is_inside = holds(viewbox, painted, SLACK * max(viewbox.width, viewbox.height))
    return viewbox if is_inside else union([viewbox, with_margin])


def make_frames(pairs: Sequence[Pair], settings: BlendSettings) -> list[Frame]:
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
    return union([cubics.bounds(contour.segments) for shape in drawing.shapes for contour in shape.contours])


def shapes_at(pair: Pair, t: float) -> tuple[PaintedShape, ...]:
    """The shapes of a pair at time t, command for command alike at all times; what has no partner ends as a point."""
    return tuple(
        PaintedShape(
            tuple(between(contour, t) for contour in shape.contours),
            *blend_styles(shape.style_a, shape.style_b, t),
        )
        for shape in pair.moving
    )


def frame_at(pair: Pair, t: float, *, as_drawn: bool) -> Frame:
    """The frame at time t; at t = 0 and t = 1 it may be the drawing itself."""
    moved = shapes_at(pair, t)
    flat = [
        [(cubics.polyline(o.segments, o.straight, FLAT_PIECES), o) for o in shape.outlines] for shape in moved
    ]
    if t in (0.0, 1.0):
        moved = pair.drawn[int(t)] if as_drawn else _without_points(pair, moved, t)
    return Frame(
        t=t,
        pair=pair.a,
        shapes=moved,
        view=between_boxes(*pair.views, t),
        self_crossings=sum(
            self_crossings(np.append(z, o.segments[-1, 3]), closed=False) for shape in flat for z, o in shape
        ),
        area=sum(abs(sum(signed_area(z) for z, _ in shape)) for shape in flat),
    )


def _without_points(pair: Pair, shapes: tuple[PaintedShape, ...], t: float) -> tuple[PaintedShape, ...]:
    """The shapes at an end of time, but for contours that are a point there."""
    found = []
    for moving_shape, shape in zip(pair.moving, shapes, strict=True):
        outlines = tuple(
            outline
            for contour, outline in zip(moving_shape.contours, shape.outlines, strict=True)
            if not (contour.shrinks if t else contour.grows)
        )
        if outlines:
            found.append(shape._replace(outlines=outlines))
    return tuple(found)
