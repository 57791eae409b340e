"""Paint between two paints: strokes, dashes, opacity, and whose paint it is."""

import pytest

from shapeblend_cli.model import LinearGradient, RadialGradient, Stop, Style
from shapeblend_cli.paint.styles import MOST_DASHES, blend_styles, common_dashes, keyed_styles, painted_as

LINE = Style(fill=None, stroke="#000000")
FADE = (Stop(0.0, "#ff0000"), Stop(1.0, "#0000ff"))
LINEAR = LinearGradient(0j, 10 + 0j, FADE)
RADIAL = RadialGradient(5 + 5j, (5.0, 5.0), 0.0, 0j, 0.0, FADE)


def at(a, b, t):
    return blend_styles(a, b, t)[0]


def test_numbers_go_straight_and_keywords_change_at_half_time():
    a = LINE._replace(stroke_width=1.0, stroke_miterlimit=2.0, stroke_opacity=0.5)
    keywords = {"stroke_linecap": "round", "stroke_linejoin": "bevel"}
    b = LINE._replace(stroke_width=3.0, stroke_miterlimit=6.0, stroke_opacity=1.0, **keywords)
    early, late = at(a, b, 0.25), at(a, b, 0.5)
    assert (early.stroke_width, early.stroke_miterlimit, early.stroke_opacity) == (1.5, 3.0, 0.625)
    assert (early.stroke_linecap, early.stroke_linejoin) == ("butt", "miter")
    assert (late.stroke_linecap, late.stroke_linejoin) == ("round", "bevel")


def test_strokes_that_do_not_scale_change_evenly_on_the_screen():
    a = LINE._replace(stroke_width=2.0, stroke_dasharray=(8.0, 4.0), pixel=1.0)
    b = LINE._replace(stroke_width=0.4, stroke_dasharray=(0.4, 0.2), pixel=0.1)
    for t, width, dash in ((0.0, 2.0, 8.0), (0.25, 2.5, 7.0), (1.0, 4.0, 4.0)):
        found = at(a, b, t).stretched(1.0 / at(a, b, t).pixel)
        assert (found.stroke_width, *found.stroke_dasharray) == pytest.approx((width, dash, dash / 2))


def test_a_stroke_that_scales_becomes_one_that_does_not_at_half_time():
    a = LINE._replace(stroke_width=32.0, stroke_dasharray=(50.0, 20.0))
    b = LINE._replace(stroke_width=2.0, stroke_dasharray=(4.0, 1.0), pixel=0.1)
    for style, t in ((a, 0.0), (a, 0.49), (b, 0.5), (b, 1.0)):
        found = at(a, b, t)
        assert (found.stroke_width, found.stroke_dasharray, found.pixel) == (
            style.stroke_width,
            style.stroke_dasharray,
            style.pixel,
        )
    assert at(Style(), b, 0.25).pixel == 0.1


FILL = Style(fill="#000000", stroke=None)
ENLARGED = FILL._replace(stroke="#000000", stroke_width=2.0, stroke_linejoin="round")


def test_a_stroke_that_only_makes_its_fill_larger_gets_thin():
    for a, b, width in ((ENLARGED, FILL, 1.5), (FILL, ENLARGED, 0.5)):
        found, _ = blend_styles(a, b, 0.25)
        assert (found.stroke, found.stroke_opacity, found.stroke_width) == ("#000000", 1.0, width)
        assert found.stroke_linejoin == "round"
    red = FILL._replace(fill="#ff0000")
    found, _ = blend_styles(ENLARGED, red, 0.5)
    assert found.stroke == found.fill not in ("#000000", "#ff0000")


@pytest.mark.parametrize(
    "other", [{"stroke": "#ff0000"}, {"fill": None}, {"fill_opacity": 0.5, "stroke_opacity": 0.5}]
)
def test_strokes_that_are_seen_beside_their_fill_fade(other):
    found, _ = blend_styles(ENLARGED._replace(**other), FILL, 0.25)
    assert found.stroke_width == 2.0
    assert found.stroke_opacity == 0.75 * other.get("stroke_opacity", 1.0)


def test_of_several_drawings_it_gets_thin_where_there_is_none():
    (keyed,) = keyed_styles([ENLARGED, FILL, ENLARGED])
    assert [style.stroke_width for style in keyed] == [2.0, 0.0, 2.0]
    assert [style.stroke_opacity for style in keyed] == [1.0, 1.0, 1.0]


def test_a_stroke_that_fades_in_has_its_own_shape_all_along():
    b = LINE._replace(stroke_width=3.0, stroke_linecap="round", stroke_dasharray=(2.0, 1.0))
    found = at(Style(), b, 0.25)
    assert (found.stroke_width, found.stroke_linecap, found.stroke_dasharray) == (3.0, "round", (2.0, 1.0))
    assert found.stroke_opacity == 0.25


@pytest.mark.parametrize(
    ("a", "b", "common"),
    [
        ((), (), ((), ())),
        ((4, 2), (6, 1), ((4, 2), (6, 1))),
        ((4, 2), (1, 1, 3, 1), ((4, 2, 4, 2), (1, 1, 3, 1))),
        # Once through an odd list, what was a dash is a gap.
        ((1, 2, 3), (5,), ((1, 2, 3, 1, 2, 3), (5, 5, 5, 5, 5, 5))),
        ((1, 2, 3, 4), (1, 2, 3, 4, 5, 6), ((1, 2, 3, 4) * 3, (1, 2, 3, 4, 5, 6) * 2)),
        ((), (3, 1, 2, 2), ((4, 0, 4, 0), (3, 1, 2, 2))),
        ((7,), (), ((7, 7), (14, 0))),
    ],
)
def test_dashes_are_repeated_to_one_length(a, b, common):
    assert common_dashes(a, b) == common


@pytest.mark.parametrize(
    ("a", "b", "halfway"),
    [
        # Gaps open between dashes that stay where they are.
        (((), 0.0), ((6.0, 2.0), 3.0), ((7.0, 1.0), 3.0)),
        (((6.0, 2.0), 3.0), ((), 0.0), ((7.0, 1.0), 3.0)),
        (((4.0, 2.0), 0.0), ((8.0, 4.0, 2.0, 4.0), 10.0), ((6.0, 3.0, 3.0, 3.0), 5.0)),
    ],
)
def test_dashes_and_their_offset_blend(a, b, halfway):
    found = at(*(LINE._replace(stroke_dasharray=d, stroke_dashoffset=o) for d, o in (a, b)), 0.5)
    assert (found.stroke_dasharray, found.stroke_dashoffset) == halfway


def test_lists_of_dashes_with_too_little_in_common_change_at_half_time():
    a = LINE._replace(stroke_dasharray=(1.0,) * 62)
    b = LINE._replace(stroke_dasharray=(2.0,) * 58, stroke_dashoffset=4.0)
    assert MOST_DASHES < 62 * 29
    assert at(a, b, 0.49).stroke_dasharray == a.stroke_dasharray
    assert at(a, b, 0.51).stroke_dasharray == b.stroke_dasharray
    assert (at(a, b, 0.49).stroke_dashoffset, at(a, b, 0.51).stroke_dashoffset) == (0.0, 4.0)


def test_style_of_one_side_leaves_the_fill_rule_of_the_other():
    a = Style(fill="#ff0000", fill_rule="evenodd")
    b = Style(fill="#0000ff", stroke="#00ff00", stroke_width=5.0)
    assert painted_as(a, b, "blend") == (a, b)
    assert painted_as(a, b, "a") == (a, a._replace(fill_rule="nonzero"))
    assert painted_as(a, b, "b") == (b._replace(fill_rule="evenodd"), b)


def test_a_plain_colour_becomes_a_gradient_of_that_colour_first():
    a, b = Style(fill="#00ff00"), Style(fill="#ff0000", fill_gradient=LINEAR)
    start, below = blend_styles(a, b, 0.0)
    assert below is None
    assert start.fill_gradient == LINEAR._replace(stops=(Stop(0.0, "#00ff00"), Stop(1.0, "#00ff00")))
    assert at(a, b, 1.0).fill_gradient == LINEAR
    assert at(b, a, 0.0).fill_gradient == LINEAR


def test_a_gradient_without_a_partner_fades_as_it_is():
    b = Style(fill="#ff0000", fill_gradient=LINEAR)
    found = at(Style(fill=None, stroke="#000000"), b, 0.25)
    assert (found.fill_gradient, found.fill_opacity) == (LINEAR, 0.25)


@pytest.mark.parametrize("opacities", [(1.0, 1.0), (1.0, 0.4), (0.3, 1.0), (0.5, 0.5)])
@pytest.mark.parametrize("t", [0.0, 0.25, 0.5, 0.9, 1.0])
def test_gradients_of_two_kinds_dissolve_into_each_other_evenly(opacities, t):
    a = Style(fill="#ff0000", fill_opacity=opacities[0], fill_gradient=LINEAR)
    b = Style(fill="#ff0000", fill_opacity=opacities[1], fill_gradient=RADIAL)
    top, below = blend_styles(a, b, t)  # B painted over A
    assert (top.fill_gradient, below.fill_gradient) == (RADIAL, LINEAR)
    seen = (1 - top.fill_opacity) * below.fill_opacity, top.fill_opacity
    assert seen == pytest.approx(((1 - t) * opacities[0], t * opacities[1]))


def test_only_what_has_to_dissolve_is_painted_twice():
    a = Style(fill="#ff0000", fill_gradient=LINEAR, stroke="#000000")
    b = Style(fill="#ff0000", fill_gradient=RADIAL, stroke="#000000", stroke_width=3.0)
    top, below = blend_styles(a, b, 0.5)
    assert (top.stroke, top.stroke_width, below.stroke) == ("#000000", 2.0, None)
    a, b = (Style(fill="#123456", stroke="#ff0000", stroke_gradient=g) for g in (LINEAR, RADIAL))
    top, below = blend_styles(a, b, 0.5)
    assert (top.fill, below.fill) == (None, "#123456")
    assert (top.stroke_gradient, below.stroke_gradient) == (RADIAL, LINEAR)
