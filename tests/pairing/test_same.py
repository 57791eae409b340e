import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.geometry import cubics
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pairing.paint_order import paint_order, visible_overlaps
from shapeblend_cli.pairing.same import same_pairs
from shapeblend_cli.pipeline import match_all
from tests.support.drawings import EVENODD, contours_of, drawing

RING = "M2 2H22V22H2Z M6 6V18H18V6Z"
FACE = '<circle cx="12" cy="12" r="10" fill="{}"/>'
FACE_OF_FOUR_ARCS = (
    '<path d="M2 12A10 10 0 0 0 12 22A10 10 0 0 0 22 12A10 10 0 0 0 12 2A10 10 0 0 0 2 12Z" fill="{}"/>'
)
EYE = '<circle cx="{}" cy="9" r="2" fill="#000"/>'


def same(a, b, required=()):
    drawings = ((d,) if isinstance(d, str) else d for d in (a, b))
    return same_pairs(
        *[contours_of(*paths, vertices=100, attributes=EVENODD) for paths in drawings], required
    )


@pytest.mark.parametrize(
    ("a", "b", "expected"),
    [
        (RING, RING, [(0, 0), (1, 1)]),
        # Whatever the nodes, the direction and the paint.
        ((FACE.format("#fc0"),), (FACE_OF_FOUR_ARCS.format("#000"),), [(0, 0)]),
        # A hole whose outline is another one is the same, and so its outlines are a pair.
        (RING, "M1 1H23V23H1Z M6 6V18H18V6Z", [(1, 1)]),
        # Not what is a little beside.
        (EYE.format(8), EYE.format(8.3), []),
        # Of two in one place, the one that is painted alike.
        ((FACE.format("#fc0"), FACE.format("#00f")), (FACE.format("#00f"),), [(1, 0)]),
        # Not in the reverse order of paint.
        ((FACE.format("#fc0"), EYE.format(8)), (EYE.format(8), FACE.format("#fc0")), [(0, 1)]),
    ],
)
def test_what_is_the_same_in_place_is_found(a, b, expected):
    assert same(a, b) == expected


def disc(size, colour):
    return f'<circle cx="12" cy="12" r="{size}" fill="#{colour:06x}"/>'


@settings(max_examples=12)
@given(st.permutations(range(6)), st.lists(st.integers(0, 2), min_size=6, max_size=6))
def test_of_what_contradicts_each_other_the_larger_is_kept(order, colours):
    # Discs that are drawn in another order; those of one colour may change places.
    a = [disc(2 + k, colours[k]) for k in range(6)]
    b = [a[k] for k in order]
    below = [visible_overlaps(contours_of(*paths)) for paths in (a, b)]
    kept = []
    for k in reversed(range(6)):
        if paint_order([(m, order.index(m)) for m in [*kept, k]], *below) is not None:
            kept.append(k)
    assert sorted(same(a, b)) == sorted((k, order.index(k)) for k in kept)


def test_what_is_required_counts_more():
    assert same(RING, RING + " M30 2H40V12H30Z", [(0, 2)]) == []


def in_betweens(a, b, times=(0.25, 0.5, 0.75)):
    """The boxes of all paths of a blend at some times."""
    (pair,), _ = match_all([drawing(*a, file="a.svg"), drawing(*b, file="b.svg")], Settings())
    return [
        [cubics.bounds(path.segments) for shape in shapes_at(pair, t) for path in shape.paths] for t in times
    ]


def test_what_is_the_same_stays_while_the_rest_moves():
    face = FACE.format("#fc0")
    there = cubics.bounds(drawing(face).shapes[0].contours[0].segments)
    for boxes in in_betweens([face, EYE.format(8)], [face, EYE.format(9), EYE.format(15)]):
        assert any(np.allclose(box, there, atol=0.05) for box in boxes)


def test_what_is_added_grows_from_its_middle_where_it_is():
    # A bar over a face, and what lies within something that is added too grows as a part of it.
    face, bar = FACE.format("#fc0"), '<path d="M2 11H22V13H2Z" fill="#f00"/>'
    badge, mark = (
        '<rect x="24" width="8" height="8" fill="#00f"/>',
        '<rect x="25" y="1" width="2" height="2"/>',
    )
    for t, boxes in zip(
        (0.25, 0.75), in_betweens([face], [face, bar, badge, mark], (0.25, 0.75)), strict=True
    ):
        _, across, rectangle, part = boxes
        assert across.centre == pytest.approx(12 + 12j, abs=0.1)
        assert across.width == pytest.approx(20 * t)
        assert rectangle.bounds == pytest.approx((28 - 4 * t, 4 - 4 * t, 28 + 4 * t, 4 + 4 * t))
        assert part.bounds == pytest.approx((28 - 3 * t, 4 - 3 * t, 28 - t, 4 - t))


def test_what_is_added_to_a_part_that_moves_goes_with_it():
    card, moved = (f'<rect x="{x}" y="2" width="10" height="10" fill="#fc0"/>' for x in (0, 12))
    dot = '<circle cx="15" cy="9" r="1"/>'
    (boxes,) = in_betweens([card], [moved, dot], [0.5])
    assert boxes[1].centre == pytest.approx(9 + 9j, abs=0.05)
