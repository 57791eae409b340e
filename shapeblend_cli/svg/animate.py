"""Pictures to an SVG file that plays by itself: by SMIL, by CSS, or frame after frame.

What goes on straight paths needs one keyframe a drawing and no more: in between a browser interpolates every number
evenly, which is eq (2). All keyframes of a path have the same commands in the same order.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli.easing import LINEAR, Ease
from shapeblend_cli.svg import document
from shapeblend_cli.svg.attributes import number, paint_attributes, short_path_data, without_defaults

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.model import Box, Frame, Track

FOREVER, PINGPONG = "forever", "pingpong"

DISCRETE = frozenset(("fill_rule", "stroke_linecap", "stroke_linejoin"))
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


def smil_svg(tracks: Sequence[Track], views: Sequence[Box], timing: Timing, decimals: int) -> str:
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
    """
    clock = _Clock(len(views) - 1, timing)
    drawing = document.empty(views[0], decimals)
    boxes = [document.box_text(view, decimals) for view in views]
    if len(set(boxes)) > 1:
        drawing.add(clock.animate(drawing, "viewBox", boxes))
    for track in tracks:
        values = _values(track, decimals)
        path = drawing.path(**{name: keys[0] for name, keys in values.items()})
        for name, keys in values.items():
            held = [keys[0]] * track.first + keys
            held += [keys[-1]] * (len(views) - len(held))
            if len(set(keys)) > 1:
                path.add(clock.animate(drawing, name, held))
        if len(track.keys) < len(views):
            if track.first:
                path["visibility"] = "hidden"
            path.add(clock.shown(drawing, track.first, track.first + len(track.keys) - 1))
        drawing.add(path)
    return document.text(drawing)


class _Clock:
    """The times of keys as shares of one run, there and perhaps back."""

    def __init__(self, pairs: int, timing: Timing) -> None:
        self.pairs = pairs
        self.timing = timing
        self.back = timing.repeat == PINGPONG
        self.total = pairs * (2 if self.back else 1)

    def animate(self, drawing: Any, name: str, values: Sequence[str]) -> Any:
        """An ``animate`` element through all keys."""
        if name in DISCRETE:
            return self._discrete(drawing, name, values)
        there = list(values)
        extra: dict[str, str] = {}
        if not self.timing.ease.is_linear:
            splines = [self.timing.ease] * self.pairs
            splines += [self.timing.ease.mirrored()] * (self.total - self.pairs)
            extra = {
                "calcMode": "spline",
                "keyTimes": ";".join(number(k / self.total, TIME_DIGITS) for k in range(self.total + 1)),
                "keySplines": ";".join(" ".join(number(v, 4) for v in spline) for spline in splines),
            }
        every = there + there[-2::-1] if self.back else there
        return self._element(drawing, name, every, extra)

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
        is_endless = self.timing.repeat in (FOREVER, PINGPONG)
        return drawing.animate(
            attributeName=name.replace("_", "-"),
            values=";".join(values),
            dur=f"{number(self.timing.seconds * self.total, 4)}s",
            repeatCount="indefinite" if is_endless else str(self.timing.repeat),
            **({} if is_endless else {"fill": "freeze"}),
            **extra,
        )


def _values(track: Track, decimals: int) -> dict[str, list[str]]:
    """Every attribute of a path at each of its keys, but for what SVG takes for granted at all of them."""
    keys = [
        {"d": short_path_data(shape.outlines, decimals), **paint_attributes(shape.style, decimals)}
        for shape in track.keys
    ]
    shown = {name for key in keys for name in without_defaults(key)}
    return {name: [key[name] for key in keys] for name in keys[0] if name in shown}


def css_svg(tracks: Sequence[Track], view: Box, timing: Timing, decimals: int) -> str:
    """An SVG document that moves by CSS, and stands still at A for who prefers reduced motion.

    Parameters
    ----------
    tracks : sequence of Track
        In paint order.
    view : Box
        What part of the plane to show; CSS cannot change it.
    timing : Timing
    decimals : int
        Of coordinates.
    """
    last = max(track.first + len(track.keys) for track in tracks) - 1
    ways = {FOREVER: "infinite", PINGPONG: "infinite alternate"}
    run = f"{number(timing.seconds * last, 4)}s {ways.get(str(timing.repeat), f'{timing.repeat} forwards')}"
    ease = (
        "linear" if timing.ease.is_linear else f"cubic-bezier({','.join(number(v, 4) for v in timing.ease)})"
    )
    drawing = document.empty(view, decimals)
    rules, paths = [], []
    for k, track in enumerate(tracks):
        values = _values(track, decimals)
        end = track.first + len(track.keys) - 1
        moving = {name: keys for name, keys in values.items() if len(set(keys)) > 1}
        stops = "".join(
            f"{_percent(i, last)}{{{';'.join(_declaration(n, keys[i - track.first]) for n, keys in moving.items())}}}"
            for i in range(track.first, end + 1)
        )
        # What a path begins or ends with is held before and after.
        if track.first:
            stops = stops.replace(_percent(track.first, last), f"0%,{_percent(track.first, last)}", 1)
        if end < last:
            stops = stops.replace(f"{_percent(end, last)}{{", f"{_percent(end, last)},100%{{", 1)
        rules.append(f"@keyframes m{k}{{{stops}}}")
        animation = f"m{k} {run} {ease}"
        if len(track.keys) <= last:
            shown = {0: "hidden"} if track.first else {}
            shown |= {track.first: "visible"} | ({end: "hidden"} if end < last else {})
            steps = "".join(f"{_percent(i, last)}{{visibility:{value}}}" for i, value in shown.items())
            final = list(shown.values())[-1]
            rules.append(f"@keyframes v{k}{{{steps}100%{{visibility:{final}}}}}")
            animation += f",v{k} {run} step-end"
        rules.append(f"#s{k}{{animation:{animation}}}")
        path = drawing.path(id=f"s{k}", **{name: keys[0] for name, keys in values.items()})
        if track.first:
            path["visibility"] = "hidden"
        paths.append(path)
    rules.append("@media (prefers-reduced-motion:reduce){path{animation:none!important}}")
    for path in paths:
        drawing.add(path)
    return document.text(drawing, style="\n".join(["", *rules, ""]))


def _percent(key: int, last: int) -> str:
    return f"{number(100.0 * key / last, TIME_DIGITS)}%"


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
            paint = without_defaults(paint_attributes(shape.style, decimals))
            picture.add(drawing.path(d=short_path_data(shape.outlines, decimals), **paint))
        drawing.add(picture)
    return document.text(drawing)
