"""Groups of things of which some are together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import BoolArray, Box


def grouped(
    likely: BoolArray, are_together: Callable[[int, int], bool] = lambda one, other: True
) -> list[list[int]]:
    """Return groups of numbers, such that all that are together, directly or through others, are in one group.

    Parameters
    ----------
    likely : (n, n) bool
        Which of n things may be together; only the part below the diagonal counts.
    are_together : callable
        Whether two such things are; asked as few times as will do, the higher number first.
    """
    groups: dict[int, list[int]] = {}
    group = np.arange(len(likely))  # that each number is in, called by its highest number
    for k, row in enumerate(likely):
        near: set[int] = set()
        for other in np.flatnonzero(row[:k]).tolist():
            if (its := int(group[other])) not in near and are_together(k, other):
                near.add(its)
        groups[k] = [k, *(other for its in sorted(near) for other in groups.pop(its))]
        group[groups[k]] = k
    return list(groups.values())


def overlaps(boxes: Sequence[Box]) -> BoolArray:
    """Return which boxes have inner points in common with which, (n, n) bool."""
    left, top, right, bottom = np.array([box.bounds for box in boxes]).T[:, :, None]
    found: BoolArray = (left < right.T) & (left.T < right) & (top < bottom.T) & (top.T < bottom)
    return found
