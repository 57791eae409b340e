"""The files that a batch writes aside from its outputs: results, messages, a summary, and dependencies."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from time import perf_counter
from typing import Any

from shapeblend_cli.batch.lines import Add, add_messages, add_results
from shapeblend_cli.batch.options import BatchOptions
from shapeblend_cli.batch.plan import Task, places
from shapeblend_cli.batch.run import Outcome
from shapeblend_cli.batch.summary import OURS, Summary, dependencies, text_of
from shapeblend_cli.errors import OutputError
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT
from shapeblend_cli.system.write import check_targets, write_files


def check_aside(options: BatchOptions, tasks: Sequence[Task], names: Sequence[str]) -> None:
    """Raise OutputError if a file is to be written aside that the batch reads or writes as well.

    `names` are files that it reads beside drawings.
    """
    files = options.results, options.log_file, options.summary, options.depfile
    given = [file for file in files if file not in (None, STANDARD_OUTPUT)]
    if not given:
        return
    place = places()
    taken = {place(path) for task in tasks for path in (*task.files, *map(str, task.targets), *names)}
    for file in map(str, given):
        if place(file) in taken:
            raise OutputError(file, "is read or written by the batch as well; another name would work")
        taken.add(place(file))


class Aside:
    """What is written aside.

    Raises
    ------
    OutputError
        If a file is of another kind, or cannot be written.
    """

    def __init__(self, options: BatchOptions, name: str) -> None:
        self._name = name
        self._summary, self._depfile = options.summary, options.depfile
        files = [Path(file) for file in (options.summary, options.depfile) if file is not None]
        check_targets(files, [], force=True)
        for file in files:
            if file.exists() and not OURS[file.suffix.lower()].match(file.read_bytes()):
                raise OutputError(
                    str(file), "is of another kind, and stays as it is; another name would work"
                )
        self._add: Add | None = add_results(options.results) if options.results is not None else None
        self.message: Add = (
            add_messages(options.log_file) if options.log_file is not None else lambda text: None
        )
        self._rows: dict[int, dict[str, Any]] = {}
        self._began = perf_counter()

    def begin(self, tasks: Sequence[Task]) -> None:
        """Begin with some tasks; OptionError is raised for a name that a file of dependencies cannot have."""
        if self._depfile is not None:
            write_files({Path(self._depfile): os.fsencode(dependencies(tasks))}, force=True)
        self._rows, self._began = {}, perf_counter()
        self.message(f"{self._name}: {len(tasks)} jobs")

    def ended(self, outcome: Outcome, is_news: bool) -> None:
        """Take what has become of a task; the results have it if it is news."""
        row = outcome.as_json()
        if self._add is not None and is_news:
            self._add(json.dumps(row, allow_nan=False))
        if self._summary is not None:
            self._rows[outcome.task.number] = row

    def end(self, tasks: Sequence[Task], problem: str | None = None) -> None:
        """Write what has become of all tasks, and what the batch itself ended with."""
        if problem is not None:
            self.message(problem)
        if self._summary is not None:
            file = Path(self._summary)
            summary = Summary(self._name, tasks, self._rows, perf_counter() - self._began, problem)
            write_files({file: text_of(file.suffix.lower(), summary)}, force=True)
