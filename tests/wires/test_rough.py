"""The rough estimate of work."""

import pytest

from shapeblend_cli.options.constants import PAPER, WorkConstants
from shapeblend_cli.wires.rough import turning, work_of_few
from tests.support.shapes import gear, random_polygon, regular_polygon, star_polygon, wavy


@pytest.mark.parametrize("closed", [True, False])
def test_paths_bend_by_the_difference_of_turnings_at_least(rng, closed):
    constants = WorkConstants(**PAPER)
    outlines = [gear(6), regular_polygon(4), wavy(30, 1)]
    outlines += [make(rng, m) for make in (random_polygon, star_polygon) for m in (3, 5, 12, 24)]
    for p in outlines:
        for q in outlines:
            apart = constants.k_b * abs(turning(p, closed) - turning(q, closed))
            assert work_of_few(p, q, closed, constants) >= apart - 1e-9
