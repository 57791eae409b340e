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

try:
    import cython
except ImportError:  # Cython is needed to build, not to run
    from shapeblend_cli import _cython as cython

if cython.compiled:
    from cython.cimports.libc.math import atan2, fabs, pow, sqrt
else:
    from math import atan2, fabs, pow, sqrt

COMPILED = cython.compiled

PI = cython.declare(cython.double, 3.141592653589793)
TWO_PI = cython.declare(cython.double, 6.283185307179586)

# An angle this near to 0 or 2 pi is zero, and a turn this near to pi is a half turn: far above what
# rounding does to the angle between two edges, far below what can be seen.
ANGLE_NOISE = cython.declare(cython.double, 1e-9)

# d is nothing but rounding when it is this small beside the products it is the difference of.
CROSS_NOISE = cython.declare(cython.double, 1e-12)

# The columns of an array of corners, as `work.corners` makes it.
THETA = cython.declare(cython.int, 0)
BACK_X = cython.declare(cython.int, 1)
BACK_Y = cython.declare(cython.int, 2)
FWD_X = cython.declare(cython.int, 3)
FWD_Y = cython.declare(cython.int, 4)
BACK_ARG = cython.declare(cython.int, 5)
FWD_ARG = cython.declare(cython.int, 6)
BASE_ARG = cython.declare(cython.int, 7)
BASE_X = cython.declare(cython.int, 8)
BASE_Y = cython.declare(cython.int, 9)

# The bends of a dot, by the step into it and the step out of it: the last axis of a table.
EE = cython.declare(cython.int, 0)
ED = cython.declare(cython.int, 1)
DE = cython.declare(cython.int, 2)
SS = cython.declare(cython.int, 3)
SD = cython.declare(cython.int, 4)
DS = cython.declare(cython.int, 5)
DD = cython.declare(cython.int, 6)


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
def _work_of_turns(
    theta: cython.double,
    s1: cython.double,
    s2: cython.double,
    s3: cython.double,
    k_b: cython.double,
    m_b: cython.double,
    e_b: cython.double,
    p_b: cython.double,
) -> cython.double:
    """Bending work, eq (17), of an angle that starts at theta and turns by s1, then s2, then s3."""
    delta_theta: cython.double = fabs(s1 + s2 + s3)
    delta_theta_star: cython.double = 0.5 * (fabs(s1) + fabs(s2) + fabs(s3) - delta_theta)
    work: cython.double = delta_theta + m_b * delta_theta_star
    if e_b != 1.0:
        work = pow(work, e_b)
    work *= k_b
    if _is_zero(theta) or _is_zero(theta + s1) or _is_zero(theta + s1 + s2) or _is_zero(theta + s1 + s2 + s3):
        work += p_b
    return work


@cython.cfunc
@cython.cdivision(True)
@cython.exceptval(check=False)
def _bend(
    theta0: cython.double,
    theta2: cython.double,
    x0: cython.double,
    y0: cython.double,
    x1: cython.double,
    y1: cython.double,
    x2: cython.double,
    y2: cython.double,
    k_b: cython.double,
    m_b: cython.double,
    e_b: cython.double,
    p_b: cython.double,
) -> cython.double:
    """Bending work along ``Q(t)`` with the control points (x0, y0), (x1, y1), (x2, y2)."""
    d0: cython.double = x0 * y1 - y0 * x1
    d1: cython.double = 0.5 * (x0 * y2 - y0 * x2)
    d2: cython.double = x1 * y2 - y1 * x2
    net: cython.double = theta2 - theta0
    one_way: cython.bint = (d0 >= 0.0 and d1 >= 0.0 and d2 >= 0.0) or (d0 <= 0.0 and d1 <= 0.0 and d2 <= 0.0)
    if one_way and net * (d0 + d1 + d2) >= 0.0:  # the usual case, without a square root or an arc tangent
        return _work_of_turns(theta0, net, 0.0, 0.0, k_b, m_b, e_b, p_b)

    size0: cython.double = x0 * x0 + y0 * y0
    size1: cython.double = x1 * x1 + y1 * y1
    size2: cython.double = x2 * x2 + y2 * y2
    noise: cython.double = CROSS_NOISE * CROSS_NOISE * (size0 * size1 + size0 * size2 + size1 * size2)
    if d0 * d0 + d1 * d1 + d2 * d2 <= noise:
        return _work_of_turns(theta0, _short_way(net), 0.0, 0.0, k_b, m_b, e_b, p_b)

    # Ends of one sign with the middle control value of the other: two roots inside or none. Ends of
    # different sign, or one end 0 and the middle of the other sign: one root inside.
    two_roots: cython.bint = not one_way and d0 * d2 > 0.0
    discriminant: cython.double = d1 * d1 - d0 * d2
    if one_way or (two_roots and discriminant <= CROSS_NOISE * d1 * d1):
        # Monotonic: theta turns the way d points, if need be by more than pi.
        if net * (d0 + d1 + d2) < 0.0:
            net += TWO_PI if net < 0.0 else -TWO_PI
        return _work_of_turns(theta0, net, 0.0, 0.0, k_b, m_b, e_b, p_b)

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
        return _work_of_turns(theta0, s1, _short_way(_short_way(net) - s1), 0.0, k_b, m_b, e_b, p_b)

    t = d0 / (a * t)  # the product of the roots is d0 / a
    u = 1.0 - t
    x = u * u * x0 + 2.0 * u * t * x1 + t * t * x2
    y = u * u * y0 + 2.0 * u * t * y1 + t * t * y2
    s3: cython.double = atan2(x * y2 - y * x2, x * x2 + y * y2)
    s2: cython.double = _short_way(_short_way(_short_way(net) - s1) - s3)
    return _work_of_turns(theta0, s1, s2, s3, k_b, m_b, e_b, p_b)


@cython.cfunc
@cython.exceptval(check=False)
def _bend_at_run(
    theta: cython.double,
    s1: cython.double,
    s2: cython.double,
    k_b: cython.double,
    m_b: cython.double,
    e_b: cython.double,
    p_b: cython.double,
) -> cython.double:
    """Bending work of the pieces Q0 -> Q1 -> Q2 beside coincident vertices (section 2.2).

    A half turn goes the cheaper way round.
    """
    work: cython.double = _work_of_turns(theta, s1, s2, 0.0, k_b, m_b, e_b, p_b)
    half1: cython.bint = fabs(s1) > PI - ANGLE_NOISE
    half2: cython.bint = fabs(s2) > PI - ANGLE_NOISE
    other1: cython.double = s1 - TWO_PI if s1 > 0.0 else s1 + TWO_PI
    other2: cython.double = s2 - TWO_PI if s2 > 0.0 else s2 + TWO_PI
    if half1:
        work = min(work, _work_of_turns(theta, other1, s2, 0.0, k_b, m_b, e_b, p_b))
    if half2:
        work = min(work, _work_of_turns(theta, s1, other2, 0.0, k_b, m_b, e_b, p_b))
    if half1 and half2:
        work = min(work, _work_of_turns(theta, other1, other2, 0.0, k_b, m_b, e_b, p_b))
    return work


@cython.cfunc
@cython.boundscheck(False)
@cython.wraparound(False)
@cython.exceptval(check=False)
def _bend_moving(
    p: cython.double[:, ::1],
    i: cython.Py_ssize_t,
    q: cython.double[:, ::1],
    j: cython.Py_ssize_t,
    k_b: cython.double,
    m_b: cython.double,
    e_b: cython.double,
    p_b: cython.double,
) -> cython.double:
    """Bend where both wires move on the way in and on the way out: eqs (7)-(9)."""
    b0x: cython.double = p[i, BACK_X]
    b0y: cython.double = p[i, BACK_Y]
    f0x: cython.double = p[i, FWD_X]
    f0y: cython.double = p[i, FWD_Y]
    b1x: cython.double = q[j, BACK_X]
    b1y: cython.double = q[j, BACK_Y]
    f1x: cython.double = q[j, FWD_X]
    f1y: cython.double = q[j, FWD_Y]
    return _bend(
        p[i, THETA],
        q[j, THETA],
        f0x * b0x + f0y * b0y,
        f0x * b0y - f0y * b0x,
        0.5 * ((f1x * b0x + f1y * b0y) + (f0x * b1x + f0y * b1y)),
        0.5 * ((f1x * b0y - f1y * b0x) + (f0x * b1y - f0y * b1x)),
        f1x * b1x + f1y * b1y,
        f1x * b1y - f1y * b1x,
        k_b,
        m_b,
        e_b,
        p_b,
    )


@cython.cfunc
@cython.boundscheck(False)
@cython.wraparound(False)
@cython.exceptval(check=False)
def _bend_into_run(
    p: cython.double[:, ::1],
    i: cython.Py_ssize_t,
    q: cython.double[:, ::1],
    j: cython.Py_ssize_t,
    k_b: cython.double,
    m_b: cython.double,
    e_b: cython.double,
    p_b: cython.double,
) -> cython.double:
    """Bend where q moves on the way in and stands still on the way out; p moves on both.

    F1 := base of q, so Q1 is conj(F0) B1 to leading order. From Q0 to Q1 only B turns, then only F.
    """
    s1: cython.double = _short_way(q[j, BACK_ARG] - p[i, BACK_ARG])
    s2: cython.double = _short_way(p[i, FWD_ARG] - q[j, BASE_ARG])
    return _bend_at_run(p[i, THETA], s1, s2, k_b, m_b, e_b, p_b)


@cython.cfunc
@cython.boundscheck(False)
@cython.wraparound(False)
@cython.exceptval(check=False)
def _bend_out_of_run(
    p: cython.double[:, ::1],
    i: cython.Py_ssize_t,
    q: cython.double[:, ::1],
    j: cython.Py_ssize_t,
    k_b: cython.double,
    m_b: cython.double,
    e_b: cython.double,
    p_b: cython.double,
) -> cython.double:
    """Bend where q stands still on the way in and moves on the way out; p moves on both.

    B1 := minus the base of q, so Q1 is conj(F1) B0 to leading order. First only F turns, then only B.
    """
    s1: cython.double = _short_way(p[i, FWD_ARG] - q[j, FWD_ARG])
    s2: cython.double = _short_way(_short_way(q[j, BASE_ARG] + PI) - p[i, BACK_ARG])
    return _bend_at_run(p[i, THETA], s1, s2, k_b, m_b, e_b, p_b)


@cython.cfunc
@cython.boundscheck(False)
@cython.wraparound(False)
@cython.exceptval(check=False)
def _bend_inside_run(
    p: cython.double[:, ::1],
    i: cython.Py_ssize_t,
    q: cython.double[:, ::1],
    j: cython.Py_ssize_t,
    k_b: cython.double,
    m_b: cython.double,
    e_b: cython.double,
    p_b: cython.double,
) -> cython.double:
    """Bend where q stands still on the way in and on the way out: its angle there is pi.

    F1 := base, B1 := minus base, so both products of Q1 are of one order: Q1 = conj(d) B0 - conj(F0) d.
    """
    dx: cython.double = q[j, BASE_X]
    dy: cython.double = q[j, BASE_Y]
    b0x: cython.double = p[i, BACK_X]
    b0y: cython.double = p[i, BACK_Y]
    f0x: cython.double = p[i, FWD_X]
    f0y: cython.double = p[i, FWD_Y]
    x1: cython.double = (dx * b0x + dy * b0y) - (f0x * dx + f0y * dy)
    y1: cython.double = (dx * b0y - dy * b0x) - (f0x * dy - f0y * dx)
    theta: cython.double = p[i, THETA]
    longest: cython.double = b0x * b0x + b0y * b0y + f0x * f0x + f0y * f0y
    if x1 * x1 + y1 * y1 <= CROSS_NOISE * CROSS_NOISE * longest:  # Q1 = 0 points nowhere
        return _work_of_turns(theta, PI - theta, 0.0, 0.0, k_b, m_b, e_b, p_b)
    theta1: cython.double = atan2(y1, x1)
    if theta1 < 0.0:
        theta1 += TWO_PI
    return _bend_at_run(theta, _short_way(theta1 - theta), _short_way(PI - theta1), k_b, m_b, e_b, p_b)


@cython.boundscheck(False)
@cython.wraparound(False)
@cython.cdivision(True)
def fill_bends(
    p: cython.double[:, ::1],
    q: cython.double[:, ::1],
    weight: cython.double[::1],
    origin: cython.Py_ssize_t[::1],
    place: cython.Py_ssize_t[::1],
    k_b: cython.double,
    m_b: cython.double,
    e_b: cython.double,
    p_b: cython.double,
    bends: cython.double[:, ::1],
) -> None:
    """Fill in the seven bends of every pair of corners in a window.

    Parameters
    ----------
    p, q : (m, 10) and (n, 10) float
        Corners of the two wires, from `work.corners`.
    weight : (m,) float
        What k_b is multiplied by at each corner of the first wire.
    origin : (m,) int
        The corner of q, modulo n, with which the window of each corner of p begins.
    place : (m,) int
        Where the window of each corner of p begins in `bends`; it ends where the next begins.
    k_b, m_b, e_b, p_b : float
        The constants of eq (17).
    bends : (dots, 7) float
        Overwritten. The last axis is the step into the dot and the step out of it, in the order EE, ED,
        DE, SS, SD, DS, DD: E moves on the first wire alone, S on the second alone, D (Southeast) on both.
    """
    m: cython.Py_ssize_t = p.shape[0]
    n: cython.Py_ssize_t = q.shape[0]
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    end: cython.Py_ssize_t
    stiff: cython.double
    for i in range(m):
        end = place[i + 1] if i + 1 < m else bends.shape[0]
        j = origin[i] % n
        stiff = k_b * weight[i]
        for k in range(place[i], end):
            bends[k, EE] = _bend_inside_run(p, i, q, j, stiff, m_b, e_b, p_b)
            bends[k, ED] = _bend_out_of_run(p, i, q, j, stiff, m_b, e_b, p_b)
            bends[k, DE] = _bend_into_run(p, i, q, j, stiff, m_b, e_b, p_b)
            bends[k, SS] = _bend_inside_run(q, j, p, i, stiff, m_b, e_b, p_b)
            bends[k, SD] = _bend_out_of_run(q, j, p, i, stiff, m_b, e_b, p_b)
            bends[k, DS] = _bend_into_run(q, j, p, i, stiff, m_b, e_b, p_b)
            bends[k, DD] = _bend_moving(p, i, q, j, stiff, m_b, e_b, p_b)
            j += 1
            if j == n:
                j = 0


@cython.boundscheck(False)
@cython.wraparound(False)
def bends_along(
    p: cython.double[:, ::1],
    q: cython.double[:, ::1],
    weight: cython.double[::1],
    dots: cython.Py_ssize_t[:, ::1],
    kinds: cython.Py_ssize_t[::1],
    k_b: cython.double,
    m_b: cython.double,
    e_b: cython.double,
    p_b: cython.double,
    work: cython.double[::1],
) -> None:
    """Bending work at single dots.

    Parameters
    ----------
    p, q, weight, k_b, m_b, e_b, p_b
        As in `fill_bends`.
    dots : (k, 2) int
    kinds : (k,) int
        The steps into and out of each dot: a place on the last axis of `fill_bends`.
    work : (k,) float
        Overwritten.
    """
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    stiff: cython.double
    for k in range(dots.shape[0]):
        i = dots[k, 0]
        j = dots[k, 1]
        stiff = k_b * weight[i]
        if kinds[k] == EE:
            work[k] = _bend_inside_run(p, i, q, j, stiff, m_b, e_b, p_b)
        elif kinds[k] == ED:
            work[k] = _bend_out_of_run(p, i, q, j, stiff, m_b, e_b, p_b)
        elif kinds[k] == DE:
            work[k] = _bend_into_run(p, i, q, j, stiff, m_b, e_b, p_b)
        elif kinds[k] == SS:
            work[k] = _bend_inside_run(q, j, p, i, stiff, m_b, e_b, p_b)
        elif kinds[k] == SD:
            work[k] = _bend_out_of_run(q, j, p, i, stiff, m_b, e_b, p_b)
        elif kinds[k] == DS:
            work[k] = _bend_into_run(q, j, p, i, stiff, m_b, e_b, p_b)
        else:
            work[k] = _bend_moving(p, i, q, j, stiff, m_b, e_b, p_b)


def angle_change(q0: complex, q1: complex, q2: complex) -> tuple[float, float, bool]:
    """How theta moves along the Q curve with these control points (section 2.1).

    Parameters
    ----------
    q0, q1, q2 : complex
        Control points of Q(t), eq (9); none of the ends is 0.

    Returns
    -------
    delta_theta : float
        Eq (11), radians in [0, 2 pi).
    delta_theta_star : float
        Way travelled against the net direction (figure 18), radians.
    reaches_zero : bool
        Whether theta(t) = 0 for a t in [0, 1], eq (3).

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
    work = [
        _bend(theta0, theta2, q0.real, q0.imag, q1.real, q1.imag, q2.real, q2.imag, k_b, m_b, 1.0, p_b)
        for k_b, m_b, p_b in ((1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    ]
    return work[0], work[1] - work[0], work[2] > 0.0
