import numpy as np
import pytest

from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.model import Box
from shapeblend_cli.pairing.growth import MatchedPoints, carried, growth_point_inside, nearest_paired
from tests.support.contours import polyline
from tests.support.drawings import drawing
from tests.support.motions import pair_of

# A crescent: the middle of its box is outside of it.
angle = np.linspace(0.6, 2 * np.pi - 0.6, 60)
CRESCENT = np.concatenate([10 * np.exp(1j * angle), 7 * np.exp(1j * angle[::-1])])
CIRCLE = 10 * np.exp(2j * np.pi * np.arange(120) / 120)
HOLE = np.exp(2j * np.pi * np.arange(12) / 12)


def test_a_hole_grows_from_where_it_is():
    assert growth_point_inside(5 + HOLE, MatchedPoints(CIRCLE, CIRCLE)) == pytest.approx(5.0)
    assert growth_point_inside(5 + HOLE, MatchedPoints(CIRCLE, 3j + 0.5 * CIRCLE)) == pytest.approx(2.5 + 3j)


def windings_of_growing_hole(point, around):
    """How often the contour around it winds round each vertex of a growing hole, at several times."""
    for t in np.linspace(0.05, 0.95, 19):
        yield winding_numbers((1 - t) * point + t * HOLE, (1 - t) * around.there + t * around.here)


def test_a_hole_stays_inside_all_the_way():
    exterior = MatchedPoints(CIRCLE, CRESCENT)
    point = growth_point_inside(HOLE, exterior)
    assert all(numbers.all() for numbers in windings_of_growing_hole(point, exterior))


def test_a_hole_keeps_away_from_its_neighbours():
    other = MatchedPoints(HOLE + 5, 4 * HOLE)
    point = growth_point_inside(HOLE, MatchedPoints(CIRCLE, CIRCLE), [other])
    assert not any(numbers.any() for numbers in windings_of_growing_hole(point, other))


def test_in_a_drawing_too():
    """A hole grows where another one was, which moves away."""
    left, right = "M6 17V23H14V17Z", "M26 17V23H34V17Z"
    a, b = (drawing("M0 0H40V40H0Z" + holes, viewbox="0 0 40 40") for holes in (left, right + left))
    pair = pair_of(a, b, motion="linear", match=(("1", "1"),))
    for t in np.linspace(0.0, 1.0, 11):
        (shape,) = shapes_at(pair, t)
        moving, growing = (polyline(path, 1) for path in shape.paths[1:])
        assert not winding_numbers(growing, moving).any()


def test_the_nearest_contour_here_is_found():
    near, far = MatchedPoints(CIRCLE + 30, CIRCLE * 1j), MatchedPoints(CIRCLE - 50, CIRCLE)
    bounds = np.array([Box.around(one.here).bounds for one in (far, near)])
    index, distance = nearest_paired(45 + CIRCLE / 10, [far, near], bounds)
    assert index == 1
    assert distance == pytest.approx(4, abs=0.1)


@pytest.mark.parametrize("inside", [True, False])
def test_a_point_goes_where_the_contour_around_it_goes(inside):
    moved = MatchedPoints(CIRCLE, CIRCLE + 7 - 2j)
    assert carried(3 + 4j, moved, inside=inside) == pytest.approx(10 + 2j)


def test_a_point_inside_turns_and_grows_with_the_contour():
    assert carried(3 + 4j, MatchedPoints(CIRCLE, 2j * CIRCLE), inside=True) == pytest.approx(2j * (3 + 4j))
