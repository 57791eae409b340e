"""Section 2: how an angle moves, against theta(t) sampled densely."""

import itertools
import sys

import hypothesis
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.matching import angles, work
from shapeblend_cli.matching.steps import BEND_OF_STEPS, MOVES, NO_BEND
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.options.constants import PAPER, WorkConstants
from tests.support import oracle
from tests.support.angles import angle_change_along
from tests.support.shapes import random_polygon
from tests.support.strategies import rngs

edge = st.builds(
    lambda r, a: r * np.exp(1j * a), st.floats(0.05, 1.0), st.floats(0.0, 2.0 * np.pi, exclude_max=True)
)


def control_points(back0, fwd0, back1, fwd1):
    """Eqs (7) and (8), written out in coordinates."""

    def dot(f, b):
        return f.real * b.real + f.imag * b.imag

    def cross(f, b):
        return f.real * b.imag - f.imag * b.real

    return (
        complex(dot(fwd0, back0), cross(fwd0, back0)),
        complex((dot(fwd1, back0) + dot(fwd0, back1)) / 2.0, (cross(fwd1, back0) + cross(fwd0, back1)) / 2.0),
        complex(dot(fwd1, back1), cross(fwd1, back1)),
    )


@given(edge, edge, edge, edge)
def test_motion_agrees_with_sampling(back0, fwd0, back1, fwd1):
    t = np.linspace(0.0, 1.0, 40001)
    size = np.abs((1 - t) * fwd0 + t * fwd1) * np.abs((1 - t) * back0 + t * back1)
    if size.min() < 1e-3:
        return  # an edge shrinks through nothing: sampling cannot tell which way round
    theta = oracle.theta_along(back0, fwd0, back1, fwd1, samples=20001)
    if min(theta.min(), 2.0 * np.pi - theta.max()) ** 2 < 1e-6:
        return  # touches zero: samples cannot tell either
    delta, star, zero = angle_change_along(*control_points(back0, fwd0, back1, fwd1))
    expected = oracle.motion(theta)
    assert delta == pytest.approx(expected[0], abs=1e-3)
    assert star == pytest.approx(expected[1], abs=1e-3)
    assert zero == expected[2]


def at(degrees, size=1.0):
    return size * np.exp(1j * np.radians(degrees))


@pytest.mark.parametrize(
    ("controls", "degrees", "reaches_zero"),
    [
        # Figure 17: the triangle Q0 Q1 Q2 contains the origin and d has no root.
        ((at(100.0), -3.0, at(260.0)), 160.0, False),
        ((at(100.0), 0.1, at(260.0)), 160.0, None),
        ((at(40.0), at(180.0), at(320.0)), 280.0, False),
        # The same ends the other way: 40 degrees down through zero to 320.
        ((at(40.0), 1.0 + 0j, at(320.0)), 80.0, True),
        # A polygon against itself turned by 180 degrees: Q(t) = Q0 (1 - 2 t)^2.
        ((np.exp(2j), -np.exp(2j), np.exp(2j)), 0.0, False),
    ],
    ids=["beyond 180", "back through the middle", "far beyond", "through zero", "right round"],
)
def test_an_angle_moves_one_way(controls, degrees, reaches_zero):
    delta, star, zero = angle_change_along(*controls)
    assert np.degrees(delta) == pytest.approx(degrees, abs=5e-11)
    if reaches_zero is not None:
        assert (star, zero) == (pytest.approx(0.0, abs=1e-12), reaches_zero)


def test_deviation_of_figure_18():
    # (a) out and back past the start: one deviation.
    q0, q1, q2 = at(90.0), at(170.0, 2.0), at(120.0)
    delta, star, _ = angle_change_along(q0, q1, q2)
    assert np.degrees(delta) == pytest.approx(30.0)
    theta = np.unwrap(
        np.angle([(1 - t) ** 2 * q0 + 2 * t * (1 - t) * q1 + t * t * q2 for t in np.linspace(0, 1, 9999)])
    )
    assert star == pytest.approx(theta.max() - np.radians(120.0), abs=1e-6)


BENDINGS = {
    "paper": PAPER,
    "paper, other constants": {**PAPER, "k_b": 0.7, "m_b": 3.0, "e_b": 2.0, "p_b": 50.0},
    "turn": {"k_t": 0.0, "smoothing": 0.0},
    "turn, other constants": {"k_t": 0.0, "smoothing": 0.0, "k_b": 0.7, "e_b": 0.5, "p_b": 50.0},
    "turn, no price of zero": {"k_t": 0.0, "smoothing": 0.0, "p_b": 0.0},
    "smoothed": {"k_t": 0.0, "smoothing": 0.01},
    "paper, smoothed": {"bending": "paper", "k_t": 0.0, "smoothing": 0.01, "m_b": 2.0},
    "travel": {"k_b": 0.0, "p_b": 0.0, "k_t": 40.0},
    "all": {"k_b": 0.7, "e_b": 2.0, "p_b": 3.0},
}
either_bending = pytest.mark.parametrize(
    "constants", [WorkConstants(**c) for c in BENDINGS.values()], ids=BENDINGS
)


def all_bends(p0, p1, closed, constants, weight=None):
    """The seven bends of every pair of corners, (m, n, 7)."""
    return Wires(p0, p1, closed, constants, weight).tables().bends.reshape(len(p0), len(p1), 7)


@either_bending
@pytest.mark.parametrize("closed", [True, False])
def test_every_bend_of_a_graph_agrees_with_the_oracle(rng, closed, constants):
    for m, n in ((3, 4), (5, 3), (6, 6)):
        p0, p1, weight = random_polygon(rng, m), random_polygon(rng, n), rng.choice([0.5, 1.0, 2.0], m)
        bends = all_bends(p0, p1, closed, constants, weight)
        expected = oracle.Oracle(p0, p1, closed, constants, weight)
        for (step_in, step_out), kind in np.ndenumerate(BEND_OF_STEPS):
            if kind == NO_BEND:
                continue
            moves_in, moves_out = MOVES[step_in], MOVES[step_out]
            # No step leads over the end of an open wire.
            columns, rows = (
                range(k) if closed else range(move_in, k - move_out)
                for k, move_in, move_out in zip((m, n), moves_in, moves_out, strict=True)
            )
            for i, j in itertools.product(columns, rows):
                if not closed and (i, j) in ((0, 0), (m - 1, n - 1)):
                    continue  # where a path of open wires starts and ends, it has no angle
                work = expected.bend(i, j, moves_in, moves_out)
                assert bends[i, j, kind] == pytest.approx(work, rel=2e-3, abs=2e-3)


@given(rngs, st.integers(3, 9), st.integers(3, 9), st.booleans())
def test_what_is_outside_the_paper_is_what_its_formulas_say(rng, m, n, closed):
    """Changes of turn, without an angle being followed; travel, dot by dot."""
    p, q = random_polygon(rng, m), random_polygon(rng, n)
    turn0, turn1 = (np.asarray(angles.Corners(z, closed).turn)[:, None, None] for z in (p, q))
    turn1 = turn1.transpose(1, 0, 2)
    changes = [
        turn0,
        turn0 - turn1 / 2,
        turn0 - turn1 / 2,
        turn1,
        turn1 - turn0 / 2,
        turn1 - turn0 / 2,
        turn0 - turn1,
    ]
    expected = np.concatenate([abs(change) + np.zeros((m, n, 1)) for change in changes], axis=2)
    if not closed:
        expected[0, 0] = expected[-1, -1] = 0.0
    found = all_bends(p, q, closed, WorkConstants(p_b=0.0, k_t=0.0, smoothing=0.0))
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)


grid_points = st.builds(complex, st.integers(0, 3), st.integers(0, 3))


@st.composite
def grid_polygons(draw):
    """Polygons of whole numbers: spikes, right angles, half turns, opposite edges, all of them exactly."""
    z = draw(st.lists(grid_points, min_size=3, max_size=7))
    hypothesis.assume(all(a != b for a, b in zip(z, z[1:] + z[:1], strict=True)))
    return np.array(z)


@hypothesis.settings(max_examples=60)
@given(grid_polygons() | st.builds(random_polygon, rngs, st.integers(3, 9)), grid_polygons(), st.booleans())
def test_by_turning_an_angle_of_zero_is_what_it_is_along_straight_paths_to_the_bit(p, q, closed):
    for one, other in ((p, q), (q, p)):
        paper = all_bends(one, other, closed, WorkConstants(**PAPER, k_b=0.0, p_b=0.7))
        turn = all_bends(one, other, closed, WorkConstants(k_b=0.0, p_b=0.7, k_t=0.0, smoothing=0.0))
        np.testing.assert_array_equal(turn, paper)


@either_bending
def test_compiled_and_uncompiled_kernels_agree_to_the_bit(rng, load_uncompiled, monkeypatch, constants):
    kernels = {
        "angles": ["Corners", "Bending", "fill_bends"],
        "travel": ["Stations", "add_travel"],
    }
    monkeypatch.setattr(work, "FEW", 0)  # no angles are kept for the other kernels
    p, q, weight = random_polygon(rng, 12), random_polygon(rng, 7), rng.choice([0.5, 1.0, 2.0], 12)
    compiled = [all_bends(p, q, closed, constants, weight) for closed in (True, False)]
    for kernel, names in kernels.items():
        source = load_uncompiled(f"shapeblend_cli.matching.{kernel}")
        assert source.__file__.endswith(".py")
        for name in names:
            assert not sys.modules[getattr(work, name).__module__].__file__.endswith(".py")
            monkeypatch.setattr(work, name, getattr(source, name))
    again = [all_bends(p, q, closed, constants, weight) for closed in (True, False)]
    for one, other in zip(compiled, again, strict=True):
        np.testing.assert_array_equal(one, other)


def test_turns_alone_are_those_of_all_angles(rng):
    vertices = np.exp(2j * np.pi * np.arange(30) / 30) + 0.1 * rng.normal(size=30)
    for closed in (True, False):
        turn = angles.Corners(vertices, closed).turn
        assert np.array_equal(angles.turns(vertices, closed), turn)
