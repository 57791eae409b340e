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
from shapeblend_cli.plot.subject import choose_subject
from shapeblend_cli.svg.reading.read import STANDARD_INPUT

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.settings import PlotOptions, ReadOptions, Settings


class Plot(NamedTuple):
    """What is asked for.

    Attributes
    ----------
    kind : str
        The name of a module beside this one.
    files : tuple of str
        Two.
    read : ReadOptions
    settings : Settings
    options : PlotOptions
    """

    kind: str
    files: tuple[str, ...]
    read: ReadOptions
    settings: Settings
    options: PlotOptions


def plot_files(plot: Plot, note: Callable[[str], None], progress: Callable[[float], None]) -> None:
    """Read two files, match them, and write the plot.

    Parameters
    ----------
    plot : Plot
    note : callable
        Takes what the user should know, a line at a time.
    progress : callable
        Takes the share of the work that is done, from 0 to 1, now and then.

    Raises
    ------
    ShapeblendError
        With one line that says what was found and what would work.
    """
    if not COMPILED:
        note(SLOW)
    output = plot.options.output or f"{plot.kind}.svg"
    target = Path(output)
    if output != STANDARD_OUTPUT:
        inputs = [Path(file) for file in plot.files if file != STANDARD_INPUT]
        check_targets([target], inputs, plot.options.force)
    (pair,) = match_files(plot.files, plot.read, plot.settings, Clock(), note, progress)
    try:
        a, b = plot.files
        subject = choose_subject((a, b), pair, plot.settings, plot.options, progress)
        text = import_module(f"shapeblend_cli.plot.{plot.kind}").draw(subject)
    except MatchError as error:
        raise InputError(" and ".join(plot.files), str(error)) from error
    if output == STANDARD_OUTPUT:
        print_text(text)
    else:
        write_files({target: text})
