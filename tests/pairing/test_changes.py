from itertools import pairwise

import numpy as np
import pytest

import shapeblend_cli as sb
from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.model import Box
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read
from tests.support.contours import polyline
from tests.support.drawings import drawing, svg

# A card with a window, and the same crossed out: a bar from corner to corner, and beside it a gap.
CARD = "M4 4H20V20H4Z M10 8V12H15V8Z"
CROSSED_OUT = "M1 2L2 1L23 22L22 23L19 20H4V5Z M7 4H20V17L15 12V8H11Z"
# A padlock, and its shackle cut on the left.
LOCK = "M4 10H7V6A5 5 0 0 1 17 6V10H20V22H4Z M9 10H15V6A3 3 0 0 0 9 6Z"
UNLOCKED = "M4 10H15V6A3 3 0 0 0 9 6H7A5 5 0 0 1 17 6V10H20V22H4Z"
PAIRS = [(CARD, CROSSED_OUT), (LOCK, UNLOCKED)]
POINTS = Box(0, 0, 24, 24).grid(71)


def pair_of(a, b, **settings):
    pairs, _ = match_all([drawing(a, file="a.svg"), drawing(b, file="b.svg")], Settings(**settings))
    return pairs[0]


def painted(pair, t):
    """Which of the points are painted."""
    windings = [
        winding_numbers(POINTS, polyline(path, 8)) for shape in shapes_at(pair, t) for path in shape.paths
    ]
    return np.sum(windings, axis=0) != 0


@pytest.mark.parametrize("motion", ["auto", "linear"])
@pytest.mark.parametrize(("a", "b"), PAIRS + [pair[::-1] for pair in PAIRS])
def test_the_ends_are_the_drawings(a, b, motion):
    pair = pair_of(a, b, motion=motion)
    for t, one in ((0.0, a), (1.0, b)):
        assert np.array_equal(painted(pair, t), painted(pair_of(one, one), 0.0))


@pytest.mark.parametrize(("a", "b"), PAIRS + [pair[::-1] for pair in PAIRS])
def test_what_is_painted_in_both_drawings_always_is_and_what_is_in_neither_never(a, b):
    pair = pair_of(a, b)
    in_a, in_b = painted(pair, 0.0), painted(pair, 1.0)
    for t in np.linspace(0.05, 0.95, 19):
        between = painted(pair, t)
        assert ((between == in_a) | (between == in_b)).mean() > 0.999


@pytest.mark.parametrize(("a", "b"), PAIRS)
def test_what_is_added_grows_from_one_end_to_the_other(a, b):
    pair = pair_of(a, b)
    in_a, in_b = painted(pair, 0.0), painted(pair, 1.0)
    changed = [np.flatnonzero((painted(pair, t) != in_a) & (in_a != in_b)) for t in (0.2, 0.4, 0.6, 0.8)]
    for fewer, more in pairwise(changed):
        assert len(fewer) < len(more)
        assert set(fewer) <= set(more)


@pytest.mark.parametrize("t", [0.2, 0.5, 0.8])
def test_the_leg_of_a_lock_draws_back_to_its_shackle(t):
    leg = painted(pair_of(LOCK, UNLOCKED), t)[np.abs(POINTS.real - 8.0) < 0.2].astype(int)
    below_the_bow = np.diff(leg[POINTS.imag[np.abs(POINTS.real - 8.0) < 0.2] > 5.0])
    assert np.abs(below_the_bow).sum() == 3, "it ends, the body begins, and ends: no piece is left between"


@pytest.mark.parametrize(("a", "b"), PAIRS)
def test_it_shrinks_as_it_grew(a, b):
    there, back = pair_of(a, b), pair_of(b, a)
    for t in (0.3, 0.7):
        assert (painted(there, t) == painted(back, 1.0 - t)).mean() > 0.998


@pytest.mark.parametrize(
    ("a", "b"),
    [
        (CARD, LOCK),  # different things
        (CARD, "M4 4H20V20H4Z"),  # a hole that closes
        (CARD, "M4 4H20V12H24V14H20V20H4Z M10 8V12H15V8Z"),  # a limb that grows
    ],
)
def test_other_shapes_become_each_other(a, b):
    assert {shape.motion_name for shape in pair_of(a, b).shapes} != {"sweep"}


def test_what_users_match_is_matched():
    assert pair_of(CARD, CROSSED_OUT, match=(("0", "0"),)).shapes[0].motion_name != "sweep"


def test_what_else_is_far_apart_has_no_partner_for_that():
    dot, line = (
        '<path fill="#f00" d="M0 0H1V1H0Z"/>',
        '<path fill="none" stroke="#0f0" d="M22 21L24 22L21 24"/>',
    )
    files = (f'<path d="{d}"/>{more}' for d, more in ((CARD, dot), (CROSSED_OUT, line)))
    documents = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24">{d}</svg>' for d in files)
    (pair,), _ = match_all([read("a.svg", document.encode()) for document in documents], Settings())
    assert "sweep" in {shape.motion_name for shape in pair.shapes}
    others = [c for shape in pair.shapes if shape.motion_name != "sweep" for c in shape.contours]
    assert sorted((c.a is None, c.b is None) for c in others) == [(False, True), (True, False)]


def test_it_goes_there_and_back_in_one_animation(tmp_path):
    files = [tmp_path / f"{name}.svg" for name in "abc"]
    for file, path in zip(files, (CARD, CROSSED_OUT, CARD), strict=True):
        file.write_text(svg(path))
    (saved,) = sb.blend(files).save(tmp_path / "x.svg")
    assert "<animate" in saved.read_text()


# A bookmark, and it crossed out: three shapes by the other fill rule, drawn a little differently beside the gap.
BOOKMARK = "M5 2H19V22L12 18L5 22Z"
PARTS = ["M2 3L3 2L22 21L21 22Z", "M6.5 2H19.2V14.5Z", "M5 4.5L19 18.5V22.2L12 18L5 22Z"]


def crossed_bookmark(*, backwards=False, middle=PARTS):
    crossed = "".join(f'<path fill-rule="evenodd" d="{d}"/>' for d in middle)
    documents = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24">{each}</svg>'
        for each in (f'<path d="{BOOKMARK}"/>', crossed)
    ]
    drawings = [read(f"{k}.svg", each.encode()) for k, each in enumerate(documents)]
    (pair,), _ = match_all(drawings[::-1] if backwards else drawings, Settings())
    return pair


@pytest.mark.parametrize("backwards", [False, True])
def test_a_drawing_that_is_crossed_out_stays_whatever_it_is_cut_into(backwards):
    pair = crossed_bookmark(backwards=backwards)
    assert [shape.motion_name for shape in pair.shapes] == ["sweep"]
    whole, crossed = painted(pair, float(backwards)), painted(pair, float(not backwards))
    parts = [painted(pair_of(d, d, strokes="keep"), 0.0) for d in PARTS]
    assert np.array_equal(whole, painted(pair_of(BOOKMARK, BOOKMARK), 0.0))
    assert (crossed == np.any(parts, axis=0)).mean() > 0.99
    along = (POINTS.real + POINTS.imag) / 48.0
    for t in (0.25, 0.5, 0.75):
        between = painted(pair, 1.0 - t if backwards else t)
        front = 5.0 / 48.0 + t * 38.0 / 48.0
        assert (between == np.where(along < front, crossed, whole)).mean() > 0.99


@pytest.mark.parametrize(
    "parts",
    [
        ["M2 11H22V13H2Z", "M5 2H19V10H5Z", "M5 14H19V22L12 18L5 22Z"],  # level: a bar of the drawing
        [PARTS[0], "M2 2H22V22H2Z"],  # something else behind the slash
        ["M9 7L9.7 6.3L16 12.6L15.3 13.3Z", BOOKMARK],  # too short
        ["M2.2 4.4L4.4 2.2L21.8 19.6L19.6 21.8Z"],  # nothing stays
    ],
)
def test_other_bars_cross_nothing_out(parts):
    pair = crossed_bookmark(middle=parts)
    assert "sweep" not in {shape.motion_name for shape in pair.shapes}


@pytest.mark.parametrize("left", [5, 6.5])
def test_a_slash_may_leave_little_of_a_drawing_on_its_other_side(left):
    stand = f"M{left} 10.5H{left + 2}V13H"
    whole = f"M9 3H15V12H9Z {stand}17V10H19V15H13V17H11V15H{left}Z"
    crossed = f"M9 3H15V12H13.5L9 7.5Z M17 10H19V15H16.5L14.5 13H17Z {stand}10.2L12.2 15H13V17H11V15H{left}Z"
    pair = pair_of(whole, f"{crossed} M1.4 4.2L2.8 2.8L21.2 21.2L19.8 22.6Z", strokes="auto")
    assert [shape.motion_name for shape in pair.shapes] == ["sweep"]


def test_a_sign_beside_other_changes_grows_from_its_middle():
    pair = pair_of(LOCK, UNLOCKED + "M11 13V19H15V13Z")
    boxes = [Box.around(path.segments) for path in shapes_at(pair, 0.5)[0].paths]
    assert [box.bounds for box in boxes if box.contains(Box(13, 16, 0, 0)) and box.width < 6.0] == [
        pytest.approx((12.0, 14.5, 14.0, 17.5))
    ]


def test_a_sign_whose_edge_continues_that_of_a_bag_by_chance_grows_from_its_middle():
    bag = "M2 4H18V18H2Z M4 6H16V8H4Z"
    plus = "M15 13H17V16H20V18H17V21H15V18H12V16H15Z"  # its bar goes on where the bag's lower edge ends
    pair = pair_of(bag, f"M2 4H18V10A6 6 0 0 0 10 18H2Z M4 6H16V8H4Z {plus}")
    (sign,) = [contour for shape in pair.shapes for contour in shape.contours if not contour.is_matched]
    assert sign.b == 2
    assert np.ptp(sign.start.segments.real) == 0.0


def test_a_sign_in_a_bite_that_opens_a_window_grows_from_its_middle():
    card = "M2 4H18V18H2Z M10 8V14H13V8Z"
    plus = "M15 12H16V14H18V15H16V17H15V15H13V14H15Z"
    pair = pair_of(card, f"M2 4H18V11H13V8H10V18H2Z {plus}")
    added = [contour for shape in pair.shapes for contour in shape.contours if not contour.is_matched]
    points = [contour for contour in added if np.ptp(contour.start.segments) == 0.0]
    assert len(added) == 2
    assert [contour.b for contour in points] == [1]
