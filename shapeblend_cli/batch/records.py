"""What a job's outputs were made of, kept beside them, so that a job is done again only when that has changed.

The record of `out/x.svg` is `out/.shapeblend/x.svg.json`. It is written before the outputs and has the hashes that
they are to have, and those that they had before. So whenever a run is killed, each output is known as the batch's own,
and is up to date if it has the hash that it is to have. What has any other hash was not written by a batch.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from shapeblend_cli.errors import FileError, InputError, OutputError
from shapeblend_cli.job.job import Job
from shapeblend_cli.system.staging import sync_folder
from shapeblend_cli.system.write import Contents
from shapeblend_cli.version import __version__

FOLDER, SUFFIX = ".shapeblend", ".json"

FORM = 1
"""Version of the form of records. Records of another version count as missing."""

UNRECORDED = ("output", "force", "report", "preview", "tries", "timeout", "max_memory")
"""Settings that do not change the contents of outputs. The names of outputs are recorded by themselves."""

IRRELEVANT = ("cli", "batch")
"""Parts of the package that outputs do not depend on."""

Hashes = dict[str, str]


class State(NamedTuple):
    """How a job stands before it is done."""

    reason: str  # why it is to be done; empty if it is up to date
    refusal: FileError | None = None  # why it cannot or must not be done
    edited: str = ""  # an output of a job that is up to date but for that, edited since


class Record:
    """The record of a job."""

    def __init__(self, job: Job, targets: Sequence[Path]) -> None:
        self._job = job
        self._targets = targets
        place = place_of(job, targets)
        self._home = place.parent
        self._path = path_of(place)

    def state(self, hash_of: Callable[[str | Path], str], force: bool) -> State:
        """Say whether the job is up to date, or why not, by the hashes of files."""
        old, new = read_record(self._path), self.made_of(hash_of)
        for file in self._job.files:
            if not hash_of(file) and (problem := _unreadable(file)):
                return State("", problem)
        now = {self._name(target): hash_of(target) for target in self._targets}
        if force:
            return State("--force")
        reason = _difference(old, new, now) if old else "it has not been done yet"
        foreign = self._foreign(old, now)
        if not foreign:
            if not reason and (
                missing := [name for name, value in now.items() if value != old["outputs"][name]]
            ):
                reason = (
                    f"{missing[0]} is missing"
                    if not now[missing[0]]
                    else f"{missing[0]} is from an older run"
                )
            return State(reason)
        if not reason and all(now.values()):
            return State("", edited=foreign)
        return State(reason or "outputs are missing", self._refusal(foreign, bool(old)))

    def write(
        self, made_of: dict[str, Any], contents: Contents, force: bool, batch: Sequence[str] = ()
    ) -> None:
        """Record the outputs before they are written; OutputError is raised if they would replace files of others.

        `batch` is where the job comes from, as `relative` has it.
        """
        old = read_record(self._path)
        now = {self._name(target): hash_of_file(target) for target in self._targets}
        if not force and (foreign := self._foreign(old, now)):
            raise self._refusal(foreign, bool(old))
        older = {name: value for part in hashes_of(old) for name, value in part.items() if name not in now}
        record = {
            "record": FORM,
            "batch": list(batch),
            **made_of,
            "outputs": {self._name(p): hashlib.sha256(data).hexdigest() for p, data in each_file(contents)},
            "before": {name: value for name, value in now.items() if value},
            "older": {name: value for name, value in older.items() if (self._home / name).exists()},
        }
        _replace(self._path, json.dumps(record, indent=1).encode())

    def made_of(self, hash_of: Callable[[str | Path], str] | None = None) -> dict[str, Any]:
        """Return what outputs would be made of now, by the hashes of files."""
        hash_of = hash_of or hash_of_file
        reported = {key: value for key, value in self._job.reported().items() if key not in UNRECORDED}
        return {
            "version": __version__,
            "method": method(),
            "inputs": [[os.path.basename(file), hash_of(file)] for file in self._job.files],
            "settings": reported,
        }

    def _name(self, target: Path) -> str:
        return os.path.relpath(target, self._home)

    def _foreign(self, old: dict[str, Any], now: Hashes) -> str:
        """Return the name of an output that no batch has written so; empty if there is none."""
        known = hashes_of(old)
        return next((n for n, value in now.items() if value and value not in (k.get(n) for k in known)), "")

    def _refusal(self, name: str, is_edited: bool) -> OutputError:
        problem = (
            "was edited since a batch wrote it; --force replaces it"
            if is_edited
            else "exists; --force replaces it"
        )
        return OutputError(str(self._home / name), problem)


def read_record(path: Path) -> dict[str, Any]:
    """Return what a record has; nothing if it cannot be read."""
    with suppress(OSError, ValueError):
        found = json.loads(path.read_bytes())
        if _is_record(found):
            return dict(found)
    return {}


def path_of(place: Path) -> Path:
    """Return where the record of a file or a folder is."""
    return place.parent / FOLDER / f"{place.name}{SUFFIX}"


def relative(batch: Sequence[str], home: Path) -> list[str]:
    """Return where jobs come from, a word and paths, as records in a folder have it."""
    word, *paths = batch
    return [word, *(os.path.relpath(path or os.curdir, home) for path in paths)]


def hashes_of(record: dict[str, Any]) -> list[Hashes]:
    """Return the hashes of files that a batch wrote, as far as a record has them: at any time, before, and at last."""
    return [record.get(part, {}) for part in ("older", "before", "outputs")]


def place_of(job: Job, targets: Sequence[Path]) -> Path:
    """Return the file or the folder that a job is recorded for."""
    return Path(job.output.path if job.output.files() else targets[0])


class HashOf:
    """Hashes of files by their names, each taken once."""

    def __init__(self) -> None:
        self._known: dict[str, str] = {}

    def __call__(self, path: str | Path) -> str:
        """Return the hash of a file; empty if it cannot be read."""
        name = str(path)
        if name not in self._known:
            self._known[name] = hash_of_file(name)
        return self._known[name]


def hash_of_file(path: str | Path) -> str:
    """Return the SHA-256 of a file's bytes; empty if it cannot be read, or is a device or the like."""
    try:
        if not os.path.isfile(path):
            return ""
        with open(path, "rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except (OSError, ValueError):
        return ""


def _unreadable(file: str) -> InputError | None:
    """Say why a drawing that has no hash cannot be read; None if it is a device or the like."""
    from shapeblend_cli.svg.reading.read import contents_of

    if not os.path.exists(file) or os.path.isfile(file) or os.path.isdir(file):
        try:
            contents_of(file)
        except InputError as error:
            return error
    return None


@cache
def method() -> str:
    """Return a hash of all code that outputs depend on."""
    package = Path(__file__).parents[1]
    found = hashlib.sha256()
    for file in sorted(package.rglob("*")):
        inside = file.relative_to(package)
        if file.suffix in (".py", ".js", ".css", ".html") and inside.parts[0] not in IRRELEVANT:
            found.update(inside.as_posix().encode() + b"\0" + file.read_bytes() + b"\0")
    return found.hexdigest()


def _difference(old: dict[str, Any], new: dict[str, Any], now: Hashes) -> str:
    """Say in what a job differs from its record; empty if in nothing."""
    if old["version"] != new["version"] or old["method"] != new["method"]:
        return f"it was done by another version of shapeblend, {old['version']}"
    for (old_name, old_hash), (name, value) in zip(old["inputs"], new["inputs"], strict=False):
        if old_name != name:
            return f"it was done with {old_name}, not {name}"
        if old_hash != value:
            return f"{name} has changed"
    if len(old["inputs"]) != len(new["inputs"]):
        return "it has more or fewer drawings"
    for key in sorted({*old["settings"], *new["settings"]}):
        before, after = old["settings"].get(key), new["settings"].get(key)
        if before != after:
            return f"{key} is {json.dumps(after)}, and was {json.dumps(before)}"
    if {*old["outputs"]} != {*now}:
        return "it has other outputs"
    return ""


def _is_record(found: Any) -> bool:
    return (
        isinstance(found, dict)
        and found.get("record") == FORM
        and all(isinstance(found.get(key), str) for key in ("version", "method"))
        and all(isinstance(found.get(key), dict) for key in ("settings", "outputs", "before"))
        and isinstance(found.get("inputs"), list)
        and all(isinstance(each, list) and len(each) == 2 for each in found["inputs"])
    )


def each_file(contents: Contents) -> Iterator[tuple[Path, bytes]]:
    """Yield each file, alone or in a folder, with its contents."""
    for target, content in contents.items():
        files = content if isinstance(content, Mapping) else {"": content}
        for name, text in files.items():
            yield target / name, text.encode("utf-8", "replace") if isinstance(text, str) else text


def _replace(path: Path, data: bytes) -> None:
    """Write a file in one step, and have it on the disk. No other batch does so at the same time; see `claims`."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        new = path.with_suffix(".new")
        with open(new, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(new, path)
        sync_folder(path.parent)
    except OSError as error:
        where = str(path.parent)
        raise OutputError(where, f"no record of a batch can be written there ({error.strerror})") from error
