"""Rows of outlines: bars above each other in one drawing, as wide as rows of several outlines in the other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.anatomy.decompose import PlacedContour
    from shapeblend_cli.model import BoolArray, FloatArray

IN_ONE_ROW = 0.5
"""Minimum common height of two outlines of one row, as a share of the lower one's height."""

OF_ONE_WIDTH = 0.8
"""Minimum common width of a bar and a row, as a share of both together."""


class Row:
    """Outlines beside each other, or, if they are turned, above each other."""

    def __init__(self, contours: Sequence[PlacedContour], *, is_turned: bool) -> None:
        self.contours = contours
        low, high = _extents(contours, 1 if is_turned else 0)
        self.along = float(low.min()), float(high.max())
        low, high = _extents(contours, 0 if is_turned else 1)
        self.middle = float(low.min() + high.max()) / 2.0

    def is_as_wide_as(self, other: Row) -> bool:
        """Return whether two rows are about equally wide, and in one place."""
        (p, q), (r, s) = self.along, other.along
        return min(q, s) - max(p, r) >= OF_ONE_WIDTH * (max(q, s) - min(p, r))


def rows_of(contours: Sequence[PlacedContour], *, is_turned: bool) -> list[Row]:
    """Return the rows of outlines, from the top; each outline is in one of them."""
    low, high = _extents(contours, 0 if is_turned else 1)
    common = np.minimum(high[:, None], high) - np.maximum(low[:, None], low)
    heights = high - low
    together: BoolArray = common >= IN_ONE_ROW * np.minimum(heights[:, None], heights)
    rows: list[list[int]] = []
    for k in np.argsort(low, kind="stable").tolist():
        row = next((row for row in rows if together[k, row].any()), None)
        if row is None:
            rows.append([k])
        else:
            row.append(k)
    return [Row([contours[k] for k in row], is_turned=is_turned) for row in rows]


def _extents(contours: Sequence[PlacedContour], axis: int) -> tuple[FloatArray, FloatArray]:
    """Return where the boxes of contours begin and end along x, 0, or y, 1."""
    bounds = np.array([contour.box.bounds for contour in contours])
    return bounds[:, axis], bounds[:, axis + 2]
