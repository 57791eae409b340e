"""The functions of the CSS property ``filter``, such as ``blur(2px)``, as steps of a filter.

https://www.w3.org/TR/filter-effects-1/#supported-filter-functions
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.model import SOURCE, Step
from shapeblend_cli.svg.effects.primitives import SPACE, colour_matrix, hue_turn, saturation
from shapeblend_cli.svg.styles import css_colours as colours
from shapeblend_cli.svg.xml.transforms import angle
from shapeblend_cli.svg.xml.units import length

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.svg.effects.placed import Units
    from shapeblend_cli.svg.styles.cascade import Inherited

MOST = 16
"""Maximum number of functions of a filter."""

_TEXT = 2000

_SRGB = ((SPACE, "sRGB"),)

_SEPIA = ((0.393, 0.769, 0.189), (0.349, 0.686, 0.168), (0.272, 0.534, 0.131))


class Call(NamedTuple):
    """A function and its arguments, or a link: ``url`` with an address."""

    name: str
    arguments: tuple[str, ...]


def calls(value: str) -> list[Call] | None:
    """Return the functions that a value of ``filter`` lists; None if it lists anything else."""
    import tinycss2

    found: list[Call] = []
    if len(value) > _TEXT:
        return None
    for token in tinycss2.parse_component_value_list(value, skip_comments=True):
        if token.type == "whitespace":
            continue
        if token.type == "url":
            found.append(Call("url", (token.value,)))
        elif token.type == "function":
            words = [part for part in token.arguments if part.type != "whitespace"]
            texts = [part.value if part.type == "string" else tinycss2.serialize([part]) for part in words]
            found.append(Call(token.lower_name, tuple(texts)))
        else:
            return None
    return found if 0 < len(found) <= MOST else None


def steps_of(call: Call, units: Units, inherited: Inherited) -> tuple[Step, ...] | None:
    """Return the step that a function stands for, applied to the source; None if it cannot be read."""
    if call.name == "blur":
        radius = _length(call.arguments[0], units) if call.arguments else 0.0
        if radius is None or radius < 0.0:
            return None
        spread = units.spread(radius, radius)
        return (Step("feGaussianBlur", (SOURCE,), _SRGB, (("stdDeviation", spread),)),)
    if call.name == "drop-shadow":
        return _shadow(call.arguments, units, inherited)
    if call.name == "hue-rotate":
        turn = angle(call.arguments[0]) if call.arguments else 0.0
        return None if turn is None else (_coloured(hue_turn(turn)),)
    amount = _amount(call.arguments[0]) if call.arguments else 1.0
    matrix = None if amount is None else _matrix(call.name, amount)
    return None if matrix is None else (_coloured(matrix),)


def _coloured(matrix: Sequence[float]) -> Step:
    return Step("feColorMatrix", (SOURCE,), _SRGB, (("values", tuple(matrix)),))


def _length(text: str, units: Units) -> float | None:
    return length(text, None, units.lengths.font_size)


def _amount(text: str) -> float | None:
    amount = length(text, whole=1.0)
    return None if amount is None or amount < 0.0 else amount


def _matrix(name: str, amount: float) -> tuple[float, ...] | None:
    """Return the matrix of a function of colours; None if there is no such function."""
    part = min(amount, 1.0)
    if name == "saturate":
        return saturation(amount)
    if name == "grayscale":
        weights = (0.2126, 0.7152, 0.0722)
        return _mixed([weights] * 3, part)
    if name == "sepia":
        return _mixed(_SEPIA, part)
    if name == "opacity":
        return (*colour_matrix("", ())[:18], part, 0.0)
    factors = {
        "brightness": (amount, 0.0),
        "contrast": (amount, 0.5 - 0.5 * amount),
        "invert": (1.0 - 2.0 * part, part),
    }
    if name not in factors:
        return None
    factor, shift = factors[name]
    rows = [(*(factor * (k == row) for k in range(3)), 0.0, shift) for row in range(3)]
    return (*(value for row in rows for value in row), 0.0, 0.0, 0.0, 1.0, 0.0)


def _mixed(rows: Sequence[Sequence[float]], part: float) -> tuple[float, ...]:
    """Return the matrix with a part of what rows of red, green and blue do."""
    found: list[float] = []
    for k, row in enumerate(rows):
        found += [(1.0 - part) * (k == n) + part * value for n, value in enumerate(row)]
        found += [0.0, 0.0]
    return (*found, 0.0, 0.0, 0.0, 1.0, 0.0)


def _shadow(arguments: Sequence[str], units: Units, inherited: Inherited) -> tuple[Step, ...] | None:
    """Return a shadow: two or three lengths, and a colour before or after them."""
    lengths: list[float] = []
    colour = inherited.color
    for text in arguments:
        found = _length(text, units)
        if found is not None:
            lengths.append(found)
            continue
        given = colours.parse(text)
        if given is None or given.kind not in ("colour", "current"):
            return None
        colour = given.colour or inherited.color
    if len(lengths) not in (2, 3) or not all(map(math.isfinite, lengths)):
        return None
    dx, dy = units.vector(*lengths[:2])
    blur = lengths[2] if len(lengths) == 3 else 0.0
    if blur < 0.0:
        return None
    numbers = (
        ("stdDeviation", units.spread(blur, blur)),
        ("dx", (dx,)),
        ("dy", (dy,)),
        ("flood-opacity", (colour.alpha,)),
    )
    return (Step("feDropShadow", (SOURCE,), _SRGB, numbers, (("flood-color", colour.rgb),)),)
