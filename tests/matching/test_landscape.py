"""The work of the least path through every dot, against all paths there are."""

from itertools import pairwise

import numpy as np
import pytest

from shapeblend_cli.matching.landscape import landscape
from shapeblend_cli.matching.steps import MOVES
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.options.constants import WorkConstants
from tests.support.oracle import legal_turn, paths
from tests.support.shapes import star_polygon
from tests.support.solver import find_least, path_through


def polygon(seed, count):
    return star_polygon(np.random.default_rng(seed), count)


def cheapest(wires, dots, band):
    """The least work through every dot, by pricing one path after the other."""
    columns, rows = (wires.m + 1, wires.n + 1) if wires.closed else (wires.m, wires.n)
    wanted = tuple(((dots[0] - dots[-1]) % (wires.m, wires.n)).tolist())
    least = np.full((columns, rows), np.inf)
    for path in paths(columns, rows):
        if band is not None and any(abs(c / (columns - 1) - r / (rows - 1)) > band for c, r in path):
            continue
        at = (np.array(path) + dots[0]) % (wires.m, wires.n)
        if wires.closed:
            steps = [(c2 - c1, r2 - r1) for (c1, r1), (c2, r2) in pairwise(path)]
            if steps[-1] != wanted or not legal_turn(steps[-1], steps[0]):
                continue
            at = at[:-1]
        work = wires.path_work(at).total
        for dot in path:
            least[dot] = min(least[dot], work)
    return least


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("band", [None, 0.45])
@pytest.mark.parametrize("weighted", [False, True])
@pytest.mark.parametrize(("m", "n"), [(3, 3), (4, 5), (5, 4)])
def test_every_dot_has_the_least_work_of_all_paths_through_it(closed, band, weighted, m, n):
    p0, p1 = polygon(m, m), polygon(10 + n, n)
    weight = np.linspace(0.5, 3.0, m) if weighted else None
    constants = WorkConstants(k_b=0.4)
    dots = find_least(p0, p1, closed, constants, band=band, weight=weight).dots
    wires = Wires(p0, p1, closed, constants, weight)
    found = landscape(wires, dots, band)
    np.testing.assert_allclose(found.works, cheapest(wires, dots, band), rtol=1e-12)


@pytest.mark.parametrize("closed", [True, False])
def test_the_path_through_a_dot_costs_what_is_said_of_the_dot(closed):
    wires = Wires(polygon(1, 17), polygon(2, 23), closed, WorkConstants())
    dots = find_least(polygon(1, 17), polygon(2, 23), closed).dots
    found = landscape(wires, dots)
    for column, row in np.argwhere(np.isfinite(found.works))[::7]:
        path = path_through(found, column, row)
        assert [column, row] in path.tolist()
        assert {tuple(step) for step in np.diff(path, axis=0).tolist()} <= set(MOVES)
        at = (path + found.start) % (wires.m, wires.n)
        work = wires.path_work(at[:-1] if closed else at).total
        assert work == pytest.approx(found.works[column, row], rel=1e-12)


def test_the_least_path_is_the_valley():
    p0, p1 = polygon(3, 30), polygon(4, 40)
    found = find_least(p0, p1)
    land = landscape(Wires(p0, p1, True, WorkConstants()), found.dots)
    places = (found.dots - found.dots[0]) % (30, 40)
    np.testing.assert_allclose(land.works[tuple(places.T)], found.work, rtol=1e-12)
    assert land.works.min() == pytest.approx(found.work, rel=1e-12)
    assert (path_through(land, 0, 0)[:-1] == places).all()


def test_no_path_goes_outside_the_band():
    wires = Wires(polygon(5, 12), polygon(6, 12), True, WorkConstants())
    land = landscape(wires, find_least(polygon(5, 12), polygon(6, 12), band=0.3).dots, 0.3)
    assert np.isinf(land.works[0, 6])
