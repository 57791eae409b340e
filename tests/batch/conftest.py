"""Drawings to blend in bulk."""

import json
from pathlib import Path

import pytest

from shapeblend_cli.batch import worker
from shapeblend_cli.cli import run
from tests.support.commands import write
from tests.support.drawings import BAR, LEAF, RING, svg


def write_drawings():
    """Write a folder of four drawings, of which natural order and that of letters differ."""
    Path("in").mkdir()
    write(**{"in/1": svg(BAR), "in/2": svg(LEAF), "in/9": svg("M2 3H20V18Z"), "in/10": svg(RING)})


@pytest.fixture
def drawings(here):
    """A working folder with these drawings."""
    write_drawings()
    return here


@pytest.fixture
def batch(here, capsys):
    """Run a batch; the exit status, its results in order of their numbers, and what it printed."""

    def do(*arguments):
        Path("results.jsonl").unlink(missing_ok=True)
        status = run(["batch", *arguments, "--results", "results.jsonl"])
        found = [json.loads(line) for line in Path("results.jsonl").read_text("utf-8").splitlines()]
        results = {each["job"]: each for each in sorted(found, key=lambda each: each["job"])}
        return status, results, capsys.readouterr()

    return do


@pytest.fixture
def statuses(batch):
    """Run a batch; the exit status, and the statuses of its jobs in order."""

    def do(*arguments):
        status, results, _ = batch(*arguments)
        return status, " ".join(results[number]["status"] for number in sorted(results))

    return do


BROKEN = """
import os, signal, sys, time
import shapeblend_cli.batch.worker as worker

def once(name):
    try:
        with open(name, "x") as file:
            print(os.getpid(), file=file)
        return True
    except FileExistsError:
        return False

def hold():
    if once("begun"):
        while not os.path.exists("go"):
            time.sleep(0.01)

def before(order):
    output = order.given["output"]
    {}

do = worker.do
worker.do = lambda order: (before(order), do(order))[1]
"""


@pytest.fixture
def broken(monkeypatch, here):
    """Have workers do something before some jobs: Python code in which `output` is what the job is to write.

    `once(name)` is true once, and `hold()` waits once until there is a file `go`; from then on `begun` has the
    number of its process.
    """

    def have(code):
        Path("broken").mkdir()
        Path("broken/sitecustomize.py").write_text(BROKEN.format(code), "utf-8")
        monkeypatch.setenv("PYTHONPATH", str(Path("broken").resolve()))
        monkeypatch.setattr(worker, "do", worker.do)  # which is what it is again after the test
        exec(BROKEN.format(code), {})  # for processes that are forked

    return have
