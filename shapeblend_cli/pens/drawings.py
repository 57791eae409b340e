"""A drawing as pen lines: strokes as they are, those recovered from fills, and what is no line."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.anatomy.decompose import EXTERIOR, HOLE, PlacedDrawing, decompose
from shapeblend_cli.errors import InputError
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.polygons import polyline_contour, signed_area
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.model import Box
from shapeblend_cli.model.arrays import median, rolled
from shapeblend_cli.pens.joints import joined, with_pieces
from shapeblend_cli.pens.line import UNITS, PenDrawing, PenLine, length
from shapeblend_cli.pens.recovery.recover import recover

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.model import ComplexArray, Contour, CubicPath, Drawing
    from shapeblend_cli.pens.recovery.region import Recovered

CURVE_POINTS = 12
"""Minimum number of points on each curved segment of a stroke."""

CURVE_STEP = 1.0
"""Maximum distance of these, in units."""

ROUND = 0.02
"""Maximum difference of a disc's area from a circle's, as a share of the square around it."""

LONGEST = 800.0
"""Maximum length of a line, in units: what goes far beyond its viewBox is no icon, and would take gigabytes."""

SQUARE = 0.05
"""Tolerance of a square that is a dot of a line with cut ends, as a share of its side."""

TINT = 0.5
"""Maximum opacity of a fill that only tints a drawing, beneath its lines."""

MOST_LINES = 60
"""Maximum number of lines of a drawing: more are an illustration."""

LEAST_VERTICES = 12
"""Minimum number of vertices of what sticks out of a line."""

MITER_LIMIT = 4.0
"""Maximum miter limit of recovered lines, in widths: sharper corners come only on the way, and would be spikes."""

MITER_ROOM = 1.02
"""Miter limit, as a multiple of what the sharpest corner needs: with more, kinks on the way would grow spikes."""

LEAST_INK = 0.1
"""Minimum share of the ink of a drawing of one colour in its lines."""

LEAST_OF_PICTURE = 0.45
"""Minimum share of the ink of a drawing of several colours in its lines: these go along with what they surround."""

CORNER = np.radians(20.0)
"""Minimum turn at a corner of an outline, in radians."""

SAME_WEIGHT = 0.97
"""Minimum ratio of the widths of two drawings in one weight of line."""


def file_lines(drawing: Drawing) -> list[PenLine]:
    """Return the lines of a drawing as it stands in its file."""
    return file_pens(drawing)[0].lines


def file_pens(drawing: Drawing) -> tuple[PenDrawing, float]:
    """Return a drawing as it stands in its file as lines, and the units of these per unit of the file."""
    box = drawing.viewbox or Box.union(
        [cubics.bounds(contour.segments) for shape in drawing.shapes for contour in shape.contours]
    )
    try:
        contours, _ = decompose(drawing, Similarity(), vertices=0)
    except InputError:  # nothing in it has an extent
        return PenDrawing([], [], 0.0, False), 1.0
    scale = UNITS / box.larger_side if box.larger_side else 1.0
    return pen_drawing(PlacedDrawing(drawing, Similarity(), contours), scale), scale


def pen_drawing(drawing: PlacedDrawing, scale: float, most: float = np.inf) -> PenDrawing:
    """Return the lines of a drawing: strokes, and those that are recovered from fills until there are too many.

    Nothing is recovered from a crowd of more than twice as many exteriors.
    """
    groups: dict[tuple[int, int], list[PlacedContour]] = defaultdict(list)
    for contour in drawing.contours:
        exterior = contour.exterior if contour.exterior is not None else contour.number
        groups[contour.shape, exterior].append(contour)
    strokes: list[PenLine] = []
    lines: list[PenLine] = []
    bodies: list[PlacedContour] = []
    ink = rest = 0.0
    is_recovered = False
    is_crowd = len(groups) > 2 * most  # of which at least half are no lines, or there are too many
    free = 1 + max((contour.number for contour in drawing.contours), default=0)
    for members in groups.values():
        style = members[0].style
        shape = drawing.drawing.shapes[members[0].shape]
        # Letters become letters, not the lines that they could be drawn with.
        is_drawn = not shape.clips and shape.element != "text"
        found: list[PenLine] | None = None
        if style.fill is None and style.stroke is not None and is_drawn:
            found = [file_line(contour, scale) for contour in members]
            if max(line.length for line in found) > LONGEST:
                found = None
        elif style.stroke is None and style.fill is not None and is_drawn:
            is_free = len(lines) <= most and not is_crowd and not _lies_below(members, drawing.contours)
            whole = recovered_lines(members, scale) if is_free else None
            if whole is not None:
                found, is_recovered = whole[0], True
                for each in whole[1]:
                    bodies.append(each._replace(number=free))
                    free, rest = free + 1, rest + each.area * scale**2
        if found is None:
            bodies += members
            area = sum(c.area * (-1.0 if c.role == HOLE else 1.0) for c in members) * scale**2
            stroke = sum(length(c.polygon.vertices) for c in members) * scale
            rest += area if style.fill is not None and style.fill_opacity > TINT else 0.0
            rest += stroke * style.stroke_width * scale if style.stroke is not None else 0.0
        else:
            (strokes if style.fill is None else lines).extend(found)
            ink += sum(max(line.length, line.width) * line.width for line in found)
    dots = {body.number: dot for body in bodies if (dot := _square_dot(body, lines, scale)) is not None}
    if dots:
        bodies = [body for body in bodies if body.number not in dots]
        lines += dots.values()
        area = sum(dot.width**2 for dot in dots.values())
        ink, rest = ink + area, max(0.0, rest - area)
    lines = _each_once(lines)
    # Recovered lines are joined by the region that they paint.
    return PenDrawing(
        [*joined(strokes), *lines], bodies, ink / (ink + rest) if ink > 0.0 else 0.0, is_recovered
    )


def _each_once(lines: Sequence[PenLine]) -> list[PenLine]:
    """Return lines without those that are painted on the same again: a few files have every outline twice."""
    found: dict[object, PenLine] = {}
    for k, line in enumerate(lines):
        is_opaque = line.style.stroke_opacity == 1.0
        found.setdefault((line.points.round(3).tobytes(), line.closed, line.style) if is_opaque else k, line)
    return list(found.values())


def _square_dot(body: PlacedContour, lines: Sequence[PenLine], scale: float) -> PenLine | None:
    """Return a square as a line as long as it is wide, if a line with cut ends has its width and paint."""
    style = body.style
    if not body.contour.straight.all() or body.role != EXTERIOR or style.stroke is not None:
        return None
    nodes = body.contour.segments[:, 0]
    sides = rolled(nodes, -1) - nodes
    sides = sides[np.abs(sides) * scale > 1e-6]
    if len(sides) != 4 or np.abs(np.abs((rolled(sides, -1) / sides).imag) - 1.0).max() > SQUARE:
        return None
    across = max(sides, key=lambda side: (round(abs(side.real), 6), side.real))
    for line in lines:
        is_alike = line.style.stroke == style.fill and line.style.stroke_linecap == "butt"
        if is_alike and abs(abs(across) * scale - line.width) < SQUARE * line.width:
            points = (body.box.centre + np.array([-0.5, 0.5]) * across) * scale
            number = body.number
            return line._replace(
                points=points, closed=False, contour=number, shape=body.shape, name=str(number)
            )
    return None


def _lies_below(members: Sequence[PlacedContour], contours: Sequence[PlacedContour]) -> bool:
    """Return whether a disc lies below what has another paint, as a wheel below its tyre: lines lie above all else."""
    own = members[0]
    size = max(own.box.width, own.box.height)
    if len(members) > 1 or abs(own.area / size**2 - np.pi / 4.0) > ROUND:
        return False
    return any(
        other.shape > own.shape
        and own.style.fill not in (other.style.fill, other.style.stroke)
        and own.box.overlaps(other.box)
        for other in contours
    )


def file_line(contour: PlacedContour, scale: float) -> PenLine:
    """Return a stroke as a line."""
    points = _flat(contour.contour, scale) * scale
    closed = contour.contour.closed or (len(points) > 3 and bool(abs(points[0] - points[-1]) < 1e-6))
    if closed and len(points) > 1 and abs(points[0] - points[-1]) < 1e-6:
        points = points[:-1]
    style = contour.style
    name = str(contour.number)
    width = contour.style.stroke_width * scale
    return PenLine(points, closed, style, width, contour.number, contour.shape, name=name)


def _flat(path: CubicPath, scale: float) -> ComplexArray:
    """Return the points of a chain: the nodes, and on curves some between them."""
    counts = np.ceil(cubics.lengths(path.segments) * scale / CURVE_STEP).clip(CURVE_POINTS, LONGEST)
    parts = [
        segment[:1] if straight else cubics.evaluate(segment, np.arange(count) / count)
        for segment, straight, count in zip(path.segments, path.straight, counts, strict=True)
    ]
    points = np.concatenate([*parts, path.segments[-1:, 3]])
    return points[np.append(True, np.abs(np.diff(points)) > 1e-9)]


def _miter_limit(line: Recovered) -> float:
    """Return the miter limit that the sharpest corner of a line needs."""
    edges = np.diff(np.append(line.points, line.points[:2]) if line.closed else line.points)
    turns = np.abs(np.angle(edges[1:] / edges[:-1]))
    return round(min(MITER_ROOM / max(np.cos(turns.max(initial=0.0) / 2.0), 1e-9), MITER_LIMIT), 3)


def recovered_lines(
    members: Sequence[PlacedContour], scale: float
) -> tuple[list[PenLine], list[PlacedContour]] | None:
    """Return the lines of an exterior with its holes, and what sticks out of them, if it is mostly lines."""
    if not all(contour.contour.closed for contour in members):
        return None
    whole = recover([with_region_on_left(contour, scale) for contour in members])
    style, first = members[0].style, members[0]
    if whole is None or (whole[1] and (style.fill_opacity < 1.0 or style.fill_gradient is not None)):
        return None
    found, rests = whole
    lines = [
        PenLine(
            line.points,
            line.closed,
            style._replace(
                fill=None,
                fill_gradient=None,
                stroke=style.fill,
                stroke_gradient=style.fill_gradient,
                stroke_opacity=style.fill_opacity,
                stroke_width=line.width / scale,
                stroke_linecap=line.cap,
                stroke_linejoin=line.join,
                stroke_miterlimit=_miter_limit(line) if line.join == "miter" else style.stroke_miterlimit,
            ),
            line.width,
            first.number,
            first.shape,
            name=f"{first.number}.{k}" if len(found) > 1 else str(first.number),
        )
        for k, line in enumerate(found, 1)
    ]
    return lines, [_rest(each / scale, first, len(members[0].polygon.vertices)) for each in rests]


def with_region_on_left(contour: PlacedContour, scale: float) -> ComplexArray:
    """Return the segments of an exterior or a hole, in units, with what is painted on their left."""
    segments = contour.contour.segments * scale
    is_left = (cubics.signed_area(segments) > 0.0) == (contour.role != HOLE)
    return segments if is_left else segments[::-1, ::-1]


def _rest(polygon: ComplexArray, exterior: PlacedContour, vertices: int) -> PlacedContour:
    """Return what sticks out of the lines of an exterior as a contour, oriented like that."""
    if signed_area(polygon) * signed_area(exterior.polygon.vertices) < 0.0:
        polygon = polygon[::-1]
    contour = polyline_contour(polygon)
    share = length(np.append(polygon, polygon[0])) / max(length(exterior.polygon.vertices), 1e-12)
    flat = flatten(contour, max(LEAST_VERTICES, int(share * vertices)))
    return exterior._replace(contour=contour, polygon=flat, role=EXTERIOR, exterior=None)


def enough_lines(
    a: PlacedDrawing, b: PlacedDrawing, pens: tuple[PenDrawing, PenDrawing], scale: float, *, is_asked: bool
) -> tuple[PenDrawing, PenDrawing] | None:
    """Return two drawings as pen lines, each with pieces of the other one's; None if these are too few or too many.

    Few are enough if `is_asked`. A letter in two weights is better blended by its outlines. `scale` is the number of
    units that a length of 1 has.
    """
    first, last = pens
    if max(len(first.lines), len(last.lines)) > MOST_LINES:  # pieces come on top
        return None
    one, other = with_pieces(first, last, scale), with_pieces(last, first, scale)
    is_sign = all(len(_colours(drawing)) == 1 for drawing in (one, other))
    least = 0.0 if is_asked else LEAST_INK if is_sign else LEAST_OF_PICTURE
    if not (one.lines and other.lines) or max(len(one.lines), len(other.lines)) > MOST_LINES:
        return None
    if min(one.share, other.share) < least:
        return None
    if (one.is_recovered or other.is_recovered) and not is_asked and _are_two_weights(a, b, one, other):
        return None
    return one, other


def _corners(contour: Contour) -> int:
    """Return the number of corners of a contour."""
    starts, ends = cubics.directions(contour.segments)
    turns = np.abs(np.angle(np.roll(starts, -1) / ends))
    return int((turns > CORNER).sum())


def _are_two_weights(a: PlacedDrawing, b: PlacedDrawing, one: PenDrawing, other: PenDrawing) -> bool:
    """Return whether outlines are built alike and lines have other widths, as a letter in two weights of a typeface.

    Outlines that were made from each other are best matched segment by segment, or corner by corner if pieces are cut.
    """
    counts = [sorted(len(contour.contour.segments) for contour in drawing.contours) for drawing in (a, b)]
    if counts[0] != counts[1]:
        counts = [sorted(_corners(contour.contour) for contour in drawing.contours) for drawing in (a, b)]
        if not any(counts[0]):
            return False
    widths = [median([line.width for line in drawing.lines]) for drawing in (one, other)]
    return counts[0] == counts[1] and min(widths) < SAME_WEIGHT * max(widths)


def _colours(drawing: PenDrawing) -> set[str | None]:
    """Return the colours of lines and fills."""
    styles = [body.style for body in drawing.bodies] + [line.style for line in drawing.lines]
    return {paint.colour for style in styles for paint in style.paints} - {None}
