"""Which file is read, and how much of it: standard input, broken data, selected shapes."""

import gzip
import io
import json
import os
import pty
import subprocess
import sys

import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.svg.reading import walk
from shapeblend_cli.svg.xml import xmltree
from tests.support.commands import report, write

SQUARE = "M0 0H10V10H0Z"
TRIANGLE = "M0 0H10L0 10Z"


def svg(markup):
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">{markup}</svg>'


@pytest.fixture
def here(here):
    small = '<g id="few"><path id="small" class="c" d="M1 1h3v3z"/></g>'
    write(a=svg(f'<path id="big" d="{SQUARE}"/>{small}'), b=svg(f'<path d="{TRIANGLE}"/>'))
    return here


@pytest.fixture
def stdin(monkeypatch):
    """Put bytes on standard input."""

    def put(data):
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))

    return put


@pytest.mark.parametrize("pack", [bytes, gzip.compress])
@pytest.mark.parametrize("first", [True, False])
def test_a_dash_is_standard_input(here, stdin, pack, first):
    stdin(pack(svg(f'<path d="{SQUARE}"/>').encode()))
    files = ["-", "b.svg"] if first else ["b.svg", "-"]
    found = report(*files, "-n", "0", "--vertices", "0")
    assert found["inputs"] == files
    side = "vertices_a" if first else "vertices_b"
    assert len(found["pairs"][0]["contours"][0][side]) == 4


def test_standard_input_is_called_so_in_messages(here, stdin, capsys):
    stdin(b"nothing")
    assert run(["a.svg", "-"]) == 1
    assert capsys.readouterr().err.startswith("shapeblend: <stdin>: line 1: not well-formed XML")
    stdin(svg(f'<path d="{SQUARE}"/>').encode())
    assert run(["-", "b.svg", "--start", "900,0"]) == 1
    assert capsys.readouterr().err.startswith("shapeblend: <stdin> and b.svg: ")
    stdin(b"")
    assert run(["inspect", "-"]) == 1
    assert capsys.readouterr().err == "shapeblend: <stdin>: the file is empty; an SVG file would work\n"


@pytest.mark.parametrize("command", ["states - b.svg -o s.svg", "- b.svg -o s.svg --trigger click"])
def test_and_in_titles_in_words(here, stdin, command):
    stdin(svg(f'<path d="{SQUARE}"/>').encode())
    assert run(command.split()) == 0
    text = (here / "s.svg").read_text("utf-8")
    assert "<title>standard input to b</title>" in text
    assert 'aria-label="standard input to b"' in text


def test_standard_input_has_the_limit_of_a_file_and_may_not_be_closed(here, stdin, capsys, monkeypatch):
    monkeypatch.setattr(xmltree, "MAX_BYTES", 1000)
    stdin(svg(" " * 1000).encode())
    assert run(["-", "b.svg"]) == 1
    assert "larger than" in capsys.readouterr().err
    monkeypatch.setattr(sys, "stdin", None)
    assert run(["inspect", "-"]) == 1
    assert capsys.readouterr().err.startswith("shapeblend: <stdin>: standard input is closed")


def test_a_target_named_like_a_dash_is_no_input(here, stdin):
    stdin(svg(f'<path d="{SQUARE}"/>').encode())
    assert run(["-", "b.svg", "-n", "0", "--report", "./-"]) == 0
    assert json.loads((here / "-").read_text())["inputs"] == ["-", "b.svg"]


def test_typing_a_file_at_a_terminal(here):
    ours, theirs = pty.openpty()
    command = [sys.executable, "-m", "shapeblend_cli", "inspect", "-", "--json"]
    process = subprocess.Popen(command, cwd=here, stdin=theirs, stdout=subprocess.PIPE)
    os.close(theirs)
    os.write(ours, svg(f'<path d="{SQUARE}"/>').encode() + b"\n\x04")
    out = process.communicate(timeout=60)[0]
    os.close(ours)
    assert process.returncode == 0
    assert json.loads(out)["shapes"][0]["length"] == 40


def test_broken_data_is_drawn_up_to_the_error_on_request(here, refused, capsys):
    write(a=svg('<path id="p" d="M0 0h4v4h-4z junk"/>'))
    line = refused(["a.svg", "b.svg"], 1, "a.svg: ")
    assert line == (
        "shapeblend: a.svg: path 'p' on line 1: at character 14 of its path data: found 'junk' where a "
        "command belongs; --lenient draws what stands before it"
    )
    assert run(["a.svg", "b.svg", "--lenient"]) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert line.endswith("where a command belongs; what stands before it is drawn")
    refused(["inspect", "a.svg", "--json"], 1, "a.svg: ")
    assert run(["inspect", "a.svg", "--json", "--lenient"]) == 0
    assert json.loads(capsys.readouterr().out)["shapes"][0]["length"] == 16


def test_selected_shapes_are_blended(here):
    found = report("a.svg", "b.svg", "-n", "0", "--vertices", "0", "--select-a", "#few")
    vertices = found["pairs"][0]["contours"][0]["vertices_a"]
    assert sorted(vertices) == [[1, 1], [4, 1], [4, 4]]
    settings = found["settings"]
    assert (settings["select_a"], settings["select_b"], settings["lenient"]) == ("#few", None, False)
    settings = report("b.svg", "a.svg", "--select-b", ".c", "--lenient", "-n", "0")["settings"]
    assert (settings["select_a"], settings["select_b"], settings["lenient"]) == (None, ".c", True)


def test_inspect_lists_what_a_selector_takes_under_the_numbers_of_the_file_or_fails_in_one_line(
    here, capsys, refused
):
    assert run(["inspect", "a.svg", "--json", "--select", "#few"]) == 0
    (shape,) = json.loads(capsys.readouterr().out)["shapes"]
    assert (shape["index"], shape["id"]) == (1, "small")
    refused(["inspect", "a.svg", "--select", "#1st"], 1, "nothing in it matches '#1st'")


def test_what_is_too_much_is_refused_before_all_of_it_is_read(here, refused, monkeypatch):
    read = []
    contours_of = walk.contours_of
    monkeypatch.setattr(walk, "contours_of", lambda *given: read.append(given) or contours_of(*given))
    write(a=svg(f'<path d="{SQUARE}"/>' * 4_000))
    refused(["a.svg", "b.svg"], 1, "contours or more, and 2000 are the most that are blended; selecting some")
    assert len(read) == 2001
    assert run(["inspect", "a.svg"]) == 0


@pytest.mark.parametrize("size", ["1e-308", "1e-320", "1e-30"])
@pytest.mark.parametrize("viewbox", ["0 0 10 10", "0 0 1e-300 1e-300"])
def test_drawings_without_any_size_are_one_line(here, refused, size, viewbox):
    path = f"M0 0H{size}V{size}z"
    write(a=svg(f'<path d="{path}"/>').replace("0 0 10 10", viewbox))
    refused(["a.svg", "b.svg"], 1, "a.svg: no painted shape: 1 shape without extent")
    refused(["b.svg", "a.svg"], 1, "a.svg: no painted shape: 1 shape without extent")


def test_a_drawing_whose_width_is_next_to_nothing_has_no_box(here, capsys):
    write(a=svg(f'<path d="{SQUARE}"/>').replace('viewBox="0 0 10 10"', 'width="1e-300" height="10"'))
    assert run(["a.svg", "b.svg", "-n", "1"]) == 0
    assert capsys.readouterr().err == ""
    assert "nan" not in (here / "blend" / "frame-1.svg").read_text()
