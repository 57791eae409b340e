"""Claims of batches on the outputs that they are about to write, so that no two of them write the same ones at a time.

A claim is a file in each folder of records, `out/.shapeblend/x7k2.claim`, which says what outputs of that folder the
batch may write. It is one file, linked into all of them, and the batch holds the system's lock on it. The system takes
the lock from a process that ends, however it ends. So a claim without a lock was left by a batch that was killed.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, NamedTuple

from shapeblend_cli.batch.records import FOLDER
from shapeblend_cli.errors import OutputError
from shapeblend_cli.system.staging import locked

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

SUFFIX = ".claim"

OFTEN = 0.2
"""Time between two attempts to claim what another batch has claimed, in seconds."""


@contextmanager
def claimed(places: Iterable[Path], wait: bool, note: Callable[[str], None]) -> Iterator[None]:
    """Claim outputs until the block is done.

    Raises
    ------
    OutputError
        If another batch has claimed one of them, and this one is not to `wait` for its end.
    """
    claim = _Claim(places)
    is_waiting = False
    try:
        while fcntl is not None and (other := claim.stake()):
            if not wait:
                raise OutputError(other.place, f"{other.problem}; --wait would wait until that has ended")
            if not is_waiting:
                note(f"{other.place}: {other.problem}; waiting until that has ended")
            is_waiting = True
            time.sleep(OFTEN)
        yield
    finally:
        claim.give_up()


class _Other(NamedTuple):
    """An output that another batch has claimed."""

    place: str
    owner: str

    @property
    def problem(self) -> str:
        return f"another batch is writing this, {self.owner}"


class _Claim:
    """The claim of a batch."""

    def __init__(self, places: Iterable[Path]) -> None:
        self._name = f"{os.urandom(6).hex()}{SUFFIX}"
        self._homes: dict[Path, set[str]] = {}
        for place in places:
            self._homes.setdefault(place.parent, set()).add(place.name)
        self._files: list[IO[bytes]] = []  # one, unless outputs are on several drives
        self._links: list[Path] = []
        self._made: list[Path] = []  # folders
        self._read: dict[tuple[int, int, int], list[bytes]] = {}  # claims of others, by what tells them apart

    def stake(self) -> _Other | None:
        """Make the claim, or return the claims in its way."""
        # All batches take folders in one order, so that of two that meet one goes on.
        for home in sorted(self._homes, key=os.path.realpath):
            with suppress(OSError):  # where none can be made, jobs fail, too
                other = self._stake_in(home)
                if other is not None:
                    self.give_up()
                    return other
        return None

    def _stake_in(self, home: Path) -> _Other | None:
        folder = home / FOLDER
        self._made += [path for path in (folder, *folder.parents) if not path.exists()]
        folder.mkdir(parents=True, exist_ok=True)
        with locked(folder):
            number = folder.stat().st_ino
            names = {b"%d %s" % (number, os.fsencode(name)): name for name in self._homes[home]}
            for owner, taken in self._others(folder):
                if common := names.keys() & taken:
                    return _Other(str(home / names[min(common)]), os.fsdecode(owner))
            self._link(folder / self._name)
            self._files[-1].write(b"".join(b"%s\0" % name for name in names))
        return None

    def _link(self, path: Path) -> None:
        """Have the claim in a folder, too; it has to be another file where that is on another drive."""
        try:
            os.link(self._links[-1], path)
        except (IndexError, OSError):
            file = open(path, "xb", buffering=0)
            self._files.append(file)
            with suppress(OSError):  # no locks on this drive
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            file.write(f"process {os.getpid()} on {os.uname().nodename}\0".encode())
        self._links.append(path)

    def _others(self, folder: Path) -> Iterator[tuple[bytes, list[bytes]]]:
        """Yield the owners of other claims in a folder, with what they have claimed; take away those without one."""
        for name in os.listdir(folder):
            if not name.endswith(SUFFIX):
                continue
            with suppress(OSError), open(folder / name, "rb") as file:
                try:
                    fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
                except BlockingIOError:
                    found = os.fstat(file.fileno())
                    key = found.st_dev, found.st_ino, found.st_size
                    if key not in self._read:
                        self._read[key] = file.read().split(b"\0")
                    owner, *taken = self._read[key]
                    yield owner, taken
                else:
                    os.unlink(folder / name)

    def give_up(self) -> None:
        """Take the claim away, and the folders that were made for it and have nothing else in them."""
        for link in self._links:
            link.unlink(missing_ok=True)
        for folder in sorted(self._made, key=lambda folder: -len(folder.parts)):
            with suppress(OSError):
                folder.rmdir()
        for file in self._files:
            file.close()
        self._links, self._made, self._files = [], [], []
