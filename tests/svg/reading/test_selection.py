"""Which shapes a selector takes out of a drawing, and what is said when it takes none."""

import re

import pytest

from shapeblend_cli.svg.styles import selection, stylesheets
from tests.svg.reading.drawings import RECT, drawn, refused, svg

DRAWING = svg(
    """
<defs><rect id="unused" width="5" height="5"/><g id="tree"><path id="leaf" d="M0 0h5v5z"/></g></defs>
<g id="layer 1" inkscape:label="Wing"><path id="1st" class="st0 x" d="M0 0h5v5z"/><path id="a.b" d="M0 0h6v6z"/></g>
<g id="hidden" display="none"><rect id="inside" width="5" height="5"/></g>
<use id="u1" class="u" href="#tree"/><use id="u2" href="#tree"/>
<circle id="path:2" r="4" class="st0"/>
<rect id="clear" width="5" height="5" fill="none"/>
<image id="words"/><g id="empty"/><linearGradient id="fade"/><use id="lost" href="#nowhere"/>
"""
)
TAKEN = {
    "#1st": [0],
    "#a.b": [1],
    "#layer 1": [0, 1],
    "#path:2": [4],
    "#u1": [2],
    "#tree": [2, 3],
    "#leaf": [2, 3],
    ".u": [2],
    ".st0": [0, 4],
    "path": [0, 1, 2, 3],
    "circle, #u2": [3, 4],
    "svg > path, svg > circle": [4],
    "g path:first-child": [0, 2, 3],
    "use#u2": [3],
    "[inkscape\\:label=Wing] path + path": [1],
    ":not(g):not(svg):not(path):not(use)": [4],
    "use:has(~ circle)": [2, 3],
    "svg": [0, 1, 2, 3, 4],
    "*": [0, 1, 2, 3, 4],
}


@pytest.mark.parametrize("selector", TAKEN)
def test_shapes_are_taken_in_file_order_with_the_numbers_they_have_there(selector):
    drawing = drawn(DRAWING, select=selector)
    assert [shape.index for shape in drawing.shapes] == TAKEN[selector]
    everything = drawn(DRAWING)
    assert [s.id for s in drawing.shapes] == [everything.shapes[k].id for k in TAKEN[selector]]
    assert drawing.viewbox == everything.viewbox


def test_an_id_as_it_stands_comes_before_what_css_makes_of_it():
    paths = '<path id="a.b" d="M0 0h1v1z"/><path id="a" class="b" d="M0 0h2v2z"/>'
    drawing = drawn(paths, select="#a.b")
    assert [shape.index for shape in drawing.shapes] == [0]


NOTHING = {
    "#layer1": "nothing in it matches '#layer1'; #layer 1 would",
    "#LAYER 1": "nothing in it matches '#LAYER 1'; #layer 1 would",
    "layer": "#layer 1 would",
    ".st1": "nothing in it matches '.st1'; .st0 would",
    "g > paht": "nothing in it matches 'g > paht'; path would",
    "#zzzzzz": "its ids are #unused, #tree, #leaf, #layer 1, #1st and 9 more",
    ":hover": "nothing in it matches ':hover'; its ids are",
    "#hidden": "'#hidden' is there (g 'hidden' on line 4) but paints nothing: it is not displayed; "
    "#1st, #a.b or #leaf would work",
    "#inside": "paints nothing: it is in g 'hidden' on line 4, which is not displayed; ",
    "#unused": "paints nothing: it stands in <defs> and no use draws it; ",
    "#clear": "paints nothing: it is with neither fill nor stroke; ",
    "#words": "paints nothing: it is without a picture; ",
    "#empty": "paints nothing: no shape stands in it; ",
    "#fade": "paints nothing: <linearGradient> is no shape; ",
    "#lost": "paints nothing: what it refers to is not drawn; ",
    "defs > rect, image": "is there (rect 'unused' on line 2 and 1 more) but paints nothing",
}


@pytest.mark.parametrize("selector", NOTHING)
def test_a_selector_that_takes_nothing_is_told_why_and_what_would_work(selector):
    assert refused(DRAWING, re.escape(NOTHING[selector]), select=selector).isprintable()


def test_a_file_without_ids_names_what_can_be_selected():
    said = re.escape("it has no ids, but 0 (its first shape), .wing or path would")
    refused('<path class="wing" d="M0 0h1v1z"/>', said, select="#zzz")


def test_a_selector_that_matches_the_document_itself_takes_all_and_that_is_said():
    two = '<path d="M0 0h1v1z"/><path d="M2 0h1v1z"/>'
    drawing = drawn(two, select=":first-child")
    assert len(drawing.shapes) == 2
    assert drawing.notes == ("all shapes are taken: ':first-child' matches the document itself",)
    for select in ("path:first-child", "svg", "*", None):
        assert not drawn(two, select=select).notes


BROKEN = {
    "g >": "it ends too early",
    "g > > a": "at character 5",
    "": "it ends too early",
    "#": "at character 1",
    ":nonsense": "an unknown pseudo-class",
    "path:nth-child(2n+)": "it cannot be read",
    "[*|href]": "not supported",
    ":not(" * 330 + ")" * 330: "nested too deeply",
    "g " * 500 + "path": "nested too deeply",
    "a," * 1001: "more than 2000 characters",
}


@pytest.mark.parametrize("selector", BROKEN, ids=BROKEN.values())
def test_what_is_no_selector_is_told_without_a_file(selector):
    with pytest.raises(selection.SelectorError, match=re.escape(BROKEN[selector])):
        selection.check_selector(selector)
    refused('<path d="M0 0h1v1z"/>', re.escape(BROKEN[selector]), select=selector)


@pytest.mark.parametrize(
    "selector", ["#1st", "#a b", "#" + ":not(" * 900, "path", "g > path:nth-child(2n+1)"]
)
def test_what_may_be_one_is_left_to_the_file(selector):
    selection.check_selector(selector)


@pytest.mark.parametrize(("selector", "numbers"), [("0", [0]), ("2,0", [0, 2]), (" 1 , 2 ", [1, 2])])
def test_shapes_are_selected_by_their_numbers(selector, numbers):
    paths = "".join(f'<path d="M{k} 0h1v1z"/>' for k in range(3))
    assert [shape.index for shape in drawn(paths, select=selector).shapes] == numbers
    refused(paths, "it paints no shape 3; 0 to 2 would work", select="1,3")


def test_a_selector_cannot_take_for_ever(monkeypatch):
    monkeypatch.setattr(stylesheets, "_BUDGET", 100_000)
    deep, slow = "<g>" * 100 + RECT * 50 + "</g>" * 100, "x g g g g g rect"
    refused(deep, f"the selector '{slow}' takes too long to match", select=slow)


def test_only_some_of_many_names_are_compared(monkeypatch):
    monkeypatch.setattr(selection, "_MAX_COMPARED", 10)
    names = "".join(f'<g id="layer{k}"/>' for k in range(5000))
    refused(names + RECT, "'#layer77x'; #layer77", select="#layer77x")


def test_ids_in_messages_are_printable_and_short():
    long = '<rect id="&#x9b;' + "a" * 50_000 + '" width="1" height="2"/>'
    message = refused(long, "nothing in it matches", select="#" + "b" * 50_000)
    assert message.isprintable()
    assert len(message) < 300


def test_a_rule_that_cssselect2_stumbles_over_is_left_out():
    drawing = drawn(f"<style>rect:nth-child(2n+) {{ fill: red }}</style>{RECT}")
    assert drawing.shapes[0].style.fill == "#000000"


def test_siblings_are_matched_whatever_their_number():
    assert len(drawn(f"<circle/>{RECT * 3000}", select="circle + rect").shapes) == 1
