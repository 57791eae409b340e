"""``shapeblend A.svg B.svg``, the default command."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from shapeblend_cli.cli.group import TYPED, SectionedCommand
from shapeblend_cli.cli.options import NAME, options_of
from shapeblend_cli.cli.terminal import Terminal, details
from shapeblend_cli.interrupts import stop_after
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT
from shapeblend_cli.outputs.options import OutputOptions, specify
from shapeblend_cli.settings import (
    ReadOptions,
    RunOptions,
    Settings,
    TerminalOptions,
    WriteOptions,
    report_settings,
)

if TYPE_CHECKING:
    from shapeblend_cli.files import Job

STANDARD_INPUT = "-"

EXAMPLES = (
    ("shapeblend a.svg b.svg", "five in-betweens: blend/frame-1.svg ... blend/frame-5.svg"),
    ("shapeblend a.svg b.svg -o moving.svg", "an animated SVG, for any browser"),
    ("shapeblend a.svg b.svg --preview look.html", "a page to look at the blend and its correspondence"),
    ("shapeblend a.svg b.svg c.svg -n 9 --ends", "frames through three drawings, which are among them"),
)


@click.command(
    cls=SectionedCommand,
    examples=EXAMPLES,
    params=options_of(ReadOptions, Settings, OutputOptions, WriteOptions, RunOptions, TerminalOptions),
)
@click.argument("files", type=NAME, nargs=-1, required=True, metavar="A.svg B.svg [C.svg ...]")
def blend(files: tuple[str, ...], **given: Any) -> None:
    """Blend A.svg into B.svg, and on into further files, with the least work of bending and stretching.

    Writes the in-betweens as SVG files, one animated SVG, or pictures. One of the files may be -, standard input.
    """
    printed = TerminalOptions.of(given)
    if printed.quiet and printed.verbose:
        raise click.UsageError("--quiet and --verbose contradict each other")
    job = _job(files, given)
    stop_after(RunOptions.of(given).timeout)

    from shapeblend_cli.files import blend_files

    with Terminal(quiet=printed.quiet) as terminal:
        run = blend_files(job, terminal.note, terminal.warn, terminal.progress)
        if printed.verbose:
            for line in details(run):
                terminal.note(line)


def check_files(files: tuple[str, ...], settings: Settings) -> None:
    """Raise an error if there are too few files, or settings that do not go with so many."""
    if len(files) < 2:
        raise click.UsageError(f"a blend needs two files or more, A.svg and B.svg; {len(files)} given")
    if files.count(STANDARD_INPUT) > 1:
        raise click.UsageError("only one of the files can be standard input")
    settings.check_drawings(len(files))


def _job(files: tuple[str, ...], given: dict[str, Any]) -> Job:
    """Make a job of files and options, or raise an error if they do not go together."""
    read, settings, write = ReadOptions.of(given), Settings.of(given), WriteOptions.of(given)
    options = OutputOptions.of(given)
    check_files(files, settings)
    output = specify(options, settings, len(files))
    if output.path == write.report == STANDARD_OUTPUT:
        raise click.UsageError("--output and --report cannot both be standard output")
    if write.tries is not None and len(files) > 2:
        raise click.UsageError(f"--try applies to two files; {len(files)} given")

    from shapeblend_cli.files import Job

    return Job(
        files,
        read,
        output,
        write,
        reported=report_settings(
            read, output.settings, options.replace(**output.decided()), write, RunOptions.of(given)
        ),
        command=("shapeblend", *click.get_current_context().meta[TYPED]),
    )
