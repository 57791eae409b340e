"""Pictures of pixels among shapes with effects."""

import pytest

from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.interpolate.chains import keyframed_shapes
from shapeblend_cli.model import Box
from shapeblend_cli.options.easing import Timing
from shapeblend_cli.outputs.formats import Documents
from shapeblend_cli.svg.reading.images import element
from shapeblend_cli.svg.writing.animation import Views
from shapeblend_cli.svg.writing.css import css_svg
from shapeblend_cli.svg.writing.document import frame_svg
from shapeblend_cli.svg.writing.smil import smil_svg
from tests.support.images import checkerboard, disc, face, image
from tests.svg.effects.test_effects import BLUR, BOX, DISC, difference, pair_of, picture
from tests.svg.effects.test_tiles import FILLED, RAMP
from tests.svg.reading.drawings import drawn, refused, svg

ONE = image(checkerboard(), 'x="12" y="15" width="50" height="50"')
OTHER = image(face(), 'x="30" y="25" width="60" height="45"')
SOFT = f'{RAMP}<mask id="m"><rect width="100" height="100" fill="url(#g)"/></mask>'
VIEW = Box(0.0, 0.0, 100.0, 100.0)

AROUND = {
    "filter": f'{BLUR.format(3)}<g filter="url(#b)">{{}}{DISC}</g>',
    "opacity": f'<g opacity=".4">{{}}{DISC}</g>',
    "mode": f'{BOX}<g style="mix-blend-mode:multiply">{{}}</g>',
    "mask": f'{SOFT}<g mask="url(#m)">{{}}{DISC}</g>',
}


@pytest.mark.parametrize("around", AROUND.values(), ids=AROUND)
def test_ends_look_as_the_files(around):
    drawings = around.format(ONE), around.format(OTHER)
    pair, notes = pair_of(*drawings)
    assert notes == []
    for t, markup in enumerate(drawings):
        shown = picture(frame_svg(frame_at(pair, float(t), as_drawn=False), 3))
        assert difference(shown, picture(svg(markup).decode())) < 0.004


@pytest.mark.parametrize("around", AROUND.values(), ids=AROUND)
def test_animations_begin_as_the_file(around):
    pair, _ = pair_of(around.format(ONE), around.format(OTHER))
    shapes = keyframed_shapes([pair])
    expected = picture(svg(around.format(ONE)).decode())
    for text in (
        smil_svg(shapes, Views([VIEW, VIEW]), Timing(), 3),
        css_svg(shapes, VIEW, Timing(), 3),
    ):
        assert text.count("<image") == 2
        assert difference(picture(text), expected) < 0.01


GREY = image(face(), 'id="i" width="60" height="45"')
USED = f'<defs>{GREY}</defs><use href="#i" x="20" y="30"/>'
FIGMA = image(face(160, 120), 'id="i" width="160" height="120"')
SMALL = image(face(), 'width="20" height="15" opacity=".7"')
CUT = image(face(), 'width="20" height="15" clip-path="url(#c)" image-rendering="pixelated"')
CLIP = '<clipPath id="c"><circle cx="10" cy="8" r="7"/></clipPath>'
TILE = '<pattern id="p" patternUnits="userSpaceOnUse" width="20" height="15" {}>{}</pattern>'
MASK = '<mask id="m" {}>{}</mask><g mask="url(#m)">' + BOX + DISC + "</g>"
DISC_OF_PIXELS = image(disc(), 'x="30" y="25" width="50" height="50" opacity=".8"')

WITH_PICTURES = {
    "a picture as Figma fills with it": '<pattern id="p" patternContentUnits="objectBoundingBox" width="1" height="1">'
    f'<use href="#i" transform="scale(.00625 .00833333)"/></pattern><defs>{FIGMA}</defs>{FILLED}',
    "tiles": TILE.format('patternTransform="rotate(20)"', SMALL) + FILLED,
    "tiles that are clipped": CLIP + TILE.format("", CUT) + FILLED,
    "a mask that uses a picture": MASK.format("", USED),
    "a mask with a picture": MASK.format("", OTHER),
    "a mask of alpha": MASK.format('mask-type="alpha"', DISC_OF_PIXELS),
    "a mask of alpha that is opaque": MASK.format('mask-type="alpha"', OTHER),
}


@pytest.mark.parametrize("name", WITH_PICTURES)
def test_patterns_and_masks_have_pictures(name):
    markup = WITH_PICTURES[name]
    pair, notes = pair_of(markup, BOX)
    assert (notes, drawn(markup).notes) == ([], ())
    expected = picture(svg(markup).decode())
    assert difference(expected, picture(svg("").decode())) > 0.05
    frame = frame_at(pair, 0.0, as_drawn=True)
    assert difference(picture(frame_svg(frame, 3)), expected) < 0.004
    shapes = keyframed_shapes([pair])
    for text in (
        smil_svg(shapes, Views([VIEW, VIEW]), Timing(), 3),
        css_svg(shapes, VIEW, Timing(), 3),
    ):
        assert text.count("<image") == (name != "a mask of alpha that is opaque")
        assert difference(picture(text), expected) < 0.01


def test_a_mask_of_alpha_sees_no_colours():
    red, blue = (
        MASK.format('mask-type="alpha"', image(pixels, 'x="20" y="20" width="60" height="60"'))
        for pixels in (disc(), disc(colour=(0, 0, 255, 255)))
    )
    assert drawn(red).shapes[0].effects[0].mask == drawn(blue).shapes[0].effects[0].mask
    assert drawn(red.replace("alpha", "luminance")).shapes[0].effects[0].mask != (
        drawn(blue.replace("alpha", "luminance")).shapes[0].effects[0].mask
    )


def test_a_picture_is_there_once_however_often_it_is_shown():
    tiles = (
        TILE.format("", SMALL) + FILLED,
        TILE.format('patternTransform="rotate(90) scale(2)"', SMALL) + FILLED,
    )
    pair, _ = pair_of(*tiles)
    text = css_svg(keyframed_shapes([pair]), VIEW, Timing(), 3)
    assert text.count("<use") > 20
    assert text.count("data:") == 1


@pytest.mark.parametrize(
    "inside",
    [
        '<image width="9" height="9" href="data:image/png;base64,AAAA"/>',
        '<foreignObject width="9" height="9"/>',
        f'{DISC}<use href="#far"/>',
    ],
)
def test_what_cannot_be_shown_of_a_pattern_or_a_mask_leaves_it_out(inside):
    far = '<defs><image id="far" width="9" height="9" href="https://example.org/a.png"/></defs>'
    tile = drawn(far + TILE.format("", inside) + FILLED)
    assert tile.shapes[0].style.fill_gradient is None
    assert tile.notes[-1] == "a gradient or pattern read as a plain colour"
    assert "left out" in tile.notes[0]
    masked = drawn(far + MASK.format("", inside))
    assert [shape.effects for shape in masked.shapes] == [(), ()]
    assert masked.notes[-1] == "mask not applied"
    assert len(masked.notes) == 2


def test_a_mask_in_which_nothing_is_drawn_though_it_has_effects_leaves_a_note():
    broken = '<image opacity=".5" width="9" height="9" href="data:image/png;base64,AAAA"/>'
    drawing = drawn(MASK.format("", broken))
    assert [shape.effects for shape in drawing.shapes] == [(), ()]
    assert drawing.notes[-1] == "mask not applied"


def test_pictures_of_pixels_have_own_files_in_patterns_and_masks_too():
    jpeg = image(face(), 'width="20" height="15"', "JPEG")
    inner = (
        f'<pattern id="q" width=".5" height="1">{jpeg}</pattern><rect width="99" height="99" fill="url(#q)"/>'
    )
    for markup in (TILE.format("", jpeg) + FILLED, MASK.format("", jpeg), MASK.format("", inner)):
        pair, _ = pair_of(markup, BOX)
        frame = frame_at(pair, 0.0, as_drawn=True)
        assert "image/jpeg" in frame_svg(frame, 2)
        (text,) = Documents([frame], 2, 400)
        assert ("image/jpeg" in text, "image/png" in text) == (False, True)
        assert difference(picture(text), picture(frame_svg(frame, 2))) < 0.004


def test_pictures_count_wherever_they_are(monkeypatch):
    monkeypatch.setattr(element, "MOST_IMAGES", 2)
    both = TILE.format("", SMALL) + FILLED + MASK.format("", OTHER)
    assert len(drawn(both).shapes) == 3
    refused(both + ONE, "more than 2 pictures, the limit")
