"""Lines cut out of a plate, such as a check in a disc: they become each other as pen lines do, but of negative ink.

The holes of both drawings are recovered as lines, and matched as lines. What is painted is one shape still: the plate,
and holes in the other direction, one for each straight piece of the pen's path. Where such pieces overlap, a hole would
count twice, so that the overlap is put back: each point of a hole counts once, by the rule of inclusion and exclusion.
"""

from __future__ import annotations

from itertools import combinations, pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.decompose import EXTERIOR
from shapeblend_cli.blending.copies import CROWD
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import orientation, signed_area, winding_numbers
from shapeblend_cli.geometry.polyline import clipped, needed
from shapeblend_cli.model.arrays import rolled
from shapeblend_cli.pens.drawings import recovered_lines
from shapeblend_cli.pens.line import UNITS
from shapeblend_cli.wires.contour_blends import vertex_by_vertex

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour, PlacedDrawing
    from shapeblend_cli.model import Box, ComplexArray, ContourBlend, Motion, ShapeBlend
    from shapeblend_cli.motion.pen import Pen
    from shapeblend_cli.options.settings import Settings
    from shapeblend_cli.pens.line import PenLine
    from shapeblend_cli.pens.moves import Move

MOST_PIECES = 12
"""Maximum number of straight pieces of the lines in a plate."""

MOST_OVERLAPS = 80
"""Maximum number of overlaps of these."""

MOST_TOGETHER = 4
"""Maximum number of pieces that overlap in one place."""

SAME_PLATE = 0.1
"""Maximum distance of the sides of two plates that are one, as a share of their size. Half the difference in area."""

STRAIGHT = 0.06
"""Tolerance of the straight pieces of a line, in units."""

ARC = 10
"""Number of edges of a round cap."""

TIMES = np.linspace(0.0, 1.0, 25)
"""Times at which the lines are looked at beforehand."""

APPEARS = 0.12
"""Share of the time in which a line that begins as a dot gets its width."""

UNSEEN = 1e-5
"""Size of what is not there, in A's units: a path of animations must not be a point."""

SPECK = 1e-4
"""Minimum area of an overlap, in square units."""


class Inlay(NamedTuple):
    """A line of negative ink on its way."""

    pen: Pen
    widths: tuple[float, float]  # of A and B
    is_round: tuple[bool, bool]  # its caps, and its joins
    span: tuple[float, float]  # the times of its start and its end
    dot: (
        int | None
    )  # the end, 0 or 1, at which it is a dot that gets its width first; None if it is at neither

    def polygons(self, t: float) -> list[ComplexArray]:
        """Return a convex polygon for each piece of the line at a time, and for each mitred corner."""
        begin, until = self.span
        t = min(max((t - begin) / (until - begin), 0.0), 1.0)
        points = self.pen.points(t)
        width = (1.0 - t) * self.widths[0] + t * self.widths[1]
        if self.dot is not None:
            width *= min(1.0, abs(t - self.dot) / APPEARS)
        last = len(points) - 2
        found = []
        for k, (p, q) in enumerate(pairwise(points)):
            ends = self.is_round[0 if k == 0 else 1], self.is_round[0 if k == last else 1]
            found.append(_piece(p, q, width / 2.0, ends))
        if not self.is_round[1]:
            found += [_corner(points[k : k + 3], width / 2.0) for k in range(last)]
        return found


class Inlaid(NamedTuple):
    """The motion of a plate, and of the lines that are cut out of it."""

    plate: Motion | None  # None for straight paths
    own: int  # number of the plate's contours
    inlays: tuple[Inlay, ...]
    overlaps: tuple[tuple[int, ...], ...]  # the pieces that overlap somewhere
    sizes: tuple[int, ...]  # the numbers of vertices of the overlaps
    sign: int  # of the area of the plate

    @property
    def name(self) -> str:
        """No motion that can be asked for."""
        return "pen"

    def segments(self, contours: Sequence[ContourBlend], t: float) -> list[ComplexArray]:
        """Return the control points of each contour at time t."""
        plate = contours[: self.own]
        if self.plate is None:
            found = [contour.straight(t) for contour in plate]
        else:
            found = self.plate.segments(plate, t)
        return found + [cubics.lines(polygon, closed=True) for polygon in self.holes(t)]

    def holes(self, t: float) -> list[ComplexArray]:
        """Return the polygons of the pieces, which run against the plate, and of overlaps, which make up for them."""
        pieces = [polygon for inlay in self.inlays for polygon in inlay.polygons(t)]
        found = [piece[:: -self.sign] for piece in pieces]
        for numbers, size in zip(self.overlaps, self.sizes, strict=True):
            common = _padded(_common([pieces[k] for k in numbers]), size, pieces[numbers[0]])
            found.append(common[:: self.sign if len(numbers) % 2 == 0 else -self.sign])
        return found


def _piece(p: complex, q: complex, reach: float, is_round: tuple[bool, bool]) -> ComplexArray:
    """Return what a pen paints from one point to another; it runs so that its area is positive."""
    way = (q - p) / abs(q - p) if abs(q - p) > 1e-9 else 1.0 + 0j
    side = -1j * way * max(reach, UNSEEN)
    turns = np.exp(1j * np.linspace(0.0, np.pi, ARC + 1))
    flat = np.linspace(1.0, -1.0, ARC + 1)
    around_q = q + side * (turns if is_round[1] else flat)
    around_p = p - side * (turns if is_round[0] else flat)
    return np.concatenate([around_q, around_p])


def _corner(points: ComplexArray, reach: float) -> ComplexArray:
    """Return what a mitred corner has beyond the pieces that meet there."""
    q = points[1]
    ways = [(b - a) / abs(b - a) if abs(b - a) > 1e-9 else 1.0 + 0j for a, b in pairwise(points)]
    turn = float(np.angle(ways[1] / ways[0]))
    outer = -1j * (1.0 if turn > 0.0 else -1.0) * reach
    share = min(1.0 / max(np.cos(turn / 2.0), 0.25), 4.0)
    tip = q + outer * (ways[0] + ways[1]) / max(abs(ways[0] + ways[1]), 1e-9) * share
    kite = np.array([q, q + outer * ways[0], tip, q + outer * ways[1]])
    return kite if turn > 0.0 else kite[::-1]


def _common(polygons: Sequence[ComplexArray]) -> ComplexArray:
    """Return the intersection of convex polygons of positive area; perhaps nothing."""
    found = polygons[0]
    for other in polygons[1:]:
        edges = rolled(other, -1) - other
        is_long = np.abs(edges) > 1e-9
        other, edges = other[is_long], edges[is_long]
        outside = ((found - other[:, None]) * edges.conj()[:, None]).imag < 0.0
        if not len(edges) or outside.all(axis=1).any():
            return found[:0]
        for k in np.flatnonzero(outside.any(axis=1)).tolist():
            found = clipped(found, other[k], edges[k])
    return found


def _padded(polygon: ComplexArray, size: int, around: ComplexArray) -> ComplexArray:
    """Return a polygon with so many vertices: the last one more than once, or the least needed ones left out.

    One without an area is a speck.
    """
    if len(polygon) < 3:
        return np.asarray(around.mean() + UNSEEN * np.exp(2j * np.pi * np.arange(size) / size))
    while len(polygon) > size:
        areas = np.abs(((polygon - np.roll(polygon, 1)) * np.conj(np.roll(polygon, -1) - polygon)).imag)
        polygon = np.delete(polygon, int(areas.argmin()))
    return np.concatenate([polygon, np.repeat(polygon[-1:], size - len(polygon))])


class Plates(NamedTuple):
    """A plate of both drawings, and how the lines cut out of it become each other."""

    plates: tuple[PlacedContour, PlacedContour]
    holes: tuple[list[PlacedContour], list[PlacedContour]]
    moves: Sequence[Move]


def plates_of(a: PlacedDrawing, b: PlacedDrawing, settings: Settings, view: Box) -> list[Plates]:
    """Return the plates that both drawings have in one place, with nothing but lines cut out of them.

    None are returned if users ask for pairs of contours or for a motion.
    """
    named = settings.match or settings.pins or settings.start or settings.stiff or settings.mix
    if named or settings.motion != "auto" or max(len(side.contours) for side in (a, b)) > CROWD:
        return []
    scale = UNITS / view.larger_side
    sides = [_cut_out(side, scale) for side in (a, b)]
    if not all(sides):
        return []
    from shapeblend_cli.pens.line_blends import line_moves  # few drawings have plates
    from shapeblend_cli.pens.named_lines import Required
    from shapeblend_cli.pens.turned import as_whole

    found = []
    for p, lines_p in sides[0]:
        for q, lines_q in sides[1]:
            if not _is_same_plate(p, q):
                continue
            moves = (
                as_whole(lines_p, lines_q)
                or line_moves(lines_p, lines_q, Required({}, settings), settings, scale)[0]
            )
            holes = [[c for c in side.contours if c.exterior == own.number] for side, own in ((a, p), (b, q))]
            found.append(Plates((p, q), (holes[0], holes[1]), moves))
    return found


def _cut_out(drawing: PlacedDrawing, scale: float) -> list[tuple[PlacedContour, list[PenLine]]]:
    """Return the exteriors with holes that are open lines or dots, all of them, and these lines."""
    found = []
    for plate in drawing.contours:
        if plate.role != EXTERIOR or plate.style.fill is None or plate.style.stroke is not None:
            continue
        holes = [hole for hole in drawing.contours if hole.exterior == plate.number]
        lines: list[PenLine] | None = []
        for hole in holes:
            own, rests = recovered_lines([hole._replace(role=EXTERIOR, exterior=None)], scale) or ([], [])
            if not own or rests or lines is None or not all(map(_is_open, own)):
                lines = None
                break
            lines += [_simplified(line) for line in own]
        if lines and sum(max(1, len(line.points) - 1) for line in lines) <= MOST_PIECES:
            found.append((plate, lines))
    return found


def _is_open(line: PenLine) -> bool:
    """Return whether a line is open, or a round dot."""
    return not line.closed and (len(line.points) > 1 or line.style.stroke_linecap == "round")


def _simplified(line: PenLine) -> PenLine:
    """Return a line without the vertices that it does not need."""
    if len(line.points) < 2:
        return line
    return line._replace(points=line.points[needed(line.points, STRAIGHT)])


def _is_same_plate(p: PlacedContour, q: PlacedContour) -> bool:
    """Return whether two plates are one, in one place."""
    most = SAME_PLATE * max(p.box.larger_side, q.box.larger_side)
    apart = np.abs(np.subtract(p.box.bounds, q.box.bounds)).max()
    return bool(apart <= most and abs(p.area - q.area) <= 2.0 * SAME_PLATE * max(p.area, q.area))


def without_inlays(drawing: PlacedDrawing, plates: Sequence[Plates], side: int) -> PlacedDrawing:
    """Return a drawing without the holes that are lines."""
    numbers = {hole.number for each in plates for hole in each.holes[side]}
    return drawing._replace(contours=[c for c in drawing.contours if c.number not in numbers])


def with_inlays(shapes: Sequence[ShapeBlend], plates: Sequence[Plates], view: Box) -> list[ShapeBlend] | None:
    """Cut lines out of the plates among shapes; None if a plate is not there, or its lines do not fit."""
    scale = UNITS / view.larger_side
    found = list(shapes)
    for each in plates:
        numbers = tuple(plate.number for plate in each.plates)
        here = [k for k, shape in enumerate(found) if numbers in [c.numbers for c in shape.contours]]
        shape = _inlaid(found[here[0]], each, scale) if len(here) == 1 else None
        if shape is None:
            return None
        found[here[0]] = shape
    return found


def _inlaid(shape: ShapeBlend, plates: Plates, scale: float) -> ShapeBlend | None:
    """Return the shape of a plate with its lines; None if these leave the plate, or overlap too much."""
    inlays = tuple(_inlay(move, scale) for move in plates.moves)
    sign = orientation(plates.plates[0].polygon)
    found = _overlaps(inlays, 1.0 / scale)
    if found is None or not sign:
        return None
    vertices = np.concatenate([p for inlay in inlays for t in TIMES[::3] for p in inlay.polygons(float(t))])
    if any((winding_numbers(vertices, plate.polygon.vertices) == 0).any() for plate in plates.plates):
        return None
    motion = Inlaid(shape.motion, len(shape.contours), inlays, tuple(found), tuple(found.values()), sign)
    ends = [motion.holes(t) for t in (0.0, 1.0)]
    names = [[hole.number for hole in side] for side in plates.holes]
    whose = [move for move, inlay in zip(plates.moves, inlays, strict=True) for _ in inlay.polygons(0.0)]
    contours = []
    for k, (one, other) in enumerate(zip(*ends, strict=True)):
        move = whose[k] if k < len(whose) else whose[next(iter(found))[0]]
        numbers = (
            move.a.contour if move.a else names[0][0],
            move.b.contour if move.b else names[1][0],
        )
        contours.append(_hole(numbers, one, other)._replace(reason=move.reason))
    style_a, style_b = (style._replace(fill_rule="nonzero") for style in (shape.style_a, shape.style_b))
    return shape._replace(
        contours=(*shape.contours, *contours), style_a=style_a, style_b=style_b, motion=motion
    )


def _inlay(move: Move, scale: float) -> Inlay:
    line_a, line_b = move.a or move.b, move.b or move.a
    assert line_a is not None
    assert line_b is not None
    style = line_a.style
    is_round = style.stroke_linecap == "round", style.stroke_linejoin == "round"
    dot = None if move.is_joined or (move.a and move.b) else 0 if move.b else 1
    widths = line_a.width / scale, line_b.width / scale
    return Inlay(move.motion.scaled(1.0 / scale), widths, is_round, move.span, dot)


def _overlaps(inlays: Sequence[Inlay], unit: float) -> dict[tuple[int, ...], int] | None:
    """Return which pieces overlap at any time, and with how many vertices; None if too many do."""
    found: dict[tuple[int, ...], int] = {}
    for t in TIMES:
        pieces = [polygon for inlay in inlays for polygon in inlay.polygons(float(t))]
        if len(pieces) > 2 * MOST_PIECES:
            return None
        groups: dict[tuple[int, ...], ComplexArray] = {(k,): piece for k, piece in enumerate(pieces)}
        for size in range(2, MOST_TOGETHER + 2):
            larger: dict[tuple[int, ...], ComplexArray] = {}
            for group, k in ((g, k) for g in groups for k in range(g[-1] + 1, len(pieces))):
                if all(
                    (*part, k) in found or len(group) == 1 for part in combinations(group, len(group) - 1)
                ):
                    common = _common([groups[group], pieces[k]])
                    if len(common) > 2 and abs(signed_area(common)) > SPECK * unit * unit:
                        larger[*group, k] = common
            if larger and size > MOST_TOGETHER:
                return None
            for group, common in larger.items():
                found[group] = max(found.get(group, 0), len(common))
            groups = larger
        if len(found) > MOST_OVERLAPS:
            return None
    return found


def _hole(numbers: tuple[int, int], a: ComplexArray, b: ComplexArray) -> ContourBlend:
    """Return the blend of a polygon, vertex by vertex."""
    size = max(float(np.ptp(a.real)), float(np.ptp(b.real)), 1e-9)
    return vertex_by_vertex(numbers, a, b, (size, size))
