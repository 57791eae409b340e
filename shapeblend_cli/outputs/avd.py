"""A blend as an Android animated vector drawable: one XML file for ``res/drawable``.

The vector and its animators are in one file, by ``aapt:attr``. The formats: VectorDrawable, AnimatedVectorDrawable and
PathInterpolator in the reference of Android.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapeblend_cli.outputs.formats import OutputSpec, Rendered
from shapeblend_cli.svg.writing.path_data import path_data
from shapeblend_cli.svg.writing.rounding import number

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from xml.etree.ElementTree import Element

    from shapeblend_cli.model import PaintedShape, Pair
    from shapeblend_cli.options.easing import Timing
    from shapeblend_cli.outputs.move import Move, Section

NAMESPACES = {
    "xmlns:android": "http://schemas.android.com/apk/res/android",
    "xmlns:aapt": "http://schemas.android.com/aapt",
}

LARGEST = 200
"""Maximum side of a drawable, in dp. Android advises against more, so larger drawables are scaled down."""

TYPES = {"pathData": "pathType", "fillColor": "colorType", "strokeColor": "colorType"}
"""Types of animated properties; all other properties are numbers."""

DEFAULTS = {
    "fillAlpha": "1",
    "fillType": "nonZero",
    "strokeAlpha": "1",
    "strokeLineCap": "butt",
    "strokeLineJoin": "miter",
    "strokeMiterLimit": "4",
    "trimPathStart": "0",
    "trimPathEnd": "1",
}
"""Android's defaults of attributes."""

TRIMS = ("trimPathStart", "trimPathEnd")
"""Properties of the part of a path that is seen, as shares of its length."""

LONGEST = 32_767
"""Maximum length of a path in Android's build tools, in characters."""

FIXED = ("fillType", "strokeLineCap", "strokeLineJoin", "strokeMiterLimit")
"""Properties that Android does not animate."""


def animated_vector(move: Move, timing: Timing, decimals: int) -> str:
    """Return an animated vector drawable that moves once."""
    from xml.etree import ElementTree

    view = move.view
    root = ElementTree.Element("animated-vector", NAMESPACES)
    scale = min(1.0, LARGEST / view.larger_side)
    size = {
        "width": f"{number(scale * view.width, 2)}dp",
        "height": f"{number(scale * view.height, 2)}dp",
        "viewportWidth": number(view.width, decimals),
        "viewportHeight": number(view.height, decimals),
    }
    parent = _add(_inline(root, "drawable"), "vector", size)
    shift = {"translateX": number(-view.x, decimals), "translateY": number(-view.y, decimals)}
    if set(shift.values()) != {"0"}:
        parent = _add(parent, "group", shift)
    for shape in move.shapes:
        regions = {
            f"{shape.name}-clip-{k}": [(t, path_data([outline], decimals)) for t, outline in stops]
            for k, stops in enumerate(shape.clips, 1)
        }
        start, end = (_attributes(painted, decimals) for painted in (shape.start, shape.end))
        for side, key in enumerate(TRIMS if shape.trims else ()):
            start[key], end[key] = (number(shape.trims[k][1][side], 4) for k in (0, -1))
        shown = {key: value for key, value in start.items() if DEFAULTS.get(key) != value}
        _add(_clipped(parent, regions), "path", {"name": shape.name, **shown})
        changing = [key for key in start if key not in FIXED and start[key] != end[key]]
        painted = [
            _attributes(shape.start._replace(style=style), decimals) for _, style in shape.styles[1:-1]
        ]
        times = [t for t, _ in shape.styles]
        stops = {
            key: [(t, one.get(key, "")) for t, one in zip(times, (start, *painted, end), strict=True)]
            for key in changing
        }
        if shape.waypoints:
            inner = [(waypoint.t, path_data(waypoint.paths, decimals)) for waypoint in shape.waypoints]
            stops["pathData"] = [(0.0, start["pathData"]), *inner, (1.0, end["pathData"])]
        for paint in ("fill", "stroke") if shape.fading else ():
            if f"{paint}Alpha" in stops:
                styles = [(0.0, shape.start.style), *shape.fading, (1.0, shape.end.style)]
                faded = [(t, number(getattr(style, f"{paint}_opacity"), 4)) for t, style in styles]
                stops[f"{paint}Alpha"] = faded
        for side, key in enumerate(TRIMS if shape.trims else ()):
            if key in stops:
                stops[key] = [(t, number(part[side], 4)) for t, part in shape.trims]
        _add_target(root, shape.name, stops, timing)
        for name, each in regions.items():
            _add_target(root, name, {"pathData": each} if len({data for _, data in each}) > 1 else {}, timing)
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def _clipped(parent: Element, regions: Mapping[str, Sequence[tuple[float, str]]]) -> Element:
    """Return where to add what regions clip: a group with them, if there are any. Each has its path data at times."""
    if not regions:
        return parent
    group = _add(parent, "group")
    for name, stops in regions.items():
        _add(group, "clip-path", {"name": name, "pathData": stops[0][1]})
    return group


def too_long(move: Move, decimals: int) -> list[str]:
    """Return a phrase for each shape whose path is longer than Android's build tools accept."""
    notes = []
    for shape in move.shapes:
        drawn = [shape.start.paths, *(waypoint.paths for waypoint in shape.waypoints), shape.end.paths]
        drawn += [(outline,) for stops in shape.clips for _, outline in stops]
        length = max(len(path_data(paths, decimals)) for paths in drawn)
        if length > LONGEST:
            what = f"its path has {length} characters, and Android takes {LONGEST}"
            notes.append(f"{shape.name}: {what}; fewer --vertices make it shorter")
    return notes


def _add_target(
    root: Element, name: str, stops: Mapping[str, Sequence[tuple[float, str]]], timing: Timing
) -> None:
    """Add the animators of what has a name: of properties by their values at times, of which there may be none."""
    from shapeblend_cli.outputs.move import sections

    if not stops:
        return
    animators = _inline(_add(root, "target", {"name": name}), "animation")
    if len(stops) > 1:
        animators = _add(animators, "set")
    duration = max(1, round(1000 * timing.seconds))
    for key, each in stops.items():
        _animate(animators, key, sections(each, duration, timing.ease, 0), round(1000 * timing.hold[0]))


def _animate(parent: Element, key: str, steps: Sequence[Section[str]], rest: int) -> None:
    """Add the animators of a property in sequence, after a rest: keyframes of a single one cannot hold paths."""
    if len(steps) > 1:
        parent = _add(parent, "set", {"ordering": "sequentially"})
    for start, end, (begin, until), ease in steps:
        attributes = {
            "propertyName": key,
            "duration": str(round(until - begin)),
            "valueFrom": start,
            "valueTo": end,
            "valueType": TYPES.get(key, "floatType"),
        }
        if rest:
            attributes["startOffset"], rest = str(rest), 0
        interpolator = _inline(_add(parent, "objectAnimator", attributes), "interpolator")
        curve = {f"control{name.upper()}": number(value, 4) for name, value in ease._asdict().items()}
        _add(interpolator, "pathInterpolator", curve)


def _attributes(shape: PaintedShape, decimals: int) -> dict[str, str]:
    style = shape.style
    attributes = {"pathData": path_data(shape.paths, decimals)}
    if style.fill is not None:
        attributes["fillColor"] = style.fill
        attributes["fillAlpha"] = number(style.fill_opacity, 4)
        attributes["fillType"] = {"nonzero": "nonZero", "evenodd": "evenOdd"}[style.fill_rule]
    if style.stroke is not None:
        attributes["strokeColor"] = style.stroke
        attributes["strokeAlpha"] = number(style.stroke_opacity, 4)
        attributes["strokeWidth"] = number(style.stroke_width, decimals)
        attributes["strokeLineCap"] = style.stroke_linecap
        attributes["strokeLineJoin"] = style.stroke_linejoin
        attributes["strokeMiterLimit"] = number(style.stroke_miterlimit, 4)
    return attributes


def _inline(parent: Element, name: str) -> Element:
    """Add an attribute whose value is an element: a resource of its own, written in place."""
    attribute = parent.makeelement("aapt:attr", {"name": f"android:{name}"})
    parent.append(attribute)
    return attribute


def _add(parent: Element, tag: str, attributes: dict[str, str] | None = None) -> Element:
    """Add an element with attributes of Android's namespace."""
    named = {f"android:{name}": value for name, value in (attributes or {}).items()}
    element = parent.makeelement(tag, named)
    parent.append(element)
    return element


def render(spec: OutputSpec, pairs: Sequence[Pair]) -> Rendered:
    """Return the drawable."""
    from shapeblend_cli.outputs.move import left_out, moves_of, runs_left_out, without_pictures

    pairs, lost = without_pictures(pairs, "Android")
    (move,), decimals = moves_of(spec.eased(pairs), trims=True), spec.decimals(pairs)
    move = move.with_strokes_below()
    dashed = [
        f"{shape.name}: Android draws no dashes; its stroke is solid"
        for shape in move.shapes
        if any(side.style.stroke_dasharray for side in (shape.start, shape.end))
    ]
    notes = [
        *lost,
        *move.unsupported_in("Android"),
        *dashed,
        *too_long(move, decimals),
        *left_out(pairs, "Android", clips="simple"),
        *runs_left_out(spec.timing, "a drawable of Android"),
    ]
    return Rendered([animated_vector(move, spec.timing, decimals)], notes)
