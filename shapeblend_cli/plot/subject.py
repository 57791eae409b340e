"""From two files to a plot of one contour, as it was solved."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.errors import InputError, MatchError
from shapeblend_cli.job.make import SLOW, match_files
from shapeblend_cli.job.targets import check_output, write_output
from shapeblend_cli.matching.solve import COMPILED
from shapeblend_cli.plot.axes import short_name, value_text
from shapeblend_cli.system.clock import Clock
from shapeblend_cli.wires.match import solved_wires

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.model import ContourBlend, Correspondence, Pair
    from shapeblend_cli.options.settings import ReadOptions, Settings
    from shapeblend_cli.plot.options import PlotOptions

    Dot = tuple[int, int]


class Subject(NamedTuple):
    """A contour of A and the contour of B that it becomes."""

    names: tuple[str, str]  # of both files
    contour: ContourBlend
    wires: Wires  # both contours in the unit box
    band: float | None
    dot: Dot | None  # the one that is asked for

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


def plot_files(
    kind: str,
    files: tuple[str, str],
    read: ReadOptions,
    settings: Settings,
    options: PlotOptions,
    note: Callable[[str], None],
    progress: Callable[[str, float], None],
) -> None:
    """Read two files, match them, and write the plot that the module `kind` beside this one draws.

    Parameters
    ----------
    note : callable
        Takes notes for the user, a line at a time.
    progress : callable
        Takes the name of a stage and the share of it that is done, from 0 to 1, now and then.

    Raises
    ------
    ShapeblendError
        With one line that says what was found and what would work.
    """
    if not COMPILED:
        note(SLOW)
    output = options.output or f"{kind}.svg"
    check_output(output, files, options.force)
    (pair,) = match_files(files, read, settings, Clock(), note, progress)
    try:
        subject = choose_subject(files, pair, settings, options)
        text = import_module(f"shapeblend_cli.plot.{kind}").draw(subject)
    except MatchError as error:
        raise InputError(" and ".join(files), str(error)) from error
    write_output(output, text, options.force)


def choose_subject(names: tuple[str, str], pair: Pair, settings: Settings, options: PlotOptions) -> Subject:
    """Choose the contour by its number in A, else the largest that is matched.

    Raises
    ------
    MatchError
        No contour of that number is matched, or the dot names no vertices.
    """
    matched = [contour for contour in pair.contours if contour.is_matched]
    number, dot = options.contour, options.dot
    candidates = [contour for contour in matched if number in (None, contour.a)]
    if not candidates:
        others = sorted({contour.a for contour in matched if contour.a is not None})
        shown = ", ".join(map(str, others[:10])) + " and others" * (len(others) > 10)
        raise MatchError(f"contour {number} of A has no partner in B; {shown} would work")
    contour = max(candidates, key=lambda each: each.scale_a)
    wires = solved_wires(contour, settings)
    if dot is not None and not (dot[0] < wires.m and dot[1] < wires.n):
        raise MatchError(
            f"dot {dot[0]},{dot[1]} names no vertices; 0,0 to {wires.m - 1},{wires.n - 1} would work"
        )
    return Subject(names, contour, wires, settings.band, dot)


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
