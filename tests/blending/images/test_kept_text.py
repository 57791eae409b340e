"""Text that stays text where all drawings have it, with a part of Noto Sans that the drawings embed."""

import itertools
import json
import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from shapeblend_cli.blending.images.kept_text import with_common_texts
from shapeblend_cli.cli import run
from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.frames.outlined import with_outlined_text
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.rows.project import project_of
from shapeblend_cli.studio import answers
from shapeblend_cli.studio.order import Order
from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.svg.writing.document import frame_svg
from tests.support.commands import write
from tests.support.images import face, image
from tests.support.pictures import difference, pixels
from tests.svg.reading.drawings import svg

pytest.importorskip("uharfbuzz")
embedded = pytest.importorskip("tests.svg.reading.test_text").embedded

COARSE = Settings(vertices=30)
SVG = "{http://www.w3.org/2000/svg}"
BAR = '<rect width="100" height="5"/>'
ONE = '<text id="t" x="10" y="40" font-size="20">HELLO</text>'
SPANS = (
    '<text x="{x}" y="40" font-size="{size}" text-anchor="middle">HE<tspan dx="{dx}" font-weight="bold">LL</tspan>'
    '<tspan x="{x}" dy="{size}">O</tspan></text>'
)


def file_of(markup, font=None):
    return svg((embedded() if font is None else font) + BAR + markup).decode()


def pair_of(a, b, font=None):
    drawings = [read(name, file_of(each, font).encode(), text="keep") for name, each in (("a", a), ("b", b))]
    (pair,), _ = match_all(drawings, COARSE)
    return pair


def frame_of(pair, t):
    return ElementTree.fromstring(frame_svg(frame_at(pair, t, as_drawn=True), 3))


def texts(a, b, t=0.5):
    return list(frame_of(pair_of(a, b), t).iter(f"{SVG}text"))


def test_equal_text_stays_and_its_place_size_and_colour_go_evenly():
    other = '<text id="t" x="30" y="80" font-size="10" fill="#f00" opacity=".5">HELLO</text>'
    (text,) = texts(ONE, other)
    assert text.text == "HELLO"
    assert [float(text.get(name)) for name in ("x", "y", "font-size", "fill-opacity")] == [20, 60, 15, 0.75]
    assert text.get("font-family") == "Mine"
    assert text.get("id") == "t"
    (first,), (last,) = texts(ONE, other, 0.0), texts(ONE, other, 1.0)
    assert [first.get(name) for name in ("x", "y", "font-size", "fill")] == ["10", "40", "20", "#000000"]
    assert [last.get(name) for name in ("x", "y", "font-size", "fill")] == ["30", "80", "10", "#ff0000"]


def test_what_turns_or_skews_has_a_transform():
    (text,) = texts(ONE, ONE.replace("<text", '<text transform="rotate(40 30 40)"'))
    a, b, c, d, *_ = map(float, re.findall(r"-?[\d.]+", text.get("transform")))
    assert np.degrees(np.arctan2(b, a)) == pytest.approx(20)
    assert (a, b) == pytest.approx((d, -c))


def test_spans_keep_their_places_and_fonts():
    (text,) = texts(SPANS.format(x=50, size=10, dx=2), SPANS.format(x=40, size=20, dx=4))
    assert [(span.text, span.get("x"), span.get("dx"), span.get("dy")) for span in text] == [
        ("HE", "45", None, None),
        ("LL", None, "3", None),
        ("O", "45", None, "15"),
    ]
    assert (text.get("text-anchor"), text[1].get("font-weight")) == ("middle", "700")


@pytest.mark.parametrize(
    "other",
    [
        ONE.replace("HELLO", "WORLD"),
        ONE.replace("HELLO", '<tspan fill="red">H</tspan>ELLO'),
        ONE.replace("<text", '<text stroke="red"'),
        ONE.replace("<text", '<text letter-spacing="3"'),
        ONE.replace("<text", '<text font-weight="bold"'),
        ONE.replace("HELLO", 'HE<tspan baseline-shift="super">LLO</tspan>'),
        ONE.replace("<text", '<text textLength="90"'),
        ONE.replace("HELLO", 'HE<tspan dx="1">LLO</tspan>'),
        ONE.replace("HELLO", '<textPath href="#p">HELLO</textPath>')
        + '<path id="p" d="M0 50H99" fill="none"/>',
        '<linearGradient id="g"><stop/><stop offset="1" stop-color="red"/></linearGradient>'
        + ONE.replace("<text", '<text fill="url(#g)"'),
        "",
    ],
)
def test_other_text_becomes_letters(other):
    drawings = [read("x.svg", file_of(each).encode(), text="keep") for each in (ONE, other)]
    assert len(drawings[0].shapes) == 1 + 5
    for both in (drawings, drawings[::-1]):
        assert [len(each.shapes) for each in with_common_texts(both)] == [len(each.shapes) for each in both]


def test_of_texts_that_one_has_more_often_as_many_stay_as_both_have():
    second = ONE.replace('id="t" x="10" y="40"', 'x="10" y="90"')
    root = frame_of(pair_of(ONE + second, second), 0.0)
    assert len(list(root.iter(f"{SVG}text"))) == 1
    assert len(list(root.iter(f"{SVG}path"))) == 1 + 5


def test_a_text_becomes_the_nearest_of_those_that_are_equal():
    low = ONE.replace('id="t" x="10" y="40"', 'x="10" y="90"')
    moved = ONE.replace('id="t" x="10" y="40"', 'x="14" y="44"'), low.replace("90", "86")
    found = {float(text.get("y")) for text in texts(ONE + low, moved[1] + moved[0])}
    assert found == {42, 88}


def test_in_a_chain_text_stays_that_all_drawings_have(here):
    write(a=file_of(ONE), b=file_of(ONE), c=file_of(ONE.replace("HELLO", "WORLD")))
    assert run("a.svg b.svg c.svg --text keep -n 1 -o three -q".split()) == 0
    assert not any("<text" in file.read_text() for file in Path("three").iterdir())
    write(c=file_of(ONE))
    assert run("a.svg b.svg c.svg --text keep -n 1 -o three -q -f".split()) == 0
    assert all("<text" in file.read_text() for file in Path("three").iterdir())


def test_the_fonts_of_the_file_go_along():
    root = frame_of(pair_of(ONE, ONE), 0.5)
    (rule,) = [style.text for style in root.iter(f"{SVG}style")]
    assert rule.startswith(
        '@font-face{font-family:"Mine";font-weight:400;font-style:normal;src:url(data:font'
    )
    assert "http" not in rule


def test_what_is_written_means_no_more_than_its_letters():
    font = '<style>text { font-family: "a\'};b\\{x}</style><script>", sans-serif }</style>'
    font = font.replace("</style><script>", "")
    markup = ONE.replace("HELLO", "&lt;script&gt; &amp;amp; &quot;LO&quot;").replace('id="t"', "")
    pair = pair_of(markup, markup, font)
    (text,) = frame_of(pair, 0.5).iter(f"{SVG}text")
    assert text.text == '<script> &amp; "LO"'
    assert text.get("font-family").count("'") % 2 == 0


def test_blanks_stay_where_they_count():
    markup = ONE.replace("<text", '<text xml:space="preserve"').replace("HELLO", "HE  LLO")
    (text,) = texts(markup, markup)
    assert (text.text, text.get("{http://www.w3.org/XML/1998/namespace}space")) == ("HE  LLO", "preserve")


def test_it_has_the_colour_of_its_page(here):
    markup = file_of(ONE.replace("<text", '<text fill="currentColor"')).replace(
        BAR, BAR.replace("/>", ' fill="currentColor"/>')
    )
    write(a=markup, b=markup)
    for options in ("-n 1 -o frames", "-o x.svg", "-o x.svg --animate css"):
        assert run(["a.svg", "b.svg", "--text", "keep", *options.split(), "-q", "-f"]) == 0
        out = Path(options.split()[options.split().index("-o") + 1])
        written = (next(out.iterdir()) if out.is_dir() else out).read_text()
        assert re.search(r'<(text|g)\b[^>]* fill="currentColor"', written)


def test_pictures_are_no_text_and_text_no_picture():
    photo = image(face(), 'id="t" x="10" y="30" width="40" height="30"')
    pair = pair_of(ONE + photo, photo + ONE.replace('id="t"', 'id="u"'))
    root = frame_of(pair, 0.5)
    assert {len(list(root.iter(f"{SVG}{tag}"))) for tag in ("text", "image")} <= {1, 2}
    assert all(type(s.style_a.picture) is type(s.style_b.picture) for s in pair.shapes)


@pytest.mark.parametrize(
    "options",
    [
        "-o x.json",
        "-o x.xml --emit avd",
        "-o x --emit pair",
        "-o x.js",
        "-o x.svg --trigger hover",
        "-o x.svg --trigger hover --animate css",
        "-o x.svg --mix .5,.5",
    ],
)
def test_other_outputs_have_outlines(here, capsys, options):
    write(a=file_of(ONE), b=file_of(ONE.replace("<text", '<text transform="rotate(30)"')))
    assert run(["a.svg", "b.svg", "--text", "keep", "--motion", "linear", *options.split()]) == 0
    out = Path("x") / "a.svg" if "pair" in options else Path(options.split()[1])
    written = out.read_text()
    assert "<text" not in written
    assert '"text"' not in written
    assert "HELLO" not in written
    assert "left out" not in capsys.readouterr().err


def test_states_have_outlines(here):
    write(a=file_of(ONE), b=file_of(ONE))
    assert run("states a.svg b.svg --text keep -o s.svg -q".split()) == 0
    assert "<text" not in Path("s.svg").read_text()


def test_outlines_are_those_of_the_letters():
    markup = ONE, SPANS.format(x=50, size=14, dx=2)
    other = (each.replace("<text", '<text transform="rotate(30 30 40) skewX(10)"') for each in markup)
    kept = with_outlined_text(pair_of("".join(markup), "".join(other)))
    plain = [
        read("a", file_of("".join(each)).encode())
        for each in (
            markup,
            [m.replace("<text", '<text transform="rotate(30 30 40) skewX(10)"') for m in markup],
        )
    ]
    (outlined,), _ = match_all(plain, COARSE)
    for end, as_drawn in itertools.product((0.0, 1.0), (True, False)):
        one, other_frame = (
            pixels(frame_svg(frame_at(pair, end, as_drawn=as_drawn), 3)) for pair in (kept, outlined)
        )
        assert difference(one, other_frame) < 2e-3
    assert frame_svg(frame_at(kept, 0.5, as_drawn=True), 3).count("<path") == 3


def test_the_studio_shows_it_as_outlines_and_times_it_by_its_name(here):
    write(a=file_of(ONE), b=file_of(ONE.replace("20", "30")))
    project = project_of({"files": ["a.svg", "b.svg"], "text": "keep", "vertices": 40}, "", "")
    answer = answers.do(Order("blend", project, {}))
    (pair,) = answer["pairs"]
    assert [part["name"] for part in pair["parts"]] == ["0", "#t"]
    for drawing in answer["drawings"]:
        assert len(drawing["contours"]) == 2
        assert [sorted(path) for path in drawing["paths"]] == [["path"], ["image"]]


def test_the_page_and_the_report_take_it(here):
    write(a=file_of(ONE), b=file_of(ONE.replace("20", "30")))
    assert run("a.svg b.svg --text keep -o x --preview page.html --report report.json -q".split()) == 0
    assert "HELLO" not in Path("page.html").read_text()
    (pair,) = json.loads(Path("report.json").read_text())["pairs"]
    assert len(pair["contours"]) == 2
