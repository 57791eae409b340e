"""Several drawings one after the other, and how animations run."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.cli import run
from shapeblend_cli.model import Box
from shapeblend_cli.options.settings import Settings
from tests.support.commands import contents, names, report, write
from tests.support.contours import drawing, polygon_contour
from tests.support.drawings import BAR, EYED, LEAF, svg
from tests.support.motions import blend


@pytest.fixture
def here(here):
    paths = {"a": (BAR, "#000000"), "b": (LEAF, "#ffffff"), "c": (EYED, "#ff0000")}
    write(**{k: svg(d, attributes=f'fill="{fill}" fill-rule="evenodd"') for k, (d, fill) in paths.items()})
    return here


def animations(file):
    root = ElementTree.parse(file).getroot()
    return {a.get("attributeName"): dict(a.attrib) for a in root.iter("{http://www.w3.org/2000/svg}animate")}


def test_frames_are_numbered_on_through_all_pairs(here):
    found = report("a.svg", "b.svg", "c.svg", "-n", "4", "-o", "out")
    assert names("out") == [f"frame-{k}.svg" for k in range(1, 9)]
    assert [(p["a"], p["b"]) for p in found["pairs"]] == [(0, 1), (1, 2)]
    assert [f["pair"] for f in found["frames"]] == [0] * 4 + [1] * 4
    assert [f["t"] for f in found["frames"]] == pytest.approx([0.2, 0.4, 0.6, 0.8] * 2)
    assert found["inputs"] == ["a.svg", "b.svg", "c.svg"]


def test_with_its_ends_each_drawing_is_there_once(here):
    assert run(["a.svg", "b.svg", "c.svg", "-n", "1", "--ends", "-o", "out"]) == 0
    fills = [re.search(r'fill="(#\w+)"', path.read_text())[1] for path in sorted(here.glob("out/*"))]
    assert len(fills) == 5
    assert fills[::2] == ["#000000", "#ffffff", "#ff0000"]


def test_frames_of_the_ends_are_the_drawings_nodes(here):
    assert run(["a.svg", "c.svg", "-n", "0", "--ends", "-o", "out"]) == 0
    text = (here / "out/frame-2.svg").read_text()
    assert "M2,12C6,4 18,4 22,12 18,20 6,20 2,12Z" in text
    assert 'fill-rule="evenodd"' in text


def test_one_animation_through_all(here):
    assert run(["a.svg", "b.svg", "a.svg", "-o", "x.svg", "--duration", "1.5"]) == 0
    found = animations("x.svg")
    assert set(found) == {"d", "fill"}
    fills = found["fill"]["values"].split(";")
    assert fills == fills[::-1]
    assert (fills[0], fills[len(fills) // 2]) == ("#000000", "#ffffff")
    keys = found["d"]["values"].split(";")
    assert len(keys) == 3
    assert len({re.sub(r"[\d. -]+", "", key) for key in keys}) == 1
    assert {a["dur"] for a in found.values()} == {"3s"}
    assert {a["repeatCount"] for a in found.values()} == {"indefinite"}
    assert not {"keyTimes", "calcMode", "fill"} & set(found["d"])


def test_easing_and_repetition(here):
    assert run(["a.svg", "b.svg", "-o", "x.svg", "--ease", "ease", "--repeat", "3"]) == 0
    found = animations("x.svg")["d"]
    assert (found["calcMode"], found["keyTimes"], found["keySplines"]) == ("spline", "0;1", "0.25 0.1 0.25 1")
    assert (found["repeatCount"], found["fill"]) == ("3", "freeze")
    options = ["--ease", "cubic-bezier(0.4,0,1,0.5)", "--repeat", "pingpong", "-f"]
    assert run(["a.svg", "b.svg", "-o", "x.svg", *options]) == 0
    found = animations("x.svg")["d"]
    there, again, back = found["values"].split(";")
    assert there == back != again
    assert (found["keyTimes"], found["keySplines"]) == ("0;0.5;1", "0.4 0 1 0.5;0 0.5 0.6 1")
    assert (found["dur"], found["repeatCount"]) == ("4s", "indefinite")


def test_what_cannot_be_in_between_switches_at_half_time(here):
    line = svg('<path d="M2 2L20 20" stroke="#000" stroke-linecap="butt" fill="none" stroke-width="2"/>')
    write(a=line, b=line.replace("butt", "round"))
    assert run(["a.svg", "b.svg", "-o", "x.svg"]) == 0
    found = animations("x.svg")["stroke-linecap"]
    assert (found["values"], found["keyTimes"], found["calcMode"]) == ("butt;round", "0;0.5", "discrete")


@pytest.mark.parametrize(
    "options",
    [
        *(
            "-o x",
            "-o x.svg --animate smil",
            "-o x.svg --animate css",
            "-o x.svg --animate frames",
            "-o x.json",
        ),
        *(f"-o x.{kind} -n 2 --width 50" for kind in ("png", "gif", "webp", "apng")),
    ],
)
def test_same_input_same_bytes(here, options):
    command = ["a.svg", "b.svg", "c.svg", *options.split(), "-f"]
    assert run(command) == 0
    before = contents()
    assert run(command) == 0
    assert contents() == before
    for file in here.glob("x.svg"):
        ElementTree.parse(file)
        assert "nan" not in file.read_text()


def test_precision(here):
    assert run(["a.svg", "b.svg", "-o", "x.svg", "--precision", "1"]) == 0
    assert max(len(v) for v in re.findall(r"\.(\d+)", animations("x.svg")["d"]["values"])) == 1
    assert run(["a.svg", "b.svg", "-o", "x.svg", "-f"]) == 0
    assert max(len(v) for v in re.findall(r"\.(\d+)", animations("x.svg")["d"]["values"])) == 3


@given(st.integers(-999, 999), st.integers(1, 999), st.integers(1, 99))
def test_a_viewbox_that_holds_the_drawing_is_kept_whatever_its_decimals(x, size, inset):
    viewbox = Box(x / 10, x / 10, size / 10, size / 10)
    corner = complex(viewbox.x, viewbox.y)
    square = np.array([0, 1, 1 + 1j, 1j]) * viewbox.width * (1 - inset / 100) + corner
    a = drawing(polygon_contour(square), viewbox=viewbox)
    pair, _ = blend(a, a, Settings(vertices=0, frames=0))
    for view in pair.views:
        assert view == pytest.approx(viewbox)
