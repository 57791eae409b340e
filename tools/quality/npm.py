"""What npm installs from a lock file of ours, into `out/`."""

from __future__ import annotations

import fcntl
import functools
import shutil
import subprocess
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path


@functools.cache
def install(source: Path, target: Path, *others: str) -> str | None:
    """Install what a folder's package.json asks for, or say why that cannot be.

    Parameters
    ----------
    source, target : Path
        Where package.json and package-lock.json are, and where things go.
    *others : str
        Files that belong beside it.
    """
    if not (shutil.which("node") and shutil.which("npm")):
        return "node and npm are not there"
    target.mkdir(parents=True, exist_ok=True)
    with open(target / ".lock", "w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)  # of several processes one installs, and the others wait
        return _install(source, target, others)


def _install(source: Path, target: Path, others: Sequence[str]) -> str | None:
    known = target / "node_modules" / ".package-lock.json"
    lock = target / "package-lock.json"
    there = known.exists() and lock.read_bytes() == (source / lock.name).read_bytes()
    for name in ("package.json", lock.name, *others):
        shutil.copyfile(source / name, target / name)
    if there:
        return None
    command = [
        "npm",
        "ci",
        "--loglevel=error",
        "--no-audit",
        "--no-fund",
        "--ignore-scripts",
        "--fetch-retries=1",
    ]
    done = subprocess.run(command, cwd=target, stdout=subprocess.DEVNULL, check=False)
    return "npm could not install it" if done.returncode else None
