"""Two drawings with equal commands, for any program that moves one path into another.

GSAP, CSS transitions, Figma and many more interpolate linearly from number to number, and need the same commands in
the same order for that. The in-betweens are then those of shapeblend, unless these move on curved paths.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.outputs.formats import Format, OutputSpec, Rendered

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Pair
    from shapeblend_cli.outputs.move import Move


def svg_pair(move: Move, decimals: int) -> list[str]:
    """Return two SVG documents: the same paths by id, order, attributes and commands.

    Each shows what its drawing shows, in the coordinates of A. A contour without a partner is a point in the other
    file; paint without a partner is there with an opacity of 0, so that it can fade in.
    """
    from shapeblend_cli.svg.writing import document
    from shapeblend_cli.svg.writing.paint import Gradients, paint_attributes, without_defaults
    from shapeblend_cli.svg.writing.path_data import path_data

    drawings = [document.empty(view, decimals) for view in move.views]
    gradients = [Gradients(decimals) for _ in drawings]
    for name, *shapes, _ in move.shapes:
        paints = [paint_attributes(shape.style, decimals) for shape in shapes]
        shown = without_defaults(paints[0]).keys() | without_defaults(paints[1]).keys()
        for drawing, shape, paint, defined in zip(drawings, shapes, paints, gradients, strict=True):
            attributes = {key: value for key, value in paint.items() if key in shown}
            for key in ("fill", "stroke"):
                gradient = getattr(shape.style, f"{key}_gradient")
                if gradient is not None:
                    attributes[key] = defined.link(gradient)
            drawing.add(drawing.path(d=path_data(shape.paths, decimals), id=name, **attributes))
    return [
        document.text(drawing, definitions=defined.elements)
        for drawing, defined in zip(drawings, gradients, strict=True)
    ]


def _render(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    from shapeblend_cli.outputs.move import moves_of

    (move,) = moves_of(pairs)
    return Rendered(svg_pair(move, spec.decimals(pairs)), move.lost_curved_motion())


FORMAT = Format(
    "pair",
    "A and B as SVG files with the same path commands, for other programs to morph",
    _render,
    emit="pair",
    files=("a.svg", "b.svg"),
    takes_sequences=False,
    motion="linear",  # as programs move between two files
)
