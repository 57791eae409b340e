"""Patterns and masks: what is drawn in them, and where.

https://www.w3.org/TR/SVG2/pservers.html#Patterns and https://www.w3.org/TR/css-masking-1/
"""

from __future__ import annotations

import cmath
import hashlib
import math
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from shapeblend_cli.geometry import cubics
from shapeblend_cli.model import Box, Content, Filling, Mask, MaskLayer, Pattern, Picture, Shape, Style
from shapeblend_cli.svg.xml.transforms import IDENTITY, Affine, is_sound, onto, parse, translation
from shapeblend_cli.svg.xml.units import Lengths, length

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from shapeblend_cli.svg.xml.xmltree import Node

    Draw = Callable[
        [Node, Affine, Lengths], Sequence[Shape] | None
    ]  # draws what is in an element, if all of it
    Fit = Callable[[Node, float, float], Affine | None]  # maps the viewBox of an element onto a size

MOST_LINKS = 8
"""Maximum number of patterns that refer to each other in turn."""

LARGEST_TILE = 8.0
"""Maximum side of a tile, in larger sides of the box that it fills: programs draw each tile as a picture."""

_NO_AREA = 1e-24
_WHITE = "#ffffff"


def content_of(shapes: Sequence[Shape]) -> Content:
    """Return shapes as what a pattern or a mask draws."""
    digest = hashlib.blake2b(digest_size=16)
    for shape in shapes:
        for contour in shape.contours:
            digest.update(contour.segments.tobytes())
            digest.update(contour.straight.tobytes())
        for clip in shape.clips:
            for path in clip.paths:
                digest.update(path.segments.tobytes())
        effects = [effect._replace(clips=()) for effect in shape.effects]
        digest.update(repr((len(shape.contours), shape.style, effects)).encode())
    return Content(tuple(shapes), digest.hexdigest())


def chain(node: Node, ids: Mapping[str, Node]) -> list[Node]:
    """Return a pattern and those that it refers to, the nearest first."""
    found = [node]
    while len(found) < MOST_LINKS:
        link = found[-1].link().strip()
        following = ids.get(link[1:]) if link.startswith("#") else None
        if following is None or following.tag != "pattern" or following in found:
            break
        found.append(following)
    return found


def has_tile(links: Sequence[Node]) -> bool:
    """Return whether a chain of patterns has something to draw, on a tile with an extent: others paint nothing."""
    sides = (length(_given(links, name), whole=1.0) or 0.0 for name in ("width", "height"))
    return any(node.children for node in links) and all(side > 0.0 for side in sides)


def _given(links: Sequence[Node], name: str) -> str:
    """Return an attribute of a chain of patterns, of the first that has it; empty if none does."""
    return next((node.attrib[name] for node in links if name in node.attrib), "")


def pattern_of(
    links: Sequence[Node], matrix: Affine, box: Box, lengths: Lengths, draw: Draw, fit: Fit
) -> Pattern | None:
    """Return a chain of patterns as one pattern in the root's coordinates; None if not all of it can be drawn.

    The `matrix` maps the shape's coordinates to the root's; the `box` is around the shape, without its stroke.
    """
    given = partial(_given, links)
    holder = next((node for node in links if node.children), None)
    viewed = next((node for node in links if "viewBox" in node.attrib), None)
    if holder is None:
        return None
    in_box = given("patternUnits").strip() != "userSpaceOnUse"
    if in_box:
        x, y, width, height = (
            length(given(name), whole=1.0) or 0.0 for name in ("x", "y", "width", "height")
        )
        x, y = box.x + x * box.width, box.y + y * box.height
        width, height = width * box.width, height * box.height
    else:
        ways = (("x", lengths.x), ("y", lengths.y), ("width", lengths.x), ("height", lengths.y))
        x, y, width, height = (way(given(name)) or 0.0 for name, way in ways)
    own = parse(given("patternTransform")) or IDENTITY
    matrix = matrix @ own @ translation(x, y)
    if width <= 0.0 or height <= 0.0 or not is_sound(matrix) or abs(matrix.determinant) < _NO_AREA:
        return None
    sides = width * math.hypot(own.a, own.b), height * math.hypot(own.c, own.d)
    if max(sides) > LARGEST_TILE * max(box.larger_side, 1e-9):
        return None
    inner: Affine | None = IDENTITY
    if viewed is not None:
        inner = fit(viewed, width, height)
    elif given("patternContentUnits").strip() == "objectBoundingBox":
        inner = Affine(box.width, 0.0, 0.0, box.height)
    shapes = draw(holder, inner or IDENTITY, lengths)
    return None if shapes is None else _placed(content_of(shapes), (width, height), matrix)


def _placed(content: Content, size: tuple[float, float], matrix: Affine) -> Pattern:
    """Return the pattern whose tile a matrix maps to the root's coordinates."""
    a, b, c, d, e, f = matrix
    along = complex(a, b)
    wide = abs(along)
    shear, high = (a * c + b * d) / wide, matrix.determinant / wide
    skew = math.degrees(math.atan2(shear, high)) if high > 0.0 else math.degrees(math.atan2(-shear, -high))
    return Pattern(content, size, complex(e, f), math.degrees(cmath.phase(along)), (wide, high), skew)


def colour_of(pattern: Pattern) -> str | None:
    """Return the plain colour that stands for a pattern: that of the largest shape in it."""
    best, found = 0.0, None
    for shape in pattern.content.shapes:
        colour = shape.style.fill or shape.style.stroke
        box = cubics.bounds(np.concatenate([contour.segments for contour in shape.contours]))
        size = box.diagonal
        if colour is not None and size > best:
            best, found = size, colour
    return found


def mask_of(node: Node, matrix: Affine, box: Box | None, lengths: Lengths, draw: Draw) -> Mask | None:
    """Return a mask in the root's coordinates, to which the `matrix` maps; None if it is not known where it is.

    The `box` is around what is masked, in its own coordinates.
    """
    region = region_of(node, "maskUnits", box, lengths)
    inner = matrix
    if (node.get("maskContentUnits") or "").strip() == "objectBoundingBox":
        if box is None:
            return None
        inner = matrix @ onto(box)
    if region is None:
        return None
    shapes = draw(node, inner, lengths)
    if shapes is None or (not shapes and any(each.tag == "text" for each in node.walk())):
        return None  # it would hide what it masks
    corners = np.array(
        [
            complex(x, y)
            for x in (region.x, region.x + region.width)
            for y in (region.y, region.y + region.height)
        ]
    )
    around = Box.around(matrix.points(corners))
    return Mask(around, (MaskLayer(content_of(shapes), around),))


def whitened(shapes: Sequence[Shape]) -> list[Shape]:
    """Return shapes in white, so that they are as bright as they are opaque: what a mask of alpha looks at."""
    return [replace(shape, style=_white(shape.style)) for shape in shapes]


def _white(style: Style) -> Style:
    def white(gradient: Filling | None) -> Filling | None:
        if gradient is None:
            return None
        if isinstance(gradient, Picture):
            from shapeblend_cli.images.decode import whitened as white_picture  # few drawings have any

            opaque = gradient.raster.is_opaque
            return None if opaque else gradient._replace(raster=white_picture(gradient.raster))
        if isinstance(gradient, Pattern):
            return gradient._replace(content=content_of(whitened(gradient.content.shapes)))
        return gradient._replace(stops=tuple(stop._replace(colour=_WHITE) for stop in gradient.stops))

    return style._replace(
        fill=style.fill and _WHITE,
        stroke=style.stroke and _WHITE,
        fill_gradient=white(style.fill_gradient),
        stroke_gradient=white(style.stroke_gradient),
    )


def region_of(node: Node, units: str, box: Box | None, lengths: Lengths) -> Box | None:
    """Return the region of a mask or a filter, in the coordinates of what it is applied to; None without one."""
    given = [
        node.get(name) or default
        for name, default in (("x", "-10%"), ("y", "-10%"), ("width", "120%"), ("height", "120%"))
    ]
    if (node.get(units) or "").strip() == "userSpaceOnUse":
        ways = lengths.x, lengths.y, lengths.x, lengths.y
        x, y, width, height = (way(text) or 0.0 for way, text in zip(ways, given, strict=True))
    elif box is None:
        return None
    else:
        x, y, width, height = (length(text, whole=1.0) or 0.0 for text in given)
        x, y = box.x + x * box.width, box.y + y * box.height
        width, height = width * box.width, height * box.height
    return Box(x, y, width, height) if width > 0.0 and height > 0.0 else None
