"""Dashes of lines that move: the pattern goes along with the line, wherever its path begins."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry.polyline import cumulative_lengths
from shapeblend_cli.pens.line import lengths_along

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray, Style
    from shapeblend_cli.pens.line import PenLine


def with_dashes(
    styles: tuple[Style, Style], lines: tuple[PenLine, PenLine], ends: list[ComplexArray], scale: float
) -> tuple[Style, Style]:
    """Return the paint of a line at both ends, its dashes as the files have them, and at rest where the line rests.

    Parameters
    ----------
    styles : (Style, Style)
    lines : (PenLine, PenLine)
        What the line is a part of, at the start and at the end.
    ends : list of (k,) complex
        Its vertices there, in units, as its path has them.
    scale : float
        Units per unit of the drawing.
    """
    a, b = (_along(*each, scale) for each in zip(styles, lines, ends, strict=True))
    if not (a.stroke_dasharray and b.stroke_dasharray):
        return a, b
    # A vertex in the middle: what is before it may be drawn on or back.
    known = [cumulative_lengths(points) for points in ends]
    middle = int(np.searchsorted(known[0] + known[1], (known[0][-1] + known[1][-1]) / 2.0))
    wanted = a.stroke_dashoffset + float(known[0][middle] - known[1][middle]) / scale
    period = sum(b.stroke_dasharray) * (1 + len(b.stroke_dasharray) % 2)
    turns = round((wanted - b.stroke_dashoffset) / period)
    return a, b._replace(stroke_dashoffset=b.stroke_dashoffset + turns * period)


def _along(style: Style, line: PenLine, points: ComplexArray, scale: float) -> Style:
    """Return a style with its dashes in the direction and from the start of a part of a line."""
    lengths = lengths_along(line, points) if style.stroke_dasharray else None
    if lengths is None:
        return style
    begin = float(lengths[0]) / scale
    if all(low <= high for low, high in pairwise(lengths)):
        return style._replace(stroke_dashoffset=style.stroke_dashoffset + begin)
    dashes = style.stroke_dasharray * (1 + len(style.stroke_dasharray) % 2)
    # From the other side: the last dash comes first, and the last gap is what is left before it.
    turned = (*dashes[-2::-1], dashes[-1])
    return style._replace(
        stroke_dasharray=turned, stroke_dashoffset=sum(dashes[:-1]) - style.stroke_dashoffset - begin
    )
