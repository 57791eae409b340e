"""Shapes that start one after the other, or when a timetable says."""

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import assert_refused, points, write
from tests.support.drawings import BAR, LEAF, svg

pytestmark = pytest.mark.usefixtures("blended_once")

SVG = "{http://www.w3.org/2000/svg}"


def three(shift, fill="#000000"):
    """Three squares beside each other, the right one lowest in paint order, the middle one largest."""
    boxes = ((20, 4), (8, 6), (0, 3))
    return svg(
        *(f'<path d="M{x} {2 + shift}h{side}v{side}h{-side}z" fill="{fill}"/>' for x, side in boxes),
        viewbox="0 0 30 30",
    )


def starts(*options):
    """When each square has begun to move, of 20 frames: 0 by then, counted in frames; in the order of the file."""
    write(a=three(0), b=three(12))
    assert (
        run(["a.svg", "b.svg", "-n", "19", "--ends", "-o", "f", "-f", "-q", "--motion", "linear", *options])
        == 0
    )
    tops = []
    for file in sorted(Path("f").iterdir()):
        paths = ElementTree.parse(file).getroot().findall(f"{SVG}path")
        tops.append([points(path.get("d")).imag.min() for path in paths])
    found = []
    for square in zip(*tops, strict=True):
        moving = [k for k, top in enumerate(square) if 2.01 < top < 13.99]
        found.append((moving[0] - 1, moving[-1] + 1))
    return found


def test_without_it_all_start_at_once(here):
    assert starts() == [(0, 20)] * 3


@pytest.mark.parametrize(
    ("by", "first", "last"),
    [("order", 0, 2), ("left", 2, 0), ("right", 0, 2), ("size", 1, 2), (None, 0, 2)],
)
def test_shapes_start_in_turn_and_take_equally_long(here, by, first, last):
    found = starts("--stagger", ".5", *(["--stagger-by", by] if by else []))
    assert found[first] == (0, 10)
    assert found[last] == (10, 20)
    assert sorted(found) == [(0, 10), (5, 15), (10, 20)]


@pytest.mark.parametrize("by", ["top", "bottom"])
def test_they_may_start_from_above_or_below(here, by):
    column = svg(*(f'<path d="M2 {y}h4v4h-4z"/>' for y in (2, 10, 18)))
    moved = svg(*(f'<path d="M14 {y}h4v4h-4z"/>' for y in (2, 10, 18)))
    write(a=column, b=moved)
    assert (
        run(["a.svg", "b.svg", "-n", "1", "-o", "f", "-f", "-q", "--stagger", ".6", "--stagger-by", by]) == 0
    )
    paths = ElementTree.parse("f/frame-1.svg").getroot().findall(f"{SVG}path")
    lefts = [points(path.get("d")).real.min() for path in paths]
    assert lefts == sorted(lefts, reverse=by == "top")
    assert len(set(lefts)) == 3


def test_paint_goes_with_its_shape(here):
    write(a=three(0, "#ff0000"), b=three(12, "#0000ff"))
    assert run("a.svg b.svg -n 1 -o f -q --stagger .9 --motion linear".split()) == 0
    fills = [path.get("fill") for path in ElementTree.parse("f/frame-1.svg").getroot().findall(f"{SVG}path")]
    assert fills[0] == "#0000ff"
    assert fills[2] == "#ff0000"


REFUSED = {
    "--stagger 1": "--stagger must be at most 0.95, not 1",
    "--stagger-by size": "--stagger-by sets the order of --stagger",
    "--stagger .5 --emit pair": "--stagger is for frames and what plays",
    "--timing {0} --emit pair": "--timing is for frames and what plays",
    "--timing {0} --stagger .5": "one is enough",
    "--timing {0} --mix .5,.5": "--mix makes mixtures",
    "--timing {0} -o x.svg --animate css --trigger hover": "--timing with --trigger hover needs --animate smil",
    "--stagger .5 --mix .5,.5": "--mix makes mixtures",
    "--stagger .5 -o x.svg --animate css --trigger hover": "needs --animate smil",
}


@pytest.mark.parametrize("options", REFUSED)
def test_what_cannot_be_staggered_is_refused(here, capsys, options):
    write(a=svg(BAR), b=svg(LEAF))
    table = '{"0":{"start":0.5}}'
    assert_refused(
        capsys,
        ["a.svg", "b.svg", *(word.format(table) if word == "{0}" else word for word in options.split())],
        REFUSED[options],
    )


TABLE = {"#right": {"start": 0.5}, "#pair": {"start": 0.25, "length": 0.25}, "2": {"length": 0.1}}


def named(shift):
    """The squares of `three`, the first with an id, the others in a group."""
    text = three(shift).replace("<path ", '<path id="right" ', 1)
    first, second, rest = text.split("<path ", 3)[:2], *text.split("<path ", 3)[2:]
    return (
        "<path ".join(first)
        + '<g id="pair"><path '
        + second
        + "<path "
        + rest.replace("</svg>", "</g></svg>")
    )


def test_parts_move_when_a_timetable_says(here):
    Path("timing.json").write_text(json.dumps(TABLE))
    write(a=named(0), b=named(12))
    found = {}
    for given in ("timing.json", json.dumps(TABLE)):
        options = ["--timing", given, "--motion", "linear", "-q", "-f"]
        assert run(["a.svg", "b.svg", "-n", "19", "-o", "f", *options]) == 0
        files = sorted(Path("f").iterdir())
        tops = [
            [points(path.get("d")).imag.min() for path in ElementTree.parse(file).iter(f"{SVG}path")]
            for file in files
        ]
        found[given] = [
            (moving[0], moving[-1] + 2)
            for square in zip(*tops, strict=True)
            if (moving := [k for k, top in enumerate(square) if 2.01 < top < 13.99])
        ]
    assert found["timing.json"] == [
        (10, 20),
        (5, 10),
        (0, 2),
    ]  # a part's own name counts more than its group's
    assert len({*map(tuple, found.values())}) == 1


def test_every_format_that_plays_keeps_to_a_timetable(here):
    write(a=named(0), b=named(12))
    for name in ("m.svg", "m.json", "m.xml", "m.js", "m.gif", "css.svg"):
        animate = ["--animate", "css"] if name == "css.svg" else []
        assert (
            run(
                [
                    "a.svg",
                    "b.svg",
                    "-o",
                    name,
                    "-q",
                    "--timing",
                    json.dumps(TABLE),
                    *animate,
                    "--width",
                    "30",
                ][: None if name == "m.gif" else -2]
            )
            == 0
        )
    times = re.findall(r'attributeName="d"[^>]*keyTimes="([^"]*)"', Path("m.svg").read_text())
    assert times == ["0;0.5;1", "0;0.25;0.5;1", "0;0.1;1"]
    layers = json.loads(Path("m.json").read_text())["layers"]
    frames = {layer["nm"]: [key["t"] for key in layer["shapes"][0]["it"][0]["ks"]["k"]] for layer in layers}
    assert frames["right"] == [0, 60, 120]
    lengths = re.findall(r'duration="(\d+)"', Path("m.xml").read_text())
    assert [int(length) for length in lengths] == [1000, 1000, 500, 500, 1000, 200, 1800]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('{"#lef":{"start":0.5}}', "no part is called '#lef'; #right, #pair, 0, B0, 1, B1, 2 would work"),
        ('{"7":{"start":0.5}}', "no part is called '7'"),
        ('{"0":{"start":2}}', "start of '0' is 2"),
        ('{"0":{"start":true}}', "start of '0' is True"),
        ('{"0":{"start":0.5,"length":0.6}}', "it ends at 1.1, after 1"),
        ('{"0":{"length":0}}', "nothing is left for its length"),
        ('{"0":{"begin":0.5}}', "'0' has {'begin': 0.5}"),
        ('{"0":{"start":NaN}}', "start of '0' is nan"),
        ('{"0":{},"0":{}}', "has '0' twice"),
        ("{}", "a key for each part"),
        ("{" + '"a":{' * 5000, "nested too deeply"),
        ('{"0":', "line 1"),
    ],
)
def test_what_is_no_timetable_is_said_in_a_line(here, capsys, text, words):
    write(a=named(0), b=named(12))
    assert_refused(capsys, ["a.svg", "b.svg", "--timing", text], words)
    Path("t.json").write_text(text)
    assert_refused(capsys, ["a.svg", "b.svg", "--timing", "t.json"], words)


def test_a_timetable_that_cannot_be_read_is_said(here, capsys):
    write(a=named(0), b=named(12))
    assert_refused(capsys, ["a.svg", "b.svg", "--timing", "none.json"], "none.json: cannot be read", 1)
    Path("list.json").write_text("[1]")
    assert_refused(capsys, ["a.svg", "b.svg", "--timing", "list.json"], "a key for each part")


def test_a_project_has_its_timetable_beside_it_or_in_it_and_the_api_takes_one(here):
    import shapeblend_cli

    write(a=named(0), b=named(12))
    Path("own").mkdir()
    Path("own/timing.json").write_text(json.dumps(TABLE))
    for name, timing in {"file": "timing.json", "inside": TABLE}.items():
        row = {"files": ["../a.svg", "../b.svg"], "timing": timing, "output": f"{name}.svg"}
        Path(f"own/{name}.json").write_text(json.dumps(row))
        assert run([f"own/{name}.json", "-q"]) == 0
    made = Path("own/file.svg").read_text()
    assert Path("own/inside.svg").read_text() == made
    shapeblend_cli.blend("a.svg", "b.svg", timing=TABLE).save("made.svg")
    assert Path("made.svg").read_text() == made
