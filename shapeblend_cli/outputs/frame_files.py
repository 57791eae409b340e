"""A file for each frame, SVG or PNG; or all frames in one SVG document, in layers to be edited on."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.errors import OptionError
from shapeblend_cli.outputs.formats import TRANSPARENT, Format, OutputSpec, Rendered, frame_svgs, page_of
from shapeblend_cli.outputs.pixels import check_libraries, rasterize, size_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Pair


def _render_svg(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    from shapeblend_cli.frames.frames import make_frames
    from shapeblend_cli.svg.writing.document import frame_svg

    decimals = spec.decimals(pairs)
    return Rendered([frame_svg(frame, decimals) for frame in spec.counted(make_frames(pairs, spec.settings))])


def _render_png(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    size = size_of(spec.width, pairs, spec.frame_count)
    return Rendered([rasterize(svg, size, spec.ground) for svg in spec.counted(frame_svgs(spec, pairs))])


def _render_layers(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    from shapeblend_cli.frames.frames import make_frames
    from shapeblend_cli.svg.writing.document import layers_svg

    return Rendered([layers_svg(make_frames(pairs, spec.settings), spec.decimals(pairs), page_of(pairs))])


def _check_layers(spec: OutputSpec) -> None:
    if not spec.frame_count:
        raise OptionError("--frames 0 leaves nothing for layers; --frames 1 or --ends would work")


_SVG = Format(
    "svg",
    "one file for each frame",
    _render_svg,
    takes_times=True,
    takes_stagger=True,
    mixtures="several",
)

SINGLE = (
    _SVG,
    _SVG._replace(
        name="png",
        render=_render_png,
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
    takes_times=True,
    takes_stagger=True,
    check=_check_layers,
)
