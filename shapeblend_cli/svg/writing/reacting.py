"""SVG documents that wait for a trigger, move, and move back: by SMIL, or by CSS transitions.

No script is needed to point at them, to click them or to reach them by keyboard. Only Enter and Space on what moves by
SMIL take a line of script in an attribute, and events of other elements that no other event undoes.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement

from shapeblend_cli.model import Box, Clip, Effect, KeyframedEffect, KeyframedShape, Page, PaintedShape
from shapeblend_cli.options.easing import Easing, Timing
from shapeblend_cli.options.triggers import CLICK, HOVER, Trigger
from shapeblend_cli.svg.writing import document
from shapeblend_cli.svg.writing.animation import COLOURS, DISCRETE, Timeline, Values, Views, attribute_values
from shapeblend_cli.svg.writing.css import declaration
from shapeblend_cli.svg.writing.ids import Ids
from shapeblend_cli.svg.writing.paint import STROKE_LENGTHS, Gradients, Regions, add_region, visible_styles
from shapeblend_cli.svg.writing.path_data import short_path_data
from shapeblend_cli.svg.writing.rounding import number
from shapeblend_cli.svg.writing.smil import add_animated

XHTML = "http://www.w3.org/1999/xhtml"

PRESS = (
    "if(/^( |Enter)$/.test(event.key)){event.preventDefault();for(const r of this.querySelectorAll(':scope>rect[id]'))"
    "if(getComputedStyle(r).display!='none'){r.dispatchEvent(new Event('click',{bubbles:true}));break}}"
)
"""Handler of keys: Enter and Space click the area of the button that is displayed."""

PRESSED = "this.setAttribute('aria-pressed',this.getAttribute('aria-pressed')!='true')"

LISTEN = """\
(function(g){var o=false;function s(e){g.dispatchEvent(new Event(e))}
function f(){var n=document.getElementById(%s);if(n){%s}}
document.readyState=="loading"?document.addEventListener("DOMContentLoaded",f):f()})(document.currentScript.parentNode)"""
"""Script that turns events of another element into events of the drawing."""

IN_TURN = 'n.addEventListener(%s,function(){o=!o;s(o?"forth":"back")})'
"""Listener for an event that goes forth and back in turn."""

EACH = 'n.addEventListener(%s,function(){s("forth")});n.addEventListener(%s,function(){s("back")})'
"""Listeners for an event that goes forth, and its opposite that goes back."""


class Reaction(NamedTuple):
    """Moving shapes, the view of each drawing, the page, and the trigger."""

    shapes: Sequence[KeyframedShape]
    views: Views
    page: Page
    trigger: Trigger

    @property
    def id(self) -> str:
        """An id of its own, a word as SMIL takes it."""
        return f"b{document.fingerprint(self.shapes, self.trigger, self.page.called)}"

    def empty(self, decimals: int) -> Element:
        """Return a drawing of it that draws nothing yet; it has a title."""
        return document.empty_and_called(self.views.boxes[0], decimals, self.page)


def reacting_smil(reaction: Reaction, timing: Timing, decimals: int) -> str:
    """Return an SVG document that goes from the first drawing to the last and back, by SMIL.

    Straight motion that is interrupted goes on from where it is. For those who prefer reduced motion there are both
    drawings, of which one or the other is seen.
    """
    drawing, trigger, name = reaction.empty(decimals), reaction.trigger, reaction.id
    timeline = _ThereAndBack(reaction.views.pairs, timing, *_begins(trigger, name))
    timeline.turns_round = not reaction.views.times
    timeline.add_views(drawing, reaction.views, decimals)
    document.put(drawing, {"role": "presentation"})  # what it is, is said of what is in it
    around = document.new("g", {"id": name, **_role(trigger, reaction.page.called)})
    drawing.append(around)
    area = {**_area(Box.union(reaction.views.boxes), decimals), "fill": "none", "pointer-events": "all"}
    around.append(document.new("rect", area))
    ids = document.ids_of(drawing, reaction.shapes, lambda: f"{name}-")
    moving = document.new("g", {"class": f"{name}-moving"})
    around.append(moving)
    gradients = add_animated(document.Tree(moving, ids), reaction.shapes, timeline, decimals)
    still = document.new("g", {"class": f"{name}-still"})
    around.append(still)
    defined = Gradients(decimals, ids)
    for end in (0, -1):
        group = document.new("g", {"display": "none"} if end else {})
        for kind, display in (("forth", "inline" if end else "none"), ("back", "none" if end else "inline")):
            group.append(timeline.switch(display, kind))
        _add_still(group, reaction, end, defined)
        still.append(group)
    if trigger.kind == CLICK:
        for kind, other in (("forth", "back"), ("back", "forth")):
            shown = {"display": "none"} if kind == "back" else {}
            rect = document.new("rect", {"id": f"{name}{kind}", "style": "cursor:pointer", **area, **shown})
            rect.append(timeline.switch("none", kind))
            rect.append(timeline.switch("inline", other))
            around.append(rect)
    if trigger.name and not _is_declared(trigger):
        script = Element("script")
        events = [json.dumps(event) for event in (trigger.event, trigger.opposite) if event]
        listens = (EACH if trigger.opposite else IN_TURN) % tuple(events)
        script.text = LISTEN % (json.dumps(trigger.name), listens)
        around.append(script)
    style = (
        f"#{name}:focus:not(:focus-visible){{outline:none}}.{name}-still{{display:none}}"
        f"@media (prefers-reduced-motion:reduce){{.{name}-still{{display:inline}}.{name}-moving{{display:none}}}}"
    )
    return document.text(drawing, style=style, definitions=[*gradients, *defined.elements])


def _area(box: Box, decimals: int) -> dict[str, str]:
    names = ("x", "y", "width", "height")
    return {name: number(value, decimals) for name, value in zip(names, box, strict=True)}


def _role(trigger: Trigger, title: str) -> dict[str, str]:
    """Return attributes for screen readers and keyboards."""
    if trigger.kind == CLICK:
        keys = {"onkeydown": PRESS, "onclick": PRESSED}
        return {"role": "button", "tabindex": "0", "aria-pressed": "false", "aria-label": title, **keys}
    focus = {"tabindex": "0"} if trigger.kind == HOVER else {}
    return {"role": "img", "aria-label": title, **focus}


def _is_declared(trigger: Trigger) -> bool:
    """Return whether SMIL alone can wait for an event of another element; browsers split names at hyphens."""
    return trigger.opposite is not None and "-" not in trigger.name


def _begins(trigger: Trigger, name: str) -> tuple[str, str]:
    if trigger.kind == CLICK:
        return f"{name}forth.click", f"{name}back.click"
    if trigger.kind == HOVER:
        return f"{name}.mouseenter;{name}.focusin", f"{name}.mouseleave;{name}.focusout"
    if _is_declared(trigger):
        return f"{trigger.name}.{trigger.event}", f"{trigger.name}.{trigger.opposite}"
    return f"{name}.forth", f"{name}.back"


def _add_still(group: Element, reaction: Reaction, end: int, gradients: Gradients) -> None:
    """Add the shapes as they are in the first drawing, or in the last."""
    last = reaction.views.pairs
    tree = document.Tree(group, Ids())
    for shape in reaction.shapes:
        is_there = shape.first == 0 if end == 0 else shape.first + len(shape.keys) - 1 == last
        painted: PaintedShape = shape.keys[end]
        if is_there and not all(path.is_point for path in painted.paths):
            data = short_path_data(painted.paths, gradients.decimals)
            regions = [_still_region(clip, end) for clip in shape.clips]
            clipped = gradients.clips.attributes(regions)
            around = gradients.around([_still(each, end) for each in shape.effects])
            for style in visible_styles(painted, float(bool(end))):
                if style.picture is not None and style.fill_opacity == 0.0:
                    continue
                element = document.painted(style, {"d": data, **clipped}, gradients)
                tree.add(element, around=around)


def _still_region(clip: Sequence[KeyframedShape], end: int) -> Clip:
    """Return a region as it is at an end."""
    return Clip(tuple(p for s in clip for p in s.keys[end].paths), clip[0].keys[end].style.fill_rule)


def _still(keyed: KeyframedEffect, end: int) -> Effect:
    """Return an effect as it is at an end."""
    effect = keyed.blend.end if end else keyed.blend.start
    return effect._replace(clips=tuple(_still_region(clip, end) for clip in keyed.clips))


class _ThereAndBack(Timeline):
    """Makes two animations of each: one that goes when something begins, and one that comes back."""

    def __init__(self, pairs: int, timing: Timing, forth: str, back: str) -> None:
        super().__init__(pairs, timing._replace(repeat=1))
        self.turns_round = True
        self._begins = {"forth": forth, "back": back}

    def animate(self, element: Element | list[Element], name: str, values: Values) -> None:
        """Animate an attribute; between two keys colours go straight, so that they can turn round on the way."""
        if self.turns_round and name in COLOURS and len(values.keys) == 2:
            values = values._replace(waypoints=[()])
        super().animate(element, name, values)

    def switch(self, display: str, kind: str) -> Element:
        """Return the animation that shows or hides an element at once."""
        run = {"attributeName": "display", "to": display, "begin": self._begins[kind], "fill": "freeze"}
        return document.new("set", run)

    def _add(
        self,
        element: Element | list[Element],
        tag: str,
        given: dict[str, str],
        texts: Sequence[str],
        extra: dict[str, str],
    ) -> None:
        # Without a start an animation begins with what is there, on the way too; only two values can do that.
        is_straight = len(texts) == 2 and tag == "animate" and extra.get("calcMode") != "discrete"
        for kind in ("forth", "back"):
            values, own = (texts, extra) if kind == "forth" else (texts[::-1], _reversed(extra))
            way = {"to": values[-1]} if is_straight else {"values": ";".join(values)}
            run = {"dur": self.duration, "begin": self._begins[kind], "fill": "freeze"}
            element.append(document.new(tag, {**given, **way, **run, **own}))


def _reversed(extra: dict[str, str]) -> dict[str, str]:
    """Return times and easing of the way back."""
    changed = dict(extra)
    times = [1.0 - float(time) for time in extra.get("keyTimes", "").split(";") if time][::-1]
    if extra.get("calcMode") == "discrete":
        # A value is held until the next one; the last one until the end.
        times = [0.0, *times[:-1]]
    if times:
        changed["keyTimes"] = ";".join(number(time, 5) for time in times)
    if "keySplines" in extra:
        splines = [[float(value) for value in spline.split()] for spline in extra["keySplines"].split(";")]
        mirrored = [(1.0 - x2, 1.0 - y2, 1.0 - x1, 1.0 - y1) for x1, y1, x2, y2 in splines[::-1]]
        changed["keySplines"] = ";".join(
            " ".join(number(value, 4) for value in spline) for spline in mirrored
        )
    return changed


def reacting_css(reaction: Reaction, timing: Timing, ease: Easing, decimals: int) -> str:
    """Return an SVG document that goes from one drawing to another and back, by CSS transitions.

    They turn round wherever they are. A click is that on a check box, which keyboards reach too. With
    prefers-reduced-motion the other drawing is there at once.
    """
    drawing, trigger, name = reaction.empty(decimals), reaction.trigger, reaction.id
    document.put(drawing, {"class": name})
    is_click = trigger.kind == CLICK
    if not is_click:
        document.put(drawing, _role(trigger, reaction.page.called))
    tree = document.Tree.of(drawing, reaction.shapes)
    active = [f".{name}:has(:checked)"] if is_click else [f".{name}:hover", f".{name}:focus-visible"]
    rules: list[str] = []

    def move(own: str, shape: KeyframedShape, values: Mapping[str, Values]) -> dict[str, str]:
        """Add the rules by which a path of a class moves, and return its attributes at rest."""
        start = {attribute: value.keys[0] for attribute, value in values.items()}
        changing = [attribute for attribute, value in values.items() if not value.is_constant]
        if changing:
            there, back = (
                _transitions(shape, changing, timing.seconds, ease, is_back=is_back)
                for is_back in (False, True)
            )
            at_rest = [declaration(attribute, start[attribute]) for attribute in changing]
            moved = [declaration(attribute, values[attribute].keys[-1]) for attribute in changing]
            rules.append(f".{own}{{{';'.join([*at_rest, back])}}}")
            rules.append(f"{','.join(f'{one} .{own}' for one in active)}{{{';'.join([*moved, there])}}}")
        return {"class": own, **start}

    def add_clip(element: Element, clip: Sequence[KeyframedShape]) -> None:
        for k, shape in enumerate(clip):
            outline = {"d": attribute_values(shape, decimals)["d"]}
            add_region(
                element, move(f"{element.get('id')}-{k}", shape, outline), shape.keys[0].style.fill_rule
            )

    regions = Regions(tree.ids, add_clip, f"{name}-clip")
    for k, shape in enumerate(reaction.shapes):
        start = move(f"{name}-{k}", shape, attribute_values(shape, decimals))
        path = document.new("path", {**start, **regions.attributes(shape.clips)})
        tree.add(path, shape.groups, shape.name)
    if is_click:
        drawing.append(_check_box(reaction, decimals))
        rules.append(f".{name}:has(:focus-visible){{outline:2px solid}}")
    rules.append(f"@media (prefers-reduced-motion:reduce){{[class^={name}]{{transition:none!important}}}}")
    return document.text(drawing, style="\n".join(["", *rules, ""]), definitions=regions.elements)


def _check_box(reaction: Reaction, decimals: int) -> Element:
    """Return a check box over all of the drawing, which is not seen."""
    holder = Element("foreignObject", _area(Box.union(reaction.views.boxes), decimals))
    given = {"type": "checkbox", "role": "switch", "aria-label": reaction.page.called}
    style = "width:100%;height:100%;margin:0;opacity:0;cursor:pointer"
    SubElement(holder, "input", {"xmlns": XHTML, **given, "style": style})
    return holder


def _transitions(
    shape: KeyframedShape, changing: Sequence[str], seconds: float, ease: Easing, *, is_back: bool
) -> str:
    """Return the transitions of attributes, forth or back; attributes without values in between change half way."""
    ease = ease.mirrored() if is_back else ease
    fading = shape.fading[0] if shape.fading else ()
    parts = []
    for attribute in changing:
        name = attribute.replace("_", "-")
        begin, until = 0.0, 1.0
        if fading and attribute.endswith("opacity"):
            begin, until = _span(shape, attribute)
            begin, until = (1.0 - until, 1.0 - begin) if is_back else (begin, until)
            begin, until = ease.time_of(begin), ease.time_of(until)
        if attribute in DISCRETE or ("vector_effect" in changing and attribute in STROKE_LENGTHS):
            begin = until = ease.time_of(0.5)
        length, delay = (number(seconds * share, 4) for share in (until - begin, begin))
        wait = f" {delay}s" if begin else ""
        curve = ease.css() if until - begin == 1.0 else "linear"
        parts.append(f"{name} {length}s {curve}{wait}")
    return f"transition:{','.join(parts)}"


def _span(shape: KeyframedShape, attribute: str) -> tuple[float, float]:
    stops = [(0.0, shape.keys[0].style), *shape.fading[0], (1.0, shape.keys[-1].style)]
    values = [(t, getattr(style, attribute)) for t, style in stops]
    changes = [(p[0], q[0]) for p, q in pairwise(values) if p[1] != q[1]]
    return (changes[0][0], changes[-1][1]) if changes else (0.0, 1.0)
