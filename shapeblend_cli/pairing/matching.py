"""One contour into another: solved where there are two, grown from a point where there is one."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.geometry.polygons import orientation, reverse_contour, reverse_polygon
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.match.solve import least_work
from shapeblend_cli.match.work import Wires
from shapeblend_cli.model import Contour, ContourBlend, Correspondence, CubicPath, Polygon, unroll
from shapeblend_cli.pairing.costs import coarse_work
from shapeblend_cli.pairing.decompose import LINE
from shapeblend_cli.pairing.upright import upright

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.model import FloatArray
    from shapeblend_cli.pairing.constraints import Constraints
    from shapeblend_cli.pairing.decompose import PlacedContour
    from shapeblend_cli.settings import Settings

    Pin = tuple[complex, complex]
    Watch = Callable[[float], None]

OPENINGS = 24
"""Nodes of an outline at which it may be opened to become a line, at most."""


def match_contours(
    a: PlacedContour,
    b: PlacedContour,
    settings: Settings,
    constraints: Constraints,
    watch: Watch | None,
    turn: float = 0.0,
    *,
    alone: bool = True,
) -> ContourBlend:
    """Solve the correspondence of two contours.

    Parameters
    ----------
    a, b : PlacedContour
        B's is reversed where that agrees better with A's direction. An outline that is to become a line is opened.
    settings : Settings
    constraints : Constraints
    watch : callable or None
        Told now and then which share of the work is done, from 0 to 1.
    turn : float
        By what angle B is turned back for that, in radians.
    alone : bool
        Whether no other contours are matched beside these.

    Raises
    ------
    MatchError
        Constraints that cannot be met.
    """
    if (a.role == LINE) != (b.role == LINE):
        a, b = (a, _opened(b, a, settings)) if a.role == LINE else (_opened(a, b, settings), b)
    turned = _turned_back(b.polygon, turn)
    if turn:
        constraints = constraints._replace(pins=[_pin_turned_back(pin, turn) for pin in constraints.pins])
    backwards, found = choose_direction(a.polygon, turned, settings, constraints, watch, alone=alone)
    contour_b, polygon_b = b.contour, b.polygon
    if backwards:
        polygon_b = reverse_polygon(polygon_b, len(contour_b.segments))
        contour_b = reverse_contour(contour_b)
    scales = a.polygon.box.larger_side, turned.box.larger_side
    return _blend(
        (a.number, b.number), (a.contour, contour_b), (a.polygon, polygon_b), scales, found
    )._replace(rotation=turn)


def _blend(
    numbers: tuple[int | None, int | None],
    contours: tuple[Contour, Contour],
    polygons: tuple[Polygon, Polygon],
    scales: tuple[float, float],
    correspondence: Correspondence,
) -> ContourBlend:
    """Put a blend together; it moves along the polygons, a line for every step of the correspondence."""
    dots, closed = correspondence.dots, correspondence.closed
    period = len(polygons[0].vertices), len(polygons[1].vertices)
    along = unroll(dots, period if closed else None)
    start, end = (
        CubicPath(
            lines := cubics.lines(polygon.vertices[dots[:, side]], closed),
            np.ones(len(lines), np.bool_),
            closed,
        )
        for side, polygon in enumerate(polygons)
    )
    return ContourBlend(
        *numbers, *contours, *polygons, *scales, correspondence, start, end, (along[:, 0], along[:, 1])
    )


def _turned_back(polygon: Polygon, turn: float) -> Polygon:
    return Similarity.rotation(-turn).polygon(polygon) if turn else polygon


def _pin_turned_back(pin: Pin, turn: float) -> Pin:
    """A pin for B turned back; vertex numbers stay what they are."""
    return pin if isinstance(pin[1], int) else (pin[0], Similarity.rotation(-turn).point(pin[1]))


def grow_from_point(part: PlacedContour, point: complex, *, of_b: bool) -> ContourBlend:
    """A contour that grows from a point, if it is B's, or shrinks to one, if it is A's. Nothing is solved."""
    size = part.polygon.box.larger_side
    spot = Polygon(np.array([point]), np.zeros(1, np.intp), np.zeros(1), part.polygon.closed)
    still = replace(part.contour, segments=np.full_like(part.contour.segments, point))
    every = np.arange(len(part.polygon.vertices))
    dots = np.stack([0 * every, every] if of_b else [every, 0 * every], axis=1)
    nothing = Correspondence(dots, part.polygon.closed, 0.0, 0.0, 0.0, 0, 0.0, 0)
    if of_b:
        return _blend((None, part.number), (still, part.contour), (spot, part.polygon), (size, size), nothing)
    return _blend((part.number, None), (part.contour, still), (part.polygon, spot), (size, size), nothing)


def choose_direction(
    a: Polygon,
    b: Polygon,
    settings: Settings,
    constraints: Constraints,
    watch: Watch | None,
    *,
    alone: bool,
) -> tuple[bool, Correspondence]:
    """Solve for the direction of B that agrees with A's; where none is decided, for the cheaper of both.

    Returns
    -------
    backwards : bool
        Whether B was gone through backwards; then the dots number the vertices of `reverse_polygon`.
    correspondence : Correspondence
    """
    ways = _backwards(a, b, settings.reverse)
    unit_a = to_unit_box(a)
    weight = _weight(a, settings.stiff)
    solved: list[tuple[bool, Correspondence]] = []
    refused: list[MatchError] = []
    for run, backwards in enumerate(ways):
        # Only the vertices count here, and they do not depend on the number of segments.
        candidate = reverse_polygon(b, 1) if backwards else b
        unit_b = to_unit_box(candidate)
        solve = partial(
            least_work,
            unit_a,
            unit_b,
            a.closed,
            settings.constants,
            weight=weight,
            solver=settings.solver,
            effort=settings.effort,
        )
        try:
            found = solve(
                start=constraints.start,
                pins=[_vertices(a, candidate, pin) for pin in constraints.pins],
                band=settings.band,
                watch=part_of(watch, run, len(ways)),
            )
        except MatchError as error:  # pins that cross one way round need not cross the other way
            refused.append(error)
        else:
            if a.closed and not constraints.start and not constraints.pins and settings.band is None:
                found = upright(unit_a, unit_b, found, solve, settings.constants, alone=alone)
            solved.append((backwards, found))
    if not solved:
        raise refused[0]
    return min(solved, key=lambda way: way[1].work)


def solved_wires(contour: ContourBlend, settings: Settings) -> Wires:
    """The wires of a matched contour as they were solved: in the unit box, B turned back, A stiff where asked for."""
    turned = _turned_back(contour.polygon_b, contour.rotation)
    return Wires(
        to_unit_box(contour.polygon_a),
        to_unit_box(turned),
        contour.correspondence.closed,
        settings.constants,
        _weight(contour.polygon_a, settings.stiff),
    )


def part_of(watch: Watch | None, run: int, runs: int) -> Watch | None:
    """What watches one of several runs."""
    return None if watch is None else lambda share: watch((run + share) / runs)


def _backwards(a: Polygon, b: Polygon, reverse: str) -> list[bool]:
    """Whether to go through B backwards: one answer, or both where only the work can tell."""
    if reverse != "auto":
        return [reverse == "yes"]
    ways = orientation(a), orientation(b)
    return [False, True] if 0 in ways else [ways[0] != ways[1]]


def _vertices(a: Polygon, b: Polygon, pin: tuple[complex, complex]) -> tuple[int, int]:
    """Two vertex numbers, from numbers or from points."""
    if isinstance(pin[0], int) and isinstance(pin[1], int):
        return pin[0], pin[1]
    return int(np.abs(a.vertices - pin[0]).argmin()), int(np.abs(b.vertices - pin[1]).argmin())


def _weight(a: Polygon, stiff: tuple[tuple[complex, float, float], ...]) -> FloatArray | None:
    """Stiffness at A's vertices; regions that overlap multiply."""
    if not stiff:
        return None
    weight = np.ones(len(a.vertices))
    for point, radius, factor in stiff:
        weight[np.abs(a.vertices - point) <= radius] *= factor
    return weight


def _opened(outline: PlacedContour, line: PlacedContour, settings: Settings) -> PlacedContour:
    """An outline cut at the node from which it becomes the line, or comes of it, with the least work."""
    nodes = np.flatnonzero(outline.polygon.parameter == 0.0)
    nodes = nodes[:: -(-len(nodes) // OPENINGS)] if len(nodes) else np.zeros(1, np.intp)
    p = to_unit_box(line.polygon)
    unit = to_unit_box(outline.polygon)

    def work(vertex: int) -> float:
        rolled = np.roll(unit, -vertex)
        return coarse_work(p, np.append(rolled, rolled[0]), False, settings.constants)

    return cut_open(outline, min(nodes.tolist(), key=work))


def cut_open(outline: PlacedContour, vertex: int) -> PlacedContour:
    """A closed contour as an open one that begins and ends at a vertex which is a node."""
    polygon, contour = outline.polygon, outline.contour
    first = int(polygon.segment[vertex])
    count = len(contour.segments)
    rolled = Contour(
        np.roll(contour.segments, -first, axis=0), np.roll(contour.straight, -first), closed=False
    )
    opened = Polygon(
        np.append(np.roll(polygon.vertices, -vertex), polygon.vertices[vertex]),
        np.append((np.roll(polygon.segment, -vertex) - first) % count, count - 1),
        np.append(np.roll(polygon.parameter, -vertex), 1.0),
        closed=False,
    )
    return outline._replace(contour=rolled, polygon=opened, role=LINE)
