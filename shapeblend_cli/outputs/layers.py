"""All frames in one SVG document, each in a layer of its own, to be edited on."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.errors import OptionError
from shapeblend_cli.outputs.formats import Format, OutputSpec, Rendered

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Pair


def _render(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
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


def _check(spec: OutputSpec) -> None:
    if not spec.frame_count:
        raise OptionError("--frames 0 leaves nothing for layers; --frames 1 or --ends would work")


FORMAT = Format(
    "layers",
    "one SVG with all frames as layers of Inkscape",
    _render,
    emit="layers",
    suffix=".svg",
    to_standard_output=True,
    check=_check,
)
