"""Documents: encodings, namespaces, entities, and files that are something else."""

import gzip
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.errors import InputError
from shapeblend_cli.svg.reading.read import read
from tests.svg.reading.drawings import RECT, boxes, drawn, refused, svg

BYTES = RECT.encode()
NAMESPACE = b"http://www.w3.org/2000/svg"
PLAIN = svg(RECT)
XML = b'<?xml version="1.0" encoding="%b"?>'

DOCUMENTS = {
    "plain": PLAIN,
    "without a namespace": b'<svg><rect width="1" height="2"/></svg>',
    "with an unknown namespace": b'<svg xmlns="http://www.w3.org/2000/SVG-1">' + BYTES + b"</svg>",
    "with prefixes": b'<s:svg xmlns:s="%b"><s:rect width="1" height="2"/><rect/></s:svg>' % NAMESPACE,
    "with an undeclared prefix": b'<svg:svg><svg:rect width="1" height="2"/></svg:svg>',
    "with an undeclared attribute prefix": b'<svg xlink:href="#">' + BYTES + b"</svg>",
    "of a draft": b'<svg xmlns="%b-20000303-stylable">%b</svg>' % (NAMESPACE, BYTES),
    "compressed": gzip.compress(PLAIN),
    "byte order mark": b"\xef\xbb\xbf" + PLAIN,
    "UTF-16": PLAIN.decode().encode("utf-16"),
    "UTF-16 without a mark": PLAIN.decode().encode("utf-16-be"),
    "UTF-16, declared": ('<?xml version="1.0" encoding="UTF-16"?>' + PLAIN.decode()).encode("utf-16"),
    "Latin-1": XML % b"ISO-8859-1" + b"<!-- \xe9 -->" + PLAIN,
    "Windows-1252": XML % b"windows-1252" + b"<!-- \x80 -->" + PLAIN,
    "Shift JIS": XML % b"Shift_JIS" + b"<!-- \x82\xa0 -->" + PLAIN,
    "metadata": svg(f'<metadata><r:R xmlns:r="urn:r"><rect width="9" height="9"/></r:R></metadata>{RECT}'),
    "doctype": b'<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/svg11.dtd">' + PLAIN,
    "entities": b'<!DOCTYPE svg [<!ENTITY ns "%b"><!ENTITY st "width:1px;height:2px">]>'
    b'<svg xmlns="&ns;"><rect style="&st;"/></svg>' % NAMESPACE,
}


@pytest.mark.parametrize("data", DOCUMENTS.values(), ids=DOCUMENTS)
def test_document_is_read(data):
    assert boxes(drawn(data)) == [[0, 0, 1, 2]]


def test_file_is_opened(tmp_path):
    (tmp_path / "a.svg").write_bytes(PLAIN)
    drawing = read(str(tmp_path / "a.svg"))
    assert drawing.file == str(tmp_path / "a.svg")
    assert boxes(drawing) == [[0, 0, 1, 2]]


REFUSED = {
    "empty": (b"", "the file is empty; an SVG file would work"),
    "blank": (b" \n ", "the file is empty"),
    "image": (b"\x89PNG\r\n\x1a\n\0\0", "this is a PNG image; an SVG file would work"),
    "binary": (b"\0\1\2\3", "line 1: not well-formed XML"),
    "text": (b"hello", "line 1: not well-formed XML (syntax error)"),
    "truncated": (PLAIN[:-9], "line 1: not well-formed XML"),
    "mismatched": (
        b"<svg>\n<g></svg>",
        "line 2: not well-formed XML (mismatched tag); a file saved as SVG would work",
    ),
    "web page": (b"<html><svg/></html>", "this is a page of HTML; an SVG file would work"),
    "no shapes": (b"<svg/>", "no painted shape: it has no shape elements"),
    "only images": (b"<svg><image/></svg>", "no painted shape: image left out"),
    "only definitions": (b"<svg><defs><path/></defs></svg>", "1 shape in defs, symbols, clip paths"),
    "damaged gzip": (gzip.compress(PLAIN)[:-20], "compressed data is damaged or cut short"),
    "gzip in gzip": (gzip.compress(gzip.compress(PLAIN)), "this is compressed twice"),
    "UTF-32": (PLAIN.decode().encode("utf-32"), "this is text in UTF-32; saved in UTF-8 it would work"),
    "UTF-32 without a mark": (PLAIN.decode().encode("utf-32-be"), "this is text in UTF-32"),
    "not gzip": (b"\x1f\x8b nothing", "compressed data is damaged"),
    "unknown encoding": (
        XML % b"klingon" + b"<svg/>",
        "its encoding is not supported; saved in UTF-8 it would work",
    ),
    "wrong encoding": (XML % b"gb2312" + b"<svg>\xff\xff</svg>", "not valid gb2312 text"),
    "undefined entity": (b"<svg>&foo;</svg>", "undefined entity"),
}


@pytest.mark.parametrize(("data", "message"), REFUSED.values(), ids=REFUSED)
def test_other_data_is_refused_in_one_line(data, message):
    whole = refused(data, re.escape(message))
    assert whole.startswith("test.svg: ")
    assert whole.isprintable()


@pytest.mark.parametrize(
    ("file", "message"),
    [
        ("/nowhere/a.svg", r"^/nowhere/a.svg: cannot be read \(No such file or directory\)"),
        (".", r"cannot be read \(Is a directory\)"),
        ("a\0.svg", "not the name of a file"),
    ],
)
def test_what_is_no_readable_file(file, message):
    with pytest.raises(InputError, match=message):
        read(file)


PIECES = (
    b"<svg>|</svg>|<g |>|/>|<path d='|M0 0|l1 1|z|'|\"|<rect width='5' height='3'| style='| transform='|scale(2)|fill:"
    b"|red|url(#a)|;|<use href='#a'| id='a'|<style>|</style>|rect{|}|&#10;|<!--|-->|<![CDATA[|]]>"
    b"|\xff|<symbol viewBox='0 0 1 1'>|<!DOCTYPE svg [|]>"
).split(b"|")


def assert_read_or_refused(data):
    try:
        drawing = drawn(data)
    except InputError as error:
        message = str(error)
    else:
        message = " ".join(drawing.notes)
        assert drawing.shapes
    assert message.isprintable()


MARKUP = st.lists(st.sampled_from(PIECES), max_size=20).map(
    lambda pieces: b"<svg>%b</svg>" % b"".join(pieces)
)


@pytest.mark.parametrize("strategy", [st.binary(max_size=200), MARKUP], ids=["bytes", "markup"])
@given(st.data())
def test_any_bytes_are_read_or_refused(strategy, data):
    assert_read_or_refused(data.draw(strategy))


@given(st.integers(0, len(PLAIN)), st.binary(max_size=3))
def test_a_damaged_drawing_is_read_or_refused(place, bytes_there):
    assert_read_or_refused(PLAIN[:place] + bytes_there + PLAIN[place + len(bytes_there) :])


NAMES = "d points x y width height r rx viewBox transform style fill stroke stroke-width opacity".split()
SENSIBLE = ["1", "1e5", "50%", "rotate(5)", "fill:red", "0 0 5 5", "M0 0h5", "url(#x)", "var(--x)"]
CHARACTERS = st.characters(exclude_characters="<>&'\"", min_codepoint=32, exclude_categories=["Cs"])


@given(
    st.dictionaries(st.sampled_from(NAMES), st.text(CHARACTERS, max_size=25) | st.sampled_from(SENSIBLE)),
    st.sampled_from(["path", "rect", "circle", "ellipse", "line", "polygon", "svg", "g"]),
)
def test_any_attributes_are_read_or_refused(attributes, tag):
    text = " ".join(f'{name}="{value}"' for name, value in attributes.items())
    assert_read_or_refused(svg(f"<{tag} {text}>{RECT}</{tag}>"))
