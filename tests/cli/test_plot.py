"""`shapeblend plot` as its users run it."""

import re
from xml.etree import ElementTree

import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.cli.plot import KINDS
from tests.support.commands import names, process, write

TWO = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 30 20"><path d="M0 0h4v4h-4z"/>'
    '<path d="M10 0h{0}v9h-{0}z"/></svg>'
)


@pytest.fixture
def here(here):
    """A folder with two files of two squares."""
    write(a=TWO.format(9), b=TWO.format(12))
    return here


def test_there_is_a_module_for_every_kind(here):
    for kind in KINDS:
        assert run(["plot", kind, "a.svg", "b.svg", "--vertices", "20"]) == 0
        ElementTree.fromstring((here / f"{kind}.svg").read_text(encoding="utf-8"))
    assert names() == sorted(["a.svg", "b.svg", *(f"{kind}.svg" for kind in KINDS)])


@pytest.mark.parametrize("kind", KINDS)
def test_same_input_same_bytes(here, kind):
    """In two processes: what has an order by chance has another one there."""
    printed = process("plot", kind, "a.svg", "b.svg", "-o", "-").stdout
    assert run(["plot", kind, "a.svg", "b.svg"]) == 0
    assert (here / f"{kind}.svg").read_bytes() == printed


def test_standard_output_and_standard_input(here):
    done = process("plot", "graph", "-", "b.svg", "-o", "-", stdin=(here / "a.svg").read_bytes())
    assert "standard input → b.svg" in done.stdout.decode("utf-8")
    assert names() == ["a.svg", "b.svg"]


def test_a_file_that_exists_stays_without_force(here, refused):
    (here / "graph.svg").write_text("mine")
    refused(["plot", "graph", "a.svg", "b.svg"], 1, "shapeblend: graph.svg: exists; --force replaces it")
    assert run(["plot", "graph", "a.svg", "b.svg", "--force"]) == 0
    refused(["plot", "graph", "a.svg", "b.svg", "-f", "-o", "a.svg"], 1, "is an input")


def test_the_largest_contour_is_drawn_unless_another_is_named(here):
    for arguments, number in (([], 1), (["--contour", "0"], 0)):
        assert run(["plot", "graph", "a.svg", "b.svg", "-f", *arguments]) == 0
        text = (here / "graph.svg").read_text(encoding="utf-8")
        assert re.search(r"contour (\d+) of A", text).group(1) == str(number)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("graph a.svg b.svg --contour 7", "contour 7 of A has no partner in B; 0, 1 would work"),
        ("angle a.svg b.svg --dot 0,4000", "dot 0,4000 names no vertices"),
        ("graph a.svg none.svg", "none.svg: cannot be read"),
    ],
)
def test_errors_are_one_line_and_nothing_is_written(here, refused, arguments, message):
    refused(["plot", *arguments.split()], 1, message)
