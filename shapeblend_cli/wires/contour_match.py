"""Two contours to match, solved as they are or with other vertices."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry.flat_contour import FlatContour
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.model import Correspondence
from shapeblend_cli.wires.constraints import Constraints
from shapeblend_cli.wires.direction import solve, wires_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.model import IntArray, Polygon
    from shapeblend_cli.options.settings import Settings

    Solve = Callable[[FlatContour, FlatContour, IntArray | None, float], "Solved"]

OTHERWISE = 1.25
"""Maximum ratio between the least works of two contours with one set of vertices and with another."""

NOISE = 1e-12
"""Maximum rounding error of work, in units of work."""


class Solved(NamedTuple):
    """Two contours, with all their nodes but perhaps other vertices than before, and their correspondence."""

    a: FlatContour
    b: FlatContour
    correspondence: Correspondence


class ContourMatch(NamedTuple):
    """Two contours in the same direction, and the requirements on their match.

    Attributes
    ----------
    a, b : FlatContour
    first : Correspondence
        The least work of the two as they are.
    settings : Settings
    constraints : Constraints
    rotation : float
        The angle by which B is rotated back while it is solved, in radians.
    """

    a: FlatContour
    b: FlatContour
    first: Correspondence
    settings: Settings
    constraints: Constraints
    rotation: float = 0.0

    @property
    def is_free(self) -> bool:
        """Whether nothing is required of the correspondence."""
        return not (self.constraints.pins or self.settings.stiff)

    def rotated_back(self, polygon: Polygon) -> Polygon:
        """Return a polygon of B as it is solved."""
        return rotated_back(polygon, self.rotation)

    def wires(self, p: FlatContour, q: FlatContour) -> Wires:
        """Return the wires of these contours with other vertices."""
        return wires_of(p.polygon, self.rotated_back(q.polygon), self.settings)

    def solve(
        self, p: FlatContour, q: FlatContour, near: IntArray | None = None, known: float = np.inf
    ) -> Solved:
        """Find the least work of these contours with other vertices: below a known work, or near a path.

        `NothingLess` may be raised where all paths near that take more than the known work.
        """
        directed = self.rotated_back(q.polygon)
        return Solved(
            p, q, solve(p.polygon, directed, self.settings, self.constraints, near=near, known=known)
        )

    def unless_far_more(self, solved: Solved, most: float | None) -> Solved | None:
        """Return a correspondence with the lower bound of all matches; None if it takes too many times the least work.

        Parameters
        ----------
        solved : Solved
        most : float or None
            Maximum work as a multiple of the least work, of these vertices or before they were cut; None is any.
        """
        found, first = solved.correspondence, self.first.work
        proof = Proof(self, solved)
        # Where it is clearly less, the least work of these vertices need not be known.
        if most is not None and found.work > most / OTHERWISE * first + NOISE:
            if found.work > most * min(first, proof.least.work) + NOISE:
                return None
        return solved._replace(correspondence=replace(found, bound=proof))

    def everywhere(self, solved: Solved) -> Solved:
        """Solve the same vertices again, not only near a path, knowing the work of that."""
        return self.solve(solved.a, solved.b, None, solved.correspondence.work)


class Proof:
    """A lower bound of all matches with the vertices of one that was solved, searched for when first asked for."""

    def __init__(self, match: ContourMatch, solved: Solved) -> None:
        """Keep what is searched."""
        self._match, self._solved = match, solved

    @cached_property
    def least(self) -> Correspondence:
        """The least work of these vertices."""
        return self._match.everywhere(self._solved).correspondence

    def __call__(self) -> float:
        """Return the lower bound."""
        return min(self.least.lower_bound, self._solved.correspondence.work)


def rotated_back(polygon: Polygon, rotation: float) -> Polygon:
    """Return a polygon rotated back by an angle in radians."""
    return Similarity.rotation(-rotation).polygon(polygon) if rotation else polygon
