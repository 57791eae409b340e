"""From two files to a plot of how they correspond."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.clock import Clock
from shapeblend_cli.errors import InputError, MatchError
from shapeblend_cli.files import SLOW, match_files, print_text
from shapeblend_cli.match.solve import COMPILED
from shapeblend_cli.output import check_targets, write_files
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT
from shapeblend_cli.plot.subject import subject
from shapeblend_cli.svg.reading.read import STANDARD_INPUT

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.settings import Settings


class Plot(NamedTuple):
    """What is asked for.

    Attributes
    ----------
    kind : str
        A name of `plot.kinds.KINDS`.
    files : (str, str)
    output : str
        The name of a file, or ``-``.
    force : bool
        Replace an existing file.
    select : tuple of str or None
        Which shapes of each file; None is all it paints.
    lenient : bool
        Draw broken path data up to the error.
    blend : Settings
    contour : int or None
        The number of a contour of A; None is the largest that is matched.
    dot : (int, int) or None
        Vertices of A and B.
    """

    kind: str
    files: tuple[str, str]
    output: str
    force: bool
    select: tuple[str | None, ...]
    lenient: bool
    blend: Settings
    contour: int | None
    dot: tuple[int, int] | None


def plot_files(plot: Plot, say: Callable[[str], None], watch: Callable[[float], None]) -> None:
    """Read two files, match them, and write the plot.

    Parameters
    ----------
    plot : Plot
    say : callable
        Takes what the user should know, a line at a time.
    watch : callable
        Told now and then which share of the work is done, from 0 to 1.

    Raises
    ------
    ShapeblendError
        With one line that says what was found and what would work.
    """
    if not COMPILED:
        say(SLOW)
    target = Path(plot.output)
    if plot.output != STANDARD_OUTPUT:
        check_targets([target], [Path(file) for file in plot.files if file != STANDARD_INPUT], plot.force)
    (pair,) = match_files(plot.files, plot.select, plot.lenient, plot.blend, Clock(), say, watch)
    try:
        chosen = subject(plot.files, pair, plot.blend, plot.contour, plot.dot, watch)
        text = import_module(f"shapeblend_cli.plot.{plot.kind}").draw(chosen)
    except MatchError as error:
        raise InputError(" and ".join(plot.files), str(error)) from error
    if plot.output == STANDARD_OUTPUT:
        print_text(text)
    else:
        write_files({target: text})
