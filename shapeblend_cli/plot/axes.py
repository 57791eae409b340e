"""Colours, headings, and axes with their ticks, for all plots."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.svg.reading.read import title_of
from shapeblend_cli.svg.writing.figure import Figure, Point, line_data

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import ComplexArray

INK, SOFT, FAINT, GROUND = "#1d2733", "#5c6875", "#d5dae0", "#ffffff"
COLOUR_A, COLOUR_B, PATH = "#2b6cb0", "#c05621", "#c81e4a"

_STYLE = f"""
text{{font:13px system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue","DejaVu Sans",Arial,sans-serif;fill:{INK}}}
svg{{fill:none;stroke-linejoin:round;stroke-linecap:round}}
.ground{{fill:{GROUND}}}
.title{{font-size:17px;font-weight:600}}
.note,.tick-x,.tick-y,.right-note,.middle-note{{fill:{SOFT};font-size:12px}}
.tick-x,.label,.middle-note,.name{{text-anchor:middle}}
.tick-y,.right-note{{text-anchor:end}}
.name{{font-weight:600;paint-order:stroke;stroke:#fff;stroke-width:3}}
.frame,.tick{{stroke:{SOFT};stroke-width:1}}
.grid{{stroke:{FAINT};stroke-width:1}}
.rule{{stroke:{SOFT};stroke-width:1;stroke-dasharray:5 4}}
"""

LEFT = 72.0
"""Distance of the axes from the left side of the page, in pixels: room for ticks and a label."""

TOP = 96.0
"""Distance of the axes from the top of the page, in pixels: room for a heading of three lines."""

LINE = 18.0
"""Height of a line of text, in pixels."""

TICK = 5.0

WHOLE = tuple(float(f * 10**p) for p in range(6) for f in (1, 2, 5))
"""Steps between the vertex numbers of ticks."""

DIGITS = 4
"""Number of digits of a work."""

NOTHING = 1e-9
"""Tolerance of zero work, in the unit of work."""

LONGEST = 36
"""Maximum length of a file's name in a title, in characters."""

EXPONENTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Axes(NamedTuple):
    """A rectangle of a page, and the values `x` at its left and right, and `y` at its bottom and top."""

    figure: Figure
    left: float
    top: float
    width: float
    height: float
    x: tuple[float, float]
    y: tuple[float, float]

    def at(self, x: float, y: float) -> Point:
        """Return where values are on the page."""
        return (
            self.left + self.width * (x - self.x[0]) / (self.x[1] - self.x[0]),
            self.top + self.height * (self.y[1] - y) / (self.y[1] - self.y[0]),
        )

    def points(self, values: ComplexArray) -> list[Point]:
        """Return where values x + iy are on the page."""
        return [self.at(x, y) for x, y in page_points(values)]

    def across(self, y: float, kind: str) -> None:
        """Draw a line from left to right."""
        self.figure.line([self.at(self.x[0], y), self.at(self.x[1], y)], kind)

    def frame(self) -> None:
        """Draw the sides."""
        (x0, x1), (y0, y1) = self.x, self.y
        corners = (x0, y0), (x1, y0), (x1, y1), (x0, y1)
        self.figure.line([self.at(*corner) for corner in corners], "frame", closed=True)

    def grid(self, xs: Sequence[float], ys: Sequence[float]) -> None:
        """Draw lines at values, all in one path."""
        upright = [line_data([self.at(x, self.y[0]), self.at(x, self.y[1])]) for x in xs]
        level = [line_data([self.at(self.x[0], y), self.at(self.x[1], y)]) for y in ys]
        self.figure.path("".join(upright + level), "grid")

    def ticks_below(self, values: Sequence[float], names: Sequence[str], label: str) -> None:
        """Draw ticks under the lower side, with their names and a label."""
        bottom = self.top + self.height
        xs = [self.at(value, 0.0)[0] for value in values]
        marks = [line_data([(x, bottom), (x, bottom + TICK)]) for x in xs]
        self.figure.path("".join(marks), "tick")
        for x, name in zip(xs, names, strict=True):
            self.figure.words(name, (x, bottom + TICK + 13.0), "tick-x")
        self.figure.words(label, (self.left + self.width / 2.0, bottom + 40.0), "label")

    def ticks_beside(self, values: Sequence[float], names: Sequence[str], label: str) -> None:
        """Draw ticks along the left side, with their names and a label."""
        ys = [self.at(0.0, value)[1] for value in values]
        marks = [line_data([(self.left - TICK, y), (self.left, y)]) for y in ys]
        self.figure.path("".join(marks), "tick")
        for y, name in zip(ys, names, strict=True):
            self.figure.words(name, (self.left - TICK - 4.0, y + 4.0), "tick-y")
        self.figure.words(label, (self.left - 50.0, self.top + self.height / 2.0), "label", turn=-90.0)


def titled_figure(width: float, height: float, style: str, title: str, *notes: str) -> Figure:
    """Return a figure with a title and lines of small print at the top."""
    figure = Figure(width, height, _STYLE + style)
    figure.words(title, (24.0, 34.0), "title")
    for k, note in enumerate(notes):
        figure.words(note, (24.0, 56.0 + LINE * k), "note")
    return figure


def page_points(values: ComplexArray) -> list[Point]:
    """Return complex numbers as points."""
    return [(z.real, z.imag) for z in values.tolist()]


def short_name(file: str) -> str:
    """Return a file's name as titles have it."""
    name = title_of(file)
    return name if len(name) <= LONGEST else f"{name[: LONGEST - 1]}…"


def ticks(low: float, high: float, most: int = 6, steps: Sequence[float] = ()) -> list[float]:
    """Return up to `most` round values: multiples of one of `steps`, else of 1, 2 or 5 times a power of ten."""
    if not steps:
        power = 10.0 ** math.floor(math.log10((high - low) / most)) if high > low else 1.0
        steps = [power, 2.0 * power, 5.0 * power, 10.0 * power]
    step = next((s for s in steps if (high - low) / s <= most - 1), steps[-1])
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [k * step for k in range(first, last + 1)]


def value_text(value: float) -> str:
    """Return a number as people write it, without noise of rounding."""
    text = "0" if abs(value) < NOTHING else f"{value:.{DIGITS}g}"
    if "e" in text:
        mantissa, _, power = text.partition("e")
        return f"{mantissa}·10{str(int(power)).translate(EXPONENTS)}"
    return text.replace("-", "−")


def signed(value: float) -> str:
    """Return a number with its sign."""
    return f"+{value_text(value)}" if value > 0.0 else value_text(value)
