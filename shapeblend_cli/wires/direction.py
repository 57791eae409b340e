"""In which direction B is traversed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.geometry.polygons import orientation, reverse_polygon
from shapeblend_cli.matching.solve import Search, least_work
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.wires.constraints import Constraints, stiffness

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.model import Correspondence, IntArray, Polygon
    from shapeblend_cli.options.settings import Settings

    Watch = Callable[[float], None]


CLEAR = 4.0
"""Minimum ratio between the summed squared distances of the ends of open polygons, both ways round, to be decided."""


def choose_direction(
    a: Polygon, b: Polygon, settings: Settings, constraints: Constraints, watch: Watch | None = None
) -> tuple[bool, Correspondence]:
    """Solve in the direction that `settings.reverse` asks for; with `auto` in A's, or the cheaper one if undecided.

    Returns
    -------
    is_reversed : bool
    correspondence : Correspondence
        If reversed, its dots number the vertices of `reverse_polygon`.
    """
    candidates = reversed_candidates(a, b, settings.reverse)
    solved: list[tuple[bool, Correspondence]] = []
    errors: list[MatchError] = []
    for run, is_reversed in enumerate(candidates):
        # Only the vertices count here, and they do not depend on the number of segments.
        directed = reverse_polygon(b, 1) if is_reversed else b
        try:
            found = solve(a, directed, settings, constraints, watch_part(watch, run, len(candidates)))
        except MatchError as error:  # pins that cross in one direction need not cross in the other
            errors.append(error)
        else:
            solved.append((is_reversed, found))
    if not solved:
        raise errors[0]
    return min(solved, key=lambda candidate: candidate[1].work)


def solve(
    a: Polygon,
    b: Polygon,
    settings: Settings,
    constraints: Constraints,
    watch: Watch | None = None,
    near: IntArray | None = None,
    known: float = np.inf,
) -> Correspondence:
    """Solve as polygons run, knowing the work of a path, or only near a path, if that takes less (see `Search`).

    Constraints that cannot be met raise a MatchError.
    """
    search = Search(
        start=constraints.start,
        pins=constraints.pinned_vertices(a, b),
        band=settings.band,
        solver=settings.solver,
        effort=settings.effort,
        near=near,
        known=known if near is None else np.inf,
        most=np.inf if near is None else known,
    )
    return least_work(wires_of(a, b, settings), search, watch)


def wires_of(a: Polygon, b: Polygon, settings: Settings) -> Wires:
    """Return polygons as wires in the unit box, A stiff where that is required."""
    return Wires(to_unit_box(a), to_unit_box(b), a.closed, settings.constants, stiffness(a, settings))


def reversed_candidates(a: Polygon, b: Polygon, reverse: str) -> list[bool]:
    """Return whether to reverse B: one answer, or both where only the work can tell.

    By default closed polygons get one orientation, and the ends of open ones go to the nearer ends, if that is clear.
    """
    if reverse != "auto":
        return [reverse == "yes"]
    if not a.closed:
        ends = [
            (polygon.vertices[[0, -1]] - polygon.box.centre) / polygon.box.larger_side for polygon in (a, b)
        ]
        apart = [float((np.abs(ends[0] - other) ** 2).sum()) for other in (ends[1], ends[1][::-1])]
        return [False, True] if max(apart) < CLEAR * min(apart) else [apart[1] < apart[0]]
    orientations = orientation(a), orientation(b)
    return [False, True] if 0 in orientations else [orientations[0] != orientations[1]]


def watch_part(watch: Watch | None, run: int, runs: int) -> Watch | None:
    """Return a watch on one of several runs that take about the same time."""
    return None if watch is None else lambda share: watch((run + share) / runs)
