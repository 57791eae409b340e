"""Section 4: the least path, against every path there is."""

import numpy as np
import pytest

from shapeblend_cli.constants import WorkConstants
from shapeblend_cli.errors import MatchError
from shapeblend_cli.matching import graph, sweeps
from shapeblend_cli.matching.graph import Graph, Starts
from shapeblend_cli.matching.steps import BEND_OF_STEPS, ENTERING, MOVES
from shapeblend_cli.matching.tables import Window
from shapeblend_cli.matching.work import Wires
from tests.support.oracle import SOUTH, Oracle, legal_turn, paths
from tests.support.shapes import gear, random_polygon, regular_polygon, star_polygon
from tests.support.solver import exhaustive, find_least


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


def random_problem(seed, smallest=3):
    """Two small polygons, constants, and the generator for more."""
    rng = np.random.default_rng(seed)
    m, n = rng.integers(smallest, 7, 2)
    make = random_polygon if seed % 2 else star_polygon
    return make(rng, m), make(rng, n), random_constants(rng), rng


def assert_bounds(found, least):
    """The bound of a restricted search holds for all paths, so there is a gap to dearer ones than the least."""
    assert 0.0 < found.lower_bound <= least.work * (1 + 1e-9)
    assert found.gap >= 1.0 - least.work * (1 + 1e-9) / found.work


@pytest.mark.parametrize("seed", range(300))
def test_closed_optimum_is_that_of_an_exhaustive_search(seed):
    p0, p1, constants, _ = random_problem(seed)
    found = find_least(p0, p1, True, constants)
    assert found.work == pytest.approx(exhaustive(p0, p1, True, constants), rel=1e-9, abs=1e-12)
    assert (found.lower_bound, found.gap) == (found.work, 0.0)


@pytest.mark.parametrize("seed", range(1000, 1040))
def test_optimum_from_a_given_start_is_that_of_an_exhaustive_search(seed):
    p0, p1, constants, rng = random_problem(seed)
    start = int(rng.integers(len(p0))), int(rng.integers(len(p1)))
    found = find_least(p0, p1, True, constants, start=start)
    assert_bounds(found, find_least(p0, p1, True, constants))
    assert found.dots[0].tolist() == list(start)
    assert found.work == pytest.approx(
        exhaustive(p0, p1, True, constants, starts=[start]), rel=1e-9, abs=1e-12
    )


@pytest.mark.parametrize("seed", range(2000, 2060))
def test_open_optimum_is_that_of_an_exhaustive_search(seed):
    p0, p1, constants, _ = random_problem(seed, smallest=2)
    found = find_least(p0, p1, False, constants)
    assert found.dots[0].tolist() == [0, 0]
    assert found.dots[-1].tolist() == [len(p0) - 1, len(p1) - 1]
    assert found.work == pytest.approx(exhaustive(p0, p1, False, constants), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("seed", range(4000, 4080))
def test_banded_optimum_is_that_of_an_exhaustive_search(seed):
    p0, p1, constants, rng = random_problem(seed)
    closed, band = bool(seed % 4), rng.choice([0.0, 0.1, 0.2, 0.35])
    best = exhaustive(p0, p1, closed, constants, band=band)
    if np.isinf(best):
        with pytest.raises(MatchError, match=r"within .* of the diagonal"):
            find_least(p0, p1, closed, constants, band=band)
        return
    found = find_least(p0, p1, closed, constants, band=band)
    assert_bounds(found, find_least(p0, p1, closed, constants))
    assert found.work == pytest.approx(best, rel=1e-9, abs=1e-12)
    assert found.diagonal_deviation <= band + 1e-9


@pytest.mark.parametrize("seed", range(5000, 5100))
def test_pinned_optimum_is_that_of_an_exhaustive_search(seed):
    p0, p1, constants, rng = random_problem(seed)
    m, n, closed = len(p0), len(p1), bool(seed % 3)
    pins = [(int(rng.integers(m)), int(rng.integers(n))) for _ in range(rng.integers(1, 4))]
    best = exhaustive(p0, p1, closed, constants, starts=[pins[0]] if closed else None, pins=pins)
    if np.isinf(best):
        with pytest.raises(MatchError, match=r"cross each other|no path goes through these pins"):
            find_least(p0, p1, closed, constants, pins=pins)
        return
    found = find_least(p0, p1, closed, constants, pins=pins)
    assert_bounds(found, find_least(p0, p1, closed, constants))
    assert set(pins) <= set(map(tuple, found.dots.tolist()))
    assert found.work == pytest.approx(best, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("seed", range(6000, 6040))
def test_stiff_optimum_is_that_of_an_exhaustive_search(seed):
    p0, p1, constants, rng = random_problem(seed)
    closed, weight = bool(seed % 3), rng.choice([0.2, 1.0, 5.0], len(p0))
    found = find_least(p0, p1, closed, constants, weight=weight)
    assert found.work == pytest.approx(exhaustive(p0, p1, closed, constants, weight), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("seed", range(7000, 7060))
def test_everything_at_once_is_that_of_an_exhaustive_search(seed):
    p0, p1, constants, rng = random_problem(seed)
    m, n = len(p0), len(p1)
    weight = rng.choice([0.5, 1.0, 3.0], m)
    start, pin = ((int(rng.integers(m)), int(rng.integers(n))) for _ in range(2))
    best = exhaustive(p0, p1, True, constants, weight, starts=[start], pins=[pin], band=0.6)
    if np.isinf(best):
        return
    found = find_least(p0, p1, True, constants, start=start, pins=[pin], band=0.6, weight=weight)
    assert_bounds(found, find_least(p0, p1, True, constants, weight))
    assert found.work == pytest.approx(best, rel=1e-9, abs=1e-12)


def test_stiffness_of_one_everywhere_changes_no_bit(rng):
    p0, p1 = star_polygon(rng, 30), star_polygon(rng, 25)
    plain, stiff = find_least(p0, p1), find_least(p0, p1, weight=np.ones(30))
    np.testing.assert_array_equal(plain.dots, stiff.dots)
    assert (plain.work, plain.stretching, plain.sweeps) == (stiff.work, stiff.stretching, stiff.sweeps)


def test_a_full_band_is_no_band(rng):
    p0, p1 = star_polygon(rng, 30), star_polygon(rng, 25)
    assert find_least(p0, p1, band=1.0).work == pytest.approx(find_least(p0, p1).work, rel=1e-12)


def test_pins_of_the_least_path_change_nothing(rng):
    p0, p1 = star_polygon(rng, 40), star_polygon(rng, 35)
    least = find_least(p0, p1)
    pins = [tuple(dot) for dot in least.dots[[3, 11, 30]].tolist()]
    assert find_least(p0, p1, pins=pins).work == pytest.approx(least.work, rel=1e-12)


def test_crossing_pins_are_named(rng):
    p = star_polygon(rng, 12)
    with pytest.raises(MatchError, match=r"pins 4,8 and 8,4 cross each other, going round from 0,0"):
        find_least(p, p, pins=[(0, 0), (4, 8), (8, 4)])
    with pytest.raises(MatchError, match=r"pins 3,6 and 5,2 cross each other; vertices"):
        find_least(p, p, False, pins=[(3, 6), (5, 2)])
    assert find_least(p, p, pins=[(4, 8), (8, 4)]).work > 0.0  # two alone never cross on closed outlines


@pytest.mark.parametrize("seed", range(8000, 8060))
def test_the_simplified_solver_is_never_below_the_exact_one(seed):
    p0, p1, constants, _ = random_problem(seed)
    for closed in (True, False):
        exact = find_least(p0, p1, closed, constants)
        simple = find_least(p0, p1, closed, constants, solver="simplified")
        assert simple.work >= exact.work * (1 - 1e-12)
        assert_bounds(simple, exact)


def test_the_simplified_solver_considers_every_start(rng):
    p0, p1 = random_polygon(rng, 12), random_polygon(rng, 10)
    best = find_least(p0, p1, solver="simplified").work
    for j in range(10):
        assert best <= find_least(p0, p1, start=(0, j), solver="simplified").work * (1 + 1e-12)


def simplified_by_the_book(p0, p1, constants):
    """Eqs (23)-(28) for open wires, as they stand, without 90-degree turns."""
    m, n = len(p0), len(p1)
    priced = Wires(p0, p1, False, constants).tables()
    bends, oracle = priced.bends.reshape(m, n, 7), Oracle(p0, p1, False, constants)
    work, came = {(0, 0): 0.0}, {(0, 0): None}
    for i in range(m):
        for j in range(n):
            if (i, j) == (0, 0):
                continue
            offers = []
            for step in MOVES:
                before = i - step[0], j - step[1]
                if before not in work:
                    continue
                bend = 0.0
                if came[before]:
                    kind = BEND_OF_STEPS[MOVES.index(came[before]), MOVES.index(step)]
                    bend = np.inf if kind < 0 else bends[(*before, kind)]
                offers.append((work[before] + bend + oracle.stretch(*before, step), step))
            work[i, j], came[i, j] = min(offers, key=lambda offer: offer[0])
    return work[m - 1, n - 1]


@pytest.mark.parametrize("seed", range(9000, 9030))
def test_the_simplified_solver_is_that_of_the_equations(seed):
    p0, p1, constants, _ = random_problem(seed)
    simple = find_least(p0, p1, False, constants, solver="simplified")
    assert simple.work == pytest.approx(simplified_by_the_book(p0, p1, constants), rel=1e-9)


@pytest.mark.parametrize("seed", range(25))
def test_work_is_the_sum_of_the_equations_along_the_dots(seed):
    rng = np.random.default_rng(3000 + seed)
    closed = bool(seed % 3)
    p0, p1 = star_polygon(rng, 6), random_polygon(rng, 5)
    constants, weight = random_constants(rng), rng.choice([0.5, 1.0, 2.0], 6)
    found = find_least(p0, p1, closed, constants, weight=weight)
    assert found.work == pytest.approx(
        Oracle(p0, p1, closed, constants, weight).price(found.dots), rel=5e-3, abs=5e-3
    )


@pytest.mark.parametrize("closed", [True, False])
def test_tables_made_block_by_block_change_nothing(rng, closed, monkeypatch):
    p0, p1 = star_polygon(rng, 23), star_polygon(rng, 31)
    pins = [(2, 5), (9, 20)]
    stored = [find_least(p0, p1, closed, **given) for given in ({}, {"pins": pins}, {"band": 0.3})]
    monkeypatch.setattr(graph, "STORED_DOTS", 0)
    monkeypatch.setattr(graph, "BLOCK_DOTS", 100)
    blocks = [find_least(p0, p1, closed, **given) for given in ({}, {"pins": pins}, {"band": 0.3})]
    for one, other in zip(stored, blocks, strict=True):
        np.testing.assert_array_equal(one.dots, other.dots)
        assert one.work == other.work


def plain_sweeps(p0, p1, constants):
    """Least work by one unpruned sweep from every starting state, without bounds of any kind."""
    wires, region = Wires(p0, p1, True, constants), Window.full(len(p0) + 1, 2 * len(p1))
    least = np.inf
    for row in range(len(p1)):
        for step in ENTERING:
            found = Graph(wires, region).sweep(Starts(0.0, row, row, (step,)), np.inf)
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
    found = find_least(p0, p1, True, constants)
    assert found.work == pytest.approx(plain_sweeps(p0, p1, constants), rel=1e-9, abs=1e-9)


def test_cost_to_go_is_the_cost_of_the_sweep(rng):
    wires = Wires(star_polygon(rng, 12), star_polygon(rng, 10), True, WorkConstants())
    region = Window.full(13, 20)
    bounds = Graph(wires, region).bound_starts()
    assert len(bounds) == 10
    for row in range(10):
        for step in ENTERING:
            work, _, _ = Graph(wires, region).sweep(Starts(0.0, row, row, (step,)), np.inf)
            assert bounds[row] <= work + 1e-9
    everywhere = Starts(0.0, 0, 9, ENTERING)
    work, _, _ = Graph(wires, region).sweep(everywhere, np.inf)
    assert bounds.min() == pytest.approx(work)


def test_a_path_prices_the_same_wherever_it_begins(rng):
    p0, p1 = star_polygon(rng, 9), star_polygon(rng, 7)
    found = find_least(p0, p1, True)
    turned = Wires(p0, p1, True, WorkConstants()).path_work(np.roll(found.dots, 4, axis=0))
    assert turned.total == pytest.approx(found.work)


@pytest.mark.parametrize(
    "dots", [[[0, 0], [1, 0], [1, 1], [2, 2]], [[0, 0], [2, 1]], [[0, 0], [1, 1], [2, 2], [2, 2]]]
)
def test_a_path_with_a_turn_or_a_jump_is_refused(rng, dots):
    p0, p1 = star_polygon(rng, 3), star_polygon(rng, 3)
    with pytest.raises(ValueError, match="East, South or Southeast"):
        Wires(p0, p1, True, WorkConstants()).path_work(np.array(dots))


def test_a_start_that_names_no_vertex_is_refused(rng):
    p = star_polygon(rng, 5)
    with pytest.raises(MatchError, match="5,0 names no vertices; 0,0 to 4,4"):
        find_least(p, p, True, start=(5, 0))


def test_compiled_and_uncompiled_kernels_agree_to_the_bit(rng, load_uncompiled, monkeypatch):
    assert sweeps.COMPILED
    p0, p1 = gear(4), star_polygon(rng, 13)
    compiled = [find_least(p0, p1, closed) for closed in (True, False)]
    monkeypatch.setattr(graph, "sweeps", load_uncompiled("shapeblend_cli.matching.sweeps"))
    uncompiled = [find_least(p0, p1, closed) for closed in (True, False)]
    for one, other in zip(compiled, uncompiled, strict=True):
        np.testing.assert_array_equal(one.dots, other.dots)
        assert (one.work, one.sweeps) == (other.work, other.sweeps)


def test_arguments_are_left_as_they_were(rng):
    p0, p1 = star_polygon(rng, 8), star_polygon(rng, 6)
    before = p0.copy(), p1.copy()
    find_least(p0, p1, True)
    np.testing.assert_array_equal(p0, before[0])
    np.testing.assert_array_equal(p1, before[1])


@pytest.mark.parametrize("seed", range(20))
def test_starts_may_be_limited(seed):
    rng = np.random.default_rng(seed)
    m, n = (int(k) for k in rng.integers(3, 5, 2))
    p0, p1 = star_polygon(rng, m), star_polygon(rng, n)
    vertex, first = int(rng.integers(m)), int(rng.integers(n))
    last = first + int(rng.integers(n))
    wires = Wires(p0, p1, True, WorkConstants())
    least = np.inf
    for path in paths(m + 1, n + 1):
        steps = np.diff(path, axis=0)
        down = int((np.array(path)[:, 0] == 0).sum()) - 1  # rows it goes South at once
        if tuple(steps[-1]) == SOUTH or not legal_turn(tuple(steps[-1]), tuple(steps[0])):
            continue
        for row in range(first, last + 1 - down):
            dots = (np.array(path[:-1]) + (vertex, row)) % (m, n)
            least = min(least, wires.path_work(dots).total)
    assert find_least(p0, p1, starts=(vertex, first, last)).work == pytest.approx(least, rel=1e-9)


@pytest.mark.parametrize("closed", [True, False])
def test_where_a_bound_would_take_long_there_is_none(rng, closed, monkeypatch):
    p0, p1 = star_polygon(rng, 12), star_polygon(rng, 13)
    monkeypatch.setattr(graph, "BOUND_DOTS", 0)
    assert find_least(p0, p1, closed).gap == 0.0
    pinned = find_least(p0, p1, closed, pins=[(2, 3), (5, 6), (8, 9)])
    assert (pinned.lower_bound, pinned.gap) == (0.0, 1.0)


def test_large_problems_keep_to_their_starts():
    p0 = gear(30)
    p1 = np.roll(gear(30), 7)
    step = len(p1) // 30
    anywhere = find_least(p0, p1, effort="fast")
    found = find_least(p0, p1, starts=(0, 4 * step - 2, 4 * step + 2), effort="fast")
    assert found.work == pytest.approx(anywhere.work, abs=1e-6)
    goes = int(found.dots[found.dots[:, 0] == 0][0, 1])
    assert abs(goes - 4 * step) <= step
