"""Stages: folders of our own in which files are written in full, and from which they are moved into place.

    HOME/.shapeblend-KEY/names       the names of the files that the stage is for
    HOME/.shapeblend-KEY/new/NAME    is to become HOME/NAME: a file, or a folder with all that is in it
    HOME/.shapeblend-KEY/old/NAME    the file or folder before, if it is replaced, until the run is done
    HOME/.shapeblend-KEY/moved.json  the files that are being moved, if there are several

A process holds the system's lock on its stage. The system takes the lock from a process that ends, however it ends. So
a stage without a lock was left by a run that was killed, whatever the number of its process. The next run that writes
into the same folder takes it away, unless it has anything in it that is not on its list.
"""

from __future__ import annotations

import errno
import os
import time
from binascii import crc32
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

PREFIX = ".shapeblend-"
NEW, OLD, NAMES, MOVED = "new", "old", "names", "moved.json"

PATIENCE = 30.0
"""Maximum wait for a lock, in seconds. A script that runs the command may hold it, as `flock FOLDER command` does."""


class CannotSwap(Exception):
    """A folder cannot be exchanged for another one as a whole."""


class Stage:
    """A stage in the folder `home`, for files with names relative to that folder."""

    def __init__(self, home: Path, names: Iterable[str]) -> None:
        self.home = home
        self.names = frozenset(names)
        self.path = home / _name(os.urandom(6).hex())
        self.new, self.old = self.path / NEW, self.path / OLD
        self.is_kept = False  # for a later run to put back
        self._is_removed = False
        self._handle: int | None = None
        self._moved: list[str] = []

    def make(self) -> None:
        """Make the folders of the stage; after any error, call `remove`."""
        self.path.mkdir(mode=0o700)
        with suppress(OSError):  # Windows opens no folders
            self._handle = os.open(self.path, os.O_RDONLY)
            _lock(self._handle, 0.0)
        # Not synced: it is for those who come after a kill, and after a power failure a stage may stay.
        (self.path / NAMES).write_bytes(b"\0".join(map(os.fsencode, sorted(self.names))))
        self.new.mkdir()

    def move(self, force: bool) -> None:
        """Move everything into place. Each name takes one step, in which what was there goes.

        Without `force`, a file that is there raises FileExistsError. After any error, call `put_back`.
        """
        for folder in self.new.iterdir():
            if folder.is_dir():
                sync_folders(folder)
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
                self.old.mkdir(exist_ok=True)
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
            self.old.mkdir(exist_ok=True)
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
            name = self._moved[-1]
            target, before = self.home / name, self._before(name)
            if not os.path.lexists(before):
                os.rename(target, before)
            elif not target.is_dir():
                os.replace(before, target)
            elif before.parent == self.new:
                exchange(before, target)
            else:
                os.rename(target, self.new / name)
                os.rename(before, target)
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
        """Take the stage away, unless it is kept; once is enough."""
        if not (self.is_kept or self._is_removed):
            _remove(self.path, self.names)
            self._is_removed = True
        if self._handle is not None:
            os.close(self._handle)
            self._handle = None


@contextmanager
def locked(folder: Path) -> Iterator[bool | None]:
    """Hold the lock of a folder, for which this waits; give whether it is held, or None if the folder was replaced.

    Where the system has no such locks, as on some network drives, and where the wait is too long, nothing is held.
    """
    try:
        handle = os.open(folder, os.O_RDONLY)
    except OSError:  # Windows opens no folders, and nobody those that may not be read
        yield False
        return
    try:
        is_held = _lock(handle, PATIENCE)
        try:
            is_same = os.path.samestat(os.fstat(handle), os.stat(folder))
        except OSError:
            is_same = False
        yield is_held if is_same else None
    finally:
        os.close(handle)


def _lock(handle: int, seconds: float) -> bool:
    """Lock an open folder until it is closed, and return whether that was possible within this time."""
    last = time.monotonic() + seconds
    while fcntl is not None:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            if time.monotonic() >= last:
                return False
            time.sleep(0.01)
        except OSError:
            return False
        else:
            return True
    return False


def clear(home: Path) -> None:
    """Take away stages that killed runs have left in a folder, and put back what those were moving.

    The caller holds the lock of the folder. A stage with anything in it that is not on its list stays as it is.
    """
    for stage in _stages(home):
        with suppress(OSError):
            handle = os.open(stage, os.O_RDONLY | os.O_NOFOLLOW)
            try:
                if not _lock(handle, 0.0):
                    continue  # its maker lives
                names = _names(stage)
                own = _own(names)
                if all(own.get(inside) is is_folder for inside, is_folder in _all_in(stage)):
                    _undo(stage)
                    _remove(stage, names)
            finally:
                os.close(handle)


def _name(key: str) -> str:
    """Return the name of a stage, with a checksum, so that no other folder has such a name by chance."""
    return f"{PREFIX}{key}{crc32(key.encode()):08x}"


def _stages(folder: Path) -> list[str]:
    """Return the stages in a folder that are our own and not those of another user."""
    if fcntl is None:  # nobody knows whether their makers live
        return []
    with suppress(OSError, ValueError), os.scandir(folder) as entries:
        return [
            entry.path
            for entry in entries
            if entry.name.startswith(PREFIX)
            and entry.name == _name(entry.name[len(PREFIX) : -8])
            and entry.is_dir(follow_symlinks=False)
            and entry.stat(follow_symlinks=False).st_uid == os.geteuid()
        ]
    return []


def _names(stage: str) -> frozenset[str]:
    """Return the names that a stage is for; none if its maker was killed before they were written."""
    with suppress(FileNotFoundError), open(os.path.join(stage, NAMES), "rb") as file:
        return frozenset(map(os.fsdecode, file.read().split(b"\0")))
    return frozenset()


def _own(names: Iterable[str]) -> dict[str, bool]:
    """Return all paths that a stage for some names may have in it, and whether each is a folder."""
    own = {NAMES: False, MOVED: False, NEW: True, OLD: True}
    for name in names:
        for part in (NEW, OLD):
            path = os.path.join(part, name)
            own[path] = False
            while (path := os.path.dirname(path)) not in own:
                own[path] = True
    return own


def _all_in(folder: str, inside: str = "") -> Iterator[tuple[str, bool]]:
    """Yield all paths in a folder, innermost first, and whether each is a folder.

    The list of a stage comes after the files on it, so that a run that is killed on the way leaves a stage.
    """
    for name in sorted(os.listdir(os.path.join(folder, inside)), reverse=True):
        path = os.path.join(inside, name)
        full = os.path.join(folder, path)
        is_folder = os.path.isdir(full) and not os.path.islink(full)
        if is_folder:
            yield from _all_in(folder, path)
        yield path, is_folder


def _remove(stage: str | Path, names: Iterable[str]) -> None:
    """Take a stage away, except for files that are not on its list."""
    own = _own(names)
    with suppress(OSError):
        for inside, is_folder in _all_in(str(stage)):
            if own.get(inside) is is_folder:
                with suppress(OSError):
                    (os.rmdir if is_folder else os.unlink)(os.path.join(stage, inside))
        os.rmdir(stage)


def _undo(stage: str) -> None:
    """Put back what a killed run was moving, but nothing that has changed since."""
    stamps: dict[str, list[int]] = {}
    with suppress(OSError, ValueError, TypeError), open(os.path.join(stage, MOVED), "rb") as file:
        import json

        stamps = dict(json.load(file))
    home, olds = os.path.dirname(stage), os.path.join(stage, OLD)
    for name in os.listdir(olds) if os.path.isdir(olds) else ():
        old, target = os.path.join(olds, name), os.path.join(home, name)
        if os.path.isdir(old):
            if not os.path.lexists(target):
                os.rename(old, target)
        elif os.path.lexists(target) and _stamp(target) == stamps.get(name):
            os.replace(old, target)


def _stamp(path: str | Path) -> list[int]:
    """Return what tells a file from another one that has its name, and from itself once it is edited."""
    found = os.lstat(path)
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
        import shutil  # hardly ever

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
