"""SVG documents that are animated by SMIL: paths that move, or frames shown in turn."""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from functools import cache
from itertools import pairwise
from xml.etree.ElementTree import Element

from shapeblend_cli.model import WHOLE, Frame, Gradient, KeyframedShape, Page, RadialGradient
from shapeblend_cli.options.easing import FOREVER, PINGPONG, Timing
from shapeblend_cli.svg.writing import document
from shapeblend_cli.svg.writing.animation import (
    TIME_DIGITS,
    Moment,
    Values,
    Views,
    attribute_values,
    delayed,
    fading_keys,
    image_values,
    moments,
    resting,
    values_between,
)
from shapeblend_cli.svg.writing.ids import Ids
from shapeblend_cli.svg.writing.paint import (
    Gradients,
    Regions,
    add_region,
    gradient_attributes,
    gradient_element,
    link_attributes,
    visible_styles,
)
from shapeblend_cli.svg.writing.path_data import short_path_data
from shapeblend_cli.svg.writing.rounding import number

DISCRETE = frozenset(("fill_rule", "stroke_linecap", "stroke_linejoin", "vector_effect", "spreadMethod"))
"""Attributes without values in between, which switch at half time."""

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
    for shape in shapes:
        extended = _extend(shape, drawings)
        if shape.keys[0].style.picture is not None:
            image = _animated_image(timeline, extended, regions.attributes(shape.clips), decimals)
            _show_in_time(timeline, image, shape)
            tree.add(image, shape.groups, shape.name)
            continue
        attributes = attribute_values(extended, decimals)
        for paint in ("fill", "stroke"):
            times, styles = fading_keys(extended if extended.is_paced else extended._replace(fading=()))
            painted = [getattr(style, f"{paint}_gradient") for style in styles]
            if all(painted):
                name = tree.ids.new(f"gradient-{len(gradients) + 1}")
                animated = _animated_gradient(timeline, name, painted, (times, extended.spans), decimals)
                gradients.append(animated)
                attributes[paint] = values_between(paint, [f"url(#{name})"] * drawings)
        clipped = regions.attributes(shape.clips)
        path = document.new("path", {name: values.keys[0] for name, values in attributes.items()} | clipped)
        for name, values in attributes.items():
            if not values.is_constant:
                timeline.animate(path, name, values)
        _show_in_time(timeline, path, shape)
        tree.add(path, shape.groups, shape.name)
    return [*gradients, *regions.elements]


def _show_in_time(timeline: Timeline, element: Element, shape: KeyframedShape) -> None:
    """Let an element be seen while its shape is there."""
    if len(shape.keys) <= timeline.pairs:
        if shape.first:
            document.put(element, {"visibility": "hidden"})
        timeline.show(element, shape.first, shape.first + len(shape.keys) - 1)


def _animated_image(
    timeline: Timeline, shape: KeyframedShape, clipped: dict[str, str], decimals: int
) -> Element:
    """Return a picture that moves, in a group if it is clipped."""
    values, picture = image_values(shape, decimals), shape.keys[0].style.picture
    assert picture is not None, "it is one"
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
    own = cache(lambda: f"b{document.fingerprint_of([frame.shapes for frame in frames])}-")
    gradients = Gradients(decimals, Ids(own=own))
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
        for shape in frame.shapes:
            data = short_path_data(shape.paths, decimals)
            for style in visible_styles(shape, frame.t):
                layer.append(document.painted(style, {"d": data}, gradients))
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
            # Each is "translate(...) rotate(...) scale(...)".
            for step in zip(*(text.rstrip(")").split(") ") for text in texts), strict=True):
                kinds, numbers = zip(*(function.split("(") for function in step), strict=True)
                timeline.animate_transform(animations, kinds[0], values(attribute, numbers))
        else:
            timeline.animate(animations, attribute, values(attribute, texts))
    gradient[:0] = animations
    for k, element in enumerate(stop_elements):
        for attribute in written[0][1][k]:
            changing = values(attribute, [s[k][attribute] for _, s in written])
            if not changing.is_constant:
                timeline.animate(element, attribute, changing)
    return gradient


class Timeline:
    """Adds animations to elements, or to lists; key times are shares of one run, forwards and perhaps backwards."""

    def __init__(self, pairs: int, timing: Timing) -> None:
        self.pairs = pairs
        self.timing = timing
        self.backwards = timing.is_pingpong
        self.total = timing.length(pairs)  # in times of `timing.seconds`

    def add_views(self, drawing: Element, views: Views, decimals: int) -> None:
        """Let a drawing show one box after another."""
        boxes = [document.box_text(view, decimals) for view in views.boxes]
        if len(set(boxes)) > 1:
            self.animate(drawing, "viewBox", values_between("viewBox", boxes, views.times))

    def animate(self, element: Element | list[Element], name: str, values: Values) -> None:
        """Animate an attribute of an element through all keys."""
        if name in DISCRETE or (name == "stroke_dasharray" and len({v.count(" ") for v in values.keys}) > 1):
            self._switch(element, name, values)
        else:
            self._add(element, "animate", {"attributeName": name.replace("_", "-")}, *self._timed(values))

    def animate_transform(
        self,
        element: Element | list[Element],
        kind: str,
        values: Values,
        attribute: str = "gradientTransform",
    ) -> None:
        """Animate a part of a transform through all keys; all but the first, a translation, are added."""
        texts, extra = self._timed(values)
        if kind != "translate":
            extra["additive"] = "sum"
        given = {"attributeName": attribute, "type": kind}
        self._add(element, "animateTransform", given, texts, extra)

    def show(self, element: Element | list[Element], first: int, last: int) -> None:
        """Make an element visible from one key to another."""
        reached, until = self.timing.when(first), self.timing.when(last, leaves=last == self.pairs)
        spans = [(reached, until)]
        if self.backwards:
            there, back = (
                self._mirrored(self.timing.when(last)),
                self._mirrored(self.timing.when(first, leaves=not first)),
            )
            spans = [(reached, back)] if last == self.pairs else [(reached, until), (there, back)]
        states = {0.0: "hidden"}
        for start, end in spans:
            states[start / self.total] = "visible"
            if end < self.total:
                states[end / self.total] = "hidden"
        self.steps(element, "visibility", states)

    def steps(self, element: Element | list[Element], name: str, states: dict[float, str]) -> None:
        """Switch an attribute of an element to each value at its time."""
        kept: dict[float, str] = {}
        for time, value in states.items():
            if not kept or value != list(kept.values())[-1]:
                kept[time] = value
        times = ";".join(number(time, TIME_DIGITS) for time in kept)
        extra = {"calcMode": "discrete", "keyTimes": times}
        given = {"attributeName": name.replace("_", "-")}
        self._add(element, "animate", given, list(kept.values()), extra)

    def _switch(self, element: Element | list[Element], name: str, values: Values) -> None:
        """Switch an attribute at half time from value to value."""
        timed = [(0.0, values.keys[0])]
        for k, (section, key) in enumerate(zip(values.waypoints, values.keys[1:], strict=True)):
            for (start, before), (end, after) in pairwise([(0.0, timed[-1][1]), *section, (1.0, key)]):
                if before != after:
                    half = self.timing.ease.time_of(0.5 * (start + end))
                    timed.append((self.timing.when(k + half), after))
        states = {t / self.total: value for t, value in timed}
        if self.backwards:
            states |= {self._mirrored(t) / self.total: before for (_, before), (t, _) in pairwise(timed)}
        self.steps(element, name, dict(sorted(states.items())))

    def _mirrored(self, time: float) -> float:
        """Return when a time on the way there comes again on the way back."""
        return self.timing.when(self.pairs, leaves=True) + self.timing.when(self.pairs) - time

    def _timed(self, values: Values) -> tuple[list[str], dict[str, str]]:
        """Return the values of a run, and the attributes for their times and easing."""
        ease = self.timing.ease
        forth = resting(moments(values, ease), self.timing)
        splines = [moment.ease for moment in forth[:-1]]
        back: list[Moment] = []
        if self.backwards:
            first, last = self.timing.when(0, leaves=True), self.timing.when(self.pairs)
            on_the_way = [moment for moment in forth if first <= moment.time < last]
            splines += [moment.ease.mirrored() for moment in on_the_way[::-1]]
            back = [moment._replace(time=self._mirrored(moment.time)) for moment in on_the_way[::-1]]
        texts = [moment.value for moment in (*forth, *back)]
        extra = {}
        if len(texts) > self.total + 1 or self.timing.rests or not ease.is_linear:
            times = [moment.time / self.total for moment in (*forth, *back)]
            extra["keyTimes"] = ";".join(number(time, TIME_DIGITS) for time in times)
        if not ease.is_linear:
            extra["calcMode"] = "spline"
            extra["keySplines"] = ";".join(" ".join(number(v, 4) for v in spline) for spline in splines)
        return texts, extra

    def _add(
        self,
        element: Element | list[Element],
        tag: str,
        given: dict[str, str],
        texts: Sequence[str],
        extra: dict[str, str],
    ) -> None:
        is_endless = self.timing.repeat in (FOREVER, PINGPONG)
        run = {
            "dur": self.duration,
            **({"begin": f"{number(self.timing.delay, 4)}s"} if self.timing.delay else {}),
            "repeatCount": "indefinite" if is_endless else str(self.timing.repeat),
            **({} if is_endless else {"fill": "freeze"}),
        }
        element.append(document.new(tag, {**given, "values": ";".join(texts), **run, **extra}))

    @property
    def duration(self) -> str:
        """How long a run takes."""
        return f"{number(self.timing.seconds * self.total, 4)}s"
