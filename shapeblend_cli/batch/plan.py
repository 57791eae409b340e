"""Rows into tasks: every row is a job that could be run, and no job is in the way of another one."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from shapeblend_cli.batch.records import SUFFIX, place_of
from shapeblend_cli.errors import OptionError, ShapeblendError
from shapeblend_cli.job.job import RECORDS, STANDARD_INPUT, Job, all_targets, job_of
from shapeblend_cli.outputs.formats import STANDARD_OUTPUT
from shapeblend_cli.outputs.registry import EMITS, FORMATS
from shapeblend_cli.rows.row import LETTERS, Name, Row

_FIELD = re.compile(r"\{\{|\}\}|\{([^{}]*)\}")

LONGEST = 255
"""Maximum length of a file's name, in bytes, as of nearly every file system."""

FILES = {o.name: o.flags[-1] for record in RECORDS for o in record.options.values() if o.kind.is_file}
"""Options that name files, by the names of their fields."""


class Task(NamedTuple):
    """A job of a batch."""

    number: int  # from 1, in the order of the rows
    where: str
    files: tuple[str, ...]
    given: dict[str, Any]  # values of options by the names of their fields
    targets: tuple[Path, ...]
    place: Path  # the file or the folder that it is recorded for
    tree: str  # the folder that its output and those of similar tasks are in
    source: tuple[str, ...]  # where the tasks of the batch come from: a word and paths
    patterns: Mapping[str, str]  # of the files that options name, perhaps with fields

    @property
    def output(self) -> str:
        """The file or folder that is written."""
        return str(self.given["output"])

    @property
    def beside(self) -> list[str]:
        """The files that are read beside drawings: the manifest, and the file of a timetable."""
        word, *paths = self.source
        timing = self.given.get("timing")
        names = *(paths if word == "batch" else ()), timing.file if timing else ""
        return [name for name in names if name and name != STANDARD_INPUT]

    @property
    def job(self) -> Job:
        """The job that is run."""
        return job_of(self.files, self.given, ())


Place = Callable[[str | Path], str]
"""Says where a path leads, in the one form in which paths are compared."""


def places() -> Place:
    """Return what says where paths lead; it looks up each once."""
    folder_of = cache(os.path.realpath)

    @cache
    def place(path: str | Path) -> str:
        folder, name = os.path.split(path)
        found = os.path.join(folder_of(folder), name)
        is_plain = name not in ("", os.curdir, os.pardir) and not os.path.islink(found)
        return os.path.normcase(found if is_plain else os.path.realpath(path))

    return place


def plan(
    rows: Sequence[Row],
    defaults: Mapping[str, Any],
    pattern: str,
    source: tuple[str, ...],
    outside: bool = False,
) -> list[Task]:
    """Return the tasks of all rows, which come from a `source`.

    `defaults` are values of options for rows that do not have their own, and `pattern` is the output of those that get
    none from there. Files that a manifest names lie in its folder, or may lie `outside`.

    Raises
    ------
    OptionError
        If options of a row do not go together, if a name cannot be that of a file, or if a task writes where another
        one reads or writes.
    """
    tasks = []
    leads = places()
    for number, row in enumerate(rows, 1):
        given = {**defaults, **row.given}
        if given.get("output") is None:
            given["output"] = Name(pattern + _suffix(given.get("emit") or EMITS[0]))
        output = given["output"]
        tree = os.path.dirname(os.path.join(output.base, output.pattern.partition("{")[0]))
        fields = _fields(row, number, len(rows))
        patterns = {}
        for name in FILES:
            if given.get(name) is not None:
                patterns[name] = given[name].pattern
                path = _filled(given[name], fields, row.where)
                if given[name].is_bound and not outside:
                    _check_inside(path, given[name].base or os.curdir, row.where, leads)
                given[name] = path
        try:
            job = job_of(row.files, given, ())
            targets = tuple(all_targets(job))
            if not targets:
                raise OptionError("nothing is written: there are no frames, nor anything else")
            if job.read.images == "beside":
                raise OptionError(
                    "--images beside: a batch would not notice that such a file changes; embedded would work"
                )
        except ShapeblendError as error:
            raise OptionError(f"{row.where}: {error}") from None
        place = place_of(job, targets)
        tasks.append(Task(number, row.where, row.files, given, targets, place, tree, source, patterns))
    _check_files(tasks)
    return tasks


def _check_inside(path: str, folder: str, where: str, leads: Place) -> None:
    around = leads(os.path.join(folder, os.curdir))
    if os.path.commonpath([leads(path), around]) != around:
        raise OptionError(
            f"{where}: {path} lies outside the folder of the manifest; --outside on the command line allows that"
        )


def _suffix(emit: str) -> str:
    """Return the suffix of the file that is emitted by default; empty if that is a folder."""
    return next(format.suffix for format in FORMATS if format.emit == emit)


def _fields(row: Row, number: int, count: int) -> dict[str, str]:
    fields = dict(zip(LETTERS, map(_stem, row.files), strict=False))
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


class _Owner(NamedTuple):
    """A task, and what it alone may write: a file, or files in a folder of frames."""

    task: Task
    path: str
    is_file: bool


def _check_files(tasks: Sequence[Task]) -> None:
    for task in tasks:
        for name in (*task.files, *map(str, task.targets)):
            _check_name(name, task.where, LONGEST)
        _check_name(str(task.place), task.where, LONGEST - len(SUFFIX))
    place = places()
    owners: dict[str, _Owner] = {}
    for task in tasks:
        files = list(map(str, task.targets))
        for path in dict.fromkeys((*files, str(task.place))):
            other = owners.setdefault(place(path), _Owner(task, path, path in files)).task
            if other is not task:
                raise OptionError(
                    f"{task.where}: {path} is written by {other.where} as well; {_apart(task, other, path)}"
                )

    @cache
    def owned(folder: str) -> str:
        """Return a folder, or the innermost one that it is in, that has an owner; empty if there is none."""
        parent = os.path.dirname(folder)
        return folder if folder in owners else "" if parent == folder else owned(parent)

    for task in tasks:
        for folder, target in {os.path.dirname(target): target for target in task.targets}.items():
            above = owned(place(folder))
            while above:
                owner = owners[above]
                if owner.is_file:
                    raise OptionError(
                        f"{task.where}: {target} is in {owner.path}, which {owner.task.where} writes as a file"
                    )
                if owner.task is not task:
                    raise OptionError(
                        f"{task.where}: {target} is in {owner.path}, where {owner.task.where} writes its files; "
                        "another folder would work"
                    )
                above = owned(os.path.dirname(above))
        for file in task.files:
            writer = owners.get(place(file))
            if writer is not None:
                if writer.task is task:
                    raise OptionError(f"{task.where}: {file} would be written, and is one of its drawings")
                raise OptionError(f"{writer.task.where}: {file} would be written, which {task.where} reads")
        for file in task.beside:
            writer = owners.get(place(file))
            if writer is not None:
                raise OptionError(
                    f"{writer.task.where}: {file} would be written, and is an input, which is never replaced"
                )


def _apart(task: Task, other: Task, path: str) -> str:
    """Return what would tell a path apart of two tasks: a field in the option that names it."""
    option = next((name for name in FILES if _is_same(task.given.get(name), path)), "output")
    pattern = task.patterns[option]
    if _FIELD.search(pattern):
        return f"{{n}} in {FILES[option]} would tell them apart"
    if [*map(_stem, task.files[:2])] == [*map(_stem, other.files[:2])]:
        fields = "{n}"
    else:
        fields = "{a}" if task.source[0] == "--pairs" else "{a}-{b}"
    root, suffix = os.path.splitext(pattern.rstrip("/"))
    apart = f"{root}-{fields}{suffix}" if suffix else f"{root}/{fields}"
    return f"{FILES[option]} '{apart}' would tell them apart"


def _is_same(name: str | None, path: str) -> bool:
    return name is not None and os.path.normpath(name) == os.path.normpath(path)


def _stem(file: str) -> str:
    return os.path.splitext(os.path.basename(file))[0]


def _check_name(path: str, where: str, longest: int) -> None:
    try:
        name = os.fsencode(path)
    except UnicodeEncodeError:
        name = b"\0"
    if b"\0" in name:
        raise OptionError(f"{where}: {path!a} has a character that no file's name can have")
    names = name.split(os.fsencode(os.sep))
    if len(names[-1]) > longest or max(map(len, names)) > LONGEST:
        raise OptionError(f"{where}: {path} is too long a name; {longest} bytes would work")
