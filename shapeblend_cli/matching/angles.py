# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
# mypy: disable-error-code="attr-defined"
"""The motion of an angle during a blend, and the work of bending it.

Sections 2.1, 2.2 and 3.2 of Sederberg and Greenwood, "A Physically Based Approach to 2-D Shape Blending", Computer
Graphics 26(2), 1992 (SIGGRAPH '92). This file is compiled by Cython and runs uncompiled as well.

Symbols
-------
``B``, ``F`` (`back`, `fwd`): edge vectors from a vertex to the vertices before and after it; subscript 0 for the first
wire, 1 for the second. ``Q(t) = conj(F(t)) B(t)`` is eqs (6)-(9) as one complex product, so ``theta(t) = arg Q(t)`` in
[0, 2 pi). ``d(t)``, eq (10), has the sign of theta's velocity.

The motion of theta is cut at its extrema into monotonic pieces. A piece that lies between two roots of d turns by less
than pi, so its signed turn s is the angle between its ends; only a motion without a root can turn further, and then the
sign of d gives the direction. That is eq (11) without a triangle test. With the turns s1, s2, ... of the pieces:

* ``delta_theta = |s1 + s2 + ...|``,
* ``delta_theta_star``, the way travelled against the net direction (figure 18), is ``(|s1| + ... - delta_theta) / 2``,
* theta reaches zero when theta0, theta0 + s1, ... leaves the open interval (0, 2 pi).

Departures
----------
* What an angle costs is, unless the paper's bending is asked for, a change of turning: `Bending`.
* Section 2.2 gives the end angles of coincident vertices; the motion in between is the limit of an infinitesimal
  isosceles triangle. Of ``Q1`` the leading order is kept, and the motion has exactly the pieces Q0 -> Q1 -> Q2. There
  is no epsilon.
* An edge that shrinks through nothing and grows out the other side turns by exactly pi, either way round. Where that
  happens beside coincident vertices the cheaper way is taken.
* Where ``Q0``, ``Q1`` and ``Q2`` lie on one line through the origin, d vanishes: theta goes the short way.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.matching import steps

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.cpython.exc import PyErr_CheckSignals as look_for_signals
    from cython.cimports.libc.math import atan2, fabs, pow, sqrt
else:
    from math import atan2, fabs, pow, sqrt

    from shapeblend_cli._cython import look_for_signals

if TYPE_CHECKING:
    from shapeblend_cli.matching.tables import Window
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray
    from shapeblend_cli.options.constants import WorkConstants

COMPILED = cython.compiled

PI = cython.declare(cython.double, 3.141592653589793)
TWO_PI = cython.declare(cython.double, 6.283185307179586)

# Maximum distance of a zero angle from 0 and 2 pi, and of a half turn from pi: far above rounding, far below sight.
ANGLE_NOISE = cython.declare(cython.double, 1e-9)
HALF_TURN = cython.declare(cython.double, 3.141592653589793 - 1e-9)

# Factor on the noise of a quick test, which must never be sure where an exact one is not.
MORE_NOISE = cython.declare(cython.double, 1.01)

# Minimum distance from half a round of directions that are certainly on one side.
HALF_ROUND_NOISE = cython.declare(cython.double, 1e-6)

# Maximum size of d where it is nothing but rounding, as a share of the products whose difference it is.
CROSS_NOISE = cython.declare(cython.double, 1e-12)

cython.declare(EE=cython.int, ED=cython.int, DE=cython.int, SS=cython.int)
cython.declare(SD=cython.int, DS=cython.int, DD=cython.int)
EE, ED, DE, SS, SD, DS, DD = steps.BENDS

# The control points Q0, Q1 and Q2 of Q(t).
Curve = cython.struct(
    x0=cython.double, y0=cython.double, x1=cython.double, y1=cython.double, x2=cython.double, y2=cython.double
)

# The dots of a column, numbers from `first` to before `beyond`: vertex i of the first wire, and of the second j and on.
Column = cython.struct(
    i=cython.Py_ssize_t, j=cython.Py_ssize_t, first=cython.Py_ssize_t, beyond=cython.Py_ssize_t
)

# The signed turns of theta in its two monotonic pieces beside coincident vertices.
Turns = cython.struct(s1=cython.double, s2=cython.double)


def _arg(z: ComplexArray) -> FloatArray:
    """Return angles in [-pi, pi]."""
    return np.arctan2(z.imag, z.real)


def _edges_at(vertices: ComplexArray, closed: bool) -> tuple[ComplexArray, ComplexArray]:
    """Return B and F of each vertex, see `Corners`."""
    back, fwd = np.empty((2, len(vertices)), np.complex128)
    _fill_edges(np.ascontiguousarray(vertices, np.complex128), closed, back, fwd)
    return back, fwd


@cython.cfunc
def _fill_edges(
    vertices: cython.const[cython.doublecomplex][::1],
    closed: cython.bint,
    back: cython.doublecomplex[::1],
    fwd: cython.doublecomplex[::1],
) -> None:
    """Fill in B and F of each vertex."""
    k: cython.Py_ssize_t
    last: cython.Py_ssize_t = vertices.shape[0] - 1
    for k in range(last + 1):
        back[k] = vertices[k - 1 if k > 0 else last] - vertices[k]
        fwd[k] = vertices[k + 1 if k < last else 0] - vertices[k]
    if not closed:
        fwd[last] = -back[last]
        back[0] = -fwd[0]


def _theta(back: ComplexArray, fwd: ComplexArray) -> FloatArray:
    theta = _arg(fwd.conj() * back)
    return np.add(theta, 2.0 * np.pi, out=theta, where=theta < 0.0)


def turns(vertices: ComplexArray, closed: bool) -> FloatArray:
    """Return how far a wire turns at its vertices, as `Corners.turn`, (m,) float, without their other angles."""
    return np.pi - _theta(*_edges_at(vertices, closed))


@cython.cclass
class Corners:
    """The angles at the vertices of a wire.

    Parameters
    ----------
    vertices : (m,) complex
        No two neighbours are equal. m >= 2 when open, >= 3 when closed.
    closed : bool
        An open wire goes straight on beyond its ends: the missing edge of an end vertex is its other edge reversed, so
        a run of coincident vertices there lies along the wire.
    smooth_turn : (m,) float, optional
        How far the smoothed outline turns there; by default as far as the wire.

    Attributes
    ----------
    theta : (m,) float
        The angle arg(conj(F) B) in [0, 2 pi).
    turn : (m,) float
        How far the wire turns there, pi - theta, in (-pi, pi].
    back, fwd : (m,) complex
        B and F.
    base : (m,) complex
        Direction of the base on which coincident vertices lie (section 2.2): B turned by -(90 degrees + theta / 2).
    back_arg, fwd_arg, base_arg : (m,) float
        Their angles in [-pi, pi].
    heading : (m,) float
        The angle of -B, the way in, in [-pi, pi]; the way out is this and the turn.
    ahead, aside : (m,) float
        The parts of conj(F) B.
    apart, along : (m,) complex
        B - F and B + F.
    least_turn, most_turn : (m,) float
        The turn where it is negative, or positive; else 0.
    toward_zero : (m, 4) float
        Vectors u and v, (ux, uy, vx, vy), of the test whether the angle reaches zero where the other wire rests on a
        base of direction d, see `_fill_toward_zero`.
    """

    theta = cython.declare(cython.double[::1], visibility="readonly")
    turn = cython.declare(cython.double[::1], visibility="readonly")
    back = cython.declare(cython.doublecomplex[::1], visibility="readonly")
    fwd = cython.declare(cython.doublecomplex[::1], visibility="readonly")
    base = cython.declare(cython.doublecomplex[::1], visibility="readonly")
    back_arg: cython.double[::1]
    fwd_arg: cython.double[::1]
    base_arg: cython.double[::1]
    heading: cython.double[::1]
    ahead: cython.double[::1]
    aside: cython.double[::1]
    apart: cython.doublecomplex[::1]
    along: cython.doublecomplex[::1]
    smooth_turn: cython.double[::1]
    least_turn: cython.double[::1]
    most_turn: cython.double[::1]
    toward_zero: cython.double[:, ::1]

    def __init__(self, vertices: ComplexArray, closed: bool, smooth_turn: FloatArray | None = None) -> None:
        back, fwd = _edges_at(vertices, closed)
        theta = _theta(back, fwd)
        base = back / np.abs(back) * np.exp(-1j * (0.5 * np.pi + 0.5 * theta))
        self.theta, self.turn = theta, np.pi - theta
        self.smooth_turn = self.turn if smooth_turn is None else smooth_turn
        self.back, self.fwd, self.base = back, fwd, base
        self.back_arg, self.fwd_arg, self.base_arg = _arg(back), _arg(fwd), _arg(base)
        self.heading, self.ahead, self.aside, self.least_turn, self.most_turn = np.empty((5, len(vertices)))
        self.apart, self.along = np.empty((2, len(vertices)), np.complex128)
        self.toward_zero = np.zeros((len(vertices), 4))
        self._fill_parts()
        self._fill_toward_zero()

    @cython.cfunc
    @cython.exceptval(check=False)
    def _fill_parts(self) -> cython.void:
        """Fill in what is made of B, F, their angles and the turn by a few operations, without an array for each."""
        cython.declare(k=cython.Py_ssize_t)
        for k in range(self.turn.shape[0]):
            back, fwd = self.back[k], self.fwd[k]
            self.heading[k] = _short_way(self.back_arg[k] + PI)
            self.ahead[k], self.aside[k] = _dot(fwd, back), _cross(fwd, back)
            self.apart[k], self.along[k] = back - fwd, back + fwd
            self.least_turn[k], self.most_turn[k] = min(self.turn[k], 0.0), max(self.turn[k], 0.0)

    @cython.cfunc
    @cython.exceptval(check=False)
    def _fill_toward_zero(self) -> cython.void:
        """Fill in the vectors by which two products decide most cases of `Bending.resting`.

        The angle reaches zero if both u d and v d exceed 1, and does not if one is below -1. In between, rounding might
        decide; where it always might, u and v are zero.

        The parts of Q1, see `Bending.inside_run`, are products of d and constant vectors. In general the way from Q0 to
        Q1 passes right of the origin if it crosses the axis, by u, and does so on the right, by v. At a straight vertex
        Q0 is on the left of the axis. Between edges of one length Q1 is on the axis too, to its right or left; between
        others it is off the axis, and the angle does not reach zero.
        """
        cython.declare(k=cython.Py_ssize_t, side=cython.double, tall=cython.double)
        for k in range(self.ahead.shape[0]):
            x0: cython.double = self.ahead[k]
            y0: cython.double = self.aside[k]
            apart, along = self.apart[k], self.along[k]
            wide: cython.double = fabs(apart.real) + fabs(apart.imag)
            high: cython.double = fabs(along.real) + fabs(along.imag)
            noise: cython.double = MORE_NOISE * ANGLE_NOISE * (fabs(x0) + fabs(y0) + wide + high)
            if fabs(y0) > noise:
                side = 1.0 if y0 > 0.0 else -1.0
                tall = noise * (fabs(y0) + high + 2.0 * fabs(x0))
                self.toward_zero[k, 0] = -side * along.imag / noise
                self.toward_zero[k, 1] = side * along.real / noise
                self.toward_zero[k, 2] = (fabs(y0) * apart.real - x0 * side * along.imag) / tall
                self.toward_zero[k, 3] = (fabs(y0) * apart.imag + x0 * side * along.real) / tall
            elif x0 < -noise and MORE_NOISE * fabs(y0) <= ANGLE_NOISE * fabs(x0):
                tall = MORE_NOISE * (high + 1e-15 * (wide + high)) / (0.1 * ANGLE_NOISE)
                if tall < 0.5 * wide:
                    self.toward_zero[k, 0] = self.toward_zero[k, 2] = apart.real / tall
                    self.toward_zero[k, 1] = self.toward_zero[k, 3] = apart.imag / tall
                else:
                    self.toward_zero[k, 0], self.toward_zero[k, 2] = along.imag / noise, -along.imag / noise
                    self.toward_zero[k, 1], self.toward_zero[k, 3] = -along.real / noise, along.real / noise


@cython.cfunc
@cython.exceptval(check=False)
def _dot(f: cython.doublecomplex, b: cython.doublecomplex) -> cython.double:
    """Return the real part of conj(f) b."""
    return f.real * b.real + f.imag * b.imag


@cython.cfunc
@cython.exceptval(check=False)
def _cross(f: cython.doublecomplex, b: cython.doublecomplex) -> cython.double:
    """Return the imaginary part of conj(f) b."""
    return f.real * b.imag - f.imag * b.real


@cython.cfunc
@cython.exceptval(check=False)
def _at(a: cython.double, b: cython.double, c: cython.double, t: cython.double) -> cython.double:
    """Return a coordinate of a curve at a time."""
    u: cython.double = 1.0 - t
    return u * u * a + 2.0 * u * t * b + t * t * c


@cython.cfunc
@cython.exceptval(check=False)
def _short_way(angle: cython.double) -> cython.double:
    """Bring a difference of two angles, in [-2 pi, 2 pi], into [-pi, pi]."""
    if angle > PI:
        return angle - TWO_PI
    if angle < -PI:
        return angle + TWO_PI
    return angle


@cython.cfunc
@cython.exceptval(check=False)
def _curve(p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> Curve:
    """Return the control points, eq (9), where both wires move on the way in and on the way out."""
    b0, f0, b1, f1 = p.back[i], p.fwd[i], q.back[j], q.fwd[j]
    return Curve(
        _dot(f0, b0),
        _cross(f0, b0),
        0.5 * (_dot(f1, b0) + _dot(f0, b1)),
        0.5 * (_cross(f1, b0) + _cross(f0, b1)),
        _dot(f1, b1),
        _cross(f1, b1),
    )


@cython.cfunc
@cython.exceptval(check=False)
def _is_beyond(q: Curve, t: cython.double, noise: cython.double) -> cython.int:
    """Return whether Q is right of the origin at a time within (0, 1): 1 if it is, -1 if rounding might decide."""
    if not 0.0 < t < 1.0:
        return 0
    x: cython.double = _at(q.x0, q.x1, q.x2, t)
    return -1 if fabs(x) <= noise else x > 0.0


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _meets_zero(q: Curve) -> cython.int:
    """Return whether theta reaches zero along Q: 1 or 0, or -1 where rounding might decide. At most one square root."""
    x0, y0, x1, y1, x2, y2 = q.x0, q.y0, q.x1, q.y1, q.x2, q.y2
    if x0 < 0.0 and x1 < 0.0 and x2 < 0.0:
        return 0
    noise: cython.double = ANGLE_NOISE * (fabs(x0) + fabs(x1) + fabs(x2))
    if (y0 > noise and y1 > noise and y2 > noise) or (y0 < -noise and y1 < -noise and y2 < -noise):
        return 0
    flat: cython.double = ANGLE_NOISE * (fabs(y0) + fabs(y1) + fabs(y2))
    if fabs(y0) <= flat or fabs(y2) <= flat:
        return -1
    b: cython.double = y1 - y0
    a: cython.double = y0 - 2.0 * y1 + y2
    discriminant: cython.double = b * b - a * y0
    if discriminant < 0.0:
        return 0
    if discriminant <= flat * flat:
        return -1
    big: cython.double = -b - sqrt(discriminant) if b > 0.0 else -b + sqrt(discriminant)
    first: cython.int = _is_beyond(q, y0 / big, noise)
    second: cython.int = _is_beyond(q, big / a, noise) if a != 0.0 else 0
    return 1 if first == 1 or second == 1 else min(first, second)


@cython.cfunc
@cython.exceptval(check=False)
def _into_run(p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> Turns:
    """Return the turns where q moves on the way in and rests on the way out; p moves on both.

    F1 := base of q, so Q1 is conj(F0) B1 to leading order. From Q0 to Q1 only B turns, then only F.
    """
    return Turns(_short_way(q.back_arg[j] - p.back_arg[i]), _short_way(p.fwd_arg[i] - q.base_arg[j]))


@cython.cfunc
@cython.exceptval(check=False)
def _out_of_run(p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> Turns:
    """Return the turns where q rests on the way in and moves on the way out; p moves on both.

    B1 := minus the base of q, so Q1 is conj(F1) B0 to leading order. First only F turns, then only B.
    """
    return Turns(
        _short_way(p.fwd_arg[i] - q.fwd_arg[j]),
        _short_way(_short_way(q.base_arg[j] + PI) - p.back_arg[i]),
    )


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _power(
    is_linear: cython.bint, k_b: cython.double, e_b: cython.double, change: cython.double
) -> cython.double:
    """Return the work of a change. Where there is no factor, the power may be infinite."""
    if is_linear:
        return k_b * change
    return k_b * pow(change, e_b) if k_b != 0.0 else 0.0


@cython.final
@cython.cclass
class Bending:
    """The work of bending: by turning, or along straight vertex paths, eq (17).

    By turning, which is not in the paper, an angle costs k_b |turn of p - turn of q|^e_b, and p_b where straight vertex
    paths take the angle through zero. Each end of a run of coincident vertices has half of the turn that the run's
    vertex has, as in section 2.2, and its inside has none. On the smoothed outline the factor is `k_smooth`.
    """

    by_turning: cython.bint
    k_b: cython.double
    m_b: cython.double
    e_b: cython.double
    p_b: cython.double
    k_smooth: cython.double

    def __init__(self, constants: WorkConstants, k_b: float, p_b: float, k_smooth: float = 0.0) -> None:
        self.by_turning = constants.bending == "turn"
        self.k_b, self.m_b, self.e_b, self.p_b = k_b, constants.m_b, constants.e_b, p_b
        self.k_smooth = k_smooth

    @cython.cfunc
    @cython.exceptval(check=False)
    def fill_motions(
        self,
        k_b: cython.double,
        p: Corners,
        i: cython.Py_ssize_t,
        q: Corners,
        j: cython.Py_ssize_t,
        work: cython.double[:, ::1],
        k: cython.Py_ssize_t,
    ) -> cython.void:
        """Fill in the work of the angle's motions at a dot."""
        work[k, EE] = self.inside_run(k_b, p, i, q, j)
        work[k, SS] = self.inside_run(k_b, q, j, p, i)
        work[k, ED] = self.at_run(k_b, p.theta[i], _out_of_run(p, i, q, j))
        work[k, DE] = self.at_run(k_b, p.theta[i], _into_run(p, i, q, j))
        work[k, SD] = self.at_run(k_b, q.theta[j], _out_of_run(q, j, p, i))
        work[k, DS] = self.at_run(k_b, q.theta[j], _into_run(q, j, p, i))
        work[k, DD] = self.moving(k_b, p, i, q, j)

    @cython.cfunc
    @cython.inline
    @cython.exceptval(check=False)
    def fill_turning(
        self,
        is_linear: cython.bint,
        stiffness: cython.double,
        p: Corners,
        q: Corners,
        column: Column,
        work: cython.double[:, ::1],
    ) -> cython.void:
        """Fill in the work of bending by turning at the dots of a column; it is linear where e_b is 1.

        Where both wires go on within half a round, in and out, no angle on the way between them is zero. Among
        coincident vertices on both sides of a dot, where the limit of the angle counts, it may still be.
        """
        cython.declare(k=cython.Py_ssize_t, x=cython.double, y=cython.double)
        i: cython.Py_ssize_t = column.i
        j: cython.Py_ssize_t = column.j
        n: cython.Py_ssize_t = q.turn.shape[0]
        e_b: cython.double = self.e_b
        p_b: cython.double = self.p_b
        k_b: cython.double = self.k_b * stiffness
        k_smooth: cython.double = self.k_smooth * stiffness
        turn: cython.double = p.turn[i]
        smooth: cython.double = p.smooth_turn[i]
        alone: cython.double = _power(is_linear, k_b, e_b, fabs(turn))
        smooth_alone: cython.double = _power(is_linear, k_smooth, e_b, fabs(smooth))
        heading, least, most = p.heading[i], p.least_turn[i], p.most_turn[i]
        base_x: cython.double = p.base[i].real
        base_y: cython.double = p.base[i].imag
        ux, uy, vx, vy = p.toward_zero[i, 0], p.toward_zero[i, 1], p.toward_zero[i, 2], p.toward_zero[i, 3]
        for k in range(column.first, column.beyond):
            other: cython.double = q.turn[j]
            ee: cython.double = alone
            ed: cython.double = _power(is_linear, k_b, e_b, fabs(turn - 0.5 * other))
            ss: cython.double = _power(is_linear, k_b, e_b, fabs(other))
            sd: cython.double = _power(is_linear, k_b, e_b, fabs(other - 0.5 * turn))
            dd: cython.double = _power(is_linear, k_b, e_b, fabs(turn - other))
            de, ds = ed, sd
            if p_b != 0.0:
                x, y = q.base[j].real, q.base[j].imag
                x, y = ux * x + uy * y, vx * x + vy * y
                x = min(x, y)
                ee += self.resting(p, i, q, j) if fabs(x) <= 1.0 else p_b * (x > 0.0)
                x = q.toward_zero[j, 0] * base_x + q.toward_zero[j, 1] * base_y
                y = q.toward_zero[j, 2] * base_x + q.toward_zero[j, 3] * base_y
                x = min(x, y)
                ss += self.resting(q, j, p, i) if fabs(x) <= 1.0 else p_b * (x > 0.0)
                x = _short_way(q.heading[j] - heading)
                if max(most, x + q.most_turn[j]) - min(least, x + q.least_turn[j]) >= PI - HALF_ROUND_NOISE:
                    ed += self.at_run(0.0, p.theta[i], _out_of_run(p, i, q, j))
                    de += self.at_run(0.0, p.theta[i], _into_run(p, i, q, j))
                    sd += self.at_run(0.0, q.theta[j], _out_of_run(q, j, p, i))
                    ds += self.at_run(0.0, q.theta[j], _into_run(q, j, p, i))
                    dd += self.moving(0.0, p, i, q, j)
            other = q.smooth_turn[j]
            x = _power(is_linear, k_smooth, e_b, fabs(smooth - 0.5 * other))
            y = _power(is_linear, k_smooth, e_b, fabs(other - 0.5 * smooth))
            # In the order of `steps.BENDS`, whose names the C compiler takes for variables: it would read them again.
            work[k, 0], work[k, 1], work[k, 2] = ee + smooth_alone, ed + x, de + x
            work[k, 3] = ss + _power(is_linear, k_smooth, e_b, fabs(other))
            work[k, 4], work[k, 5] = sd + y, ds + y
            work[k, 6] = dd + _power(is_linear, k_smooth, e_b, fabs(smooth - other))
            j += 1
            if j == n:
                j = 0

    @cython.cfunc
    @cython.exceptval(check=False)
    def resting(self, p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> cython.double:
        """Return what zero angles cost where q rests on the way in and on the way out."""
        base = q.base[j]
        x1: cython.double = _dot(base, p.apart[i])
        if p.ahead[i] < 0.0 and x1 < 0.0:
            return 0.0
        rests: cython.int = _meets_zero_inside(p.ahead[i], p.aside[i], x1, _cross(base, p.along[i]))
        return self.inside_run(0.0, p, i, q, j) if rests < 0 else rests * self.p_b

    @cython.cfunc
    @cython.exceptval(check=False)
    def of_motion(
        self,
        k_b: cython.double,
        theta: cython.double,
        s1: cython.double,
        s2: cython.double,
        s3: cython.double,
    ) -> cython.double:
        """Return the work of an angle that starts at theta and turns by s1, then s2, then s3: eq (17)."""
        work: cython.double = 0.0
        if k_b != 0.0:
            delta_theta: cython.double = fabs(s1 + s2 + s3)
            delta_theta_star: cython.double = 0.5 * (fabs(s1) + fabs(s2) + fabs(s3) - delta_theta)
            work = _power(self.e_b == 1.0, k_b, self.e_b, delta_theta + self.m_b * delta_theta_star)
        first: cython.double = theta + s1
        second: cython.double = first + s2
        third: cython.double = second + s3
        stays_above: cython.bint = min(theta, first, second, third) >= ANGLE_NOISE
        stays_below: cython.bint = max(theta, first, second, third) <= TWO_PI - ANGLE_NOISE
        return work if stays_above and stays_below else work + self.p_b

    @cython.cfunc
    @cython.exceptval(check=False)
    def at_run(self, k_b: cython.double, theta: cython.double, turns: Turns) -> cython.double:
        """Return the work of a motion beside coincident vertices (section 2.2): a half turn goes the cheaper way."""
        s1, s2 = turns.s1, turns.s2
        work: cython.double = self.of_motion(k_b, theta, s1, s2, 0.0)
        if work == 0.0:
            return work
        other1: cython.double = s1 if fabs(s1) <= HALF_TURN else s1 - TWO_PI if s1 > 0.0 else s1 + TWO_PI
        other2: cython.double = s2 if fabs(s2) <= HALF_TURN else s2 - TWO_PI if s2 > 0.0 else s2 + TWO_PI
        if other1 == s1 and other2 == s2:
            return work
        return min(
            work,
            self.of_motion(k_b, theta, other1, s2, 0.0),
            self.of_motion(k_b, theta, s1, other2, 0.0),
            self.of_motion(k_b, theta, other1, other2, 0.0),
        )

    @cython.cfunc
    @cython.exceptval(check=False)
    def moving(
        self, k_b: cython.double, p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t
    ) -> cython.double:
        """Return the work where both wires move on the way in and on the way out, along Q(t) from arg Q0 to arg Q2."""
        curve: Curve = _curve(p, i, q, j)
        meets: cython.int = _meets_zero(curve) if self.by_turning else -1
        if meets >= 0:
            return meets * self.p_b
        x0, y0, x1, y1, x2, y2 = curve.x0, curve.y0, curve.x1, curve.y1, curve.x2, curve.y2
        d0: cython.double = x0 * y1 - y0 * x1
        d1: cython.double = 0.5 * (x0 * y2 - y0 * x2)
        d2: cython.double = x1 * y2 - y1 * x2
        theta: cython.double = p.theta[i]
        net: cython.double = q.theta[j] - theta
        one_way: cython.bint = (d0 >= 0.0 and d1 >= 0.0 and d2 >= 0.0) or (
            d0 <= 0.0 and d1 <= 0.0 and d2 <= 0.0
        )
        if one_way and net * (d0 + d1 + d2) >= 0.0:  # the usual case, without a square root or an arc tangent
            return self.of_motion(k_b, theta, net, 0.0, 0.0)

        size0: cython.double = x0 * x0 + y0 * y0
        size1: cython.double = x1 * x1 + y1 * y1
        size2: cython.double = x2 * x2 + y2 * y2
        noise: cython.double = CROSS_NOISE * CROSS_NOISE * (size0 * size1 + size0 * size2 + size1 * size2)
        if d0 * d0 + d1 * d1 + d2 * d2 <= noise:
            return self.of_motion(k_b, theta, _short_way(net), 0.0, 0.0)

        # Ends of one sign with the middle control value of the other: two roots inside or none. Ends of
        # different sign, or one end 0 and the middle of the other sign: one root inside.
        two_roots: cython.bint = not one_way and d0 * d2 > 0.0
        discriminant: cython.double = d1 * d1 - d0 * d2
        if one_way or (two_roots and discriminant <= CROSS_NOISE * d1 * d1):
            # Monotonic: theta turns the way d points, if need be by more than pi.
            if net * (d0 + d1 + d2) < 0.0:
                net += TWO_PI if net < 0.0 else -TWO_PI
            return self.of_motion(k_b, theta, net, 0.0, 0.0)

        # With d = a t^2 + 2 b t + d0 the roots are big / a and d0 / big, big being the one of -b -+ root whose
        # terms cannot cancel.
        root: cython.double = sqrt(discriminant)
        b: cython.double = d1 - d0
        big: cython.double = -b - root if b > 0.0 else -b + root
        a: cython.double = d0 - 2.0 * d1 + d2
        t: cython.double = d0 / big
        if not 0.0 < t < 1.0 or (two_roots and big / a < t):  # of two roots the first
            t = big / a
        x: cython.double = _at(x0, x1, x2, t)
        y: cython.double = _at(y0, y1, y2, t)
        s1: cython.double = atan2(x0 * y - y0 * x, x0 * x + y0 * y)
        if not two_roots:
            return self.of_motion(k_b, theta, s1, _short_way(_short_way(net) - s1), 0.0)

        t = d0 / (a * t)  # the product of the roots is d0 / a
        x = _at(x0, x1, x2, t)
        y = _at(y0, y1, y2, t)
        s3: cython.double = atan2(x * y2 - y * x2, x * x2 + y * y2)
        return self.of_motion(k_b, theta, s1, _short_way(_short_way(_short_way(net) - s1) - s3), s3)

    @cython.cfunc
    @cython.exceptval(check=False)
    def inside_run(
        self, k_b: cython.double, p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t
    ) -> cython.double:
        """Return the work where q rests on the way in and on the way out, by the motion from Q0 to Q1 to Q2.

        F1 := base, B1 := minus base, so both products of Q1 are of one order: Q1 = conj(d) B0 - conj(F0) d. From there
        the angle only goes on to pi, the angle of Q2.
        """
        d, b, f = q.base[j], p.back[i], p.fwd[i]
        x1, y1 = _dot(d, b) - _dot(f, d), _cross(d, b) - _cross(f, d)
        theta: cython.double = p.theta[i]
        if x1 * x1 + y1 * y1 <= CROSS_NOISE * CROSS_NOISE * (
            _dot(b, b) + _dot(f, f)
        ):  # Q1 = 0 points nowhere
            return self.of_motion(k_b, theta, PI - theta, 0.0, 0.0)
        # The angle of Q1 is zero, whichever way it goes there.
        if k_b == 0.0 and fabs(y1) <= 0.1 * ANGLE_NOISE * x1:
            return self.p_b
        theta1: cython.double = atan2(y1, x1)
        if theta1 < 0.0:
            theta1 += TWO_PI
        return self.at_run(k_b, theta, Turns(_short_way(theta1 - theta), _short_way(PI - theta1)))


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _meets_zero_inside(
    x0: cython.double, y0: cython.double, x1: cython.double, y1: cython.double
) -> cython.int:
    """Return whether the way from Q0 to Q1 passes right of the origin: 1 or 0, or -1 where rounding might decide.

    Q1 is that of `Bending.inside_run`.
    """
    below0: cython.double = fabs(y0)
    below1: cython.double = fabs(y1)
    right: cython.double = x0 * below1 + x1 * below0
    noise: cython.double = ANGLE_NOISE * (fabs(x0) + below0 + fabs(x1) + below1)
    # Where rounding decides nothing, which is usual, the signs are random: no branches.
    if min(below0, below1) > noise and fabs(right) > noise * (below0 + below1):
        return (right > 0.0) & ((y0 > 0.0) != (y1 > 0.0))
    if x0 < 0.0 and x1 < 0.0:
        return 0
    if (y0 > noise and y1 > noise) or (y0 < -noise and y1 < -noise):
        return 0
    if fabs(y1) > noise >= fabs(y0) and x0 < -noise:  # it begins or ends left of the origin
        return 0
    if fabs(y0) > noise >= fabs(y1) and x1 < -noise:
        return 0
    return -1


def fill_bends(
    p: Corners,
    q: Corners,
    bending: Bending,
    columns: IntArray,
    weight: FloatArray,
    window: Window,
    bends: FloatArray,
) -> None:
    """Fill in the work of the seven bends at every dot of a window.

    Parameters
    ----------
    p, q : Corners
        Of the first wire and the second.
    bending : Bending
    columns : (columns,) int
        Vertices of the first wire, one for each column; rows are vertices of the second, modulo n.
    weight : (columns,) float
        Multiplies k_b there.
    window : Window
    bends : (dots, 7) float
    """
    vertices: cython.Py_ssize_t[::1] = columns
    stiffness: cython.double[::1] = weight
    low: cython.Py_ssize_t[::1] = window.low
    high: cython.Py_ssize_t[::1] = window.high
    column_offset: cython.Py_ssize_t[::1] = window.column_offset
    work: cython.double[:, ::1] = bends
    n: cython.Py_ssize_t = q.turn.shape[0]
    cython.declare(c=cython.Py_ssize_t, i=cython.Py_ssize_t, j=cython.Py_ssize_t)
    cython.declare(k=cython.Py_ssize_t, first=cython.Py_ssize_t)
    for c in range(vertices.shape[0]):
        if c % 8 == 0:
            look_for_signals()
        i, j, first = vertices[c], low[c] % n, column_offset[c]
        beyond: cython.Py_ssize_t = first + high[c] - low[c] + 1
        if bending.by_turning:
            if bending.e_b == 1.0:
                bending.fill_turning(True, stiffness[c], p, q, Column(i, j, first, beyond), work)
            else:
                bending.fill_turning(False, stiffness[c], p, q, Column(i, j, first, beyond), work)
            continue
        for k in range(first, beyond):
            bending.fill_motions(bending.k_b * stiffness[c], p, i, q, j, work, k)
            j += 1
            if j == n:
                j = 0
