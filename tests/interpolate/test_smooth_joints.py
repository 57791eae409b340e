"""Lines that are divided, and cuts that slide."""

import numpy as np
import pytest

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.interpolate import smooth_joints
from shapeblend_cli.interpolate.parametrization import parametrize
from shapeblend_cli.model import Contour

KERNEL = "shapeblend_cli.interpolate.smooth_joints"


@pytest.fixture(params=["compiled", "uncompiled"])
def module(request, load_uncompiled):
    return smooth_joints if request.param == "compiled" else load_uncompiled(KERNEL)


def round_contour(radii, turn=0.0):
    """Return a closed smooth contour through points at even angles."""
    ways = np.exp(1j * (turn + 2.0 * np.pi * np.arange(len(radii)) / len(radii)))
    points = radii * ways
    handles = 0.5j * ways * radii * 2.0 * np.pi / len(radii) / 1.5
    ends, leaving = np.roll(points, -1), np.roll(handles, -1)
    segments = np.stack([points, points + handles, ends - leaving, ends], axis=1)
    return Contour(segments, np.zeros(len(radii), bool), closed=True)


def bends(segments_a, segments_b):
    """Return how much the joints bend half way, in radians."""
    begin, end = cubics.directions(0.5 * (segments_a + segments_b))
    return np.abs(np.angle(begin * np.roll(end, 1).conj()))


def test_a_line_that_becomes_a_curve_is_divided_so_that_joints_stay_smooth(module):
    line = cubics.line(np.array([[0.0], [3.0]]), np.array([[3.0], [4.0]]))
    curves = np.array([[0.0, 1.0, 2.0, 3.0 + 1.0j], [3.0 + 1.0j, 4.0 + 2.0j, 4.5 + 2.5j, 5.0 + 4.0j]])
    are_lines, is_curve = np.array([True, False]), np.zeros(2, bool)
    line[1, 1:3] = [3.1, 3.8]
    given = line.copy()
    a, b = module.divide_lines(line, curves, are_lines, is_curve, False)
    assert (line == given).all()
    assert (b == curves).all()
    assert (a[1] == line[1]).all()
    assert np.abs(a[0].imag).max() == 0.0
    assert 0.0 < a[0, 1].real < a[0, 2].real < 3.0
    assert bends(a, b)[1] < 0.2 * bends(line, b)[1]
    same = module.divide_lines(line, curves, is_curve, is_curve, False)
    assert same[0] is line
    assert same[1] is curves


def test_cuts_slide_so_that_joints_bend_less(module, rng):
    a, b = (round_contour(rng.uniform(0.8, 1.2, count)) for count in (5, 7))
    one, other = (parametrize(contour, flatten(contour, 60)) for contour in (a, b))
    low = np.concatenate([np.flatnonzero(one.node[:-1]), [one.count]]).astype(float)
    high = np.flatnonzero(other.node[1:-1]) + 1.0
    cuts = np.sort(
        np.concatenate([[low, low / one.count * other.count], [high / other.count * one.count, high]], axis=1)
    ).T
    loose = np.ones(len(cuts), bool)
    loose[[0, -1]] = False
    slid = module.slide_cuts(one, other, cuts, loose, 0.02)

    def both(at):
        return [side.parts(at[:, k], joined=True)[0] for k, side in enumerate((one, other))]

    assert bends(*both(slid)).max() < bends(*both(cuts)).max()
    assert (np.diff(slid, axis=0) >= 0.0).all()
    assert (slid[[0, -1]] == cuts[[0, -1]]).all()
    nodes = np.stack([one.is_node(cuts[:, 0]), other.is_node(cuts[:, 1])], axis=1)
    assert (slid[nodes] == cuts[nodes]).all()
    assert module.slide_cuts(one, other, cuts, np.zeros(len(cuts), bool), 0.02) is cuts


def test_kernels_give_the_same_uncompiled(rng, load_uncompiled):
    uncompiled = load_uncompiled(KERNEL)
    assert smooth_joints.COMPILED
    assert not uncompiled.COMPILED
    for count in (3, 40):
        a, b = (round_contour(rng.uniform(0.5, 1.5, count), turn).segments.copy() for turn in (0.0, 0.2))
        lines = rng.random((2, count)) < 0.4
        a[lines[0]] = cubics.line(a[lines[0], :1], a[lines[0], 3:])
        b[lines[1]] = cubics.line(b[lines[1], :1], b[lines[1], 3:])
        for closed in (True, False):
            ours, theirs = (
                module.divide_lines(a, b, *lines, closed) for module in (smooth_joints, uncompiled)
            )
            np.testing.assert_array_equal(ours, theirs)
        sides = [Contour(each, line, closed=True) for each, line in zip((a, b), lines, strict=True)]
        one, other = (parametrize(contour, flatten(contour, 3 * count)) for contour in sides)
        cuts = np.stack([np.linspace(0.0, side.count, 2 * count + 1) for side in (one, other)], axis=1)
        cuts[1:-1, 0] += rng.uniform(-0.3, 0.3, 2 * count - 1)
        cuts = np.sort(cuts, axis=0)
        ours, theirs = (
            module.slide_cuts(one, other, cuts, np.ones(len(cuts), bool), 0.02)
            for module in (smooth_joints, uncompiled)
        )
        np.testing.assert_array_equal(ours, theirs)
        assert (ours != cuts).any()
