"""Broken path data and points: refused, or drawn up to the error as browsers do."""

from __future__ import annotations

import re

import pytest

from shapeblend_cli.errors import InputError
from shapeblend_cli.svg.reading import path_data
from shapeblend_cli.svg.reading.read import read
from tests.svg.reading.drawings import boxes, length, svg

# Length and box as Chromium 156 has them.
CHROMIUM = {
    "M0 0h5v5L1": (10, [0, 0, 5, 5]),
    "M0 0L10 0 10 10 foo": (20, [0, 0, 10, 10]),
    "M0 0L10 0 X 5 5 L 20 20": (10, [0, 0, 10, 0]),
    "M0 0L10 0 20": (10, [0, 0, 10, 0]),
    "M0 0h5z5": (10, [0, 0, 5, 0]),
    "M0 0h5v5z junk": (17.0711, [0, 0, 5, 5]),
    "M0 0h5 nan": (5, [0, 0, 5, 0]),
    "M0 0C1 2 3 4 5 6 7 8": (7.8421, [0, 0, 5, 6]),
    "M0 0A5 5 0 0 1 10 0 5 5 0 2 1 20 0": (15.708, [0, -5, 10, 0]),
    "M0 0 10 0 5": (10, [0, 0, 10, 0]),
    "M0 0h5M3 3 6 3 9": (8, [0, 0, 6, 3]),
    "M0 0L1 1,,2 2": (1.4142, [0, 0, 1, 1]),
    "M0 0h5;v5": (5, [0, 0, 5, 0]),
    "m0 0h5 1e999 6": (5, [0, 0, 5, 0]),
    "M0 0h5 v 5 6 #": (16, [0, 0, 5, 11]),
    "M0 0h5 1.5.x": (6.5, [0, 0, 6.5, 0]),
}


def leniently(markup):
    return read("test.svg", svg(markup), lenient=True)


@pytest.mark.parametrize(("data", "total", "box"), [(d, *rest) for d, rest in CHROMIUM.items()], ids=CHROMIUM)
def test_broken_data_is_drawn_as_far_as_chromium_draws_it(data, total, box):
    drawing = leniently(f'<path d="{data}"/>')
    assert length(drawing) == pytest.approx(total, rel=1e-3)
    (found,) = boxes(drawing)
    assert found == pytest.approx(box, abs=1e-3)
    (note,) = drawing.notes
    assert re.fullmatch(
        r"path on line 1: at character \d+ of its path data: found .*; what stands before it is drawn", note
    )


@pytest.mark.parametrize("data", CHROMIUM)
def test_the_same_data_is_refused_otherwise(data):
    with pytest.raises(InputError, match=r"; --lenient draws what stands before it$"):
        read("test.svg", svg(f'<path d="{data}"/>'))


@pytest.mark.parametrize("data", ["L1 1", "M5", "M0 0", "M0 0H", "M0 0L,1 1", "x"])
def test_data_with_nothing_before_the_error(data):
    broken = f'<path id="p" d="{data}#"/>'
    with pytest.raises(InputError, match=r"path 'p' on line 1: .*; --lenient leaves it out$"):
        read("test.svg", svg(broken))
    drawing = leniently(broken + '<rect width="1" height="2"/>')
    assert boxes(drawing) == [[0, 0, 1, 2]]
    assert drawing.notes[0].endswith("; nothing stands before it")


@pytest.mark.parametrize(
    ("points", "box"),
    [("0 0 5 0 5 6 x 9 9", [0, 0, 5, 6]), ("0 0 5 0 5 6 9 x", [0, 0, 5, 6]), ("0 0 5 6,,9 9", [0, 0, 5, 6])],
)
def test_points_are_drawn_up_to_the_error(points, box):
    broken = f'<polyline points="{points}"/>'
    assert boxes(leniently(broken)) == [box]
    with pytest.raises(InputError, match=r"of its points: found .*; --lenient draws what stands before it$"):
        read("test.svg", svg(broken))


def test_sound_files_are_read_alike():
    sound = svg('<path d="M0 0h5v5z"/><polygon points="0 0 5 5 5 0"/>')
    assert boxes(read("a.svg", sound, lenient=True)) == boxes(read("a.svg", sound))
    assert read("a.svg", sound, lenient=True).notes == ()


def test_a_used_element_is_noted_once():
    drawing = leniently('<defs><path id="p" d="M0 0h5v5x"/></defs><use href="#p"/><use href="#p"/>')
    assert len(drawing.shapes) == 2
    assert len(drawing.notes) == 1
    assert "times" not in drawing.notes[0]


def test_limits_hold_all_the_same(monkeypatch):
    monkeypatch.setattr(path_data, "MAX_SEGMENTS", 10)
    with pytest.raises(InputError, match="more than 10 segments") as caught:
        leniently(f'<path d="M0 0{"h1v1 " * 10}"/>')
    assert "--lenient" not in str(caught.value)
