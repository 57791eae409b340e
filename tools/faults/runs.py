"""Runs over targets that are there, and what may be there afterwards.

Most runs are forks of this process, which has everything loaded already: two hundred of them take a minute.
"""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable
from contextlib import chdir
from functools import cache
from pathlib import Path
from typing import NamedTuple

from shapeblend_cli import cli
from shapeblend_cli.system.staging import Stage
from tools.faults.aimed import strike_at

ROOT = Path(__file__).parents[2]
A = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24"><path fill="#c00" d="M4 4H20V20H4Z"/></svg>'
B = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24"><path fill="#00c" d="M12 3L21 20H3Z"/></svg>'
COMMAND = [sys.executable, "-m", "shapeblend_cli"]
FEW = ["--vertices", "12"]
PREFIX = ".shapeblend-"

TARGETS = {
    "folder": ["-o", "out"],
    "shorter folder": ["-o", "out", "-n", "3"],
    "new folder": ["-o", "deep/out"],
    "animation": ["-o", "out.svg"],
    "GIF": ["-o", "out.gif", "-n", "2", "--width", "24"],
    "report": ["-n", "0", "--report", "out.json"],
}
"""Further arguments of a run, by what it writes."""

SIGNALS = ("SIGKILL", "SIGTERM", "SIGINT")


class Fault(AssertionError):
    """A promise that was not kept."""


class Expected(NamedTuple):
    """What stands in a folder before and after a run, by name."""

    arguments: list[str]
    old: dict[str, object]
    new: dict[str, object]
    changes: int  # moments that can be aimed at
    seconds: float


def environment() -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(ROOT)}


def warm_up(arguments: list[str], where: Path) -> None:
    """Run in this process, so that forks of it find all modules loaded."""
    with chdir(where):
        if cli.run(arguments):
            raise Fault(f"{arguments}")


class Fork:
    """A run of the command in a fork of this process."""

    def __init__(
        self, arguments: list[str], where: Path, before: Callable[[], object] = lambda: None
    ) -> None:
        self.arguments = arguments
        handle, name = tempfile.mkstemp()
        os.close(handle)
        self._said = Path(name)
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])  # until the fork can answer it
        self.number = os.fork()
        if self.number:
            signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
        else:
            status = 99
            try:
                os.chdir(where)
                os.dup2(os.open(self._said, os.O_WRONLY), 2)
                sys.stderr = open(2, "w", closefd=False)
                signal.signal(signal.SIGINT, signal.default_int_handler)
                before()
                signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
                status = cli.run_safely(arguments)
            finally:
                os._exit(status)

    def wait(self) -> subprocess.CompletedProcess[bytes]:
        _, status = os.waitpid(self.number, 0)
        said = self._said.read_bytes()
        self._said.unlink()
        return subprocess.CompletedProcess(self.arguments, os.waitstatus_to_exitcode(status), b"", said)


def run(arguments: list[str], where: Path) -> subprocess.CompletedProcess[bytes]:
    return Fork(arguments, where).wait()


def state(where: Path) -> dict[str, object]:
    """Return what is in a folder, by name; of a report, without the seconds."""
    found: dict[str, object] = {}
    for path in sorted(where.rglob("*")):
        name = path.relative_to(where).as_posix()
        if name.startswith(PREFIX) or f"/{PREFIX}" in name or path.is_dir():
            continue
        data = path.read_bytes()
        found[name] = without_seconds(json.loads(data)) if name.endswith(".json") else data
    return found


def without_seconds(value: object) -> object:
    if isinstance(value, dict):
        return {key: without_seconds(each) for key, each in value.items() if key != "seconds"}
    return [without_seconds(each) for each in value] if isinstance(value, list) else value


def litter(where: Path) -> list[str]:
    return [str(path) for path in where.rglob(f"{PREFIX}*")]


def left_over(where: Path) -> list[str]:
    """The files in stages, apart from what marks these.

    A run that was killed when its new folder was in place leaves an empty stage beside that. Later runs write into the
    folder, and do not look beside it.
    """
    stages = where.rglob(f"{PREFIX}*")
    return [
        str(path) for stage in stages for path in stage.rglob("*") if path.is_file() and path.name != "stage"
    ]


def begin(where: Path) -> Path:
    """Make a folder with two drawings and a file of somebody else's where the frames go."""
    shutil.rmtree(where, ignore_errors=True)
    where.mkdir(parents=True)
    (where / "a.svg").write_text(A)
    (where / "b.svg").write_text(B)
    return where


def prepare(name: str, where: Path) -> Expected:
    """Make a folder in which a target is there already, and return what a run may make of it."""
    begin(where)
    arguments = [*FEW, *TARGETS[name]]
    first = ["b.svg", "a.svg", *arguments, "-f", "-n", "0" if name == "report" else "5"]
    warm_up(first, where)
    if name == "new folder":
        begin(where)
    elif "folder" in name:
        (where / "out" / "mine.txt").write_text("mine")
    old = state(where)
    before = where.with_name(where.name + ".before")
    shutil.rmtree(before, ignore_errors=True)
    shutil.copytree(where, before)
    arguments = ["a.svg", "b.svg", *arguments, "-f"]
    began = time.perf_counter()
    done(run(arguments, where))
    seconds = time.perf_counter() - began
    new = state(where)
    if old == new:
        raise Fault(f"{name}: old and new are the same")
    restore(where)
    counted = subprocess.run(
        [sys.executable, "-m", "tools.faults.aimed", "0", "count", *arguments],
        cwd=where,
        env=environment(),
        capture_output=True,
        check=True,
    )
    restore(where)
    return Expected(arguments, old, new, counted.stdout.count(b"."), seconds)


def restore(where: Path) -> None:
    shutil.rmtree(where)
    shutil.copytree(where.with_name(where.name + ".before"), where)


def done(process: subprocess.CompletedProcess[bytes]) -> None:
    if process.returncode:
        raise Fault(f"{process.args}: {process.stderr.decode()}")


def aimed(moment: int, what: str, arguments: list[str], where: Path) -> subprocess.CompletedProcess[bytes]:
    return Fork(arguments, where, lambda: strike_at(moment, what)).wait()


def killed(
    seconds: float, what: str, arguments: list[str], where: Path
) -> subprocess.CompletedProcess[bytes]:
    """Run, and send a signal after so many seconds."""
    fork = Fork(arguments, where)
    time.sleep(seconds)
    os.kill(fork.number, getattr(signal, what))
    return fork.wait()


def killed_early(
    seconds: float, what: str, arguments: list[str], where: Path
) -> subprocess.CompletedProcess[bytes]:
    """Do that to a process of its own, which loads everything first."""
    command = [*COMMAND, *arguments]
    with subprocess.Popen(
        command, cwd=where, env=environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        time.sleep(seconds)
        process.send_signal(getattr(signal, what))
        out, err = process.communicate()
    return subprocess.CompletedProcess(command, process.returncode, out, err)


def check_killed(
    process: subprocess.CompletedProcess[bytes], expected: Expected, where: Path, what: str
) -> None:
    """Check what stands after a run was sent a signal, what it said, and the run after it."""
    found = state(where)
    said = process.stderr.decode()
    if found not in (expected.old, expected.new):
        raise Fault(f"neither old nor new: {sorted(found)} after {said!r}")
    if "Traceback" in said or said.count("\n") > 2:
        raise Fault(f"said {said!r}")
    if "nothing was written" in said and found != expected.old:
        raise Fault(f"said {said!r}, and it is new")
    if "all files were written" in said and found != expected.new:
        raise Fault(f"said {said!r}, and it is old")
    if process.returncode == 0 and found != expected.new:
        raise Fault("status 0, and it is old")
    if what != "SIGKILL" and litter(where):
        raise Fault(f"left {litter(where)}")
    again(expected, where)


def again(expected: Expected, where: Path) -> None:
    """Run once more, which has to work, and to leave no litter."""
    done(run(expected.arguments, where))
    if state(where) != expected.new or left_over(where):
        raise Fault(f"after the next run: {sorted(state(where))}, {left_over(where)}")


def kill_at_random(expected: Expected, what: str, count: int, where: Path, rng: random.Random) -> None:
    for _ in range(count):
        restore(where)
        process = killed(rng.uniform(0.0, 1.1 * expected.seconds), what, expected.arguments, where)
        check_killed(process, expected, where, what)


def kill_early(
    expected: Expected, what: str, count: int, where: Path, rng: random.Random, after: float
) -> None:
    """Kill processes as they start, after so many seconds at least."""
    for _ in range(count):
        restore(where)
        process = killed_early(rng.uniform(after, 0.4), what, expected.arguments, where)
        check_killed(process, expected, where, what)


def kill_at_moves(expected: Expected, what: str, moments: Iterable[int], where: Path) -> None:
    for moment in moments:
        restore(where)
        process = aimed(moment, what, expected.arguments, where)
        check_killed(process, expected, where, what)


def fail_at_moves(expected: Expected, error: str, moments: Iterable[int], where: Path) -> None:
    """Let changes meet an error, one in each run."""
    for moment in moments:
        restore(where)
        process = aimed(moment, error, expected.arguments, where)
        found, said = state(where), process.stderr.decode()
        if found != (expected.old if process.returncode else expected.new):
            raise Fault(f"status {process.returncode}, {sorted(found)}, said {said!r}")
        if process.returncode and "nothing was changed" not in said:
            raise Fault(f"said {said!r}")
        again(expected, where)


@cache
def alone(name: str, pair: tuple[str, str], where: Path) -> dict[str, object]:
    """Return what stands after a run of its own."""
    begin(where)
    done(run([*pair, *FEW, *TARGETS[name]], where))
    return state(where)


def two_at_once(name: str, force: bool, where: Path) -> None:
    """Start two runs on one target; one wins whole, and without force the other one says so."""
    begin(where)
    options = [*FEW, *TARGETS[name], *(["-f"] if force else [])]
    pairs = (["a.svg", "b.svg"], ["b.svg", "a.svg"])
    forks = [Fork([*pair, *options], where) for pair in pairs]
    ended = [fork.wait() for fork in forks]
    statuses = [process.returncode for process in ended]
    said = [process.stderr for process in ended]
    found = state(where)
    whole = [alone(name, tuple(pair), where.with_name(where.name + ".alone")) for pair in pairs]
    if litter(where) or found not in whole:
        raise Fault(f"{sorted(found)}, {litter(where)}")
    if force and statuses != [0, 0]:
        raise Fault(f"{statuses}, {said}")
    if not force and (sorted(statuses) != [0, 1] or found != whole[statuses.index(0)]):
        raise Fault(f"{statuses}, {said}")


def batch_line(seconds: str) -> list[str]:
    return ["batch", "--chain", "*.svg", "-o", "m/{n}.svg", "--duration", seconds, "-j", "1", *FEW]


def begin_batch(where: Path) -> None:
    begin(where)
    (where / "c.svg").write_text(A.replace("H20", "H12"))


def outputs(where: Path) -> dict[str, object]:
    return {
        name: data for name, data in state(where).items() if name.startswith("m/") and name.endswith(".svg")
    }


@cache
def batch_alone(seconds: str, where: Path) -> dict[str, object]:
    """Return what stands after a batch of its own."""
    begin_batch(where)
    done(run(batch_line(seconds), where))
    return outputs(where)


def two_batches(moment: float, where: Path) -> None:
    """Start two batches with different options on one folder; what is there is that of one, and the other says so."""
    begin_batch(where)
    forks = [Fork(batch_line("2"), where)]
    time.sleep(moment)
    forks.append(Fork(batch_line("3"), where))
    ended = [fork.wait() for fork in forks]
    statuses = [process.returncode for process in ended]
    whole = [batch_alone(seconds, where.with_name(where.name + ".alone")) for seconds in ("2", "3")]
    if statuses == [0, 0]:  # one after the other
        right = outputs(where) == whole[1]
    else:
        loser = ended[statuses.index(1)] if sorted(statuses) == [0, 1] else None
        right = loser is not None and outputs(where) == whole[statuses.index(0)]
        right = right and loser is not None and b"another batch is writing this" in loser.stderr
    if not right or litter(where) or list(where.rglob("*.claim")):
        raise Fault(f"two batches: {statuses}, {[process.stderr for process in ended]}, {litter(where)}")


def foreign_folders(name: str, is_read: bool, where: Path) -> None:
    """Run, be refused and be killed among folders that only look like stages; all stay, with all that is in them."""
    begin(where)
    places = [where, where / "deep", where / "out"][: 3 if name != "animation" else 2]
    folders = []
    for place in places:
        place.mkdir(exist_ok=True)
        stage = Stage(place, ["out.svg"])
        for folder in (place / f"{PREFIX}cache", stage.path):
            (folder / "new").mkdir(parents=True)
            for file in ("db", "new/db"):
                (folder / file).write_text("somebody else's")
            folders.append(folder)
    for folder in folders:
        folder.chmod(0o700 if is_read else 0)
    arguments = ["a.svg", "b.svg", *FEW, *TARGETS[name], "-f"]
    Fork(["nowhere.svg", *arguments[1:]], where).wait()
    Fork([*batch_line("2"), "--dry-run"], where, lambda: os.dup2(os.open(os.devnull, os.O_WRONLY), 1)).wait()
    Fork(arguments, where, lambda: strike_at(3, "SIGKILL")).wait()
    done(run(arguments, where))
    for folder in folders:
        folder.chmod(0o700)
        if [(folder / file).read_text() for file in ("db", "new/db")] != ["somebody else's"] * 2:
            raise Fault(f"{folder} was changed")
    if len(litter(where)) != len(folders):
        raise Fault(f"more is left than was there: {litter(where)}")
