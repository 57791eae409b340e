"""Outlines instead of lines, where nearly all of two drawings are lines but these would be torn apart."""

import pytest

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
PIN = (
    "M16 18a5 5 0 1 1 5-5a5.006 5.006 0 0 1-5 5m0-8a3 3 0 1 0 3 3a3.003 3.003 0 0 0-3-3",
    "m16 30l-8.436-9.949a35 35 0 0 1-.348-.451A10.9 10.9 0 0 1 5 13a11 11 0 0 1 22 0a10.9 10.9 0 0 1-2.215 "
    "6.597l-.001.003s-.3.394-.345.447ZM8.813 18.395s.233.308.286.374L16 26.908l6.91-8.15c.044-.055.278-.365.279"
    "-.366A8.9 8.9 0 0 0 25 13a9 9 0 1 0-18 0a8.9 8.9 0 0 0 1.813 5.395",
)
MAP = (
    "m16 24l-6.09-8.6A8.14 8.14 0 0 1 16 2a8.08 8.08 0 0 1 8 8.13a8.2 8.2 0 0 1-1.8 5.13Zm0-20a6.07 6.07 0 0 0-6 "
    "6.13a6.2 6.2 0 0 0 1.49 4L16 20.52L20.63 14A6.24 6.24 0 0 0 22 10.13A6.07 6.07 0 0 0 16 4",
    "M14 9a2 2 0 1 0 4 0a2 2 0 1 0-4 0Z",
    "M28 12h-2v2h2v14H4V14h2v-2H4a2 2 0 0 0-2 2v14a2 2 0 0 0 2 2h24a2 2 0 0 0 2-2V14a2 2 0 0 0-2-2",
)


def pair_of(tmp_path, a, b, size, **settings):
    files = tmp_path / "a.svg", tmp_path / "b.svg"
    for file, paths in zip(files, (a, b), strict=True):
        file.write_text(svg(*paths, viewbox=f"0 0 {size} {size}"))
    (pair,) = sb.blend(*files, **settings).pairs
    return pair


def has_lines(pair):
    return any(contour.lines != (None, None) for shape in pair.shapes for contour in shape.contours)


@pytest.mark.parametrize(("a", "b", "size"), [((BATTERY,), (CHARGING,), 24), (PIN, MAP, 32)])
def test_a_part_stays_what_it_is_where_lines_would_make_something_else_of_it(tmp_path, a, b, size):
    assert not has_lines(pair_of(tmp_path, a, b, size))


@pytest.mark.parametrize("asked", [{"strokes": "recover"}, {"motion": "linear"}])
def test_lines_are_kept_as_asked(asked, tmp_path):
    assert has_lines(pair_of(tmp_path, PIN, MAP, 32, **asked))
