"""Numbers, path data and paint as SVG writes them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box, Outline, Style

DIGITS = 5
"""Coordinates are written to about this share, 10 ** -DIGITS, of the drawing's size."""

DEFAULTS = {
    "fill_opacity": "1",
    "fill_rule": "nonzero",
    "stroke_opacity": "1",
    "stroke_width": "1",
    "stroke_linecap": "butt",
    "stroke_linejoin": "miter",
}
"""What SVG takes for attributes that are not there."""


def decimals_for(box: Box) -> int:
    """Decimals that keep coordinates within half of 10 ** -DIGITS of a drawing's size."""
    size = max(box.width, box.height)
    return max(0, DIGITS - math.floor(math.log10(size))) if size > 0.0 else DIGITS


def path_data(outlines: Sequence[Outline], decimals: int) -> str:
    """Polygons as path data: pairs after the first are lines without saying so."""
    parts = []
    for outline in outlines:
        points = " ".join(
            f"{number(z.real, decimals)},{number(z.imag, decimals)}" for z in outline.vertices.tolist()
        )
        parts.append(f"M{points}{'Z' if outline.closed else ''}")
    return "".join(parts)


def without_defaults(attributes: dict[str, str]) -> dict[str, str]:
    """The attributes that say something else than SVG does by itself."""
    return {name: value for name, value in attributes.items() if DEFAULTS.get(name) != value}


def paint_attributes(style: Style, decimals: int) -> dict[str, str]:
    """Presentation attributes of a style."""
    paint = {"fill": style.fill or "none"}
    if style.fill is not None:
        paint["fill_opacity"] = number(style.fill_opacity, 4)
        paint["fill_rule"] = style.fill_rule
    if style.stroke is not None:
        paint["stroke"] = style.stroke
        paint["stroke_opacity"] = number(style.stroke_opacity, 4)
        paint["stroke_width"] = number(style.stroke_width, decimals)
        paint["stroke_linecap"] = style.stroke_linecap
        paint["stroke_linejoin"] = style.stroke_linejoin
    return paint


def number(value: float, decimals: int) -> str:
    """A finite number in its shortest form with at most so many decimals."""
    if not math.isfinite(value):
        raise ValueError(f"{value} cannot be written to an SVG file")
    text = f"{value:.{decimals}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
