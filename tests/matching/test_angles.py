"""Section 2: how an angle moves, against theta(t) sampled densely."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.constants import WorkConstants
from shapeblend_cli.matching import angles
from shapeblend_cli.matching.steps import BEND_OF_STEPS, MOVES, NO_BEND
from shapeblend_cli.matching.tables import Window
from tests.support import oracle
from tests.support.shapes import random_polygon

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
    delta, star, zero = angles.angle_change(*control_points(back0, fwd0, back1, fwd1))
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
    delta, star, zero = angles.angle_change(*controls)
    assert np.degrees(delta) == pytest.approx(degrees, abs=5e-11)
    if reaches_zero is not None:
        assert (star, zero) == (pytest.approx(0.0, abs=1e-12), reaches_zero)


def test_deviation_of_figure_18():
    # (a) out and back past the start: one deviation.
    q0, q1, q2 = at(90.0), at(170.0, 2.0), at(120.0)
    delta, star, _ = angles.angle_change(q0, q1, q2)
    assert np.degrees(delta) == pytest.approx(30.0)
    theta = np.unwrap(
        np.angle([(1 - t) ** 2 * q0 + 2 * t * (1 - t) * q1 + t * t * q2 for t in np.linspace(0, 1, 9999)])
    )
    assert star == pytest.approx(theta.max() - np.radians(120.0), abs=1e-6)


def test_nothing_moves_when_the_angle_only_grows():
    assert angles.angle_change(1j, 2j, 4j) == (0.0, 0.0, False)


def all_bends(kernel, p0, p1, closed, constants):
    """The seven bends of every pair of corners, (m, n, 7)."""
    m, n = len(p0), len(p1)
    bends = np.empty((m * n, 7))
    bending = kernel.Bending(constants.k_b, constants.m_b, constants.e_b, constants.p_b)
    corners = kernel.Corners(p0, closed), kernel.Corners(p1, closed)
    kernel.fill_bends(*corners, bending, np.arange(m), np.ones(m), Window.full(m, n), bends)
    return bends.reshape(m, n, 7)


@pytest.mark.parametrize("closed", [True, False])
def test_every_bend_of_a_graph_agrees_with_the_oracle(rng, closed):
    for constants in (WorkConstants(), WorkConstants(k_b=0.7, m_b=3.0, e_b=2.0, p_b=50.0)):
        for m, n in ((3, 4), (5, 3), (6, 6)):
            p0, p1 = random_polygon(rng, m), random_polygon(rng, n)
            bends = all_bends(angles, p0, p1, closed, constants)
            expected = oracle.Oracle(p0, p1, closed, constants)
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
                    work = expected.bend(i, j, moves_in, moves_out)
                    assert bends[i, j, kind] == pytest.approx(work, rel=2e-3, abs=2e-3)


def test_compiled_and_uncompiled_kernels_agree_to_the_bit(rng, load_uncompiled):
    assert angles.COMPILED
    uncompiled = load_uncompiled("shapeblend_cli.matching.angles")
    assert not uncompiled.COMPILED
    for m, n, constants in ((7, 9, WorkConstants()), (12, 5, WorkConstants(k_b=0.3, e_b=0.5, m_b=4.0))):
        p, q = random_polygon(rng, m), random_polygon(rng, n)
        tables = [all_bends(kernel, p, q, True, constants) for kernel in (angles, uncompiled)]
        np.testing.assert_array_equal(*tables)
