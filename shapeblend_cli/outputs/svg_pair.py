"""Two drawings with equal commands, for any program that moves one path into another.

GSAP, CSS transitions, Figma and many more interpolate linearly from number to number, and need the same commands in
the same order for that. The in-betweens are then those of shapeblend, unless these move on curved paths.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.outputs.formats import OutputSpec, Rendered

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Pair
    from shapeblend_cli.outputs.move import Move


def svg_pair(move: Move, decimals: int) -> list[str]:
    """Return two SVG documents: the same paths by id, order, attributes and commands.

    Each shows its drawing, in the coordinates of A. A contour without a partner is a point in the other
    file; paint without a partner is there with an opacity of 0, so that it can fade in.
    """
    from shapeblend_cli.svg.writing import document
    from shapeblend_cli.svg.writing.paint import Gradients, paint_attributes
    from shapeblend_cli.svg.writing.path_data import path_data

    drawings = [document.empty(view, decimals) for view in move.views]
    gradients = [Gradients(decimals) for _ in drawings]
    for moved in move.shapes:
        name, shapes = moved.name, (moved.start, moved.end)
        sides = [defined.attributes(shape.style) for defined, shape in zip(gradients, shapes, strict=True)]
        for drawing, shape, side in zip(drawings, shapes, sides, strict=True):
            paint = paint_attributes(shape.style, decimals) | side
            shown = {key: value for key, value in paint.items() if any(key in other for other in sides)}
            data = path_data(shape.paths, decimals)
            drawing.append(document.new("path", {"d": data, "id": name, **shown}))
    return [
        document.text(drawing, definitions=defined.elements)
        for drawing, defined in zip(drawings, gradients, strict=True)
    ]


def render(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    """Return both documents."""
    from shapeblend_cli.outputs.move import left_out, moves_of, without_pictures

    pairs, lost = without_pictures(pairs, "--emit pair")
    (move,) = moves_of(pairs)
    notes = [*lost, *move.lost_curved_motion(), *left_out(pairs, "--emit pair")]
    return Rendered(svg_pair(move, spec.decimals(pairs)), notes)
