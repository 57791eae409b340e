"""What bytes are pictures, within which limits."""

import io
import struct
import zlib
from contextlib import suppress

import numpy as np
import pytest
from PIL import Image

from shapeblend_cli.images import decode
from shapeblend_cli.images.decode import as_png, pixels_of, raster_of
from shapeblend_cli.images.links import NotThereError
from tests.support.images import checkerboard, disc, encoded, face

UNREADABLE = "it is no PNG, JPEG or WebP picture that can be read"


@pytest.mark.parametrize(
    ("form", "kind"), [("PNG", "image/png"), ("JPEG", "image/jpeg"), ("WEBP", "image/webp")]
)
def test_three_formats_are_read(form, kind):
    raster = raster_of(encoded(face(), form))
    assert (raster.kind, raster.width, raster.height, raster.is_opaque) == (kind, 160, 120, True)
    assert (
        np.abs(np.asarray(pixels_of(raster).convert("RGB"), float) - np.asarray(face(), float)).mean() < 4.0
    )


def test_colour_is_the_mean_of_what_is_seen():
    assert raster_of(encoded(Image.new("RGB", (4, 4), (10, 20, 30)))).colour == "#0a141e"
    raster = raster_of(encoded(disc()))
    assert not raster.is_opaque
    assert (
        np.abs(np.frombuffer(bytes.fromhex(raster.colour[1:]), np.uint8) - np.array([200, 30, 60])).max() <= 3
    )


def test_a_photo_that_was_taken_sideways_is_upright():
    exif = Image.Exif()
    exif[0x0112] = 6
    raster = raster_of(encoded(face(), "JPEG", exif=exif))
    assert (raster.width, raster.height) == (120, 160)


def test_grey_pictures_of_16_bits_keep_their_shades():
    shades = np.linspace(0, 65535, 256).astype(np.uint16)[None].repeat(4, 0)
    raster = raster_of(encoded(Image.fromarray(shades)))
    assert np.abs(np.asarray(pixels_of(raster))[0, :, 0].astype(int) - np.arange(256)).max() <= 1


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"no picture",
        encoded(face())[:200],
        encoded(face(), "JPEG")[:300],
        encoded(face(), "GIF"),
        b"<svg/>",
    ],
    ids=["empty", "words", "cut PNG", "cut JPEG", "GIF", "SVG"],
)
def test_anything_else_is_no_picture(data):
    with pytest.raises(NotThereError, match=UNREADABLE):
        raster_of(data)


def test_flipped_bits_end_in_a_picture_or_in_an_answer(rng):
    for form in ("PNG", "JPEG", "WEBP"):
        whole = encoded(face(), form)
        for _ in range(30):
            data = bytearray(whole)
            for place in rng.integers(0, len(data), 4):
                data[place] ^= 1 << int(rng.integers(8))
            with suppress(NotThereError):
                assert raster_of(bytes(data)).width > 0


def bomb(width, height):
    """A PNG of black pixels that is small as a file."""

    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", b"x") + chunk(b"IEND", b"")


def test_a_picture_of_too_many_pixels_is_refused_before_it_is_unpacked(monkeypatch):
    monkeypatch.setattr(Image.Image, "load", lambda self: pytest.fail("it was unpacked"))
    for side in (7000, 12_000, 60_000):
        with pytest.raises(NotThereError, match="it has more than 40 million pixels, the limit"):
            raster_of(bomb(side, side))


def test_pictures_are_encoded_again_and_made_smaller_in_halves():
    raster = raster_of(encoded(face(640, 480), "JPEG"))
    small = as_png(raster, 60)
    assert (small.kind, small.width, small.height) == ("image/png", 80, 60)
    again = as_png(raster, 1000)
    assert Image.open(io.BytesIO(again.data)).format == "PNG"
    assert (again.width, again.height) == (640, 480)
    assert np.abs(np.asarray(pixels_of(again), int) - np.asarray(pixels_of(raster), int)).max() == 0


def test_pictures_need_pillow(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "PIL", None)
    assert not decode.is_available()


def test_a_checkerboard_is_read_to_the_pixel():
    assert (
        np.asarray(pixels_of(raster_of(encoded(checkerboard()))))[..., :3] == np.asarray(checkerboard())
    ).all()
