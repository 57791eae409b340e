"""Straight strokes and slashes without a partner, beside fills."""

import numpy as np
import pytest

from shapeblend_cli.frames.frames import shapes_at
from tests.pens.test_line_blends import blend
from tests.support.drawings import drawing

BELL = '<path d="M{x} 4H{y}V18H{x}Z" fill="#fd0" stroke="#000" stroke-width="2"/>'
LINE = '<path d="{path}" fill="none" stroke="#000" stroke-width="2" stroke-linecap="round"/>'


def loose_line(path, t, *, backwards):
    """Return the stroke without a partner at a time, its ends and its width; the bell moves on by 2."""
    plain, lined = drawing(BELL.format(x=6, y=16)), drawing(BELL.format(x=8, y=18) + LINE.format(path=path))
    pair = blend(*[plain, lined][:: -1 if backwards else 1])
    (shape,) = [shape for shape in shapes_at(pair, 1.0 - t if backwards else t) if shape.style.fill is None]
    points = np.append(shape.paths[0].segments[:, 0], shape.paths[0].segments[-1, 3])
    return points, shape.style.stroke_width


@pytest.mark.parametrize("backwards", [False, True])
def test_a_slash_is_drawn_on_from_its_left_end_at_its_width(backwards):
    points, width = loose_line("M4 3L22 21", 0.5, backwards=backwards)
    assert width == pytest.approx(2.0)
    whole = abs(18 + 18j)
    assert np.abs(np.diff(points)).sum() == pytest.approx(whole / 2.0)
    assert points[0].imag == pytest.approx(3.0)
    assert points[0].real < 4.0  # carried along


def test_a_stick_is_drawn_on_from_where_it_touches_and_stays_in_touch():
    for t in (0.3, 0.6, 0.9):
        points, width = loose_line("M24 10H18", t, backwards=False)
        assert width == pytest.approx(2.0)
        assert points[0] == pytest.approx(16 + 2 * t + 10j)
        assert np.abs(np.diff(points)).sum() == pytest.approx(6.0 * t)


def test_a_bent_stroke_grows_from_a_point():
    assert loose_line("M24 10H18V14", 0.5, backwards=False)[1] == pytest.approx(1.0)


@pytest.mark.parametrize(("bar", "is_drawn"), [("M3 4L5 2L23 20L21 22Z", True), ("M8 10H16V12H8Z", False)])
def test_a_filled_slash_is_drawn_on_and_other_bars_grow(bar, is_drawn):
    plain = BELL.format(x=6, y=16)
    pair = blend(drawing(plain), drawing(plain + f'<path fill="#f00" d="{bar}"/>'))
    (shape,) = [
        shape for shape in shapes_at(pair, 0.5) if "#ff0000" in (shape.style.fill, shape.style.stroke)
    ]
    assert (shape.style.fill is None) == is_drawn
    if is_drawn:
        assert shape.style.stroke_width == pytest.approx(abs(2 + 2j), rel=0.01)
        ends = shape.paths[0].segments[0, 0], shape.paths[0].segments[-1, 3]
        assert abs(ends[1] - ends[0]) == pytest.approx(abs(9 + 9j), rel=0.02)
