"""How an angle moves, as the kernels price it."""

import cmath

import numpy as np

from shapeblend_cli.matching.angles import Bending, Corners, fill_bends
from shapeblend_cli.matching.steps import DD
from shapeblend_cli.matching.tables import Window
from shapeblend_cli.options.constants import WorkConstants


def angle_change(p, q, i, j, kind):
    """Delta theta and delta theta* in radians, and whether theta reaches zero, at a bend of two closed wires."""
    corners = Corners(p, True), Corners(q, True)
    dot = Window.between(np.array([j]), np.array([j]))
    bends = np.zeros((3, 1, 7))
    for work, (k_b, m_b, p_b) in zip(bends, ((1, 0, 0), (1, 1, 0), (0, 0, 1)), strict=True):
        bending = Bending(WorkConstants(bending="paper", m_b=m_b, e_b=1.0), k_b, p_b)
        fill_bends(*corners, bending, np.array([i]), np.ones(1), dot, work)
    delta, with_star, zero = bends[:, 0, kind]
    return delta, with_star - delta, zero > 0


def angle_change_along(q0, q1, q2):
    """The same along a curve of these control points, eq (9), by edges that have it."""
    # With F0 = 1 and F1 = f, B1 is 2 Q1 - conj(f) Q0, and conj(f) a root of Q0 z^2 - 2 Q1 z + Q2.
    root = cmath.sqrt(q1 * q1 - q0 * q2)
    f = max((q1 + root) / q0, (q1 - root) / q0, key=abs).conjugate()
    p, q = np.array([q0, 0.0, 1.0]), np.array([q2 / f.conjugate(), 0.0, f])
    return angle_change(p, q, 1, 1, DD)
