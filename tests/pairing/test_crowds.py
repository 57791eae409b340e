"""Drawings of many contours."""

import pytest

from tests.support.drawings import contours_of

DISC = "M2 72A20 20 0 1 0 42 72A20 20 0 1 0 2 72Z"


@pytest.mark.parametrize("count", [2, 41, 270, 600])
def test_small_contours_get_fewer_vertices_in_a_crowd_fewer_still_and_the_largest_all(count):
    dots = (f"M{x} {y}h1v1h-1Z" for x in range(0, 90, 3) for y in range(0, 60, 3))
    contours = contours_of(DISC, *(d for _, d in zip(range(count - 1), dots, strict=False)))
    vertices = [len(contour.polygon.vertices) for contour in contours]
    assert len(vertices) == count
    assert 190 <= vertices[0] <= 210
    assert min(vertices) >= 25
    assert max(vertices[1:]) < (50 if count > 100 else 70)
