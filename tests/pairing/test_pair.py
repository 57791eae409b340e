import pytest

from shapeblend_cli.errors import MatchError
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.pairing.decompose import decompose
from shapeblend_cli.pairing.pair import pair_contours
from shapeblend_cli.settings import Settings
from tests.support.drawings import EIGHT, EYED, I_DOT, J_DOT, LEAF, RING, SQUARES, B, drawing

EVENODD = 'fill-rule="evenodd"'
LINE = '<path d="M2 2L20 9" fill="none" stroke="#000"/>'
STROKED = '<path d="M2 12L9 20L20 18Z" fill="none" stroke="#000"/>'


def pairs(a, b, given=(), **options):
    a, b = ((d,) if isinstance(d, str) else d for d in (a, b))
    parts = [decompose(drawing(*d, attributes=EVENODD), Similarity(), 100)[0] for d in (a, b)]
    found = pair_contours(*parts, Settings(**options), given)
    return [(p.number, q.number) for p, q in found]


def reversed_subpaths(d):
    return " ".join(f"M{part.strip()}" for part in reversed(d.split("M")[1:]))


def test_what_belongs_together_is_found_in_any_order():
    assert pairs(I_DOT, J_DOT) == [(0, 0), (1, 1)]
    assert pairs(I_DOT, reversed_subpaths(J_DOT)) == [(0, 1), (1, 0)]
    assert pairs(B, EIGHT) == [(0, 0), (1, 1), (2, 2)]
    assert pairs(B, reversed_subpaths(EIGHT)) == [(0, 2), (1, 1), (2, 0)]
    assert pairs(SQUARES, reversed_subpaths(SQUARES)) == [(0, 3), (1, 2), (2, 1), (3, 0)]


def test_a_hole_is_paired_inside_the_partner_of_its_outline_only():
    # The ring's hole, and a leaf beside an eyed shape: the leaf is nearer to the hole than the eye.
    beside = f"{LEAF} M30 12C32 8 44 8 46 12C44 16 32 16 30 12Z M38 11H40V13H38Z"
    found = dict(pairs(f"{RING}", beside))
    assert found.get(1) in (None, 2)
    assert pairs(RING, LEAF) == [(0, 0)]
    assert pairs(LEAF, EYED) == [(0, 0)]


def test_shapes_of_several_elements_are_paired_as_one_drawing():
    apart = tuple(f"M{part}" for part in SQUARES.split("M")[1:])
    assert pairs(SQUARES, apart) == [(0, 0), (1, 1), (2, 2), (3, 3)]
    assert pairs(apart, SQUARES) == [(0, 0), (1, 1), (2, 2), (3, 3)]


def test_open_with_open_unless_there_is_nothing_else():
    assert pairs((LINE, STROKED), (STROKED, LINE)) == [(0, 1), (1, 0)]
    assert pairs((LINE, STROKED), (STROKED,)) == [(1, 0)]
    assert pairs((LINE,), (STROKED,)) == [(0, 0)]


def test_the_larger_ones_find_a_partner():
    large_and_small = "M2 2H18V18H2Z M19 19H20V20H19Z M21 21H22V22H21Z"
    assert pairs(large_and_small, "M3 3H17V16H3Z") == [(0, 0)]


def test_paint_tells_where_shape_does_not():
    def square(x, colour):
        return f'<rect x="{x}" width="4" height="4" y="0" fill="{colour}"/>'

    a, b = (square(0, "#f00"), square(2, "#00f")), (square(0, "#00f"), square(2, "#f00"))
    assert pairs(a, b) != [(0, 1), (1, 0)]  # they overlap: what is on top stays there
    far = square(30, "#0f0")
    a, b = (square(0, "#f00"), square(5, "#00f"), far), (square(0, "#00f"), square(5, "#f00"), far)
    assert pairs(a, b) == [(0, 1), (1, 0), (2, 2)]


def test_where_paint_would_have_to_swap_places_the_larger_one_keeps_its_partner():
    big, small = '<circle cx="12" cy="12" r="{}" fill="#f00"/>', '<circle cx="{}" cy="12" r="2" fill="#00f"/>'
    # In B the small one is below the big one.
    assert pairs((big.format(10), small.format(12)), (small.format(6), big.format(8))) == [(0, 1)]
    # Another small one on top takes its place.
    on_top = (small.format(6), big.format(8), small.format(14))
    assert pairs((big.format(10), small.format(12)), on_top) == [(0, 1), (1, 2)]
    # What is given stays, whatever it covers.
    assert pairs((big.format(10), small.format(12)), (small.format(6), big.format(8)), [(1, 0)])[-1] == (1, 0)


def test_given_pairs_win():
    assert pairs(SQUARES, SQUARES, [(0, 3)])[0] == (0, 3)
    assert pairs(B, EIGHT, [(1, 2)]) == [(0, 0), (1, 2), (2, 1)]
    # Two rings each: a pair of holes makes one of their outlines.
    rings = RING + " " + RING.replace("M12", "M42").replace(" 12 ", " 42 ")
    assert pairs(rings, rings) == [(0, 0), (1, 1), (2, 2), (3, 3)]
    assert pairs(rings, rings, [(1, 3)]) == [(0, 2), (1, 3), (2, 0), (3, 1)]


@pytest.mark.parametrize(
    ("a", "b", "given", "message"),
    [
        (RING, RING, [(0, 1)], "contour 0 of A is an outline and contour 1 of B a hole in contour 0"),
        (RING, RING, [(7, 1)], "A has no contour 7 to match; its contours are 0 to 1"),
        (RING, RING, [(1, 7)], "B has no contour 7"),
        (SQUARES, SQUARES, [(0, 1), (0, 2)], "0=2 contradicts another pair"),
        (SQUARES, SQUARES, [(0, 1), (2, 1)], "2=1 contradicts another pair"),
        ((LINE, STROKED), (STROKED, LINE), [(0, 0)], "is an open line and contour 0 of B an outline"),
    ],
)
def test_pairs_that_cannot_be_given(a, b, given, message):
    with pytest.raises(MatchError, match=message):
        pairs(a, b, given)


def test_lines_there_and_back_and_specks_are_paired():
    there_and_back = "M2 2L20 9L2 2Z M2 12L20 19L2 12Z M2 20H2.001V20.001Z"
    stroke = 'fill="none" stroke="#000"'
    parts = [
        decompose(drawing(d, attributes=stroke), Similarity(), 200)[0] for d in (there_and_back, SQUARES)
    ]
    assert len(pair_contours(*parts, Settings())) == 3
