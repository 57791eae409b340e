"""Writing files so that they appear only when all of them are complete, and nothing is lost if that fails.

A target is a file with its content, or a folder with the contents of files in it. Everything is first written in
stages (see `staging`) beside the targets. A folder that is there is replaced as a whole by a new one that has its other
files too; where that cannot be, its files are moved one by one.
"""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from os.path import join
from pathlib import Path
from typing import IO, Any, NamedTuple

from shapeblend_cli.errors import OutputError
from shapeblend_cli.system.interrupts import has_written, uninterrupted
from shapeblend_cli.system.staging import CannotSwap, Stage, clear, locked, write_synced

Content = str | bytes
Contents = Mapping[Path, Content | Mapping[str, Content]]

THREADS = 16
"""Maximum number of files that are written at a time."""

NOTHING_CHANGED = "nothing was changed"
STREAMS = ("/dev/stdout", "/dev/stderr", "/dev/fd/", "/proc/")


def check_targets(targets: Iterable[Path], inputs: Iterable[Path], force: bool) -> None:
    """Refuse targets that must not be written, before any work is done.

    OutputError is raised for a target that is an input or a folder, that exists without `force`, or whose folder cannot
    be made.
    """
    sources = list(map(real_path, inputs))
    for target in targets:
        with _refusing(target):
            real = real_path(target)
            if real in sources:
                raise OutputError(str(target), "is an input and is never replaced; another name would work")
            if target.is_dir():
                raise OutputError(str(target), "is a folder; the name of a file would work")
            if is_stream(target):
                continue
            if not force and os.path.lexists(target):
                raise _exists(target)
            parents = Path(os.path.realpath(target)).parents
            home = next(parent for parent in parents if os.path.lexists(parent))
            if not home.is_dir():
                raise OutputError(_as_typed(home, target), "is a file, and a folder of that name is needed")
            if not os.access(home, os.W_OK):
                raise OutputError(_as_typed(home, target), "is a folder that cannot be written to")


def write_files(contents: Contents, force: bool) -> None:
    """Write all files or none, texts as UTF-8, and then to devices and pipes.

    What is there is replaced with `force`; it keeps its mode and, where that is allowed, its owner. A symbolic link
    stays, and the file it names is replaced. OutputError is raised if the disk is full, a folder is read-only, and the
    like; it says what stands then.
    """
    files = {target: content for target, content in contents.items() if content and not is_stream(target)}
    if files:
        try:
            _write_all(files, force, swap=True)
        except CannotSwap:
            _write_all(files, force, swap=False)
    for target, content in contents.items():
        if target in files or not content or isinstance(content, Mapping):
            continue
        try:
            with _open_stream(target) as stream:
                stream.write(_encoded(content))
        except BrokenPipeError:
            raise  # as of standard output
        except OSError as error:
            stands = "; the other files were written" if files else ""
            raise OutputError(str(target), f"cannot be written ({_reason(error)}){stands}") from error


def is_inside(path: Path, folder: str) -> bool:
    """Return whether a path lies in a folder or deeper, wherever symbolic links lead."""
    return Path(real_path(path)).is_relative_to(real_path(Path(folder)))


class _File(NamedTuple):
    target: Path  # as the user has it
    home: Path  # the folder that gets the stage
    inside: Path  # its path from there, or in the stage
    data: bytes
    replaces: Path | None  # the file that is there


class _Plan(NamedTuple):
    files: list[_File]
    folders: list[Path]  # those that are made or replaced as a whole

    @property
    def homes(self) -> dict[Path, Path]:
        """The folders that get stages, in order, and a target in each."""
        return dict(sorted((file.home, file.target) for file in self.files))


def _plan(contents: Contents, swap: bool) -> _Plan:
    """Say where files are staged, as things are now."""
    named: list[tuple[Path, Content]] = []
    folders: list[Path] = []
    for target, content in contents.items():
        if not isinstance(content, Mapping):
            named.append((target, content))
            continue
        named += [(target / name, text) for name, text in content.items()]
        folder = Path(os.path.realpath(target))
        if not os.path.lexists(folder) or (swap and _can_be_replaced(folder, content)):
            folders.append(folder)
    return _Plan([_file(target, content, folders) for target, content in named], folders)


def _file(target: Path, content: Content, folders: Iterable[Path]) -> _File:
    real = Path(os.path.realpath(target))
    home = next((folder for folder in folders if real.is_relative_to(folder)), real).parent
    replaces = real if os.path.lexists(real) else None
    return _File(target, home, real.relative_to(home), _encoded(content), replaces)


def real_path(path: Path) -> str:
    """Return a path without symbolic links, where the working folder is known and the name can be one."""
    try:
        return os.path.realpath(path)
    except (OSError, ValueError):
        return str(path)


def _can_be_replaced(folder: Path, names: Iterable[str]) -> bool:
    """Return whether a folder can be replaced as a whole by another with all its files.

    That of a process, such as a shell, would not be where it was; what a drive is mounted on cannot be moved; and to
    folders inside there are no second links.
    """
    if not folder.is_dir() or os.path.ismount(folder) or not os.access(folder.parent, os.W_OK):
        return False
    with suppress(OSError):
        if Path(os.getcwd()).is_relative_to(folder):
            return False
    with os.scandir(folder) as entries:
        return all(
            entry.is_file(follow_symlinks=False) or (entry.is_symlink() and entry.name not in names)
            for entry in entries
        )


def _write_all(contents: Contents, force: bool, swap: bool) -> None:
    """Write all files or none; `CannotSwap` is raised where a folder turns out not to be movable."""
    current = str(next(iter(contents)))
    try:
        with _locked_plan(contents, swap) as plan, ExitStack() as ends:
            others = {folder: _others(folder, plan.files) for folder in plan.folders}
            stages: dict[Path, Stage] = {}
            for home, target in plan.homes.items():
                current = _as_typed(home, target)
                names = [str(file.inside) for file in plan.files if file.home == home]
                names += [join(f.name, name) for f in others if f.parent == home for name in others[f]]
                with uninterrupted():
                    stages[home] = Stage(home, names)
                    ends.callback(stages[home].remove)
                    stages[home].make()
            for folder in plan.folders:
                _link_others(folder, stages[folder.parent].new / folder.name, others[folder])
            staged = [stages[file.home].new / file.inside for file in plan.files]
            for file, path in zip(plan.files, staged, strict=True):
                current = str(file.target)
                if file.replaces and not force:
                    raise _exists(file.target)
                path.parent.mkdir(parents=True, exist_ok=True)
            with several(_stage, plan.files, staged) as each:
                for file in plan.files:
                    current = str(file.target)
                    next(each)
            ends.enter_context(uninterrupted())
            _move_all(stages.values(), force)
            has_written()
    except OSError as error:
        if isinstance(error, OutputError):
            raise
        if isinstance(error, FileExistsError) and not force:
            there = (file.target for file in plan.files if os.path.lexists(file.target))
            raise _exists(next(there, Path(current))) from error
        raise _failed(current, "written", error) from error


def _stage(file: _File, path: Path) -> None:
    write_synced(path, file.data)
    if file.replaces:
        _take_after(path, file.replaces)


@contextmanager
def several(act: Callable[..., None], *values: Sequence[Any]) -> Iterator[Iterator[None]]:
    """Give an iterator that acts on values in turn. Several wait for the disk at a time, which takes as long as one."""
    if len(values[0]) < 2:
        yield map(act, *values)
        return
    from concurrent.futures import ThreadPoolExecutor

    pool = ThreadPoolExecutor(THREADS)
    try:
        with uninterrupted():  # a thread that the pool has started and not yet noted would not be waited for
            done = pool.map(act, *values)
        yield done
    finally:
        pool.shutdown(cancel_futures=True)


@contextmanager
def _locked_plan(contents: Contents, swap: bool) -> Iterator[_Plan]:
    """Hold the locks of all folders that a plan is about, which are made if they are missing, and give the plan.

    First, what killed runs have left in the folders that get stages is cleared up. That, and other runs that this one
    waited for, may change where files are staged; then the plan is made anew.
    """
    with ExitStack() as ends:
        while True:
            plan = _plan(contents, swap)
            for home, target in plan.homes.items():
                _make(home, target, ends)
            with ExitStack() as locks:
                # All runs take them in one order, so that no two wait for each other.
                held = {f: locks.enter_context(locked(f)) for f in sorted({*plan.homes, *plan.folders})}
                if None in held.values():
                    continue
                for home in plan.homes:
                    if held[home]:
                        clear(home)
                if _plan(contents, swap) == plan:
                    yield plan
                    return


def _make(folder: Path, target: Path, ends: ExitStack) -> None:
    """Make a folder and those that it is in; in the end they go again, unless there is anything in them."""
    if os.path.lexists(folder):
        return
    for each in (*reversed(folder.parents), folder):
        if not os.path.lexists(each):
            try:
                with uninterrupted():
                    os.mkdir(each)
                    ends.callback(_remove_if_empty, each)
            except FileExistsError:
                pass  # another run was faster
            except OSError as error:
                raise _failed(_as_typed(each, target), "made", error) from error


def _remove_if_empty(folder: Path) -> None:
    with suppress(OSError):
        os.rmdir(folder)


def _others(folder: Path, files: Iterable[_File]) -> list[str]:
    """Return the names in a folder that are not replaced; none if there is no such folder yet."""
    replaced = {file.replaces for file in files}
    return [name for name in os.listdir(folder) if folder / name not in replaced] if folder.is_dir() else []


def _link_others(folder: Path, copy: Path, names: Iterable[str]) -> None:
    """Make a folder like another one, if there is one, with links to some of its files."""
    copy.mkdir()
    for name in names:
        try:
            os.link(folder / name, copy / name, follow_symlinks=False)
        except OSError as error:  # no links on this drive, or none of a file of somebody else's
            raise CannotSwap from error
    if folder.is_dir():
        _take_after(copy, folder)


def _move_all(stages: Iterable[Stage], force: bool) -> None:
    """Move all that is staged into place, or put back what was there."""
    begun: list[Stage] = []
    try:
        for stage in stages:
            begun.append(stage)
            stage.move(force)
        for stage in begun:
            stage.settle()
    except (OSError, CannotSwap):
        for stage in reversed(begun):
            try:
                stage.put_back()
            except OSError as error:
                stage.is_kept = True
                raise OutputError(
                    str(stage.home),
                    f"not all files could be replaced, nor the old ones put back ({_reason(error)}); the next run "
                    f"that writes there tries again, and until then they are in {stage.path}",
                ) from error
        raise
    for stage in begun:
        stage.remove()


def _take_after(path: Path, other: Path) -> None:
    """Give a file or folder the mode of another one, and if that is allowed its owner and group."""
    found = os.stat(other)
    if hasattr(os, "chown"):
        for owner in ((found.st_uid, -1), (-1, found.st_gid)):
            with suppress(OSError):
                os.chown(path, *owner)
    os.chmod(path, stat.S_IMODE(found.st_mode))


def is_stream(target: Path) -> bool:
    """Return whether a target is opened and written to where it is, being no file or an open one."""
    if str(target).startswith(STREAMS):
        return True
    try:
        mode = os.stat(target).st_mode
    except (OSError, ValueError):
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def _open_stream(target: Path) -> IO[bytes]:
    """Open a device or the like; a stream that this process has already is written to where it stands."""
    number = re.fullmatch(r"/(?:dev|proc/self)/fd/(\d{1,9})", str(target))
    handle = int(number[1]) if number else {"/dev/stdout": 1, "/dev/stderr": 2}.get(str(target))
    return open(target if handle is None else os.dup(handle), "wb")


@contextmanager
def _refusing(target: Path) -> Iterator[None]:
    """Say of a target what the system says of its name."""
    try:
        yield
    except OutputError:
        raise
    except (OSError, ValueError) as error:
        if isinstance(error, OSError) and error.filename is None:
            raise  # it is about the current folder
        raise OutputError(str(target), f"cannot be written ({_reason(error)})") from error


def _exists(target: Path) -> OutputError:
    return OutputError(str(target), "exists; --force replaces it")


def _failed(path: str, what: str, error: OSError) -> OutputError:
    return OutputError(path, f"cannot be {what} ({_reason(error)}); {NOTHING_CHANGED}")


def _reason(error: OSError | ValueError) -> str:
    return getattr(error, "strerror", None) or str(error)


def _encoded(content: Content) -> bytes:
    """Return bytes; names of files that are not UTF-8 cannot be kept in a text that is."""
    return content.encode("utf-8", "replace") if isinstance(content, str) else content


def _as_typed(folder: Path, target: Path) -> str:
    """Return a folder on the way to a target as the target has it, unless it leaves the current folder out."""
    typed = (each for each in target.parents if each != Path())
    return next((str(each) for each in typed if Path(os.path.realpath(each)) == folder), str(folder))
