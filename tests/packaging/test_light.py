"""It works where scipy, which svgpathtools names as a requirement, is not installed."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.commands import names, write
from tests.support.drawings import BAR, LEAF, svg

BLOCK = """
import sys
class Blocked:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] == "scipy":
            raise ModuleNotFoundError(f"no module named {name!r}: it is blocked")
sys.meta_path.insert(0, Blocked())
"""

ARC = "M2,2 A5,3 20 1 1 8,8 A6,6 0 0 0 2,2 Z"


@pytest.fixture
def without_scipy(here):
    """Run Python in a process that cannot import scipy, nor can those that it starts."""
    Path("blocked").mkdir()
    Path("blocked/sitecustomize.py").write_text(BLOCK, "utf-8")

    def do(*arguments):
        paths = [str(Path("blocked").resolve()), os.environ.get("PYTHONPATH", "")]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths))}
        return subprocess.run(
            [sys.executable, *arguments], env=environment, capture_output=True, text=True, check=False
        )

    return do


def test_scipy_is_blocked(without_scipy):
    done = without_scipy("-c", "import scipy")
    assert done.returncode == 1
    assert "it is blocked" in done.stderr


@pytest.mark.parametrize(
    "line",
    [
        "a.svg b.svg --report report.json --preview page.html --try tries.svg",
        "a.svg b.svg -o moving.svg --motion intrinsic",
        "a.svg b.svg -o moving.json --emit lottie --motion intrinsic",
        "inspect b.svg --picture picture.svg",
        "plot graph a.svg b.svg",
        "rank a.svg b.svg --sheet sheet.svg",
        "batch --chain . -o out/{a}-{b}.svg",
    ],
    ids=lambda line: " ".join(line.split()[:2]),
)
def test_commands_work_without_scipy(line, without_scipy):
    write(a=svg(BAR), b=svg(ARC), c=svg(LEAF))
    before = names()
    done = without_scipy("-m", "shapeblend_cli", *line.split())
    assert done.returncode == 0, done.stderr
    assert len(names()) > len(before)
