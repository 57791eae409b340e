"""A ``text`` element, or one that moves in a group around it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple
from xml.etree.ElementTree import Element, SubElement

from shapeblend_cli.svg.writing.rounding import number

if TYPE_CHECKING:
    from shapeblend_cli.model import Picture
    from shapeblend_cli.model.words import TextRun, Words

SAME = 1e-9
"""Tolerance of a map that only scales and moves, as a share of its scale."""

FURTHER = 2
"""Number of further decimals of places and sizes of letters."""

MATRIX_DIGITS = 9
"""Significant digits of the numbers of a map that turns or skews."""

_NAME = re.compile(r"[A-Za-z][-\w]*", re.ASCII)


class _Map(NamedTuple):
    """Scaling and shift, all that happens to lengths; the rest is left to a matrix."""

    scale: float = 1.0
    shift: complex = 0j


def text_element(words: Words, picture: Picture, paint: Mapping[str, str], decimals: int) -> Element:
    """Return a text in the place of a picture, by its own attributes if it is only scaled and moved there."""
    origin, across, down = words.axes_in(picture)
    if abs(down - 1j * across) + abs(across.imag) <= SAME * abs(across) and across.real > 0.0:
        return _written(words, _Map(across.real, origin), paint, decimals)
    parts = [part for z in (across, down, origin) for part in (z.real, z.imag)]
    matrix = " ".join(f"{part:.{MATRIX_DIGITS}g}" for part in parts)
    return _written(words, _Map(), {**paint, "transform": f"matrix({matrix})"}, decimals)


def centred(picture: Picture) -> Picture:
    """Return the place of a picture in a group that a transform moves: a square of side 1 around 0."""
    return picture._replace(origin=-0.5 - 0.5j, across=1.0 + 0j, down=1j)


def _written(words: Words, place: _Map, paint: Mapping[str, str], decimals: int) -> Element:
    runs = words.runs
    around = {"direction": words.direction, "dominant-baseline": words.baseline}
    common = {name: value for name, value in around.items() if value not in ("ltr", "auto")}
    # A text begins at 0 where no place is given.
    first = runs[0]._replace(x=runs[0].x or 0.0, y=runs[0].y or 0.0)
    own = [_attributes(run, place, decimals) for run in (first, *runs[1:])]
    shared = {name: value for name, value in own[0].items() if name in _INHERITED}
    attributes = {**common, **shared, **paint, **({} if len(runs) > 1 else own[0])}
    whole = "".join(run.text for run in runs)
    if "  " in whole or whole != whole.strip(" "):
        attributes["xml:space"] = "preserve"
    element = Element("text", dict(sorted(attributes.items())))
    if len(runs) == 1:
        element.text = whole
        return element
    for run, given in zip(runs, own, strict=True):
        differing = {
            name: value
            for name, value in given.items()
            if name not in _INHERITED or shared.get(name) != value
        }
        reset = {name: _INHERITED[name] for name in shared if name not in given}
        SubElement(element, "tspan", dict(sorted({**reset, **differing}.items()))).text = run.text
    return element


_INHERITED = {
    "font-family": "",
    "font-size": "16",
    "font-style": "normal",
    "font-weight": "400",
    "letter-spacing": "0",
    "word-spacing": "0",
    "text-anchor": "start",
}
"""Attributes that spans have from their text, with their initial values."""


def _attributes(run: TextRun, place: _Map, decimals: int) -> dict[str, str]:
    """Return the attributes of a run, without initial values."""
    digits = decimals + FURTHER

    def lengths(values: Sequence[float]) -> str:
        return " ".join(number(place.scale * value, digits) for value in values)

    found = {
        "x": "" if run.x is None else number(place.scale * run.x + place.shift.real, digits),
        "y": "" if run.y is None else number(place.scale * run.y + place.shift.imag, digits),
        "dx": lengths(run.dx),
        "dy": lengths(run.dy),
        "rotate": " ".join(number(angle, 4) for angle in run.rotate),
        "font-family": ", ".join(map(_family, run.families)),
        "font-size": lengths([run.size]),
        "font-style": "italic" if run.is_slanted else "normal",
        "font-weight": str(run.weight),
        "letter-spacing": lengths([run.between_letters]),
        "word-spacing": lengths([run.between_words]),
        "text-anchor": run.anchor,
    }
    return {name: value for name, value in found.items() if value and _INHERITED.get(name) != value}


def _family(name: str) -> str:
    """Return the name of a font as style sheets have it; generic names are those that need no quotes."""
    if _NAME.fullmatch(name):
        return name
    return "'" + "".join(c for c in name if c.isprintable() and c not in "'\\<>") + "'"
