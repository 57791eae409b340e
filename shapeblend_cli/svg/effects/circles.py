"""Patterns that would be drawn in themselves.

https://www.w3.org/TR/SVG2/pservers.html says that such references are errors. Which of them paint nothing is not said;
in Chromium it is those that close a circle with references before them in the file.
"""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING

from shapeblend_cli.svg.effects.tiles import chain
from shapeblend_cli.svg.styles import css_colours as colours

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from shapeblend_cli.svg.styles.cascade import Cascade
    from shapeblend_cli.svg.xml.xmltree import Node

MOST_PATTERNS = 200
"""Maximum number of patterns of a file that are looked at."""


def closing(root: Node, ids: Mapping[str, Node], cascade: Cascade) -> set[tuple[int, int]]:
    """Return pairs of patterns, as ids of Python: what is in the first one and refers to the second paints nothing."""
    patterns = [*islice((node for node in root.walk() if node.tag == "pattern"), MOST_PATTERNS)]
    places = {id(node): k for k, node in enumerate(patterns)}
    reached = [0] * len(patterns)  # by each pattern: a bit for every other one
    found = set()
    for k, node in enumerate(patterns):
        for other in _others(node, ids, cascade):
            place = places.get(id(other))
            if place is None or reached[k] >> place & 1:
                continue
            if place == k or reached[place] >> k & 1:
                found.add((id(node), id(other)))
                continue
            more = reached[place] | 1 << place
            reached = [
                bits | more if number == k or bits >> k & 1 else bits for number, bits in enumerate(reached)
            ]
    return found


def _others(node: Node, ids: Mapping[str, Node], cascade: Cascade) -> Iterator[Node]:
    """Yield what a pattern refers to, in the order of the file: the pattern that it is like, and paints in it."""
    yield from chain(node, ids)[1:2]
    for each in node.walk():
        declared = cascade.declared(each)
        for name in ("fill", "stroke"):
            paint = colours.parse(declared[name]) if "url(" in declared.get(name, "") else None
            server = None if paint is None or not paint.link.startswith("#") else ids.get(paint.link[1:])
            if server is not None:
                yield server


def is_closed(
    server: Node, around: tuple[Node, ...], closing: set[tuple[int, int]], ids: Mapping[str, Node]
) -> bool:
    """Return whether a pattern would be drawn in itself, or paints nothing where others are drawn, innermost last."""
    holder = next((node for node in chain(server, ids) if node.children), server)
    inner = next((node for node in reversed(around) if node.tag == "pattern"), None)
    return holder in around or (id(inner), id(server)) in closing
