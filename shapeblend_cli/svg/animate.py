"""Two pictures to an SVG file that plays by itself.

Vertices on straight paths need two keyframes and no more: between them SMIL interpolates every number
evenly, which is eq (2). Both must have the same commands in the same order.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from shapeblend_cli.svg import document
from shapeblend_cli.svg.attributes import decimals_for, number, paint_attributes, path_data, without_defaults

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box, PaintedShape

SECONDS = 2.0
"""How long an animation takes from A to B."""


def animated_svg(start: Sequence[PaintedShape], end: Sequence[PaintedShape], viewbox: Box) -> str:
    """An SVG document that moves from one picture to another, over and over.

    Parameters
    ----------
    start, end : sequence of PaintedShape
        With the same outlines, vertex for vertex.
    viewbox : Box
    """
    decimals = decimals_for(viewbox)
    drawing = document.empty(viewbox, decimals)
    for shape, target in zip(start, end, strict=True):
        drawing.add(_animated_path(drawing, shape, target, decimals))
    return document.text(drawing)


def _animated_path(drawing: Any, start: PaintedShape, end: PaintedShape, decimals: int) -> Any:
    keyframes = [
        {"d": path_data(shape.outlines, decimals), **paint_attributes(shape.style, decimals)}
        for shape in (start, end)
    ]
    shown = without_defaults(keyframes[0]).keys() | without_defaults(keyframes[1]).keys()
    path = drawing.path(**{name: value for name, value in keyframes[0].items() if name in shown})
    for name in sorted(keyframes[0].keys() & keyframes[1].keys()):
        value, target = keyframes[0][name], keyframes[1][name]
        if value != target:
            path.add(
                drawing.animate(
                    attributeName=name.replace("_", "-"),
                    values=f"{value};{target}",
                    dur=f"{number(SECONDS, 3)}s",
                    repeatCount="indefinite",
                )
            )
    return path
