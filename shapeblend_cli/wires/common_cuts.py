"""Both outlines cut at places that correspond, so that a step of the graph takes an edge to an edge of its like.

The steps of a path are whole edges. Two polygons of one curve that were cut apart from each other have edges of other
lengths, and vertices in other places: a path between them climbs stairs, and where it grows an edge from a vertex it
pays twice the edge's length for nothing. A first path shows roughly which places correspond. It is smoothed, each
outline is also cut where the other has a vertex, and the least path is found once more; and again, until the work stops
falling.

Not in the paper, whose polygons are given.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polyline import interpolated, tridiagonal
from shapeblend_cli.matching.angles import turns
from shapeblend_cli.matching.solve import NothingLess, is_proven
from shapeblend_cli.model import unroll
from shapeblend_cli.wires.contour_match import Proof, Solved

if TYPE_CHECKING:
    from shapeblend_cli.geometry.flat_contour import FlatContour
    from shapeblend_cli.model import FloatArray, IntArray
    from shapeblend_cli.wires.contour_match import ContourMatch, Solve

ROUNDS = 3
"""Maximum number of times that the outlines are cut."""

EVENNESS = 2e-3
"""Weight of an even path, in radians: outweighed where both outlines bend by more."""

BASE = 1e-2
"""Weight of the path as it was found, where nothing bends, in radians for the whole outline."""

FIXED = 1e6
"""Weight of the ends of open outlines, in radians."""

FAR_MORE = 1.1
"""Maximum work that is found everywhere, as a multiple of the work found near a path: more was not searched in full."""

SHORTEST_STEP = 1e-15
"""Minimum step along an outline, as a share of its length: shorter ones are rounding."""


def solve_with_common_cuts(match: ContourMatch) -> Solved:
    """Solve two contours, each cut where the other has vertices."""
    solved = refine(Solved(match.a, match.b, match.first), match.solve)
    a, b, found = solved
    if not is_proven(len(a.polygon.vertices), len(b.polygon.vertices), match.settings.effort):
        return solved
    if match.settings.effort == "exact":
        everywhere = match.everywhere(solved)
        # Else there was too much to search.
        return everywhere if everywhere.correspondence.work <= FAR_MORE * found.work else solved
    return Solved(a, b, replace(found, bound=Proof(match, solved)))


def refine(start: Solved, solve: Solve) -> Solved:
    """Cut two contours where they correspond and solve again near that, until the work stops falling.

    The work before the first cut is of another problem, and does not count.

    Parameters
    ----------
    start : Solved
        Two contours in the same direction.
    solve : callable
        Finds the correspondence of these contours with other vertices: near a vertex of the second for each of the
        first, and where only less than a given work is of use: `NothingLess` may be raised. It may change the vertices.
    """
    a, b, _ = start
    solved = solve(*common_cuts(a, b, start), np.inf)
    for _ in range(ROUNDS - 1):
        try:
            again = solve(*common_cuts(a, b, solved), solved.correspondence.work)
        except NothingLess:
            break
        if again.correspondence.work >= solved.correspondence.work:
            break
        solved = again
    return solved


def common_cuts(a: FlatContour, b: FlatContour, solved: Solved) -> tuple[FlatContour, FlatContour, IntArray]:
    """Cut each contour where the other has a vertex, by a correspondence of the same contours with other vertices.

    Returns
    -------
    cut_a, cut_b : FlatContour
    near : (m,) int
        The vertex of B nearest to the partner of each vertex of A.
    """
    place_a, place_b = _smoothed_path(solved.a, solved.b, solved.correspondence.dots)
    closed = a.polygon.closed
    own_a, own_b = (flat.shares[: len(flat.polygon.vertices)] for flat in (a, b))
    cut_a = a.cut_at(_along(own_b, place_b, place_a, closed))
    cut_b = b.cut_at(_along(own_a, place_a, place_b, closed))
    partners = _along(cut_a.shares[: len(cut_a.polygon.vertices)], place_a, place_b, closed)
    known = cut_b.shares
    nearest = np.round(np.interp(partners % 1.0 if closed else partners, known, np.arange(len(known))))
    return cut_a, cut_b, nearest.astype(np.intp) % len(cut_b.polygon.vertices)


def _smoothed_path(a: FlatContour, b: FlatContour, dots: IntArray) -> tuple[FloatArray, FloatArray]:
    """Return places along both outlines that correspond, as shares of the lengths, without stairs; neither ever falls.

    Between places where both outlines bend the same way, length goes to length evenly: no path stretches less. Let u be
    the mean of both places of a dot, d the lead of B over A there, and w the lesser of both turns. The smoothed lead x
    has the least sum of ``w (x - d)^2`` over dots and ``EVENNESS (x' - x)^2 / (u' - u)`` over steps.
    """
    closed = a.polygon.closed
    counts = len(a.polygon.vertices), len(b.polygon.vertices)
    positions = unroll(dots, counts if closed else None)
    place_a, place_b = (
        interpolated(positions[:, k] % counts[k], np.arange(float(len(own))), own)
        + positions[:, k] // counts[k]
        for k, own in enumerate((a.shares, b.shares))
    )
    middle, ahead = 0.5 * (place_a + place_b), place_b - place_a
    turn_a, turn_b = (turns(flat.polygon.vertices, closed)[dots[:, k]] for k, flat in enumerate((a, b)))
    weight = np.where(turn_a * turn_b > 0.0, np.minimum(np.abs(turn_a), np.abs(turn_b)), 0.0)
    steps = np.maximum(middle[1:] - middle[:-1], SHORTEST_STEP)
    weight[: len(steps)] += BASE * steps
    if not closed:
        weight[[0, -1]] = FIXED
    smooth = _even_between(ahead[: len(dots)], weight, EVENNESS / steps, closed)
    if closed:
        smooth = np.concatenate([smooth, smooth[:1]])
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
        return tridiagonal(diagonal, spring, right)
    last = float(spring[-1])
    corner = np.zeros(count)
    corner[[0, -1]] = 1.0, -1.0  # spring (x_first - x_last)^2 alone
    diagonal[-1] -= last
    inside, outside = (tridiagonal(diagonal, spring[:-1], side) for side in (right, corner))
    share = last * (inside[0] - inside[-1]) / (1.0 + last * (outside[0] - outside[-1]))
    return inside - share * outside


def _along(places: FloatArray, known: FloatArray, partners: FloatArray, closed: bool) -> FloatArray:
    """Return the partners of places on an outline, between known places and partners, both rising."""
    if closed:
        places = known[0] + (places - known[0]) % 1.0
    return interpolated(places, known, partners)
