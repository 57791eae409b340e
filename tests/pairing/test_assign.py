from itertools import permutations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.pairing.pair import assign

tables = st.tuples(st.integers(1, 5), st.integers(1, 5)).flatmap(
    lambda shape: st.lists(
        st.lists(st.integers(0, 50), min_size=shape[1], max_size=shape[1]),
        min_size=shape[0],
        max_size=shape[0],
    )
)


@given(tables)
def test_as_many_pairs_as_can_be_at_the_least_total(rows):
    costs = np.array(rows, float)
    p, q = costs.shape
    found = assign(costs)
    assert len({i for i, _ in found}) == len({j for _, j in found}) == len(found) == min(p, q)
    tall = costs if p <= q else costs.T
    least = min(
        sum(tall[i, j] for i, j in enumerate(way)) for way in permutations(range(max(p, q)), min(p, q))
    )
    assert sum(costs[i, j] for i, j in found) == least


def test_nothing_with_nothing():
    assert assign(np.zeros((0, 3))) == []
