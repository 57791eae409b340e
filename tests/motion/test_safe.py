"""Motion that does not cross itself."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.job.report import measure
from shapeblend_cli.model import CubicPath
from shapeblend_cli.motion.safe import find_route, follow_route
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read
from tests.support.contours import circle_contour, polygon_contour
from tests.support.motions import moving_curves, moving_polygons, moving_shape, rigidly, similarity_of
from tests.support.shapes import arm, bar, comb, spiral, star_polygon
from tests.support.strategies import rngs

TIMES = np.linspace(0.0, 1.0, 52)[1:-1]


def safely(shape):
    """The shape in safe motion."""
    route = find_route(shape, similarity_of(shape))
    assert route is not None, "no route"
    return follow_route(route)


def crossed(shape):
    """At how many times there are crossings."""
    return sum(path_crossings(paths_at(shape, t)) > 0 for t in TIMES)


def mirrored(z):
    """The mirror image, in the same direction."""
    return -np.conj(z[::-1])


BY_HAND = {
    "a bar and a spiral": (bar(), spiral(2.0)),
    "a spiral and a bar": (spiral(3.0), bar()),
    "a spiral and its mirror image": (spiral(2.0), mirrored(spiral(2.0))),
    "two spirals": (spiral(1.5), spiral(3.0) * 1j),
    "combs with their teeth on both sides": (comb(4), np.roll(comb(4)[::-1].conj(), 9)),
    "combs, tooth for gap": (comb(5), np.roll(comb(5), 6)),
    "an arm to the left and to the right": (arm(80, 140, 200, 250), arm(10, -40, -100, -150)),
    "an arm and a star": (arm(20, 60, 120, 170), star_polygon(np.random.default_rng(3), 14)),
}


@pytest.mark.parametrize("name", BY_HAND)
def test_where_straight_paths_cross_it_does_not_and_goes_there_steadily(name):
    straight = moving_polygons(BY_HAND[name])
    assert [path_crossings(paths_at(straight, t)) for t in (0.0, 1.0)] == [0, 0]
    assert crossed(straight) > 0
    shape = safely(straight)
    assert shape.motion.name == "safe"
    assert crossed(shape) == 0
    start, *others, end = (paths_at(shape, t)[0].segments for t in np.linspace(0.0, 1.0, 101))
    np.testing.assert_array_equal(start, shape.contours[0].start.segments)
    np.testing.assert_array_equal(end, shape.contours[0].end.segments)
    every = np.array([start, *others, end])
    size = max(np.ptp(z.real) for z in (start, end))
    assert np.isfinite(every).all()
    assert abs(np.diff(every, axis=0)).max() < 0.12 * size
    for t, side in ((1e-6, start), (1.0 - 1e-6, end)):
        assert abs(paths_at(shape, t)[0].segments - side).max() < 1e-4 * size


@settings(max_examples=15)
@given(rngs, st.integers(4, 40), st.floats(0.2, 0.9))
def test_any_two_simple_outlines_have_a_route(rng, m, roughness):
    a, b = (star_polygon(rng, m, roughness) for _ in range(2))
    assert crossed(safely(moving_polygons((a, np.roll(b, rng.integers(0, m)))))) == 0


def test_without_crossings_on_its_way_it_is_the_rigid_motion(rng):
    a = star_polygon(rng, 12, 0.2)
    shape = moving_polygons((a, a * np.exp(1.2j) + 5.0))
    safe, rigid = safely(shape), rigidly(shape)
    for t in (0.1, 0.25, 0.5, 0.75, 0.9):
        np.testing.assert_allclose(paths_at(safe, t)[0].segments, paths_at(rigid, t)[0].segments, atol=1e-3)
    assert (safe.motion.levels == 0.0).all()


def test_lines_stay_lines():
    shape = safely(moving_polygons(BY_HAND["a spiral and its mirror image"]))
    for t in (0.2, 0.5, 0.8):
        (path,) = paths_at(shape, t)
        assert path.straight.all()
        thirds = path.segments[:, :1] + np.diff(path.segments[:, ::3]) * [0, 1 / 3, 2 / 3, 1]
        np.testing.assert_allclose(path.segments, thirds, atol=1e-9)


def test_curves_and_lines_together_become_curves():
    (contour,) = moving_polygons(BY_HAND["a bar and a spiral"]).contours
    straight = np.arange(len(contour.start.segments)) % 7 > 0
    start, end = (CubicPath(path.segments, straight, True) for path in (contour.start, contour.end))
    shape = safely(moving_shape(contour._replace(start=start, end=end)))
    assert crossed(shape) == 0
    assert not shape.contours[0].start.straight.any()
    np.testing.assert_array_equal(shape.contours[0].start.segments, start.segments)


def test_a_hole_stays_in_its_outline():
    def circle(centre, radius):
        return circle_contour(centre, radius).segments

    exterior = moving_curves(circle(0j, 3.0), np.roll(circle(0j, 3.0), 4, axis=0))
    hole = moving_curves(circle(0j, 1.0), np.roll(circle(1.2 + 1j, 1.2), 4, axis=0))
    assert crossed(safely(moving_shape(exterior, hole))) == 0


def test_crossings_of_the_ends_are_allowed():
    eight = np.array([0, 3 + 1j, 3 - 1j, 0, -2 + 1j, -2 - 1j])
    shape = safely(moving_polygons((eight, 2.0 * np.roll(eight, 1))))
    for t in TIMES:
        assert np.isfinite(paths_at(shape, t)[0].segments).all()
        assert path_crossings(paths_at(shape, t)) <= 1


def test_open_lines():
    line = spiral(1.5)[:60]
    assert path_crossings([polygon_contour(line, closed=False)]) == 0
    assert crossed(safely(moving_polygons((line, -line.conj()), closed=False))) == 0


def test_the_antlers_of_figure_27_do_not_cross(samples):
    """Straight ones do by the paper's work, with m_b = 10 as all its rows of table 1; by turning they need no help."""
    drawings = [read(str(samples / f"{name}.svg")) for name in ("cow", "deer")]
    paper = Settings(preset="paper", m_b=10.0)
    crossings = []
    for wanted in (paper.replace(motion="linear"), paper.replace(motion="safe"), Settings(motion="linear")):
        (pair,), _ = match_all(drawings, wanted)
        crossings.append(max(measure(pair, t / 20).self_crossings for t in range(21)))
    straight, safe, by_turning = crossings
    assert straight > 0
    assert (safe, by_turning) == (0, 0)
