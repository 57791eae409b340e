"""Which drawings make the best blend with one of them."""

import io
import json
import re
import shutil
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import contents, report, write
from tests.support.drawings import BAR, LEAF, RING, svg

pytestmark = pytest.mark.usefixtures("forked")

TURNED = "M4,0 L6,0 L6,10 L4,10 Z"


@pytest.fixture
def icons(here):
    """A drawing a.svg, and a folder of others: one of them is the same, one cannot be read."""
    Path("icons").mkdir()
    write(a=svg(BAR), **{"icons/same": svg(BAR), "icons/leaf": svg(LEAF), "icons/ring": svg(RING)})
    write(**{"icons/both": svg(f"{BAR} {TURNED}")})
    return here


@pytest.fixture
def ranked(capsys):
    """Rank, which has to succeed; the lines of JSON, and what was said beside them."""

    def do(*arguments, status=0):
        capsys.readouterr()
        assert run(["rank", *arguments, "--json"]) == status
        out, err = capsys.readouterr()
        return [json.loads(line) for line in out.splitlines()], err

    return do


def test_the_best_comes_first_and_the_same_drawing_is_perfect(icons, ranked):
    found, _ = ranked("a.svg", "icons")
    assert [each["place"] for each in found] == [1, 2, 3, 4]
    assert {each["file"] for each in found} == {f"icons/{name}.svg" for name in "same leaf ring both".split()}
    assert found[0]["file"] == "icons/same.svg"
    assert (found[0]["why"], found[0]["alone"]) == ("", 0)
    grades = [each["grade"] for each in found]
    assert grades == sorted(grades)
    assert grades[-1] > grades[0]


def test_numbers_are_those_that_a_blend_reports(icons, ranked):
    found, _ = ranked("a.svg", "icons")
    for each in found:
        contours = report("a.svg", each["file"])["pairs"][0]["contours"]
        both = [c for c in contours if c["a"] is not None and c["b"] is not None]
        assert each["work"] == pytest.approx(sum(c["work"] for c in both), abs=1e-6)
        assert each["alone"] == len(contours) - len(both)


def test_by_work_the_least_work_comes_first(icons, ranked):
    found, _ = ranked("a.svg", "icons", "--by", "work")
    works = [each["work"] for each in found]
    assert works == sorted(works)
    assert works[0] < works[-1]


def test_by_work_a_drawing_that_is_built_alike_comes_first(ranked, samples, here):
    cow, *others = (str(samples / f"{name}.svg") for name in "cow bird-1 dancer-1 deer e".split())
    found, _ = ranked(cow, *others, "--by", "work", "--top", "1")
    assert [Path(each["file"]).stem for each in found] == ["deer"]


def test_only_the_first_are_listed(icons, ranked):
    every, _ = ranked("a.svg", "icons")
    first, _ = ranked("a.svg", "icons", "--top", "2")
    assert first == every[:2]


def test_processes_do_not_change_what_is_found(icons, ranked):
    assert ranked("a.svg", "icons", "-j", "1") == ranked("a.svg", "icons", "-j", "3")


def test_a_table_has_a_row_for_each(icons, capsys):
    assert run(["rank", "a.svg", "icons"]) == 0
    head, *rows = capsys.readouterr().out.splitlines()
    assert head.split()[:5] == ["place", "grade", "work", "alone", "file"]
    assert [row.split()[0] for row in rows] == ["1", "2", "3", "4"]
    assert rows[0].split()[1:5] == ["0.00", "0", "0", "icons/same.svg"]


def test_the_first_drawing_is_not_compared_with_itself(icons, ranked):
    shutil.copy("a.svg", "icons/a.svg")
    found, _ = ranked("icons/a.svg", "./icons")
    assert len(found) == 4
    assert not any(each["file"].endswith("/a.svg") for each in found)


def test_patterns_and_files_stand_for_drawings_each_once(icons, ranked):
    found, _ = ranked("a.svg", "icons/l*.svg", "icons/ring.svg", "icons/leaf.svg")
    assert sorted(each["file"] for each in found) == ["icons/leaf.svg", "icons/ring.svg"]


def test_a_sheet_has_a_row_of_pictures_for_each(icons, ranked):
    found, _ = ranked("a.svg", "icons", "--top", "3", "--sheet", "sheet.svg")
    tree = ElementTree.parse("sheet.svg")
    words = [each.text for each in tree.iter("{http://www.w3.org/2000/svg}text")]
    images = len(list(tree.iter("{http://www.w3.org/2000/svg}image")))
    assert [line.split()[:2] for line in words] == [[str(e["place"]), e["file"]] for e in found]
    assert images == 3 * 9


def test_a_drawing_that_cannot_be_read_is_named_and_the_others_are_ranked(icons, ranked):
    Path("icons/broken.svg").write_text("<svg", "utf-8")
    found, said = ranked("a.svg", "icons", status=1)
    assert len(found) == 5
    assert found[-1]["file"] == "icons/broken.svg"
    assert "error" in found[-1]
    (line,) = said.splitlines()
    assert line.startswith("shapeblend: icons/broken.svg: ")


def test_standard_input_is_the_first_drawing(icons, ranked, monkeypatch):
    expected, _ = ranked("a.svg", "icons")
    data = Path("a.svg").read_bytes()
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))
    found, _ = ranked("-", "icons")
    assert found == expected


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        ("a.svg nowhere", 1, "nowhere: no such file or folder"),
        ("nothing.svg icons", 1, "nothing.svg: cannot be read"),
        ("a.svg a.svg", 2, "no drawings except a.svg"),
        ("a.svg empty", 2, "no drawings except a.svg"),
        ("a.svg icons --sheet a.svg -f", 1, "a.svg"),
        ("a.svg icons --sheet old.svg", 1, "old.svg"),
        ("a.svg icons --top 0", 2, "--top"),
        ("a.svg", 2, "DIR"),
    ],
)
def test_what_cannot_be_ranked_is_refused_in_a_line(icons, capsys, arguments, status, words):
    Path("empty").mkdir()
    write(old=svg(LEAF))
    before = contents()
    assert run(["rank", *arguments.split()]) == status
    out, err = capsys.readouterr()
    (line,) = err.splitlines()
    assert line.startswith("shapeblend: ")
    assert re.search(re.escape(words), line)
    assert (out, contents()) == ("", before)
