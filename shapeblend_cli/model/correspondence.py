"""Which vertices of two polygons correspond, and the work between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.model.arrays import frozen

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.model.arrays import IntArray


class Work(NamedTuple):
    """The work of a correspondence by its terms, each summed along the path."""

    stretching: float = 0.0  # eq (16)
    bending: float = 0.0  # eq (17), or by turning
    travel: float = 0.0  # of points on their way

    @property
    def total(self) -> float:
        """All work together."""
        return sum(self)


class Figures(NamedTuple):
    """Figures of a path that reports have, and nothing else needs."""

    zero_angles: int = 0
    diagonal_deviation: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class Correspondence:
    """Corresponding vertices of two polygons, and the work between them.

    Attributes
    ----------
    dots : (k, 2) int
        The path through the graph, ``[i, j]`` by vertex numbers, from its start. The path of closed polygons
        returns to the first dot, which is not repeated.
    pairs : (k, 2) int
        The dots.
    closed : bool
    work : float
        What the correspondence costs: the sum of its terms.
    terms : Work
        The terms are attributes of the correspondence, too: `stretching`, `bending` and `travel`.
    lower_bound : float
        The least work that any correspondence of the two polygons in these directions can take: from any start,
        through any vertices, in no band, exactly solved. Equal to `work` if that is the least; 0 if nothing is known.
        It is searched for when it is first read.
    gap : float
        (`work` - `lower_bound`) / `work`: how much of the work another path could save at most.
    zero_angles : int
        Number of dots whose angle reaches zero.
    diagonal_deviation : float
        Eq (30), from the start.
    sweeps : int
        Number of passes over the graph.
    """

    dots: IntArray
    closed: bool
    terms: Work
    bound: float | Callable[[], float]  # `lower_bound`, or what searches for it
    figures: Callable[[], Figures]  # measures what `zero_angles` and `diagonal_deviation` give
    sweeps: int

    def __post_init__(self) -> None:
        object.__setattr__(self, "dots", frozen(self.dots, np.intp))

    @classmethod
    def without_work(cls, dots: IntArray, closed: bool) -> Correspondence:
        """Return a correspondence that was given, not solved, without its work."""
        return cls(dots, closed, Work(), bound=0.0, figures=Figures, sweeps=0)

    @classmethod
    def one_to_one(cls, count: int, closed: bool) -> Correspondence:
        """Return that of two polygons of as many vertices, each of which becomes that of its number."""
        return cls.without_work(np.arange(count)[:, None].repeat(2, axis=1), closed)

    @property
    def pairs(self) -> IntArray:
        """The dots: pairs of vertex numbers."""
        return self.dots

    @property
    def work(self) -> float:
        """All work together."""
        return self.terms.total

    @property
    def stretching(self) -> float:
        """The work of stretching."""
        return self.terms.stretching

    @property
    def bending(self) -> float:
        """The work of bending."""
        return self.terms.bending

    @property
    def travel(self) -> float:
        """The work of travel."""
        return self.terms.travel

    @property
    def zero_angles(self) -> int:
        """Number of dots whose angle reaches zero."""
        return self.figures().zero_angles

    @property
    def diagonal_deviation(self) -> float:
        """Eq (30), from the start."""
        return self.figures().diagonal_deviation

    @property
    def lower_bound(self) -> float:
        """Minimum work of any correspondence of the two polygons in these directions."""
        return self.bound() if callable(self.bound) else self.bound

    @property
    def gap(self) -> float:
        """Maximum work that another path could save, as a share; 0 if this path is proven to be the best."""
        return (self.work - self.lower_bound) / self.work if self.work > 0.0 else 0.0
