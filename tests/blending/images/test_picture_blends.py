"""Pictures of two drawings: partners, ways, paint and the order of paint."""

import numpy as np
import pytest

from shapeblend_cli.errors import InputError, MatchError
from shapeblend_cli.frames.frames import frame_at
from shapeblend_cli.model import Pose
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from tests.support.drawings import drawing
from tests.support.images import checkerboard, disc, face, image

BOARD, FACE, DISC = checkerboard(), face(), disc()
SQUARE, CIRCLE = '<rect x="2" y="2" width="6" height="6"/>', '<circle cx="18" cy="18" r="4" fill="#c00"/>'


def blend(a, b, **settings):
    """The blend of two documents of elements."""
    (pair,), notes = match_all([drawing(a), drawing(b, file="b.svg")], Settings(**settings))
    assert not notes
    return pair


def pictures(pair):
    return [shape for shape in pair.shapes if shape.style_a.picture]


def at(pair, t):
    """What a frame shows: pictures as their names in the table below, shapes by their colours, and opacities."""
    shown = []
    for shape in frame_at(pair, t, as_drawn=False).shapes:
        for style in (shape.below, shape.style):
            if style is not None and style.fill_opacity > 0.0:
                shown.append((style.picture, style.fill_opacity) if style.picture else style.fill)
    return shown


def test_the_same_picture_stays_one_on_its_way():
    pair = blend(
        image(BOARD, 'width="8" height="8"'),
        image(BOARD, 'x="12" y="4" width="4" height="12" preserveAspectRatio="none" opacity=".5"'),
    )
    ((picture, opacity),) = at(pair, 0.5)
    assert (picture.origin, picture.across, picture.down, opacity) == (6 + 2j, 6, 10j, 0.75)


def test_another_picture_dissolves_over_the_first():
    pair = blend(image(BOARD, 'width="8" height="8"'), image(FACE, 'width="8" height="8"', "JPEG"))
    (below, a), (above, b) = at(pair, 0.25)
    assert (below.raster.kind, a, above.raster.kind, b) == ("image/png", 1.0, "image/jpeg", 0.25)
    assert below.pose == pytest.approx(above.pose)


def test_below_a_picture_with_nothing_around_it_the_first_one_fades():
    pair = blend(image(BOARD, 'width="8" height="8"'), image(DISC, 'width="8" height="8"'))
    assert [opacity for _, opacity in at(pair, 0.25)] == [0.75, 0.25]


def test_a_picture_turns_the_shorter_way():
    turned = 'width="8" height="4" transform="rotate({} 12 12) translate(8 10)"'
    pair = blend(image(BOARD, turned.format(170)), image(BOARD, turned.format(-170)))
    ((picture, _),) = at(pair, 0.5)
    assert abs(picture.pose.angle) == pytest.approx(180)
    assert abs(picture.across) == pytest.approx(4)  # square, as it fits into the box


def test_sides_skew_and_angle_change_evenly(rng):
    for _ in range(20):
        poses = [
            Pose(
                complex(*rng.normal(size=2)),
                rng.uniform(-90, 90),
                rng.uniform(-60, 60),
                *rng.uniform(0.5, 3.0, 2),
            )
            for _ in range(2)
        ]
        middle = poses[0].towards(poses[1], 0.5)
        assert np.allclose(np.array(middle), np.mean(poses, axis=0))


def test_a_mirror_image_is_turned_over_like_a_card():
    pair = blend(
        image(FACE, 'width="8" height="6"'),
        image(FACE, 'x="-8" width="8" height="6" transform="scale(-1 1)"'),
    )
    ((picture, _),) = at(pair, 0.25)
    assert (picture.pose.angle, picture.pose.height) == pytest.approx((0, 6))
    assert picture.across == pytest.approx(4)


PARTNERS = {
    "ids": ('id="p" x="0"', 'id="q" x="20"', 'id="q" x="0"', 'id="p" x="20"', True),
    "labels": ('inkscape:label="p" x="0"', 'x="20"', 'x="0"', 'inkscape:label="p" x="20"', True),
    "place": ('id="p" x="0"', 'x="20"', 'x="1"', 'id="q" x="19"', False),
}


@pytest.mark.parametrize("case", PARTNERS)
def test_partners_are_called_alike_or_near(case):
    *attributes, crosses = PARTNERS[case]
    one, other, third, fourth = (image(BOARD, f'{text} width="4" height="4"') for text in attributes)
    pair = blend(one + other, third + fourth)
    moves = {(shape.sources[0], shape.sources[1]) for shape in pictures(pair)}
    assert moves == ({(0, 1), (1, 0)} if crosses else {(0, 0), (1, 1)})


def test_the_same_picture_is_a_nearer_partner():
    a = image(BOARD, 'x="0" width="4" height="4"') + image(FACE, 'x="3" width="4" height="4"')
    b = image(FACE, 'x="0" width="4" height="4"') + image(BOARD, 'x="3" width="4" height="4"')
    assert {shape.sources for shape in pictures(blend(a, b))} == {(0, 1), (1, 0)}


def test_match_names_pictures_by_number_and_id():
    a = (
        SQUARE
        + image(BOARD, 'x="0" width="4" height="4"')
        + image(FACE, 'id="f" x="20" width="4" height="4"')
    )
    for match in (("1", "2"), ("f", "1"), ("#f", "1")):
        assert {shape.sources for shape in pictures(blend(a, a, match=(match,)))} == {(1, 2), (2, 1)}
    with pytest.raises(MatchError, match="--match 0,1: a picture becomes a picture"):
        blend(a, a, match=(("0", "1"),))


@pytest.mark.parametrize("is_new", [False, True])
def test_a_picture_without_a_partner_fades_at_its_place(is_new):
    drawings = [SQUARE + image(BOARD, 'x="10" width="8" height="8"'), SQUARE]
    pair = blend(*(drawings[::-1] if is_new else drawings))
    _, (picture, opacity) = at(pair, 0.25)
    assert (picture.origin, picture.across, opacity) == (10, 8, 0.25 if is_new else 0.75)
    assert len(at(pair, 1.0 if is_new else 0.0)) == 2
    assert len(at(pair, 0.0 if is_new else 1.0)) == 1


ORDERS = {
    "behind": (image(BOARD, 'width="24" height="24"') + SQUARE + CIRCLE, [True, False, False]),
    "between": (SQUARE + image(BOARD, 'width="24" height="24"') + CIRCLE, [False, True, False]),
    "before": (SQUARE + CIRCLE + image(BOARD, 'width="24" height="24"'), [False, False, True]),
}


@pytest.mark.parametrize("order", ORDERS)
def test_the_order_of_paint_stays(order):
    markup, expected = ORDERS[order]
    pair = blend(markup, markup.replace('cx="18"', 'cx="15"'))
    assert [isinstance(one, tuple) for one in at(pair, 0.5)] == expected


def test_a_picture_that_changes_its_place_in_the_order_fades_there():
    pair = blend(ORDERS["behind"][0], ORDERS["before"][0])
    assert [isinstance(one, tuple) for one in at(pair, 0.3)] == [True, False, False]
    assert [isinstance(one, tuple) for one in at(pair, 0.5)] == [True, False, False, True]
    assert [isinstance(one, tuple) for one in at(pair, 0.7)] == [False, False, True]
    assert len(pair.each_shape) == 3


def test_drawings_of_pictures_alone_blend():
    pair = blend(image(BOARD, 'width="8" height="8"'), image(BOARD, 'x="8" width="8" height="8"'))
    assert [shape.sources for shape in pair.shapes] == [(0, 0)]


def test_shapes_beside_a_drawing_of_pictures_alone_fade():
    pair = blend(SQUARE + CIRCLE, image(BOARD, 'width="8" height="8"'))
    assert at(pair, 0.0) == ["#000000", "#cc0000"]
    styles = [shape.style for shape in frame_at(pair, 0.25, as_drawn=False).shapes]
    assert sorted(style.fill_opacity for style in styles) == [0.25, 0.75, 0.75]
    assert [one[1] for one in at(pair, 1.0)] == [1.0]


def test_clips_go_along():
    clipped = '<clipPath id="c"><circle cx="{0}" cy="4" r="4"/></clipPath>' + image(
        BOARD, 'x="{1}" width="8" height="8" clip-path="url(#c)"'
    )
    pair = blend(clipped.format(4, 0), clipped.format(14, 10))
    (shape,) = frame_at(pair, 0.5, as_drawn=False).shapes
    (clip,) = shape.clips
    edge = np.concatenate([path.segments.ravel() for path in clip.paths])
    assert (edge.real.min(), edge.real.max()) == pytest.approx((5, 13))


def test_the_other_paint_at_its_own_place():
    pair = blend(image(BOARD, 'width="8" height="8"'), image(FACE, 'x="8" width="8" height="6"'), style="a")
    ((picture, _),) = at(pair, 1.0)
    assert (picture.raster.kind, picture.origin, picture.down) == ("image/png", 8, 6j)


def test_mixtures_have_no_pictures():
    files = [drawing(SQUARE + image(BOARD, ""), file=name) for name in ("a.svg", "b.svg", "c.svg")]
    pairs, notes = match_all(files, Settings(mix=((0.2, 0.4, 0.4),)))
    assert notes == ["pictures are left out of mixtures and states; frames and animated SVGs have them"]
    assert all(len(pair.shapes) == 1 for pair in pairs)
    only = [drawing(image(BOARD, ""), file=name) for name in ("a.svg", "b.svg", "c.svg")]
    with pytest.raises(InputError, match="mixtures and states have no pictures"):
        match_all(only, Settings(mix=((0.2, 0.4, 0.4),)))


def test_pictures_start_one_after_the_other():
    pair = blend(
        SQUARE + image(BOARD, 'width="8" height="8"'),
        SQUARE + image(BOARD, 'x="16" width="8" height="8"'),
        stagger=0.5,
    )
    assert at(pair, 0.5)[1][0].origin == 0
    assert at(pair, 0.75)[1][0].origin == 8
