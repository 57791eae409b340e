"""What has become of a whole batch, for other programs: a summary as JUnit or JSON, and a file of dependencies."""

from __future__ import annotations

import json
import os
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from typing import Any, NamedTuple

from shapeblend_cli.batch.plan import Task
from shapeblend_cli.errors import OptionError
from shapeblend_cli.version import __version__

STATUSES = ("done", "cached", "current", "failed", "timeout", "died", "left")

XML, JSON, DEPENDENCIES = ".xml", ".json", ".d"

OURS = {
    XML: re.compile(rb'\Z|<\?xml[^>]*\?>\s*<testsuites name="shapeblend"'),
    JSON: re.compile(rb'\Z|\{"shapeblend": '),
    DEPENDENCIES: re.compile(rb"(\Z|([^\t#\n].*: .+\n)+([^\t#\n].*:\n)+\Z)"),
}
"""The forms of files that are written here, by their suffixes. Others are not replaced."""

NOT_IN_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


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


def text_of(suffix: str, summary: Summary) -> str:
    """Return a summary as a file with a suffix has it."""
    return _junit(summary) if suffix == XML else _json(summary)


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
        "failures": sum(counts[status] for status in ("failed", "timeout", "died")),
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
