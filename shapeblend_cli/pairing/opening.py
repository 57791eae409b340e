"""Rings that become an outline with a hole less: they open where that takes the least work, as an O becomes a C."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.anatomy.decompose import EXTERIOR, PlacedContour, holes_by_exterior
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.cutting import run_of_segments
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.grouping import assign
from shapeblend_cli.geometry.placement import to_unit_box
from shapeblend_cli.model import Contour
from shapeblend_cli.wires.rough import rough_work

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.anatomy.decompose import ContourPair
    from shapeblend_cli.model import Polygon
    from shapeblend_cli.options.constants import WorkConstants
    from shapeblend_cli.options.settings import Settings

    Flat = tuple[Contour, Polygon]

PLACES = 40
"""Number of places, evenly round its hole, at which a ring may open."""

LEAST_HOLE = 0.15
"""Minimum area of a ring's hole, as a share of the area within the outer edge."""

LEAST_LOOP = 0.04
"""Minimum area of a hole in a loop, in the same measure, such as the shackle of a padlock."""

LOOP = 0.45
"""Maximum width of a loop at its narrowest, in sizes of its hole."""

WIDTH = 0.5
"""Additional weight of the work at a place where a ring is twice as wide as at its narrowest."""

NARROW = 1e-3
"""Minimum width of a ring, as a share of its size: a narrower one counts as so wide."""

CROWD = 100
"""Maximum number of pairs among which rings are opened: each is tried at many places, and no one looks at so many."""

CLEAR = 0.6
"""Maximum work of an opened ring, as a share of the work of its outer edge alone."""


def open_rings(
    a: Sequence[PlacedContour],
    b: Sequence[PlacedContour],
    pairs: Sequence[ContourPair],
    settings: Settings,
    required: Mapping[int, int],
) -> list[ContourPair]:
    """Open paired rings whose partner has a hole less, if that takes far less work. Return all pairs.

    An opened ring has the number of its outer edge, and its hole is part of it. Rings with a stroke, which would show
    the cut, rings of required pairs, B's numbers by A's, and those of a crowd stay closed.
    """
    if len(pairs) > CROWD:
        return list(pairs)
    opened = []
    holes_a, holes_b = holes_by_exterior(a), holes_by_exterior(b)
    for p, q in pairs:
        inner_a, inner_b = (
            [hole for hole in holes.get(one.number, ()) if one.contains_hole(hole)]
            for one, holes in ((p, holes_a), (q, holes_b))
        )
        is_plain = all(one.style.fill is not None and one.style.stroke is None for one in (p, q))
        is_free = p.role == q.role == EXTERIOR and required.get(p.number) != q.number
        more = len(inner_a) - len(inner_b)
        if is_plain and is_free and abs(more) == 1:
            if more > 0:
                p = _opened(p, _without_partner(inner_a, inner_b), q, settings)
            else:
                q = _opened(q, _without_partner(inner_b, inner_a), p, settings)
        opened.append((p, q))
    return opened


def _without_partner(holes: Sequence[PlacedContour], others: Sequence[PlacedContour]) -> PlacedContour:
    """Return the hole that is left when the others of a ring become as many holes, by places and sizes."""
    away = np.array([[abs(p.centre - q.centre) + abs(p.size - q.size) for q in others] for p in holes])
    taken = {i for i, _ in assign(away)} if others else set()
    return next(hole for k, hole in enumerate(holes) if k not in taken)


def _opened(
    ring: PlacedContour, hole: PlacedContour, partner: PlacedContour, settings: Settings
) -> PlacedContour:
    """Return a ring opened where it becomes its partner with the least work; unopened if that is not much less."""
    if hole.area < LEAST_LOOP * ring.area:
        return ring
    sides = (ring.contour, ring.polygon), (hole.contour, hole.polygon)
    widths = NARROW * ring.size, LOOP * hole.size if hole.area < LEAST_HOLE * ring.area else np.inf
    found = _opening(*sides, partner.polygon, widths, settings.vertices, settings.constants)
    if found is None:
        return ring
    outline, polygon = found
    return ring._replace(contour=outline, polygon=polygon, is_piece=True, opened=hole.number)


@lru_cache(maxsize=64)
def _opening(
    ring: Flat,
    hole: Flat,
    partner: Polygon,
    limits: tuple[float, float],
    vertices: int,
    constants: WorkConstants,
) -> Flat | None:
    """Return the outline of an opened ring; None if that takes not much less work.

    Other pairings of the same drawings ask for the same. `limits` are the least width that counts, and the largest
    width of the ring where it is narrowest.
    """
    edge, inner = ring[1].vertices, hole[1].vertices
    ends = np.linspace(0, len(inner), PLACES, endpoint=False).astype(np.intp)
    ends = ends[np.diff(ends, prepend=-1) > 0]
    across = np.abs(edge[:, None] - inner[ends])
    starts = across.argmin(axis=0)
    widths = across.min(axis=0)
    if widths.min() > limits[1]:
        return None
    target = to_unit_box(partner)
    weights = 1.0 + WIDTH * np.maximum(widths / max(float(widths.min()), limits[0]) - 1.0, 0.0)
    best: tuple[float, int, float] | None = None
    # Where the ring is narrow, much work is hardly ever less than elsewhere.
    for k in np.argsort(weights, kind="stable").tolist():
        weight = float(weights[k])
        outline = _keyhole(ring, hole, int(starts[k]), int(ends[k]))
        polygon = flatten(outline, vertices)
        most = best[0] / weight if best else np.inf
        work = rough_work(to_unit_box(polygon), target, True, constants, most)
        cut = work * weight, k, work
        if best is None or cut < best:
            best, found = cut, (outline, polygon)
    assert best is not None, "a hole has vertices"
    closed = rough_work(to_unit_box(ring[1]), target, True, constants)
    return found if best[2] <= CLEAR * closed < np.inf else None


def _keyhole(ring: Flat, hole: Flat, i: int, j: int) -> Contour:
    """Return the outer edge of a ring from its vertex i once round, and its hole from vertex j, as one outline."""
    outer, outer_lines = run_of_segments(*ring, i, i)
    inner, inner_lines = run_of_segments(*hole, j, j)
    there, back = cubics.line(outer[-1, 3], inner[0, 0]), cubics.line(inner[-1, 3], outer[0, 0])
    return Contour(
        np.vstack([outer, there, inner, back]),
        np.concatenate([outer_lines, [True], inner_lines, [True]]),
        closed=True,
    )
