"""Animations read back: pictures, times, runs and transparency."""

import io

import pytest
from PIL import Image, ImageChops

from shapeblend_cli.outputs.raster import Size, rasterize, read_png
from shapeblend_cli.outputs.raster_animation import Run, encode
from tests.support.drawings import svg

FORMS = {"gif": "GIF", "webp": "WEBP", "apng": "PNG"}
WHITE = "#ffffff"
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


def read_back(content):
    """The pictures, how long each is shown, and what the file says of repeating."""
    image = Image.open(io.BytesIO(content))
    pictures, delays = [], []
    for k in range(image.n_frames):
        image.seek(k)
        image.load()  # the time of a WebP's picture is known then
        pictures.append(image.convert("RGBA"))
        delays.append(image.info["duration"])
    return image.format, pictures, delays, image.info.get("loop")


def made(kind, run, runs=None, background=None):
    background = WHITE if kind == "gif" and background is None else background
    return encode(kind, SQUARES[: run.pairs * run.steps + 1], SIZE, run, runs, background)


@pytest.mark.parametrize("kind", FORMS)
def test_every_picture_is_shown_in_its_turn_for_its_time(kind):
    run = Run(2, 2, 0.07, True)
    form, pictures, delays, _ = read_back(made(kind, run))
    assert form == FORMS[kind]
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
    ("kind", "runs", "loop"),
    [
        ("gif", None, 0),
        ("gif", 1, None),  # nothing is said, which is once
        ("gif", 2, 1),  # how often again
        ("gif", 65_535, 65_534),
        ("webp", None, 0),
        ("webp", 1, 1),
        ("webp", 65_535, 65_535),
        ("apng", None, 0),
        ("apng", 1, 1),
        ("apng", 3, 3),
    ],
)
def test_how_often_it_runs(kind, runs, loop):
    assert read_back(made(kind, Run(1, 2, 1.0, False), runs))[3] == loop


@pytest.mark.parametrize("kind", FORMS)
def test_a_background_leaves_nothing_transparent(kind):
    _, pictures, _, _ = read_back(made(kind, Run(1, 2, 1.0, False), background="#aabbcc"))
    assert {picture.getpixel((0, 0)) for picture in pictures} == {(0xAA, 0xBB, 0xCC, 255)}


@pytest.mark.parametrize("kind", FORMS)
def test_the_same_bytes_again(kind):
    run = Run(1, 3, 0.5, True)
    assert made(kind, run) == made(kind, run)


@pytest.mark.parametrize("kind", FORMS)
def test_drawings_that_are_all_the_same_make_a_picture(kind):
    content = encode(kind, [SQUARES[0]] * 3, SIZE, Run(1, 2, 1.0, False), None, WHITE)
    assert read_png(content).size == SIZE


def test_a_gif_of_more_colours_than_it_can_have_stays_near_them_and_its_ground_white():
    size = Size(120, 120)
    content = encode("gif", [GRADIENT, SQUARES[0]], size, Run(1, 1, 1.0, False), None, WHITE)
    shown = read_back(content)[1][0].convert("RGB")
    wanted = read_png(rasterize(GRADIENT, size, WHITE)).convert("RGB")
    assert wanted.getcolors(256) is None
    assert shown.getpixel((0, 0)) == (255, 255, 255)
    histogram = ImageChops.difference(shown, wanted).convert("L").histogram()
    assert sum(histogram[17:]) < 0.01 * sum(histogram)
