"""The values of an attribute over time, for SMIL and CSS animations.

A vertex on a straight path needs one keyframe a drawing: in between, browsers interpolate every number linearly, which
is eq (2). Curved motion and colours get further keyframes at waypoints. All keyframes of a path have the same commands
in the same order.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple
from xml.etree.ElementTree import Element

from shapeblend_cli.model import Box, KeyframedShape, Pose, Style
from shapeblend_cli.options.easing import FOREVER, LINEAR, PINGPONG, Ease, Timing
from shapeblend_cli.paint.oklab import colour_stops
from shapeblend_cli.paint.styles import INSTANT
from shapeblend_cli.svg.writing import document
from shapeblend_cli.svg.writing.paint import (
    SIDES,
    STROKE_LENGTHS,
    Gradients,
    hyphened,
    paint_attributes,
    without_defaults,
)
from shapeblend_cli.svg.writing.path_data import short_path_data
from shapeblend_cli.svg.writing.rounding import number

COLOURS = frozenset(("fill", "stroke", "stop_color", "flood_color", "lighting_color"))

DISCRETE = frozenset(
    "fill_rule stroke_linecap stroke_linejoin vector_effect spreadMethod paint_order class".split()
)
"""Attributes without values in between, which switch at half time."""

OPACITIES = ("fill_opacity", "stroke_opacity")

TIME_DIGITS = 5

ANGLE_DIGITS = 4
"""Minimum number of decimals of the transforms of a picture."""


class Values(NamedTuple):
    """The values of an attribute over time: at keys, and at waypoints between each key and the next one.

    A waypoint is how far from key to key it lies, within (0, 1), and its value. Numbers are interpolated linearly from
    each value to the next.
    """

    keys: Sequence[str]
    waypoints: Sequence[Sequence[tuple[float, str]]]

    @property
    def is_constant(self) -> bool:
        """Whether all are the same."""
        return len({*self.keys, *(value for section in self.waypoints for _, value in section)}) == 1


class Views(NamedTuple):
    """Parts of the plane that are shown: at each key, or at `times`, counted in keys."""

    boxes: Sequence[Box]
    times: Sequence[float] = ()

    @property
    def pairs(self) -> int:
        """Number of keys but one."""
        return int(self.times[-1]) if self.times else len(self.boxes) - 1


class Moment(NamedTuple):
    """A value, the time it is reached, counted in keys, and the easing from it to the next one."""

    time: float
    value: str
    ease: Ease


def values_between(name: str, texts: Sequence[str], times: Sequence[float] = ()) -> Values:
    """Return the values of an attribute that is interpolated linearly from value to value, unless it is a colour.

    Without `times`, counted in keys, all values are at keys.
    """
    keys: list[str] = []
    waypoints: list[list[tuple[float, str]]] = []
    for (begin, start), (until, end) in pairwise(zip(times or range(len(texts)), texts, strict=True)):
        share = begin % 1.0
        if share == 0.0:
            keys.append(start)
            waypoints.append([])
        else:
            waypoints[-1].append((share, start))
        stops = colour_stops(start, end) if name in COLOURS and start != end else [start, end]
        steps = [(share + (until - begin) * n / (len(stops) - 1), stop) for n, stop in enumerate(stops)]
        waypoints[-1] += steps[1:-1]
    return Values([*keys, texts[-1]], waypoints)


def attribute_values(shape: KeyframedShape, decimals: int) -> dict[str, Values]:
    """Return the values of every attribute of a path, except those that have their initial value at all keys."""
    keys = [
        {"d": short_path_data(key.paths, decimals), **paint_attributes(key.style, decimals)}
        for key in shape.keys
    ]
    written = {name for key in keys for name in without_defaults(key)}
    values = {name: values_between(name, [key[name] for key in keys]) for name in keys[0] if name in written}
    if "vector_effect" in values and not shape.is_paced:
        for name in STROKE_LENGTHS:
            if name in values:
                values[name] = _switched(values[name], [key["vector_effect"] for key in keys])
    if any(shape.fading):
        times, styles = fading_keys(shape)
        paints = [paint_attributes(style, decimals) for style in styles]
        for name in values.keys() - {"d"} if shape.is_paced else OPACITIES:
            if name in paints[0]:
                values[name] = values_between(name, [paint[name] for paint in paints], times)
    if shape.spans:
        values = {name: delayed(value, shape.spans) for name, value in values.items()}
    waypoints = [[(w.t, short_path_data(w.paths, decimals)) for w in section] for section in shape.waypoints]
    values["d"] = values["d"]._replace(waypoints=waypoints)
    return values


class ImageValues(NamedTuple):
    """The values over time of a picture: of attributes, and of the transforms that place it, if it is not upright."""

    attributes: dict[str, Values]
    transforms: list[tuple[str, Values]]  # functions of ``transform``, the first of them ``translate``

    @property
    def first(self) -> dict[str, str]:
        """The attributes at first."""
        found = {name: values.keys[0] for name, values in self.attributes.items()}
        if self.transforms:
            placed = " ".join(f"{kind}({values.keys[0]})" for kind, values in self.transforms)
            found |= {"x": "-.5", "y": "-.5", "width": "1", "height": "1", "transform": placed}
        return found

    @property
    def is_still(self) -> bool:
        """Whether it stays in its place."""
        return all(values.is_constant for _, values in self.transforms)


def image_values(shape: KeyframedShape, decimals: int, *, boxes: bool = True) -> ImageValues:
    """Return the values of a picture: of its box where it is upright, if programs can move boxes, or of transforms."""
    times, styles = fading_keys(shape if shape.is_paced else shape._replace(fading=()))
    poses: list[Pose] = []
    for style in styles:
        assert style.picture is not None, "what is a picture stays one"
        poses.append(style.picture.pose.near(poses[-1]) if poses else style.picture.pose)

    def over_time(name: str, texts: Sequence[str]) -> Values:
        return delayed(values_between(name, texts, times), shape.spans)

    found = attribute_values(shape, decimals)
    attributes = {"opacity": found["fill_opacity"]} if "fill_opacity" in found else {}
    if boxes and all(pose.is_upright for pose in poses):
        for name, of in zip(SIDES, _SIDES, strict=True):
            attributes[name] = over_time(name, [number(of(pose), decimals) for pose in poses])
        return ImageValues(attributes, [])
    kinds: dict[str, list[tuple[float, ...]]] = {
        "translate": [(pose.centre.real, pose.centre.imag) for pose in poses],
        "rotate": [(pose.angle,) for pose in poses],
        "skewX": [(pose.skew,) for pose in poses],
        "scale": [(pose.width, pose.height) for pose in poses],
    }
    transforms = [
        (
            kind,
            over_time(
                kind, [" ".join(number(one, max(decimals, ANGLE_DIGITS)) for one in each) for each in every]
            ),
        )
        for kind, every in kinds.items()
        if kind in ("translate", "scale") or any(each != (0.0,) for each in every)
    ]
    return ImageValues(attributes, transforms)


def text_values(shape: KeyframedShape, decimals: int) -> ImageValues:
    """Return the values of a text: of its colour and opacity, and of the transforms that place its box."""
    found = attribute_values(shape, decimals)
    paint: dict[str, Values] = {name: found[name] for name in ("fill", "fill_opacity") if name in found}
    return image_values(shape, decimals, boxes=False)._replace(attributes=paint)


def moving_text(style: Style, values: ImageValues, contents: Gradients) -> Element:
    """Return a group of a text, which has its paint at first, and its place if the text moves."""
    from shapeblend_cli.svg.writing.kept.text_element import centred  # few blends have any

    assert style.picture is not None
    first = {} if values.is_still else {"transform": values.first["transform"]}
    paint = {name: each.keys[0] for name, each in values.attributes.items()}
    group = Element("g", dict(sorted(hyphened(without_defaults({**first, **paint})).items())))
    place = style.picture if values.is_still else centred(style.picture)
    group.append(contents.text(style, at=place, is_painted=False))
    return group


_SIDES: tuple[Callable[[Pose], float], ...] = (
    lambda pose: pose.centre.real - 0.5 * pose.width,
    lambda pose: pose.centre.imag - 0.5 * pose.height,
    lambda pose: pose.width,
    lambda pose: pose.height,
)


def fading_keys(shape: KeyframedShape) -> tuple[list[float], list[Style]]:
    """Return the styles of a shape at its keys and while it fades, with their times, counted in keys."""
    timed = [(float(k), key.style) for k, key in enumerate(shape.keys)]
    timed += [(k + t, style) for k, each in enumerate(shape.fading) for t, style in each]
    times, styles = zip(*sorted(timed, key=lambda one: one[0]), strict=True)
    return list(times), list(styles)


def _switched(values: Values, kinds: Sequence[str]) -> Values:
    """Return values that change at half time from keys of one kind to those of another one."""
    steps = zip(pairwise(values.keys), pairwise(kinds), values.waypoints, strict=True)
    return values._replace(
        waypoints=[
            section if kind == other else [(0.5 - INSTANT, start), (0.5, end)]
            for (start, end), (kind, other), section in steps
        ]
    )


def delayed(values: Values, spans: Sequence[tuple[float, float]]) -> Values:
    """Return values that change only from one time to another between each key and the next."""
    if not spans:
        return values
    waypoints = []
    for k, ((begin, until), section) in enumerate(zip(spans, values.waypoints, strict=True)):
        inner = [(begin + share * (until - begin), value) for share, value in section]
        timed = [(begin, values.keys[k]), *inner, (until, values.keys[k + 1])]
        waypoints.append([(t, value) for t, value in timed if 0.0 < t < 1.0])
    return Values(values.keys, waypoints)


def moments(values: Values, ease: Ease, first: int = 0) -> list[Moment]:
    """Return keys, counted from `first`, and waypoints in order of time."""
    timed = []
    for k, (key, waypoints) in enumerate(zip(values.keys[:-1], values.waypoints, strict=True), first):
        starts = [(0.0, key), *waypoints]
        ends = [*(share for share, _ in waypoints), 1.0]
        timed += [
            Moment(k + ease.time_of(start), value, ease.piece(start, end) if waypoints else ease)
            for (start, value), end in zip(starts, ends, strict=True)
        ]
    return [*timed, Moment(first + len(values.waypoints), values.keys[-1], ease)]


def resting(timed: Sequence[Moment], timing: Timing) -> list[Moment]:
    """Return moments in times of `timing.seconds`, with a second one wherever a drawing is left after a rest."""
    found = []
    for moment in timed:
        reached = timing.when(moment.time)
        left = timing.when(moment.time, leaves=True) if float(moment.time).is_integer() else reached
        if left > reached:
            found.append(Moment(reached, moment.value, LINEAR))
        found.append(moment._replace(time=left))
    return found


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
        self, element: Element | list[Element], kind: str, values: Values, name: str = "gradientTransform"
    ) -> None:
        """Animate a part of a transform through all keys; all but the first, a translation, are added."""
        texts, extra = self._timed(values)
        if kind != "translate":
            extra["additive"] = "sum"
        given = {"attributeName": name, "type": kind}
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
