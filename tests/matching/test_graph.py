"""Section 4: the least path, against every path there is."""

import numpy as np
import pytest

from shapeblend_cli.errors import MatchError
from shapeblend_cli.matching import graph, sweeps
from shapeblend_cli.matching.graph import Graph, Starts
from shapeblend_cli.matching.landscape import landscape
from shapeblend_cli.matching.steps import BEND_OF_STEPS, ENTERING, MOVES
from shapeblend_cli.matching.tables import Window
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.options.constants import WorkConstants
from tests.support.oracle import Oracle
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
        bending=rng.choice(["turn", "paper"]),
        k_t=rng.choice([0.0, 5.0, 50.0]),
        smoothing=rng.choice([0.0, 0.005, 0.03]),
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


SEEDS = {
    "anywhere": range(30),
    "start": range(1000, 1005),
    "open": range(2000, 2006),
    "band": range(4000, 4012),
    "pins": range(5000, 5012),
    "stiff": range(6000, 6006),
    "all": range(7000, 7008),
}
OPEN_EVERY = {"open": 1, "band": 4, "pins": 3, "stiff": 3}
REFUSED = {
    "band": r"within .* of the diagonal",
    "pins": r"cross each other|no path goes through these pins",
    "all": r"within .* of the diagonal|cross each other",
}


def restrictions(kind, rng, m, n):
    """What a search is given, and the stiffness."""

    def dot():
        return int(rng.integers(m)), int(rng.integers(n))

    if kind == "start":
        return {"start": dot()}, None
    if kind == "band":
        return {"band": rng.choice([0.0, 0.1, 0.2, 0.35])}, None
    if kind == "pins":
        return {"pins": [dot() for _ in range(rng.integers(1, 4))]}, None
    if kind == "stiff":
        return {}, rng.choice([0.2, 1.0, 5.0], m)
    if kind == "all":
        weight = rng.choice([0.5, 1.0, 3.0], m)
        return {"start": dot(), "pins": [dot()], "band": 0.6}, weight
    return {}, None


@pytest.mark.parametrize(("kind", "seed"), [(kind, seed) for kind in SEEDS for seed in SEEDS[kind]])
def test_the_optimum_is_that_of_an_exhaustive_search(kind, seed):
    p0, p1, constants, rng = random_problem(seed, smallest=2 if kind == "open" else 3)
    closed = kind not in OPEN_EVERY or seed % OPEN_EVERY[kind] > 0
    given, weight = restrictions(kind, rng, len(p0), len(p1))
    problem = p0, p1, closed, constants, weight
    band, pins = given.get("band"), [*filter(None, [given.get("start")]), *given.get("pins", [])]
    best = exhaustive(*problem, starts=pins[:1] if closed and pins else None, pins=pins, band=band)
    if np.isinf(best):
        with pytest.raises(MatchError, match=REFUSED[kind]):
            find_least(*problem, **given)
        return
    found = find_least(*problem, **given)
    assert found.work == pytest.approx(best, rel=1e-9, abs=1e-12)
    if given:
        assert_bounds(found, find_least(*problem))
    else:
        assert (found.lower_bound, found.gap) == (found.work, 0.0)
    assert set(pins) <= set(map(tuple, found.dots.tolist()))
    assert band is None or found.diagonal_deviation <= band + 1e-9
    if "start" in given:
        assert found.dots[0].tolist() == list(given["start"])
    if not closed:
        assert found.dots[[0, -1]].tolist() == [[0, 0], [len(p0) - 1, len(p1) - 1]]


@pytest.mark.parametrize("kind", ["a full band", "pins on the path", "a stiffness of 1"])
def test_what_restricts_nothing_changes_nothing(rng, kind):
    p0, p1 = star_polygon(rng, 40), star_polygon(rng, 35)
    least = find_least(p0, p1)
    pins = [tuple(dot) for dot in least.dots[[3, 11, 30]].tolist()]
    given = {"a full band": {"band": 1.0}, "pins on the path": {"pins": pins}}.get(
        kind, {"weight": np.ones(40)}
    )
    found = find_least(p0, p1, **given)
    assert found.work == pytest.approx(least.work, rel=1e-12)
    if "weight" in given:
        np.testing.assert_array_equal(found.dots, least.dots)
        assert (found.work, found.stretching, found.sweeps) == (least.work, least.stretching, least.sweeps)


def test_crossing_pins_are_named(rng):
    p = star_polygon(rng, 12)
    with pytest.raises(MatchError, match=r"pins 4,8 and 8,4 cross each other, going round from 0,0"):
        find_least(p, p, pins=[(0, 0), (4, 8), (8, 4)])
    with pytest.raises(MatchError, match=r"pins 3,6 and 5,2 cross each other; vertices"):
        find_least(p, p, False, pins=[(3, 6), (5, 2)])
    assert find_least(p, p, pins=[(4, 8), (8, 4)]).work > 0.0  # two alone never cross on closed outlines


@pytest.mark.parametrize("seed", range(8000, 8008))
def test_the_simplified_solver_is_never_below_the_exact_one(seed):
    p0, p1, constants, _ = random_problem(seed)
    for closed in (True, False):
        exact = find_least(p0, p1, closed, constants)
        simple = find_least(p0, p1, closed, constants, solver="simplified")
        assert simple.work >= exact.work * (1 - 1e-12)
        assert_bounds(simple, exact)


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


@pytest.mark.parametrize("seed", range(9000, 9006))
def test_the_simplified_solver_is_that_of_the_equations(seed):
    p0, p1, constants, _ = random_problem(seed)
    simple = find_least(p0, p1, False, constants, solver="simplified")
    assert simple.work == pytest.approx(simplified_by_the_book(p0, p1, constants), rel=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_work_is_the_sum_of_the_equations_along_the_dots(seed):
    rng = np.random.default_rng(3000 + seed)
    closed = bool(seed % 3)
    p0, p1 = star_polygon(rng, 6), random_polygon(rng, 5)
    constants, weight = random_constants(rng), rng.choice([0.5, 1.0, 2.0], 6)
    found = find_least(p0, p1, closed, constants, weight=weight)
    assert found.work == pytest.approx(
        Oracle(p0, p1, closed, constants, weight).price(found.dots), rel=5e-3, abs=5e-3
    )


def plain_sweeps(p0, p1):
    """Least work by one unpruned sweep from every starting state, without bounds of any kind."""
    wires, region = Wires(p0, p1), Window.full(len(p0) + 1, 2 * len(p1))
    least = np.inf
    for row in range(len(p1)):
        for step in ENTERING:
            found = Graph(wires, region).sweep(Starts(0.0, row, row, (step,)))
            if found is not None:
                assert found[2]
                least = min(least, found[0])
    return least


SHAPES = {
    "circles": (regular_polygon(40), regular_polygon(40, turn=0.01)),
    "circles of other counts": (regular_polygon(40), regular_polygon(33)),
    "gears": (gear(12), gear(12, turn=0.1)),
    "other gears": (gear(12), gear(9)),
    "gear and circle": (gear(8), regular_polygon(30)),
    "stars": (star_polygon(np.random.default_rng(5), 45), star_polygon(np.random.default_rng(6), 38)),
    "scribbles": (random_polygon(np.random.default_rng(7), 25), random_polygon(np.random.default_rng(8), 31)),
}


@pytest.mark.parametrize("shapes", SHAPES)
def test_pruning_loses_nothing(shapes):
    p0, p1 = SHAPES[shapes]
    assert find_least(p0, p1).work == pytest.approx(plain_sweeps(p0, p1), rel=1e-9, abs=1e-9)


def test_bounds_are_those_of_the_sweep(rng):
    p0, p1 = star_polygon(rng, 12), star_polygon(rng, 10)
    wires, region = Wires(p0, p1), Window.full(13, 20)
    bounds = Graph(wires, region).bound_starts()
    assert len(bounds) == 10
    for row in range(10):
        for step in ENTERING:
            work, *_ = Graph(wires, region).sweep(Starts(0.0, row, row, (step,)))
            assert bounds[row] <= work + 1e-9
    work, *_ = Graph(wires, region).sweep(Starts(0.0, 0, 9, ENTERING))
    assert bounds.min() == pytest.approx(work)
    assert Graph(wires, region).lower_bound() == bounds.min()
    open_graph = Graph(Wires(p0, p1, False), Window.full(12, 10))
    assert open_graph.lower_bound() == pytest.approx(find_least(p0, p1, False).work, rel=1e-12)


@pytest.mark.parametrize(
    "dots", [[[0, 0], [1, 0], [1, 1], [2, 2]], [[0, 0], [2, 1]], [[0, 0], [1, 1], [2, 2], [2, 2]]]
)
def test_a_path_with_a_turn_or_a_jump_is_refused(rng, dots):
    p0, p1 = star_polygon(rng, 3), star_polygon(rng, 3)
    with pytest.raises(ValueError, match="East, South or Southeast"):
        Wires(p0, p1).path_work(np.array(dots))


def test_a_start_that_names_no_vertex_is_refused(rng):
    p = star_polygon(rng, 5)
    with pytest.raises(MatchError, match="5,0 names no vertices; 0,0 to 4,4"):
        find_least(p, p, True, start=(5, 0))


def test_compiled_and_uncompiled_kernels_agree_to_the_bit(rng, load_uncompiled, monkeypatch):
    assert sweeps.COMPILED
    p0, p1 = gear(4), star_polygon(rng, 13)
    searches = [
        (closed, given)
        for closed in (True, False)
        for given in ({}, {"pins": [(2, 3)]}, {"solver": "simplified"}, {"band": 0.6})
    ]

    def solve_all():
        found = [find_least(p0, p1, closed, **given) for closed, given in searches]
        lands = [landscape(Wires(p0, p1, one.closed), one.dots) for one in found]
        numbers = [(one.work, one.lower_bound, one.sweeps) for one in found]
        return [*(one.dots for one in found), numbers, *(array for land in lands for array in land)]

    compiled = solve_all()
    uncompiled = load_uncompiled("shapeblend_cli.matching.sweeps")
    monkeypatch.setattr(graph, "sweeps", uncompiled)
    monkeypatch.setattr("shapeblend_cli.matching.landscape.cost_to_go", uncompiled.cost_to_go)
    for one, other in zip(compiled, solve_all(), strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("closed", [True, False])
def test_where_a_bound_would_take_long_there_is_none(rng, closed, monkeypatch):
    p0, p1 = star_polygon(rng, 12), star_polygon(rng, 13)
    monkeypatch.setattr(graph, "BOUND_DOTS", 0)
    assert find_least(p0, p1, closed).gap == 0.0
    pinned = find_least(p0, p1, closed, pins=[(2, 3), (5, 6), (8, 9)])
    assert (pinned.lower_bound, pinned.gap) == (0.0, 1.0)


@pytest.mark.parametrize("bending", ["turn", "paper"])
def test_bending_without_end_still_has_its_zero_angles_counted(bending):
    square, bow = np.array([0, 1, 1 + 1j, 1j]), np.array([0, 1, 1j, 1 + 1j])
    dots = np.arange(4)[:, None].repeat(2, axis=1)
    wires = Wires(square, bow, True, WorkConstants(e_b=1e4, bending=bending))
    assert wires.path_work(dots).bending == np.inf
    assert 0 <= wires.zero_angles(dots) <= 4
