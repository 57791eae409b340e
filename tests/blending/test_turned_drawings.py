"""Drawings that are another one turned as a whole, or its mirror image."""

import numpy as np
import pytest

from shapeblend_cli.blending import blended, turned_drawings
from shapeblend_cli.blending.placing import AS_IT_IS, flattened
from shapeblend_cli.blending.swaps.swapped import swapped
from shapeblend_cli.blending.turned_drawings import way_between
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import control_box
from shapeblend_cli.motion.rigid import ON_EDGE, turned_over
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.system.kept import Kept
from shapeblend_cli.wires.match import solved_wires
from tests.support.drawings import drawing

FLAG = "M4 2H6V4L20 3L14 8L19 13L6 12V22H4Z"
FLAG_MIRRORED = "M20 2H18V4L4 3L10 8L5 13L18 12V22H20Z"
THUMB = "M3 9H8L11 2H13L14 10H21L20 20H3Z"
THUMB_MIRRORED = "M3 15H8L11 22H13L14 14H21L20 4H3Z"
KEY = "M4 4H10V10H8V12H20V16H18V14H16V18H14V14H4Z"
KEY_MIRRORED = "M20 4H14V10H16V12H4V16H6V14H8V18H10V14H20Z"
FACE = "M12 2A10 10 0 1 0 12 22A10 10 0 1 0 12 2Z"
SMILE = ("M8 7H9V10H8Z", "M15 7H16V10H15Z", "M7 14C9 18 15 18 17 14C15 16 9 16 7 14Z")
UPSIDE_DOWN = ("M8 14H9V17H8Z", "M15 14H16V17H15Z", "M7 10C9 6 15 6 17 10C15 8 9 8 7 10Z")


def shapes_of(a, b, **settings):
    """Two drawings, matched."""
    (pair,), _ = match_all([a, b], Settings(strokes="keep", **settings))
    return pair.shapes


def face(*features):
    """A yellow face with dark features."""
    return drawing(f'<path fill="#fc0" d="{FACE}"/>', *features)


def test_a_mirror_image_turns_if_little_is_left_to_do():
    (shape,) = shapes_of(drawing(THUMB), drawing(THUMB_MIRRORED))
    assert shape.motion_name == "rigid"
    half_way = control_box(paths_at(shape, 0.5))
    assert (half_way.width, half_way.height) == pytest.approx((18.0, 18.0), abs=1.0), "it lies on its side"


def test_a_pole_that_would_become_the_other_side_of_its_flag_is_turned_over():
    (shape,) = shapes_of(drawing(FLAG), drawing(FLAG_MIRRORED))
    assert shape.reason == "B is A's mirror image, turned over"


def test_a_mirror_image_is_turned_over_rather_than_taking_the_place_of_the_drawing(monkeypatch):
    def exchange(asked, *others):
        return swapped(*asked.drawn)

    monkeypatch.setattr(blended, "_by_lines_or_outlines", exchange)
    monkeypatch.setattr(turned_drawings, "_is_clean", lambda shapes, view: True)
    (shape,) = shapes_of(drawing(FLAG), drawing(FLAG_MIRRORED))
    assert shape.reason == "B is A's mirror image, turned over"
    assert len(shapes_of(drawing(FLAG), drawing(SMILE[0]))) == 2, "others take the place"


def test_a_mirror_image_that_is_unlike_the_drawing_is_turned_over():
    (shape,) = shapes_of(drawing(KEY), drawing(KEY_MIRRORED))
    assert (shape.motion_name, shape.reason) == ("flip", "B is A's mirror image, turned over")
    for t, share in ((0.2, 0.98), (0.3, 0.87), (ON_EDGE, 0.1), (0.5, 0.38), (0.7, 0.95)):
        box = control_box(paths_at(shape, t))
        assert box.width == pytest.approx(16.0 * share, abs=0.1)
        assert (box.height, box.centre) == (pytest.approx(14.0), pytest.approx(12.0 + 11.0j))


def test_what_is_turned_over_is_no_line_half_way_and_never_turns_back():
    sizes = [turned_over(t) for t in np.linspace(0.0, 1.0, 33)]
    assert (sizes[0], sizes[-1]) == (1.0, -1.0)
    assert sizes == sorted(sizes, reverse=True)
    assert abs(sizes[16]) > 0.35


def test_it_ends_at_the_drawing():
    (shape,) = shapes_of(drawing(KEY), drawing(KEY_MIRRORED))
    (almost,), (end,) = paths_at(shape, 1.0 - 1e-9), paths_at(shape, 1.0)
    assert np.abs(almost.segments - end.segments).max() < 1e-6
    corners = {complex(round(z.real, 6), round(z.imag, 6)) for z in end.segments[:, 0]}
    assert corners >= {20 + 4j, 14 + 4j, 4 + 16j, 16 + 10j}


def test_a_face_turns_upside_down_within_its_disc():
    shapes = shapes_of(face(*SMILE), face(*UPSIDE_DOWN))
    assert {shape.motion_name for shape in shapes} == {"rigid"}
    disc = control_box(paths_at(shapes[0], 0.5))
    assert disc.bounds == pytest.approx((2.0, 2.0, 22.0, 22.0), abs=0.05)
    left, right = (control_box(paths_at(shape, 0.5)).centre for shape in shapes[1:3])
    assert abs(left.real - right.real) < 0.5, "at half time the eyes are above each other"


def test_lines_above_a_tint_are_turned_over_with_it():
    def tinted(tint, *lines):
        strokes = "".join(
            f'<path fill="none" stroke="#000" stroke-width="1.5" d="{line}"/>' for line in lines
        )
        return drawing(f'<path opacity="0.2" d="{tint}"/>', strokes)

    a = tinted("M4 4H10V10H4Z", KEY, "M7 4V10")
    b = tinted("M20 4H14V10H20Z", KEY_MIRRORED, "M17 4V10")
    (pair,), _ = match_all([a, b], Settings())
    assert {shape.motion_name for shape in pair.shapes} == {"flip"}


def test_what_stays_is_not_turned():
    aligned = [f"M2 3H22V5H2Z M{left} 9H{left + 12}V11H{left}Z M2 15H22V17H2Z" for left in (2, 10)]
    assert {shape.motion_name for shape in shapes_of(*map(drawing, aligned))} == {"linear"}


def strokes(*paths, turned=0):
    """Lines, turned by some degrees about the middle of the view."""
    pen = f'fill="none" stroke="#000" stroke-width="2" transform="rotate({turned} 12 12)"'
    return drawing(*(f'<path {pen} d="{path}"/>' for path in paths))


# A switch in pieces, as some sets cut their strokes, and one whose knob is a ring on the end of a bow.
IN_PIECES = ["M7 17h10a5 5 0 0 0 0-10H7", "M7 17A5 5 0 0 0 7 7", "M7 17a5 5 0 0 1-5-5a5 5 0 0 1 5-5"]
RINGED = ["M8 6H16A6 6 0 0 1 16 18H8", "M8 6A6 6 0 0 0 8 18A6 6 0 0 0 8 6Z"]
REFRESH = ["M20 12A8 8 0 1 1 17.600 6.300M20 3V8H15"]
ARROW = ["M12 17V3", "M15 6L12 3L9 6", "M12 17A2 2 0 1 0 12 21A2 2 0 0 0 12 17Z"]
GAUGE = ["M4 18A10 10 0 1 1 20 18", "M12 14L17 9"]


@pytest.mark.parametrize("switch", [IN_PIECES, RINGED], ids=["pieces", "ring"])
def test_a_switch_stays_where_it_is_as_its_knob_goes_to_the_other_side(switch):
    (pair,), _ = match_all([strokes(*switch), strokes(*switch, turned=180)], Settings())
    boxes = [
        control_box([path for shape in pair.shapes for path in paths_at(shape, t)]) for t in (0.0, 0.3, 0.5)
    ]
    assert all(box.height < 0.8 * box.width for box in boxes)


def test_an_arrow_whose_shaft_stays_turns():
    (pair,), _ = match_all([strokes(*ARROW), strokes(*ARROW, turned=180)], Settings())
    box = control_box([path for shape in pair.shapes for path in paths_at(shape, 0.5)])
    assert box.width > 2.0 * box.height


@pytest.mark.parametrize("degrees", [45, 90])
@pytest.mark.parametrize("sign", [REFRESH, GAUGE], ids=["refresh", "gauge"])
def test_an_arc_that_slides_along_itself_turns_with_the_rest(sign, degrees):
    shapes = shapes_of(strokes(*sign), strokes(*sign, turned=degrees))
    assert {shape.motion_name for shape in shapes} == {"rigid"}


@pytest.mark.parametrize("settings", [{"motion": "linear"}, {"stagger": 0.5}, {"pins": ((0, 0),)}])
def test_what_is_asked_for_comes_first(settings):
    shapes = shapes_of(drawing(KEY), drawing(KEY_MIRRORED), **settings)
    assert "flip" not in {shape.motion_name for shape in shapes}


def test_clips_are_turned_over_as_well():
    clip, clipped = '<clipPath id="c"><path d="{}"/></clipPath>', '<path clip-path="url(#c)" d="{}"/>'
    red = '<path fill="#e33" d="M{}Z"/>'  # in one colour, clips are applied
    a = drawing(clip.format("M2 2H18V22H2Z"), clipped.format(KEY), red.format("2 1H4V2H2"))
    b = drawing(clip.format("M22 2H6V22H22Z"), clipped.format(KEY_MIRRORED), red.format("22 1H20V2H22"))
    (clip,) = next(shape.clips for shape in shapes_of(a, b) if shape.clips)
    box = control_box(paths_at(clip.shapes[0], ON_EDGE))
    assert box.width == pytest.approx(1.6, abs=0.01)


def test_plots_know_the_wires_as_they_were_solved():
    (shape,) = shapes_of(drawing(KEY), drawing(KEY_MIRRORED))
    (contour,) = shape.contours
    assert contour.mirrored
    found = contour.correspondence
    assert sum(solved_wires(contour, Settings()).path_work(found.dots)) == pytest.approx(found.work, abs=1e-9)


PENCIL = "M2 5L5 2L17 14L20 20L14 17Z"
BRUSH = "M22 3L20 1L9 11C6 10 6 15 2 20C7 19 12 17 11 14Z"


def test_a_long_drawing_turns_where_that_looks_better():
    (shape,) = shapes_of(drawing(PENCIL), drawing(BRUSH))
    assert (shape.motion_name, shape.reason) == ("rigid", "a long drawing turns as a whole")
    box = control_box(paths_at(shape, 0.5))
    assert max(box.width, box.height) > 18.0, "it keeps its length"
    assert min(box.width, box.height) < 9.0


def test_a_long_drawing_whose_ends_are_alike_turns_the_short_way():
    sloping = (
        "M22 4C21 2 18 4 15 6C11 8 5 12 5 12C5 12 2 13 3 15C4 16 8 13 8 13C8 13 12 10 16 8C19 7 23 6 22 4Z"
    )
    level = "M2 10H18Q22 10 22 12Q22 14 18 14L4 13Q2 12 2 10Z"
    (shape,) = shapes_of(drawing(sloping), drawing(level))
    assert [abs(contour.rotation) < 1.0 for contour in shape.contours] == [True]


def test_a_long_drawing_whose_nodes_were_moved_does_not_turn_the_long_way_round():
    hook = "M0 0C-6 5 13 0 18 20C28 57 17 84 44 80C58 79 50 28 41 9C29 -16 3 -2 0 0Z"
    moved = "M57 19C71 35 100 26 102 39C108 70 69 75 40 41C26 25 18 -19 27 -17C33 -16 38 -3 57 19Z"
    (shape,) = shapes_of(drawing(hook), drawing(moved))
    assert shape.motion_name == "linear"


def test_a_long_drawing_that_becomes_another_in_its_place_does_not_turn():
    (shape,) = shapes_of(drawing(PENCIL), drawing("M2 4L4 2L18 15L21 21L15 18Z"))
    assert shape.motion_name == "linear"


def test_what_is_its_own_mirror_image_and_stays_is_not_turned_over():
    bars = [f"M11 {y}H13V{y + 1}H11Z" for y in range(2, 23, 3)]
    a, b = drawing(" ".join(bars)), drawing(" ".join([*bars[:2], "M11 9.9H13V10.1H11Z", *bars[3:]]))
    assert "flip" not in {shape.motion_name for shape in shapes_of(a, b)}
    assert way_between(*laid(a, b)) is None


def laid(*drawings):
    """Drawings, flattened as they lie."""
    return flattened(drawings, [AS_IT_IS] * len(drawings), 0, Kept(0))[0]
