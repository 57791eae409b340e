"""Coarse pictures of painted shapes, for counting and comparing, not for people."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.raster import winding_grid

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapeblend_cli.model import Box, ComplexArray, CubicPath, IntArray, PaintedShape, PictureArray, Style

SIDE = 96
"""Number of pixels along each side of a picture."""

CHORDS = 6
"""Number of chords that stand for a curve."""

CORNERS = 8
"""Number of corners of the polygon that stands for a round join."""


TURNS = np.exp(2j * np.pi * np.arange(CORNERS) / CORNERS)
"""Directions of the corners of a round join, (`CORNERS`,)."""

FOLLOWING = np.roll(TURNS, -1)
"""Directions of the corners after these, (`CORNERS`,)."""


class _Outlines(NamedTuple):
    """Points along the paths of a shape."""

    points: ComplexArray
    following: ComplexArray  # the point after each, round its path
    bounds: IntArray  # where each path begins, and where the last one ends


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
    layers = [
        layer
        for shape, outlines in zip(shapes, _outlines(shapes), strict=True)
        for style in (shape.below, shape.style)
        if style is not None
        for layer in _layers(shape.paths, outlines, style)
    ]
    is_black = not any(any(layer.colour) for layer in layers)
    # Of black, only the opacity is not 0.
    painted = np.zeros(SIDE * SIDE if is_black else (SIDE * SIDE, 4), np.float32)
    for layer in layers:
        numbers = winding_grid(layer.starts, layer.ends, corner, step, SIDE)
        inside = np.flatnonzero(numbers % 2 != 0 if layer.rule == "evenodd" else numbers != 0)
        colour = np.float32(1.0) if is_black else np.array((*layer.colour, 1.0), np.float32)
        under = painted.take(inside, axis=0)
        painted[inside] = under + layer.opacity * (colour - under)
    found = np.zeros((4, SIDE * SIDE), np.float32)
    found[3 if is_black else slice(None)] = painted.T
    return found.reshape(4, SIDE, SIDE)


def _outlines(shapes: Sequence[PaintedShape]) -> Iterator[_Outlines]:
    """Yield points along the paths of each shape: the ends of lines, and of chords of curves."""
    paths = [path for shape in shapes for path in shape.paths]
    if not paths:
        return
    segments = np.concatenate([path.segments for path in paths])
    last = np.cumsum([len(path.segments) for path in paths]) - 1
    points = np.empty((len(segments), CHORDS + 1), np.complex128)
    points[:, :CHORDS] = cubics.evaluate(segments[:, None, :], np.arange(CHORDS) / CHORDS)
    points[:, CHORDS] = segments[:, 3]
    keep = np.zeros(points.shape, np.bool_)
    keep[:, 0] = True
    keep[~np.concatenate([path.straight for path in paths]), :CHORDS] = True
    keep[last, CHORDS] = True
    found = points[keep]
    bounds = np.append(0, keep.sum(axis=1).cumsum()[last])
    following = np.append(found[1:], found[:1])
    following[bounds[1:] - 1] = found[bounds[:-1]]
    number = 0
    for shape in shapes:
        own = bounds[number : number + len(shape.paths) + 1]
        number += len(shape.paths)
        all_own = slice(own[0], own[-1])
        yield _Outlines(found[all_own], following[all_own], own - own[0])


def _layers(paths: Sequence[CubicPath], outlines: _Outlines, style: Style) -> list[_Layer]:
    """Return the regions of a fill and of a stroke."""
    found = []
    points, following, bounds = outlines
    fill, stroke = style.paints
    if fill.colour is not None and fill.opacity > 0.0:
        found.append(_Layer(points, following, style.fill_rule, _rgb(fill.colour), fill.opacity))
    if stroke.colour is not None and stroke.opacity > 0.0 and style.stroke_width > 0.0:
        lines = np.split(points, bounds[1:-1])
        corners = [_stroked(line, path.closed, style) for line, path in zip(lines, paths, strict=True)]
        starts, ends = (np.concatenate(side) for side in zip(*corners, strict=True))
        found.append(_Layer(starts, ends, "nonzero", _rgb(stroke.colour), stroke.opacity))
    return found


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
    round_ends = closed or style.stroke_linecap == "round"
    joints = line if round_ends else line[1:-1]
    count = len(along) * 4
    edges = np.empty((2, count + len(joints) * CORNERS), np.complex128)
    boxes = edges[:, :count].reshape(2, -1, 4)
    for k, corner in enumerate((first - side, last - side, last + side, first + side)):
        boxes[0, :, k] = boxes[1, :, k - 1] = corner
    discs = edges[:, count:].reshape(2, -1, CORNERS)
    discs[0] = joints[:, None] + half * TURNS
    discs[1] = joints[:, None] + half * FOLLOWING
    return edges[0], edges[1]


def _rgb(colour: str) -> tuple[float, float, float]:
    red, green, blue = bytes.fromhex(colour[1:])
    return red / 255.0, green / 255.0, blue / 255.0
