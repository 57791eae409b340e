"""`currentColor`, the text colour of a page: what all drawings leave to the page, a blend leaves to it, too."""

import re
from pathlib import Path

import pytest

import shapeblend_cli as sb
from shapeblend_cli.cli import run
from tests.support.commands import write
from tests.support.drawings import svg

pytestmark = pytest.mark.usefixtures("blended_once")

BARS = '<path d="M4 5h16"/><path d="M4 12h16"/><path d="M4 19h16"/>'
CROSS = '<path d="M18 6 6 18"/><path d="m6 6 12 12"/>'
PEN = 'fill="none" stroke="{}" stroke-width="2" stroke-linecap="round"'
SOLID, RING = '<path d="M4 4h16v16h-16z"/>', '<path d="M12 2 22 12 12 22 2 12z"/>'
OUTPUTS = {
    "frames": ["-o", "out", "-n", "2", "--ends"],
    "smil": ["-o", "out.svg"],
    "css": ["-o", "out.svg", "--animate", "css"],
    "frames in turn": ["-o", "out.svg", "--animate", "frames"],
    "hover": ["-o", "out.svg", "--trigger", "hover"],
    "hover by css": ["-o", "out.svg", "--trigger", "hover", "--animate", "css"],
    "layers": ["-o", "out.svg", "--emit", "layers", "--ends"],
    "a pair": ["-o", "out", "--emit", "pair"],
    "a module": ["-o", "out.js"],
    "a mixture": ["-o", "out.svg", "--mix", "0.5,0.5"],
    "A's paint": ["-o", "out", "--style", "a"],
}
LOST = "currentColor is black wherever only one of the drawings has it"


def written(*options, command=(), files=("a.svg", "b.svg")):
    """The text of all files that a run writes; ids that are made of what is drawn are the same."""
    assert run([*command, *files, *options, "-f", "--vertices", "24"]) == 0
    out = Path(options[options.index("-o") + 1])
    parts = sorted(out.iterdir()) if out.is_dir() else [out]
    return re.sub(r"\b[bs][0-9a-f]{8}", "own", "".join(part.read_text() for part in parts))


def painted(markup, attributes):
    return svg(f"<g {attributes}>{markup}</g>")


def drawings(a, b, attributes=PEN, markup=(BARS, CROSS)):
    write(a=painted(markup[0], attributes.format(a)), b=painted(markup[1], attributes.format(b)))


@pytest.mark.parametrize("options", OUTPUTS.values(), ids=OUTPUTS)
@pytest.mark.parametrize(
    ("attributes", "markup"),
    [(PEN, (BARS, CROSS)), ('fill="{}"', (SOLID, RING)), (PEN, (BARS, SOLID))],
    ids=["strokes", "fills", "lines and a ring"],
)
def test_it_stays_in_all_that_a_page_may_hold(here, options, attributes, markup):
    drawings("#000", "#000", attributes, markup)
    black = written(*options)
    drawings("currentColor", "currentcolor", attributes, markup)
    assert written(*options) == black.replace("#000000", "currentColor") != black


def graded(path, stops, kind="linear", colour="currentColor"):
    """A drawing that is filled with a gradient of such stops: colours, and an opacity."""
    written = "".join(
        f'<stop offset="{k / max(len(stops) - 1, 1)}" stop-color="{stop or colour}" stop-opacity="{1 - 0.4 * k}"/>'
        for k, stop in enumerate(stops)
    )
    return svg(f'<{kind}Gradient id="g">{written}</{kind}Gradient><path d="{path}" fill="url(#g)"/>')


@pytest.mark.parametrize("options", OUTPUTS.values(), ids=OUTPUTS)
@pytest.mark.parametrize("stops", [("", ""), ("", "red")], ids=["all stops", "one stop"])
def test_it_stays_in_gradients(here, capsys, options, stops):
    both = "M4 4h16v16h-16z", "M12 2 22 12 12 22 2 12z"
    found = []
    for colour in ("#000000", "currentColor"):
        a, b = (graded(path, stops, colour=colour) for path in both)
        write(a=a, b=b)
        found.append(written(*options))
    assert found[1] == found[0].replace("#000000", "currentColor")
    assert "currentColor" in found[1]
    assert LOST not in capsys.readouterr().err


@pytest.mark.parametrize(
    ("a", "b", "stays"),
    [
        (("", ""), SOLID.replace("/>", ' fill="currentColor"/>'), True),
        (("", "red"), SOLID.replace("/>", ' fill="currentColor"/>'), False),
        (("", "red"), ("red", ""), False),
        (("", "red"), ("", "blue"), True),
        (("", ""), ("red", "red"), False),
        (("", ""), ("", "", ""), True),
        (("", "red"), ("", "red", "red"), False),
    ],
)
def test_in_gradients_it_stays_where_it_does_not_mix(here, capsys, a, b, stays):
    path = "M4 4h16v16h-16z"
    a, b = (graded(path, each) if isinstance(each, tuple) else svg(each) for each in (a, b))
    write(a=a, b=b)
    text = written("-o", "out", "-n", "1", "--ends")
    assert ("currentColor" in text) == stays
    assert capsys.readouterr().err.count(LOST) == (not stays)


def test_a_gradient_of_one_colour_is_that_of_the_page(here):
    write(a=graded("M4 4h16v16h-16z", ("",)), b=svg(RING.replace("/>", ' fill="currentColor"/>')))
    assert written("-o", "out", "-n", "1", "--ends").count('fill="currentColor"') == 3


def test_gradients_of_two_kinds_dissolve_with_it(here):
    write(a=graded("M4 4h16v16h-16z", ("", "")), b=graded("M4 4h16v16h-16z", ("", ""), kind="radial"))
    assert written("-o", "out", "-n", "1").count('stop-color="currentColor"') == 4


@pytest.mark.parametrize("out", ["states.svg", "states.js"])
def test_it_stays_in_states(here, out):
    drawings("#000", "#000")
    black = written("-o", out, command=["states"])
    drawings("currentColor", "currentColor")
    assert written("-o", out, command=["states"]) == black.replace("#000000", "currentColor") != black


@pytest.mark.parametrize(
    "options", [["-o", "out.json"], ["-o", "out.xml", "--emit", "avd"]], ids=["lottie", "avd"]
)
def test_without_a_page_it_is_black(here, capsys, options):
    drawings("#000", "#000")
    black = written(*options)
    drawings("currentColor", "currentColor")
    assert written(*options) == black
    drawings("currentColor", "#f00")
    written(*options)
    assert "currentColor" not in capsys.readouterr().err


def test_what_only_one_drawing_has_is_black_with_one_note(here, capsys):
    drawings("#000", "#f00")
    black = written("-o", "out.svg")
    capsys.readouterr()
    for a, b in (("currentColor", "#f00"), ("currentColor", "#000")):
        drawings(a, b)
        assert "currentColor" not in (text := written("-o", "out.svg"))
        assert capsys.readouterr().err.count(LOST) == 1
        assert text == black or b == "#000"


def test_what_the_file_colours_itself_is_of_that_colour(here, capsys):
    for attributes in ('color="#123456" ', 'style="color: #123456" '):
        drawings("currentColor", "currentColor", attributes + PEN)
        text = written("-o", "out.svg")
        assert "currentColor" not in text
        assert "#123456" in text
    assert "currentColor" not in capsys.readouterr().err
    drawings("currentColor", "currentColor", 'color="currentColor" ' + PEN)
    assert "currentColor" in written("-o", "out.svg")


def test_paints_of_one_icon_stay_by_themselves(here, capsys):
    dot = '<circle id="dot" cx="18" cy="6" r="3" stroke="none" fill="{}"/>'
    outline = PEN.format("currentColor")
    write(
        a=painted(f'<path id="box" d="M4 8h10v12h-10z"/>{dot.format("red")}', outline),
        b=painted(f'<path id="box" d="M6 6h10v12h-10z"/>{dot.format("blue")}', outline),
    )
    text = written("-o", "out", "--ends", "-n", "1")
    assert text.count('stroke="currentColor"') == 3
    assert "#ff0000" in text
    assert "#0000ff" in text
    assert LOST not in capsys.readouterr().err
    write(b=painted(f'<path id="box" d="M6 6h10v12h-10z"/>{dot.format("currentColor")}', outline))
    text = written("-o", "out", "--ends", "-n", "1")
    assert text.count('stroke="currentColor"') == 3
    assert 'fill="currentColor"' not in text
    assert capsys.readouterr().err.count(LOST) == 1


def test_in_a_chain_it_stays_where_all_have_it(here):
    drawings("currentColor", "currentColor", 'fill="{}"', (SOLID, RING))
    for third in ("currentColor", "#00f"):
        Path("c.svg").write_text(painted(SOLID, f'fill="{third}"'))
        text = written("-o", "out", "--ends", "-n", "1", files=("a.svg", "b.svg", "c.svg"))
        assert text.count("currentColor") == (5 if third == "currentColor" else 0)


def test_under_the_paint_of_one_drawing_that_one_counts(here, capsys):
    drawings("currentColor", "#f00", 'fill="{}"', (SOLID, RING))
    assert written("-o", "out", "--style", "a", "--ends", "-n", "1").count("currentColor") == 3
    assert "currentColor" not in written("-o", "out", "--style", "b", "--ends", "-n", "1")
    assert LOST not in capsys.readouterr().err


def test_pictures_of_the_api_have_it_and_their_shapes_a_colour(here):
    drawings("currentColor", "currentColor")
    blend = sb.blend("a.svg", "b.svg")
    for picture in (blend.frame(0.0), blend.frame(0.5), blend.frame(1.0), blend.mix(1.0, 2.0)):
        assert 'stroke="currentColor"' in picture.svg
        assert {shape.style.stroke for shape in picture.shapes} == {"#000000"}
