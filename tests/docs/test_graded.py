"""The icons whose blends were graded, as npm installs them."""

import pytest

from tests.support.equipment import require
from tools.quality.judge import pairs, section


@pytest.mark.parametrize(("seed", "count"), section.SEEDS.items())
def test_graded_pairs_are_drawn_by_lot(seed, count):
    require("graded icons")
    picked = iter(pairs.picked(seed, count))
    assert all(one.pair in picked for one in section.graded(seed))  # in the order in which they were drawn
