"""theta(t) at every moment, beside the kernel and beside the polygons of eq (2)."""

import math

import numpy as np
import pytest

from shapeblend_cli.matching.steps import DD, DE, DS, ED, EE, SD, SS
from shapeblend_cli.matching.work import Wires
from shapeblend_cli.options.constants import PAPER, WorkConstants
from shapeblend_cli.plot.theta import theta_of
from tests.support.shapes import random_polygon, star_polygon

SQUARE = np.array([0, 0.5j, 1j, 1 + 1j, 1])
CONSTANTS = WorkConstants(**PAPER, p_b=7.0)
TURNED = np.array([1, 0, 1j, 0.5 + 1j, 1 + 1j])


def wires(rng, kind):
    if kind == "square":  # half turns, control points on one line, Q1 that points nowhere
        return Wires(SQUARE, TURNED, True, CONSTANTS)
    polygon = random_polygon if kind == "any" else star_polygon
    return Wires(polygon(rng, 7), polygon(rng, 6), True, CONSTANTS, 0.5 + rng.random(7))


@pytest.mark.parametrize("kind", ["any", "star", "square"])
@pytest.mark.parametrize("bend", [EE, ED, DE, SS, SD, DS, DD])
def test_turns_cost_what_the_kernel_says(rng, kind, bend):
    for _ in range(1 if kind == "square" else 6):
        wire = wires(rng, kind)
        bends = wire.tables().bends.reshape(wire.m, wire.n, 7)
        for i in range(wire.m):
            for j in range(wire.n):
                work = theta_of(wire, (i, j), bend).bending(wire, i)
                assert work == pytest.approx(bends[i, j, bend], abs=1e-7)


@pytest.mark.parametrize("names", [("bird-1", "bird-2"), ("cow", "deer")])
def test_it_is_the_angle_of_the_polygon_at_that_time(subject_of, names):
    subject = subject_of(*names, motion="linear")
    wire, dots = subject.wires, subject.correspondence.dots
    at, kinds, _ = wire.bends_on(dots)
    assert len(set(kinds.tolist())) > 4
    ends = [np.cumsum(c.fwd) for c in (wire.corners0, wire.corners1)]
    p, q = (np.roll(end, 1)[dots[:, axis]] for axis, end in enumerate(ends))
    for place, (dot, kind) in enumerate(zip(at.tolist(), kinds.tolist(), strict=True)):
        theta = theta_of(wire, tuple(dot), kind)
        inside = (theta.times > 1e-3) & (theta.times < 1.0 - 1e-3)
        t = theta.times[inside]
        back, here, fwd = ((1.0 - t) * p[k] + t * q[k] for k in (place - 1, place, (place + 1) % len(p)))
        angle = np.angle((fwd - here).conj() * (back - here))
        away = np.angle(np.exp(1j * (theta.angles[inside] - angle)))
        assert abs(away).max(initial=0.0) < 1e-6


def test_figure_17_turns_further_than_half_a_turn():
    # Both edges turn by about half a turn, each its own way: from 10 degrees over 180 to 350.
    before = np.array([np.exp(1j * np.radians(10.0)), 0, 1])
    after = np.array([-1, 0, np.exp(1j * np.radians(190.0))])
    theta = theta_of(Wires(before, after, True, WorkConstants()), (1, 1), DD)
    assert math.degrees(theta.first) == pytest.approx(10.0)
    assert math.degrees(theta.last) == pytest.approx(350.0)
    assert theta.change == (pytest.approx(math.radians(340.0)), 0.0, False)
