"""One blend of files with everything that was asked of it, checked before anything heavy is imported."""

from __future__ import annotations

import os
import re
import shlex
import stat
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from shapeblend_cli.errors import InputError, OptionError, OutputError, unreadable
from shapeblend_cli.job.options import RunOptions, WriteOptions, report_settings
from shapeblend_cli.options.fields import Record
from shapeblend_cli.options.settings import ReadOptions, Settings
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT, OutputSpec
from shapeblend_cli.outputs.options import OutputOptions, specify

STANDARD_INPUT = "-"

RECORDS: tuple[type[Record], ...] = (ReadOptions, Settings, OutputOptions, WriteOptions, RunOptions)
"""Records of the options that a job takes."""


class Job(NamedTuple):
    """One run of the command: files in, files out."""

    files: tuple[str, ...]  # two or more, one of them perhaps `-`, standard input
    read: ReadOptions
    output: OutputSpec
    write: WriteOptions
    reported: Callable[[], dict[str, Any]]  # gives every option's value in force, for the report
    command: tuple[str, ...]  # the command line
    project: str = ""  # the file that names the others, if there is one

    @property
    def inputs(self) -> list[Path]:
        """All files that are read, whatever for: none of them is replaced."""
        names = *self.files, self.project, self.output.settings.timing.file
        return [Path(name) for name in names if name and name != STANDARD_INPUT]


def job_of(files: tuple[str, ...], given: Mapping[str, Any], command: tuple[str, ...]) -> Job:
    """Make a job of files and values of options by name; raise OptionError if they do not go together."""
    read, settings, write = ReadOptions.of(given), Settings.of(given), WriteOptions.of(given)
    options = OutputOptions.of(given)
    check_files(files, settings)
    output = specify(options, settings, len(files))
    if output.path == write.report == STANDARD_OUTPUT:
        raise OptionError("--output and --report cannot both be standard output")
    if settings.mix and (write.report or write.preview or write.tries):
        raise OptionError(
            "--report, --preview and --try are for blends from drawing to drawing; --mix makes mixtures"
        )
    if write.tries is not None and len(files) > 2:
        raise OptionError(f"--try applies to two files; {len(files)} given")
    records = read, output.settings, options, write, RunOptions.of(given)
    return Job(files, read, output, write, lambda: report_settings(*records) | output.decided(), command)


def check_files(files: tuple[str, ...], settings: Settings) -> None:
    """Raise OptionError if there are too few files, or settings that do not go with their number."""
    if len(files) < 2:
        quoted = [file for file in files if re.search(r"[*?\[]", file) and not os.path.exists(file)]
        remedy = f"; without quotes the shell gives what fits {quoted[0]}" if quoted else ""
        raise OptionError(f"a blend needs two files or more, A.svg and B.svg; {len(files)} given{remedy}")
    if files.count(STANDARD_INPUT) > 1:
        raise OptionError("only one of the files can be standard input")
    settings.check_drawings(len(files))


def check_inputs(files: Sequence[str]) -> None:
    """Raise InputError for a file that is not there, before anything heavy is imported to read the others."""
    for file in files:
        try:
            if file != STANDARD_INPUT and stat.S_ISDIR(os.stat(file).st_mode):
                raise InputError(file, f"is a folder; shapeblend batch {_of_folders(files, file)} would work")
        except InputError:
            raise
        except (OSError, ValueError) as error:
            raise unreadable(file, error, "SVG file") from None


def _of_folders(files: Sequence[str], folder: str) -> str:
    """Return what a batch is told of folders that were given in place of drawings."""
    if len(files) == 2 and all(map(os.path.isdir, files)):
        return f"--pairs {shlex.join(files)}"
    return f"--chain {shlex.quote(folder)}"


def all_targets(job: Job) -> list[Path]:
    """Return all files that a job writes; raise OutputError if two of them are one."""
    names = [*job.output.files(), job.write.report, job.write.preview, job.write.tries]
    targets = [Path(name) for name in names if name and name != STANDARD_OUTPUT]
    places = [os.path.normpath(target) for target in targets]
    for k, place in enumerate(places):
        if place in places[:k]:
            raise OutputError(str(targets[k]), "is named for two different outputs; another name would work")
    return targets
