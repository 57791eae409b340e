"""A drawing that becomes the same one filled: a level moves, and both stay as they are."""

import pytest

import shapeblend_cli as sb
from shapeblend_cli.blending.graded import FILLED_GRADE, grade_of
from shapeblend_cli.blending.swaps.filled import OVERLAP
from shapeblend_cli.blending.swaps.swapped import is_filled
from shapeblend_cli.frames.frames import frame_at, shapes_at
from shapeblend_cli.interpolate.paths import paths_at
from shapeblend_cli.model import control_box
from tests.support.drawings import EVENODD, svg

SHIELD = "M12 2L20 5V11C20 16 17 20 12 22C7 20 4 16 4 11V5Z"
CHECK = "M8 11L11 14L16.5 8.5L17.9 9.9L11 16.8L6.6 12.4Z"
INSIDE = "M12 4.1L18 6.4V11C18 15 16 18 12 19.8C8 18 6 15 6 11V6.4Z"
OUTLINE, FILL = f"{SHIELD}{INSIDE}{CHECK}", f"{SHIELD}{CHECK}"
BOX = "M2 2H22V22H2Z"
TIMES = (0.1, 0.3, 0.5, 0.8)


def blended(tmp_path, a, b, **settings):
    files = tmp_path / "a.svg", tmp_path / "b.svg"
    for file, d in zip(files, (a, b), strict=True):
        file.write_text(d if d.startswith("<") else svg(d, attributes=EVENODD))
    (pair,) = sb.blend(*files, **settings).pairs
    return pair


def region(shape, t):
    ((clip,),) = (clip.shapes for clip in shape.clips)
    return control_box(paths_at(clip, shape.own_time(t)))


def test_a_level_rises_evenly_from_the_foot_of_what_changes_to_its_top(tmp_path):
    above, below = blended(tmp_path, OUTLINE, FILL).shapes
    assert is_filled((above, below))
    assert (above.sources, below.sources) == ((0, None), (None, 0))
    levels = [region(below, t).y for t in (0.01, 0.5, 0.99)]
    assert levels == pytest.approx([19.8, 12.0, 4.1], abs=0.4)


@pytest.mark.parametrize("curves", [False, True])
def test_both_drawings_are_whole_at_their_ends_and_beyond(tmp_path, curves):
    pair = blended(tmp_path, OUTLINE, FILL, curves=curves)
    for t in (-0.2, 0.0, 1.0, 1.2):
        (shape,) = frame_at(pair, t, as_drawn=False).shapes
        ((clip,),) = (clip.paths for clip in shape.clips)
        assert control_box([clip]).contains(control_box(shape.paths))
        assert len(shape.paths) == (3 if t <= 0.0 else 2)


def test_nothing_else_moves_and_no_gap_opens(tmp_path):
    pair = blended(tmp_path, OUTLINE, FILL)
    for t in TIMES:
        for shape, (drawn,) in zip(shapes_at(pair, t), pair.drawn, strict=True):
            assert control_box(shape.paths).bounds == pytest.approx(control_box(drawn.paths).bounds)
        above, below = (region(shape, t) for shape in pair.shapes)
        assert above.y + above.height == pytest.approx(below.y + OVERLAP * 24.0)
        assert above.y <= 0.0
        assert below.y + below.height >= 24.0


def test_the_way_back_is_the_same(tmp_path):
    forth, back = blended(tmp_path, OUTLINE, FILL), blended(tmp_path, FILL, OUTLINE)
    for t in TIMES:
        for one, other in zip(forth.shapes, back.shapes, strict=True):
            assert region(one, t).bounds == pytest.approx(region(other, 1.0 - t).bounds)


def test_what_is_filled_may_have_a_gap_where_a_line_is(tmp_path):
    card = "M2 5H22V19H2Z M4 7H20V9H4Z M4 11H20V17H4Z M6 13H10V15H6Z"
    assert is_filled(blended(tmp_path, card, "M2 5H22V9H2Z M2 11H22V19H2Z M6 13H10V15H6Z").shapes)


def test_the_fill_may_have_another_colour_and_all_of_it_changes_then(tmp_path):
    red = svg(f'<path d="{FILL}" fill="#e33" {EVENODD}/>')
    above, below = blended(tmp_path, OUTLINE, red).shapes
    assert [shape.style_a.fill for shape in (above, below)] == ["#000000", "#ee3333"]
    assert [region(below, t).y for t in (0.01, 0.99)] == pytest.approx([22.0, 2.0], abs=0.6)


def test_opacities_may_differ_and_then_the_overlap_is_small(tmp_path):
    tinted = svg(f'<path d="{SHIELD}" fill-opacity=".2"/>', f'<path d="{OUTLINE}" {EVENODD}/>')
    *above, below = blended(tmp_path, tinted, FILL).shapes
    assert is_filled((*above, below))
    upper, lower = region(above[0], 0.5), region(below, 0.5)
    assert upper.y + upper.height - lower.y == pytest.approx(OVERLAP * 24.0)


def test_what_is_not_seen_is_not_filled(tmp_path):
    unseen = svg(f'<path d="{CHECK}" fill="none" stroke="#000" stroke-opacity="0"/>')
    other = svg('<path d="M4 12H18M12 4V18" fill="none" stroke="#000" stroke-opacity="0"/>')
    assert not is_filled(blended(tmp_path, unseen, other).shapes)


def test_no_time_is_lost_where_nothing_changes(tmp_path):
    a = "M2 1H22V9H2Z M4 3H20V7H4Z M6 4H9V6H6Z M2 15H22V23H2Z M4 17H20V21H4Z M6 18H9V20H6Z"
    b = "M2 1H22V9H2Z M6 4H9V6H6Z M2 15H22V23H2Z M6 18H9V20H6Z"
    _, below = blended(tmp_path, a, b).shapes
    levels = [region(below, t).y for t in (0.01, 0.25, 0.75, 0.99)]
    assert levels == pytest.approx([21.0, 19.0, 5.0, 3.0], abs=0.5)
    assert 7.0 < region(below, 0.5).y < 17.0


def test_it_has_a_grade_of_its_own(tmp_path):
    assert grade_of(blended(tmp_path, OUTLINE, FILL)).number == FILLED_GRADE


def test_a_knob_of_a_switch_slides():
    (pair,) = sb.blend("docs/icons/bootstrap/toggle-off.svg", "docs/icons/bootstrap/toggle-on.svg").pairs
    assert not is_filled(pair.shapes)


@pytest.mark.parametrize(
    ("a", "b"),
    [
        (f"{SHIELD}{INSIDE}", SHIELD),  # the hole closes, which looks well
        (OUTLINE, f"{BOX}{CHECK}"),
        (FILL, f"{SHIELD}M7 10.5H17V12.5H7Z"),  # both are filled
        (
            OUTLINE,
            f"M12 3L19 5.6V11C19 15.5 16.5 19 12 20.8C7.5 19 5 15.5 5 11V5.6Z{CHECK}",
        ),  # smaller all around
        (OUTLINE, svg(f'<path d="{SHIELD}" fill="#e33"/>', f'<path d="{CHECK}" fill="#fff"/>')),
    ],
)
def test_other_drawings_are_blended_as_usual(tmp_path, a, b):
    assert not is_filled(blended(tmp_path, a, b).shapes)


@pytest.mark.parametrize("settings", [{"swap": "never"}, {"place": "asis"}, {"motion": "linear"}])
def test_so_are_those_for_which_it_is_asked(tmp_path, settings):
    assert not is_filled(blended(tmp_path, OUTLINE, FILL, **settings).shapes)
