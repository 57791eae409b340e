"""Affine transforms.

A matrix ``(a, b, c, d, e, f)`` maps ``(x, y)`` to ``(a x + c y + e, b x + d y + f)``.
"""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

from shapeblend_cli.svg.reading.units import BLANK, GAP, LIMIT, NUMBER, length

if TYPE_CHECKING:
    from shapeblend_cli.model import Box, ComplexArray

Matrix = tuple[float, float, float, float, float, float]

IDENTITY: Matrix = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)

# Left as text: `re` compiles them when the first transform is read.
_FUNCTION = rf"{GAP}([a-zA-Z]++){BLANK}*+\(([^()]*+)\)"
_ARGUMENT = rf"{GAP}({NUMBER})([a-zA-Z%]*+)"
_ORIGINS = {"left": "0%", "top": "0%", "center": "50%", "right": "100%", "bottom": "100%"}
_MAX_LENGTH = 10_000
_ANGLES = {"": 1.0, "deg": 1.0, "rad": 180.0 / math.pi, "grad": 0.9, "turn": 360.0}


def multiply(m: Matrix, n: Matrix) -> Matrix:
    """Return the matrix that applies `n` first, then `m`."""
    a, b, c, d, e, f = m
    p, q, r, s, t, u = n
    return (
        a * p + c * q,
        b * p + d * q,
        a * r + c * s,
        b * r + d * s,
        a * t + c * u + e,
        b * t + d * u + f,
    )


def apply(m: Matrix, points: ComplexArray) -> ComplexArray:
    """Return `points` with `m` applied to each."""
    a, b, c, d, e, f = m
    if m == IDENTITY:
        return points
    turned = points * complex(a + d, b - c) / 2
    if a != d or b != -c:
        turned = turned + points.conj() * complex(a - d, b + c) / 2
    return turned + complex(e, f)


def determinant(m: Matrix) -> float:
    """Return the factor by which `m` scales areas."""
    return m[0] * m[3] - m[1] * m[2]


def is_sound(m: Matrix) -> bool:
    """Return whether every entry is finite and below the limit on numbers."""
    return all(abs(entry) < LIMIT for entry in m)


def translation(x: float, y: float) -> Matrix:
    """Return the matrix that moves by ``(x, y)``."""
    return (1.0, 0.0, 0.0, 1.0, x, y)


def about(m: Matrix, x: float, y: float) -> Matrix:
    """Return `m` with ``(x, y)`` as its origin."""
    return multiply(multiply(translation(x, y), m), translation(-x, -y))


def parse(text: str, whole: tuple[float, float] | None = None) -> Matrix | None:
    """Read a list of transform functions, or ``none``.

    Parameters
    ----------
    text : str
    whole : pair of float, optional
        Given for the CSS property: what 100 % is across and down. Its lengths and angles need units,
        those of the attribute must have none.

    Returns
    -------
    tuple of six floats, or None when `text` is not a transform
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
        step = _function(match[1].lower(), match[2], whole)
        if step is None:
            return None
        result = multiply(result, step)
        end = match.end()
    return result if end and not text[end:].strip() else None


def _function(name: str, text: str, whole: tuple[float, float] | None) -> Matrix | None:
    """Return one function's matrix: https://www.w3.org/TR/css-transforms-1/#two-d-transform-functions."""
    arguments = _arguments(text)
    if not arguments or not all(abs(value) < LIMIT for value, _ in arguments):
        return None
    if whole is None and any(unit for _, unit in arguments):
        return None
    if name.startswith("translate"):
        return _translate(name, arguments, whole)
    if name in ("rotate", "skewx", "skewy", "skew"):
        return _turn(name, arguments, needs_unit=whole is not None)
    if name.startswith("scale"):
        arguments = [(value / 100, "") if unit == "%" else (value, unit) for value, unit in arguments]
    if any(unit for _, unit in arguments):
        return None
    values = [value for value, _ in arguments]
    match name, len(values):
        case "matrix", 6:
            return (values[0], values[1], values[2], values[3], values[4], values[5])
        case "scale", 1 | 2:
            return (values[0], 0.0, 0.0, values[-1], 0.0, 0.0)
        case "scalex", 1:
            return (values[0], 0.0, 0.0, 1.0, 0.0, 0.0)
        case "scaley", 1:
            return (1.0, 0.0, 0.0, values[0], 0.0, 0.0)
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


def _translate(
    name: str, arguments: list[tuple[float, str]], whole: tuple[float, float] | None
) -> Matrix | None:
    axes = {"translate": (0, 1), "translatex": (0,), "translatey": (1,)}.get(name)
    if axes is None or len(arguments) > len(axes):
        return None
    move = [0.0, 0.0]
    for axis, (value, unit) in zip(axes, arguments, strict=False):
        if whole is not None and not unit and value:
            return None
        distance = length(f"{value!r}{unit}", whole[axis] if whole else None)
        if distance is None:
            return None
        move[axis] = distance
    return translation(move[0], move[1])


def _turn(name: str, arguments: list[tuple[float, str]], needs_unit: bool) -> Matrix | None:
    """Return the matrix of a rotation or a skew."""
    # Only the attribute's rotate() takes a centre.
    most = {"rotate": 1 if needs_unit else 3, "skew": 2}.get(name, 1)
    if len(arguments) > most or (name == "rotate" and len(arguments) == 2):
        return None
    if any(unit not in _ANGLES or (needs_unit and not unit and value) for value, unit in arguments):
        return None
    angles = [math.radians(value * _ANGLES[unit]) for value, unit in arguments]
    if name == "rotate":
        cos, sin = math.cos(angles[0]), math.sin(angles[0])
        turn = (cos, sin, -sin, cos, 0.0, 0.0)
        return about(turn, arguments[1][0], arguments[2][0]) if len(arguments) == 3 else turn
    if name == "skewy":
        return (1.0, math.tan(angles[0]), 0.0, 1.0, 0.0, 0.0)
    down = math.tan(angles[1]) if len(angles) == 2 else 0.0
    return (1.0, down, math.tan(angles[0]), 1.0, 0.0, 0.0)


def origin(text: str, whole: tuple[float, float], font_size: float) -> tuple[float, float]:
    """Return the point ``transform-origin`` names; (0, 0), the default, when it cannot be read."""
    words = text[:_MAX_LENGTH].lower().split()[:2]
    if words and (words[0] in ("top", "bottom") or words[1:] in (["left"], ["right"])):
        words = [*words[1:], words[0]]
        if len(words) == 1:
            words.insert(0, "center")
    words += ["center"] * (2 - len(words))
    point = [length(_ORIGINS.get(w, w), size, font_size) for w, size in zip(words, whole, strict=True)]
    x, y = point
    return (0.0, 0.0) if x is None or y is None else (x, y)


def viewbox_fit(box: Box, width: float, height: float, fit: str) -> Matrix:
    """Return the map of a viewBox onto a viewport at the origin.

    https://www.w3.org/TR/SVG2/coords.html#ComputingAViewportsTransform

    Parameters
    ----------
    box : Box
        With a width and a height above zero.
    width, height : float
        Of the viewport.
    fit : str
        The attribute preserveAspectRatio; one that cannot be read counts as the default.
    """
    words = fit[:_MAX_LENGTH].replace("defer", "").split()
    align = words[0].lower() if words else "xmidymid"
    across, down = width / box.width, height / box.height
    if align != "none":
        across = down = max(across, down) if words[1:2] == ["slice"] else min(across, down)
    free_x, free_y = width - across * box.width, height - down * box.height
    shares = {"min": 0.0, "mid": 0.5, "max": 1.0}
    if re.fullmatch(r"x(min|mid|max)y(min|mid|max)", align):
        share_x, share_y = shares[align[1:4]], shares[align[5:8]]
    else:
        share_x = share_y = 0.5
    return (across, 0.0, 0.0, down, share_x * free_x - across * box.x, share_y * free_y - down * box.y)
