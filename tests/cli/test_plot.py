"""`shapeblend plot` as its users run it."""

import re
import subprocess
import sys
from xml.etree import ElementTree

import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.cli.plot import KINDS

TWO = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 30 20"><path d="M0 0h4v4h-4z"/>'
    '<path d="M10 0h{0}v9h-{0}z"/></svg>'
)


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Give a folder with two files of two squares."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.svg").write_text(TWO.format(9))
    (tmp_path / "b.svg").write_text(TWO.format(12))
    return tmp_path


def test_there_is_a_module_for_every_kind(here):
    for kind in KINDS:
        assert run(["plot", kind, "a.svg", "b.svg", "--vertices", "20"]) == 0
        ElementTree.fromstring((here / f"{kind}.svg").read_text(encoding="utf-8"))
    assert sorted(path.name for path in here.iterdir()) == sorted(
        ["a.svg", "b.svg", *(f"{kind}.svg" for kind in KINDS)]
    )


@pytest.mark.parametrize("kind", KINDS)
def test_same_input_same_bytes(here, kind):
    written = []
    for name in ("one.svg", "two.svg"):
        command = [sys.executable, "-m", "shapeblend_cli", "plot", kind, "a.svg", "b.svg", "-o", name]
        subprocess.run(command, check=True, stdin=subprocess.DEVNULL)
        written.append((here / name).read_bytes())
    assert written[0] == written[1]


def test_standard_output_and_standard_input(here):
    done = subprocess.run(
        [sys.executable, "-m", "shapeblend_cli", "plot", "graph", "-", "b.svg", "-o", "-"],
        input=(here / "a.svg").read_bytes(),
        capture_output=True,
        check=True,
    )
    assert "standard input → b.svg" in done.stdout.decode("utf-8")
    assert sorted(path.name for path in here.iterdir()) == ["a.svg", "b.svg"]


def test_a_file_that_exists_stays_without_force(here, capsys):
    (here / "graph.svg").write_text("mine")
    assert run(["plot", "graph", "a.svg", "b.svg"]) == 1
    assert capsys.readouterr().err == "shapeblend: graph.svg: exists; --force replaces it\n"
    assert (here / "graph.svg").read_text() == "mine"
    assert run(["plot", "graph", "a.svg", "b.svg", "--force"]) == 0
    assert run(["plot", "graph", "a.svg", "b.svg", "-f", "-o", "a.svg"]) == 1
    assert "is an input" in capsys.readouterr().err


def test_the_largest_contour_is_drawn_unless_another_is_named(here):
    for arguments, number in (([], 1), (["--contour", "0"], 0)):
        assert run(["plot", "starts", "a.svg", "b.svg", "-f", *arguments]) == 0
        text = (here / "starts.svg").read_text(encoding="utf-8")
        assert re.search(r"contour (\d+) of A", text).group(1) == str(number)


@pytest.mark.parametrize(
    ("arguments", "status", "message"),
    [
        (["graph", "a.svg"], 2, "a plot is of two files, A.svg and B.svg; 1 given"),
        (["graph", "a.svg", "b.svg", "a.svg"], 2, "a plot is of two files, A.svg and B.svg; 3 given"),
        (["pie", "a.svg", "b.svg"], 2, "'pie' is not one of 'graph', 'surface', 'angle', 'starts'"),
        (
            ["graph", "a.svg", "b.svg", "--dot", "0,0"],
            2,
            "--dot is for angle and starts; graph shows all dots",
        ),
        (["starts", "a.svg", "b.svg", "--start", "0,0"], 2, "--start and --pin would leave one"),
        (["starts", "a.svg", "b.svg", "--pin", "0,0"], 2, "--start and --pin would leave one"),
        (
            ["graph", "a.svg", "b.svg", "--contour", "7"],
            1,
            "contour 7 of A is matched with none of B; 0, 1 would do",
        ),
        (["angle", "a.svg", "b.svg", "--dot", "0,4000"], 1, "dot 0,4000 names no vertices"),
        (["graph", "a.svg", "none.svg"], 1, "none.svg: cannot be read"),
    ],
)
def test_errors_are_one_line_and_nothing_is_written(here, capsys, arguments, status, message):
    assert run(["plot", *arguments]) == status
    said = capsys.readouterr().err
    assert message in said
    assert said.count("\n") == 1
    assert sorted(path.name for path in here.iterdir()) == ["a.svg", "b.svg"]


def test_help_lists_it(capsys):
    assert run(["--help"]) == 0
    assert re.search(r"^  plot +Draw how two files correspond", capsys.readouterr().out, re.MULTILINE)
