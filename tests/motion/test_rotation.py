"""Whether an outline is a rotated copy of another one."""

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.motion.rotation import rotation_between
from tests.support.contours import circle_contour, polygon
from tests.support.shapes import arm, comb, regular_polygon, spiral, star_polygon, star_with, unit
from tests.support.strategies import rngs

ARM, SQUARE = arm(20, 60, 120), regular_polygon(4)


def degrees_between(a, b, closed=True):
    """The angle from outline to outline, None if there is none."""
    angle = rotation_between(polygon(a, closed), polygon(b, closed))
    return None if angle is None else np.degrees(angle)


def finer(z, rng):
    """The same outline with a vertex more on some of its edges."""
    edges = np.flatnonzero(rng.random(len(z)) < 0.5)
    share = rng.uniform(0.2, 0.8, len(edges))
    return np.insert(z, edges + 1, z[edges] + share * (np.roll(z, -1)[edges] - z[edges]))


@settings(max_examples=30, phases=[Phase.explicit, Phase.generate])
@given(
    rngs,
    st.integers(1, 5),
    st.floats(4.0, 178.0),
    st.sampled_from([1, -1]),
    st.floats(0.01, 50.0),
    st.integers(0, 29),
)
def test_a_known_angle_is_found_from_any_start(rng, m, degrees, sign, scale, start):
    a = arm(*rng.uniform(-70.0, 70.0, m).cumsum())
    b = np.roll(finer(a, rng), start) * scale * unit(sign * degrees) + 7.0
    assert degrees_between(a, b) == pytest.approx(sign * degrees, abs=2.5)
    assert degrees_between(b, a) == pytest.approx(-sign * degrees, abs=2.5)


@pytest.mark.parametrize("z", [ARM, comb(4), spiral(2.0)], ids=["arm", "comb", "spiral"])
@pytest.mark.parametrize("degrees", [3, 45, 90, -135, 175])
def test_known_angles_of_outlines_by_hand(z, degrees):
    assert degrees_between(z, np.roll(z, 5) * unit(degrees)) == pytest.approx(degrees, abs=0.75)


@pytest.mark.parametrize(("degrees", "least"), [(50, -40), (-50, 40), (100, 10), (130, 40)])
def test_a_square_has_the_smallest_angle(degrees, least):
    assert degrees_between(SQUARE, SQUARE * unit(degrees)) == pytest.approx(least, abs=0.75)


@pytest.mark.parametrize("degrees", [0, 90, 180, 270, 0.5])
def test_what_is_rotated_onto_itself_or_hardly_is_not_rotated(degrees):
    assert degrees_between(SQUARE, 3 * SQUARE * unit(degrees)) is None


@pytest.mark.parametrize("degrees", [0, 17, 100, 180])
def test_a_circle_is_not_rotated(degrees):
    circle = flatten(circle_contour(), 100)
    assert rotation_between(circle, polygon(circle.vertices * unit(degrees))) is None


@given(rngs, st.integers(5, 20))
def test_unlike_outlines_are_not(rng, m):
    assert degrees_between(star_with(rng, m, teeth=3), ARM) is None


def test_a_mirror_image_is_not():
    assert degrees_between(ARM, -ARM.conj()[::-1]) is None


def test_nor_is_an_outline_with_a_bite(rng):
    z = star_polygon(rng, 40, 0.1)
    bitten = z.copy()
    bitten[5:9] = 0.5 * (bitten[5:9] + z.mean())
    assert degrees_between(z, bitten * 1j) is None


@pytest.mark.parametrize("degrees", [90, -90, 180, 60])
def test_the_hand_of_a_clock_turns_about_its_end(degrees):
    hand = np.array([-0.3j, 5 - 0.2j, 5 + 0.2j, 0.3j])
    square = 0.2 * np.array([-1 - 1j, 24 - 1j, 24 + 1j, -1 + 1j])  # as long on both sides, and it has a tail
    for z in (hand, square):
        turned = z * unit(degrees)
        assert abs(degrees_between(z + 7, turned + 7)) == pytest.approx(abs(degrees), abs=0.75)
        assert degrees_between(z + 7, turned + 7) * degrees > 0 or abs(degrees) == 180


def test_open_lines_are_seen_from_both_ends():
    z = spiral(1.5)[:60]
    for line in (z, z[::-1]):
        assert degrees_between(z, line * unit(50), False) == pytest.approx(50, abs=0.57)
    assert rotation_between(polygon(z, closed=False), polygon(z)) is None


def test_a_straight_line_has_no_direction():
    assert abs(degrees_between(np.array([0, 4]), np.array([0, 4j]), False)) == pytest.approx(90)
    assert degrees_between(np.array([0, 4]), np.array([4, 0]), False) is None
