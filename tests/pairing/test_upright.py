"""Contours among others keep upright where rotation says nothing; one alone takes the least work."""

import numpy as np
import pytest

from shapeblend_cli.pairing.upright import (
    RUNS,
    UPRIGHT,
    may_rotate_onto_itself,
    overlapping_starts,
    rotation_along,
)
from tests.support.drawings import drawing
from tests.support.motions import pair_of
from tests.support.shapes import regular_polygon, star_with
from tests.support.solver import find_least


def oval(rx, ry, sweep=0):
    """Path data of an ellipse in the middle, begun at its right."""
    arc = f"A{rx} {ry} 0 0 {sweep} {{}} 12".format
    return f"M{12 + rx} 12{arc(12 - rx)}{arc(12 + rx)}Z"


TALL, FLAT = oval(4, 8), oval(8, 5)


def matched(a, b):
    """The contours of two drawings, and by how much each rotates."""
    contours = pair_of(drawing(a), drawing(b), motion="linear").contours
    return contours, [rotated_by(contour, contour.correspondence) for contour in contours]


def rotated_by(contour, correspondence):
    return abs(rotation_along(contour.polygon_a.vertices, contour.polygon_b.vertices, correspondence.dots))


def least_alone(contour):
    """The least path of a contour over all starts."""
    return find_least(
        contour.polygon_a.vertices / contour.scale_a, contour.polygon_b.vertices / contour.scale_b
    )


def test_a_hole_does_not_rotate_in_its_outline():
    # The outlines are much alike, so they stay; the holes could be had for less work with a quarter turn.
    (_, hole), angles = matched(oval(10, 11, 1) + TALL, oval(11, 10, 1) + FLAT)
    assert max(angles) < UPRIGHT
    free = least_alone(hole)
    assert free.work < hole.correspondence.work
    assert hole.correspondence.lower_bound == pytest.approx(free.work, rel=1e-9)
    assert hole.correspondence.gap > 0.1
    assert rotated_by(hole, free) > np.radians(45)


def test_alone_it_takes_the_least_work():
    (contour,), (angle,) = matched(TALL, FLAT)
    assert contour.correspondence.work == pytest.approx(least_alone(contour).work, rel=1e-9)
    assert contour.correspondence.gap == pytest.approx(0.0, abs=1e-9)
    assert angle > np.radians(45)


@pytest.mark.parametrize("start", range(4))
def test_of_starts_that_cost_the_same_the_one_without_a_rotation_is_taken(start):
    corners = np.roll(["4 4", "20 4", "20 20", "4 20"], start)
    _, angles = matched("M4 4H20V20H4Z", f"M{'L'.join(corners)}Z")
    assert angles == pytest.approx([0.0], abs=1e-9)


def test_what_has_a_shape_rotates_all_the_same():
    # A bar with a hook and beside it a frame: the hook is rotated by a quarter, and its corners say so.
    frame = "M1 1H23V23H1ZM2 2V22H22V2Z"
    _, angles = matched(frame + "M6 8H18V10H8V16H6Z", frame + "M16 6V18H14V8H8V6Z")
    assert sorted(np.degrees(angles)) == pytest.approx([0.0, 0.0, 90.0], abs=1.0)


@pytest.mark.parametrize("corners", range(2, 13))
def test_what_looks_the_same_rotated_is_known(corners):
    k = np.arange(2 * corners)
    assert may_rotate_onto_itself(np.where(k % 2, 0.5, 1.0) * np.exp(1j * np.pi * k / corners))
    assert may_rotate_onto_itself(regular_polygon(max(corners, 3)))


@pytest.mark.parametrize("seed", range(10))
def test_what_does_not_is_known(seed):
    assert not may_rotate_onto_itself(star_with(np.random.default_rng(seed), 60, teeth=5))


@pytest.mark.parametrize("runs", [(-1.0, 1.0), RUNS])
def test_starts_lie_around_the_place_that_fits(runs):
    z = np.exp(2j * np.pi * np.arange(60) / 60)
    flat, tall = z.real + 0.5j * z.imag, 0.5 * z.real + 1j * z.imag
    found = overlapping_starts(flat, np.roll(tall, 13), runs)
    assert len(found) == len(runs) - 1
    assert {vertex for vertex, _, _ in found} == {0}
    covered = {row % 60 for _, begin, end in found for row in range(begin, end + 1)}
    assert 13 in covered
    assert len(covered) <= 60 / 4 + 2
