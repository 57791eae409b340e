"""Markers at the vertices of lines."""

import pytest

from shapeblend_cli.geometry import cubics
from shapeblend_cli.svg.reading.read import read
from tests.support.drawings import svg

ARROW = '<marker id="m" viewBox="0 0 10 10" refX="10" refY="5" {}><path d="M0 0L10 5L0 10Z"/></marker>'
DOT = '<marker id="m" markerWidth="2" markerHeight="2" refX="1" refY="1"><circle cx="1" cy="1" r="1" {}/></marker>'


def shapes(*elements):
    """What a document with these elements paints."""
    return read("a.svg", svg(*elements).encode()).shapes


def boxes(*elements):
    """The boxes of all shapes but the first, the line itself."""
    return [cubics.bounds(shape.contours[0].segments).bounds for shape in shapes(*elements)[1:]]


def line(d, rest=""):
    """A line 2 wide."""
    return f'<path d="{d}" fill="none" stroke="#00f" stroke-width="2" {rest}/>'


def test_an_arrowhead_ends_at_the_end_and_is_as_large_as_the_stroke_is_wide():
    (box,) = boxes(ARROW.format('orient="auto"'), line("M2 12H20", 'marker-end="url(#m)"'))
    assert box == pytest.approx((14.0, 9.0, 20.0, 15.0))  # 3 by 3, times the width


@pytest.mark.parametrize(
    ("attributes", "place", "expected"),
    [
        ('orient="auto"', "start", (-4.0, 9.0, 2.0, 15.0)),
        ('orient="auto-start-reverse"', "start", (2.0, 9.0, 8.0, 15.0)),
        ('orient="90"', "end", (17.0, 6.0, 23.0, 12.0)),
        ('orient="1e999"', "end", (14.0, 9.0, 20.0, 15.0)),
        ('orient="1.5707963rad"', "end", (17.0, 6.0, 23.0, 12.0)),
        ('markerUnits="userSpaceOnUse" markerWidth="4" markerHeight="4"', "end", (16.0, 10.0, 20.0, 14.0)),
        ('orient="auto" display="none"', "end", (14.0, 9.0, 20.0, 15.0)),
        ('markerWidth="6" markerHeight="3"', "end", (14.0, 9.0, 20.0, 15.0)),
    ],
)
def test_its_attributes_place_turn_and_scale_it(attributes, place, expected):
    (box,) = boxes(ARROW.format(attributes), line("M2 12H20", f'marker-{place}="url(#m)"'))
    assert box == pytest.approx(expected, abs=1e-5)


def test_vertices_within_a_line_have_markers_between_both_directions():
    found = boxes(ARROW.format('orient="auto"'), line("M2 2H12V20", 'marker-mid="url(#m)"'))
    assert len(found) == 1
    tip = 12 + 2j
    left, top, right, bottom = found[0]
    assert right == pytest.approx(tip.real, abs=3.0)
    assert (right - left, bottom - top) == pytest.approx((6.36, 6.36), abs=0.01)


def test_markers_are_inherited_and_a_closed_path_has_one_at_both_ends():
    group = f'<g style="marker: url(#m)">{line("M2 2H20V20H2Z")}</g>'
    centres = [(round((x + z) / 2, 6), round((y + w) / 2, 6)) for x, y, z, w in boxes(DOT.format(""), group)]
    assert sorted(centres) == [(2, 2), (2, 2), (2, 20), (20, 2), (20, 20)]


def test_they_take_the_paint_of_the_line_if_they_ask_for_it():
    dot = shapes(DOT.format('fill="context-stroke"'), line("M2 2H20", 'marker-end="url(#m)"'))[1]
    assert dot.style.fill == "#0000ff"
    plain = shapes(DOT.format(""), line("M2 2H20", 'marker-end="url(#m)"'))[1]
    assert plain.style.fill == "#000000"


def test_what_lies_outside_of_the_box_is_clipped_unless_it_overflows():
    wide = '<marker id="m" markerWidth="2" markerHeight="2" {}><rect width="9" height="9"/></marker>'
    clipped = shapes(wide.format(""), line("M2 2H20", 'marker-end="url(#m)"'))[1]
    assert [cubics.bounds(clip.paths[0].segments).bounds for clip in clipped.clips] == [
        (20.0, 2.0, 24.0, 6.0)
    ]
    shown = shapes(wide.format('style="overflow:visible"'), line("M2 2H20", 'marker-end="url(#m)"'))[1]
    assert not shown.clips


@pytest.mark.parametrize(
    ("marker", "d", "note"),
    [
        ("", "M2 2H20", "a marker that is not in the file left out"),
        (DOT.format(""), "M2 2" + "h.01" * 501, "more than 500 markers of an element left out"),
    ],
)
def test_what_cannot_be_marked_is_noted(marker, d, note):
    drawing = read(
        "a.svg", svg(*filter(None, [marker, line(d, 'marker-mid="url(#m)" marker-end="url(#m)"')])).encode()
    )
    assert len(drawing.shapes) == 1
    assert any(note in each for each in drawing.notes)


def test_a_marker_that_marks_its_own_lines_is_drawn_once():
    own = '<marker id="m" style="marker-end:url(#m)"><path d="M0 0H1" stroke="#000" marker-end="url(#m)"/></marker>'
    assert len(shapes(own, line("M2 2H20", 'marker-end="url(#m)"'))) == 2
