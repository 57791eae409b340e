"""A file for each frame, SVG or PNG; or all frames in one SVG document, in layers to be edited on."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.errors import OptionError
from shapeblend_cli.outputs.formats import OutputSpec, Rendered, frame_svgs, page_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Pair


def render_svg(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    """Return a document for each frame."""
    from shapeblend_cli.frames.frames import make_frames
    from shapeblend_cli.svg.writing.document import frame_svg

    decimals = spec.decimals(pairs)
    return Rendered([frame_svg(frame, decimals) for frame in spec.counted(make_frames(pairs, spec.settings))])


def render_png(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    """Return a picture of each frame."""
    from shapeblend_cli.outputs.composed import draw_all
    from shapeblend_cli.outputs.pixels import size_of

    size = size_of(spec.width, pairs, spec.frame_count)
    return Rendered([*draw_all(spec.counted(frame_svgs(spec, pairs)), size, spec.ground)])


def render_layers(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    """Return the document."""
    from shapeblend_cli.frames.frames import make_frames
    from shapeblend_cli.svg.writing.document import layers_svg

    return Rendered([layers_svg(make_frames(pairs, spec.settings), spec.decimals(pairs), page_of(pairs))])


def check_layers(spec: OutputSpec) -> None:
    """Raise OptionError where there are no frames."""
    if not spec.frame_count:
        raise OptionError("--frames 0 leaves nothing for layers; --frames 1 or --ends would work")
