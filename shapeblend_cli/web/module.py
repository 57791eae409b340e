"""A blend as a JavaScript module: the drawing with its moving attributes, and what plays it."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree.ElementTree import Element, fromstring

if TYPE_CHECKING:
    from shapeblend_cli.options.easing import Timing

PLACES = re.compile(r'/\*[A-Z]+\*/|FILE(?=")')
"""Places in the text of the module that are filled."""

STEPS = 40
"""Number of straight pieces of an easing."""


def module_js(animated: str, timing: Timing, pairs: int, decimals: int, name: str) -> str:
    """Return a JavaScript module.

    Parameters
    ----------
    animated : str
        An SVG document that is animated by SMIL, without easing, rests and repetition.
    timing : Timing
        The time that each of the `pairs` takes, and its easing.
    pairs : int
    decimals : int
        Of coordinates in the document; those in between get one more.
    name : str
        Name of the file, for the examples in its head.
    """
    text = Path(__file__).with_suffix(".js").read_text(encoding="utf-8")
    drawing = _node(fromstring(animated))
    root = drawing[1]
    # The svg element of the page has a name of its own, and may have a size.
    root.pop("id", None)
    sizes = [[name, root.pop(name)] for name in ("width", "height") if name in root]
    values = {
        "/*DRAWING*/": json.dumps(drawing, separators=(",", ":"), ensure_ascii=False),
        "/*SIZES*/": json.dumps(sizes, separators=(",", ":")),
        "/*EASING*/": json.dumps(_stops(timing, pairs), separators=(",", ":")),
        "/*DIGITS*/": str(decimals + 1),
        "/*MILLISECONDS*/": f"{round(1000.0 * timing.seconds * pairs)}",
        "FILE": json.dumps(name)[1:-1],
    }
    # All at once: a title may hold what looks like a place to be filled.
    return PLACES.sub(lambda place: values[place[0]].replace("</", "<\\/"), text)


def _stops(timing: Timing, pairs: int) -> list[list[float]]:
    """Return points of the easing of the whole way, time and progress."""
    steps = 1 if timing.ease.is_linear else STEPS
    places = [(k, n / steps) for k in range(pairs) for n in range(steps)]
    found = [[(k + time) / pairs, (k + timing.ease.at(time)) / pairs] for k, time in places]
    return [[round(number, 5) for number in point] for point in [*found, [1.0, 1.0]]]


def _node(element: Element) -> list[Any]:
    """Return an element as its tag, its attributes, how they move, and its children or its text."""
    moves = [_move(child) for child in element if _tag(child).startswith("animate")]
    children = [_node(child) for child in element if not _tag(child).startswith("animate")]
    # Those with a namespace, such as labels of Inkscape, say nothing to browsers, and setAttribute refuses them.
    attributes = {name: value for name, value in element.attrib.items() if not name.startswith("{")}
    return [_tag(element), attributes, moves, children or (element.text or "").strip() or []]


def _move(animation: Element) -> list[Any]:
    """Return an attribute, its values, their times unless they are even, whether it jumps, and the transformation."""
    given = animation.attrib
    times = [float(time) for time in given["keyTimes"].split(";")] if "keyTimes" in given else 0
    jumps = int(given.get("calcMode") == "discrete")
    return [given["attributeName"], given["values"].split(";"), times, jumps, given.get("type", "")]


def _tag(element: Element) -> str:
    return element.tag.rpartition("}")[2]
