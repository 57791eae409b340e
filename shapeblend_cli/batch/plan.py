"""Rows into tasks: every row is a job that could be run, and no two write one file."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from shapeblend_cli.batch.rows import LETTERS, Name, Row, command_of
from shapeblend_cli.errors import OptionError, ShapeblendError
from shapeblend_cli.job.job import RECORDS, Job, all_targets, job_of
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT
from shapeblend_cli.outputs.registry import EMITS, FORMATS

_FIELD = re.compile(r"\{\{|\}\}|\{([^{}]*)\}")

FILES = tuple(o.name for record in RECORDS for o in record.options.values() if o.kind.is_file)


class Task(NamedTuple):
    """A job of a batch."""

    number: int  # from 1, in the order of the rows
    where: str
    files: tuple[str, ...]
    given: dict[str, Any]  # values of options by the names of their fields
    targets: tuple[Path, ...]

    @property
    def output(self) -> str:
        """The file or folder that is written."""
        return str(self.given["output"])

    @property
    def job(self) -> Job:
        """The job that is run."""
        return job_of(self.files, self.given, command_of(self.files, self.given))


def plan(rows: Sequence[Row], defaults: Mapping[str, Any], pattern: str) -> list[Task]:
    """Return the tasks of all rows.

    `defaults` are values of options for rows that do not have their own, and `pattern` is the output of those that get
    none from there.

    Raises
    ------
    OptionError
        If options of a row do not go together, or if two tasks write one file, or one writes what another one reads.
    """
    tasks = []
    for number, row in enumerate(rows, 1):
        given = {**defaults, **row.given}
        if given.get("output") is None:
            given["output"] = Name(pattern + _suffix(given.get("emit") or EMITS[0]))
        fields = _fields(row, number, len(rows))
        for name in FILES:
            if given.get(name) is not None:
                given[name] = _filled(given[name], fields, row.where)
        task = Task(number, row.where, row.files, given, ())
        try:
            targets = tuple(all_targets(task.job))
            if not targets:
                raise OptionError("nothing is written: there are no frames, nor anything else")
        except ShapeblendError as error:
            raise OptionError(f"{row.where}: {error}") from None
        tasks.append(task._replace(targets=targets))
    _check_files(tasks)
    return tasks


def _suffix(emit: str) -> str:
    """Return the suffix of the file that is emitted by default; empty if that is a folder."""
    return next(format.suffix for format in FORMATS if format.emit == emit)


def _fields(row: Row, number: int, count: int) -> dict[str, str]:
    """Return what the fields of names stand for."""
    stems = [os.path.splitext(os.path.basename(file))[0] for file in row.files]
    fields = dict(zip(LETTERS, stems, strict=False))
    return fields | {"a": os.path.splitext(row.name)[0], "n": f"{number:0{len(str(count))}d}"}


def _filled(name: Name, fields: Mapping[str, str], where: str) -> str:
    """Return a name with its fields filled in, below its base; `{{` and `}}` are braces."""

    def fill(match: re.Match[str]) -> str:
        if match[1] is None:
            return match[0][0]
        try:
            return fields[match[1]]
        except KeyError:
            known = ", ".join(f"{{{field}}}" for field in fields)
            remedy = f"{known} would work, and {{{{ for a brace"
            raise OptionError(f"{where}: {name.pattern} has {match[0]}; {remedy}") from None

    if name.pattern == STANDARD_OUTPUT:
        raise OptionError(f"{where}: a batch writes files, and nothing to standard output")
    return os.path.join(name.base, _FIELD.sub(fill, name.pattern))


def _check_files(tasks: Sequence[Task]) -> None:
    written: dict[str, Task] = {}
    for task in tasks:
        for target in task.targets:
            other = written.setdefault(_place(target), task)
            if other is not task:
                raise OptionError(
                    f"{task.where}: {target} is written by {other.where} as well; "
                    "{n} or {b} in --output would tell them apart"
                )
    for task in tasks:
        for file in task.files:
            writer = written.get(_place(file))
            if writer is not None:
                raise OptionError(f"{writer.where}: {file} would be written, which {task.where} reads")


def _place(path: str | Path) -> str:
    return os.path.normcase(os.path.realpath(path))
