"""``shapeblend A.svg B.svg``, the default command."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Any

import click

from shapeblend_cli.cli.group import TYPED, SectionedCommand
from shapeblend_cli.cli.parameters import NAME, options_of
from shapeblend_cli.cli.terminal import NOTHING, Terminal, TerminalOptions, details, results
from shapeblend_cli.errors import InputError, OptionError
from shapeblend_cli.job.job import RECORDS, check_inputs, job_of
from shapeblend_cli.job.options import RunOptions
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT
from shapeblend_cli.outputs.options import OutputOptions, check_runs, long_times
from shapeblend_cli.system.interrupts import limit

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.job.job import Job

EXAMPLES = (
    ("shapeblend a.svg b.svg", "five in-betweens: blend/frame-1.svg ... blend/frame-5.svg"),
    ("shapeblend a.svg b.svg -o moving.svg", "an animated SVG, for any browser"),
    ("shapeblend a.svg b.svg --preview look.html", "a page that shows the blend and its correspondence"),
    ("shapeblend blend.json", "a project: drawings and options, as the studio saves them"),
    ("shapeblend a.svg b.svg c.svg -n 9 --ends", "frames through three drawings, including the drawings"),
)


@click.command(
    cls=SectionedCommand,
    examples=EXAMPLES,
    params=options_of(*RECORDS, TerminalOptions),
)
@click.argument("files", type=NAME, nargs=-1, required=True, metavar="A.svg B.svg [C.svg ...]")
@click.pass_context
def blend(context: click.Context, /, files: tuple[str, ...], **given: Any) -> None:
    """Blend A.svg into B.svg, and on into further files, by bending and stretching outlines with the least work.

    Writes the in-betweens as SVG files, one animated SVG, or pictures. One of the files may be -, standard input.
    """
    printed = TerminalOptions.of(given)
    if printed.quiet and printed.verbose:
        raise click.UsageError("--quiet and --verbose contradict each other")
    typed_files = files
    _check_words(files, context.find_root().command)
    files, options = opened(files, given, stays_inside=True)
    project = "" if files == typed_files else typed_files[0]
    job = job_of(files, options, ("shapeblend", *context.meta[TYPED]))._replace(project=project)
    _check_idle(job, given, printed)
    limit(*RunOptions.of(options).values)
    _check_files(job)

    from shapeblend_cli.job.make import blend_files

    with Terminal(quiet=printed.quiet) as terminal:
        for line in long_times(OutputOptions.of(given)):
            terminal.note(line)
        if given["ends"] and job.output.format.plays:
            terminal.note("--ends adds nothing here: animations begin and end with the drawings")
        note = None if printed.quiet else terminal.note
        run = blend_files(job, note, terminal.warn, terminal.progress)
        if sys.stderr is not None and sys.stderr.isatty():
            for line in results(job, sum(run.clock.seconds.values())):
                terminal.note(line)
        if printed.verbose:
            for line in details(run, context.obj):
                terminal.note(line)


def _check_words(files: Sequence[str], group: click.Command) -> None:
    """Raise UsageError for a command among the files."""
    for word in files[1:]:
        if isinstance(group, click.Group) and word in group.commands and not os.path.exists(word):
            raise click.UsageError(f"{word} is a command, which comes first: shapeblend {word}")


def _check_files(job: Job) -> None:
    """Raise InputError for a drawing that is not there, with the project that names it, if one does."""
    try:
        check_inputs(job.files)
    except InputError as error:
        if not job.project:
            raise
        raise InputError(job.project, f"its drawing {error}") from None


def _check_idle(job: Job, typed: Mapping[str, Any], printed: TerminalOptions) -> None:
    """Raise OptionError for a run that would do nothing, and for what was typed and would do nothing."""
    output, write = job.output, job.write
    if typed["repeat"] is not None and not write.preview:  # its page plays whatever is written
        check_runs(output)
    others = write.report or write.preview or write.tries or write.fail_on != "never" or printed.verbose
    if not (output.files() or output.path == STANDARD_OUTPUT or others):
        raise OptionError(NOTHING)


def opened(
    files: tuple[str, ...], given: dict[str, Any], *, stays_inside: bool = False
) -> tuple[tuple[str, ...], dict[str, Any]]:
    """Return the drawings and options of the command line, or of the project that it names.

    A project that `stays_inside` must not write outside its folder; the studio asks instead.
    """
    from shapeblend_cli.rows import is_project

    projects = [file for file in files if is_project(file)]
    if not projects:
        return files, given
    if len(files) > 1:
        raise click.UsageError(f"{projects[0]}: a project names its own drawings, and is given alone")
    from shapeblend_cli.rows.project import check_outputs, read_project

    project = read_project(projects[0])
    if stays_inside:
        check_outputs(project, projects[0], given)
    project = project.with_given(given)
    return project.files, dict(project.given)
