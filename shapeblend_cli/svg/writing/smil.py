"""SVG documents that are animated by SMIL: paths that move, or frames shown in turn."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from xml.etree.ElementTree import Element

from shapeblend_cli.model import (
    NORMAL,
    WHOLE,
    Effect,
    Frame,
    Gradient,
    KeyframedEffect,
    KeyframedShape,
    Page,
    Pattern,
    RadialGradient,
)
from shapeblend_cli.model.words import Words
from shapeblend_cli.options.easing import FOREVER, PINGPONG, Timing
from shapeblend_cli.svg.writing import document
from shapeblend_cli.svg.writing.animation import (
    Timeline,
    Values,
    Views,
    attribute_values,
    delayed,
    fading_keys,
    image_values,
    moving_text,
    text_values,
    values_between,
)
from shapeblend_cli.svg.writing.ids import Ids
from shapeblend_cli.svg.writing.paint import (
    Around,
    Gradients,
    Regions,
    add_region,
    gradient_attributes,
    gradient_element,
    link_attributes,
    pattern_attributes,
    visible_styles,
)
from shapeblend_cli.svg.writing.path_data import short_path_data
from shapeblend_cli.svg.writing.rounding import number

TICKS = ".02s 500"
"""Length and number of the events that end animations: in ten seconds most pages are loaded."""


def smil_svg(
    shapes: Sequence[KeyframedShape],
    views: Views,
    timing: Timing,
    decimals: int,
    page: Page | None = None,
    *,
    stops: bool = True,
) -> str:
    """Return an SVG document in which paths, in paint order, are animated by SMIL; it shows its views.

    For those who prefer reduced motion it `stops`, unless others play it.
    """
    drawing = document.empty(views.boxes[0], decimals, page)
    timeline = Timeline(views.pairs, timing)
    timeline.add_views(drawing, views, decimals)
    ids = document.ids_of(drawing, shapes, cache(lambda: f"b{document.fingerprint(shapes)}-"))
    gradients = add_animated(document.Tree(drawing, ids), shapes, timeline, decimals)
    rule = _stop(drawing, gradients, timing) if stops else None
    return document.text(drawing, style=rule, definitions=gradients)


def _stop(drawing: Element, definitions: Sequence[Element], timing: Timing) -> str | None:
    """Have animations that play forever end at once for those who prefer reduced motion; return the style sheet for it.

    SMIL itself knows no such preference. A style sheet does: it lets an element run an empty animation, whose events
    begin a timer, and with that everything else ends, so that the first drawing is left. Events are repeated, since
    pages begin to play when all of them is loaded.
    """
    animations = [
        element
        for root in (drawing, *definitions)
        for element in root.iter()
        if element.tag in ("animate", "animateTransform")
    ]
    # Of those that play a number of times the last picture freezes; it would be one on the way.
    if not animations or timing.repeat not in (FOREVER, PINGPONG):
        return None
    digest = 0
    for element in animations:
        digest = zlib.crc32(repr(element.attrib).encode(), digest)
    own = f"b{digest:08x}"  # so that several drawings can stand in one page
    for element in animations:
        document.put(element, {"end": f"{own}s.begin"})
    holder = document.new("g", {"id": own})
    events = {"attributeName": "x", "begin": "animationstart;animationiteration"}
    holder.append(document.new("set", {"id": f"{own}s", **events}))
    drawing.append(holder)
    return f"@media(prefers-reduced-motion){{#{own}{{animation:{own} {TICKS}}}}}@keyframes {own}{{}}"


def add_animated(
    tree: document.Tree, shapes: Sequence[KeyframedShape], timeline: Timeline, decimals: int
) -> list[Element]:
    """Add animated paths to a drawing, and return the gradients they are painted with."""
    gradients: list[Element] = []
    drawings = timeline.pairs + 1

    def add_clip(element: Element, clip: Sequence[KeyframedShape]) -> None:
        for shape in clip:
            values = attribute_values(_extend(shape, drawings), decimals)["d"]
            path = add_region(element, {"d": values.keys[0]}, shape.keys[0].style.fill_rule)
            if not values.is_constant:
                timeline.animate(path, "d", values)

    regions = Regions(tree.ids, add_clip)
    layers = _AnimatedEffects(timeline, Gradients(decimals, tree.ids), regions, tree.ids)
    for shape in shapes:
        extended = _extend(shape, drawings)
        if shape.keys[0].style.picture is not None:
            image = _animated_image(timeline, extended, regions.attributes(shape.clips), layers.contents)
            _show_in_time(timeline, image, shape)
            tree.add(image, shape.groups, shape.name, layers.around(shape.effects))
            continue
        attributes = attribute_values(extended, decimals)
        for paint in ("fill", "stroke"):
            times, styles = fading_keys(extended if extended.is_paced else extended._replace(fading=()))
            painted = [getattr(style, f"{paint}_gradient") for style in styles]
            if all(painted):
                kind = "pattern" if isinstance(painted[0], Pattern) else "gradient"
                name = tree.ids.new(f"{kind}-{len(gradients) + 1}")
                when = times, extended.spans
                if isinstance(painted[0], Pattern):
                    gradients.append(_animated_pattern(timeline, name, painted, when, layers.contents))
                else:
                    gradients.append(_animated_gradient(timeline, name, painted, when, decimals))
                attributes[paint] = values_between(paint, [f"url(#{name})"] * drawings)
        clipped = regions.attributes(shape.clips)
        path = document.new("path", {name: values.keys[0] for name, values in attributes.items()} | clipped)
        for name, values in attributes.items():
            if not values.is_constant:
                timeline.animate(path, name, values)
        _show_in_time(timeline, path, shape)
        tree.add(path, shape.groups, shape.name, layers.around(shape.effects))
    return [*gradients, *regions.elements, *layers.elements]


class _AnimatedEffects:
    """The groups of effects that are animated, and in `elements` what they refer to."""

    def __init__(self, timeline: Timeline, contents: Gradients, regions: Regions, ids: Ids) -> None:
        self.contents = contents  # of patterns and masks, which do not change
        self._timeline = timeline
        self._ids = ids
        self._regions = regions
        self._decimals = contents.decimals
        self._masks: dict[int, str] = {}
        self._filters: list[Element] = []
        self._links: dict[int, str] = {}
        self._rules: dict[str, None] = {}

    @property
    def elements(self) -> list[Element]:
        """Filters, and the style sheet of blend modes that change."""
        found = [*self._filters, *self.contents.elements]
        if not self._rules:
            return found
        sheet = Element("style")
        sheet.text = "".join(self._rules)
        return [*found, sheet]

    def around(self, effects: Sequence[KeyframedEffect]) -> list[Around]:
        """Return groups for the effects around a shape, the outermost first."""
        return [
            Around(each.blend.number, each.blend.start.place, partial(self._group, each)) for each in effects
        ]

    def _group(self, keyed: KeyframedEffect) -> Element:
        from shapeblend_cli.paint.effects import keyed_effects
        from shapeblend_cli.svg.writing.groups import class_of, effect_attributes, rule_of

        times, effects = keyed_effects(keyed, self._timeline.pairs + 1)
        link = None if effects[0].filter is None else self._link(keyed.blend.number, times, effects)
        changes = len({(effect.mode, effect.isolates) for effect in effects}) > 1
        first = effects[0]._replace(mode=NORMAL, isolates=False) if changes else effects[0]
        masked = {} if first.mask is None else {"mask": self._mask(keyed.blend.number, times, effects)}
        clipped = self._regions.attributes(keyed.clips)
        element = document.new("g", {**effect_attributes(first, link, clipped), **masked})
        if changes:
            classes = [class_of(effect) for effect in effects]
            self._rules |= dict.fromkeys(map(rule_of, effects))
            document.put(element, {"class": classes[0]})
            self._timeline.animate(element, "class", values_between("class", classes, times))
        opacities = [number(effect.opacity, 4) for effect in effects]
        if len(set(opacities)) > 1:
            self._timeline.animate(element, "opacity", values_between("opacity", opacities, times))
        return element

    def _link(self, known: int, times: Sequence[float], effects: Sequence[Effect]) -> str:
        """Return the value of ``filter`` that refers to an animated filter, which is defined once."""
        from shapeblend_cli.svg.writing import groups as writing

        if known in self._links:
            return self._links[known]
        made = [effect.filter for effect in effects if effect.filter is not None]
        single = writing.is_single(made)
        name = self._ids.new(f"filter-{len(self._links) + 1}")
        link = self.contents.shown_link
        element = writing.filter_element(name, made[0], self._decimals, single, link)
        written = list(element)
        self._animate(element, [writing.filter_attributes(each, self._decimals) for each in made], times)
        for k, (step, is_one) in enumerate(zip(written, single, strict=True)):
            steps = [each.steps[k] for each in made]
            parts = list(step)
            self._animate(
                step, [writing.step_attributes(each, self._decimals, is_one) for each in steps], times
            )
            for n, _ in enumerate(steps[0].parts):
                own = [writing.step_attributes(each.parts[n], self._decimals, single=False) for each in steps]
                self._animate(parts[n], own, times)
        self._filters.append(element)
        self._links[known] = f"url(#{name})"
        return self._links[known]

    def _mask(self, known: int, times: Sequence[float], effects: Sequence[Effect]) -> str:
        """Return the value of ``mask`` that refers to an animated mask, which is defined once."""
        from shapeblend_cli.svg.writing.groups import place_of

        if known not in self._masks:
            name = self._ids.new(f"mask-{len(self._masks) + 1}")
            masks = [effect.mask for effect in effects if effect.mask is not None]
            element, written = self.contents.mask_element(name, masks[0])
            for k, (holder, place) in enumerate(written):
                layers = [mask.layers[k] for mask in masks]
                shares = [number(layer.share, 4) for layer in layers]
                if len(set(shares)) > 1:
                    self._timeline.animate(holder, "opacity", values_between("opacity", shares, times))
                places = [place_of(layer, self._decimals) for layer in layers]
                if len(set(places)) > 1:
                    _animate_steps(
                        self._timeline,
                        place,
                        "transform",
                        places,
                        lambda each: values_between("transform", each, times),
                    )
            self._filters.append(element)
            self._masks[known] = f"url(#{name})"
        return self._masks[known]

    def _animate(self, element: Element, texts: Sequence[Mapping[str, str]], times: Sequence[float]) -> None:
        for name in texts[0]:
            values = values_between(name.replace("-", "_"), [text[name] for text in texts], times)
            if not values.is_constant:
                self._timeline.animate(element, name.replace("-", "_"), values)


def _show_in_time(timeline: Timeline, element: Element, shape: KeyframedShape) -> None:
    """Let an element be seen while its shape is there."""
    if len(shape.keys) <= timeline.pairs:
        if shape.first:
            document.put(element, {"visibility": "hidden"})
        timeline.show(element, shape.first, shape.first + len(shape.keys) - 1)


def _animated_image(
    timeline: Timeline, shape: KeyframedShape, clipped: dict[str, str], contents: Gradients
) -> Element:
    """Return a picture that moves, or a text, in a group if it is clipped."""
    style = shape.keys[0].style
    picture = style.picture
    assert picture is not None, "it is one"
    if isinstance(picture.raster, Words):
        values = text_values(shape, contents.decimals)
        image = moving_text(style, values, contents)
    else:
        values = image_values(shape, contents.decimals)
        image = document.new("image", {**link_attributes(picture), **values.first})
    for name, changing in values.attributes.items():
        if not changing.is_constant:
            timeline.animate(image, name, changing)
    for kind, changing in () if values.is_still else values.transforms:
        timeline.animate_transform(image, kind, changing, "transform")
    return document.clipped(image, clipped.get("clip_path"))


def stacked_svg(
    frames: Sequence[Frame], timing: Timing, pairs: int, decimals: int, page: Page | None = None
) -> str:
    """Return an SVG document with all frames on top of each other, one of them visible at a time.

    The frames are at even times of all `pairs` together; they are eased already.
    """
    order = list(range(len(frames)))
    if timing.is_pingpong:
        order += order[-2:0:-1]
    steps = (len(frames) - 1) // pairs
    begin, begins = 0.0, []
    for shown in order:
        begins.append(begin)
        rest = timing.rest_at(shown, steps) / timing.seconds
        begin += pairs * (1 + timing.is_pingpong) / len(order) + rest
    view = frames[0].view
    drawing = document.empty(view, decimals, page)
    timeline = Timeline(pairs, timing)
    effects = [shape.effects for frame in frames for shape in frame.shapes if shape.effects]
    own = cache(lambda: f"b{document.fingerprint_of([frame.shapes for frame in frames], *effects)}-")
    ids = Ids(own=own)
    gradients = Gradients(decimals, ids)
    for k, frame in enumerate(frames):
        if frame.view == view:
            layer = document.new("g")
        else:  # fitted into what the first frame shows
            x, y, width, height = (number(value, decimals) for value in view)
            place = {"x": x, "y": y, "width": width, "height": height}
            layer = document.new("svg", {**place, "viewBox": document.box_text(frame.view, decimals)})
            layer.append(Element("defs"))  # as ever, for the same bytes
        document.put(layer, {"visibility": "hidden" if k else "visible"})
        shares = (
            [n / len(order) for n in range(len(order))] if not timing.rests else [b / begin for b in begins]
        )
        states = {n: "visible" if k == shown else "hidden" for n, shown in zip(shares, order, strict=True)}
        timeline.steps(layer, "visibility", states)
        tree = document.Tree(layer, ids)
        for shape in frame.shapes:
            clipped = gradients.clips.attributes(shape.clips)
            data = {"d": short_path_data(shape.paths, decimals), **clipped}
            around = gradients.around(shape.effects)
            for style in visible_styles(shape, frame.t):
                tree.add(document.painted(style, data, gradients), around=around)
        drawing.append(layer)
    rule = _stop(drawing, gradients.elements, timing)
    return document.text(drawing, style=rule, definitions=gradients.elements)


def _extend(shape: KeyframedShape, drawings: int) -> KeyframedShape:
    """Return a shape with a key for every drawing: its first key is repeated before it begins, its last after it."""
    before = shape.first
    after = drawings - before - len(shape.keys)
    return KeyframedShape(
        keys=(shape.keys[0],) * before + shape.keys + (shape.keys[-1],) * after,
        first=0,
        waypoints=((),) * before + shape.waypoints + ((),) * after,
        fading=((),) * before + shape.fading + ((),) * after if shape.fading else (),
        is_paced=shape.is_paced,
        name=shape.name,
        groups=shape.groups,
        spans=(WHOLE,) * before + shape.spans + (WHOLE,) * after if shape.spans else (),
    )


def _animated_gradient(
    timeline: Timeline,
    name: str,
    keys: Sequence[Gradient],
    when: tuple[Sequence[float], Sequence[tuple[float, float]]],
    decimals: int,
) -> Element:
    """Return a gradient that is animated together with the shape it paints, by its times and spans."""

    def values(attribute: str, texts: Sequence[str]) -> Values:
        return delayed(values_between(attribute, texts, when[0]), when[1])

    as_ellipse = any(isinstance(key, RadialGradient) and key.radii[0] != key.radii[1] for key in keys)
    written = [gradient_attributes(key, decimals, as_ellipse=as_ellipse) for key in keys]
    gradient = gradient_element(name, keys[0], *written[0])
    stop_elements = list(gradient)
    animations: list[Element] = []
    for attribute in sorted({key for attributes, _ in written for key in attributes}):
        texts = [attributes.get(attribute, "pad") for attributes, _ in written]
        if len(set(texts)) == 1:
            continue
        if attribute == "gradientTransform":
            _animate_steps(timeline, animations, attribute, texts, partial(values, attribute))
        else:
            timeline.animate(animations, attribute, values(attribute, texts))
    gradient[:0] = animations
    for k, element in enumerate(stop_elements):
        for attribute in written[0][1][k]:
            changing = values(attribute, [s[k][attribute] for _, s in written])
            if not changing.is_constant:
                timeline.animate(element, attribute, changing)
    return gradient


def _animate_steps(
    timeline: Timeline,
    animations: list[Element] | Element,
    attribute: str,
    texts: Sequence[str],
    values: Callable[[Sequence[str]], Values],
) -> None:
    """Animate transforms step by step: each is ``translate(...) rotate(...) scale(...)`` or the like."""
    for step in zip(*(text.rstrip(")").split(") ") for text in texts), strict=True):
        kinds, numbers = zip(*(function.split("(") for function in step), strict=True)
        timeline.animate_transform(animations, kinds[0], values(numbers), attribute)


def _animated_pattern(
    timeline: Timeline,
    name: str,
    keys: Sequence[Pattern],
    when: tuple[Sequence[float], Sequence[tuple[float, float]]],
    contents: Gradients,
) -> Element:
    """Return a pattern that is animated together with the shape it paints, by its times and spans."""
    element = contents.pattern(name, keys[0])
    attribute = "patternTransform"
    texts = [pattern_attributes(key, contents.decimals)[attribute] for key in keys]
    if len(set(texts)) > 1:
        animations: list[Element] = []
        _animate_steps(
            timeline,
            animations,
            attribute,
            texts,
            lambda each: delayed(values_between(attribute, each, when[0]), when[1]),
        )
        element[:0] = animations
    return element
