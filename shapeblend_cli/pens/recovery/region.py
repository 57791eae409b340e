"""Filled regions, what lines paint of them when drawn again, and what sticks out: by the edges of polygons."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import ring_edges, signed_area
from shapeblend_cli.geometry.polyline import nearest_edges
from shapeblend_cli.geometry.raster import winding_grid
from shapeblend_cli.model.arrays import numbered
from shapeblend_cli.pens.line import evenly, length

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, ComplexArray, FloatArray

DISC = np.exp(2j * np.pi * np.arange(24) / 24.0) / np.sqrt(np.cos(np.pi / 24.0))
"""Vertices of a round cap or join of radius 1; the area is a circle's."""


SLIGHT = 0.3
"""Maximum turn at which a round join is drawn as a mitred one, in radians: it has no more than a hundredth beyond."""

SHARPEST = np.radians(150.0)
"""Maximum turn of a mitred join, in radians."""


OUTLINE_STEP = 0.1
"""Distance of sample points along an outline, in units."""

CURVE_POINTS = 8
"""Minimum number of points on each segment of an outline."""

CURVE_STEP = 0.4
"""Maximum distance of these, in units: a heart may be drawn with two segments."""

OFF = 0.03
"""Maximum distance of an outline from what a line paints where it is the line's edge, in widths."""

STICKS_OUT = 0.12
"""Minimum distance by which something sticks out of a line, in widths."""

GOOD = 0.97
"""Minimum overlap of a region and its lines, drawn again, as a share of both together."""

SLANT = 0.3
"""Maximum area by which a cut end may differ from the line's cap, in square widths: many are cut along a slash."""

MOST_SLANT = 0.07
"""Maximum area by which all cut ends of a region may, as a share of it."""

LONG = 4.0
"""Minimum length of a straight line with slanting ends, in widths: shorter ones are trapezoids."""

MOST_REST = 0.3
"""Maximum share of a region that sticks out of its lines: a solid shape with lines beside it is an outline."""

SPILL = 0.02
"""Maximum area that lines paint beyond such a region, as a share of it."""

MOST_RESTS = 3
"""Maximum number of parts that stick out of lines: a letter with serifs is no line with many of them."""

MOST_BESIDE_RESTS = 4
"""Maximum number of lines of a region of which something sticks out: more are an illustration with fine lines."""

KNOB_SPILL = 0.1
"""Maximum area that one of its lines paints beyond it, as a share of the line's: a wider one is a knob."""

GRID = 192
"""Points along the side of the grid on which these are compared."""

SHIFT = 0.37
"""Shift of another grid, in steps: a row may lie along an edge, on one side in the file and on the other if drawn."""

UNSURE = 0.05
"""Maximum lack of overlap on the grid for the shifted one to decide."""


class Recovered(NamedTuple):
    """A recovered line: a polyline, whether it is closed, its width, and its cap and join as SVG names them."""

    points: ComplexArray
    closed: bool
    width: float
    cap: str
    join: str


class Stretch:
    """A stretch of centre line, its pen, and what is known of its ends: a cap, a cut, a joint, or nothing yet."""

    def __init__(
        self,
        points: ComplexArray,
        width: float,
        closed: bool = False,
        ends: Sequence[str | None] = (None, None),
    ) -> None:
        self.points, self.width, self.closed, self.ends = points, width, closed, list(ends)

    @property
    def outline(self) -> ComplexArray:
        """The polyline from end to end; a closed one ends where it begins."""
        return np.append(self.points, self.points[0]) if self.closed or len(self.points) == 1 else self.points

    def ending(self, side: int) -> ComplexArray:
        """The points towards one of the ends, that end last."""
        return self.points if side else self.points[::-1]


class Region:
    """A filled region, by the edges of its outlines."""

    def __init__(self, contours: Sequence[ComplexArray]) -> None:
        self.starts, self.ends = ring_edges([outline_points(each) for each in contours])

    def holds(self, point: complex) -> bool:
        """Return whether a point is inside, by the even-odd rule."""
        above, below = self.starts.imag <= point.imag, self.ends.imag <= point.imag
        p, q = self.starts[above != below], self.ends[above != below]
        x = p.real + (q.real - p.real) * (point.imag - p.imag) / (q.imag - p.imag)
        return bool((x > point.real).sum() % 2)

    def ahead(self, point: complex, direction: complex) -> float:
        """Return how far the outline is from a point in a direction; infinite if it is not there."""
        return distance_ahead(point, direction, self.starts, self.ends)[0]


def outline_points(segments: ComplexArray) -> ComplexArray:
    """Return points along an outline, without its end."""
    lengths = cubics.lengths(segments)
    is_curved = lengths > (1.0 + 1e-6) * np.abs(segments[:, 3] - segments[:, 0])
    counts = np.where(is_curved, np.ceil(lengths / CURVE_STEP), 0).clip(CURVE_POINTS).astype(np.intp)
    segment = np.repeat(np.arange(len(segments)), counts)
    return cubics.evaluate(segments[segment], numbered(counts) / counts[segment])


def distance_ahead(
    point: complex, direction: complex, starts: ComplexArray, ends: ComplexArray
) -> tuple[float, int]:
    """Return how far the nearest edge in a direction is, and which one it is."""
    edges, offsets = ends - starts, (starts - point).conj()
    slant = (direction.conjugate() * edges).imag
    with np.errstate(divide="ignore", invalid="ignore"):
        ahead = (offsets * edges).imag / slant
        share = (offsets * direction).imag / slant
        # With room for rounding, or what goes through a vertex would miss both of its edges.
        hits = (np.abs(slant) > 1e-12) & (ahead > 0.0) & (share > -1e-9) & (share < 1.0 + 1e-9)
    if not hits.any():
        return np.inf, -1
    k = int(np.where(hits, ahead, np.inf).argmin())
    return float(ahead[k]), k


def stroke_edges(lines: Sequence[Recovered]) -> tuple[ComplexArray, ComplexArray]:
    """Return the starts and ends of the edges of polygons, wound alike, that cover what lines paint."""
    polygons = [each for line in lines for each in _polygons(line)]
    if not polygons:
        return np.zeros(0, complex), np.zeros(0, complex)
    starts, ends = [], []
    for each in polygons:
        following = np.concatenate([each[:, 1:], each[:, :1]], axis=1)
        back = ((each.conj() * following).imag.sum(axis=1) < 0.0)[:, None]
        starts.append(np.where(back, following, each).ravel())
        ends.append(np.where(back, each, following).ravel())
    return np.concatenate(starts), np.concatenate(ends)


def _polygons(line: Recovered) -> list[ComplexArray]:
    """Return the polygons of a line's edges, (n, 4), of mitred or slight corners, (n, 4), and discs, (n, 24)."""
    points, ways, before, after = _course(line)
    reach = line.width / 2.0
    p, q, aside = points[:-1], points[1:], 1j * ways * reach
    edges = np.stack([p + aside, p - aside, q - aside, q + aside], axis=1)
    places = p if line.closed else points[1:-1]
    turns = np.angle(after * before.conj())
    is_round = np.abs(turns) > (SLIGHT if line.join == "round" else SHARPEST)
    is_mitred = ~is_round & (np.abs(turns) > 1e-3)
    place, way, out, turn = (each[is_mitred] for each in (places, before, after, turns))
    side = -1j * np.sign(turn) * reach
    tip = place + side * (way + out) / np.abs(way + out) / np.cos(turn / 2.0)
    corners = np.stack([place, place + side * way, tip, place + side * out], axis=1)
    centres = places[is_round]
    if not line.closed and line.cap == "round":
        centres = np.append(centres, points[[0, -1]])
    return [edges, corners, centres[:, None] + reach * DISC]


def _course(
    line: Recovered | Stretch,
) -> tuple[ComplexArray, ComplexArray, ComplexArray, ComplexArray]:
    """Return the points of a line, each once, the directions of its edges, and those before and after its joins."""
    points = np.append(line.points, line.points[0]) if line.closed else line.points
    points = points[np.append(True, np.abs(np.diff(points)) > 1e-9)]
    ways = np.diff(points) / np.abs(np.diff(points))
    return (points, ways, np.roll(ways, 1), ways) if line.closed else (points, ways, ways[:-1], ways[1:])


def rests_of(contours: Sequence[ComplexArray], lines: Sequence[Recovered]) -> list[ComplexArray]:
    """Return the polygons that stick out of lines: stretches of outline, closed along the centre lines.

    Parameters
    ----------
    contours : sequence of (k, 4) complex
        An exterior and its holes, closed chains of cubic segments in units, with the region on their left.
    lines : sequence of Recovered
    """
    found = []
    for segments in contours:
        polyline = outline_points(segments)
        points = evenly(np.append(polyline, polyline[0]), OUTLINE_STEP)[:-1]
        away, feet, width = _from_lines(points, lines)
        is_out = away > OFF * width
        if is_out.all() or not is_out.any():
            continue
        order = np.roll(np.arange(len(points)), -int(np.flatnonzero(~is_out)[0]))
        points, feet = points[order], feet[order]
        away, width, is_out = away[order], width[order], is_out[order]
        borders = np.flatnonzero(np.diff(np.append(is_out, False).astype(np.int8)))
        for before, last in borders.reshape(-1, 2).tolist():
            run = slice(before + 1, last + 1)
            if away[run].max() < STICKS_OUT * width[run].max():
                continue
            after = (last + 1) % len(points)
            polygon = np.concatenate(
                [feet[[before]], points[before : last + 1], [points[after], feet[after]]]
            )
            if abs(signed_area(polygon)) > 1e-3:
                found.append(polygon[np.append(True, np.abs(np.diff(polygon)) > 1e-9)])
    return found


def _from_lines(
    points: ComplexArray, lines: Sequence[Recovered]
) -> tuple[FloatArray, ComplexArray, FloatArray]:
    """Return the distance of points from what the nearest line paints, the nearest place on it, and its width."""
    best = np.full(len(points), np.inf)
    feet, widths = points.copy(), np.ones(len(points))
    for line in lines:
        outline = (
            np.append(line.points, line.points[0]) if line.closed or len(line.points) == 1 else line.points
        )
        starts, ends = outline[:-1], outline[1:]
        away, edge, shares = nearest_edges(points, starts, ends)
        own = starts[edge] + shares * (ends - starts)[edge]
        is_nearer = away - line.width / 2.0 < best
        best = np.where(is_nearer, away - line.width / 2.0, best)
        feet, widths = np.where(is_nearer, own, feet), np.where(is_nearer, line.width, widths)
    return best, feet, widths


def checked(
    lines: Sequence[Stretch], region: Region, contours: Sequence[ComplexArray]
) -> tuple[list[Recovered], list[ComplexArray]] | None:
    """Return the lines with the join with which they cover the region best, and its rests; None if they do not."""
    grid = _Grid.over(region)
    wanted = grid.painted(region.starts, region.ends)
    overlap, drawn = _with_best_join(lines, grid, wanted)
    least = GOOD - _slanted(lines, float(wanted.sum()) * grid.step**2)
    if least - UNSURE <= overlap < least:
        shifted = grid._replace(corner=grid.corner + SHIFT * grid.step * (1.0 + 1.0j))
        overlap, drawn = _with_best_join(lines, shifted, shifted.painted(region.starts, region.ends))
    if overlap >= least:
        return drawn, []
    # A wide line that is none, but a knob, leaves the region at its corners.
    own = [grid.painted(*stroke_edges([line])) for line in drawn]
    is_inside = [(cells & ~wanted).sum() <= KNOB_SPILL * cells.sum() for cells in own]
    drawn = [line for line, is_line in zip(drawn, is_inside, strict=True) if is_line]
    covered = np.logical_or.reduce(
        [cells for cells, is_line in zip(own, is_inside, strict=True) if is_line] or [~wanted]
    )
    if (wanted & ~covered).sum() > MOST_REST * wanted.sum() or (
        covered & ~wanted
    ).sum() > SPILL * wanted.sum():
        return None
    rests = rests_of(contours, drawn)
    for rest in rests:
        covered |= grid.painted(rest, np.roll(rest, -1))
    whole = float((wanted & covered).sum() / max(1, (wanted | covered).sum()))
    is_drawn = 0 < len(rests) <= MOST_RESTS and len(drawn) <= MOST_BESIDE_RESTS and whole >= GOOD
    return (drawn, rests) if is_drawn else None


class _Grid(NamedTuple):
    """Points at which a region and its lines are compared."""

    corner: complex
    step: float

    @classmethod
    def over(cls, region: Region) -> _Grid:
        """Lay a grid over a region."""
        low = min(region.starts.real), min(region.starts.imag)
        size = max(max(region.starts.real) - low[0], max(region.starts.imag) - low[1]) + 1.0
        return cls(complex(*low) - 0.5 - 0.5j, size / GRID)

    def painted(self, starts: ComplexArray, ends: ComplexArray) -> BoolArray:
        """Return which points polygons paint, by their edges."""
        return winding_grid(starts, ends, self.corner, self.step, GRID) != 0


def _with_best_join(
    lines: Sequence[Stretch], grid: _Grid, wanted: BoolArray
) -> tuple[float, list[Recovered]]:
    """Return the overlap of a region and its lines with the join that suits them best, and these lines."""
    best, drawn = 0.0, list[Recovered]()
    for join in ("round", "miter") if any(map(_has_corners, lines)) else ("round",):
        some = [Recovered(line.points, line.closed, line.width, _cap_of(line), join) for line in lines]
        cells = grid.painted(*stroke_edges(some))
        overlap = float((wanted & cells).sum() / max(1, (wanted | cells).sum()))
        if overlap > best + 1e-4:
            best, drawn = overlap, some
    return best, drawn


def _has_corners(line: Stretch) -> bool:
    """Return whether the joins of a line are to be seen."""
    _, _, before, after = _course(line)
    turns = np.abs(np.angle(after * before.conj()))
    return bool(((turns > SLIGHT) & (turns <= SHARPEST)).any())


def _slanted(lines: Sequence[Stretch], area: float) -> float:
    """Return the largest share of a region that one line may leave or paint beyond it at cut ends."""
    first = lines[0]
    is_short = len(first.points) == 2 and length(first.points) < LONG * first.width
    if len(lines) > 1 or is_short:
        return 0.0
    cuts = sum(end in ("butt", "cut") for end in first.ends)
    return min(MOST_SLANT, SLANT * cuts * first.width**2 / max(area, 1e-9))


def _cap_of(line: Stretch) -> str:
    return "butt" if "butt" in line.ends and "round" not in line.ends else "round"
