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
* What an angle costs is, unless the paper's bending is asked for, a change of turning: `TurnBending`.
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

# Directions this much less than half a round apart are certainly on one side.
HALF_ROUND_NOISE = cython.declare(cython.double, 1e-6)

# d is nothing but rounding when it is this small beside the products it is the difference of.
CROSS_NOISE = cython.declare(cython.double, 1e-12)

cython.declare(EE=cython.int, ED=cython.int, DE=cython.int, SS=cython.int)
cython.declare(SD=cython.int, DS=cython.int, DD=cython.int)
EE, ED, DE, SS, SD, DS, DD = steps.BENDS

# The control points Q0, Q1 and Q2 of Q(t).
Curve = cython.struct(
    x0=cython.double, y0=cython.double, x1=cython.double, y1=cython.double, x2=cython.double, y2=cython.double
)

# The signed turns of theta from Q0 to Q1 and from there to Q2.
Turns = cython.struct(first=cython.double, second=cython.double)


def _arg(z: ComplexArray) -> FloatArray:
    """Return angles in [-pi, pi]."""
    return np.arctan2(z.imag, z.real)


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
    turn : (m,) float
        How far the wire turns there, pi - theta, in (-pi, pi].
    back, fwd : (m,) complex
        B and F.
    base : (m,) complex
        The direction of the base on which coincident vertices lie (section 2.2), B turned by
        -(90 degrees + theta / 2).
    back_arg, fwd_arg, base_arg : (m,) float
        Their angles in [-pi, pi].
    heading : (m,) float
        The angle of -B, the way in, in [-pi, pi]; the way out is this and the turn.
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

    def __init__(self, vertices: ComplexArray, closed: bool) -> None:
        last = len(vertices) - 1
        fwd = np.concatenate([vertices[1:], vertices[:1]]) - vertices
        back = np.concatenate([vertices[last:], vertices[:last]]) - vertices
        if not closed:
            fwd[last] = -back[last]
            back[0] = -fwd[0]
        theta = _arg(fwd.conj() * back)
        theta = np.where(theta < 0.0, theta + 2.0 * np.pi, theta)
        base = back / np.abs(back) * np.exp(-1j * (0.5 * np.pi + 0.5 * theta))
        self.theta, self.turn = theta, np.pi - theta
        self.back, self.fwd, self.base = back, fwd, base
        self.back_arg, self.fwd_arg, self.base_arg = _arg(back), _arg(fwd), _arg(base)
        self.heading = _arg(-back)

    def sharpness(self) -> FloatArray:
        """Return how far each angle is from straight, radians."""
        return np.abs(self.turn)


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


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _all_ahead(
    heading0: cython.double, turn0: cython.double, heading1: cython.double, turn1: cython.double
) -> cython.bint:
    """Whether both wires go on within half a round, in and out: no angle on the way between them is then zero.

    Among coincident vertices on both sides of a dot, where the limit of the angle counts, it may still be.
    """
    ahead: cython.double = _short_way(heading1 - heading0)
    low: cython.double = min(0.0, turn0, ahead, ahead + turn1)
    high: cython.double = max(0.0, turn0, ahead, ahead + turn1)
    return high - low < PI - HALF_ROUND_NOISE


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _control_points(p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> Curve:
    """Return the control points, eq (9), where both wires move on the way in and on the way out."""
    b0x, b0y = p.back[i].real, p.back[i].imag
    f0x, f0y = p.fwd[i].real, p.fwd[i].imag
    b1x, b1y = q.back[j].real, q.back[j].imag
    f1x, f1y = q.fwd[j].real, q.fwd[j].imag
    return Curve(
        f0x * b0x + f0y * b0y,
        f0x * b0y - f0y * b0x,
        0.5 * ((f1x * b0x + f1y * b0y) + (f0x * b1x + f0y * b1y)),
        0.5 * ((f1x * b0y - f1y * b0x) + (f0x * b1y - f0y * b1x)),
        f1x * b1x + f1y * b1y,
        f1x * b1y - f1y * b1x,
    )


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _turns_into_run(p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> Turns:
    """Return the turns where q moves on the way in and rests on the way out.

    F1 := base of q, so Q1 is conj(F0) B1 to leading order. From Q0 to Q1 only B turns, then only F.
    """
    return Turns(_short_way(q.back_arg[j] - p.back_arg[i]), _short_way(p.fwd_arg[i] - q.base_arg[j]))


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _turns_out_of_run(p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> Turns:
    """Return the turns where q rests on the way in and moves on the way out.

    B1 := minus the base of q, so Q1 is conj(F1) B0 to leading order. First only F turns, then only B.
    """
    return Turns(
        _short_way(p.fwd_arg[i] - q.fwd_arg[j]),
        _short_way(_short_way(q.base_arg[j] + PI) - p.back_arg[i]),
    )


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _inside_run(p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> Curve:
    """Return Q0 and Q1 where q rests on the way in and on the way out; Q2 is -1, since its angle is pi.

    F1 := base, B1 := minus base, so both products of Q1 are of one order: Q1 = conj(d) B0 - conj(F0) d.
    """
    dx, dy = q.base[j].real, q.base[j].imag
    b0x, b0y = p.back[i].real, p.back[i].imag
    f0x, f0y = p.fwd[i].real, p.fwd[i].imag
    return Curve(
        f0x * b0x + f0y * b0y,
        f0x * b0y - f0y * b0x,
        (dx * b0x + dy * b0y) - (f0x * dx + f0y * dy),
        (dx * b0y - dy * b0x) - (f0x * dy - f0y * dx),
        -1.0,
        0.0,
    )


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _stays_off_zero(q: Curve) -> cython.bint:
    """Whether the control points alone say that theta does not reach zero: all left, above or below."""
    x0, y0, x1, y1, x2, y2 = q.x0, q.y0, q.x1, q.y1, q.x2, q.y2  # type: ignore[attr-defined]
    if x0 < 0.0 and x1 < 0.0 and x2 < 0.0:
        return True
    noise: cython.double = ANGLE_NOISE * (fabs(x0) + fabs(x1) + fabs(x2))
    if y0 > noise and y1 > noise:
        return y2 > noise or (y2 == 0.0 and x2 < 0.0)
    if y0 < -noise and y1 < -noise:
        return y2 < -noise or (y2 == 0.0 and x2 < 0.0)
    return False


@cython.cfunc
@cython.inline
@cython.exceptval(check=False)
def _side_of_crossing(q: Curve, t: cython.double) -> cython.int:
    """Return where Q crosses the real axis at time t: 1 on the right, -1 on the left or not within (0, 1), 0 at 0."""
    if not 0.0 < t < 1.0:
        return -1
    x0, x1, x2 = q.x0, q.x1, q.x2  # type: ignore[attr-defined]
    u: cython.double = 1.0 - t
    x: cython.double = u * u * x0 + 2.0 * u * t * x1 + t * t * x2
    if fabs(x) <= ANGLE_NOISE * (fabs(x0) + fabs(x1) + fabs(x2)):
        return 0
    return 1 if x > 0.0 else -1


@cython.cfunc
@cython.exceptval(check=False)
def _reaches_zero(q: Curve) -> cython.int:
    """Whether theta reaches zero along Q: 1 or 0, or -1 where rounding might decide. One square root at the most."""
    y0, y1, y2 = q.y0, q.y1, q.y2  # type: ignore[attr-defined]
    if _stays_off_zero(q):
        return 0
    noise: cython.double = ANGLE_NOISE * (fabs(y0) + fabs(y1) + fabs(y2))
    if fabs(y0) <= noise or fabs(y2) <= noise:
        return -1
    b: cython.double = y1 - y0
    a: cython.double = y0 - 2.0 * y1 + y2
    discriminant: cython.double = b * b - a * y0
    if discriminant < 0.0:
        return 0
    if discriminant <= noise * noise:
        return -1
    big: cython.double = -b - sqrt(discriminant) if b > 0.0 else -b + sqrt(discriminant)
    first: cython.int = _side_of_crossing(q, y0 / big)
    second: cython.int = _side_of_crossing(q, big / a) if a != 0.0 else -1
    if first == 1 or second == 1:
        return 1
    return -1 if first == 0 or second == 0 else 0


@cython.cclass
class Bending:
    """What an angle costs."""

    @cython.cfunc
    def add_column(
        self,
        p: Corners,
        i: cython.Py_ssize_t,
        q: Corners,
        j: cython.Py_ssize_t,
        weight: cython.double,
        work: cython.double[:, ::1],
    ) -> None:
        """Add the seven bends of dots i, j and i, j + 1 and so on to the rows of `work`, k_b times a weight."""


@cython.final
@cython.cclass
class PaperBending(Bending):
    """Bending along straight vertex paths, eq (17), with constants of `constants.WorkConstants`."""

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
    def _at_run(self, theta: cython.double, turns: Turns) -> cython.double:
        """Bending work of the pieces Q0 -> Q1 -> Q2 beside coincident vertices (section 2.2).

        A half turn takes the cheaper direction.
        """
        s1, s2 = turns.first, turns.second  # type: ignore[attr-defined]
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
        """Bend where both wires move on the way in and on the way out."""
        return self._along(p.theta[i], q.theta[j], _control_points(p, i, q, j))

    @cython.cfunc
    @cython.exceptval(check=False)
    def into_run(self, p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> cython.double:
        """Bend where q moves on the way in and rests on the way out; p moves on both."""
        return self._at_run(p.theta[i], _turns_into_run(p, i, q, j))

    @cython.cfunc
    @cython.exceptval(check=False)
    def out_of_run(self, p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> cython.double:
        """Bend where q rests on the way in and moves on the way out; p moves on both."""
        return self._at_run(p.theta[i], _turns_out_of_run(p, i, q, j))

    @cython.cfunc
    @cython.exceptval(check=False)
    def inside_run(self, p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t) -> cython.double:
        """Bend where q rests on the way in and on the way out."""
        curve: Curve = _inside_run(p, i, q, j)
        x1, y1 = curve.x1, curve.y1  # type: ignore[attr-defined]
        theta: cython.double = p.theta[i]
        b0x, b0y = p.back[i].real, p.back[i].imag
        f0x, f0y = p.fwd[i].real, p.fwd[i].imag
        longest: cython.double = b0x * b0x + b0y * b0y + f0x * f0x + f0y * f0y
        if x1 * x1 + y1 * y1 <= CROSS_NOISE * CROSS_NOISE * longest:  # Q1 = 0 points nowhere
            return self._of_turns(theta, PI - theta, 0.0, 0.0)
        theta1: cython.double = atan2(y1, x1)
        if theta1 < 0.0:
            theta1 += TWO_PI
        return self._at_run(theta, Turns(_short_way(theta1 - theta), _short_way(PI - theta1)))

    @cython.cfunc
    def add_column(
        self,
        p: Corners,
        i: cython.Py_ssize_t,
        q: Corners,
        j: cython.Py_ssize_t,
        weight: cython.double,
        work: cython.double[:, ::1],
    ) -> None:
        """See `Bending`. A bend that is not here is one of these with the wires exchanged."""
        bend: PaperBending = PaperBending(self.k_b * weight, self.m_b, self.e_b, self.p_b)
        k: cython.Py_ssize_t
        for k in range(work.shape[0]):
            work[k, EE] += bend.inside_run(p, i, q, j)
            work[k, ED] += bend.out_of_run(p, i, q, j)
            work[k, DE] += bend.into_run(p, i, q, j)
            work[k, SS] += bend.inside_run(q, j, p, i)
            work[k, SD] += bend.out_of_run(q, j, p, i)
            work[k, DS] += bend.into_run(q, j, p, i)
            work[k, DD] += bend.moving(p, i, q, j)
            j += 1
            if j == q.theta.shape[0]:
                j = 0


@cython.final
@cython.cclass
class TurnBending(Bending):
    """Bending by turning: k_b |turn of p - turn of q|^e_b, and p_b where a straight path takes the angle through zero.

    Not in the paper. Each end of a run of coincident vertices has half of the turn that the run's vertex has, as in
    section 2.2, and its inside has none. Whether an angle reaches zero is left to the paper's bending, and it is asked
    only where headings and turns do not exclude it.
    """

    k_b: cython.double
    e_b: cython.double
    p_b: cython.double
    zero: PaperBending

    def __init__(self, k_b: cython.double, e_b: cython.double, p_b: cython.double) -> None:
        self.k_b = k_b
        self.e_b = e_b
        self.p_b = p_b
        self.zero = PaperBending(0.0, 0.0, 1.0, p_b)

    @cython.cfunc
    @cython.inline
    @cython.exceptval(check=False)
    def _of_change(self, turn: cython.double, weight: cython.double) -> cython.double:
        """Bending work of a change of turn."""
        work: cython.double = fabs(turn)
        if self.e_b != 1.0:
            work = pow(work, self.e_b)
        return self.k_b * weight * work

    @cython.cfunc
    def add_column(
        self,
        p: Corners,
        i: cython.Py_ssize_t,
        q: Corners,
        j: cython.Py_ssize_t,
        weight: cython.double,
        work: cython.double[:, ::1],
    ) -> None:
        """See `Bending`."""
        has_price: cython.bint = self.p_b != 0.0
        turn: cython.double = p.turn[i]
        alone: cython.double = self._of_change(turn, weight)
        k: cython.Py_ssize_t
        for k in range(work.shape[0]):
            other: cython.double = q.turn[j]
            other_alone: cython.double = self._of_change(other, weight)
            beside: cython.double = self._of_change(turn - 0.5 * other, weight)
            other_beside: cython.double = self._of_change(other - 0.5 * turn, weight)
            work[k, EE] += alone
            work[k, ED] += beside
            work[k, DE] += beside
            work[k, SS] += other_alone
            work[k, SD] += other_beside
            work[k, DS] += other_beside
            work[k, DD] += self._of_change(turn - other, weight)
            if has_price:
                if not _stays_off_zero(_inside_run(p, i, q, j)):
                    work[k, EE] += self._price_inside_run(p, i, q, j)
                if not _stays_off_zero(_inside_run(q, j, p, i)):
                    work[k, SS] += self._price_inside_run(q, j, p, i)
            if has_price and not _all_ahead(p.heading[i], turn, q.heading[j], other):
                work[k, ED] += self._price_at_run(p.theta[i], _turns_out_of_run(p, i, q, j))
                work[k, DE] += self._price_at_run(p.theta[i], _turns_into_run(p, i, q, j))
                work[k, SD] += self._price_at_run(q.theta[j], _turns_out_of_run(q, j, p, i))
                work[k, DS] += self._price_at_run(q.theta[j], _turns_into_run(q, j, p, i))
                work[k, DD] += self._price_moving(p, i, q, j)
            j += 1
            if j == q.theta.shape[0]:
                j = 0

    @cython.cfunc
    @cython.exceptval(check=False)
    def _price_moving(
        self, p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t
    ) -> cython.double:
        """Return p_b if theta reaches zero where both wires move, else 0."""
        reaches: cython.int = _reaches_zero(_control_points(p, i, q, j))
        return self.zero.moving(p, i, q, j) if reaches < 0 else self.p_b if reaches else 0.0

    @cython.cfunc
    @cython.exceptval(check=False)
    def _price_inside_run(
        self, p: Corners, i: cython.Py_ssize_t, q: Corners, j: cython.Py_ssize_t
    ) -> cython.double:
        """Return p_b if theta reaches zero among coincident vertices of q, else 0; not all control points are ahead."""
        curve: Curve = _inside_run(p, i, q, j)
        x0, y0, x1, y1 = curve.x0, curve.y0, curve.x1, curve.y1  # type: ignore[attr-defined]
        # From Q0 to Q1 theta goes the short way, and from there on to pi.
        across: cython.double = x0 * fabs(y1) + x1 * fabs(y0)
        size: cython.double = (
            fabs(p.back[i].real) + fabs(p.back[i].imag) + fabs(p.fwd[i].real) + fabs(p.fwd[i].imag)
        )
        noise0: cython.double = ANGLE_NOISE * (fabs(x0) + fabs(y0))
        noise1: cython.double = ANGLE_NOISE * size
        if fabs(y0) > noise0 and fabs(y1) > noise1 and fabs(across) > noise0 * size:
            return self.p_b if y0 * y1 < 0.0 and across > 0.0 else 0.0
        return self.zero.inside_run(p, i, q, j)

    @cython.cfunc
    @cython.exceptval(check=False)
    def _price_at_run(self, theta: cython.double, turns: Turns) -> cython.double:
        """Return p_b if theta reaches zero beside coincident vertices, else 0."""
        theta1: cython.double = theta + turns.first  # type: ignore[attr-defined]
        theta2: cython.double = theta1 + turns.second  # type: ignore[attr-defined]
        if _is_zero(theta) or _is_zero(theta1) or _is_zero(theta2):
            return self.zero._at_run(theta, turns)
        return 0.0


def fill_bends(
    p: Corners,
    q: Corners,
    bending: Bending,
    columns: IntArray,
    weight: FloatArray,
    window: Window,
    bends: FloatArray,
) -> None:
    """Add the work of the seven bends to every dot of a window.

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
    """
    vertices: cython.Py_ssize_t[::1] = columns
    stiffness: cython.double[::1] = weight
    low: cython.Py_ssize_t[::1] = window.low
    high: cython.Py_ssize_t[::1] = window.high
    column_offset: cython.Py_ssize_t[::1] = window.column_offset
    work: cython.double[:, ::1] = bends
    n: cython.Py_ssize_t = q.theta.shape[0]
    c: cython.Py_ssize_t
    first: cython.Py_ssize_t
    last: cython.Py_ssize_t
    for c in range(vertices.shape[0]):
        first = column_offset[c]
        last = first + high[c] - low[c] + 1
        bending.add_column(p, vertices[c], q, low[c] % n, stiffness[c], work[first:last])


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
        PaperBending(k_b, m_b, 1.0, p_b)._along(theta0, theta2, curve)
        for k_b, m_b, p_b in ((1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    ]
    return work[0], work[1] - work[0], work[2] > 0.0
