"""``shapeblend plot``."""

from __future__ import annotations

from typing import Any

import click

from shapeblend_cli.cli.group import SectionedCommand
from shapeblend_cli.cli.parameters import ABOUT_FRAMES, NAME, options_of
from shapeblend_cli.cli.terminal import ONLY_ERRORS, Terminal, TerminalOptions
from shapeblend_cli.job.job import check_files
from shapeblend_cli.job.options import RunOptions
from shapeblend_cli.options.settings import ReadOptions, Settings
from shapeblend_cli.plot.options import PlotOptions
from shapeblend_cli.system.interrupts import limit

KINDS = ("graph", "angle")  # each is a module of that name in `plot`


class Kind(click.Choice):  # type: ignore[type-arg]  # generic only in newer releases
    """The kind of a plot."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return a kind; an error says where it stands."""
        if value not in KINDS:
            files = "A.svg B.svg" if value.isalpha() else f"{value} ..."
            raise click.UsageError(
                f"KIND must be {' or '.join(KINDS)}, not '{value}'; shapeblend plot {KINDS[0]} {files} would work",
                ctx,
            )
        return value


@click.command(
    cls=SectionedCommand,
    params=options_of(
        PlotOptions,
        ReadOptions,
        Settings,
        RunOptions,
        TerminalOptions,
        without=(*ABOUT_FRAMES, "style", "viewbox", "verbose"),
        helps={"quiet": ONLY_ERRORS},
    ),
)
@click.argument("kind", type=Kind(KINDS), metavar="KIND")
@click.argument("files", type=NAME, nargs=-1, required=True, metavar="A.svg B.svg")
def plot(kind: str, files: tuple[str, ...], **given: Any) -> None:
    """Draw how two files correspond, in the style of the paper's figures.

    KIND is graph (the path of least work among all correspondences) or angle (how the angle at a vertex changes).
    """
    options, settings = PlotOptions.of(given), Settings.of(given)
    if len(files) != 2:
        raise click.UsageError(f"a plot compares two files, A.svg and B.svg; {len(files)} given")
    check_files(files, settings)
    if options.dot is not None and kind != "angle":
        raise click.UsageError(f"--dot is for angle; {kind} shows all dots")
    limit(*RunOptions.of(given).values)

    from shapeblend_cli.plot.subject import plot_files

    a, b = files
    read, settings = ReadOptions.of(given), settings.replace(curves=False)
    with Terminal(quiet=TerminalOptions.of(given).quiet) as terminal:
        plot_files(kind, (a, b), read, settings, options, terminal.note, terminal.progress)
