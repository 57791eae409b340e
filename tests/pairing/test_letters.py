"""Letters of one text that become those of another one."""

import base64
from pathlib import Path

import pytest

import shapeblend_cli as sb

pytest.importorskip("uharfbuzz")
FONT = Path(__file__).parents[1] / "svg" / "reading" / "fonts" / "noto-sans.ttf"


def text(words):
    data = base64.b64encode(FONT.read_bytes()).decode()
    font = f'<style>@font-face {{ font-family: Mine; src: url("data:font/ttf;base64,{data}") }}</style>'
    return sb.read(
        text='<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 90 30">'
        f'{font}<text y="24" font-family="Mine" font-size="24">{words}</text></svg>'
    )


def test_equal_letters_become_each_other_and_the_others_keep_their_order():
    blend = sb.blend(text("HELLO"), text("WORLD"))
    found = {(match["a"], match["b"]) for match in blend.report()["pairs"][0]["contours"]}
    h, e, first_l, second_l, o = range(5)
    w, other_o, _, r, _, other_l, d = range(7)  # O and R have a hole
    assert {(h, w), (e, r), (second_l, other_l), (first_l, d), (o, other_o)} <= found


def test_letters_are_no_pen_lines_on_their_way():
    shapes = sb.blend(text("HELLO"), text("WORLD")).frame(0.5).shapes
    assert {shape.style.stroke for shape in shapes} == {None}
