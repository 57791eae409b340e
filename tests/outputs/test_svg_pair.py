"""Two SVG files with equal commands."""

import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.outputs.options import OutputOptions, specify
from shapeblend_cli.paint.oklab import blend_colours
from tests.outputs.blends import AB, BLENDS, OPTIONS, each_blend, emitted
from tests.support.commands import points as read_points
from tests.support.commands import write
from tests.support.drawings import BAR, LEAF, svg
from tests.support.ends import ENDS, emitted_ends, seen
from tests.support.motions import rotated_move
from tests.support.pictures import difference, pixels

NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def emit_pair(blend, *options):
    a = emitted(blend, "pair", "blend/a.svg", "-q", *options)
    return a, Path("blend/b.svg").read_text(encoding="utf-8")


def mixed(a, b, t):
    """What a program shows that goes evenly from number to number, and mixes colours as frames do."""

    def between(value, target):
        if value.startswith("#"):  # each program mixes them in its own way
            return blend_colours(value, target, t)
        if not NUMBER.search(value):
            return target if t >= 0.5 else value
        pairs = iter(zip(map(float, NUMBER.findall(value)), map(float, NUMBER.findall(target)), strict=True))
        return NUMBER.sub(lambda _: str(np.dot(next(pairs), (1 - t, t)).round(6)), value)

    root, other = ElementTree.fromstring(a), ElementTree.fromstring(b)
    for element, target in zip(root.iter(), other.iter(), strict=True):
        for name in set(element.keys()) - {"id"}:
            element.set(name, between(element.get(name), target.get(name)))
    return ElementTree.tostring(root, encoding="unicode")


@each_blend
def test_paths_attributes_and_commands_agree_and_each_file_shows_its_drawing(here, blend):
    texts = emit_pair(blend)
    a, b = (list(ElementTree.fromstring(text)) for text in texts)
    assert [path.get("id") for path in a] == [f"shape-{k + 1}" for k in range(len(a))]
    for one, other in zip(a, b, strict=True):
        assert one.get("id") == other.get("id")
        assert list(one.keys()) == list(other.keys())
        assert NUMBER.sub("0", one.get("d")) == NUMBER.sub("0", other.get("d"))
    for text, drawing in zip(texts, BLENDS[blend], strict=True):
        assert difference(pixels(text), pixels(drawing)) < 1e-3


@pytest.mark.parametrize("blend", [name for name in BLENDS if name != "another viewBox"])
def test_going_evenly_from_number_to_number_gives_the_frames(here, blend):
    a, b = emit_pair(blend)
    assert run([*AB, "-n", "2", "-o", "frames", "--motion", "linear", "-q", *OPTIONS[blend]]) == 0
    for k, t in enumerate((1 / 3, 2 / 3), 1):
        frame = Path(f"frames/frame-{k}.svg").read_text(encoding="utf-8")
        assert difference(pixels(mixed(a, b, t)), pixels(frame)) < 1e-3


@pytest.mark.parametrize("name", ENDS)
def test_the_order_of_paint_is_that_of_each_drawing(here, name):
    a = emitted_ends(name, "blend/a.svg", "--emit", "pair", "--place", "asis")
    b = Path("blend/b.svg").read_text(encoding="utf-8")
    for text, shown in zip((a, b), ENDS[name], strict=False):
        assert difference(seen(text, shown), pixels(shown)) < 2e-3


def test_a_contour_without_a_partner_is_a_point_in_the_other_file(here):
    a, b = emit_pair("a hole that grows, stroked with round caps")
    for text, points in ((a, 1), (b, 0)):
        subpaths = re.findall(r"M[^MZ]+", ElementTree.fromstring(text)[0].get("d"))
        assert sum(bool((np.diff(read_points(s)) == 0).all()) for s in subpaths) == points


def test_paint_without_a_partner_is_there_and_not_seen(here):
    a, b = (ElementTree.fromstring(text)[0] for text in emit_pair("paint on one side alone"))
    assert (a.get("fill"), a.get("fill-opacity"), a.get("stroke-opacity")) == ("#cc00cc", "0.5", "0")
    assert (b.get("fill"), b.get("fill-opacity"), b.get("stroke-opacity")) == ("#cc00cc", "0", "1")
    assert a.get("stroke") == b.get("stroke") == "#204080"


def test_curved_paths_are_said_to_be_lost():
    _, pair = rotated_move(LEAF, BAR)
    straight = pair._replace(shapes=tuple(shape._replace(motion=None) for shape in pair.shapes))

    def render(emit, pair):
        spec = specify(OutputOptions(emit=emit), Settings())
        return spec.format.render(spec, [pair])

    contents, notes = render("pair", pair)
    assert notes == [
        "shape-1: moves on curved paths, which two files cannot show; it moves straight between them"
    ]
    assert render("pair", straight) == (contents, [])
    for emit in ("lottie", "avd"):
        assert render(emit, pair).notes == []


def test_polygons_have_lines_alone(here):
    for text in emit_pair("holes", "--polygons"):
        assert "C" not in ElementTree.fromstring(text)[0].get("d")


GRADIENTS = [
    f'<{kind} id="g" gradientUnits="userSpaceOnUse" {box}><stop stop-color="#ff0000"/>'
    f'<stop offset="1" stop-color="#0000ff"/></{kind}><path d="M2 2H22V22H2Z" fill="url(#g)"/>'
    for kind, box in (("linearGradient", 'x1="2" x2="22"'), ("radialGradient", 'cx="12" cy="12" r="10"'))
]


@pytest.mark.parametrize("first", [0, 1])
@pytest.mark.parametrize("second", [0, 1])
def test_gradients_stay(here, first, second):
    drawings = {"a": svg(GRADIENTS[first]), "b": svg(GRADIENTS[second])}
    write(**drawings)
    assert run([*AB, "--emit", "pair"]) == 0
    for name, drawing in drawings.items():
        assert difference(pixels(Path(f"blend/{name}.svg").read_text()), pixels(drawing)) < 0.001
