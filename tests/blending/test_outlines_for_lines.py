"""Outlines instead of lines, where these would become something else."""

import shapeblend_cli as sb
from tests.support.drawings import svg

BATTERY = (
    "M16 20H8V6h8m.67-2H15V2H9v2H7.33A1.33 1.33 0 0 0 6 5.33v15.34C6 21.4 6.6 22 7.33 22h9.34A1.33 1.33 0 0 0 18 "
    "20.67V5.33C18 4.6 17.4 4 16.67 4"
)
CHARGING = (
    "M23.05 11h-3V4l-5 10h3v8M12 20H4l.05-14h8m.67-2h-1.67V2h-6v2H3.38a1.33 1.33 0 0 0-1.33 1.33v15.34c0 .73.6 1.33 "
    "1.33 1.33h9.34c.73 0 1.33-.6 1.33-1.33V5.33A1.33 1.33 0 0 0 12.72 4"
)


def pair_of(tmp_path, a, b):
    files = tmp_path / "a.svg", tmp_path / "b.svg"
    for file, path in zip(files, (a, b), strict=True):
        file.write_text(svg(path))
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
