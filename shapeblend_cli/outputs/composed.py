"""Frames with bent pictures, composed of these and of documents: as one document they would take far longer."""

from __future__ import annotations

import math
from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from functools import lru_cache
from itertools import groupby
from threading import Event
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np

from shapeblend_cli.images.coverage import coverage
from shapeblend_cli.images.own_files import with_own_pictures
from shapeblend_cli.images.sampling import BEYOND, lay_over
from shapeblend_cli.model import NORMAL
from shapeblend_cli.outputs.pixels import NEVER, Size, bands, png_of, rasterize, read_png
from shapeblend_cli.svg.writing.document import frame_svg

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from shapeblend_cli.model import BentPicture, Box, Frame, PaintedShape, UIntArray

T = TypeVar("T")

MOST_AT_ONCE = 4
"""Maximum number of frames that are worked on at the same time."""

MOST_KEPT = 1 << 22
"""Maximum size of a document's picture that is kept for the next frame, in pixels."""


class Composed(NamedTuple):
    """A frame in parts."""

    view: Box
    parts: tuple[str | PaintedShape, ...]  # from below: documents, and shapes with a bent picture


def in_parts(frame: Frame, decimals: int, side: int) -> Composed | None:
    """Return a frame, of some pixels on its longer side, in parts; None if it has to be drawn as a whole."""
    effects = [(shape.bent, effect) for shape in frame.shapes for effect in shape.effects]
    if any(effect.mode != NORMAL or (bent and not effect.is_plain) for bent, effect in effects):
        return None
    parts: list[str | PaintedShape] = []
    for is_bent, shapes in groupby(frame.shapes, lambda shape: shape.bent is not None):
        if is_bent:
            parts += shapes
        else:
            own = with_own_pictures(frame._replace(shapes=tuple(shapes)), side)
            parts.append(frame_svg(own, decimals))
    return Composed(frame.view, tuple(parts))


def draw(document: str | Composed, size: Size, ground: str | None = None) -> bytes:
    """Return a document, or a frame in parts, as a PNG; see `rasterize`."""
    if isinstance(document, str):
        return rasterize(document, size, ground)
    return compose(document, size, ground)


def draw_all(documents: Iterable[str | Composed], size: Size, ground: str | None = None) -> Iterator[bytes]:
    """Yield documents as PNGs; see `rasterize`. Frames in parts are drawn at the same time."""
    pool, over = ThreadPoolExecutor(MOST_AT_ONCE), Event()
    drawn: deque[bytes | Future[bytes]] = deque()
    try:
        for document in documents:
            if isinstance(document, str):
                drawn.append(rasterize(document, size, ground))  # resvg keeps other threads from running
            else:
                drawn.append(pool.submit(compose, document, size, ground, over))
            while drawn and (len(drawn) > MOST_AT_ONCE or isinstance(drawn[0], bytes)):
                yield _result(drawn.popleft())
        yield from map(_result, drawn)
    finally:
        over.set()
        pool.shutdown(cancel_futures=True)


def at_once(act: Callable[[bytes], T], values: Iterable[bytes]) -> Iterator[T]:
    """Yield what a function returns for values, in their order. It is called for several of them at the same time."""
    pool = ThreadPoolExecutor(MOST_AT_ONCE)
    try:
        yield from pool.map(act, values)
    finally:
        pool.shutdown(cancel_futures=True)


def _result(drawn: bytes | Future[bytes]) -> bytes:
    return drawn if isinstance(drawn, bytes) else drawn.result()


def compose(frame: Composed, size: Size, ground: str | None = None, over: Event = NEVER) -> bytes:
    """Return a frame as a PNG; see `rasterize`, and `bands` for `over`."""
    canvas = np.zeros((size.height, size.width, 4), np.uint8)
    if ground is not None:
        from PIL import ImageColor

        red, green, blue, *alpha = ImageColor.getrgb(ground)
        opacity = alpha[0] if alpha else 255
        canvas[:] = [round(value * opacity / 255) for value in (red, green, blue, 255)]
    view = frame.view
    scale = min(size.width / view.width, size.height / view.height)
    corner = view.centre - complex(size.width, size.height) / (2.0 * scale)
    for part in frame.parts:
        if isinstance(part, str):
            drawn = (_kept if size.width * size.height <= MOST_KEPT else _drawn)(part, size)
            for first, last in bands(size.width, 0, size.height, over):
                mask = np.full((last - first, size.width), 255, np.uint8)
                lay_over(canvas, drawn[first:last], mask, 0, first)
        elif part.bent is not None:
            _lay_bent(canvas, part, part.bent, corner, scale, over)
    return b"" if over.is_set() else png_of(canvas)


def _lay_bent(
    canvas: UIntArray, shape: PaintedShape, bent: BentPicture, corner: complex, scale: float, over: Event
) -> None:
    """Lay the bent picture of a shape over what is drawn so far."""
    height, width = canvas.shape[:2]
    near, far = (scale * (complex(*side) - corner) for side in (bent.box.bounds[:2], bent.box.bounds[2:]))
    left, right = max(math.floor(near.real - BEYOND), 0), min(math.ceil(far.real + BEYOND), width)
    top, bottom = max(math.floor(near.imag - BEYOND), 0), min(math.ceil(far.imag + BEYOND), height)
    if left >= right:
        return
    for first, last in bands(right - left, top, bottom, over):
        place = corner + complex(left, first) / scale
        mask = coverage(shape.clips, place, scale, right - left, last - first)
        drawn = bent.pixels(place, scale, right - left, last - first)
        lay_over(canvas, drawn, mask, left, first)


def _drawn(document: str, size: Size) -> UIntArray:
    """Return the pixels of a document, premultiplied."""
    return np.array(read_png(rasterize(document, size)).convert("RGBa"))


_kept = lru_cache(maxsize=2)(_drawn)  # what stays is the same document in all frames
