"""The cascade: from style sheets, attributes and inheritance to the properties of an element."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

from shapeblend_cli.svg.styles import css_colours as colours
from shapeblend_cli.svg.styles.declarations import Declarations, add, parse_inline, substitute
from shapeblend_cli.svg.styles.values import CONTEXT, MARKERS, inherited_value
from shapeblend_cli.svg.xml.messages import check_limit
from shapeblend_cli.svg.xml.units import KEYWORDS, Measure
from shapeblend_cli.svg.xml.xmltree import ANIMATIONS, Node, Tree

TEXT = frozenset(
    "alignment-baseline baseline-shift direction dominant-baseline font font-family font-style font-weight "
    "letter-spacing text-anchor white-space word-spacing writing-mode".split()
)
"""Properties of text, which this reader keeps as they are written."""

PRESENTATION = TEXT - {"font"} | frozenset(
    "clip-path clip-rule color color-interpolation-filters display fill fill-opacity fill-rule filter flood-color "
    "flood-opacity font-size lighting-color marker-end marker-mid marker-start mask mask-type opacity overflow "
    "paint-order stop-color stop-opacity stroke stroke-dasharray "
    "stroke-dashoffset stroke-linecap stroke-linejoin stroke-miterlimit stroke-opacity stroke-width transform "
    "transform-origin vector-effect visibility".split()
)
"""Presentation attributes: properties that this reader knows, and that may be written as attributes."""


class Inherited(NamedTuple):
    """The computed values of an element's inherited properties."""

    fill: colours.Paint = colours.Paint("colour", colours.BLACK)
    fill_opacity: float = 1.0
    fill_rule: str = "nonzero"
    clip_rule: str = "nonzero"
    stroke: colours.Paint = colours.NONE
    stroke_opacity: float = 1.0
    stroke_width: Measure = (1.0, False)
    stroke_linecap: str = "butt"
    stroke_linejoin: str = "miter"
    stroke_miterlimit: float = 4.0
    stroke_dasharray: tuple[Measure, ...] = ()
    stroke_dashoffset: Measure = (0.0, False)
    color: colours.Colour = colours.BLACK
    has_color: bool = False  # whether the file sets it; else the page does
    visibility: str = "visible"
    font_size: float = 16.0
    paint_order: str = "normal"  # or stroke, if that is below the fill
    marker_start: str = "none"
    marker_mid: str = "none"
    marker_end: str = "none"
    context: tuple[colours.Paint, colours.Paint] = (colours.NONE,) * 2  # fill and stroke of a marked line
    text: Mapping[str, str] = MappingProxyType({})  # properties in `TEXT`
    variables: Mapping[str, str] = MappingProxyType({})


INITIAL = Inherited()

_PARENTS = (KEYWORDS - {"initial"}) | {""}
_FIELDS = {
    field.replace("_", "-"): field
    for field in Inherited._fields
    if field not in ("text", "variables", "context", "has_color")
}
# Properties that are handed on only where ``inherit`` asks for it. Of transforms, attributes have another grammar.
_OWN = frozenset(
    "clip-path display filter flood-color flood-opacity lighting-color mask mix-blend-mode opacity stop-color "
    "stop-opacity".split()
)
MAX_VARIABLES = 1000

_WORDS = r"normal|italic|oblique|small-caps|bold|bolder|lighter|[1-9]00"
_FONT = rf"(?is)((?:(?:{_WORDS})\s++)*+)([^\s/]++)(?:\s*+/\s*+\S++)?\s++(.++)"


class Cascade:
    """The style rules of a document."""

    def __init__(self, tree: Tree) -> None:
        root = tree.root
        self._tree = tree
        self._rules: dict[int, tuple[Declarations, Declarations]] = {}
        self._kept: dict[int, Declarations] = {}
        sheets, self.is_animated = [], False
        for node in root.walk():
            if node.tag == "style":
                sheets.append(node)
                self.is_animated |= "keyframes" in node.text and "animation" in node.text
            else:
                self.is_animated |= node.tag in ANIMATIONS
        texts = [node.text for node in sheets if _is_css(node)]
        self.has_schemes = any(
            "prefers-color-scheme" in part for node in sheets for part in (node.text, node.get("media") or "")
        )
        if any(text.strip() for text in texts):
            from shapeblend_cli.svg.styles import stylesheets

            self._rules = stylesheets.match(root, texts)

    def declared(self, node: Node, keep: bool = False) -> Declarations:
        """Return the winning declaration of each property; `keep` it if the node will be asked for again."""
        if id(node) in self._kept:
            return self._kept[id(node)]
        winners = self._winners(node)
        if "inherit" in winners.values():
            return self._inheriting(node, winners)
        if keep:
            self._kept[id(node)] = winners
        return winners

    def _winners(self, node: Node) -> Declarations:
        winners = {name: value for name, value in node.attrib.items() if name in PRESENTATION}
        rules = self._rules.get(id(node))
        style = node.attrib.get("style")
        layers = [rules] if rules else []
        if style:
            layers.append(parse_inline(style))
        for rank in (0, 1):
            for layer in layers:
                add(winners, layer[rank])
        return winners

    def _inheriting(self, node: Node, winners: Declarations) -> Declarations:
        """Return the declarations of an element with those that it takes from the element around it, and keep them."""
        waiting = [(node, winners)]
        found: Declarations = {}
        while (around := self._tree.parent(node)) is not None:
            node = around
            found = self._kept.get(id(node)) or self._winners(node)
            if id(node) in self._kept or "inherit" not in found.values():
                self._kept[id(node)] = found
                break
            waiting.append((node, found))
            found = {}
        for node, winners in reversed(waiting):
            asking = {name for name in _OWN.intersection(winners) if winners[name] == "inherit"}
            winners = {name: value for name, value in winners.items() if name not in asking}
            winners |= {name: found[name] for name in asking.intersection(found)}
            found = self._kept[id(node)] = winners
        return found


def _is_css(node: Node) -> bool:
    kind = node.get("type", "") or ""
    media = (node.get("media", "") or "").strip().lower()
    if kind.strip().lower() not in ("", "text/css"):
        return False
    if media in ("", "all", "screen"):
        return True
    from shapeblend_cli.svg.styles import stylesheets

    return stylesheets.medium(media) in stylesheets.MEDIA


def in_force(
    cascade: Cascade, nodes: Iterable[Node], note: Callable[[str], None], around: Inherited = INITIAL
) -> Inherited:
    """Return what the last of some elements has, each of which is in the one before, and hands on."""
    for node in nodes:
        declared = cascade.declared(node, keep=True)
        around = with_variables(around, declared)
        around = inherit(around, substitute(declared, around.variables), note)
    return around


def with_variables(inherited: Inherited, declared: Declarations) -> Inherited:
    """Return the properties in force with the custom properties that an element declares."""
    own = {name: value for name, value in declared.items() if name.startswith("--")}
    if not own:
        return inherited
    variables = {**inherited.variables, **own}
    check_limit(len(variables), MAX_VARIABLES, "custom properties")
    return inherited._replace(variables=variables)


def inherit(parent: Inherited, declared: Declarations, note: Callable[[str], None]) -> Inherited:
    """Return the inherited properties of an element.

    `note` takes a phrase on each declaration that cannot be read; browsers ignore these as well.
    """
    changed: dict[str, Any] = {}
    font_size = parent.font_size
    if "marker" in declared:
        declared = {**dict.fromkeys(MARKERS, declared["marker"]), **declared}
    if not TEXT.isdisjoint(declared):
        declared = _with_font(declared)
        changed["text"] = _text(parent.text, declared)
    # Lengths in em need the font size first.
    for name in sorted((name for name in declared if name in _FIELDS), key=lambda name: name != "font-size"):
        text = declared[name].strip()
        keyword = text.lower()
        if keyword in _PARENTS:
            continue
        field = _FIELDS[name]
        value = getattr(INITIAL, field) if keyword == "initial" else _value(name, text, parent, font_size)
        if value is None:
            note(f"{name} cannot be read")
            continue
        if name == "font-size":
            font_size = value
        if name == "color" and keyword != "currentcolor":
            changed["has_color"] = True
        changed[field] = value
    return parent._replace(**changed) if changed else parent


def _value(name: str, text: str, parent: Inherited, font_size: float) -> Any:
    keyword = text.lower()
    if name in ("fill", "stroke") and keyword in CONTEXT:
        return parent.context[CONTEXT.index(keyword)]
    if name == "color" and keyword == "currentcolor":
        return parent.color
    return inherited_value(name, text, font_size)


def _with_font(declared: Declarations) -> Declarations:
    """Return declarations with those that ``font`` stands for; others of the same element come after it."""
    match = re.fullmatch(_FONT, declared.get("font", "").strip())
    if match is None:
        return declared
    words = match[1].lower().split()
    weights = [word for word in words if word[0].isdigit() or word in ("bold", "bolder", "lighter")]
    slants = [word for word in words if word in ("italic", "oblique")]
    meant = {
        "font-style": (slants or ["normal"])[0],
        "font-weight": (weights or ["normal"])[0],
        "font-size": match[2],
        "font-family": match[3],
    }
    return {**meant, **declared}


def _text(parent: Mapping[str, str], declared: Declarations) -> Mapping[str, str]:
    """Return the properties of text; ``bolder`` and ``lighter`` go by the weight around."""
    found = {**parent}
    for name in TEXT.intersection(declared):
        value = declared[name].strip()
        keyword = value.lower()
        if keyword == "initial":
            found.pop(name, None)
        elif name == "font-weight" and keyword in ("bolder", "lighter"):
            is_bold = parent.get(name, "400").strip().lower() in ("bold", "600", "700", "800", "900")
            found[name] = (
                "700"
                if (keyword == "bolder") != is_bold
                else "900"
                if is_bold and keyword == "bolder"
                else "400"
            )
        elif keyword not in _PARENTS:
            found[name] = value
    return found
