"""Which way of solving two contours is taken."""

import pytest

from tests.support.drawings import drawing
from tests.support.motions import pair_of

HEART = (
    "M50 90C20 65 10 50 10 33C10 18 21 10 31 10C40 10 47 15 50 22"
    "C53 15 60 10 69 10C79 10 90 18 90 33C90 50 80 65 50 90Z"
)
STAR = "M50 8L61 38L93 38L67 58L77 90L50 71L23 90L33 58L7 38L39 38Z"
FLAG = "M10 10C40 0 50 30 90 10L80 60C50 80 40 45 12 70Z"
TORN = "M10 10C40 4 50 24 90 18L74 64C50 66 44 55 22 60Z"


@pytest.mark.parametrize(("a", "b"), [(HEART, STAR), (FLAG, TORN)], ids=["symmetry", "same segments"])
def test_a_stiff_region_leaves_no_way_but_the_least_work(a, b):
    free, stiff = (
        pair_of(drawing(a), drawing(b), motion="linear", **given).contours[0].correspondence
        for given in ({}, {"stiff": [(50 + 22j, 30.0, 1.5)]})
    )
    assert free.gap > 0.0
    assert stiff.gap == 0.0
