"""A blend as a Lottie animation: JSON that lottie-web, lottie-ios, lottie-android, After Effects and others play.

A layer for every shape, the topmost first, with two keyframes, and one more for each waypoint of its paths.
The format: https://lottie.github.io/lottie-spec/
"""

from __future__ import annotations

import cmath
import io
import json
import math
import zipfile
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

from shapeblend_cli.outputs.formats import OutputSpec, Rendered
from shapeblend_cli.outputs.lottie.image_layers import FRAME_RATE, Assets, masks_of
from shapeblend_cli.outputs.lottie.keyframes import Keyframes, constant, rounded
from shapeblend_cli.paint.oklab import colour_stops
from shapeblend_cli.svg.writing.rounding import DASH_DIGITS

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapeblend_cli.model import Box, CubicPath, Gradient, Pair, RadialGradient, Stop, Style
    from shapeblend_cli.options.easing import Timing
    from shapeblend_cli.outputs.move import Move, MovedShape

VERSION = "5.7.4"
"""Version of the format. Players correct the behaviour of older versions."""

SIZE = 512
"""Longer side of an animation, in pixels, for drawings outside of `OWN_SIZES`. Players scale it as they like."""

OWN_SIZES = range(100, 4097)
"""Longer sides that an animation takes from its drawing, in pixels. Both sides must be whole numbers."""

SAME = 1e-3
"""Tolerance of equal radii, as a share of the larger one."""

FLATTEST = 1e-3
"""Minimum ratio of the radii of an ellipse. A group that is squashed further needs more digits than files have."""

FILL_RULES = {"nonzero": 1, "evenodd": 2}
LINE_CAPS = {"butt": 1, "round": 2, "square": 3}
LINE_JOINS = {"miter": 1, "round": 2, "bevel": 3}


def lottie(moves: Sequence[Move], timing: Timing, decimals: int) -> str:
    """Return a Lottie animation of one move after another.

    The frame named by `op` is not shown, so there is one more than fits the seconds: it shows the last drawing.
    """
    from shapeblend_cli.model import Box

    view = Box.union([box for move in moves for box in move.views])
    is_whole = view.width.is_integer() and view.height.is_integer()
    scale = 1.0 if is_whole and view.larger_side in OWN_SIZES else SIZE / view.larger_side
    size = max(1, round(scale * view.width)), max(1, round(scale * view.height))
    placement = _placement(view, scale, size, decimals)
    assets = Assets(size, scale, view.centre)
    frames = max(1, round(FRAME_RATE * timing.seconds))
    # Where each drawing is reached, and where it is left.
    reached, left = (
        [round(frames * timing.when(k, leaves=leaves)) for k in range(len(moves) + 1)]
        for leaves in (False, True)
    )
    last = left[-1] + 1
    layers = []
    for k, move in enumerate(moves):
        keys = Keyframes(left[k], reached[k + 1], timing.ease, decimals)
        until = keys.end if k + 1 < len(moves) else last
        for shape in move.shapes:
            times = {"ip": reached[k], "op": until, "st": 0}
            if shape.pictures:
                layers += assets.layers(shape, keys, times)
                continue
            masks = masks_of(shape, keys.path_over_time)
            placed = {"ks": placement, **masks, "ao": 0, "shapes": [_group(shape, keys)]}
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
        "assets": assets.found,
        "layers": [{"ind": ind, **layer} for ind, layer in enumerate(layers, 1)],
    }
    return json.dumps(animation, separators=(",", ":"), allow_nan=False) + "\n"


def _placement(view: Box, scale: float, size: tuple[int, int], decimals: int) -> dict[str, Any]:
    """Return the transform that lays the centre of the view on the centre of the picture."""
    # Half of a side has one decimal more.
    centre = [*(rounded(value, decimals + 1) for value in (view.centre.real, view.centre.imag)), 0]
    percent = float(f"{100 * scale:.9g}")
    percent = int(percent) if percent.is_integer() else percent
    position = [*(rounded(side / 2, 1) for side in size), 0]
    return constant({"o": 100, "r": 0, "p": position, "a": centre, "s": [percent, percent, 100]})


def _group(shape: MovedShape, keys: Keyframes) -> dict[str, Any]:
    """Return paths and their paint, the upper one first."""
    ellipse = _ellipse(shape)
    if ellipse is not None:
        shape = shape.mapped(ellipse.path)
    items: list[dict[str, Any]] = [
        {"ty": "sh", "nm": f"contour-{k + 1}", "ks": keys.path(shape, k)}
        for k in range(len(shape.start.paths))
    ]
    if shape.trims:
        trim = {"s": keys.trim(shape, 0), "e": keys.trim(shape, 1), "o": {"a": 0, "k": 0}, "m": 1}
        items.append({"ty": "tm", "nm": "trim", **trim})
    s, e = shape.start.style, shape.end.style
    if s.stroke is not None and e.stroke is not None:
        kind, shade = _paint(shape, "stroke", keys)
        stroke = {
            **shade,
            "w": keys.value(shape, lambda style: rounded(style.stroke_width, keys.decimals)),
            "lc": LINE_CAPS[s.stroke_linecap],
            "lj": LINE_JOINS[s.stroke_linejoin],
            "ml": rounded(s.stroke_miterlimit, 4),
            **_dashes(shape, keys),
        }
        items.append({"ty": kind, "nm": "stroke", **stroke})
    for coat in _coats(shape):
        s, e = coat.start.style, coat.end.style
        if s.fill is not None and e.fill is not None:
            kind, shade = _paint(coat, "fill", keys)
            items.append({"ty": kind, "nm": "fill", **shade, "r": FILL_RULES[s.fill_rule]})
    still = constant({"p": [0, 0], "a": [0, 0], "s": [100, 100], "r": 0, "o": 100})
    if ellipse is not None:
        still |= constant({"s": [100, rounded(100.0 * ellipse.ratio, 6)], "r": rounded(ellipse.angle, 4)})
    return {"ty": "gr", "nm": "paths", "it": [*items, {"ty": "tr", **still}]}


def _dashes(shape: MovedShape, keys: Keyframes) -> dict[str, Any]:
    """Return the property for dashes and gaps in turn, if there are any."""
    start, end = shape.start.style, shape.end.style
    if not start.stroke_dasharray or _loses_dashes(start, end):
        return {}

    def length(k: int) -> Callable[[Style], float]:
        decimals = keys.decimals + DASH_DIGITS
        return lambda style: rounded((*style.stroke_dasharray, style.stroke_dashoffset)[k], decimals)

    kinds = [*("dg"[k % 2] for k in range(len(start.stroke_dasharray))), "o"]
    # Players need names of their own.
    return {
        "d": [
            {"n": kind, "nm": f"{kind}{k}", "v": keys.value(shape, length(k))} for k, kind in enumerate(kinds)
        ]
    }


def _loses_dashes(start: Style, end: Style) -> bool:
    """Return whether the dashes of a stroke have no common length at both ends, which keyframes need."""
    is_drawn = start.stroke is not None and end.stroke is not None
    return is_drawn and len(start.stroke_dasharray) != len(end.stroke_dasharray)


def _coats(shape: MovedShape) -> list[MovedShape]:
    """Return the coats of a shape's fill, the upper one first: two where one gradient dissolves over another."""
    start, end = shape.start.style, shape.end.style
    below = shape.end.below
    if start.fill_gradient is None or end.fill_gradient is None or below is None or shape.fading:
        return [shape]
    if type(start.fill_gradient) is type(end.fill_gradient):
        return [shape]
    begun = start._replace(fill=end.fill, fill_gradient=end.fill_gradient, fill_opacity=0.0)
    return [
        shape._replace(start=shape.start._replace(style=begun)),
        shape._replace(end=shape.end._replace(style=below)),
    ]


def _paint(shape: MovedShape, name: str, keys: Keyframes) -> tuple[str, dict[str, Any]]:
    """Return the kind of a fill or a stroke, and its colours and opacity."""
    gradients = _gradients(shape, name)
    opacity = {"o": keys.opacity(shape, name)}
    if gradients:
        return {"fill": "gf", "stroke": "gs"}[name], _shade(shape, gradients, keys) | opacity
    colour = keys.property([(t, _colour(text)) for t, text in _colours(shape, name)])
    return {"fill": "fl", "stroke": "st"}[name], {"c": colour} | opacity


def _colours(shape: MovedShape, name: str) -> list[tuple[float, str]]:
    """Return the colours of a paint at times, between which each channel goes evenly."""
    found = [(t, getattr(style, name)) for t, style in shape.styles]
    colours = found[:1]
    for (begin, a), (end, b) in pairwise(found):
        _, *stops = colour_stops(a, b)
        colours += [(begin + (end - begin) * (k + 1) / len(stops), text) for k, text in enumerate(stops)]
    return colours


def _shows_gradients(shape: MovedShape, paint: str) -> bool:
    return all(_gradients(coat, paint) for coat in _coats(shape))


def _gradients(shape: MovedShape, paint: str) -> list[Gradient]:
    """Return the gradients of a paint if Lottie has such, ellipses as circles in their own coordinates."""
    from shapeblend_cli.model import Pattern, RadialGradient

    found: list[Gradient] = [getattr(style, f"{paint}_gradient") for _, style in shape.styles]
    if None in found or len({(type(one), len(one.stops)) for one in found}) > 1:
        return []
    if any(isinstance(one, Pattern) or one.spread != "pad" for one in found):
        return []
    if not isinstance(found[0], RadialGradient):
        return found
    if any(one.focal_radius for one in found if isinstance(one, RadialGradient)):
        return []
    ellipse = _ellipse(shape) if paint == "fill" else None
    radial = [one for one in found if isinstance(one, RadialGradient)]
    if ellipse is not None:
        radial = [ellipse.gradient(one) for one in radial]
    is_round = all(math.isclose(*one.radii, rel_tol=SAME) for one in radial)
    return [*radial] if is_round else []


class _Ellipse(NamedTuple):
    """An ellipse, which is a circle in a group that is rotated and squashed."""

    angle: float  # in degrees
    ratio: float  # of the smaller radius to the larger one

    def points(self, z: Any) -> Any:
        """Return points in the coordinates of the group."""
        upright = z * cmath.rect(1.0, -math.radians(self.angle))
        return upright.real + 1j * upright.imag / self.ratio

    def path(self, path: CubicPath) -> CubicPath:
        """Return a path in these coordinates."""
        from dataclasses import replace

        return replace(path, segments=self.points(path.segments))

    def gradient(self, gradient: RadialGradient) -> RadialGradient:
        """Return a gradient in these coordinates."""
        radius = gradient.radii[0]
        return gradient._replace(centre=self.points(gradient.centre), radii=(radius, radius), angle=0.0)


def _ellipse(shape: MovedShape) -> _Ellipse | None:
    """Return the ellipse of a shape's radial fill, if that is alike at both ends and no stroke is squashed with it."""
    from shapeblend_cli.model import RadialGradient

    ellipses = set()
    for _, style in shape.styles:
        fill = style.fill_gradient
        if not isinstance(fill, RadialGradient) or style.stroke is not None:
            return None
        if not fill.radii[1] > FLATTEST * fill.radii[0]:
            return None
        ellipses.add(_Ellipse(round(fill.angle, 3), round(fill.radii[1] / fill.radii[0], 6)))
    first, *others = ellipses
    is_round = math.isclose(first.ratio, 1.0, rel_tol=SAME)
    return None if is_round or others else first


def _shade(shape: MovedShape, gradients: Sequence[Gradient], keys: Keyframes) -> dict[str, Any]:
    """Return the properties of a gradient: its kind, its line or radius, its highlight and its stops."""
    from shapeblend_cli.model import LinearGradient, RadialGradient

    lines, highlights = [], []
    for gradient in gradients:
        if isinstance(gradient, LinearGradient):
            lines.append((gradient.start, gradient.end))
            highlights.append((0.0, 0.0))
        elif isinstance(gradient, RadialGradient):
            lines.append((gradient.centre, gradient.centre + gradient.radii[0]))
            away, angle = cmath.polar(gradient.focus)
            highlights.append((100.0 * away, math.degrees(angle) + gradient.angle if away else 0.0))
    points = [
        [[rounded(z.real, keys.decimals), rounded(z.imag, keys.decimals)] for z in line] for line in lines
    ]
    spots = [[rounded(value, 2) for value in highlight] for highlight in highlights]
    with_alpha = any(stop.opacity < 1.0 for gradient in gradients for stop in gradient.stops)
    stops = [_stops(gradient.stops, with_alpha) for gradient in gradients]

    def changing(values: Sequence[Any]) -> dict[str, Any]:
        return keys.property([(t, value) for (t, _), value in zip(shape.styles, values, strict=True)])

    return {
        "t": 1 if isinstance(gradients[0], LinearGradient) else 2,
        "s": changing([start for start, _ in points]),
        "e": changing([end for _, end in points]),
        "h": changing([away for away, _ in spots]),
        "a": changing([angle for _, angle in spots]),
        "g": {"p": len(gradients[0].stops), "k": changing(stops)},
    }


def _stops(stops: Sequence[Stop], with_alpha: bool) -> list[float]:
    """Return offsets with red, green and blue, then offsets with opacities."""
    numbers: list[float] = []
    for stop in stops:
        numbers += [rounded(stop.offset, 4), *_colour(stop.colour)[:3]]
    for stop in stops if with_alpha else ():
        numbers += [rounded(stop.offset, 4), rounded(stop.opacity, 4)]
    return numbers


def _colour(text: str) -> list[float]:
    """Return ``#rrggbb`` as shares of 1, with the opaque alpha some players expect."""
    return [*(rounded(c / 255, 4) for c in bytes.fromhex(text[1:])), 1]


def render(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    """Return the animation, which does not say how often it runs."""
    from shapeblend_cli.outputs.move import runs_left_out

    rendered = _rendered(spec, pairs)
    notes = runs_left_out(spec.timing, "JSON of Lottie", "; .lottie has it")
    return rendered._replace(notes=[*rendered.notes, *notes])


def _rendered(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    from shapeblend_cli.outputs.move import left_out, moves_of

    notes: list[str] = []
    moves = [move.with_strokes_below() for move in moves_of(spec.eased(pairs), trims=True)]
    text = lottie(moves, spec.timing, spec.decimals(pairs))
    for move in moves:
        notes += move.unsupported_in("Lottie", _shows_gradients)
        notes += [
            f"{shape.name}: Lottie cannot change the number of its dashes; its stroke is solid"
            for shape in move.shapes
            if _loses_dashes(shape.start.style, shape.end.style)
        ]
    if any(not each.picture.is_smooth for move in moves for shape in move.shapes for each in shape.pictures):
        notes.append("Lottie smooths pictures; image-rendering is left out")
    return Rendered([text], [*notes, *left_out(pairs, "Lottie", clips="simple")])


def render_archive(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    """Return the animation in a zip file with its manifest, as dotLottie 1.0 has it; https://dotlottie.io/spec/1.0."""
    rendered = _rendered(spec, pairs)
    animation = {
        "id": "animation",
        "loop": not isinstance(spec.timing.repeat, int),
        "playMode": "bounce" if spec.timing.is_pingpong else "normal",
    }
    manifest = {"version": "1.0", "generator": "shapeblend", "animations": [animation]}
    contents = {"manifest.json": json.dumps(manifest), "animations/animation.json": rendered.contents[0]}
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in contents.items():
            archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED)  # always of the same time
    return rendered._replace(contents=[file.getvalue()])
