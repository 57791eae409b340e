"""Numbers and path data as they are written."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeblend_cli.model import Box, CubicPath
from shapeblend_cli.svg.writing.path_data import path_data, short_path_data
from shapeblend_cli.svg.writing.rounding import decimals_for, number
from tests.support.contours import circle_contour, polygon_contour
from tests.svg.reading.drawings import path_contours

coordinates = st.floats(-1000, 1000)
points = st.builds(complex, coordinates, coordinates)


@st.composite
def cubic_paths(draw):
    count = draw(st.integers(2, 6))
    segments = np.array(draw(st.lists(points, min_size=4 * count, max_size=4 * count))).reshape(count, 4)
    segments[1:, 0] = segments[:-1, 3]
    closed = draw(st.booleans())
    if closed:
        segments[-1, 3] = segments[0, 0]
    return CubicPath(segments, draw(st.lists(st.booleans(), min_size=count, max_size=count)), closed)


def kinds(text):
    return [c for c in text if c.isalpha()]


@pytest.mark.parametrize("write", [path_data, short_path_data])
@given(st.lists(cubic_paths(), min_size=1, max_size=3), st.integers(0, 5))
def test_what_is_written_is_read_again(write, given, decimals):
    text = write(given, decimals)
    read = path_contours(text)
    within = 0.71 * 10.0**-decimals
    # What rounding has made a point is not read.
    if len(read) == len(given):
        for path, contour in zip(given, read, strict=True):
            if len(contour.segments) == len(path.segments):
                ends = contour.segments[:, 3] - path.segments[:, 3]
                assert np.abs(ends).max() <= within + 1e-9
                inner = np.abs(contour.segments - path.segments)[~path.straight]
                assert inner.max(initial=0.0) <= within + 1e-9
    assert len(read) <= len(given)


@given(cubic_paths())
def test_letters_depend_on_the_kinds_of_segments_alone(path):
    moved = CubicPath(path.segments * 1j + 3, path.straight, path.closed)
    for write in (path_data, short_path_data):
        assert kinds(write([path], 3)) == kinds(write([moved], 3))


def test_short_data_is_short():
    path = polygon_contour([0, 0.5, 0.5 + 0.25j, 10 - 3j])
    assert path_data([path], 2) == "M0,0 0.5,0 0.5,0.25 10,-3Z"
    assert short_path_data([path], 2) == "M0 0l.5 0 0 .25 9.5-3.25z"
    small = circle_contour(500 + 500j, 3)
    assert len(short_path_data([small], 3)) < 0.8 * len(path_data([small], 3))


def test_what_is_not_finite_is_not_written():
    path = polygon_contour([0, 1, np.nan])
    for write in (path_data, short_path_data):
        with pytest.raises(ValueError, match="cannot be written"):
            write([path], 3)


@pytest.mark.parametrize(
    ("value", "text"), [(1.0, "1"), (-0.0004, "0"), (0.5, "0.5"), (1234.5678, "1234.568")]
)
def test_numbers_are_as_short_as_can_be(value, text):
    assert number(value, 3) == text


@pytest.mark.parametrize(("size", "decimals"), [(24, 3), (100, 3), (512, 2), (2000, 1), (0.02, 6), (1e6, 0)])
def test_decimals_go_by_the_size(size, decimals):
    assert decimals_for([Box(0, 0, size, size / 2)]) == decimals
    assert 0.71 * 10.0**-decimals <= 1e-4 * size or decimals == 0
