"""Animated SVGs by the letter; what they show is seen in a browser."""

import re
from xml.etree import ElementTree

import pytest

from shapeblend_cli.interpolate.chains import keyframed_shapes
from shapeblend_cli.model import Box
from shapeblend_cli.options.easing import LINEAR, PINGPONG, Ease, Timing
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.writing.animation import Views
from shapeblend_cli.svg.writing.css import css_svg
from shapeblend_cli.svg.writing.smil import smil_svg
from tests.support.drawings import BAR, LEAF, RING, drawing
from tests.support.motions import rotated

pytestmark = pytest.mark.usefixtures("blended_once")

NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)")
SLOW_START = Ease(0.42, 0.0, 1.0, 1.0)


def pairs_of(*paths, fills=("#333",) * 3):
    drawings = [drawing(p, attributes=f'fill="{fill}"') for p, fill in zip(paths, fills, strict=False)]
    return match_all(drawings, Settings())[0]


def smil(pairs, timing):
    views = [pairs[0].views[0], *(pair.views[1] for pair in pairs)]
    return ElementTree.fromstring(smil_svg(keyframed_shapes(pairs), Views(views), timing, 3))


def css(pairs, timing):
    views = [view for pair in pairs for view in pair.views]
    return css_svg(keyframed_shapes(pairs), Box.union(views), timing, 3)


def animations(root, name):
    return [element for element in root.iter() if element.get("attributeName") == name]


@pytest.mark.parametrize("ease", [LINEAR, SLOW_START])
@pytest.mark.parametrize("repeat", ["forever", PINGPONG])
@pytest.mark.parametrize("paths", [(LEAF, BAR), (LEAF, BAR, LEAF), (LEAF, RING, LEAF)])
def test_every_waypoint_has_its_value_time_and_spline(paths, repeat, ease):
    straight, timing = pairs_of(*paths), Timing(ease=ease, repeat=repeat)
    moved = [rotated(straight[0]), *straight[1:]]
    steps = len(straight) + sum(len(way) for way in keyframed_shapes(moved)[0].waypoints)
    found, *_ = animations(smil(moved, timing), "d")
    values, times = found.get("values").split(";"), [float(v) for v in found.get("keyTimes").split(";")]
    assert len(values) == len(times) == steps * (2 if repeat == PINGPONG else 1) + 1
    assert len({NUMBER.sub("", value).replace(" ", "") for value in values}) == 1
    assert (times[0], times[-1]) == (0.0, 1.0)
    assert times == sorted(set(times))
    if repeat == PINGPONG:
        assert values == values[::-1]
        assert times == pytest.approx([1.0 - time for time in times[::-1]], abs=1.1e-5)
    assert found.get("calcMode") == (None if ease.is_linear else "spline")
    if not ease.is_linear:
        assert len(found.get("keySplines").split(";")) == len(values) - 1


def test_without_waypoints_there_is_a_value_for_each_drawing_and_no_word_of_time():
    (found,) = animations(smil(pairs_of(LEAF, BAR, LEAF), Timing()), "d")
    assert len(found.get("values").split(";")) == 3
    assert set(found.keys()) == {"attributeName", "values", "dur", "repeatCount", "end"}


def test_only_the_path_has_keyframes_at_waypoints():
    (pair,) = pairs_of(LEAF, BAR, fills=("#333333", "#343434"))
    root = smil([rotated(pair)], Timing())
    (data,), (fill,) = animations(root, "d"), animations(root, "fill")
    assert len(data.get("values").split(";")) > len(fill.get("values").split(";")) == 2


def test_css_gives_a_path_with_waypoints_keyframes_of_its_own():
    straight, timing = pairs_of(LEAF, BAR), Timing(ease=SLOW_START)
    moved = [rotated(pair) for pair in straight]
    (way,) = keyframed_shapes(moved)[0].waypoints
    text = css(moved, timing)
    assert text.count("d:path(") == len(way) + 2
    assert text.count("animation-timing-function:") == len(way) + 1
    assert css(straight, timing).count("d:path(") == 2


def test_drawings_that_move_differently_have_different_names_in_css():
    straight = pairs_of(LEAF, BAR)
    moved = ([rotated(straight[0], degrees)] for degrees in (90.0, 120.0))
    texts = [css(pairs, Timing()) for pairs in (straight, *moved)]
    assert len({re.search(r' class="([^"]*)"', text)[1] for text in texts}) == 3
