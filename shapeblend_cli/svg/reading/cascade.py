"""From what is declared to what is in force: inheritance, keywords, units, opacity."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli.svg.reading import colours
from shapeblend_cli.svg.reading.declarations import KEYWORDS
from shapeblend_cli.svg.reading.units import length

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapeblend_cli.svg.reading.declarations import Declarations


Measure = tuple[float, bool]
"""A length in user units, except that ``(share, True)`` is a share of the viewport's diagonal."""


class Inherited(NamedTuple):
    """The inherited properties of an element, as computed for its children."""

    fill: colours.Paint = colours.Paint("colour", colours.BLACK)
    fill_opacity: float = 1.0
    fill_rule: str = "nonzero"
    stroke: colours.Paint = colours.NONE
    stroke_opacity: float = 1.0
    stroke_width: Measure = (1.0, False)
    stroke_linecap: str = "butt"
    stroke_linejoin: str = "miter"
    stroke_miterlimit: float = 4.0
    stroke_dasharray: tuple[Measure, ...] = ()
    stroke_dashoffset: Measure = (0.0, False)
    color: colours.Colour = colours.BLACK
    visibility: str = "visible"
    font_size: float = 16.0
    variables: Mapping[str, str] = MappingProxyType({})


INITIAL = Inherited()

_KEYWORDS = {
    "fill-rule": ("nonzero", "evenodd"),
    "stroke-linecap": ("butt", "round", "square"),
    "stroke-linejoin": ("miter", "round", "bevel", "arcs", "miter-clip"),
    "visibility": ("visible", "hidden", "collapse"),
}
_PARENTS = (KEYWORDS - {"initial"}) | {""}
_PROPERTIES = {field.replace("_", "-"): field for field in Inherited._fields if field != "variables"}
_MAX_DASHES_TEXT = 10_000
_MAX_DASHES = 1000

_FONT_SIZES = {"smaller": 1 / 1.2, "larger": 1.2}


def inherit(parent: Inherited, declared: Declarations, note: Callable[[str], None]) -> Inherited:
    """Return the inherited properties of an element.

    Parameters
    ----------
    parent : Inherited
        Those of the element around it.
    declared : dict
        What the cascade gives it.
    note : callable
        Takes a phrase on each declaration that cannot be read; it is ignored, as browsers do.
    """
    changed: dict[str, Any] = {}
    font_size = parent.font_size
    names = [name for name in declared if name in _PROPERTIES]
    # Lengths in em need the font size first.
    names.sort(key=lambda name: name != "font-size")
    for name in names:
        text = declared[name].strip()
        keyword = text.lower()
        if keyword in _PARENTS:
            continue
        field = _PROPERTIES[name]
        value = getattr(INITIAL, field) if keyword == "initial" else _value(name, text, parent, font_size)
        if value is None:
            note(f"{name} cannot be read")
            continue
        if isinstance(value, float) and name == "font-size":
            font_size = value
        changed[field] = value
    return parent._replace(**changed) if changed else parent


def _value(name: str, text: str, parent: Inherited, font_size: float) -> object:
    """Return one property's value, or None when `text` is not one."""
    if name in ("fill", "stroke"):
        return colours.parse(text)
    if name == "color":
        return parent.color if text.lower() == "currentcolor" else colours.parse_colour(text)
    if name in ("fill-opacity", "stroke-opacity"):
        return share(text)
    if name == "stroke-width":
        return _positive(_measure(text, font_size))
    if name == "stroke-dashoffset":
        return _measure(text, font_size)
    if name == "stroke-dasharray":
        return _dashes(text, font_size)
    if name == "stroke-miterlimit":
        limit = length(text) if text[-1:].isdigit() or text[-1:] == "." else None
        return None if limit is None or limit < 1 else limit
    if name == "font-size":
        return _font_size(text, font_size)
    keyword = text.lower()
    return keyword if keyword in _KEYWORDS[name] else None


def share(text: str) -> float | None:
    """Return a share between 0 and 1, written as a number or a percentage."""
    value = length(text, whole=1.0)
    return None if value is None else min(max(value, 0.0), 1.0)


def _measure(text: str, font_size: float) -> Measure | None:
    is_share = text.endswith("%")
    value = length(text, 1.0 if is_share else None, font_size)
    return None if value is None else (value, is_share)


def _positive(measure: Measure | None) -> Measure | None:
    return None if measure is None or measure[0] < 0 else measure


def _dashes(text: str, font_size: float) -> tuple[Measure, ...] | None:
    """Return the lengths of dashes and gaps in turn; of dashes that cannot be read, or are too many, None."""
    if text.lower() == "none":
        return ()
    parts = text[:_MAX_DASHES_TEXT].replace(",", " ").split()
    if len(text) > _MAX_DASHES_TEXT or not 0 < len(parts) <= _MAX_DASHES:
        return None
    found = []
    for part in parts:
        dash = _positive(_measure(part, font_size))
        if dash is None:
            return None
        found.append(dash)
    return tuple(found)


def _font_size(text: str, font_size: float) -> float:
    factor = _FONT_SIZES.get(text.lower())
    if factor is not None:
        return font_size * factor
    size = length(text, font_size, font_size)
    # Keywords such as 'medium' are rare and only matter to lengths in em.
    return INITIAL.font_size if size is None or size < 0 else size


def in_user_units(measure: Measure, viewport: tuple[float, float]) -> float:
    """Return a length that may be a share of the viewport's diagonal."""
    value, is_share = measure
    return value * diagonal(*viewport) if is_share else value


def diagonal(width: float, height: float) -> float:
    """Return what 100 % is for a length that is neither across nor down."""
    return math.sqrt((width * width + height * height) / 2)
