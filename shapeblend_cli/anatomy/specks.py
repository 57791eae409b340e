"""Drawings without what is too small to be meant, such as the specks of a scan."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from shapeblend_cli.errors import InputError
from shapeblend_cli.geometry import cubics
from shapeblend_cli.model import Box

if TYPE_CHECKING:
    from shapeblend_cli.model import Drawing


def without_specks(drawing: Drawing, least: float | str) -> tuple[Drawing, list[str]]:
    """Return a drawing without contours whose larger side is below a length, and phrases on what was left out.

    The length is in the drawing's own units, or a share of its larger side such as ``1%``. Raises InputError if nothing
    is left.
    """
    boxes = [[cubics.bounds(contour.segments) for contour in shape.contours] for shape in drawing.shapes]
    whole = Box.union([box for own in boxes for box in own])
    limit = whole.larger_side * float(least[:-1]) / 100.0 if isinstance(least, str) else least
    shapes = []
    left_out = 0
    for shape, own in zip(drawing.shapes, boxes, strict=True):
        kept = tuple(c for c, box in zip(shape.contours, own, strict=True) if box.larger_side >= limit)
        left_out += len(own) - len(kept)
        if kept:
            shapes.append(replace(shape, contours=kept))
    if not shapes:
        raise InputError(
            drawing.file,
            f"all of its contours are smaller than {limit:.6g}; a smaller --specks would leave some",
        )
    if not left_out:
        return drawing, []
    what = "1 contour" if left_out == 1 else f"{left_out} contours"
    return drawing._replace(shapes=tuple(shapes)), [
        f"{drawing.file}: {what} smaller than {limit:.6g} left out"
    ]
