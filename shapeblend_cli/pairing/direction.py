"""In which direction B is traversed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.errors import MatchError
from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.geometry.polygons import orientation, reverse_polygon
from shapeblend_cli.matching.solve import Search, least_work
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.pairing.constraints import Constraints, stiffness
from shapeblend_cli.pairing.upright import upright

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.model import Correspondence, Polygon
    from shapeblend_cli.settings import Settings

    Watch = Callable[[float], None]


def choose_direction(
    a: Polygon, b: Polygon, settings: Settings, constraints: Constraints, watch: Watch | None = None
) -> tuple[bool, Correspondence]:
    """Solve in the direction that `settings.reverse` asks for; with `auto` in A's, or the cheaper one if undecided.

    Return whether B was reversed, and the correspondence; if so its dots number the vertices of `reverse_polygon`.
    """
    candidates = reversed_candidates(a, b, settings.reverse)
    unit_a = to_unit_box(a)
    solved: list[tuple[bool, Correspondence]] = []
    errors: list[MatchError] = []
    for run, is_reversed in enumerate(candidates):
        # Only the vertices count here, and they do not depend on the number of segments.
        directed = reverse_polygon(b, 1) if is_reversed else b
        unit_b = to_unit_box(directed)
        wires = Wires(unit_a, unit_b, a.closed, settings.constants, stiffness(a, settings))
        search = Search(
            start=constraints.start,
            pins=constraints.pinned_vertices(a, directed),
            band=settings.band,
            solver=settings.solver,
            effort=settings.effort,
        )
        try:
            least = least_work(wires, search, watch_part(watch, run, len(candidates)))
        except MatchError as error:  # pins that cross in one direction need not cross in the other
            errors.append(error)
            continue
        if a.closed and not constraints.start and not constraints.pins and settings.band is None:
            least = upright(wires, least, search, alone=constraints.is_alone)
        solved.append((is_reversed, least))
    if not solved:
        raise errors[0]
    return min(solved, key=lambda candidate: candidate[1].work)


def reversed_candidates(a: Polygon, b: Polygon, reverse: str) -> list[bool]:
    """Return whether to reverse B: one answer, or both where only the work can tell.

    By default closed polygons are gone through with equal orientation.
    """
    if reverse != "auto":
        return [reverse == "yes"]
    orientations = orientation(a), orientation(b)
    return [False, True] if 0 in orientations else [orientations[0] != orientations[1]]


def watch_part(watch: Watch | None, run: int, runs: int) -> Watch | None:
    """Return what watches one of several runs that take about the same time."""
    return None if watch is None else lambda share: watch((run + share) / runs)
