from itertools import permutations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import shapeblend_cli as sb
from shapeblend_cli.errors import MatchError
from shapeblend_cli.geometry.grouping import assign
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pairing.pair import pair_contours
from shapeblend_cli.wires.match import solved_wires
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


def square(x, y=0, colour="#000", side=4):
    return f'<rect x="{x}" y="{y}" width="{side}" height="{side}" fill="{colour}"/>'


def test_paint_tells_where_place_does_not():
    corners = square(-20, -20), square(30, 20)
    a = square(0, 0, "#f00"), square(6, 0, "#00f"), *corners
    b = square(3, 2, "#00f"), square(3, -2, "#f00"), *corners
    assert pairs(a, b) == [(0, 1), (1, 0), (2, 2), (3, 3)]


def test_a_contour_keeps_its_partner_where_what_was_on_top_is_below():
    big, small = '<circle cx="12" cy="12" r="{}" fill="#f00"/>', '<circle cx="{}" cy="12" r="2" fill="#00f"/>'
    a, b = (big.format(10), small.format(12)), (small.format(10), big.format(8))
    assert pairs(a, b) == [(0, 1), (1, 0)]


def test_what_lies_in_a_contour_goes_where_that_goes():
    # Two plates change their places, with a dot each; the dots themselves would rather stay where they are.
    def plate(x, colour, dot):
        return square(x, 0, colour, 20), square(x + dot, 8, "#000", 4)

    a = *plate(0, "#f80", 3), *plate(24, "#08f", 13)
    b = *plate(24, "#f80", 3), *plate(0, "#08f", 13)
    assert pairs(a, b, [(0, 0)]) == [(0, 0), (1, 1), (2, 2), (3, 3)]
    assert pairs(a, b, [(0, 2)])[:2] == [(0, 2), (1, 3)]


def test_a_line_in_an_outline_goes_to_the_line_in_its_partner():
    stroked = '<path d="M{}V16" fill="none" stroke="#000"/>'
    a = square(0, 0, "#f80", 20), square(30, 0, "#08f", 20), stroked.format("10 4")
    b = square(0, 0, "#08f", 20), square(30, 0, "#f80", 20), stroked.format("8 5"), stroked.format("42 4")
    assert pairs(a, b, [(0, 1)]) == [(0, 1), (1, 0), (2, 3)]


def test_no_partner_is_better_than_a_wrong_one():
    boat = "M10 40H50L42 52H18Z"
    waves = "M2 90C6 86 10 86 14 90H2Z", "M44 90C48 86 52 86 56 90H44Z"
    assert pairs((boat, square(4, 4, "#f00", 3)), (boat, *waves)) == [(0, 0)]
    # But something becomes something, whatever it costs.
    assert len(pairs((square(0, 0, "#f00", 3),), (square(90, 90, "#00f", 30), square(0, 60, "#0f0", 9)))) == 1


def test_of_two_places_for_it_the_better_one_counts_more_than_the_number_of_pairs():
    bars = [square(0, y, "#000", 6) for y in (0, 7, 40)]
    assert pairs(bars[:2], bars[1:])[0] == (1, 0)


FACE = '<circle cx="20" cy="20" r="20" fill="#fc4"/>'


def dot(x, y, r=3.0):
    return f'<circle cx="{x}" cy="{y}" r="{r}" fill="#640"/>'


MOUTH = '<path d="M10 26C14 34 26 34 30 26C26 30 14 30 10 26Z" fill="#640"/>'


def test_twins_go_to_twins_left_to_left_and_the_axis_to_the_axis():
    a = FACE, MOUTH, dot(13, 13), dot(27, 13)
    # In B the eyes are further down, its left one where A's mouth begins, and a dot on the axis is where they were.
    b = FACE, dot(29, 20), dot(11, 20), dot(20, 30, 4), dot(20, 10, 2)
    assert dict(pairs(a, b)) == {0: 0, 1: 3, 2: 2, 3: 1}


def test_an_eye_that_winks_stays_on_its_side():
    wink = '<path d="M23 14C25 10 29 10 31 14C29 12 25 12 23 14Z" fill="#640"/>'
    assert dict(pairs((FACE, MOUTH, wink, dot(13, 13)), (FACE, dot(12, 14), dot(28, 14), MOUTH))) == {
        0: 0,
        1: 3,
        2: 2,
        3: 1,
    }


def test_a_fill_and_its_stroke_go_to_one_outline_and_its_stroke():
    def both(x):
        data = f'd="M{x} 4H{x + 16}V20H{x}Z"'
        return f'<path {data} fill="#fc4"/>', f'<path {data} fill="none" stroke="#000"/>'

    a, b = (*both(0), *both(20)), (*both(21), *both(1))
    assert pairs(a, b) == [(0, 2), (1, 3), (2, 0), (3, 1)]


@settings(max_examples=12)
@given(st.lists(st.integers(1, 3), min_size=4, max_size=4), st.permutations(range(8)))
def test_the_order_in_the_file_of_what_does_not_overlap_means_nothing(sides, order):
    drawn = [square(12 * k, 12 * y, "#000", 3 + 2 * side) for y in range(2) for k, side in enumerate(sides)]
    shuffled = [drawn[k] for k in order]
    assert pairs(drawn, shuffled) == sorted((k, place) for place, k in enumerate(order))


def test_two_hundred_contours_find_their_partners():
    rng = np.random.default_rng(7)
    places = [(30 * (k % 25), 30 * (k // 25)) for k in range(200)]
    a = [square(x, y, "#08f", 12) for x, y in places]
    order = rng.permutation(200)
    b = [square(x + 3, y - 2, "#08f", 10) for x, y in np.array(places)[order].tolist()]
    assert pairs(a, b) == sorted((int(k), place) for place, k in enumerate(order))


def test_required_pairs_win():
    assert pairs(SQUARES, SQUARES, [(0, 3)])[0] == (0, 3)
    assert pairs(B, EIGHT, [(1, 2)]) == [(0, 0), (1, 2), (2, 1)]
    # A pair of holes makes one of their exteriors.
    assert pairs(RINGS, RINGS, [(1, 3)]) == [(0, 2), (1, 3), (2, 0), (3, 1)]


@pytest.mark.parametrize(("dot", "expected"), [(11, [(1, 1), (2, 2)]), (15, [(1, 2), (2, 1)])])
def test_the_dot_of_a_letter_that_is_cut_out_does_not_pass_through_its_stem(dot, expected):
    letter, mark = (
        f"M2 2H22V22H2Z M{dots} {y}h2v{height}h-2Z M{stems} {low}h2v{rest}h-2Z"
        for dots, y, height, stems, low, rest in ((dot, 5, 2, 11, 9, 9), (11, 5, 9, dot, 16, 2))
    )
    assert pairs(letter, mark) == [(0, 0), *expected]
    assert pairs(letter, mark, [(1, 2)]) == [(0, 0), (1, 2), (2, 1)], "if it has to"


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
    there_and_back = "M{0} 2L20 9L{0} 2Z M2 12L20 1{0}L2 12Z M2 20H2.001V20.001Z"
    contours = [contours_of(there_and_back.format(x), attributes='fill="none" stroke="#000"') for x in (2, 4)]
    assert [(p.number, q.number) for p, q in pair_contours(*contours, Settings())] == [(0, 0), (1, 1), (2, 2)]


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
    ("a", "b", "given_settings"),
    [
        ("e", "f", sb.Settings()),
        ("step-1", "step-2", sb.Settings()),  # rotated by a quarter
        ("cow", "deer", sb.Settings(stiff=((59.0 + 80.0j, 60.0, 5.0),), motion="linear")),
    ],
)
def test_a_correspondence_costs_on_the_solved_wires_what_it_says(a, b, given_settings):
    blend = sb.blend(f"samples/{a}.svg", f"samples/{b}.svg", given_settings)
    for contour in blend.pairs[0].contours:
        price = solved_wires(contour, given_settings).path_work(contour.correspondence.dots)
        assert price.total == pytest.approx(contour.correspondence.work, rel=1e-9)


DISC = '<circle cx="50" cy="50" r="50" fill="#fc4"/>'
LIPS = '<rect x="35" y="72" width="30" height="8" fill="#640"/>'


def two(x, y, width, height, fill="#640"):
    """Two ellipses beside each other on a face."""
    return "".join(
        f'<ellipse cx="{cx}" cy="{y}" rx="{width}" ry="{height}" fill="{fill}"/>' for cx in (50 - x, 50 + x)
    )


EYES, BROWS, CHEEKS = two(17, 42, 5, 7), two(22, 20, 10, 3), two(36, 55, 10, 10, "#f78")


@pytest.mark.parametrize("others", [BROWS, CHEEKS, BROWS + CHEEKS])
@pytest.mark.parametrize("eyes", [EYES, two(25, 22, 18, 18, "#d24")], ids=["dark", "large, red and high"])
def test_what_is_left_out_of_a_face_is_not_the_eyes(eyes, others):
    a = DISC, eyes, LIPS
    b = DISC, others, EYES, LIPS
    left = len(others.split("<ellipse"))
    assert pairs(a, b) == [(0, 0), (1, left), (2, left + 1), (3, left + 2)]


def test_eyes_become_eyeballs_and_a_mouth_a_mouth_rather_than_what_lies_in_these():
    a = DISC, two(19, 41, 12, 6), LIPS
    balls = two(19, 38, 15, 15, "#fff") + two(19, 32, 6, 6)
    teeth = '<rect x="30" y="66" width="40" height="22" fill="#640"/>'
    teeth += '<rect x="34" y="72" width="32" height="8" fill="#fff"/>'
    b = DISC, balls, teeth
    assert pairs(a, b) == [(0, 0), (1, 1), (2, 2), (3, 5)]


def test_the_rest_of_a_kind_has_partners_too():
    arcs = {
        "M3 33A50 50 0 0 1 88 18L69 34A25 25 0 0 0 27 41Z": "#e43",
        "M88 18A50 50 0 0 1 82 88L66 69A25 25 0 0 0 69 34Z": "#48f",
        "M82 88A50 50 0 0 1 12 82L31 66A25 25 0 0 0 66 69Z": "#3a5",
        "M12 82A50 50 0 0 1 3 33L27 41A25 25 0 0 0 31 66Z": "#fb0",
    }
    ring = [f'<path d="{d}" fill="{fill}"/>' for d, fill in arcs.items()]
    places = {"#f1511b": (0, 0), "#80cc28": (53, 0), "#00adef": (0, 53), "#fbbc09": (53, 53)}
    tiles = [square(x, y, colour, 47) for colour, (x, y) in places.items()]
    assert len(pairs(ring, tiles)) == 4
