"""Groups of things of which some are together, and pairs at the least cost."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from shapeblend_cli.model import BoolArray, Box, FloatArray


class Groups:
    """Groups of numbers, which are added one by one, from 0 on."""

    def __init__(self, count: int) -> None:
        self.of = np.arange(count)  # the group that each number is in, called by its highest number
        self._members: dict[int, list[int]] = {}

    def add(self, number: int, near: Iterable[int]) -> None:
        """Add the next number, and make one group of it and of the groups with these names."""
        groups = [self._members.pop(name) for name in sorted(near)]
        self._members[number] = [number, *(other for group in groups for other in group)]
        self.of[self._members[number]] = number

    def __iter__(self) -> Iterator[list[int]]:
        return iter(self._members.values())


def grouped(together: BoolArray) -> list[list[int]]:
    """Return groups of numbers, such that all that are together, directly or through others, are in one group.

    Parameters
    ----------
    together : (n, n) bool
        Which of n things are together; only the part below the diagonal counts.
    """
    groups = Groups(len(together))
    for k, row in enumerate(together):
        groups.add(k, set(groups.of[:k][row[:k]].tolist()))
    return list(groups)


def overlaps(boxes: Sequence[Box]) -> BoolArray:
    """Return which boxes have inner points in common with which, (n, n) bool."""
    left, top, right, bottom = np.array([box.bounds for box in boxes]).T[:, :, None]
    found: BoolArray = (left < right.T) & (left.T < right) & (top < bottom.T) & (top.T < bottom)
    return found


def assign(costs: FloatArray) -> list[tuple[int, int]]:
    """Pair rows with columns at the least total of finite costs, as many as there are of the fewer; by row."""
    if min(costs.shape) == 0:
        return []
    if 1 in costs.shape:
        return [divmod(int(costs.argmin()), costs.shape[1])]
    import lap  # drawings with one exterior do without it

    _, columns, _ = lap.lapjv(np.ascontiguousarray(costs), extend_cost=True)
    return [(i, int(j)) for i, j in enumerate(columns) if j >= 0]
