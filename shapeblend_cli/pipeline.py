"""The one place that joins the stages: read, flatten, normalise, match, interpolate, write.

`blend` works on values and touches no file.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.clock import Clock
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.normalise import Similarity, lay_over, union
from shapeblend_cli.geometry.outline import self_crossings, signed_area
from shapeblend_cli.interpolate.paths import blend_vertices
from shapeblend_cli.interpolate.styles import blend_styles, painted_as
from shapeblend_cli.interpolate.times import frame_times
from shapeblend_cli.model import (
    Box,
    Correspondence,
    Drawing,
    Frame,
    MatchedShape,
    Outline,
    PaintedShape,
    Pair,
    Polygon,
)
from shapeblend_cli.pairing.join import join, least_work_either_way, part_of
from shapeblend_cli.pairing.pair import pair_parts
from shapeblend_cli.pairing.parts import main_way, take_apart
from shapeblend_cli.pairing.shapes import Joint, matched_shapes
from shapeblend_cli.pairing.wishes import Wishes, check_stiff, given_pairs, pinned, wishes_for
from shapeblend_cli.settings import BlendSettings

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike


def blend(a: Drawing, b: Drawing, settings: BlendSettings) -> tuple[Pair, list[Frame]]:
    """Match two drawings and make the frames between them.

    Raises
    ------
    InputError
        A drawing whose outline cannot be blended with the other's; its file is named.
    MatchError
        Starts, pins, bands and stiff regions that do not fit the outlines.
    """
    pair = match(a, b, settings)
    return pair, make_frames(pair, frame_times(settings.frames, settings.ends))


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


def match(
    a: Drawing,
    b: Drawing,
    settings: BlendSettings,
    clock: Clock | None = None,
    watch: Callable[[float], None] | None = None,
) -> Pair:
    """Find the correspondence of two drawings: everything up to the first frame.

    Parameters
    ----------
    a, b : Drawing
    settings : BlendSettings
    clock : Clock, optional
        Told of the stages `flatten` and `match`.
    watch : callable, optional
        Told now and then which share of the matching is done, from 0 to 1.
    """
    clock = clock or Clock()
    over = place_over(a, b, settings.place)
    parts_a, notes_a = take_apart(a, Similarity(), settings.vertices)
    way = main_way([part.polygon for part in parts_a])
    parts_b, notes_b = take_apart(b, over, settings.vertices, way)
    check_stiff([part.polygon for part in parts_a], settings)
    clock.lap("flatten")
    pins = pinned(parts_a, parts_b, settings, over)
    given = given_pairs((a, b), (parts_a, parts_b), settings) + [found.pair for found in pins]
    couples = pair_parts(parts_a, parts_b, settings, given)
    clock.lap("match")
    largest = max(couples, key=lambda couple: couple[0].size)
    joints = []
    for run, couple in enumerate(couples):
        wishes = wishes_for(couple, settings, pins, is_largest=couple is largest)
        matched = join(*couple, settings, wishes, part_of(watch, run, len(couples)))
        joints.append(Joint(*couple, matched._replace(seconds=clock.lap("match"))))
    shapes = tuple(_in_style(shape, settings.style) for shape in matched_shapes(parts_a, parts_b, joints))
    clock.lap("match")
    return Pair(a=0, b=1, shapes=shapes, notes=(*notes_a, *notes_b))


def _in_style(shape: MatchedShape, style: str) -> MatchedShape:
    """A shape painted as the settings say; one without a partner keeps its own paint."""
    if all(c.a is None for c in shape.contours) or all(c.b is None for c in shape.contours):
        return shape
    style_a, style_b = painted_as(shape.style_a, shape.style_b, style)
    return shape._replace(style_a=style_a, style_b=style_b)


def make_frames(pair: Pair, times: list[float]) -> list[Frame]:
    """Make the frames of a pair at the given times in [0, 1]."""
    return [_frame(pair, t) for t in times]


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


def keyframes(pair: Pair) -> tuple[tuple[PaintedShape, ...], tuple[PaintedShape, ...]]:
    """The shapes of a pair at t = 0 and t = 1, command for command alike; what has no partner is a point there."""
    start, end = (tuple(_painted(shape, t) for shape in pair.shapes) for t in (0.0, 1.0))
    return start, end


def _frame(pair: Pair, t: float) -> Frame:
    # At the ends of time a contour that grows from a point or shrinks to one is not there.
    shapes = [
        shape._replace(
            contours=tuple(
                c for c in shape.contours if not (c.a is None and t == 0.0) and not (c.b is None and t == 1.0)
            )
        )
        for shape in pair.shapes
    ]
    painted = tuple(_painted(shape, t) for shape in shapes if shape.contours)
    outlines = [outline for shape in painted for outline in shape.outlines]
    return Frame(
        t=t,
        pair=0,
        shapes=painted,
        self_crossings=sum(self_crossings(o.vertices, o.closed) for o in outlines),
        area=sum(abs(sum(signed_area(o.vertices) for o in shape.outlines)) for shape in painted),
    )


def _painted(shape: MatchedShape, t: float) -> PaintedShape:
    outlines = tuple(
        Outline(
            blend_vertices(c.polygon_a.vertices, c.polygon_b.vertices, c.correspondence.dots, t),
            c.correspondence.closed,
        )
        for c in shape.contours
    )
    return PaintedShape(outlines, *blend_styles(shape.style_a, shape.style_b, t))
