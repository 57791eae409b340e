"""Batches that stay and do again what changes."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

COMMAND = [sys.executable, "-m", "shapeblend_cli", "batch", "--watch", "--results", "r.jsonl"]


@pytest.fixture
def watching(drawings):
    """Start a batch that watches, which ends with the test."""
    processes = []

    def start(*line):
        with open("printed", "wb") as printed:
            processes.append(subprocess.Popen([*COMMAND, *line], stderr=printed))
        return processes[0]

    yield start
    for process in processes:
        process.kill()
        process.wait()


def until(condition):
    end = time.monotonic() + 90.0
    while not condition():
        assert time.monotonic() < end, Path("printed").read_text("utf-8")
        time.sleep(0.05)


def told():
    lines = Path("r.jsonl").read_bytes().split(b"\n")[:-1] if Path("r.jsonl").exists() else []
    return [(Path(each["b"]).name, each["status"]) for each in map(json.loads, lines)]


def printed():
    return Path("printed").read_text("utf-8")


def replace(name, text):
    Path("new").write_text(text, "utf-8")
    os.replace("new", name)


def test_what_changes_is_done_again_and_nothing_else(watching):
    process = watching("--chain", "in", "-o", "m/{a}-{b}.svg", "--force")
    until(lambda: "waiting for drawings to change" in printed())
    assert sorted(told()) == [("10.svg", "done"), ("2.svg", "done"), ("9.svg", "done")]
    before = Path("m/9-10.svg").read_bytes()
    replace("in/10.svg", Path("in/1.svg").read_text("utf-8"))
    until(lambda: len(told()) == 4)
    assert told()[3:] == [("10.svg", "done")]
    assert Path("m/9-10.svg").read_bytes() != before
    shutil.copy("in/2.svg", "in/11.svg")
    until(lambda: len(told()) == 5)
    assert told()[4:] == [("11.svg", "done")]
    replace("in/11.svg", "<svg/>")
    until(lambda: len(told()) == 6)
    assert told()[5:] == [("11.svg", "failed")]
    Path("in/11.svg").unlink()
    until(lambda: "shapeblend: 3 up to date\n" in printed())
    process.send_signal(signal.SIGINT)
    assert process.wait(30) == 130
    assert "Traceback" not in printed()
    assert len(told()) == 6


def test_a_manifest_that_is_edited_is_read_again_also_after_a_mistake(watching):
    replace("in/jobs.csv", "a,b,o\n1.svg,2.svg,x.svg\n")
    process = watching("in/jobs.csv")
    until(lambda: "waiting for drawings to change" in printed())
    replace("in/jobs.csv", "a,b,o,vertexes\n1.svg,2.svg,x.svg,3\n")
    until(lambda: "'vertexes' is no option" in printed())
    replace("in/jobs.csv", "a,b,o\n1.svg,2.svg,x.svg\n2.svg,9.svg,y.svg\n")
    until(lambda: len(told()) == 2)
    assert told() == [("2.svg", "done"), ("9.svg", "done")]
    assert Path("in/y.svg").is_file()
    process.send_signal(signal.SIGTERM)
    assert process.wait(30) == 143
