import pytest

from shapeblend_cli.pairing.paint_order import Overlaps, paint_order, paint_places, visible_overlaps
from tests.support.drawings import contours_of

TWO_COLOURS = 'fill="#fff" stroke="#000"'


def overlaps(*drawings):
    return [Overlaps(contours_of(*paths)) for paths in drawings]


@pytest.mark.parametrize(
    ("groups", "a", "b", "expected"),
    [
        ([(0, 0), (1, 1)], [(0, 1)], [(0, 1)], [0, 1]),
        ([(1, 1), (0, 0)], [], [], [1, 0]),
        ([(0, 1), (1, 0)], [], [(0, 1)], [1, 0]),
        ([(0, 1), (1, 0)], [(0, 1)], [(0, 1)], None),
        # What grows and what shrinks take their place between the others.
        ([(0, 0), (2, 1), (1, None), (None, 2)], [(0, 1), (1, 2)], [(0, 1), (1, 2)], [0, 2, 1, 3]),
    ],
)
def test_what_is_on_top_stays_on_top(groups, a, b, expected):
    assert paint_order(groups, a, b) == expected


@pytest.mark.parametrize(
    ("lower", "x", "upper", "expected"),
    [
        ('fill="#f00"', 2, 'fill="#00f"', [(0, 1)]),
        ('fill="#f00"', 2, 'fill="#f00"', []),  # of the same colour: nobody can tell
        ('fill="#f00"', 9, 'fill="#00f"', []),
        # A stroke reaches further than the outline.
        ('fill="#f00"', 5, 'fill="none" stroke="#00f" stroke-width="4"', [(0, 1)]),
        # Of two colours each, even if the same two.
        (TWO_COLOURS, 2, TWO_COLOURS, [(0, 1)]),
    ],
)
def test_shapes_that_meet_in_other_paint_are_above_each_other(lower, x, upper, expected):
    rects = [f'<rect x="{at}" y="0" width="4" height="4" {paint}/>' for at, paint in ((0, lower), (x, upper))]
    assert visible_overlaps(contours_of(*rects, vertices=0)) == expected


def test_what_lies_in_another_shape_changes_its_place_though_they_do_not_touch():
    disc, dot = '<circle cx="9" cy="9" r="8" fill="#f00"/>', '<circle cx="9" cy="9" r="2" fill="#00f"/>'
    places = paint_places([(0, 1), (1, 0)], [64.0, 4.0], overlaps((disc, dot), (dot, disc)))
    assert sorted((place.shape, place.end) for place in places if place.end is not None) == [(1, 0), (1, 1)]


def test_what_lies_beside_another_shape_in_its_box_keeps_its_place():
    corner, dot = '<path d="M2 2H22V4H4V22H2Z" fill="#f00"/>', '<circle cx="14" cy="14" r="2" fill="#00f"/>'
    places = paint_places([(0, 1), (1, 0)], [64.0, 4.0], overlaps((corner, dot), (dot, corner)))
    assert all(place.end is None for place in places)
