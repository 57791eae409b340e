"""The one place that joins the stages: read, flatten, normalise, match, interpolate, write.

`blend` works on values and touches no file.
"""

from __future__ import annotations

import time
from typing import NamedTuple

import numpy as np

from shapeblend_cli.errors import InputError
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.normalise import Similarity, lay_over, to_unit_box, union
from shapeblend_cli.geometry.outline import reversed_polygon, self_crossings, signed_area
from shapeblend_cli.interpolate import blend_styles, blend_vertices, frame_times
from shapeblend_cli.match.solve import least_work
from shapeblend_cli.match.work import WorkConstants
from shapeblend_cli.model import (
    Box,
    Contour,
    Correspondence,
    Drawing,
    Frame,
    MatchedContour,
    Outline,
    Pair,
    Polygon,
    Style,
)

PLACES = ("viewbox", "bbox", "asis")


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
    constants : WorkConstants
    """

    frames: int = 5
    ends: bool = False
    vertices: int = 200
    place: str = "viewbox"
    start: tuple[int, int] | None = None
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
        A start that does not exist.
    """
    pair = match(a, b, settings)
    return pair, make_frames(pair, frame_times(settings.frames, settings.ends))


def match(a: Drawing, b: Drawing, settings: BlendSettings) -> Pair:
    """Find the correspondence of two drawings: everything up to the first frame."""
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
    before = time.perf_counter()
    polygon_b, correspondence = _least_work_either_way(polygon_a, polygon_b, settings)
    matched = MatchedContour(
        a=chosen_a.number,
        b=chosen_b.number,
        polygon_a=polygon_a,
        polygon_b=polygon_b,
        scale_a=to_unit_box(polygon_a)[1],
        scale_b=to_unit_box(polygon_b)[1],
        correspondence=correspondence,
        seconds=time.perf_counter() - before,
    )
    return Pair(
        a=0,
        b=1,
        contours=(matched,),
        style_a=chosen_a.style,
        style_b=chosen_b.style._replace(stroke_width=over.scale * chosen_b.style.stroke_width),
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


def _least_work_either_way(a: Polygon, b: Polygon, settings: BlendSettings) -> tuple[Polygon, Correspondence]:
    """Solve for the direction of B that agrees with A's, for open outlines for the cheaper of both."""

    def solve(b: Polygon) -> tuple[Polygon, Correspondence]:
        unit_a, unit_b = to_unit_box(a)[0], to_unit_box(b)[0]
        return b, least_work(unit_a, unit_b, a.closed, settings.constants, start=settings.start)

    if not a.closed:
        return min(solve(b), solve(reversed_polygon(b)), key=lambda solved: solved[1].work)
    opposite = signed_area(a.vertices) * signed_area(b.vertices) < 0.0
    return solve(reversed_polygon(b) if opposite else b)


def _frame(pair: Pair, t: float) -> Frame:
    outlines = tuple(
        Outline(
            blend_vertices(c.polygon_a.vertices, c.polygon_b.vertices, c.correspondence.dots, t),
            c.correspondence.closed,
        )
        for c in pair.contours
    )
    return Frame(
        t=t,
        pair=0,
        outlines=outlines,
        style=blend_styles(pair.style_a, pair.style_b, t),
        self_crossings=sum(self_crossings(o.vertices, o.closed) for o in outlines),
        area=sum(abs(signed_area(o.vertices)) for o in outlines),
    )
