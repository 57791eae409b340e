"""Lines without a partner beside fills of several colours: when they are gone, and with what they go."""

import numpy as np
import pytest

from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.model import Box
from tests.support.drawings import drawing
from tests.support.motions import pair_of

ROUND = '<path fill="#ee8822" d="M4 36A28 24 0 0 1 60 36A28 24 0 0 1 4 36Z"/>'
TALL = '<path fill="#ee8822" d="M14 14H50V62H14Z"/>'
FLAG = '<path fill="#224488" d="M30 12V2L44 7Z"/>'
LINES = '<path fill="none" stroke="#000000" stroke-width="2" stroke-linecap="round" d="{}"/>'


def blend(a, b):
    return pair_of(*(drawing(side, viewbox="0 0 64 64") for side in (a, b)))


def strokes_at(pair, t):
    """The boxes of what is seen of black lines at a time."""
    found = [shape for shape in shapes_at(pair, t) if shape.style.stroke == "#000000"]
    seen = [shape for shape in found if shape.style.stroke_width and shape.style.stroke_opacity]
    return [Box.around(np.asarray(path.segments).ravel()) for shape in seen for path in shape.paths]


def test_several_curved_lines_of_one_shape_are_no_dots_once_they_are_gone():
    curls = LINES.format("M20 30Q24 24 28 30M36 30Q40 24 44 30M28 44Q34 52 38 44")
    pair = blend(ROUND + curls, TALL)
    assert len(strokes_at(pair, 0.1)) == 3
    assert not strokes_at(pair, 0.5)


def test_straight_lines_that_are_drawn_back_are_no_dots_either():
    pair = blend(ROUND + LINES.format("M20 30H28M36 30H44"), TALL)
    assert len(strokes_at(pair, 0.1)) == 2
    assert not strokes_at(pair, 0.5)


@pytest.mark.parametrize("t", [0.1, 0.2, 0.3])
def test_an_outline_goes_with_its_fill(t):
    pair = blend(ROUND + FLAG + LINES.format("M30 12V2L44 7Z"), TALL)
    (line,) = strokes_at(pair, t)
    fills = [shape for shape in shapes_at(pair, t) if shape.style.fill == "#224488"]
    flag = Box.around(np.concatenate([path.segments.ravel() for shape in fills for path in shape.paths]))
    assert line.centre == pytest.approx(flag.centre, abs=0.2)
    assert line.width == pytest.approx(flag.width, abs=0.2)
