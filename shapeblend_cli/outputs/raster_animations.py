"""Drawings one after another in a GIF, a WebP or an animated PNG.

GIF: https://www.w3.org/Graphics/GIF/spec-gif89a.txt, WebP: https://developers.google.com/speed/webp/docs/riff_container,
animated PNG: https://www.w3.org/TR/png-3/
"""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

from PIL import Image

from shapeblend_cli.outputs.raster import drawn, opened

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from shapeblend_cli.outputs.raster import Size
    from shapeblend_cli.outputs.times import Run

COLOURS = 256
"""Of a picture in a GIF."""


def animation(
    kind: str, svgs: Sequence[str], size: Size, run: Run, runs: int | None, background: str | None
) -> bytes:
    """The file of an animation.

    Parameters
    ----------
    kind : {'gif', 'webp', 'apng'}
    svgs : sequence of str
        Documents without an XML declaration, from the first drawing to the last.
    size : Size
        Drawings are fitted into it as large as they can be.
    run : Run
    runs : int or None
        How often it runs; None is forever.
    background : str or None
        A colour, which a GIF needs; without one what is not painted is transparent.
    """
    if kind == "gif":
        return _gif(svgs, size, run, runs, background)
    pictures = (opened(png) for png in _drawn(svgs, size, run, background))
    said: dict[str, Any] = {"duration": run.delays(1000), "loop": runs or 0}
    if kind == "webp":
        # Without loss quality is how hard it tries; more than this takes twice as long for a hundredth.
        return _saved(pictures, "WEBP", **said, lossless=True, quality=40)
    return _saved(pictures, "PNG", **said)


def _gif(svgs: Sequence[str], size: Size, run: Run, runs: int | None, background: str | None) -> bytes:
    """Each picture has a palette of its own, since colours change; dithering would flicker."""
    pictures = (
        opened(png)
        .convert("RGB")
        .quantize(COLOURS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
        for png in _drawn(svgs, size, run, background)
    )
    # The file says how often it runs again: nothing for once, and 0 for forever.
    again = {} if runs == 1 else {"loop": 0 if runs is None else runs - 1}
    return _saved(pictures, "GIF", duration=[10 * delay for delay in run.delays(100)], **again)


def _drawn(svgs: Sequence[str], size: Size, run: Run, background: str | None) -> list[bytes]:
    """The pictures in the order they are shown in, each drawn once."""
    pngs = [drawn(svg, size, background) for svg in svgs]
    return [pngs[k] for k in run.order()]


def _saved(pictures: Iterable[Image.Image], form: str, **said: Any) -> bytes:
    file = io.BytesIO()
    first, *others = pictures
    first.save(file, form, save_all=True, append_images=others, **said)
    return file.getvalue()
