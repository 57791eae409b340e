"""Values of properties: those that are inherited, and whether what is written is one at all."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Any

from shapeblend_cli.svg.styles import css_colours as colours
from shapeblend_cli.svg.xml.transforms import SINGLE, parse
from shapeblend_cli.svg.xml.units import KEYWORDS, Lengths, Measure, length

CONTEXT = ("context-fill", "context-stroke")
"""Paints in a marker: those of the line that is marked."""

MARKERS = ("marker-start", "marker-mid", "marker-end")
"""Properties that name the markers of a line."""

_KEYWORDS = {
    "fill-rule": ("nonzero", "evenodd"),
    "clip-rule": ("nonzero", "evenodd"),
    "stroke-linecap": ("butt", "round", "square"),
    "stroke-linejoin": ("miter", "round", "bevel", "arcs", "miter-clip"),
    "visibility": ("visible", "hidden", "collapse"),
}
_MAX_DASHES_TEXT = 10_000
_MAX_DASHES = 1000
_LAYERS = frozenset(("fill", "stroke", "markers"))

_FONT_SIZE = 16.0
_FONT_SIZES = {"smaller": 1 / 1.2, "larger": 1.2}
_NAMED_SIZES = {
    "xx-small": 9.0,
    "x-small": 10.0,
    "small": 13.0,
    "medium": 16.0,
    "large": 18.0,
    "x-large": 24.0,
    "xx-large": 32.0,
    "xxx-large": 48.0,
}

_COLOURS = frozenset(("stop-color", "flood-color", "lighting-color"))
_SHARES = frozenset(("opacity", "stop-opacity", "flood-opacity"))
_INHERITED = frozenset(
    "fill fill-opacity stroke stroke-opacity stroke-width stroke-miterlimit stroke-dasharray stroke-dashoffset color "
    "font-size paint-order".split()
).union(_KEYWORDS)
_BOX = r"(?:fill|stroke|view|margin|border|padding|content)-box"
_EFFECTS = "url|blur|brightness|contrast|drop-shadow|grayscale|hue-rotate|invert|opacity|saturate|sepia"
# Left as text: few files declare a property twice.
_GRAMMARS = {
    "display": r"none|block|contents|flow|flow-root|grid|flex|math|list-item"
    "|(?:inline|table|ruby|run|-webkit|-ms)(?:-[a-z-]+)?",
    "clip-path": rf"none|(?:{_BOX}\s+)?(?:url|inset|circle|ellipse|polygon|path|rect|xywh|shape)\(.*|{_BOX}",
    "mask": r"none|[^(]*\(.*",
    "filter": rf"none|(?:{_EFFECTS})\(.*",
    **dict.fromkeys(("marker", *MARKERS), r"none|url\(.*"),
}
# Functions that browsers compute and this reader does not: a note says that the value cannot be read.
_COMPUTED = r"(?i)(?:^|[\s,(])(?:calc|min|max|clamp|env|var)\("


@lru_cache(maxsize=4096)
def is_value(name: str, text: str) -> bool:
    """Return whether a declaration counts in browsers, or is of a property whose values are not known here.

    One that does not count leaves an earlier one in force.
    """
    text = text.strip()
    if text.lower() in KEYWORDS or re.search(_COMPUTED, text):
        return True
    if name in _INHERITED:
        if name in ("fill", "stroke") and text.lower() in CONTEXT:
            return True
        if name == "color" and text.lower() == "currentcolor":
            return True
        return inherited_value(name, text) is not None
    if name in _COLOURS:
        paint = colours.parse(text)
        return paint is not None and paint.kind in ("colour", "current")
    if name in _SHARES:
        return share(text) is not None
    if name == "transform":
        return parse(text, Lengths(1.0, 1.0)) is not None
    if name in SINGLE:
        return text.lower() == "none" or parse(f"{name}({text})", Lengths(1.0, 1.0)) is not None
    grammar = _GRAMMARS.get(name)
    return grammar is None or re.fullmatch(f"(?is){grammar}", text) is not None


def inherited_value(name: str, text: str, font_size: float = _FONT_SIZE) -> Any:
    """Return the value of an inherited property, other than text, or None if it cannot be read."""
    if name in ("fill", "stroke"):
        return colours.parse(text)
    if name in MARKERS:
        return text
    if name == "paint-order":
        return _paint_order(text)
    if name == "color":
        return colours.parse_colour(text)
    if name in ("fill-opacity", "stroke-opacity"):
        return share(text)
    if name in ("stroke-width", "stroke-dashoffset"):
        measure = _measure(text, font_size)
        return None if name == "stroke-width" and measure is not None and measure[0] < 0 else measure
    if name == "stroke-dasharray":
        return _dashes(text, font_size)
    if name == "stroke-miterlimit":
        limit = length(text) if text[-1:].isdigit() or text[-1:] == "." else None
        return None if limit is None or limit < 1 else limit
    if name == "font-size":
        return _font_size(text, font_size)
    keyword = text.lower()
    return keyword if keyword in _KEYWORDS[name] else None


def _paint_order(text: str) -> str | None:
    """Return ``stroke`` if strokes are below fills, else ``normal``; what is not named comes later."""
    words = text.lower().split()
    if words == ["normal"]:
        return "normal"
    if not words or len({*words}) < len(words) or not _LAYERS.issuperset(words):
        return None
    order = [*words, *(word for word in ("fill", "stroke") if word not in words)]
    return "stroke" if order.index("stroke") < order.index("fill") else "normal"


def share(text: str) -> float | None:
    """Return a share between 0 and 1, written as a number or a percentage."""
    value = length(text, whole=1.0)
    return None if value is None else min(max(value, 0.0), 1.0)


def _measure(text: str, font_size: float) -> Measure | None:
    is_share = text.endswith("%")
    value = length(text, 1.0 if is_share else None, font_size)
    return None if value is None else (value, is_share)


def _dashes(text: str, font_size: float) -> tuple[Measure, ...] | None:
    """Return the lengths of dashes and gaps in turn; of dashes that cannot be read, or are too many, None."""
    if text.lower() == "none":
        return ()
    parts = text[:_MAX_DASHES_TEXT].replace(",", " ").split()
    if len(text) > _MAX_DASHES_TEXT or not 0 < len(parts) <= _MAX_DASHES:
        return None
    dashes = [_measure(part, font_size) for part in parts]
    return None if any(dash is None or dash[0] < 0 for dash in dashes) else tuple(filter(None, dashes))


def _font_size(text: str, font_size: float) -> float | None:
    factor = _FONT_SIZES.get(text.lower())
    if factor is not None:
        return font_size * factor
    if text.lower() in _NAMED_SIZES:
        return _NAMED_SIZES[text.lower()]
    size = length(text, font_size, font_size)
    return None if size is None or size < 0 else size
