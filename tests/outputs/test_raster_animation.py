"""Raster animations read back: pictures, times, runs and transparency."""

import io
from itertools import product

import numpy as np
import pytest
from PIL import Image, ImageChops

from shapeblend_cli.options.easing import Timing
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.outputs import raster_animation
from shapeblend_cli.outputs.formats import WHITE
from shapeblend_cli.outputs.options import OutputOptions, specify
from shapeblend_cli.outputs.pixels import Size, rasterize, read_png
from shapeblend_cli.outputs.raster_animation import FASTEST, Run, encode, run_for
from tests.support.drawings import svg

each_kind = pytest.mark.parametrize("kind", ["gif", "webp", "apng"])
SIZE = Size(40, 30)
SQUARES = [
    svg(f"M{x} 4H{x + 8}V12H{x}Z", attributes=f'fill="#{40 * x:02x}0080" stroke="#000"', viewbox="0 0 16 12")
    for x in range(5)
]
GRADIENT = svg(
    '<linearGradient id="g"><stop stop-color="#f80"/><stop offset="1" stop-color="#08f"/></linearGradient>',
    '<linearGradient id="h" x2="0" y2="1"><stop stop-color="#fff" stop-opacity="0.9"/>'
    '<stop offset="1" stop-color="#000" stop-opacity="0.9"/></linearGradient>',
    '<circle cx="12" cy="12" r="9" fill="url(#g)"/><circle cx="12" cy="12" r="9" fill="url(#h)"/>',
)
ONCE = Run(1, 2, Timing(1.0, repeat=1))


def to_and_fro(seconds):
    return Timing(seconds, repeat="pingpong")


def read_back(content):
    """The pictures, how long each is shown, and the loop count of the file."""
    image = Image.open(io.BytesIO(content))
    pictures, delays = [], []
    for k in range(image.n_frames):
        image.seek(k)
        image.load()  # the time of a WebP's picture is known then
        pictures.append(image.convert("RGBA"))
        delays.append(image.info["duration"])
    return image.format, pictures, delays, image.info.get("loop")


def spec_of(kind, background=None, *, lossless=True):
    options = OutputOptions(output=f"x.{kind}", background=background, lossless=lossless and kind == "webp")
    return specify(options, Settings())


def made(kind, run, background=None):
    return encode(spec_of(kind, background), SQUARES[: run.pairs * run.steps + 1], SIZE, run)


@each_kind
def test_every_picture_is_shown_in_its_turn_for_its_time(kind):
    run = Run(2, 2, to_and_fro(0.07))
    form, pictures, delays, _ = read_back(made(kind, run))
    assert form == {"gif": "GIF", "webp": "WEBP", "apng": "PNG"}[kind]
    unit = 100 if kind == "gif" else 1000
    assert delays == [d * 1000 // unit for d in run.delays(unit)]
    assert sum(delays) == 280
    ground = WHITE if kind == "gif" else None
    for shown, k in zip(pictures, run.order(), strict=True):
        assert shown.size == SIZE
        wanted = read_png(rasterize(SQUARES[k], SIZE, ground))
        # Where nothing is painted colours do not count.
        assert shown.getchannel("A").tobytes() == wanted.getchannel("A").tobytes()
        both = [Image.composite(i, Image.new("RGBA", SIZE), i.getchannel("A")) for i in (shown, wanted)]
        assert ImageChops.difference(*both).getbbox(alpha_only=False) is None


@pytest.mark.parametrize(
    ("kind", "repeat", "loop"),
    [
        *[(kind, "forever", 0) for kind in ("gif", "webp", "apng")],
        ("gif", 1, None),  # nothing is said, which is once
        ("gif", 2, 1),  # how often again
        ("gif", 65_535, 65_534),
        *[(kind, count, count) for kind, count in (("webp", 1), ("webp", 65_535), ("apng", 1), ("apng", 3))],
    ],
)
def test_how_often_it_runs(kind, repeat, loop):
    assert read_back(made(kind, Run(1, 2, Timing(1.0, repeat=repeat))))[3] == loop


@each_kind
def test_drawings_that_are_all_the_same_make_a_picture(kind):
    assert read_png(encode(spec_of(kind, WHITE), [SQUARES[0]] * 3, SIZE, ONCE)).size == SIZE


def test_a_gif_of_more_colours_than_it_can_have_stays_near_them_and_its_ground_white():
    size = Size(120, 120)
    content = encode(spec_of("gif"), [GRADIENT, SQUARES[0]], size, ONCE._replace(steps=1))
    shown = read_back(content)[1][0].convert("RGB")
    wanted = read_png(rasterize(GRADIENT, size, WHITE)).convert("RGB")
    assert wanted.getcolors(256) is None
    assert shown.getpixel((0, 0)) == (255, 255, 255)
    histogram = ImageChops.difference(shown, wanted).convert("L").histogram()
    assert sum(histogram[17:]) < 0.01 * sum(histogram)


def test_photos_have_the_colours_they_have_and_in_a_gif_nearly(monkeypatch):
    noise = '<filter id="f" x="0" y="0" width="1" height="1"><feTurbulence baseFrequency="0.4" seed="{}"/></filter>'
    photos = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{noise.format(k)}'
        '<path d="M0 0H9V9H0Z"/><path d="M0 0H9V9H0Z" filter="url(#f)"/></svg>'
        for k in (1, 5)
    ]
    size, run = Size(400, 400), ONCE._replace(steps=1)
    wanted = [read_png(rasterize(photo, size, WHITE)) for photo in photos]
    assert wanted[1].getcolors(1000) is None
    monkeypatch.setattr(raster_animation, "MOST_COLOURS", 1000)
    shown = read_back(encode(spec_of("apng"), photos, size, run))[1]
    assert [each.convert("RGBA").tobytes() for each in shown] == [each.tobytes() for each in wanted]
    for each, like in zip(read_back(encode(spec_of("gif"), photos, size, run))[1], wanted, strict=True):
        apart = np.asarray(each.convert("RGB"), int) - np.asarray(like.convert("RGB"), int)
        assert np.abs(apart.mean(axis=(0, 1))).max() < 2.0
        assert np.sqrt((apart**2).mean()) < 12.0


@pytest.mark.parametrize("timing", [Timing, to_and_fro])
def test_a_run_takes_its_time_without_drift_and_never_more_pictures_than_are_allowed(timing):
    for fps, duration, pairs in product((1, 7, 30, 50), (0.3, 1.3, 7.77), (1, 2, 3)):
        run = run_for(fps, 5, pairs, timing(duration))
        assert run.seconds == pytest.approx(duration * pairs * (2 if timing is to_and_fro else 1))
        assert run.steps == 1 or run.pictures <= fps * run.seconds + 1e-6
        assert run._replace(steps=run.steps + 1).pictures > fps * run.seconds - 1e-6
        assert len(run.order()) == run.pictures
        for units in (100, 1000):
            begun = np.cumsum([0, *run.delays(units)])
            even = np.arange(run.pictures + 1) * run.seconds * units / run.pictures
            assert abs(begun - even).max() <= 0.5 + 1e-6
    assert min(run_for(FASTEST, 5, 3, timing(1.3)).delays(100)) >= 100 / FASTEST


def test_common_numbers_come_out_even():
    assert run_for(25, 5, 1, Timing(2.0)).delays(100) == [4] * 50
    assert run_for(25, 5, 2, to_and_fro(2.0)).delays(1000) == [40] * 200


def test_frames_that_are_asked_for_are_shown_with_both_ends_and_back_neither_end_twice():
    assert run_for(None, 3, 1, Timing(2.0)) == Run(1, 4, Timing(2.0))
    assert run_for(None, 3, 1, Timing(2.0)).order() == [0, 1, 2, 3, 4]
    assert run_for(None, 0, 2, Timing(2.0)).order() == [0, 1, 2]
    assert run_for(None, 1, 2, to_and_fro(1.0)).order() == [0, 1, 2, 3, 4, 3, 2, 1]
    assert run_for(None, 0, 1, to_and_fro(1.0)).order() == [0, 1]


def test_a_webp_is_lossy_and_smaller_unless_it_is_asked_not_to_be():
    pictures, size, run = [GRADIENT, GRADIENT], Size(200, 200), ONCE._replace(steps=1)
    lossy, exact = (encode(spec_of("webp", lossless=is_), pictures, size, run) for is_ in (False, True))
    assert len(lossy) < 0.5 * len(exact)
    white = Image.new("RGBA", size, "white")
    shown, wanted = (Image.alpha_composite(white, read_back(content)[1][0]) for content in (lossy, exact))
    assert 0 < max(high for _, high in ImageChops.difference(shown, wanted).getextrema()) < 60
