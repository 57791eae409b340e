"""Raster pictures, drawn by resvg from our own SVG documents alone: native code should not read others' files."""

from __future__ import annotations

import io
from importlib import import_module
from threading import Event
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.errors import InputError, PictureError, with_extra

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from PIL import Image

    from shapeblend_cli.model import Box, Pair, PictureArray, UIntArray

MOST_SIDE = 16_383
"""Maximum side of a picture, in pixels: WebP has no larger ones."""

WIDEST_STROKE = 1e5
"""Maximum width of a stroke, in sizes of the view. With strokes of some million sizes resvg ends the process."""

MOST_PIXELS = 80_000_000
"""Maximum size of all pictures of a run together, in pixels of four bytes. Pillow warns of slightly larger pictures."""

BAND = 1 << 18
"""Number of pixels that are drawn together, about."""


NEVER = Event()
"""Event that does not happen."""


class Size(NamedTuple):
    """Pixels of a picture."""

    width: int
    height: int


def check_libraries() -> None:
    """Raise PictureError where pictures cannot be drawn."""
    try:
        for name in ("resvg_py", "PIL.Image"):
            import_module(name)
    except ImportError as error:
        raise PictureError(
            f"pictures need resvg_py and Pillow; {with_extra('pictures')} installs them"
        ) from error


def size_for(width: int | None, view: Box, count: int = 1) -> Size:
    """Return the size of `count` pictures of a view, or raise PictureError if they are too large or have no height."""
    assert width is not None, "raster formats have a default"
    height = round(width * view.height / view.width)
    if not 1 <= height <= MOST_SIDE:
        raise PictureError(
            f"the view of the first drawing, {view.width:g} x {view.height:g}, would be {width} x {height} pixels; "
            f"pictures are 1 to {MOST_SIDE} pixels high, so a {'larger' if height < 1 else 'smaller'} --width "
            "or a viewBox of other proportions would work"
        )
    return check_pixels(Size(width, height), count)


def size_of(width: int | None, pairs: Sequence[Pair], count: int = 1) -> Size:
    """Return the size of pictures of a blend; see `size_for`. Strokes far too wide raise PictureError as well."""
    for pair in pairs:
        for shape in pair.shapes:
            widths = [style.stroke_width for style in (shape.style_a, shape.style_b) if style.stroke]
            times = max(widths, default=0.0) / pair.views[0].larger_side
            if times > WIDEST_STROKE:
                raise PictureError(
                    f"a stroke is {times:.1g} times as wide as the view, and pictures can have strokes up to "
                    f"{WIDEST_STROKE:.0e} times as wide; --place bbox, or a viewBox of the drawing's size, would work"
                )
    return size_for(width, pairs[0].views[0], count)


def check_pixels(size: Size, count: int = 1) -> Size:
    """Return the size of `count` pictures, or raise PictureError if they have more than `MOST_PIXELS`."""
    if count * size.width * size.height > MOST_PIXELS:
        pictures = f"{count} pictures of " if count > 1 else ""
        raise PictureError(
            f"{pictures}{size.width} x {size.height} pixels are more than {MOST_PIXELS // 1_000_000} million; "
            "a smaller --width or fewer frames would work"
        )
    return size


def rasterize(svg: str, size: Size, background: str | None = None) -> bytes:
    """Return a document as a PNG, fitted into the picture as large as possible, centre on centre.

    The document is without an XML declaration. Where nothing is painted, the picture has the colour `background`, or
    without one is transparent.
    """
    import resvg_py

    fitted = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{size.width}" height="{size.height}">{svg}</svg>'
    )
    return bytes(resvg_py.svg_to_bytes(svg_string=fitted, background=background, skip_system_fonts=True))


def read_png(png: bytes) -> Image.Image:
    """Return a picture: red, green, blue and alpha."""
    from PIL import Image

    return Image.open(io.BytesIO(png)).convert("RGBA")


def bands(width: int, top: int, bottom: int, over: Event = NEVER) -> Iterator[tuple[int, int]]:
    """Yield the first row, and the one after the last, of each part of a picture of about `BAND` pixels.

    There are no more once nobody waits for the picture, as `over` says.
    """
    rows = max(1, BAND // width)
    for first in range(top, bottom, rows):
        if over.is_set():
            return
        yield first, min(first + rows, bottom)


def png_of(canvas: UIntArray) -> bytes:
    """Return premultiplied pixels as a PNG: photos are packed with little effort, as that is most of the work."""
    from PIL import Image

    height, width = canvas.shape[:2]
    image = Image.frombuffer("RGBa", (width, height), canvas.tobytes(), "raw", "RGBa", 0, 1)
    file = io.BytesIO()
    image.convert("RGBA").save(file, "PNG", compress_level=1)
    return file.getvalue()


def pictures_in(file: str, side: int) -> list[PictureArray]:
    """Return the pictures in a PNG or GIF file, as large as a square allows that has such sides.

    Each is (4, height, width): red, green and blue times opacity, and opacity.

    Raises
    ------
    PictureError
        Pillow is not installed.
    InputError
        The file cannot be read, or has more than `MOST_PIXELS`.
    """
    check_libraries()
    from PIL import Image, ImageSequence

    try:
        with Image.open(file, formats=("PNG", "GIF")) as image:
            count = getattr(image, "n_frames", 1)
            if count * image.width * image.height > MOST_PIXELS:
                size = f"{count} pictures of {image.width} x {image.height} pixels"
                raise InputError(file, f"{size}; up to {MOST_PIXELS // 1_000_000} million pixels would work")
            return [_fitted(frame.convert("RGBA"), side) for frame in ImageSequence.Iterator(image)]
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(file, "no PNG or GIF picture that Pillow can read") from error


def _fitted(image: Image.Image, side: int) -> PictureArray:
    """Return a picture as large as a square allows."""
    import numpy as np

    scale = side / max(image.size)
    size = [max(1, round(scale * length)) for length in image.size]
    small = (
        np.asarray(image.resize((size[0], size[1]), 4), np.float32) / 255.0
    )  # 4: the mean of each pixel's area
    small[..., :3] *= small[..., 3:]
    return np.ascontiguousarray(small.transpose(2, 0, 1))
