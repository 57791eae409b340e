"""Every command of docs/cookbook.md, run as it stands there."""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from shapeblend_cli.cli import run
from tests.support.commands import names

ROOT = Path(__file__).parents[1]
TEXT = (ROOT / "docs" / "cookbook.md").read_text(encoding="utf-8")
BLOCKS = dict.fromkeys(("sh", "make", "yaml", "css"), "")
for kind, block in re.findall(r"^```(\w+)\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL):
    BLOCKS[kind] += block
LINES = [line for line in BLOCKS["sh"].splitlines() if line.strip()]

DRAWINGS = {
    "play": "triangle",
    "pause": "square",
    "sun": "square",
    "moon": "triangle",
    "e": "e",
    "f": "f",
    "coast-1900": "pan-1",
    "coast-2000": "pan-1",
    "walk": "dancer-1",
    "run": "dancer-2",
    "icons/1": "triangle",
    "icons/2": "step-1",
    "off/wifi": "step-1",
    "on/wifi": "step-2",
}
"""What the page calls drawings, and the samples that are taken for them."""


@pytest.fixture
def kitchen(here, samples):
    """A working folder with all drawings that the page has."""
    for name, sample in DRAWINGS.items():
        Path(name).parent.mkdir(exist_ok=True)
        shutil.copy(samples / f"{sample}.svg", f"{name}.svg")
    return here


def written_by(line):
    """The file or folder that a command names for what it writes."""
    words = shlex.split(line)
    (flag,) = {"-o", "--sheet"} & {*words}
    return words[words.index(flag) + 1].replace("{a}", "wifi")


@pytest.mark.parametrize("line", LINES)
def test_a_command_of_the_cookbook_works(line, kitchen):
    words = shlex.split(line)
    assert words[0] == "shapeblend"
    assert run(words[1:]) == 0
    assert Path(written_by(line)).exists()


def test_every_block_of_commands_is_seen():
    assert len(LINES) == TEXT.count("```sh") >= 9


def test_the_rule_for_make_works(kitchen):
    if shutil.which("make") is None:
        pytest.skip("needs make")
    Path("Makefile").write_text(BLOCKS["make"], encoding="utf-8")
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    again = [
        subprocess.run(
            ["make", "moving/wifi.svg"], env={**os.environ, "PATH": path}, capture_output=True, text=True
        )
        for _ in range(2)
    ]
    assert [done.returncode for done in again] == [0, 0], again[0].stderr
    assert "moving/wifi.svg" in names()
    assert "up to date" in again[1].stdout


def test_the_command_in_continuous_integration_works(kitchen):
    (job,) = yaml.safe_load(BLOCKS["yaml"])["jobs"].values()
    (line,) = [step["run"] for step in job["steps"] if "run" in step]
    words = shlex.split(line)
    assert words[:2] == ["uvx", "shapeblend"]
    assert run(words[2:]) == 0
    assert Path("moving/wifi.svg").exists()


def test_both_files_of_a_pair_have_the_ids_that_the_page_names(kitchen):
    assert run("play.svg pause.svg --emit pair -o pair".split()) == 0
    for name in ("a", "b"):
        assert 'id="shape-1"' in Path(f"pair/{name}.svg").read_text(encoding="utf-8")
    assert "#shape-1" in BLOCKS["css"]
