"""Pictures and elements that filters show, with feImage."""

import re

import pytest

from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.interpolate.chains import keyframed_shapes
from shapeblend_cli.model import Box, Raster, View
from shapeblend_cli.options.easing import Timing
from shapeblend_cli.outputs.formats import Documents
from shapeblend_cli.svg.effects import images
from shapeblend_cli.svg.reading.images import element
from shapeblend_cli.svg.writing.animation import Views
from shapeblend_cli.svg.writing.css import css_svg
from shapeblend_cli.svg.writing.document import frame_svg
from shapeblend_cli.svg.writing.smil import smil_svg
from tests.support.images import MEDIA, checkerboard, encoded, face, uri
from tests.svg.effects.test_effects import BOX, difference, pair_of, picture
from tests.svg.reading.drawings import drawn, refused, svg

VIEW = Box(0.0, 0.0, 100.0, 100.0)
LINK = uri(encoded(checkerboard(2, 4)))
CIRCLE = '<defs><circle id="c" cx="10" cy="8" r="6" fill="red"/></defs>'


def shown(attributes, more="", around=""):
    """A box with a filter that shows something: BOX is 40 x 30 at 20, 30."""
    step = f"<feImage {attributes}/>"
    return f'<filter id="f" {around}>{step}{more}</filter><g filter="url(#f)">{BOX}</g>'


def step(markup):
    """The first step of the filter of the first shape."""
    (effect,) = drawn(markup).shapes[0].effects
    return effect.filter.steps[0]


def text_of(markup):
    return svg(markup).decode()


def ends(markup):
    pair, _ = pair_of(markup, markup)
    return frame_svg(frame_at(pair, 0.0, as_drawn=True), 2)


@pytest.mark.parametrize(
    ("given", "around", "box"),
    [
        ("", "", (16, 27, 48, 36)),
        ('x="1" height="50%"', "", (1, 27, 48, 50)),
        ('x="1" y="2" width="3" height="4"', "", (1, 2, 3, 4)),
        ('x=".5" y="0" width="50%" height="1"', 'primitiveUnits="objectBoundingBox"', (40, 30, 20, 30)),
        ('x=".5" width=".1"', 'primitiveUnits="objectBoundingBox"', (40, 27, 4, 36)),
    ],
)
def test_what_is_not_given_of_its_box_is_that_of_the_filter(given, around, box):
    found = step(shown(f'href="{LINK}" {given}', around=around))
    assert isinstance(found.image, Raster)
    assert found.region == pytest.approx(Box(*box))


@pytest.mark.parametrize("fit", ["", "none", "xMinYMin slice"])
@pytest.mark.parametrize("box", ["", 'x="25" y="32" width="30" height="8"'])
def test_pictures_look_as_in_the_file(fit, box):
    fit = fit and f'preserveAspectRatio="{fit}"'
    over = '<feBlend in2="SourceGraphic" mode="multiply"/>'
    markup = shown(f'href="{LINK}" {box} {fit}', over, 'color-interpolation-filters="sRGB"')
    assert difference(picture(ends(markup)), picture(text_of(markup))) < 0.004


def test_elements_are_at_the_corner_of_their_box():
    markup = CIRCLE + shown('href="#c" x="30" y="30" width="13" height="20"')
    assert isinstance(step(markup).image, View)
    like = '<clipPath id="k"><path d="M30 30H43V50H30Z"/></clipPath><circle cx="40" cy="38" r="6" fill="red" {}/>'
    assert difference(picture(ends(markup)), picture(text_of(like.format('clip-path="url(#k)"')))) < 0.01
    inner = shown('href="#c"')
    moved = CIRCLE + f'<g transform="translate(10 5) scale(.5)">{inner}</g>'
    wanted = '<circle cx="23" cy="22.5" r="3" fill="red"/>'
    assert difference(picture(ends(moved)), picture(text_of(wanted))) < 0.01


def test_an_element_that_is_not_there_is_empty():
    markup = shown('href="#no"')
    assert step(markup).image.content.shapes == ()
    assert (picture(ends(markup)) == 1.0).all()


@pytest.mark.parametrize("href", ["", "http://example.org/a.png", "data:image/png;base64,AAAA", "#i"])
def test_what_cannot_be_shown_leaves_the_filter_out(href):
    inside = f'<defs><g id="i"><image width="9" height="9" href="{LINK}"/></g></defs>'
    drawing = drawn(inside + shown(f'href="{href}"'))
    assert drawing.shapes[0].effects == ()
    assert "feImage of a filter not applied" in drawing.notes


def test_a_group_that_its_own_filter_shows_comes_to_an_end():
    assert drawn(f'<filter id="f"><feImage href="#r"/></filter><g id="r" filter="url(#f)">{BOX}</g>').shapes


def test_one_picture_is_blended_as_it_is_and_another_one_dissolves():
    blur = '<feGaussianBlur stdDeviation="{}"/>'
    pair, _ = pair_of(*(shown(f'href="{LINK}"', blur.format(k)) for k in (1, 3)))
    (effect,) = frame_at(pair, 0.5, as_drawn=False).shapes[0].effects
    assert [dict(each.numbers).get("stdDeviation") for each in effect.filter.steps] == [None, (2.0, 2.0)]
    other = uri(encoded(face(8, 8)))
    pair, _ = pair_of(shown(f'href="{LINK}"'), shown(f'href="{other}"'))
    text = frame_svg(frame_at(pair, 0.5, as_drawn=False), 2)
    assert (LINK in text, other in text) == (True, True)


@pytest.mark.parametrize("href", [LINK, "#c"])
def test_animations_begin_as_the_file(href):
    over = '<feBlend in2="SourceGraphic" mode="multiply"/>'
    markup = CIRCLE + shown(f'href="{href}"', over)
    pair, _ = pair_of(markup, markup.replace("multiply", "screen"))
    shapes, expected = keyframed_shapes([pair]), picture(ends(markup))
    for text in (smil_svg(shapes, Views([VIEW, VIEW]), Timing(), 3), css_svg(shapes, VIEW, Timing(), 3)):
        assert "feImage" in text
        assert difference(picture(text), expected) < 0.01


def test_pictures_of_pixels_have_own_files_in_filters_too():
    link = uri(encoded(face(), "JPEG"), "JPEG")
    pair, _ = pair_of(shown(f'href="{link}"'), BOX)
    frame = frame_at(pair, 0.0, as_drawn=True)
    assert MEDIA["JPEG"] in frame_svg(frame, 2)
    (text,) = Documents([frame], 2, 400)
    assert (MEDIA["JPEG"] in text, MEDIA["PNG"] in text) == (False, True)
    assert difference(picture(text), picture(frame_svg(frame, 2))) < 0.01


def test_pictures_count_in_filters_too(monkeypatch):
    monkeypatch.setattr(element, "MOST_IMAGES", 1)
    once = shown(f'href="{LINK}"')
    assert drawn(once).notes == ()
    refused(f'{once}<image width="9" height="9" href="{LINK}"/>', "more than 1 pictures, the limit")


def test_elements_in_filters_are_bounded(monkeypatch):
    ten = '<feImage href="#r%d"/>' * 10
    chain = "".join(
        f'<filter id="f{k}">{ten % ((k + 1,) * 10)}</filter><g id="r{k}" filter="url(#f{k})">{BOX}</g>'
        for k in range(4)
    )
    assert "feImage of a filter not applied (3 times)" in drawn(chain).notes
    one = shown('href="#c"')
    inside = f'<pattern id="p" width="9" height="9" patternUnits="userSpaceOnUse">{one}</pattern>'
    filled = BOX.replace("#08f", "url(#p)")
    within = CIRCLE + inside + filled
    assert "feImage of a filter not applied" in drawn(within).notes
    monkeypatch.setattr(images, "MOST_SEGMENTS", 8)
    assert drawn(CIRCLE + shown('href="#c"')).notes == ()
    refused(
        CIRCLE + shown('href="#c"', '<feImage href="#c"/>' * 2), "more than 8 segments in filters, the limit"
    )


def test_documents_in_filters_have_their_own_gradients():
    ramp = (
        '<linearGradient id="g"><stop stop-color="red"/><stop offset="1" stop-color="blue"/></linearGradient>'
    )
    markup = f'{ramp}<defs><rect id="c" width="30" height="20" fill="url(#g)"/></defs>' + shown('href="#c"')
    (link,) = re.findall(r'href="data:image/svg\+xml;base64,([^"]+)"', ends(markup))
    like = '<g transform="translate(16 27)"><rect width="30" height="20" fill="url(#g)"/></g>'
    assert link
    assert difference(picture(ends(markup)), picture(text_of(ramp + like))) < 0.01
