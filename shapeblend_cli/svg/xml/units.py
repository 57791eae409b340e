"""Numbers, lengths and percentages as SVG writes them.

All patterns here are atomic or possessive, and long runs of blanks are cut short before they are searched: no text
takes more than linear time.
"""

from __future__ import annotations

import math
import re
from typing import NamedTuple

from shapeblend_cli.model import Length
from shapeblend_cli.svg.xml.messages import printable

KEYWORDS = frozenset(("inherit", "initial", "unset", "revert", "revert-layer"))
"""Values of every property: https://www.w3.org/TR/css-cascade-4/#defaulting-keywords."""

NUMBER = r"(?>[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"

BLANKS = " \t\r\n\f"
BLANK = r"[ \t\r\n\f]"
GAP = rf"{BLANK}*+(?:,{BLANK}*+)?+"  # what may stand between two numbers
LIMIT = 1e9  # numbers of this size or more are refused: products of a few of them must stay finite
LEAST = 1e-12  # coordinates smaller than this are 0: so small a drawing has no digits left beside another one

PIXELS = {
    "": 1.0,
    "px": 1.0,
    "in": 96.0,
    "cm": 96.0 / 2.54,
    "mm": 96.0 / 25.4,
    "q": 96.0 / 101.6,
    "pt": 96.0 / 72.0,
    "pc": 16.0,
}
"""Lengths of absolute units, in CSS pixels: https://www.w3.org/TR/css-values-3/#absolute-lengths."""

Measure = tuple[float, bool]
"""A length in user units, except that ``(share, True)`` is a share of the viewport's diagonal."""

_FONT_UNITS = {"em": 1.0, "ex": 0.5, "ch": 0.5}
_ROOT_FONT_SIZE = 16.0
_MAX_LENGTH = 1000

_LENGTH = re.compile(rf"({NUMBER})\s*+(%|[a-zA-Z]*+)")
_RUN = re.compile(rf"{BLANK}{{2,}}")
_NUMBER = re.compile(NUMBER)
_NUMBERS = re.compile(rf"{BLANK}*+(?:{NUMBER}(?:{GAP}{NUMBER})*+)?+{BLANK}*+,?{BLANK}*+")
# A comma after the last number is against the grammar, and all browsers forgive it.
_END = re.compile(rf"{BLANK}*+,?{BLANK}*+")


class GrammarError(ValueError):
    """A fault at an offset from 0; in a list, `before` has the numbers in front of it."""

    def __init__(self, offset: int, message: str, before: list[float] | None = None) -> None:
        super().__init__(message)
        self.offset = offset
        self.before = before or []

    def message_in(self, text: str) -> str:
        """Return the message with its position in a text."""
        return f"at character {self.offset + 1} of its {text}: {self}"


class Lengths(NamedTuple):
    """The lengths for percentages and font units: the viewport's size in user units, and the font size."""

    width: float
    height: float
    font_size: float = _ROOT_FONT_SIZE

    @property
    def diagonal(self) -> float:
        """100 % of lengths that are neither horizontal nor vertical."""
        return math.sqrt((self.width * self.width + self.height * self.height) / 2)

    def x(self, text: str) -> float | None:
        """Return a horizontal length in user units."""
        return length(text, self.width, self.font_size)

    def y(self, text: str) -> float | None:
        """Return a vertical length in user units."""
        return length(text, self.height, self.font_size)

    def resolve(self, measure: Measure) -> float:
        """Return a measure in user units."""
        value, is_share = measure
        return value * self.diagonal if is_share else value


def length(text: str, whole: float | None = None, font_size: float = _ROOT_FONT_SIZE) -> float | None:
    """Return a length in user units, or None when `text` is no length.

    100 % is `whole`; without it a percentage is no length. 1em is `font_size`.
    """
    match = _LENGTH.fullmatch(text.strip()) if len(text) <= _MAX_LENGTH else None
    if match is None:
        return None
    unit = match[2].lower()
    if unit == "%":
        factor = None if whole is None else whole / 100.0
    elif unit in _FONT_UNITS:
        factor = font_size * _FONT_UNITS[unit]
    elif unit == "rem":
        factor = _ROOT_FONT_SIZE
    else:
        factor = PIXELS.get(unit)
    if factor is None:
        return None
    value = float(match[1]) * factor
    return value if abs(value) < LIMIT else None


def measured(text: str) -> Length | None:
    """Return a length as it is written, a number and a unit, or None if it has another unit than `PIXELS` and ``%``."""
    match = _LENGTH.fullmatch(text.strip()) if len(text) <= _MAX_LENGTH else None
    if match is None or not (match[2] == "%" or match[2].lower() in PIXELS):
        return None
    number = float(match[1])
    return Length(number, match[2]) if abs(number) < LIMIT else None


def one_blank(text: str) -> str:
    """Return `text` with every run of blanks replaced by one."""
    return _RUN.sub(" ", text) if _RUN.search(text) else text


def is_end(text: str, start: int) -> bool:
    """Return whether only blanks and one comma stand from `start` on."""
    return _END.fullmatch(text, start) is not None


def numbers(text: str, expected: str = "a number") -> list[float]:
    """Read numbers separated by blanks, single commas, or nothing where that is clear.

    Anything else, or a number beyond the limit, raises a GrammarError with the `expected` text.
    """
    if not _NUMBERS.fullmatch(text):
        raise _error(text, expected)
    values = list(map(float, _NUMBER.findall(text)))
    if values and not -LIMIT < min(values) <= max(values) < LIMIT:
        raise _error(text, expected)
    return values


def _error(text: str, expected: str) -> GrammarError:
    """Return the first error of a list of numbers that has one."""
    end = 0
    before: list[float] = []
    following = re.compile(GAP + NUMBER)
    while match := following.match(text, end):
        number = match[0].strip(BLANKS + ",")
        start = match.end() - len(number)
        if end == 0 and "," in match[0]:
            break
        if not abs(float(number)) < LIMIT:
            return GrammarError(start, f"found {printable(number, 20)}, which is beyond {LIMIT:g}", before)
        before.append(float(number))
        end = match.end()
    rest = text[end:].lstrip(BLANKS)
    message = f"found '{printable(rest[:12])}' where {expected} belongs"
    return GrammarError(len(text) - len(rest), message, before)
