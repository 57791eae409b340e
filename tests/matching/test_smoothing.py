"""Outlines smoothed along their length, beside the oracle's integrals; and the travel of points, beside lengths."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.matching.smoothing import smoothed
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.options.constants import PAPER, WorkConstants
from tests.support import oracle
from tests.support.shapes import random_polygon, regular_polygon, star_polygon, unit_box
from tests.support.strategies import rngs

sigmas = st.sampled_from([0.001, 0.005, 0.02, 0.1])
counts = st.integers(3, 20)


@given(rngs, counts, st.booleans(), sigmas)
def test_it_is_the_integral_against_a_gaussian(rng, m, closed, sigma):
    p = random_polygon(rng, m)
    np.testing.assert_allclose(
        smoothed(p, closed, sigma), oracle.smoothed(p, closed, sigma), atol=2e-5 * sigma * m
    )


@given(rngs, counts, sigmas)
def test_it_is_the_same_wherever_a_closed_outline_begins_and_which_way_it_runs(rng, m, sigma):
    p, start = random_polygon(rng, m), int(rng.integers(m))
    smooth = smoothed(p, True, sigma)
    np.testing.assert_allclose(smoothed(np.roll(p, start), True, sigma), np.roll(smooth, start), atol=1e-12)
    np.testing.assert_allclose(smoothed(p[::-1], True, sigma), smooth[::-1], atol=1e-12)
    np.testing.assert_allclose(smoothed(3j * p + 5, True, sigma), 3j * smooth + 5, atol=1e-11)


@given(rngs, counts, st.booleans(), sigmas)
def test_vertices_on_straight_lines_change_nothing(rng, m, closed, sigma):
    p = random_polygon(rng, m)
    following = np.roll(p, -1) if closed else p[1:]
    share = rng.uniform(0.1, 0.9, len(following))
    inserted = p[: len(following)] + share * (following - p[: len(following)])
    more = np.insert(p, np.arange(1, len(following) + 1), inserted)
    np.testing.assert_allclose(smoothed(more, closed, sigma)[::2], smoothed(p, closed, sigma), atol=1e-12)


@pytest.mark.parametrize("closed", [True, False])
def test_many_vertices_are_smoothed_on_a_grid(rng, closed, monkeypatch):
    p = random_polygon(rng, 90)
    one_by_one = smoothed(p, closed, 0.02)
    monkeypatch.setattr("shapeblend_cli.matching.smoothing.MANY", 0)
    on_grid = smoothed(p, closed, 0.02)
    assert (on_grid != one_by_one).any()
    np.testing.assert_allclose(on_grid, one_by_one, atol=1e-8)


def test_ends_of_open_outlines_stay(rng):
    p = random_polygon(rng, 12)
    smooth = smoothed(p, False, 0.05)
    np.testing.assert_allclose(smooth[[0, -1]], p[[0, -1]], atol=1e-9)
    assert abs(smooth - p)[1:-1].min() > 1e-4


def test_a_small_zigzag_hardly_bends_any_more():
    edge = np.linspace(0, 1, 101)[:-1]
    teeth = 0.004j * (np.arange(100) % 2)
    square = np.concatenate([(edge + teeth) * 1j**k + corner for k, corner in enumerate((0, 1, 1 + 1j, 1j))])
    plain = np.concatenate([edge * 1j**k + corner for k, corner in enumerate((0, 1, 1 + 1j, 1j))])
    dots = np.arange(400)[:, None].repeat(2, axis=1)
    rough, smooth = (
        Wires(unit_box(square), unit_box(plain), True, WorkConstants(p_b=0.0, smoothing=sigma))
        .path_work(dots)
        .bending
        for sigma in (0.0, 0.01)
    )
    assert smooth < 0.35 * rough


@pytest.mark.parametrize("constants", [WorkConstants(k_b=0.0, p_b=0.0, k_s=0.0), WorkConstants(k_t=3.0)])
def test_travel_does_not_hang_on_the_number_of_vertices(constants):
    """Two circles, one turned against the other: an integral along the outline, however it is cut."""
    found = []
    for m in (30, 60, 400):
        p, q = regular_polygon(m), regular_polygon(m, turn=0.4)
        found.append(Wires(p, q, True, constants).path_work(np.arange(m)[:, None].repeat(2, axis=1)).travel)
    assert found[0] == pytest.approx(found[2], rel=0.02)
    assert found[1] == pytest.approx(found[2], rel=0.005)
    # A chord of .4 radians in a box of two radii, along a circumference of pi of such boxes.
    assert found[2] == pytest.approx(constants.k_t * np.sin(0.2) ** 2 * np.pi, rel=1e-3)


def test_boxes_are_squares_to_travel_and_nothing_travels_in_a_wide_one(rng):
    p = star_polygon(rng, 15)
    wide = p.real + 0.3j * p.imag
    dots = np.arange(15)[:, None].repeat(2, axis=1)
    assert Wires(p, wide, True, WorkConstants()).path_work(dots).travel == pytest.approx(0.0, abs=1e-12)
    # What is nearly a line is not blown up: .02 of its length is its height at least.
    line = np.linspace(0, 1, 15) + 1e-5j * rng.random(15)
    other = np.linspace(0, 1, 15) + 1e-5j * rng.random(15)
    assert Wires(line, other, False, WorkConstants(k_t=10.0)).path_work(dots).travel < 1e-4


def test_without_stiffness_there_is_no_travel(rng):
    p, q = star_polygon(rng, 9), star_polygon(rng, 9)
    dots = np.arange(9)[:, None].repeat(2, axis=1)
    for constants in (WorkConstants(k_t=0.0), WorkConstants(**PAPER)):
        assert Wires(p, q, True, constants).path_work(dots).travel == 0.0


def test_compiled_and_uncompiled_kernels_agree_to_the_bit(rng, load_uncompiled):
    uncompiled = load_uncompiled("shapeblend_cli.matching.smoothing")
    for closed in (True, False):
        p = random_polygon(rng, 30)
        assert np.array_equal(uncompiled.smoothed(p, closed, 0.01), smoothed(p, closed, 0.01))
