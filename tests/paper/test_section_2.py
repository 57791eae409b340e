"""Sections 2.1 and 2.2: the angles of figures 19 to 22."""

import numpy as np
import pytest

from shapeblend_cli.matching import angles
from shapeblend_cli.matching.steps import DE, ED, EE
from tests.support.angles import angle_change


def wedge(alpha, length=1.0):
    """A triangle whose vertex 1 has the interior angle alpha in degrees."""
    back = length * np.exp(1j * np.radians(alpha))
    return np.array([back, 0.0, length])


def bend(*dot):
    """Delta theta in degrees, and whether theta reaches zero."""
    delta, _, zero = angle_change(*dot)
    return np.degrees(delta), zero


@pytest.mark.parametrize("alpha", [20.0, 40.0, 90.0, 150.0])
def test_ends_of_a_run_have_90_degrees_and_half_the_angle(alpha):
    # Figure 19: theta_2 = theta_4 = 90 + alpha / 2 at the ends of the base, 180 in between.
    corners = angles.Corners(wedge(alpha), True)
    theta, back, base = corners.theta[1], corners.back[1], corners.base[1]
    assert back == wedge(alpha)[0]
    into = np.degrees(np.angle(base.conjugate() * back)) % 360.0
    out_of = np.degrees(np.angle(1.0 * -base)) % 360.0
    assert np.degrees(theta) == pytest.approx(alpha)
    assert into == pytest.approx(90.0 + alpha / 2.0)
    assert out_of == pytest.approx(90.0 + alpha / 2.0)


def test_figure_20_the_middle_of_a_run_ends_straight():
    # Three coincident vertices: the middle one has 180 degrees at the end, whatever the wedge.
    for alpha in (30.0, 80.0, 140.0):
        delta, zero = bend(wedge(70.0), wedge(alpha), 1, 1, EE)
        assert (delta, zero) == (pytest.approx(110.0), False)


def test_figure_21_two_coincident_vertices():
    # Q2 lies on a ray of 110 degrees (so alpha is 40), and delta_theta is 38 degrees.
    delta, zero = bend(wedge(72.0), wedge(40.0), 1, 1, DE)
    assert (delta, zero) == (pytest.approx(38.0), False)
    delta, zero = bend(wedge(148.0), wedge(40.0), 1, 1, ED)
    assert (delta, zero) == (pytest.approx(38.0), False)


def test_figure_22_an_angle_of_coincident_vertices_goes_to_zero():
    # The edge into the run swings past the other before the run shrinks away.
    p = np.array([np.exp(1j * np.radians(60.0)), 0.0, 1.0])
    q = p * np.exp(1j * np.radians(-100.0))
    assert bend(p, q, 1, 1, DE)[1]
    assert not bend(p, p, 1, 1, DE)[1]
