"""``shapeblend plot``."""

from __future__ import annotations

from typing import Any

import click

from shapeblend_cli.cli.group import SectionedCommand
from shapeblend_cli.cli.options import NAME, options_of
from shapeblend_cli.cli.terminal import Terminal
from shapeblend_cli.job.job import check_files
from shapeblend_cli.options.settings import PlotOptions, ReadOptions, RunOptions, Settings, TerminalOptions
from shapeblend_cli.system.interrupts import stop_after

KINDS = ("graph", "surface", "angle", "starts")  # each is a module of that name in `plot`
DOTTED = ("angle", "starts")  # those about a single dot


@click.command(
    cls=SectionedCommand,
    params=options_of(
        PlotOptions,
        ReadOptions,
        Settings,
        RunOptions,
        TerminalOptions,
        without=("frames", "ends", "style", "curves", "ease", "verbose"),
    ),
)
@click.argument("kind", type=click.Choice(KINDS), metavar="KIND")
@click.argument("files", type=NAME, nargs=-1, required=True, metavar="A.svg B.svg")
def plot(kind: str, files: tuple[str, ...], **given: Any) -> None:
    """Draw how two files correspond, in the style of the paper's figures.

    KIND is graph (the path of least work among all correspondences), surface (the in-betweens over time), angle
    (how the angle at a vertex changes) or starts (the least work for each starting correspondence).
    """
    options, settings = PlotOptions.of(given), Settings.of(given)
    if len(files) != 2:
        raise click.UsageError(f"a plot compares two files, A.svg and B.svg; {len(files)} given")
    check_files(files, settings)
    if options.dot is not None and kind not in DOTTED:
        raise click.UsageError(f"--dot is for {' and '.join(DOTTED)}; {kind} shows all dots")
    stop_after(RunOptions.of(given).timeout)
    if kind == "starts" and (settings.start or settings.pins):
        raise click.UsageError("starts compares all starts; --start and --pin would leave one")

    from shapeblend_cli.plot.write import plot_files

    a, b = files
    read, settings = ReadOptions.of(given), settings.replace(curves=False)
    with Terminal(quiet=TerminalOptions.of(given).quiet) as terminal:
        plot_files(kind, (a, b), read, settings, options, terminal.note, terminal.progress)
