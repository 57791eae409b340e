"""Parameter types of the command line: from what is typed to values, or a line that says what would do."""

from __future__ import annotations

import math
from typing import Any

import click

from shapeblend_cli import easing
from shapeblend_cli.outputs.formats import PAGES


class StartType(click.ParamType[Any]):
    """``auto``, or two vertex numbers ``I,J``."""

    name = "auto|I,J"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Turn ``auto`` into None and ``I,J`` into two numbers."""
        if value == "auto" or isinstance(value, tuple):
            return None if value == "auto" else value
        try:
            i, j = (int(part) for part in value.split(","))
        except ValueError:
            self.fail(f"{value!r} is neither 'auto' nor two vertex numbers such as 0,3.", param, ctx)
        if i < 0 or j < 0:
            self.fail(f"{value!r}: vertex numbers begin at 0.", param, ctx)
        return i, j


class BandType(click.ParamType[Any]):
    """A diagonal deviation from 0 to 1, or ``none``."""

    name = "DD|none"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Read a share; ``none`` stays as it is."""
        if value == "none" or isinstance(value, float):
            return value
        band = _number(self, value, param, ctx)
        if not 0.0 <= band <= 1.0:
            self.fail(f"{value}: a band lies between 0 and 1, or is 'none'.", param, ctx)
        return band


class PinType(click.ParamType[Any]):
    """``I,J``: two vertex numbers; or ``x,y:x,y``: a point of A and a point of B."""

    name = "I,J|x,y:x,y"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Turn numbers into a pair of int, points into a pair of complex."""
        if isinstance(value, tuple):
            return value
        if ":" in value:
            sides = [side.split(",") for side in value.split(":")]
            if [len(side) for side in sides] != [2, 2]:
                self.fail(f"{value!r} is not two points such as 1.5,2:3,4.", param, ctx)
            return tuple(complex(*(_number(self, v, param, ctx) for v in side)) for side in sides)
        return START.convert(value, param, ctx)


class PageType(click.ParamType[str]):
    """The name of an HTML file."""

    name = "FILE.html"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Refuse what no browser would take for a page."""
        if not value.lower().endswith(PAGES):
            self.fail(f"{value!r} is no file name of a page; one that ends in .html would work.", param, ctx)
        return str(value)


class EaseType(click.ParamType[Any]):
    """A CSS name of an easing, or ``cubic-bezier(x1,y1,x2,y2)``."""

    name = "NAME"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Turn it into its four numbers."""
        if isinstance(value, easing.Ease):
            return value
        try:
            return easing.parse(value)
        except ValueError as error:
            self.fail(f"{error}.", param, ctx)


MOST_RUNS = 1_000_000
"""Runs of an animation that can be asked for; more is forever."""


class RepeatType(click.ParamType[Any]):
    """How often an animation runs: a number, ``forever``, or ``pingpong``."""

    name = "N|forever|pingpong"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Read a number; the words stay as they are."""
        if isinstance(value, int) or value in ("forever", "pingpong"):
            return value
        if not value.isdecimal() or not 1 <= int(value) <= MOST_RUNS:
            self.fail(
                f"{value!r} is neither 'forever' nor 'pingpong' nor a number from 1 to {MOST_RUNS}.",
                param,
                ctx,
            )
        return int(value)


class ColourType(click.ParamType[str]):
    """An opaque CSS colour, or ``transparent``."""

    name = "COLOUR"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Turn a colour into ``#rrggbb``."""
        from shapeblend_cli.svg.reading.colours import parse_colour

        colour = parse_colour(value.strip())
        if colour is not None and colour.alpha == 0.0:
            return "transparent"
        if colour is None or colour.alpha < 1.0:
            self.fail(
                f"{value!r} is neither 'transparent' nor an opaque CSS colour such as white or #f4f4f0.",
                param,
                ctx,
            )
        return colour.rgb


class MatchType(click.ParamType[Any]):
    """``A=B``: a contour number or an id of each drawing."""

    name = "A=B"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Turn it into the two names."""
        if isinstance(value, tuple):
            return value
        a, equals, b = value.partition("=")
        if not (a.strip() and equals and b.strip()):
            self.fail(f"{value!r} is not of the form A=B, such as 0=1 or left=right.", param, ctx)
        return a.strip(), b.strip()


class StiffType(click.ParamType[Any]):
    """``x,y,r=W``: around a point of A, within a radius, the wire is W times as stiff."""

    name = "x,y,r=W"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Turn it into the point, the radius and the weight."""
        if isinstance(value, tuple):
            return value
        region, equals, weight = value.partition("=")
        parts = region.split(",")
        if not equals or len(parts) != 3:
            self.fail(f"{value!r} is not of the form x,y,r=W, such as 10,20,5=3.", param, ctx)
        x, y, radius, factor = (_number(self, v, param, ctx) for v in (*parts, weight))
        if radius <= 0.0 or factor <= 0.0:
            self.fail(f"{value!r}: the radius and the weight must be greater than 0.", param, ctx)
        return complex(x, y), radius, factor


def _number(
    kind: click.ParamType[Any], text: str, param: click.Parameter | None, ctx: click.Context | None
) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        kind.fail(f"{text!r} is not a number.", param, ctx)
    return number


START = StartType()


class SelectorType(click.ParamType[str]):
    """``#id``, or a CSS selector; whether an id is there only the file can tell."""

    name = "SEL"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Look whether it can be one."""
        from shapeblend_cli.svg.reading.selection import SelectorError, check_selector

        try:
            check_selector(value)
        except SelectorError as error:
            self.fail(str(error), param, ctx)
        return str(value)


SELECTOR = SelectorType()


class ConstantType(click.ParamType[float]):
    """A finite number, not negative; above zero where zero means nothing, and at most one for c_s."""

    name = "X"

    def __init__(self, positive: bool, largest: float) -> None:
        self.positive = positive
        self.largest = largest

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Read a number and hold it against its range."""
        number = _number(self, value, param, ctx)
        least = "greater than 0" if self.positive else "0 or more"
        if number < 0.0 or (self.positive and number == 0.0):
            self.fail(f"{value} must be {least}.", param, ctx)
        if number > self.largest:
            self.fail(f"{value} must be at most {self.largest:g}.", param, ctx)
        return number
