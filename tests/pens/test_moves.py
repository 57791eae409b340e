"""How lines join up, split, are pressed flat and crossed out."""

from pathlib import Path

import numpy as np
import pytest

from shapeblend_cli.frames.frames import frame_at, shapes_at
from shapeblend_cli.grading.painting import picture
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import Box
from shapeblend_cli.motion.pen import Turning, between
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pens.drawings import file_lines
from shapeblend_cli.pens.moves import BECOMES, DRAWN_BACK, DRAWN_ON, STAYS, alike, becoming
from shapeblend_cli.pens.partners import sign_in_ring
from shapeblend_cli.pens.splits import COPY, SHUT
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read
from tests.support.drawings import drawing

TIMES = [k / 10 for k in range(11)]
PLAY, PAUSE = "M6 3L20 12L6 21Z", "M5 4H9V20H5ZM15 4H19V20H15Z"
EYE = "M2 12C6 4 18 4 22 12C18 20 6 20 2 12Z"


def pen(*paths, cap="round"):
    style = f'fill="none" stroke="#000" stroke-width="2" stroke-linecap="{cap}" stroke-linejoin="round"'
    return drawing(*[f'<path d="{path}" {style}/>' for path in paths])


def shapes_of(a, b):
    (pair,), _ = match_all([a, b], Settings())
    return pair.shapes


def line_at(shape, t):
    (path,) = paths_at(shape, t)
    return np.append(path.segments[:, 0], path.segments[-1, 3])


@pytest.mark.parametrize(
    ("paths", "ends"),
    [
        (["M3 3L6 6", "M6 6L12 12", "M12 12L21 21"], [{3 + 3j, 21 + 21j}]),
        (["M3 3L9 9M9 9A3 3 0 0 1 15 9", "M9 9L15 15"], [{3 + 3j, 15 + 15j}, {9 + 9j, 15 + 9j}]),
        (["M3 12H21L16 7", "M21 12L16 17"], [{3 + 12j, 21 + 12j}, {16 + 7j, 16 + 17j}]),  # shaft and head
    ],
    ids=["a slash in pieces", "an arc beside it", "an arrow"],
)
def test_pieces_that_go_on_from_each_other_are_one_line(paths, ends):
    lines = file_lines(pen(*paths))
    assert [{*np.round(line.points[[0, -1]], 3)} for line in lines] == ends


def test_pieces_of_a_ring_are_a_ring_and_flat_ends_make_no_corner():
    (ring,) = file_lines(pen("M4 4H20V20", "M20 20H4V4"))
    assert ring.closed
    assert len(file_lines(pen("M4 4H20", "M20 4V20", cap="butt"))) == 2


def test_a_closed_line_splits_into_two_that_close_again():
    shapes = shapes_of(pen(PLAY), pen(PAUSE))
    assert [shape.reason for shape in shapes] == [COPY, COPY]
    drawn = [sum(float(np.abs(np.diff(line_at(shape, t))).sum()) for shape in shapes) for t in TIMES]
    ends = [
        sum(np.abs(np.diff([*line.points, line.points[0]])).sum() for line in file_lines(pen(path)))
        for path in (PLAY, PAUSE)
    ]
    assert (drawn[0], drawn[-1]) == (pytest.approx(ends[0]), pytest.approx(ends[1], rel=1e-3))
    shut = next(k for k, t in enumerate(TIMES) if t >= SHUT)
    assert (np.diff(drawn[: shut + 1]) > 0.0).all()
    assert np.ptp(drawn[shut:]) < 0.02 * drawn[-1], "once they are shut they only change their shape"


def test_bars_split_and_open_to_boxes_while_the_middle_one_goes():
    boxes = "M4 4H10V10H4ZM14 4H20V10H14ZM4 14H10V20H4ZM14 14H20V20H14Z"
    shapes = shapes_of(pen("M4 6H20", "M4 12H20", "M4 18H20"), pen(boxes))
    assert sorted(shape.reason for shape in shapes) == sorted([COPY] * 4 + [DRAWN_BACK])


@pytest.mark.parametrize("backwards", [False, True])
def test_a_ring_is_pressed_flat_to_one_line_without_a_spike(backwards):
    glass = pen("M10 4A6 6 0 1 0 10 16A6 6 0 1 0 10 4Z", "M14.3 14.3L20 20")
    shapes = shapes_of(*[glass, pen("M4 4L20 20", "M20 4L4 20")][:: -1 if backwards else 1])
    (ring,) = [shape for shape in shapes if shape.contours[0].start.closed]
    assert ring.reason == BECOMES
    times = TIMES[::-1] if backwards else TIMES
    width = [np.ptp((line_at(ring, t) * np.exp(-0.25j * np.pi)).real) for t in times]
    assert (np.diff(width) < 1e-9).all()
    assert max(width[8:]) < 0.05


def test_the_gap_opens_where_the_tip_of_a_slash_comes_by():
    off = [
        "M2 12C3 10 4.4 8.6 6 7.6",
        "M10 6.1C15 5.4 20 8 22 12C21.4 13.3 20.6 14.3 19.6 15.2",
        "M16 17C11 19 4.5 17 2 12",
    ]
    shapes = shapes_of(pen(EYE), pen(*off, "M3 3L21 21"))
    assert {shape.reason for shape in shapes} == {STAYS, DRAWN_ON}
    tails = [tail for shape in shapes for tail in getattr(shape.motion, "tails", ()) if tail is not None]
    assert tails
    assert all(tail.span != (0.0, 1.0) for tail in tails)


def test_a_corner_that_turns_over_opens_and_does_not_fold_up():
    head, other = np.array([0, 4 + 4j, 8j]), np.array([4, 4j, 4 + 8j])
    half = between(head, other).points(0.5)
    assert abs(half[2] - half[0]) == pytest.approx(np.abs(np.diff(half)).sum())
    turned = between(head, 1j * other)
    assert isinstance(turned, Turning)
    assert np.abs(np.diff(turned.points(0.5))) == pytest.approx(np.abs(np.diff(head)))


def test_what_has_no_partner_is_carried_along_by_the_line_that_it_touches():
    shapes = shapes_of(pen("M2 6H14", "M8 6V2"), pen("M6 14H18"))
    (gone,) = [shape for shape in shapes if shape.reason == DRAWN_BACK]
    (bar,) = [shape for shape in shapes if shape.reason == BECOMES]
    for t in (0.2, 0.5, 0.8):
        assert np.abs(line_at(gone, t).imag - line_at(bar, t).imag.mean()).min() < 0.01


def test_a_solid_piece_with_slanting_ends_is_a_piece_of_the_line_on_which_it_lies():
    ring = "M12 2A10 10 0 1 0 12 22A10 10 0 1 0 12 2ZM12 4A8 8 0 1 1 12 20A8 8 0 1 1 12 4Z"
    corners = [
        12 + 12j + r * np.exp(1j * np.radians(a)) for r, a in ((10, -110), (10, 30), (8, 20), (8, -95))
    ]
    p, q, r, s = (f"{each.real:.3f} {each.imag:.3f}" for each in corners)
    off = drawing(f"M{p}A10 10 0 0 1 {q}L{r}A8 8 0 0 0 {s}Z", "M2 2.7L2.7 2L22 21.3L21.3 22Z")
    shapes = shapes_of(drawing(ring), off)
    (stays,) = [shape for shape in shapes if shape.reason == STAYS]
    assert (stays.contours[0].a, stays.contours[0].b) == (0, 0)
    radius = np.abs(line_at(stays, 0.6) - (12 + 12j))
    assert np.abs(radius - 9.0).max() < 0.1


BLOCK = "M2 4H12V20H2Z"
WAVES, CROSS = "M15 8H16.4V16H15ZM19 6H20.4V18H19Z", "M15 9L16 8L21 15L20 16ZM20 8L21 9L16 16L15 15Z"


def test_lines_beside_a_solid_shape_of_their_colour_move_as_lines_if_that_looks_better():
    shapes = shapes_of(drawing(BLOCK + WAVES), drawing(BLOCK + CROSS))
    assert [shape.reason for shape in shapes].count(BECOMES) == 2


def test_lines_on_fills_of_other_colours_go_along_with_these():
    block = f'<path d="{BLOCK}" fill="#fc0"/>'
    shapes = shapes_of(*(drawing(block, f'<path d="{path}"/>') for path in (WAVES, CROSS)))
    assert BECOMES not in [shape.reason for shape in shapes]


ICONS = Path(__file__).parents[2] / "docs" / "icons"
LUCIDE = [("menu", "x"), ("eye", "eye-off"), ("search", "x"), ("play", "pause"), ("log-in", "log-out")]


@pytest.mark.parametrize("names", LUCIDE, ids="-to-".join)
def test_line_weight_along_every_centre_line_is_that_of_the_ends(names):
    (pair,), _ = match_all([read(str(ICONS / "lucide" / f"{name}.svg")) for name in names], Settings())
    for t in np.linspace(0.0, 1.0, 13)[1:-1]:
        painted = [shape for shape in shapes_at(pair, t) if shape.style.stroke_opacity > 0.0]
        assert {shape.style.fill for shape in painted} == {None}
        assert [shape.style.stroke_width for shape in painted] == pytest.approx(
            [2.0] * len(painted), rel=0.03
        )


@pytest.mark.parametrize("names", LUCIDE, ids="-to-".join)
def test_little_changes_in_the_first_and_the_last_thousandth(names):
    (pair,), _ = match_all([read(str(ICONS / "lucide" / f"{name}.svg")) for name in names], Settings())
    for end, near in ((0.0, 1e-3), (1.0, 1.0 - 1e-3)):
        pictures = [picture(frame_at(pair, t, as_drawn=True).shapes, pair.views[0])[3] for t in (end, near)]
        # Icons have edges along the rows of pixels, whose side is decided by the tolerance of flattening.
        assert np.mean(np.abs(pictures[0] - pictures[1]) > 0.25) < 0.003


def test_halves_close_alike_above_and_below_however_the_vertices_lie():
    shapes = shapes_of(pen("M6 3L9 4.93L13 7.5L16 9.43L20 12L6 21Z"), pen(PAUSE))
    drawn = np.concatenate([line_at(shape, 0.5) for shape in shapes])
    assert drawn.imag.max() + drawn.imag.min() == pytest.approx(24.0, abs=0.05)


def test_what_has_no_partner_leaves_no_hook_on_a_line_that_becomes_another():
    arrow, check = pen("M4 12A8 8 0 0 0 20 12", "M1 14L4 12L7 14"), pen("M5 12L10 17L20 7")
    for a, b in ((arrow, check), (check, arrow)):
        (head,) = [shape for shape in shapes_of(a, b) if shape.reason in (DRAWN_BACK, DRAWN_ON)]
        t = 0.7 if a is arrow else 0.3
        points = line_at(head, t)
        assert np.abs(np.diff(points)).sum() < 0.01


def test_a_mark_beside_what_stays_takes_all_the_time():
    (mark,) = [
        s
        for s in shapes_of(pen("M2 2H22V22H2Z"), pen("M2 2H22V22H2Z", "M7 12L11 16L17 8"))
        if s.reason == DRAWN_ON
    ]
    assert mark.span == (0.0, 1.0)


def test_mitred_corners_of_a_ring_that_comes_are_cut_off_while_it_is_small():
    a = pen("M3 12H21", cap="butt")
    b = drawing(
        '<path d="M3 12H21M10 2H14L12 8Z" fill="none" stroke="#000" stroke-width="2" stroke-miterlimit="6"/>'
    )
    (ring,) = [shape for shape in shapes_of(a, b) if shape.contours[0].a is None]
    assert (ring.style_a.stroke_miterlimit, ring.style_b.stroke_miterlimit) == (1.0, 6.0)


def test_what_is_crossed_out_and_moves_stays_but_for_that():
    house = "M4 20V9L12 3L20 9V20Z"
    moved = [("M4 22V11L9.5 6.9", "M13 5.8L20 11V16"), ("M4 22H14",)]
    a, b = pen(house), pen(*moved[0], *moved[1], "M5 3L21 22")
    shapes = shapes_of(a, b)
    slash = [shape for shape in shapes if shape.contours[0].a is None]
    assert len(slash) == 1
    for shape in shapes:
        if shape not in slash:
            assert shape.reason == STAYS
            assert shape.motion.shift == pytest.approx(2j, abs=0.05)
            assert line_at(shape, 0.0).imag.min() >= 2.9


def test_a_line_that_goes_nearly_round_does_not_unroll_across_the_drawing():
    around = np.exp(1.9j * np.pi * np.linspace(0.0, 1.0, 25))
    moving = between(around, 1j * around.conj())
    assert max(np.abs(moving.points(t)).max() for t in TIMES) < 1.25


def test_letters_of_two_weights_become_each_other_by_corners_though_their_lines_are_cut():
    thin = drawing("M12 0V-73H51V-68.4H17V-40.3H47.5V-35.8H17V-4.6H51V0Z", viewbox="8 -77 47 81")
    cut = "M42 -29V-5H74V3H34V-32V-67H46H74V-63V-59H54H42V-37H71V-29Z"
    (shape,) = shapes_of(thin, drawing(cut, viewbox="30 -71 49 79"))
    assert [(contour.a, contour.b) for contour in shape.contours] == [(0, 0)]
    assert BECOMES not in shape.reason


def test_an_open_line_that_ends_where_it_begins_becomes_a_ring_of_any_number_of_points():
    ring, bow = (pen(path) for path in ("M4 4H20V20H4Z", "M4 4L20 20"))
    (closed,), (open_,) = map(file_lines, (ring, bow))
    square, loop = np.array([0, 1, 1 + 1j, 1j, 0j]), np.array([0, 2, 1 + 2j, 0j])
    for lines, points in (((closed, open_), (square, loop)), ((open_, closed), (loop, square))):
        motion = becoming(*lines, *points).motion
        for t, end in ((0.0, points[0]), (1.0, points[1])):
            assert np.abs(end[:, None] - motion.points(t)).min(axis=1).max() < 0.1


def test_a_corner_goes_to_a_corner_even_if_the_legs_are_of_other_lengths():
    head, check = np.array([5 + 12j, 12 + 5j, 19 + 12j]), np.array([4 + 12j, 9 + 17j, 20 + 6j])
    a, b = alike(head, check)
    assert len(a) == 3
    assert a == pytest.approx(head)
    assert b == pytest.approx(check)


@pytest.mark.parametrize(
    "paths", [("M12 16V8", "M8 12L12 8L16 12"), ("M8 12L12 8L16 12",)], ids=["arrow", "chevron"]
)
def test_an_arrow_that_comes_is_drawn_from_its_tip(paths):
    around = "M2 12A10 10 0 1 1 22 12A10 10 0 1 1 2 12Z"
    shapes = [s for s in shapes_of(pen(around), pen(around, *paths)) if s.reason == DRAWN_ON]
    assert len(shapes) == len(paths)
    for shape in shapes:
        points = line_at(shape, 0.3)
        assert np.abs(points - (12 + 8j)).min() < 0.01
        assert (points.real.min() + points.real.max()) / 2.0 == pytest.approx(12.0, abs=0.01)


def test_a_bar_becomes_a_dot_without_curling_up():
    dots = [f"M11 {y}A1 1 0 1 1 13 {y}A1 1 0 1 1 11 {y}Z" for y in (5, 12, 19)]
    shapes = shapes_of(pen("M3 6H21", "M3 12H21", "M3 18H21"), pen(*dots))
    assert [shape.reason for shape in shapes] == [BECOMES] * 3
    for shape in shapes:
        points = line_at(shape, 0.5)
        middle = (points.imag.min() + points.imag.max()) / 2.0
        inner = points.imag[
            np.abs(points.real - 12.0) < 2.0
        ]  # above and below: a line that curls up has one side
        assert inner.min() < middle < inner.max()
        assert np.abs(inner - middle).min() > 0.2


def test_a_ring_does_not_unravel_to_one_of_its_sides():
    triangle = "M9 8A1 1 0 0 1 10.5 7.1L16.5 11.1A1 1 0 0 1 16.5 12.9L10.5 16.9A1 1 0 0 1 9 16Z"
    shapes = shapes_of(pen(triangle), pen("M9 7V17", "M15 7V17"))
    assert [shape.reason for shape in shapes] == [COPY] * 2


def test_a_ring_without_a_hole_becomes_a_disc_of_its_size_without_moving():
    ring = '<circle cx="12" cy="12" r="2" fill="none" stroke="#000" stroke-width="4"/>'
    disc = "M12 8A4 4 0 1 1 12 16A4 4 0 1 1 12 8Z"
    (pair,), _ = match_all([drawing(ring), drawing(disc)], Settings(place="asis"))
    whole = picture(shapes_at(pair, 0.0), Box(0.0, 0.0, 24.0, 24.0))
    for t in (0.3, 0.6, 0.9):
        now = picture(shapes_at(pair, t), Box(0.0, 0.0, 24.0, 24.0))
        assert np.abs(now - whole).mean() < 2e-3


CIRCLE = "M12 2A10 10 0 0 1 12 22A10 10 0 0 1 12 2Z"


@pytest.mark.parametrize(
    ("small", "large"),
    [
        (["M8 12L11 15L16 9"], ["M3 12L9 18L21 5"]),
        (["M10 9V15", "M14 9V15"], ["M9 6V18", "M15 6V18"]),
        (["M8 12H16", "M13 9L16 12L13 15"], ["M4 12H20", "M14 6L20 12L14 18"]),
        (["M8 9H16", "M8 12H16", "M8 15H16"], ["M3 6H21", "M3 12H21", "M3 18H21"]),
    ],
    ids=["a check mark", "pause", "an arrow", "a menu"],
)
def test_a_sign_leaves_its_ring_and_grows_while_that_is_drawn_back(small, large):
    there, back = shapes_of(pen(CIRCLE, *small), pen(*large)), shapes_of(pen(*large), pen(CIRCLE, *small))
    for shapes, gone in ((there, DRAWN_BACK), (back, DRAWN_ON)):
        reasons = [shape.reason for shape in shapes]
        assert reasons.count(BECOMES) == len(small)
        assert reasons.count(gone) == 1
    # Each place is half way between where it is in both.
    (first, *_) = [shape for shape in there if shape.reason == BECOMES]
    ends = [line_at(first, t) for t in (0.0, 0.5, 1.0)]
    assert ends[1] == pytest.approx((ends[0] + ends[2]) / 2.0, abs=1e-6)


def test_a_ring_becomes_a_sign_that_is_a_ring_itself():
    shapes = shapes_of(pen(CIRCLE, "M9 9H15V15H9Z"), pen("M4 4H20V20H4Z"))
    (ring,) = [shape for shape in shapes if shape.reason == BECOMES]
    assert ring.contours[0].a == 0


@pytest.mark.parametrize(
    ("a", "b"),
    [
        ([CIRCLE, "M8 12H16"], ["M12 3V21"]),
        ([CIRCLE, "M8 12L11 15L16 9"], ["M3 6L12 18L21 6"]),
        ([CIRCLE, "M8 12H16"], ["M8 12H16"]),
        ([CIRCLE, "M8 12H16", "M12 8V16"], ["M4 12H20"]),
        (["M2 2H8V8H2Z", "M8 12H16"], ["M4 12H20"]),
    ],
    ids=["another bar", "another bend", "one that stays", "one line less", "no ring around it"],
)
def test_only_a_sign_that_is_the_same_in_another_size_leaves_its_ring(a, b):
    sides = [file_lines(pen(*paths)) for paths in (a, b)]
    assert not sign_in_ring(*sides)
    assert not sign_in_ring(*sides[::-1])
