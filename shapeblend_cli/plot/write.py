"""From two files to a plot of how they correspond."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from shapeblend_cli.errors import InputError, MatchError
from shapeblend_cli.job.make import SLOW, check_output, match_files, write_output
from shapeblend_cli.matching.solve import COMPILED
from shapeblend_cli.plot.subject import choose_subject
from shapeblend_cli.system.clock import Clock

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.options.settings import PlotOptions, ReadOptions, Settings


def plot_files(
    kind: str,
    files: tuple[str, str],
    read: ReadOptions,
    settings: Settings,
    options: PlotOptions,
    note: Callable[[str], None],
    progress: Callable[[float], None],
) -> None:
    """Read two files, match them, and write the plot that the module `kind` beside this one draws.

    Parameters
    ----------
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
    output = options.output or f"{kind}.svg"
    check_output(output, files, options.force)
    (pair,) = match_files(files, read, settings, Clock(), note, progress)
    try:
        subject = choose_subject(files, pair, settings, options, progress)
        text = import_module(f"shapeblend_cli.plot.{kind}").draw(subject)
    except MatchError as error:
        raise InputError(" and ".join(files), str(error)) from error
    write_output(output, text, options.force)
