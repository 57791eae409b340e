"""Broken path data and points: refused, or drawn up to the error as browsers do."""

import re

import pytest

from shapeblend_cli.svg.reading import path_commands
from tests.svg.reading.drawings import RECT, boxes, drawn, length, refused

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
    return drawn(markup, lenient=True)


@pytest.mark.parametrize(("data", "total", "box"), [(d, *rest) for d, rest in CHROMIUM.items()], ids=CHROMIUM)
def test_broken_data_is_drawn_as_far_as_chromium_draws_it_or_refused(data, total, box):
    broken = f'<path d="{data}"/>'
    drawing = leniently(broken)
    assert length(drawing) == pytest.approx(total, rel=1e-3)
    assert boxes(drawing) == [pytest.approx(box, abs=1e-3)]
    (note,) = drawing.notes
    place = r"path on line 1: at character \d+ of its path data"
    assert re.fullmatch(rf"{place}: found .*; what stands before it is drawn", note)
    refused(broken, r"; --lenient draws what stands before it$")


@pytest.mark.parametrize("data", ["L1 1", "M5", "M0 0", "M0 0H", "M0 0L,1 1", "x"])
def test_data_with_nothing_before_the_error(data):
    broken = f'<path id="p" d="{data}#"/>'
    refused(broken, r"path 'p' on line 1: .*; --lenient leaves it out$")
    drawing = leniently(broken + RECT)
    assert boxes(drawing) == [[0, 0, 1, 2]]
    assert drawing.notes[0].endswith("; nothing stands before it")


@pytest.mark.parametrize("points", ["0 0 5 0 5 6 x 9 9", "0 0 5 0 5 6 9 x", "0 0 5 6,,9 9"])
def test_points_are_drawn_up_to_the_error(points):
    broken = f'<polyline points="{points}"/>'
    assert boxes(leniently(broken)) == [[0, 0, 5, 6]]
    refused(broken, r"of its points: found .*; --lenient draws what stands before it$")


def test_sound_files_are_read_alike():
    sound = '<path d="M0 0h5v5z"/><polygon points="0 0 5 5 5 0"/>'
    assert boxes(leniently(sound)) == boxes(drawn(sound))
    assert leniently(sound).notes == ()


def test_a_used_element_is_noted_once():
    drawing = leniently('<defs><path id="p" d="M0 0h5v5x"/></defs><use href="#p"/><use href="#p"/>')
    assert len(drawing.shapes) == 2
    assert len(drawing.notes) == 1
    assert "times" not in drawing.notes[0]


def test_limits_hold_all_the_same(monkeypatch):
    monkeypatch.setattr(path_commands, "MAX_SEGMENTS", 10)
    message = refused(f'<path d="M0 0{"h1v1 " * 10}"/>', "more than 10 segments", lenient=True)
    assert "--lenient" not in message
