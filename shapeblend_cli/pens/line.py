"""A pen line, its dashes, and places along polylines.

Lengths here are in units of the drawing: its larger side is `UNITS` of them, as in the grid of most icons.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.polyline import cumulative_lengths, nearest_places, points_at
from shapeblend_cli.model import Box

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.model import ComplexArray, FloatArray, Style

    _Side = tuple[int, int]

UNITS = 24.0
"""Size of a drawing, in units."""


LEAST_TURN = 20.0
"""Minimum turn of a corner whose join is seen, in degrees."""

LEAST_SLASH = 11.0
"""Minimum length of a slash, in units."""

SHORT = 1.5
"""Maximum length of a line that comes or goes as a dot, in widths."""

STRAIGHT = 0.99
"""Minimum distance of the ends of a straight line, as a share of its length."""


OFF = 0.02
"""Maximum distance of a piece from its line, as a share of the length of both."""

DRIFT = 0.03
"""Maximum length that a piece with fewer vertices has lost, as a share of it."""

LOOKED_UP = 0.5
"""Distance of the places of a line whose distances from another one are looked up, in units."""


class PenLine(NamedTuple):
    """The centre line of a stroke.

    Attributes
    ----------
    points : (k,) complex
        A polyline, in units; of a closed line the first point is not repeated. A dot has one point.
    closed : bool
    style : Style
        A stroke without a fill; its width is in A's coordinates.
    width : float
        In units.
    contour : int
        The number of the contour that it is, or is part of.
    shape : int
        The index of its shape.
    is_piece : bool
        Whether it is a piece of a line that was cut at its corners.
    name : str
        The number of its contour, and of several lines of a contour a number of its own: 3.1, 3.2.
    share : (float, float)
        Of a piece, where it begins and ends, as shares of the length of its line.
    is_bow : bool
        Whether it is bent and stands on other lines with both ends, as a door does, or a handle.
    """

    points: ComplexArray
    closed: bool
    style: Style
    width: float
    contour: int
    shape: int
    is_piece: bool = False
    name: str = ""
    share: tuple[float, float] = (0.0, 1.0)
    is_bow: bool = False

    @property
    def outline(self) -> ComplexArray:
        """The polyline from end to end; a closed one ends where it begins."""
        return np.append(self.points, self.points[0]) if self.closed else self.points

    @property
    def drawn(self) -> ComplexArray:
        """Its outline; of a dot the point twice."""
        return self.outline if len(self.points) > 1 else np.repeat(self.points, 2)

    @property
    def length(self) -> float:
        """Its length, in units."""
        return length(self.outline)

    @property
    def centre(self) -> complex:
        """The centre of the box around it."""
        return Box.around(self.points).centre

    @property
    def reach(self) -> float:
        """Maximum distance of an end from a line that it touches, in units."""
        return 0.6 * self.width + 0.2

    @property
    def can_be_drawn_on(self) -> bool:
        """Whether it has ends, and is longer than a dot."""
        return not self.closed and self.length >= SHORT * self.width

    @property
    def is_straight(self) -> bool:
        """Whether it goes straight from end to end."""
        return not self.closed and bool(abs(self.points[-1] - self.points[0]) >= STRAIGHT * self.length)

    @property
    def is_slash(self) -> bool:
        """Whether it is straight, crosses much of the drawing, and slants."""
        chord = complex(self.points[-1] - self.points[0])
        slope = abs(chord.real) / max(abs(chord.imag), 1e-9)
        return self.length > LEAST_SLASH and self.is_straight and 0.3 < slope < 3.3

    def style_beside(self, partner: PenLine) -> Style:
        """Return its style, with its partner's caps if it has no ends, and its joins if it has no corners."""
        style = self.style
        if self.closed and not partner.closed:
            style = style._replace(stroke_linecap=partner.style.stroke_linecap)
        if style.stroke_linejoin != partner.style.stroke_linejoin and not corners(self.outline, LEAST_TURN):
            style = style._replace(stroke_linejoin=partner.style.stroke_linejoin)
        return style

    def part(self, begin: float, end: float) -> ComplexArray:
        """Return the polyline between two lengths along the line; of a closed line also through its beginning."""
        return part_of(self.outline, self.closed, begin, end)


class PenDrawing(NamedTuple):
    """The lines of a drawing, those of its contours that are no lines, and the share of its ink in lines."""

    lines: list[PenLine]
    bodies: list[PlacedContour]
    share: float
    is_recovered: bool  # whether any line is not a stroke in the file


def length(points: ComplexArray) -> float:
    """Return the length of a polyline."""
    return float(np.abs(points[1:] - points[:-1]).sum())


def part_of(points: ComplexArray, closed: bool, begin: float, end: float) -> ComplexArray:
    """Return the part of a line between two lengths along it; a closed one may pass its end."""
    whole = length(points)
    if closed and (end <= begin + 1e-9 or end > whole):
        points = np.concatenate([points[:-1], points])
        end += whole if end <= begin + 1e-9 else 0.0
    along = cumulative_lengths(points)
    inner = points[(along > begin + 1e-6) & (along < end - 1e-6)]
    return np.concatenate([at(points, [begin]), inner, at(points, [end])])


def at(points: ComplexArray, lengths: FloatArray | list[float]) -> ComplexArray:
    """Return points at lengths along a polyline."""
    return points_at(np.asarray(lengths, float), points, cumulative_lengths(points))


def evenly(points: ComplexArray, step: float) -> ComplexArray:
    """Return points along a polyline at even lengths of at most `step`, both ends among them."""
    whole = length(points)
    return at(points, np.linspace(0.0, whole, max(2, int(np.ceil(whole / step)) + 1)))


def farthest(p: ComplexArray, q: ComplexArray) -> float:
    """Return the largest distance of a polyline from another one."""
    return float(foot_points(evenly(p, LOOKED_UP), q)[0].max())


def apart(p: ComplexArray, q: ComplexArray) -> float:
    """Return the largest distance of two polylines from each other."""
    return max(farthest(some, onto) for some, onto in ((p, q), (q, p)))


def begun(points: ComplexArray, share: float) -> ComplexArray:
    """Return the part of a polyline up to a share of its length."""
    along = cumulative_lengths(points)
    end = share * along[-1]
    return np.append(points[along < end - 1e-9], at(points, [end]))


def foot_points(points: ComplexArray, line: ComplexArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return for each point its distance from a polyline, and the length along that to the nearest place.

    The third array has the direction of the polyline there, in radians.
    """
    distance, place = nearest_places(points, line)
    edge = np.minimum(place.astype(np.intp), len(line) - 2)
    edges = np.diff(line)
    along = cumulative_lengths(line)[edge] + (place - edge) * np.abs(edges[edge])
    return distance, along, np.angle(edges[edge])


def lengths_along(line: PenLine, points: ComplexArray) -> FloatArray | None:
    """Return the length along a line of each vertex of a piece, rising or falling; None if it is no piece of it."""
    outline, whole = line.outline, line.length
    if len(outline) < 2:
        return np.zeros(len(points))
    along, own = cumulative_lengths(outline), cumulative_lengths(points)
    first = float(foot_points(points[:1], outline)[1][0])
    best: tuple[float, FloatArray] | None = None
    for way in (1.0, -1.0):
        # Vertices that were left out have made the piece shorter.
        stretched = first + way * own * (1.0 + np.linspace(0.0, DRIFT, 61))[:, None]
        stretched = stretched if line.closed else np.clip(stretched, 0.0, whole)
        away = np.abs(points_at(stretched % whole if line.closed else stretched, outline, along) - points)
        k = int(away.max(axis=1).argmin())
        if best is None or away[k].max() < best[0]:
            best = float(away[k].max()), stretched[k]
    assert best is not None
    return best[1] if best[0] < OFF * (whole + 1.0) else None


def each_once(places: FloatArray) -> FloatArray:
    """Return one or more places along a line in order, rounded, without repetitions."""
    ordered = np.sort(np.round(places, 6))  # np.unique would load numpy.ma first
    return ordered[np.append(True, np.diff(ordered) > 0.0)]


def corners(points: ComplexArray, least: float = 35.0) -> list[float]:
    """Return where a polyline turns by at least so many degrees within a unit, as shares of its length."""
    whole = length(points)
    along = np.arange(0.6, whole - 0.6, 0.1)
    if whole < 1.5 or len(along) < 3:
        return []
    before, here, after = (at(points, along + off) for off in (-0.5, 0.0, 0.5))
    turns = np.abs(np.angle((after - here) / (here - before + 1e-12), deg=True))
    vertices = cumulative_lengths(points)
    found = []
    while turns.max() > least:
        place = along[int(turns.argmax())]
        vertex = vertices[np.abs(vertices - place).argmin()]
        found.append(float(vertex if abs(vertex - place) < 0.3 else place) / whole)
        turns[np.abs(along - place) < 1.2] = 0.0
    return sorted(found)


def with_dashes(
    styles: tuple[Style, Style], lines: tuple[PenLine, PenLine], ends: list[ComplexArray], scale: float
) -> tuple[Style, Style]:
    """Return the paint of a line at both ends, its dashes as the files have them, and at rest where the line rests.

    Parameters
    ----------
    styles : (Style, Style)
    lines : (PenLine, PenLine)
        What the line is a part of, at the start and at the end.
    ends : list of (k,) complex
        Its vertices there, in units, as its path has them.
    scale : float
        Units per unit of the drawing.
    """
    a, b = (_dashes_along(*each, scale) for each in zip(styles, lines, ends, strict=True))
    if not (a.stroke_dasharray and b.stroke_dasharray):
        return a, b
    # A vertex in the middle: what is before it may be drawn on or back.
    known = [cumulative_lengths(points) for points in ends]
    middle = int(np.searchsorted(known[0] + known[1], (known[0][-1] + known[1][-1]) / 2.0))
    wanted = a.stroke_dashoffset + float(known[0][middle] - known[1][middle]) / scale
    period = sum(b.stroke_dasharray) * (1 + len(b.stroke_dasharray) % 2)
    turns = round((wanted - b.stroke_dashoffset) / period)
    return a, b._replace(stroke_dashoffset=b.stroke_dashoffset + turns * period)


def _dashes_along(style: Style, line: PenLine, points: ComplexArray, scale: float) -> Style:
    """Return a style with its dashes in the direction and from the start of a part of a line."""
    lengths = lengths_along(line, points) if style.stroke_dasharray else None
    if lengths is None:
        return style
    begin = float(lengths[0]) / scale
    if all(low <= high for low, high in pairwise(lengths)):
        return style._replace(stroke_dashoffset=style.stroke_dashoffset + begin)
    dashes = style.stroke_dasharray * (1 + len(style.stroke_dasharray) % 2)
    # From the other side: the last dash comes first, and the last gap is what is left before it.
    turned = (*dashes[-2::-1], dashes[-1])
    return style._replace(
        stroke_dasharray=turned, stroke_dashoffset=sum(dashes[:-1]) - style.stroke_dashoffset - begin
    )


class End(NamedTuple):
    """An end of a piece that may be joined to another one: whose, which, where, and the direction out of it."""

    piece: int
    side: int
    place: complex
    direction: complex


def ends_near(ends: Sequence[End], reaches: Iterable[float]) -> Iterator[tuple[int, int]]:
    """Yield the numbers of each two ends that are within the reach of the first of them."""
    places = np.array([end.place for end in ends])
    for i, (end, reach) in enumerate(zip(ends, reaches, strict=True)):
        near = np.flatnonzero(np.abs(places[i + 1 :] - end.place) <= reach) + i + 1
        yield from ((i, j) for j in near.tolist())


def chains(count: int, joined: Mapping[_Side, _Side]) -> Iterator[tuple[list[_Side], bool]]:
    """Yield the chains that pieces form whose ends are joined: each as its pieces, and whether it is closed.

    Parameters
    ----------
    count : int
        Number of pieces.
    joined : mapping
        For each joined end, a piece's number and its side (0 or 1), the end that it is joined to; in both directions.

    Yields
    ------
    chain : list of (int, int)
        The numbers of its pieces, each with the side that comes first.
    closed : bool
        Whether the last piece is joined to the first.
    """
    done: set[int] = set()
    for piece in range(count):
        if piece in done:
            continue
        here, side, seen = piece, 0, {piece}
        while (other := joined.get((here, side))) and other[0] not in seen:  # back to where the chain begins
            here, side = other[0], 1 - other[1]
            seen.add(here)
        chain = [(here, side)]
        done.add(here)
        while (other := joined.get((here, 1 - side))) and other[0] not in done:
            here, side = other
            chain.append(other)
            done.add(here)
        yield chain, other is not None
