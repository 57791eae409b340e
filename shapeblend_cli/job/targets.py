"""The files that a job writes: whether it may, all of them or none, and the standard output."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from shapeblend_cli.errors import OutputError, PictureError
from shapeblend_cli.job.job import STANDARD_INPUT, Job, all_targets
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT, OutputSpec
from shapeblend_cli.system.write import Contents, check_targets, write_files


def check_libraries(job: Job) -> None:
    """Raise OutputError if a job needs a library that is not there."""
    with named(job.output.path):
        job.output.format.check_libraries()


def check_files_of(job: Job) -> None:
    """Raise OutputError if a job must not write one of its targets; see `check_targets`."""
    check_targets(all_targets(job), job.inputs, job.write.force)


def check_output(output: str, files: Sequence[str], force: bool) -> None:
    """Raise OutputError if a text that is made of files must not be written to an output; see `check_targets`."""
    if output != STANDARD_OUTPUT:
        check_targets([Path(output)], [Path(file) for file in files if file != STANDARD_INPUT], force)


def write(
    job: Job, contents: Contents, warn: Callable[[str], None], standard_output: str | bytes = ""
) -> None:
    """Write what was made, all of it or nothing."""
    write_files(contents, job.write.force)
    print_text(standard_output, "; the files were written" if any(contents.values()) else "")
    warn_of_others(job, warn)


def warn_of_others(job: Job, warn: Callable[[str], None]) -> None:
    """Say that there are frames of another run in the folder of a job."""
    if stale := _stale_frames(job.output):
        warn(f"{job.output.path}: {len(stale)} frame files of another run remain, {min(stale)} among them")


def write_output(output: str, text: str, force: bool) -> None:
    """Write a text to a file, or to standard output."""
    if output == STANDARD_OUTPUT:
        print_text(text)
    else:
        write_files({Path(output): text}, force)


@contextmanager
def named(output: str) -> Iterator[None]:
    """Name the output in errors about pictures that cannot be drawn."""
    try:
        yield
    except PictureError as error:
        raise OutputError(output, str(error)) from error


def _stale_frames(output: OutputSpec) -> set[str]:
    """Return the names of frame files in the folder that are none of the run's own."""
    names = {name for name in output.frame_files() if name}
    suffixes = {re.escape(Path(name).suffix) for name in names}
    if not suffixes:
        return set()
    frames = re.compile(rf"frame-[0-9]+({'|'.join(suffixes)})")
    return {name for name in os.listdir(output.path) if frames.fullmatch(name)} - names


def print_text(text: str | bytes, stands: str = "") -> None:
    """Write to standard output as UTF-8 in every locale; an error names the files that were written."""
    if not text:
        return
    try:
        sys.stdout.buffer.write(text.encode("utf-8", "replace") if isinstance(text, str) else text)
        sys.stdout.buffer.flush()
    except BrokenPipeError:
        raise
    except OSError as error:
        raise OutputError("standard output", f"cannot be written ({error.strerror}){stands}") from error
