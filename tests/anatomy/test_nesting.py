import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.anatomy import nesting
from shapeblend_cli.anatomy.nesting import nest
from shapeblend_cli.geometry import raster
from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.polygons import reverse_polygon, winding_numbers
from shapeblend_cli.model import Box
from tests.support.contours import circle_contour, polygon_contour
from tests.support.shapes import random_polygon


def square(x, y, size, step=1):
    corners = np.array([0, 1, 1 + 1j, 1j]) * size + complex(x, y)
    return flatten(polygon_contour(corners[::step]), 0)


@pytest.mark.parametrize(
    ("squares", "rule", "exterior", "is_reversed", "new_rule", "any_rule"),
    [
        ([(0, 0, 9)], "nonzero", [None], [0], "nonzero", True),
        ([(0, 0, 9, -1)], "evenodd", [None], [1], "nonzero", True),
        ([(0, 0, 9), (3, 3, 3, -1)], "nonzero", [None, 0], [0, 0], "nonzero", True),
        ([(0, 0, 9), (3, 3, 3)], "evenodd", [None, 0], [0, 1], "nonzero", True),
        ([(3, 3, 3), (0, 0, 9)], "evenodd", [1, None], [1, 0], "nonzero", True),
        # The same way round under nonzero: solid in solid, and no hole.
        ([(0, 0, 9), (3, 3, 3)], "nonzero", [None, None], [0, 0], "nonzero", False),
        # An island in a hole, and a second exterior the other way round beside it.
        (
            [(0, 0, 9), (1, 1, 7, -1), (3, 3, 3), (20, 0, 5, -1)],
            *("nonzero", [None, 0, None, None], [0, 0, 0, 1], "nonzero", True),
        ),
        # A hole that touches its exterior in a corner.
        ([(0, 0, 9), (0, 0, 4)], "evenodd", [None, 0], [0, 1], "nonzero", True),
        # Two that overlap: where they do is empty under evenodd, and no direction gives that under nonzero.
        ([(0, 0, 4), (2, 2, 4)], "evenodd", [None, None], [0, 0], "evenodd", False),
        ([(0, 0, 4), (2, 2, 4)], "nonzero", [None, None], [0, 0], "nonzero", False),
        # Windings 1, 2, 1, 0: the innermost is a hole, but one that no direction of its own cuts out of two solids.
        (
            [(0, 0, 9), (1, 1, 7), (2, 2, 5, -1), (3, 3, 3, -1)],
            *("nonzero", [None, None, None, 2], [0, 0, 0, 0], "nonzero", False),
        ),
    ],
)
def test_roles_are_told_by_the_fill_rule(squares, rule, exterior, is_reversed, new_rule, any_rule):
    polygons = [square(*each) for each in squares]
    assert nest(polygons, rule) == (tuple(exterior), tuple(map(bool, is_reversed)), new_rule, any_rule)


def test_of_contours_drawn_again_and_again_one_is_looked_at(monkeypatch):
    looked = []
    monkeypatch.setattr(
        nesting, "winding_sums", lambda *given: looked.append(len(given[0])) or raster.winding_sums(*given)
    )
    squares = [square(0, 0, 9)] * 50 + [square(3, 3, 3)] * 50
    assert nest(squares, "evenodd").exterior == (None,) * 100
    assert set(looked) == {2 * 2 * nesting.SAMPLES}


def test_winding_numbers_are_added_up(rng):
    """Of polygons in each other, across all of the bands or parts of them, whichever way round they run."""
    sizes = np.append(np.linspace(0.2, 12, 40), rng.uniform(0.05, 2, 40))
    middles = np.append(np.zeros(40), rng.normal(0, 5, 40) + 1j * rng.normal(0, 5, 40))
    polygons = [
        middle + size * random_polygon(rng, 7)
        for middle, size in zip(middles.tolist(), sizes.tolist(), strict=True)
    ]
    bands = raster.Bands.of(polygons, np.array([Box.around(vertices) for vertices in polygons]))
    points = rng.normal(0, 6, 400) + 1j * rng.normal(0, 6, 400)
    factors = rng.integers(-3, 4, len(polygons))
    table = np.array([winding_numbers(points, vertices) for vertices in polygons])
    assert np.unique(table).size > 2
    np.testing.assert_array_equal(raster.winding_table(points, bands), table)
    np.testing.assert_array_equal(raster.winding_sums(points, bands, factors), factors @ table)


def test_a_pentagram_keeps_its_rule():
    star = flatten(polygon_contour(np.exp(4j * np.pi * np.arange(5) / 5)), 0)
    assert nest([star], "evenodd").rule == "evenodd"
    assert nest([star], "nonzero") == ((None,), (False,), "nonzero", False)


def test_curves_are_told_like_polygons():
    ring = [flatten(circle_contour(radius=r), 100) for r in (1.0, 3.0)]
    assert nest(ring, "evenodd").exterior == (1, None)


corners = st.integers(0, 12)
squares = st.builds(square, corners, corners, st.integers(1, 12), st.sampled_from([1, -1]))
GRID = np.add.outer(1j * (np.arange(24) + 0.5), np.arange(24) + 0.5).ravel()


def painted(polygons, rule):
    """At which points of the grid there is paint."""
    windings = sum(winding_numbers(GRID, polygon.vertices) for polygon in polygons)
    return windings != 0 if rule == "nonzero" else windings % 2 == 1


@given(st.lists(squares, min_size=1, max_size=6), st.sampled_from(["nonzero", "evenodd"]))
def test_what_is_painted_stays(polygons, rule):
    nesting = nest(polygons, rule)
    oriented = [
        reverse_polygon(polygon, len(polygon.vertices)) if is_reversed else polygon
        for polygon, is_reversed in zip(polygons, nesting.reversed, strict=True)
    ]
    for new_rule in ("nonzero", "evenodd") if nesting.any_rule else (nesting.rule,):
        np.testing.assert_array_equal(painted(oriented, new_rule), painted(polygons, rule))
    for k, parent in enumerate(nesting.exterior):
        assert parent is None or nesting.exterior[parent] is None, f"{k} is a hole in a hole"
