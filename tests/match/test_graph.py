"""Section 4: the least path, against every path there is."""

import numpy as np
import pytest

from shapeblend_cli.match import graph, starts
from shapeblend_cli.match.solve import least_work
from shapeblend_cli.match.work import BEND_OF_STEPS, EAST, SOUTH, SOUTHEAST, WorkConstants, path_work, tables
from tests.support.oracle import EAST as E
from tests.support.oracle import SOUTH as S
from tests.support.oracle import SOUTHEAST as D
from tests.support.oracle import Oracle
from tests.support.shapes import gear, random_polygon, regular_polygon, star_polygon

CODE = {E: EAST, S: SOUTH, D: SOUTHEAST}


def random_constants(rng):
    return WorkConstants(
        k_s=rng.uniform(0.1, 2.0),
        k_b=rng.uniform(0.1, 2.0),
        e_s=rng.choice([1.0, 2.0]),
        e_b=rng.choice([0.5, 1.0, 2.0]),
        p_b=rng.choice([0.0, 5.0, 1000.0]),
        m_b=rng.choice([0.0, 1.0, 10.0]),
        c_s=rng.uniform(0.2, 1.0),
    )


def exhaustive(p0, p1, closed, constants, starts=None):
    """Least work over all paths; bends come from the tables, which have a test of their own."""
    priced = tables(p0, p1, closed, constants).bends
    oracle = Oracle(p0, p1, closed, constants)

    def bend(i, j, step_in, step_out):
        return priced[i, j, BEND_OF_STEPS[CODE[step_in], CODE[step_out]]]

    return oracle.least(bend, starts)


@pytest.mark.parametrize("seed", range(300))
def test_closed_optimum_is_that_of_an_exhaustive_search(seed):
    rng = np.random.default_rng(seed)
    m, n = rng.integers(3, 7, 2)
    make = random_polygon if seed % 2 else star_polygon
    p0, p1, constants = make(rng, m), make(rng, n), random_constants(rng)
    found = least_work(p0, p1, True, constants)
    assert found.work == pytest.approx(exhaustive(p0, p1, True, constants), rel=1e-9, abs=1e-12)
    assert found.gap <= 1e-9


@pytest.mark.parametrize("seed", range(40))
def test_optimum_from_a_given_start_is_that_of_an_exhaustive_search(seed):
    rng = np.random.default_rng(1000 + seed)
    m, n = rng.integers(3, 7, 2)
    p0, p1, constants = random_polygon(rng, m), random_polygon(rng, n), random_constants(rng)
    start = int(rng.integers(m)), int(rng.integers(n))
    found = least_work(p0, p1, True, constants, start)
    assert found.dots[0].tolist() == list(start)
    assert found.work == pytest.approx(exhaustive(p0, p1, True, constants, [start]), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("seed", range(60))
def test_open_optimum_is_that_of_an_exhaustive_search(seed):
    rng = np.random.default_rng(2000 + seed)
    m, n = rng.integers(2, 7, 2)
    p0, p1, constants = random_polygon(rng, m), random_polygon(rng, n), random_constants(rng)
    found = least_work(p0, p1, False, constants)
    assert found.dots[0].tolist() == [0, 0]
    assert found.dots[-1].tolist() == [m - 1, n - 1]
    assert found.work == pytest.approx(exhaustive(p0, p1, False, constants), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("seed", range(25))
def test_work_is_the_sum_of_the_equations_along_the_dots(seed):
    rng = np.random.default_rng(3000 + seed)
    closed = bool(seed % 3)
    p0, p1 = star_polygon(rng, 6), random_polygon(rng, 5)
    constants = random_constants(rng)
    found = least_work(p0, p1, closed, constants)
    assert found.work == pytest.approx(
        Oracle(p0, p1, closed, constants).price(found.dots), rel=5e-3, abs=5e-3
    )


def plain_sweeps(p0, p1, constants):
    """Least work by one unpruned sweep from every starting state, without bounds of any kind."""
    priced = tables(p0, p1, True, constants)
    least = np.inf
    for row in range(len(p1)):
        for step in (EAST, SOUTHEAST):
            search = starts.Graph(priced, closed=True)
            found = search.sweep(starts.Starts(0.0, row, row, (step,)), np.inf)
            if found is not None:
                assert found[2]
                least = min(least, found[0])
    return least


@pytest.mark.parametrize(
    ("p0", "p1"),
    [
        (regular_polygon(40), regular_polygon(40, turn=0.01)),
        (regular_polygon(40), regular_polygon(33)),
        (gear(12), gear(12, turn=0.1)),
        (gear(12), gear(9)),
        (gear(8), regular_polygon(30)),
        (star_polygon(np.random.default_rng(5), 45), star_polygon(np.random.default_rng(6), 38)),
        (random_polygon(np.random.default_rng(7), 25), random_polygon(np.random.default_rng(8), 31)),
    ],
    ids=[
        "circles",
        "circles of other counts",
        "gears",
        "other gears",
        "gear and circle",
        "stars",
        "scribbles",
    ],
)
def test_pruning_loses_nothing(p0, p1):
    constants = WorkConstants()
    found = least_work(p0, p1, True, constants)
    assert found.work == pytest.approx(plain_sweeps(p0, p1, constants), rel=1e-9, abs=1e-9)


def test_cost_to_go_is_the_cost_of_the_sweep(rng):
    priced = tables(star_polygon(rng, 12), star_polygon(rng, 10), True, WorkConstants())
    search = starts.Graph(priced, closed=True)
    bounds = search.bound_states()
    for row in range(10):
        for step in (EAST, SOUTHEAST):
            work, _, _ = starts.Graph(priced, closed=True).sweep(
                starts.Starts(0.0, row, row, (step,)), np.inf
            )
            assert bounds[row, step] <= work + 1e-9
    everywhere = starts.Starts(0.0, 0, 9, (EAST, SOUTHEAST))
    work, _, _ = starts.Graph(priced, closed=True).sweep(everywhere, np.inf)
    assert bounds[:, [EAST, SOUTHEAST]].min() == pytest.approx(work)


def test_a_path_prices_the_same_wherever_it_begins(rng):
    p0, p1 = star_polygon(rng, 9), star_polygon(rng, 7)
    found = least_work(p0, p1, True)
    turned = path_work(p0, p1, np.roll(found.dots, 4, axis=0), True, WorkConstants())
    assert turned.total == pytest.approx(found.work)


@pytest.mark.parametrize(
    "dots", [[[0, 0], [1, 0], [1, 1], [2, 2]], [[0, 0], [2, 1]], [[0, 0], [1, 1], [2, 2], [2, 2]]]
)
def test_a_path_with_a_turn_or_a_jump_is_refused(rng, dots):
    p0, p1 = star_polygon(rng, 3), star_polygon(rng, 3)
    with pytest.raises(ValueError, match="East, South or Southeast"):
        path_work(p0, p1, np.array(dots), True, WorkConstants())


def test_a_start_that_names_no_vertex_is_refused(rng):
    from shapeblend_cli.errors import MatchError

    p = star_polygon(rng, 5)
    with pytest.raises(MatchError, match="start 5,0 names no vertices; 0,0 to 4,4"):
        least_work(p, p, True, start=(5, 0))
    with pytest.raises(MatchError, match="open"):
        least_work(p, p, False, start=(0, 0))


def test_compiled_and_uncompiled_kernels_agree_to_the_bit(rng, load_uncompiled, monkeypatch):
    assert graph.COMPILED
    p0, p1 = gear(4), star_polygon(rng, 13)
    compiled = [least_work(p0, p1, closed) for closed in (True, False)]
    monkeypatch.setattr(starts, "graph", load_uncompiled("shapeblend_cli.match.graph"))
    uncompiled = [least_work(p0, p1, closed) for closed in (True, False)]
    for one, other in zip(compiled, uncompiled, strict=True):
        np.testing.assert_array_equal(one.dots, other.dots)
        assert (one.work, one.sweeps) == (other.work, other.sweeps)


def test_arguments_are_left_as_they_were(rng):
    p0, p1 = star_polygon(rng, 8), star_polygon(rng, 6)
    before = p0.copy(), p1.copy()
    least_work(p0, p1, True)
    np.testing.assert_array_equal(p0, before[0])
    np.testing.assert_array_equal(p1, before[1])
