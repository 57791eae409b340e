"""Where outlines share most of their length, only what they do not share moves."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.flat_contour import FlatContour
from shapeblend_cli.geometry.polygons import signed_area
from shapeblend_cli.geometry.polyline import from_end_to_end, nearest_places
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Polygon
from shapeblend_cli.wires.shared import solve_with_shared
from tests.support.contours import polygon_contour
from tests.support.drawings import drawing
from tests.support.motions import pair_of
from tests.support.solver import match_of

PLUS = [
    (2, 10),
    (10, 10),
    (10, 2),
    (14, 2),
    (14, 10),
    (22, 10),
    (22, 14),
    (14, 14),
    (14, 22),
    (10, 22),
    (10, 14),
    (2, 14),
]
MINUS = [(2, 10), (22, 10), (22, 14), (2, 14)]
LEFT, RIGHT = (
    "M12 21C4 15 2 11 2 7C2 4 4 2 7 2C9 2 11 3 12 5",
    "C13 3 15 2 17 2C20 2 22 4 22 7C22 11 20 15 12 21Z",
)
HEART, BROKEN = LEFT + RIGHT, LEFT + "L10 8L13 10L11 12L14 9.5L11 8L12 5" + RIGHT


def path(points):
    return "M" + " ".join(f"{x},{y}" for x, y in points) + "Z"


def blend(a, b, **options):
    """The only shape of two documents, each of one path, on straight paths."""
    (shape,) = pair_of(drawing(a), drawing(b), motion="linear", **options).shapes
    return shape


def nodes(shape, t):
    (outline,) = paths_at(shape, t)
    return outline.segments[:, 0]


@pytest.mark.parametrize("turn", range(0, 12, 5))
@pytest.mark.parametrize("is_reversed", [False, True])
def test_the_arms_of_a_plus_go_straight_in(turn, is_reversed):
    minus = MINUS[::-1] if is_reversed else MINUS
    for shape, times in (
        (blend(path(PLUS[turn:] + PLUS[:turn]), path(minus)), (0.25, 0.5, 0.75)),
        (blend(path(minus), path(PLUS[turn:] + PLUS[:turn])), (0.75, 0.5, 0.25)),
    ):
        for t, share in zip((0.25, 0.5, 0.75), times, strict=True):
            z = nodes(shape, t)
            assert abs(signed_area(z)) == pytest.approx(80 + (1 - share) * 64, rel=5e-3)
            out = np.abs(z.imag - 12) > 2.01
            assert np.abs(np.abs(z.real[out] - 12) - 2).max() < 0.1


@pytest.mark.parametrize("vertices", [40, 200])
def test_what_is_shared_rests(vertices):
    shape = blend(HEART, BROKEN, vertices=vertices)
    (whole,) = paths_at(shape, 0.0)
    outline = cubics.evaluate(whole.segments[:, None, :], np.arange(64) / 64).ravel()
    for t in (0.3, 0.6):
        z = nodes(shape, t)
        beside = z[(z.real < 9.9) | (z.real > 14.1) | (z.imag > 12.1)]
        assert len(beside) > 4
        assert nearest_places(beside, from_end_to_end(outline, closed=True))[0].max() < 0.03


def test_a_limb_that_swings_is_no_limb_that_goes_in():
    """As much is shared, but holding that takes far more work than letting go."""
    standing = path([(0, 0), (6, 0), (6, 8), (8, 20), (5, 20), (3, 9), (1, 20), (-2, 20), (0, 8)])
    striding = path([(0, 0), (6, 0), (6, 8), (14, 17), (12, 19), (3, 9), (1, 20), (-2, 20), (0, 8)])
    shape = blend(standing, striding)
    (contour,) = shape.contours
    assert contour.correspondence.work <= 1.15 * contour.correspondence.lower_bound + 1e-9


@settings(max_examples=25)  # each is a whole blend
@given(st.integers(0, 2**32 - 1))
def test_a_held_match_is_a_path_and_no_less_than_the_least(seed):
    rng = np.random.default_rng(seed)
    radius = 10 + 4 * rng.random(24)
    z = radius * np.exp(2j * np.pi * np.arange(24) / 24)
    w = z.copy()
    some = int(rng.integers(1, 9))
    w[:some] *= rng.uniform(0.3, 1.8)
    shape = blend(path((p.real, p.imag) for p in z), path((p.real, p.imag) for p in w), vertices=60)
    (contour,) = shape.contours
    found = contour.correspondence
    counts = len(contour.polygon_a.vertices), len(contour.polygon_b.vertices)
    moves = (np.roll(found.dots, -1, axis=0) - found.dots) % counts
    assert moves.max() <= 1
    assert moves.any(axis=1).all()
    assert (moves.sum(axis=0) == counts).all()
    assert found.lower_bound <= found.work * (1 + 1e-9)


def test_outlines_that_share_little_are_left_alone():
    flats = []
    for points in (PLUS, [(x + 3, y + 3) for x, y in MINUS]):
        contour = polygon_contour(np.array([complex(*p) for p in points]))
        count = len(points)
        polygon = Polygon(contour.segments[:, 0], np.arange(count), np.zeros(count), True)
        flats.append(FlatContour(contour, polygon))
    assert solve_with_shared(match_of(*flats)) is None
