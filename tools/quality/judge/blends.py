"""The blends of a pair that are graded, how they look, and what the judge says of them."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import shapeblend_cli as sb
from shapeblend_cli.geometry.raster import winding_grid
from shapeblend_cli.model import Box
from shapeblend_cli.motion.judge import judge_shape, outlines_of
from tools.quality.npm import icon_file

if TYPE_CHECKING:
    from tools.quality.judge.pairs import Pair

OPTIONS = {
    "linear": {"motion": "linear"},
    "intrinsic": {"motion": "intrinsic"},
    "rigid": {"motion": "rigid"},
    "paper": {"motion": "linear", "preset": "paper"},
    "paper, intrinsic": {"motion": "intrinsic", "preset": "paper"},
}
"""What is graded of a pair, and the options that draw it."""

CELLS, POINTS, MOMENTS = 6, 10, (2, 4, 6)
"""A look tells of so many cells a side how much of each is painted, from that many points a side, at those of the
judge's times. What lies in another shape counts as unpainted, so that it is seen."""

ALIKE = 0.2
"""Blends look alike if their looks differ by no more in the mean, of 9."""


def blend_of(pair: Pair, options: dict[str, str]) -> sb.Blend:
    """Blend a pair of icons."""
    with tempfile.TemporaryDirectory() as folder:
        files = Path(folder, "a.svg"), Path(folder, "b.svg")
        for file, name in zip(files, pair[1:], strict=True):
            file.write_text(icon_file(pair.icons, name), encoding="utf-8")
        return sb.blend(*map(str, files), strokes="keep", **options)  # the graded blends are of outlines


def look(blend: sb.Blend) -> str:
    """How a blend looks, a digit for each cell: by it a blend that was graded is known again."""
    outlines = [outlines_of(shape) for shape in blend.pairs[0].each_shape]
    box = Box.around(np.concatenate([one.points[[0, -1]].ravel() for one in outlines]))
    left, top, right, bottom = box.bounds
    side = CELLS * POINTS
    step = box.larger_side / side
    corner = 0.5 * complex(left + right, top + bottom) - 0.5 * side * step * (1.0 + 1.0j)
    digits = []
    for k in MOMENTS:
        painted = np.zeros((side, side), np.bool_)
        for one in outlines:
            starts = one.points[k, one.closed]
            ends = one.points[k, one.following[one.closed]]
            painted ^= winding_grid(starts, ends, corner, step, side) != 0
        cells = painted.reshape(CELLS, POINTS, CELLS, POINTS).mean(axis=(1, 3))
        digits += np.rint(9.0 * cells).astype(int).ravel().tolist()
    return "".join(map(str, digits))


def unlikeness(p: str, q: str) -> float:
    """By how much two looks differ in the mean."""
    return float(np.mean([abs(int(x) - int(y)) for x, y in zip(p, q, strict=True)]))


def number(blend: sb.Blend) -> float:
    """What is wrong with a blend: the judge's numbers of its shapes, each counting by the area it paints."""
    view = Box.union([drawing.viewbox for drawing in blend.drawings])
    found = [judge_shape(shape, view) for shape in blend.pairs[0].each_shape]
    return float(np.average([one.judgement.number for one in found], weights=[one.painted for one in found]))
