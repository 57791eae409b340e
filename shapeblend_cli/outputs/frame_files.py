"""A file for each frame, SVG or PNG; or all frames in one SVG document, in layers to be edited on."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.errors import OptionError
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


def _render_layers(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    from shapeblend_cli.frames.frames import make_frames
    from shapeblend_cli.paint.names import common_page
    from shapeblend_cli.svg.writing.document import layers_svg

    frames = make_frames(pairs, spec.settings)
    return Rendered(
        [
            layers_svg(
                frames,
                spec.decimals(pairs),
                common_page([pairs[0].pages[0], *(pair.pages[1] for pair in pairs)]),
            )
        ]
    )


def _check_layers(spec: OutputSpec) -> None:
    if not spec.frame_count:
        raise OptionError("--frames 0 leaves nothing for layers; --frames 1 or --ends would work")


SINGLE = (
    Format("svg", "one file for each frame", _render_svg),
    Format(
        "png",
        "one file for each frame",
        _render_png,
        defaults={"width": 512, "background": TRANSPARENT},
        check_libraries=check_libraries,
    ),
)

LAYERS = Format(
    "layers",
    "one SVG with all frames as layers of Inkscape",
    _render_layers,
    emit="layers",
    suffix=".svg",
    to_standard_output=True,
    check=_check_layers,
)
