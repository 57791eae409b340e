"""Frames to SVG: a file a frame, or one file that plays by itself.

Vertices on straight paths need two keyframes and no more: between them SMIL interpolates every number
evenly, which is eq (2). Both must have the same commands in the same order.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree  # svgwrite has imported it anyway

from shapeblend_cli.svg.foreign import svgwrite

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box, Frame, Outline, PaintedShape, Style

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

SECONDS = 2.0
"""How long an animation takes from A to B."""


def decimals_for(box: Box) -> int:
    """Decimals that keep coordinates within half of 10 ** -DIGITS of a drawing's size."""
    size = max(box.width, box.height)
    return max(0, DIGITS - math.floor(math.log10(size))) if size > 0.0 else DIGITS


def frame_svg(frame: Frame, viewbox: Box) -> str:
    """One frame as an SVG document."""
    drawing, decimals = _drawing(viewbox)
    for shape in frame.shapes:
        paint = _without_defaults(_paint(shape.style, decimals))
        drawing.add(drawing.path(d=_path_data(shape.outlines, decimals), **paint))
    return _text(drawing)


def animated_svg(start: Frame, end: Frame, viewbox: Box) -> str:
    """An SVG document that moves from one frame to another, over and over.

    Parameters
    ----------
    start, end : Frame
        With the same shapes and outlines, vertex for vertex.
    viewbox : Box
    """
    drawing, decimals = _drawing(viewbox)
    for shape, target in zip(start.shapes, end.shapes, strict=True):
        drawing.add(_animated_path(drawing, shape, target, decimals))
    return _text(drawing)


def _animated_path(drawing: Any, start: PaintedShape, end: PaintedShape, decimals: int) -> Any:
    keyframes = [
        {"d": _path_data(shape.outlines, decimals), **_paint(shape.style, decimals)} for shape in (start, end)
    ]
    shown = _without_defaults(keyframes[0]).keys() | _without_defaults(keyframes[1]).keys()
    path = drawing.path(**{name: value for name, value in keyframes[0].items() if name in shown})
    for name in sorted(keyframes[0].keys() & keyframes[1].keys()):
        value, target = keyframes[0][name], keyframes[1][name]
        if value != target:
            path.add(
                drawing.animate(
                    attributeName=name.replace("_", "-"),
                    values=f"{value};{target}",
                    dur=f"{_number(SECONDS, 3)}s",
                    repeatCount="indefinite",
                )
            )
    return path


def _drawing(viewbox: Box) -> tuple[Any, int]:
    decimals = decimals_for(viewbox)
    drawing = svgwrite.Drawing(debug=False, viewBox=" ".join(_number(v, decimals) for v in viewbox))
    drawing.elements.remove(drawing.defs)
    return drawing, decimals


def _text(drawing: Any) -> str:
    """Serialise without what svgwrite adds unasked: a size of 100 %, a profile, two unused namespaces."""
    root = drawing.get_xml()
    for name in ("width", "height", "version", "baseProfile", "xmlns:ev", "xmlns:xlink"):
        root.attrib.pop(name, None)
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def _path_data(outlines: Sequence[Outline], decimals: int) -> str:
    """Polygons as path data: pairs after the first are lines without saying so."""
    parts = []
    for outline in outlines:
        points = " ".join(
            f"{_number(z.real, decimals)},{_number(z.imag, decimals)}" for z in outline.vertices.tolist()
        )
        parts.append(f"M{points}{'Z' if outline.closed else ''}")
    return "".join(parts)


def _without_defaults(attributes: dict[str, str]) -> dict[str, str]:
    """The attributes that say something else than SVG does by itself."""
    return {name: value for name, value in attributes.items() if DEFAULTS.get(name) != value}


def _paint(style: Style, decimals: int) -> dict[str, str]:
    """Presentation attributes of a style."""
    paint = {"fill": style.fill or "none"}
    if style.fill is not None:
        paint["fill_opacity"] = _number(style.fill_opacity, 4)
        paint["fill_rule"] = style.fill_rule
    if style.stroke is not None:
        paint["stroke"] = style.stroke
        paint["stroke_opacity"] = _number(style.stroke_opacity, 4)
        paint["stroke_width"] = _number(style.stroke_width, decimals)
        paint["stroke_linecap"] = style.stroke_linecap
        paint["stroke_linejoin"] = style.stroke_linejoin
    return paint


def _number(value: float, decimals: int) -> str:
    """A finite number in its shortest form with at most so many decimals."""
    if not math.isfinite(value):
        raise ValueError(f"{value} cannot be written to an SVG file")
    text = f"{value:.{decimals}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
