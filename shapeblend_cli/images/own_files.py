"""Frames whose pictures are our own files, for programs that are not to read others'."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from shapeblend_cli.images.decode import as_png
from shapeblend_cli.model import Content, Pattern, Picture, Raster, Step, Style

if TYPE_CHECKING:
    from shapeblend_cli.model import Effect, Filling, Frame, PaintedShape


def with_own_pictures(frame: Frame, side: int) -> Frame:
    """Return a frame for a picture of some pixels on its longer side, with each picture in it encoded again.

    Pictures far larger than they are seen are made smaller: programs that skip pixels would show others at each moment.
    """
    scale = side / frame.view.larger_side

    def own(shape: PaintedShape) -> PaintedShape:
        effects = tuple(_masked(effect, scale) for effect in shape.effects)
        if shape.bent is not None:
            bent = Style(fill_gradient=shape.bent.drawn(frame.view, side))
            return shape._replace(style=bent, below=None, bent=None, effects=effects)
        below = shape.below and _painted(shape.below, scale)
        return shape._replace(style=_painted(shape.style, scale), below=below, effects=effects)

    return frame._replace(shapes=tuple(map(own, frame.shapes)))


def _painted(style: Style, scale: float) -> Style:
    """Return a style with pictures of our own, `scale` pixels for each unit of its coordinates."""
    if not style.has_pictures:
        return style
    fill, stroke = (_filling(paint, scale) for paint in (style.fill_gradient, style.stroke_gradient))
    return style._replace(fill_gradient=fill, stroke_gradient=stroke)


def _filling(paint: Filling | None, scale: float) -> Filling | None:
    if isinstance(paint, Picture):
        seen = scale * min(abs(paint.across), abs(paint.down))
        return paint._replace(raster=as_png(paint.raster, 1 << max(round(seen) - 1, 1).bit_length()))
    if isinstance(paint, Pattern):
        return paint._replace(content=_content(paint.content, scale * max(map(abs, paint.scale))))
    return paint


def _masked(effect: Effect, scale: float) -> Effect:
    if not effect.has_pictures:
        return effect
    if effect.filter is not None and effect.filter.has_pictures:
        steps = tuple(_shown(step, scale) for step in effect.filter.steps)
        effect = effect._replace(filter=effect.filter._replace(steps=steps))
    if effect.mask is None:
        return effect
    layers = tuple(
        layer
        if layer.content is None
        else layer._replace(content=_content(layer.content, scale * max(map(abs, layer.scale))))
        for layer in effect.mask.layers
    )
    return effect._replace(mask=effect.mask._replace(layers=layers))


def _shown(step: Step, scale: float) -> Step:
    if not isinstance(step.image, Raster) or step.region is None:
        return step
    seen = scale * max(step.region.width, step.region.height)
    return step._replace(image=as_png(step.image, 1 << max(round(seen) - 1, 1).bit_length()))


def _content(content: Content, scale: float) -> Content:
    if not content.has_pictures:
        return content
    shapes = (
        replace(
            shape,
            style=_painted(shape.style, scale),
            effects=tuple(_masked(effect, scale) for effect in shape.effects),
        )
        for shape in content.shapes
    )
    return Content(tuple(shapes), content.key)
