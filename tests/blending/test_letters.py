"""Letters of texts: equal ones become each other."""

import base64
import re
from pathlib import Path

import pytest

import shapeblend_cli as sb
from shapeblend_cli.svg.reading.read import read

pytest.importorskip("uharfbuzz")
pytest.importorskip("fontTools")

FONT = Path(__file__).parents[1] / "svg" / "reading" / "fonts" / "noto-sans.ttf"


def word(letters):
    font = base64.b64encode(FONT.read_bytes()).decode()
    style = f"<style>@font-face {{ font-family: Mine; src: url(data:font/ttf;base64,{font}) }}</style>"
    text = f'<text y="80" font-size="60" font-family="Mine">{letters}</text>'
    root = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 300 100">'
    return read("word.svg", f"{root}{style}{text}</svg>".encode())


@pytest.mark.parametrize(
    ("a", "b", "expected"),
    [
        ("HELLO", "WORLD", {"L": 1, "O": 1}),
        ("AREA", "AREA", {"A": 2, "R": 1, "E": 1}),
        ("ALE", "LEA", {"A": 1, "L": 1, "E": 1}),
    ],
)
def test_equal_letters_become_each_other(a, b, expected):
    blend = sb.blend(word(a), word(b), frames=1)
    names = re.findall('inkscape:label="(.)"', blend.frame(0.5).svg)
    assert {letter: names.count(letter) for letter in expected} == expected
