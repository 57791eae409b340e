"""Affine maps, and the ``transform`` attribute and properties that give them."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.svg.reading.units import BLANK, GAP, LIMIT, NUMBER, length

if TYPE_CHECKING:
    from shapeblend_cli.model import ComplexArray
    from shapeblend_cli.svg.reading.units import Lengths

# Left as text: `re` compiles them when the first transform is read.
_FUNCTION = rf"{GAP}([a-zA-Z]++){BLANK}*+\(([^()]*+)\)"
_ARGUMENT = rf"{GAP}({NUMBER})([a-zA-Z%]*+)"
_ORIGINS = {"left": "0%", "top": "0%", "center": "50%", "right": "100%", "bottom": "100%"}
_MAX_LENGTH = 10_000
_ANGLES = {"": 1.0, "deg": 1.0, "rad": 180.0 / math.pi, "grad": 0.9, "turn": 360.0}


class Affine(NamedTuple):
    """The affine map of ``(x, y)`` to ``(a x + c y + e, b x + d y + f)``; by default the identity."""

    a: float = 1.0
    b: float = 0.0
    c: float = 0.0
    d: float = 1.0
    e: float = 0.0
    f: float = 0.0

    def __matmul__(self, first: Affine) -> Affine:
        """Return the map that applies `first`, then this one."""
        a, b, c, d, e, f = self
        p, q, r, s, t, u = first
        return Affine(
            a * p + c * q,
            b * p + d * q,
            a * r + c * s,
            b * r + d * s,
            a * t + c * u + e,
            b * t + d * u + f,
        )

    def points(self, z: ComplexArray) -> ComplexArray:
        """Map points."""
        if self == IDENTITY:
            return z
        a, b, c, d, e, f = self
        linear = z * complex(a + d, b - c) / 2
        if a != d or b != -c:
            linear = linear + z.conj() * complex(a - d, b + c) / 2
        return linear + complex(e, f)

    @property
    def determinant(self) -> float:
        """The factor by which areas are scaled."""
        return self.a * self.d - self.b * self.c

    def about(self, x: float, y: float) -> Affine:
        """Return this map with ``(x, y)`` as its origin."""
        return translation(x, y) @ self @ translation(-x, -y)


IDENTITY = Affine()


def translation(x: float, y: float) -> Affine:
    """Return the map that moves by ``(x, y)``."""
    return Affine(1.0, 0.0, 0.0, 1.0, x, y)


def is_sound(matrix: Affine) -> bool:
    """Return whether every entry is finite and below the limit on numbers."""
    return all(abs(entry) < LIMIT for entry in matrix)


def parse(text: str, viewport: Lengths | None = None) -> Affine | None:
    """Read a list of transform functions, or ``none``; return None when `text` is neither.

    The `viewport` is given for the CSS property. Its lengths and angles need units, those of the attribute must have
    none.
    """
    text = text.strip()
    if text in ("", "none"):
        return IDENTITY
    if text.startswith(",") or len(text) > _MAX_LENGTH:
        return None
    result = IDENTITY
    end = 0
    pattern = re.compile(_FUNCTION)
    while match := pattern.match(text, end):
        step = _function(match[1].lower(), match[2], viewport)
        if step is None:
            return None
        result = result @ step
        end = match.end()
    return result if end and not text[end:].strip() else None


def _function(name: str, text: str, viewport: Lengths | None) -> Affine | None:
    """Return the map of one function: https://www.w3.org/TR/css-transforms-1/#two-d-transform-functions."""
    arguments = _arguments(text)
    if not arguments or not all(abs(value) < LIMIT for value, _ in arguments):
        return None
    if viewport is None and any(unit for _, unit in arguments):
        return None
    if name.startswith("translate"):
        return _translate(name, arguments, viewport)
    if name in ("rotate", "skewx", "skewy", "skew"):
        return _rotate_or_skew(name, arguments, needs_unit=viewport is not None)
    if name.startswith("scale"):
        arguments = [(value / 100, "") if unit == "%" else (value, unit) for value, unit in arguments]
    if any(unit for _, unit in arguments):
        return None
    values = [value for value, _ in arguments]
    match name, len(values):
        case "matrix", 6:
            return Affine(*values)
        case "scale", 1 | 2:
            return Affine(a=values[0], d=values[-1])
        case "scalex", 1:
            return Affine(a=values[0])
        case "scaley", 1:
            return Affine(d=values[0])
    return None


def _arguments(text: str) -> list[tuple[float, str]] | None:
    """Return numbers with their units."""
    if text.lstrip()[:1] == ",":
        return None
    found = []
    end = 0
    pattern = re.compile(_ARGUMENT)
    while match := pattern.match(text, end):
        found.append((float(match[1]), match[2].lower()))
        end = match.end()
    return found if not text[end:].strip() else None


def _translate(name: str, arguments: list[tuple[float, str]], viewport: Lengths | None) -> Affine | None:
    axes = {"translate": (0, 1), "translatex": (0,), "translatey": (1,)}.get(name)
    if axes is None or len(arguments) > len(axes):
        return None
    shift = [0.0, 0.0]
    for axis, (value, unit) in zip(axes, arguments, strict=False):
        if viewport is not None and not unit and value:
            return None
        distance = length(f"{value!r}{unit}", viewport[axis] if viewport else None)
        if distance is None:
            return None
        shift[axis] = distance
    return translation(*shift)


def _rotate_or_skew(name: str, arguments: list[tuple[float, str]], needs_unit: bool) -> Affine | None:
    # Only the attribute's rotate() takes a centre.
    most = {"rotate": 1 if needs_unit else 3, "skew": 2}.get(name, 1)
    if len(arguments) > most or (name == "rotate" and len(arguments) == 2):
        return None
    if any(unit not in _ANGLES or (needs_unit and not unit and value) for value, unit in arguments):
        return None
    angles = [math.radians(value * _ANGLES[unit]) for value, unit in arguments]
    if name == "rotate":
        cos, sin = math.cos(angles[0]), math.sin(angles[0])
        rotation = Affine(cos, sin, -sin, cos)
        return rotation.about(arguments[1][0], arguments[2][0]) if len(arguments) == 3 else rotation
    if name == "skewy":
        return Affine(b=math.tan(angles[0]))
    return Affine(b=math.tan(angles[1]) if len(angles) == 2 else 0.0, c=math.tan(angles[0]))


def origin(text: str, lengths: Lengths) -> tuple[float, float]:
    """Return the point ``transform-origin`` names; (0, 0), the default, when it cannot be read."""
    words = text[:_MAX_LENGTH].lower().split()[:2]
    if words and (words[0] in ("top", "bottom") or words[1:] in (["left"], ["right"])):
        words = [*words[1:], words[0]]
        if len(words) == 1:
            words.insert(0, "center")
    horizontal, vertical = (_ORIGINS.get(word, word) for word in (*words, "center", "center")[:2])
    x, y = lengths.x(horizontal), lengths.y(vertical)
    return (0.0, 0.0) if x is None or y is None else (x, y)
