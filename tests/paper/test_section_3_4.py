"""Section 3.4: a unit isosceles right triangle becomes a unit square (figures 23 and 24)."""

import numpy as np
import pytest

from shapeblend_cli.matching.work import Wires
from shapeblend_cli.options.constants import PAPER, WorkConstants

# Both blends leave the right angle at vertex 0 and the legs 0-1 and 3-4 as they are. In figure 23 the third
# vertex halves the hypotenuse; in figure 24 a corner of the triangle splits into two vertices.
SQUARE = np.array([0, 1j, 1 + 1j, 1])
TRIANGLE_HALVED = np.array([0, 1j, 0.5 + 0.5j, 1])
TRIANGLE = np.array([0, 1j, 1])
BLEND_1 = np.array([[0, 0], [1, 1], [2, 2], [3, 3]])
BLEND_2 = np.array([[0, 0], [1, 1], [1, 2], [2, 3]])


def equation_18(k_s, k_b, e_s, e_b, c_s):
    return (
        2 * k_s * 0.292893**e_s / (0.707107 + 0.292893 * c_s) + 2 * k_b * 0.785398**e_b + k_b * 1.570796**e_b
    )


def equation_19(k_s, k_b, e_s, e_b, c_s):
    return k_s * (1 / c_s + 0.414214**e_s / (1 + 0.414214 * c_s)) + k_b * (2 * 0.392699**e_b + 0.785398**e_b)


@pytest.mark.parametrize(("k_s", "k_b", "work"), [(0.5, 0.5, 1.914), (0.4, 0.6, 2.159)])
def test_blend_1(k_s, k_b, work):
    constants = WorkConstants(**PAPER, k_s=k_s, k_b=k_b, e_s=1, e_b=1, c_s=0.5)
    wires = Wires(TRIANGLE_HALVED, SQUARE, True, constants)
    priced = wires.path_work(BLEND_1)
    assert priced.total == pytest.approx(work, abs=5e-4)
    assert priced.total == pytest.approx(equation_18(k_s, k_b, 1, 1, 0.5), abs=1e-5)
    assert wires.zero_angles(BLEND_1) == 0


@pytest.mark.parametrize(("k_s", "k_b", "work"), [(0.5, 0.5, 1.957), (0.4, 0.6, 1.88)])
def test_blend_2(k_s, k_b, work):
    # The section's formula has no m_b, and under section 2.2 the two coincident vertices are not monotonic:
    # they start at 135 degrees and pass 112.5 on their way to 90. Hence m_b = 0 here.
    constants = WorkConstants(**PAPER, k_s=k_s, k_b=k_b, e_s=1, e_b=1, c_s=0.5, m_b=0)
    priced = Wires(TRIANGLE, SQUARE, True, constants).path_work(BLEND_2)
    assert priced.total == pytest.approx(work, abs=5e-3)
    assert priced.total == pytest.approx(equation_19(k_s, k_b, 1, 1, 0.5), abs=1e-5)


@pytest.mark.parametrize(("e_s", "e_b", "c_s"), [(2, 1, 0.5), (1, 2, 0.3), (2, 0.5, 1.0)])
def test_both_formulas_for_other_exponents(e_s, e_b, c_s):
    constants = WorkConstants(**PAPER, k_s=0.8, k_b=0.3, e_s=e_s, e_b=e_b, c_s=c_s, m_b=0)
    values = 0.8, 0.3, e_s, e_b, c_s
    assert Wires(TRIANGLE_HALVED, SQUARE, True, constants).path_work(BLEND_1).total == pytest.approx(
        equation_18(*values), abs=1e-5
    )
    assert Wires(TRIANGLE, SQUARE, True, constants).path_work(BLEND_2).total == pytest.approx(
        equation_19(*values), abs=1e-5
    )
