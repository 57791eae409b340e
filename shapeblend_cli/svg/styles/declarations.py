"""CSS declarations: read from text, chosen between, and rid of ``var()``."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache

from shapeblend_cli.svg.styles.values import is_value
from shapeblend_cli.svg.xml.messages import Problem

_MAX_INLINE = 100_000
# What splitting at semicolons would cut in the wrong place: strings, functions, comments, escapes.
_NEEDS_PARSER = r"[\"'(/\\{@]"

_VARIABLE = r"var\(\s*+(--[^\s,()]++)\s*+(?:,([^()]*+(?:\([^()]*+\)[^()]*+)*+))?+\)"
_MAX_VALUE = 10_000
_MAX_SUBSTITUTIONS = 20

Declarations = dict[str, str]


@lru_cache(maxsize=128)
def parse_inline(text: str) -> tuple[Declarations, Declarations]:
    """Return the normal and the important declarations of a style attribute.

    Many elements have the same: the dictionaries are shared and must not be changed.
    """
    if len(text) > _MAX_INLINE:
        raise Problem(f"a style attribute longer than {_MAX_INLINE} characters, the limit")
    if re.search(_NEEDS_PARSER, text):
        return parse(text)
    normal: Declarations = {}
    important: Declarations = {}
    for declaration in text.split(";"):
        name, colon, value = declaration.partition(":")
        if colon:
            value, mark, _ = value.partition("!")
            put(important if mark else normal, name.strip(), value.strip())
    return normal, important


def parse(source: object) -> tuple[Declarations, Declarations]:
    """Return the normal and the important declarations in `source`, text or tokens of tinycss2."""
    import tinycss2

    normal: Declarations = {}
    important: Declarations = {}
    try:
        for item in tinycss2.parse_blocks_contents(source, skip_comments=True, skip_whitespace=True):
            if item.type == "declaration":
                value = tinycss2.serialize(item.value).strip()
                put(important if item.important else normal, item.name, value)
    except RecursionError:
        raise Problem("a style nested too deeply; without it the file would work") from None
    return normal, important


def put(declarations: Declarations, name: str, value: str) -> None:
    """Add a declaration, unless it has a value that cannot be read: then an earlier one stays, as in browsers.

    Editors write ``fill: #f00; fill: color(display-p3 1 0 0)`` for readers that know less.
    """
    # The names of custom properties are case-sensitive.
    name = name if name.startswith("--") else name.lower()
    if name not in declarations or is_value(name, value):
        declarations[name] = value


def add(declarations: Declarations, others: Declarations) -> None:
    """Add declarations of a higher rank."""
    for name, value in others.items():
        put(declarations, name, value)


def substitute(declared: Declarations, variables: Mapping[str, str]) -> Declarations:
    """Replace each ``var()`` by the custom property it names, which may refer to others.

    https://www.w3.org/TR/css-variables-1/#substitute-a-var
    """
    if not any("var(" in value for value in declared.values()):
        return declared
    return {
        name: _substitute(value, variables) if "var(" in value else value for name, value in declared.items()
    }


def _substitute(value: str, variables: Mapping[str, str]) -> str:
    for _ in range(_MAX_SUBSTITUTIONS):
        match = re.search(_VARIABLE, value)
        if match is None:
            return value
        replacement = variables.get(match[1], match[2])
        if replacement is None or len(value) + len(replacement) > _MAX_VALUE:
            break
        value = value[: match.start()] + replacement.strip() + value[match.end() :]
    return "unset"
