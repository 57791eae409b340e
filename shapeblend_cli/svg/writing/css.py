"""SVG documents that are animated by CSS."""

from __future__ import annotations

import zlib
from collections.abc import Mapping, Sequence
from typing import NamedTuple
from xml.etree.ElementTree import Element

from shapeblend_cli.model import Box, KeyframedShape, Page
from shapeblend_cli.options.easing import FOREVER, PINGPONG, Timing
from shapeblend_cli.svg.writing import document
from shapeblend_cli.svg.writing.animation import (
    COLOURS,
    TIME_DIGITS,
    Moment,
    Values,
    attribute_values,
    image_values,
    moments,
    resting,
)
from shapeblend_cli.svg.writing.paint import Regions, add_region, link_attributes
from shapeblend_cli.svg.writing.rounding import number


def css_svg(
    shapes: Sequence[KeyframedShape], view: Box, timing: Timing, decimals: int, page: Page | None = None
) -> str:
    """Return an SVG document animated by CSS; with prefers-reduced-motion it shows A at rest.

    Gradients become plain colours, and there is one view, since CSS can animate neither. The shapes are in paint order.
    """
    values_by_shape = [_values_of(shape, decimals) for shape in shapes]
    # Names of its own, so that several drawings can stand in one page.
    keys = [{name: values.keys for name, values in attributes.items()} for attributes in values_by_shape]
    curved = [
        section
        for attributes in values_by_shape
        if "d" in attributes
        for section in attributes["d"].waypoints
        if section
    ]
    prefix = f"b{zlib.crc32(repr((keys, timing, *curved)).encode()):08x}"
    last = max(shape.first + len(shape.keys) for shape in shapes) - 1
    clock = _Clock.of(timing, last)
    drawing = document.empty(view, decimals, page)
    tree = document.Tree.of(drawing, shapes)
    rules: list[str] = []

    def add_clip(element: Element, clip: Sequence[KeyframedShape]) -> None:
        for k, shape in enumerate(clip):
            values, own = attribute_values(shape, decimals)["d"], f"{element.get('id')}-{k}"
            add_region(element, {"class": own, "d": values.keys[0]}, shape.keys[0].style.fill_rule)
            if not values.is_constant:
                timed = _declarations("d", moments(values, timing.ease, shape.first), clock)
                clip_rules.extend([_keyframes(own, timed), f".{own}{{animation:{own} {clock.run} linear}}"])

    clip_rules: list[str] = []
    regions = Regions(tree.ids, add_clip, f"{prefix}-clip")
    for k, (shape, attributes) in enumerate(zip(shapes, values_by_shape, strict=True)):
        name = f"{prefix}-{k}"
        animations = _animate(name, shape, attributes, clock, rules)
        start = {attribute: values.keys[0] for attribute, values in attributes.items()}
        clipped, picture = regions.attributes(shape.clips), shape.keys[0].style.picture
        if picture is None:
            path = document.new("path", {"class": name, **clipped, **start})
        else:
            placed = {**link_attributes(picture), **image_values(shape, decimals, boxes=False).first}
            path = document.new("image", {"class": name, **placed})
        if len(shape.keys) <= last:
            begin, until = shape.first, shape.first + len(shape.keys) - 1
            visible = {0.0: ["visibility:hidden"], clock.share(timing.when(begin)): ["visibility:visible"]}
            if until < last:
                visible[clock.share(timing.when(until))] = ["visibility:hidden"]
            rules.append(_keyframes(f"{name}-shown", visible))
            animations.append(f"{name}-shown {clock.run} step-end")
            document.put(path, {"visibility": "hidden" if shape.first else "visible"})
        if animations:
            rules.append(f".{name}{{animation:{','.join(animations)}}}")
        if picture is not None:
            path = document.clipped(path, clipped.get("clip_path"))
        tree.add(path, shape.groups, shape.name)
    rules += clip_rules
    rules.append(f"@media (prefers-reduced-motion:reduce){{[class^={prefix}]{{animation:none!important}}}}")
    return document.text(drawing, style="\n".join(["", *rules, ""]), definitions=regions.elements)


def _values_of(shape: KeyframedShape, decimals: int) -> dict[str, Values]:
    """Return the values of the attributes of a path, or of a picture, as style sheets have them."""
    if shape.keys[0].style.picture is None:
        return attribute_values(shape, decimals)
    found = image_values(shape, decimals, boxes=False)
    units = {"translate": "px", "rotate": "deg", "skewX": "deg", "scale": ""}

    def joined(texts: Sequence[str]) -> str:
        return " ".join(
            f"{kind}({','.join(part + units[kind] for part in text.split(' '))})"
            for (kind, _), text in zip(found.transforms, texts, strict=True)
        )

    every = [values for _, values in found.transforms]
    keys = list(map(joined, zip(*(values.keys for values in every), strict=True)))
    waypoints = [
        [(parts[0][0], joined([text for _, text in parts])) for parts in zip(*sections, strict=True)]
        for sections in zip(*(values.waypoints for values in every), strict=True)
    ]
    return {**found.attributes, "transform": Values(keys, waypoints)}


class _Clock(NamedTuple):
    """The times of a run forwards, in times of `timing.seconds`, as shares of it.

    One that alternates turns round in the middle of its rests.
    """

    timing: Timing
    begin: float
    end: float

    @classmethod
    def of(cls, timing: Timing, last: int) -> _Clock:
        """Return the clock of a run to a last key."""
        cuts = [rest / (2.0 * timing.seconds) if timing.is_pingpong else 0.0 for rest in timing.hold]
        return cls(timing, cuts[0], timing.when(last, leaves=True) - cuts[1])

    @property
    def run(self) -> str:
        """How long it takes, and how often it runs."""
        endless: dict[int | str, str] = {FOREVER: "infinite", PINGPONG: "infinite alternate"}
        times = endless.get(self.timing.repeat, f"{self.timing.repeat} forwards")
        wait = f" {number(self.timing.delay, 4)}s" if self.timing.delay else ""
        return f"{number(self.timing.seconds * (self.end - self.begin), 4)}s{wait} {times}"

    def share(self, time: float) -> float:
        """Return a time as a share of the run."""
        return min(max(time - self.begin, 0.0) / (self.end - self.begin), 1.0)


def _animate(
    name: str, shape: KeyframedShape, attributes: Mapping[str, Values], clock: _Clock, rules: list[str]
) -> list[str]:
    """Add the rules of a shape's attributes, and return its animations."""
    timing = clock.timing
    animations = []
    places = range(shape.first, shape.first + len(shape.keys))
    times = [[clock.share(timing.when(k, leaves=leaves)) for k in places] for leaves in (False, True)]
    at_keys: dict[float, list[str]] = {time: [] for time in (*times[0], *times[1])}
    for attribute, values in attributes.items():
        if values.is_constant:
            continue
        if attribute in COLOURS or any(values.waypoints):
            timed = _declarations(attribute, moments(values, timing.ease, shape.first), clock)
            rules.append(_keyframes(f"{name}-{attribute}", timed))
            animations.append(f"{name}-{attribute} {clock.run} linear")
        else:
            for reached, left, value in zip(*times, values.keys, strict=True):
                for time in dict.fromkeys((reached, left)):
                    at_keys[time].append(declaration(attribute, value))
    if at_keys[times[0][0]]:
        rules.append(_keyframes(name, at_keys))
        animations.append(f"{name} {clock.run} {timing.ease.css()}")
    return animations


def _keyframes(name: str, declarations: dict[float, list[str]]) -> str:
    """Return a ``@keyframes`` rule; the first declarations hold from the beginning, the last to the end."""
    times = sorted(declarations)
    rules = []
    for time in times:
        at = [f"{number(100.0 * time, TIME_DIGITS)}%"]
        if time == times[0] and time > 0.0:
            at.insert(0, "0%")
        if time == times[-1] and time < 1.0:
            at.append("100%")
        rules.append(f"{','.join(at)}{{{';'.join(declarations[time])}}}")
    return f"@keyframes {name}{{{''.join(rules)}}}"


def _declarations(name: str, timed: Sequence[Moment], clock: _Clock) -> dict[float, list[str]]:
    """Return declarations of an attribute by time, as a share of the run, with their easing."""
    declarations = {}
    stops = resting(timed, clock.timing)
    for moment in stops:
        time = clock.share(moment.time)
        declarations[time] = [declaration(name, moment.value)]
        if not moment.ease.is_linear and moment is not stops[-1]:
            declarations[time].append(f"animation-timing-function:{moment.ease.css()}")
    return declarations


def declaration(name: str, value: str) -> str:
    """Return the declaration of an attribute in a style sheet."""
    return f'd:path("{value}")' if name == "d" else f"{name.replace('_', '-')}:{value}"
