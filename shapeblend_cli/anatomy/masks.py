"""What is seen through masks and clip paths, as shapes of its own.

Some icon sets paint each icon as one rectangle behind a mask, and all of its lines are in the mask. Seen through a mask
that only shows and hides, shapes are what is left of them; through one that is painted without black, all of a
rectangle in one colour, they are what the mask draws, in this colour. Such shapes become others as any do, whereas
masks can only fade into each other.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import groupby
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.unions import CUT, GRID, MOST_UNLIKE, Sheet, are_alike, rasters
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import rectangle
from shapeblend_cli.model import Box, control_box

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from pathops import Path, PathOp

    from shapeblend_cli.model import Clip, CubicPath, Effect, Mask, Paint, Shape, Style

MOST_SEGMENTS = 2000
"""Maximum number of segments of a shape and what it is seen through, and of what is left of it."""

BRIGHTNESS = np.array([0.2125, 0.7154, 0.0721])
"""Weights of red, green and blue in what a mask shows."""

NEARLY = 0.004
"""Maximum difference from black or white that is not seen."""

LEAST_SEEN = 0.07
"""Minimum difference of opacity that is seen."""

UPRIGHT = 1e-6
"""Maximum slant of the sides of a rectangle, as a share of its larger side."""


class _Layer(NamedTuple):
    """What a shape of a mask paints with its fill or its stroke, and what is seen there, from 0 to 1."""

    shape: Shape
    is_stroke: bool
    shown: float
    opacity: float

    @property
    def hides(self) -> bool:
        """Whether nothing is seen there."""
        return self.shown < NEARLY

    @property
    def is_hard(self) -> bool:
        """Whether all is seen there, or nothing."""
        return self.opacity > 1.0 - NEARLY and (self.hides or self.shown > 1.0 - NEARLY)

    def area(self, sheet: Sheet) -> Path:
        """Return where it paints; dashes are left out."""
        contours, style = self.shape.contours, self.shape.style
        return sheet.stroked(contours, style) if self.is_stroke else sheet.area(contours, style.fill_rule)

    @property
    def rule(self) -> str:
        """The rule by which the outlines of its area paint."""
        return "nonzero" if self.is_stroke else self.shape.style.fill_rule


def unmasked(shapes: Sequence[Shape]) -> tuple[Shape, ...]:
    """Return shapes in the order of paint, with what is seen of some as shapes of their own, where that is exact.

    These are shapes in plain colours behind masks, and in drawings of one colour also those behind clip paths.
    """
    colours = {paint.colour for shape in shapes for paint in shape.style.paints} - {None}
    return _unmasked(shapes, is_sign=len(colours) == 1)


def _unmasked(shapes: Sequence[Shape], *, is_sign: bool) -> tuple[Shape, ...]:
    numbers = [effect.number for shape in shapes for effect in shape.effects]
    found: list[Shape] = []
    for shape in shapes:
        seen: list[Shape] | None = None
        if _is_plain(shape) and (shape.effects or (shape.clips and is_sign)):
            is_alone = not shape.effects or numbers.count(shape.effects[0].number) == 1
            try:
                seen = _seen(shape, is_alone=is_alone)
            except ImportError:  # the library has no wheels for Windows on ARM
                return tuple(shapes)
        found += [shape] if seen is None else seen
    return tuple(found)


def _is_plain(shape: Shape) -> bool:
    """Return whether a shape is an outline in plain colours behind nothing but a mask and clip paths."""
    style = shape.style
    is_coloured = style.fill_gradient is None and style.stroke_gradient is None and style.pixel is None
    if shape.element == "text" or not is_coloured or len(shape.effects) > 1:
        return False
    return not shape.effects or _is_mask(shape.effects[0])


def _is_mask(effect: Effect) -> bool:
    """Return whether an effect is a mask as files have it."""
    mask = effect.mask
    is_only = effect._replace(mask=None, number=0, place=0, clips=()).is_plain
    return is_only and mask is not None and len(mask.layers) == 1 and mask.layers[0].content is not None


def _seen(shape: Shape, *, is_alone: bool) -> list[Shape] | None:
    """Return what is seen of a shape; None where that cannot be told exactly."""
    mask = shape.effects[0].mask if shape.effects else None
    clips = [*shape.clips, *(shape.effects[0].clips if shape.effects else ())]
    layers = None if mask is None else _layers(mask)
    if mask is not None and layers is None:
        return None
    paths: list[CubicPath] = [*shape.contours]
    paths += [path for each in layers or () for path in each.shape.contours]
    paths += [path for clip in clips for path in clip.paths]
    if sum(len(path.segments) for path in paths) > MOST_SEGMENTS or not control_box(paths[:1]).larger_side:
        return None
    if mask is not None and layers and not clips and (is_alone or all(each.is_hard for each in layers)):
        drawn = _drawn(shape, mask, layers)
        if drawn is not None:
            return drawn
    if not all(each.is_hard and not each.shape.style.stroke_dasharray for each in layers or ()):
        return None
    if shape.style.stroke is not None and shape.style.stroke_dasharray:
        return None
    return _left(shape, mask, layers or [], clips)


def _layers(mask: Mask) -> list[_Layer] | None:
    """Return what a mask paints, the lowest first; None if that is not all in plain colours."""
    content = mask.layers[0].content
    assert content is not None  # as it is a mask as files have it
    found = []
    for shape in _unmasked(content.shapes, is_sign=True):
        if not _is_plain(shape) or shape.effects or shape.clips:
            return None
        found += [
            _Layer(shape, is_stroke, _brightness(paint), paint.opacity)
            for paint, is_stroke in _paints(shape.style)
        ]
    return found


def _paints(style: Style) -> list[tuple[Paint, bool]]:
    """Return the paint of a fill and of a stroke that is seen, the lower one first, and whether it is the stroke."""
    paints = list(zip(style.paints, (False, True), strict=True))
    if style.paint_order != "normal":
        paints.reverse()
    return [
        (paint, is_stroke)
        for paint, is_stroke in paints
        if paint.colour is not None and paint.opacity > 0.0 and (not is_stroke or style.stroke_width > 0.0)
    ]


def _brightness(paint: Paint) -> float:
    assert paint.colour is not None  # as it is seen
    return min(1.0, float(BRIGHTNESS @ np.frombuffer(bytes.fromhex(paint.colour[1:]), np.uint8)) / 255.0)


def _drawn(shape: Shape, mask: Mask, layers: Sequence[_Layer]) -> list[Shape] | None:
    """Return what a mask draws in the colour of the rectangle behind it; None if that is not the same picture."""
    style = shape.style
    if style.stroke is not None or style.fill is None or not _is_rectangle(shape):
        return None
    if any(each.hides for each in layers):
        return None
    around = Box.union([_box(each) for each in layers])
    if not all(box.contains(around, NEARLY) for box in (control_box(shape.contours), mask.region)):
        return None
    sheet = Sheet.around(shape.contours, CUT)
    areas = rasters(
        (shape.contours, style.fill_rule), *((sheet.outlines(each.area(sheet)), each.rule) for each in layers)
    )
    next(areas)
    # What the mask lets through, and how much its shapes cover in the colour of the rectangle.
    seen = np.zeros((GRID, GRID))
    painted = np.zeros_like(seen)
    for layer, area in zip(layers, areas, strict=True):
        seen[area] += layer.opacity * (layer.shown - seen[area])
        opacity = style.fill_opacity * layer.opacity * layer.shown
        painted[area] += opacity * (1.0 - painted[area])
    is_other = np.abs(style.fill_opacity * seen - painted) > LEAST_SEEN
    if is_other.sum() > MOST_UNLIKE * (seen > 0.0).sum():
        return None
    found = []
    for _, group in groupby(layers, key=lambda layer: id(layer.shape)):
        own = list(group)
        inked = own[0].shape.style._replace(fill=None, stroke=None)
        for layer in own:
            opacity = style.fill_opacity * layer.opacity * layer.shown
            if layer.is_stroke:
                inked = inked._replace(stroke=style.fill, stroke_opacity=opacity)
            else:
                inked = inked._replace(fill=style.fill, fill_opacity=opacity)
        found.append(replace(shape, contours=own[0].shape.contours, style=inked, effects=()))
    return found


def _is_rectangle(shape: Shape) -> bool:
    """Return whether a shape is an upright rectangle."""
    if len(shape.contours) != 1 or not shape.contours[0].straight.all():
        return False
    nodes = shape.contours[0].segments[:, 0]
    sides = np.diff(np.append(nodes, nodes[0]))
    sides = sides[np.abs(sides) > 0.0]
    slant = np.minimum(np.abs(sides.real), np.abs(sides.imag)).max(initial=0.0)
    return len(sides) == 4 and bool(slant <= UPRIGHT * np.abs(sides).max())


def _box(layer: _Layer) -> Box:
    """Return the box around what a layer paints, mitres and all."""
    box = Box.union([cubics.bounds(contour.segments) for contour in layer.shape.contours])
    style = layer.shape.style
    if not layer.is_stroke:
        return box
    long = style.stroke_miterlimit if style.stroke_linejoin == "miter" else 1.5
    has_corners = any(
        len(contour.segments) > 1 and contour.straight.any() for contour in layer.shape.contours
    )
    return box.expanded(style.stroke_width / 2.0 * (long if has_corners else 1.0))


class _Step(NamedTuple):
    """An area that is added to what is seen, taken from it, or all of what is left of it."""

    area: Path
    rule: str
    how: PathOp


def _steps(
    sheet: Sheet, mask: Mask | None, layers: Sequence[_Layer], clips: Sequence[Clip]
) -> Iterator[_Step]:
    """Yield the areas of a mask that only shows and hides, and of clip paths."""
    from pathops import PathOp

    for layer in layers:
        yield _Step(layer.area(sheet), layer.rule, PathOp.DIFFERENCE if layer.hides else PathOp.UNION)
    if mask is not None:
        yield _Step(sheet.area([rectangle(mask.region)]), "nonzero", PathOp.INTERSECTION)
    for k, clip in enumerate(clips):
        is_first = mask is None and k == 0
        how = PathOp.UNION if is_first else PathOp.INTERSECTION
        yield _Step(sheet.area(clip.paths, clip.rule), clip.rule, how)


def _left(
    shape: Shape, mask: Mask | None, layers: Sequence[_Layer], clips: Sequence[Clip]
) -> list[Shape] | None:
    """Return what a mask that only shows and hides, and clip paths, leave of a shape; None if that is not found."""
    from pathops import Path, PathOp, PathOpsError, op

    sheet = Sheet.around(shape.contours, CUT)
    steps = list(_steps(sheet, mask, layers, clips))
    region, found, is_whole = Path(), [], True
    try:
        for step in steps:
            region = op(region, step.area, step.how, keep_starting_points=False)
        for style, whole, rule in _areas(sheet, shape):
            outlines = sheet.outlines(op(whole, region, PathOp.INTERSECTION, keep_starting_points=False))
            if sum(len(path.segments) for path in outlines) > MOST_SEGMENTS:
                return None
            parts = ((sheet.outlines(step.area), step.rule) for step in steps)
            before, after, *others = rasters((sheet.outlines(whole), rule), (outlines, "nonzero"), *parts)
            seen = np.zeros_like(before)
            for other, step in zip(others, steps, strict=True):
                is_taken = step.how == PathOp.DIFFERENCE
                seen = seen | other if step.how == PathOp.UNION else seen & (other ^ is_taken)
            # The library is at a loss with some areas, and what it returns is another picture.
            if not are_alike(before & seen, after):
                return None
            is_whole &= bool((before <= seen).all())
            if outlines:
                found.append(replace(shape, contours=tuple(outlines), style=style, clips=(), effects=()))
    except PathOpsError:
        return None
    return [replace(shape, clips=(), effects=())] if is_whole else found or None


def _areas(sheet: Sheet, shape: Shape) -> Iterator[tuple[Style, Path, str]]:
    """Yield what a shape paints with its fill and its stroke, each with the style of a fill, and its rule."""
    bare = shape.style._replace(stroke=None, fill_rule="nonzero")
    for paint, is_stroke in _paints(shape.style):
        layer = _Layer(shape, is_stroke, 1.0, paint.opacity)
        yield bare._replace(fill=paint.colour, fill_opacity=paint.opacity), layer.area(sheet), layer.rule
