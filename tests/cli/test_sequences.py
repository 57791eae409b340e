"""Several drawings one after the other, and how animations run."""

import json
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.cli import run
from shapeblend_cli.model import Box
from shapeblend_cli.pipeline import blend
from shapeblend_cli.settings import Settings
from tests.support.contours import drawing, polygon_contour
from tests.support.drawings import BAR, EYED, LEAF, svg

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, path, fill in (("a", BAR, "#000000"), ("b", LEAF, "#ffffff"), ("c", EYED, "#ff0000")):
        (tmp_path / f"{name}.svg").write_text(svg(path, attributes=f'fill="{fill}" fill-rule="evenodd"'))
    return tmp_path


def animations(file):
    root = ElementTree.parse(file).getroot()
    return {a.get("attributeName"): dict(a.attrib) for a in root.iter(SVG + "animate")}


def test_frames_are_numbered_on_through_all_pairs(here):
    assert run(["a.svg", "b.svg", "c.svg", "-n", "4", "-o", "out", "--report", "r.json"]) == 0
    assert [p.name for p in sorted((here / "out").iterdir())] == [f"frame-{k}.svg" for k in range(1, 9)]
    report = json.loads((here / "r.json").read_text())
    assert [(p["a"], p["b"]) for p in report["pairs"]] == [(0, 1), (1, 2)]
    assert [f["pair"] for f in report["frames"]] == [0] * 4 + [1] * 4
    assert [f["t"] for f in report["frames"]] == pytest.approx([0.2, 0.4, 0.6, 0.8] * 2)
    assert report["inputs"] == ["a.svg", "b.svg", "c.svg"]


def test_with_its_ends_each_drawing_is_there_once(here):
    assert run(["a.svg", "b.svg", "c.svg", "-n", "1", "--ends", "-o", "out"]) == 0
    fills = [
        re.search(r'fill="(#\w+)"', path.read_text())[1] for path in sorted((here / "out").glob("*.svg"))
    ]
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
    for name, cap in (("a", "butt"), ("b", "round")):
        (here / f"{name}.svg").write_text(
            svg(f'<path d="M2 2L20 20" stroke="#000" stroke-linecap="{cap}" fill="none" stroke-width="2"/>')
        )
    assert run(["a.svg", "b.svg", "-o", "x.svg"]) == 0
    found = animations("x.svg")["stroke-linecap"]
    assert (found["values"], found["keyTimes"], found["calcMode"]) == ("butt;round", "0;0.5", "discrete")


def test_same_input_same_bytes(here):
    for method in ("smil", "css", "frames"):
        for name in ("x.svg", "y.svg"):
            assert run(["a.svg", "b.svg", "c.svg", "-o", name, "-f", "--animate", method]) == 0
        text = (here / "x.svg").read_text()
        assert text == (here / "y.svg").read_text()
        ElementTree.fromstring(text)
        assert "nan" not in text


def test_precision(here):
    assert run(["a.svg", "b.svg", "-o", "x.svg", "--precision", "1"]) == 0
    assert max(len(v) for v in re.findall(r"\.(\d+)", animations("x.svg")["d"]["values"])) == 1
    assert run(["a.svg", "b.svg", "-o", "x.svg", "-f"]) == 0
    assert max(len(v) for v in re.findall(r"\.(\d+)", animations("x.svg")["d"]["values"])) == 3


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--ease", "easy"], "must be linear, ease, ease-in"),
        (["--ease", "cubic-bezier(0,2,1,1)"], "between 0 and 1"),
        (["--repeat", "0"], "a number from 1"),
        (["--repeat", "often"], "pingpong"),
        (["--duration", "0"], "--duration"),
        (["--precision", "11"], "--precision"),
        (["c.svg", "--match", "0=0"], "are about two files; 3 given"),
        (["-", "-"], "one of the files"),
        (["--motion", "curly"], "linear"),
    ],
)
def test_usage_errors(here, capsys, arguments, words):
    assert run(["a.svg", "b.svg", *arguments]) == 2
    said = capsys.readouterr().err
    assert words in said
    assert said.count("\n") == 1


@given(st.integers(-999, 999), st.integers(1, 999), st.integers(1, 99))
def test_a_viewbox_that_holds_the_drawing_is_kept_whatever_its_decimals(x, size, inset):
    viewbox = Box(x / 10, x / 10, size / 10, size / 10)
    corner = complex(viewbox.x, viewbox.y)
    square = np.array([0, 1, 1 + 1j, 1j]) * viewbox.width * (1 - inset / 100) + corner
    a = drawing(polygon_contour(square), viewbox=viewbox)
    pair, _ = blend(a, a, Settings(vertices=0, frames=0))
    for view in pair.views:
        assert view == pytest.approx(viewbox)
