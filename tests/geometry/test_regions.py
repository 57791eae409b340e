import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.geometry import regions

pictures = st.integers(2, 9).flatmap(
    lambda n: st.lists(st.lists(st.integers(0, 2), min_size=n, max_size=n), min_size=n, max_size=n)
)


def flooded(picture, least):
    """Count regions by flooding one after the other."""
    left = {(y, x) for y in range(len(picture)) for x in range(len(picture))}
    painted = holes = 0
    while left:
        stack = [left.pop()]
        number, region = picture[stack[0][0]][stack[0][1]], set(stack)
        while stack:
            y, x = stack.pop()
            for near in ((y + 1, x), (y - 1, x), (y, x + 1), (y, x - 1)):
                if near in left and picture[near[0]][near[1]] == number:
                    left.remove(near)
                    region.add(near)
                    stack.append(near)
        edge = {0, len(picture) - 1}
        if len(region) >= least:
            painted += number != 0
            holes += number == 0 and not any(y in edge or x in edge for y, x in region)
    return painted, holes


@given(pictures, st.integers(1, 4))
def test_regions_are_those_that_flooding_finds(picture, least):
    assert regions.count_regions(np.array(picture), least) == flooded(picture, least)


def test_compiled_and_uncompiled_kernels_agree(rng, load_uncompiled):
    picture = rng.integers(0, 4, (24, 24))
    uncompiled = load_uncompiled("shapeblend_cli.geometry.regions")
    assert uncompiled.count_regions(picture, 2) == regions.count_regions(picture, 2)
