"""Pictures to an SVG file that plays by itself: by SMIL, by CSS, or frame after frame.

What goes on straight paths needs one keyframe a drawing and no more: in between a browser interpolates every number
evenly, which is eq (2). What does not has further keyframes on its way: outlines that move otherwise, and colours. All
keyframes of a path have the same commands in the same order.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple
from xml.etree.ElementTree import Element

from shapeblend_cli.easing import LINEAR, Ease
from shapeblend_cli.model import RadialGradient, Track
from shapeblend_cli.svg.writing import document
from shapeblend_cli.svg.writing.attributes import (
    gradient_attributes,
    number,
    paint_attributes,
    short_path_data,
    without_defaults,
)
from shapeblend_cli.svg.writing.write import Gradients, add_shape, gradient_element

if TYPE_CHECKING:
    from shapeblend_cli.model import Box, Frame, Gradient

FOREVER, PINGPONG = "forever", "pingpong"

Colours = Callable[[str, str], Sequence[str]]
"""Colours at even times from one to another, such that each channel may be interpolated by itself between them."""

Way = Sequence[tuple[float, str]]
"""Values between two keys: how far on the way each lies, within (0, 1). From one to the next numbers go evenly."""

COLOURS = frozenset(("fill", "stroke", "stop_color"))

DISCRETE = frozenset(("fill_rule", "stroke_linecap", "stroke_linejoin", "spreadMethod"))
"""Attributes that have nothing in between and switch at half time."""

TIME_DIGITS = 5


class Timing(NamedTuple):
    """How an animation runs.

    Attributes
    ----------
    seconds : float > 0
        From one drawing to the next.
    ease : Ease
        From one drawing to the next.
    repeat : int or str
        How often it runs; ``forever``; or ``pingpong``: there and back forever.
    """

    seconds: float = 2.0
    ease: Ease = LINEAR
    repeat: int | str = FOREVER


class _Values(NamedTuple):
    """The values of an attribute.

    Attributes
    ----------
    keys : sequence of str
        At each key.
    ways : sequence of Way
        For each key but the last, what is passed before the next one.
    """

    keys: Sequence[str]
    ways: Sequence[Way]

    @property
    def is_still(self) -> bool:
        """Whether all are the same."""
        return len({*self.keys, *(value for way in self.ways for _, value in way)}) == 1


class _Moment(NamedTuple):
    """A value, when it is reached, counted in keys, and how fast it goes on to the next one."""

    time: float
    value: str
    ease: Ease


def smil_svg(
    tracks: Sequence[Track], views: Sequence[Box], timing: Timing, decimals: int, colours: Colours
) -> str:
    """An SVG document that moves by SMIL.

    Parameters
    ----------
    tracks : sequence of Track
        In paint order.
    views : sequence of Box
        What part of the plane to show, a box a key.
    timing : Timing
    decimals : int
        Of coordinates.
    colours : callable
        Gives the colours on the way between two, see `Colours`.
    """
    clock = _Clock(len(views) - 1, timing)
    drawing = document.empty(views[0], decimals)
    gradients: list[Any] = []
    boxes = [document.box_text(view, decimals) for view in views]
    if len(set(boxes)) > 1:
        drawing.add(clock.animate(drawing, "viewBox", _keyed("viewBox", boxes, colours)))
    for track in tracks:
        held = _held(track, len(views))
        attributes = _attributes(held, decimals, colours)
        for paint in ("fill", "stroke"):
            keys = [getattr(shape.style, f"{paint}_gradient") for shape in held.keys]
            if all(keys):
                name = f"gradient-{len(gradients) + 1}"
                gradients.append(_moving_gradient(drawing, clock, name, keys, decimals, colours))
                attributes[paint] = _keyed(paint, [f"url(#{name})"] * len(keys), colours)
        path = drawing.path(**{name: values.keys[0] for name, values in attributes.items()})
        for name, values in attributes.items():
            if not values.is_still:
                path.add(clock.animate(drawing, name, values))
        if len(track.keys) < len(views):
            if track.first:
                path["visibility"] = "hidden"
            path.add(clock.shown(drawing, track.first, track.first + len(track.keys) - 1))
        drawing.add(path)
    return document.text(drawing, definitions=gradients)


def _moving_gradient(
    drawing: Any, clock: _Clock, name: str, keys: Sequence[Gradient], decimals: int, colours: Colours
) -> Element:
    """A gradient that changes as the shape does that is painted in it."""
    as_ellipse = any(isinstance(key, RadialGradient) and key.radii[0] != key.radii[1] for key in keys)
    written = [gradient_attributes(key, decimals, as_ellipse=as_ellipse) for key in keys]
    found = gradient_element(name, keys[0], *written[0])
    stop_elements = list(found)
    moving = []
    for attribute in sorted({key for attributes, _ in written for key in attributes}):
        values = [attributes.get(attribute, "pad") for attributes, _ in written]
        if len(set(values)) == 1:
            continue
        if attribute == "gradientTransform":
            steps = [value.split(") ") for value in values]
            for number_of_step in range(3):
                kinds, numbers = zip(
                    *(step[number_of_step].rstrip(")").split("(") for step in steps), strict=True
                )
                step_values = _keyed(attribute, numbers, colours)
                moving.append(clock.transform(kinds[0], step_values, is_first=number_of_step == 0))
        else:
            moving.append(clock.animate(drawing, attribute, _keyed(attribute, values, colours)).get_xml())
    found[:0] = moving
    for k, element in enumerate(stop_elements):
        for attribute in written[0][1][k]:
            stop_values = _keyed(attribute, [stops[k][attribute] for _, stops in written], colours)
            if not stop_values.is_still:
                element.append(clock.animate(drawing, attribute, stop_values).get_xml())
    return found


class _Clock:
    """The times of keys as shares of one run, there and perhaps back."""

    def __init__(self, pairs: int, timing: Timing) -> None:
        self.pairs = pairs
        self.timing = timing
        self.back = timing.repeat == PINGPONG
        self.total = pairs * (2 if self.back else 1)

    def animate(self, drawing: Any, name: str, values: _Values) -> Any:
        """An ``animate`` element through all keys."""
        if name in DISCRETE or (name == "stroke_dasharray" and len({v.count(" ") for v in values.keys}) > 1):
            return self._discrete(drawing, name, values.keys)
        every, extra = self._timed(values)
        return self._element(drawing, name, every, extra)

    def transform(self, kind: str, values: _Values, *, is_first: bool) -> Element:
        """An ``animateTransform`` element through all keys; further ones come on top of the first."""
        every, extra = self._timed(values)
        if not is_first:
            extra["additive"] = "sum"
        said = {"attributeName": "gradientTransform", "type": kind, "values": ";".join(every)}
        return Element("animateTransform", {**said, **self._run(), **extra})

    def _timed(self, values: _Values) -> tuple[list[str], dict[str, str]]:
        """Values there and perhaps back, and what says when each is reached if that is not self-evident."""
        ease = self.timing.ease
        moments = _moments(values, ease)
        times = [moment.time for moment in moments]
        every = [moment.value for moment in moments]
        splines = [moment.ease for moment in moments[:-1]]
        if self.back:
            times += [self.total - time for time in times[-2::-1]]
            every += every[-2::-1]
            splines += [spline.mirrored() for spline in splines[::-1]]
        extra = {}
        if len(every) > self.total + 1 or not ease.is_linear:
            extra["keyTimes"] = ";".join(number(time / self.total, TIME_DIGITS) for time in times)
        if not ease.is_linear:
            extra["calcMode"] = "spline"
            extra["keySplines"] = ";".join(" ".join(number(v, 4) for v in spline) for spline in splines)
        return every, extra

    def shown(self, drawing: Any, first: int, last: int) -> Any:
        """An ``animate`` element that shows something from one key to another."""
        spans = [(first, last)]
        if self.back:
            spans.append((2 * self.pairs - last, 2 * self.pairs - first))
            if last == self.pairs:
                spans = [(first, 2 * self.pairs - first)]
        moments = {0.0: "hidden"}
        for start, end in spans:
            moments[start / self.total] = "visible"
            if end < self.total:
                moments[end / self.total] = "hidden"
        return self._steps(drawing, "visibility", moments)

    def steps(self, drawing: Any, name: str, values: Sequence[str]) -> Any:
        """An ``animate`` element that gives every value the same time."""
        return self._steps(drawing, name, {k / len(values): value for k, value in enumerate(values)})

    def _discrete(self, drawing: Any, name: str, values: Sequence[str]) -> Any:
        half = self.timing.ease.time_of(0.5)
        moments = {0.0: values[0]}
        for k, value in enumerate(values[1:]):
            moments[(k + half) / self.total] = value
        if self.back:
            for k, value in enumerate(values[:-1]):
                moments[(self.total - k - half) / self.total] = value
        return self._steps(drawing, name, dict(sorted(moments.items())))

    def _steps(self, drawing: Any, name: str, moments: dict[float, str]) -> Any:
        kept: dict[float, str] = {}
        for time, value in moments.items():
            if not kept or value != list(kept.values())[-1]:
                kept[time] = value
        times = ";".join(number(time, TIME_DIGITS) for time in kept)
        return self._element(drawing, name, list(kept.values()), {"calcMode": "discrete", "keyTimes": times})

    def _element(self, drawing: Any, name: str, values: Sequence[str], extra: dict[str, str]) -> Any:
        return drawing.animate(
            attributeName=name.replace("_", "-"), values=";".join(values), **self._run(), **extra
        )

    def _run(self) -> dict[str, str]:
        """How long one run takes, and how often there is one."""
        is_endless = self.timing.repeat in (FOREVER, PINGPONG)
        return {
            "dur": f"{number(self.timing.seconds * self.total, 4)}s",
            "repeatCount": "indefinite" if is_endless else str(self.timing.repeat),
            **({} if is_endless else {"fill": "freeze"}),
        }


def _held(track: Track, drawings: int) -> Track:
    """A track through all drawings: before it begins it is as at its first key, and after its end as at its last."""
    before = track.first
    after = drawings - before - len(track.keys)
    return Track(
        keys=(track.keys[0],) * before + track.keys + (track.keys[-1],) * after,
        first=0,
        ways=((),) * before + track.ways + ((),) * after,
    )


def _attributes(track: Track, decimals: int, colours: Colours) -> dict[str, _Values]:
    """Every attribute of a path, but for those whose values SVG takes for granted at all keys."""
    keys = [
        {"d": short_path_data(shape.paths, decimals), **paint_attributes(shape.style, decimals)}
        for shape in track.keys
    ]
    shown = {name for key in keys for name in without_defaults(key)}
    found = {name: _keyed(name, [key[name] for key in keys], colours) for name in keys[0] if name in shown}
    found["d"] = found["d"]._replace(
        ways=[
            [(waypoint.t, short_path_data(waypoint.paths, decimals)) for waypoint in way]
            for way in track.ways
        ]
    )
    return found


def _keyed(name: str, keys: Sequence[str], colours: Colours) -> _Values:
    """The values of an attribute that goes evenly from key to key, unless it is a colour."""
    ways: list[Way] = []
    for start, end in pairwise(keys):
        stops = colours(start, end) if name in COLOURS and start != end else [start, end]
        ways.append([(n / (len(stops) - 1), stop) for n, stop in enumerate(stops)][1:-1])
    return _Values(keys, ways)


def _moments(values: _Values, ease: Ease, first: int = 0) -> list[_Moment]:
    """What keys, counted on from a number, and what lies between them come to, in order of time."""
    found = []
    for k, (key, way) in enumerate(zip(values.keys[:-1], values.ways, strict=True), first):
        starts = [(0.0, key), *way]
        ends = [*(share for share, _ in way), 1.0]
        found += [
            _Moment(k + ease.time_of(start), value, ease.piece(start, end) if way else ease)
            for (start, value), end in zip(starts, ends, strict=True)
        ]
    return [*found, _Moment(first + len(values.ways), values.keys[-1], ease)]


def css_svg(tracks: Sequence[Track], view: Box, timing: Timing, decimals: int, colours: Colours) -> str:
    """An SVG document that moves by CSS, and stands still at A for who prefers reduced motion.

    Parameters
    ----------
    tracks : sequence of Track
        In paint order. Gradients become plain colours, since CSS cannot change them.
    view : Box
        What part of the plane to show; CSS cannot change that either.
    timing : Timing
    decimals : int
        Of coordinates.
    colours : callable
        Gives the colours on the way between two, see `Colours`.
    """
    every = [_attributes(track, decimals, colours) for track in tracks]
    # Names of its own, so that several drawings can stand in one page.
    seen = [{name: values.keys for name, values in attributes.items()} for attributes in every]
    curved = [way for attributes in every for way in attributes["d"].ways if way]
    prefix = f"b{zlib.crc32(repr((seen, timing, *curved)).encode()):08x}"
    last = max(track.first + len(track.keys) for track in tracks) - 1
    ways = {FOREVER: "infinite", PINGPONG: "infinite alternate"}
    run = f"{number(timing.seconds * last, 4)}s {ways.get(str(timing.repeat), f'{timing.repeat} forwards')}"
    drawing = document.empty(view, decimals)
    rules = []
    for k, (track, attributes) in enumerate(zip(tracks, every, strict=True)):
        name, animations = f"{prefix}-{k}", []
        times = [(track.first + i) / last for i in range(len(track.keys))]
        even: dict[float, list[str]] = {time: [] for time in times}
        for attribute, values in attributes.items():
            if values.is_still:
                continue
            if attribute in COLOURS or any(values.ways):
                moments = _moments(values, timing.ease, track.first)
                rules.append(_keyframes(f"{name}-{attribute}", _timed_keyframes(attribute, moments, last)))
                animations.append(f"{name}-{attribute} {run} linear")
            else:
                for time, value in zip(times, values.keys, strict=True):
                    even[time].append(_declaration(attribute, value))
        if even[times[0]]:
            rules.append(_keyframes(name, even))
            animations.append(f"{name} {run} {timing.ease.css()}")
        path = drawing.path(
            id=name, **{attribute: values.keys[0] for attribute, values in attributes.items()}
        )
        if len(track.keys) <= last:
            shown = {0.0: ["visibility:hidden"], times[0]: ["visibility:visible"]}
            if times[-1] < 1.0:
                shown[times[-1]] = ["visibility:hidden"]
            rules.append(_keyframes(f"{name}-shown", shown))
            animations.append(f"{name}-shown {run} step-end")
            path["visibility"] = "hidden" if track.first else "visible"
        if animations:
            rules.append(f"#{name}{{animation:{','.join(animations)}}}")
        drawing.add(path)
    rules.append(f"@media (prefers-reduced-motion:reduce){{[id^={prefix}]{{animation:none!important}}}}")
    return document.text(drawing, style="\n".join(["", *rules, ""]))


def _keyframes(name: str, declarations: dict[float, list[str]]) -> str:
    """A rule with declarations by time; before the first and after the last these hold."""
    times = sorted(declarations)
    rules = []
    for time in times:
        at = [_percent(time)]
        if time == times[0] and time > 0.0:
            at.insert(0, "0%")
        if time == times[-1] and time < 1.0:
            at.append("100%")
        rules.append(f"{','.join(at)}{{{';'.join(declarations[time])}}}")
    return f"@keyframes {name}{{{''.join(rules)}}}"


def _timed_keyframes(name: str, moments: Sequence[_Moment], last: int) -> dict[float, list[str]]:
    """Declarations of an attribute by time, as a share of all up to the last key; each says how fast it goes on."""
    found = {}
    for moment in moments:
        said = [_declaration(name, moment.value)]
        if not moment.ease.is_linear and moment is not moments[-1]:
            said.append(f"animation-timing-function:{moment.ease.css()}")
        found[moment.time / last] = said
    return found


def _percent(time: float) -> str:
    return f"{number(100.0 * time, TIME_DIGITS)}%"


def _declaration(name: str, value: str) -> str:
    return f'd:path("{value}")' if name == "d" else f"{name.replace('_', '-')}:{value}"


def stacked_svg(frames: Sequence[Frame], timing: Timing, pairs: int, decimals: int) -> str:
    """An SVG document with all frames one over the other, one of them shown at a time.

    Parameters
    ----------
    frames : sequence of Frame
        In order of time, evenly spaced.
    timing : Timing
        The frames are eased already.
    pairs : int
    decimals : int
        Of coordinates.
    """
    order = list(range(len(frames)))
    if timing.repeat == PINGPONG:
        order += order[-2:0:-1]
    view = frames[0].view
    drawing = document.empty(view, decimals)
    clock = _Clock(pairs, timing)
    gradients = Gradients(decimals)
    for k, frame in enumerate(frames):
        if frame.view == view:
            picture = drawing.g()
        else:  # fitted into what the first frame shows
            picture = drawing.svg(
                insert=(number(view.x, decimals), number(view.y, decimals)),
                size=(number(view.width, decimals), number(view.height, decimals)),
                viewBox=document.box_text(frame.view, decimals),
            )
        picture["visibility"] = "hidden" if k else "visible"
        picture.add(clock.steps(drawing, "visibility", ["visible" if k == n else "hidden" for n in order]))
        for shape in frame.shapes:
            add_shape(picture, drawing, gradients, shape, short_path_data(shape.paths, decimals), frame.t)
        drawing.add(picture)
    return document.text(drawing, definitions=gradients.elements)
