"""Frames with bent pictures, composed of these and of documents."""

import io
from threading import Event

import numpy as np
import pytest
from PIL import Image

from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.images.own_files import with_own_pictures
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.outputs import pixels
from shapeblend_cli.outputs.composed import Composed, compose, draw, draw_all, in_parts
from shapeblend_cli.outputs.pixels import Size, png_of, rasterize, read_png
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.writing.document import frame_svg
from tests.support.drawings import drawing
from tests.support.images import checkerboard, face, image

pytestmark = pytest.mark.usefixtures("blended_once")

HEART = (
    "M12 22C5 17 1 12 1 7.5C1 4 3.5 2 6.5 2C9 2 11 3.5 12 5.5"
    "C13 3.5 15 2 17.5 2C20.5 2 23 4 23 7.5C23 12 19 17 12 22Z"
)
DISC = "M21 12A9 9 0 1 1 3 12A9 9 0 1 1 21 12Z"
WHOLE = 'width="24" height="24" preserveAspectRatio="none"'


def clipped(region, picture):
    shown = image(picture, f'{WHOLE} clip-path="url(#c)"')
    return f'<clipPath id="c"><path d="{region}"/></clipPath>{shown}'


def frame(a, b, t=0.4, **sizes):
    (pair,), _ = match_all([drawing(a, **sizes), drawing(b, file="b.svg", **sizes)], Settings())
    return frame_at(pair, t, as_drawn=False)


def array(png):
    return np.asarray(read_png(png).convert("RGBa"), int)


UNDER = '<path d="M1 1H23V23H1Z" fill="#3465a4" fill-opacity="0.5"/>'
OVER = f'<path d="{HEART}" fill="none" stroke="#a40000" stroke-width="2"/>'
CASES = {
    "alone": ("", ""),
    "on a shape": (UNDER, ""),
    "under a shape": ("", OVER),
    "between shapes": (UNDER, OVER),
    "under a group": ("", f'<g opacity="0.5">{OVER}{UNDER}</g>'),
}


@pytest.mark.parametrize("ground", [None, "#fce94f"])
@pytest.mark.parametrize("case", CASES)
def test_it_looks_as_the_document_does(case, ground):
    under, over = CASES[case]
    shown = frame(under + clipped(DISC, checkerboard()) + over, under + clipped(HEART, face()) + over)
    size, parts = Size(120, 120), in_parts(shown, 3, 120)
    assert isinstance(parts, Composed)
    assert len(parts.parts) == 1 + bool(under) + bool(over)
    wanted = array(rasterize(frame_svg(with_own_pictures(shown, 120), 3), size, ground))
    apart = np.abs(array(compose(parts, size, ground)) - wanted).max(axis=2)
    # resvg draws the edges of clip paths with a few degrees of opacity, up to a fifth apart from their share.
    assert apart.mean() < 1.0
    assert (apart > 3).mean() < 0.03
    assert apart.max() < 60


def test_in_a_picture_of_other_proportions_it_is_in_the_middle():
    shown = frame(clipped(DISC, checkerboard()), clipped(DISC, checkerboard()), 0.5)
    parts = in_parts(shown, 3, 60)
    square = array(draw(parts, Size(60, 60)))
    wide = array(draw(parts, Size(100, 60)))
    assert np.abs(wide[:, 20:80] - square).max() <= 1
    assert not wide[:, :20].any()
    assert not wide[:, 80:].any()


@pytest.mark.parametrize(
    "around",
    ['<g opacity="0.5">{}' + OVER + "</g>", '<g style="mix-blend-mode:multiply">{}</g>'],
)
def test_within_an_effect_it_is_drawn_as_a_document(around):
    a, b = (around.format(clipped(region, face())) for region in (DISC, HEART))
    assert in_parts(frame(a, b), 3, 60) is None


def test_below_a_blend_mode_it_is_drawn_as_a_document():
    over = f'<path d="{DISC}" fill="red" style="mix-blend-mode:multiply"/>'
    assert in_parts(frame(*(clipped(region, face()) + over for region in (DISC, HEART))), 3, 60) is None


def test_a_picture_beyond_the_view_draws_nothing():
    shown = frame(clipped(DISC, checkerboard()), clipped(HEART, face()))
    away = in_parts(shown._replace(view=shown.view._replace(x=500.0)), 3, 60)
    assert not array(draw(away, Size(60, 60))).any()


@pytest.mark.parametrize("band", [7, 100, 1 << 18])
def test_pngs_have_the_pixels(monkeypatch, rng, band):
    monkeypatch.setattr(pixels, "BAND", band)
    plain = rng.integers(0, 256, (13, 17, 4)).astype(np.uint8)
    plain[:5, :, 3] = 255
    plain[5:9, :, 3] = 0
    canvas = np.array(Image.fromarray(plain).convert("RGBa"))
    with Image.open(io.BytesIO(png_of(canvas))) as found:
        assert (np.asarray(found)[:5] == plain[:5]).all()
        assert np.abs(np.asarray(found.convert("RGBa"), int) - canvas).max() <= 1


def test_in_bands_it_is_the_same(monkeypatch):
    parts = in_parts(frame(clipped(DISC, checkerboard()), clipped(HEART, face())), 3, 60)
    whole = array(draw(parts, Size(60, 60)))
    monkeypatch.setattr(pixels, "BAND", 600)
    assert np.abs(array(draw(parts, Size(60, 60))) - whole).max() <= 1


def test_documents_and_frames_in_parts_keep_their_order():
    blends = [frame(clipped(DISC, checkerboard()), clipped(HEART, face()), t) for t in (0.2, 0.5, 0.8)]
    parts = [in_parts(each, 3, 40) for each in blends]
    plain = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M0 0H{k}V9Z"/></svg>'
        for k in range(3)
    ]
    documents = [plain[0], *parts, plain[1], *parts, *parts, plain[2]]
    size = Size(40, 40)
    assert [*draw_all(documents, size)] == [draw(document, size) for document in documents]


def test_what_goes_wrong_while_drawing_is_raised(monkeypatch):
    parts = in_parts(frame(clipped(DISC, checkerboard()), clipped(HEART, face())), 3, 40)
    monkeypatch.setattr("shapeblend_cli.outputs.composed.png_of", lambda *_: 1 // 0)
    with pytest.raises(ZeroDivisionError):
        list(draw_all([parts] * 9, Size(40, 40)))


def test_frames_that_nobody_waits_for_are_not_drawn_on(monkeypatch):
    parts = in_parts(frame(clipped(DISC, checkerboard()), clipped(HEART, face())), 3, 40)
    monkeypatch.setattr(pixels, "BAND", 40)
    over, looks = Event(), []
    monkeypatch.setattr("shapeblend_cli.outputs.composed.lay_over", lambda *_: looks.append(1) or over.set())
    compose(parts, Size(40, 40), None, over)
    assert looks == [1]
