"""What other programs read: summaries, dependencies and the log."""

import json
import os
import re
import shutil
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import assert_refused

pytestmark = pytest.mark.usefixtures("forked")

NAMES = ["plain", "a b", "#1", "$HOME", "c:d", "back\\slash", "back\\ space", "(1)[2]"]
"""Names that have to be escaped."""


@pytest.fixture
def failed(drawings):
    """Run a batch whose first job is done, whose second one fails, and whose third one is not begun."""
    Path("in/9.svg").write_text("<svg/>", "utf-8")
    return lambda *more: run(["batch", "--chain", "in", "-o", "m/{n}.svg", "-j", "1", "--fail-fast", *more])


def test_junit_has_a_case_for_each_job(failed):
    assert failed("--summary", "ci/junit.xml") == 1
    root = ElementTree.parse("ci/junit.xml").getroot()
    counts = {"tests": "3", "failures": "1", "errors": "0", "skipped": "1"}
    assert root.attrib.items() >= counts.items()
    (suite,) = root
    assert suite.attrib.items() >= {"name": "--chain in", **counts}.items()
    cases = {case.get("name"): [each.tag for each in case] for case in suite}
    assert cases == {"m/1.svg": [], "m/2.svg": ["failure"], "m/3.svg": ["skipped"]}
    (failure,) = root.iter("failure")
    assert failure.get("message").startswith("in/9.svg: ")
    assert failure.text == f"--chain, in/2.svg and in/9.svg: {failure.get('message')}"


def test_json_has_the_counts_and_the_results(failed):
    for _ in range(2):
        assert failed("--summary", "s.json", "--results", "r.jsonl") == 1
    found = json.loads(Path("s.json").read_text("utf-8"))
    counts = {
        "jobs": 3,
        "done": 0,
        "cached": 0,
        "current": 1,
        "failed": 1,
        "timeout": 0,
        "died": 0,
        "left": 1,
    }
    assert found.items() >= {"batch": "--chain in", "error": None, **counts}.items()
    assert found["results"] == [
        json.loads(each) for each in Path("r.jsonl").read_text("utf-8").splitlines()[-2:]
    ]


def test_a_batch_that_ends_with_an_error_has_no_clean_summary(drawings, monkeypatch):
    monkeypatch.setattr("shapeblend_cli.system.processes.START", "raise SystemExit(3)")
    for file in ("s.xml", "s.json"):
        assert run(["batch", "--chain", "in", "--summary", file]) == 1
    (error,) = ElementTree.parse("s.xml").iter("error")
    assert "do not start" in error.get("message")
    assert json.loads(Path("s.json").read_text("utf-8"))["error"] == error.get("message")


def test_characters_that_xml_cannot_have(drawings):
    Path("jobs.jsonl").write_text(r'{"a": "in/1.svg", "b": "\u0001\udcff.svg", "o": "\u0001.svg"}', "utf-8")
    assert run(["batch", "jobs.jsonl", "--summary", "s.xml"]) == 1
    (case,) = ElementTree.parse("s.xml").iter("testcase")
    assert case.get("name") == "\ufffd.svg"


def test_the_log_has_all_messages_of_all_runs(failed, capsys):
    assert failed("--log-file", "log", "-q") == failed("--log-file", "log") == 1
    lines = Path("log").read_text("utf-8").splitlines()
    assert all(re.match(r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d shapeblend: ", line) for line in lines)
    assert len(lines) == 6
    assert lines[0][20:] == lines[3][20:] == "shapeblend: --chain in: 3 jobs"
    printed = capsys.readouterr().err.splitlines()
    assert printed == [line[20:] for line in (lines[1], *lines[4:])]


def test_names_that_are_not_utf8(drawings):
    name = os.fsdecode(b"in/\xff.svg")
    Path(name).write_text("<svg/>", "utf-8")
    Path("jobs.jsonl").write_text(json.dumps({"a": name, "b": "in/1.svg", "o": "x.svg"}), "utf-8")
    line = "batch jobs.jsonl --summary s.xml --log-file log --depfile x.d --results r.jsonl"
    assert run(line.split()) == 1
    assert b"x.svg: in/\xff.svg in/1.svg\n" in Path("x.d").read_bytes()
    assert "in/\\udcff.svg: " in Path("log").read_text("utf-8")
    (failure,) = ElementTree.parse("s.xml").iter("failure")
    assert failure.get("message").startswith("in/\ufffd.svg: ")


@pytest.fixture
def escaped(drawings):
    """A batch whose names have to be escaped, and the names."""
    for name in NAMES:
        shutil.copy("in/1.svg", f"in/{name}.svg")
    rows = [{"a": f"in/{name}.svg", "b": "in/2.svg", "o": f"./m/{name}.svg"} for name in NAMES]
    Path("jobs.jsonl").write_text("\n".join(map(json.dumps, rows)), "utf-8")
    assert run(["batch", "jobs.jsonl", "--depfile", "m/batch.d"]) == 0
    return NAMES


@pytest.mark.skipif(shutil.which("make") is None, reason="needs make")
def test_make_reads_the_dependencies(escaped):
    Path("Makefile").write_text("include m/batch.d\n%.svg:\n\t@echo made\n", "utf-8")

    def made(name):
        command = ["make", "-f", "Makefile", f"m/{name}.svg"]
        return "made" in subprocess.run(command, capture_output=True, check=True, text=True).stdout

    assert not any(map(made, escaped))
    for name in escaped:
        os.utime(f"in/{name}.svg", (2**32, 2**32))
        assert made(name)
    Path("in/plain.svg").unlink()  # as whoever takes it out of the manifest does
    assert made("plain")


@pytest.mark.skipif(shutil.which("ninja") is None, reason="needs ninja")
def test_ninja_reads_the_dependencies(escaped):
    outputs = " ".join(re.sub("([$: ])", r"$\1", f"m/{name}.svg") for name in escaped)
    rule = "rule batch\n command = cp kept.d m/batch.d && touch m/*\n depfile = m/batch.d\n"
    Path("build.ninja").write_text(f"{rule}build {outputs}: batch\n", "utf-8")
    shutil.copy("m/batch.d", "kept.d")

    def made():
        done = subprocess.run(["ninja", "-v"], capture_output=True, check=True, text=True)
        return "no work to do" not in done.stdout

    assert made()
    assert not made()
    for later, name in enumerate(escaped, 2**32):
        os.utime(f"in/{name}.svg", (later, later))
        assert made()
        os.utime(f"in/{name}.svg", (0, 0))
        assert not made()


def test_names_that_a_file_of_dependencies_cannot_have(drawings, capsys):
    shutil.copy("in/1.svg", "in/a;b.svg")
    assert_refused(
        capsys, ["batch", "--chain", "in", "--depfile", "x.d"], "cannot read the name 'blend/10-a;b/"
    )
