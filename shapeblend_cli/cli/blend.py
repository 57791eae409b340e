"""``shapeblend A.svg B.svg``, the default command."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from shapeblend_cli.cli.group import TYPED, SectionedCommand
from shapeblend_cli.cli.options import options_of
from shapeblend_cli.cli.terminal import Terminal, details
from shapeblend_cli.easing import Timing
from shapeblend_cli.outputs.formats import FORMS, FRAME_KINDS, STANDARD_OUTPUT, kind_of, problem
from shapeblend_cli.outputs.raster_options import ANIMATED, RasterOptions, defaults, timing_problem
from shapeblend_cli.outputs.raster_options import problem as raster_problem
from shapeblend_cli.outputs.times import run_for
from shapeblend_cli.settings import (
    OutputOptions,
    ReadOptions,
    RunOptions,
    Settings,
    TerminalOptions,
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

ABOUT_TWO_FILES = ("start", "pins", "match", "stiff")
"""Settings that name places of A and of B."""


@click.command(
    cls=SectionedCommand,
    examples=EXAMPLES,
    params=options_of(ReadOptions, Settings, OutputOptions, RunOptions, TerminalOptions),
)
@click.argument("files", type=click.Path(), nargs=-1, required=True, metavar="A.svg B.svg [C.svg ...]")
def blend(files: tuple[str, ...], **given: Any) -> None:
    """Blend A.svg into B.svg, and on into further files, with the least work of bending and stretching.

    Writes the in-betweens as SVG files, one animated SVG, or pictures. One of the files may be -, standard input.
    """
    printed = TerminalOptions.of(given)
    if printed.quiet and printed.verbose:
        raise click.UsageError("--quiet and --verbose contradict each other")
    job = _job(files, given)

    from shapeblend_cli.files import blend_files

    with Terminal(quiet=printed.quiet) as terminal:
        run = blend_files(job, terminal.note, terminal.progress)
        if printed.verbose:
            for line in details(run):
                terminal.note(line)


def check_files(files: tuple[str, ...], settings: Settings) -> None:
    """Refuse too few files, and settings that do not go with so many.

    Raises
    ------
    click.UsageError
    """
    if len(files) < 2:
        raise click.UsageError(f"two files or more are blended, A.svg and B.svg; {len(files)} given")
    if files.count(STANDARD_INPUT) > 1:
        raise click.UsageError("standard input can be one of the files, not more")
    if len(files) > 2 and any(getattr(settings, name) for name in ABOUT_TWO_FILES):
        raise click.UsageError(f"--start, --pin, --match and --stiff are about two files; {len(files)} given")


def _job(files: tuple[str, ...], given: dict[str, Any]) -> Job:
    """Make a job of files and options, or raise click.UsageError if they do not go together."""
    read, settings, run = ReadOptions.of(given), Settings.of(given), RunOptions.of(given)
    options = OutputOptions.of(given)
    check_files(files, settings)
    output = run.output or FORMS[options.emit].output
    if found := problem(options.emit, output, len(files)):
        raise click.UsageError(found)
    kind = kind_of(options.emit, output, options.format)
    raster = _raster_options(kind, output, options, settings, given["frames"] is None, len(files) - 1)
    if output == run.report == STANDARD_OUTPUT:
        raise click.UsageError("--output and --report cannot both be standard output")
    if options.emit == "pair" and settings.motion == "auto":
        settings = settings.replace(motion="linear")  # what programs do between two files

    from shapeblend_cli.files import Job
    from shapeblend_cli.outputs.render import OutputSpec

    timing = Timing(options.duration, settings.ease, options.repeat)
    run = run.replace(output=output)
    chosen = options.replace(format=kind if kind in FRAME_KINDS else None, **raster._asdict())
    return Job(
        files,
        read,
        settings,
        OutputSpec(kind, options.animate, timing, options.precision, raster),
        run,
        reported=report_settings(read, settings, chosen, run),
        command=("shapeblend", *click.get_current_context().meta[TYPED]),
    )


def _raster_options(
    kind: str, output: str, options: OutputOptions, settings: Settings, by_fps: bool, pairs: int
) -> RasterOptions:
    """How pictures are drawn, with the defaults filled in, or click.UsageError if they cannot be."""
    given = {name: getattr(options, name) for name in ("format", "width", "columns", "fps", "background")}
    if found := raster_problem(kind, output, given):
        raise click.UsageError(found)
    if not by_fps and options.fps is not None:
        raise click.UsageError("--frames and --fps both say how many pictures there are; one will do")
    usual = defaults(kind, by_fps=by_fps)
    raster = usual._replace(**{n: given[n] for n in usual._fields if given[n] is not None})
    if kind == "sheet" and not (settings.frames or settings.ends):
        raise click.UsageError(
            "--frames 0 leaves nothing for a contact sheet; --frames 1 or --ends would work"
        )
    if kind in ANIMATED:
        run = run_for(raster.fps, settings.frames, pairs, options.duration, options.repeat == "pingpong")
        if found := timing_problem(run, options.repeat):
            raise click.UsageError(found)
    return raster
