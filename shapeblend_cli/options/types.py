"""The types of fields, which read and check values.

Errors are phrased so that the name of a field or of an option goes before them: "must be 0 or more, not -3".
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from operator import index
from typing import Any, NamedTuple

from shapeblend_cli.errors import InputError
from shapeblend_cli.options import easing, timetable, triggers


class Unfit(ValueError):
    """An error with a text of its own, where `FieldType.expected` would not say it well."""


class FieldType(NamedTuple):
    """A type of fields.

    `canonical` returns a value in the one form it is kept in, or raises ValueError or TypeError.
    """

    expected: str  # what a value must be, for errors
    canonical: Callable[[Any], Any]
    metavar: str  # how help shows a value
    split: Callable[[str], Any] = str  # turns what is typed into a value for `canonical`
    choices: tuple[str, ...] = ()  # all values, if they are a few words
    is_file: bool = False  # whether a value names a file
    is_read: bool = False  # whether a text names a file with the value
    words: int = 1  # how many words on the command line make a value

    def check(self, value: Any) -> Any:
        """Return a value in its canonical form, or raise ValueError. A text may have the form of what is typed."""
        is_typed = isinstance(value, str) and self.split not in (str, int, float)
        return self._try(self._typed if is_typed else self.canonical, value, repr(value))

    def parse(self, text: str) -> Any:
        """Return the value that a typed text stands for, or raise ValueError.

        A word for None stays that word, as None would say that nothing was typed.
        """
        shown = text if self.split in (int, float) else repr(text)
        value = self._try(self._typed, text, shown)
        return text if value is None else value

    def _typed(self, text: str) -> Any:
        return self.canonical(self.split(text))

    def _try(self, read: Callable[[Any], Any], value: Any, shown: str) -> Any:
        try:
            return read(value)
        except InputError:
            raise
        except Unfit as error:
            raise ValueError(f"must be {error}") from None
        except (ValueError, TypeError, OverflowError):
            raise ValueError(f"must be {self.expected}, not {shown}") from None


def choice(*words: str, elsewhere: str = "") -> FieldType:
    """One of a few words; errors may say what would do what other words ask for."""
    expected = f"{', '.join(words[:-1])} or {words[-1]}{elsewhere}"
    return FieldType(expected, lambda value: words[words.index(value)], f"[{'|'.join(words)}]", choices=words)


def number(low: float, high: float = math.inf, *, above: bool = False) -> FieldType:
    """A finite number within limits; with `above`, greater than the lower one."""
    return FieldType("a number", lambda value: _within(_finite(value), low, high, above), "X", float)


def seconds(low: float, high: float) -> FieldType:
    """A time within limits, in seconds; typed also as ``0.3s`` or ``300ms``."""
    expected = "seconds, such as 0.3, 0.3s or 300ms"
    return FieldType(expected, lambda value: _within(_finite(value), low, high, False), "S", _split_seconds)


def _split_seconds(text: str) -> float:
    text = text.strip().lower()
    return float(text[:-2]) / 1000.0 if text.endswith("ms") else float(text.removesuffix("s"))


def _hold(value: Any) -> tuple[float, float]:
    rests = [_finite(one) for one in (value if isinstance(value, list | tuple) else [value])]
    if not 1 <= len(rests) <= 2:
        raise ValueError
    first, other = (float(_within(rest, 0.0, 3600.0)) for rest in (rests[0], rests[-1]))
    return first, other


def whole(low: int, high: float = math.inf) -> FieldType:
    """A whole number within limits."""
    return FieldType("a whole number", lambda value: _within(_integer(value), low, high), "N", int)


def file(*suffixes: str) -> FieldType:
    """The name of a file or folder; if there are suffixes, it ends in one of them."""

    def canonical(value: Any) -> str:
        if not str(value).lower().endswith(suffixes or "") or not str(value):
            raise ValueError
        return str(value)

    ending = f" ending in {' or '.join(suffixes)}" if suffixes else ""
    return FieldType(f"a file name{ending}", canonical, "FILE", is_file=True)


def text(expected: str, pattern: str, metavar: str) -> FieldType:
    """Text of a form."""

    def canonical(value: Any) -> str:
        if not isinstance(value, str) or re.fullmatch(pattern, value) is None:
            raise ValueError
        return value

    return FieldType(expected, canonical, metavar)


def _flag(value: Any) -> bool:
    if not isinstance(value, bool):
        raise TypeError
    return value


def _selector(value: Any) -> Any:
    from shapeblend_cli.svg.styles.selection import SelectorError, check_selector

    try:
        check_selector(value)
    except SelectorError as error:
        raise Unfit(f"#id or a CSS selector: {error}") from None
    return value


def _start(value: Any) -> tuple[int, int] | None:
    if value == "auto":
        return None
    i, j = map(_integer, value)
    if min(i, j) < 0:
        raise Unfit(f"two vertex numbers, and these begin at 0, not {i},{j}")
    return i, j


def _pin(value: Any) -> Any:
    a, b = value
    return _start(value) if hasattr(a, "__index__") else (_point(a), _point(b))


def _stiff(value: Any) -> tuple[complex, float, float]:
    point, radius, weight = value
    if not (_finite(radius) > 0.0 and _finite(weight) > 0.0):
        raise Unfit(f"a point with a radius and a weight greater than 0, not {radius:g} and {weight:g}")
    return _point(point), float(radius), float(weight)


def _split_stiff(text: str) -> Any:
    region, weight = text.split("=")
    x, y, radius = _floats(region)
    return (x, y), radius, float(weight)


def _match(value: Any) -> tuple[str, str] | tuple[complex, complex]:
    one, other = value
    if all(isinstance(side, complex | tuple | list) for side in (one, other)):
        return _point(one), _point(other)
    a, b = (str(side).strip() for side in value)
    if not (a and b):
        raise ValueError
    if re.fullmatch(r"[0-9.]+(?:[\s,;]+[0-9.]+=[0-9.]+)+", b):
        pairs = re.split(r"[\s,;]+", f"{a}={b}")
        raise Unfit(f"one pair each time, {' and then '.join(pairs)}, not '{a}={b}'")
    return a, b


def _band(value: Any) -> float | None:
    if value == "none":
        return None
    if not 0.0 <= _finite(value) <= 1.0:
        raise ValueError
    return float(value)


MOST_RUNS = 1_000_000  # runs of an animation that can be asked for; more is forever
RUNS = f"forever, pingpong, or a number from 1 to {MOST_RUNS}"


LIKE_RUNS = {
    "forever": "infinite infinity indefinite always endless loop true yes on -1 0".split(),
    "pingpong": "ping-pong alternate yoyo reverse boomerang bounce mirror".split(),
    "1": "once no none false off never".split(),
}
"""Words for runs of animations elsewhere, by those that mean the same here."""


def _repeat(value: Any) -> Any:
    if value in ("forever", "pingpong"):
        return value
    likely = [ours for ours, theirs in LIKE_RUNS.items() if str(value).lower() in theirs]
    if likely:
        raise Unfit(f"{RUNS}, not {value!r}; {likely[0]} would work")
    if not 1 <= _integer(value) <= MOST_RUNS:
        raise ValueError
    return index(value)


def _ease(value: Any) -> easing.Easing:
    if isinstance(value, easing.Easing):
        return value
    try:
        return easing.parse(str(value))
    except ValueError:
        if problem := easing.wrong(str(value)):
            raise Unfit(problem) from None
        raise


def _timing(value: Any) -> timetable.Timetable:
    try:
        return timetable.parse(value) if isinstance(value, str) else timetable.timetable(value)
    except InputError:
        raise
    except ValueError as error:
        raise Unfit(str(error)) from None


def _colour(value: Any) -> str:
    from shapeblend_cli.svg.styles.css_colours import parse_colour

    colour = parse_colour(str(value).strip())
    if colour is not None and colour.alpha == 0.0:
        return "transparent"
    if colour is None or colour.alpha < 1.0:
        raise ValueError
    return colour.rgb


def _finite(value: Any) -> float:
    if isinstance(value, str) or not math.isfinite(value):
        raise TypeError
    return float(value)


def _integer(value: Any) -> int:
    if isinstance(value, bool):
        raise TypeError
    return index(value)


def _within(number: Any, low: float, high: float, above: bool = False) -> Any:
    if number < low or (above and number == low):
        raise Unfit(f"{f'greater than {low:g}' if above else f'{low:g} or more'}, not {_shown(number)}")
    if number > high:
        raise Unfit(f"at most {_shown(high)}, not {_shown(number)}")
    return number


def _shown(number: float) -> str:
    return str(number) if isinstance(number, int) and abs(number) < 1e15 else f"{number:g}"


def _point(value: Any) -> complex:
    """A complex number, or two numbers."""
    x, y = (value.real, value.imag) if isinstance(value, complex) else value
    return complex(_finite(x), _finite(y))


def _integers(text: str) -> list[int]:
    return list(map(int, text.split(",")))


def _floats(text: str) -> list[float]:
    return list(map(float, text.split(",")))


def _folders(value: Any) -> tuple[str, str]:
    one, other = map(str, value)
    return one, other


def _shard(value: Any) -> tuple[int, int]:
    number, count = map(_integer, value)
    if not 1 <= number <= count:
        raise ValueError
    return number, count


def _mix(value: Any) -> tuple[float, ...]:
    weights = tuple(map(_finite, value))
    total = sum(weights)
    if len(weights) < 2 or min(weights) < 0.0 or not (total > 0.0 and math.isfinite(total)):
        raise ValueError
    return tuple(weight / total for weight in weights)


def _specks(value: Any) -> float | str:
    if isinstance(value, str):
        number = value.removesuffix("%")
        if number == value or not 0.0 < float(number) < 100.0:
            raise ValueError
        return f"{float(number):g}%"
    if not _finite(value) > 0.0:
        raise ValueError
    return float(value)


def _times(value: Any) -> tuple[float, ...]:
    times = tuple(float(_within(_finite(one), -1.0, 2.0)) for one in value)
    if not times or len(times) > 10_000:
        raise ValueError
    return times


FLAG = FieldType("True or False", _flag, "")
MIX = FieldType(
    "shares of two files or more, 0 or more and not all 0, such as .2,.5,.3",
    _mix,
    "X,X,...",
    _floats,
)
ELEMENT = text(
    "the name of a custom element: small letters, digits and a hyphen, such as my-icon",
    r"[a-z][a-z0-9]*(-[a-z0-9]+)+",
    "NAME",
)
SPECKS = FieldType(
    "a length such as 2.5, or a share of the drawing such as 1%",
    _specks,
    "LENGTH|X%",
    lambda text: text if text.endswith("%") else float(text),
)
HOLD = FieldType(
    "seconds, such as 0.5 or 500ms, or two such times with a comma between",
    _hold,
    "S[,S]",
    lambda text: [_split_seconds(part) for part in text.split(",")],
)
TIMES = FieldType("times between -1 and 2, such as -.25,0,.5,1,1.25", _times, "T,T,...", _floats)
TEXT = text("a text", r"(?s:.+)", "TEXT")
SELECTOR = FieldType("", _selector, "SEL")
START = FieldType(
    "auto, or two vertex numbers such as 0,3",
    _start,
    "auto|I,J",
    lambda text: text if text == "auto" else _integers(text),
)
PIN = FieldType(
    "two vertex numbers such as 0,3, or two points such as 1.5,2:3,4",
    _pin,
    "I,J|x,y:x,y",
    lambda text: [_floats(side) for side in text.split(":")] if ":" in text else _integers(text),
)
STIFF = FieldType("of the form x,y,r=W, such as 10,20,5=3", _stiff, "x,y,r=W", _split_stiff)
MATCH = FieldType(
    "of the form A=B, such as 0=1 or left=right, or two points such as 120,40:98,44",
    _match,
    "A=B|x,y:x,y",
    lambda text: text.split("=", 1) if "=" in text else [_floats(side) for side in text.split(":")],
)
BAND = FieldType(
    "none, or a number between 0 and 1",
    _band,
    "DD|none",
    lambda text: text if text == "none" else float(text),
)
EASE = FieldType(
    f"{', '.join(easing.NAMES)}, back or elastic, both also with -in, -out or -in-out, "
    f"{' or '.join(f'{name}({numbers})' for name, (numbers, _) in easing.FORMS.items())}",
    _ease,
    "NAME",
)
REPEAT = FieldType(
    RUNS,
    _repeat,
    "N|forever|pingpong",
    lambda text: int(text) if text.isdecimal() else text,
)
COLOUR = FieldType("transparent, or an opaque CSS colour such as white or #f4f4f0", _colour, "COLOUR")
TIMING = FieldType("", _timing, "FILE", str, is_read=True)
TRIGGER = FieldType(
    "load, click, hover, or the id of an element and an event of it, such as menu.click",
    lambda value: value if isinstance(value, triggers.Trigger) else triggers.parse(str(value)),
    "load|click|hover|NAME.event",
)
FOLDERS = FieldType("two folders", _folders, "FROM TO", words=2)
ADDRESS = text(
    "the address of a scheduler, such as tcp://192.168.0.1:8786", r"(?:.*://)?.+:[0-9]+", "tcp://HOST:PORT"
)
SHARD = FieldType(
    "K/N, with K from 1 to N, such as 3/16",
    _shard,
    "K/N",
    lambda text: tuple(map(int, text.split("/"))),
)
