"""An ``image`` element as a shape: https://www.w3.org/TR/SVG2/embedded.html#ImageElement."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.geometry.polygons import rectangle
from shapeblend_cli.images import decode
from shapeblend_cli.images.links import NotThereError, bytes_of
from shapeblend_cli.model import Box, Clip, Contour, Picture, Raster
from shapeblend_cli.svg.reading import contours, viewports
from shapeblend_cli.svg.xml.messages import check_limit

if TYPE_CHECKING:
    from shapeblend_cli.svg.styles.declarations import Declarations
    from shapeblend_cli.svg.xml.messages import Notes
    from shapeblend_cli.svg.xml.transforms import Affine
    from shapeblend_cli.svg.xml.units import Lengths
    from shapeblend_cli.svg.xml.xmltree import Node

MOST_IMAGES = 500
"""Maximum number of pictures that a file draws."""

MOST_PIXELS = 100_000_000
"""Maximum size of all pictures that a file draws together, in pixels."""

LEFT_OUT = "image left out"

PIXELATED = frozenset(("pixelated", "crisp-edges", "optimizespeed", "-webkit-optimize-contrast"))
"""Values of ``image-rendering`` that show pixels as squares."""


class PlacedImage(NamedTuple):
    """A picture in the coordinates of its element: the box it fills, and the viewport if that cuts something off."""

    raster: Raster
    box: Box
    viewport: Box | None
    is_smooth: bool

    @property
    def contour(self) -> Contour:
        """The outline of the picture."""
        return rectangle(self.box)

    def picture(self, matrix: Affine) -> Picture:
        """Return it as paint in the root's coordinates."""
        x, y, width, height = self.box
        corner, right, below = (
            complex(matrix.a * px + matrix.c * py + matrix.e, matrix.b * px + matrix.d * py + matrix.f)
            for px, py in ((x, y), (x + width, y), (x, y + height))
        )
        return Picture(self.raster, corner, right - corner, below - corner, self.is_smooth)

    def clips(self, matrix: Affine) -> tuple[Clip, ...]:
        """Return the region of the viewport in the root's coordinates, if it cuts something off."""
        if self.viewport is None:
            return ()
        return (Clip((contours.transform(rectangle(self.viewport), matrix),)),)


class Images:
    """The pictures of a document, from its links and from the files in a folder, if there is one."""

    def __init__(self, notes: Notes, wanted: str, folder: str | None) -> None:
        self._notes = notes
        self._wanted = wanted
        self._folder = folder if wanted == "beside" else None
        self._count = 0
        self._pixels = 0

    def of(self, node: Node, declared: Declarations, lengths: Lengths) -> PlacedImage | None:
        """Return the picture of an element; None, with a note, if there is none."""
        if self._wanted == "skip":
            self._notes.leave_out(LEFT_OUT)
            return None
        if not decode.is_available():
            self._notes.leave_out(f"{LEFT_OUT}: the extra shapeblend[images] reads pictures")
            return None
        try:
            raster = decode.raster_of(bytes_of(node.link(), self._folder))
        except NotThereError as reason:
            self._notes.leave_out(f"{LEFT_OUT}: {reason}" if str(reason) else LEFT_OUT)
            return None
        self._count += 1
        self._pixels += raster.width * raster.height
        check_limit(self._count, MOST_IMAGES, "pictures")
        check_limit(self._pixels, MOST_PIXELS, "pixels of pictures")
        return _placed(raster, node, declared, lengths)


def _placed(raster: Raster, node: Node, declared: Declarations, lengths: Lengths) -> PlacedImage | None:
    """Return a picture in its viewport; None if that has no area."""

    def size(name: str) -> float | None:
        """Return a length; None is ``auto``, or one that cannot be read."""
        text = declared.get(name) or node.get(name) or ""
        return lengths.x(text) if name in ("x", "width") else lengths.y(text)

    x, y = size("x") or 0.0, size("y") or 0.0
    width, height = size("width"), size("height")
    own = Box(0.0, 0.0, float(raster.width), float(raster.height))
    if width is None:
        width = own.width if height is None else height * own.width / own.height
    if height is None:
        height = width * own.height / own.width
    if width <= 0.0 or height <= 0.0:
        return None
    fit = viewports.fit(own, width, height, node.get("preserveAspectRatio") or "")
    box = Box(x + fit.e, y + fit.f, fit.a * own.width, fit.d * own.height)
    viewport = Box(x, y, width, height)
    is_cut = not viewport.contains(box, 1e-9 * viewport.diagonal)
    rendering = (declared.get("image-rendering") or node.get("image-rendering") or "auto").strip().lower()
    return PlacedImage(raster, box, viewport if is_cut else None, rendering not in PIXELATED)
