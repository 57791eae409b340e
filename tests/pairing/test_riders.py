import numpy as np
import pytest

from shapeblend_cli.frames.frames import shapes_at
from shapeblend_cli.motion.choose import FOLLOWS
from shapeblend_cli.options.settings import Settings
from shapeblend_cli.pipeline import match_all
from tests.support.contours import furthest, polyline
from tests.support.drawings import drawing

pytestmark = pytest.mark.usefixtures("blended_once")

FILL, STROKE = '<path d="{}" fill="#fc0"/>', '<path d="{}" fill="none" stroke="#000" stroke-width="{}"/>'
LEAF, DROP = "M4 20C4 8 8 4 20 4C20 16 16 20 4 20Z", "M14 22C6 22 5 15 8 10L14 2L20 10C23 15 22 22 14 22Z"
# The upper and the lower half of the leaf, in other directions, and its middle.
UPPER, LOWER, MIDDLE = "M20 4C8 4 4 8 4 20", "M20 4C20 16 16 20 4 20", "M5 19L15 9"


def between(a, b, t=0.5, **settings):
    """What is painted at a time."""
    (pair,), _ = match_all([drawing(*a, file="a.svg"), drawing(*b, file="b.svg")], Settings(**settings))
    return shapes_at(pair, t)


def sides(shapes):
    """The outlines of fills, closed, and the strokes with their widths, as polylines."""
    fills = [polyline(path, 16) for shape in shapes for path in shape.paths if shape.style.fill]
    strokes = [
        (np.append(polyline(path, 16), path.segments[-1, 3]), shape.style.stroke_width)
        for shape in shapes
        for path in shape.paths
        if shape.style.stroke and shape.style.stroke_width
    ]
    return [np.append(fill, fill[0]) for fill in fills], strokes


@pytest.mark.parametrize("t", [0.02, 0.3, 0.5, 0.7, 0.98])
@pytest.mark.parametrize(
    "strokes", [([LEAF + "Z"], [DROP]), ([UPPER, LOWER], [DROP]), ([UPPER], [DROP]), ([UPPER, LOWER], [])]
)
def test_strokes_stay_on_the_edge(strokes, t):
    a, b = (
        [FILL.format(fill), *(STROKE.format(d, 1) for d in lines)]
        for fill, lines in zip((LEAF, DROP), strokes, strict=True)
    )
    fills, found = sides(between(a, b, t))
    assert found
    for line, _ in found:
        assert furthest(line, *fills) < 0.15


def test_strokes_that_go_to_strokes_keep_their_width():
    a = [FILL.format(LEAF), STROKE.format(UPPER, 1), STROKE.format(LOWER, 1)]
    b = [FILL.format(DROP), STROKE.format(DROP, 2)]
    for t in (0.25, 0.75):
        _, strokes = sides(between(a, b, t))
        assert [width for _, width in strokes] == pytest.approx([1 + t] * len(strokes))


def test_a_stroke_keeps_its_width_where_it_goes_to_strokes_and_loses_it_elsewhere():
    a = [FILL.format(LEAF), STROKE.format(LEAF, 1)]
    b = [FILL.format(DROP), STROKE.format("M14 22C6 22 5 15 8 10L14 2", 1)]  # the left half
    fills, strokes = sides(between(a, b, 0.75))
    lengths = {0.25: 0.0, 1.0: 0.0}
    for line, width in strokes:
        assert furthest(line, *fills) < 0.15
        lengths[round(width, 6)] += np.abs(np.diff(line)).sum()
    # What comes of A's stroke, and B's own half.
    assert lengths[1.0] / (lengths[0.25] + lengths[1.0]) == pytest.approx(2 / 3, abs=0.1)


def test_of_strokes_on_strokes_those_of_the_drawing_at_hand_are_seen_at_an_end():
    a, b = ([FILL.format(d), STROKE.format(d, 1)] for d in (LEAF, DROP))
    seen = [
        [shape.style.stroke_opacity for shape in between(a, b, t) if shape.style.stroke]
        for t in (0.0, 0.05, 0.1, 0.5, 0.9, 0.95, 1.0)
    ]
    of_a = [1, 1, 1, 1, 1, 0.5, 0]
    expected = [sorted(both) for both in zip(of_a, of_a[::-1], strict=True)]
    np.testing.assert_allclose([sorted(opacities) for opacities in seen], expected, atol=1e-9)


def test_strokes_that_go_to_nothing_lose_their_width():
    _, strokes = sides(between([FILL.format(LEAF), STROKE.format(UPPER, 1)], [FILL.format(DROP)], 0.75))
    assert [width for _, width in strokes] == pytest.approx([0.25])


def test_lines_that_are_not_on_an_edge_become_each_other():
    a, b = (
        [FILL.format(fill), STROKE.format(line, 1)] for fill, line in ((LEAF, MIDDLE), (DROP, "M14 6V20"))
    )
    _, strokes = sides(between(a, b))
    ((line, width),) = strokes
    assert width == pytest.approx(1.0)
    assert line[[0, -1]].mean() == pytest.approx(12 + 13.5j, abs=0.5)


def test_what_users_match_is_matched():
    a, b = [FILL.format(LEAF), STROKE.format(UPPER, 1)], [FILL.format(DROP), STROKE.format("M14 6V20", 1)]
    (pair,), _ = match_all([drawing(*a), drawing(*b)], Settings(match=(("1", "1"),)))
    assert (1, 1) in [(contour.a, contour.b) for contour in pair.contours]


def test_a_stroke_becomes_the_stroke_that_is_painted_last_where_it_goes():
    a = [FILL.format(LEAF), STROKE.format(LEAF, 1)]
    filled = FILL.format(DROP).replace("/>", ' stroke="#fc0" stroke-width="1"/>')
    shapes = between(a, [filled, STROKE.format(DROP, 1)])
    assert {shape.style.stroke for shape in shapes if shape.style.fill is None} == {"#000000"}


@pytest.mark.parametrize(("tail", "follows"), [("L31 4", True), ("L60 4", False)])
def test_a_stroke_that_leaves_the_edge_follows_it_if_most_of_it_lies_there(tail, follows):
    a = drawing(FILL.format(LEAF), STROKE.format(f"M4 20C4 8 8 4 20 4{tail}", 1))
    b = drawing(FILL.format(DROP), STROKE.format(DROP, 1))
    (pair,), _ = match_all([a, b], Settings())
    reasons = [shape.reason for shape in pair.shapes if shape.sources[0] == 1]
    assert reasons
    assert all((reason == FOLLOWS) == follows for reason in reasons)
