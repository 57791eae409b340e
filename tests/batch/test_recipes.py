"""The recipes in docs/batch.md, run as they stand there."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

TEXT = (Path(__file__).parents[2] / "docs" / "batch.md").read_text("utf-8")
RECIPES = re.findall(r"^```(sh|make)\n(.*?)^```", TEXT, re.M | re.S)


def recipe(kind, words):
    """The one recipe that has some words."""
    (found,) = [text for form, text in RECIPES if form == kind and words in text]
    return found


@pytest.fixture
def manifest(drawings):
    """A manifest of six jobs."""
    names = ["1", "2", "9", "10"]
    pairs = [(a, b) for k, a in enumerate(names) for b in names[k + 1 :]]
    rows = [f"in/{a}.svg,in/{b}.svg,parts/{a}-{b}.svg\n" for a, b in pairs]
    Path("jobs.csv").write_text("a,b,o\n" + "".join(rows), "utf-8")
    return drawings


@pytest.fixture
def do():
    """Run a command that finds `shapeblend`, and return what it printed."""

    def run(*command, **environment):
        path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
        done = subprocess.run(
            command,
            env={**os.environ, "PATH": path, **environment},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        return done.stdout + done.stderr

    return run


def statuses():
    """The statuses that the results of four shards have."""
    texts = [Path(f"results-{k}.jsonl").read_text("utf-8") for k in range(1, 5)]
    return [" ".join(json.loads(line)["status"] for line in text.splitlines()) for text in texts]


def assert_whole(do):
    """Shards have made what one batch makes, which has nothing left to do."""
    assert "6 up to date" in do("shapeblend", "batch", "jobs.csv")
    shutil.move("parts", "together")
    do("shapeblend", "batch", "jobs.csv")
    assert len(list(Path("parts").glob("*.svg"))) == 6
    for path in Path("parts").glob("*.svg"):
        assert path.read_bytes() == Path("together", path.name).read_bytes()


def test_an_array_of_slurm(manifest, do):
    """Slurm runs the script once for each number, with these variables."""
    Path("array.sh").write_text(recipe("sh", "SLURM_ARRAY_TASK_ID"), "utf-8")
    for number in range(1, 5):
        variables = {
            "SLURM_ARRAY_TASK_ID": str(number),
            "SLURM_ARRAY_TASK_COUNT": "4",
            "SLURM_CPUS_PER_TASK": "1",
        }
        do("sh", "array.sh", **variables)
    assert statuses() == ["done done", "done done", "done", "done"]
    assert_whole(do)


def test_gnu_parallel(manifest, do):
    if shutil.which("parallel") is None or "GNU" not in do("parallel", "--version"):
        pytest.skip("no GNU parallel: apt-get install parallel")
    do("sh", "-c", recipe("sh", "parallel -j 4"))
    assert statuses() == ["done done", "done done", "done", "done"]
    assert_whole(do)


@pytest.mark.skipif(shutil.which("make") is None, reason="no make")
def test_make(drawings, do):
    shutil.move("in", "icons")
    Path("Makefile").write_text(recipe("make", "moving:"), "utf-8")
    assert "3 done" in do("make", "moving")
    assert "3 up to date" in do("make", "moving")
    Path("moving/2-9.svg").unlink()
    assert "1 done, 2 up to date" in do("make", "moving")


@pytest.mark.skipif(shutil.which("make") is None, reason="no make")
def test_make_with_dependencies(drawings, do):
    shutil.move("in", "icons")
    Path("jobs.csv").write_text("a,b,o\nicons/1.svg,icons/2.svg,moving/1.svg\n", "utf-8")
    Path("Makefile").write_text(recipe("make", "--depfile"), "utf-8")
    assert "1 done" in do("make", "moving/1.svg")
    assert "is up to date" in do("make", "moving/1.svg")
    Path("icons/2.svg").write_bytes(Path("icons/9.svg").read_bytes())
    os.utime("icons/2.svg", (2**32, 2**32))
    assert "1 done" in do("make", "moving/1.svg")


def test_a_newcomer_makes_29_animations_of_30_icons_with_the_command_in_the_help(here, do):
    """The first example of `shapeblend batch --help`, typed as it stands."""
    from tests.support.commands import write
    from tests.support.drawings import BAR, LEAF, svg

    help_text = do("shapeblend", "batch", "--help", COLUMNS="200")
    (line,) = re.findall(r"shapeblend batch --chain icons .*?svg'", help_text)
    Path("icons").mkdir()
    write(**{f"icons/icon-{k}": svg(f"M{k % 7} 0" + (BAR if k % 2 else LEAF)) for k in range(1, 31)})
    assert "29 done" in do("sh", "-c", line)
    made = sorted(path.name for path in Path("moving").glob("*.svg"))
    assert len(made) == 29
    assert "icon-9-icon-10.svg" in made
    assert all(b"<animate" in Path("moving", name).read_bytes() for name in made)
