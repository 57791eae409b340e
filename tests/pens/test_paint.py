"""The paint of lines: dashes, opacity where they cross, and gradients."""

import numpy as np
import pytest

from shapeblend_cli.frames.frames import frame_at, shapes_at
from shapeblend_cli.pens.moves import DRAWN_ON, STAYS
from shapeblend_cli.svg.writing.document import frame_svg
from tests.pens.test_line_blends import blend, reasons
from tests.support.drawings import drawing
from tests.support.pictures import difference, pixels

SLASH = '<path d="M12 3V9" fill="none" stroke="#000" stroke-width="2"/>'


def stroke(path, more=""):
    return f'<path d="{path}" fill="none" stroke="#000" stroke-width="2" {more}/>'


@pytest.mark.parametrize("dashes", ["3 2", "4 2 1 2", "3"])
@pytest.mark.parametrize("other", ["M21 12H3", "M3 12H21", "M12 12H21", "M3 12H12"])
def test_dashes_lie_as_in_both_files_and_rest_where_the_line_rests(dashes, other):
    more = f'stroke-dasharray="{dashes}" stroke-dashoffset="1"'
    pair = blend(drawing(stroke("M3 12H21", more)), drawing(stroke(other, more) + SLASH), strokes="recover")
    assert STAYS in reasons(pair)
    for end in (0.0, 1.0):
        drawn = pixels(frame_svg(frame_at(pair, end, as_drawn=True), 3))
        near = pixels(frame_svg(frame_at(pair, abs(end - 1e-4), as_drawn=False), 3))
        assert difference(drawn, near) < 2e-3


def test_dashes_of_a_line_that_is_drawn_on_from_its_beginning_do_not_slide():
    more = 'stroke-dasharray="3 2"'
    short, long = stroke("M12 12H21", more), stroke("M2 12H21", 'stroke-dasharray="3 2"')
    pair = blend(drawing(short), drawing(long + SLASH), strokes="recover")
    (line,) = [shape for shape in pair.shapes if shape.reason == STAYS]
    places = set()
    for t in (0.0, 0.3, 0.6, 1.0):
        (painted,) = [p for p, s in zip(shapes_at(pair, t), pair.shapes, strict=True) if s is line]
        start = painted.paths[0].segments[0, 0].real
        places.add(round((start - painted.style.stroke_dashoffset) % 5.0, 3) % 5.0)
    assert places == {2.0}


def test_transparent_lines_do_not_show_where_they_cross():
    more = 'stroke-opacity="0.5"'
    plus, cross = stroke("M4 12H20M12 4V20", more), stroke("M5 5L19 19M5 19L19 5M12 1V3", more)
    pair = blend(drawing(plus), drawing(cross), strokes="recover")
    for t in (0.0, 0.3, 0.5, 0.8, 1.0):
        picture = pixels(frame_svg(frame_at(pair, t, as_drawn=False), 3))
        assert picture.min() > 120


def test_gradients_go_along():
    gradient = (
        '<linearGradient id="g"><stop stop-color="red"/><stop offset="1" stop-color="blue"/></linearGradient>'
    )
    bars = "M2 3H22V5H2ZM2 11H22V13H2ZM2 19H22V21H2Z"
    filled = drawing(f'<defs>{gradient}</defs><path d="{bars}" fill="url(#g)"/>')
    pair = blend(filled, drawing(stroke("M5 5L19 19M5 19L19 5")), strokes="recover")
    assert all(shape.style_a.fill is None for shape in pair.shapes)
    assert any(shape.style_a.stroke_gradient for shape in pair.shapes)
    drawn, near = (pixels(frame_svg(frame_at(pair, t, as_drawn=t == 0.0), 3)) for t in (0.0, 1e-4))
    assert np.abs(drawn - near).mean() < 1.0


def test_a_line_that_comes_late_is_not_seen_before():
    from shapeblend_cli.outputs.move import moves_of

    pair = blend(drawing(stroke("M2 20H20")), drawing(stroke("M4 2V20M16 8V12")), strokes="recover")
    (move,) = moves_of([pair], trims=True)
    (new,) = [
        moved for moved, shape in zip(move.shapes, pair.shapes, strict=True) if shape.reason == DRAWN_ON
    ]
    hidden, *_ = new.fading
    assert 0.0 < hidden[0] < 1.0
    assert hidden[1].stroke_opacity == 0.0
