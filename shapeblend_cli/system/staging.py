"""Stages: folders of our own in which files are written in full, and from which they are moved into place.

    HOME/.shapeblend-0123456789ab/stage       says what the folder is
    HOME/.shapeblend-0123456789ab/new/NAME    is to become HOME/NAME: a file, or a folder with all that is in it
    HOME/.shapeblend-0123456789ab/old/NAME    the file or folder before, until the run is done
    HOME/.shapeblend-0123456789ab/moved.json  the files that are being moved, if there are several

Who has a stage in a folder holds the system's lock on that folder for as long as the stage is there. The system takes
the lock from a process that ends, however it ends. So a stage that is found by who holds the lock was left by a run
that was killed, whatever the number of its process. The next run that writes into the folder takes it away. Folders
that only have such a name, or anything else in them, are their owners' own, and stay.
"""

from __future__ import annotations

import errno
import os
import re
import shutil
import time
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

if TYPE_CHECKING:
    from collections.abc import Iterator

PREFIX = ".shapeblend-"
STAGE_NAME = re.compile(re.escape(PREFIX) + "[0-9a-f]{12}")
MARK, NEW, OLD, MOVED = "stage", "new", "old", "moved.json"
MARK_TEXT = b"shapeblend keeps files here while it writes them. The next run that writes here removes it.\n"

PATIENCE = 30.0
"""Maximum wait for a lock, in seconds. A script that runs the command may hold it, as `flock FOLDER command` does."""


class CannotSwap(Exception):
    """A folder cannot be exchanged for another one as a whole."""


class Stage:
    """A stage in the folder `home`, of which its owner holds the lock."""

    def __init__(self, home: Path) -> None:
        self.home = home
        self.path = home / f"{PREFIX}{os.urandom(6).hex()}"
        self.path.mkdir(mode=0o700)
        (self.path / MARK).write_bytes(MARK_TEXT)
        self.new, self.old = self.path / NEW, self.path / OLD
        self.new.mkdir()
        self.old.mkdir()
        self.is_kept = False  # for a later run to put back
        self._moved: list[str] = []

    def move(self, force: bool) -> None:
        """Move everything into place. Each name takes one step, in which what was there goes.

        Without `force`, a file that is there raises FileExistsError. After any error, call `put_back`.
        """
        sync_folders(self.new)
        names = sorted(os.listdir(self.new))
        if len(names) > 1:
            import json  # most runs write a single file, or a folder as a whole

            stamps = {name: _stamp(self.new / name) for name in names if (self.new / name).is_file()}
            write_synced(self.path / MOVED, json.dumps(stamps).encode())
        for name in names:
            source, target = self.new / name, self.home / name
            if not os.path.lexists(target):
                _move_to_free_name(source, target)
            elif source.is_dir() and target.is_dir():
                self._swap(source, target)
            elif force:
                _link_or_copy(target, self.old / name)
                os.replace(source, target)
            else:
                raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), str(target))
            self._moved.append(name)
        sync_folder(self.home)

    def _swap(self, source: Path, target: Path) -> None:
        """Exchange a folder that is in place for the one that is staged."""
        try:
            exchange(source, target)
            return
        except OSError:
            old = self.old / target.name
        # Two steps. A run that is killed between them leaves nothing in place, and `clear` puts the old one back.
        try:
            os.rename(target, old)
        except OSError as error:
            raise CannotSwap from error
        try:
            os.rename(source, target)
        except OSError:
            os.rename(old, target)
            raise

    def _before(self, name: str) -> Path:
        """Return where that is now which had a name before this stage's file took it."""
        return self.old / name if os.path.lexists(self.old / name) else self.new / name

    def put_back(self) -> None:
        """Move what was moved out of place again, and back what was there before."""
        while self._moved:
            target, before = self.home / self._moved[-1], self._before(self._moved[-1])
            if not os.path.lexists(before):
                os.rename(target, before)
            elif target.is_dir():
                os.rename(target, self.path / target.name)
                os.rename(before, target)
            else:
                os.replace(before, target)
            self._moved.pop()

    def settle(self) -> None:
        """From now on, no later run puts anything back. What was meanwhile put into a folder moves into the new one."""
        if os.path.lexists(self.path / MOVED):
            os.unlink(self.path / MOVED)
        for name in self._moved:
            before, target = self._before(name), self.home / name
            if before.is_dir():
                for each in set(os.listdir(before)) - set(os.listdir(target)):
                    os.rename(before / each, target / each)

    def remove(self) -> None:
        """Take the stage away, unless it is kept."""
        if self.is_kept:
            return
        shutil.rmtree(self.path, ignore_errors=True)


@contextmanager
def locked(folder: Path) -> Iterator[bool]:
    """Hold the lock of a folder, for which this waits; give whether the folder is still the one that was locked.

    Where the system has no such locks, as on some network drives, and where the wait is too long, nothing is held.
    """
    try:
        handle = os.open(folder, os.O_RDONLY)
    except OSError:  # Windows opens no folders, and nobody those that may not be read
        yield True
        return
    try:
        _lock(handle)
        try:
            is_same = os.path.samestat(os.fstat(handle), os.stat(folder))
        except OSError:
            is_same = False
        yield is_same
    finally:
        os.close(handle)


def _lock(handle: int) -> bool:
    """Lock an open folder until it is closed, and return whether that was possible."""
    last = time.monotonic() + PATIENCE
    while fcntl is not None:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            if time.monotonic() > last:
                return False
            time.sleep(0.01)
        except OSError:
            return False
        else:
            return True
    return False


def clear(folder: Path) -> None:
    """Take away stages that killed runs have left in a folder, and put back what those were moving."""
    if fcntl is None or not _stages(folder):
        return
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            for stage in _stages(folder) if _lock(handle) else ():  # without the lock they may be in use
                _undo(stage)
                shutil.rmtree(stage, ignore_errors=True)
        finally:
            os.close(handle)


def _stages(folder: Path) -> list[Path]:
    """Return the stages in a folder that are our own and not those of another user."""
    with suppress(OSError), os.scandir(folder) as entries:
        return [
            Path(entry.path)
            for entry in entries
            if STAGE_NAME.fullmatch(entry.name)
            and entry.is_dir(follow_symlinks=False)
            and entry.stat(follow_symlinks=False).st_uid == os.geteuid()
            and _is_marked(Path(entry.path))
        ]
    return []


def _is_marked(path: Path) -> bool:
    """Return whether a folder is a stage: it says so, and has nothing in it that a stage has not."""
    try:
        is_ours = (path / MARK).read_bytes() == MARK_TEXT
        return is_ours and {MARK, NEW, OLD, MOVED}.issuperset(os.listdir(path))
    except OSError:
        return False


def _undo(stage: Path) -> None:
    """Put back what a killed run was moving, but nothing that has changed since."""
    import json

    home = stage.parent
    try:
        stamps = json.loads((stage / MOVED).read_bytes())
    except (OSError, ValueError):
        stamps = {}
    for name, stamp in stamps.items():
        target, old = home / name, stage / OLD / name
        if os.path.lexists(target) and _stamp(target) == stamp:
            os.replace(old, target) if os.path.lexists(old) else target.unlink()
    for name in os.listdir(stage / OLD) if (stage / OLD).is_dir() else ():
        if not os.path.lexists(home / name) and (stage / OLD / name).is_dir():
            os.rename(stage / OLD / name, home / name)


def _stamp(path: Path) -> list[int]:
    """Return what tells a file from another one that has its name, and from itself once it is edited."""
    found = path.lstat()
    return [found.st_ino, found.st_mtime_ns, found.st_size]


def _move_to_free_name(source: Path, target: Path) -> None:
    """Give a file or a folder a name that nothing has; FileExistsError if that is not so any more."""
    if not source.is_dir():
        try:
            os.link(source, target)  # which replaces nothing, whatever another program does meanwhile
        except FileExistsError:
            raise
        except OSError:  # no links on this drive
            os.rename(source, target)
        else:
            source.unlink()
    else:
        os.rename(source, target)


def _link_or_copy(source: Path, target: Path) -> None:
    try:
        os.link(source, target)
    except OSError:  # no links on this drive, or none of a file of somebody else's
        shutil.copy2(source, target)


def exchange(one: Path, other: Path) -> None:
    """Exchange the names of two files or folders in one step; OSError where the system cannot.

    Python has no function for it.
    """
    import ctypes

    function = getattr(ctypes.CDLL(None, use_errno=True), "renameat2", None)
    if function is None:
        raise OSError(errno.ENOSYS, os.strerror(errno.ENOSYS))
    here, rename_exchange = -100, 2  # AT_FDCWD, RENAME_EXCHANGE
    if function(here, os.fsencode(one), here, os.fsencode(other), rename_exchange):
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()), str(other))


def write_synced(path: Path, data: bytes) -> None:
    """Write a new file, and have it on the disk."""
    with open(path, "xb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())


def sync_folders(folder: Path) -> None:
    """Have the names in a folder on the disk, and those in folders inside."""
    for path, _, _ in os.walk(folder):
        sync_folder(Path(path))


def sync_folder(folder: Path) -> None:
    """Have the names in a folder on the disk, where the system can."""
    try:
        handle = os.open(folder, os.O_RDONLY)
    except OSError:
        return
    try:
        os.fsync(handle)
    except OSError as error:
        if error.errno not in (errno.EINVAL, errno.EBADF, errno.ENOTSUP):
            raise
    finally:
        os.close(handle)
