"""SVG documents that are animated by CSS."""

from __future__ import annotations

import zlib
from collections.abc import Mapping, Sequence
from functools import partial
from itertools import pairwise
from typing import NamedTuple
from xml.etree.ElementTree import Element

from shapeblend_cli.model import Box, Effect, KeyframedEffect, KeyframedShape, MaskLayer, Page, Pattern
from shapeblend_cli.model.words import Words, words_in
from shapeblend_cli.options.easing import FOREVER, PINGPONG, Timing
from shapeblend_cli.paint.gradients import blend_patterns
from shapeblend_cli.svg.writing import document
from shapeblend_cli.svg.writing.animation import (
    COLOURS,
    TIME_DIGITS,
    Moment,
    Values,
    attribute_values,
    delayed,
    image_values,
    moments,
    moving_text,
    resting,
    text_values,
    values_between,
)
from shapeblend_cli.svg.writing.groups import effect_attributes
from shapeblend_cli.svg.writing.paint import Around, Gradients, Regions, add_region, link_attributes
from shapeblend_cli.svg.writing.rounding import number

FILTER_STEPS = 24
"""Number of filters from one drawing to the next, each of which is seen for a moment."""


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
    effects = [each.blend for shape in shapes for each in shape.effects]
    prefix = f"b{zlib.crc32(repr((keys, timing, *curved, *effects)).encode()):08x}"
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
    contents = Gradients(decimals, tree.ids, f"{prefix}-")
    layers = _AnimatedEffects(prefix, clock, last + 1, contents, regions)
    for k, (shape, attributes) in enumerate(zip(shapes, values_by_shape, strict=True)):
        name = f"{prefix}-{k}"
        attributes |= _patterns(shape, contents)
        animations = _animate(name, shape, attributes, clock, rules)
        start = {attribute: values.keys[0] for attribute, values in attributes.items()}
        path = _element(shape, {"class": name, **start}, regions, contents)
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
        if shape.keys[0].style.picture is not None:
            path = document.clipped(path, regions.attributes(shape.clips).get("clip_path"))
        tree.add(path, shape.groups, shape.name, layers.around(shape.effects))
    rules += [*clip_rules, *layers.rules]
    rules.append(f"@media (prefers-reduced-motion:reduce){{[class^={prefix}]{{animation:none!important}}}}")
    definitions = [*regions.elements, *contents.elements, *layers.masks]
    return document.text(drawing, style="\n".join(["", *rules, ""]), definitions=definitions)


def _element(shape: KeyframedShape, start: dict[str, str], regions: Regions, contents: Gradients) -> Element:
    """Return the path of a shape, which is clipped, or its picture, which is not, as they are at first."""
    picture, decimals = shape.keys[0].style.picture, contents.decimals
    if picture is None:
        return document.new("path", {**start, **regions.attributes(shape.clips)})
    if isinstance(picture.raster, Words):
        text = moving_text(shape.keys[0].style, text_values(shape, decimals), contents)
        document.put(text, {"class": start["class"]})
        return text
    placed = image_values(shape, decimals, boxes=False).first
    return document.new("image", {"class": start["class"], **link_attributes(picture), **placed})


def _patterns(shape: KeyframedShape, contents: Gradients) -> dict[str, Values]:
    """Return the values of paints that are patterns; of one that moves there is another in each of many steps."""
    found = {}
    for paint in ("fill", "stroke"):
        patterns = [getattr(key.style, f"{paint}_gradient") for key in shape.keys]
        if not all(isinstance(pattern, Pattern) for pattern in patterns):
            continue
        waypoints = [
            [
                (n / FILTER_STEPS, contents.link(between))
                for n in range(1, FILTER_STEPS if start != end else 1)
                if (between := blend_patterns(start, end, n / FILTER_STEPS)) is not None
            ]
            for start, end in pairwise(patterns)
        ]
        found[paint] = delayed(Values(list(map(contents.link, patterns)), waypoints), shape.spans)
    return found


class _AnimatedEffects:
    """The groups of effects that are animated, with the rules for them."""

    def __init__(
        self, prefix: str, clock: _Clock, drawings: int, contents: Gradients, regions: Regions
    ) -> None:
        self.rules: list[str] = []
        self.masks: list[Element] = []
        self._contents = contents  # filters, and what is in masks
        self._names: dict[int, str] = {}
        self._prefix = prefix
        self._clock = clock
        self._drawings = drawings
        self._regions = regions

    def around(self, effects: Sequence[KeyframedEffect]) -> list[Around]:
        """Return groups for the effects around a shape, the outermost first."""
        return [
            Around(each.blend.number, each.blend.start.place, partial(self._group, each)) for each in effects
        ]

    def _group(self, keyed: KeyframedEffect) -> Element:
        """Return the group of an effect. CSS animates no filters, so there is another one in each of many steps."""
        from shapeblend_cli.paint.effects import keyed_effects

        times, effects = keyed_effects(keyed, self._drawings, FILTER_STEPS)
        end = keyed.first + 1
        # Browsers paint blots where a filter moves over a group of which nothing is visible.
        shown = [keyed.first <= time < end or time == end == self._drawings - 1 for time in times]
        links = [
            effect.filter and self._contents.filters.link(effect.filter) if is_shown else None
            for effect, is_shown in zip(effects, shown, strict=True)
        ]
        name = f"{self._prefix}-effect-{len(self.rules)}"
        start = effect_attributes(effects[0], links[0], self._regions.attributes(keyed.clips))
        masked = {} if effects[0].mask is None else {"mask": self._mask(keyed.blend.number, times, effects)}
        element = document.new("g", {"class": name, **start, **masked})
        texts = {
            "opacity": [number(effect.opacity, 4) for effect in effects],
            "filter": [link or "none" for link in links],
            "mix-blend-mode": [effect.mode for effect in effects],
            "isolation": ["isolate" if effect.isolates else "auto" for effect in effects],
        }
        self._animate(name, texts, times)
        return element

    def _mask(self, known: int, times: Sequence[float], effects: Sequence[Effect]) -> str:
        """Return the value of ``mask`` that refers to an animated mask, which is defined once."""
        if known in self._names:
            return f"url(#{self._names[known]})"
        own = self._names[known] = f"{self._prefix}-mask-{len(self._names) + 1}"
        masks = [effect.mask for effect in effects if effect.mask is not None]
        element, written = self._contents.mask_element(own, masks[0])
        for k, (holder, place) in enumerate(written):
            layers = [mask.layers[k] for mask in masks]
            texts = {
                "opacity": (holder, [number(layer.share, 4) for layer in layers]),
                "transform": (place, [_place(layer) for layer in layers]),
            }
            for attribute, (moved, values) in texts.items():
                if len(set(values)) > 1:
                    document.put(moved, {"class": f"{own}-{k}-{attribute}"})
                    self._animate(f"{own}-{k}-{attribute}", {attribute: values}, times)
        self.masks.append(element)
        return f"url(#{own})"

    def _animate(self, name: str, texts: Mapping[str, Sequence[str]], times: Sequence[float]) -> None:
        """Add the rules of a class whose properties change."""
        animations = []
        for attribute, values in texts.items():
            if len(set(values)) == 1:
                continue
            timed = moments(values_between(attribute, values, times), self._clock.timing.ease)
            own = f"{name}-{attribute}"
            if attribute in ("opacity", "transform"):
                declared, pace = _declarations(attribute, timed, self._clock), "linear"
            else:
                stops = resting(timed, self._clock.timing)
                declared, pace = (
                    {self._clock.share(m.time): [declaration(attribute, m.value)] for m in stops},
                    "step-end",
                )
            self.rules.append(_keyframes(own, declared))
            animations.append(f"{own} {self._clock.run} {pace}")
        if animations:
            self.rules.append(f".{name}{{animation:{','.join(animations)}}}")


def _place(layer: MaskLayer) -> str:
    x, y = (number(value, 4) for value in (layer.shift.real, layer.shift.imag))
    return f"translate({x}px,{y}px) scale({number(layer.scale[0], 6)},{number(layer.scale[1], 6)})"


def _values_of(shape: KeyframedShape, decimals: int) -> dict[str, Values]:
    """Return the values of the attributes of a path, or of a picture, as style sheets have them."""
    if shape.keys[0].style.picture is None:
        return attribute_values(shape, decimals)
    is_text = words_in(shape.keys[0].style.picture) is not None
    found = text_values(shape, decimals) if is_text else image_values(shape, decimals, boxes=False)
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
        # The first half of the first rest is in no run.
        delay = self.timing.delay + self.timing.seconds * self.begin
        wait = f" {number(delay, 4)}s" if delay else ""
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
