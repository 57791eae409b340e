"""Coarse to fine: legal paths, near the exact answer where that is known, in bounded time and memory."""

import numpy as np
import pytest

from shapeblend_cli.errors import MatchError
from shapeblend_cli.matching import coarse, graph, solve
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.options.constants import WorkConstants
from tests.support.shapes import gear, random_polygon, star_polygon, wavy
from tests.support.solver import find_least


@pytest.fixture
def small(monkeypatch):
    """Everything above 30 by 30 vertices goes from coarse to fine, in narrow corridors."""
    monkeypatch.setitem(solve.EXACT_DOTS, "fast", 900)
    monkeypatch.setattr(coarse, "COARSEST_DOTS", 900)
    monkeypatch.setattr(coarse, "PADS", (6,))
    monkeypatch.setattr(coarse, "LEAST_VERTICES", 12)
    monkeypatch.setattr(coarse, "CORRIDOR_DOTS", 5000)


CASES = {
    "closed": {},
    "start": {"start": (7, 30)},
    "pins": {"pins": [(5, 9), (60, 70), (100, 115)]},
    "band": {"band": 0.3},
    "stiff": {"weight": np.linspace(0.5, 2.0, 150)},
    "simplified": {"solver": "simplified"},
    "open": {"closed": False},
    "open with a pin": {"closed": False, "pins": [(70, 80)]},
}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("seed", range(4))
def test_paths_are_legal_and_not_below_the_least(small, case, seed):
    p0, p1, given = wavy(150, seed), wavy(170, seed + 50), CASES[case]
    found = find_least(p0, p1, effort="fast", **given)
    exact = find_least(p0, p1, effort="exact", **{**given, "solver": "exact"})
    wires = Wires(p0, p1, given.get("closed", True), WorkConstants(), given.get("weight"))
    assert wires.path_work(found.dots).total == pytest.approx(found.work)
    assert exact.work * (1 - 1e-9) <= found.work <= 2.0 * exact.work
    assert (found.lower_bound, found.gap) == (0.0, 1.0)
    least = find_least(p0, p1, wires.closed, weight=given.get("weight"), effort="exact").work
    restricted = set(given) & {"start", "pins", "band"}
    assert 0.5 * least <= exact.lower_bound <= least * (1 + 1e-9) if restricted else exact.gap == 0.0
    assert set(given.get("pins", [])) <= set(map(tuple, found.dots.tolist()))
    if "start" in given:
        assert tuple(found.dots[0].tolist()) == given["start"]
    if "band" in given:
        assert found.diagonal_deviation <= given["band"] + 1e-9


def test_the_simplified_solver_goes_coarse_where_tables_would_not_fit(small, monkeypatch):
    monkeypatch.setattr(graph, "STORED_DOTS", 900)
    monkeypatch.setattr(coarse, "CORRIDOR_DOTS", 500)
    p0, p1 = wavy(60, 1), wavy(50, 2)
    exact = find_least(p0, p1, effort="exact")
    assert (exact.lower_bound, exact.gap) == (exact.work, 0.0)  # block by block
    assert find_least(p0, p1, start=(0, 0), effort="exact").lower_bound == 0.0  # nothing cheap is known
    monkeypatch.setattr(graph, "STORED_DOTS", 2500)
    assert find_least(p0, p1, solver="simplified", effort="exact").work >= exact.work * (1 - 1e-9)


def test_smooth_outlines_come_out_exact(small):
    for seed in range(6):
        p0, p1 = wavy(300, seed), wavy(280, seed + 20)
        assert find_least(p0, p1, effort="fast").work == pytest.approx(
            find_least(p0, p1, effort="exact").work, rel=0.01
        )


def test_a_short_outline_and_a_very_long_one():
    p0, p1 = star_polygon(np.random.default_rng(1), 9), wavy(1200, 2)
    least = find_least(p0, p1, effort="exact")
    path, lower_bound = coarse.solve(coarse.Problem(Wires(p0, p1)), None, 100)
    assert lower_bound == 0.0
    assert least.work <= path.work * (1 + 1e-9)


@pytest.mark.parametrize(
    "shape", [gear(24), star_polygon(np.random.default_rng(3), 200)], ids=["gear", "star"]
)
def test_a_shape_and_itself_cost_nothing(small, shape):
    assert find_least(shape, np.roll(shape, 33), effort="fast").work < 1e-9


def test_a_band_that_no_path_fits_into_is_an_error_here_too(small):
    with pytest.raises(MatchError, match=r"within 0 of the diagonal"):
        find_least(wavy(150, 1), wavy(171, 2), effort="fast", band=0.0)


def test_thinning_keeps_corners_ends_and_what_it_is_told_to_keep(small):
    square = np.concatenate(
        [np.linspace(a, b, 20, endpoint=False) for a, b in ((0, 1), (1, 1 + 1j), (1 + 1j, 1j), (1j, 0))]
    )
    kept = coarse.thin(square, True, {33})
    assert {0, 20, 40, 60, 33} <= set(kept.tolist())
    assert len(kept) < 40
    assert (np.diff(kept) > 0).all()
    assert coarse.thin(square, False, set())[-1] == 79


def test_large_outlines_take_bounded_memory():
    import tracemalloc

    p0, p1 = wavy(4000, 1), wavy(4000, 2)
    tracemalloc.start()
    found = find_least(p0, p1)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert found.lower_bound == 0.0
    assert peak < 250e6  # all tables at once would take a gigabyte


@pytest.mark.parametrize("closed", [True, False])
def test_near_the_least_path_the_least_is_found_and_elsewhere_no_less(rng, closed):
    p0, p1 = wavy(90, 3), wavy(80, 4)
    least = find_least(p0, p1, closed)
    near = np.zeros(90, int)
    near[least.dots[::-1, 0]] = least.dots[::-1, 1]
    found = find_least(p0, p1, closed, near=near)
    assert found.work == pytest.approx(least.work, rel=1e-12)
    assert (found.lower_bound, found.gap) == (0.0, 1.0)  # nothing is known of the rest
    elsewhere = (near + 40) % 80 if closed else np.minimum(near + 40, 79)
    assert find_least(p0, p1, closed, near=elsewhere).work >= least.work * (1 - 1e-12)


def test_where_no_path_is_near_what_is_required_all_are_searched():
    p0, p1 = wavy(90, 3), wavy(80, 4)
    required = {"start": (0, 0), "pins": [(30, 70)]}
    near = (np.arange(90) * 80 // 90 + 40) % 80
    found = find_least(p0, p1, near=near, **required)
    assert {(0, 0), (30, 70)} <= set(map(tuple, found.dots.tolist()))
    assert found.work >= find_least(p0, p1, **required).work * (1 - 1e-12)


@pytest.mark.parametrize("share", [1.0, 1.01, 2.0])
def test_knowing_the_work_of_a_path_changes_nothing_but_the_time(rng, share):
    p0, p1 = wavy(90, 3), star_polygon(rng, 40)
    least = find_least(p0, p1)
    found = find_least(p0, p1, known=share * least.work)
    assert np.array_equal(found.dots, least.dots)
    assert (found.work, found.lower_bound) == (least.work, least.lower_bound)


def test_what_no_path_takes_is_not_taken_for_known():
    p0, p1 = wavy(90, 3), wavy(80, 4)
    least = find_least(p0, p1)
    assert np.array_equal(find_least(p0, p1, known=0.5 * least.work).dots, least.dots)


def test_a_search_that_ends_early_says_how_far_it_can_be_from_the_least(rng, monkeypatch):
    polygons = [star_polygon(rng, 40) for _ in range(2)]
    least = find_least(*polygons)
    monkeypatch.setitem(solve.MOST_SWEPT, "auto", 2 * 80 * 41)
    early = find_least(*polygons)
    assert early.lower_bound < least.work <= early.work
    assert least.lower_bound == least.work
    assert find_least(*polygons, effort="exact").work == least.work


def test_some_path_is_found_however_little_may_be_searched(rng):
    wires = Wires(random_polygon(rng, 40), random_polygon(rng, 50))
    least, _ = coarse.solve(coarse.Problem(wires), None, 1e9)
    some, lower_bound = coarse.solve(coarse.Problem(wires, most_swept=1.0), None, 1e9)
    assert lower_bound <= least.work <= some.work < np.inf
    assert not some.is_least
