"""What regression trees tell of the measures of a strip. `make judge-weights` grows them from grades by people."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from shapeblend_cli.model import FloatArray, IntArray

DEPTH = 3
"""Number of questions that a tree asks."""


class Forest(NamedTuple):
    """Trees with `DEPTH` levels of questions; the node after node k is 2 k + 1, or 2 k + 2 if the answer is yes."""

    base: float  # mean grade, to which each tree adds
    places: IntArray  # (trees, 2**DEPTH - 1), which measure is asked about
    limits: FloatArray  # (trees, 2**DEPTH - 1): is the measure larger?
    leaves: FloatArray  # (trees, 2**DEPTH), what is added

    def tell(self, values: FloatArray) -> float:
        """Return the sum of what the trees say of the measures of one strip."""
        trees = np.arange(len(self.places))
        at = np.zeros(len(trees), np.intp)
        for _ in range(DEPTH):
            at = 2 * at + 1 + (values[self.places[trees, at]] > self.limits[trees, at])
        return self.base + float(self.leaves[trees, at - len(self.places[0])].sum())


@cache
def forest() -> Forest:
    """Read the trees."""
    import json  # most blends are not graded

    found = json.loads(Path(__file__).with_name("trees.json").read_text("utf-8"))
    return Forest(
        found["base"],
        np.array(found["places"], np.intp),
        np.array(found["limits"], np.float64),
        np.array(found["leaves"], np.float64),
    )


def tree_grade(values: FloatArray) -> float:
    """Return a grade by the measures of a strip, and the weighted sum of its faults after them."""
    return forest().tell(values)
