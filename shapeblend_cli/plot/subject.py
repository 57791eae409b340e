"""What a plot is about: one contour of a pair, as it was solved."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.pairing.matching import solved_wires
from shapeblend_cli.plot.axes import short_name, value_text

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.match.work import Wires
    from shapeblend_cli.model import ContourBlend, Correspondence, Pair, ShapeBlend
    from shapeblend_cli.settings import Settings

    Dot = tuple[int, int]


class Subject(NamedTuple):
    """A contour of A and the contour of B it becomes.

    Attributes
    ----------
    names : (str, str)
        Of the files.
    contour : ContourBlend
    wires : Wires
        The two in the unit box.
    band : float or None
        The band in force.
    shape : ShapeBlend
        The shape that the contour is part of, as it moves.
    place : int
        Where in the shape.
    dot : (int, int) or None
        The dot that is asked for.
    watch : callable
        Told now and then which share of the work is done, from 0 to 1.
    """

    names: tuple[str, str]
    contour: ContourBlend
    wires: Wires
    band: float | None
    shape: ShapeBlend
    place: int
    dot: Dot | None
    watch: Callable[[float], None]

    @property
    def found(self) -> Correspondence:
        """The correspondence."""
        return self.contour.correspondence

    @property
    def title(self) -> str:
        """From file to file."""
        return " → ".join(map(short_name, self.names))

    @property
    def contours(self) -> str:
        """Which contours, and how large."""
        m, n = self.wires.m, self.wires.n
        return f"contour {self.contour.a} of A ({m} vertices) to contour {self.contour.b} of B ({n} vertices)"

    @property
    def price(self) -> str:
        """The work, and what it is the sum of."""
        found = self.found
        parts = [value_text(work) for work in (found.work, found.stretching, found.bending)]
        return "work {} = stretching {} + bending {}".format(*parts)


def subject(
    names: tuple[str, str],
    pair: Pair,
    settings: Settings,
    number: int | None,
    dot: Dot | None,
    watch: Callable[[float], None],
) -> Subject:
    """Choose the contour, by its number in A, else the largest that is matched.

    Raises
    ------
    MatchError
        No contour of that number is matched, or the dot names no vertices.
    """
    contour, shape, place = _chosen(pair, number)
    wires = solved_wires(contour, settings)
    if dot is not None and not (dot[0] < wires.m and dot[1] < wires.n):
        raise MatchError(f"dot {dot[0]},{dot[1]} names no vertices; 0,0 to {wires.m - 1},{wires.n - 1} would")
    return Subject(names, contour, wires, settings.band, shape, place, dot, watch)


def _chosen(pair: Pair, number: int | None) -> tuple[ContourBlend, ShapeBlend, int]:
    """The contour, the shape it moves with, and its place there."""
    matched = [
        (contour, shape, place)
        for shape in pair.shapes
        for place, contour in enumerate(shape.contours)
        if contour.is_matched
    ]
    wanted = [found for found in matched if number is None or found[0].a == number]
    if not wanted:
        others = sorted({contour.a for contour, _, _ in matched if contour.a is not None})
        raise MatchError(f"contour {number} of A is matched with none of B; {_listed(others)} would do")
    return max(wanted, key=lambda found: found[0].scale_a)


def on_path(subject: Subject, dots: Sequence[Dot]) -> int:
    """Where among the dots of a path the one that is asked for is.

    Raises
    ------
    MatchError
        Nowhere; the message names one that is near.
    """
    assert subject.dot is not None
    if subject.dot in dots:
        return dots.index(subject.dot)
    period = np.array([subject.wires.m, subject.wires.n])
    away = np.abs(np.array(dots) - subject.dot)
    if subject.found.closed:
        away = np.minimum(away, period - away)
    # A dot of the same vertex of A is nearer than any other.
    i, j = dots[int((away @ (period.sum(), 1)).argmin())]
    raise MatchError(
        f"vertices {subject.dot[0]} of A and {subject.dot[1]} of B do not correspond; "
        f"{i},{j} is a dot of the path near by"
    )


def _listed(numbers: Sequence[int]) -> str:
    shown = ", ".join(map(str, numbers[:10]))
    return f"{shown} and others" if len(numbers) > 10 else shown
