"""Pictures of pixels among shapes with effects."""

import pytest

from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.interpolate.chains import keyframed_shapes
from shapeblend_cli.model import Box
from shapeblend_cli.options.easing import Timing
from shapeblend_cli.svg.writing.animation import Views
from shapeblend_cli.svg.writing.css import css_svg
from shapeblend_cli.svg.writing.document import frame_svg
from shapeblend_cli.svg.writing.smil import smil_svg
from tests.support.images import checkerboard, face, image
from tests.svg.effects.test_effects import BLUR, BOX, DISC, difference, pair_of, picture
from tests.svg.effects.test_tiles import FILLED, RAMP
from tests.svg.reading.drawings import drawn, svg

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


def test_patterns_and_masks_have_none():
    tile = f'<pattern id="p" width="1" height="1">{{}}</pattern>{FILLED}'
    assert drawn(tile.format(ONE)).notes == ("a gradient or pattern read as a plain colour",)
    named = ONE.replace("<image", '<image id="i"')
    used = drawn(f"<defs>{named}</defs>" + tile.format('<use href="#i"/>'))
    assert used.notes == ("image left out", "a gradient or pattern read as a plain colour")
    assert used.shapes[0].style.fill_gradient is None
    masked = drawn(f'<mask id="m">{ONE}</mask><g mask="url(#m)">{BOX}</g>')
    assert masked.notes == ("mask not applied",)
    assert masked.shapes[0].effects == ()
