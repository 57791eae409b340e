"""Which motion a shape gets."""

import numpy as np
import pytest

from shapeblend_cli.geometry.crossings import path_crossings
from shapeblend_cli.interpolate.paths import between
from shapeblend_cli.pipeline import blend, match_all
from shapeblend_cli.settings import Settings
from shapeblend_cli.svg.reading.read import read
from tests.support import drawings
from tests.support.contours import drawing, polygon_contour
from tests.support.motions import reasons
from tests.support.shapes import arm, bar, comb, spiral

SETTINGS = Settings(place="asis")
CLEAN = [("e", "f"), ("triangle", "square"), ("bird-1", "bird-2")]


def pair_of(a, b, **settings):
    (pair,), _ = match_all([a, b], SETTINGS.replace(**settings))
    return pair


def polygon(*outlines):
    return drawing(*(polygon_contour(z) for z in outlines))


def motions(pair):
    return [shape.motion_name for shape in pair.shapes]


@pytest.mark.parametrize("names", CLEAN)
def test_without_a_fault_paths_are_straight_and_all_is_as_if_asked_for(samples, names):
    a, b = (read(str(samples / f"{name}.svg")) for name in names)
    settings = Settings(ends=True)
    pair, frames = blend(a, b, settings)
    asked, same = blend(a, b, settings.replace(motion="linear"))
    assert (reasons(pair), reasons(asked)) == (("no fault",), ("asked for",))
    assert pair.views == asked.views
    for frame, other in zip(frames, same, strict=True):
        for shape, alike in zip(frame.shapes, other.shapes, strict=True):
            for one, straight in zip(shape.paths, alike.paths, strict=True):
                np.testing.assert_array_equal(one.segments, straight.segments)


def test_a_turned_shape_turns():
    pair = pair_of(polygon(comb(3)), polygon(comb(3) * 1j))
    assert motions(pair) == ["rigid"]
    assert reasons(pair) == ("B is A turned by 90 degrees",)


def test_nearly_a_turned_shape_does_not_go_straight():
    thicker = comb(3)
    thicker[-2:] += 1.5j
    pair = pair_of(polygon(comb(3)), polygon(thicker * np.exp(2.5j)))
    assert motions(pair) != ["linear"]
    assert reasons(pair)[0].startswith("linear: ")


def test_an_arm_that_swings_keeps_its_length():
    a, b = arm(80, 95, 110, length=3.0), arm(-60, -75, -90, length=3.0)
    pair = pair_of(polygon(a), polygon(b))
    assert motions(pair) == ["intrinsic"]
    assert [part.split(":")[0] for part in reasons(pair)[0].split("; ")] == ["linear", "rigid"]


@pytest.mark.parametrize("motion", ["linear", "rigid", "intrinsic", "safe"])
def test_what_is_asked_for_is_taken(motion):
    pair = pair_of(polygon(comb(3)), polygon(spiral(1.0, 20)), motion=motion)
    assert motions(pair) == [motion]
    assert reasons(pair) == ("asked for",)


@pytest.mark.parametrize(
    "shapes", [(bar(30), spiral(1.5, 30)), (comb(4), spiral(1.0, 20)), (spiral(1.5), arm(20, 60, 120))]
)
def test_nothing_chosen_has_more_crossings_than_straight_paths(shapes):
    a, b = map(polygon, shapes)
    times = np.linspace(0.0, 1.0, 42)[1:-1]
    counts = []
    for motion in ("auto", "linear"):
        (shape,) = pair_of(a, b, motion=motion).shapes
        counts.append(sum(path_crossings(between(shape, t)) for t in times))
    assert counts[0] <= counts[1]


@pytest.mark.parametrize(
    "shapes", [(bar(30), spiral(1.5, 30)), (comb(4), spiral(1.0, 20)), (spiral(1.5), arm(20, 60, 120))]
)
def test_safe_never_crosses_whatever_the_solver_matched(shapes):
    (shape,) = pair_of(*map(polygon, shapes), motion="safe").shapes
    assert all(path_crossings(between(shape, t)) == 0 for t in np.linspace(0.0, 1.0, 42))


def test_only_the_shape_with_a_fault_moves_otherwise():
    still, comb_path = "M30 0L45 5V12H30Z", "M{}Z".format
    centre = comb(3).mean()
    shapes = [comb(3), (comb(3) - centre) * np.exp(2j) + centre]
    a, b = (
        drawings.drawing(still, comb_path(" ".join(f"{v.real},{v.imag}" for v in z)), viewbox="-10 -10 60 60")
        for z in shapes
    )
    pair = pair_of(a, b)
    found = dict(zip(motions(pair), reasons(pair), strict=True))
    assert set(found) == {"linear", "rigid"}
    assert found["linear"] == "no fault"
    assert found["rigid"].startswith("linear: ")


def test_a_shape_that_appears_has_nothing_to_choose():
    a = drawings.drawing("M2 2H10V10H2Z")
    b = drawings.drawing("M2 2H10V10H2Z", "M14 14H22V22H14Z")
    pair = pair_of(a, b)
    assert sorted(reasons(pair)) == ["a point at one end", "no fault"]
    assert motions(pair) == ["linear", "linear"]
    assert sorted(reasons(pair_of(a, b, motion="rigid"))) == ["a point at one end", "asked for"]


def test_backwards_it_is_the_same_motion():
    for one, other in ((comb(3), comb(3) * np.exp(2j)), (comb(3), comb(3) + 1)):
        there, back = pair_of(polygon(one), polygon(other)), pair_of(polygon(other), polygon(one))
        assert motions(there) == motions(back)
