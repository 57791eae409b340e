"""What is wrong with a motion."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.motion.alignment import Alignment, Rigid
from shapeblend_cli.motion.defects import COLLAPSE, CROSSING, LOSS, OVERLAP, STRAY, worst_defect
from tests.support.contours import polygon_contour
from tests.support.motions import moving_polygons, rigidly
from tests.support.shapes import arm, comb, star_polygon, unit
from tests.support.strategies import rngs

SQUARE = np.array([0, 4, 4 + 4j, 4j])
STILL = moving_polygons((SQUARE, SQUARE))
BOW_TIE = np.array([0, 2, 2j, 2 + 2j])


def rotated(z, degrees):
    return (z - z.mean()) * unit(degrees) + z.mean()


def rank(shape, times=()):
    defect = worst_defect(shape, times)
    return defect and defect.rank


def message(*pairs, closed=True):
    return worst_defect(moving_polygons(*pairs, closed=closed), ()).message


def test_ranks_rise():
    assert LOSS < OVERLAP < COLLAPSE < STRAY < CROSSING


@pytest.mark.parametrize("scale", [1.0, 0.3, 2.0, 5.0, 20.0])
@pytest.mark.parametrize("z", [SQUARE, comb(3), arm(20, 60, 120)], ids=["square", "comb", "arm"])
def test_what_only_moves_and_grows_has_none(z, scale):
    assert worst_defect(moving_polygons((z, scale * z + 7)), (0.5,)) is None
    assert worst_defect(rigidly(moving_polygons((z, scale * rotated(z, 80) + 7))), (0.5,)) is None


@given(rngs, st.integers(6, 20), st.floats(-30.0, 30.0))
def test_a_little_rotation_is_none(rng, m, degrees):
    z = star_polygon(rng, m)
    assert worst_defect(moving_polygons((z, rotated(z, degrees))), ()) is None


@pytest.mark.parametrize(("degrees", "expected"), [(75, LOSS), (90, COLLAPSE), (180, COLLAPSE)])
def test_straight_paths_of_a_rotated_square_lose_area(degrees, expected):
    defect = worst_defect(moving_polygons((SQUARE, rotated(SQUARE, degrees))), ())
    assert defect.rank == expected
    phrase = re.fullmatch(r"(\d+) % of the area it should have at t = ([\d.]+)", defect.message)
    share, t = map(float, phrase.groups())
    left = abs(1.0 - t + t * unit(degrees)) ** 2
    assert share == pytest.approx(100.0 * left, abs=0.51)


class Scripted:
    """The motion of a contour by a function of its start and the time."""

    name = "scripted"

    def __init__(self, at):
        self.at = at

    def segments(self, contours, t):
        return [self.at(contour.start.segments, t) for contour in contours]


@pytest.mark.parametrize(("factor", "expected"), [(1.2, None), (1.28, LOSS)])
def test_too_much_area_is_a_loss_too(factor, expected):
    def blown(z, t):
        return SQUARE.mean() + (1.0 + 4.0 * t * (1.0 - t) * (factor - 1.0)) * (z - SQUARE.mean())

    assert rank(STILL._replace(motion=Scripted(blown))) == expected


def test_a_limb_that_collapses():
    limbs = arm(60, 60, 60, width=0.1), arm(-60, -60, -60, width=0.1)
    assert rank(moving_polygons(limbs)) == LOSS
    assert re.fullmatch(r"a limb shrinks to \d+ % at t = 0.5", message(limbs))


def test_a_line_that_folds():
    lines = [0, 1, 2, 3, 4], [0, 1, 2, 1 + 0.1j, 0.1j]
    assert message(lines, closed=False).startswith("a limb shrinks")


def test_contours_in_each_others_way():
    pairs = (SQUARE, SQUARE + 6 + 1j), (SQUARE + 6 + 1j, SQUARE)
    assert rank(moving_polygons(*pairs)) == OVERLAP
    assert message(*pairs) == "outlines cross each other at t = 0.2"


def test_an_outline_that_crosses_itself_is_worst_and_named_with_its_time():
    arms = arm(80, 140, 200, 250), arm(10, -40, -100, -150)
    assert rank(moving_polygons(arms)) == CROSSING
    assert message(arms).startswith("an outline crosses itself at t = ")


def test_a_crossing_between_the_usual_times_is_seen_at_a_frames_time():
    bow_tie = polygon_contour(SQUARE[[0, 2, 1, 3]]).segments

    def spiked(reach):
        return STILL._replace(motion=Scripted(lambda z, t: bow_tie if abs(t - 0.512) < reach else z))

    assert rank(spiked(0.004)) is None
    assert worst_defect(spiked(0.004), (0.512,)) == (CROSSING, "an outline crosses itself at t = 0.512")
    assert rank(spiked(0.0), (0.512,)) is None


LINE = np.array([0, 4, 2, 1])


@pytest.mark.parametrize(
    "pairs",
    [
        # Crossings of the ends.
        [(BOW_TIE, BOW_TIE + 5)],
        [(SQUARE, SQUARE + 9), (SQUARE + 2 + 2j, SQUARE + 11 + 2j)],
        # A point at one end.
        [(SQUARE, SQUARE), (10 + 10j, SQUARE + 8 + 8j)],
        [(SQUARE, SQUARE), (SQUARE + 8 + 8j, 10 + 10j)],
        # No area to lose.
        [(LINE, LINE + 1j)],
    ],
)
def test_what_the_ends_have_is_none(pairs):
    assert worst_defect(moving_polygons(*pairs), (0.5,)) is None


@pytest.mark.parametrize("distance", [0.0, 12.0])
def test_what_swings_far_out_strays(distance):
    # A square that stays, moved round a point at a distance.
    centre = complex(SQUARE.mean()) + distance
    defect = worst_defect(STILL._replace(motion=Rigid(Alignment(centre, centre, 1.0, np.pi))), ())
    assert (defect is not None and defect.rank == STRAY) == (distance > 0.0)
    if distance:
        # Half way it is where the centre is: what B has on its far side, A has on the near one.
        phrase = re.fullmatch(r"swings out to ([\d.]+) times its size at t = 0.5", defect.message)
        assert float(phrase[1]) == pytest.approx(distance / abs(SQUARE[0] - SQUARE.mean()), abs=0.06)


def test_a_bar_that_rotates_in_its_place_does_not_stray():
    bar = np.array([0, 1, 1 + 20j, 20j])
    assert worst_defect(rigidly(moving_polygons((bar, rotated(bar, 180)))), ()) is None
