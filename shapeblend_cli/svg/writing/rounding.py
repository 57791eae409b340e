"""Numbers as they are written: how many decimals a drawing needs, and a number rounded to them."""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapeblend_cli.model import Box, ComplexArray, IntArray

ROUNDING = 4e-5  # how far rounding may move a point, as a share of what is shown

DASH_DIGITS = 2
"""Number of further decimals of dashes and gaps: along a line their errors add up."""

MOST_KNOWN = 1 << 14
"""Maximum number of numbers whose texts are kept."""

LARGEST = 2.0**62
"""Minimum number of units that no machine's integer is sure to hold, nor a difference of two."""


def decimals_for(boxes: Sequence[Box]) -> int:
    """Return the number of decimals that moves no point by more than `ROUNDING`, whichever box is shown."""
    size = min(box.larger_side for box in boxes)
    return max(0, math.ceil(-math.log10(math.sqrt(2.0) * ROUNDING * size))) if size > 0.0 else 5


def number(value: float, decimals: int) -> str:
    """Return a finite number in its shortest form, with at most `decimals` decimals."""
    if not math.isfinite(value):
        raise ValueError(f"{value} cannot be written to an SVG file")
    text = f"{value:.{decimals}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def on_grid(points: ComplexArray, scale: int) -> IntArray:
    """Round points, (..., k) complex, to a grid of 1 / `scale`; return x and y in units of it, (..., k, 2) int."""
    values = np.ascontiguousarray(points).view(np.float64)
    if not np.isfinite(values).all():
        raise ValueError(f"{points[~np.isfinite(points)][0]} cannot be written to an SVG file")
    rounded = np.rint(values * scale)
    is_huge = np.abs(rounded).max(initial=0.0) >= LARGEST
    grid = np.array([*map(int, rounded.flat)], object) if is_huge else rounded.astype(np.int64)
    return grid.reshape(*points.shape, 2)


class _ShortNumbers(dict[int, str]):
    """Texts of numbers, see `short_numbers`, as far as they were asked for."""

    def __init__(self, scale: int) -> None:
        super().__init__()
        self._scale = scale

    def __missing__(self, value: int) -> str:
        if len(self) >= MOST_KNOWN:
            self.clear()
        whole, rest = divmod(abs(value), self._scale)
        decimals = str(rest + self._scale)[1:].rstrip("0") if rest else ""
        digits = (str(whole) if whole or not decimals else "") + (f".{decimals}" if decimals else "")
        self[value] = text = f"-{digits}" if value < 0 else f" {digits}"
        return text


@cache
def short_numbers(scale: int) -> Mapping[int, str]:
    """Return the texts of numbers of units of 1 / `scale`, without needless zeros: ``.5`` rather than ``0.5``.

    Those without a sign begin with a blank, which parts them from what is before them.
    """
    return _ShortNumbers(scale)
