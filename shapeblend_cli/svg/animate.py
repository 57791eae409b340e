"""Pictures to an SVG file that plays by itself: by SMIL, by CSS, or frame after frame.

What goes on straight paths needs one keyframe a drawing and no more: in between a browser interpolates every number
evenly, which is eq (2). All keyframes of a path have the same commands in the same order.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar
from xml.etree.ElementTree import Element

from shapeblend_cli.easing import LINEAR, Ease
from shapeblend_cli.model import RadialGradient
from shapeblend_cli.svg import document
from shapeblend_cli.svg.attributes import (
    gradient_attributes,
    number,
    paint_attributes,
    short_path_data,
    without_defaults,
)
from shapeblend_cli.svg.write import Gradients, add_shape, gradient_element

if TYPE_CHECKING:
    from shapeblend_cli.model import Box, Frame, Gradient, Track

FOREVER, PINGPONG = "forever", "pingpong"

Colours = Callable[[str, str], Sequence[str]]
"""Colours at even times from one to another, such that each channel may be interpolated by itself between them."""

Key = TypeVar("Key")

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
    clock = _Clock(len(views) - 1, timing, colours)
    drawing = document.empty(views[0], decimals)
    gradients: list[Any] = []
    boxes = [document.box_text(view, decimals) for view in views]
    if len(set(boxes)) > 1:
        drawing.add(clock.animate(drawing, "viewBox", boxes))
    for track in tracks:
        values = _values(track, decimals)
        for paint in ("fill", "stroke"):
            keys = [getattr(shape.style, f"{paint}_gradient") for shape in track.keys]
            if all(keys):
                name = f"gradient-{len(gradients) + 1}"
                held = clock.held(keys, track.first)
                gradients.append(_moving_gradient(drawing, clock, name, held, decimals))
                values[paint] = [f"url(#{name})"] * len(keys)
        path = drawing.path(**{name: keys[0] for name, keys in values.items()})
        for name, keys in values.items():
            if len(set(keys)) > 1:
                path.add(clock.animate(drawing, name, clock.held(keys, track.first)))
        if len(track.keys) < len(views):
            if track.first:
                path["visibility"] = "hidden"
            path.add(clock.shown(drawing, track.first, track.first + len(track.keys) - 1))
        drawing.add(path)
    return document.text(drawing, definitions=gradients)


def _moving_gradient(
    drawing: Any, clock: _Clock, name: str, keys: Sequence[Gradient], decimals: int
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
                moving.append(clock.transform(kinds[0], numbers, is_first=number_of_step == 0))
        else:
            moving.append(clock.animate(drawing, attribute, values).get_xml())
    found[:0] = moving
    for k, element in enumerate(stop_elements):
        for attribute in written[0][1][k]:
            values = [stops[k][attribute] for _, stops in written]
            if len(set(values)) > 1:
                element.append(clock.animate(drawing, attribute, values).get_xml())
    return found


class _Clock:
    """The times of keys as shares of one run, there and perhaps back."""

    def __init__(self, pairs: int, timing: Timing, colours: Colours = lambda p, q: [p, q]) -> None:
        self.pairs = pairs
        self.timing = timing
        self.colours = colours
        self.back = timing.repeat == PINGPONG
        self.total = pairs * (2 if self.back else 1)

    def held(self, keys: Sequence[Key], first: int) -> list[Key]:
        """The values of all keys: before and after a track its first and its last."""
        found = [keys[0]] * first + list(keys)
        return found + [keys[-1]] * (self.pairs + 1 - len(found))

    def animate(self, drawing: Any, name: str, values: Sequence[str]) -> Any:
        """An ``animate`` element through all keys."""
        if name in DISCRETE or (name == "stroke_dasharray" and len({v.count(" ") for v in values}) > 1):
            return self._discrete(drawing, name, values)
        every, extra = self._timed(values, name in COLOURS)
        return self._element(drawing, name, every, extra)

    def transform(self, kind: str, values: Sequence[str], *, is_first: bool) -> Element:
        """An ``animateTransform`` element through all keys; further ones come on top of the first."""
        every, extra = self._timed(values, is_colour=False)
        if not is_first:
            extra["additive"] = "sum"
        said = {"attributeName": "gradientTransform", "type": kind, "values": ";".join(every)}
        return Element("animateTransform", {**said, **self._run(), **extra})

    def _timed(self, values: Sequence[str], is_colour: bool) -> tuple[list[str], dict[str, str]]:
        """Values there and perhaps back, and what says when each is reached if that is not self-evident."""
        ease = self.timing.ease
        times, every, splines = [0.0], [values[0]], []
        for k, (start, end) in enumerate(pairwise(values)):
            stops = self.colours(start, end) if is_colour and start != end else [start, end]
            steps = len(stops) - 1
            for n in range(steps):
                times.append(k + ease.time_of((n + 1) / steps))
                every.append(stops[n + 1])
                splines.append(ease if steps == 1 else ease.piece(n / steps, (n + 1) / steps))
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


def _values(track: Track, decimals: int) -> dict[str, list[str]]:
    """Every attribute of a path at each of its keys, but for what SVG takes for granted at all of them."""
    keys = [
        {"d": short_path_data(shape.outlines, decimals), **paint_attributes(shape.style, decimals)}
        for shape in track.keys
    ]
    shown = {name for key in keys for name in without_defaults(key)}
    return {name: [key[name] for key in keys] for name in keys[0] if name in shown}


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
    values = [_values(track, decimals) for track in tracks]
    # Names of its own, so that several drawings can stand in one page.
    prefix = f"b{zlib.crc32(repr((values, timing)).encode()):08x}"
    last = max(track.first + len(track.keys) for track in tracks) - 1
    ways = {FOREVER: "infinite", PINGPONG: "infinite alternate"}
    run = f"{number(timing.seconds * last, 4)}s {ways.get(str(timing.repeat), f'{timing.repeat} forwards')}"
    drawing = document.empty(view, decimals)
    rules = []
    for k, (track, keyed) in enumerate(zip(tracks, values, strict=True)):
        name, animations = f"{prefix}-{k}", []
        times = [(track.first + i) / last for i in range(len(track.keys))]
        even: dict[float, list[str]] = {time: [] for time in times}
        for attribute, keys in keyed.items():
            if len(set(keys)) == 1:
                continue
            if attribute in COLOURS:
                steps = _colour_keyframes(attribute, keys, track.first, last, timing.ease, colours)
                rules.append(_keyframes(f"{name}-{attribute}", steps))
                animations.append(f"{name}-{attribute} {run} linear")
            else:
                for time, value in zip(times, keys, strict=True):
                    even[time].append(_declaration(attribute, value))
        if even[times[0]]:
            rules.append(_keyframes(name, even))
            animations.append(f"{name} {run} {timing.ease.css()}")
        path = drawing.path(id=name, **{attribute: keys[0] for attribute, keys in keyed.items()})
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


def _colour_keyframes(
    name: str, keys: Sequence[str], first: int, last: int, ease: Ease, colours: Colours
) -> dict[float, list[str]]:
    """Declarations of a colour by time; each says how fast it goes on."""
    found = {}
    for k, (start, end) in enumerate(pairwise(keys), first):
        stops = colours(start, end) if start != end else [start, end]
        steps = len(stops) - 1
        for n, stop in enumerate(stops[:-1]):
            said = [_declaration(name, stop)]
            if not ease.is_linear:
                speed = ease if steps == 1 else ease.piece(n / steps, (n + 1) / steps)
                said.append(f"animation-timing-function:{speed.css()}")
            found[(k + ease.time_of(n / steps)) / last] = said
    found[(first + len(keys) - 1) / last] = [_declaration(name, keys[-1])]
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
            add_shape(picture, drawing, gradients, shape, short_path_data(shape.outlines, decimals), frame.t)
        drawing.add(picture)
    return document.text(drawing, definitions=gradients.elements)
