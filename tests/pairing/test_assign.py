from itertools import combinations, permutations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.pairing.assign import align, assign

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


@given(tables, st.integers(0, 30))
def test_pairs_in_order_at_the_least_total(rows, left_out):
    costs = np.array(rows, float)
    p, q = costs.shape
    found = align(costs, float(left_out))
    assert found == sorted(found)
    assert [j for _, j in found] == sorted({j for _, j in found})

    def total(pairs):
        return sum(costs[i, j] for i, j in pairs) + left_out * (p + q - 2 * len(pairs))

    every = (
        total(list(zip(i, j, strict=True)))
        for count in range(min(p, q) + 1)
        for i in combinations(range(p), count)
        for j in combinations(range(q), count)
    )
    assert total(found) == min(every)


def test_what_cannot_be_a_pair_is_none():
    assert align(np.array([[np.inf, 1.0], [2.0, np.inf]]), 5.0) in ([(0, 1)], [(1, 0)])
    assert assign(np.zeros((0, 3))) == []
