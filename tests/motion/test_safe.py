"""Motion that does not cross itself."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.interpolate.paths import between
from shapeblend_cli.measure import measure
from shapeblend_cli.model import CubicPath
from shapeblend_cli.motion.alignment import Rigid
from shapeblend_cli.motion.safe import find_route, follow_route
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.settings import Settings
from shapeblend_cli.svg.reading.read import read
from tests.conftest import SAMPLES
from tests.support.contours import circle_contour
from tests.support.motions import moving_polygons, outline, similarity_of
from tests.support.shapes import arm, bar, comb, spiral, star_polygon
from tests.support.strategies import rngs

TIMES = np.linspace(0.0, 1.0, 52)[1:-1]


def made_safe(shape):
    found = find_route(shape, similarity_of(shape))
    assert found is not None, "no way"
    return follow_route(found)


def crossed(shape):
    """At how many times there are crossings."""
    return sum(path_crossings(between(shape, t)) > 0 for t in TIMES)


def mirrored(z):
    """The mirror image, gone through the same way round."""
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
def test_where_straight_paths_cross_it_does_not(name):
    straight = moving_polygons(BY_HAND[name])
    assert [path_crossings(between(straight, t)) for t in (0.0, 1.0)] == [0, 0]
    assert crossed(straight) > 0
    found = made_safe(straight)
    assert found.motion.name == "safe"
    assert crossed(found) == 0


@settings(max_examples=15)
@given(rngs, st.integers(4, 40), st.floats(0.2, 0.9))
def test_any_two_simple_outlines_have_a_way(rng, m, roughness):
    a, b = (star_polygon(rng, m, roughness) for _ in range(2))
    assert crossed(made_safe(moving_polygons((a, np.roll(b, rng.integers(0, m)))))) == 0


@pytest.mark.parametrize("name", BY_HAND)
def test_it_starts_and_ends_as_drawn_and_goes_there_steadily(name):
    shape = made_safe(moving_polygons(BY_HAND[name]))
    for t, side in ((0.0, "start"), (1.0, "end")):
        (picture,) = between(shape, t)
        np.testing.assert_array_equal(picture.segments, getattr(shape.contours[0], side).segments)
    every = np.array([between(shape, t)[0].segments for t in np.linspace(0.0, 1.0, 101)])
    size = max(np.ptp(every[k].real) for k in (0, -1))
    assert np.isfinite(every).all()
    assert abs(np.diff(every, axis=0)).max() < 0.12 * size
    near = [between(shape, t)[0].segments for t in (1e-6, 1.0 - 1e-6)]
    assert abs(near[0] - every[0]).max() < 1e-4 * size
    assert abs(near[1] - every[-1]).max() < 1e-4 * size


def test_without_crossings_on_its_way_it_is_the_rigid_motion(rng):
    a = star_polygon(rng, 12, 0.2)
    shape = moving_polygons((a, a * np.exp(1.2j) + 5.0))
    found = made_safe(shape)
    rigid = shape._replace(motion=Rigid(similarity_of(shape)))
    for t in (0.1, 0.25, 0.5, 0.75, 0.9):
        np.testing.assert_allclose(between(found, t)[0].segments, between(rigid, t)[0].segments, atol=1e-6)
    assert (found.motion.levels == 0.0).all()


def test_lines_stay_lines():
    shape = made_safe(moving_polygons(BY_HAND["a spiral and its mirror image"]))
    for t in (0.2, 0.5, 0.8):
        (picture,) = between(shape, t)
        assert picture.straight.all()
        thirds = picture.segments[:, :1] + np.diff(picture.segments[:, ::3]) * [0, 1 / 3, 2 / 3, 1]
        np.testing.assert_allclose(picture.segments, thirds, atol=1e-9)


def test_curves_and_lines_together_become_curves():
    shape = moving_polygons(BY_HAND["a bar and a spiral"])
    (contour,) = shape.contours
    straight = np.arange(len(contour.start.segments)) % 7 > 0
    start, end = (CubicPath(one.segments, straight, True) for one in (contour.start, contour.end))
    shape = shape._replace(contours=(contour._replace(start=start, end=end),))
    found = made_safe(shape)
    assert crossed(found) == 0
    assert not found.contours[0].start.straight.any()
    np.testing.assert_array_equal(found.contours[0].start.segments, start.segments)


def test_a_hole_stays_in_its_outline():
    ring = [circle_contour(0j, r).segments for r in (3.0, 1.0)]
    far = [circle_contour(0j, 3.0).segments, circle_contour(1.2 + 1j, 1.2).segments]
    curved = np.zeros(8, bool)
    places = (np.arange(9.0), np.arange(9.0))
    base = moving_polygons((ring[0][:, 0], far[0][:, 0]), (ring[1][:, 0], far[1][:, 0]))
    contours = tuple(
        c._replace(
            start=CubicPath(a, curved, True),
            end=CubicPath(np.roll(b, 4, axis=0), curved, True),
            cuts=places,
        )
        for c, a, b in zip(base.contours, ring, far, strict=True)
    )
    found = made_safe(base._replace(contours=contours))
    assert crossed(found) == 0


def test_crossings_of_the_ends_are_allowed():
    eight = np.array([0, 3 + 1j, 3 - 1j, 0, -2 + 1j, -2 - 1j])
    found = made_safe(moving_polygons((eight, 2.0 * np.roll(eight, 1))))
    for t in TIMES:
        assert np.isfinite(between(found, t)[0].segments).all()
        assert path_crossings(between(found, t)) <= 1


def test_open_lines():
    shape = moving_polygons((spiral(1.5)[:60], -spiral(1.5)[:60].conj()), closed=False)
    assert path_crossings([outline(spiral(1.5)[:60], closed=False)]) == 0
    found = made_safe(shape)
    assert crossed(found) == 0


def test_the_antlers_of_figure_27_do_not_cross():
    """Straight ones do: the paper's figure 27, with m_b = 10 as all its rows of table 1."""
    cow, deer = (read(str(SAMPLES / f"{name}.svg")) for name in ("cow", "deer"))
    crossings = {}
    for motion in ("linear", "auto"):
        (pair,), _ = match_all([cow, deer], Settings(motion=motion, m_b=10.0))
        crossings[motion] = [measure(pair, t / 20).self_crossings for t in range(21)]
    assert max(crossings["linear"]) > 0
    assert max(crossings["auto"]) == 0
