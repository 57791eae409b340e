"""Text of many scripts: its outlines, and Chromium's picture of it with the same font."""

import shutil
import subprocess

import numpy as np
import pytest

from shapeblend_cli.cli import run
from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.svg.writing.path_data import path_data
from tests.support.chromium import picture_of
from tests.support.commands import write
from tests.support.pictures import difference
from tests.svg.reading.drawings import svg
from tests.svg.reading.test_text import embedded

pytest.importorskip("uharfbuzz")
pytest.importorskip("fontTools")

BAR = '<rect width="100" height="5"/>'

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
@pytest.mark.parametrize(
    "attributes",
    [
        "",
        'text-anchor="end" x="380"',
        'letter-spacing="2"',
        'textLength="300" lengthAdjust="spacingAndGlyphs"',
    ],
)
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


KEPT = {
    "moved, scaled and coloured": (
        '<text x="10" y="30" font-size="20" letter-spacing="2">AVATO</text>',
        '<text x="30" y="80" font-size="10" letter-spacing="1" fill="#06c">AVATO</text>',
    ),
    "turned": (
        '<text x="50" y="50" font-size="12" text-anchor="middle">HE<tspan dx="3">LL</tspan>'
        '<tspan x="50" dy="12">O</tspan></text>',
        '<text x="50" y="50" font-size="16" text-anchor="middle" transform="rotate(35 50 50) skewX(10)" '
        'opacity=".6">HE<tspan dx="4">LL</tspan><tspan x="50" dy="16">O</tspan></text>',
    ),
}
MOMENTS = (0.0, 0.5, 1.0)


@pytest.mark.parametrize("name", KEPT)
def test_text_that_stays_is_where_the_files_and_the_frames_have_it(here, browser, name):
    files = {side: svg(embedded() + BAR + each).decode() for side, each in zip("ab", KEPT[name], strict=True)}
    write(**files)
    common = ["a.svg", "b.svg", "--text", "keep", "--ease", "linear", "-q"]
    assert run([*common, "-n", "1", "--ends", "-o", "frames"]) == 0
    assert run([*common, "-o", "smil.svg"]) == 0
    assert run([*common, "-o", "css.svg", "--animate", "css"]) == 0
    assert run([*common, "--text", "outline", "-n", "1", "--ends", "-o", "letters"]) == 0
    page = browser.new_page(viewport={"width": 300, "height": 300}, device_scale_factor=2)

    def shown(document, stop="", t=0.0):
        style = "<style>body{margin:0}svg{width:300px;height:300px;display:block}</style>"
        page.set_content(style + document)
        page.evaluate("async (t) => { await document.fonts.ready; " + stop + " }", t)
        return np.asarray(picture_of(page).reduce(2), float)

    stops = {
        "smil.svg": "const s = document.querySelector('svg'); s.pauseAnimations(); "
        "s.setCurrentTime(Math.min(2 * t, 1.9999));",
        "css.svg": "document.getAnimations().forEach((a) => "
        "{ a.pause(); a.currentTime = Math.min(2000 * t, 1999.99); });",
    }
    frames = [shown((here / f"frames/frame-{k}.svg").read_text()) for k in (1, 2, 3)]
    for frame, file in ((frames[0], files["a"]), (frames[2], files["b"])):
        assert difference(frame, shown(file)) < 2e-3
    for frame, k in zip(frames, (1, 2, 3), strict=True):
        if k != 2:  # half way letters move by themselves
            assert difference(frame, shown((here / f"letters/frame-{k}.svg").read_text())) < 0.015
    for file, stop in stops.items():
        document = (here / file).read_text()
        assert "<text" in document
        for t, frame in zip(MOMENTS, frames, strict=True):
            assert difference(shown(document, stop, t), frame) < 0.015
    page.close()
