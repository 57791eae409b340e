"""Coarse pictures of painted shapes, for counting and comparing, not for people."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.raster import winding_grid
from shapeblend_cli.model.arrays import rolled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box, ComplexArray, CubicPath, PaintedShape, PictureArray, Style

SIDE = 96
"""Number of pixels along each side of a picture."""

CHORDS = 6
"""Number of chords that stand for a curve."""

CORNERS = 8
"""Number of corners of the polygon that stands for a round join."""


class _Layer(NamedTuple):
    """The edges of a painted region, its fill rule, colour and opacity."""

    starts: ComplexArray
    ends: ComplexArray
    rule: str
    colour: tuple[float, float, float]
    opacity: float


def picture(shapes: Sequence[PaintedShape], view: Box) -> PictureArray:
    """Paint shapes on nothing.

    Parameters
    ----------
    shapes : sequence of PaintedShape
        In the order of paint. Gradients are painted in their mean colour; dashes are left out, and so are clips.
    view : Box
        The part of the plane that is seen, in the middle of the picture.

    Returns
    -------
    (4, SIDE, SIDE) float
        Red, green and blue times opacity, and opacity, from 0 to 1.
    """
    step = view.larger_side / SIDE
    corner = view.centre - 0.5 * SIDE * step * (1.0 + 1.0j)
    painted = np.zeros((4, SIDE * SIDE), np.float32)
    for shape in shapes:
        for style in (shape.below, shape.style):
            if style is not None:
                for layer in _layers(shape.paths, style):
                    numbers = winding_grid(layer.starts, layer.ends, corner, step, SIDE)
                    inside = np.flatnonzero(numbers % 2 != 0 if layer.rule == "evenodd" else numbers != 0)
                    for channel, value in zip(painted, (*layer.colour, 1.0), strict=True):
                        channel[inside] += layer.opacity * (value - channel[inside])
    return painted.reshape(4, SIDE, SIDE)


def _layers(paths: Sequence[CubicPath], style: Style) -> list[_Layer]:
    """Return the regions of a fill and of a stroke."""
    found = []
    lines = [_points(path) for path in paths]
    fill, stroke = style.paints
    if fill.colour is not None and fill.opacity > 0.0:
        after = [rolled(line, -1) for line in lines]
        found.append(
            _Layer(
                np.concatenate(lines), np.concatenate(after), style.fill_rule, _rgb(fill.colour), fill.opacity
            )
        )
    if stroke.colour is not None and stroke.opacity > 0.0 and style.stroke_width > 0.0:
        corners = [_stroked(line, path.closed, style) for line, path in zip(lines, paths, strict=True)]
        starts, ends = (np.concatenate(side) for side in zip(*corners, strict=True))
        found.append(_Layer(starts, ends, "nonzero", _rgb(stroke.colour), stroke.opacity))
    return found


def _points(path: CubicPath) -> ComplexArray:
    """Return points along a path: the ends of its lines, and of chords of its curves."""
    t = np.arange(CHORDS) / CHORDS
    points = cubics.evaluate(path.segments[:, None, :], t)
    keep = np.ones(points.shape, np.bool_)
    keep[path.straight, 1:] = False
    return np.append(points[keep], path.segments[-1, 3])


def _stroked(line: ComplexArray, closed: bool, style: Style) -> tuple[ComplexArray, ComplexArray]:
    """Return edges around a stroked line: a rectangle for each chord, and a polygon for each join and round cap."""
    half = 0.5 * style.stroke_width
    chords = np.diff(line)
    lengths = np.abs(chords)
    chords, starts = chords[lengths > 0.0], line[:-1][lengths > 0.0]
    along = chords / np.abs(chords)
    square = half if style.stroke_linecap == "square" and not closed else 0.0
    side = 1j * half * along
    first, last = starts.copy(), starts + chords
    if square and len(along):
        first[0] -= square * along[0]
        last[-1] += square * along[-1]
    boxes = np.stack([first - side, last - side, last + side, first + side], axis=1)
    round_ends = closed or style.stroke_linecap == "round"
    joints = line if round_ends else line[1:-1]
    turns = np.exp(2j * np.pi * np.arange(CORNERS) / CORNERS)
    discs = joints[:, None] + half * turns
    return (
        np.concatenate([boxes.ravel(), discs.ravel()]),
        np.concatenate([np.roll(boxes, -1, axis=1).ravel(), np.roll(discs, -1, axis=1).ravel()]),
    )


def _rgb(colour: str) -> tuple[float, float, float]:
    red, green, blue = bytes.fromhex(colour[1:])
    return red / 255.0, green / 255.0, blue / 255.0
