"""Files that grow by whole lines: what has become of jobs, and the messages of a run.

Each line is added in one step, under the system's lock on the file, so that several batches can share one.
"""

from __future__ import annotations

import errno
import json
import os
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path

from shapeblend_cli.errors import OutputError
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT
from shapeblend_cli.system.staging import locked

LONGEST = 2**20
"""Maximum length of a line that is taken for one of ours, in bytes."""

Add = Callable[[str], None]
"""Adds a line to a file."""


def add_results(file: str) -> Add:
    """Return what adds lines of JSON to a file of results; OutputError if it is a file of another kind."""
    return _add_to(file, _is_result, "results")


def add_messages(file: str) -> Add:
    """Return what adds messages to a log, each with the time; OutputError if it is a file of another kind."""
    add = _add_to(file, _is_message, "messages")
    return lambda text: add(f"{datetime.now():%Y-%m-%d %H:%M:%S} shapeblend: {' '.join(text.split())}")


def _is_result(line: bytes) -> bool:
    try:
        found = json.loads(line)
    except (ValueError, RecursionError):
        return False
    return isinstance(found, dict) and {"job", "status"} <= found.keys()


def _is_message(line: bytes) -> bool:
    return re.match(rb"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d shapeblend: ", line) is not None


def _add_to(file: str, is_ours: Callable[[bytes], bool], what: str) -> Add:
    """Return what adds lines to a file, to standard output, or to a device or the like."""

    def append(line: str) -> None:
        with _cannot_write(file), locked(Path(file)):
            _append(file, _bytes(line), is_ours)

    if file == STANDARD_OUTPUT:
        return _print
    with _cannot_write(file):
        if os.path.exists(file) and not (os.path.isfile(file) or os.path.isdir(file)):
            handle = os.open(file, os.O_WRONLY)  # for as long as the process runs
            return lambda line: _write(file, handle, line)
        os.makedirs(os.path.dirname(file) or os.curdir, exist_ok=True)
        with open(file, "a+b") as found:
            found.seek(0)
            first = found.readline(LONGEST)
    if first and not is_ours(first):
        raise OutputError(file, f"is no file of {what}, and stays as it is; another name would work")
    return append


def _bytes(line: str) -> bytes:
    return line.encode("utf-8", "backslashreplace") + b"\n"


def _print(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def _write(file: str, handle: int, line: str) -> None:
    with _cannot_write(file):
        os.write(handle, _bytes(line))


def _append(file: str, line: bytes, is_ours: Callable[[bytes], bool]) -> None:
    """Add a line at the end of a file, or nothing. What is there of a line that was cut off goes."""
    with open(file, "a+b", buffering=0) as stream:
        size = stream.seek(0, os.SEEK_END)
        stream.seek(max(size - 1, 0))
        if stream.read() not in (b"", b"\n"):
            stream.seek(max(size - LONGEST, 0))
            rest = stream.read().rpartition(b"\n")[2]
            if is_ours(rest):
                line = b"\n" + line
            else:
                size = stream.truncate(size - len(rest))
        try:
            if stream.write(line) < len(line):
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        except OSError:
            stream.truncate(size)
            raise


@contextmanager
def _cannot_write(file: str) -> Iterator[None]:
    try:
        yield
    except (OSError, ValueError) as error:
        raise OutputError(file, f"cannot be written ({getattr(error, 'strerror', None) or error})") from error
