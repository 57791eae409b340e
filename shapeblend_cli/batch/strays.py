"""Files that a batch wrote and that are outputs no more: of jobs that are gone, and of runs that wrote more files.

A file counts as written by a batch if its bytes have the hash that a record has of it.
"""

from __future__ import annotations

import os
from collections.abc import Container, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

from shapeblend_cli.batch.plan import Place, Task, places
from shapeblend_cli.batch.records import (
    FOLDER,
    SUFFIX,
    hash_of_file,
    hashes_of,
    path_of,
    read_record,
    relative,
)
from shapeblend_cli.errors import OutputError


class Strays(NamedTuple):
    """Files that a record has and that are outputs no more."""

    place: Path  # what the record is of
    is_gone: bool  # whether its job is gone
    files: list[Path]
    edited: list[Path]  # since a batch wrote them; they stay

    def remove(self) -> Iterator[str]:
        """Remove files, and yield a message for each; OutputError is raised if one cannot be removed."""
        gone = [path_of(self.place)] if self.is_gone and not self.edited else []
        for file in (*self.files, *gone):
            try:
                file.unlink()
            except OSError as error:
                raise OutputError(str(file), f"cannot be removed ({error.strerror})") from error
        for file in self.files:
            yield f"{file}: removed, as no job writes it any more"
        for file in self.edited:
            yield f"{file}: no job writes it any more, but it was edited, and stays"

    def remove_folders(self) -> None:
        """Remove folders that have nothing in them any more."""
        home = self.place.parent
        for folder in (*dict.fromkeys(file.parent for file in self.files), home / FOLDER, home):
            with suppress(OSError):
                folder.rmdir()


def strays(tasks: Sequence[Task], well: Container[int] | None = None) -> Iterator[Strays]:
    """Yield the files that are outputs no more: of jobs that are gone, and of tasks if they have ended `well`."""
    place = places()
    taken = {place(path) for task in tasks for path in (*task.files, *map(str, task.targets))}
    records = {place(path_of(task.place)) for task in tasks}
    for task in tasks:
        if well is None or task.number in well:
            yield _strays(task.place, False, read_record(path_of(task.place)), place, taken)
    for home in _homes(tasks):
        for path in sorted((home / FOLDER).glob(f"*{SUFFIX}")):
            record = read_record(path)
            if place(path) not in records and record.get("batch") == relative(tasks[0].source, home):
                yield _strays(home / path.name.removesuffix(SUFFIX), True, record, place, taken)


def _strays(
    where: Path, is_gone: bool, record: dict[str, Any], place: Place, taken: Container[str]
) -> Strays:
    known: dict[str, set[str]] = {}
    for part in hashes_of(record):
        for name, value in part.items():
            known.setdefault(name, set()).add(value)
    found = Strays(where, is_gone, [], [])
    for name, hashes in known.items():
        file = Path(os.path.normpath(where.parent / name))
        now = hash_of_file(file)
        if now and place(file) not in taken:
            (found.files if now in hashes and not file.is_symlink() else found.edited).append(file)
    return found


def _homes(tasks: Sequence[Task]) -> Iterator[Path]:
    """Yield the folders below those that the batch writes to which have records."""
    seen: set[str] = set()
    for tree in sorted({task.tree for task in tasks}):
        for folder, inside, _ in os.walk(tree or os.curdir):
            if folder in seen:
                inside.clear()
                continue
            seen.add(folder)
            if FOLDER in inside:
                yield Path(folder)
            inside[:] = [name for name in inside if not name.startswith(".")]
