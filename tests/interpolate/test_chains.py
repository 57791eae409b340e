"""Chains: what continues from pair to pair as one path."""

from dataclasses import replace
from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString

from shapeblend_cli.interpolate.chains import keyframed_shapes
from shapeblend_cli.interpolate.paths import paths_at, waypoints
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from tests.support.contours import drawing as contour_drawing
from tests.support.contours import polygon_contour, polyline
from tests.support.drawings import BAR, EIGHT, EYED, LEAF, RING, SQUARES, B, drawing
from tests.support.motions import rotated
from tests.support.shapes import star_polygon
from tests.support.strategies import rngs

pytestmark = pytest.mark.usefixtures("blended_once")

EVENODD = 'fill-rule="evenodd"'
CIRCLE = "M22 12A10 10 0 1 0 2 12A10 10 0 1 0 22 12Z"
STAR = "M12 2 15 9 22 9 17 14 19 22 12 17 5 22 7 14 2 9 9 9Z"
DROP = "M12 2C14 8 20 10 20 16C20 20 16 22 12 22C8 22 4 20 4 16C4 10 10 8 12 2Z"
LINES = [
    f'<path d="{d}" fill="none" stroke="#000"/>'
    for d in ("M2 2L20 9L9 20", "M20 20C20 5 9 2 2 9", "M2 9H12V20H20")
]


def pairs_of(*paths, curves=True):
    settings = Settings(curves=curves, motion="linear", strokes="keep")
    return match_all([drawing(p, attributes=EVENODD) for p in paths], settings)[0]


def line(outline):
    points = np.append(polyline(outline, 40), outline.segments[-1, 3])
    return LineString(np.stack([points.real, points.imag], axis=1))


SAME_CONTOURS = [
    (CIRCLE, STAR, DROP),
    (DROP, CIRCLE, DROP, LEAF, BAR),
    (LEAF, LEAF, LEAF),
    (STAR, BAR, STAR, BAR),
    (B, EIGHT, B),
    (RING, RING, RING),
    tuple(LINES),
    (LINES[0], LINES[1], LINES[2].replace("M2 9H12V20H20", "M20 20H12V9H2"), LINES[1]),
]

# Drawings are 20 large. A line between two curves is divided unevenly for the one, and so not quite for the other.
NEAR = 0.15


def keyed_paths_at(shape, k, t):
    """The paths of a keyframed shape at a time after its key k, straight from waypoint to waypoint."""
    stations = [(0.0, shape.keys[k].paths), *shape.waypoints[k], (1.0, shape.keys[k + 1].paths)]
    for (low, before), (high, after) in pairwise(stations):
        if low <= t <= high:
            u = (t - low) / (high - low)
            return [
                replace(p, segments=(1 - u) * p.segments + u * q.segments)
                for p, q in zip(before, after, strict=True)
            ]
    raise AssertionError("waypoints out of order")


def chained(pairs, times=(0.5,)):
    """The keyframed shapes of pairs; within each pair every outline must be one of the pair's own."""
    shapes = keyframed_shapes(pairs)
    for pair, t in product(pairs, times):
        own = [line(path) for shape in pair.shapes for path in paths_at(shape, t)]
        here = [shape for shape in shapes if shape.first <= pair.a < shape.first + len(shape.keys) - 1]
        lines = [line(path) for shape in here for path in keyed_paths_at(shape, pair.a - shape.first, t)]
        assert len(lines) == len(own)
        for one in own:
            assert min(one.hausdorff_distance(other) for other in lines) < NEAR
    return shapes


def assert_alike(paths):
    """All have the same commands, and are joined without gaps."""
    assert len({(p.segments.shape, p.straight.tobytes(), p.closed) for p in paths}) == 1
    for path in paths:
        assert np.abs(path.segments[1:, 0] - path.segments[:-1, 3]).max(initial=0.0) < 1e-9


KINDS = [(paths, True) for paths in SAME_CONTOURS] + [(paths, False) for paths in SAME_CONTOURS[1::3]]
"""Contours, and whether they are blended as curves or as polygons."""


@pytest.mark.parametrize(("paths", "curves"), KINDS)
def test_equal_contours_make_one_path_of_equal_commands(paths, curves):
    pairs = pairs_of(*paths, curves=curves)
    (shape,) = chained(pairs)
    assert (shape.first, len(shape.keys)) == (0, len(paths))
    assert shape.waypoints == ((),) * (len(paths) - 1)
    for outlines in zip(*(key.paths for key in shape.keys), strict=True):
        assert_alike(outlines)
    for k, pair in enumerate(pairs):
        for shapes, key in ((pair.drawn[0], shape.keys[k]), (pair.drawn[1], shape.keys[k + 1])):
            drawn = [line(path) for painted in shapes for path in painted.paths]
            for path in key.paths:
                apart = min(line(path).hausdorff_distance(other) for other in drawn)
                assert apart < (0.01 if curves else 0.05)


# The last rotates back, and the others by different angles, so each has waypoints of its own.
TURNS = (120.0, 45.0, -75.0, 170.0)


@pytest.mark.parametrize(("paths", "curves"), KINDS)
def test_waypoints_are_cut_as_the_keys_are(paths, curves):
    pairs = [
        rotated(pair, degrees) for pair, degrees in zip(pairs_of(*paths, curves=curves), TURNS, strict=False)
    ]
    (shape,) = chained(pairs, (0.01, 0.25, 0.5, 0.8, 0.99))
    assert len(shape.waypoints) == len(shape.keys) - 1
    for pair, points in zip(pairs, shape.waypoints, strict=True):
        assert [point.t for point in points] == [point.t for point in waypoints(pair.shapes[0])]
        assert (len(pair.shapes), len(points) > 3) == (1, True)
        for outlines in zip(shape.keys[0].paths, *(point.paths for point in points), strict=True):
            assert_alike(outlines)


def test_pairs_that_move_straight_have_no_waypoints_among_others_that_do_not():
    pairs = pairs_of(STAR, DROP, CIRCLE, STAR)
    pairs[1] = rotated(pairs[1])
    (shape,) = chained(pairs, (0.01, 0.3, 0.99))
    assert [len(points) > 0 for points in shape.waypoints] == [False, True, False]


def test_each_coat_of_paint_has_the_waypoints():
    stops = '<stop stop-color="#f00"/><stop offset="1" stop-color="#00f"/>'
    leaf = f'<path d="{LEAF}" fill="url(#g)"/>'
    gradients = [f'<{kind}Gradient id="g">{stops}</{kind}Gradient>{leaf}' for kind in ("linear", "radial")]
    (pair,) = pairs_of(*gradients)
    below, above = keyframed_shapes([rotated(pair)])
    assert below.keys[0].style != above.keys[0].style
    assert below.waypoints == above.waypoints
    assert len(above.waypoints[0]) > 3


def spans(shapes):
    """Of each shape its first drawing and the number of its keys."""
    return [(shape.first, len(shape.keys)) for shape in shapes]


def test_a_shape_of_other_contours_than_before_ends_there():
    assert spans(chained(pairs_of(EYED, LEAF, EYED))) == [(0, 2), (1, 2)]
    pairs = pairs_of(SQUARES, BAR, SQUARES)
    assert spans(chained(pairs)) == [(0, 2), (1, 2)]
    chained([rotated(pair) for pair in pairs], (0.01, 0.2, 0.99))


def test_some_shapes_continue_and_others_do_not():
    def shapes(*paths):
        return "".join(
            f'<path d="{p}" fill="{c}"/>' for p, c in zip(paths, ("#f00", "#0a0", "#00f"), strict=False)
        )

    corner, other = "M0 0H3V3H0Z", "M20 0L24 0L24 4Z"
    pairs = pairs_of(shapes(STAR, corner, other), shapes(DROP, corner), shapes(LEAF, other, corner))
    assert sorted(spans(chained(pairs))) == [(0, 2), (0, 3), (0, 3), (1, 2)]


def test_an_outline_that_was_opened_for_a_line_does_not_continue_closed():
    ring = '<circle cx="12" cy="12" r="8" fill="none" stroke="#000"/>'
    square = '<path d="M4 4H20V20H4Z" fill="none" stroke="#000"/>'
    assert spans(keyframed_shapes(pairs_of(LINES[0], ring, square))) == [(0, 2), (1, 2)]


@given(rngs, st.lists(st.integers(3, 12), min_size=3, max_size=4), st.booleans())
def test_any_polygons_in_any_direction(rng, counts, curves):
    drawings = []
    for count in counts:
        z = star_polygon(rng, count) * 10
        drawings.append(contour_drawing(polygon_contour(z[::-1] if rng.random() < 0.5 else z)))
    pairs, _ = match_all(drawings, Settings(vertices=20, curves=curves, place="asis", motion="linear"))
    assert [len(shape.keys) for shape in chained(pairs)] == [len(counts)]
    chained([rotated(pair, 100.0, 5 + 5j) for pair in pairs], (0.01, 0.4))
