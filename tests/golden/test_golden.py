"""Whole runs against files one can read."""

import json
from pathlib import Path
from xml.etree import ElementTree

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import report

HERE = Path(__file__).parent
CASES = sorted(path.parent.name for path in HERE.glob("*/arguments.txt"))


def canonical(path):
    """An SVG file with its attributes in one order, so that only meaning counts."""
    return ElementTree.canonicalize(path.read_text(encoding="utf-8"))


def correspondence(found):
    """Dots and work of every contour, rounded to what must not change."""
    contours = [contour for pair in found["pairs"] for contour in pair["contours"]]
    return [
        {"dots": c["dots"]} | {part: round(c[part], 9) for part in ("stretching", "bending", "travel")}
        for c in contours
    ]


def produce(case):
    """Run a case in the working folder: what it wrote, by name, and the correspondence."""
    arguments = (HERE / case / "arguments.txt").read_text(encoding="utf-8").split()
    files = [str(path) for path in sorted((HERE / case).glob("?.svg"))]
    if "--mix" in arguments:  # has no report
        assert run([*files, *arguments, "--output", "out", "-f"]) == 0
        found = []
    else:
        found = correspondence(report(*files, *arguments, "--output", "out"))
    return {path.name: path for path in sorted(Path("out").iterdir())}, found


@pytest.mark.parametrize("case", CASES)
def test_golden(case, here, request):
    written, found = produce(case)
    expected, known = HERE / case / "expected", HERE / case / "correspondence.json"
    if request.config.getoption("--update-golden"):
        expected.mkdir(exist_ok=True)
        for old in expected.iterdir():
            old.unlink()
        for name, path in written.items():
            (expected / name).write_bytes(path.read_bytes())
        lines = ",\n ".join(json.dumps(contour) for contour in found)
        known.write_text(f"[{lines}]\n", encoding="utf-8")
        return
    assert found == json.loads(known.read_text(encoding="utf-8"))
    assert sorted(written) == sorted(path.name for path in expected.iterdir())
    for name, path in written.items():
        assert canonical(path) == canonical(expected / name)


def test_a_difference_would_be_seen(here):
    written, _ = produce(CASES[0])
    changed = here / "changed.svg"
    path = next(iter(written.values()))
    changed.write_text(path.read_text(encoding="utf-8").replace("M", "M1", 1), encoding="utf-8")
    assert canonical(changed) != canonical(path)
