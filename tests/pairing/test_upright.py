"""Contours among others keep upright where turning tells nothing; one alone takes the least work."""

import numpy as np
import pytest

from shapeblend_cli.pairing.upright import RUNS, TURNED, may_turn_onto_itself, starts_laid_over, turn_along
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.settings import Settings
from tests.support.drawings import drawing
from tests.support.shapes import regular_polygon, star_with
from tests.support.solver import find_least

SETTINGS = Settings(motion="linear")


def oval(x, y, rx, ry, way=1):
    """Path data of an ellipse around a point, begun at its right."""
    return (
        f"M{x + rx} {y}A{rx} {ry} 0 0 {(way + 1) // 2} {x - rx} {y}"
        f"A{rx} {ry} 0 0 {(way + 1) // 2} {x + rx} {y}Z"
    )


TALL, FLAT = oval(12, 12, 4, 8, -1), oval(12, 12, 8, 5, -1)


def turns(a, b):
    """By how much the contours of two drawings turn."""
    (pair,), _ = match_all([drawing(a), drawing(b)], SETTINGS)
    found = []
    for contour in pair.contours:
        a_at, b_at = contour.polygon_a.vertices, contour.polygon_b.vertices
        found.append(abs(turn_along(a_at, b_at, contour.correspondence.dots)))
    return pair, found


def test_a_hole_does_not_turn_in_its_outline():
    # The outlines are much alike, so they stay; the holes could be had for less work with a quarter turn.
    around = oval(12, 12, 10, 11)
    pair, found = turns(around + TALL, oval(12, 12, 11, 10) + FLAT)
    assert max(found) < TURNED
    hole = pair.contours[1]
    free = find_least(hole.polygon_a.vertices / hole.scale_a, hole.polygon_b.vertices / hole.scale_b)
    assert free.work < hole.correspondence.work
    assert hole.correspondence.lower_bound == pytest.approx(free.work, rel=1e-9)
    assert hole.correspondence.gap > 0.1
    assert abs(turn_along(hole.polygon_a.vertices, hole.polygon_b.vertices, free.dots)) > np.radians(45)


def test_alone_it_takes_the_find_least():
    pair, (turn,) = turns(TALL, FLAT)
    (contour,) = pair.contours
    free = find_least(
        contour.polygon_a.vertices / contour.scale_a, contour.polygon_b.vertices / contour.scale_b
    )
    assert contour.correspondence.work == pytest.approx(free.work, rel=1e-9)
    assert contour.correspondence.gap == pytest.approx(0.0, abs=1e-9)
    assert turn > np.radians(45)


@pytest.mark.parametrize("start", range(4))
def test_of_starts_that_cost_the_same_the_one_without_a_turn_is_taken(start):
    corners = np.roll(["4 4", "20 4", "20 20", "4 20"], start)
    _, (turn,) = turns("M4 4H20V20H4Z", f"M{'L'.join(corners)}Z")
    assert turn == pytest.approx(0.0, abs=1e-9)


def test_what_has_a_shape_turns_all_the_same():
    # A bar with a hook and beside it a frame: the hook is turned by a quarter, and its corners say so.
    frame = "M1 1H23V23H1ZM2 2V22H22V2Z"
    hook, turned = "M6 8H18V10H8V16H6Z", "M16 6V18H14V8H8V6Z"
    _, found = turns(frame + hook, frame + turned)
    assert sorted(np.degrees(found)) == pytest.approx([0.0, 0.0, 90.0], abs=1.0)


@pytest.mark.parametrize("corners", range(2, 13))
def test_what_looks_the_same_turned_is_known(corners):
    star = np.where(np.arange(2 * corners) % 2, 0.5, 1.0) * np.exp(
        1j * np.pi * np.arange(2 * corners) / corners
    )
    assert may_turn_onto_itself(star)
    assert may_turn_onto_itself(regular_polygon(max(corners, 3)))


@pytest.mark.parametrize("seed", range(10))
def test_what_does_not_is_known(seed):
    assert not may_turn_onto_itself(star_with(np.random.default_rng(seed), 60, teeth=5))


@pytest.mark.parametrize("runs", [(-1.0, 1.0), RUNS])
def test_starts_lie_around_the_place_that_fits(runs):
    z = np.exp(2j * np.pi * np.arange(60) / 60)
    flat, tall = z.real + 0.5j * z.imag, 0.5 * z.real + 1j * z.imag
    found = starts_laid_over(flat, np.roll(tall, 13), runs)
    assert len(found) == len(runs) - 1
    assert {vertex for vertex, _, _ in found} == {0}
    covered = {row % 60 for _, begin, end in found for row in range(begin, end + 1)}
    assert 13 in covered
    assert len(covered) <= 60 / 4 + 2
