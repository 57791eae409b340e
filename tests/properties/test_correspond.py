"""Polygons without SVG."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import shapeblend_cli as sb
from tests.support.shapes import random_polygon, star_polygon
from tests.support.solver import exhaustive
from tests.support.strategies import rngs, seeds


def polygons(seed, m=20, n=17):
    rng = np.random.default_rng(seed)
    return star_polygon(rng, m), star_polygon(rng, n)


@given(seeds, st.booleans(), st.booleans())
def test_numbers_are_those_given_whichever_way_round(seed, flip0, flip1):
    p0, p1 = polygons(seed)
    plain = sb.match(p0, p1)
    order0 = np.arange(20)[::-1] if flip0 else np.arange(20)
    order1 = np.arange(17)[::-1] if flip1 else np.arange(17)
    found = sb.match(p0[order0], p1[order1])
    assert found.work == pytest.approx(plain.work, rel=1e-9)
    there = {(int(order0[i]), int(order1[j])) for i, j in found.dots.tolist()}
    assert len(there & set(map(tuple, plain.dots.tolist()))) >= 0.9 * len(plain.dots)


def test_an_open_line_backwards_costs_nothing_and_pins_may_decide_for_it():
    line = np.array([0, 2, 2 + 1j, 3 + 1j, 5 + 4j])
    found = sb.match(line, 10 * line[::-1] + 7, closed=False)
    assert found.work == pytest.approx(0.0, abs=1e-9)
    assert found.dots.tolist() == [[k, 4 - k] for k in range(5)]
    forced = sb.match(line, 10 * line[::-1] + 7, closed=False, settings=sb.Settings(reverse="no"))
    assert forced.work > 0.1
    other = 3 * line[::-1] + 1
    pins = ((complex(line[1]), complex(other[3])), (complex(line[3]), complex(other[1])))
    found = sb.match(line, other, closed=False, settings=sb.Settings(pins=pins))
    assert found.dots.tolist() == [[k, 4 - k] for k in range(5)]
    with pytest.raises(sb.ShapeblendError, match=r"cross each other"):
        sb.match(line, other, closed=False, settings=sb.Settings(pins=pins, reverse="no"))


@given(rngs, st.sampled_from(["yes", "no"]))
def test_a_given_direction_is_solved_as_exhaustively(rng, reverse):
    p0, p1 = random_polygon(rng, 5), random_polygon(rng, 4)
    way = p1[::-1] if reverse == "yes" else p1
    found = sb.match(p0, p1, settings=sb.Settings(reverse=reverse))
    least = exhaustive(p0, way, True, sb.Settings().constants)
    assert found.work == pytest.approx(least, rel=1e-9, abs=1e-9)


def test_a_figure_of_eight_is_tried_both_ways():
    t = 2 * np.pi * np.arange(60) / 60
    eight = np.sin(t) + 0.5j * np.sin(2 * t)
    lopsided = np.where(eight.real > 0, 1.3, 1.0) * eight
    # Backwards an eight is another curve; the better of both ways is found whichever is given.
    for other in (lopsided, lopsided[::-1]):
        assert sb.match(lopsided, np.roll(other, 7)).work == pytest.approx(0.0, abs=1e-6)


def test_pins_and_stiff_points_are_those_of_the_polygons():
    p0, p1 = polygons(5)
    pin = (complex(p0[3]) + 1e-6, complex(p1[9]) + 1e-6)
    settings = sb.Settings(pins=(pin,), stiff=((complex(p0[3]), 0.2, 4.0),))
    assert [3, 9] in sb.match(p0, p1, settings=settings).dots.tolist()


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ([0, 1], "3 or more"),
        ([0, 1, float("nan")], "finite"),
        ([0, 1, 1, 1j], "coincide"),
        ([0, 1, 1j, 0], "coincide"),
        ([[0, 1], [1, 0]], "list of 3"),
    ],
)
def test_what_is_no_polygon_is_refused(points, words):
    with pytest.raises(ValueError, match=words):
        sb.match(points, [0, 1, 1j])
