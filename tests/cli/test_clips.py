"""Clip paths that go along with what they clip."""

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from svgpathtools import parse_path

from shapeblend_cli.cli import run
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read
from tests.support.commands import points, write
from tests.support.drawings import svg
from tests.support.pictures import pixels

SVG = "{http://www.w3.org/2000/svg}"
ANDROID = "{http://schemas.android.com/apk/res/android}"


def clipped(region, bands=10):
    return svg(
        f'<clipPath id="c">{region}</clipPath>' if region else "",
        f'<g {"clip-path" if region else "id"}="url(#c)"><path d="M1 1H23V23H1Z" fill="#f0c000"/>'
        f'<path d="M1 {bands}H23V16H1Z" fill="#c00000"/></g>',
    )


LEFT, RIGHT = '<path d="M2 6H10V14H2Z"/>', '<path d="M10 8H22V20H10Z"/>'
LEFT_CORNERS, RIGHT_CORNERS = {2 + 6j, 10 + 6j, 10 + 14j, 2 + 14j}, {10 + 8j, 22 + 8j, 22 + 20j, 10 + 20j}


def frames(*options):
    assert run(["a.svg", "b.svg", "-o", "frames", "-f", "-q", *options]) == 0
    return [path.read_text() for path in sorted(Path("frames").iterdir())]


def regions(text):
    return [
        points(path.get("d")) for path in ElementTree.fromstring(text).findall(f".//{SVG}clipPath/{SVG}path")
    ]


def test_a_clip_moves_from_one_region_to_the_other(here):
    write(a=clipped(LEFT), b=clipped(RIGHT))
    found = frames("-n", "1", "--ends")
    boxes = []
    for text in found:
        (region,) = regions(text)  # once, for both shapes
        assert text.count('clip-path="url(#clip-1)"') == 2
        boxes.append((region.real.min(), region.imag.min(), region.real.max(), region.imag.max()))
    assert boxes[0] == (2, 6, 10, 14)
    assert boxes[1] == pytest.approx((6, 7, 16, 17))
    assert boxes[2] == (10, 8, 22, 20)


def test_frames_at_the_ends_look_like_the_drawings(here):
    write(a=clipped('<circle cx="10" cy="12" r="7"/>'), b=clipped('<path d="M4 4H22L13 22Z"/>', 6))
    for text, name in zip(frames("-n", "0", "--ends"), "ab", strict=True):
        assert np.abs(pixels(text) - pixels(Path(f"{name}.svg").read_text())).mean() < 1.0


def test_what_is_clipped_in_one_drawing_alone_opens(here):
    write(a=clipped(LEFT), b=clipped(None))
    start, middle, end = frames("-n", "1", "--ends")
    assert "clip" not in end
    assert [np.ptp(region.real) > 12 for region in regions(middle)] == [True, True]
    seen = [float((pixels(text).min(axis=2) < 128).mean()) for text in (start, middle, end)]
    assert seen == sorted(seen)
    assert seen[0] < seen[1] < seen[2]


def test_clips_in_clips_and_of_shapes_that_come(here):
    inner = '<clipPath id="d"><path d="M0 0H24V12H0Z"/></clipPath>'
    a = clipped(LEFT).replace('<path d="M1 1H', inner + '<path clip-path="url(#d)" d="M1 1H')
    write(a=a, b=clipped(RIGHT))
    (text,) = frames("-n", "1")
    nested = [e for e in ElementTree.fromstring(text).iter(f"{SVG}clipPath") if e.get("clip-path")]
    assert len(nested) == 1
    more = clipped(RIGHT).replace("</g>", '<circle cx="16" cy="14" r="9" fill="#00f"/></g>')
    write(a=clipped(LEFT), b=more)
    assert frames("-n", "1")[0].count("clip-path=") == 3


def test_a_region_without_area_does_not_stop_a_blend(here):
    write(a=clipped('<path d="M2 6H10"/>'), b=clipped(RIGHT))
    (text,) = frames("-n", "1")
    assert len(regions(text)) == 1


def test_what_has_no_clips_says_so(here, capsys):
    write(a=clipped(LEFT), b=clipped(RIGHT))
    assert run("a.svg b.svg --emit pair".split()) == 0
    assert "clip paths are left out of --emit pair" in capsys.readouterr().err


@pytest.mark.parametrize(("suffix", "where"), [("json", "Lottie"), ("xml", "Android")])
def test_other_programs_have_clips_of_one_outline(here, capsys, suffix, where):
    write(a=clipped(LEFT), b=clipped(RIGHT))
    assert run(f"a.svg b.svg -o one.{suffix}".split()) == 0
    assert capsys.readouterr().err == ""
    write(a=clipped(LEFT + RIGHT))
    assert run(f"a.svg b.svg -o several.{suffix}".split()) == 0
    assert f"clip paths of several outlines are left out of {where}" in capsys.readouterr().err


def test_each_layer_of_lottie_has_its_mask(here):
    write(a=clipped(LEFT), b=clipped(RIGHT))
    assert run("a.svg b.svg -o one.json".split()) == 0
    layers = json.loads(Path("one.json").read_text())["layers"]
    assert [len(layer.get("masksProperties", ())) for layer in layers] == [1] * len(layers)


def test_android_moves_the_outline_of_a_clip(here):
    write(a=clipped(LEFT), b=clipped(RIGHT))
    assert run("a.svg b.svg -o one.xml".split()) == 0
    root = ElementTree.parse("one.xml").getroot()
    found = [
        (clip.get(ANDROID + "name"), clip.get(ANDROID + "pathData"), len(group))
        for group in root.iter("group")
        for clip in group.findall("clip-path")
    ]
    assert [(name, size) for name, _, size in found] == [("shape-1-clip-1", 2), ("shape-2-clip-1", 2)]
    moves = {
        target.get(ANDROID + "name"): animator.attrib
        for target in root.findall("target")
        for animator in target.iter("objectAnimator")
    }
    for name, data, _ in found:
        assert moves[name][ANDROID + "valueFrom"] == data
        assert set(points(moves[name][ANDROID + "valueTo"])) == RIGHT_CORNERS


def test_css_transitions_move_clips(here, capsys):
    write(a=clipped(LEFT), b=clipped(RIGHT))
    assert run("a.svg b.svg -o x.svg --trigger hover --animate css".split()) == 0
    assert capsys.readouterr().err == ""
    root = ElementTree.parse("x.svg").getroot()
    (outline,) = root.findall(f".//{SVG}clipPath/{SVG}path")
    (style,) = root.findall(f"{SVG}style")
    rest, hover = re.findall(rf"\.{outline.get('class')}{{d:path\(\"([^\"]*)\"\)", style.text)
    assert rest == outline.get("d")
    assert {segment.start for segment in parse_path(rest)} == LEFT_CORNERS
    assert {segment.start for segment in parse_path(hover)} == RIGHT_CORNERS


def test_states_say_so_too(here, capsys):
    write(a=clipped(LEFT), b=clipped(RIGHT), c=clipped(RIGHT))
    for files in ("a.svg b.svg c.svg", "a.svg b.svg"):
        assert run(f"states {files} -f".split()) == 0
        assert "clip paths are left out of mixtures and states" in capsys.readouterr().err


def test_progress_names_the_stages_of_clips():
    told = []
    a, b = (read(name, clipped(region).encode()) for name, region in (("a.svg", LEFT), ("b.svg", RIGHT)))
    match_all([a, b], Settings(), watch=lambda stage, share: told.append(stage))
    assert {"clips: flattening", "clips: matching", "clips: moving"} <= set(told)
