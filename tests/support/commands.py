"""Running the command in the working folder."""

from __future__ import annotations

import json
import os
import pty
import re
import subprocess
import sys
import time
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from shapeblend_cli.cli import run


def write(**drawings):
    """Write drawings to files of their names."""
    for name, text in drawings.items():
        Path(f"{name}.svg").write_text(text, encoding="utf-8")


def names(folder="."):
    """What is in a folder and in those inside it."""
    return sorted(path.relative_to(folder).as_posix() for path in Path(folder).rglob("*"))


def made():
    """What is in the working folder beside a.svg, b.svg and c.svg."""
    return [name for name in names() if name not in ("a.svg", "b.svg", "c.svg")]


def contents(folder="."):
    """The bytes of all files in a folder and in those inside it."""
    return {path: path.is_file() and path.read_bytes() for path in sorted(Path(folder).rglob("*"))}


def wait_until(is_so, seconds=30):
    """Wait until something is so, and fail if it never is."""
    end = time.monotonic() + seconds
    while not is_so():  # asked once more, a server may already be busy again
        assert time.monotonic() < end
        time.sleep(0.02)


def report(*arguments):
    """The report of a run."""
    assert run([*arguments, "--report", "r.json", "-f"]) == 0
    return json.loads(Path("r.json").read_text(encoding="utf-8"))


def contours(*arguments):
    """What the report of a run says of contours."""
    return [contour for pair in report(*arguments)["pairs"] for contour in pair["contours"]]


def assert_refused(capsys, arguments, words, status=2):
    """Run the command, which has to say what is wrong in one line with these words in it, and write nothing."""
    before = contents()
    assert run(arguments) == status
    error = capsys.readouterr().err
    assert words in error
    assert error.count("\n") == 1
    assert contents() == before


def process(*arguments, stdin=None, **environment):
    """Run the command in a process of its own, which has to succeed."""
    command = [sys.executable, "-m", "shapeblend_cli", *arguments]
    return subprocess.run(
        command, input=stdin, capture_output=True, check=True, env={**os.environ, **environment}
    )


def points(text):
    """The points in path data, or in the text of a file with one path."""
    path = re.search(r' d="([^"]*)"', text)
    numbers = re.findall(r"-?[\d.]+(?:e-?\d+)?", path[1] if path else text)
    return np.array(numbers, float).reshape(-1, 2) @ [1, 1j]


def viewbox(file):
    """The viewBox of an SVG file, which has no other attributes."""
    root = ElementTree.parse(file).getroot()
    assert root.keys() == ["viewBox"]
    return [float(number) for number in root.get("viewBox").split()]


def read_to(terminal, end=None):
    """What is written on a terminal, up to some text or until its other side is closed."""
    seen = b""
    while end is None or end not in seen:
        try:
            seen += os.read(terminal, 4096)
        except OSError:
            break
    return seen


def start_on_terminal(command, **options):
    """A process with a terminal for its standard output and error, and our side of that."""
    ours, theirs = pty.openpty()
    streams = {"stdin": subprocess.DEVNULL, "stdout": theirs, "stderr": theirs}
    process = subprocess.Popen(command, **streams, **options)
    os.close(theirs)
    return process, ours
