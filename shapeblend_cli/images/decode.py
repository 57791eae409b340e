"""Pictures decoded by Pillow, within limits, and encoded again."""

from __future__ import annotations

import io
import warnings
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

from shapeblend_cli.images.links import NotThereError
from shapeblend_cli.model import Raster

if TYPE_CHECKING:
    from PIL import Image

MOST_PIXELS = 40_000_000
"""Maximum size of a picture, in pixels: a large photo has 24 million."""

_TOO_LARGE = f"it has more than {MOST_PIXELS // 1_000_000} million pixels, the limit"

KINDS = {"PNG": "image/png", "JPEG": "image/jpeg", "WEBP": "image/webp"}
"""Media types of the formats that are read."""

_WIDE = ("I;16", "I;16B", "I;16L", "I")
"""Modes of grey pictures of 16 bits."""


def is_available() -> bool:
    """Return whether pictures can be decoded."""
    try:
        from PIL import Image  # noqa: F401
    except ImportError:
        return False
    return True


@lru_cache(maxsize=16)
def raster_of(data: bytes) -> Raster:
    """Return the picture that bytes hold; raise NotThereError if they hold none, or one too large."""
    image, kind = _decoded(data)
    small = image.convert("RGBa").resize((1, 1), 4)  # as premultiplied, what is not seen has no colour
    *channels, alpha = small.tobytes()
    colour = "#{:02x}{:02x}{:02x}".format(*(min(255, round(255 * c / max(alpha, 1))) for c in channels))
    is_opaque = min(image.getchannel("A").tobytes()) == 255
    return Raster(data, kind, image.width, image.height, colour, is_opaque)


def pixels_of(raster: Raster) -> Image.Image:
    """Return the pixels of a picture, RGBA."""
    return _decoded(raster.data)[0]


@lru_cache(maxsize=16)
def as_png(raster: Raster, most: int) -> Raster:
    """Return a picture as a PNG of our own, its sides halved while the smaller one is at least twice `most`."""
    image = pixels_of(raster)
    factor = 1
    while min(image.size) >= 2 * factor * most:
        factor *= 2
    image = image.reduce(factor) if factor > 1 else image
    return encoded(image, raster)


@lru_cache(maxsize=16)
def whitened(raster: Raster) -> Raster:
    """Return a picture that is white where it is seen, and as opaque as another one."""
    image = pixels_of(raster)
    white = image.copy()
    white.paste((255, 255, 255), (0, 0, *image.size))
    white.putalpha(image.getchannel("A"))
    return replace(encoded(white, raster), colour="#ffffff")


def encoded(image: Image.Image, like: Raster) -> Raster:
    """Return pixels as a PNG that stands for another picture."""
    file = io.BytesIO()
    image.save(file, "PNG", compress_level=1)
    return Raster(file.getvalue(), KINDS["PNG"], image.width, image.height, like.colour, like.is_opaque)


def _decoded(data: bytes) -> tuple[Image.Image, str]:
    """Return the pixels of a picture, RGBA and upright, and its media type."""
    from PIL import Image, ImageOps

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of large pictures, which have a limit here
            with Image.open(io.BytesIO(data), formats=tuple(KINDS)) as image:
                if image.width * image.height > MOST_PIXELS:
                    raise NotThereError(_TOO_LARGE)
                kind = KINDS[image.format or "PNG"]
                image.load()
                upright = ImageOps.exif_transpose(image)
                if upright.mode in _WIDE:
                    upright = (
                        upright.point(lambda value: value / 257.0, "L")
                        if upright.mode == "I"
                        else _narrow(upright)
                    )
                return upright.convert("RGBA"), kind
    except NotThereError:
        raise
    except Image.DecompressionBombError:
        raise NotThereError(_TOO_LARGE) from None
    except Exception:  # Pillow's decoders raise errors of many kinds on damaged files
        raise NotThereError("it is no PNG, JPEG or WebP picture that can be read") from None


def _narrow(image: Image.Image) -> Image.Image:
    """Return a grey picture of 16 bits with 8."""
    import numpy as np
    from PIL import Image

    return Image.fromarray((np.asarray(image).astype(np.uint32) // 257).astype(np.uint8))
