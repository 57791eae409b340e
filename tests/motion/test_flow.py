"""The curve shortening flow, step by step."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.geometry.crossings import polygon_crossings
from shapeblend_cli.motion import flow
from tests.support.contours import polygon
from tests.support.shapes import comb, random_polygon, spiral, star_polygon
from tests.support.strategies import rngs

TINY = 1e-12


def stepped(z, time, closed=True, least=TINY, kernel=flow):
    """The vertices after a step."""
    z = np.asarray(z, complex)
    points = np.stack([z.real, z.imag], axis=1)
    kernel.shorten(points, np.empty((len(z), 3)), closed, time, least)
    return points @ [1, 1j]


def solved(z, time, closed, least):
    """The same by a dense matrix: (1 + 2 c) x - c (x before + x after) = x as it was."""
    n = len(z)
    inside = range(n) if closed else range(1, n - 1)
    matrix = np.eye(n)
    for k in inside:
        h = max(0.5 * (abs(z[k] - z[k - 1]) + abs(z[(k + 1) % n] - z[k])), least)
        matrix[k, k] += 2.0 * time / h**2
        matrix[k, k - 1] -= time / h**2
        matrix[k, (k + 1) % n] -= time / h**2
    return np.linalg.solve(matrix, z)


@given(rngs, st.integers(3, 40), st.floats(-6.0, 2.0), st.booleans(), st.sampled_from([TINY, 0.05]))
def test_a_step_solves_its_equations(rng, m, exponent, closed, least):
    z = random_polygon(rng, m)
    time = 10.0**exponent
    np.testing.assert_allclose(stepped(z, time, closed, least), solved(z, time, closed, least), atol=1e-7)


def test_compiled_and_uncompiled_kernels_agree_to_the_bit(rng, load_uncompiled):
    assert flow.COMPILED
    uncompiled = load_uncompiled("shapeblend_cli.motion.flow")
    assert not uncompiled.COMPILED
    for m, closed, least in ((3, True, TINY), (17, True, 0.1), (40, False, TINY), (5, False, 0.1)):
        z = random_polygon(rng, m)
        steps = [stepped(z, 0.01, closed, least, kernel) for kernel in (flow, uncompiled)]
        np.testing.assert_array_equal(*steps)


@pytest.mark.parametrize("steps", [50, 200])
def test_a_circle_shrinks_as_the_square_of_its_radius_says(steps):
    radius, time = 2.0, 0.8
    z = radius * np.exp(2j * np.pi * np.arange(200) / 200)
    for _ in range(steps):
        z = stepped(z, time / steps)
    np.testing.assert_allclose(abs(z), np.sqrt(radius**2 - 2.0 * time), rtol=0.5 / steps)
    assert abs(z.mean()) < 1e-9


def test_the_ends_of_an_open_line_stay_and_it_becomes_straight(rng):
    z = random_polygon(rng, 20)
    line = z
    for _ in range(40):
        line = stepped(line, 0.05, closed=False, least=0.02)
    assert (line[0], line[-1]) == (z[0], z[-1])
    along = (line - z[0]) / (z[-1] - z[0])
    assert abs(along.imag).max() < 1e-3
    assert (np.diff(along.real) > 0.0).all()


def test_a_straight_line_of_even_vertices_stays():
    line = np.linspace(0.0, 3.0 + 1j, 9)
    np.testing.assert_allclose(stepped(line, 10.0, closed=False), line, atol=1e-12)


@given(rngs, st.integers(3, 30))
def test_any_step_stays_within_the_hull_and_keeps_coincident_vertices_finite(rng, m):
    z = np.repeat(random_polygon(rng, m), rng.integers(1, 4, m))
    for time, closed in product((1e-6, 1.0, 1e6), (True, False)):
        found = stepped(z, time, closed, least=1e-3)
        assert np.isfinite(found).all()
        for coordinate, most in ((found.real, z.real.max()), (found.imag, z.imag.max())):
            assert -1e-9 < coordinate.min() <= coordinate.max() < most + 1e-9


STARS = [star_polygon(np.random.default_rng(seed), 5 + seed, 0.8) for seed in range(2, 12)]


@pytest.mark.parametrize("z", [spiral(2.0), comb(4), *STARS])
def test_what_does_not_cross_itself_does_not_begin_to(z):
    z = (z[:, None] + np.linspace(0, 1, 5)[:-1] * (np.roll(z, -1) - z)[:, None]).ravel()
    z = z / np.ptp(z.real)
    assert polygon_crossings([polygon(z)]) == 0
    for _ in range(60):
        mean = abs(np.diff(z, append=z[:1])).mean()
        z = stepped(z, 0.5 * mean**2, least=0.02 * mean)
        assert polygon_crossings([polygon(z)]) == 0
