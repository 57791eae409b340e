"""Outlines instead of lines, where these would become something else."""

import pytest

import shapeblend_cli as sb
from shapeblend_cli.blending.swaps.swapped import is_swapped
from tests.support.drawings import svg

BATTERY = (
    "M16 20H8V6h8m.67-2H15V2H9v2H7.33A1.33 1.33 0 0 0 6 5.33v15.34C6 21.4 6.6 22 7.33 22h9.34A1.33 1.33 0 0 0 18 "
    "20.67V5.33C18 4.6 17.4 4 16.67 4"
)
CHARGING = (
    "M23.05 11h-3V4l-5 10h3v8M12 20H4l.05-14h8m.67-2h-1.67V2h-6v2H3.38a1.33 1.33 0 0 0-1.33 1.33v15.34c0 .73.6 1.33 "
    "1.33 1.33h9.34c.73 0 1.33-.6 1.33-1.33V5.33A1.33 1.33 0 0 0 12.72 4"
)


# A magnifier, and a smaller one whose ring is too uneven for a pen line, with a plus in it.
SEARCH = "M15 2a13 13 0 1 0 .01 0zM15 4a11 11 0 1 1-.01 0zM27.4 25.9l7 7-1.5 1.5-7-7z"
ZOOM_IN = (
    "M15 3a12 12 0 1 0 .01 0zM15.1 5.15a9.95 9.95 0 1 1-.01 0zM25.4 23.9l6 6-1.5 1.5-6-6z"
    "M20 14h-4v-4h-2v4h-4v2h4v4h2v-4h4z"
)
# A round lock and a padlock, in strokes.
ROUND_LOCK = "M12 3a9 9 0 1 0 .01 0zM12 10a2 2 0 1 0 .01 0zM12 14v3"
PADLOCK = "M6 10h12a2 2 0 0 1 2 2v7a2 2 0 0 1-2 2h-12a2 2 0 0 1-2-2v-7a2 2 0 0 1 2-2zM8 10v-3a4 4 0 0 1 7-2.5"
STROKE = 'fill="none" stroke="#000" stroke-width="2" stroke-linecap="round"'


def pair_of(tmp_path, a, b, **options):
    files = tmp_path / "a.svg", tmp_path / "b.svg"
    for file, path in zip(files, (a, b), strict=True):
        file.write_text(svg(path, **options))
    (pair,) = sb.blend(*files).pairs
    return pair


def test_a_part_stays_what_it_is_where_lines_would_make_something_else_of_it(tmp_path):
    pair = pair_of(tmp_path, BATTERY, CHARGING)
    lines = [contour.lines for shape in pair.shapes for contour in shape.contours]
    assert set(lines) == {(None, None)}
    (body,) = [
        contour for shape in pair.shapes for contour in shape.contours if contour.a == contour.b - 1 == 0
    ]
    assert body.is_matched


@pytest.mark.parametrize(
    ("a", "b", "options"),
    [(SEARCH, ZOOM_IN, {"viewbox": "0 0 36 36"}), (ROUND_LOCK, PADLOCK, {"attributes": STROKE})],
)
def test_outlines_go_on_where_lines_would_be_swapped(tmp_path, a, b, options):
    pair = pair_of(tmp_path, a, b, **options)
    assert not is_swapped(pair.shapes)
    contours = [contour for shape in pair.shapes for contour in shape.contours]
    assert (0, 0) in {(contour.a, contour.b) for contour in contours}
    assert {contour.lines for contour in contours} == {(None, None)}
