"""What is shown first and last is the drawings, whatever lies on what in each."""

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import shapeblend_cli as sb
from tests.support.drawings import drawing
from tests.support.ends import BLUE, ENDS, GOLD, GREEN, RED, card, seen, write_ends
from tests.support.pictures import difference, pixels

SOON = 1e-7
CARDS = 4


@pytest.mark.parametrize("name", ENDS)
def test_in_betweens_begin_and_end_with_the_drawings(here, name):
    write_ends(name)
    *drawings, options = ENDS[name]
    match = re.findall(r"(\d)=(\d)", options)
    blend = sb.blend("a.svg", "b.svg", match=match, place="asis")
    for t, shown in zip((SOON, 1.0 - SOON), drawings, strict=True):
        assert difference(seen(blend.frame(t).svg, shown), pixels(shown)) < 2e-3


permutations = st.permutations(range(CARDS))
spots = st.lists(st.tuples(st.integers(0, 12), st.integers(0, 8)), min_size=CARDS, max_size=CARDS)


@settings(max_examples=10)
@given(permutations, permutations, spots, spots, st.sampled_from(["", 'fill-opacity="0.6"']))
def test_in_any_order(order, partners, spots_a, spots_b, opacity):
    paints = [f"{paint} {opacity}" for paint in (RED, BLUE, GOLD, GREEN)]
    cards_a = [card(*spot, paint) for spot, paint in zip(spots_a, paints, strict=True)]
    cards_b = [card(*spot, paints[k]) for spot, k in zip(spots_b, order, strict=True)]
    match = [(str(k), str(partners[k])) for k in range(CARDS)]
    blend = sb.blend(drawing(*cards_a), drawing(*cards_b), match=match, place="asis", motion="linear")
    first, last = (pixels(blend.frame(t).svg) for t in (0, 1))
    assert difference(pixels(blend.frame(SOON).svg), first) < 2e-3
    assert difference(pixels(blend.frame(1.0 - SOON).svg), last) < 2e-3


def mixed(picture):
    """How many pixels are neither all red nor all blue nor white, as where one shines through the other."""
    red, _, blue = picture.transpose(2, 0, 1)
    return int(((red > 60) & (red < 195) & (blue > 60) & (blue < 195)).sum())


@pytest.mark.parametrize(
    ("blue_at", "red_at", "times"),
    [
        ((2, 14), (6, 14), [0.45]),  # they always meet: for a moment one shines through the other
        ((0, 14), (14, 2), []),  # they are apart half way
    ],
)
def test_a_card_comes_to_the_top_at_half_time_and_unseen_where_it_can(blue_at, red_at, times):
    red, blue = 'fill="#ff0000"', 'fill="#0000ff"'
    a = drawing(card(2, 2, red, 8, 8), card(6, 2, blue, 8, 8))
    b = drawing(card(*blue_at, blue, 8, 8), card(*red_at, red, 8, 8))
    blend = sb.blend(a, b, match=[("0", "1"), ("1", "0")], place="asis", motion="linear")
    pictures = {t: pixels(blend.frame(t).svg) for t in (0.2, 0.39, 0.45, 0.51, 0.61, 0.8)}
    assert [t for t, picture in pictures.items() if mixed(picture) > 1000] == times
