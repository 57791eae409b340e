"""What is seen through masks and clip paths, as shapes of its own.

Some icon sets paint each icon as one rectangle behind a mask, and all of its lines are in the mask. A mask without
black in front of a rectangle is replaced by the mask's own shapes, in the rectangle's colour. Shapes behind a mask of
pure black and white are replaced by the parts that show. These shapes blend like any others; masks can only fade into
each other.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import groupby
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapeblend_cli.anatomy.unions import CUT, GRID, MOST_UNLIKE, Sheet, are_alike, rasters
from shapeblend_cli.geometry import cubics
from shapeblend_cli.geometry.polygons import is_rectangle, rectangle
from shapeblend_cli.model import MOST_CONTOURS, UNNAMED, Box, control_box

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from pathops import Path, PathOp

    from shapeblend_cli.model import Clip, Contour, CubicPath, Effect, Mask, Paint, Shape, Style

MOST_SEGMENTS = 2000
"""Maximum number of segments and dashes that a drawing is seen through, counted for each shape behind them, and of what
is left of a shape."""

BRIGHTNESS = np.array([0.2125, 0.7154, 0.0721])
"""Weights of red, green and blue in what a mask shows."""

NEARLY = 0.004
"""Maximum difference from black or white, and share of a size, that goes unnoticed."""

LEAST_SEEN = 0.07
"""Smallest visible difference of opacity."""

NOTHING = 1e-5
"""Maximum share of a shape's area that is nothing but rounding."""


class _Layer(NamedTuple):
    """What a shape of a mask paints with its fill or its stroke, and how bright it is, from 0 to 1."""

    shape: Shape
    is_stroke: bool
    brightness: float
    opacity: float

    @property
    def hides(self) -> bool:
        """Whether nothing is seen there."""
        return self.brightness < NEARLY

    @property
    def is_hard(self) -> bool:
        """Whether all is seen there, or nothing."""
        return self.opacity > 1.0 - NEARLY and (self.hides or self.brightness > 1.0 - NEARLY)

    @property
    def rule(self) -> str:
        """The rule by which the outlines of its area paint."""
        return "nonzero" if self.is_stroke else self.shape.style.fill_rule

    def area(self, sheet: Sheet) -> Path:
        """Return where it paints."""
        contours, style = self.shape.contours, self.shape.style
        return sheet.stroked(contours, style) if self.is_stroke else sheet.area(contours, style.fill_rule)


class _Step(NamedTuple):
    """An area that is added to what is seen, taken from it, or that limits it."""

    area: Path
    rule: str
    how: PathOp


def unmasked(shapes: Sequence[Shape]) -> tuple[Shape, ...]:
    """Return shapes in the order of paint, some replaced by what is seen of them where that can be told exactly.

    These are shapes in plain colours behind masks, and in drawings of one colour also those behind clip paths.
    """
    colours = {paint.colour for shape in shapes for paint in shape.style.paints} - {None}
    return _unmasked(shapes, has_one_colour=len(colours) == 1)


def _unmasked(shapes: Sequence[Shape], *, has_one_colour: bool) -> tuple[Shape, ...]:
    wanted = [
        _is_plain(shape) and bool(shape.effects or (shape.clips and has_one_colour)) for shape in shapes
    ]
    work = sum(_work(shape) for shape, is_wanted in zip(shapes, wanted, strict=True) if is_wanted)
    if work > MOST_SEGMENTS:
        return tuple(shapes)
    numbers = [effect.number for shape in shapes for effect in shape.effects]
    found: list[Shape] = []
    for shape, is_wanted in zip(shapes, wanted, strict=True):
        is_alone = not shape.effects or numbers.count(shape.effects[0].number) == 1
        try:
            seen = _seen(shape, is_alone=is_alone) if is_wanted else None
        except ImportError:  # the library has no wheels for Windows on ARM
            return tuple(shapes)
        found += [shape] if seen is None else seen
    return tuple(found) if sum(len(shape.contours) for shape in found) <= MOST_CONTOURS else tuple(shapes)


def _is_plain(shape: Shape) -> bool:
    """Return whether a shape is an outline in plain colours behind nothing but a mask and clip paths."""
    style = shape.style
    is_coloured = style.fill_gradient is None and style.stroke_gradient is None and style.pixel is None
    if shape.element == "text" or not is_coloured or len(shape.effects) > 1:
        return False
    return not shape.effects or _is_mask(shape.effects[0])


def _is_mask(effect: Effect) -> bool:
    """Return whether an effect is a mask of shapes, and nothing else."""
    mask = effect.mask
    is_no_more = effect._replace(mask=None, number=0, place=0, clips=()).is_plain
    return is_no_more and mask is not None and len(mask.layers) == 1 and mask.layers[0].content is not None


def _work(shape: Shape) -> float:
    """Return the number of segments and dashes of a shape and of what it is seen through."""
    paths: list[CubicPath] = [*shape.contours]
    paths += [path for clip in shape.clips for path in clip.paths]
    count = float(sum(len(path.segments) for path in paths))
    if shape.style.stroke_dasharray and shape.style.stroke is not None:
        length = sum(float(cubics.lengths(contour.segments).sum()) for contour in shape.contours)
        count += length / sum(shape.style.stroke_dasharray)
    for effect in shape.effects:
        count += sum(len(path.segments) for clip in effect.clips for path in clip.paths)
        content = effect.mask.layers[0].content if effect.mask is not None else None
        count += sum(map(_work, content.shapes)) if content is not None else 0.0
    return count


def _seen(shape: Shape, *, is_alone: bool) -> list[Shape] | None:
    """Return what is seen of a shape; None where that cannot be told exactly."""
    if not control_box(shape.contours).larger_side:
        return None
    mask = shape.effects[0].mask if shape.effects else None
    clips = [*shape.clips, *(shape.effects[0].clips if shape.effects else ())]
    layers = [] if mask is None else _layers(mask)
    if layers is None:
        return None
    are_hard = all(each.is_hard for each in layers)
    if mask is not None and layers and not clips and (is_alone or are_hard):
        drawn = _drawn(shape, mask, layers)
        if drawn is not None:
            return drawn
    return _left(shape, mask, layers, clips) if are_hard else None


def _layers(mask: Mask) -> list[_Layer] | None:
    """Return what a mask paints, the lowest first; None if that is not all in plain colours."""
    content = mask.layers[0].content
    assert content is not None, "it is a mask of shapes"
    found = []
    for shape in _unmasked(content.shapes, has_one_colour=True):
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
    assert paint.colour is not None, "it is seen"
    return min(1.0, float(BRIGHTNESS @ np.frombuffer(bytes.fromhex(paint.colour[1:]), np.uint8)) / 255.0)


def _drawn(shape: Shape, mask: Mask, layers: Sequence[_Layer]) -> list[Shape] | None:
    """Return the shapes of a mask in the colour of the rectangle behind it; None if that is another picture."""
    style = shape.style
    if style.stroke is not None or style.fill is None or len(shape.contours) != 1:
        return None
    if not is_rectangle(shape.contours[0]) or any(each.hides for each in layers):
        return None
    sheet = Sheet.around(shape.contours, CUT)
    outlines = [sheet.outlines(each.area(sheet)) for each in layers]
    if not all(outlines):
        return None
    around = control_box([path for each in outlines for path in each])
    slack = NEARLY * around.larger_side
    if not all(box.contains(around, slack) for box in (control_box(shape.contours), mask.region)):
        return None
    # What the mask lets through, and how much its shapes cover in the colour of the rectangle.
    seen = np.zeros((GRID, GRID))
    painted = np.zeros_like(seen)
    areas = rasters(around, *((each, layer.rule) for each, layer in zip(outlines, layers, strict=True)))
    for layer, area in zip(layers, areas, strict=True):
        seen[area] += layer.opacity * (layer.brightness - seen[area])
        opacity = style.fill_opacity * layer.opacity * layer.brightness
        painted[area] += opacity * (1.0 - painted[area])
    is_other = np.abs(style.fill_opacity * seen - painted) > LEAST_SEEN
    if not seen.any() or is_other.sum() > MOST_UNLIKE * (seen > 0.0).sum():
        return None
    return list(_in_colour(shape, layers))


def _in_colour(shape: Shape, layers: Sequence[_Layer]) -> Iterator[Shape]:
    """Yield the shapes of a mask in the colour of a fill."""
    is_of_page = "fill" in shape.page_coloured
    for _, group in groupby(layers, key=lambda layer: id(layer.shape)):
        own = list(group)
        style, names = own[0].shape.style._replace(fill=None, stroke=None), []
        for layer in own:
            opacity = shape.style.fill_opacity * layer.opacity * layer.brightness
            if layer.is_stroke:
                style = style._replace(stroke=shape.style.fill, stroke_opacity=opacity)
            else:
                style = style._replace(fill=shape.style.fill, fill_opacity=opacity)
            names.append("stroke" if layer.is_stroke else "fill")
        page_coloured = tuple(sorted(names)) if is_of_page else ()
        contours = own[0].shape.contours
        yield replace(shape, contours=contours, style=style, page_coloured=page_coloured, effects=())
        shape = replace(shape, name=UNNAMED)  # readers are told once


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
    from pathops import OpBuilder, PathOp, PathOpsError, op

    sheet = Sheet.around(shape.contours, CUT)
    steps = list(_steps(sheet, mask, layers, clips))
    parts = [(sheet.outlines(step.area), step) for step in steps]
    region = OpBuilder(keep_starting_points=False)
    found: list[Shape] = []
    is_cut = False
    for step in steps:
        region.add(step.area, step.how)
    try:
        shown = region.resolve()
        for layer in (
            _Layer(shape, is_stroke, 1.0, paint.opacity) for paint, is_stroke in _paints(shape.style)
        ):
            whole = layer.area(sheet)
            left = op(whole, shown, PathOp.INTERSECTION, keep_starting_points=False)
            lost = op(whole, shown, PathOp.DIFFERENCE, keep_starting_points=False)
            outlines = sheet.outlines(left)
            if sum(len(path.segments) for path in outlines) > MOST_SEGMENTS:
                return None
            if not _is_right((sheet.outlines(whole), layer.rule), outlines, parts):
                return None
            is_cut |= abs(lost.area) > NOTHING * (abs(left.area) + abs(lost.area))
            if outlines:
                # Readers are told once what it is.
                found.append(_filled(replace(shape, name=UNNAMED) if found else shape, layer, outlines))
    except PathOpsError:
        return None
    return (found or None) if is_cut else [replace(shape, clips=(), effects=())]


def _is_right(
    whole: tuple[Sequence[Contour], str],
    left: Sequence[Contour],
    parts: Sequence[tuple[Sequence[Contour], _Step]],
) -> bool:
    """Return whether outlines are what some steps leave of others, seen on a raster around what they show.

    The library is at a loss with some areas, and what it returns is another picture.
    """
    from pathops import PathOp

    added = [path for paths, step in parts for path in paths if step.how == PathOp.UNION]
    if not whole[0] or not added:
        return not left
    box = _common(control_box(whole[0]), control_box(added))
    if box is None:
        return not left
    areas = ((paths, step.rule) for paths, step in parts)
    before, after, *others = rasters(box, whole, (left, "nonzero"), *areas)
    seen = np.zeros_like(before)
    for other, (_, step) in zip(others, parts, strict=True):
        is_taken = step.how == PathOp.DIFFERENCE
        seen = seen | other if step.how == PathOp.UNION else seen & (other ^ is_taken)
    return bool((before & seen).any()) and are_alike(before & seen, after)


def _common(one: Box, other: Box) -> Box | None:
    """Return what two boxes have in common; None if that is nothing."""
    x, y = max(one.x, other.x), max(one.y, other.y)
    width = min(one.x + one.width, other.x + other.width) - x
    height = min(one.y + one.height, other.y + other.height) - y
    return Box(x, y, width, height) if width > 0.0 and height > 0.0 else None


def _filled(shape: Shape, layer: _Layer, outlines: Sequence[Contour]) -> Shape:
    """Return what is left of a shape's fill or stroke, as a fill."""
    paint = shape.style.paints[layer.is_stroke]
    style = shape.style._replace(
        stroke=None, fill_rule="nonzero", fill=paint.colour, fill_opacity=paint.opacity
    )
    is_of_page = ("stroke" if layer.is_stroke else "fill") in shape.page_coloured
    return replace(
        shape,
        contours=tuple(outlines),
        style=style,
        page_coloured=("fill",) if is_of_page else (),
        clips=(),
        effects=(),
    )
