"""The steps of a filter element: primitives with their inputs, lengths and colours.

https://www.w3.org/TR/filter-effects-1/
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.model import ALPHA, SOURCE, Box, Step
from shapeblend_cli.svg.styles import css_colours as colours
from shapeblend_cli.svg.styles.declarations import substitute
from shapeblend_cli.svg.styles.values import share
from shapeblend_cli.svg.xml.messages import Notes
from shapeblend_cli.svg.xml.units import GrammarError, length, numbers

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.svg.effects.images import Shown
    from shapeblend_cli.svg.effects.placed import Units
    from shapeblend_cli.svg.styles.cascade import Cascade, Inherited
    from shapeblend_cli.svg.styles.declarations import Declarations
    from shapeblend_cli.svg.xml.xmltree import Node

MOST_STEPS = 64
"""Maximum number of steps of a filter: each is a picture of its own."""

MOST_VALUES = 300
"""Maximum number of values of a table or of a matrix."""

MOST_OCTAVES = 8
"""Maximum number of octaves of a noise: each costs as much as another, and more than these are not seen."""

LARGEST_KERNEL = 9
"""Maximum side of the matrix of a convolution: each of its numbers is a look at every pixel."""

_TEXT = 10_000

WORDS: dict[str, dict[str, tuple[str, ...]]] = {
    "feGaussianBlur": {"edgeMode": ("none", "duplicate", "wrap")},
    "feBlend": {
        "mode": tuple(
            "normal multiply screen overlay darken lighten color-dodge color-burn hard-light soft-light difference "
            "exclusion hue saturation color luminosity".split()
        )
    },
    "feComposite": {"operator": ("over", "in", "out", "atop", "xor", "lighter", "arithmetic")},
    "feMorphology": {"operator": ("erode", "dilate")},
    "feTurbulence": {"type": ("turbulence", "fractalNoise"), "stitchTiles": ("noStitch", "stitch")},
    "feDisplacementMap": {
        "xChannelSelector": ("A", "R", "G", "B"),
        "yChannelSelector": ("A", "R", "G", "B"),
    },
    "feConvolveMatrix": {"edgeMode": ("duplicate", "wrap", "none"), "preserveAlpha": ("false", "true")},
    **{f"feFunc{c}": {"type": ("identity", "table", "discrete", "linear", "gamma")} for c in "RGBA"},
}
"""Values of attributes that are words, by element, beginning with the default."""

SCALARS: dict[str, dict[str, float]] = {
    "feComposite": dict.fromkeys(("k1", "k2", "k3", "k4"), 0.0),
    "feDiffuseLighting": {"diffuseConstant": 1.0},
    "feSpecularLighting": {"specularConstant": 1.0, "specularExponent": 1.0},
    "feDistantLight": {"azimuth": 0.0, "elevation": 0.0},
    "feSpotLight": {"specularExponent": 1.0},
    "feTurbulence": {"numOctaves": 1.0, "seed": 0.0},
    "feConvolveMatrix": {"order": 3.0, "divisor": 0.0, "bias": 0.0},
    **{
        f"feFunc{c}": {"slope": 1.0, "intercept": 0.0, "amplitude": 1.0, "exponent": 1.0, "offset": 0.0}
        for c in "RGBA"
    },
}
"""Defaults of attributes of numbers that no transform changes, by element."""

LISTS = {  # attributes of lists of numbers, by element
    **dict.fromkeys((f"feFunc{c}" for c in "RGBA"), "tableValues"),
    "feConvolveMatrix": "kernelMatrix",
}

# Elements by what they have.
TWO_INPUTS = frozenset(("feBlend", "feComposite", "feDisplacementMap"))
NO_INPUT = frozenset(("feFlood", "feTurbulence", "feImage"))
BLURS = {"feGaussianBlur": "stdDeviation", "feDropShadow": "stdDeviation", "feMorphology": "radius"}
OFFSETS = frozenset(("feOffset", "feDropShadow"))
FLOODS = frozenset(("feFlood", "feDropShadow"))
LIGHTINGS = frozenset(("feDiffuseLighting", "feSpecularLighting"))
LIGHTS: dict[str, tuple[str, ...]] = {
    "feDistantLight": (),
    "fePointLight": ("x", "y", "z"),
    "feSpotLight": ("x", "y", "z", "pointsAtX", "pointsAtY", "pointsAtZ"),
}
OTHERS = frozenset(("feColorMatrix", "feMerge", "feComponentTransfer", "feTile"))

KNOWN = {*WORDS, *BLURS, *OFFSETS, *FLOODS, *LIGHTINGS, *OTHERS} - {f"feFunc{c}" for c in "RGBA"}
"""Names of elements that are steps."""

SPACE = "color-interpolation-filters"

WHITE = colours.Colour("#ffffff")


class Steps:
    """The steps of a filter while they are read, in order."""

    def __init__(
        self, units: Units, cascade: Cascade, inherited: Inherited, notes: Notes, shown: Shown
    ) -> None:
        self._units = units
        self._shown = shown
        self._cascade = cascade
        self._inherited = inherited
        self._notes = notes
        self._results: dict[str, int] = {}
        self.found: list[Step] = []

    def add(self, node: Node, space: str) -> bool:
        """Add an element, in whose place others are if it has an id for its result; False if it is not known."""
        image = self._shown.step(node, self._units) if node.tag == "feImage" else None
        if image is None and node.tag not in KNOWN:
            return False
        declared = substitute(self._cascade.declared(node, keep=True), self._inherited.variables)
        is_srgb = declared.get(SPACE, space).strip().lower() == "srgb"
        words = [(SPACE, "sRGB")] if is_srgb else []  # linearRGB is the default
        step = Step(
            node.tag,
            self._inputs(node),
            (*words, *_words(node)),
            (*self._numbers(node), *self._flood(node, declared)),
            self._colours(node, declared),
            self._region(node),
            tuple(filter(None, map(self._part, node.children))),
        )
        if image is not None:
            step = image._replace(words=(*words, *image.words))
        result = (node.get("result") or "").strip()
        if result:
            self._results[result] = len(self.found)
        self.found.append(step)
        return True

    def _inputs(self, node: Node) -> tuple[str | int, ...]:
        if node.tag in NO_INPUT:
            return ()
        if node.tag == "feMerge":
            return tuple(self._input(child, "in") for child in node.children if child.tag == "feMergeNode")[
                :MOST_STEPS
            ]
        names = ("in", "in2") if node.tag in TWO_INPUTS else ("in",)
        return tuple(self._input(node, name) for name in names)

    def _input(self, node: Node, name: str) -> str | int:
        """Return what an attribute names; what nothing is called is the step before, as in browsers."""
        value = (node.get(name) or "").strip()
        if value in (SOURCE, ALPHA):
            return value
        before = len(self.found) - 1 if self.found else SOURCE
        return self._results.get(value, before)

    def _numbers(self, node: Node) -> list[tuple[str, tuple[float, ...]]]:
        units, tag = self._units, node.tag
        found: list[tuple[str, tuple[float, ...]]] = []
        if tag in BLURS:
            default = 2.0 if tag == "feDropShadow" else 0.0
            x, y = _pair(self._values(node, BLURS[tag]), default)
            # A negative one switches the blur off.
            found.append((BLURS[tag], units.spread(x, y) if min(x, y) >= 0.0 else (0.0, 0.0)))
        if tag in OFFSETS:
            default = 2.0 if tag == "feDropShadow" else 0.0
            dx, dy = (self._scalar(node, name, default) for name in ("dx", "dy"))
            dx, dy = units.vector(dx, dy)
            found += [("dx", (dx,)), ("dy", (dy,))]
        if tag == "feColorMatrix":
            found.append(("values", colour_matrix(node.get("type") or "", self._values(node, "values"))))
        if tag == "feTurbulence":
            x, y = _pair(self._values(node, "baseFrequency"), 0.0)
            found.append(("baseFrequency", (max(x, 0.0) / units.scale, max(y, 0.0) / units.scale)))
        if tag == "feDisplacementMap":
            scale, _ = units.own(self._scalar(node, "scale", 0.0), 0.0)
            found.append(("scale", (scale * units.scale,)))
        if tag in LIGHTINGS:
            # A height, so the default is one of the file's units, too.
            found.append(("surfaceScale", (self._scalar(node, "surfaceScale", 1.0) * units.scale,)))
        for name, default in SCALARS.get(tag, {}).items():
            if node.get(name) is not None:
                found.append((name, (self._scalar(node, name, default),)))
        if tag in LISTS and (values := self._values(node, LISTS[tag])):
            found.append((LISTS[tag], values))
        return _bounded(tag, found)

    def _flood(self, node: Node, declared: Declarations) -> list[tuple[str, tuple[float, ...]]]:
        if node.tag not in FLOODS:
            return []
        opacity = share(declared.get("flood-opacity", "1"))
        alpha = self._colour(declared, "flood-color", colours.BLACK).alpha
        return [("flood-opacity", (alpha * (1.0 if opacity is None else opacity),))]

    def _colours(self, node: Node, declared: Declarations) -> tuple[tuple[str, str], ...]:
        if node.tag in FLOODS:
            return (("flood-color", self._colour(declared, "flood-color", colours.BLACK).rgb),)
        if node.tag in LIGHTINGS:
            return (("lighting-color", self._colour(declared, "lighting-color", WHITE).rgb),)
        return ()

    def _colour(self, declared: Declarations, name: str, default: colours.Colour) -> colours.Colour:
        given = colours.parse(declared.get(name, default.rgb))
        if given is not None and given.kind == "current":
            own = colours.parse_colour(declared["color"]) if "color" in declared else None
            return own or self._inherited.color
        return default if given is None or given.colour is None else given.colour

    def _region(self, node: Node) -> Box | None:
        """Return the box of a step, if it has one of its own."""
        given = [node.get(name) for name in ("x", "y", "width", "height")]
        if any(text is None for text in given):
            return None
        units, lengths = self._units, self._units.lengths
        if units.box is not None:
            sides = [length(text or "", whole=1.0) for text in given]
        else:
            ways = lengths.x, lengths.y, lengths.x, lengths.y
            sides = [way(text or "") for way, text in zip(ways, given, strict=True)]
        x, y, width, height = (0.0 if side is None else side for side in sides)
        if width <= 0.0 or height <= 0.0:
            return None
        if units.box is not None:
            box = units.box
            x, y = box.x + x * box.width, box.y + y * box.height
            width, height = width * box.width, height * box.height
        return units.region(Box(x, y, width, height))

    def _part(self, node: Node) -> Step | None:
        """Return an element inside of a step: a function of a channel, or a light."""
        if node.tag in LIGHTS:
            places = [self._scalar(node, name, 0.0) for name in LIGHTS[node.tag]]
            found = [(name, (value,)) for name, value in self._placed(LIGHTS[node.tag], places)]
            own = SCALARS.get(node.tag, {})
            found += [(name, (self._scalar(node, name, default),)) for name, default in own.items()]
            return Step(node.tag, numbers=tuple(found))
        if node.tag.startswith("feFunc") and node.tag in WORDS:
            return Step(node.tag, words=tuple(_words(node)), numbers=tuple(self._numbers(node)))
        return None

    def _placed(self, names: Sequence[str], values: Sequence[float]) -> list[tuple[str, float]]:
        placed: list[tuple[str, float]] = []
        for k in range(0, len(names), 3):
            x, y = self._units.point(values[k], values[k + 1])
            placed += zip(names[k : k + 3], (x, y, values[k + 2] * self._units.scale), strict=True)
        return placed

    def _values(self, node: Node, name: str) -> tuple[float, ...]:
        text = (node.get(name) or "")[:_TEXT]
        try:
            return tuple(numbers(text))[:MOST_VALUES]
        except GrammarError:
            self._notes.add(f"{name} of {node.tag} cannot be read")
            return ()

    def _scalar(self, node: Node, name: str, default: float) -> float:
        values = self._values(node, name)
        return values[0] if values else default


def _words(node: Node) -> list[tuple[str, str]]:
    """Return the words of an element that are not the default."""
    found = []
    for name, known in WORDS.get(node.tag, {}).items():
        value = (node.get(name) or "").strip()
        if value in known[1:]:
            found.append((name, value))
    return found


def _pair(values: Sequence[float], default: float) -> tuple[float, float]:
    """Return one number or two as two."""
    return (values[0], values[1] if len(values) > 1 else values[0]) if values else (default, default)


def _bounded(tag: str, found: Sequence[tuple[str, tuple[float, ...]]]) -> list[tuple[str, tuple[float, ...]]]:
    """Return numbers within what is drawn in little time."""
    limits = {"numOctaves": (0.0, float(MOST_OCTAVES)), "order": (1.0, float(LARGEST_KERNEL))}

    def bounded(name: str, value: float) -> float:
        low, high = limits.get(name, (value, value))
        return min(max(value, low), high)

    return [(name, tuple(bounded(name, value) for value in values)) for name, values in found]


def colour_matrix(kind: str, values: Sequence[float]) -> tuple[float, ...]:
    """Return any kind of ``feColorMatrix`` as the 20 numbers of a matrix.

    https://www.w3.org/TR/filter-effects-1/#feColorMatrixElement
    """
    identity = _rows((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    kind = kind.strip() or "matrix"
    if kind == "luminanceToAlpha":
        return (0.0,) * 15 + (0.2125, 0.7154, 0.0721, 0.0, 0.0)
    if kind == "saturate":
        return identity if len(values) > 1 else saturation(values[0] if values else 1.0)
    if kind == "hueRotate":
        return identity if len(values) > 1 else hue_turn(np.radians(values[0] if values else 0.0))
    return tuple(values) if len(values) == 20 else identity


def _rows(*rows: tuple[float, float, float]) -> tuple[float, ...]:
    """Return the matrix that mixes red, green and blue."""
    return (*(value for row in rows for value in (*row, 0.0, 0.0)), 0.0, 0.0, 0.0, 1.0, 0.0)


_GREY = (0.213, 0.715, 0.072)


def saturation(s: float) -> tuple[float, ...]:
    """Return the matrix with which colours have a share of their saturation."""
    r, g, b = ([(1.0 - s) * weight + s * (k == row) for k, weight in enumerate(_GREY)] for row in range(3))
    return _rows((r[0], r[1], r[2]), (g[0], g[1], g[2]), (b[0], b[1], b[2]))


def hue_turn(angle: float) -> tuple[float, ...]:
    """Return the matrix that turns hues by an angle in radians."""
    cos, sin = float(np.cos(angle)), float(np.sin(angle))
    r, g, b = _GREY
    return _rows(
        (r + cos * (1 - r) - sin * r, g - cos * g - sin * g, b - cos * b + sin * (1 - b)),
        (r - cos * r + sin * 0.143, g + cos * (1 - g) + sin * 0.140, b - cos * b - sin * 0.283),
        (r - cos * r - sin * (1 - r), g - cos * g + sin * g, b + cos * (1 - b) + sin * b),
    )
