"""Groups of things of which some are together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import BoolArray, Box


def grouped(together: BoolArray) -> list[list[int]]:
    """Return groups of numbers, such that all that are together, directly or through others, are in one group.

    Parameters
    ----------
    together : (n, n) bool
        Which of n things are together; only the part below the diagonal counts.
    """
    groups: list[list[int]] = []
    for k, row in enumerate(together):
        near = [group for group in groups if row[group].any()]
        groups = [group for group in groups if group not in near]
        groups.append([k, *(other for group in near for other in group)])
    return groups


def overlaps(boxes: Sequence[Box]) -> BoolArray:
    """Return which boxes have inner points in common with which, (n, n) bool."""
    left, top, right, bottom = np.array([box.bounds for box in boxes]).T[:, :, None]
    found: BoolArray = (left < right.T) & (left.T < right) & (top < bottom.T) & (top.T < bottom)
    return found
