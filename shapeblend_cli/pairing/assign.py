"""Pairs of least total cost."""

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
