"""What must hold for any two shapes, from contours to frames."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.model import Contour
from shapeblend_cli.options.constants import WorkConstants
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.wires.same_segments import MOST_OF_MANY
from tests.support.contours import circle_contour, drawing, polygon_contour
from tests.support.motions import blend
from tests.support.shapes import random_polygon, regular_polygon, star_polygon
from tests.support.solver import find_least
from tests.support.strategies import rngs, seeds

counts = st.integers(3, 30)
constants = st.builds(
    WorkConstants,
    k_s=st.floats(0.1, 5),
    k_b=st.floats(0.1, 5),
    e_s=st.sampled_from([1.0, 1.5, 2.0]),
    e_b=st.sampled_from([0.5, 1.0, 2.0]),
    p_b=st.floats(0, 2000),
    m_b=st.floats(0, 20),
    c_s=st.floats(0.1, 1),
)
similarities = st.builds(
    Similarity, st.floats(0.01, 100), st.builds(complex, st.floats(-50, 50), st.floats(-50, 50)), st.just(0j)
)
ASIS = Settings(place="asis", vertices=40, motion="linear")


def match(a, b, settings):
    pair, _ = blend(a, b, settings)
    return pair


def star(seed, m):
    return star_polygon(np.random.default_rng(seed), m)


# With e_b < 1 the rounding of angles, 1e-13 radians and the like, would be raised to something visible.
@given(seeds, counts, similarities, st.integers(0, 29), constants.filter(lambda c: c.e_b >= 1.0))
def test_a_shape_and_itself_moved_scaled_begun_elsewhere_cost_nothing(seed, m, similarity, start, constants):
    p = star(seed, m)
    a = drawing(polygon_contour(p))
    b = drawing(polygon_contour(similarity.points(np.roll(p, start))), file="b.svg")
    pair = match(a, b, ASIS.replace(**{name: getattr(constants, name) for name in WorkConstants.options}))
    found = pair.contours[0].correspondence
    assert found.work < 1e-7
    p0, p1 = (polygon.vertices for polygon in (pair.contours[0].polygon_a, pair.contours[0].polygon_b))
    assert found.dots[:, 0].tolist() == list(range(len(p0)))
    np.testing.assert_allclose(similarity.points(p0), p1[found.dots[:, 1]], atol=1e-9 * (1 + abs(p1).max()))


@given(seeds, counts)
def test_a_shape_reversed_costs_nothing(seed, m):
    p = star(seed, m)
    pair = match(drawing(polygon_contour(p)), drawing(polygon_contour(p[::-1])), ASIS)
    assert pair.contours[0].correspondence.work < 1e-7


@given(rngs, counts, counts, st.booleans(), constants)
def test_swapping_keeps_the_work(rng, m, n, closed, constants):
    p0, p1 = random_polygon(rng, m), random_polygon(rng, n)
    there, back = find_least(p0, p1, closed, constants), find_least(p1, p0, closed, constants)
    assert there.work == pytest.approx(back.work, rel=1e-9, abs=1e-9)


@given(rngs, counts, counts, constants)
def test_reversing_or_mirroring_both_keeps_the_work(rng, m, n, constants):
    p0, p1 = random_polygon(rng, m), random_polygon(rng, n)
    work = find_least(p0, p1, True, constants).work
    assert find_least(p0[::-1], p1[::-1], True, constants).work == pytest.approx(work, rel=1e-9, abs=1e-9)
    assert find_least(p0.conj(), p1.conj(), True, constants).work == pytest.approx(work, rel=1e-9, abs=1e-9)


@given(seeds, counts, counts, st.booleans())
def test_frames_at_both_ends_are_the_drawings(seed, m, n, curves):
    a, b = (drawing(polygon_contour(star(seed + k, count))) for k, count in enumerate((m, n)))
    pair, frames = blend(a, b, ASIS.replace(frames=0, ends=True, curves=curves))
    (contour,) = pair.contours
    dots = contour.correspondence.dots
    sides = zip(frames, dots.T, (contour.polygon_a, contour.polygon_b), (a, b), strict=True)
    for frame, side, polygon, shape in sides:
        found = frame.shapes[0].paths[0].segments
        drawn = shape.shapes[0].contours[0].segments if curves else polygon.vertices[side]
        np.testing.assert_array_equal(found if curves else found[:, 0], drawn)
        assert len(frame.shapes[0].paths) == 1


@settings(max_examples=10)  # each is a whole blend
@given(rngs, counts)
def test_curves_and_lines_of_any_mixture_blend(rng, count):
    nodes = rng.random(count) + 1j * rng.random(count)
    inner = rng.random((count, 2)) + 1j * rng.random((count, 2))
    segments = np.column_stack([nodes, inner, np.roll(nodes, -1)])
    scribble = Contour(segments, np.zeros(count, bool), True)
    circle = drawing(circle_contour(), file="b.svg")
    pair, frames = blend(drawing(scribble), circle, ASIS.replace(place="bbox"))
    assert len(frames) == 5
    assert all(np.isfinite(frame.shapes[0].paths[0].segments).all() for frame in frames)
    # Where both can be drawn with as many segments it may take more than the least work.
    assert pair.contours[0].correspondence.gap <= 1.0 - 1.0 / MOST_OF_MANY


def test_two_circles_of_other_counts_stay_round():
    p0, p1 = regular_polygon(60), regular_polygon(47)
    dots = find_least(p0, p1, True).dots
    halfway = (p0[dots[:, 0]] + p1[dots[:, 1]]) / 2
    centre = (p0.mean() + p1.mean()) / 2
    assert abs(halfway - centre).min() > 0.4
