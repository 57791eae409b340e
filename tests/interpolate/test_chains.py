"""Sequences: what goes on from pair to pair as one path."""

from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString

from shapeblend_cli.interpolate.chains import keyframed_shapes
from shapeblend_cli.interpolate.paths import between, waypoints
from shapeblend_cli.model import ShapeBlend, Style
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.settings import Settings
from tests.support.contours import drawing as contour_drawing
from tests.support.contours import polygon_contour, polyline
from tests.support.drawings import BAR, EIGHT, EYED, LEAF, RING, SQUARES, B, drawing
from tests.support.motions import contour_blend, turned
from tests.support.shapes import star_polygon
from tests.support.strategies import rngs

EVENODD = 'fill-rule="evenodd"'
CIRCLE = "M22 12A10 10 0 1 0 2 12A10 10 0 1 0 22 12Z"
STAR = "M12 2 15 9 22 9 17 14 19 22 12 17 5 22 7 14 2 9 9 9Z"
DROP = "M12 2C14 8 20 10 20 16C20 20 16 22 12 22C8 22 4 20 4 16C4 10 10 8 12 2Z"
LINES = [
    f'<path d="{d}" fill="none" stroke="#000"/>'
    for d in ("M2 2L20 9L9 20", "M20 20C20 5 9 2 2 9", "M2 9H12V20H20")
]


def pairs_of(*paths, curves=True):
    pairs, _ = match_all(
        [drawing(p, attributes=EVENODD) for p in paths], Settings(curves=curves, motion="linear")
    )
    return pairs


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


def outlines_at(track, k, t):
    """The outlines of a track at a time after its key k, straight from waypoint to waypoint."""
    stations = [
        (0.0, track.keys[k].paths),
        *((waypoint.t, waypoint.paths) for waypoint in track.waypoints[k]),
        (1.0, track.keys[k + 1].paths),
    ]
    for (low, before), (high, after) in pairwise(stations):
        if low <= t <= high:
            contours = tuple(
                contour_blend(start, end, (np.zeros(1), np.zeros(1)))
                for start, end in zip(before, after, strict=True)
            )
            return between(ShapeBlend(contours, Style(), Style()), (t - low) / (high - low))
    raise AssertionError("waypoints out of order")


def assert_goes_the_same_way(pairs, found, times=(0.5,)):
    """Within each pair every outline of the tracks is one of the pair's own."""
    for pair, t in product(pairs, times):
        own = [line(outline) for shape in pair.shapes for outline in between(shape, t)]
        here = [track for track in found if track.first <= pair.a < track.first + len(track.keys) - 1]
        outlines = [line(o) for track in here for o in outlines_at(track, pair.a - track.first, t)]
        assert len(outlines) == len(own)
        for outline in own:
            assert min(outline.hausdorff_distance(other) for other in outlines) < NEAR


@pytest.mark.parametrize("curves", [True, False])
@pytest.mark.parametrize("paths", SAME_CONTOURS)
def test_equal_contours_make_one_path_of_equal_commands(paths, curves):
    pairs = pairs_of(*paths, curves=curves)
    found = keyframed_shapes(pairs)
    (track,) = found
    assert (track.first, len(track.keys)) == (0, len(paths))
    assert track.waypoints == ((),) * (len(paths) - 1)
    for outlines in zip(*(key.paths for key in track.keys), strict=True):
        assert len({o.segments.shape for o in outlines}) == 1
        assert len({o.straight.tobytes() for o in outlines}) == 1
        for o in outlines:
            joints = np.abs(o.segments[1:, 0] - o.segments[:-1, 3])
            assert joints.max(initial=0.0) < 1e-9
    assert_goes_the_same_way(pairs, found)
    for k, pair in enumerate(pairs):
        for shapes, key in ((pair.drawn[0], track.keys[k]), (pair.drawn[1], track.keys[k + 1])):
            drawn = [line(o) for shape in shapes for o in shape.paths]
            for outline in key.paths:
                assert min(line(outline).hausdorff_distance(other) for other in drawn) < (
                    0.01 if curves else 0.05
                )


# The last turns back, and the others turn by different angles, so each has waypoints of its own.
TURNS = (120.0, 45.0, -75.0, 170.0)


@pytest.mark.parametrize("curves", [True, False])
@pytest.mark.parametrize("paths", SAME_CONTOURS)
def test_waypoints_are_cut_as_the_keys_are(paths, curves):
    pairs = [
        turned(pair, degrees) for pair, degrees in zip(pairs_of(*paths, curves=curves), TURNS, strict=False)
    ]
    found = keyframed_shapes(pairs)
    (track,) = found
    assert len(track.waypoints) == len(track.keys) - 1
    for pair, ways in zip(pairs, track.waypoints, strict=True):
        (shape,) = pair.shapes
        assert [waypoint.t for waypoint in ways] == [waypoint.t for waypoint in waypoints(shape)]
        assert len(ways) > 3
        for waypoint in ways:
            for outline, key in zip(waypoint.paths, track.keys[0].paths, strict=True):
                assert outline.segments.shape == key.segments.shape
                assert (outline.closed, outline.straight.tobytes()) == (key.closed, key.straight.tobytes())
                joints = np.abs(outline.segments[1:, 0] - outline.segments[:-1, 3])
                assert joints.max(initial=0.0) < 1e-9
    assert_goes_the_same_way(pairs, found, (0.01, 0.25, 0.5, 0.8, 0.99))


def test_pairs_that_go_straight_have_no_waypoints_among_others_that_do_not():
    pairs = pairs_of(STAR, DROP, CIRCLE, STAR)
    pairs[1] = turned(pairs[1])
    found = keyframed_shapes(pairs)
    (track,) = found
    assert [len(ways) > 0 for ways in track.waypoints] == [False, True, False]
    assert_goes_the_same_way(pairs, found, (0.01, 0.3, 0.99))


def test_each_coat_of_paint_has_the_waypoints():
    stops = '<stop stop-color="#f00"/><stop offset="1" stop-color="#00f"/>'
    leaf = f'<path d="{LEAF}" fill="url(#g)"/>'
    gradients = [f'<{kind}Gradient id="g">{stops}</{kind}Gradient>{leaf}' for kind in ("linear", "radial")]
    (pair,) = pairs_of(*gradients)
    below, above = keyframed_shapes([turned(pair)])
    assert below.keys[0].style != above.keys[0].style
    assert below.waypoints == above.waypoints
    assert len(above.waypoints[0]) > 3


def test_a_shape_that_does_not_go_on_as_it_came_ends_there():
    pairs = pairs_of(EYED, LEAF, EYED)
    found = keyframed_shapes(pairs)
    assert [(t.first, len(t.keys)) for t in found] == [(0, 2), (1, 2)]
    assert_goes_the_same_way(pairs, found)
    pairs = pairs_of(SQUARES, BAR, SQUARES)
    assert_goes_the_same_way(pairs, keyframed_shapes(pairs))
    pairs = [turned(pair) for pair in pairs]
    assert_goes_the_same_way(pairs, keyframed_shapes(pairs), (0.01, 0.2, 0.99))


def test_some_shapes_go_on_and_others_do_not():
    def shapes(*paths):
        return "".join(
            f'<path d="{p}" fill="{c}"/>' for p, c in zip(paths, ("#f00", "#0a0", "#00f"), strict=False)
        )

    corner, other = "M0 0H3V3H0Z", "M20 0L24 0L24 4Z"
    pairs = pairs_of(shapes(STAR, corner, other), shapes(DROP, corner), shapes(LEAF, other, corner))
    found = keyframed_shapes(pairs)
    assert sorted((t.first, len(t.keys)) for t in found) == [(0, 2), (0, 3), (0, 3), (1, 2)]
    assert_goes_the_same_way(pairs, found)


def test_an_outline_that_was_opened_for_a_line_does_not_go_on_closed():
    ring = '<circle cx="12" cy="12" r="8" fill="none" stroke="#000"/>'
    square = '<path d="M4 4H20V20H4Z" fill="none" stroke="#000"/>'
    pairs = pairs_of(LINES[0], ring, square)
    found = keyframed_shapes(pairs)
    assert [(t.first, len(t.keys)) for t in found] == [(0, 2), (1, 2)]


@given(rngs, st.lists(st.integers(3, 12), min_size=3, max_size=4), st.booleans())
def test_any_polygons_in_any_direction(rng, counts, curves):
    drawings = []
    for count in counts:
        z = star_polygon(rng, count) * 10
        drawings.append(contour_drawing(polygon_contour(z[::-1] if rng.random() < 0.5 else z)))
    pairs, _ = match_all(drawings, Settings(vertices=20, curves=curves, place="asis", motion="linear"))
    found = keyframed_shapes(pairs)
    assert [len(t.keys) for t in found] == [len(counts)]
    assert_goes_the_same_way(pairs, found)
    pairs = [turned(pair, 100.0, 5 + 5j) for pair in pairs]
    assert_goes_the_same_way(pairs, keyframed_shapes(pairs), (0.01, 0.4))
