"""Both outlines cut at places that correspond, so that a step of the graph takes an edge to an edge of its like.

The steps of a path are whole edges. Two polygons of one curve that were cut apart from each other have edges of other
lengths, and vertices in other places: a path between them climbs stairs, and where it grows an edge from a vertex it
pays twice the edge's length for nothing. So a first path says roughly which place goes to which. It is smoothed, each
outline is also cut where the other has a vertex, and the least path is found once more; and again, until the work stops
falling.

Not in the paper, whose polygons are given.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import edge_parts
from shapeblend_cli.geometry.polyline import cumulative_lengths, from_end_to_end
from shapeblend_cli.matching.angles import Corners
from shapeblend_cli.matching.solve import is_proven
from shapeblend_cli.model import Polygon, unroll

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import ComplexArray, Contour, Correspondence, FloatArray, IntArray

    Solved = tuple["FlatContour", "FlatContour", Correspondence]
    Solve = Callable[["FlatContour", "FlatContour", IntArray | None, float], Solved]

ROUNDS = 3
"""The outlines are cut anew at most so often."""

EVENNESS, BASE = 2e-3, 1e-2
"""How much it counts that a path is even, against that it goes through places that bend; and how much the path that was
found counts where nothing bends, in radians for the whole outline."""

FIXED = 1e6
"""Weight of the ends of open outlines, in radians."""

SHORTEST_STEP = 1e-15
"""Steps along outlines, as shares of their length, are at least as long: shorter ones are rounding."""

NOISE = 1e-12
"""What rounding adds to work, at most."""

NEAR = 0.15
"""A place nearer to a vertex than this share of the usual edge is the vertex."""


@dataclass(frozen=True, eq=False)
class FlatContour:
    """A contour and its polygon."""

    contour: Contour
    polygon: Polygon

    @cached_property
    def lengths(self) -> FloatArray:
        """Return where vertices are along the outline, as shares of it; of a closed one the last is 1."""
        lengths = cumulative_lengths(from_end_to_end(self.polygon.vertices, self.polygon.closed))
        return lengths / lengths[-1]

    def cut_at(self, places: FloatArray, near: float = NEAR) -> FlatContour:
        """Return the contour with more vertices, on its curves, at shares of the outline.

        There are none nearer to a vertex, or to each other, than a share of the usual edge.
        """
        polygon, own = self.polygon, self.lengths
        places = np.sort(places % 1.0 if polygon.closed else places)
        least = near * _median(np.diff(own))
        before = np.clip(np.searchsorted(own, places, side="right") - 1, 0, len(own) - 2)
        places = places[np.minimum(places - own[before], own[before + 1] - places) > least]
        places = places[_apart(places, least)]

        points, segment, parameter = self.points_between(places)
        order = np.argsort(np.append(own[: len(polygon.vertices)], places), kind="stable")
        cut = Polygon(
            np.append(polygon.vertices, points)[order],
            np.append(polygon.segment, segment)[order],
            np.append(polygon.parameter, parameter)[order],
            polygon.closed,
        )
        return replace(self, polygon=cut)

    def points_between(self, places: FloatArray) -> tuple[ComplexArray, IntArray, FloatArray]:
        """Return points of the contour at shares of the outline in [0, 1), the segments they are on, and parameters."""
        # On the edge from one vertex to the next the parameter of the segment grows evenly.
        own = self.lengths
        edge = np.searchsorted(own, places, side="right") - 1
        segments, start, end = edge_parts(self.contour, self.polygon)
        segment = segments[edge]
        share = (places - own[edge]) / (own[edge + 1] - own[edge])
        parameter = start[edge] + (end - start)[edge] * share
        return cubics.evaluate(self.contour.segments[segment], parameter), segment, parameter


def solve_with_common_cuts(
    a: FlatContour,
    b: FlatContour,
    found: Correspondence,
    solve: Solve,
    effort: str,
) -> Solved:
    """Cut two outlines where they correspond and solve again near that, until the work stops falling.

    The work before the first cut is of another problem, and does not count. What is solved last is solved everywhere,
    where the effort allows.

    Parameters
    ----------
    a, b : FlatContour
        In the same direction.
    found : Correspondence
        Of their polygons.
    solve : callable
        Finds the correspondence of polygons of these contours; near a vertex of the second for each of the first, if
        that is given; and may count on that some correspondence takes a given work. Returns it after the contours,
        whose polygons it may have changed.
    effort : {'auto', 'exact', 'fast'}
        See `Search`.

    Returns
    -------
    a, b : FlatContour
        With all vertices of those given, and more.
    correspondence : Correspondence
        Of these two.
    """
    solved = solve(*common_cuts(a, b, (a, b), found), np.inf)
    for _ in range(ROUNDS - 1):
        again = solve(*common_cuts(a, b, solved[:2], solved[2]), np.inf)
        if again[2].work >= solved[2].work:
            break
        solved = again
    if is_proven(len(solved[0].polygon.vertices), len(solved[1].polygon.vertices), effort):
        solved = solve(*solved[:2], None, solved[2].work)
    return solved


def solve_among(
    start: Solved,
    solve_some: Solve,
    solve: Solve,
    effort: str,
    most: float | None,
    known: float = np.inf,
) -> Solved | None:
    """Solve with common cuts where only some correspondences are wanted.

    Parameters
    ----------
    start : Solved
        Two contours in the same direction, and the first of these correspondences.
    solve_some : callable
        Finds the least work of those that are wanted; see `solve_with_common_cuts`.
    solve : callable
        Finds the least work of all.
    effort : {'auto', 'exact', 'fast'}
    most : float or None
        How many times the least work it may take; None is any number.
    known : float
        The work of some correspondence.

    Returns
    -------
    a, b : FlatContour
    correspondence : Correspondence
        The lower bound is that of all correspondences of these two, where it was looked for.

    None if it takes too much work.
    """
    return unless_far_more(solve_with_common_cuts(*start, solve_some, effort), solve, most, known)


def unless_far_more(solved: Solved, solve: Solve, most: float | None, known: float = np.inf) -> Solved | None:
    """Return a correspondence with the lower bound of all, or None if it takes too many times the least work.

    See `solve_among` for the parameters.
    """
    a, b, found = solved
    least = solve(a, b, None, found.work)[2]
    if most is not None and found.work > most * min(known, least.work) + NOISE:
        return None
    return a, b, replace(found, lower_bound=min(least.lower_bound, found.work))


def common_cuts(
    a: FlatContour, b: FlatContour, solved: Sequence[FlatContour], found: Correspondence
) -> tuple[FlatContour, FlatContour, IntArray]:
    """Cut each contour where the other has a vertex, by a correspondence of the same contours with other vertices.

    Return both, and the vertex of the second that is nearest to the partner of each vertex of the first.
    """
    place_a, place_b = _smoothed_path(solved[0], solved[1], found.dots)
    closed = a.polygon.closed
    own_a, own_b = (flat.lengths[: len(flat.polygon.vertices)] for flat in (a, b))
    cut_a = a.cut_at(_along(own_b, place_b, place_a, closed))
    cut_b = b.cut_at(_along(own_a, place_a, place_b, closed))
    partners = _along(cut_a.lengths[: len(cut_a.polygon.vertices)], place_a, place_b, closed)
    known = cut_b.lengths
    nearest = np.round(np.interp(partners % 1.0 if closed else partners, known, np.arange(len(known))))
    return cut_a, cut_b, nearest.astype(np.intp) % len(cut_b.polygon.vertices)


def _smoothed_path(a: FlatContour, b: FlatContour, dots: IntArray) -> tuple[FloatArray, FloatArray]:
    """Return places along both outlines that correspond, without stairs; neither ever falls.

    Between places where both outlines bend the same way, length goes to length evenly: no path stretches less. Let u be
    the mean of the places of a dot, d how much B is ahead of A there, and w the lesser one of both turns. What d is to
    be instead, x, has the least sum of ``w (x - d)^2`` over dots and ``EVENNESS (x' - x)^2 / (u' - u)`` over steps.
    """
    closed = a.polygon.closed
    counts = len(a.polygon.vertices), len(b.polygon.vertices)
    positions = unroll(dots, counts if closed else None)
    place_a, place_b = (
        np.interp(positions[:, k] % counts[k], np.arange(len(own)), own) + positions[:, k] // counts[k]
        for k, own in enumerate((a.lengths, b.lengths))
    )
    middle, ahead = 0.5 * (place_a + place_b), place_b - place_a
    turns = [
        np.asarray(Corners(flat.polygon.vertices, closed).turn)[dots[:, k]] for k, flat in enumerate((a, b))
    ]
    weight = np.where(turns[0] * turns[1] > 0.0, np.minimum(*np.abs(turns)), 0.0)
    steps = np.maximum(np.diff(middle), SHORTEST_STEP)
    weight[: len(steps)] += BASE * steps
    if not closed:
        weight[[0, -1]] = FIXED
    smooth = _even_between(ahead[: len(dots)], weight, EVENNESS / steps, closed)
    if closed:
        smooth = np.append(smooth, smooth[0])
    return np.maximum.accumulate(middle - 0.5 * smooth), np.maximum.accumulate(middle + 0.5 * smooth)


def _even_between(values: FloatArray, weight: FloatArray, spring: FloatArray, closed: bool) -> FloatArray:
    """Return numbers x with the least sum of weight (x - values)^2 and spring (x' - x)^2, x' being the next of x.

    Closed, the first follows the last. The matrix is tridiagonal; two corners that a closed one has besides are taken
    out of it and put back by the formula of Sherman and Morrison.
    """
    count = len(values)
    diagonal = weight.copy()
    diagonal[: len(spring)] += spring
    diagonal[1:] += spring[: count - 1]
    right = weight * values
    if not closed:
        return _tridiagonal(diagonal, spring, right)
    last = float(spring[-1])
    corner = np.zeros(count)
    corner[[0, -1]] = 1.0, -1.0  # spring (x_first - x_last)^2 alone
    diagonal[-1] -= last
    inside, outside = (_tridiagonal(diagonal, spring[:-1], side) for side in (right, corner))
    share = last * (inside[0] - inside[-1]) / (1.0 + last * (outside[0] - outside[-1]))
    return inside - share * outside


def _tridiagonal(diagonal: FloatArray, beside: FloatArray, right: FloatArray) -> FloatArray:
    """Solve a symmetric, diagonally dominant system whose other elements are minus `beside`."""
    pivots, values = diagonal.tolist(), right.tolist()
    for k, spring in enumerate(beside.tolist()):
        share = spring / pivots[k]
        pivots[k + 1] -= share * spring
        values[k + 1] += share * values[k]
    values[-1] /= pivots[-1]
    for k in range(len(beside) - 1, -1, -1):
        values[k] = (values[k] + beside[k] * values[k + 1]) / pivots[k]
    return np.array(values)


def _along(places: FloatArray, known: FloatArray, partners: FloatArray, closed: bool) -> FloatArray:
    """Return the partners of places on an outline, where some and their partners are known, rising."""
    if closed:
        places = known[0] + (places - known[0]) % 1.0
    return np.interp(places, known, partners)


def _median(values: FloatArray) -> float:
    """Return the median, without the modules that numpy's own loads."""
    rising, count = np.sort(values), len(values)
    return 0.5 * float(rising[(count - 1) // 2] + rising[count // 2])


def _apart(places: FloatArray, least: float) -> IntArray:
    """Return the numbers of rising places that lie further than `least` from the one before that is kept."""
    kept: list[int] = []
    last = -np.inf
    for k, place in enumerate(places.tolist()):
        if place - last > least:
            kept.append(k)
            last = place
    return np.array(kept, np.intp)
