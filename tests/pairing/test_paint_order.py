import pytest

from shapeblend_cli.geometry.similarity import Similarity
from shapeblend_cli.pairing.decompose import decompose
from shapeblend_cli.pairing.paint_order import paint_order, visible_overlaps
from tests.support.drawings import drawing


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


def below(*elements):
    parts, _ = decompose(drawing(*elements), Similarity(), 0)
    return visible_overlaps(parts)


def rect(x, paint='fill="#f00"', size=4):
    return f'<rect x="{x}" y="0" width="{size}" height="{size}" {paint}/>'


def test_shapes_that_meet_in_other_paint_are_above_each_other():
    assert below(rect(0), rect(2, 'fill="#00f"')) == [(0, 1)]
    assert below(rect(0), rect(2)) == []  # of the same colour: nobody can tell
    assert below(rect(0), rect(9, 'fill="#00f"')) == []
    # A stroke reaches further than the outline.
    wide = 'fill="none" stroke="#00f" stroke-width="4"'
    assert below(rect(0), rect(5, wide)) == [(0, 1)]
    # Of two colours each, even if the same two.
    two = 'fill="#fff" stroke="#000"'
    assert below(rect(0, two), rect(2, two)) == [(0, 1)]
