# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""How an angle moves during a blend, and what bending it costs.

Sections 2.1, 2.2 and 3.2 of Sederberg and Greenwood, "A Physically Based Approach to 2-D Shape
Blending", Computer Graphics 26(2), 1992 (SIGGRAPH '92). This file is compiled by Cython and runs
uncompiled as well.

Symbols
-------
``B``, ``F`` (`back`, `fwd`): edge vectors from a vertex to the vertices before and after it; subscript
0 for the first wire, 1 for the second. ``Q(t) = conj(F(t)) B(t)`` is eqs (6)-(9) as one complex
product, so ``theta(t) = arg Q(t)`` in [0, 2 pi). ``d(t)``, eq (10), has the sign of theta's velocity.

The motion of theta is cut at its extrema into monotonic pieces. A piece that lies between two roots of
d turns by less than pi, so its signed turn s is the angle between its ends; only a motion without a
root can turn further, and then the sign of d says which way round it goes. That is eq (11) without a
triangle test. With the turns s1, s2, ... of the pieces:

* ``delta_theta = |s1 + s2 + ...|``,
* ``delta_theta_star``, the way travelled against the net direction (figure 18), is
  ``(|s1| + |s2| + ... - delta_theta) / 2``,
* theta reaches zero when theta0, theta0 + s1, ... leaves the open interval (0, 2 pi).

Departures
----------
* Section 2.2 gives the end angles of coincident vertices; the motion in between is the limit of an
  infinitesimal isosceles triangle. Of ``Q1`` the leading order is kept, and the motion has exactly the
  pieces Q0 -> Q1 -> Q2. There is no epsilon.
* An edge that shrinks through nothing and grows out the other side turns by exactly pi, either way
  round. Where that happens beside coincident vertices the cheaper way is taken.
* Where ``Q0``, ``Q1`` and ``Q2`` lie on one line through the origin, d vanishes and says nothing: theta
  goes the short way.
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
    from cython.cimports.libc.math import atan2, fabs, pow, sqrt
else:
    from math import atan2, fabs, pow, sqrt

if TYPE_CHECKING:
    from shapeblend_cli.matching.tables import Window
    from shapeblend_cli.model import ComplexArray, FloatArray, IntArray

COMPILED = cython.compiled

PI = cython.declare(cython.double, 3.141592653589793)
TWO_PI = cython.declare(cython.double, 6.283185307179586)

# An angle this near to 0 or 2 pi is zero, and a turn this near to pi is a half turn: far above what
# rounding does to the angle between two edges, far below what can be seen.
ANGLE_NOISE = cython.declare(cython.double, 1e-9)

# d is nothing but rounding when it is this small beside the products it is the difference of.
CROSS_NOISE = cython.declare(cython.double, 1e-12)

cython.declare(EE=cython.int, ED=cython.int, DE=cython.int, SS=cython.int)
cython.declare(SD=cython.int, DS=cython.int, DD=cython.int)
EE, ED, DE, SS, SD, DS, DD = steps.BENDS

# The control points Q0, Q1 and Q2 of Q(t).
Curve = cython.struct(
    x0=cython.double, y0=cython.double, x1=cython.double, y1=cython.double, x2=cython.double, y2=cython.double
)


@cython.cclass
class Corners:
    """The angles at the vertices of a wire.

    Parameters
    ----------
    vertices : (m,) complex
        No two neighbours are equal. m >= 2 when open, >= 3 when closed.
    closed : bool
        An open wire goes straight on beyond its ends: the missing edge of an end vertex is the other one
        reversed, so a run of coincident vertices on it lies along the wire.

    Attributes
    ----------
    theta : (m,) float
        The angle arg(conj(F) B) in [0, 2 pi).
    back, fwd : (m,) complex
        B and F.
    base : (m,) complex
        The direction of the base on which coincident vertices lie (section 2.2), B turned by
        -(90 degrees + theta / 2).
    back_arg, fwd_arg, base_arg : (m,) float
        Their angles in [-pi, pi].
    """

    theta = cython.declare(cython.double[::1], visibility="readonly")
    back = cython.declare(cython.doublecomplex[::1], visibility="readonly")
    fwd = cython.declare(cython.doublecomplex[::1], visibility="readonly")
    base = cython.declare(cython.doublecomplex[::1], visibility="readonly")
    back_arg: cython.double[::1]
    fwd_arg: cython.double[::1]
    base_arg: cython.double[::1]

    def __init__(self, vertices: ComplexArray, closed: bool) -> None:
        fwd = np.roll(vertices, -1) - vertices
        back = np.roll(vertices, 1) - vertices
        if not closed:
            last = len(vertices) - 1
            fwd[last] = -back[last]
            back[0] = -fwd[0]
        theta = np.angle(fwd.conj() * back)
        theta = np.where(theta < 0.0, theta + 2.0 * np.pi, theta)
        base = back / np.abs(back) * np.exp(-1j * (0.5 * np.pi + 0.5 * theta))
        self.theta, self.back, self.fwd, self.base = theta, back, fwd, base
        self.back_arg, self.fwd_arg, self.base_arg = np.angle(back), np.angle(fwd), np.angle(base)

    def sharpness(self) -> FloatArray:
        """Return how far each angle is from straight, radians."""
        return np.abs(np.asarray(self.theta) - np.pi)


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _short_way(angle: cython.double) -> cython.double:
    """Bring a difference of two angles, in [-2 pi, 2 pi], into [-pi, pi]."""
    if angle > PI:
        return angle - TWO_PI
    if angle < -PI:
        return angle + TWO_PI
    return angle


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _is_zero(theta: cython.double) -> cython.bint:
    """Whether an unwrapped angle has left (0, 2 pi)."""
    return theta < ANGLE_NOISE or theta > TWO_PI - ANGLE_NOISE


@cython.final
@cython.cclass
class Bending:
    """What an angle costs, eq (17), with the constants of `constants.WorkConstants`.

    A dot takes one of four methods, by which wires move on the way in and on the way out; the others are the same with
    the wires exchanged. Another kind of bending has the same four.
    """

    k_b: cython.double
    m_b: cython.double
    e_b: cython.double
    p_b: cython.double

    def __init__(
        self, k_b: cython.double, m_b: cython.double, e_b: cython.double, p_b: cython.double
    ) -> None:
        self.k_b = k_b
        self.m_b = m_b
        self.e_b = e_b
        self.p_b = p_b

    @cython.cfunc
    @cython.exceptval(check=False)
    def _of_turns(
        self, theta: cython.double, s1: cython.double, s2: cython.double, s3: cython.double
    ) -> cython.double:
        """Bending work, eq (17), of an angle that starts at theta and turns by s1, then s2, then s3."""
        delta_theta: cython.double = fabs(s1 + s2 + s3)
        delta_theta_star: cython.double = 0.5 * (fabs(s1) + fabs(s2) + fabs(s3) - delta_theta)
        work: cython.double = delta_theta + self.m_b * delta_theta_star
        if self.e_b != 1.0:
            work = pow(work, self.e_b)
        work *= self.k_b
        if (
            _is_zero(theta)
            or _is_zero(theta + s1)
            or _is_zero(theta + s1 + s2)
            or _is_zero(theta + s1 + s2 + s3)
        ):
            work += self.p_b
        return work

    @cython.cfunc
    @cython.exceptval(check=False)
    def _along(self, theta0: cython.double, theta2: cython.double, q: Curve) -> cython.double:
        """Bending work along Q(t) from theta0 to theta2."""
        x0, y0, x1, y1, x2, y2 = q.x0, q.y0, q.x1, q.y1, q.x2, q.y2  # type: ignore[attr-defined]
        d0: cython.double = x0 * y1 - y0 * x1
        d1: cython.double = 0.5 * (x0 * y2 - y0 * x2)
        d2: cython.double = x1 * y2 - y1 * x2
        net: cython.double = theta2 - theta0
        one_way: cython.bint = (d0 >= 0.0 and d1 >= 0.0 and d2 >= 0.0) or (
            d0 <= 0.0 and d1 <= 0.0 and d2 <= 0.0
        )
        if one_way and net * (d0 + d1 + d2) >= 0.0:  # the usual case, without a square root or an arc tangent
            return self._of_turns(theta0, net, 0.0, 0.0)

        size0: cython.double = x0 * x0 + y0 * y0
        size1: cython.double = x1 * x1 + y1 * y1
        size2: cython.double = x2 * x2 + y2 * y2
        noise: cython.double = CROSS_NOISE * CROSS_NOISE * (size0 * size1 + size0 * size2 + size1 * size2)
        if d0 * d0 + d1 * d1 + d2 * d2 <= noise:
            return self._of_turns(theta0, _short_way(net), 0.0, 0.0)

        # Ends of one sign with the middle control value of the other: two roots inside or none. Ends of
        # different sign, or one end 0 and the middle of the other sign: one root inside.
        two_roots: cython.bint = not one_way and d0 * d2 > 0.0
        discriminant: cython.double = d1 * d1 - d0 * d2
        if one_way or (two_roots and discriminant <= CROSS_NOISE * d1 * d1):
            # Monotonic: theta turns the way d points, if need be by more than pi.
            if net * (d0 + d1 + d2) < 0.0:
                net += TWO_PI if net < 0.0 else -TWO_PI
            return self._of_turns(theta0, net, 0.0, 0.0)

        # With d = a t^2 + 2 b t + d0 the roots are big / a and d0 / big, big being the one of -b -+ root whose
        # terms cannot cancel.
        root: cython.double = sqrt(discriminant)
        b: cython.double = d1 - d0
        big: cython.double = -b - root if b > 0.0 else -b + root
        a: cython.double = d0 - 2.0 * d1 + d2
        t: cython.double = d0 / big
        if not 0.0 < t < 1.0 or (two_roots and big / a < t):  # of two roots the first
            t = big / a
        u: cython.double = 1.0 - t
        x: cython.double = u * u * x0 + 2.0 * u * t * x1 + t * t * x2
        y: cython.double = u * u * y0 + 2.0 * u * t * y1 + t * t * y2
        s1: cython.double = atan2(x0 * y - y0 * x, x0 * x + y0 * y)
        if not two_roots:
            return self._of_turns(theta0, s1, _short_way(_short_way(net) - s1), 0.0)

        t = d0 / (a * t)  # the product of the roots is d0 / a
        u = 1.0 - t
        x = u * u * x0 + 2.0 * u * t * x1 + t * t * x2
        y = u * u * y0 + 2.0 * u * t * y1 + t * t * y2
        s3: cython.double = atan2(x * y2 - y * x2, x * x2 + y * y2)
        s2: cython.double = _short_way(_short_way(_short_way(net) - s1) - s3)
        return self._of_turns(theta0, s1, s2, s3)

    @cython.cfunc
    @cython.exceptval(check=False)
    def _at_run(self, theta: cython.double, s1: cython.double, s2: cython.double) -> cython.double:
        """Bending work of the pieces Q0 -> Q1 -> Q2 beside coincident vertices (section 2.2).

        A half turn takes the cheaper direction.
        """
        work: cython.double = self._of_turns(theta, s1, s2, 0.0)
        half1: cython.bint = fabs(s1) > PI - ANGLE_NOISE
        half2: cython.bint = fabs(s2) > PI - ANGLE_NOISE
        other1: cython.double = s1 - TWO_PI if s1 > 0.0 else s1 + TWO_PI
        other2: cython.double = s2 - TWO_PI if s2 > 0.0 else s2 + TWO_PI
        if half1:
            work = min(work, self._of_turns(theta, other1, s2, 0.0))
        if half2:
            work = min(work, self._of_turns(theta, s1, other2, 0.0))
        if half1 and half2:
            work = min(work, self._of_turns(theta, other1, other2, 0.0))
        return work

    @cython.cfunc
    @cython.exceptval(check=False)
    def moving(self, p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> cython.double:
        """Bend where both wires move on the way in and on the way out: eqs (7)-(9)."""
        b0x, b0y = p.back[i].real, p.back[i].imag
        f0x, f0y = p.fwd[i].real, p.fwd[i].imag
        b1x, b1y = q.back[j].real, q.back[j].imag
        f1x, f1y = q.fwd[j].real, q.fwd[j].imag
        curve: Curve = Curve(
            f0x * b0x + f0y * b0y,
            f0x * b0y - f0y * b0x,
            0.5 * ((f1x * b0x + f1y * b0y) + (f0x * b1x + f0y * b1y)),
            0.5 * ((f1x * b0y - f1y * b0x) + (f0x * b1y - f0y * b1x)),
            f1x * b1x + f1y * b1y,
            f1x * b1y - f1y * b1x,
        )
        return self._along(p.theta[i], q.theta[j], curve)

    @cython.cfunc
    @cython.exceptval(check=False)
    def into_run(self, p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> cython.double:
        """Bend where q moves on the way in and rests on the way out; p moves on both.

        F1 := base of q, so Q1 is conj(F0) B1 to leading order. From Q0 to Q1 only B turns, then only F.
        """
        s1: cython.double = _short_way(q.back_arg[j] - p.back_arg[i])
        s2: cython.double = _short_way(p.fwd_arg[i] - q.base_arg[j])
        return self._at_run(p.theta[i], s1, s2)

    @cython.cfunc
    @cython.exceptval(check=False)
    def out_of_run(self, p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> cython.double:
        """Bend where q rests on the way in and moves on the way out; p moves on both.

        B1 := minus the base of q, so Q1 is conj(F1) B0 to leading order. First only F turns, then only B.
        """
        s1: cython.double = _short_way(p.fwd_arg[i] - q.fwd_arg[j])
        s2: cython.double = _short_way(_short_way(q.base_arg[j] + PI) - p.back_arg[i])
        return self._at_run(p.theta[i], s1, s2)

    @cython.cfunc
    @cython.exceptval(check=False)
    def inside_run(self, p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> cython.double:
        """Bend where q rests on the way in and on the way out: its angle there is pi.

        F1 := base, B1 := minus base, so both products of Q1 are of one order: Q1 = conj(d) B0 - conj(F0) d.
        """
        dx, dy = q.base[j].real, q.base[j].imag
        b0x, b0y = p.back[i].real, p.back[i].imag
        f0x, f0y = p.fwd[i].real, p.fwd[i].imag
        x1: cython.double = (dx * b0x + dy * b0y) - (f0x * dx + f0y * dy)
        y1: cython.double = (dx * b0y - dy * b0x) - (f0x * dy - f0y * dx)
        theta: cython.double = p.theta[i]
        longest: cython.double = b0x * b0x + b0y * b0y + f0x * f0x + f0y * f0y
        if x1 * x1 + y1 * y1 <= CROSS_NOISE * CROSS_NOISE * longest:  # Q1 = 0 points nowhere
            return self._of_turns(theta, PI - theta, 0.0, 0.0)
        theta1: cython.double = atan2(y1, x1)
        if theta1 < 0.0:
            theta1 += TWO_PI
        return self._at_run(theta, _short_way(theta1 - theta), _short_way(PI - theta1))


def fill_bends(
    p: Corners,
    q: Corners,
    bending: Bending,
    columns: IntArray,
    weight: FloatArray,
    window: Window,
    bends: FloatArray,
) -> None:
    """Price the seven bends of every dot of a window.

    Parameters
    ----------
    p, q : Corners
        Of the first wire and the second.
    bending : Bending
    columns : (columns,) int
        The vertex of the first wire that each column is; rows are those of the second, modulo n.
    weight : (columns,) float
        Multiplies k_b there.
    window : Window
    bends : (dots, 7) float
        Overwritten.
    """
    vertices: cython.Py_ssize_t[::1] = columns
    stiffness: cython.double[::1] = weight
    low: cython.Py_ssize_t[::1] = window.low
    high: cython.Py_ssize_t[::1] = window.high
    column_offset: cython.Py_ssize_t[::1] = window.column_offset
    work: cython.double[:, ::1] = bends
    n: cython.Py_ssize_t = q.theta.shape[0]
    c: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    for c in range(vertices.shape[0]):
        i = vertices[c]
        j = low[c] % n
        stiff: Bending = Bending(bending.k_b * stiffness[c], bending.m_b, bending.e_b, bending.p_b)
        for k in range(column_offset[c], column_offset[c] + high[c] - low[c] + 1):
            work[k, EE] = stiff.inside_run(p, i, q, j)
            work[k, ED] = stiff.out_of_run(p, i, q, j)
            work[k, DE] = stiff.into_run(p, i, q, j)
            work[k, SS] = stiff.inside_run(q, j, p, i)
            work[k, SD] = stiff.out_of_run(q, j, p, i)
            work[k, DS] = stiff.into_run(q, j, p, i)
            work[k, DD] = stiff.moving(p, i, q, j)
            j += 1
            if j == n:
                j = 0


def angle_change(q0: complex, q1: complex, q2: complex) -> tuple[float, float, bool]:
    """Return delta theta and delta theta* in radians, and whether theta reaches zero, along a Q curve (section 2.1).

    Neither end of the control points, eq (9), is 0.

    Examples
    --------
    From 10 degrees over 170 and 190 to 350, never through zero: further than 180 (figure 17).

    >>> from cmath import rect
    >>> from math import degrees, radians
    >>> ends = [rect(1, radians(a)) for a in (10, 180, 350)]
    >>> delta, star, zero = angle_change(*ends)
    >>> round(degrees(delta), 6), round(star, 6), zero
    (340.0, 0.0, False)
    """
    theta0: cython.double = atan2(q0.imag, q0.real)
    theta2: cython.double = atan2(q2.imag, q2.real)
    if theta0 < 0.0:
        theta0 += TWO_PI
    if theta2 < 0.0:
        theta2 += TWO_PI
    curve: Curve = Curve(q0.real, q0.imag, q1.real, q1.imag, q2.real, q2.imag)
    work = [
        Bending(k_b, m_b, 1.0, p_b)._along(theta0, theta2, curve)
        for k_b, m_b, p_b in ((1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    ]
    return work[0], work[1] - work[0], work[2] > 0.0
