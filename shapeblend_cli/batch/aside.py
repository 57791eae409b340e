"""The files that a batch writes aside from its outputs: results, messages, dependencies, and a summary.

Results and messages are written as jobs end (`lines`). A summary, as JUnit or JSON, has the whole batch.
"""

from __future__ import annotations

import json
import os
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

from shapeblend_cli.batch.lines import Add, add_messages, add_results
from shapeblend_cli.batch.options import BatchOptions
from shapeblend_cli.batch.plan import Task, places
from shapeblend_cli.batch.run import Outcome
from shapeblend_cli.errors import OptionError, OutputError
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT
from shapeblend_cli.system.write import check_targets, write_files
from shapeblend_cli.version import __version__

STATUSES = ("done", "cached", "current", "failed", "timeout", "memory", "died", "left")

XML, JSON, DEPENDENCIES = ".xml", ".json", ".d"

OURS = {
    XML: re.compile(rb'\Z|<\?xml[^>]*\?>\s*<testsuites name="shapeblend"'),
    JSON: re.compile(rb'\Z|\{"shapeblend": '),
    DEPENDENCIES: re.compile(rb"(\Z|([^\t#\n].*: .+\n)+([^\t#\n].*:\n)+\Z)"),
}
"""The forms of files that are written here, by their suffixes. Others are not replaced."""

NOT_IN_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def check_aside(options: BatchOptions, tasks: Sequence[Task]) -> None:
    """Raise OutputError if a file is to be written aside that the batch reads or writes as well."""
    files = options.results, options.log_file, options.summary, options.depfile
    given = [file for file in files if file not in (None, STANDARD_OUTPUT)]
    if not given:
        return
    place = places()
    taken = {place(path) for task in tasks for path in (*task.files, *map(str, task.targets), *task.beside)}
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
        """Take the outcome of a task; only news is added to the results."""
        row = outcome.as_json()
        if self._add is not None and is_news:
            self._add(json.dumps(row, allow_nan=False))
        if self._summary is not None:
            self._rows[outcome.task.number] = row

    def end(self, tasks: Sequence[Task], problem: str | None = None) -> None:
        """Write the outcomes of all tasks, and the problem that ended the batch."""
        if problem is not None:
            self.message(problem)
        if self._summary is not None:
            file = Path(self._summary)
            summary = Summary(self._name, tasks, self._rows, perf_counter() - self._began, problem)
            form = _junit if file.suffix.lower() == XML else _json
            write_files({file: form(summary)}, force=True)


class Summary(NamedTuple):
    """What has become of a batch."""

    name: str
    tasks: Sequence[Task]
    rows: Mapping[int, dict[str, Any]]  # of tasks that have ended, by their numbers, as results have them
    seconds: float
    problem: str | None  # what the batch itself ended with

    def counts(self) -> dict[str, int]:
        """Return how many tasks have come to what."""
        found = Counter("cached" if row["cached"] else row["status"] for row in self.rows.values())
        found["left"] = len(self.tasks) - len(self.rows)
        return {status: found[status] for status in STATUSES}


def _json(summary: Summary) -> str:
    head = {"shapeblend": __version__, "batch": summary.name, "jobs": len(summary.tasks), **summary.counts()}
    tail = {
        "seconds": round(summary.seconds, 3),
        "error": summary.problem,
        "results": [*summary.rows.values()],
    }
    return json.dumps({**head, **tail}) + "\n"


def _junit(summary: Summary) -> str:
    """Return a suite with a case for each job, as Jenkins, GitLab and others read it."""
    from xml.etree import ElementTree

    counts = summary.counts()
    totals = {
        "tests": len(summary.tasks) + (summary.problem is not None),
        "failures": sum(counts[status] for status in ("failed", "timeout", "memory", "died")),
        "errors": int(summary.problem is not None),
        "skipped": counts["left"],
        "time": f"{summary.seconds:.3f}",
    }
    shown = {name: str(value) for name, value in totals.items()}
    root = ElementTree.Element("testsuites", {"name": "shapeblend", **shown})
    now = f"{datetime.now(UTC):%Y-%m-%dT%H:%M:%S}"
    name = _legal(summary.name)
    suite = ElementTree.SubElement(root, "testsuite", {"name": name, **shown, "timestamp": now})
    if summary.problem is not None:
        case = ElementTree.SubElement(suite, "testcase", {"classname": name, "name": name})
        ElementTree.SubElement(case, "error", {"message": _legal(summary.problem)})
    for task in summary.tasks:
        row = summary.rows.get(task.number)
        seconds = f"{row['seconds'] if row else 0.0:.3f}"
        case = ElementTree.SubElement(
            suite, "testcase", {"classname": name, "name": _legal(task.output), "time": seconds}
        )
        if row is None:
            ElementTree.SubElement(case, "skipped", {"message": "the batch ended before this job"})
        elif row["error"] is not None:
            error = _legal(row["error"])
            what = {"message": error, "type": row["status"]}
            ElementTree.SubElement(case, "failure", what).text = f"{_legal(task.where)}: {error}"
        if row is not None and row["notes"]:
            ElementTree.SubElement(case, "system-out").text = _legal("\n".join(row["notes"]))
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ElementTree.tostring(root, "unicode") + "\n"


def _legal(text: str) -> str:
    """Return a text with only those characters that XML can have."""
    return NOT_IN_XML.sub("\ufffd", text)


def dependencies(tasks: Sequence[Task]) -> str:
    """Return rules for make and ninja: of outputs and their drawings, and of drawings alone, which may be gone.

    OptionError is raised for a name that neither of the two can read.
    """
    lines = [
        f"{' '.join(map(_escaped, map(str, task.targets)))}: {' '.join(map(_escaped, task.files))}\n"
        for task in tasks
    ]
    drawings = dict.fromkeys(file for task in tasks for file in task.files)
    return "".join([*lines, *(f"{_escaped(file)}:\n" for file in drawings)])


def _escaped(path: str) -> str:
    """Return a path as compilers write it into a file of dependencies."""
    if path.endswith("\\") or any(sign in path for sign in "\t\n;|"):
        raise OptionError(f"--depfile: make and ninja cannot read the name {path!a}; another one would work")
    name = os.path.normpath(path).replace("$", "$$")
    name = re.sub(r"(\\*) ", r"\1\1\\ ", name)
    return re.sub("([#:])", r"\\\1", name)
