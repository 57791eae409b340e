"""Several drawings at once: each state is its drawing."""

import numpy as np
import pytest

from shapeblend_cli.geometry.cubics import lines as segments_of
from shapeblend_cli.interpolate.stacks import NOWHERE, stacked
from shapeblend_cli.interpolate.stars import star_shapes
from shapeblend_cli.model import CubicPath, Frame, KeyframedShape, PaintedShape, Style
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.outputs.formats import views
from shapeblend_cli.pipeline import match_all
from shapeblend_cli.svg.reading.read import read
from shapeblend_cli.svg.writing.document import frame_svg
from tests.support.drawings import svg
from tests.support.pictures import difference, pixels

LINE = 'fill="none" stroke="#000" stroke-width="2" stroke-linecap="round" stroke-linejoin="round"'


def stroked(*paths):
    return svg(*paths, attributes=LINE)


def filled(d, colour="#000"):
    return f'<path fill="{colour}" d="{d}"/>'


HEART = "M12 21 3 12 4 5 9 4 12 7 15 4 20 5 21 12Z"
ROUND = "M12 3A9 9 0 1 0 12 21 9 9 0 1 0 12 3Z"
DRAWINGS = {
    "one shape becomes several": [
        stroked("m14 10l7-7m-1 7h-6V4M3 21l7-7m-6 0h6v6"),
        stroked(
            "M12 7v14m8-10v8a2 2 0 0 1-2 2H6a2 2 0 0 1-2-2v-8m3.5-4a1 1 0 0 1 0-5A4.8 8 0 0 1 12 7"
            "a4.8 8 0 0 1 4.5-5a1 1 0 0 1 0 5",
            "M4 7H20A1 1 0 0 1 21 8V10A1 1 0 0 1 20 11H4A1 1 0 0 1 3 10V8A1 1 0 0 1 4 7Z",
        ),
        stroked("M19 21v-2a4 4 0 0 0-4-4H9a4 4 0 0 0-4 4v2", "M16 7A4 4 0 1 1 8 7 4 4 0 1 1 16 7Z"),
    ],
    "open in one pair and closed in the next": [
        svg(filled(HEART)),
        stroked("M3 19 12 4 21 19"),
        svg(filled(ROUND)),
    ],
    "closed in one pair and open in others": [
        svg(filled("M4 4H20V20H4Z M8 8V10H10V8Z")),
        svg(filled(ROUND)),
        stroked("M3 19 12 4 21 19M12 11V15"),
        stroked("M20 20H4V5H14"),
    ],
    "pieces of a closed line overlap a little": [
        stroked(
            "M2.25 15a4.5 4.5 0 0 0 4.5 4.5H18a3.75 3.75 0 0 0 1.332-7.257a3 3 0 0 0-3.758-3.848"
            "a5.25 5.25 0 0 0-10.233 2.33A4.5 4.5 0 0 0 2.25 15"
        ),
        stroked(
            "M3 8.689c0-.864.933-1.406 1.683-.977l7.108 4.061a1.125 1.125 0 0 1 0 1.954l-7.108 4.061"
            "A1.125 1.125 0 0 1 3 16.811z",
            "M12.75 8.689c0-.864.933-1.406 1.683-.977l7.108 4.061a1.125 1.125 0 0 1 0 1.954l-7.108 4.061"
            "a1.125 1.125 0 0 1-1.683-.977z",
        ),
        stroked("M12 3A9 9 0 1 0 12 21 9 9 0 1 0 12 3Z"),
    ],
    "a line becomes a fill with a hole": [
        stroked("M12 3A9 9 0 0 1 12 21"),
        svg(filled("M3 5H21V20H3Z M6 8V17H18V8Z")),
    ],
    "a line becomes such a fill the other way round": [
        stroked("M12 21A9 9 0 0 0 12 3"),
        svg(filled("M3 5H21V20H3Z M6 8V17H18V8Z")),
    ],
    "the order of paint changes": [
        svg(filled("M2 2H16V16H2Z", "#f00"), filled("M8 8H22V22H8Z", "#00f")),
        svg(filled("M8 8H22V22H8Z", "#00f"), filled("M2 2H16V16H2Z", "#f00")),
    ],
    "groups are transparent": [
        svg(f'<g opacity=".5">{filled("M2 2H16L2 16Z", "#f00")}{filled("M16 2V16H2Z")}</g>'),
        svg(filled("M8 8H22V22H8Z", "#00f")),
    ],
    "one of three groups is transparent": [
        svg(filled("M8 8H22V22H8Z", "#00f")),
        svg(f'<g opacity=".5">{filled("M2 2H16L2 16Z", "#f00")}{filled("M16 2V16H2Z")}</g>'),
        svg(filled(ROUND)),
    ],
    "a square is cut open at a corner": [
        svg(*("M4 20H20", "M4 4H20L17 9"), attributes='fill="none" stroke="#000" stroke-width="2"'),
        svg("M5 5H19V19H5Z", attributes='fill="none" stroke="#000" stroke-width="3"'),
    ],
    "the line around a fill is cut": [
        svg(filled(HEART, "#fac"), f'<path {LINE} d="{HEART}"/>'),
        svg(filled(ROUND, "#fe0"), f'<path {LINE} d="M12 3A9 9 0 1 0 12 21"/>'),
    ],
}


@pytest.mark.parametrize("drawings", DRAWINGS.values(), ids=DRAWINGS)
def test_each_state_is_its_drawing(drawings):
    alone = np.eye(len(drawings)).tolist()
    settings = Settings(mix=[tuple(row) for row in alone], motion="linear", unmatched="point")
    pairs, _ = match_all([read("a.svg", each.encode()) for each in drawings], settings)
    shapes = star_shapes(pairs)
    for weights, expected in zip(alone, drawings, strict=True):
        # All paths, as states have them: a point with a stroke is a dot.
        painted = [shape.keys[weights.index(1.0)] for shape in shapes]
        shown = frame_svg(Frame(0.0, 0, tuple(painted), views(pairs)[0]), 3)
        assert difference(pixels(shown), pixels(expected)) < 2e-3


def test_each_drawing_is_painted_in_its_own_order():
    colours = ["#f00", "#0f0", "#00f", "#ff0"]
    square = CubicPath(segments_of(np.array([0, 9, 9 + 9j, 9j]), True), np.ones(4, np.bool_), True)
    keys = [PaintedShape((square,), Style(fill=colour)) for colour in colours]
    shapes = [KeyframedShape((key,) * 3, 0, ((),) * 2) for key in keys]
    places = np.array([[0, 2, 1], [1, 1, 0], [2, 0, NOWHERE], [3, 3, 3]])
    copies = stacked(shapes, places)
    assert len(copies) == 6
    for k, order in enumerate([(0, 1, 2, 3), (2, 1, 0, 3), (1, 0, 3)]):
        seen = [copy.keys[k].style.fill for copy in copies if copy.keys[k].style.fill_opacity]
        assert [colour for colour in seen if colours.index(colour) in order] == [colours[n] for n in order]
