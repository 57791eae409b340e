"""What is wrong with a motion."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.motion.alignment import Alignment, Rigid
from shapeblend_cli.motion.defects import COLLAPSE, CROSSING, LOSS, OVERLAP, STRAY, worst_defect
from tests.support.motions import moving_polygons, similarity_of
from tests.support.shapes import arm, comb, star_polygon
from tests.support.strategies import rngs

SQUARE = np.array([0, 4, 4 + 4j, 4j])
BOW_TIE = np.array([0, 2, 2j, 2 + 2j])


def turned(z, degrees):
    z = np.asarray(z, complex)
    return (z - z.mean()) * np.exp(1j * np.radians(degrees)) + z.mean()


def rank(shape, times=()):
    found = worst_defect(shape, times)
    return found and found.rank


def test_ranks_rise():
    assert LOSS < OVERLAP < COLLAPSE < STRAY < CROSSING


@pytest.mark.parametrize("scale", [1.0, 0.3, 2.0, 5.0, 20.0])
@pytest.mark.parametrize("kind", ["straight", "rigid"])
def test_what_only_moves_and_grows_has_none(scale, kind):
    for z in (SQUARE, comb(3), arm(20, 60, 120)):
        shape = moving_polygons((z, scale * z + 7))
        if kind == "rigid":
            shape = moving_polygons((z, scale * turned(z, 80) + 7))
            shape = shape._replace(motion=Rigid(similarity_of(shape)))
        assert worst_defect(shape, (0.5,)) is None


@given(rngs, st.integers(6, 20), st.floats(-30.0, 30.0))
def test_a_little_turn_is_none(rng, m, degrees):
    z = star_polygon(rng, m)
    assert worst_defect(moving_polygons((z, turned(z, degrees))), ()) is None


@pytest.mark.parametrize(("degrees", "expected"), [(75, LOSS), (90, COLLAPSE), (180, COLLAPSE)])
def test_straight_paths_of_a_turned_square_lose_area(degrees, expected):
    found = worst_defect(moving_polygons((SQUARE, turned(SQUARE, degrees))), ())
    assert found.rank == expected
    share, t = map(
        float, re.fullmatch(r"(\d+) % of the area it should have at t = ([\d.]+)", found.message).groups()
    )
    left = abs(1.0 - t + t * np.exp(1j * np.radians(degrees))) ** 2
    assert share == pytest.approx(100.0 * left, abs=0.51)


def test_too_much_area_is_a_loss_too():
    shape = moving_polygons((SQUARE, SQUARE))
    assert rank(shape._replace(motion=Blown(1.2))) is None
    assert rank(shape._replace(motion=Blown(1.28))) == LOSS


class Blown:
    """Larger on its way."""

    name = "blown"

    def __init__(self, factor):
        self.factor = factor

    def segments(self, contours, t):
        scale = 1.0 + 4.0 * t * (1.0 - t) * (self.factor - 1.0)
        return [SQUARE.mean() + scale * (contour.start.segments - SQUARE.mean()) for contour in contours]


def test_a_limb_that_withers():
    found = worst_defect(moving_polygons((arm(60, 60, 60, width=0.1), arm(-60, -60, -60, width=0.1))), ())
    assert found.rank == LOSS
    assert found.message.startswith("a limb shrinks to ")
    assert found.message.endswith(" % at t = 0.5")


def test_a_line_that_folds():
    straight, back = [0, 1, 2, 3, 4], [0, 1, 2, 1 + 0.1j, 0.1j]
    assert worst_defect(moving_polygons((straight, back), closed=False), ()).message.startswith(
        "a limb shrinks"
    )


def test_contours_in_each_others_way():
    left, right = SQUARE, SQUARE + 6 + 1j
    found = worst_defect(moving_polygons((left, right), (right, left)), ())
    assert found.rank == OVERLAP
    assert found.message == "outlines cross each other at t = 0.2"


def test_an_outline_that_crosses_itself_is_worst_and_named_with_its_time():
    a, b = arm(80, 140, 200, 250), arm(10, -40, -100, -150)
    found = worst_defect(moving_polygons((a, b)), ())
    assert found.rank == CROSSING
    assert found.message.startswith("an outline crosses itself at t = ")


def test_a_crossing_between_the_usual_times_is_seen_at_a_frames_time():
    spike = [Spike(0.512, 0.004), Spike(0.512, 0.0)]
    shape = moving_polygons((SQUARE, SQUARE))
    crossing, nothing = (shape._replace(motion=motion) for motion in spike)
    assert rank(crossing) is None
    assert worst_defect(crossing, (0.512,)) == (CROSSING, "an outline crosses itself at t = 0.512")
    assert rank(nothing, (0.512,)) is None


class Spike:
    """A bow tie for a moment."""

    name = "spike"

    def __init__(self, time, reach):
        self.time, self.reach = time, reach

    def segments(self, contours, t):
        (contour,) = contours
        if abs(t - self.time) >= self.reach:
            return [contour.start.segments]
        return [moving_polygons((SQUARE[[0, 2, 1, 3]], SQUARE)).contours[0].start.segments]


def test_crossings_that_the_ends_have_are_no_fault():
    assert worst_defect(moving_polygons((BOW_TIE, BOW_TIE + 5)), (0.5,)) is None
    crossed = [SQUARE, SQUARE + 2 + 2j]
    assert worst_defect(moving_polygons(*((z, z + 9) for z in crossed)), (0.5,)) is None


def test_what_grows_from_a_point_is_no_limb_and_no_loss():
    assert worst_defect(moving_polygons((SQUARE, SQUARE), (10 + 10j, SQUARE + 8 + 8j)), ()) is None
    assert worst_defect(moving_polygons((SQUARE, SQUARE), (SQUARE + 8 + 8j, 10 + 10j)), ()) is None


def test_outlines_without_area_have_none_to_lose():
    line = [0, 4, 2, 1]
    assert worst_defect(moving_polygons((line, np.array(line) + 1j)), ()) is None


@pytest.mark.parametrize(("arm_length", "expected"), [(0.0, None), (12.0, STRAY)])
def test_what_swings_far_out_strays(arm_length, expected):
    # A square that stays, gone round a point as far away as the arm is long.
    shape = moving_polygons((SQUARE, SQUARE))
    middle = complex(SQUARE.mean()) + arm_length
    shape = shape._replace(motion=Rigid(Alignment(middle, middle, 1.0, np.pi)))
    found = [one for one in (worst_defect(shape, ()),) if one and one.rank == STRAY]
    assert [one.rank for one in found] == ([] if expected is None else [expected])
    if found:
        # Half way it is where the middle is: what B has on its far side, A has on the near one.
        match = re.fullmatch(r"swings out to ([\d.]+) times its size at t = 0.5", found[0].message)
        assert float(match[1]) == pytest.approx(arm_length / abs(SQUARE[0] - SQUARE.mean()), abs=0.06)


def test_a_bar_that_turns_in_its_place_does_not_stray():
    bar = np.array([0, 1, 1 + 20j, 20j])
    shape = moving_polygons((bar, turned(bar, 180)))
    assert worst_defect(shape._replace(motion=Rigid(similarity_of(shape))), ()) is None
