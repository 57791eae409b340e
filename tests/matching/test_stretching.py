"""The table of stretching work, beside the equation."""

import numpy as np
import pytest

from shapeblend_cli.matching import stretching
from shapeblend_cli.matching.tables import Window
from shapeblend_cli.options.constants import WorkConstants


@pytest.mark.parametrize("constants", [WorkConstants(), WorkConstants(k_s=0.7, e_s=1.3, c_s=0.2)])
def test_the_table_is_the_equation_edge_by_edge(rng, load_uncompiled, constants):
    lengths = rng.random(9), np.append(rng.random(6), 0.0)
    columns, weight = np.array([2, 0, 5, 8]), rng.random(4)
    window = Window.between(np.array([0, 1, 4, 5]), np.array([3, 4, 9, 11]))
    rows = np.concatenate([np.arange(low, high + 1) for low, high in zip(*window[:2], strict=True)]) % 7
    column = np.repeat(np.arange(4), window.high - window.low + 1)
    work = stretching.stretching_work(lengths[0][columns[column]], lengths[1][rows], constants)
    found = []
    for module in (stretching, load_uncompiled("shapeblend_cli.matching.stretching")):
        found.append(np.empty(window.dots))
        module.fill_stretching(lengths, constants, columns, weight, window, found[-1])
    np.testing.assert_allclose(found[0], work * weight[column], rtol=1e-14)
    assert np.array_equal(*found)
