"""Bezier arithmetic against the curves themselves."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from shapeblend_cli.geometry import cubics
from tests.support.contours import circle_contour

segments = hnp.arrays(
    np.complex128, (3, 4), elements=st.builds(complex, st.integers(-50, 50), st.integers(-50, 50))
)


@given(segments)
def test_bounds_hold_the_curve_and_touch_it(segments):
    box = cubics.bounds(segments)
    curve = cubics.evaluate(segments[:, None, :], np.linspace(0, 1, 2001))
    for low, extent, values in ((box.x, box.width, curve.real), (box.y, box.height, curve.imag)):
        assert low == pytest.approx(values.min(), abs=1e-4)
        assert low <= values.min() + 1e-9
        assert low + extent == pytest.approx(values.max(), abs=1e-4)
        assert low + extent >= values.max() - 1e-9


@given(segments)
def test_lengths_are_those_of_fine_polygons(segments):
    curve = cubics.evaluate(segments[:, None, :], np.linspace(0, 1, 20001))
    fine = np.abs(np.diff(curve, axis=1)).sum(axis=1)
    np.testing.assert_allclose(cubics.lengths(segments), fine, rtol=1e-3, atol=1e-9)


@given(segments, st.floats(0, 1), st.floats(0, 1))
def test_pieces_are_parts_of_the_curve(segments, s, t):
    part = cubics.pieces(segments, np.full(3, s), np.full(3, t))
    u = np.linspace(0, 1, 7)
    expected = cubics.evaluate(segments[:, None, :], s + (t - s) * u)
    np.testing.assert_allclose(cubics.evaluate(part[:, None, :], u), expected, atol=1e-9)


@given(segments)
def test_chord_deviation_is_a_bound(segments):
    curve = cubics.evaluate(segments[:, None, :], np.linspace(0, 1, 501))
    chord = segments[:, 3] - segments[:, 0]
    for k, bound in enumerate(cubics.chord_deviation(segments)):
        u = ((curve[k] - segments[k, 0]).conj() * chord[k]).real / (abs(chord[k]) ** 2 or 1.0)
        assert np.abs(curve[k] - segments[k, 0] - np.clip(u, 0, 1) * chord[k]).max() <= bound + 1e-9


def test_a_circle_has_its_length_area_and_box():
    circle = circle_contour(2 + 1j, 3.0).segments
    assert cubics.lengths(circle).sum() == pytest.approx(6 * np.pi, rel=1e-5)
    assert cubics.signed_area(circle) == pytest.approx(9 * np.pi, rel=1e-5)
    assert tuple(cubics.bounds(circle)) == pytest.approx((-1, -2, 6, 6), rel=1e-5)


def test_area_closes_an_open_chain():
    assert cubics.signed_area(np.array([cubics.line(0, 4), cubics.line(4, 4 + 2j)])) == pytest.approx(4.0)
