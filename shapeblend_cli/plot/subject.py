"""The subject of a plot: one contour of a pair, as it was solved."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.errors import MatchError
from shapeblend_cli.plot.axes import short_name, value_text
from shapeblend_cli.wires.match import solved_wires

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.model import ContourBlend, Correspondence, Pair, ShapeBlend
    from shapeblend_cli.options.settings import PlotOptions, Settings

    Dot = tuple[int, int]


class Subject(NamedTuple):
    """A contour of A and the contour of B it becomes, both files by name, and the dot that is asked for.

    The wires are the two in the unit box. The contour has a number in the shape that it is part of. `progress` takes
    the share of the work that is done, from 0 to 1.
    """

    names: tuple[str, str]
    contour: ContourBlend
    wires: Wires
    band: float | None
    shape: ShapeBlend
    number: int
    dot: Dot | None
    progress: Callable[[float], None]

    @property
    def correspondence(self) -> Correspondence:
        """The contour's correspondence."""
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
    def work(self) -> str:
        """The work as a sum."""
        found = self.correspondence
        terms = (f"{name} {value_text(work)}" for name, work in found.terms._asdict().items())
        return f"work {value_text(found.work)} = {' + '.join(terms)}"


def choose_subject(
    names: tuple[str, str],
    pair: Pair,
    settings: Settings,
    options: PlotOptions,
    progress: Callable[[float], None],
) -> Subject:
    """Choose the contour by its number in A, else the largest that is matched.

    Raises
    ------
    MatchError
        No contour of that number is matched, or the dot names no vertices.
    """
    matched = [
        (contour, shape, index)
        for shape in pair.each_shape
        for index, contour in enumerate(shape.contours)
        if contour.is_matched
    ]
    number, dot = options.contour, options.dot
    candidates = [each for each in matched if number is None or each[0].a == number]
    if not candidates:
        others = sorted({contour.a for contour, _, _ in matched if contour.a is not None})
        shown = ", ".join(map(str, others[:10])) + " and others" * (len(others) > 10)
        raise MatchError(f"contour {number} of A is matched with none of B; {shown} would do")
    contour, shape, index = max(candidates, key=lambda each: each[0].scale_a)
    wires = solved_wires(contour, settings)
    if dot is not None and not (dot[0] < wires.m and dot[1] < wires.n):
        raise MatchError(f"dot {dot[0]},{dot[1]} names no vertices; 0,0 to {wires.m - 1},{wires.n - 1} would")
    return Subject(names, contour, wires, settings.band, shape, index, dot, progress)


def index_on_path(subject: Subject, dots: Sequence[Dot]) -> int:
    """Return the index of the dot that is asked for among the dots of a path.

    Raises
    ------
    MatchError
        It is not there; the message names one nearby.
    """
    assert subject.dot is not None
    if subject.dot in dots:
        return dots.index(subject.dot)
    period = np.array([subject.wires.m, subject.wires.n])
    away = np.abs(np.array(dots) - subject.dot)
    if subject.correspondence.closed:
        away = np.minimum(away, period - away)
    # A dot of the same vertex of A is nearer than any other.
    i, j = dots[int((away @ (period.sum(), 1)).argmin())]
    raise MatchError(
        f"vertices {subject.dot[0]} of A and {subject.dot[1]} of B do not correspond; "
        f"{i},{j} is a dot of the path nearby"
    )
