"""Files made to break a reader: each is refused, or read without harm, in little time."""

from __future__ import annotations

import gzip
import io

import pytest

from shapeblend_cli.errors import InputError
from shapeblend_cli.svg.reading import path_data, stylesheets, walk, xmltree
from shapeblend_cli.svg.reading.read import read
from tests.svg.reading.drawings import boxes, drawn, svg

RECT = '<rect width="1" height="2"/>'


def doctype(declarations, text):
    return f"<!DOCTYPE svg [{declarations}]><svg>{text}{RECT}</svg>".encode()


def test_size_is_limited(monkeypatch):
    monkeypatch.setattr(xmltree, "MAX_BYTES", 1000)
    with pytest.raises(InputError, match="larger than"):
        read("a.svg", svg(" " * 1000))


def test_size_is_limited_after_unpacking():
    packed = io.BytesIO()
    with gzip.GzipFile(fileobj=packed, mode="wb") as stream:
        for _ in range(65):
            stream.write(b" " * 2**20)
    with pytest.raises(InputError, match="larger than 64 MB, the most that is read"):
        read("a.svg", packed.getvalue())


def test_depth_is_limited():
    depth = xmltree.MAX_DEPTH - 1
    assert boxes(drawn("<g>" * (depth - 1) + RECT + "</g>" * (depth - 1))) == [[0, 0, 1, 2]]
    with pytest.raises(InputError, match="nested deeper than 1000"):
        drawn("<g>" * (depth + 1) + "</g>" * (depth + 1))


def test_number_of_elements_is_limited(monkeypatch):
    monkeypatch.setattr(xmltree, "MAX_ELEMENTS", 10)
    with pytest.raises(InputError, match="more than 10 elements"):
        drawn("<g/>" * 10)


@pytest.mark.parametrize(
    ("declarations", "message"),
    [
        (
            '<!ENTITY a SYSTEM "file:///etc/passwd">',
            "external entity 'a' in its DOCTYPE; without it the file would work",
        ),
        ('<!ENTITY a PUBLIC "x" "http://example.org/">', "external entity 'a'"),
        ('<!ENTITY % a "x">', "parameter entity 'a'"),
        ('<!ENTITY a "&b;"><!ENTITY b "&a;">', "entity 'a' refers to an unknown one, 'b'"),
        (f'<!ENTITY a "{"x" * 100_001}">', "more than 100000 characters of entity text"),
        (
            f'<!ENTITY a "{"x" * 1000}"><!ENTITY b "{"&a;" * 1000}">',
            "more than 100000 characters of entity text",
        ),
    ],
)
def test_entities_that_can_do_harm_are_refused(declarations, message):
    with pytest.raises(InputError, match=message):
        read("a.svg", doctype(declarations, ""))


def test_entities_cannot_swell_a_file():
    with pytest.raises(InputError, match="entities swell it to more than 64 MB"):
        read("a.svg", doctype(f'<!ENTITY a "{"x" * 90_000}">', "&a;" * 1000))


def test_the_number_of_entities_is_limited():
    with pytest.raises(InputError, match="more than 100000 characters of entity text"):
        read("a.svg", doctype("".join(f'<!ENTITY a{k} "">' for k in range(50_000)), ""))


def test_default_attributes_cannot_swell_a_file():
    with pytest.raises(InputError, match="attributes longer than 64 MB together"):
        read("a.svg", doctype(f'<!ATTLIST g a CDATA "{"x" * 100_000}">', "<g/>" * 1000))


def test_use_of_itself_ends():
    drawing = drawn(f'<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/>{RECT}</g>')
    assert boxes(drawing) == 3 * [[0, 0, 1, 2]]
    assert "use of '#a' inside itself left out" in drawing.notes


def test_use_cannot_multiply_without_end():
    groups = "".join(f'<g id="g{k}">{f"""<use href="#g{k - 1}"/>""" * 10}</g>' for k in range(1, 12))
    with pytest.raises(InputError, match="more than 10000 elements drawn through use"):
        drawn(f'<defs><g id="g0">{RECT}</g>{groups}</defs><use href="#g11"/>')


def test_depth_of_use_is_limited():
    chain = "".join(f'<use id="u{k}" href="#u{k - 1}"/>' for k in range(1, 30))
    with pytest.raises(InputError, match="use nested deeper than 16"):
        drawn(f'<defs><rect id="u0" width="1" height="1"/>{chain}</defs><use href="#u29"/>')


def test_segments_drawn_by_use_are_limited(monkeypatch):
    monkeypatch.setattr(walk, "MAX_SEGMENTS", 1000)
    path = "M0 0" + "h1v1" * 100
    with pytest.raises(InputError, match="more than 1000 segments"):
        drawn(f'<defs><path id="p" d="{path}"/></defs>{"""<use href="#p"/>""" * 6}')


def test_segments_of_arcs_are_counted_before_they_are_kept(monkeypatch):
    monkeypatch.setattr(path_data, "MAX_SEGMENTS", 20)
    assert len(drawn(f'<path d="M0 0{"a9 9 0 1 1 1 0" * 2}"/>').shapes[0].contours[0].segments) == 16
    with pytest.raises(InputError, match="path on line 1: more than 20 segments, the most that are read"):
        drawn(f'<path d="M0 0{"a9 9 0 1 1 1 0" * 3}"/>')


@pytest.mark.parametrize(
    "markup",
    [
        '<rect width="1" height="1" transform="scale(1e8) scale(1e8)"/>',
        '<rect width="1" height="1" transform="translate(1e8) scale(1e8 1) translate(99 0)"/>',
        '<rect x="9e8" width="9e8" height="1"/>',
        '<svg width="1e8" height="1e8" viewBox="0 0 1e-8 1e-8"><rect width="1" height="1"/></svg>',
        '<rect x="1e5" width="1" height="1" transform="scale(1e5)"/>',
    ],
)
def test_huge_coordinates_are_refused(markup):
    with pytest.raises(InputError, match=r"beyond 1e\+09; smaller ones would work"):
        drawn(markup)


def test_style_sheets_cannot_take_for_ever():
    sheet = f"<style>x {'g ' * 9}rect {{ fill: red }}</style>"
    with pytest.raises(InputError, match="style sheet takes too long to match"):
        drawn(sheet + "<g>" * 300 + RECT * 50 + "</g>" * 300)


def test_many_rules_on_many_elements_cannot_take_for_ever(monkeypatch):
    monkeypatch.setattr(stylesheets, "_BUDGET", 10_000)
    with pytest.raises(InputError, match="style sheet takes too long to match"):
        drawn(f"<style>{'* { fill: red }' * 200}</style>{RECT * 100}")


def test_rules_that_match_are_paid_for(monkeypatch):
    monkeypatch.setattr(stylesheets, "_BUDGET", 10_000)
    with pytest.raises(InputError, match="style sheet takes too long to match"):
        drawn(f"<style>{'rect { fill: red }' * 30}</style>{RECT * 100}")


def test_only_the_beginning_of_a_list_of_classes_counts(monkeypatch):
    monkeypatch.setattr(stylesheets, "_MAX_CLASSES", 10)
    rects = '<rect class="a b c d e f" width="1" height="2"/>'
    drawing = drawn(f"<style>.e {{ fill: #123 }} .f {{ fill: red }}</style>{rects}")
    assert drawing.shapes[0].style.fill == "#112233"


def test_siblings_are_not_recursed_over():
    assert len(drawn(f"<style>circle ~ rect {{ fill: red }}</style><circle/>{RECT * 1500}").shapes) == 1500


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
        "a style nested too deep; without it the file would work",
        "its style sheet is nested too deep; without it the file would work",
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
    with pytest.raises(InputError, match=r"test\.svg"):
        drawn(markup)


def test_custom_properties_are_limited():
    with pytest.raises(InputError, match="more than 1000 custom properties"):
        drawn(f'<g style="{";".join(f"--v{k}:1" for k in range(1001))}">{RECT}</g>')


def test_notes_are_limited():
    assert len(drawn("".join(f'<use href="#{k}"/>' for k in range(100)) + RECT).notes) == 20
