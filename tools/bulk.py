"""Run large batches, kill them, do them in shards, and measure them, for docs/capacity.md: `make bulk`.

    python -m tools.bulk [whole] [memory] [costs] [--jobs N]

Icons come from npm. The first promise that is not kept ends it; what is measured is printed.
"""

from __future__ import annotations

import argparse
import contextlib
import hashlib
import io
import itertools
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from tools.quality.npm import icon_file, icon_set, install
from tools.quality.times import processor_time

JOBS = 2000
SHARDS = 4
KILLS = 3
COSTS = 60
"""Jobs whose time is taken."""

PACKAGE, LONGEST = "material-symbols", 400  # characters of a plain icon
VARIANTS = ("-rounded", "-sharp", "-outline")
"""The same icons again in another style, by how their names end."""
COMMAND = [sys.executable, "-m", "shapeblend_cli"]
BATCH = [*COMMAND, "batch", "--chain", "in", "-q"]


def draw(count: int, folder: Path) -> None:
    """Write one more icon than there are jobs, drawn by lot."""
    if problem := install():
        sys.exit(f"no icons: {problem}")
    known = icon_set(PACKAGE)
    names = [
        name
        for name in sorted(known["icons"])
        if not name.endswith(VARIANTS)
        and known["icons"][name]["body"].count("<") == 1
        and len(known["icons"][name]["body"]) < LONGEST
    ]
    folder.mkdir()
    chosen = random.Random(18).sample(names, count + 1)
    for k, name in enumerate(chosen):
        (folder / f"{k}.svg").write_text(icon_file(PACKAGE, name), "utf-8")


def say(text: str) -> None:
    print(text, flush=True)


def check(promise: bool, text: str) -> None:
    """End everything where a promise is not kept."""
    if not promise:
        sys.exit(f"not kept: {text}")
    say(text)


def made(folder: str) -> dict[str, str]:
    """Hashes of what a batch has written, without its records."""
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in Path(folder).glob("*.svg")}


def statuses(file: str) -> list[str]:
    lines = Path(file).read_bytes().split(b"\n")[:-1] if Path(file).exists() else []
    return [json.loads(line)["status"] for line in lines]


def whole(count: int) -> None:
    """Kill a batch at random moments, run it until it is complete, and once more; then in shards, and pair by pair."""
    rng = random.Random(1818)
    line = [*BATCH, "-o", "whole/{n}.svg", "-j", "2", "--results", "r.jsonl"]
    stood = 0
    for share in sorted(rng.uniform(0.05, 0.9) for _ in range(KILLS)):
        process = subprocess.Popen(line, start_new_session=True)
        while statuses("r.jsonl").count("done") + stood < share * count and process.poll() is None:
            time.sleep(rng.uniform(0.05, 0.15))
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        time.sleep(1.0)  # for processes that finish the job that they are at
        stood = len(made("whole"))
        say(f"killed with {stood} of {count} outputs there")
        Path("r.jsonl").unlink()
    subprocess.run(line, check=True)
    current = statuses("r.jsonl").count("current")
    check(current == stood, f"run again, {current} were up to date")
    check(len(made("whole")) == count, f"all {count} outputs are there")
    Path("r.jsonl").unlink()
    usage = processor_time(line)
    check(
        {*statuses("r.jsonl")} == {"current"},
        f"a further run does nothing, with {usage:.2f} s of a processor, {1000 * usage / count:.1f} ms a pair",
    )
    for k in range(1, SHARDS + 1):
        subprocess.run([*BATCH, "-o", "parts/{n}.svg", "--shard", f"{k}/{SHARDS}"], check=True)
    check(made("parts") == made("whole"), f"{SHARDS} shards make the {count} outputs of the whole")
    equal_to_single_commands(count)


def equal_to_single_commands(count: int) -> None:
    """Compare each output with what the command alone writes."""
    from shapeblend_cli.cli import run

    Path("single").mkdir()
    names = sorted((path.name for path in Path("in").iterdir()), key=lambda name: int(name[:-4]))
    width = len(str(count))
    with contextlib.redirect_stderr(io.StringIO()):
        for k, (a, b) in enumerate(itertools.pairwise(names), 1):
            assert run([f"in/{a}", f"in/{b}", "-o", f"single/{k:0{width}d}.svg"]) == 0
    check(made("whole") == made("single"), f"each of {count} outputs is that of a single command")


def memory(count: int) -> None:
    """Watch the memory of a worker that does all jobs."""
    line = [*BATCH, "-o", "one/{n}.svg", "-j", "1", "--results", "one.jsonl"]
    marks = [count // 20, count // 4, count // 2, count]
    at: dict[int, float] = {}
    process = subprocess.Popen(line)
    worker, peak = None, 0.0
    while process.poll() is None:
        time.sleep(0.1)
        worker = worker or next(iter(_children(process.pid)), None)
        now = _memory(worker) if worker else 0.0
        peak = max(peak, now)
        done = statuses("one.jsonl").count("done")
        if now and marks and done >= marks[0] - 5:
            at[marks.pop(0)] = now
    check(process.returncode == 0, f"a worker that did {count} jobs has {_list(at)} MB")
    early = at[count // 4]
    check(peak < 1.25 * early, f"... and at most {peak:.0f} MB, not a quarter more than after {count // 4}")


def _list(at: dict[int, float]) -> str:
    return ", ".join(f"{value:.0f} (after {k})" for k, value in at.items())


def _memory(pid: int) -> float:
    """The resident memory of a process in MB; 0 if it is gone."""
    with contextlib.suppress(OSError, IndexError):
        return int(Path(f"/proc/{pid}/status").read_text().split("VmRSS:")[1].split()[0]) / 1024
    return 0.0


def costs(jobs: int) -> None:
    """Measure what a job costs in time of a processor: alone, and in a batch of one process."""
    count = min(COSTS, jobs - 10)
    pairs = [(f"in/{k}.svg", f"in/{k + 1}.svg") for k in range(count)]
    Path("out").mkdir()
    alone = (
        sum(processor_time([*COMMAND, a, b, "-q", "-o", f"out/{k}.svg"]) for k, (a, b) in enumerate(pairs))
        / count
    )
    few = processor_time([*_first(10, "few"), "-j", "1"])
    more = processor_time([*_first(10 + count, "more"), "-j", "1"])
    say(f"a command of its own: {1000 * alone:.1f} ms")
    say(f"in a batch: {1000 * (more - few) / count:.1f} ms")


def _first(count: int, name: str) -> list[str]:
    """A batch of the first so many drawings."""
    rows = [{"a": f"in/{k}.svg", "b": f"in/{k + 1}.svg", "o": f"{name}/{k}.svg"} for k in range(count)]
    Path(f"{name}.jsonl").write_text("\n".join(map(json.dumps, rows)), "utf-8")
    return [*COMMAND, "batch", f"{name}.jsonl", "-q"]


def _children(pid: int) -> list[int]:
    found = []
    with contextlib.suppress(OSError):
        for task in os.listdir(f"/proc/{pid}/task"):
            found += map(int, Path(f"/proc/{pid}/task/{task}/children").read_text().split())
    return found


PARTS: dict[str, Callable[[int], None]] = {"whole": whole, "memory": memory, "costs": costs}


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("parts", nargs="*", metavar="|".join(PARTS))
    parser.add_argument("--jobs", type=int, default=JOBS)
    options = parser.parse_args()
    if unknown := {*options.parts} - {*PARTS}:
        parser.error(f"no part is called {min(unknown)}")
    for part in options.parts or PARTS:
        with tempfile.TemporaryDirectory(prefix="shapeblend-bulk-") as folder, contextlib.chdir(folder):
            draw(options.jobs, Path("in"))
            PARTS[part](options.jobs)


if __name__ == "__main__":
    main()
