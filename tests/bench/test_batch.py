"""Time of eighty plain pairs of icons as a batch, and by flubber in one process of node; and of planning a batch.

flubber makes path data of five in-betweens, and writes no files. `make bench-batches` times batches beside separate
commands.
"""

import json
import subprocess
import sys
from pathlib import Path

from tests.support.commands import write
from tests.support.drawings import svg
from tests.support.equipment import require
from tools.quality.data import icon_pairs
from tools.quality.peers import flubber

GROUP = "eighty plain pairs of icons"
PAIRS = icon_pairs("single")[:80]
COMMAND = f"{sys.executable} -m shapeblend_cli"


def test_batch(benchmark, here):
    benchmark.group = GROUP
    rows = []
    for k, pair in enumerate(PAIRS):
        write(**{f"{k}-a": svg(pair.a), f"{k}-b": svg(pair.b)})
        rows.append({"a": f"{k}-a.svg", "b": f"{k}-b.svg", "o": f"out/{k}.svg"})
    Path("jobs.jsonl").write_text("\n".join(map(json.dumps, rows)), "utf-8")
    line = f"{COMMAND} batch jobs.jsonl -q -j 1 --force".split()
    benchmark.pedantic(lambda: subprocess.run(line, check=True), rounds=2)
    assert len(list(Path("out").glob("*.svg"))) == len(PAIRS)


def test_planning(benchmark, here):
    """20,000 rows, none of which is done; less than three seconds on a machine with nothing else to do."""
    write(a=svg("M0 0h9v9z"), b=svg("M0 0h9v3z"))
    rows = "".join(f"a.svg,b.svg,out/{k // 500}/{k}.svg\n" for k in range(20_000))
    Path("jobs.csv").write_text(f"a,b,o\n{rows}", "utf-8")
    line = f"{COMMAND} batch jobs.csv --dry-run".split()
    done = benchmark.pedantic(lambda: subprocess.run(line, check=True, capture_output=True), rounds=3)
    assert done.stdout.count(b"\n") == 20_000


def test_flubber(benchmark):
    require("flubber")
    benchmark.group = GROUP
    times = [k / 6 for k in range(1, 6)]
    found = benchmark.pedantic(lambda: flubber.FINE.path_data(PAIRS, times), rounds=2)
    assert len(found) == len(PAIRS)
    assert sum(frames is not None for frames in found) > 70
