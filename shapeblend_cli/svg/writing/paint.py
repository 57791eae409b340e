"""Paint as SVG attributes: presentation attributes, gradients and their stops."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple
from xml.etree.ElementTree import Element, SubElement, tostring

import numpy as np

from shapeblend_cli.model import (
    Box,
    Clip,
    Content,
    CubicPath,
    Effect,
    Gradient,
    LinearGradient,
    Mask,
    MaskLayer,
    PaintedShape,
    Pattern,
    Picture,
    RadialGradient,
    Raster,
    Style,
    View,
)
from shapeblend_cli.svg.writing.ids import Ids
from shapeblend_cli.svg.writing.path_data import path_data
from shapeblend_cli.svg.writing.rounding import DASH_DIGITS, number

if TYPE_CHECKING:
    from shapeblend_cli.svg.writing.groups import Filters

SHARE_DIGITS = 5
"""Decimals of shares, such as the offset of a stop."""

DEFAULTS = {
    "fill_opacity": "1",
    "fill_rule": "nonzero",
    "stroke_opacity": "1",
    "stroke_width": "1",
    "stroke_linecap": "butt",
    "stroke_linejoin": "miter",
    "stroke_miterlimit": "4",
    "stroke_dasharray": "none",
    "stroke_dashoffset": "0",
    "paint_order": "normal",
    "vector_effect": "none",
}
"""Initial values of attributes. They need not be written."""

CONTENT_DIGITS = 2
"""Number of further decimals of what is drawn in patterns and masks, which may be scaled up."""

SCALE_DIGITS = 6
"""Decimals of factors by which patterns and masks are scaled."""

PIXEL_DIGITS = 4
"""Decimals of lengths in pixels of the screen."""

SHOWN_SIZE = 1024
"""Larger side of documents in filters, in pixels: browsers draw them in this size, whatever they are shown in."""

SIDES = ("x", "y", "width", "height")
"""Attributes that place an upright picture."""

STROKE_LENGTHS = ("stroke_width", "stroke_dasharray", "stroke_dashoffset")


def without_defaults(attributes: dict[str, str]) -> dict[str, str]:
    """Return the attributes that differ from their initial values."""
    return {name: value for name, value in attributes.items() if DEFAULTS.get(name) != value}


def visible_styles(shape: PaintedShape, t: float) -> list[Style]:
    """Return the styles a shape is painted in at time t, from below: two where one paint dissolves into another."""
    # At the end of time what is below is covered, and would only show at antialiased edges.
    styles = [shape.style] if shape.below is None or t >= 1.0 else [shape.below, shape.style]
    if styles[0].picture is not None and styles[-1].fill_opacity == 0.0:
        styles = styles[:1]  # a picture is large, also where nothing is seen of it
    return [_simplify(style) for style in styles]


def _simplify(style: Style) -> Style:
    """Return a style that paints the same without touching dashes and gradients of a single colour.

    Both arise at the ends of time if the other end has dashes or a gradient. Keyframes need them; in a still picture,
    touching dashes show seams.
    """
    dashes = style.stroke_dasharray
    # An odd number is repeated with dashes and gaps exchanged.
    if dashes and len(dashes) % 2 == 0 and not any(dashes[1::2]):
        style = style._replace(stroke_dasharray=(), stroke_dashoffset=0.0)
    for name, gradient in (("fill", style.fill_gradient), ("stroke", style.stroke_gradient)):
        if gradient is None or isinstance(gradient, Picture):
            continue
        if len({(stop.colour, stop.opacity) for stop in gradient.stops}) == 1:
            style = style.with_plain(name, gradient.stops[0])
    return style


def paint_attributes(style: Style, decimals: int) -> dict[str, str]:
    """Return the presentation attributes of a style, with plain colours in place of gradients."""
    if style.pixel is not None:
        style, decimals = style.stretched(1.0 / style.pixel), PIXEL_DIGITS
    paint = {"fill": style.fill or "none"}
    if style.fill is not None:
        paint["fill_opacity"] = number(style.fill_opacity, 4)
        paint["fill_rule"] = style.fill_rule
    if style.stroke is not None:
        paint["stroke"] = style.stroke
        paint["stroke_opacity"] = number(style.stroke_opacity, 4)
        paint["stroke_width"] = number(style.stroke_width, decimals)
        paint["stroke_linecap"] = style.stroke_linecap
        paint["stroke_linejoin"] = style.stroke_linejoin
        paint["stroke_miterlimit"] = number(style.stroke_miterlimit, 4)
        lengths = [*style.stroke_dasharray, style.stroke_dashoffset]
        *dashes, offset = (number(length, decimals + DASH_DIGITS) for length in lengths)
        paint["stroke_dasharray"] = " ".join(dashes) or "none"
        paint["stroke_dashoffset"] = offset if dashes else "0"
        paint["paint_order"] = style.paint_order if style.fill is not None else "normal"
        paint["vector_effect"] = "none" if style.pixel is None else "non-scaling-stroke"
    return paint


def gradient_attributes(
    gradient: Gradient, decimals: int, *, as_ellipse: bool = False
) -> tuple[dict[str, str], list[dict[str, str]]]:
    """Return the attributes of a gradient and of each of its stops.

    An ellipse is written as a unit circle under ``translate(x y) rotate(angle) scale(rx ry)``, a circle only if asked.
    """
    attributes = {"gradientUnits": "userSpaceOnUse"}
    if isinstance(gradient, Pattern):
        raise TypeError("a pattern has no stops")
    if isinstance(gradient, LinearGradient):
        (x1, y1), (x2, y2) = (_coordinates(point, decimals) for point in (gradient.start, gradient.end))
        attributes |= {"x1": x1, "y1": y1, "x2": x2, "y2": y2}
    else:
        attributes |= _radial_attributes(gradient, decimals, as_ellipse)
    if gradient.spread != "pad":
        attributes["spreadMethod"] = gradient.spread
    stops = [
        {
            "offset": number(stop.offset, SHARE_DIGITS),
            "stop_color": stop.colour,
            "stop_opacity": number(stop.opacity, 4),
        }
        for stop in gradient.stops
    ]
    return attributes, stops


def _radial_attributes(gradient: RadialGradient, decimals: int, as_ellipse: bool) -> dict[str, str]:
    centre, focus, focal_radius = gradient.centre, gradient.focus, gradient.focal_radius
    first, second = gradient.radii
    cx, cy = _coordinates(centre, decimals)
    if first == second and not as_ellipse:
        spot = centre + first * focus * cmath.rect(1.0, math.radians(gradient.angle))
        fx, fy = _coordinates(spot, decimals)
        r, fr = number(first, decimals), number(first * focal_radius, decimals)
        return {"cx": cx, "cy": cy, "r": r, "fx": fx, "fy": fy, "fr": fr}
    fx, fy = _coordinates(focus, SHARE_DIGITS)
    scale = f"{number(first, decimals)} {number(second, decimals)}"
    transform = f"translate({cx} {cy}) rotate({number(gradient.angle, 4)}) scale({scale})"
    fr = number(focal_radius, SHARE_DIGITS)
    return {"cx": "0", "cy": "0", "r": "1", "fx": fx, "fy": fy, "fr": fr, "gradientTransform": transform}


def _coordinates(point: complex, decimals: int) -> tuple[str, str]:
    return number(point.real, decimals), number(point.imag, decimals)


def picture_attributes(picture: Picture, opacity: float, decimals: int) -> dict[str, str]:
    """Return the attributes of an ``image`` that is a picture in its place."""
    written = {**link_attributes(picture), "opacity": number(opacity, 4)}
    if picture.is_upright:
        place = (picture.origin.real, picture.origin.imag, picture.across.real, picture.down.imag)
        written |= {name: number(value, decimals) for name, value in zip(SIDES, place, strict=True)}
    else:
        parts = [part for z in (picture.across, picture.down, picture.origin) for part in (z.real, z.imag)]
        entries = " ".join(number(part, decimals) for part in parts)
        written |= {"width": "1", "height": "1", "transform": f"matrix({entries})"}
    return {name: value for name, value in written.items() if (name, value) != ("opacity", "1")}


def link_attributes(picture: Picture) -> dict[str, str]:
    """Return the attributes of an ``image`` that hold wherever the picture is."""
    smooth = {} if picture.is_smooth else {"image_rendering": "pixelated"}
    return {"href": picture.raster.uri, "preserveAspectRatio": "none", **smooth}


class Around(NamedTuple):
    """A group around shapes in a row: its number, how many groups are around it, and its element."""

    number: int
    place: int
    make: Callable[[], Element]


class Regions:
    """The clip paths of a document, each defined once in `elements`; how one is drawn is left to `draw`."""

    def __init__(self, ids: Ids, draw: Callable[[Element, Any], None], prefix: str = "clip") -> None:
        self.elements: list[Element] = []
        self._ids, self._draw, self._prefix = ids, draw, prefix
        self._names: dict[tuple[int, ...], str] = {}
        self._kept: list[Sequence[Any]] = []  # so that no other region gets the number of one

    def attributes(self, regions: Sequence[Any]) -> dict[str, str]:
        """Return the attribute that clips a path by all of some regions; none if there are none."""
        return {"clip_path": f"url(#{self._name(regions)})"} if regions else {}

    def _name(self, regions: Sequence[Any]) -> str:
        key = tuple(map(id, regions))
        if key not in self._names:
            around = hyphened(self.attributes(regions[:-1]))
            name = self._names[key] = self._ids.new(f"{self._prefix}-{len(self._names) + 1}")
            self._kept.append(regions)
            element = Element("clipPath", {"id": name, **around})
            self._draw(element, regions[-1])
            self.elements.append(element)
        return self._names[key]


def add_region(clip_path: Element, attributes: dict[str, str], rule: str) -> Element:
    """Add a path with a fill rule to a clip path, and return it."""
    clip_rule = {} if rule == "nonzero" else {"clip-rule": rule}
    return SubElement(clip_path, "path", {**attributes, **clip_rule})


def hyphened(attributes: Mapping[str, str]) -> dict[str, str]:
    """Return attributes with the names that they have in SVG."""
    return {name.replace("_", "-"): value for name, value in attributes.items()}


def _rectangle(box: Box) -> CubicPath:
    left, top, right, bottom = box.bounds
    corners = np.array(
        [complex(left, top), complex(right, top), complex(right, bottom), complex(left, bottom)]
    )
    steps = (np.roll(corners, -1) - corners)[:, None] * np.array([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0])
    return CubicPath(corners[:, None] + steps, np.ones(4, bool), True)


class Gradients:
    """The gradients of a document, its clip paths and its filters, each defined once."""

    def __init__(self, decimals: int, ids: Ids | None = None, prefix: str = "") -> None:
        self.decimals = decimals
        self._ids = ids or Ids()
        self.clips = Regions(self._ids, self._add_clip, f"{prefix}clip")
        self._gradients: list[Element] = []
        self._names: dict[Gradient, str] = {}
        self._pictures: dict[tuple[Raster, bool], Element] = {}
        self._filters: Filters | None = None
        self._masks: dict[Mask, str] = {}
        self._frames: dict[Box, tuple[Clip, ...]] = {}
        self._prefix = prefix
        self.faces: dict[str, None] = {}

    @property
    def elements(self) -> list[Element]:
        """The definitions of pictures, gradients, clip paths and filters."""
        filters = self._filters.elements if self._filters else ()
        found = [*self._pictures.values(), *self._gradients, *self.clips.elements, *filters]
        if self.faces:
            sheet = Element("style")
            sheet.text = "".join(self.faces)
            found.append(sheet)
        return found

    @property
    def filters(self) -> Filters:
        """The filters."""
        from shapeblend_cli.svg.writing.groups import Filters

        if self._filters is None:
            self._filters = Filters(self.decimals, self._ids, f"{self._prefix}filter", self.shown_link)
        return self._filters

    def shown_link(self, shown: Raster | View) -> str:
        """Return a link to what a filter shows: a picture, or a document of its own with what is in a box."""
        from base64 import b64encode

        if isinstance(shown, Raster):
            return shown.uri
        box = shown.box
        inner, scale = Gradients(self.decimals), SHOWN_SIZE / box.larger_side
        size = {"width": number(scale * box.width, 2), "height": number(scale * box.height, 2)}
        view = " ".join(number(value, self.decimals + CONTENT_DIGITS) for value in box)
        drawing = Element("svg", {"xmlns": "http://www.w3.org/2000/svg", "viewBox": view, **size})
        drawing.set("preserveAspectRatio", "none")
        holder = Element("g")
        inner.fill(holder, shown.content)
        SubElement(drawing, "defs").extend(inner.elements)
        drawing.append(holder)
        return f"data:image/svg+xml;base64,{b64encode(tostring(drawing)).decode()}"

    def around(self, effects: Sequence[Effect]) -> list[Around]:
        """Return groups for the effects around a shape, the outermost first."""
        return [
            Around(effect.number, effect.place, partial(self._group, effect))
            for effect in effects
            if not effect.is_plain
        ]

    def _group(self, effect: Effect) -> Element:
        from shapeblend_cli.svg.writing.groups import effect_attributes  # few drawings have any

        link = effect.filter and self.filters.link(effect.filter)
        attributes = effect_attributes(effect, link, self.clips.attributes(effect.clips))
        if effect.mask is not None:
            attributes["mask"] = self.mask(effect.mask)
        return Element("g", dict(sorted(hyphened(attributes).items())))

    def _add_clip(self, element: Element, clip: Clip) -> None:
        add_region(element, {"d": path_data(clip.paths, self.decimals)}, clip.rule)

    def attributes(self, style: Style) -> dict[str, str]:
        """Return the presentation attributes of a style, linked to its gradients, without initial values."""
        paint = paint_attributes(style, self.decimals)
        for name, gradient in (("fill", style.fill_gradient), ("stroke", style.stroke_gradient)):
            if gradient is not None and not isinstance(gradient, Picture):
                paint[name] = self.link(gradient)
        return without_defaults(paint)

    def text(self, style: Style, *, at: Picture | None = None, is_painted: bool = True) -> Element:
        """Return the text that a style shows, `at` its own place or at another one, with its fonts defined once."""
        from shapeblend_cli.model.words import Words  # few blends have any
        from shapeblend_cli.svg.writing.kept.text_element import text_element

        assert style.picture is not None
        assert isinstance(style.picture.raster, Words)
        self.faces |= dict.fromkeys(style.picture.raster.faces)
        paint = hyphened(self.attributes(style)) if is_painted else {}
        return text_element(style.picture.raster, at or style.picture, paint, self.decimals)

    def shared_picture(self, picture: Picture, further: int = 0) -> dict[str, str]:
        """Return the attributes of a ``use`` that shows a picture in its place; the picture itself is defined once.

        The place has `further` decimals.
        """
        key = picture.raster, picture.is_smooth
        if key not in self._pictures:
            name = self._ids.new(f"{self._prefix}picture-{len(self._pictures) + 1}")
            own = {"id": name, "width": "1", "height": "1", **link_attributes(picture)}
            self._pictures[key] = Element("image", hyphened(own))
        parts = [part for z in (picture.across, picture.down, picture.origin) for part in (z.real, z.imag)]
        entries = " ".join(number(part, self.decimals + further) for part in parts)
        return {"href": f"#{self._pictures[key].get('id')}", "transform": f"matrix({entries})"}

    def pattern(self, name: str, pattern: Pattern) -> Element:
        """Return the definition of a pattern."""
        element = Element("pattern", {"id": name, **pattern_attributes(pattern, self.decimals)})
        self.fill(element, pattern.content)
        return element

    def fill(self, holder: Element, content: Content) -> None:
        """Add what a pattern or a mask draws to an element."""
        opened: list[tuple[int, Element]] = [(-1, holder)]
        decimals = self.decimals + CONTENT_DIGITS
        for shape in content.shapes:
            path = [each for each in shape.effects if not each.is_plain]
            shared = 0
            while shared < min(len(opened) - 1, len(path)) and opened[shared + 1][0] == path[shared].number:
                shared += 1
            del opened[shared + 1 :]
            for effect in path[shared:]:
                group = self._group(effect)
                opened[-1][1].append(group)
                opened.append((effect.number, group))
            clipped = self.clips.attributes(shape.clips)
            if shape.style.picture is not None:
                around = SubElement(opened[-1][1], "g", hyphened(clipped)) if clipped else opened[-1][1]
                shown = self.shared_picture(shape.style.picture, CONTENT_DIGITS)
                opacity = shape.style.fill_opacity
                faded = {"opacity": number(opacity, 4)} if opacity < 1.0 else {}
                SubElement(around, "use", {**shown, **faded})
                continue
            paint = {**self.attributes(shape.style), **clipped}
            SubElement(opened[-1][1], "path", {"d": path_data(shape.contours, decimals), **hyphened(paint)})

    def mask(self, mask: Mask) -> str:
        """Return the value of ``mask`` that refers to a mask."""
        if mask not in self._masks:
            self._masks[mask] = self._ids.new(f"{self._prefix}mask-{len(self._masks) + 1}")
            element, _ = self.mask_element(self._masks[mask], mask)
            self._gradients.append(element)
        return f"url(#{self._masks[mask]})"

    def mask_element(self, name: str, mask: Mask) -> tuple[Element, list[tuple[Element, Element]]]:
        """Return the definition of a mask, and of each layer the elements that have its opacity and its place."""
        from shapeblend_cli.svg.writing import groups

        return groups.mask_element(name, mask, self.fill, self._inside, self.decimals)

    def _inside(self, layer: MaskLayer) -> dict[str, str]:
        """Return the attributes that clip a layer of a mask by its region."""
        if layer.region not in self._frames:
            self._frames[layer.region] = (Clip((_rectangle(layer.region),)),)
        return hyphened(self.clips.attributes(self._frames[layer.region]))

    def link(self, gradient: Gradient) -> str:
        """Return the value of ``fill`` or ``stroke`` that refers to a gradient."""
        if gradient not in self._names:
            kind = "pattern" if isinstance(gradient, Pattern) else "gradient"
            self._names[gradient] = self._ids.new(f"{self._prefix}{kind}-{len(self._names) + 1}")
            if isinstance(gradient, Pattern):
                self._gradients.append(self.pattern(self._names[gradient], gradient))
                return f"url(#{self._names[gradient]})"
            written = gradient_attributes(gradient, self.decimals)
            self._gradients.append(gradient_element(self._names[gradient], gradient, *written))
        return f"url(#{self._names[gradient]})"


def pattern_attributes(pattern: Pattern, decimals: int) -> dict[str, str]:
    """Return the attributes of a pattern; its transform is ``translate(x y) rotate(a) skewX(a) scale(x y)``."""
    width, height = (number(side, decimals + CONTENT_DIGITS) for side in pattern.size)
    x, y = _coordinates(pattern.origin, decimals + CONTENT_DIGITS)
    turn, skew = number(pattern.angle, 4), number(pattern.skew, 4)
    scale = " ".join(number(side, SCALE_DIGITS) for side in pattern.scale)
    transform = f"translate({x} {y}) rotate({turn}) skewX({skew}) scale({scale})"
    size = {"width": width, "height": height}
    return {"patternUnits": "userSpaceOnUse", **size, "patternTransform": transform}


def gradient_element(
    name: str, gradient: Gradient, attributes: dict[str, str], stops: Sequence[dict[str, str]]
) -> Element:
    """Return the definition of a gradient with the attributes that `gradient_attributes` returns."""
    tag = "linearGradient" if isinstance(gradient, LinearGradient) else "radialGradient"
    element = Element(tag, {"id": name, **attributes})
    for stop in stops:
        SubElement(element, "stop", hyphened(stop))
    return element
