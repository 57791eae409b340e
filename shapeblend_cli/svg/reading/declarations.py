"""What properties an element is given: attributes, style sheets and the style attribute in one cascade."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING

from shapeblend_cli.svg.reading import colours
from shapeblend_cli.svg.reading.problem import Problem

if TYPE_CHECKING:
    from collections.abc import Mapping

    from shapeblend_cli.svg.reading.xmltree import Node

PRESENTATION = frozenset(
    (
        "clip-path color display fill fill-opacity fill-rule filter font-size marker-end marker-mid "
        "marker-start mask opacity stop-color stop-opacity stroke stroke-dasharray stroke-dashoffset "
        "stroke-linecap stroke-linejoin stroke-miterlimit stroke-opacity stroke-width transform "
        "transform-origin vector-effect visibility"
    ).split()
)
"""Properties this reader knows that may be written as attributes."""

KEYWORDS = frozenset(("inherit", "initial", "unset", "revert", "revert-layer"))
"""What every property may be: https://www.w3.org/TR/css-cascade-4/#defaulting-keywords."""

_MAX_INLINE = 100_000
# What the quick way below would cut in the wrong place: strings, functions, comments, escapes.
_NEEDS_PARSER = r"[\"'(/\\{@]"

_VARIABLE = r"var\(\s*+(--[^\s,()]++)\s*+(?:,([^()]*+(?:\([^()]*+\)[^()]*+)*+))?+\)"
_MAX_VALUE = 10_000
_MAX_SUBSTITUTIONS = 20

Declarations = dict[str, str]


@lru_cache(maxsize=128)
def inline(text: str) -> tuple[Declarations, Declarations]:
    """Return the declarations of a style attribute: the normal and the important ones.

    Many elements have the same: the dictionaries are shared and must not be changed.
    """
    if len(text) > _MAX_INLINE:
        raise Problem(f"a style attribute longer than {_MAX_INLINE} characters, the most that is read")
    if re.search(_NEEDS_PARSER, text):
        from shapeblend_cli.svg.reading import stylesheets

        return stylesheets.declarations(text)
    normal: Declarations = {}
    important: Declarations = {}
    for declaration in text.split(";"):
        name, colon, value = declaration.partition(":")
        if colon:
            value, mark, _ = value.partition("!")
            put(important if mark else normal, name.strip(), value.strip())
    return normal, important


def put(declarations: Declarations, name: str, value: str) -> None:
    """Add a declaration, unless it is a colour that cannot be read: then an earlier one stays.

    Editors write ``fill: #f00; fill: color(display-p3 1 0 0)`` for the sake of readers that know less.
    """
    # The names of custom properties are case-sensitive.
    name = name if name.startswith("--") else name.lower()
    if name in ("fill", "stroke", "color") and name in declarations and not _is_paint(value):
        return
    declarations[name] = value


def _is_paint(value: str) -> bool:
    return colours.parse(value) is not None or value.lower() in KEYWORDS or "var(" in value


def resolved(declared: Declarations, variables: Mapping[str, str]) -> Declarations:
    """Return `declared` with each ``var()`` replaced by the custom property it names.

    https://www.w3.org/TR/css-variables-1/#substitute-a-var

    Parameters
    ----------
    declared : dict
    variables : mapping
        The custom properties in force; one of them may refer to others.
    """
    return {
        name: _substituted(value, variables) if "var(" in value else value for name, value in declared.items()
    }


def _substituted(value: str, variables: Mapping[str, str]) -> str:
    for _ in range(_MAX_SUBSTITUTIONS):
        match = re.search(_VARIABLE, value)
        if match is None:
            return value
        found = variables.get(match[1], match[2])
        if found is None or len(value) + len(found) > _MAX_VALUE:
            break
        value = value[: match.start()] + found.strip() + value[match.end() :]
    return "unset"


class Cascade:
    """The style rules of a document.

    Parameters
    ----------
    root : Node
    """

    def __init__(self, root: Node) -> None:
        self._rules: dict[int, tuple[Declarations, Declarations]] = {}
        self._kept: dict[int, Declarations] = {}
        texts = [node.text for node in root.walk() if node.tag == "style" and _is_css(node)]
        if any(text.strip() for text in texts):
            from shapeblend_cli.svg.reading import stylesheets

            self._rules = stylesheets.match(root, texts)

    def declared(self, node: Node, keep: bool = False) -> Declarations:
        """Return what `node` is given, of each property the declaration that wins.

        Parameters
        ----------
        node : Node
        keep : bool
            Whether to remember it: the node will be asked for again.
        """
        if not keep:
            return self._cascaded(node)
        if id(node) not in self._kept:
            self._kept[id(node)] = self._cascaded(node)
        return self._kept[id(node)]

    def _cascaded(self, node: Node) -> Declarations:
        attrib = node.attrib
        found = {name: attrib[name] for name in PRESENTATION & attrib.keys()}
        rules = self._rules.get(id(node))
        style = attrib.get("style")
        layers = [rules] if rules else []
        if style:
            layers.append(inline(style))
        for rank in (0, 1):
            for layer in layers:
                for name, value in layer[rank].items():
                    put(found, name, value)
        return found


def _is_css(node: Node) -> bool:
    kind = node.get("type", "") or ""
    media = (node.get("media", "") or "").strip().lower()
    return kind.strip().lower() in ("", "text/css") and media in ("", "all", "screen")
