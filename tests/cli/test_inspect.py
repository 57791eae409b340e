"""The table of `inspect`: for people on a terminal, for grep and cut elsewhere."""

import json
import os
import re
import subprocess
import sys
from xml.etree import ElementTree

import numpy as np
import pytest

from shapeblend_cli.cli import run
from tests.support.commands import process, read_to, start_on_terminal, write
from tests.support.drawings import svg

DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 20">'
    '<rect id="{name}" x="1.5" width="4" height="2" fill="#123456"/>'
    '<path d="M0 0H3M1 1H2" stroke="red" fill="none" fill-rule="evenodd"/></svg>'
)


@pytest.fixture
def file(here):
    write(a=DRAWING.format(name="r"))
    return here / "a.svg"


def inspected(capsys):
    assert run(["inspect", "a.svg", "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def on_a_terminal(file, columns=80, **environment):
    """Return what a terminal of so many columns gets."""
    command = [sys.executable, "-m", "shapeblend_cli", "inspect", file.name]
    settings = {**os.environ, "COLUMNS": str(columns), "TERM": "xterm-256color", **environment}
    process, terminal = start_on_terminal(command, env=settings)
    seen = read_to(terminal)
    os.close(terminal)
    assert process.wait(timeout=60) == 0
    return seen.decode()


def test_json_and_table_of_transformed_shapes(here, capsys):
    write(
        a='<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 20">'
        '<g transform="translate(5 5)" fill="#123456">'
        '<rect id="r" width="4" height="2"/><path d="M0 0H3" stroke="red" fill="none"/></g></svg>'
    )
    assert inspected(capsys) == {
        "file": "a.svg",
        "viewbox": [0, 0, 20, 20],
        "shapes": [
            {
                "index": 0, "id": "r", "element": "rect", "contours": 1, "closed": True,
                "length": pytest.approx(12), "bbox": pytest.approx([5, 5, 9, 7]), "first_contour": 0, "blended": 1,
                "fill": "#123456", "stroke": None, "fill_rule": "nonzero", "pen_lines": [],
            },
            {
                "index": 1, "id": None, "element": "path", "contours": 1, "closed": False,
                "length": pytest.approx(3), "bbox": pytest.approx([5, 5, 8, 5]), "first_contour": 1, "blended": 1,
                "fill": None, "stroke": "#ff0000", "fill_rule": "nonzero",
                "pen_lines": [{"name": "1", "width": 1.0, "closed": False, "cap": "butt"}],
            },
        ],
    }  # fmt: skip
    assert run(["inspect", "a.svg"]) == 0
    text = capsys.readouterr().out
    assert "rect" in text
    assert "#123456" in text


def test_columns_are_aligned_and_every_cell_is_one_word(file, capsys):
    assert run(["inspect", "a.svg"]) == 0
    assert capsys.readouterr().out == (
        "a.svg: viewBox 0 0 20 20, 2 pen lines\n"
        "shape  element  id  contours  ends    length  box          fill     stroke   rule     numbers\n"
        "0      rect     r   1         closed  12      1.5,0,5.5,2  #123456  none     nonzero  0\n"
        "1      path     -   2         open    4       0,0,3,1      none     #ff0000  evenodd  1-2\n"
    )


def test_length_and_box_of_straight_and_curved_pieces_together(file, capsys):
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10a5 5 0 0 1 0 10h-10zM3 3h2M1 1C1 9 4 9 4 1"/></svg>'
    )
    (shape,) = inspected(capsys)["shapes"]
    t = np.linspace(0, 1, 20001)
    curve = np.polynomial.Polynomial([1 + 1j, 24j, 9 - 24j, -6])(t)
    total = 30 + 5 * np.pi + 2 + np.abs(np.diff(curve)).sum()
    assert shape["length"] == pytest.approx(total, rel=1e-5)
    assert shape["bbox"] == pytest.approx([0, 0, 15, 10], abs=1e-4)
    assert (shape["contours"], shape["closed"]) == (3, False)


@pytest.mark.parametrize("count", [1, 3000])
def test_curves_are_measured_in_slices(file, capsys, count):
    file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0{"q1 2 2 0" * count}"/></svg>')
    (shape,) = inspected(capsys)["shapes"]
    assert shape["length"] == pytest.approx(count * 2.9578857, rel=1e-6)
    assert shape["bbox"] == pytest.approx([0, 0, 2 * count, 1])


@pytest.mark.parametrize("name", ["n" * 59, "n" * 900])
def test_nothing_is_cut_and_one_long_id_widens_no_other_line(file, capsys, name):
    file.write_text(DRAWING.format(name=name))
    assert run(["inspect", "a.svg"]) == 0
    _, head, first, second = capsys.readouterr().out.splitlines()
    assert first.split()[2] == name
    assert len(first) > len(name)
    assert len(second) < 150
    assert head.index("contours") == second.index("2  ")


@pytest.mark.parametrize("variable", ["FORCE_COLOR", "COLUMNS"])
def test_a_pipe_gets_no_colours_and_no_line_breaks(file, variable):
    shown = process("inspect", "a.svg", **{variable: "20"}).stdout
    assert b"\x1b" not in shown
    assert len(shown.splitlines()) == 4


def test_rich_is_imported_for_terminals_alone(file):
    code = (
        "import sys; from shapeblend_cli.cli import run; run(sys.argv[1:]); "
        "print(*(name for name in ('rich', 'json') if name in sys.modules), file=sys.stderr)"
    )
    for arguments in (["inspect", "a.svg"], ["a.svg", "a.svg", "-o", "out"]):
        done = subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, check=True)
        assert done.stderr.splitlines()[-1] == b""


def test_a_terminal_gets_colours_within_its_width(file):
    seen = on_a_terminal(file)
    assert "\x1b[" in seen
    assert "#123456" in seen
    plain = on_a_terminal(file, NO_COLOR="1", TERM="dumb")
    assert "\x1b[3" not in plain
    assert max(map(len, plain.splitlines())) <= 80
    rows = [line.split() for line in plain.splitlines()[2:4]]
    assert [(*row[:2], row[3]) for row in rows] == [("0", "rect", "0"), ("1", "path", "1-2")]


def test_ids_are_no_markup(file):
    file.write_text(DRAWING.format(name="[red]x[/red]:smile:"))
    assert "[red]x[/red]:smile:" in on_a_terminal(file, columns=200)


def test_an_id_that_the_terminal_cannot_show(file):
    file.write_text(DRAWING.format(name="\N{SNOWMAN}"), encoding="utf-8")
    assert rb"\u2603" in process("inspect", "a.svg", PYTHONIOENCODING="ascii").stdout


def test_wide_characters_take_two_columns(file, capsys):
    file.write_text(DRAWING.format(name="\N{CJK UNIFIED IDEOGRAPH-7FBD}"), encoding="utf-8")
    assert run(["inspect", "a.svg"]) == 0
    _, _, first, second = capsys.readouterr().out.splitlines()
    assert first.index("closed") == second.index("open") - 1


def labels(file):
    """The numbers in a picture, and where they stand."""
    root = ElementTree.parse(file).getroot()
    texts = [each for each in root.iter() if each.tag.endswith("text") and "number" in each.get("class")]
    return {int(each.text): (float(each.get("x")), float(each.get("y"))) for each in texts}


def test_a_picture_has_every_contour_with_its_number(here):
    circle = "M12 8A4 4 0 1 0 12 16A4 4 0 1 0 12 8Z"
    write(
        a=svg(
            f"M1 1H23V23H1Z {circle}",
            "M2 2L22 2",
            "M3 20h1v1h-1z",
            attributes='fill-rule="evenodd" stroke="red"',
        )
    )
    assert run(["inspect", "a.svg", "--picture", "numbers.svg"]) == 0
    found = labels("numbers.svg")
    assert set(found) == {0, 1, 2, 3}
    assert (here / "numbers.svg").read_text().count('class="outline') == 4
    # Numbers are apart, and the square's is not in its hole, but where a point names it.
    places = np.array([complex(*place) for place in found.values()])
    assert np.abs(places[:, None] - places + 99.0 * np.eye(4)).min() > 12
    width = float(ElementTree.parse("numbers.svg").getroot().get("width"))
    centre = complex(*found[1])
    assert abs(centre.real - width / 2) < 4 / 24 * 720
    assert abs(complex(*found[0]) - centre) > 4 / 24 * 720


def test_a_picture_replaces_no_file_unasked(file, capsys):
    for name in ("a.svg", "there.svg"):
        (file.parent / "there.svg").write_text("mine")
        assert run(["inspect", "a.svg", "--picture", name]) == 1
        assert name in capsys.readouterr().err
    assert (file.parent / "there.svg").read_text() == "mine"
    assert run(["inspect", "a.svg", "--picture", "there.svg", "--force"]) == 0
    assert labels("there.svg").keys() == {0, 1, 2}
    assert run(["inspect", "a.svg", "--picture", "there.png"]) == 2
    assert "--picture must be a file name ending in .svg" in capsys.readouterr().err


def test_lines_of_filled_shapes_are_named_and_drawn(here, capsys):
    bars = "M4 11H20V13H4Z", "M11 4H13V11H20V13H13V20H11V13H4V11H11Z"
    write(a=svg(*(f'<path d="{d}"/>' for d in bars), viewbox="0 0 24 24"))
    assert run(["inspect", "a.svg", "--picture", "n.svg"]) == 0
    title, heading, *rows = capsys.readouterr().out.splitlines()
    assert title.endswith("3 pen lines")
    assert [line.split()[-1] for line in (heading, *rows)] == ["lines", "0", "1.1,1.2"]
    words = re.findall(r'class="number[^>]*>([^<]*)<', (here / "n.svg").read_text())
    assert sorted(words) == ["0", "1.1", "1.2"]
