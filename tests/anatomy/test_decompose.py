"""Contours as they are seen: which are closed."""

import numpy as np
import pytest

from shapeblend_cli.anatomy.decompose import decompose
from shapeblend_cli.geometry.similarity import Similarity
from tests.support.drawings import drawing

HEART = (
    "M19.5 12.572L12 20L4.5 12.572A5 5 0 1 1 12 6.006A5 5 0 1 1 19.5 12.578"  # it ends .006 from its start
)
STROKE = 'fill="none" stroke="#000" stroke-width="2"'


def contours(path, attributes):
    found, _ = decompose(drawing(f'<path d="{path}" {attributes}/>'), Similarity(), 40)
    return [contour.contour for contour in found]


def test_a_stroke_whose_gap_cannot_be_seen_is_closed():
    (heart,) = contours(HEART, STROKE)
    assert heart.closed
    assert heart.segments[-1, 3] == heart.segments[0, 0]
    assert np.array_equal(heart.segments[:-1, 3], heart.segments[1:, 0])


@pytest.mark.parametrize(
    ("path", "attributes"),
    [
        (HEART, STROKE.replace('"2"', '"0.1"')),  # in a thin line the gap is seen
        (HEART, f'{STROKE} stroke-dasharray="1 1"'),
        ("M4 4L20 20L4 4.001", STROKE),  # there and back
        ("M4 4h.01", STROKE),
        ("M4 12A8 8 0 1 1 12 20", STROKE),
    ],
)
def test_other_open_lines_stay_open(path, attributes):
    assert [contour.closed for contour in contours(path, attributes)] == [False]


def test_a_fill_is_closed_by_a_line():
    (triangle,) = contours("M4 4H20L12 20", 'fill="#000"')
    assert triangle.closed
    assert len(triangle.segments) == 3
