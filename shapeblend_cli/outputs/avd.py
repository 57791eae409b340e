"""A blend as an Android animated vector drawable: one XML file for ``res/drawable``.

The vector and its animators stand in the one file by ``aapt:attr``. The formats: VectorDrawable,
AnimatedVectorDrawable and PathInterpolator in the reference of Android.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple
from xml.etree import ElementTree  # svgwrite has imported it anyway
from xml.etree.ElementTree import Element, SubElement

from shapeblend_cli.svg.writing.path_data import path_data
from shapeblend_cli.svg.writing.rounding import number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapeblend_cli.easing import Ease
    from shapeblend_cli.model import PaintedShape
    from shapeblend_cli.outputs.move import Leg, Move

NAMESPACES = {
    "xmlns:android": "http://schemas.android.com/apk/res/android",
    "xmlns:aapt": "http://schemas.android.com/aapt",
}

LARGEST = 200
"""Android advises against drawables of more dp than that; what is larger is made smaller."""

TYPES = {"pathData": "pathType", "fillColor": "colorType", "strokeColor": "colorType"}
"""What kind of value an animated property has; all others are numbers."""

DEFAULTS = {
    "fillAlpha": "1",
    "fillType": "nonZero",
    "strokeAlpha": "1",
    "strokeLineCap": "butt",
    "strokeLineJoin": "miter",
}
"""What Android takes for attributes that are not there."""

LONGEST = 32_767
"""Characters of a path that Android's build tools take."""

FIXED = ("fillType", "strokeLineCap", "strokeLineJoin")
"""What Android does not animate."""


def animated_vector(move: Move, seconds: float, ease: Ease, decimals: int) -> str:
    """An animated vector drawable that moves once from the first picture to the second.

    Parameters
    ----------
    move : Move
    seconds : float
    ease : Ease
    decimals : int
        Of coordinates.
    """
    view = move.view()
    root = Element("animated-vector", NAMESPACES)
    small = min(1.0, LARGEST / view.larger_side)
    size = {
        "width": f"{number(small * view.width, 2)}dp",
        "height": f"{number(small * view.height, 2)}dp",
        "viewportWidth": number(view.width, decimals),
        "viewportHeight": number(view.height, decimals),
    }
    parent = SubElement(_inline(root, "drawable"), "vector", _android(size))
    shift = {"translateX": number(-view.x, decimals), "translateY": number(-view.y, decimals)}
    if set(shift.values()) != {"0"}:
        parent = SubElement(parent, "group", _android(shift))
    duration = max(1, round(1000 * seconds))
    for shape in move.shapes():
        name = shape.name
        start, end = (_attributes(painted, decimals) for painted in (shape.start, shape.end))
        shown = {key: value for key, value in start.items() if DEFAULTS.get(key) != value}
        SubElement(parent, "path", _android({"name": name, **shown}))
        moving = {
            key: [_Step(start[key], end[key], duration, ease)]
            for key in start
            if key not in FIXED and start[key] != end[key]
        }
        if shape.ways:
            moving["pathData"] = _path_steps(shape.legs(duration, ease, 0), decimals)
        if moving:
            target = SubElement(root, "target", _android({"name": name}))
            animators = _inline(target, "animation")
            if len(moving) > 1:
                animators = SubElement(animators, "set")
            for key, steps in moving.items():
                _animate(animators, key, steps)
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def too_long(move: Move, decimals: int) -> list[str]:
    """A phrase for each shape whose path is longer than Android's build tools take."""
    lengths = {
        shape.name: max(
            len(path_data(outlines, decimals))
            for outlines in (
                shape.start.paths,
                *(waypoint.paths for waypoint in shape.ways),
                shape.end.paths,
            )
        )
        for shape in move.shapes()
    }
    return [
        f"{name}: its path has {length} characters, and Android takes {LONGEST}; fewer --vertices make it shorter"
        for name, length in lengths.items()
        if length > LONGEST
    ]


class _Step(NamedTuple):
    """From one value of a property to another."""

    start: str
    end: str
    milliseconds: int
    ease: Ease


def _path_steps(legs: Sequence[Leg], decimals: int) -> list[_Step]:
    """A step for each leg of the way of a shape's outlines, which is in milliseconds."""
    return [
        _Step(
            path_data(leg.start, decimals),
            path_data(leg.end, decimals),
            round(leg.times[1] - leg.times[0]),
            leg.ease,
        )
        for leg in legs
    ]


def _animate(parent: Element, key: str, steps: Sequence[_Step]) -> None:
    """Add the animators of a property, one after the other: keyframes of a single one cannot hold paths."""
    if len(steps) > 1:
        parent = SubElement(parent, "set", _android({"ordering": "sequentially"}))
    for step in steps:
        said = {
            "propertyName": key,
            "duration": str(step.milliseconds),
            "valueFrom": step.start,
            "valueTo": step.end,
            "valueType": TYPES.get(key, "floatType"),
        }
        animator = SubElement(parent, "objectAnimator", _android(said))
        names = ("controlX1", "controlY1", "controlX2", "controlY2")
        curve = {name: number(value, 4) for name, value in zip(names, step.ease, strict=True)}
        SubElement(_inline(animator, "interpolator"), "pathInterpolator", _android(curve))


def _attributes(shape: PaintedShape, decimals: int) -> dict[str, str]:
    style = shape.style
    found = {"pathData": path_data(shape.paths, decimals)}
    if style.fill is not None:
        found["fillColor"] = style.fill
        found["fillAlpha"] = number(style.fill_opacity, 4)
        found["fillType"] = {"nonzero": "nonZero", "evenodd": "evenOdd"}[style.fill_rule]
    if style.stroke is not None:
        found["strokeColor"] = style.stroke
        found["strokeAlpha"] = number(style.stroke_opacity, 4)
        found["strokeWidth"] = number(style.stroke_width, decimals)
        found["strokeLineCap"] = style.stroke_linecap
        found["strokeLineJoin"] = style.stroke_linejoin
    return found


def _inline(parent: Element, name: str) -> Element:
    """An attribute whose value is an element: a resource of its own, written in place."""
    return SubElement(parent, "aapt:attr", {"name": f"android:{name}"})


def _android(attributes: dict[str, str]) -> dict[str, str]:
    return {f"android:{name}": value for name, value in attributes.items()}
