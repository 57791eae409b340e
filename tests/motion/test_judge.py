"""What the judge of in-betweens finds wrong: each term with a blend that has that fault and one that has not."""

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.geometry.raster import winding_grid
from shapeblend_cli.model import Box
from shapeblend_cli.motion.alignment import Alignment
from shapeblend_cli.motion.judge import WEIGHTS, judge_shape
from shapeblend_cli.motion.rigid import Rigid
from tests.support.contours import polygon_contour
from tests.support.motions import moving_polygons, rigidly
from tests.support.shapes import arm, comb, star_polygon, unit
from tests.support.strategies import rngs

SQUARE = np.array([0, 4, 4 + 4j, 4j])
STILL = moving_polygons((SQUARE, SQUARE))
BAR = np.array([0, 1, 1 + 20j, 20j])


def judge(shape, view=None):
    """The terms for a shape."""
    return judge_shape(shape, view).judgement


def rotated(z, degrees):
    return (z - z.mean()) * unit(degrees) + z.mean()


class Scripted:
    """The motion of a contour by a function of its start and the time."""

    name = "scripted"

    def __init__(self, at):
        self.at = at

    def segments(self, contours, t):
        return [self.at(contour.start.segments, t) for contour in contours]


def bulging(factor):
    """A square that is so many times as large half way."""

    def at(z, t):
        return SQUARE.mean() + (1.0 + 4.0 * t * (1.0 - t) * (factor - 1.0)) * (z - SQUARE.mean())

    return STILL._replace(motion=Scripted(at))


@given(rngs, st.integers(3, 30))
def test_winding_numbers_on_the_grid_are_those_of_its_points(rng, m):
    vertices = rng.normal(size=m) + 1j * rng.normal(size=m)
    corner, step, side = complex(-2.0, -2.5), 0.11, 40
    grid = winding_grid(vertices, np.roll(vertices, -1), corner, step, side)
    across = (np.arange(side) + 0.5) * step
    points = corner + across[None, :] + 1j * across[:, None]
    np.testing.assert_array_equal(grid, winding_numbers(points.ravel(), vertices).reshape(side, side))


def test_nothing_is_wrong_with_what_stays():
    assert judge(STILL).number == 0.0


@pytest.mark.parametrize("z", [SQUARE, comb(3), arm(20, 60, 120)], ids=["square", "comb", "arm"])
@pytest.mark.parametrize("scale", [1.0, 0.3, 5.0])
def test_hardly_anything_is_wrong_with_what_only_moves_and_grows(z, scale):
    found = judge(moving_polygons((z, scale * z + 0.3)))
    assert found._replace(sweep=0.0).number == pytest.approx(0.0, abs=0.02)


@given(rngs, st.integers(4, 20), st.floats(0.2, 5.0))
def test_size_and_place_of_a_drawing_make_no_difference(rng, m, scale):
    a, b = star_polygon(rng, m), star_polygon(rng, m)
    one = judge(moving_polygons((a, b)))
    other = judge(moving_polygons((scale * a + 7 - 3j, scale * b + 7 - 3j)))
    assert one.number == pytest.approx(other.number, abs=0.05)


def test_the_sweep_of_what_comes_back_is_counted_but_not_that_of_what_goes_there():
    there = moving_polygons((SQUARE, SQUARE + 3))
    assert judge(there).sweep == pytest.approx(0.0, abs=0.05)
    back = STILL._replace(motion=Scripted(lambda z, t: z + 12.0 * t * (1.0 - t)))
    assert judge(back).sweep == pytest.approx(2 * 2 * 3 * 4 / 16, abs=0.05)


@pytest.mark.parametrize("degrees", [60, 120])
def test_what_turns_on_straight_paths_is_strained_and_loses_area(degrees):
    straight = moving_polygons((BAR, rotated(BAR, degrees)))
    assert judge(straight).strain > 10 * judge(rigidly(straight)).strain
    assert judge(straight).area > 10 * judge(rigidly(straight)).area
    assert judge(rigidly(straight)).number < judge(straight).number


def test_area_gained_is_as_wrong_as_area_lost():
    assert judge(bulging(1.3)).area > 0.2
    assert judge(bulging(0.7)).area > 0.2
    assert judge(STILL).area == 0.0


def test_what_melts_in_one_place_to_grow_in_another_is_stretched():
    nose = np.array([0, 4, 4 + 2j, 7 + 2.1j, 4 + 2.2j, 4 + 4j, 4j, 2.2j, 2.1j, 2j])
    other = np.array([0, 4, 4 + 2j, 4 + 2.1j, 4 + 2.2j, 4 + 4j, 4j, 2.2j, -3 + 2.1j, 2j])
    assert judge(moving_polygons((nose, other))).stretch > 0.2
    assert judge(moving_polygons((nose, 2 * nose))).stretch == pytest.approx(0.0)


def test_a_symmetry_that_both_ends_have_is_missed():
    house, roof = np.array([0, 4, 4 + 4j, 2 + 4j, 4j]), np.array([0, 4, 4 + 4j, 2 + 6j, 4j])
    lopsided = np.roll(roof, -1)  # every corner goes to the next one
    assert judge(moving_polygons((house, roof))).symmetry == 0.0
    assert judge(moving_polygons((house, lopsided))).symmetry > 0.02
    # What is symmetric at one end alone has none to lose.
    assert judge(moving_polygons((house, np.array([0, 4, 5 + 4j, 4 + 5j, 3j])))).symmetry == 0.0


def test_what_turns_over_is_a_fold_unless_an_end_has_it():
    flipped = np.array([0, 4, 4j, 4 + 4j])  # a bow tie
    there = moving_polygons((SQUARE, SQUARE[[1, 0, 3, 2]]))
    assert judge(there).folds == 0.0  # it is flat for a moment, and never inside out in part
    assert judge(moving_polygons((flipped, flipped))).folds == 0.0
    corner = 4 + 4j == SQUARE

    def through(_z, t):
        nodes = SQUARE + 4.0 * t * (1.0 - t) * (-8 - 2j) * corner
        return polygon_contour(nodes).segments

    crossing = STILL._replace(motion=Scripted(through))
    assert judge(crossing).folds > 0.02


def test_a_limb_gets_thin_where_its_sides_meet():
    def pinched(z, t):
        middle = z.mean().imag
        return z.real + 1j * (middle + (1.0 - 3.6 * t * (1.0 - t)) * (z.imag - middle))

    bar = np.concatenate([np.linspace(0, 20, 30), np.linspace(20, 0, 30) + 1j])
    thin = moving_polygons((bar, bar))._replace(motion=Scripted(pinched))
    assert judge(thin).limbs > 0.2
    assert judge(moving_polygons((bar, bar + 3))).limbs == 0.0


def test_what_leaves_the_view_is_counted_only_there():
    out = STILL._replace(motion=Rigid((Alignment(12 + 2j, 12 + 2j, 1.0, np.pi),)))
    assert judge(out, Box(-1, -1, 30, 6)).view > 0.1
    assert judge(out, Box(-20, -20, 60, 60)).view == 0.0
    assert judge(out).view == 0.0


def test_lines_are_judged_too():
    line, folded = np.array([0, 1, 2, 3, 4]), np.array([0, 1, 2, 1 + 0.1j, 0.1j])
    found = judge(moving_polygons((line, folded), closed=False))
    assert found.strain > 0.01
    assert np.isfinite(found.number)


def test_the_document_has_the_weights():
    page = (Path(__file__).parents[2] / "docs" / "motion.md").read_text("utf-8")
    table = dict(re.findall(r"^\| `(\w+)` \| ([\d.]+) \|", page, re.MULTILINE))
    assert {name: float(weight) for name, weight in table.items()} == WEIGHTS._asdict()


def test_a_point_has_nothing_wrong_with_it():
    assert judge(moving_polygons((0 * SQUARE, 0 * SQUARE))).number == 0.0
