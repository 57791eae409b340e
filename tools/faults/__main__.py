"""Kill runs, let them meet, and let their disks fail, for docs/reliability.md: `make faults`.

    python -m tools.faults [RUNS]

RUNS is the number of kills with each signal at random moments, of as many again at the moves, and of meetings; 200
without it. The first promise that is not kept ends it.
"""

from __future__ import annotations

import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from itertools import cycle, islice
from pathlib import Path

from tools.faults import runs

RUNS = 200
AFTER = 0.06
"""Seconds in which Python has started and come to the first line of the command."""
NAMESPACES = 10


def kills(count: int, where: Path, expected: dict[str, runs.Expected]) -> None:
    """Kill runs with each signal, so many at random moments and so many at the moves, over all targets in turn."""
    rng = random.Random(17)
    for what in runs.SIGNALS:
        shares = [len(range(k, count, len(expected))) for k in range(len(expected))]
        for (name, each), share in zip(expected.items(), shares, strict=True):
            folder = where / name
            runs.kill_at_random(each, what, share, folder, rng)
            runs.kill_at_moves(each, what, islice(cycle(range(1, each.changes + 1)), share), folder)
        runs.kill_early(expected["folder"], what, count // 4, where / "folder", rng, AFTER)
        say(f"{what}: {count} at random moments, {count} at the moves, {count // 4} while modules load")


def meetings(count: int, where: Path) -> None:
    """Let two runs meet on one target, with and without force, over all targets in turn but the report."""
    for k, name in zip(range(count), cycle(list(runs.TARGETS)[:-1]), strict=False):
        runs.two_at_once(name, k // 5 % 2 == 0, where / "two")
    say(f"two runs at once: {count}")


def batches(count: int, where: Path) -> None:
    """Let two batches meet in one folder, the second one at a random moment of the first."""
    rng = random.Random(18)
    for _ in range(count):
        runs.two_batches(rng.uniform(0.0, 1.0), where / "batches")
    say(f"two batches at once: {count}")


def foreign(count: int, where: Path) -> None:
    """Run among folders of others that are called like stages, over all targets in turn."""
    for k, name in zip(range(count), cycle(list(runs.TARGETS)), strict=False):
        runs.foreign_folders(name, k // len(runs.TARGETS) % 2 == 0, where / "foreign")
    say(f"folders of others that are called like stages: {count}")


def errors(where: Path, expected: dict[str, runs.Expected]) -> None:
    """Let each change of each target meet an error of the disk."""
    for name, each in expected.items():
        runs.fail_at_moves(each, "EIO", range(1, each.changes + 1), where / name)
    say(f"errors of the disk: {sum(each.changes for each in expected.values())}")


def namespaces(where: Path) -> None:
    """Kill runs that are process 1 of a namespace and have one folder in common, where namespaces can be made."""
    command = ["unshare", "--fork", "--pid", "--mount-proc"]
    try:
        subprocess.run([*command, "true"], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        return say("process 1 of a namespace: not on this machine")
    expected = runs.prepare("folder", where / "one")
    for k in range(NAMESPACES):
        moment = str(expected.changes * (k + 1) // NAMESPACES)
        hanging = [sys.executable, "-m", "tools.faults.aimed", moment, "hang", *expected.arguments]
        with subprocess.Popen(
            [*command, "--kill-child", *hanging],
            cwd=where / "one",
            env=runs.environment(),
            stdout=subprocess.PIPE,
        ) as process:
            process.stdout.readline()  # it is there
            process.kill()
        if runs.state(where / "one") not in (expected.old, expected.new):
            raise runs.Fault("neither old nor new, in a namespace")
        again = subprocess.run(
            [*command, *runs.COMMAND, *expected.arguments],
            cwd=where / "one",
            env=runs.environment(),
            capture_output=True,
            check=False,
        )
        runs.done(again)
        if runs.state(where / "one") != expected.new or runs.litter(where / "one"):
            raise runs.Fault(f"after the next run in a namespace: {runs.litter(where / 'one')}")
    say(f"process 1 of a namespace: {NAMESPACES}")


def say(text: str) -> None:
    print(f"{time.strftime('%H:%M:%S')} {text}", flush=True)


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else RUNS
    memory = "/dev/shm"  # where nothing waits for a disk
    where = Path(tempfile.mkdtemp(prefix="shapeblend-", dir=memory if os.path.isdir(memory) else None))
    try:
        expected = {name: runs.prepare(name, where / name) for name in runs.TARGETS}
        kills(count, where, expected)
        meetings(count, where)
        batches(count // 10, where)
        foreign(count // 4, where)
        errors(where, expected)
        namespaces(where)
    finally:
        shutil.rmtree(where)


if __name__ == "__main__":
    main()
