"""What is shown first and last is the drawings, whatever lies on what in each."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

import shapeblend_cli as sb
from shapeblend_cli.cli import run
from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.outputs.pixels import Size, rasterize, read_png
from shapeblend_cli.preview.pictures import still_paths
from tests.support.commands import write
from tests.support.drawings import drawing, svg
from tests.support.ends import BLUE, ENDS, GOLD, GREEN, RED, card, seen, write_ends
from tests.support.pictures import difference, pixels

SOON = 1e-7
CARDS = 4


@pytest.mark.parametrize("name", ENDS)
def test_in_betweens_begin_and_end_with_the_drawings(here, name):
    write_ends(name)
    *drawings, options = ENDS[name]
    match = re.findall(r"(\d)=(\d)", options)
    blend = sb.blend("a.svg", "b.svg", match=match, place="asis")
    for t, shown in zip((SOON, 1.0 - SOON), drawings, strict=True):
        assert difference(seen(blend.frame(t).svg, shown), pixels(shown)) < 2e-3


KEEPS = 'vector-effect="non-scaling-stroke" fill="none" stroke="#000"'
SMALL = svg(f'<path d="M4 4H20V20H4Z" {KEEPS} stroke-width="2"/>')
LARGE = svg(f'<path d="M30 30H200V160H30Z" {KEEPS} stroke-width="2"/>', viewbox="0 0 240 240")


def emitted(file, *options):
    write(a=SMALL, b=LARGE)
    assert run(["a.svg", "b.svg", "-q", "-f", *options]) == 0
    return Path(file).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("file", "options"),
    [
        ("out/frame-2.svg", "-n 3 --ends -o out"),
        ("out/frame-5.svg", "-n 3 --ends -o out"),
        ("out/b.svg", "--emit pair -o out"),
        ("out.svg", "-o out.svg"),
        ("out.svg", "-o out.svg --animate css"),
        ("out.svg", "-o out.svg --animate frames"),
        ("out.svg", "-o out.svg --trigger click"),
        ("out.svg", "--emit layers -o out.svg"),
    ],
)
def test_a_stroke_keeps_its_width_on_the_screen(here, file, options):
    text = emitted(file, *options.split())
    paths = re.findall(r"<path [^>]*>", text)
    assert paths
    for path in paths:
        assert re.findall(r'stroke-width="([^"]*)"', path) == ["2"]
        assert 'vector-effect="non-scaling-stroke"' in path
    assert not re.search(r'attributeName="stroke-width"|[{;]stroke-width', text)


def test_states_keep_the_width_of_a_stroke_on_the_screen(here):
    write(a=SMALL, b=LARGE)
    assert run("states a.svg b.svg -o out.svg -q".split()) == 0
    assert re.findall(r'stroke-width[=:]"?([^";]*)', Path("out.svg").read_text("utf-8")) == ["2"]
    write(
        a=SMALL.replace('stroke-width="2"', 'stroke-width="32"').replace(KEEPS, 'fill="none" stroke="#000"')
    )
    assert run("states a.svg b.svg -o out.svg -q -f".split()) == 0
    (transition,) = re.findall(r"transition-property:([^;]*)", Path("out.svg").read_text("utf-8"))
    assert "stroke-width" not in transition


def test_what_cannot_keep_a_width_shows_it_as_at_the_drawings_own_size(here):
    lottie = json.loads(emitted("out.json", "--emit", "lottie", "-o", "out.json"))
    widths = [key["s"] for key in lottie["layers"][0]["shapes"][0]["it"][1]["w"]["k"]]
    avd = emitted("out.xml", "--emit", "avd", "-o", "out.xml")
    assert widths == [[2], [0.2]]
    assert 'strokeWidth="2"' in avd
    assert 'valueTo="0.2"' in avd
    (pair,) = sb.blend("a.svg", "b.svg").pairs
    (path,) = still_paths(frame_at(pair, 1.0, as_drawn=True), 3)
    assert path["path"]["stroke-width"] == "0.2"
    assert "vector-effect" not in path["path"]
    assert run("a.svg b.svg -q -f -n 3 --ends --format png --width 240 -o out".split()) == 0
    for frame, like in (("1", SMALL), ("5", LARGE)):
        with Image.open(f"out/frame-{frame}.png") as picture:
            drawn = np.asarray(picture)[..., 3] / 255.0
        plain = rasterize(like.replace("vector-effect", "data-is"), Size(240, 240))
        assert np.abs(drawn - np.asarray(read_png(plain))[..., 3] / 255.0).mean() < 1e-3


permutations = st.permutations(range(CARDS))
spots = st.lists(st.tuples(st.integers(0, 12), st.integers(0, 8)), min_size=CARDS, max_size=CARDS)


@settings(max_examples=10)
@given(permutations, permutations, spots, spots, st.sampled_from(["", 'fill-opacity="0.6"']))
def test_in_any_order(order, partners, spots_a, spots_b, opacity):
    paints = [f"{paint} {opacity}" for paint in (RED, BLUE, GOLD, GREEN)]
    cards_a = [card(*spot, paint) for spot, paint in zip(spots_a, paints, strict=True)]
    cards_b = [card(*spot, paints[k]) for spot, k in zip(spots_b, order, strict=True)]
    match = [(str(k), str(partners[k])) for k in range(CARDS)]
    blend = sb.blend(drawing(*cards_a), drawing(*cards_b), match=match, place="asis", motion="linear")
    first, last = (pixels(blend.frame(t).svg) for t in (0, 1))
    assert difference(pixels(blend.frame(SOON).svg), first) < 2e-3
    assert difference(pixels(blend.frame(1.0 - SOON).svg), last) < 2e-3


def mixed(picture):
    """How many pixels are neither all red nor all blue nor white, as where one shines through the other."""
    red, _, blue = picture.transpose(2, 0, 1)
    return int(((red > 60) & (red < 195) & (blue > 60) & (blue < 195)).sum())


@pytest.mark.parametrize(
    ("blue_at", "red_at", "times"),
    [
        ((2, 14), (6, 14), [0.45]),  # they always meet: for a moment one shines through the other
        ((0, 14), (14, 2), []),  # they are apart half way
    ],
)
def test_a_card_comes_to_the_top_at_half_time_and_unseen_where_it_can(blue_at, red_at, times):
    red, blue = 'fill="#ff0000"', 'fill="#0000ff"'
    a = drawing(card(2, 2, red, 8, 8), card(6, 2, blue, 8, 8))
    b = drawing(card(*blue_at, blue, 8, 8), card(*red_at, red, 8, 8))
    blend = sb.blend(a, b, match=[("0", "1"), ("1", "0")], place="asis", motion="linear")
    pictures = {t: pixels(blend.frame(t).svg) for t in (0.2, 0.39, 0.45, 0.51, 0.61, 0.8)}
    assert [t for t, picture in pictures.items() if mixed(picture) > 1000] == times
