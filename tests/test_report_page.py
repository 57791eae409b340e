"""docs/report.md and docs/batch.md have every field that there is, with its type, and no other."""

import json
import re
from pathlib import Path

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import write
from tests.support.drawings import BAR, LEAF, svg

DOCS = Path(__file__).parents[1] / "docs"

HOLDS = {
    "number": lambda value: isinstance(value, int | float) and not isinstance(value, bool),
    "text": lambda value: isinstance(value, str),
    "null": lambda value: value is None,
    "true or false": lambda value: isinstance(value, bool),
    "object": lambda value: isinstance(value, dict),
    "list": lambda value: isinstance(value, list),
    "list of text": lambda value: isinstance(value, list) and all(isinstance(each, str) for each in value),
    "list of number": lambda value: all(isinstance(each, float) for each in value),
    "`[i, j]`": lambda value: [type(each) for each in value] == [int, int],
    "list of `[i, j]`": lambda value: all([type(each) for each in pair] == [int, int] for pair in value),
    "list of `[x, y]`": lambda value: all([type(each) for each in pair] == [float, float] for pair in value),
}


def tables(page):
    """Return a dictionary of field to the names of its types for each table of fields of a page."""
    text = (DOCS / page).read_text(encoding="utf-8")
    found = []
    for block in re.findall(
        r"^\| field \| type \| what it is \|\n\| --- .*\n((?:\|.*\n)+)", text, re.MULTILINE
    ):
        rows = [re.split(r" \| ", line.strip("| "), maxsplit=2) for line in block.splitlines()]
        found.append({name: kinds for names, kinds, _ in rows for name in re.findall(r"`(\w+)`", names)})
    return found


def is_of(value, kinds):
    names = [kinds] if kinds in HOLDS else kinds.split(" or ")
    return any(HOLDS[name](value) for name in names)


def check(objects, table, may_lack=()):
    assert objects
    for one in objects:
        assert {*one} | {*may_lack} == {*table}
        for name, value in one.items():
            assert is_of(value, table[name]), (name, value)


@pytest.fixture
def drawings(here):
    write(a=svg(BAR, LEAF), b=svg(LEAF))


def test_the_report_has_these_fields(drawings):
    assert run(["a.svg", "b.svg", "--report", "report.json", "-q"]) == 0
    report = json.loads(Path("report.json").read_text(encoding="utf-8"))
    whole, pair, contour, frame, _ = tables("report.md")
    contours = [each for one in report["pairs"] for each in one["contours"]]
    assert {each["b"] is None for each in contours} == {True, False}
    for objects, table in (
        ([report], whole),
        (report["pairs"], pair),
        (contours, contour),
        (report["frames"], frame),
    ):
        check(objects, table)


def test_inspect_has_these_fields(drawings, capsys):
    assert run(["inspect", "--json", "a.svg"]) == 0
    check(json.loads(capsys.readouterr().out)["shapes"], tables("report.md")[-1])


def test_the_results_of_a_batch_have_these_fields(drawings):
    write(c=svg(LEAF))
    rows = [{"files": ["a.svg", "b.svg", "c.svg"]}, {"a": "a.svg", "b": "gone.svg"}]
    Path("jobs.jsonl").write_text("\n".join(map(json.dumps, rows)), encoding="utf-8")
    assert run(["batch", "jobs.jsonl", "-o", "out/{n}.svg", "--results", "results.jsonl", "-q"]) == 1
    results = [json.loads(line) for line in Path("results.jsonl").read_text(encoding="utf-8").splitlines()]
    assert sorted(one["status"] for one in results) == ["done", "failed"]
    (table,) = tables("batch.md")
    check(results, table, may_lack=["more"])
    assert sum("more" in one for one in results) == 1
