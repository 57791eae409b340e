"""Outputs by what they were made of, in a folder that checkouts and machines share.

An entry is a file of its own, DIR/c0/ffee...: the SHA-256 of what follows, a line of JSON, and the contents of outputs.
It is named by a hash of what a record has, and written in one step. One whose bytes do not have their hash counts as
missing. Any entry can be deleted at any time, and those that are used get a new time, so that old ones can be found.
"""

from __future__ import annotations

import hashlib
import json
import os
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

from shapeblend_cli.batch.records import each_file
from shapeblend_cli.errors import OutputError
from shapeblend_cli.job.job import Job, all_targets
from shapeblend_cli.outputs.formats import Rendered
from shapeblend_cli.system.write import Contents

FORM = 1
"""The number of the form of entries. Entries of any other form have other names."""


class Found(NamedTuple):
    """What a job has made, or made at another time."""

    contents: Contents
    notes: tuple[str, ...]


def open_cache(folder: str) -> bool:
    """Make the folder of a cache if there is none, and return whether entries can be added.

    Raises
    ------
    OutputError
        If there is no such folder, and none can be made.
    """
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise OutputError(
            folder, f"cannot be a folder ({error.strerror}); another name would work"
        ) from error
    return os.access(folder, os.W_OK)


def find(folder: str, job: Job, made_of: dict[str, Any]) -> Found | None:
    """Return the outputs kept for a job, by the hashes of its inputs; None if there are none, or damaged ones."""
    of = _of(job, made_of)
    path = _path(folder, of)
    try:
        digest, _, data = path.read_bytes().partition(b"\n")
    except OSError:
        return None
    if digest != _hash(data):
        return None
    with suppress(OSError):
        os.utime(path)
    head, _, data = data.partition(b"\n")
    entry = json.loads(head)
    pieces = []
    for size in entry["sizes"]:
        pieces.append(data[:size])
        data = data[size:]
    count = len(job.output.files())
    contents: dict[Path, Any] = {**job.output.by_target(Rendered(pieces[:count]))} if count else {}
    contents |= zip(all_targets(job)[count:], pieces[count:], strict=True)
    return Found(contents, tuple(entry["notes"]))


def keep(folder: str, job: Job, made_of: dict[str, Any], found: Found) -> None:
    """Keep what a job has made; OSError is raised if that cannot be written."""
    of = _of(job, made_of)
    pieces = [data for _, data in each_file(found.contents)]
    head = {"of": of, "notes": found.notes, "sizes": list(map(len, pieces))}
    data = b"\n".join((json.dumps(head).encode(), b"".join(pieces)))
    path = _path(folder, of)
    path.parent.mkdir(parents=True, exist_ok=True)
    new = path.with_name(f"{path.name}.{os.urandom(6).hex()}")
    try:
        new.write_bytes(_hash(data) + b"\n" + data)
        os.replace(new, path)
    except OSError:
        new.unlink(missing_ok=True)
        raise


def _of(job: Job, made_of: dict[str, Any]) -> dict[str, Any]:
    """Return all that the bytes of a job's outputs depend on. In reports and previews there are names of files."""
    has_names = job.write.report or job.write.preview
    return {
        "form": FORM,
        **made_of,
        "format": job.output.format.name,
        "aside": [bool(name) for name in (job.write.report, job.write.preview, job.write.tries)],
        "command": list(job.command) if has_names else [],
    }


def _path(folder: str, of: dict[str, Any]) -> Path:
    name = hashlib.sha256(json.dumps(of, sort_keys=True).encode()).hexdigest()
    return Path(folder, name[:2], name[2:])


def _hash(data: bytes) -> bytes:
    return hashlib.sha256(data).hexdigest().encode()
