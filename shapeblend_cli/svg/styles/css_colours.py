"""Paint: a CSS colour, ``none``, ``currentColor``, or a reference to a gradient or pattern."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Any, NamedTuple

# Left as text: `re` compiles them when they are first used, and few files need all of them.
_RGB = r"rgb\(\s*([0-9]{1,3})\s*,\s*([0-9]{1,3})\s*,\s*([0-9]{1,3})\s*\)"
_URL = r"(?s)url\(\s*([\"']?)(.*?)\1\s*\)\s*(.*)"
_LIGHT = r"(?is)light-dark\(((?>[^(),]+|\((?>[^()]+|\([^()]*\))*\))+),.*\)"
_ICC = r"\s*(?:icc-color|device-\w+)\(.*\)$"


class Colour(NamedTuple):
    """An opaque colour ``#rrggbb`` and how opaque it is."""

    rgb: str
    alpha: float = 1.0


class Paint(NamedTuple):
    """The value of fill or stroke, of kind ``none``, ``colour``, ``current`` or ``server``.

    The `link` of a paint server is the address in its ``url()``, the `fallback` is the paint after that.
    """

    kind: str
    colour: Colour | None = None
    link: str = ""
    fallback: Paint | None = None


_MAX_LENGTH = 1000
_HEX_DIGITS = frozenset("0123456789abcdefABCDEF")

NONE = Paint("none")
BLACK = Colour("#000000")

_KEYWORDS = {"none": NONE, "currentcolor": Paint("current")}
_COMMON = {"black": BLACK, "white": Colour("#ffffff"), "transparent": Colour("#000000", 0.0)}


@lru_cache(maxsize=4096)
def parse(text: str) -> Paint | None:
    """Return a paint, or None when `text` is none that is known."""
    text = text.strip()
    if len(text) > _MAX_LENGTH:
        return None
    keyword = _KEYWORDS.get(_for_light(text).lower())
    if keyword is not None:
        return keyword
    match = re.fullmatch(_URL, text) if text.startswith("url") else None
    if match:
        return Paint("server", link=match[2].strip(), fallback=parse(match[3]) if match[3] else None)
    colour = parse_colour(text)
    return None if colour is None else Paint("colour", colour)


@lru_cache(maxsize=4096)
def parse_colour(text: str) -> Colour | None:
    """Return a CSS colour, or None when `text` is none."""
    if len(text) > _MAX_LENGTH:
        return None
    text = _for_light(text.strip())
    common = _COMMON.get(text)
    if common is not None:
        return common
    if text.startswith("#") and _HEX_DIGITS.issuperset(text[1:]) and len(text) in (4, 5, 7, 9):
        return _from_hex(text[1:].lower())
    if " icc-color(" in text or " device-" in text:
        return parse_colour(re.sub(_ICC, "", text))
    match = re.fullmatch(_RGB, text)
    if match:
        return Colour("#" + "".join(f"{min(int(match[k]), 255):02x}" for k in (1, 2, 3)))
    return _from_css(text)


def _for_light(text: str) -> str:
    """Return the first of the two colours of ``light-dark()``, which is the one on a light page, or any other text."""
    match = re.fullmatch(_LIGHT, text) if text[:10].lower() == "light-dark" else None
    return match[1].strip() if match else text


def _from_hex(digits: str) -> Colour:
    if len(digits) < 6:
        digits = "".join(2 * digit for digit in digits)
    alpha = int(digits[6:], 16) / 255 if len(digits) == 8 else 1.0
    return Colour("#" + digits[:6], alpha)


def _from_css(text: str) -> Colour | None:
    """Return a colour in any other form of CSS: names, percentages, hsl() and the rest."""
    from tinycss2 import color4

    try:
        colour = color4.parse_color(text)
        # A string is a keyword, `currentcolor`.
        if colour is None or isinstance(colour, str):
            return None
        parts = [min(max(part, 0.0), 1.0) for part in _srgb(colour)]
        alpha = min(max(float(colour.alpha), 0.0), 1.0)
        return Colour("#" + "".join(f"{int(255 * part + 0.5):02x}" for part in parts), alpha)
    except (ValueError, TypeError, ArithmeticError, NotImplementedError, RecursionError):
        return None


def _srgb(colour: Any) -> tuple[float, float, float]:
    """Return red, green and blue of a tinycss2 colour, not clipped to the gamut of sRGB."""
    try:
        red, green, blue = colour.to("srgb").coordinates
    except NotImplementedError:  # of other spaces than sRGB
        from coloraide import Color

        space = "xyz-d65" if colour.space == "xyz" else colour.space
        parts = [part or 0.0 for part in colour.coordinates]
        red, green, blue = Color(space, parts).convert("srgb").coords()
    return red, green, blue
