"""Whether an outline is another one turned."""

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.motion.rotation import rotation_between
from tests.support.contours import circle_contour, polygon
from tests.support.shapes import arm, comb, regular_polygon, spiral, star_polygon, star_with
from tests.support.strategies import rngs


def finer(z, rng):
    """The same outline with a vertex more on some of its edges."""
    places = np.flatnonzero(rng.random(len(z)) < 0.5)
    share = rng.uniform(0.2, 0.8, len(places))
    return np.insert(z, places + 1, z[places] + share * (np.roll(z, -1)[places] - z[places]))


@settings(max_examples=30, phases=[Phase.explicit, Phase.generate])
@given(
    rngs, st.integers(1, 5), st.floats(4.0, 178.0), st.booleans(), st.floats(0.01, 50.0), st.integers(0, 29)
)
def test_a_known_turn_is_found_from_any_start(rng, m, degrees, negative, scale, start):
    degrees = -degrees if negative else degrees
    a = arm(*rng.uniform(-70.0, 70.0, m).cumsum())
    b = np.roll(finer(a, rng), start) * scale * np.exp(1j * np.radians(degrees)) + 7.0
    found = rotation_between(polygon(a), polygon(b))
    assert found is not None
    assert np.degrees(found) == pytest.approx(degrees, abs=2.5)
    back = rotation_between(polygon(b), polygon(a))
    assert np.degrees(back) == pytest.approx(-degrees, abs=2.5)


@pytest.mark.parametrize("z", [arm(20, 60, 120), comb(4), spiral(2.0)], ids=["arm", "comb", "spiral"])
@pytest.mark.parametrize("degrees", [3, 45, 90, -135, 175])
def test_known_turns_of_outlines_by_hand(z, degrees):
    found = rotation_between(polygon(z), polygon(np.roll(z, 5) * np.exp(1j * np.radians(degrees))))
    assert np.degrees(found) == pytest.approx(degrees, abs=0.75)


@pytest.mark.parametrize(("degrees", "least"), [(50, -40), (-50, 40), (100, 10), (130, 40)])
def test_a_square_has_the_least_turn(degrees, least):
    square = regular_polygon(4)
    found = rotation_between(polygon(square), polygon(square * np.exp(1j * np.radians(degrees))))
    assert np.degrees(found) == pytest.approx(least, abs=0.75)


@pytest.mark.parametrize("degrees", [0, 90, 180, 270, 0.5])
def test_what_is_turned_onto_itself_or_hardly_is_not_turned(degrees):
    square = regular_polygon(4)
    assert rotation_between(polygon(square), polygon(3 * square * np.exp(1j * np.radians(degrees)))) is None


@pytest.mark.parametrize("degrees", [0, 17, 100, 180])
def test_a_circle_is_not_turned(degrees):
    one = flatten(circle_contour(), 100)
    other = polygon(one.vertices * np.exp(1j * np.radians(degrees)))
    assert rotation_between(one, other) is None


@given(rngs, st.integers(5, 20))
def test_unlike_outlines_are_not(rng, m):
    a = star_with(rng, m, teeth=3)
    assert rotation_between(polygon(a), polygon(arm(20, 60, 120))) is None


def test_a_mirror_image_is_not():
    z = arm(20, 60, 120)
    assert rotation_between(polygon(z), polygon(-z.conj()[::-1])) is None


def test_nor_is_an_outline_with_a_bite(rng):
    z = star_polygon(rng, 40, 0.1)
    bitten = z.copy()
    bitten[5:9] = 0.5 * (bitten[5:9] + z.mean())
    assert rotation_between(polygon(z), polygon(bitten * 1j)) is None


def test_open_lines_are_seen_from_both_ends():
    z = spiral(1.5)[:60]
    line = polygon(z, closed=False)
    for way in (1, -1):
        found = rotation_between(line, polygon(z[::way] * np.exp(0.9j), closed=False))
        assert found == pytest.approx(0.9, abs=0.01)
    assert rotation_between(line, polygon(z)) is None


def test_a_straight_line_has_no_way():
    line, across = polygon([0, 4], closed=False), polygon([0, 4j], closed=False)
    assert abs(np.degrees(rotation_between(line, across))) == pytest.approx(90)
    assert rotation_between(line, polygon([4, 0], closed=False)) is None
