"""One SVG document to one picture: our own documents, since a renderer in native code is not for others' files."""

from __future__ import annotations

import io
from typing import NamedTuple

import resvg_py
from PIL import Image

from shapeblend_cli.errors import PictureError
from shapeblend_cli.outputs.raster_options import MOST_SIDE

MOST_PIXELS = 80_000_000
"""Of all pictures of a run together. They take four bytes each, and Pillow warns of pictures somewhat larger."""


class Size(NamedTuple):
    """Pixels of a picture."""

    width: int
    height: int


def size_for(width: int, shape: tuple[float, float]) -> Size:
    """The size of pictures of a given width.

    Parameters
    ----------
    width : int
    shape : (float, float)
        Width and height of what is shown.

    Raises
    ------
    PictureError
        Pictures of no height, or of too much.
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
    """Refuse more pixels than there is reason for.

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


def drawn(svg: str, size: Size, background: str | None = None) -> bytes:
    """A PNG of a document, fitted into the picture as large as it can be, centre on centre.

    Parameters
    ----------
    svg : str
        A document without an XML declaration.
    size : Size
    background : str, optional
        A colour; without one what is not painted is transparent.
    """
    fitted = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{size.width}" height="{size.height}">{svg}</svg>'
    )
    return bytes(resvg_py.svg_to_bytes(svg_string=fitted, background=background, skip_system_fonts=True))


def opened(png: bytes) -> Image.Image:
    """A picture that was drawn: red, green, blue and alpha."""
    return Image.open(io.BytesIO(png)).convert("RGBA")
