import numpy as np
import pytest

from shapeblend_cli.anatomy.decompose import EXTERIOR
from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.geometry.cubics import polyline, signed_area
from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pairing.pair import pair_contours
from shapeblend_cli.pairing.split import hole_in_piece
from tests.support.drawings import BAR, EVENODD, EYED, LEAF, RING, SQUARES, B, contours_of, drawing
from tests.support.motions import pair_of

DISCS = "".join(f"M{x} 9A3 3 0 1 0 {x} 15A3 3 0 1 0 {x} 9Z" for x in (4, 12, 20))
PAUSE = "M5 4H10V20H5Z M14 4H19V20H14Z"
TWO_BARS = "M4 5H20V10H4Z M4 14H20V19H4Z"
CIRCLE = "M12 2A10 10 0 1 0 12 22A10 10 0 1 0 12 2Z"


def pairs(a, b, unmatched="split"):
    contours = [contours_of(d, attributes=EVENODD) for d in (a, b)]
    return pair_contours(*contours, Settings(unmatched=unmatched))


@pytest.mark.parametrize("whole", [BAR, LEAF, CIRCLE])
@pytest.mark.parametrize("several", [DISCS, SQUARES])
def test_an_outline_is_cut_into_as_many_pieces_as_it_has_partners(whole, several):
    found = pairs(whole, several)
    assert sorted(q.number for _, q in found) == list(range(len(contours_of(several))))
    pieces = [p for p, _ in found]
    assert all(p.is_piece and p.number == 0 for p in pieces)
    total = abs(signed_area(contours_of(whole)[0].contour.segments))
    areas = [abs(signed_area(p.contour.segments)) for p in pieces]
    assert sum(areas) == pytest.approx(total, rel=1e-9)
    assert min(areas) > 0.5 * total / len(areas)
    # No piece reaches into another one.
    for p in pieces:
        middle = np.array([p.polygon.vertices.mean()])
        assert [k for k in pieces if winding_numbers(middle, k.polygon.vertices)[0]] == [p]


@pytest.mark.parametrize("unmatched", ["auto", "split"])
@pytest.mark.parametrize("whole", ["M2 2L12 12L22 2V22L12 12L2 22Z", "M2 2H22L12 12L22 22H2L12 12Z"])
def test_an_outline_is_cut_where_it_touches_itself(whole, unmatched):
    found = pairs(whole, PAUSE if "V" in whole else TWO_BARS, unmatched)
    assert [p.is_piece for p, _ in found] == [True, True]
    assert [abs(signed_area(p.contour.segments)) for p, _ in found] == pytest.approx([100, 100], rel=1e-3)


def test_a_cut_that_would_not_lie_inside_when_straightened_is_left_as_it_is():
    contours = [contours_of(each, vertices=12, attributes=EVENODD) for each in (B, SQUARES)]
    found = pair_contours(*contours, Settings(vertices=12))
    assert all(np.isfinite(p.contour.segments).all() for p, _ in found)
    assert {q.number for _, q in found} <= {0, 1, 2, 3}


def test_the_other_way_round_it_is_the_same():
    found = pairs(SQUARES, BAR)
    assert sorted(p.number for p, _ in found) == [0, 1, 2, 3]
    assert all(q.is_piece for _, q in found)
    assert max(abs(q.centre - p.centre) for p, q in found) < 4  # each goes to its own quarter


def test_a_ring_cannot_be_cut_by_a_line_for_rings_and_stays_whole():
    rings = "".join(
        f"M{x} 9A3 3 0 1 0 {x} 15A3 3 0 1 0 {x} 9Z M{x} 11A1 1 0 1 1 {x} 13A1 1 0 1 1 {x} 11Z"
        for x in (4, 12, 20)
    )
    assert [(p.number, p.is_piece) for p, _ in pairs(RING, rings) if p.role == EXTERIOR] == [(0, False)]


def test_holes_go_with_the_piece_they_are_in():
    two = EYED + "M6 10A2 2 0 1 0 6 14A2 2 0 1 0 6 10Z"
    found = pairs(two, "M2 6H10V18H2Z M4 10H8V14H4Z M14 6H22V18H14Z M16 10H20V14H16Z")
    assert len(found) == 4
    for p, q in found:
        assert abs(p.centre - q.centre) < 5, (p.role, p.number)


def test_without_splitting_nothing_is_cut():
    ((piece, _),) = pairs(BAR, SQUARES, "point")
    assert not piece.is_piece


TRIANGLE = "M4 3L20 12L4 21Z"
HALVES = "M2 2H11L9 12L11 22H2Z M13 2H22V22H13L11 12Z"


@pytest.mark.parametrize(
    ("whole", "parts"), [(TRIANGLE, PAUSE), (BAR, HALVES), (CIRCLE, PAUSE), (BAR, SQUARES)]
)
def test_an_outline_is_cut_for_parts_that_have_its_place_together(whole, parts):
    count = len(contours_of(parts))
    for a, b, piece_side in ((whole, parts, 0), (parts, whole, 1)):
        found = pairs(a, b, "auto")
        assert len(found) == count
        assert all(pair[piece_side].is_piece and not pair[1 - piece_side].is_piece for pair in found)
        assert max(abs(q.centre - p.centre) for p, q in found) < 7.0


@pytest.mark.parametrize(
    "parts",
    [
        "M2 2H22V14H2Z M2 17H5V20H2Z",  # one has nearly all of it
        "M2 2H7V7H2Z M17 17H22V22H17Z",  # they fill little of it
        "M30 2H38V22H30Z M42 2H50V22H42Z",  # another place
        "M2 2H16V22H2Z M8 2H22V22H8Z",  # not side by side
    ],
)
def test_otherwise_it_stays_whole(parts):
    box = "M2 2H22V22H2Z"
    for a, b in ((box, parts), (parts, box)):
        assert not any(p.is_piece or q.is_piece for p, q in pairs(a, b, "auto"))


def test_what_has_a_stroke_is_not_cut_by_itself():
    for attributes in ('fill="#fff" stroke="#000"', 'fill="none" stroke="#000"'):
        whole, parts = (contours_of(d, attributes=attributes) for d in (BAR, HALVES))
        assert not any(p.is_piece or q.is_piece for p, q in pair_contours(whole, parts, Settings()))


def test_what_is_asked_for_is_not_cut():
    small = "M10 10H12V12H10Z"
    contours = [contours_of(d) for d in (BAR, HALVES + small)]
    found = pair_contours(*contours, Settings(), [(0, 2)])
    assert [(p.number, q.number) for p, q in found] == [(0, 2)]
    assert not any(p.is_piece or q.is_piece for p, q in found)


def test_an_outline_that_moves_aside_gives_no_piece_to_what_comes_beside_it():
    whole = "M7.5 6A4.5 4.5 0 1 1 16.5 6A4.5 4.5 0 0 1 7.5 6Z"
    whole += "M3.75 20.1A8.25 8.25 0 0 1 20.25 20.1C18 22 6 22 3.75 20.1Z"
    head = "M5.25 6.4A4.1 4.1 0 1 1 13.5 6.4A4.1 4.1 0 0 1 5.25 6.4Z"
    body = "M2.25 19.1A7.1 7.1 0 0 1 16.5 19.1C14.5 22 4 22 2.25 19.1Z"
    plus = "M18.75 6.75H17.25V9.75H14.25V11.25H17.25V14.25H18.75V11.25H21.75V9.75H18.75Z"
    found = pairs(whole, head + body + plus, unmatched="auto")
    assert [(p.number, q.number, p.is_piece) for p, q in found] == [(0, 0, False), (1, 1, False)]


def test_a_shape_with_a_sign_in_a_bite_is_what_is_left_of_it_and_not_cut():
    whole = "M2 8H18V17H2Z"
    bitten, sign = "M2 8H11V11H9V17H2Z", "M10 12H20V21H10Z"
    for one, other in ((whole, f"{bitten}{sign}"), (f"{sign}{bitten}", whole)):
        ((p, q),) = pairs(one, other, "auto")
        assert (p.is_piece, q.is_piece) == (False, False)
        assert {len(p.contour.segments), len(q.contour.segments)} == {4, 6}


BARS = "M2 3H22V6H2Z M2 11H22V13H2Z M2 18H22V21H2Z"
COLUMNS = "M3 2V22H6V2Z M11 2V22H13V2Z M18 2V22H21V2Z"


@pytest.mark.parametrize(("bars", "left"), [(BARS, 1), (COLUMNS, 1), ("M2 4H22V9H2Z M2 15H22V20H2Z", None)])
def test_bars_are_cut_for_rows_and_stay_symmetric(bars, left):
    for a, b, side in ((bars, SQUARES, 0), (SQUARES, bars, 1)):
        found = pairs(a, b, "auto")
        assert len(found) == 4
        assert left not in {pair[side].number for pair in found}
        middles = np.array([pair[side].centre for pair in found])
        for mirrored in (24 - middles.conj(), 24j + middles.conj()):
            assert np.abs(middles[:, None] - mirrored).min(axis=1).max() < 1e-6


@pytest.mark.parametrize(
    "bars",
    [
        "M2 3H12V6H2Z M2 11H12V13H2Z M2 18H12V21H2Z",  # not as wide
        "M2 3H22V6H2Z M2 11H10V13H2Z M12 11H22V13H12Z",  # a row and a bar
    ],
)
def test_other_bars_are_paired_as_usual(bars):
    found = pairs(bars, "M2 1H6V3H2Z M18 1H22V3H18Z M2 21H6V23H2Z M18 21H22V23H18Z", "auto")
    assert not any(p.is_piece for p, _ in found)


@pytest.mark.parametrize("count", [2, 3, 4])
def test_a_grid_is_cut_by_whole_rows(count):
    step = 20 / count
    cells = "".join(
        f"M{2.5 + x * step} {2.5 + y * step}h{step - 1}v{step - 1}h{1 - step}Z"
        for x in range(count)
        for y in range(count)
    )
    found = pairs("M2 2H22V22H2Z", cells, "auto")
    assert len(found) == count * count
    for p, q in found:
        assert p.centre == pytest.approx(q.centre)
        assert (p.box.width, p.box.height) == pytest.approx((step, step))


def test_holes_are_cut_where_the_parts_have_none():
    box, bar = "M2 2H22V22H2Z ", "M5 9V11H19V9Z"
    found = pairs(f"{box}{bar}", SQUARES, "auto")
    assert [p.is_piece for p, _ in found] == [True] * 4
    whole, hole = contours_of(f"{box}{bar}", attributes=EVENODD)
    parts = [hole_in_piece(hole, p, whole) for p, _ in found]
    assert [part.area for part in parts if part is not None] == pytest.approx([14, 14])


@pytest.mark.parametrize(
    "d", ["M5 9V11H19V9Z", "M5 11V13H19V11Z", "M5 6V8H7V6Z M4 10V14H9V10Z M14 3V12H16V3Z"]
)
def test_nothing_is_painted_in_the_gap_between_pieces_of_a_shape_with_holes(d):
    a, b = (drawing(each, attributes=EVENODD) for each in ("M2 2H22V22H2Z " + d, SQUARES))
    for one, other in ((a, b), (b, a)):
        pair = pair_of(one, other, motion="linear")
        grid = np.add.outer(1j * np.arange(1.03, 23, 0.4), np.arange(1.07, 23, 0.4)).ravel()
        for t in np.linspace(0.05, 0.95, 7):
            (painted,) = shapes_at(pair, t)
            polygons = [polyline(contour.segments, 16) for contour in painted.paths]
            winding = sum(winding_numbers(grid, polygon) for polygon in polygons)
            assert set(np.unique(winding * np.sign(winding.sum()))) <= {0, 1}


def test_a_head_that_moves_is_not_cut_for_the_head_that_comes_beside_it():
    head = "M12 3A5 5 0 1 0 12 13A5 5 0 1 0 12 3Z"
    heads = "M10 3A4.5 4.5 0 1 0 10 12A4.5 4.5 0 1 0 10 3Z M16 3.5A4.5 4.5 0 0 1 16 12C18 9 18 6 16 3.5Z"
    assert not any(p.is_piece or q.is_piece for p, q in pairs(head, heads, "auto"))


def test_a_heart_breaks_at_its_notch():
    heart = "M12 8C11 3 2 2 2 9C2 15 9 19 12 22C15 19 22 15 22 9C22 2 13 3 12 8Z"
    broken = "M10 7C6 3 2 4 2 9C2 15 8 19 11 22L8 15L12 12Z M13 6L15 12L11 15L13 22C16 19 22 15 22 9C22 4 16 2 13 6Z"
    pieces = [p for p, _ in pairs(heart, broken)]
    assert len(pieces) == 2
    assert all(p.is_piece for p in pieces)
    for piece in pieces:
        nodes = piece.contour.segments[:, 0]
        assert np.abs(nodes - (12 + 8j)).min() < 1e-9
