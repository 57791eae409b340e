"""A blend as a Lottie animation: JSON that lottie-web, lottie-ios, lottie-android, After Effects and others play.

A layer for every shape, the topmost first, with two keyframes, and one more for each waypoint of its paths.
The format: https://lottie.github.io/lottie-spec/
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli.outputs.formats import Format, OutputSpec, Rendered
from shapeblend_cli.svg.writing.rounding import number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.easing import Ease, Timing
    from shapeblend_cli.model import Box, CubicPath, Pair
    from shapeblend_cli.outputs.move import Move, MovedShape, Section

VERSION = "5.7.4"
"""Of the format; players correct what older versions did otherwise."""

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


def lottie(moves: Sequence[Move], timing: Timing, decimals: int) -> str:
    """Return a Lottie animation of one move after another, coordinates with so many decimals.

    The frame named by `op` is not shown, so there is one more than in the seconds: the last one shows the last drawing.
    """
    import json

    from shapeblend_cli.model import Box

    view = Box.union([box for move in moves for box in move.views])
    is_whole = view.width.is_integer() and view.height.is_integer()
    scale = 1.0 if is_whole and view.larger_side in OWN_SIZES else SIZE / view.larger_side
    size = max(1, round(scale * view.width)), max(1, round(scale * view.height))
    placement = _placement(view, scale, size, decimals)
    frames = max(1, round(FRAME_RATE * timing.seconds))
    last = frames * len(moves) + 1
    layers = []
    for k, move in enumerate(moves):
        keys = _Keyframes(frames * k, frames * (k + 1), timing.ease, decimals)
        until = keys.end if k + 1 < len(moves) else last
        for shape in move.shapes:
            placed = {"ks": placement, "ao": 0, "shapes": [_group(shape, keys)]}
            times = {"ip": keys.start, "op": until, "st": 0}
            layers.append({"ddd": 0, "ty": 4, "nm": shape.name, "sr": 1, **placed, **times, "bm": 0})
    layers.reverse()  # in Lottie what comes first is on top
    animation = {
        "v": VERSION,
        "fr": FRAME_RATE,
        "ip": 0,
        "op": last,
        "w": size[0],
        "h": size[1],
        "nm": "blend",
        "ddd": 0,
        "assets": [],
        "layers": [{"ind": ind, **layer} for ind, layer in enumerate(layers, 1)],
    }
    return json.dumps(animation, separators=(",", ":"), allow_nan=False) + "\n"


class _Keyframes(NamedTuple):
    """The keyframes of a move: frames of its start and its end, and what is between."""

    start: int
    end: int
    ease: Ease
    decimals: int

    def value(self, start: Any, end: Any) -> dict[str, Any]:
        """Return a property of numbers or lists of numbers."""
        if start == end:
            return {"a": 0, "k": start}
        x1, y1, x2, y2 = (_rounded(value, 4) for value in self.ease)
        speed = {"o": {"x": [x1], "y": [y1]}, "i": {"x": [x2], "y": [y2]}}
        first, last = (v if isinstance(v, list) else [v] for v in (start, end))
        return {"a": 1, "k": [{"t": self.start, "s": first, **speed}, {"t": self.end, "s": last}]}

    def opacity(self, shape: MovedShape, paint: str) -> dict[str, Any]:
        """Return the property of the opacity of a paint."""
        sections = shape.opacities(paint, self.end - self.start, self.ease, TIME_DIGITS)
        end = _percent(sections[-1].end)
        starts = [_percent(section.start) for section in sections]
        if len(sections) == 1 or all(start == end for start in starts):
            return self.value(starts[0], end)
        keys: list[dict[str, Any]] = []
        for section, start in zip(sections, starts, strict=True):
            x1, y1, x2, y2 = (_rounded(value, 4) for value in section.ease)
            time = _rounded(self.start + section.times[0], TIME_DIGITS)
            keys.append({"t": time, "s": [start], "o": {"x": [x1], "y": [y1]}, "i": {"x": [x2], "y": [y2]}})
        return {"a": 1, "k": [*keys, {"t": self.end, "s": [end]}]}

    def path(self, sections: Sequence[Section[tuple[CubicPath, ...]]], contour: int) -> dict[str, Any]:
        """Return the property of one of the paths of a shape."""
        end = _bezier(sections[-1].end[contour], self.decimals)
        starts = [_bezier(section.start[contour], self.decimals) for section in sections]
        if all(start == end for start in starts):
            return {"a": 0, "k": end}
        keys: list[dict[str, Any]] = []
        for section, start in zip(sections, starts, strict=True):
            x1, y1, x2, y2 = (_rounded(value, 4) for value in section.ease)
            time = _rounded(self.start + section.times[0], TIME_DIGITS)
            keys.append({"t": time, "s": [start], "o": {"x": x1, "y": y1}, "i": {"x": x2, "y": y2}})
        return {"a": 1, "k": [*keys, {"t": self.end, "s": [end]}]}


def _constant(values: dict[str, Any]) -> dict[str, Any]:
    return {name: {"a": 0, "k": value} for name, value in values.items()}


def _placement(view: Box, scale: float, size: tuple[int, int], decimals: int) -> dict[str, Any]:
    """Return the transform that lays the centre of the view on the centre of the picture."""
    # Half of a side has one decimal more.
    centre = [*(_rounded(value, decimals + 1) for value in (view.centre.real, view.centre.imag)), 0]
    percent = float(f"{100 * scale:.9g}")
    percent = int(percent) if percent.is_integer() else percent
    position = [*(_rounded(side / 2, 1) for side in size), 0]
    return _constant({"o": 100, "r": 0, "p": position, "a": centre, "s": [percent, percent, 100]})


def _group(shape: MovedShape, keys: _Keyframes) -> dict[str, Any]:
    """Return paths and their paint, the upper one first."""
    sections = shape.sections(keys.end - keys.start, keys.ease, TIME_DIGITS)
    items: list[dict[str, Any]] = [
        {"ty": "sh", "nm": f"contour-{k + 1}", "ks": keys.path(sections, k)}
        for k in range(len(shape.start.paths))
    ]
    s, e = shape.start.style, shape.end.style
    if s.stroke is not None and e.stroke is not None:
        stroke = {
            "c": keys.value(_colour(s.stroke), _colour(e.stroke)),
            "o": keys.opacity(shape, "stroke"),
            "w": keys.value(*(_rounded(style.stroke_width, keys.decimals) for style in (s, e))),
            "lc": LINE_CAPS[s.stroke_linecap],
            "lj": LINE_JOINS[s.stroke_linejoin],
            "ml": MITER_LIMIT,
        }
        items.append({"ty": "st", "nm": "stroke", **stroke})
    if s.fill is not None and e.fill is not None:
        fill = {
            "c": keys.value(_colour(s.fill), _colour(e.fill)),
            "o": keys.opacity(shape, "fill"),
            "r": FILL_RULES[s.fill_rule],
        }
        items.append({"ty": "fl", "nm": "fill", **fill})
    still = _constant({"p": [0, 0], "a": [0, 0], "s": [100, 100], "r": 0, "o": 100})
    return {"ty": "gr", "nm": "paths", "it": [*items, {"ty": "tr", **still}]}


def _bezier(path: CubicPath, decimals: int) -> dict[str, Any]:
    """Return vertices with the tangents before and after them; a closed path has its first vertex once."""
    segments = path.segments.tolist()
    lines = path.straight.tolist()
    vertices = [p0 for p0, *_ in segments]
    leaving = [0j if line else p1 - p0 for (p0, p1, _, _), line in zip(segments, lines, strict=True)]
    arriving = [0j if line else p2 - p3 for (_, _, p2, p3), line in zip(segments, lines, strict=True)]
    if path.closed:
        arriving = [arriving[-1], *arriving[:-1]]
    else:
        vertices, leaving, arriving = [*vertices, segments[-1][3]], [*leaving, 0j], [0j, *arriving]
    lists = {"v": vertices, "i": arriving, "o": leaving}
    return {
        "c": path.closed,
        **{
            name: [[_rounded(z.real, decimals), _rounded(z.imag, decimals)] for z in points]
            for name, points in lists.items()
        },
    }


def _colour(text: str) -> list[float]:
    """Return ``#rrggbb`` as shares of 1, with the opaque alpha some players expect."""
    return [*(_rounded(c / 255, 4) for c in bytes.fromhex(text[1:])), 1]


def _percent(share: float) -> float:
    return _rounded(100 * share, 2)


def _rounded(value: float, decimals: int) -> float:
    """Return a rounded number, an int if it is whole, which JSON writes in its shortest form."""
    rounded = float(number(value, decimals))
    return int(rounded) if rounded.is_integer() else rounded


def _render(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    from shapeblend_cli.outputs.move import moves_of

    moves = moves_of(pairs)
    text = lottie(moves, spec.timing, spec.decimals(pairs))
    return Rendered([text], [note for move in moves for note in move.unsupported_in("Lottie")])


FORMAT = Format(
    "lottie",
    "a Lottie animation (JSON)",
    _render,
    emit="lottie",
    suffix=".json",
    to_standard_output=True,
)
