"""A blend as a Lottie animation: JSON that lottie-web, lottie-ios, lottie-android, After Effects and others play.

A layer for every shape, the topmost first, with two keyframes, and more where its outlines go otherwise than straight.
The format: https://lottie.github.io/lottie-spec/
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from shapeblend_cli.model import Box
from shapeblend_cli.svg.writing.rounding import number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.easing import Ease
    from shapeblend_cli.model import ComplexArray, CubicPath
    from shapeblend_cli.outputs.move import Leg, Move, MovedShape

VERSION = "5.7.4"
"""Of the format; players mend what older versions did otherwise."""

FRAME_RATE = 60

SIZE = 512
"""Pixels of the longer side, which players scale as they like, unless the drawing's own size will do."""

OWN_SIZES = range(100, 4097)
"""Longer sides that do; both sides must be whole numbers."""

TIME_DIGITS = 3
"""Decimals of frames; those of waypoints need not be whole."""

MITER_LIMIT = 4
"""SVG's."""

FILL_RULES = {"nonzero": 1, "evenodd": 2}
LINE_CAPS = {"butt": 1, "round": 2, "square": 3}
LINE_JOINS = {"miter": 1, "round": 2, "bevel": 3}


def lottie(moves: Sequence[Move], seconds: float, ease: Ease, decimals: int) -> str:
    """A Lottie animation of drawings that become one another in turn.

    The frame named by `op` is not shown, so there is one more than `seconds` has: the last one shows the last drawing.

    Parameters
    ----------
    moves : sequence of Move
        Each begins with the picture the one before ends with.
    seconds : float
        How long each move takes.
    ease : Ease
        How fast when within a move.
    decimals : int
        Of coordinates.
    """
    view = Box.union([box for move in moves for box in move.views])
    is_whole = view.width.is_integer() and view.height.is_integer()
    longer = view.larger_side
    scale = 1.0 if is_whole and longer in OWN_SIZES else SIZE / longer
    width, height = (max(1, round(scale * side)) for side in (view.width, view.height))
    frames = max(1, round(FRAME_RATE * seconds))
    last = frames * len(moves) + 1
    layers = []
    for k, move in enumerate(moves):
        keys = _Keys(frames * k, frames * (k + 1), ease)
        until = keys.end if k + 1 < len(moves) else last
        for shape in move.shapes():
            shapes = _shapes(shape, keys, decimals)
            placed = {"ks": _placed(view, scale, (width, height), decimals), "ao": 0, "shapes": shapes}
            times = {"ip": keys.start, "op": until, "st": 0}
            layers.append({"ddd": 0, "ty": 4, "nm": shape.name, "sr": 1, **placed, **times, "bm": 0})
    layers.reverse()  # in Lottie what comes first is on top
    found = {
        "v": VERSION,
        "fr": FRAME_RATE,
        "ip": 0,
        "op": last,
        "w": width,
        "h": height,
        "nm": "blend",
        "ddd": 0,
        "assets": [],
        "layers": [{"ind": ind, **layer} for ind, layer in enumerate(layers, 1)],
    }
    return json.dumps(found, separators=(",", ":"), allow_nan=False) + "\n"


class _Keys:
    """The keyframes of a move: two of them, unless it is said what lies in between."""

    def __init__(self, start: int, end: int, ease: Ease) -> None:
        self.start = start
        self.end = end
        self.ease = ease

    def value(self, start: Any, end: Any) -> dict[str, Any]:
        """A number or a list of numbers that moves, or stays."""
        if start == end:
            return {"a": 0, "k": start}
        x1, y1, x2, y2 = _curve(self.ease)
        speed = {"o": {"x": [x1], "y": [y1]}, "i": {"x": [x2], "y": [y2]}}
        first, last = (v if isinstance(v, list) else [v] for v in (start, end))
        return {"a": 1, "k": [{"t": self.start, "s": first, **speed}, {"t": self.end, "s": last}]}

    def legs(self, shape: MovedShape) -> list[Leg]:
        """The way of a shape's outlines, in frames of the move."""
        return shape.legs(self.end - self.start, self.ease, TIME_DIGITS)

    def path(self, legs: Sequence[Leg], contour: int, decimals: int) -> dict[str, Any]:
        """A path that moves, or stays: one of the contours of a shape."""
        end = _bezier(legs[-1].end[contour], decimals)
        starts = [_bezier(leg.start[contour], decimals) for leg in legs]
        if all(start == end for start in starts):
            return {"a": 0, "k": end}
        found: list[dict[str, Any]] = []
        for leg, start in zip(legs, starts, strict=True):
            x1, y1, x2, y2 = _curve(leg.ease)
            time = _plain(self.start + leg.times[0], TIME_DIGITS)
            found.append({"t": time, "s": [start], "o": {"x": x1, "y": y1}, "i": {"x": x2, "y": y2}})
        return {"a": 1, "k": [*found, {"t": self.end, "s": [end]}]}


def _curve(ease: Ease) -> list[float]:
    return [_plain(value, 4) for value in ease]


def _placed(view: Box, scale: float, size: tuple[int, int], decimals: int) -> dict[str, Any]:
    """The transform that lays the centre of the view on the centre of the picture."""
    middle = view.centre.real, view.centre.imag
    centre = [*(_plain(value, decimals + 1) for value in middle), 0]  # half of a side has one decimal more
    percent = float(f"{100 * scale:.9g}")
    percent = int(percent) if percent.is_integer() else percent
    values = {"o": 100, "r": 0, "p": [*(_plain(side / 2, 1) for side in size), 0], "a": centre}
    return {name: {"a": 0, "k": v} for name, v in {**values, "s": [percent, percent, 100]}.items()}


def _shapes(shape: MovedShape, keys: _Keys, decimals: int) -> list[dict[str, Any]]:
    """The one group of a layer: paths, and what paints them, the upper paint first."""
    items: list[dict[str, Any]] = []
    legs = keys.legs(shape)
    for k in range(len(shape.start.paths)):
        items.append({"ty": "sh", "nm": f"contour-{k + 1}", "ks": keys.path(legs, k, decimals)})
    s, e = shape.start.style, shape.end.style
    if s.stroke is not None and e.stroke is not None:
        stroke = {
            "c": keys.value(_colour(s.stroke), _colour(e.stroke)),
            "o": keys.value(_percent(s.stroke_opacity), _percent(e.stroke_opacity)),
            "w": keys.value(_plain(s.stroke_width, decimals), _plain(e.stroke_width, decimals)),
            "lc": LINE_CAPS[s.stroke_linecap],
            "lj": LINE_JOINS[s.stroke_linejoin],
            "ml": MITER_LIMIT,
        }
        items.append({"ty": "st", "nm": "stroke", **stroke})
    if s.fill is not None and e.fill is not None:
        fill = {
            "c": keys.value(_colour(s.fill), _colour(e.fill)),
            "o": keys.value(_percent(s.fill_opacity), _percent(e.fill_opacity)),
            "r": FILL_RULES[s.fill_rule],
        }
        items.append({"ty": "fl", "nm": "fill", **fill})
    still = {"p": [0, 0], "a": [0, 0], "s": [100, 100], "r": 0, "o": 100}
    items.append({"ty": "tr", **{name: {"a": 0, "k": value} for name, value in still.items()}})
    return [{"ty": "gr", "nm": "paths", "it": items}]


def _bezier(outline: CubicPath, decimals: int) -> dict[str, Any]:
    """Vertices with the tangents that come in and go out, relative to them; a closed path has its first vertex once."""
    first, second, third, fourth = outline.segments.T
    leaving = np.where(outline.straight, 0.0, second - first)
    coming = np.where(outline.straight, 0.0, third - fourth)
    if outline.closed:
        vertices, coming = first, np.roll(coming, 1)
    else:
        vertices = np.append(first, fourth[-1])
        leaving, coming = np.append(leaving, 0.0), np.append(0.0, coming)
    lists = {"v": vertices, "i": coming, "o": leaving}
    return {"c": outline.closed, **{name: _points(z, decimals) for name, z in lists.items()}}


def _points(values: ComplexArray, decimals: int) -> list[list[float]]:
    return [[_plain(z.real, decimals), _plain(z.imag, decimals)] for z in values.tolist()]


def _colour(text: str) -> list[float]:
    """``#rrggbb`` as shares of 1, with the opaque alpha some players expect."""
    return [*(_plain(c / 255, 4) for c in bytes.fromhex(text[1:])), 1]


def _percent(share: float) -> float:
    return _plain(100 * share, 2)


def _plain(value: float, decimals: int) -> float:
    """A rounded number, an int where it is whole: JSON then has it in its shortest form."""
    rounded = float(number(value, decimals))
    return int(rounded) if rounded.is_integer() else rounded
