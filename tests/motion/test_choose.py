"""Which motion a shape gets."""

import numpy as np
import pytest

from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.svg.reading.read import read
from tests.support import drawings
from tests.support.contours import drawing, polygon_contour
from tests.support.motions import blend, pair_of, reasons
from tests.support.shapes import arm, bar, comb, spiral

HARD = [(bar(30), spiral(1.5, 30)), (comb(4), spiral(1.0, 20)), (spiral(1.5), arm(20, 60, 120))]


def polygon_pair(*outlines, **settings):
    return pair_of(*(drawing(polygon_contour(z)) for z in outlines), **settings)


def motions(pair):
    return [shape.motion_name for shape in pair.shapes]


@pytest.mark.parametrize("names", [("e", "f"), ("triangle", "square")])
def test_what_looks_right_moves_straight_and_all_is_as_if_asked_for(samples, names):
    a, b = (read(str(samples / f"{name}.svg")) for name in names)
    settings = Settings(ends=True)
    pair, frames = blend(a, b, settings)
    asked, same = blend(a, b, settings.replace(motion="linear"))
    assert (motions(pair), reasons(asked)) == (["linear"], ("asked for",))
    assert pair.views == asked.views
    for frame, other in zip(frames, same, strict=True):
        for shape, alike in zip(frame.shapes, other.shapes, strict=True):
            for one, straight in zip(shape.paths, alike.paths, strict=True):
                np.testing.assert_array_equal(one.segments, straight.segments)


def test_nearly_a_rotated_shape_does_not_move_straight():
    thicker = comb(3)
    thicker[-2:] += 1.5j
    pair = polygon_pair(comb(3), thicker * np.exp(2.5j))
    assert motions(pair) != ["linear"]
    (shape,) = pair.shapes
    assert [one.name for one in shape.candidates] == ["linear", "rigid", "intrinsic"]
    assert shape.taken.wrong < shape.candidates[0].wrong
    assert f": linear {shape.candidates[0].wrong:.3f}, " in reasons(pair)[0]


CRESCENT = "M0 0C-5 10 4 22 29 41C49 56 62 46 62 46C68 36 63 31 63 31C40 55 8 16 0 0Z"
LEVEL = "M73 15C75 6 69 6 69 6C63 28 -7 11 -15 1C-20 9 13 27 42 27C65 28 73 15 73 15Z"


def test_nodes_that_were_moved_go_straight_where_others_would_swing():
    a, b = (drawings.drawing(f'<path d="{d}"/>') for d in (CRESCENT, LEVEL))
    (edited,) = pair_of(a, b).shapes
    assert edited.motion_name == "linear"
    with_lines = drawings.drawing(f'<path d="{LEVEL.replace("Z", "L73.5 13L74 11L74 9Z")}"/>')
    (swung,) = pair_of(a, with_lines).shapes
    assert swung.motion_name in ("rigid", "intrinsic")


def test_nodes_that_were_moved_turn_where_that_is_far_better():
    leaf, turned = (
        "M2 12C6 7 18 7 22 12C18 17 6 17 2 12Z",
        "M12 2C17 6 17 17 12 21C7 17 7 6 12 2Z",
    )
    (shape,) = pair_of(*(drawings.drawing(f'<path d="{d}"/>') for d in (leaf, turned))).shapes
    assert shape.motion_name != "linear"


def test_what_rests_stays_while_the_rest_of_its_shape_swings():
    ring = 8.0 * np.exp(2j * np.pi * np.arange(48) / 48)
    hands = [arm(*turns, length=1.4)[::-1] for turns in ((80, 95, 110), (-60, -75, -90))]
    a, b = (drawing(polygon_contour(ring), polygon_contour(hand - 2.0)) for hand in hands)
    (shape,) = pair_of(a, b).shapes
    assert shape.motion_name == "intrinsic"
    for t in (0.2, 0.5, 0.8):
        still, hand = paths_at(shape, t)
        np.testing.assert_allclose(np.abs(still.segments[:, [0, 3]]), 8.0, atol=1e-6)
        assert path_crossings([hand]) == 0


def crossings(outlines, motion, times):
    (shape,) = polygon_pair(*outlines, motion=motion).shapes
    return sum(path_crossings(paths_at(shape, t)) for t in times)


@pytest.mark.parametrize("outlines", HARD)
def test_what_is_chosen_is_no_more_wrong_than_straight_paths_unless_these_cross(outlines):
    (shape,) = polygon_pair(*outlines).shapes
    straight = shape.candidates[0]
    assert straight.name == "linear"
    times = np.arange(1, 10) / 10
    is_least = shape.taken.wrong == min(one.wrong for one in shape.candidates)
    assert shape.reason.startswith("the least wrong: ") == (is_least and len(shape.candidates) > 1)
    if shape.taken.wrong > straight.wrong:
        assert shape.reason.startswith("motions that are less wrong make outlines cross: ")
        assert crossings(outlines, "linear", times) > 0
        assert sum(path_crossings(paths_at(shape, t)) for t in times) == 0


def test_only_the_shape_with_a_fault_moves_otherwise():
    centre = comb(3).mean()
    teeth = comb(3), (comb(3) - centre) * np.exp(2j) + centre
    paths = (f"M{' '.join(f'{v.real},{v.imag}' for v in z)}Z" for z in teeth)
    pair = pair_of(*(drawings.drawing("M30 0L45 5V12H30Z", path, viewbox="-10 -10 60 60") for path in paths))
    found = dict(zip(motions(pair), reasons(pair), strict=True))
    assert set(found) == {"linear", "rigid"}
    assert found["linear"] == "straight paths look right"


def test_a_shape_that_appears_has_nothing_to_choose():
    a = drawings.drawing("M2 2H10V10H2Z")
    b = drawings.drawing("M2 2H10V10H2Z", "M14 14H22V22H14Z")
    pair = pair_of(a, b)
    assert sorted(reasons(pair)) == ["a point at one end", "straight paths look right"]
    assert motions(pair) == ["linear", "linear"]
    assert sorted(reasons(pair_of(a, b, motion="rigid"))) == ["a point at one end", "asked for"]


def test_a_stroke_on_an_edge_has_nothing_to_choose_and_is_no_point():
    square, wide = "M2 2H10V10H2Z", "M2 2H18V10H2Z"
    edge = f'<path d="{wide}" fill="none" stroke="#c00"/>'
    a, b = drawings.drawing(square), drawings.drawing(wide, edge)
    assert sorted(reasons(pair_of(a, b))) == [
        "it follows the edge that it lies on",
        "straight, because strokes on its edges move with it",
    ]


@pytest.mark.parametrize("other", [comb(3) * np.exp(2j), comb(3) + 1])
def test_backwards_it_is_the_same_motion(other):
    assert motions(polygon_pair(comb(3), other)) == motions(polygon_pair(other, comb(3)))
