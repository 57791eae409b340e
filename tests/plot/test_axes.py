"""Ticks and numbers."""

import pytest

from shapeblend_cli.plot.axes import WHOLE, short_name, signed, ticks, value_text
from shapeblend_cli.svg.writing.figure import Figure, line_data


@pytest.mark.parametrize(
    ("low", "high", "most", "steps", "expected"),
    [
        (0.0, 1.0, 6, (), [0, 0.2, 0.4, 0.6, 0.8, 1.0]),
        (0.0, 199.0, 12, WHOLE, [0, 20, 40, 60, 80, 100, 120, 140, 160, 180]),
        (0.0, 2.0, 12, WHOLE, [0, 1, 2]),
        (80.0, 280.0, 8, (15, 30, 45), [90, 120, 150, 180, 210, 240, 270]),
    ],
)
def test_ticks_are_round_and_few(low, high, most, steps, expected):
    found = ticks(low, high, most, steps)
    assert found == pytest.approx(expected)
    assert len(found) <= most


@pytest.mark.parametrize(
    ("value", "text"),
    [(5.33343, "5.333"), (0.0, "0"), (-4e-13, "0"), (-2.5, "−2.5"), (3.2e-7, "3.2·10⁻⁷"), (1284.6, "1285")],
)
def test_numbers_are_short_and_more_work_has_a_sign(value, text):
    assert value_text(value) == text
    assert signed(value) == ("+" if value > 0 else "") + text


def test_names_of_files_are_short():
    assert short_name("some/folder/hen.svg") == "hen.svg"
    assert short_name("-") == "standard input"
    assert len(short_name("x" * 300)) < 40


def test_a_line_is_written_by_ways_that_do_not_add_up_errors():
    places = [(0.04 * k, 0.0) for k in range(1, 101)]
    steps = line_data(places).removeprefix("M0 0l").split(" ")
    assert sum(float(v) for v in steps[::2]) == pytest.approx(4.0)
    assert line_data([(1, 2), (1.5, 1), (3, 3)], closed=True) == "M1 2l.5-1 1.5 2z".replace("l.5", "l0.5")


def test_what_cannot_stand_in_a_document_is_replaced():
    figure = Figure(100.0, 50.4, "")
    figure.words("a\x07<b>", (1.0, 2.0), "note")
    assert 'width="100"' in figure.text()
    assert "a�&lt;b&gt;" in figure.text()
