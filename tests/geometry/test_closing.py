"""Lengths that close a polygon, beside the linear equations of the paper on the intrinsic motion."""

import numpy as np
import pytest

from shapeblend_cli.geometry.closing import closing_lengths


def test_what_is_nearly_closed_is_closed_as_in_the_paper():
    # For a small opening the lengths are those of the paper's two linear equations.
    u = np.exp(2j * np.pi * np.array([0.0, 0.1, 0.35, 0.5, 0.6, 0.85]))
    compliance = np.array([0.1, 1.0, 0.5, 0.2, 0.1, 0.3])
    opened = np.array([1.0, 2.0, 1.5, 1.0, 2.0, 1.5]) + 1e-5 * np.array([3, -1, 2, 5, -4, 0])
    directions = np.stack([u.real, u.imag])
    matrix = compliance * opened * directions @ directions.T
    multipliers = np.linalg.solve(matrix, -directions @ opened)
    change = closing_lengths(opened, u, compliance) - opened
    np.testing.assert_allclose(change, compliance * opened * (multipliers @ directions), atol=1e-8)


@pytest.mark.parametrize(
    "angles", [[0.0, 0.0, 0.0], [0.0, np.pi, 0.0], [0.1, 0.8, 1.2, 3.0], [0.5, 0.5 + np.pi]]
)
def test_directions_that_cannot_close_leave_finite_lengths(angles):
    u = np.exp(1j * np.array(angles))
    lengths = closing_lengths(np.linspace(1.0, 2.0, len(u)), u, np.ones(len(u)))
    assert np.isfinite(lengths).all()
    assert (lengths > 0.0).all()
    assert lengths.max() < 1e3


def test_compiled_and_uncompiled_kernels_agree_to_the_bit(rng, load_uncompiled):
    u = np.exp(2j * np.pi * np.sort(rng.random(20)))
    given = rng.uniform(0.5, 2.0, 20), u, rng.uniform(0.1, 2.0, 20)
    uncompiled = load_uncompiled("shapeblend_cli.geometry.closing")
    assert np.array_equal(uncompiled.closing_lengths(*given), closing_lengths(*given))
