"""Strokes that become fills, and fills that become strokes."""

import numpy as np
import pytest

from shapeblend_cli.frames.frames import frame_at, shapes_at
from shapeblend_cli.svg.writing.document import frame_svg
from tests.pens.test_line_blends import blend
from tests.support.drawings import drawing
from tests.support.pictures import difference, pixels

SOLID = '<path d="M12 2L22 20H2Z"/>'
STROKES = {
    "ring": ("M12 5L19 18H5Z", 'stroke-linejoin="round"'),
    "sharp ring": ("M12 6L18 18H6Z", 'stroke-miterlimit="10"'),
    "curve": ("M4 18C4 4 20 4 20 18", 'stroke-linecap="round"'),
    "angle": ("M4 12L9 18L20 6", 'stroke-linecap="square" stroke-linejoin="bevel"'),
    "circle": ("M12 4A8 8 0 1 0 12 20A8 8 0 1 0 12 4Z", ""),
}


def stroke(name):
    path, more = STROKES[name]
    return f'<path d="{path}" fill="none" stroke="#000" stroke-width="2.5" {more}/>'


def picture(pair, t, *, as_drawn=False):
    return pixels(frame_svg(frame_at(pair, t, as_drawn=as_drawn), 3))


@pytest.mark.parametrize("name", STROKES)
@pytest.mark.parametrize("backwards", [False, True])
def test_a_stroke_and_a_fill_meet_without_grey(name, backwards):
    pair = blend(*[drawing(stroke(name)), drawing(SOLID)][:: -1 if backwards else 1], swap="never")
    end = 1.0 if backwards else 0.0
    for t in (0.25, 0.5, 0.75):
        assert all(p.style.fill and p.style.fill_opacity == 1.0 for p in shapes_at(pair, t))
    assert difference(picture(pair, end, as_drawn=True), picture(pair, abs(end - 1e-4))) < 0.01


def test_the_hole_of_a_ring_is_a_hole_all_the_way():
    for drawings in ((stroke("ring"), SOLID), (SOLID, stroke("ring"))):
        pair = blend(*map(drawing, drawings))
        middle = picture(pair, 0.5)[90:113, 82:98]
        assert middle.max() > 200


def test_strokes_stay_strokes_where_that_is_asked_for_or_the_other_drawing_has_some():
    kept = blend(drawing(stroke("ring")), drawing(SOLID), strokes="keep")
    assert any(shape.style_a.stroke for shape in kept.shapes)
    both = blend(drawing(stroke("ring")), drawing(SOLID, stroke("curve")))
    assert any(shape.style_a.stroke for shape in both.shapes)
    crossing = '<path d="M2 2L20 20H2L20 2" fill="none" stroke="#000" stroke-dasharray="3 2"/>'
    dashed = blend(drawing(crossing), drawing(SOLID))
    assert any(shape.style_a.stroke_dasharray for shape in dashed.shapes)
    assert all(np.isfinite(path.segments).all() for p in shapes_at(dashed, 0.5) for path in p.paths)


def test_beside_fills_closed_strokes_become_outlines_and_open_ones_stay():
    half = '<path d="M12 2V20H2Z"/>'
    pair = blend(drawing(SOLID), drawing(half, stroke("ring"), stroke("curve")))
    assert [shape.style_b.stroke for shape in pair.shapes].count("#000000") == 1


def test_a_stroke_along_the_edge_of_a_fill_follows_it():
    box = "M2 2H18V10H2Z"
    edged = drawing(f'<path d="{box}" fill="#fc0"/>', f'<path d="{box}" fill="none" stroke="#f00"/>')
    pair = blend(drawing("M2 2H10V10H2Z"), edged)
    assert any(contour.follows_edge for contour in pair.contours)


LINE = '<path d="{}" fill="none" stroke="#000" stroke-width="2"/>'
SPEAKER = '<path d="M4 4H20V14H4Z"/>', LINE.format("M3 18.5H21")
CROSSED_OUT = (
    '<path d="M6.5 4H20V14H16.5ZM4 6.5V14H11.5Z"/>',
    LINE.format("M3 18.5H16"),
    '<path d="M2 2L22 22" fill="none" stroke="#000" stroke-width="1.6"/>',
)


@pytest.mark.parametrize("backwards", [False, True])
def test_a_stroke_that_crosses_out_fills_and_strokes_opens_its_gap_as_it_is_drawn(backwards):
    drawings = [drawing(*SPEAKER), drawing(*CROSSED_OUT)]
    pair = blend(*drawings[:: -1 if backwards else 1])
    assert {shape.motion_name for shape in pair.shapes} == {"sweep"}
    plain, crossed, half_way = (
        picture(pair, abs(t - backwards), as_drawn=t != 0.5)[..., 0] for t in (0.0, 1.0, 0.5)
    )
    rows, columns = np.indices(half_way.shape)
    along = (rows + columns) / sum(half_way.shape)
    for part, whole in ((along < 0.4, crossed), (along > 0.6, plain)):
        assert np.abs(half_way - whole)[part].mean() < 0.02 * 255.0
