"""Text of many scripts: its outlines, and Chromium's picture of it with the same font."""

import shutil
import subprocess

import pytest

from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.svg.writing.path_data import path_data

pytest.importorskip("uharfbuzz")
pytest.importorskip("fontTools")

SCRIPTS = {
    "Latin with kerning": ("DejaVu Serif", "AVATAR To. Wave"),
    "ligatures": ("DejaVu Serif", "office fluffy"),
    "accents": ("DejaVu Sans", "e\u0301 a\u0308 n\u0303 o\u0302"),
    "Greek": ("DejaVu Sans", "Ελληνικά ώ"),
    "Arabic": ("Noto Sans Arabic", "السلام عليكم"),
    "Hebrew": ("Noto Sans Hebrew", "שלום עולם"),
    "Devanagari": ("Noto Sans Devanagari", "नमस्ते क्षत्रिय"),
    "Thai": ("Noto Sans Thai", "สวัสดีครับ ที่นี่"),
    "Chinese": ("Noto Sans CJK SC", "汉字漢字"),
    "two directions": ("DejaVu Sans", "abc שלום 123 def"),
}


def installed(family):
    command = ["fc-match", "-f", "%{family}", family]
    return (
        shutil.which("fc-match") and family in subprocess.run(command, capture_output=True, text=True).stdout
    )


@pytest.mark.parametrize(("family", "words"), SCRIPTS.values(), ids=SCRIPTS)
@pytest.mark.parametrize("attributes", ["", 'text-anchor="end" x="380"', 'letter-spacing="2"'])
def test_letters_are_where_chromium_has_them(screenshot, family, words, attributes):
    if not installed(family):
        pytest.skip(f"no font {family}")
    if "Arabic" in family and "letter-spacing" in attributes:
        pytest.skip("CSS Text lets joined letters stay together, and Chromium parts them")
    root = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 60" width="400" height="60" style="display:block">'
    place = attributes if "x=" in attributes else f'x="10" {attributes}'
    markup = f'{root}<text y="42" font-size="32" font-family="{family}" {place}>{words}</text></svg>'
    shapes = read("text.svg", markup.encode()).shapes
    outlines = f'{root}<path d="{path_data([c for s in shapes for c in s.contours], 4)}"/></svg>'
    theirs, ours = (screenshot("body { margin: 0 }", body, 400, 60, 4) for body in (markup, outlines))
    assert theirs.mean() < 250
    assert (abs(theirs - ours).max(axis=2) > 64).mean() < 0.005
