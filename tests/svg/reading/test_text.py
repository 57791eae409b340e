"""Text into outlines, with a part of Noto Sans that lies beside this file."""

import base64
import io
import struct
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.geometry.cubics import bounds
from shapeblend_cli.svg.reading import fonts
from shapeblend_cli.svg.xml.messages import Notes
from tests.svg.reading.drawings import RECT, boxes, drawn, refused

hb = pytest.importorskip("uharfbuzz")
TTFont = pytest.importorskip("fontTools.ttLib").TTFont

FONT = Path(__file__).with_name("fonts") / "noto-sans.ttf"


def packed(kind):
    """Return the test font as a file of a kind."""
    stream = io.BytesIO()
    with TTFont(FONT) as font:
        font.flavor = kind
        font.save(stream)
    return stream.getvalue()


def embedded(data=None, more=""):
    data = base64.b64encode(FONT.read_bytes() if data is None else data).decode()
    source = f'src: url("data:font/ttf;base64,{data}") format("truetype")'
    return (
        f'<style>@font-face {{ font-family: "Mine"; {more} {source} }} text {{ font-family: Mine }}</style>'
    )


def text(markup, font=None, **options):
    return drawn(f"{embedded() if font is None else font}{markup}", **options)


def lefts(drawing):
    return [box[0] for box in boxes(drawing)]


def names(drawing):
    return [shape.name.label for shape in drawing.shapes]


def advance(letters):
    """Return the width of letters in a size of 10, without kerning."""
    font = hb.Font(hb.Face(FONT.read_bytes()))
    return [font.get_glyph_h_advance(font.get_nominal_glyph(ord(c))) / 100 for c in letters]


def test_each_letter_is_a_shape_with_its_name():
    drawing = text('<text id="t" y="50">HELLO</text>')
    assert names(drawing) == [*"HELLO"]
    assert [shape.element for shape in drawing.shapes] == ["text"] * 5
    assert {shape.id for shape in drawing.shapes} == {"t"}
    assert {shape.groups[0].name.id for shape in drawing.shapes} == {"t"}
    assert [len(shape.contours) for shape in drawing.shapes] == [1, 1, 1, 1, 2]
    assert drawing.notes == ()


def test_letters_are_kerned_joined_and_accented():
    (a, v), (_, far) = (lefts(text(f'<text y="50" font-size="10">{t}</text>')) for t in ("AV", "A A"))
    assert v - a < advance("A")[0] - 0.2 < far - a
    # An accent of its own belongs to its letter, as in one character.
    two, one = (text(f'<text y="50">{t}</text>') for t in ("e\u0301", "é"))
    assert len(two.shapes) == len(one.shapes) == 1
    np.testing.assert_allclose(boxes(two), boxes(one), atol=1e-3)


@pytest.mark.parametrize("kind", ["woff", "woff2"])
def test_packed_fonts_draw_the_same(kind):
    markup = '<text y="50">HELLO fi</text>'
    np.testing.assert_allclose(boxes(text(markup, embedded(packed(kind)))), boxes(text(markup)), atol=1e-6)


@pytest.mark.parametrize(
    ("markup", "expected"),
    [
        ('<text y="50" x="10 30 60">HHH</text>', [10, 30, 60]),
        ('<text y="50" x="10 30"><tspan x="5">H</tspan>H</text>', [5, 30]),
        ('<text y="50" x="10" dx="0 7">HH</text>', [10, 17 + advance("H")[0]]),
        ('<text y="50" x="10" letter-spacing="3">HH</text>', [10, 13 + advance("H")[0]]),
        ('<text y="50" x="10" letter-spacing=".3em">HH</text>', [10, 13 + advance("H")[0]]),
        ('<text y="50" x="10" word-spacing="4">H  H</text>', [10, 14 + sum(advance("H "))]),
        ('<text y="50" x="10" xml:space="preserve">H  H</text>', [10, 10 + sum(advance("H  "))]),
        ('<text y="50" x="10" textLength="40">HH</text>', [10, 50 - advance("H")[0]]),
        ('<text y="50" x="10"><tspan textLength="40">HH</tspan>H</text>', [10, 50 - advance("H")[0], 50]),
        ('<text y="50" x="50" text-anchor="end" textLength="40">HH</text>', [10, 50 - advance("H")[0]]),
        ('<text y="50" x="10" textLength="-4">HH</text>', [10, 10 + advance("H")[0]]),
        ('<text y="50" x="50" text-anchor="end">HH</text>', [50 - 2 * advance("H")[0], 50 - advance("H")[0]]),
        ('<text y="50" x="50" text-anchor="middle">H</text>', [50 - advance("H")[0] / 2]),
        ('<text y="50" x="50" direction="rtl">H</text>', [50 - advance("H")[0]]),
    ],
)
def test_letters_are_placed(markup, expected):
    drawing = text(f'<g font-size="10">{markup}</g>')
    bearing = lefts(text('<text y="50" font-size="10">H</text>'))[0]
    np.testing.assert_allclose(lefts(drawing), np.array(expected) + bearing, atol=1e-3)


def test_letters_are_as_wide_as_their_length_says():
    length = 3 * 2 * advance("H")[0]
    asked = f'textLength="{length}" lengthAdjust="spacingAndGlyphs"'
    plain, wide = (boxes(text(f'<text y="50" font-size="10" {more}>HH</text>')) for more in ("", asked))
    for p, q in zip(plain, wide, strict=True):
        np.testing.assert_allclose([3 * p[0], p[1], 3 * p[2], p[3]], q, atol=1e-3)


def test_letters_turn_and_follow_paths():
    upright, turned = (boxes(text(f'<text x="50" y="50" rotate="{angle}">H</text>'))[0] for angle in (0, 90))
    np.testing.assert_allclose([50 + 50 - upright[1], upright[0]], [turned[2], turned[1]], atol=1e-3)
    path = '<path id="p" d="M50 10V90" fill="none"/>'
    down = text(f'{path}<text><textPath href="#p" startOffset="25%">H</textPath></text>')
    begin = 30 + upright[0] - 50
    np.testing.assert_allclose(boxes(down)[0][:2], [50, begin], atol=0.01)
    # What does not fit is left out.
    long = text(f'{path}<text><textPath href="#p" startOffset="90%">HHHHHH</textPath></text>')
    assert len(long.shapes) < 6


def test_style_size_and_paint_of_spans_count():
    drawing = text(
        '<text y="50" style="font: bold 20px Mine" fill="red">H<tspan fill="#00f" font-size="10">H</tspan></text>'
    )
    assert [shape.style.fill for shape in drawing.shapes] == ["#ff0000", "#0000ff"]
    heights = [low[3] - low[1] for low in boxes(drawing)]
    assert heights[0] > 1.9 * heights[1]
    regular = text('<text y="50" font-size="20">H</text>')
    # A bold font is not there: the letters are emboldened.
    assert bounds(drawing.shapes[0].contours[0].segments).width > boxes(regular)[0][2] - boxes(regular)[0][0]


def test_a_font_that_is_missing_is_said_once():
    drawing = text(2 * '<text y="50" style="font-family: Nowhere, Mine">H</text>')
    assert drawing.notes == ("font 'Nowhere' is not there: Mine taken",)


@pytest.mark.parametrize(
    ("there", "taken"),
    [
        ({"times new roman": "Tinos"}, "Tinos"),
        ({"times new roman": "Sans"}, "Sans"),
        ({"serif": "S"}, "Sans"),
    ],
)
def test_without_any_of_the_fonts_there_is_what_chromium_takes(monkeypatch, there, taken):
    found = {"sans-serif": "Sans"} | there
    monkeypatch.setattr(
        fonts,
        "_installed",
        lambda family, *_: (str(FONT), 0, [found.get(family.lower(), "Sans")], 400, False),
    )
    (face,) = fonts.Fonts([], Notes()).faces(fonts.Wanted(("Nowhere",)))
    assert face.name == taken


def test_text_is_skipped_or_waits_for_its_libraries(monkeypatch):
    markup = f'{RECT}<text y="50">H</text><text y="50">H</text>'
    assert len(text(markup, text="skip").shapes) == 1
    assert text(markup, text="skip").notes == ("text skipped (2 times)",)
    monkeypatch.setitem(sys.modules, "uharfbuzz", None)
    drawing = text(markup)
    assert len(drawing.shapes) == 1
    assert drawing.notes == ("text left out: pip install 'shapeblend[text]' to draw it",)


def bomb(kind):
    """Return a font that claims, or has, gigabytes."""
    if kind == "woff":
        return (
            b"wOFF\0\1\0\0"
            + struct.pack(">LHH", 0, 1, 0)
            + bytes(28)
            + struct.pack(">4s4L", b"glyf", 64, 9, 2**31, 0)
        )
    import brotli

    packed = brotli.compress(bytes(200_000_000), quality=1)
    head = struct.pack(">4sLLHHLL", b"wOF2", 0x10000, 0, 1, 0, 0, len(packed)) + bytes(24)
    return head + bytes([5, 100]) + packed  # a table 'maxp' of 100 bytes


HOSTILE = {
    "no font": (b"hello", "it is no font with letters"),
    "cut short": (FONT.read_bytes()[:500], "it is no font with letters"),
    "WOFF too large": (bomb("woff"), "it unpacks to more than 64 MB or 256 tables, the limits"),
    "WOFF2 damaged": (b"wOF2" + bytes(100), "it is no font with letters|it is damaged"),
}


@pytest.mark.parametrize(("data", "why"), HOSTILE.values(), ids=HOSTILE)
def test_hostile_fonts_are_one_note(data, why):
    drawing = text(f'{RECT}<text y="50">H</text>', embedded(data))
    assert any(
        note == f"embedded font 'Mine' not used: {reason}"
        for note in drawing.notes
        for reason in why.split("|")
    )


def test_a_font_that_swells_is_not_unpacked():
    began = time.process_time()
    data = bomb("woff2")
    made = time.process_time()
    drawing = text(f'{RECT}<text y="50">H</text>', embedded(data))
    assert drawing.notes[0] == "embedded font 'Mine' not used: its data is longer than it says"
    assert time.process_time() - made < 1.0 + 10 * (made - began)


def test_fonts_that_are_elsewhere_are_not_fetched():
    face = "@font-face { font-family: Mine; src: url(http://example.org/a.woff2) }"
    style = f"<style>{face} text {{ font-family: Mine }}</style>"
    assert (
        "embedded font 'Mine' not used: it is not in the file, and nothing is fetched"
        in text('<text y="50">H</text>', style).notes
    )


def test_too_long_or_too_deep_texts_are_refused():
    refused(f"{embedded()}<text>{'H' * 20_001}</text>", "more than 20000 characters, the limit")
    refused(f"{embedded()}<text>{'<tspan>' * 40}H{'</tspan>' * 40}</text>", "spans within each other")


def test_drawings_without_text_load_no_font_library():
    script = (
        "import sys; from shapeblend_cli.svg.reading.read import read;"
        "read('a.svg', b'<svg><path d=\"M0 0h9v9z\"/></svg>');"
        "assert not {'fontTools', 'uharfbuzz', 'shapeblend_cli.svg.reading.text'} & sys.modules.keys()"
    )
    subprocess.run([sys.executable, "-c", script], check=True)
