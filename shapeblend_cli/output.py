"""Writing files so that they appear only when all of them are complete."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from shapeblend_cli.errors import OutputError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping


def check_targets(targets: Iterable[Path], inputs: Iterable[Path], force: bool) -> None:
    """Refuse targets that must not be written, before any work is done.

    OutputError is raised for one that is an input or a folder, that exists without `force`, or whose folder cannot be
    made.
    """
    sources = [path.resolve() for path in inputs]
    for target in targets:
        if target.resolve() in sources:
            raise OutputError(str(target), "is an input and is never replaced; another name would work")
        if target.is_dir():
            raise OutputError(str(target), "is a folder; the name of a file would work")
        if not force and os.path.lexists(target):
            raise OutputError(str(target), "exists; --force replaces it")
        for parent in target.parents:
            if parent.exists():
                if not parent.is_dir():
                    raise OutputError(str(parent), "is a file, and a folder of that name is needed")
                if not os.access(parent, os.W_OK):
                    raise OutputError(str(parent), "is a folder that cannot be written to")
                break


def write_files(contents: Mapping[Path, str | bytes]) -> None:
    """Write all files or none, texts as UTF-8.

    Each file is first written in full in a folder of our own beside its target; only then are they moved into
    place, one atomic step each. OutputError is raised if the disk is full, a folder is read-only, and the like.
    """
    made: list[Path] = []  # folders, outermost first
    stages: dict[Path, Path] = {}
    staged: list[tuple[Path, Path]] = []
    moved: list[Path] = []  # to names that were free
    target = Path()
    try:
        for target, content in contents.items():
            parent = target.parent
            if parent not in stages:
                for folder in [*reversed(parent.parents), parent]:
                    if not folder.exists():
                        folder.mkdir()
                        made.append(folder)
                stages[parent] = parent / f".shapeblend-{os.getpid()}"
                stages[parent].mkdir()
            temporary = stages[parent] / target.name
            staged.append((temporary, target))
            temporary.write_bytes(content.encode("utf-8") if isinstance(content, str) else content)
        for temporary, target in staged:
            is_new = not os.path.lexists(target)
            os.replace(temporary, target)
            if is_new:
                moved.append(target)
    except OSError as error:
        for path in moved:
            path.unlink(missing_ok=True)
        raise OutputError(str(target), f"cannot be written ({error.strerror or error})") from error
    finally:
        # After a success this takes away the emptied folders of our own alone.
        for temporary, _ in staged:
            temporary.unlink(missing_ok=True)
        for folder in [*stages.values(), *reversed(made)]:
            with suppress(OSError):
                folder.rmdir()
