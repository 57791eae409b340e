"""Pictures of pixels, drawn by resvg from our own SVG documents alone: native code should not read others' files."""

from __future__ import annotations

import io
from importlib import import_module
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.errors import PictureError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from PIL import Image

    from shapeblend_cli.model import Pair
    from shapeblend_cli.outputs.formats import OutputSpec

MOST_SIDE = 16_383
"""Pixels; WebP has no more."""

MOST_PIXELS = 80_000_000
"""Of all pictures of a run together. They take four bytes each, and Pillow warns of pictures somewhat larger."""


class Size(NamedTuple):
    """Pixels of a picture."""

    width: int
    height: int


def check_libraries() -> None:
    """Refuse pictures where they cannot be drawn.

    Raises
    ------
    PictureError
    """
    try:
        for name in ("resvg_py", "PIL.Image"):
            import_module(name)
    except ImportError as error:
        raise PictureError(
            "pictures need resvg_py and Pillow; pip install 'shapeblend[pictures]' installs them"
        ) from error


def picture_size(spec: OutputSpec, pairs: Sequence[Pair], count: int) -> Size:
    """Return the size of so many pictures, proportioned like the view of the first drawing.

    Raises
    ------
    PictureError
        They have no height, or are too large.
    """
    view = pairs[0].views[0]
    assert spec.width is not None, "formats of pixels have a default"
    size = size_for(spec.width, (view.width, view.height))
    check_pixels(count, size)
    return size


def size_for(width: int, shape: tuple[float, float]) -> Size:
    """Return the size of pictures of a given width.

    Parameters
    ----------
    width : int
    shape : (float, float)
        Width and height of what is shown.

    Raises
    ------
    PictureError
        They have no height, or too much.
    """
    height = round(width * shape[1] / shape[0])
    if not 1 <= height <= MOST_SIDE:
        raise PictureError(
            f"{shape[0]:g} x {shape[1]:g} is shown of the first drawing, and that would be {width} x {height} "
            f"pixels; pictures can be 1 to {MOST_SIDE} high, so a {'larger' if height < 1 else 'smaller'} --width "
            "or a viewBox of other proportions would work"
        )
    return Size(width, height)


def check_pixels(count: int, size: Size) -> None:
    """Refuse more than `MOST_PIXELS`.

    Raises
    ------
    PictureError
    """
    if count * size.width * size.height > MOST_PIXELS:
        pictures = f"{count} pictures of " if count > 1 else ""
        raise PictureError(
            f"{pictures}{size.width} x {size.height} pixels are more than {MOST_PIXELS // 1_000_000} million; "
            "a smaller --width or fewer frames would work"
        )


def rasterize(svg: str, size: Size, background: str | None = None) -> bytes:
    """Return a document as a PNG, fitted into the picture as large as possible, centre on centre.

    Parameters
    ----------
    svg : str
        Without an XML declaration.
    size : Size
    background : str, optional
        A colour; without one what is not painted is transparent.
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
