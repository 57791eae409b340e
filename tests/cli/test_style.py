"""Paint, as users blend it."""

import re
from pathlib import Path

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import write
from tests.support.drawings import svg

SQUARE = "M2 2H22V22H2Z"
VIEWBOX = "0 0 50 50"
A = f'<path d="{SQUARE}" fill="#ff0000"/>'
B = (
    f'<path d="{SQUARE}" fill="#0000ff" stroke="#00ff00" stroke-width="2" stroke-dasharray="3 1" '
    f'stroke-dashoffset="1"/><path d="M40 40H44V44H40Z" fill="#123456"/>'
)


@pytest.fixture(autouse=True)
def here(here):
    write(a=svg(A, viewbox=VIEWBOX), b=svg(B, viewbox=VIEWBOX))


def frame(number, *options):
    assert run(["a.svg", "b.svg", "-n", "1", "--ends", "-f", "-o", "out", "--match", "0=0", *options]) == 0
    text = Path(f"out/frame-{number}.svg").read_text()
    return [dict(re.findall(r'([\w-]+)="([^"]*)"', path)) for path in re.findall(r"<path [^>]*>", text)]


@pytest.mark.parametrize(
    ("options", "fills", "strokes"),
    [
        ([], ["#ff0000", "#ac1eb7", "#0000ff"], ["none", "0.5", "1"]),
        (["--style", "a"], ["#ff0000"] * 3, ["none"] * 3),
        (["--style", "b"], ["#0000ff"] * 3, ["1"] * 3),
    ],
)
def test_frames_are_painted_in_the_style_asked_for(options, fills, strokes):
    paths = [frame(number, *options)[0] for number in (1, 2, 3)]
    assert [path["fill"] for path in paths] == fills
    assert [path.get("stroke-opacity", "1") if "stroke" in path else "none" for path in paths] == strokes


@pytest.mark.parametrize("style", ["a", "b", "blend"])
def test_a_shape_without_a_partner_keeps_its_own_paint(style):
    assert [path["fill"] for path in frame(2, "--style", style)][1:] == ["#123456"]


def test_dashes_are_laid_over_a_with_the_drawing():
    write(b=svg(B.replace("3 1", "30 10").replace('"2"', '"20"'), viewbox="0 0 500 500"))
    path = frame(3)[0]
    assert (path["stroke-width"], path["stroke-dasharray"], path["stroke-dashoffset"]) == ("2", "3 1", "0.1")


def test_gaps_open_between_the_dashes_of_a_solid_line_in_frames_and_animations():
    write(a=svg(A.replace("/>", ' stroke="#00ff00"/>'), viewbox=VIEWBOX))
    paths = [frame(number)[0] for number in (1, 2, 3)]
    assert [path.get("stroke-dasharray") for path in paths] == [None, "3.5 0.5", "3 1"]
    assert [path.get("stroke-dashoffset") for path in paths] == [None, "1", "1"]
    assert run(["a.svg", "b.svg", "-o", "moving.svg", "--match", "0=0"]) == 0
    assert 'attributeName="stroke-dasharray"' in Path("moving.svg").read_text()
    assert 'values="4 0;3 1"' in Path("moving.svg").read_text()
