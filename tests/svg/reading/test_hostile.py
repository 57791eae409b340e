"""Files made to break a reader: each is refused, or read without harm, in little time."""

import gzip

import pytest

from shapeblend_cli.errors import InputError
from shapeblend_cli.svg.reading import path_commands, walk
from shapeblend_cli.svg.styles import stylesheets
from shapeblend_cli.svg.xml import xmltree
from tests.svg.reading.drawings import RECT, boxes, drawn, refused, svg


def doctype(declarations, text=""):
    return f"<!DOCTYPE svg [{declarations}]><svg>{text}{RECT}</svg>".encode()


def groups(depth):
    return "<g>" * depth + RECT + "</g>" * depth


TENS = "".join(f'<g id="g{k}">{f"""<use href="#g{k - 1}"/>""" * 10}</g>' for k in range(1, 12))
USE_TEN_TIMES = f'<defs><g id="g0">{RECT}</g>{TENS}</defs><use href="#g11"/>'
CHAIN = "".join(f'<use id="u{k}" href="#u{k - 1}"/>' for k in range(1, 30))
USE_CHAIN = f'<defs><rect id="u0" width="1" height="1"/>{CHAIN}</defs><use href="#u29"/>'
SLOW_SHEET = "style sheet takes too long to match"

REFUSED = {
    "nested deeper than 1000": [groups(1000)],
    "external entity 'a' in its DOCTYPE; without it the file would work": [
        doctype('<!ENTITY a SYSTEM "file:///etc/passwd">'),
        doctype('<!ENTITY a PUBLIC "x" "http://example.org/">'),
    ],
    "parameter entity 'a'": [doctype('<!ENTITY % a "x">')],
    "entity 'a' refers to an unknown one, 'b'": [doctype('<!ENTITY a "&b;"><!ENTITY b "&a;">')],
    "more than 100000 characters of entity text": [
        doctype(f'<!ENTITY a "{"x" * 100_001}">'),
        doctype(f'<!ENTITY a "{"x" * 1000}"><!ENTITY b "{"&a;" * 1000}">'),
        doctype("".join(f'<!ENTITY a{k} "">' for k in range(50_000))),
    ],
    "entities swell it to more than 64 MB": [doctype(f'<!ENTITY a "{"x" * 90_000}">', "&a;" * 1000)],
    "attributes longer than 64 MB together": [
        doctype(f'<!ATTLIST g a CDATA "{"x" * 100_000}">', "<g/>" * 1000)
    ],
    "more than 10000 elements drawn through use": [USE_TEN_TIMES],
    "use nested deeper than 16": [USE_CHAIN],
    r"beyond 1e\+09; smaller ones would work": [
        '<rect width="1" height="1" transform="scale(1e8) scale(1e8)"/>',
        '<rect width="1" height="1" transform="translate(1e8) scale(1e8 1) translate(99 0)"/>',
        '<rect x="9e8" width="9e8" height="1"/>',
        '<svg width="1e8" height="1e8" viewBox="0 0 1e-8 1e-8"><rect width="1" height="1"/></svg>',
        '<rect x="1e5" width="1" height="1" transform="scale(1e5)"/>',
    ],
    "more than 2000 steps of filters, the limit": [
        f'<filter id="f">{"<feOffset/>" * 64}</filter>' + f'<g filter="url(#f)">{RECT}</g>' * 32
    ],
    SLOW_SHEET: [f"<style>x {'g ' * 9}rect {{ fill: red }}</style>{'<g>' * 300}{RECT * 50}{'</g>' * 300}"],
    "more than 1000 custom properties": [
        f'<g style="{";".join(f"--v{k}:1" for k in range(1001))}">{RECT}</g>'
    ],
}


CASES = [(message, markup) for message, drawings in REFUSED.items() for markup in drawings]


@pytest.mark.parametrize(("message", "markup"), CASES, ids=[message for message, _ in CASES])
def test_what_can_do_harm_is_refused(message, markup):
    refused(markup, message)


LIMITS = {
    "size": (xmltree, "MAX_BYTES", 1000, svg(" " * 1000), "larger than"),
    "elements": (xmltree, "MAX_ELEMENTS", 10, "<g/>" * 10, "more than 10 elements"),
    "segments drawn by use": (
        *(walk, "MAX_SEGMENTS", 1000),
        f'<defs><path id="p" d="M0 0{"h1v1" * 100}"/></defs>{"""<use href="#p"/>""" * 6}',
        "more than 1000 segments",
    ),
    "patterns": (
        *(walk, "MAX_CONTENTS", 1),
        f'<pattern id="p" width="1" height="1" patternContentUnits="objectBoundingBox">{RECT}</pattern>'
        '<rect width="1" height="1" fill="url(#p)"/><rect width="2" height="1" fill="url(#p)"/>',
        "more than 1 patterns and masks, the limit",
    ),
    "masks": (
        *(walk, "MAX_CONTENTS", 1),
        f'<mask id="m"><g opacity=".5">{RECT}</g></mask><g mask="url(#m)">{RECT}</g>'
        f'<g mask="url(#m)" transform="scale(2)">{RECT}</g>',
        "more than 1 patterns and masks, the limit",
    ),
    "many rules on many elements": (
        *(stylesheets, "_BUDGET", 10_000),
        f"<style>{'* { fill: red }' * 200}</style>{RECT * 100}",
        SLOW_SHEET,
    ),
    "rules that match": (
        *(stylesheets, "_BUDGET", 10_000),
        f"<style>{'rect { fill: red }' * 30}</style>{RECT * 100}",
        SLOW_SHEET,
    ),
}


@pytest.mark.parametrize(("module", "name", "limit", "markup", "message"), LIMITS.values(), ids=LIMITS)
def test_limits_are_held(module, name, limit, markup, message, monkeypatch):
    monkeypatch.setattr(module, name, limit)
    refused(markup, message)


def test_size_is_limited_after_unpacking():
    refused(gzip.compress(b" " * 65 * 2**20), "larger than 64 MB, the limit")


def test_the_deepest_element_and_any_number_of_siblings_are_read():
    assert boxes(drawn(groups(xmltree.MAX_DEPTH - 2))) == [[0, 0, 1, 2]]
    assert len(drawn(f"<style>circle ~ rect {{ fill: red }}</style><circle/>{RECT * 1500}").shapes) == 1500


def test_use_of_itself_ends():
    drawing = drawn(f'<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/>{RECT}</g>')
    assert boxes(drawing) == 3 * [[0, 0, 1, 2]]
    assert "use of '#a' inside itself left out" in drawing.notes


def test_segments_of_arcs_are_counted_before_they_are_kept(monkeypatch):
    monkeypatch.setattr(path_commands, "MAX_SEGMENTS", 20)
    arcs = '<path d="M0 0{}"/>'.format
    assert len(drawn(arcs("a9 9 0 1 1 1 0" * 2)).shapes[0].contours[0].segments) == 16
    refused(arcs("a9 9 0 1 1 1 0" * 3), "path on line 1: more than 20 segments, the limit")


def test_only_the_beginning_of_a_list_of_classes_counts(monkeypatch):
    monkeypatch.setattr(stylesheets, "_MAX_CLASSES", 10)
    rects = '<rect class="a b c d e f" width="1" height="2"/>'
    drawing = drawn(f"<style>.e {{ fill: #123 }} .f {{ fill: red }}</style>{rects}")
    assert drawing.shapes[0].style.fill == "#112233"


@pytest.mark.parametrize(
    "markup",
    [
        '<rect width="1" height="1" style="fill:' + "(" * 5000 + '"/>',
        "<style>rect { fill: " + "(" * 5000 + "</style>" + RECT,
        "<style>" + ":not(" * 2000 + "</style>" + RECT,
        "<style>" + "{(" * 5000 + "</style>" + RECT,
        f'<g fill="{"rgb(" * 200}">{RECT}</g>',
        f'<g style="--a: var(--b) var(--b); --b: var(--a) var(--a); fill: var(--a)">{RECT}</g>',
        f'<g style="--a: {"x" * 9000}; --b: var(--a) var(--a) var(--a); fill: var(--b)">{RECT}</g>',
    ],
)
def test_nesting_is_read_or_refused(markup):
    try:
        drawing = drawn(markup)
    except InputError as error:
        problem = error.problem
    else:
        problem = None if len(drawing.shapes) == 1 else "shapes lost"
    assert problem in (
        None,
        "a style nested too deeply; without it the file would work",
        "its style sheet is nested too deeply; without it the file would work",
    )


LONG = 200_000


@pytest.mark.parametrize(
    "markup",
    [
        f'<path d="M0 0{" " * LONG}x"/>',
        f'<path d="M0 0A{"1" * LONG}"/>',
        f'<path d="M{"0" * LONG} 0x"/>',
        f'<polygon points="0{" " * LONG}x"/>',
        f'<g transform="{" " * LONG}x"/>',
        f'<g transform="scale(1{" " * LONG}x)"/>',
        f'<g viewBox="0{" " * LONG}x"/>',
        f'<rect width="1{" " * LONG}x" height="1"/>',
        f'<g fill="url({" " * LONG}x"/>',
        f"<style>{'@font-face{' * (LONG // 10)}</style>",
        f'<g style="fill:var({" " * 9000}x"/>',
    ],
)
def test_long_text_takes_linear_time(markup):
    # Quadratic time would be minutes here; there is no clock to be late by.
    refused(markup, r"test\.svg")


def test_notes_are_limited():
    assert len(drawn("".join(f'<use href="#{k}"/>' for k in range(100)) + RECT).notes) == 20
