"""How the angle at one dot moves over time: theta(t) and its Q curve (sections 2.1 and 2.2), to be drawn.

The solver needs only how far the angle turns, see `matching.angles`; a figure needs every moment. Beside coincident
vertices all but an infinitesimal part of Q is gone at one end of time. The motion up to there takes all the time, and
the rest happens at that end: a jump.
"""

from __future__ import annotations

import cmath
import math
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.matching.angles import Bending, fill_bends
from shapeblend_cli.matching.steps import DD, DE, ED, EE, SS
from shapeblend_cli.matching.tables import Window
from shapeblend_cli.options.constants import WorkConstants

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.matching.angles import Corners
    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.model import ComplexArray, FloatArray

    Control = tuple[complex, complex, complex]
    Change = tuple[float, float, bool]
    Dot = tuple[int, int]

TWO_PI = 2.0 * math.pi

NOISE = 1e-9
"""Tolerance of angles, in radians, as in `matching.angles`."""

FLAT = 1e-12
"""Tolerance of cross products, as a share of the products that they are differences of; and of steps of an angle."""

MOMENTS = 96
"""Minimum number of moments of a motion."""

COARSE = math.radians(3.0)
"""Maximum turn from one moment to the next, in radians."""

SHORTEST = 1e-5
"""Minimum time between two moments, as a share of the motion. A shorter turn is a jump."""

FINITE = (None, None, None)
"""Directions of infinitesimal control points where all control points are finite."""


class Piece(NamedTuple):
    """A part of the motion in which the angle is monotone: times in [0, 1] and angles in radians, unwrapped."""

    times: FloatArray
    angles: FloatArray


class Theta(NamedTuple):
    """The motion of an angle."""

    control: Control  # Q0, Q1 and Q2 of eq (9); 0 for one that is infinitesimal
    directions: tuple[float | None, float | None, float | None]  # of those that are infinitesimal, radians
    times: FloatArray  # (k,) in [0, 1]
    angles: FloatArray  # (k,) in radians, the first in [0, 2 pi), unwrapped
    solved: Change | None = None  # by the solver, where the extrema lie between the times

    @property
    def first(self) -> float:
        """theta(0), radians in [0, 2 pi)."""
        return float(self.angles[0])

    @property
    def last(self) -> float:
        """theta(1), unwrapped."""
        return float(self.angles[-1])

    @property
    def change(self) -> Change:
        """Delta theta, Delta theta* (figure 18), and whether theta reaches zero."""
        if self.solved is not None:
            return self.solved
        delta = abs(self.last - self.first)
        star = 0.5 * (float(np.abs(np.diff(self.angles)).sum()) - delta)
        return delta, star, bool(self.angles.min() < NOISE or self.angles.max() > TWO_PI - NOISE)

    @property
    def against(self) -> list[Piece]:
        """The pieces against the net direction, in order of time."""
        steps = np.diff(self.angles) * (-1.0 if self.last < self.first else 1.0)
        edges = np.flatnonzero(np.diff(steps < -FLAT, prepend=False, append=False))
        runs = [slice(start, end + 1) for start, end in edges.reshape(-1, 2).tolist()]
        return [Piece(self.times[run], self.angles[run]) for run in runs]

    def bending(self, wires: Wires, i: int) -> float:
        """Return the work by eq (17) at a vertex of the first wire."""
        c, (delta, star, is_zero) = wires.constants, self.change
        work = c.k_b * float(wires.weight[i]) * (delta + c.m_b * star) ** c.e_b
        return work + c.p_b if is_zero else work


def theta_of(wires: Wires, dot: Dot, bend: int) -> Theta:
    """Return the motion of the angle at a dot, for a bend of `matching.steps`."""
    p, q = _corner(wires.corners0, dot[0]), _corner(wires.corners1, dot[1])
    if bend == DD:
        return _moving(p, q)._replace(solved=_solved(wires, dot))

    def price(theta: Theta) -> float:
        return theta.bending(wires, dot[0])

    if bend in (EE, ED, DE):
        return min(_into_a_point(p, q, bend), key=price)
    # Only the second wire moves: the same with the wires exchanged, backwards in time.
    return _reverse(min(_into_a_point(q, p, bend - SS + EE), key=price))


def _solved(wires: Wires, dot: Dot) -> Change:
    """Return the change of an angle where both wires move on both sides, as the solver prices it."""
    column, row = np.array([dot[0]]), np.array([dot[1]])
    work = np.zeros((3, 1, 7))
    for bends, (k_b, m_b, p_b) in zip(work, ((1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 0.0, 1.0)), strict=True):
        bending = Bending(WorkConstants(bending="paper", m_b=m_b, e_b=1.0), k_b, p_b)
        corners = wires.corners0, wires.corners1
        fill_bends(*corners, bending, column, np.ones(1), Window.between(row, row), bends)
    delta, both, zero = work[:, 0, DD].tolist()
    return delta, both - delta, zero > 0.0


class _Corner(NamedTuple):
    theta: float
    back: complex
    fwd: complex
    base: complex


def _corner(corners: Corners, k: int) -> _Corner:
    return _Corner(corners.theta[k], corners.back[k], corners.fwd[k], corners.base[k])


def _moving(p: _Corner, q: _Corner) -> Theta:
    """Return the motion where both wires move on both sides."""
    q0, q1, q2 = control = (
        p.fwd.conjugate() * p.back,
        0.5 * (q.fwd.conjugate() * p.back + p.fwd.conjugate() * q.back),
        q.fwd.conjugate() * q.back,
    )
    size = abs(q0 * q1) + abs(q0 * q2) + abs(q1 * q2)
    is_flat = max(abs((a.conjugate() * b).imag) for a, b in ((q0, q1), (q0, q2), (q1, q2))) <= FLAT * size
    way = math.copysign(1.0, _short(q.theta - p.theta)) if is_flat else 0.0
    return Theta(control, FINITE, *_along(control, p.theta, way))


def _along(control: Control, first: float, way: float = 0.0) -> tuple[FloatArray, FloatArray]:
    """Return times and the angles along a Q curve, so close that lines from one to the next approximate it.

    With a `way`, 1 or -1, it turns that way alone, by half a turn at most.
    """
    times = np.linspace(0.0, 1.0, MOMENTS)
    while True:
        curve = bezier(control, times)
        turned = way * np.abs(np.angle(curve * curve[0].conjugate()))
        if not way:
            turned = np.append(0.0, np.cumsum(np.angle(curve[1:] * curve[:-1].conj())))
        wide = (np.abs(np.diff(turned)) > COARSE) & (np.diff(times) > SHORTEST)
        if not wide.any():
            return times, first + turned
        times = np.sort(np.append(times, 0.5 * (times[:-1] + times[1:])[wide]))


def _into_a_point(p: _Corner, q: _Corner, bend: int) -> list[Theta]:
    """Return the motions where only the first wire moves: one for each direction of a half turn.

    The second wire has coincident vertices there.
    """
    first = p.theta
    start = p.fwd.conjugate() * p.back
    if bend == EE:
        q1 = q.base.conjugate() * p.back - p.fwd.conjugate() * q.base
        direction: float | None = None
        turns = [(0.0, math.pi - first)]
        if abs(q1) > FLAT * (abs(p.back) + abs(p.fwd)):  # else it has no direction
            direction = cmath.phase(q1) % TWO_PI
            turns = _both_turns(_short(direction - first), _short(math.pi - direction))
        times = np.array([0.0, 1.0, 1.0, 1.0])
        return [
            Theta((start, 0j, 0j), (None, direction, math.pi), times, first + np.cumsum([0.0, 0.0, s1, s2]))
            for s1, s2 in turns
        ]
    # One edge of the second wire is there at the end, and only the other one is infinitesimal.
    end = p.fwd.conjugate() * q.back if bend == DE else q.fwd.conjugate() * p.back
    # Then the infinitesimal edge takes over from that of the first wire.
    target = q.base.conjugate() * q.back if bend == DE else q.fwd.conjugate() * -q.base
    control, directions = (start, 0.5 * end, 0j), (None, None, cmath.phase(target) % TWO_PI)
    motions = []
    for s1, s2 in _both_turns(cmath.phase(end / start), cmath.phase(target / end)):
        times, angles = _along((start, 0.5 * (start + end), end), first, math.copysign(1.0, s1))
        motions.append(Theta(control, directions, np.append(times, 1.0), np.append(angles, angles[-1] + s2)))
    return motions


def _both_turns(s1: float, s2: float) -> list[tuple[float, float]]:
    """Return two turns, in both directions where one is half a turn."""
    choices = [(s,) if abs(s) <= math.pi - NOISE else (s, s - math.copysign(TWO_PI, s)) for s in (s1, s2)]
    return list(product(choices[0], choices[1]))


def _reverse(theta: Theta) -> Theta:
    """Return the motion backwards in time, its first angle in [0, 2 pi)."""
    back = TWO_PI * math.floor((theta.last + NOISE) / TWO_PI)
    q0, q1, q2 = theta.control
    d0, d1, d2 = theta.directions
    return Theta((q2, q1, q0), (d2, d1, d0), 1.0 - theta.times[::-1], theta.angles[::-1] - back)


def bezier(control: Sequence[complex], t: FloatArray) -> ComplexArray:
    """Return the points at times `t` of a curve with three control points."""
    q0, q1, q2 = control
    return q0 * (1.0 - t) ** 2 + q1 * 2.0 * t * (1.0 - t) + q2 * t * t


def _short(angle: float) -> float:
    """Return an angle modulo a turn, in [-pi, pi]."""
    return math.remainder(angle, TWO_PI)
