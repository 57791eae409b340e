"""Every mixture of options on every kind of polygon: legal paths that keep what was asked, or one clear error."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from shapeblend_cli.errors import MatchError
from shapeblend_cli.matching import coarse, graph, solve
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.options.constants import WorkConstants
from tests.support.shapes import gear, random_polygon, regular_polygon, star_polygon
from tests.support.solver import find_least

dots = st.tuples(st.integers(0, 200), st.integers(0, 200))
polygons = st.builds(
    lambda seed, m, kind: {
        "random": lambda: random_polygon(np.random.default_rng(seed), m),
        "star": lambda: star_polygon(np.random.default_rng(seed), m),
        "gear": lambda: gear(m // 4 + 2),
        "circle": lambda: regular_polygon(m),
    }[kind](),
    st.integers(0, 10**6),
    st.integers(3, 50),
    st.sampled_from(["random", "star", "star", "gear", "circle"]),
)
constants = st.builds(
    WorkConstants,
    k_s=st.sampled_from([0.0, 0.5, 1.0]),
    k_b=st.sampled_from([0.0, 0.5, 1.0]),
    e_s=st.sampled_from([1.0, 2.0]),
    e_b=st.sampled_from([0.3, 1.0, 2.0]),
    p_b=st.sampled_from([0.0, 1000.0]),
    m_b=st.sampled_from([0.0, 10.0]),
    c_s=st.sampled_from([0.1, 0.5, 1.0]),
)


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    p0=polygons,
    p1=polygons,
    closed=st.booleans(),
    constants=constants,
    start=st.none() | dots,
    pins=st.lists(dots, max_size=3),
    band=st.none() | st.sampled_from([0.0, 0.1, 0.3, 1.0]),
    stiff=st.booleans(),
    solver=st.sampled_from(["exact", "exact", "simplified"]),
    mode=st.sampled_from(["stored", "blocks", "coarse"]),
)
def test_any_problem(monkeypatch, p0, p1, closed, constants, start, pins, band, stiff, solver, mode):
    m, n = len(p0), len(p1)
    start = start and (start[0] % m, start[1] % n)
    pins = [(i % m, j % n) for i, j in pins]
    weight = np.linspace(0.2, 3.0, m) if stiff else None
    asked = {"start": start, "pins": pins, "band": band, "weight": weight}

    with monkeypatch.context() as limits:  # sizes that make small problems take the ways of large ones
        if mode == "blocks" and solver == "exact":
            limits.setattr(graph, "STORED_DOTS", 0)
            limits.setattr(graph, "BLOCK_DOTS", 90)
        if mode == "coarse":
            limits.setitem(solve.EXACT_DOTS, "fast", 60)
            limits.setattr(coarse, "COARSEST_DOTS", 60)
            limits.setattr(coarse, "LEAST_VERTICES", 5)
            limits.setattr(coarse, "PADS", (2, 4))
            limits.setattr(coarse, "CORRIDOR_DOTS", 100)
            limits.setattr(coarse, "CORRIDOR_ROWS", 1)
        effort = "fast" if mode == "coarse" else "exact"
        try:
            found = find_least(p0, p1, closed, constants, solver=solver, effort=effort, **asked)
        except MatchError:
            found = None
    if found is None:
        assert pins or start or band is not None
        return

    assert set(found.dots[:, 0].tolist()) == set(range(m))
    assert set(found.dots[:, 1].tolist()) == set(range(n))
    assert max(m, n) <= len(found.dots) <= m + n
    assert {*pins, *([start] if start else [])} <= set(map(tuple, found.dots.tolist()))
    priced = Wires(p0, p1, closed, constants, weight).path_work(found.dots)
    assert priced.total == pytest.approx(found.work)
    if band is not None and (start or not pins):
        assert found.diagonal_deviation <= band + 1e-6
    least = find_least(p0, p1, closed, constants, effort="exact", **asked)
    assert least.work <= found.work * (1 + 1e-9) + 1e-12
    if mode != "coarse" and solver == "exact":
        assert least.work == pytest.approx(found.work, rel=1e-9, abs=1e-12)
