"""Time of thirty plain pairs of icons as a batch, and as separate commands, one after another and by xargs."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.commands import write
from tests.support.drawings import svg

GROUP = "thirty plain pairs of icons"
COUNT = 30
PAIRS = Path(__file__).parent / "data" / "pairs.json"
COMMAND = f"{sys.executable} -m shapeblend_cli"
WAYS = {
    "separate commands": f"xargs -L 1 {COMMAND}",
    "xargs -P 2": f"xargs -P 2 -L 1 {COMMAND}",
    "batch -j 1": f"{COMMAND} batch jobs.jsonl -q -j 1",
    "batch -j 2": f"{COMMAND} batch jobs.jsonl -q -j 2",
}


@pytest.mark.parametrize("way", WAYS)
def test_batch(benchmark, here, way):
    benchmark.group = GROUP
    rows = []
    for k, pair in enumerate(json.loads(PAIRS.read_text("utf-8"))["single"][:COUNT]):
        write(**{f"{k}-{side}": svg(pair[side]) for side in "ab"})
        rows.append({"a": f"{k}-a.svg", "b": f"{k}-b.svg", "o": f"out/{k}.svg"})
    assert len(rows) == COUNT
    Path("jobs.jsonl").write_text("\n".join(map(json.dumps, rows)), "utf-8")
    lines = "".join(f"{row['a']} {row['b']} -o {row['o']}\n" for row in rows).encode()

    def again():
        shutil.rmtree("out", ignore_errors=True)
        Path("out").mkdir()

    benchmark.pedantic(
        lambda: subprocess.run(WAYS[way].split(), input=lines, check=True), setup=again, rounds=3
    )
    assert len(list(Path("out").glob("*.svg"))) == COUNT
