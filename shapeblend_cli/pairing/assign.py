"""Pairs of least total cost, with and without keeping an order."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from shapeblend_cli.model import FloatArray


def assign(costs: FloatArray) -> list[tuple[int, int]]:
    """Pair rows with columns at the least total cost: as many pairs as there are of the fewer.

    Parameters
    ----------
    costs : (p, q) finite float

    Returns
    -------
    list of (int, int)
        By row.
    """
    if min(costs.shape) == 0:
        return []
    if 1 in costs.shape:
        return [(int(k) // costs.shape[1], int(k) % costs.shape[1]) for k in [costs.argmin()]]
    import lap  # most drawings that are blended have one outline and no need of it

    _, columns, _ = lap.lapjv(np.ascontiguousarray(costs), extend_cost=True)
    return [(i, int(j)) for i, j in enumerate(columns) if j >= 0]


def align(costs: FloatArray, left_out: float) -> list[tuple[int, int]]:
    """Pair rows with columns in order, so that no two pairs cross, at the least total cost.

    Parameters
    ----------
    costs : (p, q) float
        Infinite for what cannot be a pair.
    left_out : float
        Cost of a row or a column without a partner.

    Returns
    -------
    list of (int, int)
        Rising in both.
    """
    p, q = costs.shape
    # total[i, j] is the least cost of the first i rows and j columns.
    total = np.zeros((p + 1, q + 1))
    total[:, 0] = left_out * np.arange(p + 1)
    total[0, :] = left_out * np.arange(q + 1)
    for i in range(1, p + 1):
        paired = total[i - 1, :-1] + costs[i - 1]
        best = np.minimum(paired, total[i - 1, 1:] + left_out)
        for j in range(1, q + 1):
            total[i, j] = min(best[j - 1], total[i, j - 1] + left_out)
    found = []
    i, j = p, q
    while i and j:
        if total[i, j] == total[i - 1, j - 1] + costs[i - 1, j - 1]:
            found.append((i - 1, j - 1))
            i, j = i - 1, j - 1
        elif total[i, j] == total[i - 1, j] + left_out:
            i -= 1
        else:
            j -= 1
    return found[::-1]
