import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.geometry.flatten import flatten
from shapeblend_cli.geometry.polygons import reverse_polygon, winding_numbers
from shapeblend_cli.pairing.nesting import nest
from tests.support.contours import circle_contour, polygon_contour


def square(x, y, size, way=1):
    corners = np.array([0, 1, 1 + 1j, 1j]) * size + complex(x, y)
    return flatten(polygon_contour(corners[::way]), 0)


def painted(polygons, rule, points):
    windings = sum(winding_numbers(points, polygon.vertices) for polygon in polygons)
    return windings != 0 if rule == "nonzero" else windings % 2 == 1


def as_nested(polygons, found):
    return [
        reverse_polygon(polygon, len(polygon.vertices)) if turn else polygon
        for polygon, turn in zip(polygons, found.reversed, strict=True)
    ]


@pytest.mark.parametrize(
    ("contours", "rule", "outline", "turned", "new_rule", "any_rule"),
    [
        ([square(0, 0, 9)], "nonzero", [None], [False], "nonzero", True),
        ([square(0, 0, 9, -1)], "evenodd", [None], [True], "nonzero", True),
        ([square(0, 0, 9), square(3, 3, 3, -1)], "nonzero", [None, 0], [False, False], "nonzero", True),
        ([square(0, 0, 9), square(3, 3, 3)], "evenodd", [None, 0], [False, True], "nonzero", True),
        ([square(3, 3, 3), square(0, 0, 9)], "evenodd", [1, None], [True, False], "nonzero", True),
        # The same way round under nonzero: solid in solid, and no hole.
        ([square(0, 0, 9), square(3, 3, 3)], "nonzero", [None, None], [False, False], "nonzero", False),
        # An island in a hole, and a second outline the other way round beside it.
        (
            [square(0, 0, 9), square(1, 1, 7, -1), square(3, 3, 3), square(20, 0, 5, -1)],
            "nonzero",
            [None, 0, None, None],
            [False, False, False, True],
            "nonzero",
            True,
        ),
        # A hole that touches its outline in a corner.
        ([square(0, 0, 9), square(0, 0, 4)], "evenodd", [None, 0], [False, True], "nonzero", True),
        # Two that overlap: where they do is empty under evenodd, and no direction gives that under nonzero.
        ([square(0, 0, 4), square(2, 2, 4)], "evenodd", [None, None], [False, False], "evenodd", False),
        ([square(0, 0, 4), square(2, 2, 4)], "nonzero", [None, None], [False, False], "nonzero", False),
        # Windings 1, 2, 1, 0: the innermost is a hole, but one that no direction of its own cuts out of two solids.
        (
            [square(0, 0, 9), square(1, 1, 7), square(2, 2, 5, -1), square(3, 3, 3, -1)],
            "nonzero",
            [None, None, None, 2],
            [False, False, False, False],
            "nonzero",
            False,
        ),
    ],
)
def test_roles_are_told_by_the_fill_rule(contours, rule, outline, turned, new_rule, any_rule):
    assert nest(contours, rule) == (tuple(outline), tuple(turned), new_rule, any_rule)


def test_a_pentagram_keeps_its_rule():
    star = flatten(polygon_contour(np.exp(4j * np.pi * np.arange(5) / 5)), 0)
    assert nest([star], "evenodd").rule == "evenodd"
    assert nest([star], "nonzero") == ((None,), (False,), "nonzero", False)


def test_curves_are_told_like_polygons():
    ring = [flatten(circle_contour(radius=r), 100) for r in (1.0, 3.0)]
    assert nest(ring, "evenodd").exterior == (1, None)


places = st.integers(0, 12)
squares = st.builds(square, places, places, st.integers(1, 12), st.sampled_from([1, -1]))


@given(st.lists(squares, min_size=1, max_size=6), st.sampled_from(["nonzero", "evenodd"]))
def test_what_is_painted_stays(contours, rule):
    found = nest(contours, rule)
    x, y = np.meshgrid(np.arange(24) + 0.5, np.arange(24) + 0.5)
    points = (x + 1j * y).ravel()
    before = painted(contours, rule, points)
    turned = as_nested(contours, found)
    np.testing.assert_array_equal(painted(turned, found.rule, points), before)
    if found.any_rule:
        other = {"nonzero": "evenodd", "evenodd": "nonzero"}[found.rule]
        np.testing.assert_array_equal(painted(turned, other, points), before)
    for k, home in enumerate(found.exterior):
        assert home is None or found.exterior[home] is None, f"{k} is a hole in a hole"
