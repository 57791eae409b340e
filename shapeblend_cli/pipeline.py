"""The one place that joins the stages: read, flatten, normalise, match, interpolate, write.

`blend` works on values and touches no file.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.clock import Clock
from shapeblend_cli.errors import InputError, MatchError
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.normalise import Similarity, lay_over, to_unit_box, union
from shapeblend_cli.geometry.outline import direction, reversed_polygon, self_crossings, signed_area
from shapeblend_cli.interpolate.paths import blend_vertices
from shapeblend_cli.interpolate.styles import blend_styles
from shapeblend_cli.interpolate.times import frame_times
from shapeblend_cli.match.solve import least_work
from shapeblend_cli.match.work import WorkConstants
from shapeblend_cli.model import (
    Box,
    Contour,
    Correspondence,
    Drawing,
    Frame,
    MatchedContour,
    MatchedShape,
    Outline,
    PaintedShape,
    Pair,
    Polygon,
    Style,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike

    from shapeblend_cli.model import FloatArray


class BlendSettings(NamedTuple):
    """What the command line can say of a blend.

    Attributes
    ----------
    frames : int >= 0
        In-betweens.
    ends : bool
        Frames at t = 0 and t = 1 too.
    vertices : int >= 0
        Vertices a contour, about.
    place : str
        How B is laid over A: viewBox on viewBox, box on box, or file coordinates as they stand.
    start : (int, int) or None
        A vertex of A and the vertex of B it corresponds to; None for the best of all.
    pins : tuple of pairs
        Vertices that must correspond: two numbers, as in the report, or two points (complex), one of A and one of
        B, each in the coordinates of its own file; the nearest vertex is taken.
    reverse : str
        Whether to go through B's outline backwards: yes, no, or auto.
    stiff : tuple of (complex, float, float)
        Point of A, radius and weight: vertices of A within the radius are so many times as stiff.
    solver, band, effort
        See `match.solve.least_work`.
    constants : WorkConstants
    """

    frames: int = 5
    ends: bool = False
    vertices: int = 200
    place: str = "viewbox"
    start: tuple[int, int] | None = None
    pins: tuple[tuple[complex, complex], ...] = ()
    reverse: str = "auto"
    stiff: tuple[tuple[complex, float, float], ...] = ()
    solver: str = "exact"
    band: float | None = None
    effort: str = "auto"
    constants: WorkConstants = WorkConstants()


class _Chosen(NamedTuple):
    """The contour of a drawing that is blended, with its paint."""

    number: int
    contour: Contour
    style: Style
    left_out: int


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
    solved, found = _least_work_either_way(a, b, Similarity(), settings or BlendSettings(), None)
    return replace(found, dots=np.stack([found.dots[:, 0], solved.segment[found.dots[:, 1]]], axis=1))


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
    chosen_a, chosen_b = _largest_contour(a), _largest_contour(b)
    if chosen_a.contour.closed != chosen_b.contour.closed:
        opened, closed = (b, a) if chosen_a.contour.closed else (a, b)
        raise InputError(
            opened.file,
            f"its outline is open and that of {closed.file} is closed; two of a kind would work",
        )
    over = place_over(a, b, settings.place)
    polygon_a = _polygon(a, chosen_a.contour, settings.vertices)
    polygon_b = _polygon(b, over.contour(chosen_b.contour), settings.vertices)
    clock.lap("flatten")
    polygon_b, correspondence = _least_work_either_way(polygon_a, polygon_b, over, settings, watch)
    matched = MatchedContour(
        a=chosen_a.number,
        b=chosen_b.number,
        polygon_a=polygon_a,
        polygon_b=polygon_b,
        scale_a=to_unit_box(polygon_a)[1],
        scale_b=to_unit_box(polygon_b)[1],
        correspondence=correspondence,
        seconds=clock.lap("match"),
    )
    return Pair(
        a=0,
        b=1,
        shapes=(
            MatchedShape(
                contours=(matched,),
                style_a=chosen_a.style,
                style_b=chosen_b.style._replace(stroke_width=over.scale * chosen_b.style.stroke_width),
            ),
        ),
        notes=tuple(
            f"{drawing.file}: contour {chosen.number}, the largest, is blended; {chosen.left_out} "
            f"other{'s are' if chosen.left_out > 1 else ' is'} left out"
            for drawing, chosen in ((a, chosen_a), (b, chosen_b))
            if chosen.left_out
        ),
    )


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


def _largest_contour(drawing: Drawing) -> _Chosen:
    """Take the contour with the largest area; the longest, where none has any."""
    contours = [(contour, shape.style) for shape in drawing.shapes for contour in shape.contours]
    sizes = [
        (abs(cubics.signed_area(c.segments)), float(cubics.lengths(c.segments).sum())) for c, _ in contours
    ]
    number = max(range(len(contours)), key=lambda k: sizes[k])
    contour, style = contours[number]
    return _Chosen(number, _closed_by_fill(contour, style), style, len(contours) - 1)


def _closed_by_fill(contour: Contour, style: Style) -> Contour:
    """Close an open contour that is only filled, as filling does."""
    if contour.closed or style.fill is None or style.stroke is not None:
        return contour
    start, end = contour.segments[0, 0], contour.segments[-1, 3]
    return Contour(
        segments=np.vstack([contour.segments, cubics.line(end, start)]),
        straight=np.append(contour.straight, True),
        closed=True,
    )


def _polygon(drawing: Drawing, contour: Contour, vertices: int) -> Polygon:
    polygon = flatten(contour, vertices)
    least = 3 if contour.closed else 2
    if len(polygon.vertices) < least:
        kind = "closed" if contour.closed else "open"
        raise InputError(
            drawing.file,
            f"its {kind} outline has {len(polygon.vertices)} distinct vertices; {least} or more would work",
        )
    return polygon


def _least_work_either_way(
    a: Polygon,
    b: Polygon,
    over: Similarity,
    settings: BlendSettings,
    watch: Callable[[float], None] | None,
) -> tuple[Polygon, Correspondence]:
    """Solve for the direction of B that agrees with A's; where none is decided, for the cheaper of both."""
    backwards = _backwards(a, b, settings.reverse)
    unit_a = to_unit_box(a)[0]
    weight = _weight(a, settings.stiff)
    solved: list[tuple[Polygon, Correspondence]] = []
    refused: list[MatchError] = []
    for run, reverse in enumerate(backwards):
        candidate = reversed_polygon(b) if reverse else b
        try:
            found = least_work(
                unit_a,
                to_unit_box(candidate)[0],
                a.closed,
                settings.constants,
                start=settings.start,
                pins=[_pin(a, candidate, over, pin) for pin in settings.pins],
                band=settings.band,
                weight=weight,
                solver=settings.solver,
                effort=settings.effort,
                watch=_part(watch, run, len(backwards)),
            )
        except MatchError as error:  # pins that cross one way round need not cross the other way
            refused.append(error)
        else:
            solved.append((candidate, found))
    if not solved:
        raise refused[0]
    return min(solved, key=lambda pair: pair[1].work)


def _backwards(a: Polygon, b: Polygon, reverse: str) -> list[bool]:
    """Whether to go through B backwards: one answer, or both where only the work can tell."""
    if reverse != "auto":
        return [reverse == "yes"]
    ways = direction(a), direction(b)
    return [False, True] if 0 in ways else [ways[0] != ways[1]]


def _part(watch: Callable[[float], None] | None, run: int, runs: int) -> Callable[[float], None] | None:
    return None if watch is None else lambda share: watch((run + share) / runs)


def _pin(a: Polygon, b: Polygon, over: Similarity, pin: tuple[complex, complex]) -> tuple[int, int]:
    """Two vertex numbers, from numbers or from points."""
    if isinstance(pin[0], int) and isinstance(pin[1], int):
        return pin[0], pin[1]
    nearest_a = np.abs(a.vertices - pin[0]).argmin()
    nearest_b = np.abs(b.vertices - over.points(np.array(pin[1]))).argmin()
    return int(nearest_a), int(nearest_b)


def _weight(a: Polygon, stiff: tuple[tuple[complex, float, float], ...]) -> FloatArray | None:
    """Stiffness at A's vertices; regions that overlap multiply."""
    if not stiff:
        return None
    weight = np.ones(len(a.vertices))
    for point, radius, factor in stiff:
        within = np.abs(a.vertices - point) <= radius
        if not within.any():
            nearest = a.vertices[np.abs(a.vertices - point).argmin()]
            raise MatchError(
                f"no vertex of A lies within {radius:g} of the stiff point {point.real:g},{point.imag:g}; "
                f"the nearest is {nearest.real:g},{nearest.imag:g}"
            )
        weight[within] *= factor
    return weight


def _frame(pair: Pair, t: float) -> Frame:
    shapes = tuple(_painted(shape, t) for shape in pair.shapes)
    outlines = [outline for shape in shapes for outline in shape.outlines]
    return Frame(
        t=t,
        pair=0,
        shapes=shapes,
        self_crossings=sum(self_crossings(o.vertices, o.closed) for o in outlines),
        area=sum(abs(signed_area(o.vertices)) for o in outlines),
    )


def _painted(shape: MatchedShape, t: float) -> PaintedShape:
    outlines = tuple(
        Outline(
            blend_vertices(c.polygon_a.vertices, c.polygon_b.vertices, c.correspondence.dots, t),
            c.correspondence.closed,
        )
        for c in shape.contours
    )
    return PaintedShape(outlines, blend_styles(shape.style_a, shape.style_b, t))
