"""What is painted, in which style, and in which order."""

import numpy as np
import pytest

from shapeblend_cli.model import Stop
from tests.svg.reading.drawings import RECT, boxes, drawn, refused

RED = "#ff0000"


def style(markup, *root):
    (shape,) = drawn(markup, *root).shapes
    return shape.style


PAINT = {
    "without a style": (
        RECT,
        {"fill": "#000000", "fill_rule": "nonzero", "fill_opacity": 1, "stroke": None},
    ),
    "a stroke of no width": ('<rect width="1" height="2" stroke="red" stroke-width="0"/>', {"stroke": None}),
    "a sheet for other media": (
        f'<style media="print">rect {{ fill: red }}</style>{RECT}',
        {"fill": "#000000"},
    ),
    "the order of the cascade": (
        "<style>.a { fill: #000001; stroke: #000002 !important; color: #000003 }</style>"
        '<rect class="a" width="1" height="1" fill="#fff" color="#fff" stroke="#fff" '
        'style="fill:#000004; stroke: #000005; stroke-width: 2 !important" stroke-width="9"/>',
        {"fill": "#000004", "stroke": "#000002", "stroke_width": 2},
    ),
    "all properties": (
        '<g fill-rule="evenodd" fill-opacity=".5" stroke="#0f0" stroke-opacity="50%" opacity=".5" '
        'stroke-linecap="round" stroke-linejoin="bevel" stroke-miterlimit="2.5">'
        '<path d="M0 0h1" style="stroke-width:10%;opacity:.5"/></g>',
        {
            **{"fill_rule": "evenodd", "fill_opacity": 0.5, "stroke": "#00ff00", "stroke_opacity": 0.5},
            **{"stroke_linecap": "round", "stroke_linejoin": "bevel", "stroke_miterlimit": 2.5},
            "stroke_width": pytest.approx(5),
        },
    ),
}


@pytest.mark.parametrize(("markup", "expected"), PAINT.values(), ids=PAINT)
def test_properties_of_a_style(markup, expected):
    painted = style(markup, 'viewBox="0 0 70 10"')
    assert {name: getattr(painted, name) for name in expected} == expected


UNREADABLE = {
    "opacity": ('opacity=".5" style="opacity:half"', {"fill_opacity": 0.5}),
    "fill-opacity": ('style="fill-opacity:.5;fill-opacity:foo"', {"fill_opacity": 0.5}),
    "stroke-width": ('stroke="red" style="stroke-width:3;stroke-width:-3"', {"stroke_width": 3}),
    "stroke-linecap": (
        'stroke="red" stroke-linecap="round" style="stroke-linecap:oval"',
        {"stroke_linecap": "round"},
    ),
    "font-size": ('stroke="red" stroke-width="1em" font-size="5" style="font-size:foo"', {"stroke_width": 5}),
    "a rule after another": ('class="a b" stroke="red"', {"stroke_width": 3, "fill_opacity": 0.5}),
}


@pytest.mark.parametrize(("attributes", "expected"), UNREADABLE.values(), ids=UNREADABLE)
def test_a_value_that_cannot_be_read_leaves_an_earlier_one(attributes, expected):
    sheet = "<style>.a { stroke-width: 3; fill-opacity: .5 } .b { stroke-width: wide; fill-opacity: half }</style>"
    painted = style(f'{sheet}<rect width="1" height="2" {attributes}/>')
    assert {name: getattr(painted, name) for name in expected} == expected


PLACED = {
    "transform": ('transform="translate(5)" style="transform:translate(7)"', [[5, 0, 6, 2]]),
    "the property of one transform": ('style="translate:5px;translate:up"', [[5, 0, 6, 2]]),
    "display": ('display="none" style="display:shown"', []),
    "clip-path": ('clip-path="url(#nothing)" style="clip-path:foo"', []),
}


@pytest.mark.parametrize(("attributes", "expected"), PLACED.values(), ids=PLACED)
def test_so_do_other_properties(attributes, expected):
    markup = f'<clipPath id="nothing"/><g {attributes}>{RECT}</g><rect x="90" width="9" height="9"/>'
    assert boxes(drawn(markup)) == [*expected, [90, 0, 99, 9]]


def test_so_do_stops():
    stop = '<stop stop-color="red" stop-opacity=".5" style="stop-color:foo;stop-opacity:foo"/>'
    painted = style(
        f'<linearGradient id="g">{stop}</linearGradient><rect width="1" height="2" fill="url(#g)"/>'
    )
    assert (painted.fill, painted.fill_opacity) == (RED, 0.5)


def test_what_is_not_inherited_is_where_it_is_asked_for():
    inner = '<g><g opacity=".5"><g style="opacity:inherit"><rect width="1" height="2" opacity="inherit"/></g></g></g>'
    assert style(inner).fill_opacity == 0.125
    assert style(f'<g opacity="inherit">{RECT}</g>').fill_opacity == 1
    stop = '<stop stop-color="inherit" style="stop-opacity:inherit"/>'
    for around in ('style="stop-color:red" stop-opacity=".5"', ""):
        server = f'<linearGradient id="g" {around}>{stop}</linearGradient>'
        painted = style(f'{server}<rect width="1" height="2" fill="url(#g)"/>')
        assert (painted.fill, painted.fill_opacity) == ((RED, 0.5) if around else ("#000000", 1))


def test_inheritance_through_many_elements_is_found_once():
    deep = '<g opacity="inherit">' * 900 + '<rect width="1" height="2" opacity="inherit"/>' * 9 + "</g>" * 900
    for shape in drawn(f'<g opacity=".999">{deep}</g>').shapes:
        opacities = [shape.style.fill_opacity, *(effect.opacity for effect in shape.effects)]
        assert np.prod(opacities) == pytest.approx(0.999**902)


def test_a_value_that_is_computed_or_replaced_later_counts():
    drawing = drawn(
        '<rect width="1" height="2" stroke="red" stroke-width="3" style="stroke-width:calc(1px + 1px)"/>'
    )
    assert drawing.shapes[0].style.stroke_width == 1
    assert drawing.notes == ("stroke-width cannot be read",)
    assert (
        style('<rect width="1" height="2" opacity=".5" style="--o:.2;opacity:var(--o)"/>').fill_opacity == 0.2
    )


ANIMATED = {
    "animate": '<rect width="1" height="2"><animate attributeName="x" to="9" dur="1s"/></rect>',
    "set": f'{RECT}<set href="#a" attributeName="x" to="9" begin="click"/><animateMotion path="M0 0h9" dur="1s"/>',
    "keyframes": f"<style>@keyframes k {{ to {{ translate: 9px }} }} rect {{ animation: k 1s }}</style>{RECT}",
}


@pytest.mark.parametrize("markup", ANIMATED.values(), ids=ANIMATED)
def test_what_is_animated_is_read_at_rest_and_that_is_said_once(markup):
    drawing = drawn(markup)
    assert boxes(drawing) == [[0, 0, 1, 2]]
    assert drawing.notes == ("read as it is without its animations",)


def test_a_sheet_with_a_transition_is_no_animation():
    assert drawn(f"<style>rect {{ transition: fill 1s }}</style>{RECT}").notes == ()


DOTS = {
    "path": '<path d="M1 1h4M5 5h0m2 2z"/>',
    "line": '<line x1="5" y1="5" x2="5" y2="5"/>',
    "polyline": '<polyline points="5 5 5 5"/>',
}


@pytest.mark.parametrize(
    ("markup", "cap"), [(each, cap) for each in DOTS.values() for cap in ("round", "butt")]
)
def test_what_has_no_length_is_a_dot_of_two_caps(markup, cap):
    around = f'<g transform="rotate(90)" fill="none" stroke="#000" stroke-width="2" stroke-linecap="{cap}">'
    shapes = drawn(f"{RECT}{around}{markup}</g>").shapes
    lines = [contour.segments[0] for shape in shapes[1:] for contour in shape.contours]
    dots = [line for line in lines if 0 < abs(line[3] - line[0]) < 0.01]
    assert [round(line.mean().real) for line in dots] == (
        [] if cap == "butt" else [-5, -7][: 1 + ("z" in markup)]
    )


NOT_PAINTED = {
    "defs": "<defs>{}</defs>",
    "symbol": "<symbol>{}</symbol>",
    "clipPath": "<clipPath>{}</clipPath>",
    "mask": "<mask>{}</mask>",
    "marker": "<marker>{}</marker>",
    "pattern": "<pattern>{}</pattern>",
    "unknown element": "<foo>{}</foo>",
    "other namespace": '<x:g xmlns:x="urn:x">{}</x:g>',
    "fill is none on a group": '<g fill="none">{}</g>',
    "not displayed": '<g display="none">{}</g>',
    "not displayed, in a style": '<g style="display: none !important">{}</g>',
    "hidden": '<g visibility="hidden">{}</g>',
    "collapsed": '<g visibility="collapse">{}</g>',
    "opacity 0": '<g opacity="0">{}</g>',
    "other language": '<g systemLanguage="de">{}</g>',
    "extension": '<g requiredExtensions="urn:x">{}</g>',
}


@pytest.mark.parametrize("around", NOT_PAINTED.values(), ids=NOT_PAINTED)
def test_not_painted_is_not_a_shape(around):
    inner = '<rect width="99" height="99"/>'
    assert boxes(drawn(around.format(inner) + RECT)) == [[0, 0, 1, 2]]
    refused(around.format(inner), "no painted shape")


def test_a_frame_with_neither_fill_nor_stroke_is_not_a_shape():
    refused(
        '<rect width="24" height="24" fill="none"/>',
        r"1 shape with neither fill nor stroke.* a filled or stroked path would work",
    )


def test_shapes_come_in_paint_order_with_their_ids():
    drawing = drawn(
        '<circle r="1" id="a"/><g><path d="M0 0h1" id="b"/><use href="#a" id="c"/></g><use href="#d" id="e"/>'
        '<defs><g id="d"><rect width="1" height="1"/></g></defs>'
    )
    found = [(s.index, s.id, s.element) for s in drawing.shapes]
    assert found == [(0, "a", "circle"), (1, "b", "path"), (2, "a", "circle"), (3, "e", "rect")]


def test_control_characters_do_not_get_into_ids():
    drawing = drawn('<rect id="a&#10;&#x9b;31m&#x202e;b" width="1" height="1"/>')
    assert drawing.shapes[0].id == "a31mb"


def test_switch_draws_its_first_child_that_fits():
    illustrator = (
        '<switch><foreignObject requiredExtensions="http://ns.adobe.com/" width="1" height="1"/>'
        '<x:g xmlns:x="urn:x"/><g>{}</g><g><rect width="9" height="9"/></g></switch>'
    )
    assert boxes(drawn(illustrator.format(RECT))) == [[0, 0, 1, 2]]


STYLES = {
    "attribute": '<rect width="1" height="2" fill="red"/>',
    "inherited": '<g fill="red"><g>{}</g></g>',
    "style beats attribute": '<g fill="blue" style="fill:red">{}</g>',
    "unreadable colour in a style": '<g fill="red" style="fill:oops">{}</g>',
    "unreadable colour": '<g fill="red"><g fill="oops">{}</g></g>',
    "later colour unreadable": '<g style="fill:red;fill:oops(1)">{}</g>',
    "later colour for light and dark": '<g fill="#00f" style="fill:light-dark(#f00, var(--dark, #0f0))">{}</g>',
    "colours for light and dark in a variable": '<g style="--c:light-dark(red, lime);fill:var(--c)">{}</g>',
    "later colour better": '<g style="fill:#00f;fill:color(display-p3 1 0 0)">{}</g>',
    "current colour": '<g color="red" fill="currentColor">{}</g>',
    "current colour of the shape": '<g color="blue" fill="currentColor"><g style="color:red">{}</g></g>',
    "variable": '<g style="--c:red"><g fill="var(--c, blue)">{}</g></g>',
    "variable's fallback": '<g fill="var(--c, var(--d, red))">{}</g>',
    "variable without a value": '<g fill="red"><g style="fill:var(--c)">{}</g></g>',
    "through use": '<defs><g id="r">{}</g></defs><use href="#r" fill="red"/>',
    "comment in a style": '<g style="/* fill:blue; */ fill:red">{}</g>',
}


@pytest.mark.parametrize("markup", STYLES.values(), ids=STYLES)
def test_fill_is_what_the_cascade_and_inheritance_make_it(markup):
    assert style(markup.format(RECT)).fill == RED


def test_fill_is_inherited_from_the_root():
    assert style(RECT, 'fill="red"').fill == RED


SHEETS = {
    "type": "rect { fill: red }",
    "class": ".a { fill: red } rect { fill: blue }",
    "one of several classes": ".b { fill: red }",
    "id": "#i { fill: red } .a.b { fill: blue }",
    "later of two": ".b { fill: blue } .a { fill: red }",
    "list": "circle, .a { fill: red }",
    "descendant": "svg .a { fill: red } .a { fill: blue }",
    "child": "g > rect { fill: red } svg > rect { fill: blue }",
    "sibling": "circle + rect { fill: red } circle ~ circle { fill: blue }",
    "n-th child": "rect:nth-child(2) { fill: red }",
    "not": "rect:not(.c) { fill: red }",
    "attribute": "[width='1'] { fill: red }",
    "important": "rect { fill: red !important } #i { fill: blue }",
    "nothing but important": "rect { fill: red !important }",
    "media": "@media screen { rect { fill: red } } @media print { rect { fill: blue } }",
    "after an embedded font": "@font-face{src:url(data:font/woff;base64,AA)} rect { fill: red }",
    "after nonsense": "} ] !! rect::: {} .a { fill: red } rect { ",
    "cdata": "<![CDATA[ g > .a { fill: red } ]]>",
    "unquoted url before": ".a { background: url(x{}) ; fill: red }",
    "long, which expat hands over in pieces": "circle { fill: blue }\n" * 5000 + "rect { fill: red }",
}


@pytest.mark.parametrize("sheet", SHEETS.values(), ids=SHEETS)
def test_style_sheet_selects(sheet):
    sheet = sheet if "CDATA" in sheet else sheet.replace(">", "&gt;")
    shape = '<rect class="a b" id="i" width="1" height="1"/>'
    drawing = drawn(f"<style>{sheet}</style><g><circle/>{shape}</g>")
    assert drawing.shapes[-1].style.fill == RED


STOPS = '<linearGradient id="h"><stop stop-color="#0a0"/><stop/></linearGradient>'


@pytest.mark.parametrize(
    ("fill", "colour"),
    [
        ("url(#p) red", "#ff0000"),
        ("url(#p)", None),
        ("url(#missing)", None),
        ("url(#missing) none", None),
        ("url(other.svg#g)", None),
        ("url(other.svg#g) #123", "#112233"),
    ],
)
def test_paint_that_is_not_there_is_what_comes_after_it_or_none(fill, colour):
    painted = style(f'<defs><pattern id="p"/></defs><g fill="{fill}" stroke="blue">{RECT}</g>')
    assert (painted.fill, painted.fill_gradient) == (colour, None)


@pytest.mark.parametrize("fill", ["url(#g)", "url('#g') none", "url(#g) red"])
def test_a_gradient_is_read_with_a_colour_that_stands_for_it(fill):
    drawing = drawn(f'<linearGradient id="g" href="#h"/>{STOPS}<g fill="{fill}">{RECT}</g>')
    painted = drawing.shapes[0].style
    assert painted.fill == "#00aa00"
    assert painted.fill_gradient.stops == (Stop(0, "#00aa00"), Stop(0, "#000000"))
    assert drawing.notes == ()


NOTES = {
    "in the order of the file": (
        '<rect stroke="?" fill="?" stroke-width="?" width="1" height="2"/>',
        ("stroke cannot be read", "fill cannot be read", "stroke-width cannot be read"),
    ),
    "a pattern": (
        f'<pattern id="p" width="99" height="99">{RECT}</pattern><g fill="url(#p)">{RECT}</g>',
        ("a gradient or pattern read as a plain colour",),
    ),
    "effects": (
        f'<g style="backdrop-filter:blur(2px)" filter="url(#no)">{RECT}</g><g filter="url(#i)">{RECT}</g>'
        '<filter id="i"><feImage href=""/></filter>',
        ("backdrop-filter not applied", "feImage of a filter not applied", "filter not applied (2 times)"),
    ),
    "left out": (
        f'<image/><image/><foreignObject/><g clip-path="url(#c)" filter="none">{RECT}</g>'
        f'<use href="#x"/><use href="http://example.org/a.svg#b"/>',
        (
            "image left out (2 times)",
            "foreignObject left out",
            "clip-path not applied",
            "use of '#x', which is not in the file, left out",
            "use of 'http://example.org/a.svg#b', which is not in the file, left out",
        ),
    ),
}


@pytest.mark.parametrize(("markup", "notes"), NOTES.values(), ids=NOTES)
def test_what_is_not_drawn_as_it_stands_is_noted(markup, notes):
    assert drawn(markup).notes == notes


@pytest.mark.parametrize(
    "sheet",
    [
        "<style>rect { fill: red } @media (prefers-color-scheme: light) { rect { fill: blue } } "
        "@media (prefers-color-scheme:dark) { rect { fill: lime } }</style>",
        '<style>rect { fill: red }</style><style media="( prefers-color-scheme:light )">rect { fill: blue }</style>',
    ],
)
def test_of_two_colour_schemes_the_light_one_is_taken_and_said(sheet):
    drawing = drawn(f"{sheet}{RECT}")
    assert drawing.shapes[0].style.fill == "#0000ff"
    assert drawing.notes == ("prefers-color-scheme: light taken",)


def dashes(value, more=""):
    markup = f'<g stroke="red" font-size="10" stroke-dasharray="{value}" {more}>{RECT}</g>'
    painted = style(markup, 'viewBox="0 0 30 40"')
    return painted.stroke_dasharray, painted.stroke_dashoffset


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("none", ()),
        ("5", (5,)),
        ("1 2,3 , 4", (1, 2, 3, 4)),
        ("1px 1pt 1em", (1, 4 / 3, 10)),
        # A share of the viewport's diagonal, by its root mean square: 35.36.
        ("10% 1", (pytest.approx(1250**0.5 / 10), 1)),
        ("0 0", ()),
        ("0 4", (0, 4)),
    ],
)
def test_dashes_are_read_in_user_units(value, expected):
    assert dashes(value)[0] == pytest.approx(expected)


@pytest.mark.parametrize("value", ["1 -2", "1;2", "1 " * 2000, "calc(1px)"])
def test_dashes_that_cannot_be_read_are_noted_and_the_line_is_solid(value):
    drawing = drawn(f'<g stroke="red" stroke-dasharray="{value}">{RECT}</g>')
    assert drawing.shapes[0].style.stroke_dasharray == ()
    assert drawing.notes == ("stroke-dasharray cannot be read",)


def test_dashes_grow_with_the_stroke():
    assert dashes("1 2", 'stroke-dashoffset="-3" transform="scale(2)"') == ((2, 4), -6)
    assert dashes("1 2", 'style="stroke-dashoffset:1em"') == ((1, 2), 10)


def test_a_miter_limit_below_1_and_a_pathlength_are_noted():
    drawing = drawn(
        '<path d="M0 0H9" pathLength="3" stroke="red" stroke-dasharray="1" stroke-miterlimit=".5"/>'
    )
    assert drawing.shapes[0].style.stroke_miterlimit == 4
    assert drawing.notes == ("stroke-miterlimit cannot be read", "pathLength not applied to dashes")
