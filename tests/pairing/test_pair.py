from itertools import permutations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import shapeblend_cli as sb
from shapeblend_cli.errors import MatchError
from shapeblend_cli.pairing.contour_blends import solved_wires
from shapeblend_cli.pairing.pair import assign, pair_contours
from shapeblend_cli.settings import Settings
from tests.support.drawings import EIGHT, EVENODD, EYED, I_DOT, J_DOT, LEAF, RING, SQUARES, B, contours_of

LINE = '<path d="M2 2L20 9" fill="none" stroke="#000"/>'
STROKED = '<path d="M2 12L9 20L20 18Z" fill="none" stroke="#000"/>'
APART = tuple(f"M{subpath}" for subpath in SQUARES.split("M")[1:])
RINGS = RING + " " + RING.replace("M12", "M42").replace(" 12 ", " 42 ")


def pairs(a, b, required=(), **options):
    drawings = ((d,) if isinstance(d, str) else d for d in (a, b))
    contours = [contours_of(*paths, vertices=100, attributes=EVENODD) for paths in drawings]
    return [(p.number, q.number) for p, q in pair_contours(*contours, Settings(**options), required)]


def backwards(d):
    """The same subpaths in reverse order."""
    return " ".join(f"M{subpath.strip()}" for subpath in reversed(d.split("M")[1:]))


@pytest.mark.parametrize(
    ("a", "b", "expected"),
    [
        (I_DOT, J_DOT, [(0, 0), (1, 1)]),
        (I_DOT, backwards(J_DOT), [(0, 1), (1, 0)]),
        (B, EIGHT, [(0, 0), (1, 1), (2, 2)]),
        (B, backwards(EIGHT), [(0, 2), (1, 1), (2, 0)]),
        (SQUARES, backwards(SQUARES), [(0, 3), (1, 2), (2, 1), (3, 0)]),
        # No hole becomes an exterior.
        (RING, LEAF, [(0, 0)]),
        (LEAF, EYED, [(0, 0)]),
        # Shapes of several elements are paired as one drawing.
        (SQUARES, APART, [(0, 0), (1, 1), (2, 2), (3, 3)]),
        (APART, SQUARES, [(0, 0), (1, 1), (2, 2), (3, 3)]),
        # Open with open unless there is nothing else.
        ((LINE, STROKED), (STROKED, LINE), [(0, 1), (1, 0)]),
        ((LINE, STROKED), (STROKED,), [(1, 0)]),
        ((LINE,), (STROKED,), [(0, 0)]),
        # The larger ones find a partner.
        ("M2 2H18V18H2Z M19 19H20V20H19Z M21 21H22V22H21Z", "M3 3H17V16H3Z", [(0, 0)]),
        (RINGS, RINGS, [(0, 0), (1, 1), (2, 2), (3, 3)]),
    ],
)
def test_what_belongs_together_is_found_in_any_order(a, b, expected):
    assert pairs(a, b) == expected


def test_a_hole_is_paired_inside_the_partner_of_its_outline_only():
    # The ring's hole, and a leaf beside an eyed shape: the leaf is nearer to the hole than the eye.
    beside = f"{LEAF} M30 12C32 8 44 8 46 12C44 16 32 16 30 12Z M38 11H40V13H38Z"
    assert dict(pairs(RING, beside)).get(1) in (None, 2)


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
    a, b = (big.format(10), small.format(12)), (small.format(6), big.format(8))
    assert pairs(a, b) == [(0, 1)]
    # Another small one on top takes its place.
    assert pairs(a, (*b, small.format(14))) == [(0, 1), (1, 2)]
    # What is required stays, whatever it covers.
    assert pairs(a, b, [(1, 0)])[-1] == (1, 0)


def test_required_pairs_win():
    assert pairs(SQUARES, SQUARES, [(0, 3)])[0] == (0, 3)
    assert pairs(B, EIGHT, [(1, 2)]) == [(0, 0), (1, 2), (2, 1)]
    # A pair of holes makes one of their exteriors.
    assert pairs(RINGS, RINGS, [(1, 3)]) == [(0, 2), (1, 3), (2, 0), (3, 1)]


@pytest.mark.parametrize(
    ("a", "b", "required", "message"),
    [
        (RING, RING, [(0, 1)], "contour 0 of A is an outline and contour 1 of B a hole in contour 0"),
        (RING, RING, [(7, 1)], "A has no contour 7 to match; its contours are 0 to 1"),
        (RING, RING, [(1, 7)], "B has no contour 7"),
        (SQUARES, SQUARES, [(0, 1), (0, 2)], "0=2 contradicts another pair"),
        (SQUARES, SQUARES, [(0, 1), (2, 1)], "2=1 contradicts another pair"),
        ((LINE, STROKED), (STROKED, LINE), [(0, 0)], "is an open line and contour 0 of B an outline"),
    ],
)
def test_pairs_that_cannot_be_required(a, b, required, message):
    with pytest.raises(MatchError, match=message):
        pairs(a, b, required)


def test_lines_there_and_back_and_specks_are_paired():
    there_and_back = "M2 2L20 9L2 2Z M2 12L20 19L2 12Z M2 20H2.001V20.001Z"
    contours = [contours_of(d, attributes='fill="none" stroke="#000"') for d in (there_and_back, SQUARES)]
    assert len(pair_contours(*contours, Settings())) == 3


@given(st.data(), st.integers(1, 5), st.integers(1, 5))
def test_as_many_pairs_as_can_be_at_the_least_total(data, p, q):
    row = st.lists(st.integers(0, 50), min_size=q, max_size=q)
    costs = np.array(data.draw(st.lists(row, min_size=p, max_size=p)), float)
    found = assign(costs)
    assert len({i for i, _ in found}) == len({j for _, j in found}) == len(found) == min(p, q)
    tall = costs if p <= q else costs.T
    columns = permutations(range(max(p, q)), min(p, q))
    assert sum(costs[i, j] for i, j in found) == min(
        sum(tall[i, j] for i, j in enumerate(chosen)) for chosen in columns
    )


def test_nothing_with_nothing():
    assert assign(np.zeros((0, 3))) == []


@pytest.mark.parametrize(
    ("a", "b", "settings"),
    [
        ("e", "f", sb.Settings()),
        ("step-1", "step-2", sb.Settings()),  # rotated by a quarter
        ("cow", "deer", sb.Settings(stiff=((59.0 + 80.0j, 60.0, 5.0),), motion="linear")),
    ],
)
def test_a_correspondence_costs_on_the_solved_wires_what_it_says(a, b, settings):
    blend = sb.blend(f"samples/{a}.svg", f"samples/{b}.svg", settings)
    for contour in blend.pairs[0].contours:
        price = solved_wires(contour, settings).path_work(contour.correspondence.dots)
        assert price.total == pytest.approx(contour.correspondence.work, rel=1e-9)
