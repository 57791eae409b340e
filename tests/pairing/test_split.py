import numpy as np
import pytest

from shapeblend_cli.geometry.cubics import signed_area
from shapeblend_cli.geometry.polygons import winding_numbers
from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.pairing.decompose import EXTERIOR, decompose
from shapeblend_cli.pairing.pair import pair_contours
from shapeblend_cli.settings import Settings
from tests.support.drawings import BAR, EYED, LEAF, RING, SQUARES, drawing

SPLIT = Settings(unmatched="split")
DISCS = "".join(f"M{x} 9A3 3 0 1 0 {x} 15A3 3 0 1 0 {x} 9Z" for x in (4, 12, 20))
CIRCLE = "M12 2A10 10 0 1 0 12 22A10 10 0 1 0 12 2Z"


def couples(a, b, settings=SPLIT):
    rule = 'fill-rule="evenodd"'
    parts = [decompose(drawing(d, attributes=rule), Similarity(), 200)[0] for d in (a, b)]
    return pair_contours(*parts, settings), parts


@pytest.mark.parametrize("whole", [BAR, LEAF, CIRCLE])
@pytest.mark.parametrize("several", [DISCS, SQUARES])
def test_an_outline_is_cut_into_as_many_pieces_as_it_has_partners(whole, several):
    found, (parts_a, parts_b) = couples(whole, several)
    assert sorted(q.number for _, q in found) == list(range(len(parts_b)))
    pieces = [p for p, _ in found]
    assert all(p.is_piece and p.number == 0 for p in pieces)
    total = abs(signed_area(parts_a[0].contour.segments))
    areas = [abs(signed_area(p.contour.segments)) for p in pieces]
    assert sum(areas) == pytest.approx(total, rel=1e-9)
    assert min(areas) > 0.5 * total / len(areas)
    # No piece reaches into another one.
    for p in pieces:
        middle = np.array([p.polygon.vertices.mean()])
        assert [k for k in pieces if winding_numbers(middle, k.polygon.vertices)[0]] == [p]


def test_the_other_way_round_it_is_the_same():
    found, _ = couples(SQUARES, BAR)
    assert sorted(p.number for p, _ in found) == [0, 1, 2, 3]
    assert all(q.is_piece for _, q in found)
    ways = [(q.centre - p.centre) for p, q in found]
    assert max(map(abs, ways)) < 4  # each goes to its own quarter


def test_a_ring_cannot_be_cut_by_a_line_and_stays_whole():
    found, _ = couples(RING, DISCS)
    assert [(p.number, p.is_piece) for p, _ in found if p.role == EXTERIOR] == [(0, False)]


def test_holes_go_with_the_piece_they_are_in():
    two = EYED + "M6 10A2 2 0 1 0 6 14A2 2 0 1 0 6 10Z"
    discs = "M2 6H10V18H2Z M4 10H8V14H4Z M14 6H22V18H14Z M16 10H20V14H16Z"
    parts = [
        decompose(drawing(d, attributes='fill-rule="evenodd"'), Similarity(), 200)[0] for d in (two, discs)
    ]
    found = pair_contours(*parts, SPLIT)
    assert len(found) == 4
    for p, q in found:
        assert abs(p.centre - q.centre) < 5, (p.role, p.number)


def test_without_splitting_nothing_is_cut():
    found, _ = couples(BAR, SQUARES, Settings())
    assert len(found) == 1
    assert not found[0][0].is_piece
