"""The work of a path once more, written another way, to test the solver against.

Angles are followed by sampling theta(t) densely instead of by extrema and signs, coincident vertices by
really placing them along a tiny base, and least paths by trying every path from every start. Only inside a
run of coincident vertices the motion is not sampled: there section 2.2 is read as the pieces Q0 - Q1 - Q2.

What is not in the paper: a wire turns at a vertex as its edges do, those of the tiny base among them; outlines are
smoothed by the integral of every edge against the Gaussian; travel goes by the edges that move.
"""

from functools import cache
from math import erf, exp, pi, sqrt

import numpy as np

EAST, SOUTH, SOUTHEAST = (1, 0), (0, 1), (1, 1)
STEPS = (EAST, SOUTH, SOUTHEAST)


def theta_along(back0, fwd0, back1, fwd1, samples=4001):
    """theta(t) unwrapped, eq (4), on a grid fine at both ends, where infinitesimal edges take over."""
    edge = np.geomspace(1e-17, 0.5, samples)
    t = np.concatenate([[0.0], edge, 1.0 - edge[::-1], [1.0]])
    u = np.concatenate([[1.0], 1.0 - edge, edge[::-1], [0.0]])
    theta = np.unwrap(np.angle((u * fwd0 + t * fwd1).conj() * (u * back0 + t * back1)))
    return theta - 2.0 * np.pi * np.floor(theta[0] / (2.0 * np.pi))


def control_path(back0, fwd0, back1, fwd1, samples=400):
    """theta along the lines Q0 - Q1 - Q2, for the inside of a run of coincident vertices."""
    q0 = fwd0.conjugate() * back0
    q1 = fwd1.conjugate() * back0 + fwd0.conjugate() * back1
    q2 = fwd1.conjugate() * back1
    unit = [q / abs(q) for q in (q0, q1, q2)]
    t = np.linspace(0.0, 1.0, samples)
    path = np.concatenate([(1 - t) * unit[0] + t * unit[1], (1 - t) * unit[1] + t * unit[2]])
    theta = np.unwrap(np.angle(path))
    return theta - 2.0 * np.pi * np.floor(theta[0] / (2.0 * np.pi))


def motion(theta):
    """delta_theta, delta_theta_star and whether zero is reached, from samples of theta."""
    turns = np.diff(theta)
    net = abs(turns.sum())
    return net, 0.5 * (np.abs(turns).sum() - net), bool(theta.min() <= 0.0 or theta.max() >= 2.0 * np.pi)


def base(back, fwd):
    """Direction of the base of the isosceles triangle of section 2.2."""
    alpha = np.angle(fwd.conjugate() * back) % (2.0 * np.pi)
    return back / abs(back) * np.exp(-1j * (0.5 * np.pi + 0.5 * alpha))


def turn(back, fwd):
    """How far a wire turns between two edges, in (-pi, pi]."""
    angle = np.angle(-fwd / back)
    return np.pi if angle <= -np.pi + 1e-12 else angle


def smoothed(p, closed, sigma):
    """Vertices of an outline that a Gaussian along its length has smoothed, but for a thousandth of the outline.

    Exactly: the edges, on and on in both directions, are straight pieces x + y s of the length s, whose products with
    the Gaussian have integrals in closed form. Beyond its ends an open outline goes on rotated half a turn.
    """
    if closed:
        around = np.concatenate([p, p, p, p[:1]])
    else:
        around = np.concatenate([2 * p[0] - p[:0:-1], p, 2 * p[-1] - p[-2::-1]])
    first = len(p) if closed else len(p) - 1
    at = np.append(0.0, np.cumsum(abs(np.diff(around))))
    width = sigma * (at[first + len(p)] - at[first] if closed else at[first + len(p) - 1] - at[first])
    smooth = np.zeros(len(p), complex)
    for k in range(len(p)):
        u = (at - at[first + k]) / width
        mass = np.array([0.5 * erf(v / sqrt(2)) for v in u])
        moment = np.array([-exp(-0.5 * v * v) / sqrt(2 * pi) for v in u])
        for e in range(len(around) - 1):
            y = (around[e + 1] - around[e]) / (u[e + 1] - u[e])
            x = around[e] - y * u[e]
            smooth[k] += x * (mass[e + 1] - mass[e]) + y * (moment[e + 1] - moment[e])
    return 0.999 * smooth + 0.001 * p


def in_unit_square(p):
    """Where points are in their box as a square; a box is at least 2 % as wide as high, and as high as wide."""
    sides = np.array([np.ptp(p.real), np.ptp(p.imag)])
    width, height = np.maximum(sides, 0.02 * sides.max())
    return np.array([(p.real - p.real.min()) / width, (p.imag - p.imag.min()) / height]).T


def legal_turn(step_in, step_out):
    """Section 4: no 90-degree turns."""
    return {step_in, step_out} != {EAST, SOUTH}


def paths(columns, rows):
    """All legal paths from the first dot of a graph to the last, as lists of dots."""
    end = (columns - 1, rows - 1)

    def extended(path, last):
        if path[-1] == end:
            yield path
            return
        for step in STEPS:
            dot = path[-1][0] + step[0], path[-1][1] + step[1]
            if dot[0] < columns and dot[1] < rows and (last is None or legal_turn(last, step)):
                yield from extended([*path, dot], step)

    return extended([(0, 0)], None)


class Oracle:
    """Prices paths between two polygons in the unit box."""

    def __init__(self, p0, p1, closed, constants, weight=None, tiny=1e-11):
        self.p, self.closed, self.constants, self.tiny = (p0, p1), closed, constants, tiny
        self.m, self.n = len(p0), len(p1)
        self.weight = np.ones(self.m) if weight is None else weight
        self.bend = cache(self._bend)
        sigma = constants.smoothing
        self.smooth = [smoothed(p, closed, sigma) for p in self.p] if sigma else self.p
        self.square = [in_unit_square(p) for p in self.p]

    def _edges(self, p, k, moves_in, moves_out):
        back, fwd = p[k - 1] - p[k], p[(k + 1) % len(p)] - p[k]
        if not self.closed and k == 0:
            back = -fwd
        if not self.closed and k == len(p) - 1:
            fwd = -back
        d = base(back, fwd) * self.tiny
        return back if moves_in else -d, fwd if moves_out else d

    def _bend(self, i, j, step_in, step_out):
        """All that a dot costs: most of the bending is that of the smoothed outlines, if they are smoothed."""
        c, travel = self.constants, self._travel(i, j, step_in, step_out)
        if not c.smoothing:
            return travel + self._bend_of(self.p, i, j, step_in, step_out, c.p_b)
        own = self._bend_of(self.p, i, j, step_in, step_out, c.p_b / 0.3)
        return travel + 0.3 * own + 0.7 * self._bend_of(self.smooth, i, j, step_in, step_out, 0.0)

    def _bend_of(self, polygons, i, j, step_in, step_out, p_b):
        c, (p, q) = self.constants, polygons
        back0, fwd0 = self._edges(p, i, step_in[0], step_out[0])
        back1, fwd1 = self._edges(q, j, step_in[1], step_out[1])
        inside_run = step_in == step_out != SOUTHEAST
        follow = control_path if inside_run else theta_along
        zero = False
        if c.bending == "paper" or p_b:
            delta, star, zero = motion(follow(back0, fwd0, back1, fwd1))
        change = delta + c.m_b * star if c.bending == "paper" else abs(turn(back0, fwd0) - turn(back1, fwd1))
        return self.weight[i] * c.k_b * change**c.e_b + p_b * zero

    def _travel(self, i, j, step_in, step_out):
        """Springs on a quarter of the edges that move at a dot."""
        edges = (
            *self._edges(self.p[0], i, step_in[0], step_out[0]),
            *self._edges(self.p[1], j, step_in[1], step_out[1]),
        )
        square = ((self.square[0][i] - self.square[1][j]) ** 2).sum()
        return self.constants.k_t * square * sum(map(abs, edges)) / 4

    def stretch(self, i, j, step):
        """Eq (16) for the step that leaves [i, j]."""
        c = self.constants
        len0 = abs(self.p[0][(i + 1) % self.m] - self.p[0][i]) * step[0]
        len1 = abs(self.p[1][(j + 1) % self.n] - self.p[1][j]) * step[1]
        resistance = (1 - c.c_s) * min(len0, len1) + c.c_s * max(len0, len1)
        weight = (self.weight[i] + self.weight[(i + step[0]) % self.m]) / 2
        return weight * c.k_s * abs(len1 - len0) ** c.e_s / resistance

    def price(self, dots):
        """Work of a path given by its dots."""
        dots = [tuple(int(v) for v in dot) for dot in dots]
        following = dots[1:] + dots[:1] if self.closed else dots[1:]
        steps = [
            ((i2 - i1) % self.m, (j2 - j1) % self.n)
            for (i1, j1), (i2, j2) in zip(dots, following, strict=False)
        ]
        work = sum(self.stretch(*dot, step) for dot, step in zip(dots, steps, strict=False))
        before = steps[-1:] + steps[:-1]
        turns = list(zip(dots, before, steps, strict=False))
        return work + sum(self.bend(*dot, *turn) for dot, *turn in turns[0 if self.closed else 1 :])

    def least(self, bend=None, starts=None, pins=(), band=None):
        """Least work over every path (from every start when closed), one path after the other.

        `bend(i, j, step_in, step_out)` prices a bend, the oracle itself if it is not given. Paths go through
        all `pins` and keep within `band` of the diagonal through their start; without `starts` a closed path
        starts where it enters column 0.
        """
        bend = bend or self.bend
        best = np.inf
        end = (self.m, self.n) if self.closed else (self.m - 1, self.n - 1)
        pins = set(pins)

        def extend(i0, j0, i, j, first, last, work, missing):
            nonlocal best
            if work >= best or (band is not None and abs(i / end[0] - j / end[1]) > band + 1e-12):
                return
            here = (i0 + i) % self.m, (j0 + j) % self.n
            missing = missing - {here}
            if (i, j) == end:
                if missing or (self.closed and not legal_turn(last, first)):
                    return
                if self.closed and starts is None and last == SOUTH:
                    return
                if self.closed:
                    work += bend(i0, j0, last, first)
                best = min(best, work)
                return
            for step in STEPS:
                if i + step[0] > end[0] or j + step[1] > end[1] or (last and not legal_turn(last, step)):
                    continue
                cost = self.stretch(*here, step) + (bend(*here, last, step) if last else 0.0)
                extend(i0, j0, i + step[0], j + step[1], first or step, step, work + cost, missing)

        everywhere = [(0, j) for j in range(self.n)] if self.closed else [(0, 0)]
        for i0, j0 in starts or everywhere:
            extend(i0, j0, 0, 0, None, None, 0.0, pins)
        return best
