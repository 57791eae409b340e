"""``shapeblend states``."""

from __future__ import annotations

from typing import Any

import click

from shapeblend_cli.cli.group import SectionedCommand
from shapeblend_cli.cli.parameters import NAME, options_of
from shapeblend_cli.cli.terminal import ONLY_ERRORS, Terminal, TerminalOptions
from shapeblend_cli.job.job import check_files
from shapeblend_cli.job.options import RunOptions, StatesOptions
from shapeblend_cli.options.settings import ReadOptions, Settings
from shapeblend_cli.system.interrupts import limit

EXAMPLES = (
    ("shapeblend states off.svg on.svg -o light.svg --trigger click", "a drawing that a click switches"),
    (
        "shapeblend states play.svg pause.svg stop.svg -o player.js",
        "<player-states state='pause'> in a web page",
    ),
)

WITHOUT = (
    "frames ends motion unmatched start pins stiff match mix times stagger stagger_by timing swap curves verbose"
).split()
"""Settings of motion and of single pairs, which states have no use for."""


@click.command(
    cls=SectionedCommand,
    examples=EXAMPLES,
    params=options_of(
        StatesOptions,
        ReadOptions,
        Settings,
        RunOptions,
        TerminalOptions,
        without=WITHOUT,
        helps={"quiet": ONLY_ERRORS},
    ),
)
@click.argument("files", type=NAME, nargs=-1, required=True, metavar="A.svg B.svg [C.svg ...]")
def states(files: tuple[str, ...], **given: Any) -> None:
    """Make one drawing with several states, which can change from any to any other.

    The states have the names of the files. In an SVG, the attribute data-state of the root names the state that is
    shown; in a custom element (.js), the attribute state does.
    """
    options, settings = StatesOptions.of(given), Settings.of(given)
    check_files(files, settings)
    limit(*RunOptions.of(given).values)

    from shapeblend_cli.job.states import write_states

    with Terminal(quiet=TerminalOptions.of(given).quiet) as terminal:
        write_states(files, ReadOptions.of(given), settings, options, terminal.note, terminal.progress)
