"""Run large batches, kill them, spread them, and write docs/capacity.json and docs/capacity.md: `make bulk`.

    python -m tools.bulk [whole] [memory] [rates] [cluster] [--again | --jobs N]

Icons come from npm. The first promise that is not kept ends it. Parts can be run by themselves: docs/capacity.json
keeps what the others have measured. With `--again` nothing is run, and the document is made of what that has; with
another number of jobs than 2,000 what was measured is printed, and not written.
"""

from __future__ import annotations

import argparse
import contextlib
import hashlib
import io
import itertools
import json
import math
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tools.dask_processes import ADDRESS, SCHEDULER, worker
from tools.quality.data import ROOT
from tools.quality.icon_sets import icon_file, icon_set
from tools.quality.judge import pairs as icons
from tools.quality.tables import Table

RAW, DOCUMENT = ROOT / "docs" / "capacity.json", ROOT / "docs" / "capacity.md"
JOBS = 2000
SHARDS = 4
KILLS = 3
FEW, MANY = 40, 440
"""What a job costs a cluster is the difference between batches of so many."""
AN_HOUR = 1_000_000
"""Pairs an hour that the document plans for."""
BUSY = 0.7
"""The share of a processor that the plan has a client or a scheduler use."""

PACKAGE, LONGEST = "material-symbols", 400  # characters of a plain icon
COMMAND = [sys.executable, "-m", "shapeblend_cli"]
BATCH = [*COMMAND, "batch", "--chain", "in", "-q"]


def draw(count: int, folder: Path) -> None:
    """Write one more icon than there are jobs, drawn by lot."""
    if problem := icons.ready():
        sys.exit(f"no icons: {problem}")
    known = icon_set(icons.INSTALLED, PACKAGE)
    variants = icons.VARIANTS[PACKAGE]
    names = [
        name
        for name in sorted(known["icons"])
        if not name.endswith(variants)
        and known["icons"][name]["body"].count("<") == 1
        and len(known["icons"][name]["body"]) < LONGEST
    ]
    folder.mkdir()
    chosen = random.Random(18).sample(names, count + 1)
    for k, name in enumerate(chosen):
        (folder / f"{k}.svg").write_text(icon_file(icons.INSTALLED, PACKAGE, name), "utf-8")


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


def killed_and_resumed(count: int) -> dict[str, Any]:
    """Kill a batch at random moments, run it until it is complete, and once more."""
    rng = random.Random(1818)
    line = [*BATCH, "-o", "whole/{n}.svg", "-j", "2", "--results", "r.jsonl"]
    at = sorted(rng.uniform(0.05, 0.9) for _ in range(KILLS))
    stood = []
    for share in at:
        process = subprocess.Popen(line, start_new_session=True)
        while statuses("r.jsonl").count("done") + sum(stood) < share * count and process.poll() is None:
            time.sleep(rng.uniform(0.05, 0.15))
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        time.sleep(1.0)  # for processes that finish the job that they are at
        now = len(made("whole"))
        say(f"killed with {now} of {count} outputs there")
        stood.append(now - sum(stood))
        Path("r.jsonl").unlink()
    subprocess.run(line, check=True)
    found = statuses("r.jsonl")
    check(found.count("current") == sum(stood), f"run again, {found.count('current')} were up to date")
    check(len(made("whole")) == count, f"all {count} outputs are there")
    Path("r.jsonl").unlink()
    before = time.perf_counter()
    usage = _cpu(line)
    seconds = time.perf_counter() - before
    check({*statuses("r.jsonl")} == {"current"}, f"a further run does nothing, in {seconds:.2f} s")
    return {"kills": KILLS, "again_seconds": seconds, "again_cpu": usage}


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


def shards(count: int) -> None:
    """Do the batch in parts."""
    for k in range(1, SHARDS + 1):
        line = [*BATCH, "-o", "parts/{n}.svg", "--shard", f"{k}/{SHARDS}"]
        subprocess.run(line, check=True)
    check(made("parts") == made("whole"), f"{SHARDS} shards make the {count} outputs of the whole")


def memory(count: int) -> dict[str, Any]:
    """Watch the memory of a worker that does all jobs; take its processor time, too."""
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
    seconds = [json.loads(each)["seconds"] for each in Path("one.jsonl").read_text().splitlines()]
    return {"memory": {str(k): round(value) for k, value in at.items()}, "median_seconds": _median(seconds)}


def _list(at: dict[int, float]) -> str:
    return ", ".join(f"{value:.0f} (after {k})" for k, value in at.items())


def _median(values: list[float]) -> float:
    return sorted(values)[len(values) // 2]


def _memory(pid: int) -> float:
    """The resident memory of a process in MB; 0 if it is gone."""
    with contextlib.suppress(OSError, IndexError):
        return int(Path(f"/proc/{pid}/status").read_text().split("VmRSS:")[1].split()[0]) / 1024
    return 0.0


def _cpu(line: list[str]) -> float:
    """Run a command; the seconds of a processor that it took, with all processes that it started."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(line, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def rates(jobs: int) -> dict[str, float]:
    """What a job costs here, in seconds of a processor: alone, and in a batch of one process."""
    count = min(60, jobs - 10)
    pairs = [(f"in/{k}.svg", f"in/{k + 1}.svg") for k in range(count)]
    Path("out").mkdir()
    alone = sum(_cpu([*COMMAND, a, b, "-q", "-o", f"out/{k}.svg"]) for k, (a, b) in enumerate(pairs)) / count
    few = _cpu(_first(10, "few") + ["-j", "1"])
    more = _cpu(_first(10 + count, "more") + ["-j", "1"])
    found = {"alone": alone, "job": (more - few) / count}
    say(f"alone {found['alone']:.3f} s, in a batch {found['job']:.3f} s of a processor each")
    return found


def _first(count: int, name: str) -> list[str]:
    """A batch of the first so many drawings."""
    rows = [{"a": f"in/{k}.svg", "b": f"in/{k + 1}.svg", "o": f"{name}/{k}.svg"} for k in range(count)]
    Path(f"{name}.jsonl").write_text("\n".join(map(json.dumps, rows)), "utf-8")
    return [*COMMAND, "batch", f"{name}.jsonl", "-q"]


def client(count: int, again: float) -> dict[str, float]:
    """What a job that is up to date costs whoever reads the batch: time of a processor, and memory."""
    peaks = []
    for number in (count // 10, count):
        rows = [{"a": f"in/{k}.svg", "b": f"in/{k + 1}.svg", "o": f"whole/{k}.svg"} for k in range(number)]
        Path("plan.jsonl").write_text("\n".join(map(json.dumps, rows)), "utf-8")
        code = (
            "import sys; from shapeblend_cli.cli import run; sys.stdout = open('/dev/null', 'w'); "
            "run(['batch', 'plan.jsonl', '--dry-run']); "
            "print(open('/proc/self/status').read().split('VmHWM:')[1].split()[0], file=sys.stderr)"
        )
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        peaks.append(int(done.stderr.split()[-1]))
    kilobytes = (peaks[1] - peaks[0]) / (count - count // 10)
    return {"plan_cpu": again / count, "plan_kilobytes": kilobytes}


def cluster(jobs: int) -> dict[str, float]:
    """What a job costs the client, the scheduler and the workers of a cluster, in seconds of a processor."""
    many = min(MANY, jobs)
    environment = {**os.environ, "DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED": "false"}
    options: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "env": environment}
    processes = [subprocess.Popen(SCHEDULER, **options)]
    try:
        while not (Path(ADDRESS).exists() and "}" in Path(ADDRESS).read_text()):
            time.sleep(0.1)
        address = json.loads(Path(ADDRESS).read_text())["address"]
        for name in ("first", "second"):
            Path(name).mkdir()
            processes.append(subprocess.Popen(worker(address, Path(name).resolve()), cwd=name, **options))
        time.sleep(5.0)
        subprocess.run([*_first(8, "warm"), "--cluster", address], check=True)
        used = []
        for count, name in ((FEW, "near"), (many, "far")):
            before = [_used(process.pid) for process in processes]
            own = _cpu([*_first(count, name), "--cluster", address])
            after = [_used(process.pid) for process in processes]
            used.append([own, *(b - a for a, b in zip(before, after, strict=True))])
    finally:
        for process in processes[::-1]:
            process.terminate()
            process.wait()
    client_share, scheduler, *workers = ((b - a) / (many - FEW) for a, b in zip(*used, strict=True))
    drawings = sum(Path(f"in/{k}.svg").stat().st_size for k in range(many + 1)) / many * 2
    outputs = sum(Path(f"far/{k}.svg").stat().st_size for k in range(many)) / many
    found = {
        "client": client_share,
        "scheduler": scheduler,
        "worker": sum(workers),
        "bytes_in": drawings,
        "bytes_out": outputs,
    }
    say(", ".join(f"{name} {value:.4g}" for name, value in found.items()))
    return found


def _used(pid: int) -> float:
    """The seconds of a processor that a process and all those that it has started have taken, also ended ones."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0.0
    own = sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")
    return own + sum(map(_used, _children(pid)))


def _children(pid: int) -> list[int]:
    found = []
    with contextlib.suppress(OSError):
        for task in os.listdir(f"/proc/{pid}/task"):
            found += map(int, Path(f"/proc/{pid}/task/{task}/children").read_text().split())
    return found


def whole(count: int) -> dict[str, Any]:
    """All about one batch: killed and resumed, in shards, beside single commands, and what it takes to read it."""
    found = killed_and_resumed(count)
    shards(count)
    equal_to_single_commands(count)
    return found | client(count, found["again_cpu"])


PARTS: dict[str, Callable[[int], dict[str, Any]]] = {
    "whole": whole,
    "memory": memory,
    "rates": rates,
    "cluster": cluster,
}


def measured(part: str, count: int) -> dict[str, Any]:
    """Run a part in a folder that is thrown away."""
    home = os.getcwd()
    folder = tempfile.mkdtemp(prefix="shapeblend-bulk-")
    try:
        os.chdir(folder)
        draw(count, Path("in"))
        found = PARTS[part](count)
    finally:
        os.chdir(home)
        shutil.rmtree(folder, ignore_errors=True)
    return {"jobs": count} | {k: round(v, 6) if isinstance(v, float) else v for k, v in found.items()}


def document(found: dict[str, Any]) -> str:
    """The page."""
    rate = AN_HOUR / 3600
    count = found["jobs"]
    after = [k for k in found["memory"]]
    promises = [
        (f"{count:,} icon pairs, killed {found['kills']} times at random moments and run again", "complete"),
        ("... outputs that differ from those of single commands, byte for byte", "0"),
        (
            "... another run, with nothing left to do",
            f"{found['again_seconds']:.1f} s, with {found['again_cpu']:.1f} s of processor time",
        ),
        (f"... in {SHARDS} shards: outputs that differ", "0"),
        *((f"memory of a worker after {int(k):,} jobs", f"{found['memory'][k]} MB") for k in after),
    ]
    costs = [
        ("a pair, by a command of its own", _ms(found["alone"])),
        ("a pair in a batch, by a process that is already running", _ms(found["job"])),
        ("a pair on a cluster: the worker, with the process that does the job", _ms(found["worker"])),
        ("... the scheduler", _ms(found["scheduler"])),
        ("... the client, which reads, sends, fetches and writes", _ms(found["client"])),
        ("a pair that is up to date, to find that out", _ms(found["plan_cpu"])),
    ]
    cores = rate * found["worker"]
    clients = math.ceil(rate * found["client"] / BUSY)
    schedulers = math.ceil(rate * found["scheduler"] / BUSY)
    traffic = rate * (found["bytes_in"] + found["bytes_out"]) / 1e6
    memory_of_all = AN_HOUR * found["plan_kilobytes"] / 1e6
    plan = [
        ("pairs a second", f"{rate:.0f}"),
        (
            "processors for workers",
            f"{cores:.0f}, or {math.ceil(1.1 * cores)} with a tenth more for losses",
        ),
        ("schedulers", f"{schedulers}, each less than {BUSY:.0%} busy"),
        (
            "clients",
            f"{clients}, each with a shard (`--shard 1/{clients}` ...) and less than {BUSY:.0%} busy",
        ),
        ("drawings and outputs that are sent", f"{traffic:.1f} MB a second"),
        ("memory of a client for a manifest of a million rows", f"{memory_of_all:.1f} GB, for each client"),
        (
            "without a cluster, with a shard for each machine: processors",
            f"{rate * found['job']:.0f}",
        ),
    ]
    parts = [
        "# Capacity",
        "This page says what many blends take. `make bulk` measures it part by part into "
        "[capacity.json](capacity.json), from which this page is made. The drawings are random icons of Material "
        "Symbols, plain ones with one path each. Each is blended into the next, as an animated SVG. Times are "
        "processor times, on a machine with two processors that did nothing else.",
        "## What was checked",
        Table(("what", "measured"), promises).markdown().rstrip("\n"),
        "## What a pair costs",
        Table(("what", "milliseconds of processor time"), costs).markdown().rstrip("\n"),
        f"## {AN_HOUR:,} pairs an hour, calculated",
        Table(("what", "needed"), plan).markdown().rstrip("\n"),
        "This is a calculation, and was not run: each figure is the rate times what a pair costs above. Other "
        "drawings take other times. To find out, make a batch of a few hundred of them; `--results` has the "
        "`seconds` of each. What the scheduler and the client do for a job hardly depends on its drawings. So the "
        "longer the jobs take, the fewer of both are needed.",
    ]
    return "\n\n".join(parts) + "\n"


def _ms(seconds: float) -> str:
    return f"{1000 * seconds:.1f}"


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("parts", nargs="*", metavar="|".join(PARTS))
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--jobs", type=int, default=JOBS)
    options = parser.parse_args()
    found = json.loads(RAW.read_text("utf-8")) if RAW.exists() else {}
    if unknown := {*options.parts} - {*PARTS}:
        parser.error(f"no part is called {min(unknown)}")
    for part in () if options.again else options.parts or PARTS:
        found |= measured(part, options.jobs)
        if options.jobs == JOBS:
            RAW.write_text(json.dumps(dict(sorted(found.items())), indent=1) + "\n", "utf-8")
    if options.jobs != JOBS:
        print(json.dumps(found, indent=1))
    elif all(key in found for key in ("memory", "alone", "client", "plan_cpu")):
        DOCUMENT.write_text(document(found), "utf-8")


if __name__ == "__main__":
    main()
