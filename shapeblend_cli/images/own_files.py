"""Frames whose pictures are our own files, for programs that are not to read others'."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.images.decode import as_png
from shapeblend_cli.model import Style

if TYPE_CHECKING:
    from shapeblend_cli.model import Frame


def with_own_pictures(frame: Frame, side: int) -> Frame:
    """Return a frame for a picture of some pixels on its longer side, with each picture in it encoded again.

    Pictures far larger than they are seen are made smaller: programs that skip pixels would show others at each moment.
    """
    scale = side / frame.view.larger_side

    def safe(style: Style) -> Style:
        picture = style.picture
        if picture is None:
            return style
        seen = scale * min(abs(picture.across), abs(picture.down))
        raster = as_png(picture.raster, 1 << max(round(seen) - 1, 1).bit_length())
        return style._replace(fill_gradient=picture._replace(raster=raster))

    shapes = tuple(
        shape._replace(style=Style(fill_gradient=shape.bent.drawn(frame.view, side)), below=None, bent=None)
        if shape.bent is not None
        else shape._replace(style=safe(shape.style), below=shape.below and safe(shape.below))
        if shape.style.picture is not None
        else shape
        for shape in frame.shapes
    )
    return frame._replace(shapes=shapes)
