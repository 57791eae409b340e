"""A file for each frame, SVG or PNG."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.outputs.formats import TRANSPARENT, Format, OutputSpec, Rendered, frame_svgs
from shapeblend_cli.outputs.raster import check_libraries, rasterize, size_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Pair


def _render_svg(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    from shapeblend_cli.frames.frames import make_frames
    from shapeblend_cli.svg.writing.document import frame_svg

    decimals = spec.decimals(pairs)
    return Rendered([frame_svg(frame, decimals) for frame in make_frames(pairs, spec.settings)])


def _render_png(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    size = size_of(spec.width, pairs, spec.frame_count)
    return Rendered([rasterize(svg, size, spec.ground) for svg in frame_svgs(spec, pairs)])


FORMATS = (
    Format("svg", "one file for each frame", _render_svg),
    Format(
        "png",
        "one file for each frame",
        _render_png,
        defaults={"width": 512, "background": TRANSPARENT},
        check_libraries=check_libraries,
    ),
)
