"""Filters, opacity and blend modes of groups, as SVG elements and attributes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element, SubElement

from shapeblend_cli.model import NORMAL, SOURCE, Content, Effect, Filter, Mask, MaskLayer, Raster, Step, View
from shapeblend_cli.svg.writing.rounding import number

if TYPE_CHECKING:
    from shapeblend_cli.svg.writing.ids import Ids

LENGTHS = frozenset(
    "stdDeviation radius dx dy scale surfaceScale x y z pointsAtX pointsAtY pointsAtZ".split()
)
"""Numbers of a filter that are lengths or places."""

WHOLE_NUMBERS = frozenset(("order", "numOctaves"))

DIGITS = 5
"""Decimals of numbers that are no lengths."""


def is_single(filters: Sequence[Filter]) -> list[bool]:
    """Return for each step of filters of one kind whether its pairs of numbers may be written as one number."""
    return [
        all(values[0] == values[-1] for each in steps for _, values in each.numbers if len(values) == 2)
        for steps in zip(*(each.steps for each in filters), strict=True)
    ]


def step_attributes(step: Step, decimals: int, single: bool) -> dict[str, str]:
    """Return the attributes of a step that may change, by their names in SVG."""
    found = {}
    for name, values in step.numbers:
        digits = decimals + 1 if name in LENGTHS else 0 if name in WHOLE_NUMBERS else DIGITS
        kept = values[:1] if single and len(values) == 2 else values
        found[name] = " ".join(number(value, digits) for value in kept)
    found |= dict(step.colours)
    if step.region is not None:
        found |= _box(step.region, decimals)
    return found


def _box(box: Sequence[float], decimals: int) -> dict[str, str]:
    return {
        name: number(value, decimals) for name, value in zip(("x", "y", "width", "height"), box, strict=True)
    }


def filter_attributes(made: Filter, decimals: int) -> dict[str, str]:
    """Return the attributes of a filter that may change."""
    return _box(made.region, decimals)


def filter_element(
    name: str, made: Filter, decimals: int, single: Sequence[bool], link: Callable[[Raster | View], str]
) -> Element:
    """Return the definition of a filter; `link` makes links to what it shows."""
    spaces = {dict(step.words).get("color-interpolation-filters") for step in made.steps}
    common = {"color-interpolation-filters": "sRGB"} if spaces == {"sRGB"} else {}
    region = filter_attributes(made, decimals)
    element = Element("filter", {"id": name, "filterUnits": "userSpaceOnUse", **region, **common})
    named = {
        each
        for k, step in enumerate(made.steps)
        for n, each in enumerate(step.inputs)
        if isinstance(each, int) and (each != k - 1 or n or step.tag == "feMerge")
    }
    for k, (step, is_one) in enumerate(zip(made.steps, single, strict=True)):
        words = {key: value for key, value in step.words if common.get(key) != value}
        result = {"result": f"s{k}"} if k in named else {}
        shown = {} if step.image is None else {"href": link(step.image)}
        written = SubElement(
            element,
            step.tag,
            {**_inputs(step, k), **shown, **words, **step_attributes(step, decimals, is_one), **result},
        )
        if step.tag == "feMerge":
            for each in step.inputs:
                SubElement(written, "feMergeNode", {"in": _called(each)})
        for part in step.parts:
            SubElement(
                written, part.tag, {**dict(part.words), **step_attributes(part, decimals, single=False)}
            )
    return element


def _inputs(step: Step, k: int) -> dict[str, str]:
    """Return the inputs of a step; the first may be left out if it is the step before."""
    if step.tag == "feMerge":
        return {}
    before = k - 1 if k else SOURCE
    names = zip(("in", "in2"), step.inputs, strict=False)
    return {name: _called(each) for name, each in names if name == "in2" or each != before}


def _called(each: str | int) -> str:
    return f"s{each}" if isinstance(each, int) else each


class Filters:
    """The filters of a document, each defined once in `elements`."""

    def __init__(self, decimals: int, ids: Ids, prefix: str, picture: Callable[[Raster | View], str]) -> None:
        self.elements: list[Element] = []
        self._decimals = decimals
        self._ids = ids
        self._prefix = prefix
        self._picture = picture
        self._names: dict[Filter, str] = {}

    def link(self, made: Filter) -> str:
        """Return the value of ``filter`` that refers to a filter."""
        if made not in self._names:
            name = self._names[made] = self._ids.new(f"{self._prefix}-{len(self._names) + 1}")
            single = is_single([made])
            self.elements.append(filter_element(name, made, self._decimals, single, self._picture))
        return f"url(#{self._names[made]})"


def effect_attributes(effect: Effect, link: str | None, clipped: Mapping[str, str]) -> dict[str, str]:
    """Return the attributes of the group of an effect, given the link to its filter, and how it is clipped."""
    found = dict(clipped)
    if link is not None:
        found["filter"] = link
    if effect.opacity < 1.0:
        found["opacity"] = number(effect.opacity, 4)
    blending = [
        *([f"mix-blend-mode:{effect.mode}"] if effect.mode != NORMAL else []),
        *(["isolation:isolate"] if effect.isolates else []),
    ]
    if blending:
        found["style"] = ";".join(blending)
    return found


def class_of(effect: Effect) -> str:
    """Return the name of the class of a blend mode, where that changes: SMIL can change nothing but classes there."""
    return f"mode-{effect.mode}" + ("-isolated" if effect.isolates else "")


def rule_of(effect: Effect) -> str:
    """Return the rule of the class of a blend mode."""
    isolation = ";isolation:isolate" if effect.isolates else ""
    return f".{class_of(effect)}{{mix-blend-mode:{effect.mode}{isolation}}}"


def mask_element(
    name: str,
    mask: Mask,
    fill: Callable[[Element, Content], None],
    inside: Callable[[MaskLayer], dict[str, str]],
    decimals: int,
) -> tuple[Element, list[tuple[Element, Element]]]:
    """Return the definition of a mask, and of each layer the elements that have its opacity and its place.

    `fill` adds what a layer draws to an element, and `inside` has the attributes that clip it by its region. Each layer
    but the lowest is opaque, so that it covers these below it by its share.
    """
    area = _box(mask.region, decimals)
    element = Element("mask", {"id": name, "maskUnits": "userSpaceOnUse", **area})
    (lowest, *_) = mask.layers
    if len(mask.layers) == 1 and lowest.content is not None and not has_place(lowest):
        fill(element, lowest.content)
        return element, [(element, element)]
    written = []
    for k, layer in enumerate(mask.layers):
        holder = SubElement(element, "g", {"opacity": number(layer.share, 4)} if k else {})
        if k or layer.content is None:
            colour = "#ffffff" if layer.content is None else "#000000"
            SubElement(holder, "rect", {**area, "fill": colour})
        place = holder
        if layer.content is not None:
            place = SubElement(holder, "g", {"transform": place_of(layer, decimals), **inside(layer)})
            fill(place, layer.content)
        written.append((holder, place))
    return element, written


def has_place(layer: MaskLayer) -> bool:
    """Return whether a layer is moved or scaled."""
    return (layer.shift, layer.scale) != (0j, (1.0, 1.0))


def place_of(layer: MaskLayer, decimals: int) -> str:
    """Return where a layer is, as ``translate(x y) scale(x y)``."""
    x, y = number(layer.shift.real, decimals + 2), number(layer.shift.imag, decimals + 2)
    return f"translate({x} {y}) scale({number(layer.scale[0], 6)} {number(layer.scale[1], 6)})"
