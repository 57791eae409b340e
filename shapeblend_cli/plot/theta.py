"""How the angle at one dot moves over time: theta(t) and its Q curve (sections 2.1 and 2.2), to be drawn.

The kernel in `match.angles` needs only the turns between the extrema; this has every moment, and the same turns.
Beside coincident vertices all but an infinitesimal part of Q is gone at one end of time. What the angle does until
then takes all the time, and the rest happens at that end: a jump there.
"""

from __future__ import annotations

import cmath
import math
from itertools import pairwise, product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.matching.steps import DD, DE, ED, EE, SS

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.matching.angles import Corners
    from shapeblend_cli.matching.work import Wires
    from shapeblend_cli.model import ComplexArray, FloatArray

    Control = tuple[complex, complex, complex]
    Curve = Callable[[FloatArray], ComplexArray]
    Dot = tuple[int, int]

TWO_PI = 2.0 * math.pi
NOISE = 1e-9
"""An angle this close to zero is zero, as in `match.angles`."""

FLAT = 1e-12
"""Cross products this small beside what they are made of are rounding."""

MOMENTS = 96
COARSE = math.radians(3.0)
"""There are so many moments, and more where the angle moves by more than `COARSE` from one to the next."""

SHORTEST = 1e-5
"""Moments this close are not divided further."""


class Piece(NamedTuple):
    """A part of the motion in which the angle is monotone: times in [0, 1] and angles in radians, unwrapped."""

    times: FloatArray
    angles: FloatArray

    @property
    def turn(self) -> float:
        """The change of the angle, signed."""
        return float(self.angles[-1] - self.angles[0])


class Theta(NamedTuple):
    """The motion of an angle."""

    control: Control  # Q0, Q1 and Q2 of eq (9); 0 for one that is infinitesimal
    directions: tuple[float | None, float | None, float | None]  # of those that are infinitesimal, radians
    pieces: tuple[Piece, ...]  # in order of time

    @property
    def first(self) -> float:
        """theta(0), radians in [0, 2 pi)."""
        return float(self.pieces[0].angles[0])

    @property
    def last(self) -> float:
        """theta(1), unwrapped."""
        return float(self.pieces[-1].angles[-1])

    @property
    def delta(self) -> float:
        """Delta theta, eq (11), radians."""
        return abs(self.last - self.first)

    @property
    def against(self) -> tuple[Piece, ...]:
        """The pieces against the net direction."""
        sign = -1.0 if self.last < self.first else 1.0
        return tuple(piece for piece in self.pieces if sign * piece.turn < 0.0)

    @property
    def delta_star(self) -> float:
        """Delta theta*, how far it moves against the net direction (figure 18), radians."""
        return sum(abs(piece.turn) for piece in self.against)

    @property
    def reaches_zero(self) -> bool:
        """Whether theta(t) = 0 at some time, eq (3)."""
        ends = [end for piece in self.pieces for end in (piece.angles[0], piece.angles[-1])]
        return min(ends) < NOISE or max(ends) > TWO_PI - NOISE

    def bending(self, wires: Wires, i: int) -> float:
        """Return the work by eq (17) at a vertex of the first wire."""
        c = wires.constants
        work = c.k_b * float(wires.weight[i]) * (self.delta + c.m_b * self.delta_star) ** c.e_b
        return work + c.p_b if self.reaches_zero else work


def theta_of(wires: Wires, dot: Dot, bend: int) -> Theta:
    """Return the motion of the angle at a dot, for a bend of `match.steps`."""
    p, q = _corner(wires.corners0, dot[0]), _corner(wires.corners1, dot[1])
    if bend == DD:
        return _moving(p, q)

    def price(theta: Theta) -> float:
        return theta.bending(wires, dot[0])

    if bend in (EE, ED, DE):
        return min(_into_a_point(p, q, bend), key=price)
    # Only the second wire moves: the same with the wires exchanged, backwards in time.
    return _reverse(min(_into_a_point(q, p, bend - SS + EE), key=price))


class _Corner(NamedTuple):
    theta: float
    back: complex
    fwd: complex
    base: complex


def _corner(corners: Corners, k: int) -> _Corner:
    return _Corner(corners.theta[k], corners.back[k], corners.fwd[k], corners.base[k])


def _moving(p: _Corner, q: _Corner) -> Theta:
    """Return the motion where both wires move on both sides: eqs (7)-(10)."""
    control = (
        p.fwd.conjugate() * p.back,
        0.5 * (q.fwd.conjugate() * p.back + p.fwd.conjugate() * q.back),
        q.fwd.conjugate() * q.back,
    )
    return Theta(control, (None, None, None), _pieces(control, p.theta, q.theta))


def _pieces(control: Control, first: float, last: float) -> tuple[Piece, ...]:
    """Return theta(t) along a Q curve whose ends are not 0, cut at the roots of eq (10)."""
    curve = bezier(control)
    q0, q1, q2 = control
    d0, d1, d2 = _cross(q0, q1), 0.5 * _cross(q0, q2), _cross(q1, q2)
    size = abs(q0 * q1) + abs(q0 * q2) + abs(q1 * q2)
    if max(abs(d0), abs(d1), abs(d2)) <= FLAT * size:  # all on one line through the origin
        return (_half_turn(curve, first, math.copysign(1.0, _short(last - first))),)
    pieces = []
    angle = first
    for begin, end in pairwise([0.0, *_roots(d0, d1, d2), 1.0]):
        middle = 0.5 * (begin + end)
        u = 1.0 - middle
        sign = math.copysign(1.0, d0 * u * u + 2.0 * d1 * u * middle + d2 * middle * middle)

        def at(t: FloatArray, begin: float = begin, angle: float = angle, sign: float = sign) -> FloatArray:
            turned = (sign * _turn(curve, begin, t)) % TWO_PI
            return angle + sign * np.where(turned > TWO_PI - NOISE, 0.0, turned)

        pieces.append(_sample(at, begin, end))
        angle = float(pieces[-1].angles[-1])
    return tuple(pieces)


def _half_turn(curve: Curve, first: float, sign: float) -> Piece:
    """Return the motion along a curve that turns by less than half a turn in all, with this sign."""
    return _sample(lambda t: first + sign * np.abs(_turn(curve, 0.0, t)), 0.0, 1.0)


def _roots(d0: float, d1: float, d2: float) -> list[float]:
    """Return where d(t), eq (10), changes its sign within (0, 1)."""
    discriminant = d1 * d1 - d0 * d2
    if discriminant <= FLAT * d1 * d1:
        return []
    a, b = d0 - 2.0 * d1 + d2, d1 - d0
    root = math.sqrt(discriminant)
    big = -b - root if b > 0.0 else -b + root  # the one whose terms cannot cancel
    roots = [d0 / big] if big else []
    if a:
        roots.append(big / a)
    return sorted(t for t in roots if 0.0 < t < 1.0)


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
        held = Piece(np.array([0.0, 1.0]), np.array([first, first]))
        return [
            Theta(
                (start, 0j, 0j), (None, direction, math.pi), (held, _jump(first, s1), _jump(first + s1, s2))
            )
            for s1, s2 in turns
        ]
    # One edge of the second wire is there at the end, and only the other one is infinitesimal.
    end = p.fwd.conjugate() * q.back if bend == DE else q.fwd.conjugate() * p.back
    # Then the infinitesimal edge takes over from that of the first wire.
    target = q.base.conjugate() * q.back if bend == DE else q.fwd.conjugate() * -q.base
    curve = bezier((start, 0.5 * (start + end), end))
    control, directions = (start, 0.5 * end, 0j), (None, None, cmath.phase(target) % TWO_PI)
    return [
        Theta(control, directions, (_half_turn(curve, first, math.copysign(1.0, s1)), _jump(first + s1, s2)))
        for s1, s2 in _both_turns(cmath.phase(end / start), cmath.phase(target / end))
    ]


def _both_turns(s1: float, s2: float) -> list[tuple[float, float]]:
    """Return two turns, in both directions where one is half a turn."""
    choices = [(s,) if abs(s) <= math.pi - NOISE else (s, s - math.copysign(TWO_PI, s)) for s in (s1, s2)]
    return list(product(choices[0], choices[1]))


def _jump(angle: float, turn: float) -> Piece:
    return Piece(np.array([1.0, 1.0]), np.array([angle, angle + turn]))


def _reverse(theta: Theta) -> Theta:
    """Return the motion backwards in time, its first angle in [0, 2 pi)."""
    back = TWO_PI * math.floor((theta.last + NOISE) / TWO_PI)
    pieces = tuple(Piece(1.0 - p.times[::-1], p.angles[::-1] - back) for p in reversed(theta.pieces))
    q0, q1, q2 = theta.control
    d0, d1, d2 = theta.directions
    return Theta((q2, q1, q0), (d2, d1, d0), pieces)


def _sample(at: Callable[[FloatArray], FloatArray], begin: float, end: float) -> Piece:
    """Return an angle at times so close that lines from one to the next approximate it."""
    times = np.linspace(begin, end, MOMENTS)
    while True:
        values = at(times)
        wide = (np.abs(np.diff(values)) > COARSE) & (np.diff(times) > SHORTEST)
        if not wide.any():
            return Piece(times, values)
        times = np.sort(np.append(times, 0.5 * (times[:-1] + times[1:])[wide]))


def bezier(control: Sequence[complex]) -> Curve:
    """Return the curve with three control points, as a function of times."""
    q0, q1, q2 = control
    return lambda t: q0 * (1.0 - t) ** 2 + q1 * 2.0 * t * (1.0 - t) + q2 * t * t


def _turn(curve: Curve, begin: float, t: FloatArray) -> FloatArray:
    """Return the angle from the curve's point at one time to its points at others, in (-pi, pi]."""
    return np.angle(curve(t) * curve(np.array(begin)).conjugate())


def _cross(a: complex, b: complex) -> float:
    return (a.conjugate() * b).imag


def _short(angle: float) -> float:
    """Return an angle modulo a turn, in [-pi, pi]."""
    return math.remainder(angle, TWO_PI)
