"""Drawings whose gaps close before the silhouette becomes the other one."""

from functools import cache

import numpy as np
import pytest

from shapeblend_cli.blending import blended, rematched
from shapeblend_cli.blending.graded import grade_of, grade_of_shapes
from shapeblend_cli.blending.silhouettes import blend
from shapeblend_cli.blending.silhouettes.blend import CLOSED, Width
from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.grading.painting import picture
from shapeblend_cli.interpolate.paths import waypoints
from shapeblend_cli.model import Box
from tests.support.drawings import drawing
from tests.support.motions import pair_of

VIEW = Box(0.0, 0.0, 64.0, 64.0)
TORTOISE = (
    "M32 2Q40 6 36 16H28Q24 6 32 2Z M6 22Q16 12 22 18L18 26Q10 28 6 22Z M58 22Q48 12 42 18L46 26Q54 28 58 22Z"
    "M12 58Q12 46 20 44L26 50Q20 58 12 58Z M52 58Q52 46 44 44L38 50Q44 58 52 58Z M24 18H40L36 26H28Z"
    "M22 20L26 28 22 34H18Q18 26 22 20Z M42 20L38 28 42 34H46Q46 26 42 20Z M28 28H36L39 33 36 39H28L25 33Z"
    "M18 37H22L27 41 24 47Q18 44 18 37Z M46 37H42L37 41 40 47Q46 44 46 37Z M29 42H35L38 49Q32 53 26 49Z"
)
TURTLE = (
    "M62 12Q54 8 48 14L50 22Q60 22 62 12Z M6 40Q20 14 46 16L44 24 36 20 24 30 14 30Z M4 44L14 33H23L18 44Z"
    "M26 31L36 23 44 27 40 38 22 42Z M6 48L40 41 46 29 48 26Q50 40 40 50 24 58 6 48Z"
    "M44 46Q54 44 50 62 42 60 40 52Z M14 54L26 57Q20 64 12 62Z"
)
BROAD = "M4 4H60V30H34V10H32V30H4Z M4 33H60V60H4Z"
LONG = "M2 10H62V24H2Z M2 27H62V40H40V50H38V40H2Z"
WORSE = [
    Width(0.03, 9.0, -9.0, 9.0, 0.0),
    Width(0.03, 0.0, 3.0, 9.0, 0.0),
    Width(0.03, 0.0, -9.0, 0.0, 0.0),
    Width(0.03, 0.0, -9.0, 9.0, 9.0),
]
EYE = "M{0} 50V54H{1}V50Z"


def two(a=TORTOISE, b=TURTLE, **settings):
    drawings = [drawing(path, viewbox="0 0 64 64") for path in (a, b)]
    return pair_of(*drawings, swap="never", vertices=100, **settings)


@cache
def usual(a, b):
    """The pair of two drawings where nothing in the package is changed, blended once."""
    return two(a, b)


def ink(pair, t):
    """Which pixels are painted at a time."""
    return picture(shapes_at(pair, t), VIEW)[3]


def closes(pair):
    return [shape.reason for shape in pair.shapes] == [CLOSED]


@pytest.fixture
def always(monkeypatch):
    """Let gaps close whatever the grades."""
    monkeypatch.setattr(blend, "DETAILED", 0.0)
    monkeypatch.setattr(blend, "WIDTHS", (Width(0.03, 0.0, -9.0, 9.0, 0.0),))
    monkeypatch.setattr(blend, "is_suspect", lambda *arguments: True)
    monkeypatch.setattr(blend, "WORSE", 9.0)


@pytest.mark.parametrize("backwards", [False, True])
def test_plates_of_a_shell_meet_before_it_becomes_another(backwards):
    pair = usual(*[TORTOISE, TURTLE][:: -1 if backwards else 1])
    assert closes(pair)
    whole = silhouette(pair)
    gaps = [(ink(whole, t) - ink(pair, t)).sum() for t in (0.0, 0.3, 0.4, 0.5, 0.6, 0.7, 1.0)]
    closed = gaps.index(0.0)
    assert (np.diff(gaps[: closed + 1]) < 0.0).all()
    assert (np.diff(gaps[closed:]) > 0.0).all()


def test_the_drawings_are_at_the_ends_and_close_to_them():
    pair = usual(TORTOISE, TURTLE)
    for t, path in ((0.0, TORTOISE), (1.0, TURTLE)):
        own = usual(path, path)
        assert np.abs(ink(pair, t) - ink(own, t)).sum() <= 0.08 * ink(own, t).sum()
        near = abs(t - 0.02)
        assert np.abs(ink(pair, near) - ink(own, t)).sum() <= 0.12 * ink(own, t).sum()


@pytest.mark.usefixtures("always")
@pytest.mark.parametrize(("drawings", "here"), [((BROAD, TORTOISE), 1), ((TORTOISE, BROAD), 0)])
def test_halfway_the_gaps_of_the_drawing_with_more_of_them_are_open_and_cross_no_others(drawings, here):
    pair = two(*drawings)
    gaps = ink(silhouette(pair), 0.5) - ink(pair, 0.5)
    assert gaps.sum() > 0.005 * gaps.size
    assert {edge.here for edge in pair.shapes[0].motion.edges if edge.until > 0.5} == {here}
    closed = 0.4 if here else 0.6
    assert np.abs(ink(pair, closed) - ink(silhouette(pair), closed)).sum() == 0.0


@pytest.mark.usefixtures("always")
def test_gaps_move_the_same_way_backwards():
    there, back = two(BROAD, TORTOISE), two(TORTOISE, BROAD)
    assert np.abs(ink(there, 0.5) - ink(back, 0.5)).mean() < 0.02


@pytest.mark.parametrize(("end", "t"), [(0.0, 1.0 / 3.0), (1.0, 2.0 / 3.0)])
def test_gaps_are_no_cracks_until_shortly_before_they_close(end, t):
    pair = usual(TORTOISE, TURTLE)
    whole = silhouette(pair)
    gaps = [ink(whole, each).sum() - ink(pair, each).sum() for each in (end, t)]
    assert gaps[1] >= 0.4 * gaps[0]


def silhouette(pair):
    """The same pair without gaps."""
    (shape,) = pair.shapes
    count = len(shape.contours) - len(shape.motion.edges)
    whole = shape._replace(contours=shape.contours[:count], motion=shape.motion._replace(edges=()))
    return pair._replace(shapes=(whole,))


@pytest.mark.parametrize("t", [0.1, 0.25, 0.4, 0.6, 0.75, 0.9])
def test_gaps_stay_in_the_silhouette(t):
    pair = usual(TORTOISE, TURTLE)
    beyond = (ink(pair, t) > 0.5) & (ink(silhouette(pair), t) < 0.5)
    assert beyond.mean() <= 0.004


def test_points_of_the_silhouette_stay_nearer_to_their_places_if_that_looks_better(monkeypatch):
    def graded():
        return grade_of_shapes(silhouette(two()).shapes, VIEW)

    monkeypatch.setattr(rematched, "NEARER", 0.02)
    better = graded()
    monkeypatch.setattr(rematched, "IN_PLACE", ())
    assert better < graded() - 0.02


def test_waypoints_are_few():
    (shape,) = usual(TORTOISE, TURTLE).shapes
    assert len(waypoints(shape)) < 40


def test_a_blend_that_looks_right_stays(monkeypatch):
    def fail(*arguments):
        raise AssertionError

    monkeypatch.setattr(blend, "DETAILED", 0.0)
    monkeypatch.setattr(blend, "_sides", fail)
    assert not closes(two(BROAD, BROAD.replace("60H4", "58H4")))


@pytest.mark.parametrize("width", WORSE)
def test_silhouettes_have_to_look_far_better(width, monkeypatch):
    assert closes(usual(TORTOISE, TURTLE))
    monkeypatch.setattr(blend, "WIDTHS", (width,))
    assert not closes(two())


@pytest.mark.parametrize(("worse", "may_close"), [(9.0, True), (-9.0, False)])
def test_with_its_gaps_the_blend_looks_little_worse_than_usual(worse, may_close, monkeypatch):
    monkeypatch.setattr(blend, "WORSE", worse)
    assert closes(two()) == may_close


@pytest.mark.parametrize(("better", "times"), [(0.0, 1), (3.0, 0)])
def test_gaps_of_one_width_close_once_and_only_if_that_may_look_better(better, times, monkeypatch):
    found = []
    monkeypatch.setattr(blend, "WIDTHS", 2 * (Width(0.03, 0.0, better, 9.0, 0.0),))
    monkeypatch.setattr(blend, "_sides", lambda *arguments: found.append(arguments))
    assert not closes(two())
    assert len(found) == times


def test_what_users_ask_for_is_left_as_it_is():
    assert not closes(two(motion="linear"))
    assert not closes(two(match=((0, 0),)))


@pytest.mark.usefixtures("always")
def test_a_slot_narrows_along_its_length():
    pair = two(BROAD, LONG)
    assert closes(pair)
    for t in (0.1, 0.3):
        columns = (ink(pair, t) < 0.5)[18:30].all(axis=0)[8:56]
        assert columns.sum() <= 4
    assert grade_of(pair).number <= 3.0


@pytest.mark.usefixtures("always")
def test_holes_that_are_alike_stay_open():
    eyed = [
        f"{path} {EYE.format(10 + by, 14 + by)}"
        for path, by in ((BROAD, 0), (BROAD.replace("60H4", "58H4"), 2))
    ]
    pair = two(*eyed)
    assert closes(pair)
    assert sum(contour.is_matched for contour in pair.shapes[0].contours) == 2
    holes = ink(pair, 0.4)[44:60, 4:24] < 0.5
    assert 0.01 < holes.mean() < 0.2


@pytest.mark.usefixtures("always")
@pytest.mark.parametrize(
    ("shape", "count"), [("a{0} {0} 0 0 0 0 {1}a{0} {0} 0 0 0 0 -{1}z", 2), ("v{1}h{1}v-{1}z", 1)]
)
def test_round_holes_stay_open_though_one_is_far_larger(shape, count):
    pair = two(*[f"{BROAD}M16 44{shape.format(size, 2 * size)}" for size in (2.5, 5.0)])
    assert closes(pair)
    assert sum(contour.is_matched for contour in pair.shapes[0].contours) == count


@pytest.mark.usefixtures("always")
def test_without_gaps_there_is_nothing_to_close():
    assert not closes(two("M4 4H60V60H4Z", "M2 20H62V50H2Z"))


@pytest.mark.usefixtures("always")
def test_holes_in_other_outlines_do_not_pair_these():
    small, large = "M2 2H22V22H2Z M9 9V15H15V9Z", "M30 2H62V62H30Z M33 5V50H34V5Z"
    drawings = f"{small} {large}", "M2 2H40V40H2Z M9 9V15H15V9Z M5 20V37H6V20Z M50 50H62V62H50Z"
    assert closes(two(*drawings))


@pytest.mark.usefixtures("always")
def test_wide_gaps_close_where_outlines_are_bent(monkeypatch):
    paths = "M4 4H60V30H4Z M4 34.5H60V60H4Z", "M2 10H62V40H2Z"
    monkeypatch.setattr(blend, "PLAIN", 0.0)
    assert not closes(two(*paths))
    monkeypatch.setattr(blend, "WIDTHS", (Width(0.045, 0.0, -9.0, 9.0, 0.2),))
    assert closes(two(*paths))
    monkeypatch.setattr(blend, "is_suspect", lambda *arguments: False)
    assert not closes(two(*paths))


@pytest.mark.parametrize("backwards", [False, True])
def test_letters_do_not_melt_together(always, backwards):
    letters = "".join(f"M{x} 20h12v24h-12zm3 3v8h6v-8z" for x in (2, 18, 34, 50))
    plate = "M2 20H62V44H2ZM4 22V42H20V22ZM23 22V42H41V22ZM44 22V42H60V22Z"
    assert not closes(two(*[letters, plate][:: -1 if backwards else 1]))
    assert closes(two(plate, TURTLE))


def test_what_becomes_a_plain_shape_closes_its_holes_as_they_are(always, monkeypatch):
    bars, triangle = "M4 4H60V60H4ZM12 14V20H52V14ZM12 28V34H52V28ZM12 42V48H52V42Z", "M4 4L60 32 4 60Z"
    assert not closes(two(bars, triangle))
    monkeypatch.setattr(blend, "PLAIN", 0.0)
    assert closes(two(bars, triangle))


def test_silhouettes_that_wider_gaps_leave_as_they_are_are_blended_once(monkeypatch):
    def in_outline_alone(*arguments):
        made.append(arguments)
        return (), 9.0

    made = []
    monkeypatch.setattr(blended, "_in_outline_alone", in_outline_alone)
    monkeypatch.setattr(
        blend, "WIDTHS", [Width(radius, 0.0, 0.0, 3.0, 0.0) for radius in (0.03, 0.03 + 1e-9)]
    )
    assert not closes(two())
    assert len(made) == 1
