"""Similarities of the plane, which map drawings whole: contours, boxes, and the lengths of their styles."""

from __future__ import annotations

import cmath
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from shapeblend_cli.model import (
    Box,
    Contour,
    Effect,
    Filter,
    LinearGradient,
    Mask,
    Pattern,
    Picture,
    Polygon,
    Step,
    Style,
)

if TYPE_CHECKING:
    from shapeblend_cli.model import Clip, ComplexArray, Filling

LENGTHS = frozenset("stdDeviation radius dx dy scale surfaceScale z pointsAtZ".split())
"""Numbers of a filter that are lengths."""

PLACES = frozenset("x y pointsAtX pointsAtY".split())
"""Numbers of a filter that are coordinates."""


class Similarity(NamedTuple):
    """The map ``z -> factor * (z - about) + onto``.

    Attributes
    ----------
    factor : complex
        Its absolute value scales, its argument rotates.
    onto, about : complex
        A point, and the one that is laid onto it. Kept apart, because rounding is less around a drawing's own centre.
    """

    factor: complex = 1.0
    onto: complex = 0j
    about: complex = 0j

    @classmethod
    def rotation(cls, angle: float, onto: complex = 0j, about: complex = 0j) -> Similarity:
        """Return the rotation by an angle in radians, positive from x towards y."""
        return cls(cmath.rect(1.0, angle), onto, about)

    def point(self, z: complex) -> complex:
        """Map a point."""
        return self.factor * (z - self.about) + self.onto

    def points(self, z: ComplexArray) -> ComplexArray:
        """Map points."""
        return self.factor * (z - self.about) + self.onto

    def contour(self, contour: Contour) -> Contour:
        """Map a contour."""
        return replace(contour, segments=self.points(contour.segments))

    def polygon(self, polygon: Polygon) -> Polygon:
        """Map a polygon."""
        return replace(polygon, vertices=self.points(polygon.vertices))

    # What follows is for maps that do not rotate.

    def box(self, box: Box) -> Box:
        """Map a box."""
        corner = self.point(complex(box.x, box.y))
        return Box(corner.real, corner.imag, abs(self.factor) * box.width, abs(self.factor) * box.height)

    def style(self, style: Style) -> Style:
        """Map the lengths and gradients of a style."""
        scale = abs(self.factor)
        return style.stretched(scale)._replace(
            fill_gradient=style.fill_gradient and self._gradient(style.fill_gradient),
            stroke_gradient=style.stroke_gradient and self._gradient(style.stroke_gradient),
            pixel=style.pixel and scale * style.pixel,
        )

    def effect(self, effect: Effect, clips: tuple[Clip, ...]) -> Effect:
        """Map the lengths and places of an effect, whose `clips` are mapped already."""
        made = effect.filter
        if made is not None:
            made = Filter(self.box(made.region), tuple(map(self._step, made.steps)))
        mask = effect.mask
        if mask is not None:
            layers = (
                layer._replace(
                    shift=self.point(layer.shift),
                    scale=(abs(self.factor) * layer.scale[0], abs(self.factor) * layer.scale[1]),
                )
                for layer in mask.layers
            )
            mask = Mask(self.box(mask.region), tuple(layers))
        return effect._replace(filter=made, clips=clips, mask=mask)

    def _step(self, step: Step) -> Step:
        scale = abs(self.factor)
        numbers = []
        for name, values in step.numbers:
            if name in PLACES:
                shift = self.point(0j)
                values = (scale * values[0] + (shift.real if name in ("x", "pointsAtX") else shift.imag),)
            elif name in LENGTHS:
                values = tuple(scale * value for value in values)
            elif name == "baseFrequency":
                values = tuple(value / scale for value in values)
            numbers.append((name, values))
        return step._replace(
            numbers=tuple(numbers),
            region=step.region and self.box(step.region),
            parts=tuple(map(self._step, step.parts)),
        )

    def _gradient(self, gradient: Filling) -> Filling:
        if isinstance(gradient, Picture):
            across, down = self.factor * gradient.across, self.factor * gradient.down
            return gradient._replace(origin=self.point(gradient.origin), across=across, down=down)
        if isinstance(gradient, LinearGradient):
            return gradient._replace(start=self.point(gradient.start), end=self.point(gradient.end))
        if isinstance(gradient, Pattern):
            x, y = gradient.scale
            scale = abs(self.factor)
            return gradient._replace(origin=self.point(gradient.origin), scale=(scale * x, scale * y))
        first, second = (abs(self.factor) * radius for radius in gradient.radii)
        return gradient._replace(centre=self.point(gradient.centre), radii=(first, second))
