"""A drawing of several states, from any to any: as an SVG document, or as a custom element of a web page.

Every path has the same commands in all states, so that CSS transitions go from each to each, and turn round wherever
they are.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple
from xml.etree.ElementTree import Element

from shapeblend_cli.model import Box, KeyframedShape, Page, Style
from shapeblend_cli.options.easing import Easing
from shapeblend_cli.paint.styles import keyed_styles
from shapeblend_cli.svg.writing import document
from shapeblend_cli.svg.writing.css import declaration
from shapeblend_cli.svg.writing.paint import STROKE_LENGTHS, paint_attributes, without_defaults
from shapeblend_cli.svg.writing.path_data import path_data
from shapeblend_cli.svg.writing.rounding import number

CLICK, HOVER = "click", "hover"
ATTRIBUTE = 'this.getAttribute("trigger")'

_ON = "var l=%s,s=this.dataset;s.state=l[(l.indexOf(s.state)+1)%%l.length]"
_KEYS = "if(/^( |Enter)$/.test(event.key)){event.preventDefault();this.onclick(event)}"
_TO = "this.dataset.state=%s"


class States(NamedTuple):
    """The shapes of each state, and the timing from state to state."""

    shapes: Sequence[KeyframedShape]  # a key for each state
    names: Sequence[str]
    view: Box
    page: Page
    seconds: float
    ease: Easing
    decimals: int

    @property
    def prefix(self) -> str:
        """The beginning of the names of its classes."""
        return f"s{document.fingerprint(self.shapes, self.names, self.seconds)}"


def states_svg(states: States, trigger: str | None) -> str:
    """Return an SVG document that shows the state of its attribute ``data-state``.

    With a trigger it goes on to the next state by a click, or to the second one while it is pointed at.
    """
    drawing, rules = _drawing(states, with_data=False)
    first, second = (json.dumps(name) for name in states.names[:2])
    given = {"role": "img", "aria-label": states.page.called}
    if trigger == CLICK:
        given |= {"role": "button", "tabindex": "0", "style": "cursor:pointer"}
        given |= {"onclick": _ON % json.dumps(list(states.names)), "onkeydown": _KEYS}
    elif trigger == HOVER:
        given |= {"tabindex": "0"}
        given |= dict.fromkeys(("onpointerenter", "onfocus"), _TO % second)
        given |= dict.fromkeys(("onpointerleave", "onblur"), _TO % first)
        given["onfocus"] = f"if(this.matches(':focus-visible')){given['onfocus']}"
    document.put(drawing, given)
    return document.text(drawing, style="\n".join(["", *rules, ""]))


def states_js(states: States, element: str, trigger: str | None = None) -> str:
    """Return a JavaScript module that defines a custom element of some name.

    A trigger is the one of elements without an attribute for it.
    """
    drawing, rules = _drawing(states, with_data=True)
    document.put(drawing, {"aria-hidden": "true"})  # the element around it says what it is
    for name in ("width", "height"):
        drawing.attrib.pop(name, None)
    text = Path(__file__).with_name("component.js").read_text(encoding="utf-8")
    values = {
        "/*STYLE*/": json.dumps("".join(rules)),
        "/*STATES*/": json.dumps(list(states.names)),
        "/*BODY*/": json.dumps(document.text(drawing).strip()),
        "/*TITLE*/": json.dumps(states.page.called),
        "/*MILLISECONDS*/": number(1000.0 * states.seconds, 1),
        "/*NAME*/": json.dumps(element),
        "FILE": f"{element}.js",
        "ELEMENT": element,
        "STATE": states.names[-1],
    }
    head, *rest = text.split("const sheet", 1)
    for key in ("FILE", "ELEMENT", "STATE"):
        head = head.replace(f'{key}"', f'{values[key]}"').replace(f"<{key}", f"<{values[key]}")
        head = head.replace(f"</{key}", f"</{values[key]}")
    body = "const sheet" + rest[0]
    for key, value in values.items():
        if key.startswith("/*"):
            body = body.replace(key, value.replace("</", "<\\/"))  # no end of a script in a page
    if trigger:
        body = body.replace(ATTRIBUTE, f"{ATTRIBUTE} ?? {json.dumps(trigger)}", 1)
    return head + body


def _drawing(states: States, *, with_data: bool) -> tuple[Element, list[str]]:
    """Return the drawing in its first state, and the rules of its style sheet."""
    prefix = states.prefix
    drawing = document.empty_and_called(states.view, states.decimals, states.page)
    document.put(drawing, {"class": prefix, "data-state": states.names[0]})
    tree = document.Tree.of(drawing, states.shapes)
    rules = []
    for k, shape in enumerate(states.shapes):
        values = [
            {"d": path_data(key.paths, states.decimals), **paint_attributes(style, states.decimals)}
            for key, style in zip(shape.keys, _plain([key.style for key in shape.keys]), strict=True)
        ]
        written = {attribute for each in values for attribute in without_defaults(each)}
        changing = [a for a in values[0] if len({each[a] for each in values}) > 1]
        own = f"{prefix}-{k}"
        if changing:
            at_once = STROKE_LENGTHS if "vector_effect" in changing else ()
            transition = ",".join(a.replace("_", "-") for a in changing if a not in at_once)
            timing = f"{number(states.seconds, 4)}s {states.ease.css()}"
            rules.append(
                f".{own}{{transition-property:{transition};transition-duration:{timing.split()[0]};"
                f"transition-timing-function:{timing.split()[1]}}}"
            )
            for state, each in zip(states.names, values, strict=True):
                declared = ";".join(declaration(a, each[a]) for a in changing)
                rules.append(f".{prefix}[data-state={json.dumps(state)}] .{own}{{{declared}}}")
        given = {a: values[0][a] for a in values[0] if a in written or a in changing}
        path = document.new("path", {"class": own, **given})
        if with_data and "d" in changing:
            data = json.dumps([each["d"] for each in values], separators=(",", ":"))
            document.put(path, {"data-d": data})
        tree.add(path, shape.groups, shape.name)
    rules.append(f".{prefix}:focus:not(:focus-visible){{outline:none}}")
    rules.append(f"@media (prefers-reduced-motion:reduce){{[class^={prefix}]{{transition:none!important}}}}")
    return drawing, rules


def _plain(styles: Sequence[Style]) -> list[Style]:
    """Return styles that transitions can go between: plain colours, and paint that fades where some have none."""
    plain = [
        style._replace(fill_gradient=None, stroke_gradient=None, stroke_dasharray=()) for style in styles
    ]
    coats = keyed_styles(plain)
    assert coats is not None, "they have neither gradients nor dashes"
    dashes = [(style.stroke_dasharray, style.stroke_dashoffset) for style in styles]
    return [
        style._replace(stroke_dasharray=dash, stroke_dashoffset=offset)
        for style, (dash, offset) in zip(coats[-1], dashes, strict=True)
    ]
